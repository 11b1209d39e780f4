//! Every finding code. Codes are stable: they are never renamed, only retired.

use crate::Severity;

/// What is known of a code.
#[derive(Clone, Copy, Debug)]
pub struct CodeInfo {
    /// The code.
    pub code: &'static str,
    /// How serious it is unless configured otherwise.
    pub severity: Severity,
    /// What it means and what to do.
    pub doc: &'static str,
}

macro_rules! codes {
    ($($name:ident = $code:literal, $severity:ident, $doc:literal;)*) => {
        /// One constant per code.
        pub mod code {
            use super::CodeInfo;
            use crate::Severity;
            $(
                #[doc = $doc]
                pub const $name: CodeInfo = CodeInfo { code: $code, severity: Severity::$severity, doc: $doc };
            )*
        }
        /// All codes, by name.
        pub const CODES: &[CodeInfo] = &[$(code::$name),*];
    };
}

codes! {
    ALPHA_BLENDED = "ALPHA-BLENDED", Warning, "A leaf material is blended: what is drawn depends on the order of the leaves, and shadows lose their holes; set alphaMode to MASK.";
    ALPHA_IGNORED = "ALPHA-IGNORED", Warning, "The texture of a leaf material has holes, and its alphaMode is OPAQUE: leaves are drawn as cards; set alphaMode to MASK.";
    ALPHA_MISSING = "ALPHA-MISSING", Warning, "A material is masked or blended, and neither its texture nor its factor has alpha: the shape of the leaves was lost, or OPAQUE was meant.";
    BRANCH_FUSED = "BRANCH-FUSED", Warning, "Wood in one piece forks: its branches were told apart by the shape of the surface, or were not (branches.method); separate tubes are surer.";
    BRANCH_ISLAND = "BRANCH-ISLAND", Warning, "Wood that nothing bears and that does not stand on the ground: move it to its parent, or name its part --other.";
    BRANCH_LEVELS = "BRANCH-LEVELS", Note, "More than four levels of branches: those beyond move as their ancestor of the fourth does.";
    BRANCH_UNSURE = "BRANCH-UNSURE", Note, "A branch might as well hang elsewhere: look at it in the report, and move its root closer to its parent if it is wrong.";
    CONTRACT_CHANNEL = "CONTRACT-CHANNEL", Error, "A channel is not stored as the contract says, or not on every primitive of its mesh: bake again.";
    CONTRACT_COLLISION = "CONTRACT-COLLISION", Error, "Two things of one file claim the same name: records of one room, ids of one label, tables of one class; bake again from the base.";
    CONTRACT_DECLARED = "CONTRACT-DECLARED", Error, "An extension of the contract is not listed in extensionsUsed, or is listed as required, which stock loaders refuse.";
    CONTRACT_ID = "CONTRACT-ID", Error, "Ids of leaves or branches do not fit their table: no whole number, or no row of it; bake again.";
    CONTRACT_MIRROR = "CONTRACT-MIRROR", Error, "The extension and its mirror in extras disagree, or one of them is broken: a tool changed one; bake again.";
    CONTRACT_RANGE = "CONTRACT-RANGE", Error, "A value of a channel or column is outside its declared range, not finite, or no unit vector: bake again.";
    CONTRACT_RECORD = "CONTRACT-RECORD", Error, "Records and contents disagree: a record names what is not there, or no record names what is there.";
    CONTRACT_TABLE = "CONTRACT-TABLE", Error, "A property table is not stored as the contract says: class, type, rows or bytes.";
    CONTRACT_UNIT = "CONTRACT-UNIT", Error, "Leaves of the table lie outside the plant: the geometry was scaled, turned or moved after baking, or the table is not in meters; bake again.";
    FILE_BROKEN = "FILE-BROKEN", Error, "The file, or a place in it, cannot be read as its format says: export it again.";
    FILE_COMPRESSED = "FILE-COMPRESSED", Warning, "Geometry that only a decoder can read: it was not checked; check the file before it is compressed, or decode it.";
    FILE_EMPTY = "FILE-EMPTY", Warning, "Nothing in the file draws a triangle.";
    GEOMETRY_COINCIDENT = "GEOMETRY-COINCIDENT", Note, "Triangles lie back to back on the same three points: a doubled sheet; a doubleSided material says the same with half the vertices.";
    GEOMETRY_DUPLICATE = "GEOMETRY-DUPLICATE", Warning, "Triangles stand twice on the same three points, facing the same way: they flicker and count twice; delete the copies.";
    GEOMETRY_INDEX = "GEOMETRY-INDEX", Error, "An index names a vertex that does not exist.";
    GEOMETRY_NAN = "GEOMETRY-NAN", Error, "A number of the geometry is not finite: renderers drop or smear what hangs on it; repair it in the modeller.";
    GEOMETRY_NORMAL = "GEOMETRY-NORMAL", Warning, "Normals are not of unit length: lighting is wrong there; export them again.";
    GEOMETRY_UNUSED = "GEOMETRY-UNUSED", Note, "Vertices that no triangle uses: they cost memory and draw nothing.";
    GEOMETRY_WRAP = "GEOMETRY-WRAP", Error, "More than 65,536 vertices, and no index above 65,535: indices were cut to 16 bits and wrapped around; export with 32-bit indices or in smaller meshes.";
    GEOMETRY_ZERO_AREA = "GEOMETRY-ZERO-AREA", Note, "Triangles without area: they draw nothing; delete them.";
    IMPORT_BUMP = "IMPORT-BUMP", Note, "A bump map was converted to a normal map, or recognised as one.";
    IMPORT_DEGENERATE = "IMPORT-DEGENERATE", Note, "Triangles without area, or vertices that no triangle uses, were kept in the base and ignored.";
    IMPORT_ENCODING = "IMPORT-ENCODING", Note, "The text was not UTF-8 and was read as Latin-1, or carried a byte order mark.";
    IMPORT_IGNORED = "IMPORT-IGNORED", Note, "Content that foliar has no use for was left out of the conversion.";
    IMPORT_INSTANCES = "IMPORT-INSTANCES", Note, "A mesh is drawn by several nodes: it is baked for the first; --expand-instances makes a mesh per node.";
    IMPORT_LOD = "IMPORT-LOD", Note, "Several levels of detail: only the finest is baked.";
    IMPORT_LYING = "IMPORT-LYING", Warning, "The trunk lies on its side: the file's up axis is probably wrong; set it in the exporter.";
    IMPORT_MTL = "IMPORT-MTL", Warning, "A material library or material is missing; plain materials stand in.";
    IMPORT_TEXTURE = "IMPORT-TEXTURE", Warning, "A texture is missing or could not be read; the part is treated as opaque.";
    IMPORT_TREES = "IMPORT-TREES", Warning, "More than one tree in the file: choose one with --node or --scene.";
    IMPORT_UNIT = "IMPORT-UNIT", Note, "No unit was given: 1 unit was taken for 1 m; say --unit or --height-m.";
    IMPORT_UP = "IMPORT-UP", Note, "No up axis was given: Y was taken for up; say --up.";
    LEAF_NONE = "LEAF-NONE", Warning, "No part is a leaf: rooms that need leaves have nothing to do; name them with --leaf.";
    LEAF_UNBOUND = "LEAF-UNBOUND", Warning, "Leaves are bound to nothing: to no row of the table of leaves, or to no branch, so that they stand still while the tree moves.";
    LEAF_ZERO_AREA = "LEAF-ZERO-AREA", Note, "Pieces of leaf parts without area were kept in the base and given no leaf row.";
    LOST_ALPHA = "LOST-ALPHA", Warning, "A tool changed how a material treats alpha: holes in leaves come out otherwise.";
    LOST_CHANNEL = "LOST-CHANNEL", Error, "A tool dropped a channel that was baked: keep custom attributes, or pack for that tool (foliar-pack).";
    LOST_EXTENSION = "LOST-EXTENSION", Warning, "A tool dropped the extension FOLIAR_foliage; the mirror in extras still says what was baked, unless that is said to be lost too.";
    LOST_GEOMETRY = "LOST-GEOMETRY", Note, "A tool changed the number of triangles: it simplified, welded or pruned.";
    LOST_ID = "LOST-ID", Error, "A tool dropped or changed the ids of leaves or branches: tables cannot be looked up any more.";
    LOST_MIRROR = "LOST-MIRROR", Warning, "A tool dropped the mirror of FOLIAR_foliage in asset.extras.";
    LOST_NAME = "LOST-NAME", Note, "A tool dropped names of materials: patterns and engine rules that go by name no longer match.";
    LOST_PRECISION = "LOST-PRECISION", Warning, "A tool stored a channel more coarsely than an eye can pass over: more than one visible step.";
    LOST_ROLE = "LOST-ROLE", Warning, "A tool dropped the roles of primitives: wood and leaves are not told apart any more.";
    LOST_TABLE = "LOST-TABLE", Error, "A tool dropped a property table: facts about leaves or branches are gone.";
    MAP_BITS = "MAP-BITS", Warning, "A map has so few bits that its steps show: give 16 bits or floats.";
    MAP_COLOR = "MAP-COLOR", Warning, "A map of numbers is tagged as colors, or was stored with loss: its numbers were taken as they are; save it linear, as PNG without profile, TIFF or EXR.";
    MAP_ESTIMATED = "MAP-ESTIMATED", Note, "A map was estimated from a photograph, not measured: take it as an artist's guess.";
    MAP_FITTED = "MAP-FITTED", Note, "Absorption and scattering of a leaf were found from its measured reflectance and transmittance: these are they.";
    MAP_NORMALS = "MAP-NORMALS", Warning, "Normals have no length, or point into the leaf: is it the normal map of that side?";
    MAP_ROUNDED = "MAP-ROUNDED", Note, "A map of coefficients was stored in 8 bits: this is what that costs.";
    MAP_STEEP = "MAP-STEEP", Note, "Thickness rises steeper than 1:1: light leaves through the wall there, which the model does not know.";
    MAP_THIN = "MAP-THIN", Note, "Texels are thinner than any leaf: taken for the least thickness, or, below 0, for no leaf.";
    MAP_TWICE = "MAP-TWICE", Note, "A photograph against the light and coefficients of physical size both hold how thick the leaf is: it counts twice; say normalize = diffuse.";
    MAP_UNIT = "MAP-UNIT", Warning, "A map says a leaf that no plant has: its thickness or its width is probably not in millimeters.";
    MAP_UNUSED = "MAP-UNUSED", Warning, "A map, or a parameter of a material, was given and nothing reads it: for a material that no leaf has, or a side that no light falls on; correct the name, or take it out.";
    MATERIAL_CULLED = "MATERIAL-CULLED", Warning, "A leaf material is seen from one side only, and its leaves have no back: half of them vanish; set doubleSided.";
    NAME_TAKEN = "NAME-TAKEN", Note, "A name that foliar writes is taken by the base: the next free one was used.";
    NEIGHBOR_COINCIDES = "NEIGHBOR-COINCIDES", Warning, "A neighbor is the plant itself, or another neighbor, at the same place: its foliage counts twice; move it or take it out.";
    PACK_BUDGET = "PACK-BUDGET", Warning, "Packing adds more bytes per vertex than scene.budget.bytes_per_vertex allows: raise it, or bake fewer channels.";
    PACK_LEFT_OUT = "PACK-LEFT-OUT", Warning, "Attributes of the base that the engine cannot take beside foliar's were left out of the packed file.";
    PARAM_IDLE = "PARAM-IDLE", Warning, "A parameter was given that has no say beside the others: nothing was read of it; take it out, or give what it needs.";
    QUALITY_MISSED = "QUALITY-MISSED", Warning, "A channel's measured error is above the `quality` that was asked for: ask for less, or take the finding as the error.";
    RECORD_UNKNOWN = "RECORD-UNKNOWN", Note, "A record of an unknown room or a newer contract was kept as it is.";
    REQUIRED_MISSING = "REQUIRED-MISSING", Error, "What --require asks for is not in the file: bake it.";
    ROLE_MIXED = "ROLE-MIXED", Warning, "One part holds trunk and crown without a hint: split it in the modeller, or name its role.";
    ROLE_UNMATCHED = "ROLE-UNMATCHED", Warning, "A pattern of section `roles` matches no part: correct it, or take it out.";
    ROLE_UNSURE = "ROLE-UNSURE", Warning, "The role of a part is a guess: paste the printed lines into foliar.toml; or patterns of two roles match it: change one.";
    SCAN_BENT = "SCAN-BENT", Warning, "A scanned leaf bends away from its plane: its thickness along one axis is too large where it slopes; scan it in its texture coordinates (--unwrap uv).";
    SCAN_BROKEN = "SCAN-BROKEN", Warning, "A scanned mesh has holes or inverted faces where no thickness can be told: those texels are empty; close the mesh.";
    SCAN_FOLDED = "SCAN-FOLDED", Note, "A scanned leaf lies over itself: the layer next to the front was taken.";
    SCAN_OPEN = "SCAN-OPEN", Warning, "A scanned mesh is not closed: close its holes; texels over them are left empty, never filled.";
    SCAN_TURNED = "SCAN-TURNED", Warning, "Faces of a scanned mesh are inverted: make all of them face outward.";
    STALE = "STALE", Warning, "The base, or a neighbor, has changed since a record was baked: run foliar rebake.";
    STALE_UNKNOWN = "STALE-UNKNOWN", Note, "Whether the base has changed since a record was baked was not looked at: its pictures are too large to be decoded for that.";
    TEXTURE_BROKEN = "TEXTURE-BROKEN", Error, "A picture cannot be read: damaged, cut, or no picture at all.";
    TEXTURE_FORMAT = "TEXTURE-FORMAT", Error, "A picture of a kind that this format has not, such as EXR in a core texture of glTF: convert it to PNG.";
    TEXTURE_MISLABELED = "TEXTURE-MISLABELED", Error, "A picture is not what its name or type says, such as EXR named PNG: name it rightly, or convert it.";
    TEXTURE_MISSING = "TEXTURE-MISSING", Error, "A picture that a material names is not there: put it beside the asset, or name its folder with --search.";
    TEXTURE_UNMAPPED = "TEXTURE-UNMAPPED", Warning, "A part has a texture and no texture coordinates: all of it shows one texel.";
    UNIT_SUSPECT = "UNIT-SUSPECT", Warning, "The plant is taller than any tree, or smaller than a leaf, or its leaves are as large as rooms: the unit is probably wrong; say --unit for an OBJ, scale a glTF in the exporter.";
    WOOD_NONE = "WOOD-NONE", Note, "There are leaves and no wood: they hang on nothing.";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_sorted_and_unique() {
        assert!(CODES.windows(2).all(|w| w[0].code < w[1].code));
    }
}

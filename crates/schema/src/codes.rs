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
    BRANCH_FUSED = "BRANCH-FUSED", Warning, "Wood in one piece forks: its branches were told apart by the shape of the surface, or were not (branches.method); separate tubes are surer.";
    BRANCH_ISLAND = "BRANCH-ISLAND", Warning, "Wood that nothing bears and that does not stand on the ground: move it to its parent, or name its part --other.";
    BRANCH_LEVELS = "BRANCH-LEVELS", Note, "More than four levels of branches: those beyond move as their ancestor of the fourth does.";
    BRANCH_UNSURE = "BRANCH-UNSURE", Note, "A branch might as well hang elsewhere: look at it in the report, and move its root closer to its parent if it is wrong.";
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
    LEAF_ZERO_AREA = "LEAF-ZERO-AREA", Note, "Pieces of leaf parts without area were kept in the base and given no leaf row.";
    NAME_TAKEN = "NAME-TAKEN", Note, "A name that foliar writes is taken by the base: the next free one was used.";
    NEIGHBOR_COINCIDES = "NEIGHBOR-COINCIDES", Warning, "A neighbor is the plant itself, or another neighbor, at the same place: its foliage counts twice; move it or take it out.";
    PACK_BUDGET = "PACK-BUDGET", Warning, "Packing adds more bytes per vertex than scene.budget.bytes_per_vertex allows: raise it, or bake fewer channels.";
    PACK_LEFT_OUT = "PACK-LEFT-OUT", Warning, "Attributes of the base that the engine cannot take beside foliar's were left out of the packed file.";
    QUALITY_MISSED = "QUALITY-MISSED", Warning, "A channel's measured error is above the `quality` that was asked for: ask for less, or take the finding as the error.";
    RECORD_UNKNOWN = "RECORD-UNKNOWN", Note, "A record of an unknown room or a newer contract was kept as it is.";
    ROLE_MIXED = "ROLE-MIXED", Warning, "One part holds trunk and crown without a hint: split it in the modeller, or name its role.";
    ROLE_UNMATCHED = "ROLE-UNMATCHED", Warning, "A pattern of section `roles` matches no part: correct it, or take it out.";
    ROLE_UNSURE = "ROLE-UNSURE", Warning, "The role of a part is a guess: paste the printed lines into foliar.toml; or patterns of two roles match it: change one.";
    STALE = "STALE", Warning, "The base, or a neighbor, has changed since a record was baked: run foliar rebake.";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_sorted_and_unique() {
        assert!(CODES.windows(2).all(|w| w[0].code < w[1].code));
    }
}

//! Names that stand in files.

/// Our own glTF extension, at the root and at primitives.
pub const EXTENSION: &str = "FOLIAR_foliage";
/// Feature ids per vertex (3D Tiles).
pub const MESH_FEATURES: &str = "EXT_mesh_features";
/// Property tables (3D Tiles).
pub const STRUCTURAL_METADATA: &str = "EXT_structural_metadata";
/// Prefix of feature id attributes; the first free number is taken.
pub const FEATURE_ID_PREFIX: &str = "_FEATURE_ID_";
/// Label of the leaf ids among a primitive's feature ids.
pub const LABEL_LEAF: &str = "foliar_leaf";
/// Label of the branch ids among a primitive's feature ids.
pub const LABEL_BRANCH: &str = "foliar_branch";
/// Buffer views of foliar are named `foliar:ROOM:NAME`.
pub const VIEW_PREFIX: &str = "foliar:";
/// Id of the schema that foliar writes where a file has none.
pub const METADATA_SCHEMA_ID: &str = "foliar";

/// Layer key of leaf ids (in files: a feature id attribute with label [`LABEL_LEAF`]).
pub const LEAF_ID: &str = "LEAF_ID";
/// Layer key of branch ids (in files: a feature id attribute with label [`LABEL_BRANCH`]).
pub const BRANCH_ID: &str = "BRANCH_ID";
/// Arc length along the branch that the vertex belongs to.
pub const BRANCH_ARC: &str = "_BRANCH_ARC";
/// Ambient coefficient k_a (Luft07 eq. 4) or the sky's ambient term.
pub const AMBIENT: &str = "_AMBIENT";
/// Realigned normal (Luft07 section 4), unit, in the mesh's own frame.
pub const SOFT_NORMAL: &str = "_SOFT_NORMAL";

/// Weights of the four levels of branches, 0 at the bark to 1 at the tip of a level's longest branch (Kusternig07 section 5).
pub const WIND_WEIGHTS: &str = "_WIND_WEIGHTS";
/// A leaf's own weight, 0 at the petiole to 1 at the tip.
pub const LEAF_WEIGHT: &str = "_LEAF_WEIGHT";

/// Optical depths of a place in the four octants below (Boulanger08 section 6.1).
pub const LIGHT_DEPTH_0: &str = "_LIGHT_DEPTH_0";
/// Optical depths of a place in the four octants above.
pub const LIGHT_DEPTH_1: &str = "_LIGHT_DEPTH_1";
/// Property of [`CLASS_LIGHT`]: optical depths of a leaf in the eight octants.
pub const OPTICAL_DEPTH: &str = "opticalDepth";
/// Property of [`CLASS_LIGHT`]: spherical harmonics of a leaf's transmittance.
pub const SUN_HARMONICS: &str = "sunSh";

/// Table class of leaves; row = leaf id.
pub const CLASS_LEAF: &str = "foliarLeaf";

/// Table class of branches; row = branch id.
pub const CLASS_BRANCH: &str = "foliarBranch";
/// Table class of the rings that the axes of branches run through, branch by branch, from root to tip.
pub const CLASS_AXIS: &str = "foliarBranchAxis";
/// Table class of what moves branches; row = branch id.
pub const CLASS_WIND: &str = "foliarWind";

/// Table class of the light that reaches leaves; row = leaf id.
pub const CLASS_LIGHT: &str = "foliarLight";

/// The step that finds roles and leaves.
pub const ROOM_STRUCTURE: &str = "structure";
/// The layer of the branch hierarchy, which structure finds when a room asks for it.
pub const ROOM_BRANCHES: &str = "branches";
/// The room of wind (Kusternig07 section 5).
pub const ROOM_WIND: &str = "wind";
/// The room of light in the crown (Boulanger08).
pub const ROOM_LIGHT: &str = "light";
/// The room of metaball density (Luft07).
pub const ROOM_DENSITY: &str = "density";

/// The baker of wind noise: a texture for a library, no part of a tree.
pub const ROOM_NOISE: &str = "noise";
/// Raster of wind noise, two channels (Kusternig07 section 5).
pub const RASTER_NOISE: &str = "noise";

/// The room of light through leaves (Kusternig07 section 3.5): lives on maps, of one leaf material each.
pub const ROOM_TRANSLUCENCY: &str = "translucency";
/// Raster shown on the front of a leaf: three coefficients and the mean over directions; green or the one wavelength.
pub const RASTER_TRANSLUCENCY_FRONT: &str = "translucencyFront";
/// The same shown on the back.
pub const RASTER_TRANSLUCENCY_BACK: &str = "translucencyBack";
/// Ending of a raster of red light.
pub const BAND_RED: &str = "Red";
/// Ending of a raster of blue light.
pub const BAND_BLUE: &str = "Blue";
/// The baker of leaf scans: maps for a library, no part of a tree.
pub const ROOM_LEAFSCAN: &str = "leafscan";
/// Map of a leaf's thickness.
pub const MAP_THICKNESS: &str = "thickness";
/// Map of where the leaf is.
pub const MAP_ALPHA: &str = "alpha";
/// Map of the front's normals.
pub const MAP_NORMAL_FRONT: &str = "normal-front";
/// Map of the back's normals.
pub const MAP_NORMAL_BACK: &str = "normal-back";
/// Map of the front's relief.
pub const MAP_HEIGHT_FRONT: &str = "height-front";
/// Map of the back's relief, outward from the back.
pub const MAP_HEIGHT_BACK: &str = "height-back";

/// Photograph of a leaf against the light, passed on as it came.
pub const MAP_BACKLIT: &str = "backlit";
/// Color of the light that comes through, the picture of a layer that is passed on as it came.
pub const PICTURE_COLOR: &str = "color";
/// Member of a translucency record's facts: what was made for each set of maps, by name.
pub const FACT_SHEETS: &str = "sheets";
/// In a record's `writes`, what stands before the name of a raster.
pub const WRITES_RASTER: &str = "raster/";
/// In a record's `writes`, what stands before the name of a picture that was passed on.
pub const WRITES_PICTURE: &str = "picture/";
/// Extension of materials that let light through (Khronos).
pub const DIFFUSE_TRANSMISSION: &str = "KHR_materials_diffuse_transmission";
/// Ending of the folder beside a file where its side files lie: `tree.foliar/` beside `tree.glb`.
pub const SIDE_ENDING: &str = "foliar";

/// Key of the record in the metadata of a layer file (safetensors).
pub const LAYER_METADATA_KEY: &str = "foliar";
/// File ending of a layer on disk.
pub const LAYER_ENDING: &str = "layer";

/// Packed for `luft07`: along the realigned normal, as long as the ambient coefficient (Luft07's encoding).
pub const NORMAL_AMBIENT: &str = "_NORMAL_AMBIENT";
/// Packed for Blender: [`SOFT_NORMAL`] with Z up, as Blender turns every normal but not custom attributes.
pub const SOFT_NORMAL_ZUP: &str = "_SOFT_NORMAL_ZUP";
/// Packed for Blender: leaf id, -1 where the vertex belongs to none.
pub const PACKED_LEAF_ID: &str = "_LEAF_ID";
/// What a packed file says of itself, in `asset.extras`: engine and generator.
pub const PACKED: &str = "FOLIAR_packed";

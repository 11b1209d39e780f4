//! Names that stand in files: those of rooms from their files in `rooms`, and those that no room writes.

pub use crate::rooms::names::*;

/// Our own glTF extension, at the root and at primitives.
pub const EXTENSION: &str = "FOLIAR_foliage";
/// Feature ids per vertex (3D Tiles).
pub const MESH_FEATURES: &str = "EXT_mesh_features";
/// Property tables (3D Tiles).
pub const STRUCTURAL_METADATA: &str = "EXT_structural_metadata";
/// Prefix of feature id attributes; the first free number is taken.
pub const FEATURE_ID_PREFIX: &str = "_FEATURE_ID_";
/// Buffer views of foliar are named `foliar:ROOM:NAME`.
pub const VIEW_PREFIX: &str = "foliar:";
/// Id of the schema that foliar writes where a file has none.
pub const METADATA_SCHEMA_ID: &str = "foliar";

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

//! The base: what import found in a file, before anyone says what is a leaf.

use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3};

/// Where a part stands in its glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// Index into `meshes`.
    pub mesh: u32,
    /// Index into the mesh's `primitives`.
    pub primitive: u32,
}

/// One primitive: triangles of one material.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Where it stands in the glTF.
    pub place: Place,
    /// Material name, where it has one.
    pub material_name: Option<String>,
    /// Name of the mesh (OBJ: the object or group).
    pub object_name: Option<String>,
    /// Name of the first node that draws it.
    pub node_name: Option<String>,
    /// Index into [`Base::materials`].
    pub material: Option<u32>,
    /// From the mesh's own frame to the rest frame of the scene, in meters, Y up.
    pub transform: DAffine3,
    /// POSITION, mesh frame.
    pub positions: Vec<Vec3>,
    /// NORMAL, mesh frame; empty where there is none.
    pub normals: Vec<Vec3>,
    /// TEXCOORD of the base color texture (glTF: v down); empty where there is none.
    pub uvs: Vec<Vec2>,
    /// COLOR_0, linear, without its alpha; empty where there is none. For pictures: no room reads it.
    pub colors: Vec<Vec3>,
    /// Vertex indices, counter-clockwise seen from the front in the *rest frame* (a mirrored node's are turned).
    pub triangles: Vec<[u32; 3]>,
    /// Vertices that share an id are one position of the file (OBJ: the file's own `v` index; glTF:
    /// one id per element of a POSITION accessor). Unique over the whole base, below `Base::position_count`.
    pub position_ids: Vec<u32>,
}

impl Part {
    /// The name that reports and patterns use first: material, else node, else mesh, else empty.
    pub fn name(&self) -> &str {
        [&self.material_name, &self.node_name, &self.object_name]
            .into_iter()
            .flatten()
            .next()
            .map_or("", String::as_str)
    }

    /// Vertex `index` in the rest frame, meters.
    pub fn rest_position(&self, index: usize) -> DVec3 {
        self.transform.transform_point3(self.positions[index].as_dvec3())
    }

    /// Takes a normal of the rest frame into the mesh's frame (unit again): n_mesh ~ M^T n_rest,
    /// because renderers take it back by the inverse transpose M^-T.
    pub fn normal_to_mesh(&self, normal: DVec3) -> DVec3 {
        (self.linear().transpose() * normal).normalize_or(normal)
    }

    /// Takes a normal of the mesh's frame into the rest frame (unit again), as renderers do. For a
    /// flattening transform, whose inverse does not exist, the cofactor matrix still answers.
    pub fn normal_to_rest(&self, normal: DVec3) -> DVec3 {
        let m = self.linear();
        let cofactor = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
        (cofactor * normal * m.determinant().signum()).normalize_or(normal)
    }

    fn linear(&self) -> DMat3 {
        self.transform.matrix3
    }
}

/// How a material treats alpha.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Fragments below the cutoff vanish.
    Mask(f32),
    /// Blended.
    Blend,
}

/// What foliar needs to know of a material.
#[derive(Clone, Debug, Default)]
pub struct Material {
    /// Name, where it has one.
    pub name: Option<String>,
    /// Linear RGBA factor.
    pub base_color: [f32; 4],
    /// Index into [`Base::rasters`] of the base color texture, sRGB with alpha.
    pub base_color_raster: Option<u32>,
    /// How alpha is treated.
    pub alpha_mode: AlphaMode,
    /// Seen from both sides.
    pub double_sided: bool,
}

/// A decoded picture, 8 bits per channel, row by row from the top.
#[derive(Clone, Debug, Default)]
pub struct Raster {
    /// Name for reports: file name or image name.
    pub name: String,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// RGBA, four bytes per pixel.
    pub rgba: Vec<u8>,
    /// Whether any pixel has alpha below 255.
    pub has_alpha: bool,
}

/// What import found: role-free.
#[derive(Clone, Debug, Default)]
pub struct Base {
    /// Primitives, in the order (mesh, primitive).
    pub parts: Vec<Part>,
    /// Materials of the file.
    pub materials: Vec<Material>,
    /// Decoded base color textures.
    pub rasters: Vec<Raster>,
    /// Number of position ids: every `position_ids` entry is below it.
    pub position_count: u32,
}

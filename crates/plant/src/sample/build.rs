//! Builds a base and its true structure side by side, piece by piece.

use super::hierarchy::Hierarchy;
use crate::{AlphaMode, Axis, Base, Leaf, Material, NO_LEAF, OnBranch, Part, Place, Plant, Raster, Structure};
use foliar_schema::Role;
use glam::{DAffine3, DVec3, Vec2, Vec3};

/// A connected piece of triangles in its part's own frame.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// Positions.
    pub positions: Vec<Vec3>,
    /// Texture coordinates, v down; as many as positions, or none.
    pub uvs: Vec<Vec2>,
    /// Counter-clockwise seen from the front, in the part's own frame.
    pub triangles: Vec<[u32; 3]>,
    /// For each vertex the first vertex of the piece at the same place (texture seams); itself where empty.
    pub twin_of: Vec<u32>,
}

/// What a piece is, as a leaf.
#[derive(Clone, Copy, Debug)]
pub struct LeafTruth {
    /// Share of its area that is opaque.
    pub coverage: f64,
    /// Where it is joined to the wood, in the part's own frame.
    pub petiole: Vec3,
    /// Group it belongs to; a group of its own where `None`.
    pub group: Option<u32>,
    /// Branch (as [`Build::branch`] numbered it) and arc length where it hangs; the nearest axis where it says none.
    pub on: OnBranch,
}

/// A plant in the making.
#[derive(Debug, Default)]
pub struct Build {
    /// So far.
    pub base: Base,
    /// So far.
    pub structure: Structure,
    /// So far.
    pub hierarchy: Hierarchy,
}

impl Build {
    /// Adds a material; `raster` is its base color, masked where it has alpha.
    pub fn material(&mut self, name: &str, raster: Option<Raster>) -> u32 {
        let masked = raster.as_ref().is_some_and(|r| r.has_alpha);
        let base_color_raster = raster.map(|raster| {
            self.base.rasters.push(raster);
            self.base.rasters.len() as u32 - 1
        });
        self.base.materials.push(Material {
            name: Some(name.into()),
            base_color: [1.0; 4],
            base_color_raster,
            alpha_mode: if masked { AlphaMode::Mask(0.5) } else { AlphaMode::Opaque },
            double_sided: true,
        });
        self.base.materials.len() as u32 - 1
    }

    /// Adds an empty part: one mesh of one primitive.
    pub fn part(&mut self, name: &str, role: Role, material: u32, transform: DAffine3) -> usize {
        let index = self.base.parts.len();
        self.base.parts.push(Part {
            place: Place { mesh: index as u32, primitive: 0 },
            material_name: self.base.materials[material as usize].name.clone(),
            object_name: Some(name.into()),
            node_name: Some(name.into()),
            material: Some(material),
            transform,
            ..Part::default()
        });
        self.structure.roles.push(role);
        self.structure.leaf_ids.push(Vec::new());
        index
    }

    /// Adds a piece that is no leaf.
    pub fn piece(&mut self, part: usize, piece: &Piece) {
        let first_id = self.base.position_count;
        let part_data = &mut self.base.parts[part];
        let first = part_data.positions.len() as u32;
        let mirrored = part_data.transform.matrix3.determinant() < 0.0;
        part_data.positions.extend(&piece.positions);
        part_data.uvs.extend(&piece.uvs);
        part_data.triangles.extend(piece.triangles.iter().map(|&[a, b, c]| {
            let [a, b, c] = [a + first, b + first, c + first];
            // Parts hold triangles that are counter-clockwise in the rest frame.
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
        let mut next = first_id;
        let mut ids: Vec<u32> = Vec::with_capacity(piece.positions.len());
        for vertex in 0..piece.positions.len() {
            let twin = piece.twin_of.get(vertex).map_or(vertex, |&t| t as usize);
            let id = if twin < vertex { ids[twin] } else { next };
            next = next.max(id + 1);
            ids.push(id);
        }
        part_data.position_ids.extend(&ids);
        self.base.position_count = next;
        let leaf_ids = &mut self.structure.leaf_ids[part];
        if self.structure.roles[part] == Role::Leaf {
            leaf_ids.resize(leaf_ids.len() + piece.positions.len(), NO_LEAF);
        }
    }

    /// Adds a tube that is one branch: `rings` says for each of its vertices which point of the axis it
    /// belongs to; axis in the part's own frame. Returns the number of the branch.
    pub fn branch(&mut self, part: usize, piece: &Piece, rings: &[u32], axis: &Axis, parent: Option<u32>) -> u32 {
        let first = self.base.parts[part].positions.len();
        self.piece(part, piece);
        self.hierarchy.add(part, first, rings, axis, &self.base.parts[part].transform, parent)
    }

    /// Adds a piece that is one leaf.
    pub fn leaf(&mut self, part: usize, piece: &Piece, truth: &LeafTruth) {
        let first = self.base.parts[part].positions.len();
        let leaf = self.leaf_row(part, piece, truth);
        self.piece(part, piece);
        self.structure.leaf_ids[part][first..].fill(self.structure.leaves.len() as u32);
        self.structure.leaves.push(leaf);
        self.hierarchy.leaf(leaf.petiole, truth.on);
    }

    fn leaf_row(&self, part: usize, piece: &Piece, truth: &LeafTruth) -> Leaf {
        let part = &self.base.parts[part];
        let place = |v: u32| part.transform.transform_point3(piece.positions[v as usize].as_dvec3());
        let turned = part.transform.matrix3.determinant().signum();
        let (mut area, mut center, mut normal) = (0.0, DVec3::ZERO, DVec3::ZERO);
        for &[a, b, c] in &piece.triangles {
            let (a, b, c) = (place(a), place(b), place(c));
            let cross = (b - a).cross(c - a) * turned;
            let twice = cross.length();
            area += twice / 2.0;
            center += (a + b + c) / 3.0 * twice;
            normal += cross;
        }
        Leaf {
            center: (center / (2.0 * area)).as_vec3(),
            normal: normal.normalize_or(DVec3::Y).as_vec3(),
            area: (area * truth.coverage) as f32,
            group: truth.group.unwrap_or(self.structure.leaves.len() as u32),
            petiole: part.transform.transform_point3(truth.petiole.as_dvec3()).as_vec3(),
            crown_volume: false,
        }
    }

    /// The plant.
    #[expect(
        clippy::expect_used,
        reason = "a sample that is no plant is a fault of this folder; a test makes them all"
    )]
    pub fn finish(mut self) -> Plant {
        self.base.parts.iter_mut().for_each(smooth_normals);
        let branches = self.hierarchy.finish(&self.base, &self.structure);
        let plant = Plant::new(self.base, self.structure).expect("samples are plants");
        plant.with_branches(branches).expect("samples are plants")
    }
}

/// Angle-free area-weighted normals over shared positions: what a modeller would have exported.
fn smooth_normals(part: &mut Part) {
    let Some(&low) = part.position_ids.iter().min() else { return };
    let high = part.position_ids.iter().max().copied().unwrap_or(low);
    let mut sums = vec![DVec3::ZERO; (high - low) as usize + 1];
    let mirrored = part.transform.matrix3.determinant() < 0.0;
    for &[a, b, c] in &part.triangles {
        let p = [a, b, c].map(|v| part.positions[v as usize].as_dvec3());
        let cross = (p[1] - p[0]).cross(p[2] - p[0]) * if mirrored { -1.0 } else { 1.0 };
        for v in [a, b, c] {
            sums[(part.position_ids[v as usize] - low) as usize] += cross;
        }
    }
    part.normals =
        part.position_ids.iter().map(|&id| sums[(id - low) as usize].normalize_or(DVec3::Y).as_vec3()).collect();
}

//! Vertices of one object and material: one per different (v, vt, vn), in the order of first use.

use super::file::ObjFile;
use super::frame::Frame;
use super::normals;
use super::runs::Run;
use super::scan::{Corner, NONE};
use glam::{Vec2, Vec3, Vec4};
use std::collections::BTreeMap;

/// A primitive in the making.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    /// Index into the file's objects.
    pub object: Option<u32>,
    /// Index into the file's materials.
    pub material: Option<u32>,
    /// Meters, Y up.
    pub positions: Vec<Vec3>,
    /// Unit.
    pub normals: Vec<Vec3>,
    /// v down; empty where no corner has any.
    pub uvs: Vec<Vec2>,
    /// Unit, w = side of the bitangent; empty unless there is a normal map.
    pub tangents: Vec<Vec4>,
    /// Three per triangle.
    pub indices: Vec<u32>,
    /// The file's `v` index of each vertex.
    pub position_ids: Vec<u32>,
}

/// What building meshes noticed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Noticed {
    /// Vertices whose normal was computed.
    pub computed_normals: usize,
    /// Vertices of textured meshes without a texture coordinate.
    pub missing_uvs: usize,
    /// `v` lines that no face uses.
    pub unused_positions: usize,
}

/// One mesh per object and material, in the order of first appearance.
pub(crate) fn build(file: &ObjFile, frame: Frame) -> (Vec<Mesh>, Noticed) {
    let own = normals::own(file, frame);
    let needs = |c: &Corner| normals::is_missing(&own, c.vn);
    let smooth = if file.triangles.iter().flatten().any(needs) { normals::smooth(file, frame) } else { Vec::new() };
    let mut builder =
        Builder { file, frame, own, smooth, heads: vec![NONE; file.positions.len()], noticed: Noticed::default() };
    let mut used = vec![false; file.positions.len()];
    let meshes: Vec<Mesh> = grouped(&file.runs).iter().map(|runs| builder.mesh(runs)).collect();
    meshes.iter().flat_map(|m| &m.position_ids).for_each(|&id| used[id as usize] = true);
    builder.noticed.unused_positions = used.iter().filter(|&&u| !u).count();
    (meshes, builder.noticed)
}

/// Runs of the same object and material together.
fn grouped(runs: &[Run]) -> Vec<Vec<Run>> {
    let mut places = BTreeMap::new();
    let mut groups: Vec<Vec<Run>> = Vec::new();
    for run in runs {
        let place = *places.entry((run.object, run.material)).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Vec::new());
        }
        groups[place].push(*run);
    }
    groups
}

struct Builder<'a> {
    file: &'a ObjFile,
    frame: Frame,
    own: Vec<Vec3>,
    smooth: Vec<Vec3>,
    /// Per position of the file: the newest vertex there, or [`NONE`]; cleared after each mesh.
    heads: Vec<u32>,
    noticed: Noticed,
}

impl Builder<'_> {
    fn mesh(&mut self, runs: &[Run]) -> Mesh {
        let (vertices, indices) = self.weld(runs);
        let has_uvs = vertices.iter().any(|c| c.vt != NONE);
        if has_uvs {
            self.noticed.missing_uvs += vertices.iter().filter(|c| c.vt == NONE).count();
        }
        self.noticed.computed_normals += vertices.iter().filter(|c| c.vn == NONE).count();
        let position = |c: &Corner| self.frame.position(self.file.positions[c.v as usize]).as_vec3();
        let normal = |c: &Corner| if c.vn == NONE { self.smooth[c.v as usize] } else { self.own[c.vn as usize] };
        Mesh {
            object: runs[0].object,
            material: runs[0].material,
            positions: vertices.iter().map(position).collect(),
            normals: vertices.iter().map(normal).collect(),
            uvs: if has_uvs { vertices.iter().map(|c| self.uv(c)).collect() } else { Vec::new() },
            tangents: Vec::new(),
            indices,
            position_ids: vertices.iter().map(|c| c.v).collect(),
        }
    }

    /// glTF counts v downward from the top.
    fn uv(&self, corner: &Corner) -> Vec2 {
        match self.file.uvs.get(corner.vt as usize) {
            Some(&[u, v]) => Vec2::new(u, (1.0 - f64::from(v)) as f32),
            None => Vec2::ZERO,
        }
    }

    /// The different corners in the order of first use, and an index per corner. A corner whose
    /// normal cannot be used counts as one without.
    fn weld(&mut self, runs: &[Run]) -> (Vec<Corner>, Vec<u32>) {
        let triangles: usize = runs.iter().map(|r| r.end - r.start).sum();
        let mut vertices: Vec<Corner> = Vec::with_capacity(triangles);
        let mut older: Vec<u32> = Vec::with_capacity(triangles);
        let mut indices = Vec::with_capacity(triangles * 3);
        for corner in runs.iter().flat_map(|r| &self.file.triangles[r.start..r.end]).flatten() {
            let vn = if normals::is_missing(&self.own, corner.vn) { NONE } else { corner.vn };
            let corner = Corner { vn, ..*corner };
            let head = self.heads[corner.v as usize];
            let mut at = head;
            while at != NONE && vertices[at as usize] != corner {
                at = older[at as usize];
            }
            if at == NONE {
                at = vertices.len() as u32;
                vertices.push(corner);
                older.push(head);
                self.heads[corner.v as usize] = at;
            }
            indices.push(at);
        }
        vertices.iter().for_each(|c| self.heads[c.v as usize] = NONE);
        (vertices, indices)
    }
}

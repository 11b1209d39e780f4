//! The base that rooms see, from a document: one part per triangle primitive of the chosen scene.

use crate::accessor::Source;
use crate::document::index_of;
use crate::scene::{Drawn, walk_scene};
use crate::{CarrierError, Selection, materials, trees, triangles, uvs};
use foliar_plant::{Base, Part, Place};
use foliar_schema::{Finding, Import, code};
use glam::{DAffine3, Vec2, Vec3};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Largest coordinate that arithmetic further on can square; as `Plant::new` has it.
const LARGEST_COORDINATE: f32 = 1e15;

/// Position ids that an OBJ brings: per mesh and vertex, and how many there are.
pub(crate) struct OwnIds<'a> {
    pub per_mesh: &'a [Vec<u32>],
    pub count: u32,
}

/// The parts that can be read, and why the others cannot.
#[derive(Default)]
pub(crate) struct Readable {
    pub parts: Vec<Part>,
    pub position_count: u32,
    pub errors: Vec<CarrierError>,
}

/// What extraction reads and what it says.
pub(crate) struct Extraction<'a> {
    pub source: Source<'a>,
    pub selection: &'a Selection,
    pub import: &'a Import,
    pub ids: Option<OwnIds<'a>>,
}

impl Extraction<'_> {
    /// Extracts the base.
    pub fn run(&self, findings: &mut Vec<Finding>, files: &mut Vec<PathBuf>) -> Result<Base, CarrierError> {
        let walked = walk_scene(self.source, self.selection, findings)?;
        let first = self.first_drawn(&walked.drawn, findings);
        let surfaces = materials::read(self.source, self.import, findings, files)?;
        let mut ids = PositionIds::default();
        let mut parts = Vec::new();
        for (mesh, drawn) in first {
            let primitives = self.source.document.list("meshes")[mesh].get("primitives").and_then(Value::as_array);
            for (index, primitive) in primitives.into_iter().flatten().enumerate() {
                let place = Place { mesh: mesh as u32, primitive: index as u32 };
                parts.extend(self.part(place, primitive, drawn, &mut ids, findings)?);
            }
        }
        let position_count = self.ids.as_ref().map_or(ids.count, |own| own.count);
        trees::report(self.source, &walked, &parts, self.selection, findings);
        Ok(Base { parts, materials: surfaces.materials, rasters: surfaces.rasters, position_count })
    }

    /// As [`Extraction::run`], without materials; a primitive that cannot be read is left out, and why.
    pub fn readable_parts(&self, findings: &mut Vec<Finding>) -> Result<Readable, CarrierError> {
        let walked = walk_scene(self.source, self.selection, findings)?;
        let mut ids = PositionIds::default();
        let mut read = Readable::default();
        for (mesh, drawn) in self.first_drawn(&walked.drawn, findings) {
            let primitives = self.source.document.list("meshes")[mesh].get("primitives").and_then(Value::as_array);
            for (index, primitive) in primitives.into_iter().flatten().enumerate() {
                let place = Place { mesh: mesh as u32, primitive: index as u32 };
                match self.part(place, primitive, drawn, &mut ids, findings) {
                    Ok(part) => read.parts.extend(part),
                    Err(error) => read.errors.push(error),
                }
            }
        }
        read.position_count = ids.count;
        trees::report(self.source, &walked, &read.parts, self.selection, findings);
        Ok(read)
    }

    /// The first node that draws each mesh.
    fn first_drawn<'d>(&self, drawn: &'d [Drawn], findings: &mut Vec<Finding>) -> BTreeMap<usize, &'d Drawn> {
        let nodes = self.source.document.list("nodes");
        let mut first: BTreeMap<usize, &Drawn> = BTreeMap::new();
        let mut times: BTreeMap<usize, usize> = BTreeMap::new();
        for one in drawn {
            first.entry(one.mesh).or_insert(one);
            *times.entry(one.mesh).or_default() += 1;
            if nodes[one.node].pointer("/extensions/EXT_mesh_gpu_instancing").is_some() {
                *times.entry(one.mesh).or_default() += 1;
            }
            if nodes[one.node].get("skin").is_some() {
                let message = "a skin was ignored: the mesh is baked as its node places it";
                findings.push(self.finding(&code::IMPORT_IGNORED, message, format!("/nodes/{}", one.node)));
            }
        }
        for (mesh, _) in times.into_iter().filter(|(_, times)| *times > 1) {
            let node = first[&mesh].node;
            let message = format!("mesh {mesh} is drawn more than once: it is baked where node {node} places it");
            findings.push(self.finding(&code::IMPORT_INSTANCES, &message, format!("/meshes/{mesh}")));
        }
        first
    }

    fn finding(&self, info: &foliar_schema::CodeInfo, message: &str, place: String) -> Finding {
        Finding::new(info, message).at(place).in_file(self.source.file)
    }

    /// One primitive; `None`, with a finding, where it draws no triangles.
    fn part(
        &self,
        place: Place,
        primitive: &Value,
        drawn: &Drawn,
        ids: &mut PositionIds,
        findings: &mut Vec<Finding>,
    ) -> Result<Option<Part>, CarrierError> {
        let source = self.source;
        let pointer = format!("/meshes/{}/primitives/{}", place.mesh, place.primitive);
        let attributes = primitive.get("attributes").unwrap_or(&Value::Null);
        let (Some(mode), Some(position)) = (triangles::Mode::of(primitive), index_of(attributes, "POSITION")) else {
            let message = "a primitive without triangles or positions is not baked";
            findings.push(self.finding(&code::IMPORT_IGNORED, message, pointer));
            return Ok(None);
        };
        let positions: Vec<Vec3> = self.vectors(position)?;
        let material = index_of(primitive, "material");
        let info = material.and_then(|m| source.document.item("materials", m)).and_then(materials::base_color_info);
        let mirrored = drawn.transform.matrix3.determinant() < 0.0;
        let position_ids = match &self.ids {
            Some(own) => own.per_mesh.get(place.mesh as usize).cloned().unwrap_or_default(),
            None => ids.of(source, position, &drawn.transform, positions.len())?,
        };
        let names = |list: &str, index: usize| -> Option<String> {
            source.document.item(list, index)?.get("name")?.as_str().map(str::to_string)
        };
        Ok(Some(Part {
            place,
            material_name: material.and_then(|m| names("materials", m)),
            object_name: names("meshes", place.mesh as usize),
            node_name: names("nodes", drawn.node),
            material: material.filter(|m| *m < source.document.list("materials").len()).map(|m| m as u32),
            transform: drawn.transform,
            normals: self.optional(attributes, "NORMAL", &positions)?,
            uvs: self.uvs(attributes, info, &positions)?,
            colors: self.colors(attributes, &positions)?,
            triangles: triangles::read(source, primitive, mode, positions.len(), mirrored, &pointer)?,
            position_ids,
            positions,
        }))
    }

    fn uvs(&self, attributes: &Value, info: Option<&Value>, positions: &[Vec3]) -> Result<Vec<Vec2>, CarrierError> {
        let Some(accessor) = index_of(attributes, &uvs::set_name(info)) else { return Ok(Vec::new()) };
        let data = self.source.floats(accessor, 2)?;
        self.check(accessor, &data, 2, f32::MAX)?;
        let mut uvs: Vec<Vec2> = data.chunks_exact(2).map(Vec2::from_slice).collect();
        self.same_length(accessor, uvs.len(), positions.len())?;
        uvs::transform(info, &mut uvs);
        Ok(uvs)
    }

    /// COLOR_0, three or four numbers; the alpha is left.
    fn colors(&self, attributes: &Value, positions: &[Vec3]) -> Result<Vec<Vec3>, CarrierError> {
        let Some(accessor) = index_of(attributes, "COLOR_0") else { return Ok(Vec::new()) };
        let kind = self.source.document.item("accessors", accessor).and_then(|a| a.get("type"));
        let width = if kind.and_then(Value::as_str) == Some("VEC4") { 4 } else { 3 };
        let data = self.source.floats(accessor, width)?;
        self.check(accessor, &data, width, f32::MAX)?;
        let colors: Vec<Vec3> = data.chunks_exact(width).map(Vec3::from_slice).collect();
        self.same_length(accessor, colors.len(), positions.len())?;
        Ok(colors)
    }

    fn optional(&self, attributes: &Value, name: &str, positions: &[Vec3]) -> Result<Vec<Vec3>, CarrierError> {
        let Some(accessor) = index_of(attributes, name) else { return Ok(Vec::new()) };
        let vectors = self.vectors(accessor)?;
        self.same_length(accessor, vectors.len(), positions.len())?;
        Ok(vectors)
    }

    fn same_length(&self, accessor: usize, found: usize, wanted: usize) -> Result<(), CarrierError> {
        if found == wanted {
            return Ok(());
        }
        let problem = format!("count {found}, but the primitive has {wanted} positions");
        Err(self.source.fail(format!("/accessors/{accessor}"), problem))
    }

    fn vectors(&self, accessor: usize) -> Result<Vec<Vec3>, CarrierError> {
        let data = self.source.floats(accessor, 3)?;
        self.check(accessor, &data, 3, LARGEST_COORDINATE)?;
        Ok(data.chunks_exact(3).map(Vec3::from_slice).collect())
    }

    /// Refuses NaN, infinities and numbers that no tree reaches.
    fn check(&self, accessor: usize, data: &[f32], width: usize, largest: f32) -> Result<(), CarrierError> {
        let Some(at) = data.iter().position(|v| !v.is_finite() || v.abs() > largest) else { return Ok(()) };
        let place = format!("/accessors/{accessor} element {}", at / width);
        Err(self.source.fail(place, format!("{} where a finite number of at most {largest:e} is wanted", data[at])))
    }
}

/// One id per element of each POSITION accessor, wherever it is drawn at the same place: primitives
/// of one mesh that share an accessor share vertices, copies of a mesh elsewhere do not.
#[derive(Default)]
struct PositionIds {
    first: BTreeMap<(usize, [u64; 12]), u32>,
    count: u32,
}

impl PositionIds {
    fn of(
        &mut self,
        source: Source,
        accessor: usize,
        transform: &DAffine3,
        count: usize,
    ) -> Result<Vec<u32>, CarrierError> {
        let key = (accessor, transform.to_cols_array().map(f64::to_bits));
        let first = match self.first.get(&key) {
            Some(first) => *first,
            None => {
                let first = self.count;
                let after = u32::try_from(count).ok().and_then(|n| first.checked_add(n));
                self.count =
                    after.ok_or_else(|| source.fail(format!("/accessors/{accessor}"), "more than 2^32 vertices"))?;
                self.first.insert(key, first);
                first
            }
        };
        Ok((first..first + count as u32).collect())
    }
}

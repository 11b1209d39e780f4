//! The trait of all rooms.

use crate::{Array, AttributeKey, BakeError, ColumnKey, FloatRaster, MapRaster, Placed};
use foliar_plant::{Branches, LEVELS, Plant};
use foliar_schema::Scene;
use glam::{DVec3, Vec3};
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Named rasters (thickness, normal, color of a leaf).
pub type Maps = BTreeMap<String, MapRaster>;

/// What a room may read. Never another room's layer.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// Base and structure.
    pub plant: Option<&'a Plant>,
    /// Named rasters.
    pub maps: &'a Maps,
    /// Plants around it.
    pub neighbors: &'a [Placed],
}

impl<'a> Inputs<'a> {
    /// The plant, for a room that cannot do without.
    ///
    /// # Errors
    /// [`BakeError::Needs`].
    pub fn plant_for(&self, room: &str) -> Result<&'a Plant, BakeError> {
        self.plant.ok_or_else(|| BakeError::Needs {
            room: room.into(),
            what: "a plant",
            remedy: "give an OBJ, glTF or GLB file".into(),
        })
    }
}

/// What a room cannot do without.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// A plant.
    pub plant: bool,
    /// The plant's branches: [`Plant::branches`] is there.
    pub branches: bool,
    /// Names of maps.
    pub maps: &'static [&'static str],
    /// A mesh that is no tree, handed over as a plant without structure; or maps in its place.
    pub scan: bool,
}

impl Needs {
    /// Whether it needs no tree and no maps of one: what it makes belongs to a library.
    pub fn nothing(&self) -> bool {
        !self.plant && self.maps.is_empty()
    }
}

/// What structure knows of a plant, for decisions that need no geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Facts {
    /// Rows of `foliarLeaf`.
    pub leaves: usize,
    /// Vertices of leaf parts.
    pub leaf_vertices: usize,
    /// Vertices of wood parts.
    pub wood_vertices: usize,
    /// Longest edge of the box around wood and leaves, meters.
    pub size_m: f64,
    /// What is known of its branches; none until a room has asked for them.
    pub branches: Option<BranchFacts>,
}

/// What is known of a plant's branches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BranchFacts {
    /// Rows of `foliarBranch`.
    pub count: usize,
    /// Levels that there are, those beyond the fourth too.
    pub levels: usize,
    /// The longest way from a parent's bark to a tip at each of the levels that a chain names, meters; 0 where
    /// there is none.
    pub longest_m: [f64; LEVELS],
}

impl BranchFacts {
    /// The facts of some branches.
    pub fn of(branches: &Branches) -> Self {
        let mut facts = BranchFacts { count: branches.count(), ..BranchFacts::default() };
        for (id, row) in branches.rows.iter().enumerate() {
            facts.levels = facts.levels.max(row.level as usize + 1);
            if let Some(longest) = facts.longest_m.get_mut(row.level as usize) {
                *longest = longest.max(branches.axes[id].length() - branches.attachments[id].bark_arc);
            }
        }
        facts
    }
}

impl Facts {
    /// The facts of a plant.
    pub fn of(plant: &Plant) -> Self {
        let vertices = |role| {
            let parts = plant.parts().iter().enumerate().filter(|(i, _)| plant.role(*i) == role);
            parts.map(|(_, part)| part.positions.len()).sum()
        };
        Facts {
            leaves: plant.leaves().len(),
            leaf_vertices: vertices(foliar_schema::Role::Leaf),
            wood_vertices: vertices(foliar_schema::Role::Wood),
            size_m: plant.size().max_element(),
            branches: plant.branches().map(BranchFacts::of),
        }
    }
}

/// A baker's answer to a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Requirement {
    /// Bake, with these parameters where nobody says otherwise.
    Required {
        /// What the scene implies (only what differs from the defaults).
        params: Map<String, Value>,
        /// Why, in words.
        because: String,
        /// Bytes that the layer adds to the file.
        bytes: u64,
    },
    /// Leave it out.
    NotRequired {
        /// Why, in words.
        because: String,
    },
}

/// One rung of an accuracy ladder: parameters, and the error that they promise.
#[derive(Clone, Debug, PartialEq)]
pub struct Rung {
    /// Name for tables.
    pub name: &'static str,
    /// Parameters, over the defaults.
    pub params: Map<String, Value>,
    /// Largest rms error per channel, in visible steps, against the room's reference.
    pub promise_steps: f64,
}

/// A parameter that has no say beside the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Idle {
    /// Its name.
    pub param: &'static str,
    /// Why, as the end of a sentence: "of `param` nothing is read: ...".
    pub because: &'static str,
}

impl Idle {
    /// Those of `params` where `idle` holds.
    pub fn where_holds(idle: bool, params: &'static [&'static str], because: &'static str) -> Vec<Idle> {
        params.iter().filter(|_| idle).map(|param| Idle { param, because }).collect()
    }
}

/// What a room hands back: arrays, the parameters as it used them, and facts for the record.
#[derive(Clone, Debug, Default)]
pub struct Baked {
    /// Values per vertex.
    pub attributes: BTreeMap<AttributeKey, Array>,
    /// Values per table row.
    pub columns: BTreeMap<ColumnKey, Array>,
    /// Rasters by name, of those that the contract gives the room.
    pub rasters: BTreeMap<String, FloatRaster>,
    /// Every parameter as it was used.
    pub resolved: Map<String, Value>,
    /// Facts that a reader needs beside the arrays.
    pub facts: Map<String, Value>,
    /// Errors against the reference, where the room measured them.
    pub errors: Vec<foliar_schema::MeasuredError>,
    /// What a person should know.
    pub findings: Vec<foliar_schema::Finding>,
}

/// A closed surface that a room draws around a plant: a file of its own, never part of a master.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// Where its positions start from, meters, in the scene's rest frame.
    pub origin: DVec3,
    /// Vertices, meters from the origin; none where there is nothing to enclose.
    pub positions: Vec<Vec3>,
    /// Unit, outward.
    pub normals: Vec<Vec3>,
    /// Counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Hears how far a bake is.
pub trait Progress: Sync {
    /// `done` of `total` steps of `stage`.
    fn step(&self, stage: &str, done: u64, total: u64);
}

/// A progress that nobody hears.
#[derive(Clone, Copy, Debug, Default)]
pub struct Quiet;

impl Progress for Quiet {
    fn step(&self, _: &str, _: u64, _: u64) {}
}

/// A room: a pure function from plant, maps and parameters to one layer.
pub trait Baker: Sync {
    /// Name of room, section, layer and program (`density` gives `foliar-density`).
    fn room(&self) -> &'static str;

    /// Changes whenever results change: the cache and re-bakes rely on it.
    fn version(&self) -> u32;

    /// One line for help texts.
    fn about(&self) -> &'static str;

    /// JSON Schema of the parameters (`schemars::schema_for!`): flags, files, help come from it.
    fn schema(&self) -> Value;

    /// What it cannot do without.
    fn needs(&self) -> Needs;

    /// Whether a scene needs it, and with which parameters.
    fn require(&self, scene: &Scene, facts: &Facts) -> Requirement;

    /// Rungs that law 5, tradeoff and bench walk.
    fn ladder(&self) -> Vec<Rung>;

    /// Parameters that would have no say beside the others and these inputs: whoever gave one of them is told.
    fn idle(&self, _inputs: &Inputs, _params: &Map<String, Value>) -> Vec<Idle> {
        Vec::new()
    }

    /// Bakes. `params` holds every parameter, defaults included, ranges checked.
    ///
    /// # Errors
    /// [`BakeError`]; nothing is ever half done.
    fn bake(&self, inputs: &Inputs, params: &Map<String, Value>, progress: &dyn Progress) -> Result<Baked, BakeError>;

    /// The surface that the room draws around the plant; `None` for a room that knows none.
    fn hull(&self) -> Option<&dyn Enclose> {
        None
    }

    /// The shortest correct program for the same result (f64, all pairs): what tests compare with.
    ///
    /// # Errors
    /// As [`Baker::bake`].
    fn reference(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Baked, BakeError>;
}

/// A room that knows a surface around the plant.
pub trait Enclose {
    /// Meshes it. `params` are those of the room's bake.
    ///
    /// # Errors
    /// As [`Baker::bake`].
    fn enclose(&self, inputs: &Inputs, params: &Map<String, Value>) -> Result<Hull, BakeError>;
}

/// Size of a pixel at the nearest distance, meters.
pub fn pixel_m(camera: &foliar_schema::Camera) -> f64 {
    camera.nearest_m * 2.0 * libm::tan(camera.fov_deg.to_radians() / 2.0) / f64::from(camera.height_px)
}

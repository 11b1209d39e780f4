//! The layer `branches`: found when a room of the plan asks for it or somebody asks by name; taken from the master
//! or from the cache where it is what finding it again would give.

use crate::bake_one::Baking;
use crate::cache::Cache;
use crate::load::Loaded;
use crate::plan::{self, Row};
use crate::report::Report;
use crate::{Failure, record};
use foliar_bake::{Facts, Layer};
use foliar_plant::Base;
use foliar_schema::{Role, names};
use foliar_structure::branches::{self, BranchParams};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

/// The layer of branches, and how it came to be.
pub struct Limbs {
    /// The layer.
    pub layer: Layer,
    /// `found`, `file` or `cache`.
    pub source: &'static str,
}

/// The plan. Where it needs branches the plant has them afterwards, and the plan knows their levels.
///
/// # Errors
/// [`Failure`] of a parameter, or of wood that cannot be taken apart.
pub fn plan<'a>(
    baking: &Baking<'a>,
    loaded: &mut Loaded,
    only: Option<&[String]>,
    report: &mut Report,
) -> Result<(Vec<Row<'a>>, Option<Limbs>), Failure> {
    let rows = plan::make(baking.bakers, &loaded.settings, only, &Facts::of(&loaded.plant))?;
    if !wanted(&rows, only) {
        return Ok((rows, None));
    }
    let limbs = limbs(baking, loaded)?;
    let found = branches::from_layer(&limbs.layer, loaded.plant.base(), loaded.plant.leaves().len())?;
    report.find(branches::findings(&found, loaded.plant.base()));
    let mut told = branches::report(&found, &loaded.plant);
    told["from"] = limbs.source.into();
    told["method"] = limbs.layer.record.resolved["method"].clone();
    report.told.branches = Some(told);
    let plant = std::mem::take(&mut loaded.plant).with_branches(found.branches);
    loaded.plant = plant.map_err(|e| Failure::Input(e.to_string()))?;
    baking.console.log(&report.lap("branches"));
    let rows = plan::make(baking.bakers, &loaded.settings, only, &Facts::of(&loaded.plant))?;
    // What they told may have made a room unnecessary.
    let limbs = wanted(&rows, only).then_some(limbs);
    Ok((rows, limbs))
}

/// Whether a room that is baked needs branches, or somebody asks for them by name.
fn wanted(rows: &[Row], only: Option<&[String]>) -> bool {
    rows.iter().any(|row| row.needed && row.baker.needs().branches)
        || only.is_some_and(|rooms| rooms.iter().any(|room| room == names::ROOM_BRANCHES))
}

fn limbs(baking: &Baking, loaded: &Loaded) -> Result<Limbs, Failure> {
    let reads = BTreeMap::from([
        ("base".to_owned(), loaded.base_hash.clone()),
        (names::ROOM_STRUCTURE.to_owned(), loaded.structure.content_hash()),
    ]);
    let given = record::given(&loaded.settings, names::ROOM_BRANCHES);
    let own = loaded.layers.iter().find(|layer| layer.record.room == names::ROOM_BRANCHES);
    if let Some(own) = own.filter(|own| still_valid(own, &given, &reads)) {
        return Ok(Limbs { layer: own.clone(), source: "file" });
    }
    let params: BranchParams = loaded.settings.section(names::ROOM_BRANCHES)?;
    let resolved = json!(params).as_object().cloned().unwrap_or_default();
    let cache = baking.options.cache.as_deref().map(Cache::new);
    let key = with_connectivity(&resolved, loaded);
    let kept = cache.as_ref().and_then(|c| c.get(names::ROOM_BRANCHES, branches::VERSION, &key, &reads));
    let (mut layer, source) = match kept {
        Some((layer, _)) => (layer, "cache"),
        None => {
            let layer = find(loaded, &params, resolved)?;
            if let Some(cache) = &cache {
                // Findings follow from the layer.
                cache.put(&layer, &key, &[])?;
            }
            (layer, "found")
        }
    };
    layer.record.given = given;
    Ok(Limbs { layer, source })
}

/// Whether a master's own branches are what finding them with these settings stands for. They know which vertices
/// an OBJ connected, which its glTF no longer says: so they are kept where they can be.
fn still_valid(layer: &Layer, given: &Map<String, Value>, reads: &BTreeMap<String, String>) -> bool {
    let record = &layer.record;
    // A tool may have dropped an array: then they are found anew.
    let whole = |name: &String| match name.split_once('/') {
        Some((class, property)) => layer.column(class, property).is_some(),
        None => layer.attributes.keys().any(|key| key.name == *name),
    };
    record.version == branches::VERSION
        && record.given == *given
        && record.reads == *reads
        && record.writes.iter().all(whole)
}

fn find(loaded: &Loaded, params: &BranchParams, resolved: Map<String, Value>) -> Result<Layer, Failure> {
    let (base, structure) = (loaded.plant.base(), loaded.plant.structure());
    let found = branches::find(base, structure, params)?;
    let mut layer = branches::to_layer(&found, base, structure, &loaded.structure.content_hash());
    layer.record.resolved = resolved;
    Ok(layer)
}

/// Parameters, and a hash of what else branches depend on that no other hash holds: which vertices of the wood the
/// file connects.
fn with_connectivity(resolved: &Map<String, Value>, loaded: &Loaded) -> Map<String, Value> {
    let mut key = resolved.clone();
    key.insert("connectivity".into(), connectivity(loaded.plant.base(), &loaded.plant.structure().roles).into());
    key
}

/// A position id that has not come yet.
const UNNAMED: u32 = u32::MAX;

/// blake3 of the position ids of wood, numbered as they come.
fn connectivity(base: &Base, roles: &[Role]) -> String {
    let mut names = vec![UNNAMED; base.position_count as usize];
    let mut next = 0u32;
    let mut hasher = blake3::Hasher::new();
    for (part, _) in base.parts.iter().zip(roles).filter(|(_, role)| **role == Role::Wood) {
        for &id in &part.position_ids {
            let name = &mut names[id as usize];
            if *name == UNNAMED {
                *name = next;
                next += 1;
            }
            hasher.update(&name.to_le_bytes());
        }
    }
    hasher.finalize().to_hex().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake_one::bake_one;
    use crate::config::{Fields, Settings};
    use crate::gather::Sources;
    use crate::options::Options;
    use crate::outputs::Job;
    use crate::runner::Product;
    use foliar_bake::{BakeError, Baked, Baker, Inputs, Needs, Progress, Requirement, Rung};
    use foliar_schema::Scene;
    use std::sync::Mutex;

    /// A room that needs branches, and hears what it gets.
    #[derive(Default)]
    struct Twigs(Mutex<Vec<String>>);

    impl Baker for Twigs {
        fn room(&self) -> &'static str {
            "twigs"
        }
        fn version(&self) -> u32 {
            1
        }
        fn about(&self) -> &'static str {
            "counts branches"
        }
        fn schema(&self) -> Value {
            json!({"properties": {}})
        }
        fn needs(&self) -> Needs {
            Needs { plant: true, branches: true, ..Needs::default() }
        }
        fn require(&self, _: &Scene, facts: &Facts) -> Requirement {
            let known = facts.branches.map(|b| format!("{} branches, {} levels", b.count, b.levels));
            let because = known.unwrap_or_else(|| "branches are not known yet".into());
            self.0.lock().unwrap().push(because.clone());
            Requirement::Required { params: Map::new(), because, bytes: 0 }
        }
        fn ladder(&self) -> Vec<Rung> {
            Vec::new()
        }
        fn bake(&self, inputs: &Inputs, _: &Map<String, Value>, _: &dyn Progress) -> Result<Baked, BakeError> {
            let count = inputs.plant.and_then(|plant| plant.branches()).map_or(0, |b| b.count());
            self.0.lock().unwrap().push(format!("got {count}"));
            Ok(Baked::default())
        }
        fn reference(&self, _: &Inputs, _: &Map<String, Value>) -> Result<Baked, BakeError> {
            Ok(Baked::default())
        }
    }

    #[test]
    fn what_the_file_connects_is_known_by_more_than_its_base() {
        let base = |ids: [u32; 3]| Base {
            parts: vec![foliar_plant::Part { position_ids: ids.to_vec(), ..Default::default() }],
            position_count: 3,
            ..Base::default()
        };
        let of = |ids| connectivity(&base(ids), &[Role::Wood]);
        assert_eq!(of([0, 1, 1]), of([2, 0, 0]), "numbers are no matter");
        assert_ne!(of([0, 1, 1]), of([0, 1, 2]));
        assert_eq!(connectivity(&base([0, 1, 1]), &[Role::Leaf]), connectivity(&base([0, 1, 2]), &[Role::Leaf]));
    }

    /// A trunk and a twig, three sides each.
    const TREE: &str = "o trunk\nv 1 0 0\nv -1 0 1\nv -1 0 -1\nv 1 9 0\nv -1 9 1\nv -1 9 -1\n\
        f 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n\
        v 0 4 .1\nv 0 4.1 -.1\nv 0 3.9 -.1\nv 5 4 .1\nv 5 4.1 -.1\nv 5 3.9 -.1\n\
        f 7 8 11 10\nf 8 9 12 11\nf 9 7 10 12\n";

    #[test]
    fn a_room_that_needs_branches_gets_them_and_its_plan_knows_their_levels() {
        let here = std::env::temp_dir().join(format!("foliar-limbs-{}", std::process::id()));
        std::fs::create_dir_all(&here).unwrap();
        let input = here.join("tree.obj");
        std::fs::write(&input, TREE).unwrap();
        let twigs = Twigs::default();
        let bakers: [&dyn Baker; 1] = [&twigs];
        let fields = Fields::new(&bakers).unwrap();
        let sources = Sources { fields: &fields, environment: Settings::default(), flags: Settings::default() };
        let options = Options { no_config: true, ..Options::default() };
        let console = options.console();
        let baking = Baking {
            bakers: &bakers,
            only: None,
            sources: &sources,
            options: &options,
            console: &console,
            again: false,
        };
        let mut report = Report::new(&input);
        let job = Job { input, output: Some(here.join("tree.glb")) };
        let product = bake_one(&baking, &job, &mut report).unwrap();
        std::fs::remove_dir_all(&here).unwrap();
        assert!(matches!(product, Product::Files(files) if files.len() == 1));
        let heard = twigs.0.lock().unwrap().join("; ");
        assert_eq!(heard, "branches are not known yet; 2 branches, 2 levels; got 2");
        let plan = json!(report.told.plan);
        assert_eq!((&plan[0]["baker"], &plan[0]["because"]), (&json!("branches"), &json!("twigs needs them")));
    }
}

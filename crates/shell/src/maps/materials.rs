//! Which maps are for which leaf material, by name or pattern, and what was given for each.

use super::{Entry, FOR_MATERIAL, Gathering, MATERIAL, Wanted, from_photo};
use crate::Failure;
use crate::config::{Given, Origin, from_text};
use foliar_bake::Baker;
use foliar_plant::Plant;
use foliar_schema::{Finding, Role, code, names};
use globset::{GlobBuilder, GlobMatcher};
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};

/// Parameters that say how all maps of a file are stored.
const OF_THE_FILE: [&str; 2] = ["exr", "embed_all"];

/// Parameters that say nothing without a tree.
const OF_A_TREE: [&str; 3] = [MATERIAL, FOR_MATERIAL, "embed_all"];

/// The one set of maps that stand alone.
pub(super) fn alone<'a>(gathering: &Gathering, baker: &dyn Baker, entries: &'a [Entry]) -> Result<Wanted<'a>, Failure> {
    let mut of_map: BTreeMap<&str, &Entry> = BTreeMap::new();
    for entry in entries {
        if let Some(other) = of_map.insert(&entry.map, entry) {
            let text = format!(
                "map {} is given twice, {} and {}: without a tree one leaf is baked at a time",
                entry.map,
                other.file.display(),
                entry.file.display()
            );
            return Err(Failure::usage(text));
        }
    }
    if let Some(entry) = of_map.get(names::MAP_BACKLIT) {
        let text = format!("{}: a backlit photograph is passed on into a tree: name the tree", entry.origin);
        return Err(Failure::usage(text));
    }
    let named = entries.iter().find(|entry| entry.pattern.is_some()).map(|entry| &entry.origin);
    let of_materials = OF_A_TREE.iter().filter_map(|key| {
        let given = gathering.settings.get(&format!("{}.{key}", baker.room()))?;
        matches!(given.origin, Origin::Flag(_)).then_some(&given.origin)
    });
    if let Some(origin) = named.into_iter().chain(of_materials).next() {
        let text = format!("{origin} is about the materials of a tree: name the tree, or leave it out");
        return Err(Failure::usage(text));
    }
    Ok(Wanted { name: String::new(), entries: of_map, given: own_given(gathering, baker, None)? })
}

/// Names of the leaf materials of a plant, in the order of the file.
fn leaf_materials(plant: &Plant) -> Vec<String> {
    let parts = plant.parts().iter().enumerate().filter(|(index, _)| plant.role(*index) == Role::Leaf);
    let used: BTreeSet<u32> = parts.filter_map(|(_, part)| part.material).collect();
    let mut found: Vec<String> = Vec::new();
    for index in used {
        let name = material_name(plant, index);
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// The name of a material, or its number in words, as the carrier links it.
pub(super) fn material_name(plant: &Plant, index: u32) -> String {
    let own = plant.base().materials.get(index as usize).and_then(|material| material.name.clone());
    own.filter(|name| !name.is_empty()).unwrap_or_else(|| format!("material {index}"))
}

/// The maps of each leaf material that has any.
///
/// # Errors
/// [`Failure::Usage`] for a map of no material, of one among several that nobody named, or given twice.
pub(super) fn by_material<'a>(
    gathering: &Gathering,
    baker: &dyn Baker,
    entries: &'a [Entry],
    plant: &Plant,
    findings: &mut Vec<Finding>,
) -> Result<Vec<Wanted<'a>>, Failure> {
    let leaves = leaf_materials(plant);
    refuse_no_material(gathering, baker, &leaves, findings)?;
    let unnamed = unnamed_patterns(gathering, baker)?;
    let mut of: BTreeMap<&str, BTreeMap<&str, &Entry>> = BTreeMap::new();
    for entry in entries {
        let patterns = match &entry.pattern {
            Some(text) => vec![Pattern::new(text)?],
            None => unnamed.clone(),
        };
        for name in meant(entry, &patterns, &leaves, findings)? {
            let maps = of.entry(name.as_str()).or_default();
            if let Some(other) = maps.insert(&entry.map, entry) {
                let text = format!(
                    "map {} of material {name} is given twice, {} and {}: give one of them",
                    entry.map,
                    other.file.display(),
                    entry.file.display()
                );
                return Err(Failure::usage(text));
            }
        }
    }
    let wanted = leaves.iter().filter_map(|name| Some((name, of.remove(name.as_str())?)));
    let wanted = wanted.map(|(name, entries)| {
        Ok(Wanted { name: name.clone(), entries, given: own_given(gathering, baker, Some(name))? })
    });
    wanted.collect()
}

/// Leaf materials without a map of thickness that have it estimated from their own color: all that are not named otherwise.
pub(super) fn photographed<'a>(
    gathering: &Gathering,
    baker: &dyn Baker,
    plant: &Plant,
    wanted: &[Wanted],
) -> Result<Vec<Wanted<'a>>, Failure> {
    let patterns = unnamed_patterns(gathering, baker)?;
    let meant = |name: &String| patterns.is_empty() || patterns.iter().any(|pattern| pattern.matches(name));
    let mut more = Vec::new();
    for name in leaf_materials(plant).into_iter().filter(|name| wanted.iter().all(|w| w.name != *name) && meant(name)) {
        let given = own_given(gathering, baker, Some(&name))?;
        if from_photo(&given) {
            more.push(Wanted { name, entries: BTreeMap::new(), given });
        }
    }
    Ok(more)
}

/// The materials that a map is for; without a pattern the only one.
fn meant<'a>(
    entry: &Entry,
    patterns: &[Pattern],
    leaves: &'a [String],
    findings: &mut Vec<Finding>,
) -> Result<Vec<&'a String>, Failure> {
    let hit: Vec<&String> = match (patterns.is_empty(), leaves) {
        (true, [] | [_]) => leaves.iter().collect(),
        (true, _) => {
            let text = format!(
                "map {} ({}): the tree has {} leaf materials, {}: say which with --material NAME or NAME=FILE",
                entry.map,
                entry.origin,
                leaves.len(),
                listed(leaves)
            );
            return Err(Failure::usage(text));
        }
        _ => leaves.iter().filter(|name| patterns.iter().any(|p| p.matches(name))).collect(),
    };
    if hit.is_empty() {
        let pattern = entry.pattern.as_ref().map_or_else(String::new, |pattern| format!("{pattern}="));
        let what = format!("map {} {pattern}{}", entry.map, entry.file.display());
        findings.push(for_nothing(&what, &entry.origin, leaves)?);
    }
    Ok(hit)
}

fn listed(leaves: &[String]) -> String {
    if leaves.is_empty() { "none".into() } else { leaves.join(", ") }
}

/// What is for no material of this tree: a failure where it was typed for this bake, else a finding, for a file serves many.
fn for_nothing(what: &str, origin: &Origin, leaves: &[String]) -> Result<Finding, Failure> {
    let text = format!("{what} ({origin}) is for no leaf material of this tree; there are: {}", listed(leaves));
    match origin {
        Origin::Flag(_) => Err(Failure::usage(text)),
        _ => Ok(Finding::new(&code::MAP_UNUSED, text)),
    }
}

/// A pattern over names of materials, case ignored, as patterns of roles are.
#[derive(Clone)]
struct Pattern(GlobMatcher, String);

impl Pattern {
    fn new(text: &str) -> Result<Pattern, Failure> {
        let glob = GlobBuilder::new(&text.to_lowercase()).build();
        let glob = glob.map_err(|e| Failure::usage(format!("material {text:?}: is no pattern: {}", e.kind())))?;
        Ok(Pattern(glob.compile_matcher(), text.to_lowercase()))
    }

    fn matches(&self, name: &str) -> bool {
        let name = name.to_lowercase();
        // A name that holds what a pattern takes for special still means itself.
        self.1 == name || self.0.is_match(name)
    }
}

fn texts<'a>(gathering: &'a Gathering, baker: &dyn Baker, key: &str) -> impl Iterator<Item = (&'a str, &'a Given)> {
    let given = gathering.settings.get(&format!("{}.{key}", baker.room()));
    given.into_iter().flat_map(|given| {
        given.value.as_array().into_iter().flatten().filter_map(Value::as_str).map(move |text| (text, given))
    })
}

/// Patterns of materials that maps without a name belong to.
fn unnamed_patterns(gathering: &Gathering, baker: &dyn Baker) -> Result<Vec<Pattern>, Failure> {
    texts(gathering, baker, MATERIAL).map(|(text, _)| Pattern::new(text)).collect()
}

/// Looks for what is for a material that no leaf has, as [`meant`] does for maps.
fn refuse_no_material(
    gathering: &Gathering,
    baker: &dyn Baker,
    leaves: &[String],
    findings: &mut Vec<Finding>,
) -> Result<(), Failure> {
    for (text, from) in texts(gathering, baker, FOR_MATERIAL) {
        let Some((pattern, _)) = text.split_once('=').and_then(|(place, _)| place.rsplit_once(':')) else { continue };
        let pattern = Pattern::new(pattern.trim())?;
        if !leaves.iter().any(|name| pattern.matches(name)) {
            findings.push(for_nothing(&format!("{FOR_MATERIAL} {text:?}"), &from.origin, leaves)?);
        }
    }
    Ok(())
}

/// What was given for a material: the section, and over it what is for this material alone.
fn own_given(gathering: &Gathering, baker: &dyn Baker, name: Option<&str>) -> Result<Map<String, Value>, Failure> {
    let mut given = gathering.settings.given(baker.room());
    for field in gathering.fields.section(baker.room()).filter(|field| field.map.is_some()) {
        given.shift_remove(field.path.last().map_or("", String::as_str));
    }
    given.shift_remove(MATERIAL);
    given.shift_remove(FOR_MATERIAL);
    for (text, from) in texts(gathering, baker, FOR_MATERIAL) {
        let refuse = |why: String| Failure::usage(format!("{}: {FOR_MATERIAL} {text:?}: {why}", from.origin));
        let form = || refuse("must be MATERIAL:KEY=VALUE, such as Needle*:leaf_width_mm=2".into());
        let (place, value) = text.split_once('=').ok_or_else(form)?;
        let (pattern, key) = place.rsplit_once(':').ok_or_else(form)?;
        let field = gathering.fields.find(&format!("{}.{}", baker.room(), key.trim())).map_err(refuse)?;
        if field.map.is_some() || [MATERIAL, FOR_MATERIAL].contains(&key.trim()) {
            return Err(refuse("maps are given as MATERIAL=FILE".into()));
        }
        if OF_THE_FILE.contains(&key.trim()) {
            return Err(refuse(format!("{} is of the whole file, not of a material", key.trim())));
        }
        let value = from_text(field, value.trim()).map_err(refuse)?;
        let pattern = Pattern::new(pattern.trim())?;
        if name.is_some_and(|name| pattern.matches(name)) {
            given.insert(key.trim().into(), value);
        }
    }
    Ok(given)
}

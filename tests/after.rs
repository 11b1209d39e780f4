//! `foliar-check` on files that lost a part of what was baked, or whose numbers are what no room writes.

use crate::common::{CHECK, FOLIAR, TRANSLUCENCY, folder, glb, open_glb, run, text, tree};
use crate::translucency::{thickness, with_flags};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A master with every room that needs no camera, and maps.
fn master(here: &Path) -> PathBuf {
    let (baked, out) = (here.join("baked.glb"), here.join("master.glb"));
    run(
        FOLIAR,
        &["bake", text(&tree(here, 60)), "-o", text(&baked), "--only", "density", "--only", "wind", "--only", "light"],
    )
    .expect(0, &[]);
    let map = thickness(here, "t.png", 24, 0.1);
    run(TRANSLUCENCY, &with_flags(&[text(&baked), "--thickness", text(&map), "-o", text(&out)])).expect(0, &[]);
    out
}

/// Primitives of one role.
fn of_role<'a>(json: &'a mut Value, role: &'a str) -> impl Iterator<Item = &'a mut Value> {
    let meshes = json["meshes"].as_array_mut().unwrap().iter_mut();
    let all = meshes.flat_map(|mesh| mesh["primitives"].as_array_mut().unwrap().iter_mut());
    all.filter(move |primitive| primitive["extras"]["FOLIAR_foliage"]["role"] == role)
}

fn tables(json: &mut Value) -> &mut Vec<Value> {
    json["extensions"]["EXT_structural_metadata"]["propertyTables"].as_array_mut().unwrap()
}

fn table<'a>(json: &'a mut Value, class: &str) -> &'a mut Value {
    tables(json).iter_mut().find(|table| table["class"] == class).unwrap()
}

fn remove(object: &mut Value, key: &str) {
    object.as_object_mut().unwrap().remove(key);
}

type Loss = (&'static str, fn(&mut Value), &'static [&'static str]);

/// What a tool can lose of a file, one thing at a time, and what is said of it.
const LOSSES: [Loss; 8] = [
    (
        "a channel of wood",
        |j| of_role(j, "wood").for_each(|p| remove(&mut p["attributes"], "_AMBIENT")),
        &["LOST-CHANNEL", "_AMBIENT stood on every wood primitive"],
    ),
    (
        "a role",
        |j| {
            for primitive in of_role(j, "leaf").collect::<Vec<_>>() {
                remove(&mut primitive["extensions"], "FOLIAR_foliage");
                remove(primitive, "extras");
            }
        },
        &["LOST-ROLE", "primitives whose material has a role"],
    ),
    (
        "roles exchanged",
        |j| {
            for primitive in of_role(j, "leaf").collect::<Vec<_>>() {
                primitive["extensions"]["FOLIAR_foliage"]["role"] = json!("wood");
                primitive["extras"]["FOLIAR_foliage"]["role"] = json!("wood");
            }
        },
        &["LOST-ROLE", "is leaf in the master and wood here"],
    ),
    ("the table of wind", |j| tables(j).retain(|table| table["class"] != "foliarWind"), &["LOST-TABLE", "foliarWind"]),
    (
        "the table of light",
        |j| tables(j).retain(|table| table["class"] != "foliarLight"),
        &["LOST-TABLE", "foliarLight"],
    ),
    ("a column", |j| remove(&mut table(j, "foliarLeaf")["properties"], "petiole"), &["LOST-TABLE", "has lost petiole"]),
    ("rows", |j| table(j, "foliarBranchAxis")["count"] = json!(1), &["LOST-TABLE", "rows in the master, 1 here"]),
    (
        "the names of textures",
        |j| {
            j["textures"].as_array_mut().unwrap().iter_mut().for_each(|texture| remove(texture, "name"));
        },
        &["LOST-CHANNEL", "translucencyFront of the master are gone"],
    ),
];

#[test]
fn what_is_lost_in_part_is_said() {
    let here = folder();
    let master = master(here.path());
    let (json, binary) = open_glb(&master);
    let after = here.path().join("after.glb");
    let check = || run(CHECK, &["--after", text(&after), "--master", text(&master)]);
    std::fs::write(&after, glb(&json, &binary)).unwrap();
    let whole = check();
    assert!(!whole.stdout.contains("LOST-"), "nothing is lost: {whole:?}");
    for (what, lose, said) in LOSSES {
        let mut json = json.clone();
        lose(&mut json);
        std::fs::write(&after, glb(&json, &binary)).unwrap();
        let found = check();
        assert!(said.iter().all(|word| found.stdout.contains(word)), "{what}: {said:?} in {}", found.stdout);
    }
}

/// First byte of a column of a table.
fn column(json: &mut Value, class: &str, property: &str) -> usize {
    let view = table(json, class)["properties"][property]["values"].as_u64().unwrap();
    json["bufferViews"][view as usize]["byteOffset"].as_u64().unwrap_or(0) as usize
}

/// Whole numbers of tables are held against their ranges and the tables that they lead into.
#[test]
fn rows_that_lead_nowhere_are_said() {
    let here = folder();
    let master = master(here.path());
    let (mut json, binary) = open_glb(&master);
    let bad = here.path().join("bad.glb");
    for (class, property, value, code, said) in [
        ("foliarLeaf", "branch", 9_999, "CONTRACT-ID", "names row 9999 of foliarBranch"),
        ("foliarBranch", "parent", 0, "CONTRACT-ID", "runs in a circle"),
        ("foliarBranch", "kind", 7, "CONTRACT-RANGE", "is 7, not 0 to 2"),
        ("foliarLeaf", "crownVolume", -3, "CONTRACT-RANGE", "is -3, not 0 to 1"),
        ("foliarBranchAxis", "branch", 9_999, "CONTRACT-ID", "names row 9999"),
    ] {
        let at = column(&mut json, class, property);
        let mut bytes = binary.clone();
        bytes[at..at + 4].copy_from_slice(&i32::to_le_bytes(value));
        std::fs::write(&bad, glb(&json, &bytes)).unwrap();
        let found = run(CHECK, &[text(&bad)]);
        assert!([code, said].iter().all(|word| found.stdout.contains(word)), "{class}/{property}: {}", found.stdout);
    }
}

/// Where a tool has left the mirror alone, values are still held against their channels.
#[test]
fn numbers_of_a_file_without_the_extension_are_looked_at() {
    let here = folder();
    let master = master(here.path());
    let (mut json, mut binary) = open_glb(&master);
    remove(&mut json["extensions"], "FOLIAR_foliage");
    let bad = here.path().join("bad.glb");
    std::fs::write(&bad, glb(&json, &binary)).unwrap();
    let found = run(CHECK, &[text(&bad)]);
    assert!(found.stdout.contains("LOST-EXTENSION") && !found.stdout.contains("CONTRACT-RANGE"), "{found:?}");
    let accessor = of_role(&mut json, "leaf").next().unwrap()["attributes"]["_AMBIENT"].as_u64().unwrap() as usize;
    let view = json["accessors"][accessor]["bufferView"].as_u64().unwrap() as usize;
    let at = json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize
        + json["accessors"][accessor]["byteOffset"].as_u64().unwrap_or(0) as usize;
    binary[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    std::fs::write(&bad, glb(&json, &binary)).unwrap();
    let found = run(CHECK, &[text(&bad)]);
    assert!(
        found.stdout.contains("CONTRACT-RANGE") && found.stdout.contains("_AMBIENT of vertex 0 is NaN"),
        "{found:?}"
    );
}

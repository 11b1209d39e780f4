//! Mutated files, and what fuzzing has found: no program fails by a fault of its own.

#[path = "fuzz/src/cases.rs"]
mod cases;
#[path = "fuzz/src/lib.rs"]
mod fuzz;
#[path = "fuzz/src/mutate.rs"]
mod mutate;

use crate::common::{FOLIAR, folder, tree};
use cases::{Ground, make, seeds};
use std::path::Path;

/// How many cases; `cargo xtask mutate` runs more, over real trees.
const CASES: u64 = 60;

#[test]
fn mutated_files_end_in_time_in_bounds_and_in_words() {
    let here = folder();
    let input = tree(here.path(), 20);
    let programs = Path::new(FOLIAR).parent().unwrap().to_path_buf();
    let made = here.path().join("made");
    make(&programs, &input, &made).unwrap();
    let ground = Ground { programs, scratch: here.path().join("cases") };
    let seeds = seeds(&[here.path().to_path_buf(), made.clone(), made.join("master"), made.join("maps")]).unwrap();
    let mut wrong = Vec::new();
    for case in 0..CASES {
        let (seed, other) = (&seeds[case as usize % seeds.len()], &seeds[(7 * case as usize + 3) % seeds.len()].file);
        wrong.extend(ground.judge(seed, other, case, &format!("{case}")).unwrap());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_fuzzing_found_breaks_nothing_any_more() {
    let found = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/found");
    let mut replayed = 0;
    for entry in std::fs::read_dir(found).unwrap() {
        let file = entry.unwrap().path();
        let Some(kind) = fuzz::Kind::of(&file) else { continue };
        fuzz::feed(kind, &std::fs::read(&file).unwrap());
        replayed += 1;
    }
    assert!(replayed > 0, "no file of tests/fuzz/found was read");
}

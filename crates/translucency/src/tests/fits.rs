//! Optics from measurements: inverted PROSPECT leaves, 22 measured leaves, presets.

use super::{number, oracle, shared};
use crate::oracle::{leaf_error, measured_leaf_error};
use crate::transport::AddingDoubling;
use crate::{Measured, Preset, fit_rt};

/// The oracle was inverted with more nodes: R and T of 16 are within 6e-4 of its (translucency.md 2.5), and coefficients
/// follow within a few per cent where the leaf is bright enough to tell them.
const COEFFICIENT: f64 = 0.03;

#[test]
fn inverted_leaves_come_out_again() {
    let Some(file) = oracle("leaf_params.json") else { return };
    for record in file.as_array().unwrap() {
        let off = leaf_error(record).unwrap();
        assert!(off < COEFFICIENT, "{off}: {record}");
    }
}

/// Every band of every measured leaf, with the mirror where R holds it. Coefficients are those of a leaf of .2 mm.
#[test]
fn measured_leaves_are_reproduced() {
    let Some(text) = shared("trees/helios_leaf_spectra/leaf_R_T_bands.csv") else { return };
    let rows: Vec<Vec<&str>> =
        text.lines().filter(|l| l.contains("-2") || l.contains("-1")).map(|l| l.split(',').collect()).collect();
    let rows: Vec<&Vec<&str>> = rows.iter().filter(|row| row.len() == 16).collect();
    assert_eq!(rows.len(), 22);
    let (mut found, mut without_mirror) = (0, 0);
    for row in rows {
        for (band, index) in [(2, 1.4955), (5, 1.4739), (8, 1.4458), (11, 1.43)] {
            let [r, t]: [f64; 2] = [row[band], row[band + 1]].map(|cell| cell.parse().unwrap());
            let (error, mirror) =
                measured_leaf_error(r, t, index).unwrap_or_else(|error| panic!("{row:?} {band}: {error}"));
            assert!(error < 1e-6, "{row:?} {band}: {error}");
            without_mirror += usize::from(!mirror);
            found += 1;
        }
    }
    assert_eq!(found, 88);
    assert!(without_mirror < 44, "{without_mirror}");
}

#[test]
fn impossible_measurements_are_refused() {
    let fit = |r, t, index| {
        fit_rt(Measured { reflectance: r, transmittance: t, with_mirror: true }, 0.2, 0.8, index).unwrap_err()
    };
    assert!(fit(0.7, 0.4, 1.4).to_string().starts_with("R + T = 1.1: must be below 1"));
    assert!(fit(0.01, 0.1, 1.5).to_string().contains("below 0.0400"));
    assert!(fit(-0.1, 0.1, 1.5).to_string().starts_with("R = -0.1: must be above 0"));
    assert!(fit(0.1, f64::NAN, 1.5).to_string().starts_with("T = NaN"));
    assert!(fit(0.1, 0.1, 0.9).to_string().starts_with("index = 0.9"));
    assert!(fit(0.05, 0.9, 1.45).to_string().contains("no tissue"));
}

/// Presets answer as the leaves that they stand for.
#[test]
fn presets_meet_their_leaves() {
    let Some(file) = oracle("leaf_params.json") else { return };
    for record in file.as_array().unwrap().iter().filter(|record| (number(record, "g") - 0.8).abs() < 1e-9) {
        let case = record["case"].as_str().unwrap();
        let preset = Preset::named(case.split('-').next().unwrap()).unwrap();
        let totals = AddingDoubling::one(&preset.medium(number(record, "wl")).unwrap(), number(record, "d"), 1.0, 24);
        assert!((totals.reflectance - number(record, "R")).abs() < 2e-4, "{totals:?} {record}");
        assert!((totals.transmittance - number(record, "T")).abs() < 2e-4, "{totals:?} {record}");
        assert_eq!(preset.medium(900.0), None);
        assert_eq!(preset.medium(300.0), None);
    }
}

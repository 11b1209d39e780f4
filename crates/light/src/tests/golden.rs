//! Statistics of bakes, by version: whoever moves them raises `Light::version`, or caches and re-bakes would take old
//! results for new ones.

use crate::Light;
use foliar_bake::{Array, Baker, Inputs, Maps, Quiet, Request, run};
use foliar_plant::sample::Recipe;
use foliar_schema::names;
use serde_json::{Value, json};

/// The version that these statistics are of.
const VERSION: u32 = 1;
/// Of each bake: mean transmittance of leaves, and of wood, weighted along the list.
const GOLDEN: [(&str, f64, f64); 4] = [
    ("exact", 1.280_544_842_748_321_3, 0.857_431_912_938_591_1),
    ("paper", 1.236_932_426_450_291_4, 0.728_087_092_129_941_4),
    ("tree", 1.280_740_969_439_279_7, 0.856_843_333_227_565_7),
    ("rays", 1.350_000_050_595_816_5, 1.062_918_758_455_315_2),
];
/// Statistics are sums of f32 in f64: any change of a formula moves them by more.
const TOLERANCE: f64 = 1e-7;

fn mean(values: &[f32]) -> f64 {
    let seen = values.iter().enumerate().map(|(i, v)| libm::exp(-f64::from(*v)) * (1.0 + (i % 7) as f64));
    seen.sum::<f64>() / values.len().max(1) as f64
}

fn statistics(given: &Value) -> (f64, f64) {
    let plant = Recipe::small().grow();
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let request = Request { given: given.as_object().cloned().unwrap(), ..Request::default() };
    let layer = run(&Light, &inputs, &request, &Quiet).unwrap().0;
    let leaves = layer.column(names::CLASS_LIGHT, names::OPTICAL_DEPTH).and_then(Array::as_f32).unwrap();
    let wood = layer.attributes.iter().filter(|(key, _)| key.name == names::LIGHT_DEPTH_1);
    let wood: Vec<f32> = wood.flat_map(|(_, array)| array.as_f32().unwrap().to_vec()).collect();
    (mean(leaves), mean(&wood))
}

#[test]
fn who_moves_results_raises_the_version() {
    assert_eq!(Light.version(), VERSION, "new version: take its statistics over");
    let bakes = [
        json!({"engine": "exact"}),
        json!({"engine": "exact", "profile": "paper"}),
        json!({"engine": "tree", "opening": 0.5}),
        json!({"engine": "rays"}),
    ];
    let found: Vec<(f64, f64)> = bakes.iter().map(statistics).collect();
    let moved = |((_, leaves, wood), found): (&(&str, f64, f64), &(f64, f64))| {
        (found.0 - leaves).abs().max((found.1 - wood).abs()) > TOLERANCE
    };
    let moved = GOLDEN.iter().zip(&found).any(moved);
    assert!(!moved, "statistics are {found:?}: raise Light::version and take them over");
}

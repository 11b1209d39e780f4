//! Statistics of bakes, by version: whoever moves them raises `Density::version`, or caches and re-bakes would
//! take old results for new ones.

use crate::Density;
use foliar_bake::{Baker, Inputs, Maps, Quiet, Request, run};
use foliar_plant::sample::Recipe;
use serde_json::{Value, json};

/// The version that these statistics are of.
const VERSION: u32 = 4;
/// Of each bake: weighted means of k_a and of the normals' coordinates.
const GOLDEN: [(&str, f64, f64); 4] = [
    ("sky", 1.477_291_468_200_254_3, 0.054_475_630_643_138_345),
    ("luft", 1.116_719_186_467_585_2, 0.053_937_235_336_851_096),
    ("lattices", 1.488_552_366_557_897_7, 0.005_364_939_446_592_492),
    ("surface", 1.476_988_565_835_966_7, -0.062_333_102_368_644_35),
];
/// Statistics are sums of f32 in f64: any change of a formula moves them by more.
const TOLERANCE: f64 = 1e-9;

/// Two numbers that tell bakes apart: the mean of each channel, weighted along the list.
fn statistics(leaves: u32, given: &Value) -> (f64, f64) {
    let plant = Recipe { leaves, ..Recipe::small() }.grow();
    let inputs = Inputs { plant: Some(&plant), maps: &Maps::new(), neighbors: &[] };
    let request = Request { given: given.as_object().cloned().unwrap(), ..Request::default() };
    let layer = run(&Density, &inputs, &request, &Quiet).unwrap().0;
    let mean = |name: &str| {
        let values = layer.attributes.iter().filter(|(key, _)| key.name == name);
        let values: Vec<f32> = values.flat_map(|(_, array)| array.as_f32().unwrap().to_vec()).collect();
        let weighted = values.iter().enumerate().map(|(i, v)| f64::from(*v) * (1.0 + (i % 7) as f64));
        weighted.sum::<f64>() / values.len() as f64
    };
    (mean(foliar_schema::names::AMBIENT), mean(foliar_schema::names::SOFT_NORMAL))
}

#[test]
fn who_moves_results_raises_the_version() {
    assert_eq!(Density.version(), VERSION, "new version: take its statistics over");
    let bakes = [
        (700, json!({})),
        (700, json!({"ambient": "luft"})),
        (6000, json!({"ambient": "luft", "quality": 4.0})),
        (700, json!({"normals": "surface"})),
    ];
    let found: Vec<(f64, f64)> = bakes.iter().map(|(leaves, given)| statistics(*leaves, given)).collect();
    let moved = |((_, ambient, normal), found): (&(&str, f64, f64), &(f64, f64))| {
        (found.0 - ambient).abs().max((found.1 - normal).abs()) > TOLERANCE
    };
    let moved = GOLDEN.iter().zip(&found).any(moved);
    assert!(!moved, "statistics are {found:?}: raise Density::version and take them over");
}

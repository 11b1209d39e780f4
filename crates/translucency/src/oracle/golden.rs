//! Small maps whose coefficients were solved texel by texel with band-limited kernels (golden.json).

use super::{largest, medium, number, numbers};
use crate::light::Entry;
use crate::map::{LeafMap, Recipe, Tables, coefficient_map, reference};
use glam::DVec3;
use serde_json::Value;

/// Texels of leaf on all sides that make a texel one of the inside.
const RIM: i64 = 6;

/// One case.
#[derive(Clone, Debug)]
pub struct Golden {
    /// Its leaf.
    pub map: LeafMap,
    /// How it was made.
    pub recipe: Recipe,
    /// Its coefficients.
    pub exact: Vec<DVec3>,
}

impl Golden {
    /// Reads a case.
    pub fn of(case: &Value) -> Golden {
        let triples = |rows: &Value| numbers(rows).chunks_exact(3).map(DVec3::from_slice).collect::<Vec<_>>();
        let mask = numbers(&case["mask"]);
        let map = LeafMap {
            width: number(case, "width") as usize,
            height: number(case, "height") as usize,
            thickness_mm: numbers(&case["thickness_mm"]).iter().zip(&mask).map(|(d, m)| (d * m) as f32).collect(),
            normals: triples(&case["normal_xyz"]).iter().map(|n| n.as_vec3().to_array()).collect(),
        };
        let texel = numbers(&case["texel_mm"]);
        let recipe = Recipe {
            entry: if case["angular"] == "lambert" { Entry::Lambert } else { Entry::Transport },
            curve: case["curve"].as_bool().unwrap_or_default(),
            ..Recipe::new(medium(case), [texel[0], texel[1]])
        };
        Golden { map, recipe, exact: triples(&case["hl2"]) }
    }

    /// Largest miss of the direct gather, over the largest coefficient.
    pub fn direct_error(&self) -> f64 {
        self.worst(&reference::coefficient_map(&self.map, &self.recipe), |_| true)
    }

    /// The same of the bank: six texels inside the rim, and anywhere.
    pub fn bank_errors(&self) -> [f64; 2] {
        let found = fast(&self.map, &self.recipe);
        [self.worst(&found, |at| self.is_inside(at)), self.worst(&found, |_| true)]
    }

    fn worst(&self, ours: &[DVec3], counts: impl Fn(usize) -> bool) -> f64 {
        let top = largest(self.exact.iter().map(|c| c.abs().max_element()));
        let leaf = |at: &usize| self.map.thickness_mm[*at] > 0.0 && counts(*at);
        largest((0..self.exact.len()).filter(leaf).map(|at| (ours[at] - self.exact[at]).abs().max_element())) / top
    }

    fn is_inside(&self, at: usize) -> bool {
        let (width, height) = (self.map.width as i64, self.map.height as i64);
        let (x, y) = (at as i64 % width, at as i64 / width);
        let leaf = |x: i64, y: i64| {
            x >= 0 && y >= 0 && x < width && y < height && self.map.thickness_mm[(y * width + x) as usize] > 0.0
        };
        (-RIM..=RIM).all(|dy| (-RIM..=RIM).all(|dx| leaf(x + dx, y + dy)))
    }
}

/// The bank's coefficients; none where there is no leaf.
pub(super) fn fast(map: &LeafMap, recipe: &Recipe) -> Vec<DVec3> {
    let (Some(range), Some(median)) = (map.range_mm(), map.median_mm()) else { return Vec::new() };
    let found = coefficient_map(map, &Tables::new(recipe, range, median));
    found.chunks_exact(3).map(|c| DVec3::new(f64::from(c[0]), f64::from(c[1]), f64::from(c[2]))).collect()
}

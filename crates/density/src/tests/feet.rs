//! Law 5 for normals of the surface: each is the reference field's own, at a point of the reference surface that
//! nothing of that surface is nearer than. Where sheets tie, the nearest point is arbitrary: any of them will do,
//! and this law is the same.

use crate::surface::{Surface, check_mesh, extract, nearest};
use crate::{Field, Foliage, NO_GROUP, Params, Query, fast, hull, reference};
use foliar_plant::{Plant, sample::odd_plants};
use glam::{DVec3, Vec3};
use serde_json::json;

/// How far two meshes of one surface may lie apart, in cells: vertices of both are within 1e-4 of the threshold,
/// which is a hundredth of a cell where the density falls by a hundredth of the threshold over a cell.
const APART: f64 = 0.02;
/// Slope below which a direction is rounding, in thresholds per radius.
const FLAT: f64 = 1e-2;

fn params() -> Params {
    let given = json!({"normals": "surface", "channels": "normals"});
    Params::from_json(given.as_object().unwrap()).unwrap()
}

/// What the bake looks for and what it is told by.
struct Case<'a> {
    plant: &'a Plant,
    foliage: Foliage,
    unit: f64,
    plan: fast::SkyPlan,
}

impl<'a> Case<'a> {
    fn new(plant: &'a Plant) -> Case<'a> {
        let params = params();
        let foliage = Foliage::new(plant, &[], &params);
        let field = hull::field(&foliage);
        let unit = fast::density_unit(&foliage, &params, |queries| field.densities(queries));
        let plan = fast::SkyPlan::of_leaves(plant, &foliage, &fast::Places::new(plant, &params), &params);
        Case { plant, foliage, unit, plan }
    }

    fn places(&self) -> Vec<DVec3> {
        self.plan.queries.iter().map(|query| query.position).collect()
    }

    fn reference_surface(&self) -> Surface {
        let exact = reference::Exact { generators: self.foliage.own(), radius: self.foliage.radius };
        let surface = hull::surface_by(|b, p| extract(&exact, b, p), &self.foliage, self.unit, &params());
        surface.unwrap().without_cavities()
    }

    /// Checks every foot on the bake's surface; how many there were.
    fn check(&self, name: &str) -> usize {
        let surface = hull::surface(&self.foliage, self.unit, &params()).unwrap().without_cavities();
        assert!(check_mesh(&surface.triangles, surface.positions.len()).is_empty());
        let field = Field::new(self.foliage.own(), self.foliage.radius);
        let other = self.reference_surface();
        let feet = nearest(&surface, &field, &self.places()).unwrap_or_default();
        let nearest_of = |places: &[DVec3]| nearest(&other, &field, places).unwrap_or_default();
        let of_places = nearest_of(&self.places());
        let points: Vec<DVec3> = feet.iter().map(|foot| foot.point.as_dvec3() + surface.origin).collect();
        let margin = APART * surface.cell_m;
        for (i, of_point) in nearest_of(&points).iter().enumerate() {
            let place = self.plan.queries[i].position;
            let off = (of_point.point.as_dvec3() + other.origin).distance(points[i]);
            assert!(off < margin, "{name}: {off} m off the reference surface");
            let least = (of_places[i].point.as_dvec3() + other.origin).distance(place);
            let distance = points[i].distance(place);
            assert!((distance - least).abs() < margin, "{name}: {distance} m away, the reference surface {least} m");
            self.check_normal(points[i], feet[i].normal, name);
        }
        assert_eq!(feet.len(), if other.triangles.is_empty() { 0 } else { points.len() }, "{name}");
        feet.len()
    }

    fn check_normal(&self, at: DVec3, normal: Vec3, name: &str) {
        let radius = self.foliage.radius;
        let sample = reference::field(self.foliage.own(), radius, &Query { position: at, skip: NO_GROUP });
        let slope = sample.gradient.length();
        if slope * radius > FLAT * params().threshold * self.unit {
            // f32 sums are within 4e-6 / radius of the weights in reach, some hundred thresholds on these plants.
            let cosine = normal.as_dvec3().dot(-sample.gradient / slope);
            assert!(cosine > 0.999, "{name}: cosine {cosine}");
        }
    }

    /// The bake gives every vertex the normal of its leaf's foot, or of its own.
    fn check_bake(&self, name: &str) {
        let places = fast::Places::new(self.plant, &params());
        let values = fast::values(self.plant, &self.foliage, &places, &params()).unwrap();
        let surface = hull::surface(&self.foliage, self.unit, &params()).unwrap();
        let toward = hull::directions(surface, &hull::field(&self.foliage), &self.plan.queries);
        for ((_, _, place), normal) in places.vertices().zip(&values.normals) {
            let expected = toward.get(self.plan.of_place[place] as usize);
            // The same numbers by the same way.
            assert!(normal.is_none_or(|n| expected.is_some_and(|e| n.distance(*e) < 1e-12)), "{name}: {normal:?}");
        }
    }
}

#[test]
fn law_5_surface_normals_are_those_of_a_nearest_point_of_the_reference_surface() {
    let mut feet = 0;
    for sample in odd_plants().iter().filter(|sample| !sample.plant.leaves().is_empty()) {
        let case = Case::new(&sample.plant);
        feet += case.check(sample.name);
        case.check_bake(sample.name);
    }
    assert!(feet > 500, "{feet}");
}

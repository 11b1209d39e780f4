//! Where things stand in the picture: the plant, and what stands around it.

use crate::camera::PLANT_EDGE;
use foliar_bake::Layer;
use foliar_plant::Plant;
use glam::{DAffine3, DVec3, Vec3};

/// A plant that stands beside the one that a picture is about.
#[derive(Clone, Debug)]
pub struct Standing {
    /// The plant.
    pub plant: Plant,
    /// What was baked for it.
    pub layers: Vec<Layer>,
    /// From its rest frame to that of the plant that the picture is about.
    pub transform: DAffine3,
}

/// From a plant's rest frame to the picture's, in which everything that stands there is centered.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    /// From the rest frame of a neighbor to that of the plant.
    stand: DAffine3,
    center: DVec3,
    scale: f64,
}

impl Frame {
    /// The frame of the plant itself.
    pub fn around(plant: &Plant, around: &[Standing]) -> Frame {
        let half = plant.size() / 2.0;
        let (mut low, mut high) = (plant.center() - half, plant.center() + half);
        for other in around {
            let half = other.plant.size() / 2.0;
            for corner in 0..8 {
                let side = |axis: u32| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
                let corner = other.plant.center() + half * DVec3::new(side(0), side(1), side(2));
                let place = other.transform.transform_point3(corner);
                (low, high) = (low.min(place), high.max(place));
            }
        }
        let (center, size) =
            if around.is_empty() { (plant.center(), plant.size()) } else { (low.midpoint(high), high - low) };
        let edge = size.max_element();
        Frame { stand: DAffine3::IDENTITY, center, scale: if edge > 0.0 { PLANT_EDGE / edge } else { 1.0 } }
    }

    /// The frame of something that stands around the plant.
    pub fn of(&self, other: &Standing) -> Frame {
        Frame { stand: other.transform, ..*self }
    }

    /// A meter in the picture's frame.
    pub fn per_meter(&self) -> f64 {
        self.scale
    }

    pub fn place(&self, rest: DVec3) -> DVec3 {
        (self.stand.transform_point3(rest) - self.center) * self.scale
    }

    /// Unit, or zero; a neighbor is turned and scaled evenly.
    pub fn normal(&self, rest: DVec3) -> Vec3 {
        self.stand.transform_vector3(rest).as_vec3().normalize_or_zero()
    }
}

//! Where a neighbor stands, and how a person writes it: `FILE@x,y,z[,yaw_deg[,scale]]`.

use foliar_plant::Plant;
use glam::{DAffine3, DMat3, DVec3};
use std::fmt;
use std::sync::Arc;

/// What a neighbor's text must be.
const FORM: &str = "must be FILE@x,y,z[,yaw_deg[,scale]] (meters in the plant's rest frame; finite, scale above 0)";

/// Where a neighbor stands relative to the plant that is baked, whose rest frame is in meters, Y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the origin of its own rest frame goes, meters.
    pub offset_m: DVec3,
    /// Turn about the vertical through that origin, degrees: from above counter-clockwise, +Z goes toward +X.
    pub yaw_deg: f64,
    /// Factor on its size, about that origin; above 0.
    pub scale: f64,
}

impl Default for Placement {
    /// Where the plant itself stands.
    fn default() -> Self {
        Placement { offset_m: DVec3::ZERO, yaw_deg: 0.0, scale: 1.0 }
    }
}

impl Placement {
    /// Splits `FILE@x,y,z[,yaw_deg[,scale]]` into the file and where it goes; the last `@` counts.
    ///
    /// # Errors
    /// A sentence with what is wrong and what would be right.
    pub fn parse(text: &str) -> Result<(&str, Placement), String> {
        let refuse = |what: &str| format!("{text:?} {what}: {FORM}");
        let (file, place) = text.rsplit_once('@').ok_or_else(|| refuse("has no @"))?;
        if file.is_empty() {
            return Err(refuse("names no file"));
        }
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let numbers: Option<Vec<f64>> = place.split(',').map(number).collect();
        let numbers = numbers.ok_or_else(|| refuse("has something else than finite numbers after the @"))?;
        let (offset, rest) = numbers.split_at(numbers.len().min(3));
        let (yaw_deg, scale) = match (offset.len(), rest) {
            (3, []) => (0.0, 1.0),
            (3, [yaw]) => (*yaw, 1.0),
            (3, [yaw, scale]) => (*yaw, *scale),
            (count, rest) => return Err(refuse(&format!("has {} numbers", count + rest.len()))),
        };
        if scale <= 0.0 {
            return Err(refuse(&format!("has the scale {scale}")));
        }
        Ok((file, Placement { offset_m: DVec3::from_slice(offset), yaw_deg, scale }))
    }

    /// From the neighbor's rest frame to that of the plant that is baked.
    pub fn transform(&self) -> DAffine3 {
        let (sine, cosine) = libm::sincos(self.yaw_deg.to_radians());
        let axes = [DVec3::new(cosine, 0.0, -sine), DVec3::Y, DVec3::new(sine, 0.0, cosine)];
        let [x, y, z] = axes.map(|axis| axis * self.scale);
        DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation: self.offset_m }
    }
}

impl fmt::Display for Placement {
    /// The part after the `@`, no more numbers than it needs.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DVec3 { x, y, z } = self.offset_m;
        let own = Placement::default();
        write!(f, "{x},{y},{z}")?;
        if self.scale.total_cmp(&own.scale).is_ne() {
            write!(f, ",{},{}", self.yaw_deg, self.scale)
        } else if self.yaw_deg.total_cmp(&own.yaw_deg).is_ne() {
            write!(f, ",{}", self.yaw_deg)
        } else {
            Ok(())
        }
    }
}

/// A neighbor plant where it stands, relative to the plant that is baked.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The neighbor; several of one kind share it.
    pub plant: Arc<Plant>,
    /// From its rest frame to that of the plant that is baked.
    pub transform: DAffine3,
}

impl Placed {
    /// A neighbor at its place.
    pub fn new(plant: impl Into<Arc<Plant>>, placement: &Placement) -> Placed {
        Placed { plant: plant.into(), transform: placement.transform() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_come_back_as_they_were_typed() {
        for text in ["oak.glb@1,2,3", "a@b/oak.glb@-1.5,0,2000,90", "oak.obj@0,0,0,0,2.5", "o@1e-3,0,0,-45,0.1"] {
            let (file, placement) = Placement::parse(text).unwrap();
            let again = format!("{file}@{placement}");
            assert_eq!(Placement::parse(&again), Ok((file, placement)), "{text} became {again}");
        }
        assert_eq!(Placement::parse("oak.glb@1, 2 ,3,0,1").unwrap().1.to_string(), "1,2,3");
    }

    #[test]
    fn what_is_no_placement_is_refused_with_its_reason() {
        let cases = [
            ("oak.glb", "has no @"),
            ("@1,2,3", "names no file"),
            ("oak.glb@1,2", "has 2 numbers"),
            ("oak.glb@1,2,3,4,5,6", "has 6 numbers"),
            ("oak.glb@1,2,x", "something else than finite numbers"),
            ("oak.glb@", "something else than finite numbers"),
            ("oak.glb@1,2,nan", "something else than finite numbers"),
            ("oak.glb@1,2,inf", "something else than finite numbers"),
            ("oak.glb@1,2,3,0,0", "has the scale 0"),
            ("oak.glb@1,2,3,0,-2", "has the scale -2"),
            ("oak.glb@1,2,3,0,NaN", "something else than finite numbers"),
        ];
        for (text, why) in cases {
            let error = Placement::parse(text).unwrap_err();
            assert!(error.contains(why) && error.contains("must be FILE@x,y,z"), "{text}: {error}");
        }
    }

    #[test]
    fn a_quarter_turn_takes_z_to_x_and_a_scale_acts_before_the_offset() {
        let (_, placement) = Placement::parse("o@10,0,-1,90,2").unwrap();
        let place = placement.transform().transform_point3(DVec3::new(0.0, 1.0, 3.0));
        // The cosine of a quarter turn is 6e-17 in f64.
        assert!((place - DVec3::new(16.0, 2.0, -1.0)).length() < 1e-14, "{place}");
    }
}

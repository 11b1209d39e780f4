//! What the room of light in the crown writes (Boulanger08).

use super::Room;
use crate::{Channel, Column, Element, Neutral, Role, column::ANY};

/// The room of light in the crown (Boulanger08).
pub const ROOM_LIGHT: &str = "light";

/// Optical depths of a place in the four octants below (Boulanger08 section 6.1).
pub const LIGHT_DEPTH_0: &str = "_LIGHT_DEPTH_0";

/// Optical depths of a place in the four octants above.
pub const LIGHT_DEPTH_1: &str = "_LIGHT_DEPTH_1";

/// Table class of the light that reaches leaves; row = leaf id.
pub const CLASS_LIGHT: &str = "foliarLight";

/// Property of [`CLASS_LIGHT`]: optical depths of a leaf in the eight octants.
pub const OPTICAL_DEPTH: &str = "opticalDepth";

/// Property of [`CLASS_LIGHT`]: spherical harmonics of a leaf's transmittance.
pub const SUN_HARMONICS: &str = "sunSh";

/// Largest optical depth in a file: nothing is seen beyond it.
const MOST_DEPTH: f32 = 16.0;

const fn light_depth(name: &'static str, doc: &'static str) -> Channel {
    Channel {
        name,
        room: ROOM_LIGHT,
        width: 4,
        roles: &[Role::Wood],
        min: 0.0,
        max: MOST_DEPTH,
        unit_length: false,
        unit: "optical depth",
        visible_step: 1.0 / 255.0,
        step_unit: "transmittance",
        optical_depth: true,
        neutral: Neutral::Value(0.0),
        doc,
    }
}

pub(super) const ROOM: Room = Room {
    name: ROOM_LIGHT,
    channels: &[
        light_depth(LIGHT_DEPTH_0, "optical depths toward the ground: octants -x -z, +x -z, -x +z, +x +z"),
        light_depth(LIGHT_DEPTH_1, "optical depths toward the sky: octants -x -z, +x -z, -x +z, +x +z"),
    ],
    columns: &[
        Column {
            class: CLASS_LIGHT,
            name: OPTICAL_DEPTH,
            room: ROOM_LIGHT,
            element: Element::F32,
            width: 8,
            array: true,
            unit: "optical depth",
            range: [0.0, MOST_DEPTH],
            visible_step: 1.0 / 255.0,
            optical_depth: true,
            doc: "optical depths of octants, x > 0 bit 0, z > 0 bit 1, y > 0 bit 2",
        },
        Column {
            class: CLASS_LIGHT,
            name: SUN_HARMONICS,
            room: ROOM_LIGHT,
            element: Element::F32,
            width: 9,
            array: true,
            unit: "coefficient",
            range: ANY,
            visible_step: 1.0 / 255.0,
            optical_depth: false,
            doc: "transmittance in real spherical harmonics: 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2",
        },
    ],
    rasters: &[],
};

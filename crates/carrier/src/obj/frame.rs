//! From an OBJ's frame and unit to glTF's: Y up, meters. In f64; rounded once.

use super::file::ObjFile;
use crate::CarrierError;
use foliar_schema::{Finding, Import, Up, code};
use glam::DVec3;

/// Up axis and scale of an OBJ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    up: Up,
    scale: f64,
}

impl Frame {
    /// The frame that the options say. A height is that of the vertices which faces use.
    pub fn choose(file: &ObjFile, import: &Import, name: &str) -> Result<Frame, CarrierError> {
        let up = import.up.unwrap_or(Up::Y);
        let turned = Frame { up, scale: 1.0 };
        let scale = match import.height_m {
            Some(wanted) => {
                let height = height(file, turned);
                if height <= 0.0 || !(wanted / height).is_finite() {
                    let problem = format!("is {height} units high, so --height-m {wanted} gives no scale");
                    return Err(CarrierError::input(name, "", problem, "say --unit instead, or --up z"));
                }
                wanted / height
            }
            None => import.unit.map_or(1.0, foliar_schema::Unit::meters),
        };
        Ok(Frame { up, scale })
    }

    /// A direction: Z up is turned by -90 degrees about X.
    pub fn direction(self, v: DVec3) -> DVec3 {
        match self.up {
            Up::Y => v,
            Up::Z => DVec3::new(v.x, v.z, -v.y),
        }
    }

    /// A position, in meters.
    pub fn position(self, v: [f64; 3]) -> DVec3 {
        self.direction(DVec3::from(v)) * self.scale
    }
}

/// What was taken for granted about axis and unit.
pub(crate) fn findings(file: &ObjFile, import: &Import) -> Vec<Finding> {
    let height = height(file, Frame { up: import.up.unwrap_or(Up::Y), scale: 1.0 });
    let mut findings = Vec::new();
    if import.up.is_none() {
        let message =
            format!("no up axis was given: Y is taken for up, height {} units; --up z otherwise", digits(height));
        findings.push(Finding::new(&code::IMPORT_UP, message));
    }
    if import.unit.is_none() && import.height_m.is_none() {
        let message = format!(
            "no unit was given: 1 unit is taken for 1 m, height {} m; say --unit or --height-m",
            digits(height)
        );
        findings.push(Finding::new(&code::IMPORT_UNIT, message));
    }
    findings
}

/// Four digits that mean something, however tall or small the plant is.
fn digits(height: f64) -> String {
    if height == 0.0 || (0.01..1e6).contains(&height) { format!("{height:.3}") } else { format!("{height:.3e}") }
}

fn height(file: &ObjFile, frame: Frame) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in file.triangles.iter().flatten() {
        let y = frame.position(file.positions[corner.v as usize]).y;
        (low, high) = (low.min(y), high.max(y));
    }
    high - low
}

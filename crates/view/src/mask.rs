//! Which squares of the picture can show the plant at all: rays elsewhere are not cast.

use crate::camera::Camera;
use glam::{Vec2, Vec3};

/// Pixels along an edge of a square.
const SQUARE: u32 = 8;
/// Pixels around a projected triangle that count as its own: covers the rounding of the projection.
const SLACK: f32 = 1.0;

/// Squares that some triangle's bounding rectangle touches.
pub(crate) struct Mask {
    columns: u32,
    covered: Vec<bool>,
}

impl Mask {
    /// Marks the squares of all triangles.
    pub fn new(camera: &Camera, triangles: &[[Vec3; 3]], width: u32, height: u32) -> Mask {
        let (columns, rows) = (width.div_ceil(SQUARE), height.div_ceil(SQUARE));
        let mut mask = Mask { columns, covered: vec![false; (columns * rows) as usize] };
        for corners in triangles {
            let [Some(a), Some(b), Some(c)] = corners.map(|corner| camera.project(corner)) else {
                // It reaches behind the camera: anywhere.
                mask.covered.fill(true);
                break;
            };
            mask.mark(a.min(b).min(c) - SLACK, a.max(b).max(c) + SLACK, Vec2::new(width as f32, height as f32));
        }
        mask
    }

    fn mark(&mut self, low: Vec2, high: Vec2, size: Vec2) {
        if high.cmplt(Vec2::ZERO).any() || low.cmpge(size).any() {
            return;
        }
        // Casts saturate, so what lies outside ends at the border.
        let square = |at: Vec2| at.clamp(Vec2::ZERO, size - 1.0).as_uvec2() / SQUARE;
        let (first, last) = (square(low), square(high));
        for row in first.y..=last.y {
            let start = (row * self.columns) as usize;
            self.covered[start + first.x as usize..=start + last.x as usize].fill(true);
        }
    }

    /// Whether anything may be seen at this pixel.
    pub fn covers(&self, x: u32, y: u32) -> bool {
        self.covered[(y / SQUARE * self.columns + x / SQUARE) as usize]
    }
}

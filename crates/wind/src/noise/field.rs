//! Looking a place up in the noise: cubic B-spline between texels, whose second derivative has no jumps. Between
//! texels that are only joined by straight lines a branch would jerk at each.

use foliar_bake::FloatRaster;
use glam::DVec2;

/// A tiling texture of two channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    size: usize,
    texels: Vec<[f32; 2]>,
}

impl Field {
    /// The field of a raster; none where it is not square or has other than two channels.
    pub fn new(raster: &FloatRaster) -> Option<Field> {
        let whole = raster.is_whole() && raster.channels == 2 && raster.width == raster.height && raster.width > 0;
        whole.then(|| Field { size: raster.width as usize, texels: raster.data.as_chunks().0.to_vec() })
    }

    /// Texels along each edge.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Both channels of a texel, repeated without end.
    pub fn texel(&self, x: i64, y: i64) -> DVec2 {
        let wrap = |i: i64| i.rem_euclid(self.size as i64) as usize;
        let [a, b] = self.texels[wrap(y) * self.size + wrap(x)];
        DVec2::new(f64::from(a), f64::from(b))
    }

    /// Both channels at a place, tiles.
    pub fn at(&self, place: DVec2) -> DVec2 {
        let texels = place * self.size as f64 - 0.5;
        let (cell, part) = (texels.floor(), texels - texels.floor());
        let (across, down) = (weights(part.x), weights(part.y));
        let mut sum = DVec2::ZERO;
        for (row, down) in down.into_iter().enumerate() {
            for (column, across) in across.into_iter().enumerate() {
                let (x, y) = (cell.x as i64 + column as i64 - 1, cell.y as i64 + row as i64 - 1);
                sum += self.texel(x, y) * (across * down);
            }
        }
        sum
    }
}

/// Weights of four texels in a row for a place between the middle two.
fn weights(t: f64) -> [f64; 4] {
    let u = 1.0 - t;
    [
        u * u * u / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0,
        t * t * t / 6.0,
    ]
}

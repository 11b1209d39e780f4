//! No more texels than a scene has pixels for: what is finer than a pixel at the nearest distance is not stored.

use foliar_bake::FloatRaster;
use rayon::prelude::*;

/// How many texels an edge become one: a power of two that divides both edges of the map, so that texture coordinates keep
/// their meaning, and leaves no edge of a texel above `coarsest_mm`.
pub fn merged(texel_mm: [f64; 2], size: [usize; 2], coarsest_mm: Option<f64>) -> usize {
    let Some(coarsest) = coarsest_mm else { return 1 };
    let fits =
        |by: usize| size.iter().all(|n| n.is_multiple_of(by)) && texel_mm.iter().all(|mm| mm * by as f64 <= coarsest);
    (0..usize::BITS - 1).map(|power| 1 << power).take_while(|by| *by == 1 || fits(*by)).last().unwrap_or(1)
}

/// A map of four numbers a texel, the last above 0 on the leaf: each square of `by` texels an edge becomes the mean of what
/// is leaf in it, as mips do.
pub fn coarser(texels: Vec<f32>, [width, height]: [usize; 2], by: usize) -> FloatRaster {
    if by < 2 {
        return FloatRaster { width: width as u32, height: height as u32, channels: 4, data: texels };
    }
    let (columns, rows) = (width / by, height / by);
    let mut data = vec![0.0f32; 4 * columns * rows];
    data.par_chunks_exact_mut(4 * columns).enumerate().for_each(|(y, row)| {
        for (x, out) in row.chunks_exact_mut(4).enumerate() {
            let own = (y * by..(y + 1) * by).flat_map(|y| (x * by..(x + 1) * by).map(move |x| 4 * (y * width + x)));
            let (mut sum, mut count) = ([0.0f64; 4], 0.0);
            for texel in own.map(|at| &texels[at..at + 4]).filter(|texel| texel[3] > 0.0) {
                sum.iter_mut().zip(texel).for_each(|(sum, v)| *sum += f64::from(*v));
                count += 1.0;
            }
            if count > 0.0 {
                out.iter_mut().zip(sum).for_each(|(out, sum)| *out = (sum / count) as f32);
            }
        }
    });
    FloatRaster { width: columns as u32, height: rows as u32, channels: 4, data }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_grow_to_a_pixel_and_no_further() {
        assert_eq!(merged([0.1; 2], [64, 32], None), 1);
        assert_eq!(merged([0.1; 2], [64, 32], Some(0.05)), 1);
        assert_eq!(merged([0.1; 2], [64, 32], Some(0.8)), 8);
        assert_eq!(merged([0.1; 2], [64, 32], Some(0.79)), 4);
        assert_eq!(merged([0.1, 0.2], [64, 32], Some(0.8)), 4);
        assert_eq!(merged([0.1; 2], [64, 20], Some(100.0)), 4);
        assert_eq!(merged([0.1; 2], [63, 64], Some(100.0)), 1);
        assert_eq!(merged([1e-9; 2], [64, 64], Some(1e9)), 64);
    }

    #[test]
    fn a_coarser_texel_is_the_mean_of_its_leaf() {
        let texels = vec![
            [1.0, 2.0, -1.0, 0.5],
            [3.0, 0.0, 1.0, 0.3],
            [0.0; 4],
            [0.0; 4],
            [0.0; 4],
            [0.0; 4],
            [0.0; 4],
            [0.0; 4],
        ];
        let found = coarser(texels.into_flattened(), [4, 2], 2);
        assert_eq!((found.width, found.height), (2, 1));
        assert_eq!(found.data, [2.0, 1.0, 0.0, 0.4, 0.0, 0.0, 0.0, 0.0]);
    }
}

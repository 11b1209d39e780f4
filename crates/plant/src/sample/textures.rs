//! Pictures by rule: bark with furrows, sprays of leaves with veins and a clean alpha edge.

use super::noise::{cloud, signed, smooth, tile, unit};
use crate::Raster;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_4, TAU};

/// Sprays per row and column of the leaf picture.
pub const ATLAS: u32 = 2;

/// Opaque share of [`disc`]: a disc that touches the picture's edges.
pub const DISC_COVERAGE: f64 = FRAC_PI_4;

/// A green disc whose alpha is the exact cover of each pixel (16 x 16 samples).
pub fn disc(size: u32) -> Raster {
    let inside = |p: DVec2| f64::from(u8::from((p - 0.5).length() < 0.5));
    raster("disc", size, |p| {
        let alpha = samples(16).map(|s| inside(p + s / f64::from(size))).sum::<f64>() / 256.0;
        (DVec3::new(0.35, 0.5, 0.2), alpha)
    })
}

/// Bark that repeats in both directions: vertical furrows, plates, a little lichen.
pub fn bark(size: u32, seed: u64) -> Raster {
    raster("bark", size.max(16), |p| (bark_color(p, seed), 1.0))
}

fn bark_color(p: DVec2, seed: u64) -> DVec3 {
    let (furrow, height) = bark_relief(p, seed);
    let (_, beside) = bark_relief(p - DVec2::new(0.004, 0.004), seed);
    let plate = cloud(seed + 4, p.x * 5.0, p.y * 3.0, (5, 3));
    let warm = DVec3::new(0.46, 0.375, 0.30).lerp(DVec3::new(0.40, 0.36, 0.315), 0.5 + 0.5 * plate);
    let color = warm.lerp(DVec3::new(0.20, 0.145, 0.11), 0.8 * furrow);
    let lichen = smooth(0.25, 0.6, cloud(seed + 5, p.x * 3.0, p.y * 3.0, (3, 3))) * (1.0 - furrow);
    // A little light from the upper left: the relief is too fine for geometry.
    color.lerp(DVec3::new(0.46, 0.47, 0.37), 0.3 * lichen) * (1.0 + 0.55 * (height - beside)).clamp(0.6, 1.5)
}

/// Depth of the furrows in [0, 1], and height of the surface.
fn bark_relief(p: DVec2, seed: u64) -> (f64, f64) {
    let warp = 0.6 * cloud(seed + 1, p.x * 6.0, p.y * 5.0, (6, 5));
    let ridge = |k: u64, cells: i64, tall: i64| {
        let n = tile(seed + 10 + k, p.x * cells as f64 + warp, p.y * tall as f64 + 0.5 * warp, (cells, tall));
        smooth(0.35, 1.0, 1.0 - 2.2 * n.abs())
    };
    let furrow = ridge(0, 11, 2).max(0.75 * ridge(1, 19, 4)).max(0.4 * ridge(2, 31, 9));
    let grain = cloud(seed + 3, p.x * 40.0, p.y * 12.0, (40, 12));
    (furrow, 0.25 * grain - furrow)
}

/// [`ATLAS`] x [`ATLAS`] sprays of leaves, stalk at the lower edge.
pub fn sprays(size: u32, seed: u64) -> Raster {
    let cells: Vec<Spray> = (0..u64::from(ATLAS * ATLAS)).map(|k| spray(seed + 31 * k)).collect();
    let edge = (size / ATLAS * ATLAS).max(16);
    raster("leaf", edge, |p| {
        let cell = (p * f64::from(ATLAS)).floor();
        let cell_spray = &cells[(cell.y as u32 * ATLAS + cell.x as u32) as usize];
        let inner = p * f64::from(ATLAS) - cell;
        let (mut color, mut alpha) = (DVec3::ZERO, 0.0);
        for s in samples(3) {
            if let Some(hit) = spray_color(cell_spray, inner + s * f64::from(ATLAS) / f64::from(edge)) {
                color += hit;
                alpha += 1.0;
            }
        }
        // Under transparent pixels lies leaf green, so that filtering draws no dark rim.
        if alpha > 0.0 { (color / alpha, alpha / 9.0) } else { (DVec3::new(0.25, 0.36, 0.12), 0.0) }
    })
}

/// Opaque share of each spray: pixels at or above the cutoff of one half, as a mask shows them.
pub fn coverage(raster: &Raster) -> Vec<f64> {
    let cell = raster.width / ATLAS;
    let share = |column: u32, line: u32| {
        let rows = (line * cell..(line + 1) * cell).map(|y| (y * raster.width + column * cell) as usize * 4);
        let opaque = |start: usize| raster.rgba[start..start + 4 * cell as usize].chunks(4).filter(|p| p[3] >= 128);
        rows.map(|start| opaque(start).count()).sum::<usize>() as f64 / f64::from(cell * cell)
    };
    (0..ATLAS).flat_map(|line| (0..ATLAS).map(move |column| (column, line))).map(|(c, l)| share(c, l)).collect()
}

/// One leaf of a spray, in the unit square with y down.
struct Blade {
    foot: DVec2,
    along: DVec2,
    length: f64,
    tint: DVec3,
}

/// A twig with its leaves; the last lies on top.
struct Spray {
    seed: u64,
    blades: Vec<Blade>,
}

/// Leaves left and right of a twig, and one at its end.
fn spray(seed: u64) -> Spray {
    let pair = |k: u64| {
        let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let t = 0.14 + 0.095 * k as f64;
        let angle = side * (1.05 - 0.07 * k as f64 + 0.15 * signed(seed, k));
        blade(seed + k, twig(t, seed), angle, 0.40 - 0.012 * k as f64)
    };
    let mut blades: Vec<Blade> = (0..6).map(pair).collect();
    blades.push(blade(seed + 9, twig(0.62, seed), 0.12 * signed(seed, 9), 0.36));
    Spray { seed, blades }
}

/// The twig's line from the lower edge up.
fn twig(t: f64, seed: u64) -> DVec2 {
    DVec2::new(0.5 + 0.03 * libm::sin(4.0 * t + unit(seed, 77) * TAU) * t, 1.0 - t)
}

fn blade(seed: u64, foot: DVec2, angle: f64, length: f64) -> Blade {
    let warmth = signed(seed, 5);
    let light = 1.0 + 0.16 * signed(seed, 6);
    let tint = DVec3::new(0.31 + 0.05 * warmth, 0.43 + 0.01 * warmth, 0.17 - 0.02 * warmth) * light;
    Blade { foot, along: DVec2::new(libm::sin(angle), -libm::cos(angle)), length, tint }
}

fn spray_color(spray: &Spray, p: DVec2) -> Option<DVec3> {
    spray.blades.iter().rev().find_map(|blade| blade_color(blade, p)).or_else(|| twig_color(spray.seed, p))
}

/// The twig itself, thinning toward its end.
fn twig_color(seed: u64, p: DVec2) -> Option<DVec3> {
    let t = 1.0 - p.y;
    let across = (p.x - twig(t, seed).x) / (0.012 - 0.008 * t);
    (t < 0.66 && across.abs() < 1.0).then(|| DVec3::new(0.33, 0.26, 0.17) * (1.1 - 0.35 * across))
}

/// Color of a blade at a point, or nothing outside its outline and stalk.
fn blade_color(blade: &Blade, p: DVec2) -> Option<DVec3> {
    let from = p - blade.foot;
    let y = from.dot(blade.along) / blade.length;
    let x = from.dot(blade.along.perp()) / blade.length;
    // A fifth of the length is stalk.
    let t = (y - 0.16) / 0.84;
    if x.abs() < 0.014 && (0.0..0.3).contains(&y) {
        return Some(DVec3::new(0.42, 0.40, 0.18));
    }
    if !(0.0..=1.0).contains(&t) || x.abs() > half_width(t) {
        return None;
    }
    let rim = x.abs() / half_width(t).max(1e-9);
    let vein = veins(x, t);
    let half = if x > 0.0 { 1.07 } else { 0.93 };
    let color = blade.tint * half * (1.0 - 0.12 * rim * rim) * (0.9 + 0.2 * t);
    Some(color.lerp(DVec3::new(0.55, 0.62, 0.30), vein).clamp(DVec3::ZERO, DVec3::ONE))
}

/// Half the width of a leaf at `t` of its length: round below, a drawn-out tip, a toothed rim.
fn half_width(t: f64) -> f64 {
    let body = libm::pow(t, 0.38) * libm::pow(1.0 - t, 1.15);
    let tooth = 1.0 - 0.045 * (t * 15.0 - (t * 15.0).floor());
    (0.86 * body * tooth).max(0.012 * (1.0 - t))
}

/// Strength of the veins: midrib, and laterals that rise toward the rim.
fn veins(x: f64, t: f64) -> f64 {
    let midrib = 1.0 - smooth(0.006, 0.016, x.abs());
    let lane = (t - 0.75 * x.abs()) * 8.0 + if x > 0.0 { 0.5 } else { 0.0 };
    let lateral = 1.0 - smooth(0.03, 0.10, (lane - lane.round()).abs());
    (0.75 * midrib).max(0.35 * lateral * (1.0 - smooth(0.0, 0.45, x.abs())))
}

/// Offsets of an n x n sample grid inside a pixel, from its corner.
fn samples(n: u32) -> impl Iterator<Item = DVec2> {
    let at = move |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    (0..n * n).map(move |k| DVec2::new(at(k % n), at(k / n)))
}

/// A square picture of `color`, which is asked at each pixel's upper left corner in [0, 1) and
/// answers sRGB-encoded color and alpha.
fn raster(name: &str, size: u32, color: impl Fn(DVec2) -> (DVec3, f64)) -> Raster {
    let pixel = |index: u32| {
        let (rgb, alpha) = color(DVec2::new(f64::from(index % size), f64::from(index / size)) / f64::from(size));
        let byte = |x: f64| (x.clamp(0.0, 1.0) * 255.0).round() as u8;
        [byte(rgb.x), byte(rgb.y), byte(rgb.z), byte(alpha)]
    };
    let rgba: Vec<u8> = (0..size * size).flat_map(pixel).collect();
    let has_alpha = rgba.chunks(4).any(|p| p[3] < 255);
    Raster { name: format!("{name}.png"), width: size, height: size, rgba, has_alpha }
}

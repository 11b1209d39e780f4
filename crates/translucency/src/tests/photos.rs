//! Estimates from photographs: what must hold of any, and colors of leaves whose color is known.

use crate::photo::{ColorEstimate, Look, Veins, thickness_from_photo};
use crate::presets::Preset;
use crate::transport::{AddingDoubling, fresnel_outside};

const SIZE: usize = 160;

/// A green disc with a light or dark line across.
fn picture(line: f32) -> Vec<f32> {
    let texel = |at: usize| {
        let (x, y) = ((at % SIZE) as f32 - 79.5, (at / SIZE) as f32 - 79.5);
        let vein = 1.0 + line * libm::expf(-x * x / 8.0);
        let leaf = f32::from(u8::from(libm::hypotf(x, y) < 70.0));
        [0.05 * vein, 0.2 * vein, 0.03 * vein, leaf]
    };
    (0..SIZE * SIZE).flat_map(texel).collect()
}

#[test]
fn veins_are_thick_the_rim_is_thin_and_the_mean_is_as_said() {
    for (line, veins) in [(1.0, Veins::Auto), (1.0, Veins::Light), (-0.6, Veins::Auto), (-0.6, Veins::Dark)] {
        let rgba = picture(line);
        let found = thickness_from_photo(&rgba, SIZE, &Look { mean_mm: 0.25, veins });
        let leaf: Vec<f64> =
            found.iter().zip(rgba.chunks(4)).filter(|(_, t)| t[3] > 0.5).map(|(d, _)| f64::from(*d)).collect();
        assert!((leaf.iter().sum::<f64>() / leaf.len() as f64 - 0.25).abs() < 1e-6);
        assert!(found.iter().zip(rgba.chunks(4)).all(|(d, t)| (*d > 0.0) == (t[3] > 0.5)));
        let at = |x: usize, y: usize| found[y * SIZE + x];
        let (vein, blade, rim) = (at(80, 80), at(45, 80), at(10, 80));
        assert!(vein > 1.5 * blade && rim < 0.8 * blade && rim > 0.0, "{line}: {vein} {blade} {rim}");
    }
    // Looked for in vain, veins change nothing where there are none of the kind.
    let light = thickness_from_photo(&picture(1.0), SIZE, &Look { mean_mm: 0.25, veins: Veins::Dark });
    assert!(light[80 * SIZE + 80] < 1.2 * light[80 * SIZE + 45]);
}

#[test]
fn pictures_of_nothing_and_of_one_texel_are_taken() {
    let look = Look { mean_mm: 0.2, veins: Veins::Auto };
    assert_eq!(thickness_from_photo(&[0.5; 4], 1, &look), [0.2]);
    assert_eq!(thickness_from_photo(&[0.5, 0.5, 0.5, 0.0], 1, &look), [0.0]);
    assert!(thickness_from_photo(&[], 0, &look).is_empty());
    let row = thickness_from_photo(&[1.0; 28], 7, &look);
    assert!(row.iter().all(|d| (d - 0.2).abs() < 1e-6), "{row:?}");
}

/// A leaf of the preset's own albedo lets through what the preset does; brighter places let through more, none more than all.
#[test]
fn a_leaf_of_known_color_lets_through_what_it_does() {
    let preset = Preset::named("typical").unwrap();
    let estimate = ColorEstimate::new(preset, preset.thickness_mm).unwrap();
    let totals = [610.0, 550.0, 450.0].map(|nm| {
        let medium = preset.medium(nm).unwrap();
        (AddingDoubling::one(&medium, preset.thickness_mm, 1.0, 16), fresnel_outside(1.0, medium.index))
    });
    let found = estimate.of(totals.map(|(t, mirror)| (t.reflectance - mirror) as f32));
    for (found, (totals, _)) in found.iter().zip(&totals) {
        // Straight lines between 48 absorptions, a third of a factor 10 apart.
        assert!((f64::from(*found) - totals.transmittance).abs() < 5e-3, "{found} {totals:?}");
    }
    // Green shines through, as in every backlit leaf, and more yellow than by day.
    assert!(found[1] > 2.0 * found[0] && found[0] > 5.0 * found[2]);
    let mut last = [0.0; 3];
    for step in 0..=40 {
        let color = estimate.of([step as f32 / 40.0; 3]);
        assert!((0..3).all(|c| color[c] >= last[c] && color[c] < 1.0), "{color:?}");
        last = color;
    }
    assert!(estimate.of([f32::NAN, -1.0, 7.0]).iter().all(|c| (0.0..1.0).contains(c)));
}

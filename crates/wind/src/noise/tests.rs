//! The laws of the house and the gates of the noise.

use super::*;
use foliar_bake::{Maps, Quiet, Request, laws, run};
use foliar_plant::Plant;
use foliar_plant::sample::Sample;

fn texture(given: Value) -> (FloatRaster, NoiseParams, Measured) {
    let request = Request { given: given.as_object().unwrap().clone(), ..Request::default() };
    let inputs = Inputs { plant: None, maps: &Maps::new(), neighbors: &[] };
    let (layer, _) = run(&Noise, &inputs, &request, &Quiet).unwrap();
    let raster = layer.rasters[names::RASTER_NOISE].clone();
    let params = NoiseParams::from_json(&layer.record.resolved).unwrap();
    let measured = measure(&raster, &params);
    assert_eq!(layer.record.facts["measured"], measured.to_json());
    (raster, params, measured)
}

/// It reads no plant: one stands for all.
#[test]
fn the_laws_of_the_house_hold() {
    let nothing = Sample { name: "nothing", plant: Plant::default() };
    let breaches = laws::check_all(&Noise, &[nothing]);
    assert!(breaches.is_empty(), "{breaches:?}");
}

/// Gates of wind.md section 3, on seeds that nobody chose.
#[test]
fn slope_seam_correlation_and_mean_are_what_was_asked_for() {
    for beta in [1.0, 1.5, 2.0, 3.0] {
        for seed in 1..=4 {
            let (_, _, measured) = texture(json!({"beta": beta, "seed": seed, "size": 128, "kmax": 63}));
            let slope = measured.slope.unwrap();
            assert!((slope - beta).abs() <= 0.1, "beta {beta}, seed {seed}: {measured:?}");
            assert!(measured.correlation.abs() < 1e-3, "beta {beta}, seed {seed}: {measured:?}");
            assert!(measured.mean.abs() < 1e-6, "beta {beta}, seed {seed}: {measured:?}");
        }
    }
}

#[test]
fn the_default_meets_every_gate() {
    for seed in 1..=8 {
        let (raster, _, measured) = texture(json!({"seed": seed}));
        assert!((measured.slope.unwrap() - 2.0).abs() <= 0.1, "{measured:?}");
        assert!((0.85..=1.15).contains(&measured.seam_ratio), "seed {seed}: {measured:?}");
        assert!(measured.correlation.abs() < 1e-3 && measured.mean.abs() < 1e-6, "{measured:?}");
        let peak = raster.data.iter().fold(0.0f32, |peak, value| peak.max(value.abs()));
        assert_eq!(peak.to_bits(), 1.0f32.to_bits(), "the peak fills the range");
    }
}

/// A measure that cannot see a seam, a common part or another color of noise would pass everything.
#[test]
fn the_measure_sees_what_is_wrong() {
    let (mut raster, params, _) = texture(json!({"size": 64, "kmax": 31}));
    let size = raster.width as usize;
    let good = raster.clone();
    for (index, value) in raster.data.iter_mut().enumerate() {
        *value += (index / 2 % size) as f32 / size as f32;
    }
    let ramp = measure(&raster, &params);
    assert!(ramp.seam_ratio > 1.15 && ramp.mean.abs() > 0.1, "{ramp:?}");
    let mut twins = good.clone();
    twins.data.chunks_exact_mut(2).for_each(|texel| texel[1] = texel[0]);
    assert!((measure(&twins, &params).correlation - 1.0).abs() < 1e-9);
    let mut white = good;
    let mut seed = 1u32;
    white.data.iter_mut().for_each(|value| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        *value = (seed >> 8) as f32 / (1 << 24) as f32 - 0.5;
    });
    assert!(measure(&white, &params).slope.unwrap().abs() < 0.5);
}

#[test]
fn a_band_that_does_not_fit_is_refused() {
    let refused = |given: Value| NoiseParams::from_json(given.as_object().unwrap()).unwrap_err().to_string();
    assert!(refused(json!({"size": 64, "kmax": 40})).contains("below half of size = 64"));
    assert!(refused(json!({"kmin": 40, "kmax": 32})).contains("kmin"));
}

#[test]
fn the_band_is_kept() {
    let params = NoiseParams { kmin: 3, kmax: 9, ..NoiseParams::default() };
    let lengths: Vec<f64> = modes(&params).iter().map(|m| f64::from(m.kx * m.kx + m.ky * m.ky).sqrt()).collect();
    assert!(lengths.iter().all(|k| (3.0..=9.0).contains(k)) && lengths.len() > 100);
}

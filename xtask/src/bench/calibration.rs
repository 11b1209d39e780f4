//! What the machine is: its name, and the time of a fixed loop.

use super::{Figure, least_seconds};
use anyhow::Result;
use std::hint::black_box;

/// Seconds of a loop that no compiler can shorten.
pub fn seconds() -> Result<Figure> {
    let spin = || {
        let mut x = black_box(0.5f64);
        for _ in 0..1u32 << 28 {
            x = x * 0.999_999 + 1e-6;
        }
        black_box(x);
        Ok(())
    };
    Ok(Figure::new(least_seconds(2, spin)?, "none: it tells machines apart"))
}

/// The processor's name, where the system tells it.
pub fn processor() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or_else(|| format!("a processor of {}", std::env::consts::ARCH), |(_, name)| name.trim().to_string())
}

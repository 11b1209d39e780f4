//! Vector instructions that a processor may have.

/// Vector instructions to run on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// What every processor of the architecture has (SSE2, NEON).
    Plain,
    /// AVX2, eight lanes.
    Avx2,
    /// AVX-512, sixteen lanes.
    Avx512,
}

impl Isa {
    /// What this processor has, widest last.
    pub fn available() -> Vec<Isa> {
        let mut found = vec![Isa::Plain];
        #[cfg(target_arch = "x86_64")]
        {
            if std::arch::is_x86_feature_detected!("avx2") {
                found.push(Isa::Avx2);
            }
            if std::arch::is_x86_feature_detected!("avx512f") {
                found.push(Isa::Avx512);
            }
        }
        found
    }

    /// The widest of them.
    pub fn best() -> Isa {
        Isa::available().last().copied().unwrap_or(Isa::Plain)
    }
}

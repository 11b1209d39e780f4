//! Vector instructions that a processor may have.

/// Vector instructions to run on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// None that are chosen at run time; four lanes, whatever the compiler makes of them.
    Plain,
    /// NEON, four lanes.
    #[cfg(target_arch = "aarch64")]
    Neon,
    /// AVX2 and what came with it (x86-64-v3), eight lanes.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512 (x86-64-v4), sixteen lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// What this processor has, widest last.
    pub fn available() -> Vec<Isa> {
        let has = [
            (Isa::Plain, true),
            #[cfg(target_arch = "aarch64")]
            (Isa::Neon, pulp::aarch64::Neon::try_new().is_some()),
            #[cfg(target_arch = "x86_64")]
            (Isa::Avx2, pulp::x86::V3::try_new().is_some()),
            #[cfg(target_arch = "x86_64")]
            (Isa::Avx512, pulp::x86::V4::try_new().is_some()),
        ];
        has.into_iter().filter(|(_, has)| *has).map(|(isa, _)| isa).collect()
    }

    /// The widest of them.
    pub fn best() -> Isa {
        Isa::available().last().copied().unwrap_or(Isa::Plain)
    }
}

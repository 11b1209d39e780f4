//! Vector instructions, chosen at run time: without unsafe code, by pulp. Nothing is fused where the code does not say so,
//! so that plain arithmetic gives the same bits on all of them.

use pulp::{Scalar128b, Simd, WithSimd};

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

    /// Runs something on these instructions, plainly where the processor lacks them. What it calls runs on them too where it
    /// is `inline(always)`.
    pub fn dispatch<Op: WithSimd>(self, op: Op) -> Op::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            Isa::Avx512 => on(pulp::x86::V4::try_new(), op),
            #[cfg(target_arch = "x86_64")]
            Isa::Avx2 => on(pulp::x86::V3::try_new(), op),
            #[cfg(target_arch = "aarch64")]
            Isa::Neon => on(pulp::aarch64::Neon::try_new(), op),
            Isa::Plain => on(None::<Scalar128b>, op),
        }
    }
}

fn on<S: Simd, Op: WithSimd>(simd: Option<S>, op: Op) -> Op::Output {
    match simd {
        Some(simd) => simd.vectorize(op),
        None => Scalar128b.vectorize(op),
    }
}

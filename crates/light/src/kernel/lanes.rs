//! Numbers side by side, as many as a register holds.
//!
//! What handles them must be inlined whole into the function that was compiled for the instructions: functions say so,
//! closures cannot, so loops stand where a `map` would read better.

use super::LANES;
use pulp::Simd;
use std::ops::{Add, Div, Mul, Sub};

/// A register of numbers. Operations are those of IEEE, lane by lane, nothing fused.
#[derive(Clone, Copy)]
pub struct Lanes<S: Simd> {
    pub simd: S,
    values: S::f32s,
}

/// Which lanes a condition holds for.
#[derive(Clone, Copy)]
pub struct Where<S: Simd>(S::m32s);

impl<S: Simd> Lanes<S> {
    /// The same number in all.
    #[inline(always)]
    pub fn splat(simd: S, value: f32) -> Self {
        Lanes { simd, values: simd.splat_f32s(value) }
    }

    /// Those of sixteen from `start` on.
    #[inline(always)]
    pub fn load(simd: S, from: &[f32; LANES], start: usize) -> Self {
        Lanes { simd, values: S::as_simd_f32s(from).0[start / S::F32_LANES] }
    }

    /// From sixteen places to one.
    #[inline(always)]
    pub fn away(simd: S, to: [f32; 3], from: &[[f32; LANES]; 3], start: usize) -> [Self; 3] {
        let x = to[0] - Self::load(simd, &from[0], start);
        let y = to[1] - Self::load(simd, &from[1], start);
        let z = to[2] - Self::load(simd, &from[2], start);
        [x, y, z]
    }

    /// Adds them to sums.
    #[inline(always)]
    pub fn pour(self, start: usize, sums: &mut [f64; LANES]) {
        let values: &[f32] = bytemuck::cast_slice(std::slice::from_ref(&self.values));
        for (sum, value) in sums[start..start + S::F32_LANES].iter_mut().zip(values) {
            *sum += f64::from(*value);
        }
    }

    /// The larger of each pair.
    #[inline(always)]
    pub fn max(self, other: f32) -> Self {
        Lanes { values: self.simd.max_f32s(self.values, self.simd.splat_f32s(other)), ..self }
    }

    /// The smaller of each pair.
    #[inline(always)]
    pub fn min(self, other: f32) -> Self {
        Lanes { values: self.simd.min_f32s(self.values, self.simd.splat_f32s(other)), ..self }
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Lanes { values: self.simd.sqrt_f32s(self.values), ..self }
    }

    /// Where numbers equal another.
    #[inline(always)]
    pub fn equals(self, other: f32) -> Where<S> {
        Where(self.simd.equal_f32s(self.values, self.simd.splat_f32s(other)))
    }

    /// Power of two of positive numbers, and what is left between the root of 1/2 and its double.
    #[inline(always)]
    pub fn power_and_mantissa(self) -> (Self, Self) {
        /// Bits of the root of 1/2, and of 1.
        const ROOT: u32 = 0x3f35_04f3;
        const ONE: u32 = 0x3f80_0000;
        /// Bits of 2^23: a small whole number in the last bits is added to it.
        const WHOLE: u32 = 0x4b00_0000;
        let simd = self.simd;
        let bits = simd.transmute_u32s_f32s(self.values);
        let shifted = simd.add_u32s(bits, simd.splat_u32s(ONE - ROOT));
        let places = simd.splat_u32s(23);
        let power = simd.wrapping_dyn_shr_u32s(shifted, places);
        let scale = simd.sub_u32s(simd.wrapping_dyn_shl_u32s(power, places), simd.splat_u32s(ONE));
        let mantissa = simd.transmute_f32s_u32s(simd.sub_u32s(bits, scale));
        let number = simd.transmute_f32s_u32s(simd.or_u32s(power, simd.splat_u32s(WHOLE)));
        let power = Lanes { simd, values: number } - (f32::from_bits(WHOLE) + 127.0);
        (power, Lanes { simd, values: mantissa })
    }
}

impl<S: Simd> Where<S> {
    /// One number or the other.
    #[inline(always)]
    pub fn choose(self, holds: Lanes<S>, else_: Lanes<S>) -> Lanes<S> {
        Lanes { values: holds.simd.select_f32s(self.0, holds.values, else_.values), ..holds }
    }
}

/// Where sixteen whole numbers, from `start` on, equal another.
#[inline(always)]
pub fn equal<S: Simd>(simd: S, from: &[u32; LANES], start: usize, other: u32) -> Where<S> {
    let some = S::as_simd_u32s(from).0[start / S::U32_LANES];
    Where(simd.equal_u32s(some, simd.splat_u32s(other)))
}

macro_rules! operator {
    ($trait:ident, $name:ident, $simd:ident) => {
        impl<S: Simd> $trait for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Lanes { values: self.simd.$simd(self.values, other.values), ..self }
            }
        }
        impl<S: Simd> $trait<f32> for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: f32) -> Self {
                self.$name(Lanes::splat(self.simd, other))
            }
        }
        impl<S: Simd> $trait<Lanes<S>> for f32 {
            type Output = Lanes<S>;
            #[inline(always)]
            fn $name(self, other: Lanes<S>) -> Lanes<S> {
                Lanes::splat(other.simd, self).$name(other)
            }
        }
    };
}

operator!(Add, add, add_f32s);
operator!(Sub, sub, sub_f32s);
operator!(Mul, mul, mul_f32s);
operator!(Div, div, div_f32s);

//! Morton order (Morton 1966): places that are near in space come near in the list.

/// Bits of each coordinate that a Morton code keeps.
pub const MORTON_BITS: u32 = 21;

/// Interleaves the low 21 bits of three coordinates, x lowest.
pub fn morton3(x: u32, y: u32, z: u32) -> u64 {
    spread(x) | spread(y) << 1 | spread(z) << 2
}

/// Puts two empty bits between each two bits.
fn spread(value: u32) -> u64 {
    let mut bits = u64::from(value) & 0x1F_FFFF;
    for (shift, mask) in [
        (32, 0x001F_0000_0000_FFFF),
        (16, 0x001F_0000_FF00_00FF),
        (8, 0x100F_00F0_0F00_F00F),
        (4, 0x10C3_0C30_C30C_30C3),
        (2, 0x1249_2492_4924_9249),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bit_lands_where_it_belongs() {
        for bit in 0..MORTON_BITS {
            let one = 1u32 << bit;
            assert_eq!(morton3(one, 0, 0), 1 << (3 * bit));
            assert_eq!(morton3(0, one, 0), 1 << (3 * bit + 1));
            assert_eq!(morton3(0, 0, one), 1 << (3 * bit + 2));
        }
    }
}

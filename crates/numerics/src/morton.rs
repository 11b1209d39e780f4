//! Morton order: places that are near in space come near in the list.

/// Bits of each coordinate that a Morton code keeps.
pub const MORTON_BITS: u32 = 21;

/// Interleaves the low 21 bits of three coordinates, x lowest.
pub fn morton3(x: u32, y: u32, z: u32) -> u64 {
    spread(x) | spread(y) << 1 | spread(z) << 2
}

/// The coordinates that [`morton3`] interleaved.
pub fn morton3_inverse(code: u64) -> [u32; 3] {
    [compact(code), compact(code >> 1), compact(code >> 2)]
}

/// Drops two of each three bits.
fn compact(code: u64) -> u32 {
    let mut bits = code & 0x1249_2492_4924_9249;
    for (shift, mask) in [
        (2, 0x10C3_0C30_C30C_30C3),
        (4, 0x100F_00F0_0F00_F00F),
        (8, 0x001F_0000_FF00_00FF),
        (16, 0x001F_0000_0000_FFFF),
        (32, 0x1F_FFFF),
    ] {
        bits = (bits | bits >> shift) & mask;
    }
    bits as u32
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
    #[test]
    fn coordinates_come_back() {
        for place in [[0, 0, 0], [1, 2, 3], [0x1F_FFFF, 0, 0x15_5555], [7, 0x1F_FFFF, 0x0A_AAAA]] {
            assert_eq!(morton3_inverse(morton3(place[0], place[1], place[2])), place);
        }
    }
}

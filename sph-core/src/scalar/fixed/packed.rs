//! Vectors of [`Near14`] in memory, 16 bits a component; two components are added in one 32-bit word.
//!
//! In two dimensions the word is 2^16 y + x, so a sum or difference of words is that of the vectors. x is the word's lower half
//! with its sign, y what is left.

use super::near::Near14;
use crate::scalar::compact::{NearUnit, Pack};
use core::array::from_fn;

/// A vector of components within ±2.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(align(4))]
pub struct Packed14<const D: usize>([u16; D]);

impl<const D: usize> Packed14<D> {
    /// The two halves as one word, in two dimensions.
    #[inline(always)]
    fn word(self) -> u32 {
        u32::from(self.0[0]) | u32::from(self.0[1]).wrapping_shl(16)
    }

    #[inline(always)]
    fn from_word(word: u32) -> Self {
        Self(from_fn(|axis| word.wrapping_shr(16_u32.wrapping_mul(axis as u32)) as u16))
    }

    /// The low 16 bits of each number, or 2^16 y + x.
    #[inline(always)]
    fn of(numbers: [i32; D]) -> Self {
        if D == 2 {
            Self::from_word(numbers[1].wrapping_shl(16).wrapping_add(numbers[0]) as u32)
        } else {
            Self(numbers.map(|n| n as u16))
        }
    }
}

impl<const D: usize> Packed14<D> {
    /// In a function of its own: few vectors need it.
    #[inline(never)]
    fn each_clamped(self, limit: Near14) -> Self {
        Self::pack(self.unpack().map(|component| component.clamp_abs(limit)))
    }
}

impl<const D: usize> Pack<Near14, D> for Packed14<D> {
    const ZERO: Self = Self([0; D]);

    #[inline(always)]
    fn pack(vector: [Near14; D]) -> Self {
        Self::of(vector.map(|n| n.0))
    }

    #[inline(always)]
    fn unpack(self) -> [Near14; D] {
        if D == 2 {
            let word = self.word() as i32;
            let x = i32::from(word as i16);
            let y = word.wrapping_sub(x).wrapping_shr(16);
            from_fn(|axis| Near14(if axis == 0 { x } else { y }))
        } else {
            self.0.map(|n| Near14(i32::from(n as i16)))
        }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        if D == 2 {
            Self::from_word(self.word().wrapping_add(other.word()))
        } else {
            Self(from_fn(|axis| self.0[axis].wrapping_add(other.0[axis])))
        }
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        if D == 2 {
            Self::from_word(self.word().wrapping_sub(other.word()))
        } else {
            Self(from_fn(|axis| self.0[axis].wrapping_sub(other.0[axis])))
        }
    }

    /// In two dimensions first both components at once: from −`limit` on, as many counts as a power of two has.
    #[inline(always)]
    fn clamped(self, limit: Near14) -> Self {
        if D == 2 {
            let both = |count: u32| count.wrapping_mul(1 << 16 | 1);
            let count = 1_u32.wrapping_shl((limit.0 as u32).wrapping_shl(1).checked_ilog2().unwrap_or(0));
            if self.word().wrapping_add(both(limit.0 as u32)) & both(count.wrapping_neg() & 0xffff) == 0 {
                return self;
            }
        }
        self.each_clamped(limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_each_component() {
        for limit in [Near14(1 << 12), Near14(3000)] {
            let numbers =
                [0, 1, -1, 2999, -3000, -3001, 4095, 4096, 4097, -4095, -4096, -4097, 32767, -32768];
            for [x, y] in numbers.iter().flat_map(|&x| numbers.map(|y| [x, y])) {
                let clamped = Packed14::<2>::pack([Near14(x), Near14(y)]).clamped(limit).unpack();
                let expected = [x, y].map(|n| Near14(n.clamp(-limit.0, limit.0)));
                assert_eq!(clamped, expected, "{x}, {y} to {limit:?}");
            }
        }
    }
}

//! Vectors of [`Near14`] in memory, 16 bits a component; two components are added in one 32-bit word.
//!
//! In two dimensions the word is 2^16 y + x, so a sum or difference of words is that of the vectors. x is the word's lower half
//! with its sign, y what is left.

use super::near::{FRACTION, Near14};
use super::{Fixed, Format, Overflow, Word};
use crate::Arithmetic;
use crate::scalar::compact::{Compact, Pack, Place};
use core::array::from_fn;

/// A vector of components within ±2.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[repr(align(4))]
pub struct Packed14<const D: usize>([u16; D]);

/// A position: the lower and the upper 16 bits of its coordinates.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Place14<const D: usize> {
    low: Packed14<D>,
    high: Packed14<D>,
}

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
}

impl<const D: usize> Place14<D> {
    /// The coordinates as counts of 2^−14.
    #[inline(always)]
    fn counts(&self) -> [i32; D] {
        let join = |low: u32, high: u16| (low & 0xffff | u32::from(high).wrapping_shl(16)) as i32;
        if D == 2 {
            let word = self.low.word();
            let x = join(word, self.high.0[0]);
            let y = join(word.wrapping_sub(x as u32).wrapping_shr(16), self.high.0[1]);
            from_fn(|axis| if axis == 0 { x } else { y })
        } else {
            from_fn(|axis| join(self.low.0[axis].into(), self.high.0[axis]))
        }
    }
}

impl<F: Format, O: Overflow> Fixed<F, O> {
    /// A count of 2^−14 that is in range.
    #[inline(always)]
    fn of_count(n: i32) -> Self {
        Self::from_bits(F::Bits::wrap(F::Bits::from_near(n, F::FRAC_NBITS, FRACTION)))
    }
}

impl<F: Format, O: Overflow, const D: usize> Place<Fixed<F, O>, D> for Place14<D> {
    const ORIGIN: Self = Self { low: Packed14::ZERO, high: Packed14::ZERO };

    #[inline(always)]
    fn new(x: &[Fixed<F, O>; D]) -> Self {
        let counts = x.map(|coordinate| coordinate.offset(Fixed::ZERO).0);
        Self { low: Packed14::of(counts), high: Packed14(counts.map(|n| n.wrapping_shr(16) as u16)) }
    }

    #[inline(always)]
    fn coordinates(&self) -> [Fixed<F, O>; D] {
        self.counts().map(Fixed::of_count)
    }

    #[inline(always)]
    fn moved(&self, way: &[Near14; D]) -> [Fixed<F, O>; D] {
        let counts = self.counts();
        from_fn(|axis| Fixed::of_count(counts[axis].wrapping_add(way[axis].0)))
    }

    #[inline(always)]
    fn from(&self, origin: &Self) -> Packed14<D> {
        self.low.minus(origin.low)
    }
}

//! f32 and f64 with libm's correctly rounded square root, so that a target without a floating-point unit gives the same
//! bits as one with it.

use super::{Accumulator, Arithmetic, Scalar, Table};

macro_rules! float {
    ($Float:ident, $sqrt:path) => {
        impl Arithmetic for $Float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline(always)]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                numerator as Self / denominator as Self
            }

            #[inline(always)]
            fn positive_part(self) -> Self {
                if self > 0.0 { self } else { 0.0 }
            }

            #[inline(always)]
            fn times(self, n: i32) -> Self {
                self * n as Self
            }
        }

        impl Scalar for $Float {
            type Sum = Self;

            const NAME: &'static str = stringify!($Float);
            const EPSILON: Self = Self::EPSILON;
            const MAX: Self = Self::MAX;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as Self
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }

            #[inline(always)]
            fn floor_to_i32(self) -> i32 {
                let truncated = self as i32;
                truncated.saturating_sub((self < truncated as Self) as i32)
            }

            #[inline(always)]
            fn split(self, bits: u32) -> (usize, Self) {
                let scaled = self * 1_u32.wrapping_shl(bits) as Self;
                let whole = scaled as i32;
                (whole as usize, scaled - whole as Self)
            }

            #[inline(always)]
            fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(
                row: usize,
                i: usize,
            ) -> Option<Self> {
                let table: &'static [[Self; N]; ROWS] = const {
                    let mut table = [[0.0; N]; ROWS];
                    let mut i = 0;
                    while i < ROWS * N {
                        table[i / N][i % N] = C::VALUES[i / N][i % N] as Self;
                        i += 1;
                    }
                    &{ table }
                };
                table.get(row)?.get(i).copied()
            }

            #[inline(always)]
            fn canonical_bits(self) -> u64 {
                if self.is_nan() { Self::NAN.to_bits().into() } else { (self + 0.0).to_bits().into() }
            }
        }

        impl Accumulator<$Float> for $Float {
            const ZERO: Self = 0.0;

            #[inline(always)]
            fn add(&mut self, term: $Float) {
                *self += term;
            }

            #[inline(always)]
            fn total(self) -> $Float {
                self
            }

            #[inline(always)]
            fn scaled_total(self, a: $Float, b: $Float) -> $Float {
                a * b * self
            }
        }
    };
}

float!(f32, libm::sqrtf);
float!(f64, libm::sqrt);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_toward_minus_infinity_and_saturates() {
        for (x, floor) in [(0.0, 0), (0.9, 0), (-0.1, -1), (-1.0, -1), (2.0, 2), (-2.5, -3)] {
            assert_eq!(Scalar::floor_to_i32(x as f32), floor);
            assert_eq!(Scalar::floor_to_i32(x), floor);
        }
        assert_eq!(Scalar::floor_to_i32(1e30_f32), i32::MAX);
        assert_eq!(Scalar::floor_to_i32(-1e30_f64), i32::MIN);
        assert_eq!(Scalar::floor_to_i32(f32::NAN), 0);
    }

    #[test]
    fn positive_part_is_never_negative_zero() {
        assert_eq!((-0.0_f32).positive_part().to_bits(), 0);
        assert_eq!((-3.0_f64).positive_part().to_bits(), 0);
        assert_eq!(3.0_f64.positive_part(), 3.0);
    }

    #[test]
    fn canonical_bits_join_both_zeros_and_all_nans() {
        assert_eq!((-0.0_f32).canonical_bits(), 0.0_f32.canonical_bits());
        assert_eq!(f64::NAN.canonical_bits(), (-f64::NAN).canonical_bits());
        assert_ne!(1.0_f32.canonical_bits(), 1.0_f32.next_up().canonical_bits());
    }

    #[test]
    fn integer_powers_multiply() {
        assert_eq!(3.0_f64.pow::<5>(), 243.0);
        assert_eq!(2.0_f32.pow::<8>(), 256.0);
        assert_eq!((-1.5_f64).pow::<1>(), -1.5);
    }
}

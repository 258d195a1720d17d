//! Integer arithmetic under the fixed-point types: exact in a wider type, rounded to nearest with ties away from zero.
//!
//! Rounding is symmetric about zero, so the force of i on j is the force of j on i with the other sign, to the bit. A bare
//! `>>` rounds toward −∞ instead: −½ unit on average, which gives every particle the same small push.

/// The integer behind a fixed-point type: `i8`, `i16`, `i32` or `i64`. Sealed; nothing here panics.
pub trait Word: Copy + Ord + super::Sealed + 'static {
    /// Holds a product with an `i32`, a shifted dividend and a sum of 2³² terms (`i64`: of 2⁶⁴).
    type Wide: Copy + Ord + From<i32> + core::fmt::Debug + Send + Sync + 'static;

    /// So far out that a sum put here when it meets a NaR stays out of range, whatever terms follow, of either sign.
    const POISON: Self::Wide;
    /// 0
    const EMPTY_SUM: Self::Wide;

    /// The same integer, wider.
    fn widen(self) -> Self::Wide;
    /// 2^`bits` n, for an n of 32 bits or of this word's.
    fn shifted(n: Self::Wide, bits: u32) -> Self::Wide;
    /// `sum + self`
    fn added_to(self, sum: Self::Wide) -> Self::Wide;
    /// Whether a sum was put at [`POISON`](Self::POISON); terms added since do not hide it.
    fn is_poisoned(sum: Self::Wide) -> bool;
    /// The product with a sum over 2^`bits`, rounded, held at the ends of the wide type; `bits` is less than the word's.
    fn times_sum(self, sum: Self::Wide, bits: u32) -> Self::Wide;
    /// n times this word, exact.
    fn scaled(self, n: i32) -> Self::Wide;
    /// The product over 2^`bits`, rounded.
    fn product(self, other: Self, bits: u32) -> Self::Wide;
    /// 2^`bits` self / divisor, rounded; None for a divisor of 0.
    fn divided(self, divisor: Self, bits: u32) -> Option<Self::Wide>;
    /// The quotient, rounded; None for a divisor of 0.
    fn quotient(numerator: Self::Wide, denominator: Self::Wide) -> Option<Self::Wide>;
    /// √(2^`bits` self), rounded to nearest; 0 for a negative word.
    fn root(self, bits: u32) -> Self;
    /// ⌊self / 2^`bits`⌋, held at the ends of `i32`.
    fn floor(self, bits: u32) -> i32;
    /// ⌊2^`to` self / 2^`from`⌋ and the rest in units of 2^−`from`, for self ≥ 0.
    fn split(self, from: u32, to: u32) -> (usize, Self);
    /// max(0, self) without a branch; `keep_min` lets the most negative word pass as it is.
    fn positive_part(self, keep_min: bool) -> Self;
    /// The low bits of a wide integer.
    fn wrap(wide: Self::Wide) -> Self;
    /// The low bits of 64.
    fn low_bits(bits: i64) -> Self;
    /// The wide integer itself where it is in the symmetric range −MAX to MAX.
    fn fit(wide: Self::Wide) -> Option<Self>;
    /// The nearest integer of that range.
    fn saturate(wide: Self::Wide) -> Self;
    /// A 64-bit integer, wide.
    fn from_i64(n: i64) -> Self::Wide;
    /// As an f64, rounded to nearest where 53 bits do not hold it.
    fn to_f64(self) -> f64;
    /// The low bits of self − other as a count of 2^−`to` where it was one of 2^−`from`; bits that fall off are lost.
    fn near_difference(self, other: Self, from: u32, to: u32) -> i32;
    /// A count of 2^−`to` as one of 2^−`from`.
    fn from_near(near: i32, from: u32, to: u32) -> Self::Wide;
    /// The word's own bits, zeros above.
    fn bits(self) -> u64;
}

/// `$Word`, the same without a sign, twice as wide, that without a sign, and `Wide`.
macro_rules! word {
    ($Word:ty, $Unsigned:ty, $Double:ty, $UnsignedDouble:ty, $Wide:ty) => {
        impl Word for $Word {
            type Wide = $Wide;

            const POISON: $Wide = <$Wide>::MIN / 4 * 3;
            const EMPTY_SUM: $Wide = 0;

            #[inline(always)]
            fn widen(self) -> $Wide {
                self.into()
            }

            #[inline(always)]
            fn shifted(n: $Wide, bits: u32) -> $Wide {
                n.wrapping_shl(bits)
            }

            #[inline(always)]
            fn added_to(self, sum: $Wide) -> $Wide {
                sum.wrapping_add(self.into())
            }

            #[inline(always)]
            fn is_poisoned(sum: $Wide) -> bool {
                sum < <$Wide>::MIN / 2
            }

            #[inline(always)]
            fn times_sum(self, sum: $Wide, bits: u32) -> $Wide {
                let factor = <$Wide>::from(self);
                if bits == 0 {
                    return sum.saturating_mul(factor);
                }
                let high = sum.wrapping_shr(Self::BITS).wrapping_mul(factor);
                let half = <$Wide>::from(1i8).wrapping_shl(bits.wrapping_sub(1));
                let minus_one_if_negative = (sum ^ factor).wrapping_shr(<$Wide>::BITS - 1);
                let low = <$Wide>::from(sum as $Unsigned).wrapping_mul(factor);
                let low = low.wrapping_add(half).wrapping_add(minus_one_if_negative).wrapping_shr(bits);
                let up = Self::BITS.wrapping_sub(bits);
                let lifted = high.wrapping_shl(up);
                if lifted.wrapping_shr(up) == high {
                    lifted.saturating_add(low)
                } else {
                    high.wrapping_shr(<$Wide>::BITS - 1) ^ <$Wide>::MAX
                }
            }

            #[inline(always)]
            fn scaled(self, n: i32) -> $Wide {
                <$Wide>::from(self).wrapping_mul(n.into())
            }

            #[inline(always)]
            fn product(self, other: Self, bits: u32) -> $Wide {
                let exact = <$Double>::from(self).wrapping_mul(other.into());
                if bits == 0 {
                    return exact.into();
                }
                let half = <$Double>::from(1i8).wrapping_shl(bits.wrapping_sub(1));
                let minus_one_if_negative = exact.wrapping_shr(<$Double>::BITS - 1);
                exact.wrapping_add(half).wrapping_add(minus_one_if_negative).wrapping_shr(bits).into()
            }

            #[inline(always)]
            fn divided(self, divisor: Self, bits: u32) -> Option<$Wide> {
                let dividend = (self.unsigned_abs() as $UnsignedDouble).wrapping_shl(bits);
                let half = (divisor.unsigned_abs() >> 1) as $UnsignedDouble;
                let rounded = dividend.wrapping_add(half).checked_div(divisor.unsigned_abs().into())?;
                let rounded = <$Wide>::from(rounded as $Double);
                Some(if (self < 0) == (divisor < 0) { rounded } else { rounded.wrapping_neg() })
            }

            #[inline(always)]
            fn quotient(numerator: $Wide, denominator: $Wide) -> Option<$Wide> {
                let divisor = denominator.unsigned_abs();
                let rounded =
                    numerator.unsigned_abs().wrapping_add(divisor >> 1).checked_div(divisor)? as $Wide;
                Some(if (numerator < 0) == (denominator < 0) { rounded } else { rounded.wrapping_neg() })
            }

            #[inline(always)]
            fn root(self, bits: u32) -> Self {
                let square = (self.max(0) as $UnsignedDouble).wrapping_shl(bits);
                let floor = square.isqrt();
                let nearer_above = square.wrapping_sub(floor.wrapping_mul(floor)) > floor;
                floor.wrapping_add(nearer_above.into()) as Self
            }

            #[inline(always)]
            fn floor(self, bits: u32) -> i32 {
                i64::from(self.wrapping_shr(bits)).clamp(i32::MIN.into(), i32::MAX.into()) as i32
            }

            #[inline(always)]
            fn split(self, from: u32, to: u32) -> (usize, Self) {
                let below = from.saturating_sub(to);
                let rest = self & !<$Word>::MIN.wrapping_shr(Self::BITS.wrapping_sub(1).wrapping_sub(below));
                let above = to.saturating_sub(from);
                ((self.wrapping_shr(below) as usize).wrapping_shl(above), rest.wrapping_shl(to))
            }

            #[inline(always)]
            fn positive_part(self, keep_min: bool) -> Self {
                let sign_source = if keep_min { self.wrapping_sub(1) } else { self };
                self & !sign_source.wrapping_shr(Self::BITS - 1)
            }

            #[inline(always)]
            fn wrap(wide: $Wide) -> Self {
                wide as Self
            }

            #[inline(always)]
            fn low_bits(bits: i64) -> Self {
                bits as Self
            }

            #[inline(always)]
            fn fit(wide: $Wide) -> Option<Self> {
                let word = wide as Self;
                (<$Wide>::from(word) == wide && word != Self::MIN).then_some(word)
            }

            #[inline(always)]
            fn saturate(wide: $Wide) -> Self {
                let word = wide as Self;
                let end = wide.wrapping_shr(<$Wide>::BITS - 1) as Self ^ Self::MAX;
                let held = if <$Wide>::from(word) == wide { word } else { end };
                if held == Self::MIN { held.wrapping_add(1) } else { held }
            }

            #[inline(always)]
            fn from_i64(n: i64) -> $Wide {
                n.into()
            }

            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }

            #[inline(always)]
            fn near_difference(self, other: Self, from: u32, to: u32) -> i32 {
                let difference = self.wrapping_sub(other);
                if from < to {
                    (difference as i32).wrapping_shl(to.wrapping_sub(from))
                } else {
                    difference.wrapping_shr(from.wrapping_sub(to)) as i32
                }
            }

            #[inline(always)]
            fn from_near(near: i32, from: u32, to: u32) -> $Wide {
                if from < to {
                    near.wrapping_shr(to.wrapping_sub(from)).into()
                } else {
                    <$Wide>::from(near).wrapping_shl(from.wrapping_sub(to))
                }
            }

            #[inline(always)]
            fn bits(self) -> u64 {
                (self as $Unsigned).into()
            }
        }
    };
}

word!(i8, u8, i16, u16, i64);
word!(i16, u16, i32, u32, i64);
word!(i32, u32, i64, u64, i64);
word!(i64, u64, i128, u128, i128);

//! Two numbers that a third lies between.

use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, Scalar};

/// An interval of real numbers that holds the exact result, whatever the operands in theirs are: ends are rounded outwards.
///
/// A sum is widened only where it is not exact (D. E. Knuth's two-sum); products, quotients and roots always, by one unit in the last
/// place at each end. What is undefined somewhere in the operands is the whole line.
///
/// `<`, `<=`, `>`, `>=` mean *possibly*: a search visits every particle that may be in reach, whose influence then begins at 0.
/// [`undecided`](Self::undecided) counts comparisons that the intervals leave open. Code that takes one of two ways by a comparison is
/// enclosed only if both ways agree where it is open; the kernels and the brute-force search are so. `floor_to_i32` is that of the
/// lower end, so that a cell grid and a table see one of the cells that an interval touches and are *not* enclosed:
/// use [`BruteForce`](sph_core::BruteForce).
///
/// An interval does not know that two of its numbers are the same: x − x is not 0. So the gradient of a kernel that takes the distance itself,
/// not its square, is the whole line at a particle whose position is known up to some distance, where x/|x| is 0/0 for all it knows.
///
/// ```
/// use sph_core::{Arithmetic, Scalar};
/// use sph_lab::Interval;
///
/// let tenth = Interval::ratio(1, 10);
/// assert!(tenth.lower() < 0.1_f64.next_up() && tenth.contains(0.1));
/// let x = Interval::around(2.0, 0.25);
/// assert!((x * x).contains(4.5) && !(x * x).contains(5.2));
/// assert!(x / (x - x) == Interval::LINE);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

thread_local! {
    static UNDECIDED: Cell<u64> = const { Cell::new(0) };
}

impl Interval {
    /// Every number.
    pub const LINE: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// One number; the line for a NaN.
    #[must_use]
    pub const fn point(x: f64) -> Self {
        if x.is_nan() { Self::LINE } else { Self { lower: x, upper: x } }
    }

    /// From one number to another; `None` where the second is less or one is a NaN.
    #[must_use]
    pub const fn new(lower: f64, upper: f64) -> Option<Self> {
        if lower <= upper { Some(Self { lower, upper }) } else { None }
    }

    /// All numbers no farther than |`radius`| from x.
    #[must_use]
    pub fn around(x: f64, radius: f64) -> Self {
        Self::point(x) + Self::hull([-radius, radius])
    }

    /// The lower end.
    #[must_use]
    pub const fn lower(self) -> f64 {
        self.lower
    }

    /// The upper end.
    #[must_use]
    pub const fn upper(self) -> f64 {
        self.upper
    }

    /// How far the ends are apart.
    #[must_use]
    pub fn width(self) -> f64 {
        self.upper - self.lower
    }

    /// Whether a number is in it.
    #[must_use]
    pub fn contains(self, x: f64) -> bool {
        self.lower <= x && x <= self.upper
    }

    /// Comparisons of this thread so far that the intervals leave open.
    #[must_use]
    pub fn undecided() -> u64 {
        UNDECIDED.get()
    }

    /// From the least to the greatest of some numbers; the line where one is a NaN.
    fn hull<const N: usize>(numbers: [f64; N]) -> Self {
        if numbers.iter().any(|number| number.is_nan()) {
            return Self::LINE;
        }
        let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
        Self { lower: least, upper: numbers.into_iter().fold(f64::NEG_INFINITY, f64::max) }
    }

    /// One unit in the last place wider at each end.
    fn widened(self) -> Self {
        Self { lower: self.lower.next_down(), upper: self.upper.next_up() }
    }

    /// The answer of a comparison, counted where the intervals overlap.
    fn possibly(self, other: Self, answer: bool) -> bool {
        if self.lower <= other.upper && other.lower <= self.upper && self.width() + other.width() > 0.0 {
            UNDECIDED.set(UNDECIDED.get() + 1);
        }
        answer
    }
}

/// a + b, and the error of that sum, exact unless something overflows.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rounded_b = sum - a;
    (sum, (a - (sum - rounded_b)) + (b - rounded_b))
}

impl Add for Interval {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (lower, below) = two_sum(self.lower, other.lower);
        let (upper, above) = two_sum(self.upper, other.upper);
        // an error that is a NaN is that of an overflow
        let lower = if below >= 0.0 { lower } else { lower.next_down() };
        let upper = if above <= 0.0 { upper } else { upper.next_up() };
        if lower.is_nan() || upper.is_nan() { Self::LINE } else { Self { lower, upper } }
    }
}

impl Sub for Interval {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

/// 0 · ∞ is 0: an end at infinity stands for numbers as large as one likes.
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

/// The two factors are any numbers of their intervals: the square of one that holds 0 begins below 0.
impl Mul for Interval {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let ends = [
            product(self.lower, other.lower),
            product(self.lower, other.upper),
            product(self.upper, other.lower),
            product(self.upper, other.upper),
        ];
        let hull = Self::hull(ends);
        if ends == [0.0; 4] { hull } else { hull.widened() }
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::LINE;
        }
        let (a, b) = (self, other);
        Self::hull([a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper]).widened()
    }
}

impl Neg for Interval {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

crate::assign::assign_operators!([] Interval);
sph_core::own_companion!([] Interval, Interval::point(0.0));

/// Whether both are the same interval.
impl PartialEq for Interval {
    fn eq(&self, other: &Self) -> bool {
        self.lower == other.lower && self.upper == other.upper
    }
}

/// Possibly less, possibly greater.
impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self.upper < other.lower {
            Some(Ordering::Less)
        } else if self.lower > other.upper {
            Some(Ordering::Greater)
        } else {
            (self == other && self.width() == 0.0).then_some(Ordering::Equal)
        }
    }

    fn lt(&self, other: &Self) -> bool {
        self.possibly(*other, self.lower < other.upper)
    }

    fn le(&self, other: &Self) -> bool {
        self.possibly(*other, self.lower <= other.upper)
    }

    fn gt(&self, other: &Self) -> bool {
        self.possibly(*other, self.upper > other.lower)
    }

    fn ge(&self, other: &Self) -> bool {
        self.possibly(*other, self.upper >= other.lower)
    }
}

impl Arithmetic for Interval {
    const ZERO: Self = Self::point(0.0);
    const ONE: Self = Self::point(1.0);

    fn ratio(numerator: i32, denominator: i32) -> Self {
        let quotient = f64::from(numerator) / f64::from(denominator);
        let is_exact = denominator != 0
            && (denominator.unsigned_abs().is_power_of_two()
                || i64::from(numerator) % i64::from(denominator) == 0);
        if is_exact {
            Self::point(quotient)
        } else if denominator == 0 {
            Self::LINE
        } else {
            Self::point(quotient).widened()
        }
    }

    #[inline]
    fn positive_part(self) -> Self {
        Self { lower: self.lower.max(0.0), upper: self.upper.max(0.0) }
    }

    fn times(self, n: i32) -> Self {
        self * Self::point(f64::from(n))
    }
}

impl Scalar for Interval {
    type Sum = Self;

    const NAME: &'static str = "interval";
    const EPSILON: Self = Self::point(f64::EPSILON);
    const MAX: Self = Self::point(f64::MAX);

    /// The number itself.
    fn from_f64(value: f64) -> Self {
        Self::point(value)
    }

    /// The middle.
    fn to_f64(self) -> f64 {
        self.lower + 0.5 * (self.upper - self.lower)
    }

    /// Of what is not negative.
    fn sqrt(self) -> Self {
        let root = |x: f64| x.max(0.0).sqrt();
        let lower = root(self.lower);
        Self { lower: if lower > 0.0 { lower.next_down() } else { 0.0 }, upper: root(self.upper).next_up() }
    }

    fn is_finite(self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }

    fn floor_to_i32(self) -> i32 {
        self.lower.floor_to_i32()
    }

    fn canonical_bits(self) -> u64 {
        self.lower.canonical_bits() ^ self.upper.canonical_bits().rotate_left(32)
    }

    fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
        // a table's entries stand for numbers that an f64 rounds
        C::VALUES.get(row)?.get(i).map(|&entry| Self::point(entry).widened())
    }

    /// Whether it may be above 0.
    fn is_above_zero(self) -> bool {
        self > <Self as Arithmetic>::ZERO
    }

    fn abs(self) -> Self {
        if self.lower >= 0.0 {
            self
        } else if self.upper <= 0.0 {
            -self
        } else {
            Self { lower: 0.0, upper: self.upper.max(-self.lower) }
        }
    }

    fn min(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.min(other.upper) }
    }

    fn max(self, other: Self) -> Self {
        Self { lower: self.lower.max(other.lower), upper: self.upper.max(other.upper) }
    }
}

impl Accumulator<Self> for Interval {
    const ZERO: Self = Self::point(0.0);

    fn add(&mut self, term: Self) {
        *self += term;
    }

    fn total(self) -> Self {
        self
    }
}

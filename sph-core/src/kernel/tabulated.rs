//! A kernel by a table in q², for processors where a square root costs more than all the rest.
//!
//! ```text
//! f(q)     ≈ a_i + (a_{i+1} − a_i) t      i + t = 16 n q² for q < 1/4, n q² from there on      n = N − 1 intervals
//! f′(q)/q  ≈ the same from a table of its own, so that ∇W = σ_D h^{-D-2} x f′(q)/q needs no division either
//! ```
//!
//! The first quarter of the support is divided 16 times as finely, because f′(q)/q has a term linear in q for most kernels:
//! as a function of q² it ends in a root. The tables are computed when the program is compiled and kept in the scalar.
//!
//! # Errors measured
//!
//! Largest distance from the kernel on [0, 1] in two and three dimensions, of f in units of f(0) and of f′ in units of its
//! largest value; f32 and f64 agree in the figures given, and one dimension is better:
//!
//! | kernel | N | f | f′ | bytes of both tables in f32 |
//! |---|---|---|---|---|
//! | [`WendlandC2`](super::WendlandC2) | 17 | 1.2 % | 3.5 % | 272 |
//! | | 33 | 0.35 % | 1.1 % | 528 |
//! | | 65 | 0.094 % | 0.42 % | 1040 |
//! | | 129 | 0.025 % | 0.21 % | 2064 |
//! | | 257 | 0.0064 % | 0.11 % | 4112 |
//! | [`WendlandC4`](super::WendlandC4) | 65 | 0.13 % | 0.28 % | 1040 |
//! | [`WendlandC6`](super::WendlandC6) | 65 | 0.17 % | 0.35 % | 1040 |
//! | [`CubicSpline`](super::CubicSpline) | 65 | 0.052 % | 0.13 % | 1040 |
//! | [`QuarticSpline`](super::QuarticSpline) | 65 | 0.086 % | 0.14 % | 1040 |
//! | [`QuinticSpline`](super::QuinticSpline) | 65 | 0.12 % | 0.17 % | 1040 |
//!
//! A chord lies above a convex function, so a density is about 0.1 % too large with N = 65. Entries are rounded to the
//! scalar once: `I16F16` adds a tenth to the errors above, `I4F12` makes 0.15 % and 0.74 % of Wendland C2's with N = 65.

use super::{Kernel, Term};
use crate::scalar::Table;
use crate::{Arithmetic, Scalar};
use core::marker::PhantomData;

/// K by tables in q² with N = 2^b + 1 nodes each, b ≤ 8; formula and errors in the [module](self).
///
/// K must list its [`Term`]s and be smooth at q = 0, or the program does not compile: [`Spiky`](super::Spiky) is not.
/// `profile` and `slope`, which are asked for q, are K's own, and so is the normalisation.
///
/// ```
/// use sph_core::kernel::{Tabulated, WendlandC2};
/// use sph_core::{Influence, KernelInfluence};
///
/// let exact = KernelInfluence::<f32, 2, WendlandC2>::new(0.1)?;
/// let table = KernelInfluence::<f32, 2, Tabulated<WendlandC2, 65>>::new(0.1)?;
/// assert_eq!(Tabulated::<WendlandC2, 65>::bytes::<f32>(), 1040); // of flash, if both tables are used
/// let x = [0.03, 0.04];
/// assert!((table.influence_at(&x) / exact.influence_at(&x) - 1.0).abs() < 0.002);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Tabulated<K, const N: usize>(PhantomData<K>);

/// How much finer the first quarter of the support is divided, as a power of two: 1/4² of q².
const FINER: u32 = 4;

/// The profile of the form for D dimensions: the fine table, then the coarse one.
struct Profile<K, const D: usize>(PhantomData<K>);
/// f′(q)/q over 2^[`exponent`], likewise.
struct SlopeByQ<K, const D: usize>(PhantomData<K>);

impl<K: Kernel, const D: usize, const N: usize> Table<2, N> for Profile<K, D> {
    const VALUES: [[f64; N]; 2] = {
        let mut values = [[0.0; N]; 2];
        let mut i = 0;
        while i < 2 * N {
            values[i / N][i % N] = profile(terms::<K, D>(), root(node::<N>(i)));
            i += 1;
        }
        values
    };
}

impl<K: Kernel, const D: usize, const N: usize> Table<2, N> for SlopeByQ<K, D> {
    const VALUES: [[f64; N]; 2] = {
        let scale = (1_u64 << exponent(terms::<K, D>())) as f64;
        let mut values = [[0.0; N]; 2];
        let mut i = 0;
        while i < 2 * N {
            values[i / N][i % N] = slope_by_q(terms::<K, D>(), root(node::<N>(i))) / scale;
            i += 1;
        }
        values
    };
}

/// The terms of the form that K has in D dimensions.
const fn terms<K: Kernel, const D: usize>() -> &'static [Term] {
    let terms = if D == 1 { K::TERMS_IN_1D } else { K::TERMS };
    assert!(!terms.is_empty(), "a kernel without terms has no table");
    terms
}

/// q² at node i of both tables, one behind the other.
const fn node<const N: usize>(i: usize) -> f64 {
    let q_squared = (i % N) as f64 / (N - 1) as f64;
    if i < N { q_squared / (1 << FINER) as f64 } else { q_squared }
}

/// √x for 0 ≤ x ≤ 1 by Newton's method from above.
const fn root(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let mut root = 1.0;
    let mut steps = 0;
    while steps < 40 {
        root = (root + x / root) / 2.0;
        steps += 1;
    }
    root
}

/// x^n, and 0 for n < 0, which stands for a derivative that vanishes.
const fn power(x: f64, n: i32) -> f64 {
    let mut power = if n < 0 { 0.0 } else { 1.0 };
    let mut i = 0;
    while i < n {
        power *= x;
        i += 1;
    }
    power
}

/// f(q)
const fn profile(terms: &[Term], q: f64) -> f64 {
    let mut sum = 0.0;
    let mut i = 0;
    while i < terms.len() {
        let Term { coefficient, edge, power: k, degree: j } = terms[i];
        if q < edge {
            sum += coefficient * power(edge - q, k as i32) * power(q, j);
        }
        i += 1;
    }
    sum
}

/// f′(q)/q, and f″(0) for q = 0.
const fn slope_by_q(terms: &[Term], q: f64) -> f64 {
    let mut tip = 0.0;
    let mut sum = 0.0;
    let mut i = 0;
    while i < terms.len() {
        let Term { coefficient: c, edge: a, power: k, degree: j } = terms[i];
        assert!(j >= 0, "a kernel that diverges at q = 0 has no table");
        let k = k as i32;
        if j == 0 {
            tip -= c * k as f64 * power(a, k - 1);
        } else if j == 1 {
            tip += c * power(a, k);
        }
        if q > 0.0 && q < a {
            let outer = -(k as f64) * power(a - q, k - 1) * power(q, j);
            sum += c * (outer + j as f64 * power(a - q, k) * power(q, j - 1)) / q;
        } else if q == 0.0 && j == 0 {
            sum += c * (k * (k - 1)) as f64 * power(a, k - 2);
        } else if q == 0.0 && j == 1 {
            sum -= c * (2 * k) as f64 * power(a, k - 1);
        } else if q == 0.0 && j == 2 {
            sum += c * 2.0 * power(a, k);
        }
        i += 1;
    }
    assert!(tip < 1e-9 && tip > -1e-9, "a kernel with a tip at q = 0 has no table");
    sum
}

/// The exponent of the smallest power of two that is not below −f″(0), the largest |f′(q)/q|.
const fn exponent(terms: &[Term]) -> u32 {
    let mut exponent = 0;
    while -slope_by_q(terms, 0.0) > (1_u64 << exponent) as f64 {
        exponent += 1;
    }
    exponent
}

/// A place between two nodes of a table: its row, the first node's number and the distance from it.
#[derive(Clone, Copy)]
struct Place<T> {
    row: usize,
    node: usize,
    t: T,
}

impl<T: Scalar> Place<T> {
    #[inline(always)]
    fn of(q_squared: T, bits: u32) -> Self {
        let fine = q_squared < T::ratio(1, 1 << FINER);
        let (node, t) = q_squared.split(if fine { bits + FINER } else { bits });
        Self { row: usize::from(!fine), node, t }
    }

    /// The table's value here, zero beyond its end.
    #[inline(always)]
    fn look_up<C: Table<2, N>, const N: usize>(self) -> T {
        if self.node >= N - 1 {
            return T::ZERO;
        }
        let at = |node| T::constant::<C, 2, N>(self.row, node).unwrap_or(T::ZERO);
        let here = at(self.node);
        here + (at(self.node + 1) - here) * self.t
    }
}

impl<K: Kernel, const N: usize> Tabulated<K, N> {
    /// The number of intervals as a power of two.
    const BITS: u32 = {
        assert!(N > 2 && (N - 1).is_power_of_two() && N <= 257, "a table has 2^b + 1 nodes, b from 1 to 8");
        (N - 1).trailing_zeros()
    };

    /// The bytes of flash that the tables take in a scalar, if both profile and slope are used.
    pub const fn bytes<T>() -> usize {
        4 * N * size_of::<T>()
    }

    #[inline(always)]
    fn profile_at<T: Scalar, const D: usize>(place: Place<T>) -> T {
        place.look_up::<Profile<K, D>, N>()
    }

    #[inline(always)]
    fn slope_at<T: Scalar, const D: usize>(place: Place<T>, u: &[T; D]) -> [T; D] {
        let slope = place.look_up::<SlopeByQ<K, D>, N>();
        let scale = const { 1 << exponent(terms::<K, D>()) };
        u.map(|component| (component * slope).times(scale))
    }
}

impl<K: Kernel, const N: usize> Kernel for Tabulated<K, N> {
    const SUPPORT_RATIO: (i32, i32) = K::SUPPORT_RATIO;
    const TERMS: &'static [Term] = K::TERMS;
    const TERMS_IN_1D: &'static [Term] = K::TERMS_IN_1D;
    const SINGULAR: bool = K::SINGULAR;
    const RAW_POWER: u32 = K::RAW_POWER;

    #[inline(always)]
    fn profile<T: Arithmetic>(q: T) -> T {
        K::profile(q)
    }

    #[inline(always)]
    fn slope<T: Arithmetic>(q: T) -> T {
        K::slope(q)
    }

    #[inline(always)]
    fn profile_in_1d<T: Arithmetic>(q: T) -> T {
        K::profile_in_1d(q)
    }

    #[inline(always)]
    fn slope_in_1d<T: Arithmetic>(q: T) -> T {
        K::slope_in_1d(q)
    }

    #[inline(always)]
    fn profile_of_square<T: Scalar, const D: usize>(s: T) -> T {
        Self::profile_at::<T, D>(Place::of(s, Self::BITS))
    }

    #[inline(always)]
    fn slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> [T; D] {
        Self::slope_at(Place::of(s, Self::BITS), u)
    }

    #[inline(always)]
    fn profile_and_slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> (T, [T; D]) {
        let place = Place::of(s, Self::BITS);
        (Self::profile_at::<T, D>(place), Self::slope_at(place, u))
    }
}

//! The laws that every kernel obeys, in any scalar: run them on a kernel of your own in its tests.
//!
//! On [0, 1] and beyond it: f ≥ 0; f = f′ = 0 at and beyond q = 1 (Def. 1.1); f continuous; f′ ≤ 0; f′ equal to the central
//! difference of f (Thm 4.1); `profile_of_square` and `slope_vector` agree with both; the moments of the listed
//! [`Term`](super::Term)s equal quadrature.

use super::{Kernel, moment, radial_moment};
use crate::{Scalar, difference};

/// A law that a kernel can break.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Law {
    /// f(q) ≥ 0
    NonNegative,
    /// f(q) = 0 and f′(q) = 0 for q ≥ 1
    CompactSupport,
    /// f has no jump: from one place looked at to the next, 1/240 on, it moves as |f′| ≤ 4 allows, and at the end of the
    /// support as f(1) = f′(1) = 0 and f″ ≤ 48 allow
    Continuous,
    /// f′(q) ≤ 0, to a few roundings
    NonIncreasing,
    /// f′(q) is the limit of the central difference of f
    Slope,
    /// `profile_of_square` and `slope_vector` give f(q) and f′(q) x̂
    Agreement,
    /// the terms listed have the moments of the profile
    Moments,
}

/// Which law is broken, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Violation {
    /// The law.
    pub law: Law,
    /// The dimension whose form of the kernel breaks it.
    pub dim: u32,
    /// The q where it does.
    pub q: f64,
}

/// Checks every law for K in the scalar T, for the forms of one and of more dimensions.
///
/// # Errors
/// The first law found broken.
///
/// ```
/// use sph_core::kernel::{CubicSpline, conformance};
/// assert_eq!(conformance::check::<CubicSpline, f64>(), Ok(()));
/// ```
pub fn check<K: Kernel, T: Scalar>() -> Result<(), Violation> {
    check_form::<K, T, 1>()?;
    check_form::<K, T, 2>()?;
    check_form::<K, T, 3>()
}

const SAMPLES: i32 = 240;

fn check_form<K: Kernel, T: Scalar, const D: usize>() -> Result<(), Violation> {
    let (profile, slope) = (profile::<K, T, D>, slope::<K, T, D>);
    let step = difference::relative_step::<T>(1);
    let tolerance = slope_tolerance::<T>(step);
    for i in (SAMPLES..=SAMPLES * 3 / 2).chain(0..SAMPLES) {
        let q = T::ratio(i, SAMPLES);
        let law = |law, holds: bool| {
            if holds { Ok(()) } else { Err(Violation { law, dim: D as u32, q: q.to_f64() }) }
        };
        let value = profile(q);
        if i >= SAMPLES {
            law(Law::CompactSupport, value == T::ZERO && slope(T::ONE) == T::ZERO)?;
            continue;
        }
        law(Law::NonNegative, value >= T::ZERO)?;
        law(Law::NonIncreasing, slope(q) <= T::EPSILON.times(32))?;
        let jump = (profile(T::ratio(i + 1, SAMPLES)) - value).abs();
        law(Law::Continuous, jump <= largest_move(i))?;
        if q > step.times(2) {
            let difference = difference::nth(profile, 1, q, step);
            law(Law::Slope, (difference - slope(q)).abs() <= tolerance)?;
            law(Law::Agreement, agrees::<K, T, D>(q, value, slope(q)))?;
        }
    }
    check_moments::<K>(D as u32)
}

/// f of the form for D dimensions, as one function: a check asks for it in many places.
#[inline(never)]
fn profile<K: Kernel, T: Scalar, const D: usize>(q: T) -> T {
    if D == 1 { K::profile_in_1d(q) } else { K::profile(q) }
}

/// f′, likewise.
#[inline(never)]
fn slope<K: Kernel, T: Scalar, const D: usize>(q: T) -> T {
    if D == 1 { K::slope_in_1d(q) } else { K::slope(q) }
}

/// How far f may move from the i-th sample to the next.
fn largest_move<T: Scalar>(i: i32) -> T {
    let spacing = T::ratio(1, SAMPLES);
    if i + 1 < SAMPLES { spacing.times(4) } else { (spacing * spacing).times(24) + T::EPSILON.times(8) }
}

/// Truncation of the central difference, f‴ < 400 for the kernels here, and a few roundings of f over the step.
fn slope_tolerance<T: Scalar>(step: T) -> T {
    (step * step).times(70) + T::EPSILON.times(4) / step
}

fn agrees<K: Kernel, T: Scalar, const D: usize>(q: T, profile: T, slope: T) -> bool {
    let mut u = [T::ZERO; D];
    u[D - 1] = q;
    let square = q * q;
    // what the scalar's root is off moves f as f′ ≤ 4, f′ as f″ ≤ 24, and the direction u / q
    let off = (square.sqrt() - q).abs();
    let tolerance = T::EPSILON.times(128) + off.times(24) + (off / q).times(4);
    let vector = K::slope_vector(&u, square);
    let (both_profile, both_slope) = K::profile_and_slope_vector(&u, square);
    let along = vector.get(D - 1).is_some_and(|&component| (component - slope).abs() <= tolerance);
    let across = vector.iter().take(D - 1).all(|&component| component == T::ZERO);
    (K::profile_of_square::<T, D>(square) - profile).abs() <= tolerance
        && along
        && across
        && (both_profile - profile).abs() <= tolerance
        && both_slope == vector
}

fn check_moments<K: Kernel>(dim: u32) -> Result<(), Violation> {
    for n in dim..dim + 3 {
        let quadrature = moment::moment_by_quadrature::<K>(dim, n);
        let relative = radial_moment::<K>(dim, n) / quadrature - 1.0;
        if !(-1e-12..=1e-12).contains(&relative) {
            return Err(Violation { law: Law::Moments, dim, q: 0.0 });
        }
    }
    Ok(())
}

/// σ_D against the closed forms of the literature for D = 1 …, to a relative 1e-14.
#[cfg(test)]
pub(crate) fn check_normalisation<K: Kernel>(literature: &[f64; 4]) {
    for (dim, sigma) in (1..).zip(literature) {
        let relative = (super::normalisation::<K>(dim) / sigma - 1.0).abs();
        assert!(relative <= 1e-14, "D = {dim}: off by {relative:e}");
    }
}

//! The influence of a [`Kernel`].

use core::marker::PhantomData;

use super::{Influence, volume};
use crate::kernel::{Constants, Kernel};
use crate::vector::scale;
use crate::{Error, Parameter, Scalar, ball, check};

/// Ω(D, h) of the kernel K: owns h, the constant σ_D h^{-D} and the case r = 0 (Def. 2.3).
///
/// ```
/// use sph_core::{Influence, KernelInfluence, kernel::CubicSpline};
///
/// let w = KernelInfluence::<f32, 2, CubicSpline>::new(0.5)?;
/// assert_eq!(w.influence_at(&[0.5, 0.0]), 0.0);
/// assert_eq!(w.gradient_at(&[0.0, 0.0]), [0.0, 0.0]);
/// assert!(w.gradient_at(&[0.2, 0.0])[0] < 0.0); // Ω falls away from the sample
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct KernelInfluence<T, const D: usize, K> {
    support_radius: T,
    inverse_radius: T,
    inverse_square: T,
    normalisation: T,
    kernel: PhantomData<K>,
}

impl<T: Scalar, const D: usize, K: Kernel> KernelInfluence<T, D, K> {
    /// Ω with ∫ Ω d^Dx = 1 for support radius h.
    ///
    /// # Errors
    /// [`Error::SingularKernel`] for a kernel that diverges at r = 0; [`Error::NotFinite`] or [`Error::NotPositive`] for such
    /// an h; [`Error::NotRepresentable`] where h^{-2} or σ_D h^{-D} is out of the scalar's range.
    pub fn new(support_radius: T) -> Result<Self, Error> {
        Self::with_constant(support_radius, |inverse| {
            ball::constant_times(Constants::<K, D>::normalisation(), ball::power::<T, D>(inverse))
        })
    }

    /// Ω for the field's other custom, the smoothing length: h = `smoothing_length` · [`Kernel::SUPPORT_RATIO`].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_smoothing_length(smoothing_length: T) -> Result<Self, Error> {
        let (numerator, denominator) = K::SUPPORT_RATIO;
        Self::new(smoothing_length * T::ratio(numerator, denominator))
    }

    /// Ω as the paper prints it, V = ∫₀ʰ B(D, r) ω dr: ∫ Ω d^Dx ≠ 1, see the [erratum](super).
    ///
    /// ```
    /// use sph_core::{KernelInfluence, kernel::Poly6};
    /// let printed = KernelInfluence::<f64, 3, Poly6>::with_printed_volume(2.0)?;
    /// // V = π h¹⁰ / 30 for ω = (h² − r²)³, hence Ω(0) = h⁶ / V
    /// assert!((printed.normalisation() - 64.0 * 30.0 / (core::f64::consts::PI * 1024.0)).abs() < 1e-14);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_printed_volume(support_radius: T) -> Result<Self, Error> {
        let unit = 1.0 / volume::printed::<K>(D as u32, 1.0);
        Self::with_constant(support_radius, |inverse| {
            ball::constant_times(unit, ball::power::<T, D>(inverse) * inverse)
        })
    }

    fn with_constant(support_radius: T, constant: impl Fn(T) -> T) -> Result<Self, Error> {
        if K::SINGULAR {
            return Err(Error::SingularKernel);
        }
        check::positive(support_radius, Parameter::SupportRadius, 0)?;
        let inverse_radius = T::ONE / support_radius;
        let inverse_square = inverse_radius * inverse_radius;
        let normalisation = constant(inverse_radius);
        check::representable(inverse_square, Parameter::SupportRadius)?;
        check::representable(normalisation, Parameter::Normalisation)?;
        Ok(Self { support_radius, inverse_radius, inverse_square, normalisation, kernel: PhantomData })
    }

    /// σ_D h^{-D} (or what V the constructor was asked for), units L^{-D}.
    pub fn normalisation(&self) -> T {
        self.normalisation
    }

    /// Checks that the steepest ∇Ω, at the q where |f′| is largest, is in the scalar's range.
    ///
    /// A density does not need it, so [`new`](Self::new) does not ask for it. In a narrow type call this once before gradients
    /// are summed: a term that is clamped, or wraps, is not seen in a sum.
    ///
    /// # Errors
    /// [`Error::NotRepresentable`] with [`Parameter::Value`].
    ///
    /// ```
    /// # #[cfg(feature = "fixed")] {
    /// use sph_core::{Arithmetic, KernelInfluence, kernel::{WendlandC2, WendlandC6}};
    /// use sph_core::scalar::fixed::{I4F12, Saturating};
    /// type T = Saturating<I4F12>; // ends at 8
    /// let c2 = KernelInfluence::<T, 2, WendlandC2>::new(T::ONE).unwrap();
    /// let c6 = KernelInfluence::<T, 2, WendlandC6>::new(T::ONE).unwrap();
    /// assert!(c2.check_gradient().is_ok() && c6.check_gradient().is_err());
    /// # }
    /// ```
    pub fn check_gradient(&self) -> Result<(), Error> {
        const STEPS: i32 = 64;
        let scale = self.normalisation.to_f64() * self.inverse_radius.to_f64();
        for i in 1..STEPS {
            let q = f64::from(i) / f64::from(STEPS);
            let slope = if D == 1 { K::slope_in_1d(q) } else { K::slope(q) };
            if -slope * scale >= T::MAX.to_f64() {
                return Err(Error::NotRepresentable { parameter: Parameter::Value });
            }
        }
        Ok(())
    }

    /// s = r² / h²
    #[inline(always)]
    fn square(&self, distance_squared: T) -> T {
        distance_squared * self.inverse_square
    }
}

impl<T: Scalar, const D: usize, K: Kernel> Influence<T, D> for KernelInfluence<T, D, K> {
    #[inline(always)]
    fn support_radius(&self) -> T {
        self.support_radius
    }

    #[inline(always)]
    fn influence(&self, distance_squared: T) -> T {
        self.normalisation * self.shape(distance_squared)
    }

    /// f(r/h)
    #[inline(always)]
    fn shape(&self, distance_squared: T) -> T {
        K::profile_of_square::<T, D>(self.square(distance_squared))
    }

    /// σ_D h^{-D}
    #[inline(always)]
    fn constant(&self) -> T {
        self.normalisation
    }

    #[inline(always)]
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        let u = scale(x, self.inverse_radius);
        let slope = K::slope_vector(&u, self.square(distance_squared));
        slope.map(|component| component * self.normalisation * self.inverse_radius)
    }

    #[inline(always)]
    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        let u = scale(x, self.inverse_radius);
        let (profile, slope) = K::profile_and_slope_vector(&u, self.square(distance_squared));
        let gradient = slope.map(|component| component * self.normalisation * self.inverse_radius);
        (self.normalisation * profile, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{CubicSpline, Poly6, Spiky, WendlandC2};

    #[test]
    fn refuses_what_is_no_radius() {
        let new = KernelInfluence::<f64, 3, CubicSpline>::new;
        let parameter = Parameter::SupportRadius;
        for h in [0.0, -0.0, -1.0] {
            assert_eq!(new(h).unwrap_err(), Error::NotPositive { parameter, index: 0 });
        }
        for h in [f64::NAN, f64::INFINITY] {
            assert_eq!(new(h).unwrap_err(), Error::NotFinite { parameter, index: 0 });
        }
        assert!(matches!(new(1e-200), Err(Error::NotRepresentable { .. })));
        assert!(matches!(new(1e200), Err(Error::NotRepresentable { .. })));
    }

    #[test]
    fn small_supports_keep_their_precision_in_f32() {
        // h⁹ of the raw poly6 form would underflow here.
        let w = KernelInfluence::<f32, 3, Poly6>::new(1e-5).unwrap();
        let unit = KernelInfluence::<f64, 3, Poly6>::new(1.0).unwrap();
        let ratio = f64::from(w.influence_at(&[3e-6, 0.0, 0.0])) / unit.influence_at(&[0.3, 0.0, 0.0]) / 1e15;
        assert!((ratio - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_support_is_a_property_of_the_value_not_of_the_type() {
        let [narrow, wide] = [1.0, 3.0].map(|h| KernelInfluence::<f64, 2, Spiky>::new(h).unwrap());
        assert_eq!(narrow.influence_at(&[1.0, 0.5]), 0.0);
        assert!(wide.influence_at(&[1.0, 0.5]) > 0.0);
    }

    #[test]
    fn is_zero_far_away_where_squares_overflow() {
        let w = KernelInfluence::<f32, 3, WendlandC2>::new(1.0).unwrap();
        assert_eq!(w.influence_at(&[1e30, 0.0, 0.0]), 0.0);
        assert_eq!(w.gradient_at(&[1e15, 0.0, 0.0]), [0.0; 3]);
    }

    #[test]
    fn smoothing_length_is_half_the_support_of_the_cubic_spline() {
        let by_length = KernelInfluence::<f64, 3, CubicSpline>::from_smoothing_length(0.5).unwrap();
        assert_eq!(by_length.support_radius(), 1.0);
    }
}

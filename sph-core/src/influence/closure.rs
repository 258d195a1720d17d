//! An influence from a closure ω(h, r) (Def. 1.1).

use super::Influence;
use crate::vector::scale;
use crate::{Error, Parameter, Scalar, ball, check, difference, quadrature};

/// Ω from a user's raw kernel ω(h, r): V(D, h) by quadrature over shells, ∂ω/∂r by central difference (Thm 4.1).
///
/// ω is asked for 0 ≤ r ≤ h alone, and taken as zero beyond. It need not be normalised.
///
/// ```
/// use sph_core::{ClosureInfluence, Influence, KernelInfluence, kernel::Poly6};
///
/// let by_hand = ClosureInfluence::<f64, 3, _>::new(1.5, |h, r| { let s = h * h - r * r; s * s * s })?;
/// let poly6 = KernelInfluence::<f64, 3, Poly6>::new(1.5)?;
/// let x = [0.3, -0.4, 0.5];
/// assert!((by_hand.influence_at(&x) / poly6.influence_at(&x) - 1.0).abs() < 1e-13);
/// assert!((by_hand.gradient_at(&x)[0] / poly6.gradient_at(&x)[0] - 1.0).abs() < 1e-8);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ClosureInfluence<T, const D: usize, F> {
    support_radius: T,
    inverse_volume: T,
    step: T,
    raw: F,
}

impl<T: Scalar, const D: usize, F: Fn(T, T) -> T> ClosureInfluence<T, D, F> {
    /// Ω = ω(h, r) / V(D, h) with V = ∫₀ʰ S_D r^{D−1} ω dr.
    ///
    /// # Errors
    /// [`Error::NotFinite`] or [`Error::NotPositive`] for such an h; [`Error::NotRepresentable`] where V or 1 / V is not
    /// finite and positive in the scalar.
    pub fn new(support_radius: T, raw: F) -> Result<Self, Error> {
        check::positive(support_radius, Parameter::SupportRadius, 0)?;
        let surface = const { ball::unit_surface(D as u32) };
        let shell = |r: T| (1..D).fold(raw(support_radius, r), |product, _| product * r);
        let volume = ball::constant_times(surface, quadrature::integrate(shell, T::ZERO, support_radius));
        check::representable(volume, Parameter::Normalisation)?;
        let inverse_volume = T::ONE / volume;
        check::representable(inverse_volume, Parameter::Normalisation)?;
        let step = support_radius * difference::relative_step(1);
        Ok(Self { support_radius, inverse_volume, step, raw })
    }

    /// ω(h, r) / V, zero beyond h; r < 0 is taken as −r.
    fn along_radius(&self, r: T) -> T {
        let r = r.abs();
        if r < self.support_radius {
            (self.raw)(self.support_radius, r) * self.inverse_volume
        } else {
            T::ZERO
        }
    }
}

impl<T: Scalar, const D: usize, F: Fn(T, T) -> T> Influence<T, D> for ClosureInfluence<T, D, F> {
    fn support_radius(&self) -> T {
        self.support_radius
    }

    fn influence(&self, distance_squared: T) -> T {
        self.along_radius(distance_squared.sqrt())
    }

    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        let r = distance_squared.sqrt();
        if r == T::ZERO || r >= self.support_radius {
            return [T::ZERO; D];
        }
        let slope = difference::nth(|r| self.along_radius(r), 1, r, self.step);
        scale(&x.map(|component| component / r), slope)
    }
}

/// All but the closure.
#[cfg(feature = "defmt")]
impl<T: defmt::Format, const D: usize, F> defmt::Format for ClosureInfluence<T, D, F> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let Self { support_radius, inverse_volume, .. } = self;
        defmt::write!(f, "ClosureInfluence of support radius {}, 1/V {}", support_radius, inverse_volume);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::KernelInfluence;
    use crate::kernel::{CubicSpline, Kernel};

    #[test]
    fn a_closure_of_a_spline_equals_the_spline_in_every_dimension() {
        fn compare<const D: usize>() {
            let h = 0.8;
            let closure = ClosureInfluence::<f64, D, _>::new(h, CubicSpline::raw).unwrap();
            let kernel = KernelInfluence::<f64, D, CubicSpline>::new(h).unwrap();
            for i in 0..=20 {
                let mut x = [0.0; D];
                x[D - 1] = -h * i as f64 / 19.0;
                let scale = kernel.influence(0.0);
                assert!((closure.influence_at(&x) - kernel.influence_at(&x)).abs() <= 1e-13 * scale);
                let (found, expected) = (closure.gradient_at(&x), kernel.gradient_at(&x));
                assert!((found[D - 1] - expected[D - 1]).abs() <= 1e-8 * scale / h, "D = {D}, i = {i}");
            }
        }
        compare::<1>();
        compare::<2>();
        compare::<3>();
        compare::<4>();
    }

    #[test]
    fn a_kernel_that_vanishes_is_refused() {
        let refused = ClosureInfluence::<f32, 2, _>::new(1.0, |_, _| 0.0);
        assert_eq!(refused.err(), Some(Error::NotRepresentable { parameter: Parameter::Normalisation }));
    }
}

//! ρ(x) = Σ m_j W(x − x_j), the sample itself included (Thm 3.2), and V_j = m_j / ρ_j.
//!
//! ρ and ∇ρ are the moments of Shepard's form, with masses in place of volumes.

use super::ShepardWithGradient;
use crate::samples::check_length;
use crate::{
    Accumulator, Error, Influence, InfluenceOf, Neighbours, Parameter, PerSample, Scalar, Sources, Uniform,
    check,
};

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>> Sources<T, D, N, M> {
    /// ρ(x) = Σ m_j W(x − x_j), units M L^{-D}. With volumes as weights it is Σ V_j W, near 1 inside the samples.
    pub fn density_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> T {
        // a loop of its own: through the moments of an estimate a pair costs up to 3 instructions more in fixed point
        let mut sum = T::Sum::ZERO;
        self.for_each(w, x, |neighbour, mass, influence| {
            sum.add(mass * influence.influence(neighbour.distance_squared));
        });
        sum.total()
    }

    /// ρ(x) and ∇ρ(x) = Σ m_j ∇W(x − x_j), units M L^{-D} and M L^{-D-1}.
    pub fn density_gradient_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> (T, [T; D]) {
        self.moments_at::<ShepardWithGradient>(w, x)
    }

    /// ρ_i at every sample, written to `density`.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless `density` has one place for each sample.
    ///
    /// ```
    /// use sph_core::{BruteForce, KernelInfluence, Sources, kernel::Poly6};
    /// let sources = Sources::new(BruteForce::new(&[[0.0_f32, 0.0], [9.0, 0.0]])?, &[2.0, 1.0])?;
    /// let w = KernelInfluence::<f32, 2, Poly6>::new(1.0)?;
    /// let mut density = [0.0; 2];
    /// sources.density(&w, &mut density)?;
    /// assert_eq!(density[0], 2.0 * w.normalisation());
    /// assert_eq!(density[1], w.normalisation());
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn density(&self, w: impl InfluenceOf<T, D>, density: &mut [T]) -> Result<(), Error> {
        check::length(density.len(), self.positions().len(), Parameter::Output)?;
        for (out, x) in density.iter_mut().zip(self.positions()) {
            *out = self.density_at(w, x);
        }
        Ok(())
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>> Sources<T, D, N, Uniform<T>> {
    /// ρ(x) = m σ_D h^{-D} Σ f(|x − x_j|/h): [`density_at`](Self::density_at) for equal masses and one kernel, with what all
    /// terms share outside the sum, so that a pair costs two multiplications less. Rounded otherwise. As there, only ρ has to be
    /// in the scalar's range: the bare sum, 1 / (m σ_D h^{-D}) for a density of 1, may leave it.
    ///
    /// ```
    /// use sph_core::{BruteForce, KernelInfluence, Sources, Uniform, kernel::Poly6};
    /// let positions = [[0.0_f32, 0.0], [0.3, 0.0], [0.0, 0.4]];
    /// let sources = Sources::new(BruteForce::open(&positions)?, Uniform(0.2))?;
    /// let w = KernelInfluence::<f32, 2, Poly6>::new(1.0)?;
    /// let (fast, plain) = (sources.equal_density_at(&w, &[0.1, 0.1]), sources.density_at(&w, &[0.1, 0.1]));
    /// assert!((fast - plain).abs() <= 4.0 * f32::EPSILON * plain);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn equal_density_at<W: Influence<T, D>>(&self, w: &W, x: &[T; D]) -> T {
        let mut sum = T::Sum::ZERO;
        self.for_each(w, x, |neighbour, _, influence| sum.add(influence.shape(neighbour.distance_squared)));
        sum.scaled_total(self.weights().0, w.constant())
    }
}

/// V_j = m_j / ρ_j, units L^D: the weights of a [`Field`](super::Field).
///
/// # Errors
/// [`Error::LengthMismatch`] unless all three have one length; [`Error::NotFinite`] or [`Error::NotPositive`] with the index of
/// a density that is not so.
///
/// ```
/// let mut volumes = [0.0; 2];
/// sph_core::field::volumes(&[2.0, 3.0], &[4.0, 1.0], &mut volumes)?;
/// assert_eq!(volumes, [0.5, 3.0]);
/// # Ok::<(), sph_core::Error>(())
/// ```
pub fn volumes<T: Scalar>(masses: impl PerSample<T>, density: &[T], volumes: &mut [T]) -> Result<(), Error> {
    check_length(&masses, density.len(), Parameter::Mass)?;
    check::length(volumes.len(), density.len(), Parameter::Output)?;
    for (j, (volume, &density)) in volumes.iter_mut().zip(density).enumerate() {
        check::positive(density, Parameter::Density, j)?;
        *volume = masses.get(j).unwrap_or(T::ZERO) / density;
        check::representable(*volume, Parameter::Volume)?;
    }
    Ok(())
}

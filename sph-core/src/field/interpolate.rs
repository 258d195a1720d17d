//! A(x) = Σ V_j A_j W(x − x_j) (Def. 3.1), V_j = m_j / ρ_j.

use super::{Estimate, Field, Quantity, Reads, Term};
use crate::{InfluenceOf, Lane, Neighbours, PerSample, Scalar};

/// A(x) = Σ V_j A_j W(x − x_j), in the unit of A.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl<T: Scalar, const D: usize> Estimate<T, D> for Plain {
    const READS: Reads = Reads::INFLUENCE;
    type Moments<A: Lane<T>> = ();
    type Sums<A: Lane<T>> = A;
    type Basis = ();

    #[inline(always)]
    fn add_moments<A: Lane<T>>((): &mut (), _: &impl Term<A, D>) {}

    #[inline(always)]
    fn add<A: Lane<T>>(sum: &mut A::Sum, term: &impl Term<A, D>, value: A) {
        (value * (term.weight() * term.influence())).add_to(sum);
    }

    #[inline(always)]
    fn basis((): (), _: T) -> Option<()> {
        Some(())
    }

    #[inline(always)]
    fn finish((): &(), value: T) -> Option<(T, [T; D])> {
        Some((value, [T::ZERO; D]))
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// A(x) in the unit of A, for scalar or vector values; zero where no sample is in reach.
    ///
    /// ```
    /// use sph_core::{BruteForce, Field, KernelInfluence, Sources, Uniform, kernel::CubicSpline};
    /// let positions = [[0.0_f64], [1.0], [2.0], [3.0], [4.0]];
    /// let volumes = Sources::new(BruteForce::new(&positions)?, Uniform(1.0))?;
    /// let velocity = Field::new(&volumes, Uniform([3.0, -1.0]))?;
    /// let w = KernelInfluence::<f64, 1, CubicSpline>::new(2.0)?;
    /// let [u, v] = velocity.interpolate_at(&w, &[2.0]);
    /// assert!((u - 3.0).abs() < 1e-12 && (v + 1.0).abs() < 1e-12);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn interpolate_at<Q: Quantity<T>>(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Q
    where
        V: PerSample<Q>,
    {
        self.value_at::<Plain, Q>(w, x).unwrap_or(Q::ZERO)
    }
}

//! Gradients of a scalar field by the analytic gradient of the kernel (Thm 3.3).
//!
//! ```text
//! plain       ∇A(x) = Σ V_j A_j ∇W(x − x_j)                       the exact gradient of the interpolated field
//! difference  ∇A_i  = Σ V_j (A_j − A_i) ∇W_ij                     zero for constants
//! symmetric   ∇A_i  = ρ_i Σ m_j (A_i/ρ_i² + A_j/ρ_j²) ∇W_ij       pairwise opposite: conserves momentum
//! corrected   ∇A_i  = L_i⁻¹ · difference,  L_i = Σ V_j ∇W_ij ⊗ x_ji    exact for linear A
//! ```
//!
//! Source of the forms at samples: D. J. Price, *Smoothed particle hydrodynamics and magnetohydrodynamics*, J. Comput. Phys.
//! 231 (2012) 759, sects. 2.4 and 4.1.

use super::estimate::One;
use super::{Estimate, Field, Reads, SumOf, Summand, Term, matrix};
use crate::{Influence, InfluenceOf, Lane, Neighbours, PerSample, Scalar};

/// ∇A(x) = Σ V_j A_j ∇W(x − x_j) alone.
#[derive(Clone, Copy, Debug)]
pub struct PlainGradient;

/// A(x) = Σ V_j A_j W(x − x_j) and its gradient.
#[derive(Clone, Copy, Debug)]
pub struct PlainWithGradient;

impl<T: Scalar, const D: usize> Estimate<T, D> for PlainGradient {
    const READS: Reads = Reads::GRADIENT;
    type Moments<A: Lane<T>> = ();
    type Sums<A: Lane<T>> = [A; D];
    type Basis = ();

    #[inline(always)]
    fn add_moments<A: Lane<T>>((): &mut (), _: &impl Term<A, D>) {}

    #[inline(always)]
    fn add<A: Lane<T>>(sums: &mut SumOf<T, A, [A; D]>, term: &impl Term<A, D>, value: A) {
        term.gradient().add_weighted(sums, term.weight() * value);
    }

    #[inline(always)]
    fn basis((): (), _: T) -> Option<()> {
        Some(())
    }

    #[inline(always)]
    fn finish((): &(), gradient: [T; D]) -> Option<(T, [T; D])> {
        Some((T::ZERO, gradient))
    }
}

impl<T: Scalar, const D: usize> Estimate<T, D> for PlainWithGradient {
    const READS: Reads = Reads::BOTH;
    type Moments<A: Lane<T>> = ();
    type Sums<A: Lane<T>> = (A, [A; D]);
    type Basis = ();

    #[inline(always)]
    fn add_moments<A: Lane<T>>((): &mut (), _: &impl Term<A, D>) {}

    #[inline(always)]
    fn add<A: Lane<T>>((values, slopes): &mut SumOf<T, A, Self::Sums<A>>, term: &impl Term<A, D>, value: A) {
        let (influence, gradient) = term.influence_and_gradient();
        (value * (term.weight() * influence)).add_to(values);
        gradient.add_weighted(slopes, term.weight() * value);
    }

    #[inline(always)]
    fn basis((): (), _: T) -> Option<()> {
        Some(())
    }

    #[inline(always)]
    fn finish((): &(), sums: (T, [T; D])) -> Option<(T, [T; D])> {
        Some(sums)
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V: PerSample<T>>
    Field<'_, T, D, N, M, V>
{
    /// ∇A(x) = Σ V_j A_j ∇W(x − x_j), unit of A per L.
    ///
    /// ```
    /// use sph_core::{BruteForce, Field, KernelInfluence, Sources, Uniform, difference, kernel::CubicSpline};
    /// let positions = [[0.0_f64, 0.0], [0.5, 0.1], [0.2, 0.6]];
    /// let volumes = Sources::new(BruteForce::new(&positions)?, Uniform(0.3))?;
    /// let field = Field::new(&volumes, &[1.0, 2.0, 4.0])?;
    /// let w = KernelInfluence::<f64, 2, CubicSpline>::new(1.0)?;
    ///
    /// let analytic = field.gradient_at(&w, &[0.3, 0.3]);
    /// let numeric = difference::gradient(|x| field.interpolate_at(&w, x), &[0.3, 0.3], 1e-5); // Thm 4.1
    /// assert!((analytic[0] - numeric[0]).abs() < 1e-7 && (analytic[1] - numeric[1]).abs() < 1e-7);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn gradient_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> [T; D] {
        self.estimate_at::<PlainGradient>(w, x).map_or([T::ZERO; D], |(_, gradient)| gradient)
    }

    /// A(x) and ∇A(x) in one pass over the neighbours.
    pub fn interpolate_with_gradient_at(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> (T, [T; D]) {
        let mut sums = <(T, [T; D]) as Summand<T>>::EMPTY;
        self.sources.for_each(w, x, |neighbour, weight, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                PlainWithGradient::add(
                    &mut sums,
                    &One { neighbour, weight, influence, reach: T::ZERO },
                    value,
                );
            }
        });
        <(T, [T; D]) as Summand<T>>::total(sums)
    }

    /// Σ V_j (A_j − A_i) ∇W_ij at sample i; `None` where there is no such sample.
    pub fn difference_gradient(&self, w: impl InfluenceOf<T, D>, i: usize) -> Option<[T; D]> {
        let (x, own) = self.sample(i)?;
        let mut sum = <[T; D] as Summand<T>>::EMPTY;
        self.sources.for_each(w, &x, |neighbour, volume, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let slope = influence.gradient(&neighbour.offset, neighbour.distance_squared);
                slope.add_weighted(&mut sum, volume * (value - own));
            }
        });
        Some(<[T; D] as Summand<T>>::total(sum))
    }

    /// ρ_i Σ m_j (A_i/ρ_i² + A_j/ρ_j²) ∇W_ij at sample i, m_j = V_j ρ_j; `None` where there is no such sample or density.
    pub fn symmetric_gradient(
        &self,
        w: impl InfluenceOf<T, D>,
        density: impl PerSample<T>,
        i: usize,
    ) -> Option<[T; D]> {
        let (x, own) = self.sample(i)?;
        let own_density = density.get(i)?;
        let own_term = own / own_density / own_density;
        let mut sum = <[T; D] as Summand<T>>::EMPTY;
        self.sources.for_each(w, &x, |neighbour, volume, influence| {
            if let (Some(value), Some(density)) =
                (self.values.get(neighbour.index), density.get(neighbour.index))
            {
                let slope = influence.gradient(&neighbour.offset, neighbour.distance_squared);
                slope.add_weighted(&mut sum, volume * (own_term * density + value / density));
            }
        });
        Some(<[T; D] as Summand<T>>::total(sum).map(|component| component * own_density))
    }

    /// The difference form corrected to be exact for linear A; `None` where there is no such sample, or where its neighbours
    /// do not span the D directions: L_i has a condition number above 1e8 (f64) or 1e4 (narrower types).
    pub fn corrected_gradient(&self, w: impl InfluenceOf<T, D>, i: usize) -> Option<[T; D]> {
        let (x, own) = self.sample(i)?;
        let mut sum = <[T; D] as Summand<T>>::EMPTY;
        let mut rows = [<[T; D] as Summand<T>>::EMPTY; D];
        self.sources.for_each(w, &x, |neighbour, volume, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let slope = influence.gradient(&neighbour.offset, neighbour.distance_squared);
                slope.add_weighted(&mut sum, volume * (value - own));
                for (row, &component) in rows.iter_mut().zip(&slope) {
                    neighbour.offset.add_weighted(row, -volume * component);
                }
            }
        });
        // ∇W is along x_ij and against it, so L_i is symmetric and positive semidefinite
        let correction = rows.map(<[T; D] as Summand<T>>::total);
        if !matrix::is_well_conditioned(correction) {
            return None;
        }
        matrix::solve(correction, <[T; D] as Summand<T>>::total(sum))
    }
}

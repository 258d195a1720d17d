//! How the value of a field is estimated from its samples, and the sums over them, one sample at a time.

use super::{Field, Quantity, Summand};
use crate::{Influence, InfluenceOf, Lane, Neighbour, Neighbours, PerSample, Scalar, Sources};

/// A sample in reach of a point x, or several side by side in a [`Lane`]: what sums are made of.
pub trait Term<A, const D: usize> {
    /// V_j, units L^D; m_j for a density.
    fn weight(&self) -> A;
    /// W(x − x_j), units L^{-D}.
    fn influence(&self) -> A;
    /// ∇W(x − x_j), units L^{-D-1}.
    fn gradient(&self) -> [A; D];
    /// W(x − x_j) and ∇W(x − x_j) together.
    fn influence_and_gradient(&self) -> (A, [A; D]);
    /// x − x_j, units L.
    fn offset(&self) -> [A; D];
    /// h_j, units L.
    fn support_radius(&self) -> A;
    /// 1 / the largest h_j, units L^{-1}: the same for all terms.
    fn inverse_reach(&self) -> A;
}

/// What an estimate reads of its terms beside the weights, so that a fast path need not prepare the rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reads {
    /// W(x − x_j)
    pub influence: bool,
    /// ∇W(x − x_j)
    pub gradient: bool,
    /// x − x_j
    pub offset: bool,
}

impl Reads {
    /// W alone.
    pub const INFLUENCE: Self = Self { influence: true, gradient: false, offset: false };
    /// ∇W alone.
    pub const GRADIENT: Self = Self { influence: false, gradient: true, offset: false };
    /// W and ∇W.
    pub const BOTH: Self = Self { influence: true, gradient: true, offset: false };
    /// W and x − x_j.
    pub const INFLUENCE_AND_OFFSET: Self = Self { influence: true, gradient: false, offset: true };

    /// What two estimates read together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            influence: self.influence || other.influence,
            gradient: self.gradient || other.gradient,
            offset: self.offset || other.offset,
        }
    }
}

/// One way to estimate A(x) from the values A_j of the samples in reach: what is added for a sample, and what the sums mean.
///
/// Terms are written once, for one sample at a time or several in a [`Lane`]. There are two kinds of sums: the moments, to
/// which only the samples' positions and volumes contribute, so that all fields at a point share them, and those of one field.
///
/// Every sum must be linear in W and ∇W together. A fast path gives terms without the constant σ h⁻ᴰ of the kernel and
/// multiplies the sums by it.
///
/// ```
/// use sph_core::field::{Estimate, Reads, Summand, Term};
/// use sph_core::{BruteForce, Field, KernelInfluence, Lane, Scalar, Sources, Uniform, kernel::CubicSpline};
///
/// /// The mean of the neighbours' values, whatever their distance.
/// struct Mean;
///
/// impl<T: Scalar, const D: usize> Estimate<T, D> for Mean {
///     const READS: Reads = Reads { influence: false, gradient: false, offset: false };
///     type Moments<A: Lane<T>> = A;
///     type Sums<A: Lane<T>> = A;
///     type Basis = T;
///
///     fn add_moments<A: Lane<T>>(count: &mut A::Sum, _: &impl Term<A, D>) {
///         A::ONE.add_to(count);
///     }
///
///     fn add<A: Lane<T>>(sum: &mut A::Sum, _: &impl Term<A, D>, value: A) {
///         value.add_to(sum);
///     }
///
///     fn basis(count: T, _: T) -> Option<T> {
///         count.is_above_zero().then_some(count)
///     }
///
///     fn finish(count: &T, sum: T) -> Option<(T, [T; D])> {
///         Some((sum / *count, [T::ZERO; D]))
///     }
/// }
///
/// let samples = Sources::new(BruteForce::new(&[[0.0_f64], [0.1], [9.0]])?, Uniform(1.0))?;
/// let w = KernelInfluence::<f64, 1, CubicSpline>::new(1.0)?;
/// let mean = Field::new(&samples, &[1.0, 2.0, 7.0])?.estimate_at::<Mean>(&w, &[0.0]);
/// assert_eq!(mean, Some((1.5, [0.0])));
/// # Ok::<(), sph_core::Error>(())
/// ```
pub trait Estimate<T: Scalar, const D: usize> {
    /// What is read of a term.
    const READS: Reads;
    /// What is summed over positions and volumes; `()` for nothing.
    type Moments<A: Lane<T>>: Summand<T, A, Total = Self::Moments<T>>;
    /// What is summed for a field.
    type Sums<A: Lane<T>>: Summand<T, A, Total = Self::Sums<T>>;
    /// What the moments mean for all fields at a point.
    type Basis: Copy;

    /// Adds a term to the moments.
    fn add_moments<A: Lane<T>>(moments: &mut SumOf<T, A, Self::Moments<A>>, term: &impl Term<A, D>);
    /// Adds a term to the sums of a field whose value there is A_j.
    fn add<A: Lane<T>>(sums: &mut SumOf<T, A, Self::Sums<A>>, term: &impl Term<A, D>, value: A);
    /// What the moments mean; `None` where the samples in reach do not carry the estimate. `reach` is the largest h_j.
    fn basis(moments: Self::Moments<T>, reach: T) -> Option<Self::Basis>;
    /// A(x) and ∇A(x), either zero where the estimate has none; `None` where they are out of the scalar's range.
    fn finish(basis: &Self::Basis, sums: Self::Sums<T>) -> Option<(T, [T; D])>;
}

/// The running sums of a [`Summand`].
pub type SumOf<T, A, S> = <S as Summand<T, A>>::Sum;

/// One neighbour as a term.
pub(super) struct One<'a, T, W, const D: usize> {
    pub(super) neighbour: &'a Neighbour<T, D>,
    pub(super) weight: T,
    pub(super) influence: W,
    /// The largest h_j; not read where x − x_j is not.
    pub(super) reach: T,
}

impl<T: Scalar, W: Influence<T, D>, const D: usize> Term<T, D> for One<'_, T, W, D> {
    #[inline(always)]
    fn weight(&self) -> T {
        self.weight
    }

    #[inline(always)]
    fn influence(&self) -> T {
        self.influence.influence(self.neighbour.distance_squared)
    }

    #[inline(always)]
    fn gradient(&self) -> [T; D] {
        self.influence.gradient(&self.neighbour.offset, self.neighbour.distance_squared)
    }

    #[inline(always)]
    fn influence_and_gradient(&self) -> (T, [T; D]) {
        self.influence.value_and_gradient(&self.neighbour.offset, self.neighbour.distance_squared)
    }

    #[inline(always)]
    fn offset(&self) -> [T; D] {
        self.neighbour.offset
    }

    #[inline(always)]
    fn support_radius(&self) -> T {
        self.influence.support_radius()
    }

    #[inline(always)]
    fn inverse_reach(&self) -> T {
        T::ONE / self.reach
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>> Sources<T, D, N, M> {
    /// The moments of an estimate about x.
    #[inline(always)]
    pub fn moments_at<E: Estimate<T, D>>(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> E::Moments<T> {
        let mut moments = <E::Moments<T> as Summand<T>>::EMPTY;
        self.for_each(w, x, |neighbour, weight, influence| {
            E::add_moments(&mut moments, &One { neighbour, weight, influence, reach: w.reach() });
        });
        <E::Moments<T> as Summand<T>>::total(moments)
    }
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// A(x) and ∇A(x) by an estimate; `None` where the samples in reach do not carry it.
    pub fn estimate_at<E: Estimate<T, D>>(&self, w: impl InfluenceOf<T, D>, x: &[T; D]) -> Option<(T, [T; D])>
    where
        V: PerSample<T>,
    {
        let (basis, sums) = self.sums_at::<E, T>(w, x)?;
        E::finish(&basis, <E::Sums<T> as Summand<T>>::total(sums))
    }

    /// A(x) by an estimate, for scalar or vector values; `None` where the samples in reach do not carry it.
    pub fn value_at<E: Estimate<T, D>, Q: Quantity<T>>(
        &self,
        w: impl InfluenceOf<T, D>,
        x: &[T; D],
    ) -> Option<Q>
    where
        V: PerSample<Q>,
    {
        let (basis, sums) = self.sums_at::<E, Q>(w, x)?;
        Q::collect(sums, |sums| Some(E::finish(&basis, <E::Sums<T> as Summand<T>>::total(sums))?.0))
    }

    /// The basis at x and the sums of each component of the values.
    #[inline(always)]
    #[expect(clippy::type_complexity, reason = "names of its parts would say less")]
    fn sums_at<E: Estimate<T, D>, Q: Quantity<T>>(
        &self,
        w: impl InfluenceOf<T, D>,
        x: &[T; D],
    ) -> Option<(E::Basis, Q::Each<SumOf<T, T, E::Sums<T>>>)>
    where
        V: PerSample<Q>,
    {
        let mut moments = <E::Moments<T> as Summand<T>>::EMPTY;
        let mut sums = Q::each(<E::Sums<T> as Summand<T>>::EMPTY);
        self.sources.for_each(w, x, |neighbour, weight, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let term = One { neighbour, weight, influence, reach: w.reach() };
                E::add_moments(&mut moments, &term);
                value.visit(&mut sums, |sums, component| E::add(sums, &term, component));
            }
        });
        Some((E::basis(<E::Moments<T> as Summand<T>>::total(moments), w.reach())?, sums))
    }

    /// A(x) and ∇A(x) by an estimate whose basis at x is known: [`Estimate::basis`] of [`Sources::moments_at`]. One basis serves all
    /// fields over the same sources.
    #[inline(always)]
    pub fn finish_at<E: Estimate<T, D>>(
        &self,
        basis: &E::Basis,
        w: impl InfluenceOf<T, D>,
        x: &[T; D],
    ) -> Option<(T, [T; D])>
    where
        V: PerSample<T>,
    {
        let mut sums = <E::Sums<T> as Summand<T>>::EMPTY;
        self.sources.for_each(w, x, |neighbour, weight, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                E::add(&mut sums, &One { neighbour, weight, influence, reach: w.reach() }, value);
            }
        });
        E::finish(basis, <E::Sums<T> as Summand<T>>::total(sums))
    }
}

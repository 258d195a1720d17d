//! The samples that contribute to a sum: a search over their positions and a weight for each, lengths checked once.

use crate::{Error, InfluenceOf, Neighbour, Neighbours, Parameter, Scalar, check};
use core::marker::PhantomData;

/// A value for each sample: a slice, or the same for all.
pub trait PerSample<V>: Copy {
    /// The value of sample j; `None` where there is no such sample.
    fn get(&self, j: usize) -> Option<V>;

    /// How many samples have a value; `None` when every sample has.
    fn count(&self) -> Option<usize>;
}

/// One value that all samples share: a mass that takes no memory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Uniform<V>(pub V);

impl<V: Copy> PerSample<V> for Uniform<V> {
    #[inline(always)]
    fn get(&self, _: usize) -> Option<V> {
        Some(self.0)
    }

    fn count(&self) -> Option<usize> {
        None
    }
}

impl<V: Copy> PerSample<V> for &[V] {
    #[inline(always)]
    fn get(&self, j: usize) -> Option<V> {
        (**self).get(j).copied()
    }

    fn count(&self) -> Option<usize> {
        Some((**self).len())
    }
}

impl<V: Copy, const N: usize> PerSample<V> for &[V; N] {
    #[inline(always)]
    fn get(&self, j: usize) -> Option<V> {
        self.as_slice().get(j).copied()
    }

    fn count(&self) -> Option<usize> {
        Some(N)
    }
}

/// Checks that there is a value for each of `samples`.
pub(crate) fn check_length<V>(
    values: &impl PerSample<V>,
    samples: usize,
    parameter: Parameter,
) -> Result<(), Error> {
    values.count().map_or(Ok(()), |count| check::length(count, samples, parameter))
}

/// Samples j with weights, ready to be summed over: masses m_j for a density, volumes V_j = m_j / ρ_j for a field.
///
/// Every sum adds its terms in the order in which the search visits the samples.
///
/// ```
/// use sph_core::{BruteForce, KernelInfluence, Sources, Uniform, kernel::CubicSpline};
/// let positions = [[0.0_f64], [0.1], [0.2], [0.3], [0.4]];
/// let search = BruteForce::new(&positions)?;
/// let w = KernelInfluence::<f64, 1, CubicSpline>::new(0.2)?;
/// let density = Sources::new(search, Uniform(0.1))?.density_at(&w, &[0.2]);
/// assert!((density - 1.0).abs() < 1e-12);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sources<T, const D: usize, N, M> {
    search: N,
    weights: M,
    scalar: PhantomData<T>,
}

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>> Sources<T, D, N, M> {
    /// Joins a search and the weights of its samples.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a weight for each sample; [`Error::NotFinite`] or [`Error::NotPositive`] with
    /// the index of a weight that is not so.
    pub fn new(search: N, weights: M) -> Result<Self, Error> {
        let samples = search.positions().len();
        check_length(&weights, samples, Parameter::Mass)?;
        for index in 0..weights.count().unwrap_or(1) {
            if let Some(weight) = weights.get(index) {
                check::positive(weight, Parameter::Mass, index)?;
            }
        }
        Ok(Self::assume_checked(search, weights))
    }

    /// As [`new`](Self::new) for weights that were checked before, at no cost: one set of weights, many searches. A sample
    /// without a weight is left out of the sums.
    pub fn assume_checked(search: N, weights: M) -> Self {
        Self { search, weights, scalar: PhantomData }
    }

    /// The samples' positions.
    pub fn positions(&self) -> &[[T; D]] {
        self.search.positions()
    }

    /// The samples' weights.
    pub fn weights(&self) -> M {
        self.weights
    }

    /// Visits every sample in reach of x with its weight and its influence.
    #[inline(always)]
    pub(crate) fn for_each<W: InfluenceOf<T, D>>(
        &self,
        w: W,
        x: &[T; D],
        mut visit: impl FnMut(&Neighbour<T, D>, T, W::Influence),
    ) {
        self.search.for_each(x, w.reach(), |neighbour| {
            if let (Some(weight), Some(influence)) =
                (self.weights.get(neighbour.index), w.of(neighbour.index))
            {
                visit(&neighbour, weight, influence);
            }
        });
    }
}

/// The search, which says the number of samples, not their weights.
#[cfg(feature = "defmt")]
impl<T, const D: usize, N: defmt::Format, M> defmt::Format for Sources<T, D, N, M> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Sources by {}", self.search);
    }
}

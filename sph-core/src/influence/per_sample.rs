//! A support radius h_j for each sample, the scatter form Ω(x − x_j, h_j).

use core::marker::PhantomData;

use super::{InfluenceOf, KernelInfluence};
use crate::kernel::Kernel;
use crate::{Error, Scalar};

/// Which kernel width each sample brings: h_j from a slice.
///
/// ```
/// use sph_core::{Influence, InfluenceOf, PerSampleInfluence, kernel::CubicSpline};
/// let w = PerSampleInfluence::<f64, 3, CubicSpline>::new(&[1.0, 2.0])?;
/// assert_eq!(w.reach(), 2.0);
/// assert_eq!(w.of(0).unwrap().support_radius(), 1.0);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct PerSampleInfluence<'a, T, const D: usize, K> {
    support_radii: &'a [T],
    reach: T,
    kernel: PhantomData<K>,
}

impl<'a, T: Scalar, const D: usize, K: Kernel> PerSampleInfluence<'a, T, D, K> {
    /// Checks every h_j.
    ///
    /// # Errors
    /// As [`KernelInfluence::new`], with the index of the sample.
    pub fn new(support_radii: &'a [T]) -> Result<Self, Error> {
        let mut reach = T::ZERO;
        for (index, &radius) in support_radii.iter().enumerate() {
            KernelInfluence::<T, D, K>::new(radius).map_err(|error| error.at(index))?;
            reach = reach.max(radius);
        }
        Ok(Self { support_radii, reach, kernel: PhantomData })
    }
}

impl<T: Scalar, const D: usize, K: Kernel> InfluenceOf<T, D> for PerSampleInfluence<'_, T, D, K> {
    type Influence = KernelInfluence<T, D, K>;

    #[inline(always)]
    fn of(&self, j: usize) -> Option<Self::Influence> {
        KernelInfluence::new(*self.support_radii.get(j)?).ok()
    }

    #[inline(always)]
    fn reach(&self) -> T {
        self.reach
    }
}

/// The number of samples and the largest radius, not each of them.
#[cfg(feature = "defmt")]
impl<T: defmt::Format, const D: usize, K> defmt::Format for PerSampleInfluence<'_, T, D, K> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let samples = self.support_radii.len();
        defmt::write!(f, "PerSampleInfluence of {=usize} samples, reach {}", samples, self.reach);
    }
}

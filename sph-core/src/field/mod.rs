//! Fields made from samples: each file is one sum (Def. 3.1, Thms 3.2, 3.3).
//!
//! | method | sum | at |
//! |---|---|---|
//! | [`Sources::density_at`] | ρ(x) = Σ m_j W(x − x_j), self included | any point |
//! | [`Sources::density_gradient_at`] | ∇ρ(x) = Σ m_j ∇W | any point |
//! | [`Field::interpolate_at`] | A(x) = Σ V_j A_j W | any point |
//! | [`Field::gradient_at`] | ∇A(x) = Σ V_j A_j ∇W | any point |
//! | [`Field::shepard_at`], [`Field::shepard_gradient_at`] | Σ V_j A_j W / Σ V_j W and its gradient | any point |
//! | [`Field::corrected_at`] | linear moving least squares, value and slope | any point |
//! | [`Field::difference_gradient`] | Σ V_j (A_j − A_i) ∇W_ij | samples |
//! | [`Field::symmetric_gradient`] | ρ_i Σ m_j (A_i/ρ_i² + A_j/ρ_j²) ∇W_ij | samples |
//! | [`Field::corrected_gradient`] | (Σ V_j ∇W_ij ⊗ x_ji)⁻¹ Σ V_j (A_j − A_i) ∇W_ij | samples |
//! | [`Field::jacobian`], [`divergence`], [`curl`], [`curl_2d`] | Σ V_j (A_j − A_i) ⊗ ∇W_ij and what follows | samples |
//! | [`Field::laplacian`], [`Field::diffusion`] | Σ V_j (μ_i + μ_j) (A_i − A_j) x_ij·∇W_ij / r² | samples |
//!
//! Those at any point are [`Estimate`]s: [`Plain`], [`PlainGradient`], [`PlainWithGradient`], [`Shepard`],
//! [`ShepardWithGradient`] and [`Corrected`]. Each is written once, for one sample at a time and for several side by side in a
//! [`Lane`](crate::Lane); one of your own is asked by [`Field::estimate_at`].
//!
//! V_j = m_j / ρ_j. The numeric gradient of an interpolated field is [`difference::gradient`](crate::difference::gradient) of a
//! closure that interpolates.
//!
//! [`Sources::density_at`]: crate::Sources::density_at
//! [`Sources::density_gradient_at`]: crate::Sources::density_gradient_at

mod corrected;
mod density;
mod estimate;
mod gradient;
mod interpolate;
mod jacobian;
mod laplacian;
mod matrix;
mod quantity;
mod shepard;
mod summand;

pub use corrected::{Corrected, LinearBasis, LinearFit};
pub use density::volumes;
pub use estimate::{Estimate, Reads, SumOf, Term};
pub use gradient::{PlainGradient, PlainWithGradient};
pub use interpolate::Plain;
pub use jacobian::{curl, curl_2d, divergence};
pub use quantity::Quantity;
pub use shepard::{Shepard, ShepardWithGradient};
pub use summand::Summand;

use crate::samples::check_length;
use crate::{Error, Neighbours, Parameter, PerSample, Scalar, Sources};

/// Values A_j at samples whose weights are volumes V_j = m_j / ρ_j: a field that can be asked for anywhere.
///
/// ```
/// use sph_core::{BruteForce, Field, KernelInfluence, Sources, Uniform, kernel::WendlandC2};
/// let positions = [[0.0_f32, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]];
/// let volumes = Sources::new(BruteForce::new(&positions)?, Uniform(0.01))?;
/// let temperature = Field::new(&volumes, &[20.0, 21.0, 22.0, 23.0])?;
///
/// let w = KernelInfluence::<f32, 2, WendlandC2>::new(0.25)?;
/// let middle = temperature.shepard_at(&w, &[0.05, 0.05]).unwrap();
/// assert!((middle - 21.5).abs() < 1e-4);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Field<'a, T, const D: usize, N, M, V> {
    sources: &'a Sources<T, D, N, M>,
    values: V,
}

impl<'a, T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'a, T, D, N, M, V> {
    /// Joins samples, weighted by their volumes, and the values there: scalars `T` or vectors `[T; N]`.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a value for each sample.
    pub fn new<Q: Quantity<T>>(sources: &'a Sources<T, D, N, M>, values: V) -> Result<Self, Error>
    where
        V: PerSample<Q>,
    {
        check_length(&values, sources.positions().len(), Parameter::Value)?;
        Ok(Self { sources, values })
    }

    /// The position and the value of sample i.
    fn sample<Q>(&self, i: usize) -> Option<([T; D], Q)>
    where
        V: PerSample<Q>,
    {
        Some((*self.sources.positions().get(i)?, self.values.get(i)?))
    }
}

/// Its sources, not the values.
#[cfg(feature = "defmt")]
impl<T, const D: usize, N: defmt::Format, M, V> defmt::Format for Field<'_, T, D, N, M, V> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Field over {}", self.sources);
    }
}

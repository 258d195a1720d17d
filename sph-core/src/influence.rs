//! The influence Ω(x) = W(x, h) of one sample and its gradient (Defs. 2.2, 2.3, Thm 2.4).
//!
//! ```text
//! Ω(D, h)(x) = ω(h, |x|) / V(D, h) = σ_D h^{-D} f(|x|/h)          units L^{-D}
//! ∇Ω(x)      = x̂ / V · ∂ω/∂r       = σ_D h^{-D-1} f′(|x|/h) x̂     units L^{-D-1}, zero at x = 0
//! V(D, h)    = ∫₀ʰ ∂B/∂r ω dr,      so that ∫ Ω d^Dx = 1
//! ```
//!
//! **Erratum.** The paper prints V = ∫₀ʰ B ω dr, with the volume of the ball where its surface belongs; ∫ Ω d^Dx is then not 1.
//! [`KernelInfluence::new`] uses the surface; [`KernelInfluence::with_printed_volume`] keeps the printed form. Interpolation
//! by Def. 3.1 with ρ from Thm 3.2 is the same under both, since the constant cancels; a density is not.

mod closure;
mod kernel;
mod per_sample;
pub mod volume;

pub use closure::ClosureInfluence;
pub use kernel::KernelInfluence;
pub use per_sample::PerSampleInfluence;

use crate::Scalar;
use crate::vector::norm_squared;

/// Ω and ∇Ω for one support radius: what every sum over neighbours is weighted with.
///
/// The distance comes as its square, because searches know that and some kernels need no more.
///
/// The smallest one of your own, for what is no [`Kernel`](crate::kernel::Kernel); all sums take it:
///
/// ```
/// use sph_core::{BruteForce, Influence, Sources, Uniform};
///
/// /// (1 − |x|²)², in two dimensions and f32; ∫ = π/3.
/// struct Bell;
///
/// impl Influence<f32, 2> for Bell {
///     fn support_radius(&self) -> f32 {
///         1.0
///     }
///     fn influence(&self, distance_squared: f32) -> f32 {
///         let t = (1.0 - distance_squared).max(0.0);
///         3.0 / core::f32::consts::PI * t * t
///     }
///     fn gradient(&self, x: &[f32; 2], distance_squared: f32) -> [f32; 2] {
///         let t = (1.0 - distance_squared).max(0.0);
///         x.map(|component| -12.0 / core::f32::consts::PI * t * component)
///     }
/// }
///
/// let sources = Sources::new(BruteForce::new(&[[0.0_f32, 0.0], [0.5, 0.0]])?, Uniform(1.0))?;
/// let (density, gradient) = sources.density_gradient_at(&Bell, &[0.25, 0.0]);
/// assert!((density - 2.0 * Bell.influence(0.0625)).abs() < 1e-6 && gradient == [0.0, 0.0]);
/// # Ok::<(), sph_core::Error>(())
/// ```
pub trait Influence<T: Scalar, const D: usize> {
    /// h: Ω(x) = 0 for |x| ≥ h. Unit L.
    fn support_radius(&self) -> T;

    /// Ω at distance √`distance_squared`, units L^{-D}.
    fn influence(&self, distance_squared: T) -> T;

    /// ∇Ω(x), the derivative by x; `distance_squared` is |x|². Units L^{-D-1}; zero at x = 0.
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D];

    /// Ω over [`constant`](Self::constant): what differs from pair to pair.
    #[inline(always)]
    fn shape(&self, distance_squared: T) -> T {
        self.influence(distance_squared)
    }

    /// What all values of Ω have in common, so that a sum may multiply by it once.
    #[inline(always)]
    fn constant(&self) -> T {
        T::ONE
    }

    /// s with ∇Ω(x) = s x at |x|² = `distance_squared`, units L^{-D-2}, for D ≥ 1: what a sum of central forces needs of a pair.
    #[inline(always)]
    fn slope(&self, distance_squared: T) -> T {
        let unit = core::array::from_fn(|axis| if axis == 0 { T::ONE } else { T::ZERO });
        self.gradient(&unit, distance_squared).first().copied().unwrap_or(T::ZERO)
    }

    /// Ω(x) and ∇Ω(x) together.
    #[inline(always)]
    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        (self.influence(distance_squared), self.gradient(x, distance_squared))
    }

    /// Ω(x).
    #[inline(always)]
    fn influence_at(&self, x: &[T; D]) -> T {
        self.influence(norm_squared(x))
    }

    /// ∇Ω(x).
    #[inline(always)]
    fn gradient_at(&self, x: &[T; D]) -> [T; D] {
        self.gradient(x, norm_squared(x))
    }
}

/// Which [`Influence`] each contributing sample brings: the same for all, or one of its own.
///
/// A reference to an [`Influence`] is the first kind, so a sum takes `&w`; [`PerSampleInfluence`] is the second.
pub trait InfluenceOf<T: Scalar, const D: usize>: Copy {
    /// The influence of one sample.
    type Influence: Influence<T, D>;

    /// The influence of sample j; `None` where there is no such sample.
    fn of(&self, j: usize) -> Option<Self::Influence>;

    /// The largest support radius among the samples: what a search must reach.
    fn reach(&self) -> T;
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Influence<T, D> for &W {
    #[inline(always)]
    fn support_radius(&self) -> T {
        (**self).support_radius()
    }

    #[inline(always)]
    fn influence(&self, distance_squared: T) -> T {
        (**self).influence(distance_squared)
    }

    #[inline(always)]
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        (**self).gradient(x, distance_squared)
    }

    #[inline(always)]
    fn shape(&self, distance_squared: T) -> T {
        (**self).shape(distance_squared)
    }

    #[inline(always)]
    fn constant(&self) -> T {
        (**self).constant()
    }

    fn slope(&self, distance_squared: T) -> T {
        (**self).slope(distance_squared)
    }

    #[inline(always)]
    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        (**self).value_and_gradient(x, distance_squared)
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> InfluenceOf<T, D> for &W {
    type Influence = Self;

    #[inline(always)]
    fn of(&self, _: usize) -> Option<Self> {
        Some(self)
    }

    #[inline(always)]
    fn reach(&self) -> T {
        self.support_radius()
    }
}

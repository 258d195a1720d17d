//! The kernels by name, and an influence whose kernel is chosen when the program runs.

use clap::ValueEnum;
use sph_core::kernel::{self, Kernel};
use sph_core::{Error, Influence, InfluenceOf, KernelInfluence, Scalar};

/// A kernel as the command line names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum KernelName {
    /// (1 − q²)³, Müller et al. 2003
    Poly6,
    /// (1 − q)³, Müller et al. 2003
    Spiky,
    /// for viscosity forces, Müller et al. 2003: diverges at r = 0
    Viscosity,
    /// B-spline M₄
    CubicSpline,
    /// B-spline M₅
    QuarticSpline,
    /// B-spline M₆
    QuinticSpline,
    /// Wendland's function C2
    WendlandC2,
    /// Wendland's function C4
    WendlandC4,
    /// Wendland's function C6
    WendlandC6,
}

/// Evaluates an expression with `K` standing for the kernel of a [`KernelName`].
macro_rules! with_kernel {
    ($name:expr, $K:ident => $body:expr) => {
        match $name {
            $crate::kernel_choice::KernelName::Poly6 => {
                type $K = sph_core::kernel::Poly6;
                $body
            }
            $crate::kernel_choice::KernelName::Spiky => {
                type $K = sph_core::kernel::Spiky;
                $body
            }
            $crate::kernel_choice::KernelName::Viscosity => {
                type $K = sph_core::kernel::Viscosity;
                $body
            }
            $crate::kernel_choice::KernelName::CubicSpline => {
                type $K = sph_core::kernel::CubicSpline;
                $body
            }
            $crate::kernel_choice::KernelName::QuarticSpline => {
                type $K = sph_core::kernel::QuarticSpline;
                $body
            }
            $crate::kernel_choice::KernelName::QuinticSpline => {
                type $K = sph_core::kernel::QuinticSpline;
                $body
            }
            $crate::kernel_choice::KernelName::WendlandC2 => {
                type $K = sph_core::kernel::WendlandC2;
                $body
            }
            $crate::kernel_choice::KernelName::WendlandC4 => {
                type $K = sph_core::kernel::WendlandC4;
                $body
            }
            $crate::kernel_choice::KernelName::WendlandC6 => {
                type $K = sph_core::kernel::WendlandC6;
                $body
            }
        }
    };
}

pub(crate) use with_kernel;

impl KernelName {
    /// All kernels.
    pub const ALL: &'static [Self] = &[
        Self::Poly6,
        Self::Spiky,
        Self::Viscosity,
        Self::CubicSpline,
        Self::QuarticSpline,
        Self::QuinticSpline,
        Self::WendlandC2,
        Self::WendlandC4,
        Self::WendlandC6,
    ];

    /// The name on the command line, such as `cubic-spline`.
    #[must_use]
    pub fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// Whether the kernel diverges at r = 0, so that nothing can be interpolated with it.
    #[must_use]
    pub fn is_singular(self) -> bool {
        with_kernel!(self, K => K::SINGULAR)
    }

    /// Support radius / smoothing length.
    #[must_use]
    pub fn support_ratio(self) -> f64 {
        let (numerator, denominator) = with_kernel!(self, K => K::SUPPORT_RATIO);
        f64::from(numerator) / f64::from(denominator)
    }

    /// σ_D, infinite moments giving 0.
    #[must_use]
    pub fn normalisation(self, dim: u32) -> f64 {
        with_kernel!(self, K => kernel::normalisation::<K>(dim))
    }

    /// ∫ |x|² W d^Dx for support radius 1.
    #[must_use]
    pub fn second_moment(self, dim: u32) -> f64 {
        with_kernel!(self, K => kernel::second_moment::<K>(dim))
    }

    /// f(q) of the form used in `dim` dimensions.
    #[must_use]
    pub fn profile(self, dim: u32, q: f64) -> f64 {
        with_kernel!(self, K => if dim == 1 { K::profile_in_1d(q) } else { K::profile(q) })
    }

    /// f′(q) of the form used in `dim` dimensions.
    #[must_use]
    pub fn slope(self, dim: u32, q: f64) -> f64 {
        with_kernel!(self, K => if dim == 1 { K::slope_in_1d(q) } else { K::slope(q) })
    }
}

/// An influence whose kernel is known only when the program runs. Same numbers as [`KernelInfluence`].
#[derive(Clone, Copy, Debug)]
pub struct AnyInfluence<T, const D: usize> {
    variant: Variant<T, D>,
}

#[derive(Clone, Copy, Debug)]
enum Variant<T, const D: usize> {
    Poly6(KernelInfluence<T, D, kernel::Poly6>),
    Spiky(KernelInfluence<T, D, kernel::Spiky>),
    CubicSpline(KernelInfluence<T, D, kernel::CubicSpline>),
    QuarticSpline(KernelInfluence<T, D, kernel::QuarticSpline>),
    QuinticSpline(KernelInfluence<T, D, kernel::QuinticSpline>),
    WendlandC2(KernelInfluence<T, D, kernel::WendlandC2>),
    WendlandC4(KernelInfluence<T, D, kernel::WendlandC4>),
    WendlandC6(KernelInfluence<T, D, kernel::WendlandC6>),
}

impl<T: Scalar, const D: usize> AnyInfluence<T, D> {
    /// The influence of a kernel with support radius h.
    ///
    /// # Errors
    /// As [`KernelInfluence::new`].
    pub fn new(name: KernelName, support_radius: T) -> Result<Self, Error> {
        let variant = match name {
            KernelName::Poly6 => Variant::Poly6(KernelInfluence::new(support_radius)?),
            KernelName::Spiky => Variant::Spiky(KernelInfluence::new(support_radius)?),
            KernelName::Viscosity => return Err(Error::SingularKernel),
            KernelName::CubicSpline => Variant::CubicSpline(KernelInfluence::new(support_radius)?),
            KernelName::QuarticSpline => Variant::QuarticSpline(KernelInfluence::new(support_radius)?),
            KernelName::QuinticSpline => Variant::QuinticSpline(KernelInfluence::new(support_radius)?),
            KernelName::WendlandC2 => Variant::WendlandC2(KernelInfluence::new(support_radius)?),
            KernelName::WendlandC4 => Variant::WendlandC4(KernelInfluence::new(support_radius)?),
            KernelName::WendlandC6 => Variant::WendlandC6(KernelInfluence::new(support_radius)?),
        };
        Ok(Self { variant })
    }
}

macro_rules! each_variant {
    ($self:ident, $w:ident => $body:expr) => {
        match &$self.variant {
            Variant::Poly6($w) => $body,
            Variant::Spiky($w) => $body,
            Variant::CubicSpline($w) => $body,
            Variant::QuarticSpline($w) => $body,
            Variant::QuinticSpline($w) => $body,
            Variant::WendlandC2($w) => $body,
            Variant::WendlandC4($w) => $body,
            Variant::WendlandC6($w) => $body,
        }
    };
}

impl<T: Scalar, const D: usize> Influence<T, D> for AnyInfluence<T, D> {
    fn support_radius(&self) -> T {
        each_variant!(self, w => w.support_radius())
    }

    #[inline(never)]
    fn influence(&self, distance_squared: T) -> T {
        each_variant!(self, w => w.influence(distance_squared))
    }

    #[inline(never)]
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        each_variant!(self, w => w.gradient(x, distance_squared))
    }

    #[inline(never)]
    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        each_variant!(self, w => w.value_and_gradient(x, distance_squared))
    }
}

/// The influences of a set of samples: one for all, or one each (scatter form).
#[derive(Clone, Copy, Debug)]
pub struct Influences<'a, T, const D: usize> {
    each: &'a [AnyInfluence<T, D>],
    /// 0: the first serves all; 1: each has its own.
    stride: usize,
    reach: T,
}

impl<'a, T: Scalar, const D: usize> Influences<'a, T, D> {
    /// One support radius for all.
    pub fn uniform(influence: &'a AnyInfluence<T, D>) -> Self {
        Self { each: std::slice::from_ref(influence), stride: 0, reach: influence.support_radius() }
    }

    /// A support radius each.
    pub fn per_sample(each: &'a [AnyInfluence<T, D>]) -> Self {
        let reach =
            each.iter().fold(T::ZERO, |reach, influence| Scalar::max(reach, influence.support_radius()));
        Self { each, stride: 1, reach }
    }
}

impl<'a, T: Scalar, const D: usize> InfluenceOf<T, D> for Influences<'a, T, D> {
    type Influence = &'a AnyInfluence<T, D>;

    #[inline]
    fn of(&self, j: usize) -> Option<&'a AnyInfluence<T, D>> {
        self.each.get(j * self.stride)
    }

    fn reach(&self) -> T {
        self.reach
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_command_line() {
        let names: Vec<String> = KernelName::ALL.iter().map(|kernel| kernel.name()).collect();
        assert_eq!(names[0], "poly6");
        assert_eq!(names[3], "cubic-spline");
        assert_eq!(names[8], "wendland-c6");
        assert_eq!(KernelName::ALL.len(), KernelName::value_variants().len());
    }

    #[test]
    fn the_choice_changes_no_bit() {
        let x = [0.3_f32, -0.2, 0.4];
        let chosen = AnyInfluence::<f32, 3>::new(KernelName::WendlandC4, 0.8).unwrap();
        let fixed = KernelInfluence::<f32, 3, kernel::WendlandC4>::new(0.8).unwrap();
        assert_eq!(chosen.influence_at(&x).to_bits(), fixed.influence_at(&x).to_bits());
        assert_eq!(chosen.gradient_at(&x), fixed.gradient_at(&x));
        assert!(AnyInfluence::<f32, 3>::new(KernelName::Viscosity, 0.8).is_err());
    }
}

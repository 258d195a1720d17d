//! The kernels by name, and an influence whose kernel is chosen when the program runs.

use sph_core::kernel::{self, Kernel};
use sph_core::{Error, Influence, InfluenceOf, KernelInfluence, Scalar};

use crate::named_enum::named_enum;

/// What follows from the list of kernels: [`KernelName`] and the variants of [`AnyInfluence`].
macro_rules! choices {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        named_enum! {
            /// A kernel by its name.
            KernelName { $($Kernel, $name, $about;)+ }
        }

        #[derive(Clone, Copy, Debug)]
        enum Variant<T, const D: usize> {
            $($Kernel(KernelInfluence<T, D, kernel::$Kernel>),)+
        }

        impl<T: Scalar, const D: usize> Variant<T, D> {
            fn new(name: KernelName, support_radius: T) -> Result<Self, Error> {
                Ok(match name {
                    $(KernelName::$Kernel => Self::$Kernel(KernelInfluence::new(support_radius)?),)+
                })
            }
        }
    };
}
sph_core::for_each_kernel!(choices);

/// Evaluates an expression with `K` standing for the kernel of a [`KernelName`].
macro_rules! with_kernel {
    ([$($module:ident $Kernel:ident $text:tt $about:tt;)+] $name:expr, $K:ident => $body:expr) => {
        match $name {
            $($crate::kernel_choice::KernelName::$Kernel => {
                type $K = sph_core::kernel::$Kernel;
                $body
            })+
        }
    };
    ($name:expr, $K:ident => $body:expr) => {
        sph_core::for_each_kernel!($crate::kernel_choice::with_kernel; $name, $K => $body)
    };
}

pub(crate) use with_kernel;

impl KernelName {
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

impl<T: Scalar, const D: usize> AnyInfluence<T, D> {
    /// The influence of a kernel with support radius h.
    ///
    /// # Errors
    /// As [`KernelInfluence::new`].
    pub fn new(name: KernelName, support_radius: T) -> Result<Self, Error> {
        Ok(Self { variant: Variant::new(name, support_radius)? })
    }
}

/// Evaluates an expression with `w` standing for the influence in a [`Variant`].
macro_rules! with_influence {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $variant:expr, $w:ident => $body:expr) => {
        match $variant {
            $(Variant::$Kernel($w) => $body,)+
        }
    };
    ($variant:expr, $w:ident => $body:expr) => {
        sph_core::for_each_kernel!(with_influence; $variant, $w => $body)
    };
}

impl<T: Scalar, const D: usize> Influence<T, D> for AnyInfluence<T, D> {
    fn support_radius(&self) -> T {
        with_influence!(&self.variant, w => w.support_radius())
    }

    #[inline(never)]
    fn influence(&self, distance_squared: T) -> T {
        with_influence!(&self.variant, w => w.influence(distance_squared))
    }

    #[inline(never)]
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        with_influence!(&self.variant, w => w.gradient(x, distance_squared))
    }

    #[inline(never)]
    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        with_influence!(&self.variant, w => w.value_and_gradient(x, distance_squared))
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
    fn names_are_those_of_the_list() {
        let names: Vec<_> = KernelName::ALL.iter().map(|kernel| (kernel.name(), kernel.about())).collect();
        assert_eq!(names, kernel::LIST);
        assert_eq!(KernelName::CubicSpline.to_string(), "cubic-spline");
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

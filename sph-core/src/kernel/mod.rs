//! Smoothing kernels as pure functions of q = r / h on [0, 1] (Defs. 1.1 and 1.2).
//!
//! A kernel has no dimension and no h in it: `profile` f(q) and `slope` f′(q) are polynomials written with positive parts
//! (·)₊, so one source serves floats, fixed point and SIMD lanes, without a branch. [`KernelInfluence`] brings h and the
//! constant σ_D, which follows from the radial moments of f:
//!
//! ```text
//! M_n = ∫₀¹ f(q) q^{n−1} dq        σ_D = 1 / (S_D M_D)        W = σ_D h^{-D} f(q)
//! ```
//!
//! The moments are exact: a kernel lists the [`Term`]s its profile is the sum of, and each term's moment is a beta
//! function. A kernel that lists none is integrated by [`quadrature`](crate::quadrature).
//!
//! [`LIST`] has the table of all kernels. A new one is a file in this folder, its `mod` and its line in [`for_each_kernel`]; the
//! command, the laws, the digests and every other table and test take it from there.
//!
//! [`Tabulated`] evaluates another kernel by a table in q², without a root.
//!
//! [`KernelInfluence`]: crate::KernelInfluence
//! [`for_each_kernel`]: crate::for_each_kernel

pub mod cubic_spline;
mod moment;
pub mod poly6;
pub mod quartic_spline;
pub mod quintic_spline;
pub mod spiky;
pub mod tabulated;
pub mod viscosity;
pub mod wendland_c2;
pub mod wendland_c4;
pub mod wendland_c6;

pub mod conformance;

pub(crate) use moment::Constants;
pub use moment::{Term, normalisation, radial_moment, second_moment};
pub use tabulated::Tabulated;
pub use viscosity::ViscosityLaplacian;

/// Calls a macro with the list of the kernels: module, type, name and description of each, and then with what follows `;`.
///
/// ```
/// use sph_core::kernel::{self, Kernel};
///
/// macro_rules! print_at {
///     ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $q:expr) => {
///         $(println!("{}, {}: {}", $name, $about, kernel::$Kernel::profile($q));)+
///     };
/// }
/// sph_core::for_each_kernel!(print_at; 0.5);
/// ```
#[macro_export]
macro_rules! for_each_kernel {
    ($($callback:tt)::+ $(; $($context:tt)*)?) => {
        $($callback)::+! {
            [
                poly6 Poly6 "poly6" "(1 − q²)³, Müller et al. 2003";
                spiky Spiky "spiky" "(1 − q)³, Müller et al. 2003";
                viscosity Viscosity "viscosity" "for viscosity forces, Müller et al. 2003: diverges at r = 0";
                cubic_spline CubicSpline "cubic-spline" "B-spline M₄, Monaghan 1992";
                quartic_spline QuarticSpline "quartic-spline" "B-spline M₅, Price 2012";
                quintic_spline QuinticSpline "quintic-spline" "B-spline M₆, Price 2012";
                wendland_c2 WendlandC2 "wendland-c2" "Wendland's function C2, Wendland 1995";
                wendland_c4 WendlandC4 "wendland-c4" "Wendland's function C4, Wendland 1995";
                wendland_c6 WendlandC6 "wendland-c6" "Wendland's function C6, Wendland 1995";
            ]
            $($($context)*)?
        }
    };
}

macro_rules! listed {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        $(pub use $module::$Kernel;)+

        /// The name and the description of every kernel, in the order of [`for_each_kernel`](crate::for_each_kernel).
        ///
        /// | kernel | name | what |
        /// |---|---|---|
        $(#[doc = concat!("| [`", stringify!($Kernel), "`] | `", $name, "` | ", $about, " |")])+
        pub const LIST: &[(&str, &str)] = &[$(($name, $about)),+];
    };
}
for_each_kernel!(listed);

use crate::vector::scale;
use crate::{Arithmetic, Scalar};

/// A smoothing kernel ω by its shape f(q) = ω(h, q h) / ω-unit: continuous, non-negative, zero for q ≥ 1 (Def. 1.1),
/// where its slope is zero as well, so that the gradient ends with the kernel.
///
/// `profile` and `slope` are all that a kernel must bring; [`conformance::check`] tests the laws. The smallest one:
///
/// ```
/// use sph_core::kernel::{Kernel, conformance};
/// use sph_core::{Arithmetic, KernelInfluence};
///
/// #[derive(Clone, Copy, Debug)]
/// struct Bowl; // (1 − q)²
/// impl Kernel for Bowl {
///     fn profile<T: Arithmetic>(q: T) -> T {
///         (T::ONE - q).positive_part().pow::<2>()
///     }
///     fn slope<T: Arithmetic>(q: T) -> T {
///         (T::ONE - q).positive_part().times(-2)
///     }
/// }
/// assert_eq!(conformance::check::<Bowl, f64>(), Ok(()));
/// // σ₂ = 6/π by quadrature
/// let bowl = KernelInfluence::<f64, 2, Bowl>::new(1.0).unwrap();
/// assert!((bowl.normalisation() - 6.0 / core::f64::consts::PI).abs() < 1e-14);
/// ```
pub trait Kernel: Copy + core::fmt::Debug + Send + Sync + 'static {
    /// Support radius / smoothing length of the field's custom, as a fraction.
    const SUPPORT_RATIO: (i32, i32) = (1, 1);
    /// The terms that sum to f, for exact moments; none: moments by quadrature.
    const TERMS: &'static [Term] = &[];
    /// The terms of the form used in one dimension, where that is another.
    const TERMS_IN_1D: &'static [Term] = Self::TERMS;
    /// Whether f diverges at q = 0, which forbids densities and interpolation.
    const SINGULAR: bool = false;
    /// The raw form ω(h, r) is h^p f(r/h); this is p. 6 for poly6, whose raw form is (h² − r²)³.
    const RAW_POWER: u32 = 0;

    /// f(q) for q ≥ 0, without unit.
    fn profile<T: Arithmetic>(q: T) -> T;

    /// f′(q), signed: never positive, and zero for q = 1. Only its values on [0, 1] count.
    fn slope<T: Arithmetic>(q: T) -> T;

    /// f in one dimension, where that has another form (Wendland's functions).
    #[inline(always)]
    fn profile_in_1d<T: Arithmetic>(q: T) -> T {
        Self::profile(q)
    }

    /// f′ in one dimension.
    #[inline(always)]
    fn slope_in_1d<T: Arithmetic>(q: T) -> T {
        Self::slope(q)
    }

    /// f(√s) for s = q² ≥ 0, zero for s ≥ 1 as infinity is; a kernel that is a polynomial of q² needs no root.
    #[inline(always)]
    fn profile_of_square<T: Scalar, const D: usize>(s: T) -> T {
        let q = root(s);
        if D == 1 { Self::profile_in_1d(q) } else { Self::profile(q) }
    }

    /// f′(q) û with u = x/h, s = |u|² ≥ 0; zero at u = 0 and for s ≥ 1. A kernel whose f′(q)/q has no pole needs no division.
    #[inline(always)]
    fn slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> [T; D] {
        let q = root(s);
        if q == T::ZERO {
            return [T::ZERO; D];
        }
        let slope = if D == 1 { Self::slope_in_1d(q) } else { Self::slope(q) };
        scale(&u.map(|component| component / q), slope)
    }

    /// f(√s) and f′(q) û together, sharing what they share.
    #[inline(always)]
    fn profile_and_slope_vector<T: Scalar, const D: usize>(u: &[T; D], s: T) -> (T, [T; D]) {
        (Self::profile_of_square::<T, D>(s), Self::slope_vector(u, s))
    }

    /// The raw form ω(h, r) of Def. 1.1, zero for r > h: h^p f(r/h) (Ex. 1.3 for [`Poly6`]).
    ///
    /// ```
    /// use sph_core::kernel::{Kernel, Poly6};
    /// assert_eq!(Poly6::raw(2.0_f64, 1.0), 27.0); // (h² − r²)³
    /// assert_eq!(Poly6::raw(2.0_f64, 2.5), 0.0);
    /// ```
    fn raw<T: Scalar>(support_radius: T, r: T) -> T {
        if r > support_radius {
            return T::ZERO;
        }
        raw_unit::<Self, T>(support_radius) * Self::profile(r / support_radius)
    }

    /// The raw form of the profile that is used in one dimension: what Def. 1.2 normalises by
    /// [`half_line`](crate::influence::volume::half_line).
    fn raw_in_1d<T: Scalar>(support_radius: T, r: T) -> T {
        if r > support_radius {
            return T::ZERO;
        }
        raw_unit::<Self, T>(support_radius) * Self::profile_in_1d(r / support_radius)
    }
}

/// q = √s, held at 1, beyond which every kernel is zero: squares may overflow there.
#[inline(always)]
#[track_caller]
fn root<T: Scalar>(s: T) -> T {
    s.min(T::ONE).sqrt()
}

/// h^p
fn raw_unit<K: Kernel, T: Scalar>(support_radius: T) -> T {
    (0..K::RAW_POWER).fold(T::ONE, |unit, _| unit * support_radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    macro_rules! obey {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
            if !$Kernel::SINGULAR {
                assert_eq!(conformance::check::<$Kernel, f64>(), Ok(()), $name);
                assert_eq!(conformance::check::<$Kernel, f32>(), Ok(()), $name);
            }
        )+};
    }

    #[test]
    fn every_kernel_obeys_the_laws() {
        for_each_kernel!(obey);
    }
}

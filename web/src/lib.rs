//! The module of the page: every function of `fluisim.h`, and the kernels' numbers.
//!
//! Memory of a caller lies in pages that the caller has added with `memory.grow`: below them are the module's stack and constants.

#![no_std]

// Named so that its functions are linked.
#[doc(hidden)]
pub use fluisim_c as _c;
use sph_core::kernel::{self, Kernel};
use sph_core::{KernelInfluence, for_each_kernel};

/// What [`kernel_number`] answers: 0 σ f(q), 1 σ f′(q), 2 σ, 3 the support ratio; h is 1.
fn number<K: Kernel, const D: usize>(quantity: u32, q: f64) -> f64 {
    let Ok(influence) = KernelInfluence::<f64, D, K>::new(1.0) else { return f64::NAN };
    let sigma = influence.normalisation();
    let (profile, slope) =
        if D == 1 { (K::profile_in_1d(q), K::slope_in_1d(q)) } else { (K::profile(q), K::slope(q)) };
    match quantity {
        0 => sigma * profile,
        1 => sigma * slope,
        2 => sigma,
        3 => f64::from(K::SUPPORT_RATIO.0) / f64::from(K::SUPPORT_RATIO.1),
        _ => f64::NAN,
    }
}

macro_rules! choose {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $kernel:ident $dimension:ident $quantity:ident $q:ident) => {{
        let mut place = 0;
        $(
            if $kernel == place {
                return match $dimension {
                    1 => number::<kernel::$Kernel, 1>($quantity, $q),
                    2 => number::<kernel::$Kernel, 2>($quantity, $q),
                    3 => number::<kernel::$Kernel, 3>($quantity, $q),
                    _ => f64::NAN,
                };
            }
            place += 1;
        )+
        let _ = place;
        f64::NAN
    }};
}

/// A number of a kernel of support radius 1 in 1 to 3 dimensions: 0 the influence σ f(q), 1 its slope σ f′(q), 2 the normalisation σ,
/// 3 support radius / smoothing length; NaN where there is no such kernel, dimension or quantity.
#[unsafe(export_name = "fluisim_web_kernel")]
#[must_use]
pub extern "C" fn kernel_number(kernel: i32, dimension: u32, quantity: u32, q: f64) -> f64 {
    for_each_kernel!(choose; kernel dimension quantity q)
}

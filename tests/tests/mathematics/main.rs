//! The mathematics of `sph-core`, held against closed forms, quadrature, lattice sums and fields that are known.

mod cloud;
mod conformance;
mod constants;
mod convergence;
mod density;
mod differences;
mod edges;
mod exactness;
mod fixed_point;
mod influence;
mod operators;
mod small_scalars;
mod tabulated;

/// Runs a generic expression for each kernel that can make a density.
macro_rules! each_kernel {
    ($K:ident => $body:expr) => {
        sph_core::for_each_kernel!(each_kernel; $K => $body)
    };
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $K:ident => $body:expr) => {{
        $({
            type $K = sph_core::kernel::$Kernel;
            if !<$K as sph_core::kernel::Kernel>::SINGULAR {
                $body
            }
        })+
    }};
}
pub(crate) use each_kernel;

/// |found − expected| ≤ tolerance · scale, said with the figures when it is not so.
#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (found - expected).abs();
    assert!(error <= tolerance, "{what}: found {found:e}, expected {expected:e}, off by {error:e}");
}

/// The name of a type without its path.
fn name<K>() -> &'static str {
    let path = std::any::type_name::<K>();
    path.rsplit("::").next().unwrap_or(path)
}

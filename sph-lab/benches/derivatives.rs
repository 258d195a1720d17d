//! Holds the derivatives of dual numbers against the library's gradients at a million points of each kernel and dimension (Thm 2.4), and of
//! fields (Thm 3.3): `cargo bench -p sph-lab --bench derivatives`. Ends with an error where one is too far off.

use sph_core::kernel::{self, Kernel};

#[path = "../tests/common/derivatives.rs"]
mod derivatives;
#[path = "../tests/common/double_double.rs"]
mod double_double;
#[path = "../tests/common/random.rs"]
mod random;

/// Points of each kernel in each dimension.
const POINTS: usize = 1_000_000;
/// Points of each field.
const FIELD_POINTS: usize = 10_000;

fn hold<K: Kernel>(name: &str) {
    let kernel = [
        derivatives::kernel::<K, 1>(POINTS),
        derivatives::kernel::<K, 2>(POINTS),
        derivatives::kernel::<K, 3>(POINTS),
    ];
    let fields = [
        derivatives::fields::<K, 1>(FIELD_POINTS),
        derivatives::fields::<K, 2>(FIELD_POINTS),
        derivatives::fields::<K, 3>(FIELD_POINTS),
    ];
    println!("{name:16} W: dual from exact, ∇W from exact, dual from ∇W {kernel:5.2?} ε");
    println!("{:16} fields: density, value, Shepard's form {fields:5.1?} ε", "");
    // the powers of these two cancel near r = 0, where they are 17 times the steepest slope and more
    let limit = if ["quartic-spline", "quintic-spline"].contains(&name) { 30.0 } else { 8.0 };
    let holds = kernel.iter().flatten().all(|worst| *worst <= limit);
    assert!(holds, "expected at most {limit} ε of the steepest slope");
    assert!(
        fields.iter().flatten().all(|worst| *worst <= 100.0),
        "expected at most 100 ε of the largest gradient"
    );
}

macro_rules! kernels {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        [$(($name, kernel::$Kernel::SINGULAR, hold::<kernel::$Kernel> as fn(&str))),+]
    };
}

fn main() {
    for (name, is_singular, hold) in sph_core::for_each_kernel!(kernels) {
        if !is_singular {
            hold(name);
        }
    }
}

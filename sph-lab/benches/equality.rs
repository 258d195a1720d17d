//! Holds the emulation against every compiled format, in three overflow modes, with every kernel, in one to three dimensions:
//! `cargo bench -p sph-lab --bench equality`. The tests hold a part of it, since this compiles for minutes.

use sph_core::kernel::{self, Kernel};
use sph_core::scalar::fixed::*;

#[path = "../tests/equals_compiled/fields.rs"]
mod fields;
#[path = "../tests/common/random.rs"]
mod random;

/// Points of each comparison.
const POINTS: usize = 300;

/// All modes of a format in all dimensions.
macro_rules! formats {
    ([$($Format:ident $name:tt $about:tt;)+]) => {
        fn formats<K: Kernel>() -> usize {
            let mut count = 0;
            $(
                count += modes::<Saturating<$Format>, K>();
                count += modes::<Wrapping<$Format>, K>();
                count += modes::<Checked<$Format>, K>();
            )+
            count
        }
    };
}
sph_core::for_each_format!(formats);

fn modes<T: sph_core::Scalar, K: Kernel>() -> usize {
    fields::compare::<T, K, 1>(POINTS)
        + fields::compare::<T, K, 2>(POINTS)
        + fields::compare::<T, K, 3>(POINTS)
}

macro_rules! kernels {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        [$(($name, formats::<kernel::$Kernel> as fn() -> usize)),+]
    };
}

fn main() {
    let mut all = 0;
    for (name, formats) in sph_core::for_each_kernel!(kernels) {
        let count = formats();
        println!("{name:16} {count:8} numbers are equal");
        all += count;
    }
    println!("{all} numbers are equal");
}

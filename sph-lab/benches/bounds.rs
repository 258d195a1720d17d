//! Holds intervals and running bounds in a million cases each, and says how tight the bounds are:
//! `cargo bench -p sph-lab --bench bounds`. Ends with an error where one does not hold.

use sph_core::kernel::{self, Kernel};
use sph_lab::Format;

#[path = "../tests/common/bounds.rs"]
mod bounds;
#[path = "../tests/common/double_double.rs"]
mod double_double;
#[path = "../tests/common/random.rs"]
mod random;

/// Cases of each kernel and dimension.
const CASES: u64 = 360;

/// Holds one kernel; returns how many intervals and bounds were held.
fn hold<K: Kernel>(name: &str) -> [usize; 2] {
    let mut held = [0; 2];
    let formats = [Format::new(9, 12), Format::new(9, 14), Format::new(8, 24), Format::new(12, 20)];
    let formats = formats.map(|format| format.expect("a format"));
    // ratio of the largest bound to the largest error, the worst case of each quantity, and its mean
    let mut worst = [0.0_f64; 3];
    let mut sum = [0.0; 3];
    let mut count = 0.0;
    for number in 0..CASES {
        held[0] += bounds::hold_intervals::<K, 1>(number);
        held[0] += bounds::hold_intervals::<K, 2>(number);
        held[0] += bounds::hold_intervals::<K, 3>(number);
        let format = formats[(number % 4) as usize];
        let mut one_case = |hold: fn(u64, Format, &mut bounds::Sizes) -> usize| {
            let mut sizes = [[0.0; 2]; 3];
            held[1] += hold(number, format, &mut sizes);
            count += 1.0;
            for (kind, [bound, error]) in sizes.into_iter().enumerate() {
                worst[kind] = worst[kind].max(bound / error);
                sum[kind] += bound / error;
            }
        };
        one_case(bounds::hold_bounds::<K, 1>);
        one_case(bounds::hold_bounds::<K, 2>);
        one_case(bounds::hold_bounds::<K, 3>);
    }
    let mean = sum.map(|sum| sum / count);
    println!(
        "{name:16} {:7} intervals {:7} bounds hold; bound / error of density {:5.1} (worst {:6.1}), value {:5.1} ({:6.1}), gradient {:5.1} ({:6.1})",
        held[0], held[1], mean[0], worst[0], mean[1], worst[1], mean[2], worst[2],
    );
    held
}

macro_rules! kernels {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        [$(($name, kernel::$Kernel::SINGULAR, hold::<kernel::$Kernel> as fn(&str) -> [usize; 2])),+]
    };
}

fn main() {
    let mut all = [0; 2];
    for (name, is_singular, hold) in sph_core::for_each_kernel!(kernels) {
        if !is_singular {
            let held = hold(name);
            all = [all[0] + held[0], all[1] + held[1]];
        }
    }
    println!("{} intervals and {} bounds hold", all[0], all[1]);
    assert!(all.iter().all(|&held| held >= 1_000_000), "expected a million of each");
}

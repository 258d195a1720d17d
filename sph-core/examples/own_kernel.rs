//! A kernel of one's own: Lucy's (1977), f(q) = (1 − q)³ (1 + 3q), checked and used for a density.
//!
//! `cargo run -p sph-core --example own_kernel`

use sph_core::kernel::{Kernel, Term, conformance};
use sph_core::{Arithmetic, BruteForce, Error, KernelInfluence, Sources, Uniform};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Lucy;

impl Kernel for Lucy {
    // for moments without rounding; without it they come from quadrature
    const TERMS: &'static [Term] = &[Term::new(1.0, 1.0, 3, 0), Term::new(3.0, 1.0, 3, 1)];

    fn profile<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        p.pow::<3>() * (T::ONE + q.times(3))
    }

    fn slope<T: Arithmetic>(q: T) -> T {
        let p = (T::ONE - q).positive_part();
        (q * p.pow::<2>()).times(-12)
    }
}

pub(crate) fn main() -> Result<(), Error> {
    // the laws of a kernel: run this in your tests
    assert_eq!(conformance::check::<Lucy, f32>(), Ok(()));

    // a lattice of spacing 0.25 and density 1, weighted with h = 1
    let positions: Vec<[f64; 2]> =
        (0..100).map(|i| [0.25 * f64::from(i % 10), 0.25 * f64::from(i / 10)]).collect();
    let w = KernelInfluence::<f64, 2, Lucy>::new(1.0)?;
    assert!((w.normalisation() - 5.0 / std::f64::consts::PI).abs() < 1e-14); // Lucy's own constant
    let density = Sources::new(BruteForce::new(&positions)?, Uniform(0.0625))?.density_at(&w, &[1.1, 1.2]);
    println!("density {density:.6}");
    assert!((density - 1.0).abs() < 1e-3);
    Ok(())
}

//! Fields in a compiled type and in its emulation.

use sph_core::kernel::Kernel;
use sph_core::{BruteForce, Error, Field, KernelInfluence, Scalar, Sources, Uniform};
use sph_lab::{Emulated, Format};

use super::random::Random;

/// Densities, interpolation and gradients at some points, as bits; a refusal is a result too.
fn numbers<T: Scalar, K: Kernel, const D: usize>(points: usize) -> Result<Vec<u64>, Error> {
    let mut random = Random(7);
    let mut place = || -> [T; D] { [0; D].map(|_| T::from_f64(1.5 * random.next())) };
    let positions: Vec<[T; D]> = (0..24).map(|_| place()).collect();
    let at: Vec<[T; D]> = (0..points).map(|_| place()).collect();
    let carried: Vec<T> = (0..24).map(|_| T::from_f64(2.0 * random.next() - 1.0)).collect();
    let volumes: Vec<T> = (0..24).map(|_| T::from_f64(0.1 * random.next() + 0.02)).collect();
    let w = KernelInfluence::<T, D, K>::new(T::from_f64(0.8))?;
    let sources = Sources::new(BruteForce::open(&positions)?, &volumes[..])?;
    let equal = Sources::new(BruteForce::open(&positions)?, Uniform(T::ratio(1, 9)))?;
    let field = Field::new(&sources, &carried[..])?;
    let mut bits = vec![u64::from(w.check_gradient().is_ok())];
    let mut add = |number: T| bits.push(number.canonical_bits());
    for x in &at {
        add(sources.density_at(&w, x));
        add(equal.equal_density_at(&w, x));
        field.gradient_at(&w, x).into_iter().for_each(&mut add);
        add(field.interpolate_at(&w, x));
        if let Some(fit) = field.corrected_at(&w, x) {
            add(fit.value);
            fit.gradient.into_iter().for_each(&mut add);
        }
    }
    Ok(bits)
}

/// Holds an emulation against its compiled type T; returns how many numbers were equal.
pub(crate) fn compare<T: Scalar, K: Kernel, const D: usize>(points: usize) -> usize {
    let compiled = numbers::<T, K, D>(points);
    let emulated = T::NAME.parse::<Format>().unwrap().scope(|| numbers::<Emulated, K, D>(points));
    assert_eq!(emulated, compiled, "{} in {D} dimensions", T::NAME);
    compiled.map_or(1, |bits| bits.len())
}

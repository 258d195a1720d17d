//! Intervals and running bounds around fields of particles, held against numbers of 31 digits.

use std::cmp::Ordering;

use sph_core::kernel::Kernel;
use sph_core::{BruteForce, Field, KernelInfluence, Scalar, Sources};
use sph_lab::{Emulated, Format, Interval, Rounding, Running};

use super::double_double::DoubleDouble;
use super::random::Random;

/// Particles, with every number as an f64.
pub(crate) struct Case<const D: usize> {
    positions: Vec<[f64; D]>,
    volumes: Vec<f64>,
    values: Vec<f64>,
    support: f64,
}

/// Particles of a case.
const PARTICLES: usize = 30;

impl<const D: usize> Case<D> {
    /// Particles in a box about as large as some supports, on a jittered lattice or, for an even number, so that distances are
    /// just the support radius.
    pub(crate) fn new(number: u64) -> Self {
        let mut random = Random(number.wrapping_mul(0x9E37_79B9_7F4A_7C15) + 1);
        let support = 0.6 + 0.8 * random.next();
        let is_at_the_edge = number.is_multiple_of(2);
        let side = [PARTICLES, 6, 4][D - 1];
        let spacing = if is_at_the_edge { support / 2.0 } else { support * [0.12, 0.45, 0.6][D - 1] };
        let positions = (0..PARTICLES).map(|n| {
            let mut rest = n;
            [0; D].map(|_| {
                let place = (rest % side) as f64 - side as f64 / 2.0;
                rest /= side;
                let jitter = if is_at_the_edge { 0.0 } else { random.next() - 0.5 };
                (place + 0.6 * jitter) * if D == 1 { spacing.min(3.0 / side as f64) } else { spacing }
            })
        });
        let positions = positions.collect();
        let volumes = (0..PARTICLES).map(|_| spacing.powi(D as i32) * (0.8 + 0.4 * random.next())).collect();
        let values = (0..PARTICLES).map(|_| 2.0 * random.next() - 1.0).collect();
        Self { positions, volumes, values, support }
    }
}

/// Densities, values and gradients at all particles; `convert` makes a number of an f64.
fn fields<T: Scalar, K: Kernel, const D: usize>(case: &Case<D>, mut convert: impl FnMut(f64) -> T) -> Vec<T> {
    let positions: Vec<[T; D]> = case.positions.iter().map(|x| x.map(&mut convert)).collect();
    let volumes: Vec<T> = case.volumes.iter().map(|&volume| convert(volume)).collect();
    let values: Vec<T> = case.values.iter().map(|&value| convert(value)).collect();
    let w = KernelInfluence::<T, D, K>::new(T::from_f64(case.support)).expect("a support radius in range");
    let sources = Sources::assume_checked(BruteForce::open(&positions).expect("finite"), &volumes[..]);
    let field = Field::new(&sources, &values[..]).expect("a value for each");
    let mut found = Vec::new();
    for x in &positions {
        found.extend([sources.density_at(&w, x), field.interpolate_at(&w, x)]);
        found.extend(field.gradient_at(&w, x));
    }
    found
}

/// Holds intervals of a case; returns how many numbers were held. Inputs are intervals of some width about the f64s, or points, and
/// the truth is at numbers somewhere within.
pub(crate) fn hold_intervals<K: Kernel, const D: usize>(number: u64) -> usize {
    let case = Case::<D>::new(number);
    let radius = [0.0, 1e-9, 1e-4][(number % 3) as usize];
    let enclosed = fields::<Interval, K, D>(&case, |x| Interval::around(x, radius));
    let mut random = Random(number);
    let truth = fields::<DoubleDouble, K, D>(&case, |x| {
        DoubleDouble::from_f64(x + 0.999 * radius * (2.0 * random.next() - 1.0))
    });
    for (interval, truth) in enclosed.iter().zip(&truth) {
        let is_held = truth.compare(interval.lower()) != Ordering::Less
            && truth.compare(interval.upper()) != Ordering::Greater;
        assert!(is_held, "case {number}: {truth:?} is not in {interval:?}");
    }
    enclosed.len()
}

/// The largest bound and the largest error of the numbers of a case, for density, value and gradient.
pub(crate) type Sizes = [[f64; 2]; 3];

/// Holds running bounds of a case in a format; returns how many numbers were held.
pub(crate) fn hold_bounds<K: Kernel, const D: usize>(
    number: u64,
    format: Format,
    sizes: &mut Sizes,
) -> usize {
    let case = Case::<D>::new(number);
    let truth = fields::<DoubleDouble, K, D>(&case, DoubleDouble::from_f64);
    let found = format.scope(|| {
        let plain = fields::<Emulated, K, D>(&case, Emulated::from_f64);
        let before = Running::undecided();
        let bounded = fields::<Running, K, D>(&case, Running::from_f64);
        // by chance the same sum is rounded otherwise
        let is_same_again = !matches!(format.rounding(), Rounding::Stochastic { .. });
        let is_decided = Running::undecided() == before && is_same_again;
        let numbers = bounded.iter().zip(&plain).map(|(one, plain)| {
            let is_same = one.value().canonical_bits() == plain.canonical_bits();
            assert!(is_same || !is_decided, "case {number}, {format}: {one:?} {plain:?}");
            let plain = if is_same_again { *plain } else { one.value() };
            (one.to_f64(), one.bound_of(plain), plain.to_f64())
        });
        numbers.collect::<Vec<_>>()
    });
    for (index, ((value, bound, plain), truth)) in found.iter().zip(&truth).enumerate() {
        let error = |value: f64| (DoubleDouble::from_f64(value) - *truth).0.abs();
        let own = error(*value);
        assert!(own <= *bound, "case {number}, {format}: {value} is {own:e} from the truth, bound {bound:e}");
        let error = error(*plain);
        assert!(
            error <= *bound,
            "case {number}, {format}: {plain} is {error:e} from the truth, bound {bound:e}"
        );
        let kind = (index % (2 + D)).min(2);
        sizes[kind] = [sizes[kind][0].max(*bound), sizes[kind][1].max(error)];
    }
    found.len()
}

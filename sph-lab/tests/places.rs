//! Numbers that watch: the bits of what they watch, and faults planted on purpose, found at their line.

use sph_core::kernel::{Kernel, Poly6, WendlandC2};
use sph_core::scalar::fixed::{Checked, I4F12, I8F24, I16F16, Saturating};
use sph_core::{Arithmetic, BruteForce, Field, Influence, KernelInfluence, Scalar, Sources, Uniform};
use sph_lab::{Blame, Emulated, Format, Operation, Record, Shadow, Tally, blame, watch};

#[path = "common/random.rs"]
mod random;

use random::Random;

/// Densities, values and gradients at some particles of a jittered row or plane, h = 0.8.
fn fields<T: Scalar, K: Kernel, const D: usize>() -> Vec<T> {
    let mut random = Random(11);
    let positions: Vec<[T; D]> =
        (0..40).map(|_| [0; D].map(|_| T::from_f64(2.4 * random.next() - 1.2))).collect();
    let weights: Vec<T> = (0..40).map(|_| T::from_f64(0.05 + 0.05 * random.next())).collect();
    let values: Vec<T> = (0..40).map(|_| T::from_f64(2.0 * random.next() - 1.0)).collect();
    let w = KernelInfluence::<T, D, K>::new(T::ratio(4, 5)).unwrap();
    let sources = Sources::new(BruteForce::open(&positions).unwrap(), &weights[..]).unwrap();
    let field = Field::new(&sources, &values[..]).unwrap();
    let mut found = Vec::new();
    for x in &positions {
        found.extend([sources.density_at(&w, x), field.interpolate_at(&w, x)]);
        found.extend(field.gradient_at(&w, x));
    }
    found
}

fn bits<T: Scalar>(numbers: Vec<T>) -> Vec<u64> {
    numbers.into_iter().map(Scalar::canonical_bits).collect()
}

#[test]
fn who_watches_changes_no_bit() {
    fn holds<T: Scalar, const D: usize>() {
        let plain = bits(fields::<T, WendlandC2, D>());
        assert_eq!(watch(|| bits(fields::<Tally<T>, WendlandC2, D>())).0, plain);
        assert_eq!(watch(|| bits(fields::<Shadow<T>, WendlandC2, D>())).0, plain);
        assert_eq!(bits(fields::<Tally<Shadow<T>>, WendlandC2, D>()), plain, "not watched");
    }
    holds::<f64, 1>();
    holds::<f32, 2>();
    holds::<Saturating<I8F24>, 1>();
    holds::<Saturating<I16F16>, 2>();
    holds::<Checked<I16F16>, 3>();
    Format::new(7, 17).unwrap().scope(holds::<Emulated, 2>);
    assert_eq!(bits(fields::<Blame, Poly6, 2>()), bits(fields::<f64, Poly6, 2>()));
}

/// The record of an operation on a line of this file.
fn at(places: &[Record], line: u32, operation: Operation) -> &Record {
    let is_it = |record: &&Record| {
        let place = &record.place;
        (place.line(), place.operation()) == (line, operation) && place.file().ends_with("places.rs")
    };
    places.iter().find(is_it).expect("a record of the line")
}

#[test]
fn a_place_tells_how_large_its_results_are() {
    type Real = Tally<f64>;
    let (_, log) = watch(|| {
        for n in [1, -2, 3, 5] {
            let _ = Real::ratio(n, 1) * Real::from_f64(0.25);
        }
        Real::from_f64(1.0) - Real::from_f64(1.0 + 1.0 / 1024.0)
    });
    let product = at(log.places(), line!() - 4, Operation::Multiply);
    assert_eq!((product.count, product.lowest, product.highest), (4, -0.5, 1.25));
    assert_eq!((product.least, product.largest(), product.bits()), (0.25, 1.25, 3));
    assert_eq!(product.exponents().collect::<Vec<_>>(), [(-2, 1), (-1, 2), (0, 1)]);
    let difference = at(log.places(), line!() - 6, Operation::Subtract);
    assert_eq!((difference.cancelled, difference.vanished), (1, 0));
    let (_, log) = watch(|| Tally::<Saturating<I4F12>>::ratio(1, 4096) * Tally::ratio(1, 4096));
    assert_eq!(at(log.places(), line!() - 1, Operation::Multiply).vanished, 1);
}

/// 1 − r² where the distance is far beyond: the square leaves the range, and nothing comes of it.
fn closeness<T: Scalar>(distance: T) -> T {
    (T::ONE - distance * distance).positive_part()
}

#[test]
fn a_saturation_counts_where_something_comes_of_it() {
    type Real = Tally<Saturating<I4F12>>;
    let (_, log) = watch(|| [5.0, 0.5, -7.0].map(|x| closeness(Real::from_f64(x)).to_f64()));
    assert_eq!((log.saturations().harmless(), log.saturations().consequential()), (2, 0));

    // a comparison that comes out as it would without an end of the range, and one that does not
    let compare = |limit: f64| {
        let square = Real::from_f64(3.0) * Real::from_f64(3.0);
        let sum = square - Real::from_f64(1.5);
        sum < Real::from_f64(limit)
    };
    let (is_below, log) = watch(|| compare(6.0));
    assert_eq!((is_below, log.saturations().harmless()), (false, 1));
    let (is_below, log) = watch(|| compare(7.0));
    assert_eq!((is_below, log.saturations().consequential()), (true, 1));
    assert_eq!(at(log.places(), line!() - 8, Operation::Multiply).consequential, 1);
}

#[test]
fn a_watch_ends_with_its_work_even_in_a_panic() {
    type Real = Tally<Saturating<I4F12>>;
    let (inner, log) = watch(|| {
        let _ = Real::ratio(1, 2) + Real::ONE;
        let inner = watch(|| Real::ratio(1, 2) + Real::ONE).1;
        let caught = std::panic::catch_unwind(|| watch(|| -> () { panic!("within") }));
        assert!(caught.is_err());
        let _ = Real::ratio(1, 2) + Real::ONE;
        inner
    });
    let count = |log: &sph_lab::Log| log.places().iter().map(|record| record.count).sum::<u64>();
    assert_eq!((count(&inner), count(&log)), (2, 4));
    let mut both = inner;
    both.merge(log);
    assert_eq!(count(&both), 6);
    let _ = Real::ONE + Real::ONE; // nobody watches
    assert!(both.to_string().lines().count() == both.places().len() + 1);
}

/// A kernel of one's own, 35/32 (1 − r²)³ in one dimension, whose constant is coarsened by four bits on purpose.
#[derive(Clone, Copy)]
struct Planted;

/// The line of the fault.
const PLANTED: u32 = line!() + 8;

impl<T: Scalar> Influence<T, 1> for Planted {
    fn support_radius(&self) -> T {
        T::ONE
    }

    fn influence(&self, distance_squared: T) -> T {
        let constant = (T::ratio(35, 32) * T::ratio(3, 100)).times(100) * T::ratio(1, 3);
        (T::ONE - distance_squared).positive_part().pow::<3>() * constant
    }

    fn gradient(&self, x: &[T; 1], distance_squared: T) -> [T; 1] {
        [(T::ONE - distance_squared).positive_part().pow::<2>() * T::ratio(-105, 16) * x[0]]
    }
}

/// Densities along a row with that kernel.
fn row<T: Scalar>() -> Vec<f64> {
    let positions: Vec<[T; 1]> = (0..12).map(|n| [T::from_f64(0.23 * f64::from(n) - 1.27)]).collect();
    let sources = Sources::new(BruteForce::open(&positions).unwrap(), Uniform(T::from_f64(0.23))).unwrap();
    positions.iter().map(|x| sources.density_at(&Planted, x).to_f64()).collect()
}

#[test]
fn blame_finds_a_constant_that_was_coarsened() {
    let exact = row::<f64>();
    let error = |found: &Vec<f64>| found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let format = Format::new(4, 12).unwrap();
    let mut places = blame(format, row::<Blame>);
    let again = blame(format, row::<Blame>);
    assert_eq!(places, again, "the same on every run");
    places.sort_by(|a, b| error(&b.alone).total_cmp(&error(&a.alone)));
    let first = &places[0];
    assert_eq!((first.place.line(), first.place.operation()), (PLANTED, Operation::Multiply));
    assert!(error(&first.alone) > 4.0 * error(&places[2].alone));
    assert!(error(&first.without) < 0.5 * error(&first.alone));
}

#[test]
fn a_shadow_finds_it_too() {
    let (_, log) = watch(row::<Shadow<Saturating<I4F12>>>);
    let mut places: Vec<&Record> = log.places().iter().collect();
    places.sort_by(|a, b| b.errors.global.total_cmp(&a.errors.global));
    let first = places.iter().take(2).find(|record| record.place.operation() == Operation::Times);
    let first = first.expect("the constant times 100 is among the two farthest from the truth");
    assert_eq!(first.place.line(), PLANTED);
    assert!(first.errors.global > 4.0 / 4096.0 && first.errors.local == 0.0, "{:?}", first.errors);
}

/// One intermediate that leaves the range.
#[test]
fn a_tally_finds_an_intermediate_that_saturates() {
    type Real = Tally<Saturating<I4F12>>;
    let (_, log) = watch(|| {
        let slope = Real::from_f64(-3.0);
        let steep = slope * Real::from_f64(4.0); // −12 is beyond −8
        (steep * Real::ratio(1, 8)).to_f64()
    });
    let record = at(log.places(), line!() - 3, Operation::Multiply);
    assert_eq!((record.saturated, record.consequential), (1, 1));
    assert_eq!(log.saturations().consequential(), 1);
}

#[test]
fn a_shadow_is_anchored_anew() {
    type Real = Shadow<Saturating<I4F12>>;
    let third = Real::from_f64(1.0) / Real::from_f64(3.0);
    assert!(third.truth() != third.value().to_f64());
    assert_eq!(third.anchored().truth(), third.value().to_f64());
    let (_, log) = watch(|| [third <= Real::from_f64(0.33331), third < Real::from_f64(0.5)]);
    assert_eq!(log.comparisons(), (1, 2), "both are 1365 units, but 1/3 is not below 0.33331");
}

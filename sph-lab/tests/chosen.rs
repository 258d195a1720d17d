//! A number whose type is chosen when the program runs has the bits of that type.

use sph_core::kernel::{Tabulated, WendlandC4};
use sph_core::scalar::Table;
use sph_core::{Accumulator, Arithmetic, BruteForce, Field, Influence, KernelInfluence, Scalar, Sources};
use sph_lab::{Blame, Choice, Chosen, Emulated, Format, Mini, MiniFormat, Running, Tally, watch};

struct Row;

impl Table<1, 2> for Row {
    const VALUES: [[f64; 2]; 1] = [[0.3, -1.0]];
}

/// The results of every operation, and of fields, as bits.
fn bits<T: Scalar>() -> Vec<u64> {
    let number = |n: i32| T::from_f64(0.37 * f64::from(n) - 1.1);
    let mut found = vec![T::ZERO, T::ONE, T::EPSILON, T::MAX, T::default()];
    let mut flags = Vec::new();
    for n in 0..8 {
        let (a, b) = (number(n), number((5 * n) % 8));
        found.extend([a + b, a - b, a * b, a / b, -a, a.times(n), T::ratio(n, 7), a.positive_part()]);
        found.extend([
            Scalar::abs(a).sqrt(),
            Scalar::abs(a),
            Scalar::min(a, b),
            Scalar::max(a, b),
            a.pow::<3>(),
        ]);
        let (place, rest) = Scalar::max(a, T::ZERO).split(5);
        found.push(rest);
        let mut sum = T::Sum::ZERO;
        sum.add(a);
        sum.add(b);
        found.extend([sum.total(), sum.scaled_total(a, b)]);
        found.extend(T::constant::<Row, 1, 2>(0, 1));
        flags.extend([a < b, a <= b, a > b, a >= b, a == b, a.is_finite(), a.is_above_zero()].map(u64::from));
        flags.extend([
            place as u64,
            a.floor_to_i32() as u64,
            a.to_f64().to_bits(),
            u64::from(a.partial_cmp(&b).is_none()),
        ]);
    }
    let positions: Vec<[T; 2]> = (0..9).map(|n| [T::ratio(n % 3, 4), T::ratio(n / 3, 4)]).collect();
    let weights = [T::ratio(1, 16); 9];
    let sources = Sources::new(BruteForce::open(&positions).unwrap(), &weights).unwrap();
    let field = Field::new(&sources, &weights).unwrap();
    let w = KernelInfluence::<T, 2, WendlandC4>::new(T::ONE).unwrap();
    let table = KernelInfluence::<T, 2, Tabulated<WendlandC4, 33>>::new(T::ONE).unwrap();
    for x in &positions {
        found.extend([sources.density_at(&w, x), field.interpolate_at(&w, x), table.influence_at(x)]);
        found.extend(field.gradient_at(&w, x));
    }
    found.into_iter().map(Scalar::canonical_bits).chain(flags).collect()
}

#[test]
fn the_bits_are_those_of_the_type() {
    let format = Format::new(9, 14).unwrap();
    assert_eq!(Choice::Emulated(format).scope(bits::<Chosen>), format.scope(bits::<Emulated>));
    assert_eq!(Choice::Running(format).scope(bits::<Chosen>), format.scope(bits::<Running>));
    assert_eq!(Choice::Blame.scope(bits::<Chosen>), bits::<Blame>());
    for mini in MiniFormat::ALL {
        assert_eq!(Choice::Mini(mini).scope(bits::<Chosen>), mini.scope(bits::<Mini>));
    }
    let (chosen, log) = watch(|| Choice::Tally(format).scope(bits::<Chosen>));
    assert_eq!((chosen, log), watch(|| format.scope(bits::<Tally<Emulated>>)), "and tells the same places");
}

#[test]
fn a_scope_ends_with_its_work() {
    let before = Choice::current();
    let format = Format::new(3, 13).unwrap();
    Choice::Tally(format).scope(|| {
        assert_eq!(Choice::current(), Choice::Tally(format));
        let caught = std::panic::catch_unwind(|| Choice::Blame.scope(|| panic!("within")));
        assert!(caught.is_err());
        assert_eq!(Choice::current(), Choice::Tally(format));
    });
    assert_eq!(Choice::current(), before);
    std::thread::spawn(move || {
        Choice::Mini(MiniFormat::BF16).enter();
        assert_eq!(Choice::current(), Choice::Mini(MiniFormat::BF16));
    })
    .join()
    .unwrap();
    Choice::Running(format).scope(|| {
        let third = Chosen::ratio(1, 3);
        assert!(third.running().unwrap().bound() > 0.0 && third.emulated().is_none());
    });
}

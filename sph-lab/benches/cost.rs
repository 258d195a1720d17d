//! What each number type costs beside f64: `cargo bench -p sph-lab --bench cost`. Times are of one thread; look at the ratios.

use std::time::Instant;

use sph_core::kernel::WendlandC2;
use sph_core::scalar::fixed::{I16F16, Saturating};
use sph_core::{CellGrid, CellLayout, Field, KernelInfluence, Scalar, Sources, Uniform};
use sph_lab::{Blame, Dual, Emulated, Format, Interval, Mini, MiniFormat, Running, Shadow, Tally, watch};

#[path = "../tests/common/random.rs"]
mod random;

use random::Random;

/// Particles along an axis of a jittered lattice of spacing 1, in units of h.
const SIDE: usize = 101;
/// h over the spacing, for 20 neighbours.
const REACH: f64 = 2.523;

/// Seconds for the densities and gradients at all particles.
fn seconds<T: Scalar>() -> f64 {
    let mut random = Random(7);
    let mut jitter = || 0.2 * random.signed();
    let place = |index: usize, jitter: f64| (index as f64 - SIDE as f64 / 2.0 + jitter) / REACH;
    let positions: Vec<[T; 2]> = (0..SIDE * SIDE)
        .map(|n| [T::from_f64(place(n % SIDE, jitter())), T::from_f64(place(n / SIDE, jitter()))])
        .collect();
    let volume = T::from_f64(1.0 / (REACH * REACH));
    let values: Vec<T> = positions.iter().map(|[x, _]| T::from_f64(0.04 * x.to_f64())).collect();
    let corner = T::from_f64(SIDE as f64 / 2.0 / REACH + 0.1);
    let layout = CellLayout::bounded(&[-corner; 2], &[corner; 2], [40; 2]).unwrap();
    let (mut starts, mut entries) = (vec![0_u32; layout.cells() + 1], vec![0_u32; positions.len()]);
    let grid = CellGrid::build(layout, &positions, &mut starts, &mut entries).unwrap();
    let sources = Sources::new(grid, Uniform(volume)).unwrap();
    let field = Field::new(&sources, &values[..]).unwrap();
    let w = KernelInfluence::<T, 2, WendlandC2>::new(T::ONE).unwrap();
    let start = Instant::now();
    let mut sum = 0.0;
    for x in &positions {
        sum += sources.density_at(&w, x).to_f64() + field.gradient_at(&w, x)[0].to_f64();
    }
    std::hint::black_box(sum);
    start.elapsed().as_secs_f64()
}

/// One type: its name, and a run of it.
type Entry = (&'static str, fn() -> f64);

fn in_format(integer_bits: u32, fraction_bits: u32, run: fn() -> f64) -> f64 {
    Format::new(integer_bits, fraction_bits).map_or(f64::NAN, |format| format.scope(run))
}

const ENTRIES: &[Entry] = &[
    ("f64", seconds::<f64>),
    ("compiled I16F16", seconds::<Saturating<I16F16>>),
    ("Emulated i7f17", || in_format(7, 17, seconds::<Emulated>)),
    ("Emulated i16f48", || in_format(16, 48, seconds::<Emulated>)),
    ("Mini f16", || MiniFormat::F16.scope(seconds::<Mini>)),
    ("Mini posit16", || MiniFormat::POSIT16.scope(seconds::<Mini>)),
    ("Tally<f64>", || watch(seconds::<Tally<f64>>).0),
    ("Tally<I16F16>", || watch(seconds::<Tally<Saturating<I16F16>>>).0),
    ("Tally<Emulated>", || in_format(7, 17, || watch(seconds::<Tally<Emulated>>).0)),
    ("Shadow<I16F16>", || watch(seconds::<Shadow<Saturating<I16F16>>>).0),
    ("Blame", seconds::<Blame>),
    ("Interval", seconds::<Interval>),
    ("Running i9f17", || in_format(9, 17, seconds::<Running>)),
    ("Dual<f64, 2>", seconds::<Dual<f64, 2>>),
];

/// Runs the types whose names contain the first argument, all without one.
fn main() {
    let wanted = std::env::args().nth(1).filter(|word| !word.starts_with("--")).unwrap_or_default();
    let best = |run: fn() -> f64| (0..3).map(|_| run()).fold(f64::INFINITY, f64::min);
    let f64_seconds = best(ENTRIES[0].1);
    for (name, run) in ENTRIES.iter().filter(|(name, _)| name.contains(&wanted)) {
        let seconds = best(*run);
        println!("{name:16} {:9.2} ms {:8.2} times f64", 1e3 * seconds, seconds / f64_seconds);
    }
}

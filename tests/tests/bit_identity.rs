//! The fixed scene has the digests of the golden file on this computer, from one thread and from two. `tests/on-target`
//! holds every other processor against the same file.

use fluisim_digest::{Fnv, POINTS, QUANTITIES, Scene, grid_layout, grid_storage};
use sph_core::scalar::fixed::{I8F24, I16F16, Saturating};
use sph_core::{BruteForce, Neighbours, Scalar};
use std::thread;

const GOLDEN: &str = include_str!("../on-target/digest/golden.txt");

#[test]
fn one_thread_gives_the_golden_digests() {
    let mut golden = GOLDEN.lines();
    fluisim_digest::all(|item| assert_eq!(Some(item.to_string().as_str()), golden.next())).unwrap();
    assert_eq!(golden.next(), None);
}

#[test]
fn two_threads_give_the_golden_digests() {
    by_both_searches::<f32, 2>();
    by_both_searches::<f32, 3>();
    by_both_searches::<f64, 2>();
    by_both_searches::<f64, 3>();
    by_both_searches::<Saturating<I16F16>, 2>();
    by_both_searches::<Saturating<I8F24>, 3>();
}

#[test]
fn every_quantity_is_defined_at_most_points() {
    let scene = filled::<f64, 2>();
    let undefined = points(&scene, BruteForce::new(scene.positions()).unwrap(), 0..POINTS)
        .into_iter()
        .filter(|(_, bits)| *bits == u64::MAX || *bits == f64::NAN.to_bits())
        .count();
    assert!(undefined < POINTS, "{undefined}");
}

fn filled<T: Scalar, const D: usize>() -> Scene<T, D> {
    let mut scene = Scene::empty();
    scene.fill().unwrap();
    scene
}

fn by_both_searches<T: Scalar, const D: usize>() {
    let scene = filled::<T, D>();
    in_two_threads("brute", &scene, BruteForce::new(scene.positions()).unwrap());
    let mut storage = grid_storage();
    in_two_threads("grid", &scene, storage.build(grid_layout().unwrap(), scene.positions()).unwrap());
}

/// Half of the points in each thread, digested in the order of the points.
fn in_two_threads<T: Scalar, const D: usize>(
    by: &str,
    scene: &Scene<T, D>,
    search: impl Neighbours<T, D> + Copy + Send + Sync,
) {
    let halves = thread::scope(|scope| {
        let first = scope.spawn(|| points(scene, search, 0..POINTS / 2));
        let second = scope.spawn(|| points(scene, search, POINTS / 2..POINTS));
        [first.join().unwrap(), second.join().unwrap()]
    });
    let mut digests = [Fnv::new(); QUANTITIES.len()];
    for (quantity, bits) in halves.concat() {
        digests[quantity].add(bits);
    }
    for (quantity, digest) in QUANTITIES.iter().zip(digests) {
        let line = format!("{} {D}d {by} {quantity} {:016x}", T::NAME, digest.get());
        assert!(GOLDEN.lines().any(|golden| golden == line), "{line} is not golden");
    }
}

fn points<T: Scalar, const D: usize>(
    scene: &Scene<T, D>,
    search: impl Neighbours<T, D> + Copy,
    range: std::ops::Range<usize>,
) -> Vec<(usize, u64)> {
    let mut found = Vec::new();
    for point in range {
        scene.at(search, point, |quantity, bits| found.push((quantity, bits))).unwrap();
    }
    found
}

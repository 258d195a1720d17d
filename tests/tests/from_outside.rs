//! Every open trait of `sph-core` is implemented from outside, with what is public. Kernel, scalar and container are those of the
//! examples, which run here.

use sph_core::kernel::{Kernel, WendlandC2};
use sph_core::scalar::fixed::{I16F16, Saturating};
use sph_core::{
    BruteForce, Field, Influence, InfluenceOf, KernelInfluence, Neighbour, Neighbours, Scalar, Sources,
    Uniform,
};

#[path = "../../sph-core/examples/own_container.rs"]
mod own_container;
#[path = "../../sph-core/examples/own_kernel.rs"]
mod own_kernel;
#[path = "../../sph-core/examples/own_scalar.rs"]
mod own_scalar;

#[test]
fn examples_hold() {
    own_kernel::main().unwrap();
    own_container::main().unwrap();
    own_scalar::main().unwrap();
}

/// A search that looks at every second sample first, then at the others: any order will do for a sum.
#[derive(Clone, Copy)]
struct EvenFirst<'a, T, const D: usize>(&'a [[T; D]]);

impl<T: Scalar, const D: usize> Neighbours<T, D> for EvenFirst<'_, T, D> {
    fn positions(&self) -> &[[T; D]] {
        self.0
    }

    fn for_each(&self, x: &[T; D], radius: T, visit: impl FnMut(Neighbour<T, D>)) {
        let count = self.0.len();
        (0..count)
            .step_by(2)
            .chain((1..count).step_by(2))
            .filter(|_| radius > T::ZERO)
            .filter_map(|j| Neighbour::within(j, x, &self.0[j], radius * radius))
            .for_each(visit);
    }
}

/// An influence that is the mean of two others: no kernel, but all that a sum needs.
struct Mean<A, B>(A, B);

impl<T: Scalar, const D: usize, A: Influence<T, D>, B: Influence<T, D>> Influence<T, D> for Mean<A, B> {
    fn support_radius(&self) -> T {
        self.0.support_radius().max(self.1.support_radius())
    }

    fn influence(&self, distance_squared: T) -> T {
        (self.0.influence(distance_squared) + self.1.influence(distance_squared)) * T::ratio(1, 2)
    }

    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        let (a, b) = (self.0.gradient(x, distance_squared), self.1.gradient(x, distance_squared));
        core::array::from_fn(|axis| (a[axis] + b[axis]) * T::ratio(1, 2))
    }
}

/// Influences of samples of two sizes.
#[derive(Clone, Copy)]
struct TwoSizes<'a, W>(&'a [W; 2]);

impl<'a, T: Scalar, const D: usize, W: Influence<T, D> + Copy> InfluenceOf<T, D> for TwoSizes<'a, W> {
    type Influence = &'a W;

    fn of(&self, j: usize) -> Option<&'a W> {
        self.0.get(j % 2)
    }

    fn reach(&self) -> T {
        self.0[0].support_radius().max(self.0[1].support_radius())
    }
}

fn lattice<T: Scalar>() -> Vec<[T; 2]> {
    (0..64).map(|i| [T::ratio(i % 8, 2), T::ratio(i / 8, 2)]).collect()
}

fn influence<T: Scalar, K: Kernel>(support_radius: T) -> KernelInfluence<T, 2, K> {
    KernelInfluence::new(support_radius).unwrap()
}

#[test]
fn a_search_from_outside_gives_the_sums_of_brute_force() {
    fn check<T: Scalar>(tolerance: f64) {
        let positions = lattice::<T>();
        let values: Vec<T> = positions.iter().map(|x| x[0] - x[1]).collect();
        let (w, volume) = (influence::<T, own_kernel::Lucy>(T::ratio(5, 4)), Uniform(T::ratio(1, 4)));
        let ours = Sources::new(EvenFirst(&positions), volume).unwrap();
        let theirs = Sources::new(BruteForce::new(&positions).unwrap(), volume).unwrap();
        let x = [T::ratio(17, 10), T::ratio(13, 10)];
        assert_eq!(ours.positions().len(), 64);
        assert_eq!(
            EvenFirst(&positions).count(&x, T::ONE),
            BruteForce::new(&positions).unwrap().count(&x, T::ONE)
        );
        assert_eq!(EvenFirst(&positions).count(&x, T::ZERO), 0);
        let a = Field::new(&ours, &values[..]).unwrap().corrected_at(&w, &x).unwrap();
        let b = Field::new(&theirs, &values[..]).unwrap().corrected_at(&w, &x).unwrap();
        assert!((a.value.to_f64() - b.value.to_f64()).abs() <= tolerance);
        assert!((a.value.to_f64() - 0.4).abs() <= 10.0 * tolerance);
    }
    check::<f64>(1e-14);
    check::<f32>(1e-6);
    check::<Saturating<I16F16>>(1e-3);
}

#[test]
fn influences_from_outside_serve_every_sum() {
    let positions = lattice::<f64>();
    let (wide, narrow) = (influence::<f64, WendlandC2>(1.25), influence::<f64, own_kernel::Lucy>(1.0));
    let mean = Mean(&wide, &narrow);
    let sources = Sources::new(BruteForce::new(&positions).unwrap(), Uniform(0.25)).unwrap();
    let x = [1.7, 1.3];
    let of_mean = sources.density_at(&mean, &x);
    let mean_of = (sources.density_at(&wide, &x) + sources.density_at(&narrow, &x)) / 2.0;
    assert!((of_mean - mean_of).abs() < 1e-14);
    assert!((sources.equal_density_at(&mean, &x) - mean_of).abs() < 1e-14);
    let (_, gradient) = sources.density_gradient_at(&mean, &x);
    let numeric = sph_core::difference::gradient(|x| sources.density_at(&mean, x), &x, 1e-5);
    assert!((gradient[0] - numeric[0]).abs() < 1e-8 && (gradient[1] - numeric[1]).abs() < 1e-8);

    let sizes = [influence::<f64, WendlandC2>(1.25), influence::<f64, WendlandC2>(1.0)];
    let by_hand: f64 = positions
        .iter()
        .enumerate()
        .map(|(j, p)| 0.25 * sizes[j % 2].influence_at(&[x[0] - p[0], x[1] - p[1]]))
        .sum();
    assert!((sources.density_at(TwoSizes(&sizes), &x) - by_hand).abs() < 1e-14);
}

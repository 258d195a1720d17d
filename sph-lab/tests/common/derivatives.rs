//! The derivatives that dual numbers carry, held against the library's gradients.

use sph_core::kernel::Kernel;
use sph_core::{BruteForce, Field, Influence, KernelInfluence, Scalar, Sources};
use sph_lab::Dual;

use super::double_double::DoubleDouble;
use super::random::Random;

fn length<const D: usize>(x: [f64; D]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn difference<const D: usize>(x: [f64; D], y: [f64; D]) -> [f64; D] {
    std::array::from_fn(|axis| x[axis] - y[axis])
}

/// How far the derivative of W and ∇W (Thm 2.4) are at most from the derivative in 31 digits, and from each other, at so many points in
/// and at the edge of the support, in ε of the steepest slope.
pub(crate) fn kernel<K: Kernel, const D: usize>(points: usize) -> [f64; 3] {
    type Fine<const D: usize> = Dual<DoubleDouble, D>;
    let support = 0.7;
    let w = KernelInfluence::<f64, D, K>::new(support).expect("a support radius");
    let dual = KernelInfluence::<Dual<f64, D>, D, K>::new(Dual::constant(support)).expect("a support radius");
    let fine_support = Dual::constant(DoubleDouble::from_f64(support));
    let fine = KernelInfluence::<Fine<D>, D, K>::new(fine_support).expect("a support radius");
    let on_axis = |q: f64| std::array::from_fn(|axis| if axis == 0 { q * support } else { 0.0 });
    let steepest =
        (1..400).map(|n| length(w.gradient_at(&on_axis(f64::from(n) / 400.0)))).fold(0.0, f64::max);
    let mut random = Random(D as u64);
    let mut worst = [0.0_f64; 3];
    for number in 0..points {
        let mut x: [f64; D] = [0.0; D].map(|_| support * random.signed());
        if number % 10 == 0 {
            // within some rounding of the edge
            let scale = support * (1.0 + 1e-15 * random.signed()) / length(x);
            x = x.map(|component| component * scale);
        }
        let found = dual.influence_at(&Dual::variables(x)).derivatives();
        let gradient = w.gradient_at(&x);
        let exact = fine.influence_at(&Dual::variables(x.map(DoubleDouble::from_f64)));
        let exact = exact.derivatives().map(DoubleDouble::to_f64);
        let pairs = [(found, exact), (gradient, exact), (found, gradient)];
        for (worst, (a, b)) in worst.iter_mut().zip(pairs) {
            *worst = worst.max(length(difference(a, b)));
        }
    }
    worst.map(|worst| worst / (f64::EPSILON * steepest))
}

/// The largest distance of the derivative of the interpolation by the place from the library's gradient (Thm 3.3), of density and of
/// Shepard's form likewise, in ε of the largest gradient.
pub(crate) fn fields<K: Kernel, const D: usize>(points: usize) -> [f64; 3] {
    let mut random = Random(100 + D as u64);
    let support = [0.4, 0.6, 0.9][D - 1];
    let positions: Vec<[f64; D]> = (0..60).map(|_| [0.0; D].map(|_| random.signed())).collect();
    let volumes: Vec<f64> = (0..60).map(|_| 0.05 + 0.01 * random.signed()).collect();
    let values: Vec<f64> = positions.iter().map(|x| x.iter().sum::<f64>().sin() + 2.0).collect();
    let dual = |number: &f64| Dual::<f64, D>::constant(*number);
    let places: Vec<[Dual<f64, D>; D]> = positions.iter().map(|x| x.map(|x| dual(&x))).collect();
    let [dual_volumes, dual_values] = [&volumes, &values].map(|all| all.iter().map(dual).collect::<Vec<_>>());
    let w = KernelInfluence::<f64, D, K>::new(support).expect("a support radius");
    let dual_w =
        KernelInfluence::<Dual<f64, D>, D, K>::new(Dual::constant(support)).expect("a support radius");
    let sources =
        Sources::new(BruteForce::open(&positions).expect("finite"), &volumes[..]).expect("positive");
    let dual_sources =
        Sources::new(BruteForce::open(&places).expect("finite"), &dual_volumes[..]).expect("positive");
    let field = Field::new(&sources, &values[..]).expect("a value for each");
    let dual_field = Field::new(&dual_sources, &dual_values[..]).expect("a value for each");
    let (mut largest, mut worst) = ([0.0_f64; 3], [0.0_f64; 3]);
    for _ in 0..points {
        let x = [0.0; D].map(|_| random.signed());
        let at = Dual::variables(x);
        let mut hold = |index: usize, gradient: [f64; D], found: Dual<f64, D>| {
            largest[index] = largest[index].max(length(gradient));
            worst[index] = worst[index].max(length(difference(found.derivatives(), gradient)));
        };
        hold(0, sources.density_gradient_at(&w, &x).1, dual_sources.density_at(&dual_w, &at));
        hold(1, field.gradient_at(&w, &x), dual_field.interpolate_at(&dual_w, &at));
        let shepard = field.shepard_gradient_at(&w, &x).zip(dual_field.shepard_at(&dual_w, &at));
        // where few samples are in reach the quotient is of numbers near 0
        if let Some(((_, gradient), found)) = shepard.filter(|_| sources.density_at(&w, &x) > 0.1) {
            hold(2, gradient, found);
        }
    }
    std::array::from_fn(|index| worst[index] / (f64::EPSILON * largest[index]))
}

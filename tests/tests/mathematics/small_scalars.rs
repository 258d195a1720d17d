//! What each scalar of a microcontroller makes of a density and of a gradient: the errors that the page on hardware states.

use sph_core::kernel::Poly6;
use sph_core::scalar::fast::Fast32;
use sph_core::scalar::fixed::{I4F12, I8F24, I16F16, Saturating, Wrapping};
use sph_core::{CellLayout, Field, InlineCellGrid, KernelInfluence, Scalar, Sources, Uniform};

/// 8 by 8 samples about a spacing of h/2, mass 1/4: density near 1 inside.
fn positions() -> Vec<[f64; 2]> {
    let place = |i: i32, axis: i32| f64::from((i * 37 + axis * 11) % 13 - 6) / 128.0;
    (0..64).map(|i| [f64::from(i % 8) / 2.0 + place(i, 0), f64::from(i / 8) / 2.0 + place(i, 1)]).collect()
}

/// Densities and gradients of x² / 8 at all samples.
fn compute<T: Scalar>() -> Vec<(f64, [f64; 2])> {
    let positions: Vec<[T; 2]> = positions().iter().map(|x| x.map(T::from_f64)).collect();
    let values: Vec<T> = positions.iter().map(|x| x[0] * T::ratio(1, 8) * x[0]).collect();
    // 16 bits hold no square of a distance above 2.8: a grid looks only at samples within 2 along each axis
    let mut storage = InlineCellGrid::<u8, 26, 64>::new();
    let (lower, upper) = ([-T::ratio(1, 2); 2], [T::ratio(9, 2); 2]);
    let layout = CellLayout::bounded(&lower, &upper, [5, 5]).unwrap().open();
    let search = storage.build(layout, &positions).unwrap();
    let sources = Sources::new(search, Uniform(T::ratio(1, 4))).unwrap();
    let field = Field::new(&sources, values.as_slice()).unwrap();
    let w = KernelInfluence::<T, 2, Poly6>::new(T::ONE).unwrap();
    let at = |x| (sources.equal_density_at(&w, x).to_f64(), field.gradient_at(&w, x).map(Scalar::to_f64));
    positions.iter().map(at).collect()
}

/// The largest errors against f64, in units of the density 1 and of the largest slope.
fn errors<T: Scalar>() -> (f64, f64) {
    let (mut of_density, mut of_gradient, mut steepest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ((density, gradient), (exact, slope)) in compute::<T>().into_iter().zip(compute::<f64>()) {
        of_density = of_density.max((density - exact).abs());
        for (found, exact) in gradient.into_iter().zip(slope) {
            of_gradient = of_gradient.max((found - exact).abs());
            steepest = steepest.max(exact.abs());
        }
    }
    (of_density, of_gradient / steepest)
}

/// The errors found and those stated, if they are not these, or are less than half of these.
fn off<T: Scalar>(of_density: f64, of_gradient: f64) -> Option<String> {
    let found = errors::<T>();
    let stated = |found: f64, bound: f64| bound / 2.0 < found && found <= bound;
    let holds = stated(found.0, of_density) && stated(found.1, of_gradient);
    (!holds).then(|| format!("{}: {found:?}, stated {of_density:e} {of_gradient:e}", T::NAME))
}

#[test]
fn errors_are_as_stated() {
    let wrong: Vec<String> = [
        off::<f32>(2e-7, 2e-7),
        off::<Fast32>(2e-7, 2e-7),
        off::<Saturating<I8F24>>(8e-8, 2e-7),
        off::<Saturating<I16F16>>(4e-5, 8e-5),
        off::<Saturating<I4F12>>(6e-4, 1.5e-3),
        off::<Wrapping<I4F12>>(6e-4, 1.5e-3),
    ]
    .into_iter()
    .flatten()
    .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

//! sph-core with every number type: any numbers are an error or a result, never a panic, and the searches agree.

use arbitrary::{Result, Unstructured};
use sph_core::scalar::fixed::{Check, Fixed, I8F24, I16F16, Wrap};
use sph_core::{
    BruteForce, CellGrid, CellLayout, Domain, Field, Influence, KernelInfluence, Neighbours, Scalar, Sources,
    difference, for_each_kernel, for_each_scalar, kernel,
};

use crate::numbers::{number, vector, vectors};

/// Samples at most: the time of an input is that of their pairs.
const MOST: usize = 12;

/// The first byte chooses the number type, the second the dimension.
pub fn core(data: &[u8]) {
    let Some((&[scalar, dim], rest)) = data.split_first_chunk() else { return };
    let mut bytes = Unstructured::new(rest);
    // Bytes that end too soon end the input.
    let _ = with_scalar(usize::from(scalar), usize::from(dim), &mut bytes);
}

macro_rules! choose {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+] $number:ident $dim:ident $bytes:ident) => {{
        let choices: &[fn(usize, &mut Unstructured) -> Result<()>] = &[
            $(in_dimensions::<$Scalar>,)+
            in_dimensions::<Fixed<I16F16, Wrap>>,
            in_dimensions::<Fixed<I8F24, Check>>,
        ];
        choices[$number % choices.len()]($dim, $bytes)
    }};
}

fn with_scalar(number: usize, dim: usize, bytes: &mut Unstructured) -> Result<()> {
    for_each_scalar!(choose; number dim bytes)
}

fn in_dimensions<T: Scalar>(dim: usize, bytes: &mut Unstructured) -> Result<()> {
    match dim % 3 {
        0 => everything::<T, 1>(bytes),
        1 => everything::<T, 2>(bytes),
        _ => everything::<T, 3>(bytes),
    }
}

/// A kernel's influence of any kind.
struct Any<'a, T, const D: usize>(&'a dyn Weight<T, D>);

trait Weight<T, const D: usize> {
    fn support_radius(&self) -> T;
    fn influence(&self, distance_squared: T) -> T;
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D];
}

impl<T: Scalar, K: kernel::Kernel, const D: usize> Weight<T, D> for KernelInfluence<T, D, K> {
    fn support_radius(&self) -> T {
        Influence::support_radius(self)
    }
    fn influence(&self, distance_squared: T) -> T {
        Influence::influence(self, distance_squared)
    }
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        Influence::gradient(self, x, distance_squared)
    }
}

impl<T: Scalar, const D: usize> Influence<T, D> for Any<'_, T, D> {
    fn support_radius(&self) -> T {
        self.0.support_radius()
    }
    fn influence(&self, distance_squared: T) -> T {
        self.0.influence(distance_squared)
    }
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        self.0.gradient(x, distance_squared)
    }
}

macro_rules! boxed {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $number:ident $h:ident) => {{
        type Made<T, const D: usize> = fn(T) -> Option<Box<dyn Weight<T, D>>>;
        let made: &[Made<T, D>] =
            &[$(|h| Some(Box::new(KernelInfluence::<T, D, kernel::$Kernel>::new(h).ok()?))),+];
        made[$number % made.len()]($h)
    }};
}

fn weight<T: Scalar, const D: usize>(number: usize, h: T) -> Option<Box<dyn Weight<T, D>>> {
    for_each_kernel!(boxed; number h)
}

fn everything<T: Scalar, const D: usize>(bytes: &mut Unstructured) -> Result<()> {
    let positions = vectors::<T, D>(bytes, MOST)?;
    let (x, radius) = (vector::<T, D>(bytes)?, number::<T>(bytes)?);
    let mut domain = Domain::open();
    if bytes.arbitrary()? {
        let (axis, lower, upper) = (bytes.arbitrary::<u8>()? % 4, number(bytes)?, number(bytes)?);
        domain = domain.periodic(axis.into(), lower, upper).unwrap_or(domain);
    }
    let _ = domain.wrap(&x);
    let counts = [bytes.int_in_range(0..=9)?; D];
    let (lower, upper) = (vector(bytes)?, vector(bytes)?);
    for layout in [CellLayout::bounded(&lower, &upper, counts), CellLayout::unbounded(radius, counts)] {
        agree(layout.ok(), &positions, &x, radius);
    }
    one_number::<T>(number(bytes)?, number(bytes)?, bytes.arbitrary()?);
    let Ok(search) = BruteForce::in_domain(&positions, domain) else { return Ok(()) };
    let number_of_kernel = usize::from(bytes.arbitrary::<u8>()?);
    // images beyond number are time: as many as fit into a period and a half
    let Some(boxed) = weight::<T, D>(number_of_kernel, number(bytes)?) else { return Ok(()) };
    let w = Any(&*boxed);
    if domain.axes().iter().any(|axis| *axis != Domain::<T, 1>::open().axes()[0])
        && w.support_radius() > T::ONE
    {
        return Ok(());
    }
    let masses = (0..positions.len()).map(|_| number(bytes)).collect::<Result<Vec<T>>>()?;
    let values = (0..positions.len()).map(|_| number(bytes)).collect::<Result<Vec<T>>>()?;
    fields(search, &w, &x, (&masses, &values));
    Ok(())
}

/// Both searches find as many, except where numbers wrap.
fn agree<T: Scalar, const D: usize>(
    layout: Option<CellLayout<T, D>>,
    positions: &[[T; D]],
    x: &[T; D],
    radius: T,
) {
    let Some(layout) = layout else { return };
    let Ok(brute) = BruteForce::new(positions) else { return };
    let mut starts = vec![0_u16; layout.cells() + 1];
    let mut entries = vec![0_u16; positions.len()];
    let grid = CellGrid::build(layout, positions, &mut starts, &mut entries).unwrap();
    let (found, expected) = (grid.count(x, radius), brute.count(x, radius));
    // where squares wrap, any place may seem near
    assert!(
        found == expected || T::NAME.starts_with("wrapping"),
        "{found} {expected} {}: {x:?} {radius:?} {positions:?} {layout:?}",
        T::NAME
    );
    let _ = grid.list::<4, u8>(x, radius);
}

fn one_number<T: Scalar>(x: T, step: T, n: u32) {
    let _ = (x.sqrt(), x.abs(), x.floor_to_i32(), x.is_finite(), x.canonical_bits(), x.to_f64());
    let _ = (x + step, x - step, x * step, x / step, -x, x.positive_part(), x.max(step), x.min(step));
    let _ = (difference::nth(|x| x * x, n, x, step), difference::nth_auto(|x| x, n, x));
    let _ = sph_core::ball::volume::<T, 3>(x);
    let _ = sph_core::quadrature::integrate(|x| x * x, x, step);
}

fn fields<T: Scalar, const D: usize>(
    search: BruteForce<'_, T, D, Domain<T, D>>,
    w: &Any<'_, T, D>,
    x: &[T; D],
    (masses, values): (&[T], &[T]),
) {
    let Ok(sources) = Sources::new(search, masses) else { return };
    let mut density = vec![T::ZERO; masses.len()];
    let _ = (sources.density(w, &mut density), sources.density_gradient_at(w, x));
    let mut volumes = vec![T::ZERO; masses.len()];
    if sph_core::field::volumes(masses, &density, &mut volumes).is_err() {
        return;
    }
    let Ok(sources) = Sources::new(search, &volumes[..]) else { return };
    let Ok(field) = Field::new(&sources, values) else { return };
    let _ =
        (field.interpolate_with_gradient_at(w, x), field.shepard_gradient_at(w, x), field.corrected_at(w, x));
    for i in 0..=masses.len() {
        let _ = (field.difference_gradient(w, i), field.corrected_gradient(w, i));
        let _: Option<T> = field.laplacian(w, i);
    }
}

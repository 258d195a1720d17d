//! The scene and what is computed in it.

use sph_core::field::volumes;
use sph_core::kernel::{CubicSpline, WendlandC2};
use sph_core::{
    BruteForce, Error, Field, KernelInfluence, Neighbours, PerSampleInfluence, Scalar, Sources, difference,
};

const SAMPLES: usize = 64;

/// Cells along each axis of the scene's grid.
pub(crate) const SIDE_CELLS: u32 = 4;

/// How many points the quantities are computed at.
pub const POINTS: usize = 20;

/// What is computed at each point, in the order of the numbers that [`Scene::at`] gives them.
pub const QUANTITIES: [&str; 13] = [
    "density",
    "density-gradient",
    "interpolation",
    "shepard",
    "least-squares",
    "gradient",
    "difference-gradient",
    "symmetric-gradient",
    "corrected-gradient",
    "numeric-gradient",
    "laplacian",
    "jacobian",
    "scatter-density",
];

/// Stands for a quantity that is not defined at a point.
const NONE: u64 = u64::MAX;

/// X ← 1664525 X + 1013904223 mod 2³².
struct Generator(u32);

impl Generator {
    /// An integer in −range … range.
    fn next(&mut self, range: i32) -> i32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 16) as i32 % (2 * range + 1) - range
    }
}

/// 64 samples on a jittered lattice with spacing 3/8, and what is known of them.
#[derive(Clone, Debug)]
pub struct Scene<T, const D: usize> {
    positions: [[T; D]; SAMPLES],
    masses: [T; SAMPLES],
    radii: [T; SAMPLES],
    density: [T; SAMPLES],
    volumes: [T; SAMPLES],
    values: [T; SAMPLES],
}

impl<T: Scalar, const D: usize> Scene<T, D> {
    /// Zeros, to be [filled](Self::fill) where they are: a scene that is moved takes twice its room on a small stack.
    pub const fn empty() -> Self {
        Self {
            positions: [[T::ZERO; D]; SAMPLES],
            masses: [T::ZERO; SAMPLES],
            radii: [T::ZERO; SAMPLES],
            density: [T::ZERO; SAMPLES],
            volumes: [T::ZERO; SAMPLES],
            values: [T::ZERO; SAMPLES],
        }
    }

    /// Makes the scene, with densities and volumes.
    ///
    /// # Errors
    /// Where the scalar's range is too small for it.
    pub fn fill(&mut self) -> Result<(), Error> {
        let mut random = Generator(D as u32);
        let side = if D == 2 { 8 } else { 4 };
        let unit_mass = if D == 2 { 9216 } else { 3456 }; // (3/8)^D
        for (i, position) in self.positions.iter_mut().enumerate() {
            for (axis, coordinate) in position.iter_mut().enumerate() {
                let place = i as i32 / i32::pow(side, axis as u32) % side;
                *coordinate = T::ratio(384 * place + random.next(96) - 512, 1024);
            }
        }
        self.masses.fill_with(|| T::ratio(unit_mass + random.next(512), 65_536));
        self.radii.fill_with(|| T::ratio(900 + random.next(90), 1024));
        self.values.fill_with(|| T::ratio(random.next(2048), 1024));
        Sources::new(BruteForce::new(&self.positions)?, &self.masses)?
            .density(&Self::kernel()?, &mut self.density)?;
        volumes(&self.masses, &self.density, &mut self.volumes)
    }

    fn kernel() -> Result<KernelInfluence<T, D, WendlandC2>, Error> {
        KernelInfluence::new(Self::support_radius())
    }

    /// h = 15/16, which has no exact reciprocal.
    pub fn support_radius() -> T {
        T::ratio(15, 16)
    }

    /// The samples.
    pub fn positions(&self) -> &[[T; D]] {
        &self.positions
    }

    /// Where the point with this number is: every fourth at a sample, the others anywhere, some beyond all samples.
    fn point(&self, point: usize) -> [T; D] {
        let mut random = Generator(point as u32 * 7919);
        let anywhere = core::array::from_fn(|_| T::ratio(1000 + random.next(1900), 1024));
        if point.is_multiple_of(4) { self.positions[point * 3] } else { anywhere }
    }

    /// Computes every quantity at a point, or at the sample of that number, and gives the bits of each component.
    ///
    /// # Errors
    /// None in any scalar that [`fill`](Self::fill) accepted.
    pub fn at(
        &self,
        search: impl Neighbours<T, D> + Copy,
        point: usize,
        mut emit: impl FnMut(usize, u64),
    ) -> Result<(), Error> {
        let x = self.point(point);
        self.masses_at(search, &x, &mut emit)?;
        self.fields_at(search, &x, &mut emit)?;
        self.fields_of_sample(search, point * 3, &mut emit)
    }

    fn masses_at(
        &self,
        search: impl Neighbours<T, D> + Copy,
        x: &[T; D],
        emit: &mut impl FnMut(usize, u64),
    ) -> Result<(), Error> {
        let (masses, w) = (Sources::new(search, &self.masses)?, &Self::kernel()?);
        let (density, gradient) = masses.density_gradient_at(w, x);
        emit(0, masses.density_at(w, x).canonical_bits());
        emit(1, density.canonical_bits());
        each(1, &gradient, emit);
        let scatter = PerSampleInfluence::<T, D, CubicSpline>::new(&self.radii)?;
        emit(12, masses.density_at(scatter, x).canonical_bits());
        Ok(())
    }

    fn fields_at(
        &self,
        search: impl Neighbours<T, D> + Copy,
        x: &[T; D],
        emit: &mut impl FnMut(usize, u64),
    ) -> Result<(), Error> {
        let (sources, w) = (Sources::new(search, &self.volumes)?, &Self::kernel()?);
        let field = Field::new(&sources, &self.values)?;
        emit(2, field.interpolate_at::<T>(w, x).canonical_bits());
        maybe(3, field.shepard_gradient_at(w, x).map(|(value, slope)| (Some(value), slope)), emit);
        maybe(4, field.corrected_at(w, x).map(|fit| (Some(fit.value), fit.gradient)), emit);
        each(5, &field.gradient_at(w, x), emit);
        let step = difference::relative_step(1);
        each(9, &difference::gradient(|x| field.interpolate_at(w, x), x, step), emit);
        Ok(())
    }

    fn fields_of_sample(
        &self,
        search: impl Neighbours<T, D> + Copy,
        i: usize,
        emit: &mut impl FnMut(usize, u64),
    ) -> Result<(), Error> {
        let (sources, w) = (Sources::new(search, &self.volumes)?, &Self::kernel()?);
        let field = Field::new(&sources, &self.values)?;
        maybe(6, field.difference_gradient(w, i).map(|slope| (None, slope)), emit);
        maybe(7, field.symmetric_gradient(w, &self.density, i).map(|slope| (None, slope)), emit);
        maybe(8, field.corrected_gradient(w, i).map(|slope| (None, slope)), emit);
        emit(10, field.laplacian::<T>(w, i).map_or(NONE, Scalar::canonical_bits));
        let rows = Field::new(&sources, &self.positions)?.jacobian::<D>(w, i);
        rows.iter().flatten().for_each(|row| each(11, row, emit));
        Ok(())
    }
}

/// Every component of a vector.
fn each<T: Scalar>(quantity: usize, vector: &[T], emit: &mut impl FnMut(usize, u64)) {
    vector.iter().for_each(|component| emit(quantity, component.canonical_bits()));
}

/// A value, if it has one, and a slope; or that there is neither.
fn maybe<T: Scalar, const D: usize>(
    quantity: usize,
    found: Option<(Option<T>, [T; D])>,
    emit: &mut impl FnMut(usize, u64),
) {
    let Some((value, slope)) = found else { return emit(quantity, NONE) };
    if let Some(value) = value {
        emit(quantity, value.canonical_bits());
    }
    each(quantity, &slope, emit);
}

//! Calls the whole public API of sph-core on inputs that the compiler knows nothing of.

use core::fmt::{self, Write};
use core::hint::black_box;
use sph_core::field::{self, volumes};
use sph_core::influence::volume;
use sph_core::kernel::{
    self, CubicSpline, Kernel, Poly6, QuinticSpline, Tabulated, Term, ViscosityLaplacian, WendlandC2,
    conformance,
};
use sph_core::scalar::Table;
use sph_core::scalar::fast::Fast32;
use sph_core::scalar::fixed::{self, Checked, I4F12, I8F24, I16F16, Saturating, Wrapping};
use sph_core::{
    Accumulator, Axis, BruteForce, CellGrid, CellLayout, ClosureInfluence, Domain, Error, Field, Influence,
    InfluenceOf, InlineCellGrid, KernelInfluence, NeighbourList, Neighbours, PerSample, PerSampleInfluence,
    Scalar, Sources, Uniform, ball, difference, quadrature, vector,
};

pub(crate) const SAMPLES: usize = 8;

/// Where the inputs come from; zeros to begin with, which the compiler is not told.
pub(crate) struct Inputs {
    numbers: [f64; SAMPLES],
    integers: [u32; 4],
}

/// Every value goes here.
pub(crate) fn keep<V>(value: V) {
    black_box(value);
}

impl Inputs {
    /// Zeros.
    pub(crate) const fn new() -> Self {
        Self { numbers: [0.0; SAMPLES], integers: [0; 4] }
    }

    /// Everything in two dimensions in six scalars, and in one and three in f32; the numbers of every format in every mode.
    pub(crate) fn run(&mut self) {
        self.without_scalar();
        self.in_scalar::<f32>();
        self.in_dimensions::<f32, 1>();
        self.in_dimensions::<f32, 3>();
        keep(self.per_sample_sums::<f32>());
        keep(field::curl(&self.vectors::<f32, 3>().first_chunk().copied().unwrap_or_default()));
        self.in_scalar::<f64>();
        self.in_scalar::<Fast32>();
        self.in_scalar::<Saturating<I16F16>>();
        self.in_scalar::<Checked<I8F24>>();
        self.in_scalar::<Wrapping<I4F12>>();
        macro_rules! all {
            ([$($Format:ident $name:tt $about:tt;)+]) => {$(
                self.numbers::<Saturating<fixed::$Format>>();
                self.numbers::<Checked<fixed::$Format>>();
                self.numbers::<Wrapping<fixed::$Format>>();
            )+};
        }
        sph_core::for_each_format!(all);
        self.fluids();
    }

    fn fluids(&self) {
        self.position_based::<f32>();
        self.position_based::<f64>();
        self.position_based::<Fast32>();
        self.position_based::<Saturating<I16F16>>();
        self.position_based::<Checked<I8F24>>();
        self.position_based::<Wrapping<I16F16>>();
        keep(self.weakly_compressible::<f32, 2>());
        keep(self.weakly_compressible::<f32, 3>());
        keep(self.weakly_compressible::<f64, 2>());
        keep(self.weakly_compressible::<Saturating<I16F16>, 2>());
    }

    fn in_scalar<T: Scalar>(&mut self) {
        self.numbers::<T>();
        self.in_dimensions::<T, 2>();
        keep(field::curl_2d(&self.vectors::<T, 2>().first_chunk().copied().unwrap_or([[T::ZERO; 2]; 2])));
    }

    pub(crate) fn number<T: Scalar>(&self, i: usize) -> T {
        T::from_f64(black_box(self.numbers[i % SAMPLES]))
    }

    pub(crate) fn integer(&self, i: usize) -> u32 {
        black_box(self.integers[i % 4])
    }

    pub(crate) fn integers(&self) -> [u32; 4] {
        black_box(self.integers)
    }

    pub(crate) fn scalars<T: Scalar>(&self) -> [T; SAMPLES] {
        core::array::from_fn(|i| self.number(i))
    }

    pub(crate) fn vectors<T: Scalar, const D: usize>(&self) -> [[T; D]; SAMPLES] {
        core::array::from_fn(|i| core::array::from_fn(|axis| self.number(i + axis)))
    }

    fn without_scalar(&self) {
        let (n, x) = (self.integer(0), self.number::<f64>(0));
        keep((ball::unit_volume(n), ball::unit_surface(n), ball::volume_real(x, self.number(1))));
        keep(Term::new(x, self.number(1), n, self.integer(1) as i32).moment(self.integer(2)));
        kernels(n, self.integer(1), x);
        let parameter = sph_core::Parameter::Mass;
        let (index, needed) = (n as usize, self.integer(1) as usize);
        for error in [
            Error::NotFinite { parameter, index },
            Error::NotPositive { parameter, index },
            Error::LengthMismatch { parameter, expected: index, found: needed },
            Error::CapacityExceeded { parameter, capacity: index, needed },
            Error::NotRepresentable { parameter },
            Error::SingularKernel,
            Error::OutsideDomain { index, axis: needed },
        ] {
            keep(write!(Nowhere, "{error}"));
        }
    }

    fn numbers<T: Scalar>(&self) {
        let [x, y, ..] = self.scalars::<T>();
        let n = self.integer(0);
        keep((
            x.sqrt(),
            x.floor_to_i32(),
            x.canonical_bits(),
            x.is_finite(),
            x.to_f64(),
            x.abs(),
            x.min(y),
            x.max(y),
        ));
        keep((x + y, x - y, x * y, x / y, -x, x.times(n as i32), x.positive_part(), x.pow::<5>(), x < y));
        keep((
            T::ratio(n as i32, self.integer(1) as i32),
            x.split(n),
            T::constant::<Thirds, 1, 2>(0, n as usize),
        ));
        keep(difference::nth(|x: T| x * y, n, x, y));
        keep(difference::nth_auto(|x: T| x * y, n, x));
        keep((difference::step_for::<T>(n, x), difference::relative_step::<T>(n)));
        keep(quadrature::integrate(|x: T| x * x, x, y));
        let mut sum = T::Sum::ZERO;
        sum.add(x);
        keep((sum.total(), sum.scaled_total(x, y)));
    }

    fn in_dimensions<T: Scalar, const D: usize>(&mut self) {
        self.geometry::<T, D>();
        self.influences::<T, D>().unwrap_or_default();
        keep(self.searches::<T, D>());
    }

    fn geometry<T: Scalar, const D: usize>(&self) {
        let ([x, y, ..], s) = (self.vectors::<T, D>(), self.number::<T>(0));
        keep((vector::sub(&x, &y), vector::add(&x, &y), vector::scale(&x, s)));
        keep((vector::dot(&x, &y), vector::norm_squared(&x), ball::volume::<T, D>(s)));
        keep(difference::gradient(|x: &[T; D]| vector::dot(x, &y), &x, s));
        keep(difference::partial(|x: &[T; D]| vector::dot(x, &y), &x, self.integer(0) as usize, s));
        keep(ViscosityLaplacian::<T, D>::new(s).map(|laplacian| laplacian.at_distance(self.number(1))));
    }

    fn influences<T: Scalar, const D: usize>(&self) -> Result<(), Error> {
        let h = self.number::<T>(0);
        macro_rules! all {
            ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
                // the compiler knows that a singular kernel is refused: what followed a `?` would be left out
                if let Ok(w) = KernelInfluence::<T, D, kernel::$Kernel>::new(h) {
                    self.influence(w);
                }
            )+};
        }
        sph_core::for_each_kernel!(all);
        self.influence(KernelInfluence::<T, D, CubicSpline>::from_smoothing_length(h)?);
        self.influence(KernelInfluence::<T, D, QuinticSpline>::with_printed_volume(h)?);
        self.influence(KernelInfluence::<T, D, Tabulated<WendlandC2, 17>>::new(h)?);
        keep(KernelInfluence::<T, D, Poly6>::new(h)?.normalisation());
        self.influence(ClosureInfluence::<T, D, _>::new(h, |h: T, r: T| h - r)?);
        let radii = self.scalars::<T>();
        let each = PerSampleInfluence::<T, D, CubicSpline>::new(&radii)?;
        keep((each.of(self.integer(0) as usize).map(|w| w.support_radius()), each.reach()));
        Ok(())
    }

    fn influence<T: Scalar, const D: usize>(&self, w: impl Influence<T, D>) {
        let [x, ..] = self.vectors::<T, D>();
        let r2 = self.number(1);
        keep((
            w.influence(r2),
            w.gradient(&x, r2),
            w.value_and_gradient(&x, r2),
            w.influence_at(&x),
            w.gradient_at(&x),
        ));
        keep((w.shape(r2), w.constant()));
        keep(((&&w).of(0).map(|w| w.support_radius()), (&w).reach()));
    }

    fn searches<T: Scalar, const D: usize>(&self) -> Result<(), Error> {
        let positions = self.vectors::<T, D>();
        let positions = positions.get(..self.integer(2) as usize).unwrap_or(&positions);
        let (lower, upper) = (self.number(0), self.number(1));
        let domain = Domain::open().periodic(self.integer(0) as usize, lower, upper)?;
        keep((domain.wrap(&[lower; D]), domain.axes().contains(&Axis::Open)));
        self.sums(BruteForce::new(positions)?)?;
        self.sums(BruteForce::in_domain(positions, domain)?)?;
        self.sums(BruteForce::open(positions)?)?;

        let counts = [self.integer(1); D];
        let (mut starts, mut entries) = ([0_u16; 65], [0_u16; SAMPLES]);
        let cut = self.integer(3) as usize;
        let layout = CellLayout::bounded(&[lower; D], &[upper; D], counts)?;
        keep(layout.cells());
        let starts = starts.get_mut(cut..).unwrap_or_default();
        let grid = CellGrid::build(layout, positions, starts, &mut entries)?;
        keep(grid.entries().first().copied());
        self.sums(grid)?;
        let mut storage = InlineCellGrid::<u8, 65, SAMPLES>::default();
        let layout = CellLayout::unbounded(lower, counts)?;
        self.sums(storage.build(layout.open(), positions)?)?;
        self.all_sums(storage.build(layout.periodic(self.integer(0) as usize, lower, upper)?, positions)?)
    }

    fn sums<T: Scalar, const D: usize>(&self, search: impl Neighbours<T, D> + Copy) -> Result<(), Error> {
        let (x, radius) = ([self.number::<T>(0); D], self.number(1));
        keep(search.count(&x, radius));
        let list: NeighbourList<4, u8> = search.list(&x, radius)?;
        keep((list.as_slice().first().copied(), list.iter().last(), list.len(), list.is_empty()));
        let sources = Sources::new(search, Uniform(radius))?;
        let w = KernelInfluence::<T, D, CubicSpline>::new(radius)?;
        keep((sources.density_at(&w, &x), sources.equal_density_at(&w, &x)));
        Ok(())
    }

    fn all_sums<T: Scalar, const D: usize>(&self, search: impl Neighbours<T, D> + Copy) -> Result<(), Error> {
        self.sums(search)?;
        let radius = self.number(1);
        self.fields(search, &KernelInfluence::<T, D, CubicSpline>::new(radius)?, Uniform(radius))
    }

    fn per_sample_sums<T: Scalar>(&self) -> Result<(), Error> {
        let (positions, radii) = (self.vectors::<T, 2>(), self.scalars::<T>());
        let search = BruteForce::new(&positions)?;
        let some = radii.get(..self.integer(1) as usize).unwrap_or(&radii);
        self.fields(search, PerSampleInfluence::<T, 2, WendlandC2>::new(some)?, some)
    }

    fn fields<T: Scalar, const D: usize>(
        &self,
        search: impl Neighbours<T, D> + Copy,
        w: impl InfluenceOf<T, D>,
        weights: impl PerSample<T>,
    ) -> Result<(), Error> {
        let (x, i) = ([self.number::<T>(0); D], self.integer(0) as usize);
        let sources = Sources::new(search, weights)?;
        keep((sources.positions().len(), sources.weights().get(i)));
        keep((sources.density_at(w, &x), sources.density_gradient_at(w, &x)));
        let (mut density, mut volume) = (self.scalars::<T>(), self.scalars::<T>());
        sources.density(w, &mut density)?;
        volumes(weights, &density, &mut volume)?;
        let values = self.scalars::<T>();
        let a = Field::new(&sources, values.get(..i).unwrap_or(&values))?;
        keep((a.interpolate_at::<T>(w, &x), a.shepard_at::<T>(w, &x), a.shepard_gradient_at(w, &x)));
        keep((a.gradient_at(w, &x), a.interpolate_with_gradient_at(w, &x), a.difference_gradient(w, i)));
        keep((
            a.symmetric_gradient(w, density.as_slice(), i),
            a.corrected_gradient(w, i),
            a.corrected_at(w, &x),
        ));
        keep((a.laplacian::<T>(w, i), a.diffusion::<T>(w, weights, i)));
        keep(sources.linear_basis_at(w, &x).and_then(|basis| a.fit_at(&basis, w, &x)));
        let vectors = self.vectors::<T, D>();
        let v = Field::new(&sources, vectors.as_slice())?;
        keep((v.interpolate_at::<[T; D]>(w, &x), v.shepard_at::<[T; D]>(w, &x), v.laplacian::<[T; D]>(w, i)));
        keep(v.jacobian::<D>(w, i).map(|jacobian| field::divergence(&jacobian)));
        Ok(())
    }
}

fn kernels(dim: u32, n: u32, h: f64) {
    fn one<K: Kernel>(dim: u32, n: u32, h: f64) {
        keep((
            kernel::radial_moment::<K>(dim, n),
            kernel::normalisation::<K>(dim),
            kernel::second_moment::<K>(dim),
        ));
        keep((volume::shell::<K>(dim, h), volume::printed::<K>(dim, h), volume::half_line::<K>(h)));
        keep((K::raw(h, h), K::profile(h), K::slope(h), K::profile_in_1d(h), K::slope_in_1d(h)));
        keep((conformance::check::<K, f32>(), conformance::check::<K, f64>()));
    }
    macro_rules! all {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => { $(one::<kernel::$Kernel>(dim, n, h);)+ };
    }
    sph_core::for_each_kernel!(all);
}

/// A table.
struct Thirds;

impl Table<1, 2> for Thirds {
    const VALUES: [[f64; 2]; 1] = [[1.0 / 3.0, 2.0 / 3.0]];
}

/// Takes text and drops it.
struct Nowhere;

impl Write for Nowhere {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        keep(text);
        Ok(())
    }
}

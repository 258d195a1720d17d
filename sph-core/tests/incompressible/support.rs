//! A fluid that owns its particles.

use sph_core::fluid::incompressible::{OneByOne, Outcome, Particles, Scheme, Shape, Tuning, Wall};
use sph_core::fluid::wcsph::CellStorage;
use sph_core::kernel::WendlandC2;
use sph_core::{CellLayout, Error, Influence, KernelInfluence, Scalar};

pub(crate) type Influence2<T, const D: usize> = KernelInfluence<T, D, WendlandC2>;

pub(crate) const SPACING: f64 = 0.1;
const REACH: f64 = 2.6;

/// Fluid and walls on a lattice, in cells of [`SPACING`] from the origin on.
pub(crate) struct Fluid<T, const D: usize> {
    pub(crate) scheme: Scheme<T, D, Influence2<T, D>>,
    pub(crate) positions: Vec<[T; D]>,
    pub(crate) velocities: Vec<[T; D]>,
    pub(crate) pressures: Vec<T>,
    pub(crate) shapes: Vec<Shape<T, D>>,
    pub(crate) pushes: Vec<[T; D]>,
    pub(crate) rates: Vec<T>,
    pub(crate) trial: Vec<T>,
    sources: Vec<T>,
    walls: Vec<Wall<T>>,
    wall_values: Vec<T>,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

pub(crate) type Sums<'a, T> = OneByOne<'a, CellStorage<'a, u32>, T>;

/// The cells from `from` to `to`.
fn cells<const D: usize>(from: [i32; D], to: [i32; D]) -> Vec<[i32; D]> {
    (0..D).fold(vec![[0; D]], |cells, axis| {
        let along = |cell: [i32; D]| {
            (from[axis]..to[axis]).map(move |k| {
                let mut next = cell;
                next[axis] = k;
                next
            })
        };
        cells.into_iter().flat_map(along).collect()
    })
}

impl<T: Scalar, const D: usize> Fluid<T, D> {
    /// A block of fluid in a tank without a lid, or in none.
    pub(crate) fn new(fluid: [i32; D], tank: Option<[i32; D]>, gravity: f64) -> Self {
        let number = T::from_f64;
        let place = |cell: &[i32; D]| cell.map(|k| number((f64::from(k) + 0.5) * SPACING));
        let mut positions: Vec<[T; D]> = cells([0; D], fluid).iter().map(place).collect();
        let count = positions.len();
        if let Some(tank) = tank {
            let mut to = tank.map(|k| k + 3);
            to[D - 1] = tank[D - 1];
            let is_wall = |cell: &&[i32; D]| (0..D).any(|axis| cell[axis] < 0 || cell[axis] >= tank[axis]);
            positions.extend(cells([-3; D], to).iter().filter(is_wall).map(place));
        }
        let size = tank.unwrap_or(fluid).map(|k| f64::from(k) * SPACING);
        let margin = if tank.is_some() { 0.35 } else { 1.0 };
        let influence = Influence2::<T, D>::new(number(REACH * SPACING)).unwrap();
        let lattice = cells([-3; D], [4; D]);
        let square = |cell: &[i32; D]| cell.iter().map(|&k| (f64::from(k) * SPACING).powi(2)).sum::<f64>();
        let near = lattice.iter().map(square).filter(|square| square.sqrt() < REACH * SPACING);
        let sum: f64 = near.map(|square| influence.influence(number(square)).to_f64()).sum();
        let upper = size.map(|length| length + margin);
        let counts = upper.map(|length| ((length + margin) / (REACH * SPACING)) as u32);
        let layout = CellLayout::bounded(&[number(-margin); D], &upper.map(number), counts).unwrap();
        let mut pull = [T::ZERO; D];
        pull[D - 1] = number(-gravity);
        let inside = match tank {
            Some(_) => size.map(|length| [T::ZERO, number(length)]),
            None => [[-T::MAX, T::MAX]; D],
        };
        let scheme = Scheme {
            rest_density: number(1000.0),
            gravity: pull,
            viscosity: number(0.02),
            influence,
            layout,
            spacing: number(SPACING),
            volume: number(1.0 / sum),
            inside,
            tuning: Tuning::default(),
        };
        let walls = positions.len() - count;
        Self {
            velocities: vec![[T::ZERO; D]; count],
            pressures: vec![T::ZERO; count],
            shapes: vec![Shape::NONE; count],
            pushes: vec![[T::ZERO; D]; count],
            rates: vec![T::ZERO; count],
            sources: vec![T::ZERO; count],
            trial: vec![T::ZERO; count],
            walls: vec![Wall::DRY; walls],
            wall_values: vec![T::ZERO; walls],
            starts: vec![0; scheme.layout.cells() + 1],
            entries: vec![0; positions.len()],
            scheme,
            positions,
        }
    }

    /// Calls `f` with the scheme and the particles.
    pub(crate) fn with<R>(
        &mut self,
        f: impl FnOnce(&Scheme<T, D, Influence2<T, D>>, &mut Particles<'_, T, D, Sums<'_, T>>) -> R,
    ) -> R {
        let mut sums = OneByOne {
            search: CellStorage { starts: &mut self.starts, entries: &mut self.entries },
            walls: &mut self.walls,
            wall_values: &mut self.wall_values,
        };
        let mut particles = Particles {
            positions: &mut self.positions,
            velocities: &mut self.velocities,
            pressures: &mut self.pressures,
            shapes: &mut self.shapes,
            pushes: &mut self.pushes,
            rates: &mut self.rates,
            sources: &mut self.sources,
            trial: &mut self.trial,
            sums: &mut sums,
        };
        f(&self.scheme, &mut particles)
    }

    /// Estimates ω, and makes ready for the first step.
    pub(crate) fn prepare(&mut self) {
        let relaxation = self.with(|scheme, particles| scheme.estimate_relaxation(particles)).unwrap();
        self.scheme.tuning.relaxation = relaxation;
        self.with(|scheme, particles| scheme.prepare(particles)).unwrap();
    }

    pub(crate) fn step(&mut self, dt: f64) -> Result<Outcome, Error> {
        self.with(|scheme, particles| scheme.step(particles, T::from_f64(dt)))
    }

    /// Steps as long as the scheme allows.
    pub(crate) fn advance(&mut self, seconds: f64) -> u32 {
        let (mut time, mut steps) = (0.0, 0);
        while time < seconds {
            let longest = self.with(|scheme, particles| scheme.longest_step(particles.greatest_speed()));
            let dt = longest.to_f64().min(seconds - time);
            self.step(dt).unwrap();
            time += dt;
            steps += 1;
        }
        steps
    }

    /// Kinetic and potential energy per mass, of all particles together.
    pub(crate) fn energy(&self) -> f64 {
        let gravity = -self.scheme.gravity[D - 1].to_f64();
        let kinetic = self.velocities.iter().flatten().map(|v| 0.5 * v.to_f64().powi(2)).sum::<f64>();
        let fluid = &self.positions[..self.shapes.len()];
        kinetic + fluid.iter().map(|x| gravity * x[D - 1].to_f64()).sum::<f64>()
    }

    /// Numbers without a pattern between −1 and 1.
    pub(crate) fn noise(count: usize, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        (0..count).map(|_| next()).collect()
    }

    /// Moves the fluid about by up to `part` of the spacing.
    pub(crate) fn jitter(&mut self, part: f64) {
        let count = self.shapes.len();
        let noise = Self::noise(count * D, 7);
        for (k, x) in self.positions[..count].iter_mut().flatten().enumerate() {
            *x += T::from_f64(part * SPACING * noise[k]);
        }
    }
}

//! What a case begins with, and lattices to make it from.

use sph_core::fluid::EquationOfState;
use sph_core::fluid::wcsph::{Limits, Liquid};
use sph_core::{Error, Scalar};

/// The equation of state of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StateEquation {
    /// Tait's, for free surfaces.
    Tait,
    /// The linear one, for flows without.
    Linear,
}

/// A case before its first step, in SI units.
#[derive(Clone, Debug)]
pub(crate) struct Setup<const D: usize> {
    /// The distance of particles on the first lattice.
    pub(crate) spacing: f64,
    /// Support radius / spacing.
    pub(crate) reach: f64,
    pub(crate) state_equation: StateEquation,
    pub(crate) rest_density: f64,
    pub(crate) sound_speed: f64,
    /// Gravity at the start.
    pub(crate) gravity: [f64; D],
    /// Gravity at a time.
    pub(crate) gravity_at: fn(f64) -> [f64; D],
    pub(crate) artificial_viscosity: f64,
    pub(crate) kinematic_viscosity: f64,
    pub(crate) density_diffusion: f64,
    /// The speed of shifting; zero where there is a free surface.
    pub(crate) shift_speed: f64,
    pub(crate) positions: Vec<[f64; D]>,
    pub(crate) velocities: Vec<[f64; D]>,
    /// Pressures to begin with, which give the densities.
    pub(crate) pressures: Vec<f64>,
    pub(crate) walls: Vec<[f64; D]>,
    /// The box of the cells; exact along periodic axes.
    pub(crate) lower: [f64; D],
    pub(crate) upper: [f64; D],
    pub(crate) periodic: [bool; D],
}

impl<const D: usize> Setup<D> {
    /// ρ₀ dx^D
    pub(crate) fn mass(&self) -> f64 {
        self.rest_density * self.spacing.powi(D as i32)
    }

    /// The liquid in some scalar.
    pub(crate) fn liquid<T: Scalar>(&self) -> Result<Liquid<T, D>, Error> {
        let (density, speed) = (T::from_f64(self.rest_density), T::from_f64(self.sound_speed));
        Ok(Liquid {
            equation_of_state: match self.state_equation {
                StateEquation::Tait => EquationOfState::tait(density, speed)?,
                StateEquation::Linear => EquationOfState::linear(density, speed)?,
            },
            gravity: self.gravity.map(T::from_f64),
            artificial_viscosity: T::from_f64(self.artificial_viscosity),
            kinematic_viscosity: T::from_f64(self.kinematic_viscosity),
            density_diffusion: T::from_f64(self.density_diffusion),
            shift_speed: T::from_f64(self.shift_speed),
        })
    }

    /// How long a step may be.
    pub(crate) fn limits<T: Scalar>(&self) -> Limits<T> {
        Limits { courant: T::ratio(2, 5), ..Limits::default() }
    }
}

/// The numbers of the cells from `from` up to `to`, the last axis fastest.
pub(crate) fn cells<const D: usize>(from: [i64; D], to: [i64; D]) -> Vec<[i64; D]> {
    let mut cells = vec![[0; D]];
    for axis in 0..D {
        cells = cells
            .iter()
            .flat_map(|cell| {
                (from[axis]..to[axis]).map(move |number| {
                    let mut next = *cell;
                    next[axis] = number;
                    next
                })
            })
            .collect();
    }
    cells
}

/// The centre of a cell.
pub(crate) fn centre<const D: usize>(cell: &[i64; D], spacing: f64) -> [f64; D] {
    cell.map(|number| (number as f64 + 0.5) * spacing)
}

/// Wall particles around a box of `counts` cells from the origin: `layers` of them at the lower and upper end of each axis that says so.
pub(crate) fn walls<const D: usize>(
    counts: [i64; D],
    layers: i64,
    ends: [(bool, bool); D],
    spacing: f64,
) -> Vec<[f64; D]> {
    let mut from = [0; D];
    let mut to = counts;
    for axis in 0..D {
        from[axis] -= if ends[axis].0 { layers } else { 0 };
        to[axis] += if ends[axis].1 { layers } else { 0 };
    }
    let outside = |cell: &&[i64; D]| (0..D).any(|axis| cell[axis] < 0 || cell[axis] >= counts[axis]);
    cells(from, to).iter().filter(outside).map(|cell| centre(cell, spacing)).collect()
}

/// The position moved by up to `most` along each axis, by an amount that its number alone decides.
pub(crate) fn jittered<const D: usize>(number: usize, position: [f64; D], most: f64) -> [f64; D] {
    std::array::from_fn(|axis| {
        let mut bits = ((number * D + axis + 1) as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let part = ((bits ^ (bits >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        position[axis] + (2.0 * part - 1.0) * most
    })
}

/// A column of water eight particles wide in a tank, and the size of the tank: what the tests of solvers begin with.
#[cfg(test)]
pub(super) fn column() -> (Setup<2>, [f64; 2]) {
    let spacing = 0.02;
    let counts = [32, 48];
    let positions: Vec<[f64; 2]> = cells([0; 2], [8, 16]).iter().map(|cell| centre(cell, spacing)).collect();
    let setup = Setup {
        spacing,
        reach: 2.6,
        state_equation: StateEquation::Tait,
        rest_density: 1000.0,
        sound_speed: 25.0,
        gravity: [0.0, -9.81],
        gravity_at: |_| [0.0, -9.81],
        artificial_viscosity: 0.03,
        kinematic_viscosity: 0.0,
        density_diffusion: 0.1,
        shift_speed: 0.0,
        velocities: vec![[0.0; 2]; positions.len()],
        pressures: positions.iter().map(|x| 9810.0 * (16.0 * spacing - x[1])).collect(),
        positions,
        walls: walls(counts, 3, [(true, true); 2], spacing),
        lower: [-3.0 * spacing; 2],
        upper: counts.map(|count| (count as f64 + 3.0) * spacing),
        periodic: [false; 2],
    };
    (setup, counts.map(|count| count as f64 * spacing))
}

//! The fluids: position-based in every container, weakly compressible, and their display.

use super::exercise::{Inputs, SAMPLES, keep};
use sph_core::fluid::wcsph::{CellStorage, Forces, Limits, Liquid, OneByOne, Particles, Scheme, Seen};
use sph_core::fluid::{
    BorrowedFluid, Container, Disc, EquationOfState, Mask, OpenBox, Particle, PositionBasedFluid, Raster,
    Settings, Shape,
};
use sph_core::kernel::WendlandC2;
use sph_core::scalar::compact::Compact;
use sph_core::{CellLayout, Error, KernelInfluence, Scalar};

impl Inputs {
    /// Position-based fluids in two and three dimensions.
    pub(crate) fn position_based<T: Compact>(&self) {
        let size = [self.number::<T>(0); 2];
        self.contained(OpenBox::new(size));
        self.contained(Disc::new(self.number::<T>(0)));
        self.contained(Shape::new(size, |x: &[T; 2]| (x[0] - x[1], *x)));
        let bits = self.integers().map(|n| n as u8);
        if let Ok(mask) = Mask::new(&bits, self.integer(0) as u8, self.number::<T>(0)) {
            self.contained(mask);
        }
        self.frames(OpenBox::new([self.number::<T>(0); 3]), Settings::IN_3D);
    }

    fn contained<T: Compact>(&self, container: impl Container<T, 2> + Clone) {
        self.frames(container.clone(), Settings::DEFAULT);
        let mut raster = Raster::<4, 4>::new();
        let mut particles: [Particle<T, 2>; SAMPLES] = self.particles();
        raster.update(&particles, self.number(1));
        let at = [self.integer(0), self.integer(1)].map(|n| n as usize);
        keep((raster.density(at[0], at[1]), raster.is_lit(at[0], at[1])));
        let mut starts = [0_u8; 9];
        let settings = Settings { iterations: 3, ..Settings::DEFAULT };
        if let Ok(mut fluid) = BorrowedFluid::new(&container, settings, &mut particles, &mut starts) {
            fluid.step([self.number(2), self.number(3)]);
        }
    }

    fn frames<T: Compact, const D: usize>(&self, container: impl Container<T, D>, settings: Settings) {
        let mut fluid = PositionBasedFluid::<T, _, D, SAMPLES, 27, u8>::with_settings(container, settings);
        for particle in self.particles() {
            keep(fluid.add(particle).is_err());
        }
        fluid.settings_mut().cohesion = self.integer(0) as u8;
        fluid.impulse(|particle| particle.position());
        fluid.step([self.number(2); D]);
        keep(fluid.remove(self.integer(1) as usize));
        fluid.retain(|particle| particle.pressure() > T::ZERO);
        keep(fluid.particles().first().map(|particle| (particle.position(), particle.velocity())));
    }

    fn particles<T: Compact, const D: usize>(&self) -> [Particle<T, D>; SAMPLES] {
        let velocity = [self.number(1); D];
        self.vectors().map(|position| Particle::new(position, velocity).with_pressure(self.number(2)))
    }

    /// Steps of a weakly compressible fluid with walls.
    pub(crate) fn weakly_compressible<T: Scalar, const D: usize>(&self) -> Result<(), Error> {
        let [x, y, z, ..] = self.scalars::<T>();
        let state = EquationOfState::linear(x, y)?;
        keep((state.rest_density(), state.density(x), state.energy(y)));
        let influence = KernelInfluence::<T, D, WendlandC2>::new(x)?;
        let layout = CellLayout::bounded(&[x; D], &[y; D], [self.integer(0); D])?;
        let liquid = Liquid {
            equation_of_state: EquationOfState::tait(x, y)?,
            gravity: [z; D],
            artificial_viscosity: x,
            kinematic_viscosity: y,
            density_diffusion: z,
            shift_speed: x,
        };
        let scheme = Scheme { liquid, influence, layout, mass: y };
        let fluid = (self.integer(1) as usize).min(SAMPLES);
        let (mut positions, mut velocities) = (self.vectors(), self.vectors());
        let (mut densities, mut rates) = (self.scalars(), self.scalars());
        let mut forces = [Forces::NONE; SAMPLES];
        let search = CellStorage { starts: &mut [0_u8; 28], entries: &mut [0_u8; SAMPLES] };
        let mut particles = Particles {
            positions: &mut positions,
            velocities: some(&mut velocities, fluid),
            densities: some(&mut densities, fluid),
            forces: some(&mut forces, fluid),
            rates: some(&mut rates, fluid),
            seen: &mut [Seen::NONE; SAMPLES],
            sums: &mut OneByOne(search),
        };
        scheme.prepare(&mut particles)?;
        let dt = scheme.stable_step(&particles, &Limits::default());
        scheme.step(&mut particles, dt)?;
        keep((particles.extremes(), scheme.longest_step(&Limits::default(), x, y)));
        Ok(())
    }
}

/// The first `count`.
fn some<V>(all: &mut [V; SAMPLES], count: usize) -> &mut [V] {
    all.get_mut(..count).unwrap_or_default()
}

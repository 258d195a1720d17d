//! `defmt::Format` of the fluids: their counts and settings, not all of their particles.

use super::incompressible;
use super::wcsph::{CellStorage, ParticleStates, Particles, Scheme};
use super::{BorrowedFluid, Container, Particle, PositionBasedFluid, Shape, Wall};
use crate::neighbours::Index;
use crate::scalar::compact::Compact;
use defmt::{Format, Formatter, write};

impl<T: Compact, C, I: Index, const D: usize, const CAP: usize, const CELLS: usize> Format
    for PositionBasedFluid<T, C, D, CAP, CELLS, I>
{
    fn format(&self, f: Formatter<'_>) {
        write!(f, "PositionBasedFluid of {=usize} particles, at most {=usize}", self.len(), Self::CAPACITY);
    }
}

impl<T: Compact, C: Container<T, D>, I: Index, const D: usize> Format for BorrowedFluid<'_, T, C, D, I> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "BorrowedFluid of {=usize} particles", self.particles().len());
    }
}

impl<T: Compact + Format, const D: usize> Format for Particle<T, D> {
    fn format(&self, f: Formatter<'_>) {
        let (x, v, p) = (self.position(), self.velocity(), self.pressure());
        write!(f, "Particle at {} with velocity {}, pressure {}", x, v, p);
    }
}

impl<N: Format, const D: usize> Format for Wall<N, D> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Wall with share {}, push {}", self.share, self.push);
    }
}

impl<T: Compact + Format, F: Fn(&[T; D]) -> (T, [T; D]), const D: usize> Format for Shape<T, F, D> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Shape in a box of {}", self.size());
    }
}

impl<T: Format, const D: usize, W: Format> Format for Scheme<T, D, W> {
    fn format(&self, f: Formatter<'_>) {
        let Self { liquid, influence, layout, mass } = self;
        write!(f, "Scheme of {}, {}, {}, particle mass {}", liquid, influence, layout, mass);
    }
}

impl<T, const D: usize> Format for ParticleStates<'_, T, D> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "State with {=usize} particles of fluid", self.fluid);
    }
}

impl<I> Format for CellStorage<'_, I> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Cells for {=usize} particles", self.entries.len());
    }
}

impl<T, const D: usize, S> Format for Particles<'_, T, D, S> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Particles, {=usize} of {=usize} fluid", self.forces.len(), self.positions.len());
    }
}

impl<T: Format, const D: usize, W: Format> Format for incompressible::Scheme<T, D, W> {
    fn format(&self, f: Formatter<'_>) {
        let Self { gravity, viscosity, influence, layout, tuning, .. } = self;
        write!(
            f,
            "Scheme with gravity {}, viscosity {}, {}, {}, {}",
            gravity, viscosity, influence, layout, tuning
        );
    }
}

impl<T, const D: usize, S> Format for incompressible::Particles<'_, T, D, S> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Particles, {=usize} of {=usize} fluid", self.shapes.len(), self.positions.len());
    }
}

impl<S, T> Format for incompressible::OneByOne<'_, S, T> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "Sums one by one, {=usize} walls", self.walls.len());
    }
}

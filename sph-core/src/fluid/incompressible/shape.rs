//! What the neighbourhood of a particle makes of it alone: density, Σ V ∇W, the diagonal of the constraints, and the forces that
//! are no pressure.

use super::Scheme;
use crate::lane::{Lane, add, add_vector, join_vector, sub, total_vector};
use crate::vector::{dot, norm_squared};
use crate::{Influence, Scalar};

/// What a fluid particle's neighbourhood makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Shape<T, const D: usize> {
    /// δ, itself included.
    pub density: T,
    /// Σ V ∇W over fluid and walls.
    pub gradient: [T; D],
    /// Σ |V ∇W|² over the fluid + |Σ V ∇W|², which is −∂C_i(P(q))/∂q_i without walls, and (Σ V W_iw s_w)², a bound of what walls
    /// add; s is [`Wall::stiffness`](super::Wall::stiffness).
    pub diagonal: T,
    /// Gravity, viscosity, and the push of the weight that walls hold.
    pub force: [T; D],
}

impl<T: Scalar, const D: usize> Shape<T, D> {
    /// A particle alone.
    pub const NONE: Self =
        Self { density: T::ONE, gradient: [T::ZERO; D], diagonal: T::ZERO, force: [T::ZERO; D] };
}

/// A neighbour as [`Shape`] sees it, or several side by side.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Surroundings<A, const D: usize> {
    /// x_ij = x_i − x_j
    pub offset: [A; D],
    /// V W_ij
    pub influence: A,
    /// V ∇W_ij
    pub gradient: [A; D],
}

/// The sums of one particle that make its [`Shape`].
#[derive(Clone, Copy)]
pub struct ShapeSums<T, A: Lane<T>, const D: usize> {
    density: A::Sum,
    gradient: [A::Sum; D],
    squares: A::Sum,
    stiffness: A::Sum,
    force: [A::Sum; D],
}

impl<T: Scalar, A: Lane<T>, const D: usize> ShapeSums<T, A, D> {
    /// Without neighbours.
    pub const EMPTY: Self = Self {
        density: A::EMPTY,
        gradient: [A::EMPTY; D],
        squares: A::EMPTY,
        stiffness: A::EMPTY,
        force: [A::EMPTY; D],
    };

    /// Adds the sums over other neighbours of the same particle.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        A::join(&mut self.density, other.density);
        join_vector::<T, A, D>(&mut self.gradient, &other.gradient);
        A::join(&mut self.squares, other.squares);
        A::join(&mut self.stiffness, other.stiffness);
        join_vector::<T, A, D>(&mut self.force, &other.force);
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Adds fluid, with the velocities of both.
    #[inline(always)]
    pub fn add_fluid<A: Lane<T>>(
        &self,
        sums: &mut ShapeSums<T, A, D>,
        own: &[A; D],
        other: &[A; D],
        at: &Surroundings<A, D>,
    ) {
        at.influence.add_to(&mut sums.density);
        add_vector::<T, A, D>(&mut sums.gradient, &at.gradient, A::ONE);
        norm_squared(&at.gradient).add_to(&mut sums.squares);
        if self.viscosity > T::ZERO {
            let approach = (-dot(&sub(own, other), &at.offset)).positive_part();
            let length = self.length();
            let softened = norm_squared(&at.offset) + A::splat(length * length * T::ratio(1, 100));
            let stress = A::splat(self.viscosity) * approach / softened;
            add_vector::<T, A, D>(&mut sums.force, &at.gradient, -stress);
        }
    }

    /// Adds walls, with the weight that each holds and its stiffness.
    #[inline(always)]
    pub fn add_wall<A: Lane<T>>(
        &self,
        sums: &mut ShapeSums<T, A, D>,
        [head, stiffness]: [A; 2],
        at: &Surroundings<A, D>,
    ) {
        (stiffness * at.influence).add_to(&mut sums.stiffness);
        at.influence.add_to(&mut sums.density);
        add_vector::<T, A, D>(&mut sums.gradient, &at.gradient, A::ONE);
        add_vector::<T, A, D>(&mut sums.force, &at.gradient, -head);
    }

    /// The shape that sums over all neighbours make.
    #[inline(always)]
    pub fn total_shape<A: Lane<T>>(&self, sums: ShapeSums<T, A, D>) -> Shape<T, D> {
        let gradient = total_vector::<T, A, D>(&sums.gradient);
        let stiffness = A::total(sums.stiffness);
        Shape {
            density: A::total(sums.density),
            gradient,
            diagonal: A::total(sums.squares) + norm_squared(&gradient) + stiffness * stiffness,
            force: add(&total_vector::<T, A, D>(&sums.force), &self.gravity),
        }
    }
}

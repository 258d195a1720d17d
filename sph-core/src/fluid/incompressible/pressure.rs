//! The two sums of an iteration: P, the acceleration by pressures, and C, the compression by velocities.

use super::{Scheme, Shape};
use crate::lane::{Lane, add_vector, total_vector};
use crate::vector::dot;
use crate::{Influence, Scalar};

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Adds a neighbour's pressure q_j along V ∇W_ij.
    #[inline(always)]
    pub fn add_push<A: Lane<T>>(&self, sums: &mut [A::Sum; D], value: A, gradient: &[A; D]) {
        add_vector::<T, A, D>(sums, gradient, value);
    }

    /// P_i from the particle's own pressure and the sums over its neighbours.
    #[inline(always)]
    pub fn total_push<A: Lane<T>>(&self, own: T, shape: &Shape<T, D>, sums: &[A::Sum; D]) -> [T; D] {
        let mut push = total_vector::<T, A, D>(sums);
        for axis in 0..D {
            push[axis] = -(own * shape.gradient[axis] + push[axis]);
        }
        push
    }

    /// Adds a neighbour's velocity along V ∇W_ij.
    #[inline(always)]
    pub fn add_flow<A: Lane<T>>(&self, sum: &mut A::Sum, velocity: &[A; D], gradient: &[A; D]) {
        dot(velocity, gradient).add_to(sum);
    }

    /// C_i from the particle's own velocity, the sum over its fluid neighbours, and what walls add.
    #[inline(always)]
    pub fn total_rate<A: Lane<T>>(
        &self,
        own: &[T; D],
        shape: &Shape<T, D>,
        flow: A::Sum,
        of_walls: A::Sum,
    ) -> T {
        dot(own, &shape.gradient) - A::total(flow) + A::total(of_walls)
    }
}

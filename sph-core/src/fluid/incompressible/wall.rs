//! Walls as particles that take their pressure from the fluid before them.
//!
//! ```text
//! q_w = Σ q_j W_wj / Σ W_wj + e_w,      e_w = (g·Σ x_wj W_wj / Σ W_wj)₊
//! C_i gains Σ_w W_iw / Σ_j W_wj · Σ_k V v_k·∇W_kw
//! ```
//!
//! With q_w = 0 the row at a wall would carry the weight alone, and read twice the pressure. What C gains is the adjoint of the first
//! sum: what flows into a wall particle counts for the fluid that gives it its pressure. e_w, the weight of the fluid between
//! the two, is not an unknown: it acts as a force.
//!
//! Source of q_w: S. Adami, X. Y. Hu, N. A. Adams, J. Comput. Phys. 231 (2012) 7057, eq. (27), for walls that stand still. Walls
//! push and do not pull.

use super::{Scheme, Surroundings};
use crate::lane::{Lane, splat_vector};
use crate::vector::{dot, norm_squared};
use crate::{Influence, Scalar};

/// What a wall particle knows of the fluid in reach.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Wall<T> {
    /// 1 / Σ V W_wj; zero where no fluid is near.
    pub weight: T,
    /// e_w
    pub head: T,
    /// √(Σ |V ∇W_wj|²) / Σ V W_wj, how hard the wall pushes the fluid for a pressure of one in all of it.
    pub stiffness: T,
}

impl<T: Scalar> Wall<T> {
    /// A wall where no fluid is near.
    pub const DRY: Self = Self { weight: T::ZERO, head: T::ZERO, stiffness: T::ZERO };
}

/// The sums over the fluid that make a [`Wall`].
#[derive(Clone, Copy)]
pub struct WallSums<T, A: Lane<T>> {
    norm: A::Sum,
    head: A::Sum,
    squares: A::Sum,
}

impl<T: Scalar, A: Lane<T>> WallSums<T, A> {
    /// Without neighbours.
    pub const EMPTY: Self = Self { norm: A::EMPTY, head: A::EMPTY, squares: A::EMPTY };

    /// Adds the sums over other fluid in reach of the same wall.
    #[inline(always)]
    pub fn join(&mut self, other: &Self) {
        A::join(&mut self.norm, other.norm);
        A::join(&mut self.head, other.head);
        A::join(&mut self.squares, other.squares);
    }
}

impl<T: Scalar, const D: usize, W: Influence<T, D>> Scheme<T, D, W> {
    /// Adds fluid to the sums of a wall.
    #[inline(always)]
    pub fn add_to_wall<A: Lane<T>>(&self, sums: &mut WallSums<T, A>, at: &Surroundings<A, D>) {
        at.influence.add_to(&mut sums.norm);
        let depth = dot(&splat_vector::<T, A, D>(&self.gravity), &at.offset);
        (depth * at.influence).add_to(&mut sums.head);
        norm_squared(&at.gradient).add_to(&mut sums.squares);
    }

    /// The wall that sums over all fluid in reach make. One that is hardly in reach, where 1 / Σ W is no number, is dry.
    #[inline(always)]
    pub fn total_wall<A: Lane<T>>(&self, sums: WallSums<T, A>) -> Wall<T> {
        let norm = A::total(sums.norm);
        if norm > T::EPSILON * T::EPSILON {
            let weight = T::ONE / norm;
            let head = (A::total(sums.head) * weight).positive_part();
            Wall { weight, head, stiffness: A::total(sums.squares).sqrt() * weight }
        } else {
            Wall::DRY
        }
    }
}

//! ∇ρ_i = L_i⁻¹ Σ V_j (ρ_j − ρ_i) ∇W_ij,  L_i = Σ V_j ∇W_ij ⊗ x_ji: exact for linear densities, summed along with the forces.
//!
//! The same as [`Field::corrected_gradient`](crate::Field::corrected_gradient), which a test holds it against, but for what it
//! calls too few neighbours. L_i is the identity among neighbours on all sides, and has a half in it at a flat surface. A
//! particle of spray has a fifth or less in some direction: there a gradient would be mostly noise, and none is given.

use crate::Scalar;
use crate::lane::{Lane, add_vector, join_vector, scale, total_vector};

/// The sums of one particle.
#[derive(Clone, Copy)]
pub(super) struct DensityGradient<T, A: Lane<T>, const D: usize> {
    /// Σ V_j (ρ_j − ρ_i) ∇W_ij
    difference: [A::Sum; D],
    /// −L_i on and below its diagonal.
    correction: [[A::Sum; D]; D],
}

impl<T: Scalar, A: Lane<T>, const D: usize> DensityGradient<T, A, D> {
    pub(super) const EMPTY: Self = Self { difference: [A::EMPTY; D], correction: [[A::EMPTY; D]; D] };

    /// Adds the sums over other neighbours.
    #[inline(always)]
    pub(super) fn join(&mut self, other: &Self) {
        join_vector::<T, A, D>(&mut self.difference, &other.difference);
        for row in 0..D {
            join_vector::<T, A, D>(&mut self.correction[row], &other.correction[row]);
        }
    }

    /// A neighbour: x_ij, V_j ∇W_ij / x_ij, ρ_j − ρ_i.
    #[inline(always)]
    pub(super) fn add(&mut self, offset: &[A; D], weight: A, excess: A) {
        let weighed = scale(offset, weight);
        add_vector::<T, A, D>(&mut self.difference, &weighed, excess);
        for row in 0..D {
            for column in 0..D {
                // a bound that the compiler knows, for it to do without the loop
                if column <= row {
                    (weighed[row] * offset[column]).add_to(&mut self.correction[row][column]);
                }
            }
        }
    }

    /// ∇ρ_i; zero where a pivot is a fifth or less.
    #[inline(always)]
    pub(super) fn total(self) -> [T; D] {
        let x = total_vector::<T, A, D>(&self.difference);
        let mut m = [[T::ZERO; D]; D];
        for row in 0..D {
            for column in 0..=row {
                m[row][column] = -A::total(self.correction[row][column]);
            }
        }
        solved(m, x)
    }
}

/// m⁻¹ x by elimination without exchange, m being positive semidefinite and given by its lower triangle.
#[inline]
fn solved<T: Scalar, const D: usize>(mut m: [[T; D]; D], mut x: [T; D]) -> [T; D] {
    for column in 0..D {
        let pivot = m[column][column];
        let enough = pivot > T::ratio(1, 5);
        if !enough {
            return [T::ZERO; D];
        }
        for row in column + 1..D {
            let below = m[row][column];
            let factor = below / pivot;
            for k in row..D {
                let change = factor * m[k][column];
                m[k][row] -= change;
            }
            let change = factor * x[column];
            x[row] -= change;
        }
    }
    for row in (0..D).rev() {
        for k in row + 1..D {
            let change = m[k][row] * x[k];
            x[row] -= change;
        }
        x[row] = x[row] / m[row][row];
    }
    x
}

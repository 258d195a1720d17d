//! ∇ρ_i = L_i⁻¹ Σ V_j (ρ_j − ρ_i) ∇W_ij,  L_i = Σ V_j ∇W_ij ⊗ x_ji: exact for linear densities, summed along with the forces.
//!
//! The same as [`Field::corrected_gradient`](crate::Field::corrected_gradient), which a test holds it against, but for what it
//! calls too few neighbours. L_i is the identity among neighbours on all sides, and has a half in it at a flat surface. A
//! particle of spray has a fifth or less in some direction: there a gradient would be mostly noise, and none is given.

use crate::{Accumulator, Scalar};

/// The sums of one particle.
#[derive(Clone, Copy)]
pub(super) struct DensityGradient<T: Scalar, const D: usize> {
    /// Σ V_j (ρ_j − ρ_i) ∇W_ij
    difference: [T::Sum; D],
    /// L_i on and below its diagonal.
    correction: [[T::Sum; D]; D],
}

impl<T: Scalar, const D: usize> DensityGradient<T, D> {
    pub(super) const EMPTY: Self = Self {
        difference: [<T::Sum as Accumulator<T>>::ZERO; D],
        correction: [[<T::Sum as Accumulator<T>>::ZERO; D]; D],
    };

    /// A neighbour: x_ij, V_j ∇W_ij / x_ij, ρ_j − ρ_i.
    #[inline(always)]
    pub(super) fn add(&mut self, offset: &[T; D], weight: T, excess: T) {
        for row in 0..D {
            let weighed = offset[row] * weight;
            self.difference[row].add(weighed * excess);
            for column in 0..=row {
                self.correction[row][column].add(-(weighed * offset[column]));
            }
        }
    }

    /// ∇ρ_i by elimination without exchange, L_i being positive semidefinite; zero where a pivot is a fifth or less.
    pub(super) fn total(self) -> [T; D] {
        let mut x = self.difference.map(Accumulator::total);
        let mut m = self.correction.map(|row| row.map(Accumulator::total));
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
}

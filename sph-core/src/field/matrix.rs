//! Small dense linear algebra on `[[T; D]; D]`, D ≤ 4 in practice.

use crate::Scalar;

/// The solution of M x = b by Gaussian elimination with partial pivoting; `None` where a pivot vanishes or the result is
/// not finite.
#[inline(never)]
pub(super) fn solve<T: Scalar, const D: usize>(mut m: [[T; D]; D], mut b: [T; D]) -> Option<[T; D]> {
    for column in 0..D {
        let pivot = largest_below(&m, column);
        m.swap(column, pivot);
        b.swap(column, pivot);
        let (pivot_row, pivot_value) = (m[column], b[column]);
        if pivot_row[column] == T::ZERO {
            return None;
        }
        for row in column + 1..D {
            let factor = m[row][column] / pivot_row[column];
            for k in column..D {
                m[row][k] -= factor * pivot_row[k];
            }
            b[row] -= factor * pivot_value;
        }
    }
    for row in (0..D).rev() {
        for k in row + 1..D {
            b[row] -= m[row][k] * b[k];
        }
        b[row] = b[row] / m[row][row];
    }
    b.iter().all(|component| component.is_finite()).then_some(b)
}

fn largest_below<T: Scalar, const D: usize>(m: &[[T; D]; D], column: usize) -> usize {
    let mut best = column;
    for row in column + 1..D {
        if m[row][column].abs() > m[best][column].abs() {
            best = row;
        }
    }
    best.min(D - 1) // which it is: said for the compiler, so that no index needs a check
}

/// Whether a symmetric, positive semidefinite matrix has a condition number in the 2-norm of at most 1e8 in f64, 1e4 in
/// narrower types.
pub(super) fn is_well_conditioned<T: Scalar, const D: usize>(m: [[T; D]; D]) -> bool {
    let least = if T::EPSILON.to_f64() < 1e-12 { T::from_f64(1e-8) } else { T::from_f64(1e-4) };
    let (smallest, largest) = extreme_eigenvalues(m);
    smallest > largest * least
}

/// The smallest and the largest eigenvalue of a symmetric matrix, by cyclic Jacobi rotations.
///
/// Source: G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th ed. (2013), sect. 8.5.
#[inline(never)]
fn extreme_eigenvalues<T: Scalar, const D: usize>(mut m: [[T; D]; D]) -> (T, T) {
    const SWEEPS: usize = 12;
    for _ in 0..SWEEPS {
        for p in 0..D {
            for q in p + 1..D {
                rotate(&mut m, p, q);
            }
        }
    }
    let (mut smallest, mut largest) = (m[0][0], m[0][0]);
    for axis in 1..D {
        smallest = smallest.min(m[axis][axis]);
        largest = largest.max(m[axis][axis]);
    }
    (smallest, largest)
}

/// One rotation that takes M[p][q] to zero.
#[inline(never)]
fn rotate<T: Scalar, const D: usize>(m: &mut [[T; D]; D], p: usize, q: usize) {
    let off = m[p][q];
    if off == T::ZERO {
        return;
    }
    let tau = (m[q][q] - m[p][p]) / off.times(2);
    let root = (T::ONE + tau * tau).sqrt();
    let t = if tau < T::ZERO { -T::ONE / (root - tau) } else { T::ONE / (root + tau) };
    let c = T::ONE / (T::ONE + t * t).sqrt();
    let s = t * c;
    for k in 0..D {
        let (kp, kq) = (m[k][p], m[k][q]);
        m[k][p] = c * kp - s * kq;
        m[k][q] = s * kp + c * kq;
    }
    for k in 0..D {
        let (pk, qk) = (m[p][k], m[q][k]);
        m[p][k] = c * pk - s * qk;
        m[q][k] = s * pk + c * qk;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_with_pivoting() {
        let m = [[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [3.0, 0.0, 4.0_f64]];
        let x = solve(m, [7.0, 1.0, 15.0]).unwrap();
        for (found, expected) in x.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert_eq!(solve([[1.0, 2.0], [2.0, 4.0_f64]], [1.0, 1.0]), None);
    }

    #[test]
    fn eigenvalues_of_a_known_matrix() {
        // second difference matrix: 2 − 2 cos(kπ/4)
        let m = [[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0_f64]];
        let (smallest, largest) = extreme_eigenvalues(m);
        assert!((smallest - (2.0 - libm::sqrt(2.0))).abs() < 1e-14);
        assert!((largest - (2.0 + libm::sqrt(2.0))).abs() < 1e-14);
        assert_eq!(extreme_eigenvalues([[3.0_f32]]), (3.0, 3.0));
    }
}

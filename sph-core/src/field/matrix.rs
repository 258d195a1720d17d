//! Small dense linear algebra on `[[T; D]; D]`, D ≤ 4 in practice.

use crate::Scalar;

/// The solution of M x = b by Gaussian elimination with partial pivoting; `None` where a pivot vanishes or the result is
/// not finite.
#[inline(never)]
pub(super) fn solve<T: Scalar, const D: usize>(mut m: [[T; D]; D], mut b: [T; D]) -> Option<[T; D]> {
    for column in 0..D {
        let pivot = largest_below(&m, column);
        m.swap(column, pivot);
        // swapped by hand: `swap` keeps a check of the index here on Cortex-M0 with link-time optimisation
        if let Some(&value) = b.get(pivot) {
            b[pivot] = b[column];
            b[column] = value;
        }
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
    // Most matrices are far from singular, which a bound shows at a tenth of the cost of the eigenvalues; types of few digits
    // cannot hold it.
    if T::EPSILON.to_f64() < 1e-6 && least_ratio(&m) > least.times(2) {
        return true;
    }
    let (smallest, largest) = extreme_eigenvalues(m);
    smallest > largest * least
}

/// A number that λ_min / λ_max is not below, for a symmetric matrix, of which the lower triangle is read; zero where a pivot is
/// not above zero.
///
/// Of n positive eigenvalues the largest is below their sum tr, and the n − 1 largest have a product of at most
/// (tr / (n − 1))^(n−1), their mean being at most tr / (n − 1). Hence λ_min / λ_max ≥ (n − 1)^(n−1) det / tr^n.
fn least_ratio<T: Scalar, const D: usize>(m: &[[T; D]; D]) -> T {
    let mut trace = T::ZERO;
    for axis in 0..D {
        trace += m[axis][axis];
    }
    let (mut m, mut ratio) = (*m, T::ONE);
    for column in 0..D {
        let pivot = m[column][column];
        if !pivot.is_above_zero() {
            return T::ZERO;
        }
        let inverse = T::ONE / pivot;
        for row in column + 1..D {
            let factor = m[row][column] * inverse;
            for k in column + 1..=row {
                let change = factor * m[k][column];
                m[row][k] -= change;
            }
        }
        let others = if column > 0 { D as i32 - 1 } else { 1 };
        ratio = ratio * (pivot / trace).times(others);
    }
    ratio
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

    #[test]
    fn the_bound_is_below_the_ratio_of_the_eigenvalues_and_above_zero_only_for_positive_matrices() {
        let mut random = 1_u32;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(random >> 8) / f64::from(1 << 24) - 0.5
        };
        let mut largest = 0.0_f64;
        for i in 0..500 {
            // Σ v vᵀ over four vectors, of which the last axis is flattened more and more
            let mut m = [[0.0; 4]; 4];
            for _ in 0..4 {
                let v = [next(), next(), next(), next() * libm::pow(0.98, i as f64)];
                for a in 0..4 {
                    for b in 0..4 {
                        m[a][b] += v[a] * v[b];
                    }
                }
            }
            let ((least, most), bound) = (extreme_eigenvalues(m), least_ratio(&m));
            assert!(bound <= least / most * 1.000001 && bound >= 0.0, "{i}: {bound} {least} {most}");
            largest = largest.max(bound);
        }
        assert!(largest > 0.01, "{largest}");
        assert_eq!(least_ratio(&[[2.0_f64, 0.0], [0.0, 2.0]]), 0.25);
        assert_eq!(least_ratio(&[[3.0_f32]]), 1.0);
        assert_eq!(least_ratio(&[[1.0_f64, 2.0], [2.0, 1.0]]), 0.0);
        assert_eq!(least_ratio(&[[f64::NAN]]), 0.0);
    }
}

//! The Jacobian of a vector field at samples, and what follows from it: divergence and curl.
//!
//! ```text
//! J_i = Σ V_j (A_j − A_i) ⊗ ∇W_ij,   J[a][b] = ∂A_a/∂x_b       zero for constants
//! div A = J[0][0] + J[1][1] + …       curl A = (J[2][1] − J[1][2], J[0][2] − J[2][0], J[1][0] − J[0][1])
//! ```

use super::{Field, Summand};
use crate::vector::sub;
use crate::{Influence, InfluenceOf, Neighbours, PerSample, Scalar};

impl<T: Scalar, const D: usize, N: Neighbours<T, D>, M: PerSample<T>, V> Field<'_, T, D, N, M, V> {
    /// ∂A_a/∂x_b at sample i by the difference form, row a, column b; `None` where there is no such sample.
    ///
    /// ```
    /// use sph_core::{BruteForce, Field, KernelInfluence, Sources, Uniform, field, kernel::CubicSpline};
    /// let positions = [[0.0_f64, 0.0], [0.5, 0.0], [-0.5, 0.0], [0.0, 0.5], [0.0, -0.5]];
    /// let velocity = positions.map(|[x, y]| [-y, x]); // rigid rotation
    /// let volumes = Sources::new(BruteForce::new(&positions)?, Uniform(0.25))?;
    /// let w = KernelInfluence::<f64, 2, CubicSpline>::new(1.0)?;
    /// let jacobian = Field::new(&volumes, &velocity)?.jacobian(&w, 0).unwrap();
    /// assert!(field::divergence(&jacobian).abs() < 1e-12);
    /// assert!(field::curl_2d(&jacobian) > 0.0);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    pub fn jacobian<const C: usize>(&self, w: impl InfluenceOf<T, D>, i: usize) -> Option<[[T; D]; C]>
    where
        V: PerSample<[T; C]>,
    {
        let (x, own) = self.sample::<[T; C]>(i)?;
        let mut rows = [<[T; D] as Summand<T>>::EMPTY; C];
        self.sources.for_each(w, &x, |neighbour, volume, influence| {
            if let Some(value) = self.values.get(neighbour.index) {
                let slope = influence.gradient(&neighbour.offset, neighbour.distance_squared);
                for (row, component) in rows.iter_mut().zip(sub(&value, &own)) {
                    slope.add_weighted(row, volume * component);
                }
            }
        });
        Some(rows.map(<[T; D] as Summand<T>>::total))
    }
}

/// div A, the trace of the Jacobian.
pub fn divergence<T: Scalar, const D: usize>(jacobian: &[[T; D]; D]) -> T {
    let mut trace = T::ZERO;
    for axis in 0..D {
        trace += jacobian[axis][axis];
    }
    trace
}

/// curl A in two dimensions, ∂A_y/∂x − ∂A_x/∂y.
pub fn curl_2d<T: Scalar>(jacobian: &[[T; 2]; 2]) -> T {
    jacobian[1][0] - jacobian[0][1]
}

/// curl A in three dimensions.
pub fn curl<T: Scalar>(jacobian: &[[T; 3]; 3]) -> [T; 3] {
    let j = jacobian;
    [j[2][1] - j[1][2], j[0][2] - j[2][0], j[1][0] - j[0][1]]
}

//! The fields by their definitions: every particle at every point, nothing shared with the library.

use std::f64::consts::PI;

/// Kernel name, f(q) and its σ in 1, 2 and 3 dimensions.
pub(crate) struct Kernel {
    pub(crate) name: &'static str,
    profile: fn(usize, f64) -> f64,
    slope: fn(usize, f64) -> f64,
    normalisation: [f64; 3],
}

pub(crate) const KERNELS: [Kernel; 4] = [
    Kernel {
        name: "cubic-spline",
        profile: |_, q| {
            if q < 0.5 { 1.0 - 6.0 * q * q + 6.0 * q.powi(3) } else { 2.0 * (1.0 - q).max(0.0).powi(3) }
        },
        slope: |_, q| if q < 0.5 { -12.0 * q + 18.0 * q * q } else { -6.0 * (1.0 - q).max(0.0).powi(2) },
        normalisation: [4.0 / 3.0, 40.0 / (7.0 * PI), 8.0 / PI],
    },
    Kernel {
        name: "poly6",
        profile: |_, q| (1.0 - q * q).max(0.0).powi(3),
        slope: |_, q| -6.0 * q * (1.0 - q * q).max(0.0).powi(2),
        normalisation: [35.0 / 32.0, 4.0 / PI, 315.0 / (64.0 * PI)],
    },
    Kernel {
        name: "spiky",
        profile: |_, q| (1.0 - q).max(0.0).powi(3),
        slope: |_, q| -3.0 * (1.0 - q).max(0.0).powi(2),
        normalisation: [2.0, 10.0 / PI, 15.0 / PI],
    },
    Kernel {
        name: "wendland-c2",
        profile: |dim, q| {
            let p = (1.0 - q).max(0.0);
            if dim == 1 { p.powi(3) * (1.0 + 3.0 * q) } else { p.powi(4) * (1.0 + 4.0 * q) }
        },
        slope: |dim, q| {
            let p = (1.0 - q).max(0.0);
            if dim == 1 { -12.0 * q * p.powi(2) } else { -20.0 * q * p.powi(3) }
        },
        normalisation: [1.25, 7.0 / PI, 21.0 / (2.0 * PI)],
    },
];

/// Particles with everything that the sums need.
pub(crate) struct Cloud<'a> {
    pub(crate) kernel: &'a Kernel,
    pub(crate) positions: Vec<Vec<f64>>,
    pub(crate) masses: Vec<f64>,
    pub(crate) densities: Vec<f64>,
    pub(crate) supports: Vec<f64>,
}

/// A value and its gradient.
pub(crate) type Local = (f64, Vec<f64>);

impl Cloud<'_> {
    fn dim(&self) -> usize {
        self.positions[0].len()
    }

    /// W and ∇W of particle j at x.
    fn influence(&self, j: usize, x: &[f64]) -> Local {
        let (dim, h) = (self.dim(), self.supports[j]);
        let offset: Vec<f64> = x.iter().zip(&self.positions[j]).map(|(a, b)| a - b).collect();
        let r = offset.iter().map(|d| d * d).sum::<f64>().sqrt();
        let scale = self.kernel.normalisation[dim - 1] / h.powi(dim as i32);
        let slope = if r > 0.0 { scale * (self.kernel.slope)(dim, r / h) / (h * r) } else { 0.0 };
        (scale * (self.kernel.profile)(dim, r / h), offset.iter().map(|d| d * slope).collect())
    }

    /// Σ w_j W and Σ w_j ∇W.
    fn sum(&self, x: &[f64], weight: impl Fn(usize) -> f64) -> Local {
        let mut total = (0.0, vec![0.0; self.dim()]);
        for j in 0..self.positions.len() {
            let (value, gradient) = self.influence(j, x);
            total.0 += weight(j) * value;
            total.1.iter_mut().zip(gradient).for_each(|(sum, d)| *sum += weight(j) * d);
        }
        total
    }

    pub(crate) fn density(&self, x: &[f64]) -> Local {
        self.sum(x, |j| self.masses[j])
    }

    /// Takes the densities of Thm 3.2 for those of the particles.
    pub(crate) fn recompute_densities(&mut self) {
        self.densities = self.positions.iter().map(|x| self.density(x).0).collect();
    }

    fn volume(&self, j: usize) -> f64 {
        self.masses[j] / self.densities[j]
    }

    pub(crate) fn plain(&self, x: &[f64], values: &[f64]) -> Local {
        self.sum(x, |j| self.volume(j) * values[j])
    }

    pub(crate) fn shepard(&self, x: &[f64], values: &[f64]) -> Local {
        let (above, above_slope) = self.plain(x, values);
        let (below, below_slope) = self.sum(x, |j| self.volume(j));
        let quotient = |(n, d): (&f64, &f64)| (n * below - above * d) / (below * below);
        (above / below, above_slope.iter().zip(&below_slope).map(quotient).collect())
    }

    /// The weighted least squares fit a + g·(x_j − x) by its normal equations.
    pub(crate) fn corrected(&self, x: &[f64], values: &[f64]) -> Local {
        let size = self.dim() + 1;
        let mut rows = vec![vec![0.0; size + 1]; size];
        for j in 0..self.positions.len() {
            let weight = self.volume(j) * self.influence(j, x).0;
            let difference = self.positions[j].iter().zip(x).map(|(a, b)| a - b);
            let basis: Vec<f64> = std::iter::once(1.0).chain(difference).chain([values[j]]).collect();
            for (row, a) in rows.iter_mut().zip(&basis) {
                row.iter_mut().zip(&basis).for_each(|(cell, b)| *cell += weight * a * b);
            }
        }
        let fit = gauss_jordan(rows);
        (fit[0], fit[1..].to_vec())
    }
}

/// The solution of the augmented system `rows`.
fn gauss_jordan(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    for column in 0..rows.len() {
        let size = |row: &usize| rows[*row][column].abs();
        let pivot = (column..rows.len()).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
        rows.swap(column, pivot);
        let lead = rows[column].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(number, _)| *number != column) {
            let factor = row[column] / lead[column];
            row.iter_mut().zip(&lead).for_each(|(cell, above)| *cell -= factor * above);
        }
    }
    rows.iter().enumerate().map(|(column, row)| row[row.len() - 1] / row[column]).collect()
}

//! Sums Σ c_j W(x − x_j) and Σ c_j ∇W(x − x_j) at any points, for any coefficients c_j: masses give a density, V_j A_j an
//! interpolated field, V_j the weights of Shepard's form.

use sph_core::kernel::Kernel;
use sph_core::{Error, KernelInfluence, Parameter};

use super::cells::BandLayout;
use super::radius_octaves::OwnRadii;
use super::simd::Real;
use super::sort::sort;
use super::sorted_cells::{SortedCells, bounds, check_length};
use super::sums::{Group, PointScratch};
use crate::parallel;

/// Points that a thread takes at a time.
const CHUNK: usize = 1024;
/// Points that go through each step of the sums together.
const GROUP: usize = 16;

/// Coefficients c_j of particles in [`SortedCells`] or [`RadiusOctaves`](super::RadiusOctaves), ready to be summed anywhere.
#[derive(Clone, Debug)]
pub struct Fields<'a, T, const D: usize> {
    pub(super) parts: Vec<Part<'a, T, D>>,
    pub(super) width: usize,
}

/// The coefficients of the particles of one set of cells.
#[derive(Clone, Debug)]
pub(super) struct Part<'a, T, const D: usize> {
    pub(super) cells: &'a SortedCells<T, D>,
    /// h_j and σ_D h_j^{-D}, where each particle has its own.
    pub(super) own: Option<&'a OwnRadii<T>>,
    /// Field by field, in the order of the cells, and after the last particle a block of zeros.
    pub(super) coefficients: Vec<Vec<T>>,
}

/// Sums at points.
#[derive(Clone, Debug, PartialEq)]
pub struct Sums<T> {
    /// For each point, and for each of the coefficients, Σ c_j W and, where gradients were asked for, the D components of
    /// Σ c_j ∇W.
    pub values: Vec<T>,
    /// For each point, how many particles are in reach.
    pub reached: Vec<u32>,
}

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// Joins the cells with coefficients: each slice has one for each particle, in the order of the input.
    ///
    /// ```
    /// use sph_core::kernel::CubicSpline;
    /// use sph_host::fast::SortedCells;
    ///
    /// // Σ V_j A_j W for A = 3x on a row of particles, V = 0.1: value and slope in the middle
    /// let row: Vec<[f64; 1]> = (0..100).map(|i| [0.1 * f64::from(i)]).collect();
    /// let field: Vec<f64> = row.iter().map(|[x]| 0.1 * 3.0 * x).collect();
    /// let cells = SortedCells::sort(&row, 0.4)?;
    /// let sums = cells.fields(&[&field])?.at::<CubicSpline>(&[[5.0]], true)?;
    /// assert!((sums.values[0] - 15.0).abs() < 1e-12 && (sums.values[1] - 3.0).abs() < 1e-12);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless every slice has a coefficient for each particle.
    pub fn fields(&self, coefficients: &[&[T]]) -> Result<Fields<'_, T, D>, Error> {
        for slice in coefficients {
            check_length(slice.len(), self.len(), Parameter::Value)?;
        }
        Ok(Fields { parts: vec![Part::new(self, None, coefficients)], width: coefficients.len() })
    }
}

impl<'a, T: Real, const D: usize> Part<'a, T, D> {
    /// Sorts the coefficients; there is one for each index of the cells.
    pub(super) fn new(
        cells: &'a SortedCells<T, D>,
        own: Option<&'a OwnRadii<T>>,
        coefficients: &[&[T]],
    ) -> Self {
        let coefficients = coefficients.iter().map(|slice| cells.sorted.column(|j| slice[j])).collect();
        Self { cells, own, coefficients }
    }

    /// What all sums are multiplied with: σ_D h^{-D}, or σ_D where each particle has its own h.
    fn constant<K: Kernel>(&self) -> Result<T, Error> {
        let Some(own) = self.own else {
            return Ok(KernelInfluence::<T, D, K>::new(self.cells.radius)?.normalisation());
        };
        for radius in [own.least, self.cells.radius] {
            KernelInfluence::<T, D, K>::new(radius)?;
        }
        Ok(KernelInfluence::<T, D, K>::new(T::ONE)?.normalisation())
    }
}

impl<T: Real, const D: usize> Fields<'_, T, D> {
    /// The sums at points, in any order; points that are close together in space cost less when they come together, so they
    /// are sorted first.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for such a point; those of [`KernelInfluence::new`].
    pub fn at<K: Kernel>(&self, points: &[[T; D]], gradient: bool) -> Result<Sums<T>, Error> {
        let constants: Vec<T> =
            self.parts.iter().map(|part| part.constant::<K>()).collect::<Result<_, _>>()?;
        let add: AddGroup<T, D> = |group, values, reached, scratch| group.add::<K>(values, reached, scratch);
        self.sums(add, &constants, points, gradient)
    }

    fn sums(
        &self,
        add: AddGroup<T, D>,
        constants: &[T],
        points: &[[T; D]],
        gradient: bool,
    ) -> Result<Sums<T>, Error> {
        let (lower, upper) = bounds(points)?;
        let radius = self.parts.first().map_or(1.0, |part| part.cells.radius.to_f64());
        let points = sort(&BandLayout::new(lower, upper, radius, points.len()), points);

        let row = (self.width * if gradient { 1 + D } else { 1 }).max(1);
        let mut values = vec![T::ZERO; row * points.order.len()];
        let mut reached = vec![0; points.order.len()];
        let work = values.chunks_mut(row * CHUNK).zip(reached.chunks_mut(CHUNK));
        parallel::for_each_with(work, |scratch, chunk, (values, reached)| {
            let groups = values.chunks_mut(row * GROUP).zip(reached.chunks_mut(GROUP));
            for (group, (values, reached)) in groups.enumerate() {
                let first = chunk * CHUNK + group * GROUP;
                let range = first..first + reached.len();
                for (part, &constant) in self.parts.iter().zip(constants) {
                    let group = Group { part, constant, points: &points, range: range.clone(), gradient };
                    add(&group, values, reached, scratch);
                }
            }
        });
        Ok(Sums {
            values: unsorted(&values, row, &points.order),
            reached: unsorted(&reached, 1, &points.order),
        })
    }
}

/// [`Group::add`] for a kernel: all else is compiled once for all kernels.
type AddGroup<T, const D: usize> = fn(&Group<'_, T, D>, &mut [T], &mut [u32], &mut PointScratch<T, D>);

/// Rows in the order that they had before they were sorted.
fn unsorted<V: Copy + Default + Send + Sync>(rows: &[V], width: usize, order: &[u32]) -> Vec<V> {
    let mut places = vec![0_u32; order.len()];
    for (place, &index) in order.iter().enumerate() {
        places[index as usize] = place as u32;
    }
    let mut out = vec![V::default(); rows.len()];
    let work = out.chunks_mut(width * CHUNK).zip(places.chunks(CHUNK));
    parallel::for_each(work, |_, (out, places)| {
        for (out, &place) in out.chunks_exact_mut(width).zip(places) {
            out.copy_from_slice(&rows[place as usize * width..][..width]);
        }
    });
    out
}

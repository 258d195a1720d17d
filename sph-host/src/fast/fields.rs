//! Fields at any points: estimates from what particles carry, and plain sums Σ c_j W(x − x_j) and Σ c_j ∇W(x − x_j).

use std::ops::Range;

use sph_core::field::{Estimate, Plain, PlainWithGradient};
use sph_core::kernel::Kernel;
use sph_core::{Error, Parameter, Scalar};

use super::cells::BandLayout;
use super::evaluate::Evaluator;
use super::part::{FieldKernel, Part, Samples};
use super::simd::Real;
use super::sort::{Sorted, sort};
use super::sorted_cells::{SortedCells, bounds, check_length};
use super::sums::PointSums;
use super::terms::{Group, PointScratch};
use crate::estimate_choice::{Estimate as EstimateChoice, with_estimate};
use crate::parallel;

/// Points that a thread takes at a time.
const CHUNK: usize = 1024;
/// Points that go through each step of the sums together.
const GROUP: usize = 16;

/// What the particles of [`SortedCells`] or [`RadiusOctaves`](super::RadiusOctaves) carry, ready to be estimated anywhere.
#[derive(Clone, Debug)]
pub struct Fields<'a, T, const D: usize> {
    parts: Vec<Part<'a, T, D>>,
    /// How many plain sums there are.
    plain: usize,
    /// How many fields are estimated.
    fields: usize,
}

/// Plain sums and estimated fields at points.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimates<T> {
    /// For each point, for each plain sum and then for each field, its value and, where gradients were asked for, the D
    /// components of the gradient; NaN where there is no estimate.
    pub values: Vec<T>,
    /// For each point, how many particles are in reach.
    pub reached: Vec<u32>,
    /// For each point, whether what is in reach carries the estimate of the fields: not where Σ V_j W is zero for Shepard's
    /// form, and not where the moments of the corrected one are ill-conditioned.
    pub carried: Vec<bool>,
}

impl<T: Real, const D: usize> SortedCells<T, D> {
    /// Joins the cells with coefficients of plain sums: each slice has one for each particle, in the order of the input.
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
        self.samples(&Samples { coefficients, volumes: &[], values: &[] })
    }

    /// Joins the cells with what the particles carry.
    ///
    /// ```
    /// use sph_core::kernel::CubicSpline;
    /// use sph_host::estimate_choice::Estimate;
    /// use sph_host::fast::{Samples, SortedCells};
    ///
    /// // A = 3x on a row that ends at x = 0, where the plain estimate sees half of what it would see within
    /// let row: Vec<[f64; 1]> = (0..100).map(|i| [0.1 * f64::from(i)]).collect();
    /// let field: Vec<f64> = row.iter().map(|[x]| 3.0 * x + 1.0).collect();
    /// let cells = SortedCells::sort(&row, 0.4)?;
    /// let fields = cells.samples(&Samples { coefficients: &[], volumes: &[0.1; 100], values: &[&field] })?;
    /// let at_end = fields.estimate::<CubicSpline>(Estimate::Corrected, &[[0.0]], true)?;
    /// assert!((at_end.values[0] - 1.0).abs() < 1e-12 && (at_end.values[1] - 3.0).abs() < 1e-12);
    /// # Ok::<(), sph_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless every slice has a number for each particle.
    pub fn samples(&self, samples: &Samples<'_, T>) -> Result<Fields<'_, T, D>, Error> {
        samples.check(self.len())?;
        Ok(Fields::new(vec![Part::new(self, None, samples)], samples))
    }
}

impl<T> Samples<'_, T> {
    /// There is a number for each of so many particles in every slice.
    pub(super) fn check(&self, particles: usize) -> Result<(), Error> {
        for slice in self.coefficients.iter().chain(self.values) {
            check_length(slice.len(), particles, Parameter::Value)?;
        }
        if self.values.is_empty() {
            Ok(())
        } else {
            check_length(self.volumes.len(), particles, Parameter::Volume)
        }
    }
}

impl<'a, T: Real, const D: usize> Fields<'a, T, D> {
    pub(super) fn new(parts: Vec<Part<'a, T, D>>, samples: &Samples<'_, T>) -> Self {
        Self { parts, plain: samples.coefficients.len(), fields: samples.values.len() }
    }

    /// The largest h.
    fn reach(&self) -> T {
        self.parts.iter().map(|part| part.cells.radius).fold(T::ZERO, Scalar::max)
    }

    /// The sums at points, those of the fields plain too.
    ///
    /// # Errors
    /// [`Error::NotFinite`] for such a point; those of [`KernelInfluence::new`](sph_core::KernelInfluence::new).
    pub fn at<K: Kernel>(&self, points: &[[T; D]], gradient: bool) -> Result<Estimates<T>, Error> {
        if gradient {
            self.run::<PlainWithGradient, PlainWithGradient>(&FieldKernel::new::<K>(), points, true)
        } else {
            self.run::<Plain, Plain>(&FieldKernel::new::<K>(), points, false)
        }
    }

    /// The plain sums and the estimated fields at points, in any order; points that are close together in space cost less when they
    /// come together, so they are sorted first.
    ///
    /// # Errors
    /// As [`at`](Self::at).
    pub fn estimate<K: Kernel>(
        &self,
        estimate: EstimateChoice,
        points: &[[T; D]],
        gradient: bool,
    ) -> Result<Estimates<T>, Error> {
        self.estimate_with(&FieldKernel::new::<K>(), estimate, points, gradient)
    }

    fn estimate_with(
        &self,
        kernel: &FieldKernel<T, D>,
        estimate: EstimateChoice,
        points: &[[T; D]],
        gradient: bool,
    ) -> Result<Estimates<T>, Error> {
        if gradient {
            with_estimate!(estimate, gradient E => self.run::<PlainWithGradient, E>(kernel, points, true))
        } else {
            with_estimate!(estimate, value E => self.run::<Plain, E>(kernel, points, false))
        }
    }

    /// The fields by an estimate E, and the plain sums by P.
    fn run<P: Estimate<T, D>, E: Estimate<T, D>>(
        &self,
        kernel: &FieldKernel<T, D>,
        points: &[[T; D]],
        gradient: bool,
    ) -> Result<Estimates<T>, Error> {
        let mut constants = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            constants.push(part.constant(kernel)?);
        }
        let (lower, upper) = bounds(points)?;
        let radius = self.parts.first().map_or(1.0, |part| part.cells.radius.to_f64());
        let points = sort(&BandLayout::new(lower, upper, radius, points.len()), points);
        let of_field = if gradient { 1 + D } else { 1 };
        let width = ((self.plain + self.fields) * of_field).max(1);
        let count = points.order.len();
        let mut values = vec![T::ZERO; width * count];
        let (mut reached, mut carried) = (vec![0; count], vec![true; count]);
        let work = Evaluation {
            fields: self,
            evaluate: kernel.evaluate,
            constants: &constants,
            points: &points,
            of_field,
        };
        let out =
            (values.chunks_mut(width * CHUNK).zip(reached.chunks_mut(CHUNK))).zip(carried.chunks_mut(CHUNK));
        parallel::for_each_with(out, |found, chunk, ((values, reached), carried)| {
            let mut sums = (PointSums::<T, D, P>::default(), PointSums::<T, D, E>::default());
            let out = (values.chunks_mut(width * GROUP).zip(reached.chunks_mut(GROUP)))
                .zip(carried.chunks_mut(GROUP));
            for (group, ((values, reached), carried)) in out.enumerate() {
                let first = chunk * CHUNK + group * GROUP;
                work.sum_up(first..first + reached.len(), reached, found, &mut sums);
                let rows = values.chunks_exact_mut(width).zip(carried);
                rows.enumerate()
                    .for_each(|(point, (row, carried))| *carried = work.finish(point, row, &sums));
            }
        });
        Ok(Estimates {
            values: unsorted(&values, width, &points.order),
            reached: unsorted(&reached, 1, &points.order),
            carried: unsorted(&carried, 1, &points.order),
        })
    }
}

/// What all threads need to know.
struct Evaluation<'a, T, const D: usize> {
    fields: &'a Fields<'a, T, D>,
    evaluate: Evaluator<T>,
    /// σ_D h^{-D} of each part.
    constants: &'a [T],
    points: &'a Sorted<T, D>,
    /// Numbers that each field has in a row.
    of_field: usize,
}

/// The plain sums at a group of points, and those of the fields.
type GroupSums<T, const D: usize, P, E> = (PointSums<T, D, P>, PointSums<T, D, E>);

impl<T: Real, const D: usize> Evaluation<'_, T, D> {
    /// The sums at a group of points, by P the plain ones and by E those of the fields, and how many particles are in reach.
    fn sum_up<P: Estimate<T, D>, E: Estimate<T, D>>(
        &self,
        range: Range<usize>,
        reached: &mut [u32],
        found: &mut PointScratch<T, D>,
        (plain, fields): &mut GroupSums<T, D, P, E>,
    ) {
        let Self { fields: Fields { parts, .. }, points, constants, .. } = *self;
        plain.reset(range.len(), self.fields.plain);
        fields.reset(range.len(), self.fields.fields);
        let has_plain = self.fields.plain > 0;
        let reads = match (has_plain, self.fields.fields > 0) {
            (true, true) => P::READS.and(E::READS),
            (false, true) => E::READS,
            (_, false) => P::READS,
        };
        let reach = self.fields.reach();
        for (part, &constant) in parts.iter().zip(constants) {
            let group = Group { part, constant, reach, points, range: range.clone() };
            group.find(self.evaluate, reads, reached, found);
            group.add(&[], &part.coefficients, plain, found);
            group.add(&part.volumes, &part.weighted_values, fields, found);
        }
    }

    /// Writes the row of a point of the group; returns whether what is in reach carries the estimate of the fields.
    fn finish<P: Estimate<T, D>, E: Estimate<T, D>>(
        &self,
        point: usize,
        row: &mut [T],
        (plain, fields): &GroupSums<T, D, P, E>,
    ) -> bool {
        let reach = self.fields.reach();
        let mut out = row.chunks_exact_mut(self.of_field);
        let mut put = |estimate: Option<(T, [T; D])>| {
            if let Some(out) = out.next() {
                let none = T::from_f64(f64::NAN);
                let (value, gradient) = estimate.unwrap_or((none, [none; D]));
                out[0] = value;
                out[1..].iter_mut().zip(gradient).for_each(|(out, component)| *out = component);
            }
        };
        plain.finish(point, reach, &mut put);
        fields.finish(point, reach, &mut put)
    }
}

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

//! The sums of a plan at every point, in parallel; no bit depends on the number of threads.

mod exact;
mod fast;
mod rows;
mod scene;

pub(super) use rows::{Counts, Evaluated};

use super::check::Set;
use super::error::SampleError;
use super::particles::Particles;
use super::plan::Plan;
use super::points::Points;
use super::slabs::Slabs;
use crate::progress::Progress;
use crate::scalar_choice::{ScalarName, with_scalar};

/// Evaluates a plan at all points.
pub(super) fn evaluate(
    plan: &Plan<'_>,
    particles: &mut Set,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, SampleError> {
    match particles {
        Set::Whole(particles) => over(plan, particles, points, progress),
        Set::Slabs(slabs) => slab_by_slab(plan, slabs, points, progress),
    }
}

/// The sums over each slab at the points in it.
fn slab_by_slab(
    plan: &Plan<'_>,
    slabs: &mut Slabs,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, SampleError> {
    let mut done = Evaluated { columns: rows::empty_columns(plan, points.len()), ..Evaluated::default() };
    for (slab, numbers) in slabs.points_of_each(points).iter().enumerate() {
        if numbers.is_empty() {
            continue;
        }
        let particles = slabs.load(slab, &plan.span)?;
        let part = over(plan, &particles, &points.some(numbers), progress)?;
        for (values, part) in done.columns.iter_mut().zip(&part.columns) {
            numbers.iter().zip(part).for_each(|(&number, &value)| values[number] = value);
        }
        done.counts = done.counts + part.counts;
        done.search_seconds += part.search_seconds;
        done.evaluate_seconds += part.evaluate_seconds;
    }
    Ok(done)
}

/// The sums over these particles in the plan's scalar and dimensions, on the fast path where that has them.
fn over(
    plan: &Plan<'_>,
    particles: &Particles,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, SampleError> {
    macro_rules! in_dimensions {
        ($path:ident, $T:ty) => {
            match plan.axes.len() {
                1 => $path::evaluate::<$T, 1>(plan, particles, points, progress),
                2 => $path::evaluate::<$T, 2>(plan, particles, points, progress),
                _ => $path::evaluate::<$T, 3>(plan, particles, points, progress),
            }
        };
    }
    let is_fast = !plan.request.exact;
    match (is_fast, plan.request.scalar) {
        (true, ScalarName::F32) => in_dimensions!(fast, f32),
        (true, ScalarName::F64) => in_dimensions!(fast, f64),
        _ => with_scalar!(plan.request.scalar, T => in_dimensions!(exact, T)),
    }
}

//! The exact path: every scalar, in sph-core's order of summation.

use std::time::Instant;

use sph_core::field::Estimate;
use sph_core::{Field, Scalar, Sources};

use super::rows::{Counts, Evaluated, empty_columns, fill};
use super::scene::Scene;
use crate::estimate_choice::with_estimate;
use crate::progress::Progress;
use crate::sample::error::SampleError;
use crate::sample::found::AtPoint;
use crate::sample::particles::Particles;
use crate::sample::plan::Plan;
use crate::sample::points::Points;
use crate::sample::stencil::{Contribution, Stencil};

/// Evaluates a plan in the scalar T and D dimensions.
pub(super) fn evaluate<T: Scalar, const D: usize>(
    plan: &Plan<'_>,
    particles: &Particles,
    points: &Points,
    progress: &dyn Progress,
) -> Result<Evaluated, SampleError> {
    let start = Instant::now();
    let scene = Scene::<T, D>::new(plan, particles)?;
    let search_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let frame = plan.units.frame::<D>();
    let along: [&[f64]; D] = std::array::from_fn(|axis| points.along(plan.space[axis]));
    let sums = Sums { plan, scene: &scene };
    let mut columns = empty_columns(plan, points.len());
    let mut slices: Vec<&mut [f64]> = columns.iter_mut().map(Vec::as_mut_slice).collect();
    let counts = fill(plan, &mut slices, points.len(), progress, |point, near, at, counts| {
        let x = frame.point::<T>(std::array::from_fn(|axis| along[axis][point]));
        sums.at(&x, near, at, counts);
    });
    Ok(Evaluated { columns, counts, search_seconds, evaluate_seconds: start.elapsed().as_secs_f64() })
}

struct Sums<'a, T, const D: usize> {
    plan: &'a Plan<'a>,
    scene: &'a Scene<T, D>,
}

impl<T: Scalar, const D: usize> Sums<'_, T, D> {
    /// What there is at x.
    fn at(
        &self,
        x: &[T; D],
        near: &mut Vec<Contribution<T, D>>,
        at: &mut AtPoint<T, D>,
        counts: &mut Counts,
    ) {
        // a scalar that stays at the end of its range would put the point there
        if x.iter().any(|component| !component.is_finite() && component.to_f64().is_finite()) {
            counts.overflowed += self.plan.columns.len();
            return;
        }
        let (scene, gradient) = (self.scene, self.plan.request.gradient);
        let stencil = Stencil::gather(near, &scene.search(), scene.influences(), scene.reach, x, gradient);
        counts.out_of_reach += usize::from(stencil.is_empty());
        if let Some(masses) = &scene.masses {
            let sources = Sources::assume_checked(stencil, stencil.pick(masses));
            at.density = Some(match gradient {
                true => sources.density_gradient_at(stencil, x),
                false => (sources.density_at(stencil, x), [T::ZERO; D]),
            });
        }
        if !scene.values.is_empty() {
            let estimate = self.plan.request.estimate;
            let is_carried = match gradient {
                true => with_estimate!(estimate, gradient E => self.fields::<E>(stencil, x, at)),
                false => with_estimate!(estimate, value E => self.fields::<E>(stencil, x, at)),
            };
            counts.not_carried += usize::from(!is_carried && !stencil.is_empty());
        }
    }

    /// Appends what the fields are at x by an estimate. Returns whether the particles in reach carry it.
    fn fields<E: Estimate<T, D>>(
        &self,
        stencil: Stencil<'_, T, D>,
        x: &[T; D],
        at: &mut AtPoint<T, D>,
    ) -> bool {
        let volumes = Sources::assume_checked(stencil, stencil.pick(&self.scene.volumes));
        let basis = E::basis(volumes.moments_at::<E>(stencil, x), self.scene.reach);
        at.fields.extend(self.scene.values.iter().map(|values| {
            let field = Field::new(&volumes, stencil.pick(values)).ok()?;
            field.finish_at::<E>(basis.as_ref()?, stencil, x)
        }));
        basis.is_some()
    }
}

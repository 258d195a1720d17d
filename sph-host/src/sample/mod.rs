//! Fields of a particle set at points.
//!
//! A [`Request`] is met in steps, each a module with one entry: `read` takes tables from files, `check` makes particles and
//! points of them, `plan` chooses units and columns, `evaluate` sums, and what comes of it is a [`Table`] to be written.
//!
//! ```
//! use sph_host::kernel_choice::KernelName;
//! use sph_host::estimate_choice::Estimate;
//! use sph_host::sample::{self, ParticleSource, Request, SamplePoints};
//! use sph_host::scalar_choice::ScalarName;
//!
//! let request = Request {
//!     particles: ParticleSource::Demo("vortex".into(), Some(400)),
//!     at: SamplePoints::Grid { counts: vec![8, 8], bounds: None },
//!     kernel: KernelName::CubicSpline,
//!     dim: None,
//!     quantities: vec!["pressure".into()],
//!     gradient: false,
//!     surface: None,
//!     support: None,
//!     only: Vec::new(),
//!     periodic: None,
//!     estimate: Estimate::Shepard,
//!     mass: None,
//!     recompute_density: false,
//!     scalar: ScalarName::F64,
//!     part: None,
//!     threads: None,
//!     chunk: None,
//!     exact: false,
//! };
//! let sampled = sample::run(&request, &())?;
//! assert_eq!((sampled.table.points(), sampled.particles), (64, 400));
//! assert_eq!(sampled.table.columns[1].name, "pressure");
//! # Ok::<(), sample::SampleError>(())
//! ```
//!
//! # What exact sums promise
//!
//! With `exact`, sums have the bits of a program, on a microcontroller say, that links sph-core and is given the same numbers: for
//! each coordinate (x − origin) / length, for the support radius h / length, for masses m / mass, for densities ρ / density and
//! for each quantity A / unit, all divided in f64 and then rounded to the scalar. [`Sampled::units`] has these [`Units`]. The search is
//! a [`CellGrid`](sph_core::CellGrid) of [`CellLayout::bounded`](sph_core::CellLayout::bounded): [`Units::cells`] over the box of
//! the particles in these units, an axis without extent being h long. What is found, multiplied by the unit of its column, is what the result
//! holds: density, quantity, and for gradients those over length. Pieces of a file give the bits of the whole.

mod check;
mod error;
mod evaluate;
mod found;
mod memory;
mod only;
mod outline;
mod particle_set;
mod particles;
mod periodic;
mod plan;
mod planes;
mod points;
mod read;
mod region;
mod request;
mod significant;
mod slabs;
mod span;
mod stencil;
mod table;
mod units;
mod warning;

pub use error::SampleError;
pub use only::{Only, Taken, Wanted};
pub(crate) use particle_set::ParticleSet;
pub use request::{PartOfPoints, ParticleSource, Request, SamplePoints, SupportFrom};
pub(crate) use significant::Significant;
pub use units::Units;
pub(crate) use units::cells;
pub use warning::Warning;

use std::time::Instant;

use crate::output::Table;
use crate::parallel;
use crate::progress::Progress;
use evaluate::{Counts, Evaluated};
use plan::Plan;

/// Seconds that each part took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// Reading and checking files, or making a built-in set.
    pub read: f64,
    /// Sorting the particles into cells.
    pub search: f64,
    /// Summing.
    pub evaluate: f64,
}

/// What a request comes to.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// The points and the fields there.
    pub table: Table,
    /// How many particles there are.
    pub particles: usize,
    /// How many of those of the file they are, where some were chosen.
    pub taken: Option<Taken>,
    /// How many threads worked.
    pub threads: usize,
    /// The units that the sums were made in.
    pub units: Units,
    /// What a person should know.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub timing: Timing,
}

/// Evaluates a request.
///
/// # Errors
/// [`SampleError`] says what is wrong with files or data, or what they do not have that was asked for.
pub fn run(request: &Request, progress: &dyn Progress) -> Result<Sampled, SampleError> {
    memory::refuse_oversize(request)?;
    let start = Instant::now();
    let tables = read::read(request)?;
    let notes = tables.notes();
    let mut checked = check::check(tables, request)?;
    let points = checked.points;
    let plan = Plan::new(request, checked.span, checked.taken.taken, checked.axes, &points)?;
    let read = start.elapsed().as_secs_f64();

    progress.begin(points.len() as u64, 0);
    let scalar = request.scalar;
    let pool = parallel::pool(request.threads, move || scalar.enter()).map_err(SampleError::Threads)?;
    let done = pool.install(|| evaluate::evaluate(&plan, &mut checked.particles, &points, progress))?;
    progress.end();

    let timing = Timing { read, search: done.search_seconds, evaluate: done.evaluate_seconds };
    let mut sampled = sampled(plan, points, done, timing, pool.current_num_threads());
    sampled.warnings.splice(0..0, notes);
    sampled.taken = (!request.only.is_empty()).then_some(checked.taken);
    Ok(sampled)
}

/// The result with its warnings.
fn sampled(
    plan: Plan<'_>,
    points: points::Points,
    done: Evaluated,
    timing: Timing,
    threads: usize,
) -> Sampled {
    let mut warnings = plan.warnings(points.len());
    let points_in_all = points.len();
    let Counts { out_of_reach, not_carried, overflowed } = done.counts;
    let counted = [
        (out_of_reach, Warning::OutOfReach { count: out_of_reach, points: points_in_all }),
        (
            not_carried,
            Warning::NotCarried {
                estimate: plan.request.estimate,
                count: not_carried,
                points: points_in_all,
            },
        ),
        (overflowed, Warning::Overflowed { count: overflowed }),
    ];
    warnings.extend(counted.into_iter().filter(|(count, _)| *count > 0).map(|(_, warning)| warning));
    let (caption, precision) = (plan.caption(), plan.precision);
    let (particles, units) = (plan.particles, plan.units.clone());
    let (coordinates, grid) = points.into_table();
    let table = Table { coordinates, columns: plan.into_columns(done.columns), grid, precision, caption };
    Sampled { table, particles, taken: None, threads, units, warnings, timing }
}

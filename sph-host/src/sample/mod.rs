//! `fluisim sample`: fields of a particle set at points.
//!
//! [`Request`] says what is asked for, in the words of the command line. [`run`] goes the whole way: read and check the
//! particles (`load`), make the points (`points`), evaluate sph-core's sums there in the scalar that was asked for
//! (`evaluate`), and hand back a [`Table`] with what there is to warn of.

mod evaluate;
mod evaluate_fast;
mod load;
mod outline;
mod points;
mod request;
mod scene;
mod slabs;
mod stencil;
mod units;

pub use load::{Particles, Support};
pub use request::{Estimate, ParticleSource, Request, SamplePoints, SupportFrom};

use std::time::Instant;

use crate::failure::Failure;
use crate::output::{Precision, Table};
use crate::progress::Progress;
use crate::scalar_choice::{ScalarName, with_scalar};

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

/// What a run has to show.
#[derive(Clone, Debug)]
pub struct Sampled {
    /// The points and the fields there.
    pub table: Table,
    /// How many particles there are.
    pub particles: usize,
    /// How many threads worked.
    pub threads: usize,
    /// What a person should know: one sentence each.
    pub warnings: Vec<String>,
    /// Where the time went.
    pub timing: Timing,
}

/// More threads than this help nobody and take long to start.
const MOST_THREADS: usize = 256;

/// Does what a request asks for.
///
/// # Errors
/// [`Failure`] with one clear message.
pub fn run(request: &Request, progress: &dyn Progress) -> Result<Sampled, Failure> {
    points::refuse_oversize(request)?;
    let start = Instant::now();
    let mut slabs = slabs(request)?;
    let particles = match &slabs {
        Some(slabs) => slabs.corners()?,
        None => load::particles(request)?,
    };
    let count = slabs.as_ref().map_or(particles.len(), slabs::Slabs::count);
    let points = points::points(request, &particles)?;
    let read = start.elapsed().as_secs_f64();

    progress.begin(points.len() as u64, 0);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(request.threads.map_or(0, |threads| threads.min(MOST_THREADS)))
        .build()
        .map_err(|error| Failure::input(format!("cannot start the threads: {error}")))?;
    let done = pool.install(|| match &mut slabs {
        Some(slabs) => slabs.evaluate(request, &points, progress),
        None => evaluate(request, &particles, &points, progress),
    })?;
    progress.end();

    let precision = if request.scalar == ScalarName::F32 { Precision::F32 } else { Precision::F64 };
    let caption = caption(request, &particles, count);
    let warnings = warnings(&done.counts, points.len());
    let (coordinates, grid) = points.into_table();
    Ok(Sampled {
        table: Table { coordinates, columns: done.columns, grid, precision, caption },
        particles: count,
        threads: pool.current_num_threads(),
        warnings,
        timing: Timing { read, search: done.search_seconds, evaluate: done.evaluate_seconds },
    })
}

/// The sums in the scalar and the dimensions that are asked for, on the fast path where that has them.
fn evaluate(
    request: &Request,
    particles: &Particles,
    points: &points::Points,
    progress: &dyn Progress,
) -> Result<evaluate::Evaluated, Failure> {
    macro_rules! in_dimensions {
        ($($function:ident)::+, $T:ty) => {
            match particles.dim {
                1 => $($function)::+::<$T, 1>(request, particles, points, progress),
                2 => $($function)::+::<$T, 2>(request, particles, points, progress),
                _ => $($function)::+::<$T, 3>(request, particles, points, progress),
            }
        };
    }
    let is_fast = !request.exact && request.estimate != Estimate::Corrected;
    match (is_fast, request.scalar) {
        (true, ScalarName::F32) => in_dimensions!(evaluate_fast::evaluate, f32),
        (true, ScalarName::F64) => in_dimensions!(evaluate_fast::evaluate, f64),
        _ => with_scalar!(request.scalar, T => in_dimensions!(evaluate::evaluate, T)),
    }
}

/// The file's particles in slabs, where it is to be read in pieces.
fn slabs(request: &Request) -> Result<Option<slabs::Slabs>, Failure> {
    match (&request.particles, request.chunk) {
        (ParticleSource::File(path), Some(most)) => slabs::Slabs::read(path, most, request).map(Some),
        _ => Ok(None),
    }
}

fn caption(request: &Request, particles: &Particles, count: usize) -> String {
    let support = match &particles.support {
        Support::Uniform(h) => format!("h = {:.4}", load::Significant(*h)),
        Support::PerParticle(_) => String::from("h of each particle"),
    };
    format!("{}: {count} particles, {}, {support}", particles.source, request.kernel.name())
}

fn warnings(counts: &evaluate::Counts, points: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    if points == 0 {
        warnings.push(String::from("there are no points: the result has a header alone"));
    }
    if counts.out_of_reach > 0 {
        warnings.push(format!("{} of {points} points have no particle in reach", counts.out_of_reach));
    }
    if counts.ill_conditioned > 0 {
        warnings.push(format!(
            "{} of {points} points have too few particles in reach, or all of them in a plane, for the corrected estimate",
            counts.ill_conditioned
        ));
    }
    if counts.overflowed > 0 {
        warnings
            .push(format!("{} values are outside the range of the scalar and left out", counts.overflowed));
    }
    warnings
}

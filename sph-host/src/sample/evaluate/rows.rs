//! Rows of the result, filled in parallel.

use sph_core::Scalar;

use crate::parallel;
use crate::progress::Progress;
use crate::sample::found::AtPoint;
use crate::sample::plan::Plan;

/// The columns of the result, and what was counted on the way.
#[derive(Clone, Debug, Default)]
pub(in crate::sample) struct Evaluated {
    /// Column by column, one value a point; NaN where there is none.
    pub(in crate::sample) columns: Vec<Vec<f64>>,
    pub(in crate::sample) counts: Counts,
    pub(in crate::sample) search_seconds: f64,
    pub(in crate::sample) evaluate_seconds: f64,
}

/// Points, or values, that have nothing to show.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::sample) struct Counts {
    /// Points with no particle in reach.
    pub(in crate::sample) out_of_reach: usize,
    /// Points whose particles do not carry the estimate.
    pub(in crate::sample) not_carried: usize,
    /// Values outside the range of the scalar.
    pub(in crate::sample) overflowed: usize,
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            out_of_reach: self.out_of_reach + other.out_of_reach,
            not_carried: self.not_carried + other.not_carried,
            overflowed: self.overflowed + other.overflowed,
        }
    }
}

/// Points that one thread takes at a time.
const CHUNK: usize = 1024;

/// Fills rows of columns: `found` says what there is at a point; it has memory that one point leaves to the next.
pub(super) fn fill<M: Default, T: Scalar, const D: usize>(
    plan: &Plan<'_>,
    columns: &mut [&mut [f64]],
    points: usize,
    progress: &dyn Progress,
    found: impl Fn(usize, &mut M, &mut AtPoint<T, D>, &mut Counts) + Sync,
) -> Counts {
    let mut chunks: Vec<Vec<&mut [f64]>> = vec![];
    chunks.resize_with(points.div_ceil(CHUNK), || Vec::with_capacity(columns.len()));
    for column in columns {
        chunks.iter_mut().zip(column.chunks_mut(CHUNK)).for_each(|(chunk, part)| chunk.push(part));
    }
    let counts = parallel::map(chunks.into_iter(), |chunk, mut columns| {
        let (mut counts, mut memory, mut at) = (Counts::default(), M::default(), AtPoint::default());
        let first = chunk * CHUNK;
        let rows = CHUNK.min(points - first);
        for row in 0..rows {
            at.density = None;
            at.fields.clear();
            found(first + row, &mut memory, &mut at, &mut counts);
            counts.overflowed += plan.write(&at, row, &mut columns);
        }
        progress.advance(rows as u64);
        counts
    });
    counts.into_iter().fold(Counts::default(), |a, b| a + b)
}

/// Columns without a value.
pub(super) fn empty_columns(plan: &Plan<'_>, points: usize) -> Vec<Vec<f64>> {
    vec![vec![f64::NAN; points]; plan.columns.len()]
}

//! Configurations: how space is divided, where samples and queries lie. Coordinates are drawn where searches go wrong,
//! and are finite: searches refuse the others (`errors.rs`).

use proptest::array::uniform;
use proptest::collection::vec;
use proptest::prelude::*;
use sph_core::scalar::fixed::{Checked, I16F16, I20F12, I32F32, Saturating, Wrapping};
use sph_core::{CellLayout, Domain, Error, Scalar};

use super::oracle::{Period, floor, integer};

/// A scalar with its next numbers and the coordinates that count as far away.
pub(crate) trait Probe: Scalar {
    const FAR: f64;
    fn up(self) -> Self;
    fn down(self) -> Self;
}

macro_rules! probe {
    ($($Number:ty, $far:literal, $up:expr, $down:expr;)*) => {$(
        impl Probe for $Number {
            const FAR: f64 = $far;
            fn up(self) -> Self {
                $up(self)
            }
            fn down(self) -> Self {
                $down(self)
            }
        }
    )*};
}

probe! {
    f32, 1e30, f32::next_up, f32::next_down;
    f64, 1e200, f64::next_up, f64::next_down;
    Saturating<I16F16>, 3e4, |x| x + Self::EPSILON, |x| x - Self::EPSILON;
    Checked<I16F16>, 3e4, |x| x + Self::EPSILON, |x| x - Self::EPSILON;
    Saturating<I20F12>, 5e5, |x| x + Self::EPSILON, |x| x - Self::EPSILON;
    Wrapping<I32F32>, 2e4, |x| x + Self::EPSILON, |x| x - Self::EPSILON;
}

/// A coordinate before its axis is known: a kind of place, where in it, and a step to the next number up or down.
type Spot = (u8, i16, i8);

fn spot() -> impl Strategy<Value = Spot> {
    (0_u8..9, -1200_i16..=1200, -1_i8..=1)
}

/// A configuration in numbers that every scalar can be made from.
#[derive(Clone, Debug)]
pub(crate) struct Sketch<const D: usize> {
    unbounded: bool,
    periodic: [bool; D],
    lower: [usize; D],
    length: [usize; D],
    count: [usize; D],
    cell: usize,
    radius: usize,
    samples: Vec<([Spot; D], bool)>,
    queries: Vec<[Spot; D]>,
}

const LOWER: [f64; 6] = [0.0, -0.5, 0.1, -100.0, 10.0, -0.3];
const LENGTH: [f64; 5] = [1.0, 0.3, 100.5, 0.7, 2.0];
const COUNT: [u32; 7] = [1, 2, 3, 4, 8, 17, 1000];
const CELL: [f64; 4] = [0.1, 0.5, 1.0, 3.0];
const RADIUS: [f64; 8] = [0.05, 0.25, 0.5, 0.7, 1.0, 1.3, 2.7, 6.0];

/// Fewer cells and smaller radii for more axes: the oracle looks at every image.
const fn limits(axes: usize) -> (usize, usize) {
    match axes {
        1 => (COUNT.len(), 8),
        2 => (6, 7),
        3 => (5, 6),
        _ => (4, 4),
    }
}

pub(crate) fn sketch<const D: usize>() -> impl Strategy<Value = Sketch<D>> {
    let (counts, radii) = limits(D);
    let axes = (
        any::<bool>(),
        uniform::<_, D>(any::<bool>()),
        uniform::<_, D>(0..LOWER.len()),
        uniform::<_, D>(0..LENGTH.len()),
        uniform::<_, D>(0..counts),
    );
    let samples = vec((uniform::<_, D>(spot()), prop::bool::weighted(0.1)), 0..24);
    let queries = vec(uniform::<_, D>(spot()), 1..4);
    (axes, 0..CELL.len(), 0..radii, samples, queries).prop_map(|(axes, cell, radius, samples, queries)| {
        let (unbounded, periodic, lower, length, count) = axes;
        Sketch { unbounded, periodic, lower, length, count, cell, radius, samples, queries }
    })
}

/// A configuration in one scalar.
#[derive(Clone, Debug)]
pub(crate) struct Plan<T, const D: usize> {
    pub(crate) unbounded: bool,
    pub(crate) lower: [T; D],
    pub(crate) upper: [T; D],
    pub(crate) counts: [u32; D],
    pub(crate) periods: [Period<T>; D],
    pub(crate) cell_size: T,
    pub(crate) radius: T,
    pub(crate) positions: Vec<[T; D]>,
    pub(crate) queries: Vec<[T; D]>,
}

impl<T: Probe, const D: usize> Plan<T, D> {
    pub(crate) fn new(sketch: &Sketch<D>) -> Self {
        let lower = sketch.lower.map(|i| T::from_f64(LOWER[i]));
        let upper = std::array::from_fn(|axis| lower[axis] + T::from_f64(LENGTH[sketch.length[axis]]));
        let periods = std::array::from_fn(|axis| {
            sketch.periodic[axis].then(|| (lower[axis], upper[axis] - lower[axis]))
        });
        let shortest = sketch.length.iter().map(|&i| LENGTH[i]).fold(f64::MAX, f64::min);
        let radius = T::from_f64(RADIUS[sketch.radius] * shortest);
        let mut plan = Self {
            unbounded: sketch.unbounded,
            lower,
            upper,
            counts: sketch.count.map(|i| COUNT[i]),
            periods,
            cell_size: radius * T::from_f64(CELL[sketch.cell]),
            radius,
            positions: Vec::new(),
            queries: Vec::new(),
        };
        let middle = std::array::from_fn(|axis| lower[axis] + (upper[axis] - lower[axis]) * T::ratio(1, 2));
        let first = plan.place(&sketch.queries[0], &middle);
        plan.queries = sketch.queries.iter().map(|spots| plan.place(spots, &first)).collect();
        plan.queries[0] = first;
        for (spots, again) in &sketch.samples {
            let fresh = plan.inside(plan.place(spots, &first));
            let position = if *again { plan.positions.last().copied().unwrap_or(fresh) } else { fresh };
            plan.positions.push(position);
        }
        plan
    }

    fn place(&self, spots: &[Spot; D], centre: &[T; D]) -> [T; D] {
        std::array::from_fn(|axis| self.coordinate(axis, spots[axis], centre[axis]))
    }

    fn coordinate(&self, axis: usize, (kind, n, nudge): Spot, centre: T) -> T {
        let (lower, length) = (self.lower[axis], self.upper[axis] - self.lower[axis]);
        let count = i64::from(self.counts[axis]);
        let part = T::from_f64(f64::from(n) / 1200.0);
        let place = match kind {
            0 => lower + length * part.abs(),
            1 => lower + length / integer(count) * integer(i64::from(n).rem_euclid(count + 1)),
            2 => self.cell_size * integer(i64::from(n) % 20),
            3 => centre + self.radius * part,
            4 => centre + self.radius,
            5 => centre - self.radius,
            6 => lower + length * part * integer(7),
            7 if self.periods[axis].is_none() => T::from_f64(T::FAR * f64::from(n) / 1200.0),
            _ if n < 0 => lower,
            _ => self.upper[axis],
        };
        let place = match nudge {
            -1 => place.down(),
            1 => place.up(),
            _ => place,
        };
        if place.is_finite() { place } else { lower }
    }

    /// A sample's position, brought into the periods by one of their lengths or else to the lower end.
    fn inside(&self, x: [T; D]) -> [T; D] {
        std::array::from_fn(|axis| {
            let Some((lower, length)) = self.periods[axis] else { return x[axis] };
            let images = [x[axis], x[axis] - length, x[axis] + length];
            images.into_iter().find(|&x| lower <= x && x < lower + length).unwrap_or(lower)
        })
    }

    pub(crate) fn domain(&self) -> Result<Domain<T, D>, Error> {
        (0..D).filter(|&axis| self.periods[axis].is_some()).try_fold(Domain::open(), |domain, axis| {
            domain.periodic(axis, self.lower[axis], self.upper[axis])
        })
    }

    pub(crate) fn layout(&self) -> Result<CellLayout<T, D>, Error> {
        let open = if self.unbounded {
            CellLayout::unbounded(self.cell_size, self.counts)
        } else {
            CellLayout::bounded(&self.lower, &self.upper, self.counts)
        };
        (0..D)
            .filter(|&axis| self.periods[axis].is_some())
            .try_fold(open?, |layout, axis| layout.periodic(axis, self.lower[axis], self.upper[axis]))
    }

    /// Images that the oracle looks at: two more each way than the radius spans.
    pub(crate) fn reach(&self) -> i64 {
        let periods = self.periods.iter().flatten();
        periods.map(|&(_, length)| floor(self.radius / length) as i64 + 2).max().unwrap_or(0)
    }

    /// The number, along an axis, of the cell where a query at x meets image k of a sample: what orders a grid's visits.
    pub(crate) fn cell_number(&self, axis: usize, x: T, sample: T, k: i64) -> i64 {
        let count = i64::from(self.counts[axis]);
        if self.unbounded && self.periods[axis].is_none() {
            let inverse = T::ONE / self.cell_size;
            let first = cell_of(T::ZERO, inverse, x - self.radius);
            return first + (cell_of(T::ZERO, inverse, sample) - first).rem_euclid(count);
        }
        let inverse = (T::ONE / (self.upper[axis] - self.lower[axis])) * integer(count);
        cell_of(self.lower[axis], inverse, sample).clamp(0, count - 1) + k * count
    }
}

/// ⌊(x − origin) / cell size⌋, as far as ±2³⁰.
fn cell_of<T: Scalar>(origin: T, inverse: T, x: T) -> i64 {
    const FARTHEST: f64 = (1 << 30) as f64;
    let number = (x - origin) * inverse;
    let far = if x < origin { -FARTHEST } else { FARTHEST };
    (if number.is_finite() { floor(number) } else { far }).clamp(-FARTHEST, FARTHEST) as i64
}

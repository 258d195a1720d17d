//! The neighbours by definition: each sample, each image, one comparison. Nothing here calls the searches' own code.

use sph_core::{Neighbours, Scalar};

/// One neighbour and the image that it is.
#[derive(Clone, Debug)]
pub(crate) struct Hit<T, const D: usize> {
    pub(crate) index: usize,
    pub(crate) image: [i64; D],
    pub(crate) offset: [T; D],
    pub(crate) distance_squared: T,
}

/// What a visit must reproduce: the index, and the bits of the offset and of the squared distance.
pub(crate) type Record = (usize, Vec<u64>, u64);

/// (lower, length) of a periodic axis, none for an open one.
pub(crate) type Period<T> = Option<(T, T)>;

/// An integer as the scalar.
pub(crate) fn integer<T: Scalar>(n: i64) -> T {
    T::from_f64(n as f64)
}

/// ⌊x⌋ by way of f64, which holds every scalar tested here exactly.
pub(crate) fn floor<T: Scalar>(x: T) -> f64 {
    x.to_f64().floor()
}

/// x moved into the period: x − length ⌊(x − lower) / length⌋, or its next image, or `lower` where both round out of it.
pub(crate) fn wrapped<T: Scalar>(x: T, period: Period<T>) -> T {
    let Some((lower, length)) = period else { return x };
    let inside = |x: T| lower <= x && x < lower + length;
    if inside(x) {
        return x;
    }
    let moved = x - length * T::from_f64(floor((x - lower) / length));
    [moved, moved + length, moved - length].into_iter().find(|&x| inside(x)).unwrap_or(lower)
}

/// The position of image k.
pub(crate) fn image<T: Scalar>(x: T, period: Period<T>, k: i64) -> T {
    match period {
        Some((_, length)) if k != 0 => x + length * integer(k),
        _ => x,
    }
}

/// All images −reach … reach per periodic axis, first axis fastest.
pub(crate) fn images<T, const D: usize>(periods: &[Period<T>; D], reach: i64) -> Vec<[i64; D]> {
    let mut all = vec![[0; D]];
    for (axis, period) in periods.iter().enumerate() {
        if period.is_some() {
            let before = all;
            all = Vec::new();
            for k in -reach..=reach {
                for image in &before {
                    let mut image = *image;
                    image[axis] = k;
                    all.push(image);
                }
            }
        }
    }
    all
}

/// The neighbours of x (inside the periods) in the order j, then image, that `BruteForce` documents.
pub(crate) fn hits<T: Scalar, const D: usize>(
    positions: &[[T; D]],
    periods: &[Period<T>; D],
    x: &[T; D],
    radius: T,
    reach: i64,
) -> Vec<Hit<T, D>> {
    let mut found = Vec::new();
    let images = images(periods, reach);
    for (index, position) in positions.iter().enumerate() {
        for &k in &images {
            let mut offset = [T::ZERO; D];
            let mut distance_squared = T::ZERO;
            for axis in 0..D {
                offset[axis] = x[axis] - image(position[axis], periods[axis], k[axis]);
                distance_squared += offset[axis] * offset[axis];
            }
            if radius > T::ZERO && distance_squared < radius * radius {
                found.push(Hit { index, image: k, offset, distance_squared });
            }
        }
    }
    found
}

/// The bits of a neighbour.
pub(crate) fn record<T: Scalar, const D: usize>(
    index: usize,
    offset: &[T; D],
    distance_squared: T,
) -> Record {
    let bits = |value: T| value.to_f64().to_bits();
    (index, offset.iter().map(|&component| bits(component)).collect(), bits(distance_squared))
}

/// The bits of hits.
pub(crate) fn records<T: Scalar, const D: usize>(hits: &[Hit<T, D>]) -> Vec<Record> {
    hits.iter().map(|hit| record(hit.index, &hit.offset, hit.distance_squared)).collect()
}

/// What a search finds, in its order.
pub(crate) fn found<T: Scalar, const D: usize>(
    search: &impl Neighbours<T, D>,
    x: &[T; D],
    radius: T,
) -> Vec<Record> {
    let mut records = Vec::new();
    search.for_each(x, radius, |neighbour| {
        records.push(record(neighbour.index, &neighbour.offset, neighbour.distance_squared));
    });
    assert_eq!(search.count(x, radius), records.len());
    records
}

/// The same records whatever their order, each as often.
pub(crate) fn sorted(mut records: Vec<Record>) -> Vec<Record> {
    records.sort();
    records
}

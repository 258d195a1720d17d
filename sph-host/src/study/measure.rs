//! The fields at some points in a number type, and how far they are from others.

use sph_core::{BruteForce, Error, Field, Scalar, Sources};

use super::request::Quantity;
use super::set::Patch;
use super::units::Units;
use crate::kernel_choice::{AnyInfluence, Influences, KernelName};

/// What was found at the points of a patch, in its units.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Measured {
    /// The numbers of each [`Quantity`], point by point: one a point, one a field, one a field and axis.
    numbers: [Vec<f64>; 3],
    /// How many numbers of a quantity belong together as one vector.
    lengths: [usize; 3],
}

/// The name of a place for people: the lines of this file are where the particles' numbers become numbers of the format.
pub(super) fn name_of(place: &sph_lab::Place) -> String {
    if file!().ends_with(place.file()) {
        String::from("the particles' own numbers")
    } else {
        place.to_string()
    }
}

/// Why a format holds no sums of these particles.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Refusal {
    /// A number of the particles is beyond its range.
    OutOfRange { what: &'static str, value: f64 },
    /// sph-core refuses.
    Sums(Error),
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::OutOfRange { what, value } => write!(f, "{what} of {value:.4} is out of range"),
            Self::Sums(error) => error.fmt(f),
        }
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::Sums(error)
    }
}

/// Numbers in T, none of which left its range.
fn fitted<T: Scalar>(
    values: impl Iterator<Item = f64>,
    unit: f64,
    what: &'static str,
) -> Result<Vec<T>, Refusal> {
    let fitted = |value: f64| {
        let number = T::from_f64(value / unit);
        if number.is_finite() { Ok(number) } else { Err(Refusal::OutOfRange { what, value: value / unit }) }
    };
    values.map(fitted).collect()
}

/// The particles of a patch in T.
pub(super) struct Converted<T, const D: usize> {
    positions: Vec<[T; D]>,
    masses: Vec<T>,
    volumes: Vec<T>,
    values: Vec<Vec<T>>,
    influences: Vec<AnyInfluence<T, D>>,
}

impl<T: Scalar, const D: usize> Converted<T, D> {
    /// Converts the particles of a patch.
    pub(super) fn new(patch: &Patch<D>, kernel: KernelName, units: &Units<D>) -> Result<Self, Refusal> {
        let set = &patch.set;
        let mut positions = Vec::with_capacity(set.positions.len());
        for x in &set.positions {
            let offsets = (0..D).map(|axis| x[axis] - units.origin[axis]);
            let numbers = fitted(offsets, units.length, "a coordinate")?;
            positions.push(std::array::from_fn(|axis| numbers[axis]));
        }
        let copied = |values: &[f64], unit, what| fitted(values.iter().copied(), unit, what);
        let values = set.fields.iter().zip(&units.values);
        let values = values.map(|((_, values), unit)| copied(values, *unit, "a value"));
        let radii: Vec<T> = copied(&set.supports, units.length, "the support radius")?;
        let influences = radii.into_iter().map(|h| AnyInfluence::new(kernel, h));
        Ok(Self {
            positions,
            masses: copied(&set.masses, units.mass, "a mass")?,
            volumes: copied(&set.volumes, units.length.powi(D as i32), "a volume")?,
            values: values.collect::<Result<_, _>>()?,
            influences: influences.collect::<Result<_, _>>()?,
        })
    }

    /// The sums at every point, each handed on as it is found: the quantity, the number of the field, and the sum.
    pub(super) fn sums(
        &self,
        patch: &Patch<D>,
        mut found: impl FnMut(Quantity, usize, T),
    ) -> Result<(), Refusal> {
        fn pick<V: Copy>(all: &[V], near: &[usize]) -> Vec<V> {
            near.iter().map(|&j| all[j]).collect()
        }
        for (&i, near) in patch.points.iter().zip(&patch.near) {
            let x = &self.positions[i];
            let positions = pick(&self.positions, near);
            let own: Vec<AnyInfluence<T, D>>;
            let w = match &self.influences[..] {
                [one] => Influences::uniform(one),
                each => {
                    own = pick(each, near);
                    Influences::per_sample(&own)
                }
            };
            let masses = pick(&self.masses, near);
            let search = BruteForce::open(&positions)?;
            found(Quantity::Density, 0, Sources::assume_checked(search, &masses[..]).density_at(w, x));
            let volumes = pick(&self.volumes, near);
            let sources = Sources::assume_checked(search, &volumes[..]);
            for (number, values) in self.values.iter().enumerate() {
                let values = pick(values, near);
                let field = Field::new(&sources, &values[..])?;
                found(Quantity::Interpolation, number, field.interpolate_at(w, x));
                for component in field.gradient_at(w, x) {
                    found(Quantity::Gradient, number, component);
                }
            }
        }
        Ok(())
    }
}

/// The fields at the points of a patch, summed in T, each field in terms of its largest value; a number that left the range is
/// infinite.
pub(super) fn measure<T: Scalar, const D: usize>(
    patch: &Patch<D>,
    kernel: KernelName,
    units: &Units<D>,
) -> Result<Measured, Refusal> {
    let mut measured = Measured { lengths: [1, 1, D], ..Measured::default() };
    Converted::<T, D>::new(patch, kernel, units)?.sums(patch, |quantity, field, sum| {
        let number = if sum.is_finite() { sum.to_f64() } else { f64::INFINITY };
        let share = if quantity == Quantity::Density { 1.0 } else { units.shares[field] };
        measured.numbers[quantity.index()].push(number * share);
    })?;
    Ok(measured)
}

/// How far numbers are from what they should be, relative to the largest of these.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The largest.
    pub largest: f64,
    /// The root of the mean square.
    pub rms: f64,
    /// The mean, with its sign.
    pub bias: f64,
}

impl Measured {
    /// The vectors of a quantity.
    fn vectors(&self, quantity: Quantity) -> impl Iterator<Item = &[f64]> {
        let index = quantity.index();
        self.numbers[index].chunks(self.lengths[index].max(1))
    }

    /// The largest length of a vector of a quantity.
    pub(super) fn largest(&self, quantity: Quantity) -> f64 {
        self.vectors(quantity).map(length).fold(0.0, f64::max)
    }

    /// Appends what was found elsewhere.
    pub(super) fn append(&mut self, more: &mut Self) {
        self.lengths = more.lengths;
        self.numbers.iter_mut().zip(&mut more.numbers).for_each(|(all, more)| all.append(more));
    }

    /// How far these numbers are from the truth, relative to `scale`.
    pub(super) fn deviation(&self, truth: &Self, quantity: Quantity, scale: f64) -> Deviation {
        self.deviation_from(truth, 0, quantity, scale, |_| true)
    }

    /// The same for some of the points, by their number, where the truth has `first` points before these.
    pub(super) fn deviation_from(
        &self,
        truth: &Self,
        first: usize,
        quantity: Quantity,
        scale: f64,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Deviation {
        // densities have one number a point, others one or more for each field
        let each = (self.numbers[quantity.index()].len() / self.lengths[quantity.index()].max(1))
            .checked_div(self.numbers[0].len())
            .unwrap_or(1)
            .max(1);
        let (mut largest, mut squares, mut sum, mut count) = (0.0_f64, 0.0, 0.0, 0.0);
        let pairs = self.vectors(quantity).zip(truth.vectors(quantity).skip(first * each)).enumerate();
        for (_, (own, truth)) in pairs.filter(|(number, _)| is_wanted(number / each)) {
            let difference: Vec<f64> = own.iter().zip(truth).map(|(a, b)| a - b).collect();
            let distance = length(&difference);
            largest = if distance.is_nan() { f64::INFINITY } else { largest.max(distance) };
            squares += distance * distance;
            sum += difference.iter().sum::<f64>() / difference.len() as f64;
            count += 1.0;
        }
        let count = f64::max(count, 1.0);
        Deviation {
            largest: largest / scale,
            rms: (squares / count).sqrt() / scale,
            bias: sum / count / scale,
        }
    }
}

fn length(vector: &[f64]) -> f64 {
    if let [one] = vector { one.abs() } else { vector.iter().map(|x| x * x).sum::<f64>().sqrt() }
}

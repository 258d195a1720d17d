//! The arrays of a set of particles in HDF5, with the budget of the file.

use super::budget::{Budget, refuse_wide};
use super::hdf5::words;
use super::hdf5_plain::Plain;
use super::hdf5_units::attribute_numbers;
use super::npz::{is_single, unfit};
use crate::io::error::{Parsed, Problem, counted, shown};
use crate::io::numbers::{self, Endian};
use crate::io::table::{Array, Unusable};
use hdf5_pure::{AttrValue, Dataset, Datatype, DatatypeByteOrder, Error, Group, Layout};
use std::collections::HashMap;
use std::fs::File;

/// A dataset of a set, its numbers not yet read.
pub(super) struct Stored {
    pub name: String,
    pub shape: Vec<usize>,
    /// None where they are damaged.
    pub attributes: Option<HashMap<String, AttrValue>>,
    dataset: Dataset,
    /// Where its numbers are, if they stand in the file as they are.
    plain: Option<Plain>,
}

impl Stored {
    /// Whether the dataset is called so, in any case of letters.
    pub(super) fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }

    /// A number of the dataset's attributes.
    pub(super) fn attribute(&self, name: &str) -> Option<f64> {
        let value = self.attributes.as_ref()?.get(name)?;
        attribute_numbers(value)?.first().copied()
    }

    /// Whether PySPH has written the array, and not its name alone.
    fn is_written(&self) -> bool {
        !(self.shape == [0] && self.attribute("stored") == Some(0.0))
    }
}

/// The datasets of a group that are written.
pub(super) fn open_arrays(group: &Group) -> Parsed<Vec<Stored>> {
    let whole = |error: Error| {
        Problem::new(format!("damaged, cut short, or with links, which are not read: {}", words(&error)))
    };
    let mut arrays = Vec::new();
    for (name, dataset) in group.iter_datasets().map_err(whole)? {
        let lengths = dataset.shape().map_err(|error| {
            Problem::at(format!("dataset `{name}`"), format!("damaged or cut short: {}", words(&error)))
        })?;
        let shape = lengths.iter().map(|&length| usize::try_from(length).unwrap_or(usize::MAX)).collect();
        let attributes = dataset.attrs().ok();
        let plain = Plain::of(&dataset);
        arrays.push(Stored { name, shape, attributes, dataset, plain });
    }
    arrays.retain(Stored::is_written);
    Ok(arrays)
}

/// The array of a dataset at `points` points, with a fault if it has not one row for each.
pub(super) fn array(stored: &Stored, points: usize, file: &mut File, budget: &Budget) -> Array {
    let Stored { name, shape, .. } = stored;
    let values = match components(stored, points) {
        Ok(components) => numbers(stored, file, budget).map(|values| (components, values)),
        Err(_) if is_single(name, shape, points) => {
            all_of(stored, points, file, budget).map(|values| (1, values))
        }
        Err(unusable) => Err(unusable),
    };
    match values {
        Ok((components, values)) => Array::new(name, components, values),
        Err(unusable) => Array::unusable(name, unusable),
    }
}

/// How many numbers a point has in a dataset.
fn components(stored: &Stored, points: usize) -> Result<usize, Unusable> {
    let Stored { shape, .. } = stored;
    let wrong = || Unusable::other(unfit(shape, points));
    let (&rows, rest) = shape.split_first().ok_or_else(wrong)?;
    let components = match stored.attribute("stride") {
        // PySPH writes vectors as one row of numbers, and how many belong to a point.
        Some(stride) if stride > 1.0 && rest.is_empty() && rows.is_multiple_of(stride as usize) => {
            stride as usize
        }
        _ => rest.iter().try_fold(1_usize, |all, &length| all.checked_mul(length)).unwrap_or(0),
    };
    let is_one_row_each =
        if rest.is_empty() { points.checked_mul(components) == Some(rows) } else { rows == points };
    if components == 0 || !is_one_row_each {
        return Err(wrong());
    }
    refuse_wide(components).map_err(Unusable::numbers)?;
    Ok(components)
}

/// The single number of a dataset for every point.
fn all_of(stored: &Stored, points: usize, file: &mut File, budget: &Budget) -> Result<Vec<f64>, Unusable> {
    let value = numbers(stored, file, budget)?[0];
    let mut all = budget.numbers(points).map_err(Unusable::numbers)?;
    all.resize(points, value);
    Ok(all)
}

/// The vectors of a dataset at `points` points, component by component, if they stand in the file as they are.
pub(super) fn plain_components(
    stored: &Stored,
    points: usize,
    file: &mut File,
    budget: &Budget,
) -> Result<Option<Vec<Vec<f64>>>, Unusable> {
    let Some(plain) = stored.plain else { return Ok(None) };
    let components = components(stored, points)?;
    check_storage(stored, points.saturating_mul(components), budget)?;
    plain.components(file, points, components, budget).map(Some).map_err(Unusable::numbers)
}

/// The numbers of a dataset, in the order of its shape.
fn numbers(stored: &Stored, file: &mut File, budget: &Budget) -> Result<Vec<f64>, Unusable> {
    let Stored { shape, dataset, .. } = stored;
    let kind = dataset.datatype().map_err(damaged)?;
    if !is_numeric(&kind) {
        let kind = shown(dataset.dtype().map_err(damaged)?.to_string().as_bytes());
        return Err(Unusable::other(format!("values of type {kind} where numbers are expected")));
    }
    let count = shape.iter().try_fold(1_usize, |all, &length| all.checked_mul(length));
    let count = count.ok_or_else(|| Unusable::numbers(format!("the shape {shape:?} cannot be")))?;
    check_storage(stored, count, budget)?;
    if let Some(plain) = stored.plain {
        return plain.numbers(file, count, budget).map_err(Unusable::numbers);
    }
    budget.grow(count).map_err(Unusable::numbers)?;
    let values = if is_half(&kind) { half(dataset, &kind, count) } else { dataset.read_f64() };
    let values = values.map_err(damaged)?;
    if values.len() != count {
        let found = counted(values.len(), "number");
        return Err(Unusable::numbers(format!("{found} for the shape {shape:?}")));
    }
    Ok(values)
}

/// Whether numbers of this type are those of two bytes of IEEE 754, which `read_f64` passes over.
fn is_half(kind: &Datatype) -> bool {
    matches!(kind, Datatype::FloatingPoint { size: 2, layout, .. }
        if (layout.exponent_size, layout.mantissa_size, layout.exponent_bias) == (5, 10, 15))
}

/// The `count` numbers of two bytes each.
fn half(dataset: &Dataset, kind: &Datatype, count: usize) -> Result<Vec<f64>, Error> {
    let endian = match kind {
        Datatype::FloatingPoint { byte_order: DatatypeByteOrder::BigEndian, .. } => Endian::Big,
        _ => Endian::Little,
    };
    let mut values = Vec::new();
    numbers::Stored::F16.decode(&dataset.read_raw()?, endian, count, &mut values);
    Ok(values)
}

/// That the file can hold the `count` numbers that a dataset claims, and that they were written.
fn check_storage(stored: &Stored, count: usize, budget: &Budget) -> Result<(), Unusable> {
    let size = stored.dataset.element_size().map_err(damaged)?;
    budget.unpack(clamped(size.saturating_mul(count as u64))).map_err(Unusable::numbers)?;
    match stored.dataset.layout().map_err(damaged)? {
        Layout::Compact { .. } => Ok(()),
        Layout::Contiguous { address: Some(_), size } => budget.store(size).map_err(Unusable::numbers),
        Layout::Contiguous { address: None, .. } if count > 0 => Err(unwritten()),
        Layout::Contiguous { .. } => Ok(()),
        Layout::Chunked { chunk_shape, .. } => check_chunks(stored, &chunk_shape, size, budget),
        _ => Err(Unusable::numbers("its numbers are those of other files, which are not read")),
    }
}

/// That all chunks of a dataset are there, and each of them can be in the file before room is made for it.
fn check_chunks(stored: &Stored, chunk: &[u64], size: u64, budget: &Budget) -> Result<(), Unusable> {
    let bytes = chunk.iter().fold(size, |all, &length| all.saturating_mul(length));
    let chunks = stored.dataset.chunks().map_err(damaged)?;
    for chunk in &chunks {
        budget.unpack(clamped(bytes)).map_err(Unusable::numbers)?;
        budget.store(chunk.storage_size).map_err(Unusable::numbers)?;
    }
    let along =
        stored.shape.iter().zip(chunk).map(|(&length, &chunk)| (length as u64).div_ceil(chunk.max(1)));
    let wanted = along.fold(1_u64, u64::saturating_mul);
    match chunks.len() as u64 {
        0 if wanted > 0 => Err(unwritten()),
        found if found < wanted => Err(Unusable::numbers(format!(
            "{found} of its {wanted} chunks are there: the rest was never written"
        ))),
        _ => Ok(()),
    }
}

/// An array that has a name and a shape alone.
fn unwritten() -> Unusable {
    Unusable::other("its numbers were never written")
}

fn damaged(error: Error) -> Unusable {
    Unusable::numbers(format!("damaged, cut short or of a kind that is not read: {}", words(&error)))
}

fn clamped(bytes: u64) -> usize {
    usize::try_from(bytes).unwrap_or(usize::MAX)
}

/// Whether a dataset of this type holds real numbers; a yes or no is 1 or 0.
fn is_numeric(kind: &Datatype) -> bool {
    match kind {
        Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. } => true,
        Datatype::Enumeration { base_type, .. } => matches!(**base_type, Datatype::FixedPoint { .. }),
        _ => false,
    }
}

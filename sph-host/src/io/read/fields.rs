//! Records of one length, one after the other, with fields at fixed places in each.

use super::budget::Budget;
use crate::io::numbers::{Endian, Stored};
use crate::io::table::Unusable;

/// One field of each record.
#[derive(Debug, Clone)]
pub(super) struct Field {
    pub name: String,
    /// Where it starts, in bytes from the start of the record.
    pub offset: usize,
    /// How many numbers it has.
    pub components: usize,
    /// How its numbers are stored, or why they cannot be used.
    pub form: Result<(Stored, Endian), Unusable>,
}

/// Bytes that are taken apart together, so that the records are fetched from memory once and not once a field.
const BLOCK: usize = 1 << 15;

/// The numbers of each field in `records`, which are of `length` bytes each.
pub(super) fn columns(
    records: &[u8],
    length: usize,
    fields: &[Field],
    budget: &Budget,
) -> Vec<Result<Vec<f64>, Unusable>> {
    let count = records.len() / length.max(1);
    let room = |field: &Field| {
        field.form.clone()?;
        budget.numbers(count.saturating_mul(field.components)).map_err(Unusable::numbers)
    };
    let mut columns: Vec<_> = fields.iter().map(room).collect();
    let rows = (BLOCK / length.max(1)).max(1);
    for block in records.chunks(rows.saturating_mul(length.max(1))) {
        for (field, column) in fields.iter().zip(&mut columns) {
            if let (Ok((stored, endian)), Ok(column)) = (&field.form, column) {
                stored.gather(block, (length, field.offset), *endian, field.components, column);
            }
        }
    }
    columns
}

//! Numbers that HDF5 stores in one piece, as they are: read straight into where they are wanted, a block at a time.

use super::budget::Budget;
use crate::io::numbers::{Endian, Stored};
use hdf5_pure::{Dataset, Datatype, DatatypeByteOrder, FixedPointLayout, FloatingPointLayout, Layout};
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

/// Bytes that are read at a time: they are still in the cache of a core when they are decoded.
const BLOCK: usize = 1 << 18;

/// Where the numbers of a dataset are in the file, and of which type.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plain {
    address: u64,
    size: u64,
    number: Stored,
    endian: Endian,
}

impl Plain {
    /// None where the numbers are in chunks, or of a type that only the reader of HDF5 knows.
    pub(super) fn of(dataset: &Dataset) -> Option<Self> {
        let Layout::Contiguous { address: Some(address), size } = dataset.layout().ok()? else { return None };
        let (number, order) = match dataset.datatype().ok()? {
            Datatype::FixedPoint { size, byte_order, layout } => (integer(size, layout)?, byte_order),
            Datatype::FloatingPoint { size, byte_order, layout } => (float(size, layout)?, byte_order),
            _ => return None,
        };
        let endian = match order {
            DatatypeByteOrder::LittleEndian => Endian::Little,
            DatatypeByteOrder::BigEndian => Endian::Big,
            DatatypeByteOrder::Vax => return None,
        };
        Some(Self { address, size, number, endian })
    }

    /// The first `count` numbers.
    pub(super) fn numbers(self, file: &mut File, count: usize, budget: &Budget) -> Result<Vec<f64>, String> {
        let mut numbers = budget.numbers(count)?;
        let decode = |bytes: &[u8]| self.number.decode(bytes, self.endian, usize::MAX, &mut numbers);
        self.each_block(file, count, 1, decode)?;
        Ok(numbers)
    }

    /// The numbers of `points` vectors, component by component.
    pub(super) fn components(
        self,
        file: &mut File,
        points: usize,
        components: usize,
        budget: &Budget,
    ) -> Result<Vec<Vec<f64>>, String> {
        let mut columns = (0..components).map(|_| budget.numbers(points)).collect::<Result<Vec<_>, _>>()?;
        let size = self.number.bytes(1).unwrap_or(1);
        self.each_block(file, points, components, |bytes| {
            for (component, column) in columns.iter_mut().enumerate() {
                self.number.gather(bytes, (components * size, component * size), self.endian, 1, column);
            }
        })?;
        Ok(columns)
    }

    /// Calls `take` with the bytes of some rows of so many numbers, until all `rows` were there.
    fn each_block(
        self,
        file: &mut File,
        rows: usize,
        width: usize,
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), String> {
        let row = self.number.bytes(width).filter(|&row| row > 0).ok_or("rows of no size")?;
        let needed = row.checked_mul(rows).filter(|&needed| needed as u64 <= self.size);
        let mut left = needed.ok_or_else(|| format!("{} bytes for {rows} rows of {row} each", self.size))?;
        file.seek(SeekFrom::Start(self.address)).map_err(unreadable)?;
        let mut block = vec![0; (BLOCK / row).max(1) * row];
        while left > 0 {
            let bytes = block.len().min(left);
            file.read_exact(&mut block[..bytes]).map_err(unreadable)?;
            take(&block[..bytes]);
            left -= bytes;
        }
        Ok(())
    }
}

fn unreadable(error: std::io::Error) -> String {
    format!("damaged or cut short: {error}")
}

/// An integer that fills its bytes.
fn integer(size: u32, layout: FixedPointLayout) -> Option<Stored> {
    let FixedPointLayout { signed, bit_offset, bit_precision } = layout;
    if bit_offset != 0 || u32::from(bit_precision) != 8 * size {
        return None;
    }
    Some(match (size, signed) {
        (1, true) => Stored::I8,
        (1, false) => Stored::U8,
        (2, true) => Stored::I16,
        (2, false) => Stored::U16,
        (4, true) => Stored::I32,
        (4, false) => Stored::U32,
        (8, true) => Stored::I64,
        (8, false) => Stored::U64,
        _ => return None,
    })
}

/// A number of IEEE 754.
fn float(size: u32, layout: FloatingPointLayout) -> Option<Stored> {
    match (size, layout) {
        (4, FloatingPointLayout::IEEE754_BINARY32) => Some(Stored::F32),
        (8, FloatingPointLayout::IEEE754_BINARY64) => Some(Stored::F64),
        _ => None,
    }
}

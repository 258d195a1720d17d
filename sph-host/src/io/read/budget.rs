//! What one file may cost: everything that a reader makes of claims in a file is asked for here first.
//!
//! | what | most | why |
//! |---|---|---|
//! | bytes unpacked, of all arrays together | [`MOST_PACKED`] times the file | Deflate packs no more, and a byte of a file is one array's |
//! | base64 decoded, of all arrays together | [`MOST_DECODED`] times the file | arrays may share bytes, but not by the thousand |
//! | one chunk of HDF5, as it is stored | the file | it is there |
//! | bytes of HDF5 read | 16 times the file, and 16 MiB | indexes may lead to one place by many ways |
//! | numbers kept, as `f64` | the memory that is available | beyond it the system would end the process |
//! | arrays of one piece | [`MOST_ARRAYS`] | each is compared with the others of its name |
//! | numbers a point of one array | [`MOST_COMPONENTS`] | each has a name, also where there are no points |
//! | dimensions of one array | [`MOST_DIMENSIONS`] | NumPy makes no more |
//! | header of one array of NumPy, bytes | [`MOST_HEADER`] | NumPy itself reads 10 000 |

use crate::memory;
use std::cell::{Cell, OnceCell};

/// Deflate packs at most so many bytes into one.
pub(in crate::io) const MOST_PACKED: u64 = 1032;

/// How often the bytes of a file may be decoded from base64.
const MOST_DECODED: u64 = 64;

/// Arrays in one archive, or in one piece of a file in pieces.
pub(super) const MOST_ARRAYS: usize = 4096;

/// Numbers that a point has in one array.
pub(crate) const MOST_COMPONENTS: usize = 4096;

/// Dimensions of one array of NumPy.
pub(super) const MOST_DIMENSIONS: usize = 64;

/// Bytes in the header of one array of NumPy.
pub(super) const MOST_HEADER: u64 = 1 << 16;

/// Below so many bytes the system is not asked how much memory there is.
const SMALL: u64 = 1 << 26;

/// What is left to spend on one file. Every refusal says what was asked for and what there is.
pub(super) struct Budget {
    file: u64,
    unpacked: Cell<u64>,
    decoded: Cell<u64>,
    kept: Cell<u64>,
    available: OnceCell<u64>,
}

impl Budget {
    /// The budget of a file of so many bytes.
    pub(super) fn of_file(bytes: u64) -> Self {
        Self {
            file: bytes,
            unpacked: Cell::new(bytes.saturating_mul(MOST_PACKED)),
            decoded: Cell::new(bytes.saturating_mul(MOST_DECODED)),
            kept: Cell::new(0),
            available: OnceCell::new(),
        }
    }

    /// Takes `bytes` that come out of packed ones.
    ///
    /// # Errors
    /// More than the file can hold.
    pub(super) fn unpack(&self, bytes: usize) -> Result<(), String> {
        spend(&self.unpacked, bytes, "unpacked")
    }

    /// That the file can hold one thing of `bytes`.
    ///
    /// # Errors
    /// The file is smaller.
    pub(super) fn store(&self, bytes: u64) -> Result<(), String> {
        if bytes <= self.file {
            return Ok(());
        }
        Err(format!("{bytes} bytes are to be read in one place, but the file has {}", self.file))
    }

    /// Takes `bytes` of base64.
    ///
    /// # Errors
    /// The bytes of the file are decoded too often.
    pub(super) fn decode(&self, bytes: usize) -> Result<(), String> {
        spend(&self.decoded, bytes, "decoded from base64")
    }

    /// Room for `count` numbers that are kept.
    ///
    /// # Errors
    /// More than fits in memory, together with what was kept before.
    pub(super) fn numbers(&self, count: usize) -> Result<Vec<f64>, String> {
        self.grow(count)?;
        let mut numbers = Vec::new();
        numbers.try_reserve_exact(count).map_err(|_| no_memory(count))?;
        Ok(numbers)
    }

    /// Room for one number more at the end of `numbers`, of which there is twice as much each time that it is full.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    #[inline]
    pub(super) fn push(&self, numbers: &mut Vec<f64>) -> Result<(), String> {
        if numbers.len() < numbers.capacity() { Ok(()) } else { self.double(numbers) }
    }

    #[cold]
    fn double(&self, numbers: &mut Vec<f64>) -> Result<(), String> {
        let more = numbers.len().max(64);
        self.grow(more)?;
        numbers.try_reserve_exact(more).map_err(|_| no_memory(numbers.len() + more))
    }

    /// Takes room for `count` numbers more that are kept.
    ///
    /// # Errors
    /// As [`numbers`](Self::numbers).
    pub(super) fn grow(&self, count: usize) -> Result<(), String> {
        let bytes = (count as u64).saturating_mul(8);
        let kept = self.kept.get().saturating_add(bytes);
        if kept > SMALL && kept > *self.available.get_or_init(|| memory::available().unwrap_or(u64::MAX)) {
            return Err(no_memory((kept / 8) as usize));
        }
        self.kept.set(kept);
        Ok(())
    }
}

/// Refuses an array of more than [`MOST_COMPONENTS`] numbers a point.
pub(crate) fn refuse_wide(components: usize) -> Result<(), String> {
    if components <= MOST_COMPONENTS {
        return Ok(());
    }
    Err(format!("{components} numbers a point, where at most {MOST_COMPONENTS} are read"))
}

/// Refuses more than [`MOST_ARRAYS`].
pub(super) fn refuse_many(arrays: usize) -> Result<(), String> {
    if arrays <= MOST_ARRAYS {
        return Ok(());
    }
    Err(format!("{arrays} arrays or more, where at most {MOST_ARRAYS} are read"))
}

fn spend(left: &Cell<u64>, bytes: usize, how: &str) -> Result<(), String> {
    match left.get().checked_sub(bytes as u64) {
        Some(rest) => {
            left.set(rest);
            Ok(())
        }
        None => Err(format!(
            "{bytes} bytes are to be {how}, but of what a file of this size can hold {} are left",
            left.get()
        )),
    }
}

fn no_memory(numbers: usize) -> String {
    let megabytes = numbers as f64 * 8e-6;
    format!("{numbers} numbers take {megabytes:.0} MB, more than there is memory for")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_spent_is_gone() {
        let budget = Budget::of_file(1);
        assert!(budget.unpack(1000).is_ok());
        let refused = budget.unpack(33).unwrap_err();
        assert!(refused.contains("33 bytes") && refused.contains("32 are left"), "{refused}");
        assert!(budget.unpack(32).is_ok());
        assert!(budget.decode(64).is_ok() && budget.decode(1).is_err());
    }

    #[test]
    fn what_no_memory_holds_is_refused_before_it_is_allocated() {
        let budget = Budget::of_file(1 << 40);
        assert!(budget.numbers(1 << 55).unwrap_err().contains("MB"));
        assert!(budget.numbers(usize::MAX).is_err());
        assert_eq!(budget.numbers(10).unwrap().capacity(), 10);
    }
}

//! A bounded list of neighbours, on [`heapless::Vec`].

use super::Index;
use crate::{Error, Parameter};

/// Up to CAP indices, stored inline as I; what does not fit is an error that carries the number needed, never silence.
///
/// ```
/// use sph_core::{BruteForce, Error, NeighbourList, Neighbours, Parameter};
/// let positions = [[0.0_f32], [0.1], [0.2]];
/// let search = BruteForce::new(&positions)?;
/// let list: NeighbourList<4, u8> = search.list(&[0.0], 0.15)?;
/// assert_eq!(list.as_slice(), [0, 1]);
///
/// let full = search.list::<2, u8>(&[0.0], 1.0).unwrap_err();
/// assert_eq!(full, Error::CapacityExceeded { parameter: Parameter::Neighbours, capacity: 2, needed: 3 });
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NeighbourList<const CAP: usize, I: Index = u16> {
    indices: heapless::Vec<I, CAP>,
}

impl<const CAP: usize, I: Index> NeighbourList<CAP, I> {
    /// The bytes of RAM that it takes.
    pub const BYTES: usize = size_of::<Self>();

    /// The empty list.
    pub const fn new() -> Self {
        Self { indices: heapless::Vec::new() }
    }

    /// The indices in the order they were found.
    pub fn as_slice(&self) -> &[I] {
        &self.indices
    }

    /// The indices as usize.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.indices.iter().map(|index| index.to_usize())
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    pub(super) fn push_if_room(&mut self, index: usize) {
        self.indices.push(I::from_usize(index)).ok();
    }

    /// The list, if the `needed` entries have room in it and the `largest` index in I.
    pub(super) fn complete(self, needed: usize, largest: usize) -> Result<Self, Error> {
        let full = |parameter, capacity, needed| Err(Error::CapacityExceeded { parameter, capacity, needed });
        if needed > CAP {
            return full(Parameter::Neighbours, CAP, needed);
        }
        if largest > I::MAX {
            return full(Parameter::Position, I::MAX.saturating_add(1), largest.saturating_add(1));
        }
        Ok(self)
    }
}

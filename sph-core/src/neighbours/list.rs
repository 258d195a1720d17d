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
    dropped: bool,
}

impl<const CAP: usize, I: Index> NeighbourList<CAP, I> {
    /// The empty list.
    pub const fn new() -> Self {
        Self { indices: heapless::Vec::new(), dropped: false }
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
        self.dropped |= index > I::MAX || self.indices.push(I::from_usize(index)).is_err();
    }

    /// The list, if nothing was dropped on the way to the `needed` entries.
    pub(super) fn complete(self, needed: usize) -> Result<Self, Error> {
        if self.dropped {
            let capacity = CAP.min(I::MAX);
            return Err(Error::CapacityExceeded { parameter: Parameter::Neighbours, capacity, needed });
        }
        Ok(self)
    }
}

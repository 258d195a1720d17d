//! The arrays of pieces, one after the other.

use crate::io::error::counted;
use crate::io::table::{Array, Unusable};

/// The arrays of the pieces so far, each with a fault where a piece has not the same.
#[derive(Default)]
pub(super) struct Joined {
    pub arrays: Vec<Array>,
    /// Points of the pieces so far.
    points: usize,
    /// The first piece that has points.
    filled: Option<usize>,
}

impl Joined {
    /// Points of the pieces so far.
    pub(super) fn points(&self) -> usize {
        self.points
    }

    /// Appends the arrays of piece `index`, which has so many points. Pieces without points declare what they would have:
    /// they count where all are so.
    pub(super) fn add(&mut self, index: usize, points: usize, arrays: impl IntoIterator<Item = Array>) {
        match (points, self.filled) {
            (0, Some(_)) => return,
            (1.., None) => {
                self.filled = Some(index);
                self.arrays.clear();
            }
            _ => {}
        }
        let known = self.arrays.len();
        let mut is_there = vec![false; known];
        for read in arrays {
            let same = (0..known).find(|&at| !is_there[at] && self.arrays[at].name == read.name);
            match same {
                Some(at) => {
                    is_there[at] = true;
                    append(&mut self.arrays[at], read, index);
                }
                // Two of one name in a piece are found when the table is assembled.
                None if self.points == 0 => self.arrays.push(read),
                None => self.arrays.push(missing(&read.name, self.filled.unwrap_or(0))),
            }
        }
        let absent =
            self.arrays.iter_mut().zip(&is_there).filter(|(array, there)| !**there && array.fault.is_none());
        for (array, _) in absent {
            *array = missing(&array.name, index);
        }
        self.points += points;
    }
}

/// Appends to `array` what piece `index` has of it.
fn append(array: &mut Array, read: Array, index: usize) {
    if array.fault.is_some() {
        return;
    }
    if read.fault.is_none() && read.components != array.components {
        let (found, before) = (read.components, array.components);
        let problem = format!(
            "piece {index} has {} a point, where the pieces before have {before}",
            counted(found, "number")
        );
        *array = Array::unusable(read.name, Unusable::numbers(problem));
    } else if read.fault.is_some() {
        *array = read;
    } else {
        array.extend(read.values);
    }
}

/// The array `name`, which the piece with this number has not.
fn missing(name: &str, piece: usize) -> Array {
    Array::unusable(name, Unusable::numbers(format!("piece {piece} has no such array")))
}

//! The units and the origin in which the formats see a set.

use super::set::Set;

/// Support radii to try, in the unit of length: a larger one leaves more bits to a distance, and takes them from the range.
pub(super) const SUPPORTS: [f64; 7] = [1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0];

/// Units as multiples of the file's, and the origin in the file's.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Units<const D: usize> {
    /// Subtracted from coordinates.
    pub(super) origin: [f64; D],
    /// The unit of length.
    pub(super) length: f64,
    /// The unit of mass.
    pub(super) mass: f64,
    /// The unit of each field.
    pub(super) values: Vec<f64>,
    /// That unit over the largest value of the field.
    pub(super) shares: Vec<f64>,
}

/// The largest value of each field; 1 for one that is zero.
fn largest<const D: usize>(set: &Set<D>) -> Vec<f64> {
    let largest = |values: &Vec<f64>| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let values = set.fields.iter().map(|(_, values)| largest(values));
    values.map(|most| if most > 0.0 { most } else { 1.0 }).collect()
}

impl<const D: usize> Units<D> {
    /// The file's own.
    pub(super) fn file(set: &Set<D>) -> Self {
        let shares = largest(set).into_iter().map(|most| 1.0 / most);
        Self {
            origin: [0.0; D],
            length: 1.0,
            mass: 1.0,
            values: vec![1.0; set.fields.len()],
            shares: shares.collect(),
        }
    }

    /// From the middle of the particles, the largest support radius being so many units, the mean density 1 and no value larger.
    pub(super) fn with_support(set: &Set<D>, support: f64) -> Self {
        let [lower, upper] = set.corners();
        let length = set.reach() / support;
        let density = set.masses.iter().sum::<f64>() / set.volumes.iter().sum::<f64>();
        let values = largest(set);
        Self {
            origin: std::array::from_fn(|axis| lower[axis] + (upper[axis] - lower[axis]) / 2.0),
            length,
            mass: density * length.powi(D as i32),
            shares: vec![1.0; values.len()],
            values,
        }
    }

    /// Integer bits, the sign among them, that hold every coordinate.
    pub(super) fn bits_of_positions(&self, set: &Set<D>) -> u32 {
        let farthest = |corner: &[f64; D]| {
            (0..D).fold(0.0_f64, |most, axis| {
                most.max(((corner[axis] - self.origin[axis]) / self.length).abs())
            })
        };
        let [lower, upper] = set.corners();
        let farthest = farthest(&lower).max(farthest(&upper));
        if farthest < 1.0 { 1 } else { (farthest.log2().floor() + 2.0).min(1e4) as u32 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_need_as_many_bits_as_their_farthest_has() {
        let set = |x: f64| Set::<1>::of_positions(vec![[0.0], [x]]);
        let units = Units { origin: [0.0], length: 1.0, mass: 1.0, values: Vec::new(), shares: Vec::new() };
        for (x, bits) in [(0.5, 1), (1.0, 2), (1.9, 2), (2.0, 3), (-7.9, 4), (8.0, 5)] {
            assert_eq!(units.bits_of_positions(&set(x)), bits, "{x}");
        }
    }
}

//! A container from a bitmap.

use super::{Container, Wall, half_space, hold};
use crate::scalar::compact::{Compact, NearUnit};
use crate::{Arithmetic, Error, Parameter, check};

/// A container drawn as a bitmap: fluid flows where a bit is set, everything else and everything around is wall.
///
/// Rows from the bottom up (the second axis), `⌈width / 8⌉` bytes each, the most significant bit first; the pixels are squares of
/// side 1/2 or more, in units of h. Two dimensions.
///
/// The walls' share is a sum over the pixels in reach, the kernel taken as a product of its marginals, which makes a
/// straight wall exact and a corner the product of its walls.
///
/// ```
/// use sph_core::fluid::{Container, Mask};
/// // two chambers with a door between them
/// const BITS: [u8; 5] = [0b1110_1110, 0b1110_1110, 0b1111_1110, 0b1110_1110, 0b1110_1110];
/// let badge = Mask::new(&BITS, 7, 2.0_f32)?;
/// assert!(badge.contains(&[7.0, 5.0]));
/// assert!(!badge.contains(&[7.0, 3.0]));
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Mask<'a, T> {
    bits: &'a [u8],
    width: u8,
    height: u8,
    pixel: T,
    per_length: T,
}

/// Pixels in reach on either side, for the smallest pixel.
const REACH: i32 = 2;
const WINDOW: usize = 2 * REACH as usize + 1;

/// One axis of the kernel over the window: each column's part of its mass, and of its pull.
struct Columns<N> {
    mass: [N; WINDOW],
    pull: [N; WINDOW],
}

impl<'a, T: Compact> Mask<'a, T> {
    /// The bitmap with rows of `width` pixels of side `pixel`.
    ///
    /// # Errors
    /// [`Error::NotPositive`] for a `width` or `pixel` of zero or less; [`Error::NotRepresentable`] for a pixel below 1/2, and
    /// where the scalar cannot hold the length of a side;
    /// [`Error::LengthMismatch`] where the bytes are no whole number of rows; [`Error::CapacityExceeded`] for more than 255 rows.
    pub fn new(bits: &'a [u8], width: u8, pixel: T) -> Result<Self, Error> {
        let parameter = Parameter::Cells;
        check::positive(pixel, Parameter::Axis, 0)?;
        if pixel < T::ratio(1, 2) {
            return Err(Error::NotRepresentable { parameter: Parameter::Axis });
        }
        let stride = usize::from(width.div_ceil(8));
        let rows = bits.len().checked_div(stride).ok_or(Error::NotPositive { parameter, index: 0 })?;
        check::length(bits.len(), rows.wrapping_mul(stride), parameter)?;
        if rows == 0 {
            return Err(Error::NotPositive { parameter, index: 1 });
        }
        let height = u8::try_from(rows).map_err(|_| Error::CapacityExceeded {
            parameter,
            capacity: 255,
            needed: rows,
        })?;
        // wrapped, one more pixel takes away; held at the end of the range, it adds less than a pixel
        let grows = |n: i32| {
            let (before, now) = (pixel.times(n - 1), pixel.times(n));
            now > before && now.is_finite() && now - before >= pixel - (now - before)
        };
        if !(1..=i32::from(width.max(height))).all(grows) {
            return Err(Error::NotRepresentable { parameter: Parameter::Axis });
        }
        Ok(Self { bits, width, height, pixel, per_length: T::ONE / pixel })
    }

    /// Whether fluid may be in the pixel.
    fn is_open(&self, column: i32, row: i32) -> bool {
        if column < 0 || row < 0 || column >= i32::from(self.width) || row >= i32::from(self.height) {
            return false;
        }
        let (column, row) = (column as usize, row as usize);
        let byte = row.wrapping_mul(self.width.div_ceil(8).into()).wrapping_add(column >> 3);
        self.bits.get(byte).is_some_and(|bits| bits & (0x80 >> (column & 7)) != 0)
    }

    fn pixel_of(&self, coordinate: T) -> i32 {
        (coordinate * self.per_length).floor_to_i32()
    }

    /// Whether every pixel of the window around this one is open.
    fn all_open(&self, column: i32, row: i32) -> bool {
        (-REACH..=REACH).all(|dy| (-REACH..=REACH).all(|dx| self.is_open(column + dx, row + dy)))
    }

    /// The kernel's marginal over the columns around pixel `middle`.
    fn columns(&self, x: T, middle: i32) -> Columns<T::Near> {
        let zero = T::Near::ZERO;
        let mut columns = Columns { mass: [zero; WINDOW], pull: [zero; WINDOW] };
        let (mut beyond, mut pull) = (T::Near::ONE, zero);
        for (i, (mass, pulled)) in columns.mass.iter_mut().zip(&mut columns.pull).enumerate() {
            let edge = self.pixel.times(middle.saturating_add(i as i32 + 1 - REACH)) - x;
            let (next_beyond, next_pull) = marginal(edge);
            *mass = beyond - next_beyond;
            *pulled = pull - next_pull;
            (beyond, pull) = (next_beyond, next_pull);
        }
        columns
    }
}

/// x as a particle keeps it.
fn kept<T: Compact>(x: T) -> T {
    T::from_near(x.near())
}

/// The kernel's mass beyond an edge, and the pull of particles there.
fn marginal<T: Compact>(edge: T) -> (T::Near, T::Near) {
    if edge >= T::ONE {
        return (T::Near::ZERO, T::Near::ZERO);
    }
    if edge <= -T::ONE {
        return (T::Near::ONE, T::Near::ZERO);
    }
    let d = edge.abs().near();
    let share = half_space::share::<T::Near, 2>(d);
    (if edge < T::ZERO { T::Near::ONE - share } else { share }, half_space::push::<T::Near, 2>(d))
}

impl<T: Compact> Container<T, 2> for Mask<'_, T> {
    fn size(&self) -> [T; 2] {
        [self.pixel.times(self.width.into()), self.pixel.times(self.height.into())]
    }

    fn contains(&self, x: &[T; 2]) -> bool {
        let size: [T; 2] = self.size();
        x[0] >= T::ZERO
            && x[1] >= T::ZERO
            && x[0] <= size[0]
            && x[1] <= size[1]
            && self.is_open(self.pixel_of(x[0]), self.pixel_of(x[1]))
    }

    fn wall(&self, x: &[T::Near; 2]) -> Option<Wall<T::Near, 2>> {
        let x = x.map(T::from_near);
        let [column, row] = x.map(|coordinate| self.pixel_of(coordinate));
        if self.all_open(column, row) {
            return None;
        }
        let (across, up) = (self.columns(x[0], column), self.columns(x[1], row));
        let mut wall = Wall { share: T::Near::ZERO, push: [T::Near::ZERO; 2] };
        for (j, (&mass_y, &pull_y)) in up.mass.iter().zip(&up.pull).enumerate() {
            for (i, (&mass_x, &pull_x)) in across.mass.iter().zip(&across.pull).enumerate() {
                if !self
                    .is_open(column.saturating_add(i as i32 - REACH), row.saturating_add(j as i32 - REACH))
                {
                    wall.share += mass_x * mass_y;
                    wall.push[0] -= pull_x.mul_rounded(mass_y);
                    wall.push[1] -= pull_y.mul_rounded(mass_x);
                }
            }
        }
        Some(wall)
    }

    /// One axis after the other, each up to the first wall: no step of half a pixel or less passes one.
    fn confine(&self, from: &[T::Near; 2], to: [T::Near; 2], gap: T::Near) -> [T::Near; 2] {
        let (size, to, gap): ([T; 2], _, _) = (self.size(), to.map(T::from_near), T::from_near(gap));
        let mut at = from.map(T::from_near);
        for axis in 0..2 {
            let stay = at[axis];
            let reach = self.pixel;
            let target = hold(to[axis], size[axis], T::ZERO).min(stay + reach).max(stay - reach);
            at[axis] = target;
            at[axis] = kept(at[axis]);
            if self.is_open(self.pixel_of(at[0]), self.pixel_of(at[1])) {
                continue;
            }
            let edge = self.pixel_of(stay);
            at[axis] = if target > stay {
                (self.pixel.times(edge.saturating_add(1)) - gap).max(stay)
            } else {
                (self.pixel.times(edge) + gap).min(stay)
            };
            at[axis] = kept(at[axis]);
            if !self.is_open(self.pixel_of(at[0]), self.pixel_of(at[1])) {
                at[axis] = stay;
            }
        }
        at.map(T::near)
    }
}

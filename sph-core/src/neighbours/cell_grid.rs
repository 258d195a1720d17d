//! Samples sorted into cells by counting, so that a query looks only at the cells in reach.
//!
//! `entries` holds the samples' indices by cell, and `starts[c]..starts[c + 1]` those of cell c. A row of cells along the
//! first axis is one contiguous run of entries.

use super::axis::{self, image};
use super::{CellLayout, Domain, Index, Neighbour, Neighbours, Space};
use crate::{Error, Parameter, Scalar};

/// A search over samples in cells, on slices that the caller owns.
///
/// The order of a query: rows of cells ascending with the first axis fastest, and ascending j in each cell. Any radius
/// may be asked for; a cell about as wide as the radius is quickest.
///
/// ```
/// use sph_core::{CellGrid, CellLayout, Neighbours};
/// let positions = [[0.1_f32, 0.1], [0.9, 0.9], [0.15, 0.1]];
/// let layout = CellLayout::bounded(&[0.0, 0.0], &[1.0, 1.0], [4, 4])?;
/// let mut starts = [0_u8; 17]; // cells + 1
/// let mut entries = [0_u8; 3]; // samples
/// let grid = CellGrid::build(layout, &positions, &mut starts, &mut entries)?;
/// assert_eq!(grid.count(&[0.1, 0.1], 0.25), 2);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CellGrid<'a, T, I, const D: usize, S = Domain<T, D>> {
    layout: CellLayout<T, D, S>,
    positions: &'a [[T; D]],
    starts: &'a [I],
    entries: &'a [I],
}

impl<'a, T: Scalar, I: Index, const D: usize, S: Space<T, D>> CellGrid<'a, T, I, D, S> {
    /// Sorts the samples into the layout's cells. `starts` takes cells + 1 indices, `entries` one for each sample; both may be
    /// longer. Time: O(samples + cells).
    ///
    /// # Errors
    /// [`Error::CapacityExceeded`] where a slice is too short or I too narrow; [`Error::NotFinite`] or
    /// [`Error::OutsideDomain`] with the sample's index.
    pub fn build(
        layout: CellLayout<T, D, S>,
        positions: &'a [[T; D]],
        starts: &'a mut [I],
        entries: &'a mut [I],
    ) -> Result<Self, Error> {
        sort(&layout, positions, starts, entries)?;
        Ok(Self::from_sorted(layout, positions, starts, entries))
    }

    /// The search over slices that [`build`](Self::build) has filled for these positions and this layout. Slices that it has
    /// not filled give a search that misses samples or meets some twice, and never a panic.
    pub fn from_sorted(
        layout: CellLayout<T, D, S>,
        positions: &'a [[T; D]],
        starts: &'a [I],
        entries: &'a [I],
    ) -> Self {
        Self { layout, positions, starts, entries }
    }

    /// The samples' indices, cell by cell: an order in which neighbours in space are near in memory.
    pub fn entries(&self) -> &'a [I] {
        self.entries.get(..self.positions.len()).unwrap_or(self.entries)
    }

    /// The entries of the `cells` cells from `first` on.
    #[inline(always)]
    fn run(&self, first: usize, cells: usize) -> &'a [I] {
        let end = first.wrapping_add(cells);
        match (self.starts.get(first), self.starts.get(end)) {
            (Some(start), Some(end)) => self.entries.get(start.to_usize()..end.to_usize()).unwrap_or(&[]),
            _ => &[],
        }
    }
}

/// Counting sort of the samples by cell, ascending index within each.
pub(super) fn sort<T: Scalar, I: Index, const D: usize, S: Space<T, D>>(
    layout: &CellLayout<T, D, S>,
    positions: &[[T; D]],
    starts: &mut [I],
    entries: &mut [I],
) -> Result<(), Error> {
    let cells = layout.cells();
    let samples = positions.len();
    let fits = |parameter, capacity, needed| {
        if needed <= capacity { Ok(()) } else { Err(Error::CapacityExceeded { parameter, capacity, needed }) }
    };
    fits(Parameter::Cells, starts.len().saturating_sub(1), cells)?;
    fits(Parameter::Entries, entries.len().min(I::MAX), samples)?;
    axis::check(&layout.space, positions)?;

    let starts = starts.get_mut(..=cells).unwrap_or_default();
    starts.fill(I::ZERO);
    for position in positions {
        if let Some(count) = starts.get_mut(layout.cell_of(position)) {
            *count = I::from_usize(count.to_usize().wrapping_add(1));
        }
    }
    let mut end = 0_usize;
    for start in starts.iter_mut() {
        end = end.wrapping_add(start.to_usize());
        *start = I::from_usize(end);
    }
    // From the last sample back, each takes the last free place of its cell: what remains are the cells' starts.
    for (index, position) in positions.iter().enumerate().rev() {
        if let Some(start) = starts.get_mut(layout.cell_of(position)) {
            let place = start.to_usize().wrapping_sub(1);
            *start = I::from_usize(place);
            if let Some(entry) = entries.get_mut(place) {
                *entry = I::from_usize(index);
            }
        }
    }
    Ok(())
}

impl<T: Scalar, I: Index, const D: usize, S: Space<T, D>> Neighbours<T, D> for CellGrid<'_, T, I, D, S> {
    fn positions(&self) -> &[[T; D]] {
        self.positions
    }

    #[inline]
    fn for_each(&self, x: &[T; D], radius: T, mut visit: impl FnMut(Neighbour<T, D>)) {
        if !radius.is_above_zero() || D == 0 {
            return;
        }
        let radius_squared = radius * radius;
        let (x, ranges) = self.layout.in_reach(x, radius);
        let mut row = ranges.map(|(first, _)| first);
        loop {
            self.visit_row(&row, ranges[0].1, &x, radius_squared, &mut visit);
            if !next_row(&mut row, &ranges) {
                break;
            }
        }
    }
}

impl<T: Scalar, I: Index, const D: usize, S: Space<T, D>> CellGrid<'_, T, I, D, S> {
    /// Visits the cells from `row` along the first axis to the cell number `last`, run by run of stored cells.
    #[inline(always)]
    fn visit_row(
        &self,
        row: &[i32; D],
        last: i32,
        x: &[T; D],
        radius_squared: T,
        visit: &mut impl FnMut(Neighbour<T, D>),
    ) {
        let axes = &self.layout.axes;
        let mut k = [0; D];
        let mut base = 0_usize;
        for axis in (1..D).rev() {
            let (cell, image) = axes[axis].locate(row[axis]);
            k[axis] = image;
            base = base.wrapping_add(cell as usize).wrapping_mul(axes[axis - 1].count.get() as usize);
        }
        let mut number = row[0];
        while number <= last {
            let (cell, image) = axes[0].locate(number);
            k[0] = image;
            let cells = (axes[0].count.get() - cell).min(last.abs_diff(number).saturating_add(1));
            let run = self.run(base.wrapping_add(cell as usize), cells as usize);
            self.visit_run(run, &k, x, radius_squared, visit);
            number += cells as i32;
        }
    }

    #[inline(always)]
    fn visit_run(
        &self,
        run: &[I],
        k: &[i32; D],
        x: &[T; D],
        radius_squared: T,
        visit: &mut impl FnMut(Neighbour<T, D>),
    ) {
        let space = &self.layout.space;
        for index in run {
            let index = index.to_usize();
            let Some(position) = self.positions.get(index) else { continue };
            let position = core::array::from_fn(|axis| image(&space.axis(axis), position[axis], k[axis]));
            if let Some(neighbour) = Neighbour::within(index, x, &position, radius_squared) {
                visit(neighbour);
            }
        }
    }
}

/// The next row in the ranges of the second and further axes, second fastest; false after the last.
#[inline(always)]
fn next_row<const D: usize>(row: &mut [i32; D], ranges: &[(i32, i32); D]) -> bool {
    for axis in 1..D {
        if row[axis] < ranges[axis].1 {
            row[axis] += 1;
            return true;
        }
        row[axis] = ranges[axis].0;
    }
    false
}

/// The layout and the number of samples, not each of them.
#[cfg(feature = "defmt")]
impl<T, I, const D: usize, S> defmt::Format for CellGrid<'_, T, I, D, S>
where
    T: defmt::Format,
    S: defmt::Format,
{
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "CellGrid of {=usize} samples in {}", self.positions.len(), self.layout);
    }
}

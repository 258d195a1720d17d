//! Candidates: runs of consecutive particles, sixteen at a time.

use super::cells::BandLayout;
use super::simd::{BLOCK, Real, Register};
use super::sort::to_f64;
use super::sorted_cells::SortedCells;

/// Sixteen consecutive particles, and a bit for each that counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Block {
    pub(super) first: u32,
    pub(super) mask: u32,
}

impl Block {
    /// The places of its particles.
    #[inline(always)]
    pub(super) fn places(self) -> [u32; BLOCK] {
        let mut places = [0; BLOCK];
        for k in 0..BLOCK {
            places[k] = self.first.wrapping_add(k as u32);
        }
        places
    }
}

/// Makes room for so many.
#[inline(always)]
pub(crate) fn reserve<V: Clone + Default>(list: &mut Vec<V>, room: usize) {
    #[cold]
    fn grow<V: Clone + Default>(list: &mut Vec<V>, room: usize) {
        list.resize(2 * room, V::default());
    }
    if list.len() < room {
        grow(list, room);
    }
}

/// Sixteen numbers of a list from a place on, which must be there, to be written.
#[inline(always)]
pub(crate) fn sixteen_mut<V>(list: &mut [V], first: usize) -> &mut [V; BLOCK] {
    list[first..].first_chunk_mut().expect("a block of padding")
}

/// The last place where a register of so many numbers can be stored, in a list of a known length: an assertion that a place is not
/// beyond it takes the place of a check for each list.
#[inline(always)]
pub(crate) fn last_store(length: usize, width: usize) -> usize {
    // a difference that is known not to wrap: after a plain one the checks stay
    length.checked_sub(width).expect("room for a register")
}

/// Lists the candidates about a box that lies in one row of cells, of the particles from a place on, after the first `end`
/// blocks; returns where they end then.
#[inline(always)]
pub(super) fn candidates<T: Real, const D: usize>(
    cells: &SortedCells<T, D>,
    lower: &[T; D],
    upper: &[T; D],
    from: usize,
    blocks: &mut Vec<Block>,
    mut end: usize,
) -> usize {
    let runs = cells.layout.runs(&to_f64(lower), &to_f64(upper));
    for run in &runs[..BandLayout::<D>::RUNS] {
        let (first, last) = cells.sorted.range(run);
        let first = first.max(from as u32);
        let size = last.saturating_sub(first);
        let needed = size.div_ceil(BLOCK as u32) as usize;
        reserve(blocks, end + needed + AT_ONCE);
        split(first, size, needed, &mut blocks[end..]);
        end += needed;
    }
    end
}

/// The first numbers of some lists, of each as many: then one check of a place is enough for all.
///
/// A loop fills it, after which no list is `None`: of what `array::from_fn` makes, the compiler does not know the lengths where it
/// calls it in another unit.
pub(crate) struct Fronts<'a, T, const N: usize>([Option<&'a mut [T]>; N]);

impl<'a, T, const N: usize> Fronts<'a, T, N> {
    /// The first `room` numbers of each list, which has as many.
    #[inline(always)]
    pub(crate) fn new(lists: &'a mut [Vec<T>; N], room: usize) -> Self {
        let mut fronts = [const { None }; N];
        for (number, list) in lists.iter_mut().enumerate() {
            fronts[number] = Some(&mut list[..room]);
        }
        Self(fronts)
    }

    /// One of the lists.
    #[inline(always)]
    pub(crate) fn list(&mut self, number: usize) -> &mut [T] {
        match &mut self.0[number] {
            Some(list) => list,
            None => &mut [],
        }
    }
}

/// Blocks that are written together, even where fewer are needed: a branch on their number would be mispredicted.
const AT_ONCE: usize = 4;

/// Splits consecutive particles into blocks, of which as many are `needed`.
#[inline(always)]
fn split(first: u32, size: u32, needed: usize, out: &mut [Block]) {
    let mut next = first;
    for out in out.as_chunks_mut::<AT_ONCE>().0.iter_mut().take(needed.div_ceil(AT_ONCE).max(1)) {
        for (k, out) in out.iter_mut().enumerate() {
            *out = Block { first: next.wrapping_add((k * BLOCK) as u32), mask: 0xffff };
        }
        next = next.wrapping_add((AT_ONCE * BLOCK) as u32);
    }
    let missing = (needed * BLOCK) as u32 - size;
    out[needed.max(1) - 1].mask = 0xffff >> missing;
}

/// r² of a register of particles from a place on, summed axis by axis; `distances` takes the axis and the coordinates.
#[inline(always)]
pub(super) fn squares<T: Real, R: Register<T>, const D: usize>(
    axes: &[&[T]; D],
    first: usize,
    distances: impl Fn(usize, R) -> R,
) -> R {
    let mut sum = R::ZERO;
    for axis in 0..D {
        let d = distances(axis, R::load_at(axes[axis], first));
        sum = if axis == 0 { d * d } else { sum + d * d };
    }
    sum
}

//! Which of the particles ahead of one are in reach, as the bits of a mask: bit k for the k-th, all bits where there are more than 31.

/// Whether the processor counts zeros in one instruction: among Cortex-M and RV32 those that have atomics do.
const COUNTS_ZEROS: bool = cfg!(target_has_atomic = "32");

/// Visits the particles of some runs, `row` first, that the mask has a bit for.
///
/// Both ways visit the same; the first is quicker where an index becomes an address by a shift.
#[inline(always)]
pub(super) fn visit<P>(mask: u32, row: &mut [P], beyond: &mut [&mut [P]], visit: impl FnMut(&mut P)) {
    if COUNTS_ZEROS && size_of::<P>().is_power_of_two() {
        visit_by_zeros(mask, row, beyond, visit);
    } else {
        visit_by_bits(mask, row, beyond, visit);
    }
}

/// From one bit that is set to the next.
#[inline(always)]
fn visit_by_zeros<P>(mask: u32, row: &mut [P], beyond: &mut [&mut [P]], mut visit: impl FnMut(&mut P)) {
    let (mut bits, mut run, mut later) = (mask, row, beyond.iter_mut());
    loop {
        while bits != 0
            && let Some(other) = run.get_mut(bits.trailing_zeros() as usize)
        {
            bits &= bits.wrapping_sub(1);
            visit(other);
        }
        if bits != 0 {
            let Some(next) = later.next() else { return };
            // an arithmetic shift: all bits stay all bits
            bits = (bits as i32).wrapping_shr(run.len() as u32) as u32;
            run = next;
        } else if run.len() >= 32 {
            // more than 31 ahead, so the mask has all bits
            (run, bits) = (run.get_mut(32..).unwrap_or_default(), u32::MAX);
        } else {
            return;
        }
    }
}

/// Bit by bit.
#[inline(always)]
fn visit_by_bits<P>(mask: u32, row: &mut [P], beyond: &mut [&mut [P]], mut visit: impl FnMut(&mut P)) {
    let (mut bits, mut run, mut later) = (mask as i32, row, beyond.iter_mut());
    loop {
        for other in run.iter_mut() {
            let is_near = bits & 1 != 0;
            bits >>= 1; // an arithmetic shift: all bits stay all bits
            if is_near {
                visit(other);
                if bits == 0 {
                    return;
                }
            }
        }
        let Some(next) = later.next() else { return };
        run = next;
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    /// The numbers that are visited of those counted through a row and two runs beyond it.
    fn visited(by_zeros: bool, mask: u32, lengths: [usize; 3]) -> Vec<usize> {
        let mut numbers: Vec<usize> = (0..lengths.iter().sum()).collect();
        let (row, rest) = numbers.split_at_mut(lengths[0]);
        let (next, last) = rest.split_at_mut(lengths[1]);
        let mut seen = Vec::new();
        let note = |&mut number: &mut usize| seen.push(number);
        if by_zeros {
            visit_by_zeros(mask, row, &mut [next, last], note);
        } else {
            visit_by_bits(mask, row, &mut [next, last], note);
        }
        seen
    }

    #[test]
    fn a_mask_chooses_among_the_particles_ahead() {
        for lengths in [[3, 4, 5], [0, 0, 9], [12, 0, 1], [1, 29, 1]] {
            for mask in [0, 0b1, 0b100_1010, 0b1111_0000_1111, 0x4000_0001, 0x7fff_ffff] {
                let total = lengths.iter().sum();
                let expected: Vec<usize> = (0..total).filter(|k| mask >> k & 1 == 1).collect();
                assert_eq!(visited(true, mask, lengths), expected, "{mask:b}, {lengths:?}");
                assert_eq!(visited(false, mask, lengths), expected, "{mask:b}, {lengths:?}");
            }
        }
    }

    #[test]
    fn all_bits_choose_all() {
        for lengths in [[3, 4, 5], [31, 32, 33], [32, 0, 1], [0, 64, 64], [70, 5, 100]] {
            let expected: Vec<usize> = (0..lengths.iter().sum()).collect();
            assert_eq!(visited(true, u32::MAX, lengths), expected, "{lengths:?}");
            assert_eq!(visited(false, u32::MAX, lengths), expected, "{lengths:?}");
        }
    }
}

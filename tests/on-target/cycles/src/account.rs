//! Adds up what is executed, region by region.

use crate::instruction::{self, Instruction};
use crate::timing::{CORTEX_M0, CORTEX_M0_PLUS, Timing};
use std::fmt;

/// `mov r9, r9`: a region begins after it.
pub const BEGIN: u16 = 0x46c9;
/// `mov r10, r10`: a region ends before it.
pub const END: u16 = 0x46d2;

/// What a region came to. It is written as `instructions,cycles M0,cycles M0+,without a number,of LR and PC`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Instructions that were executed.
    pub instructions: u64,
    /// Cycles on a Cortex-M0.
    pub m0: u64,
    /// Cycles on a Cortex-M0+.
    pub m0_plus: u64,
    /// Instructions that have no published number and are in neither sum: where this is not 0, the sums say nothing.
    pub unknown: u64,
    /// How many PUSH have the link register and how many POP the program counter, together: emulators disagree about these.
    pub linked: u64,
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { instructions, m0, m0_plus, unknown, linked } = self;
        write!(f, "{instructions},{m0},{m0_plus},{unknown},{linked}")
    }
}

/// The regions so far.
#[derive(Clone, Debug, Default)]
pub struct Account {
    open: Option<Totals>,
    /// Where the processor goes on if the last instruction, a branch with a condition, is not taken.
    undecided: Option<u32>,
    closed: Vec<Totals>,
}

impl Account {
    /// Nothing yet.
    pub const fn new() -> Self {
        Self { open: None, undecided: None, closed: Vec::new() }
    }

    /// The regions that have ended, in the order of their ends.
    pub fn regions(&self) -> &[Totals] {
        &self.closed
    }

    /// The next instruction that is executed, and where it lies. A narrow one has any second halfword.
    ///
    /// Whether a branch is taken shows in the address of the instruction after it.
    pub fn execute(&mut self, address: u32, first: u16, second: u16) {
        if first == BEGIN {
            (self.open, self.undecided) = (Some(Totals::default()), None);
            return;
        }
        let Some(totals) = &mut self.open else { return };
        if let Some(next) = self.undecided.take() {
            totals.add(Instruction::Conditional, address != next);
        }
        if first == END {
            self.closed.extend(self.open.take());
            return;
        }
        totals.instructions += 1;
        match instruction::decode(first, second) {
            Some(Instruction::Conditional) => self.undecided = Some(address.wrapping_add(2)),
            Some(instruction) => totals.add(instruction, false),
            None => totals.unknown += 1,
        }
        totals.linked += u64::from(matches!(first >> 8, 0xb5 | 0xbd));
    }
}

impl Totals {
    fn add(&mut self, instruction: Instruction, taken: bool) {
        let cycles = |timing: Timing| u64::from(timing.cycles(instruction, taken));
        self.m0 += cycles(CORTEX_M0);
        self.m0_plus += cycles(CORTEX_M0_PLUS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOP: u16 = 0xbf00;
    const BNE: u16 = 0xd1fd;

    fn regions(executed: &[(u32, u16, u16)]) -> Vec<Totals> {
        let mut account = Account::new();
        for &(address, first, second) in executed {
            account.execute(address, first, second);
        }
        account.regions().to_vec()
    }

    #[test]
    fn nothing_counts_outside_a_region() {
        assert!(regions(&[(0, NOP, 0), (2, END, 0), (4, NOP, 0)]).is_empty());
        assert_eq!(regions(&[(0, NOP, 0), (2, BEGIN, 0), (4, END, 0), (6, NOP, 0)]), [Totals::default()]);
    }

    #[test]
    fn a_branch_is_taken_when_something_else_follows() {
        let of_branch = |m0, m0_plus| Totals { instructions: 1, m0, m0_plus, ..Totals::default() };
        let fallen = regions(&[(0, BEGIN, 0), (2, BNE, 0), (4, END, 0)]);
        let taken = regions(&[(0, BEGIN, 0), (2, BNE, 0), (0x40, END, 0)]);
        assert_eq!((fallen, taken), (vec![of_branch(1, 1)], vec![of_branch(3, 2)]));
    }

    #[test]
    fn a_branch_that_was_not_decided_is_not_carried_into_another_region() {
        let again = regions(&[(0, BEGIN, 0), (2, BNE, 0), (8, BEGIN, 0), (10, NOP, 0), (12, END, 0)]);
        assert_eq!(again, [Totals { instructions: 1, m0: 1, m0_plus: 1, ..Totals::default() }]);
    }

    #[test]
    fn what_has_no_number_is_told() {
        let [totals] = regions(&[(0, BEGIN, 0), (2, 0xbe00, 0), (4, 0xfb90, 0xf0f1), (8, END, 0)])[..] else {
            panic!("one region")
        };
        assert_eq!((totals.instructions, totals.unknown, totals.m0), (2, 2, 0));
    }

    #[test]
    fn a_line_has_all_of_a_region() {
        let totals = Totals { instructions: 1, m0: 2, m0_plus: 3, unknown: 4, linked: 5 };
        assert_eq!(totals.to_string(), "1,2,3,4,5");
    }
}

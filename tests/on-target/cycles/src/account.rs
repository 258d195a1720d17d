//! Adds up what is executed, region by region.

use crate::instruction::{self, Instruction};
use crate::m4;
use crate::timing::{CORTEX_M0, CORTEX_M0_PLUS, Timing};
use std::fmt;
use std::ops::AddAssign;

/// `mov r9, r9`: a region begins after it.
pub const BEGIN: u16 = 0x46c9;
/// `mov r10, r10`: a region ends before it.
pub const END: u16 = 0x46d2;

/// What a region came to. It is written as a line of numbers with commas, in the order of the fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Instructions that were executed.
    pub instructions: u64,
    /// Cycles on a Cortex-M0.
    pub m0: u64,
    /// Cycles on a Cortex-M0+.
    pub m0_plus: u64,
    /// Instructions without a published number for these two. Where this is not 0, their sums say nothing.
    pub unknown: u64,
    /// How many PUSH have the link register and how many POP the program counter, together: emulators disagree about these.
    pub linked: u64,
    /// Cycles on a Cortex-M4, at least.
    pub m4_low: u64,
    /// Cycles on a Cortex-M4, at most.
    pub m4_high: u64,
    /// Instructions without bounds for a Cortex-M4. Where this is not 0, its sums say nothing.
    pub m4_unknown: u64,
}

impl fmt::Display for Totals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { instructions, m0, m0_plus, unknown, linked, m4_low, m4_high, m4_unknown } = self;
        write!(f, "{instructions},{m0},{m0_plus},{unknown},{linked},{m4_low},{m4_high},{m4_unknown}")
    }
}

/// An instruction at its place, with what it costs.
#[derive(Clone, Copy, Debug)]
struct Step {
    address: u32,
    /// Where the next instruction lies.
    end: u32,
    kind: Kind,
    /// If it is taken, or not a branch.
    cost: Totals,
    /// If it is a branch that is not taken, or stands under an IT.
    otherwise: Totals,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Begin,
    End,
    /// A branch that is taken or not.
    Conditional,
    /// Any other; so many instructions after it stand under an IT.
    Other(u32),
}

/// The instructions that are known, and the regions so far.
#[derive(Clone, Debug, Default)]
pub struct Account {
    steps: Vec<Step>,
    open: Option<Totals>,
    /// The number of a branch of which it is not known yet whether it is taken.
    undecided: Option<usize>,
    /// How many of the next instructions stand under an IT.
    conditional: u32,
    closed: Vec<Totals>,
}

impl Account {
    /// Nothing yet.
    pub const fn new() -> Self {
        Self { steps: Vec::new(), open: None, undecided: None, conditional: 0, closed: Vec::new() }
    }

    /// The regions that have ended, in the order of their ends.
    pub fn regions(&self) -> &[Totals] {
        &self.closed
    }

    /// Learns an instruction that lies at an address; gives its number. A narrow one has any second halfword.
    pub fn learn(&mut self, address: u32, first: u16, second: u16) -> usize {
        let is_conditional = m4::is_conditional(first, second);
        let kind = match first {
            BEGIN => Kind::Begin,
            END => Kind::End,
            _ if is_conditional => Kind::Conditional,
            _ => Kind::Other(m4::conditional_after(first)),
        };
        let size = if instruction::is_wide(first) { 4 } else { 2 };
        self.steps.push(Step {
            address,
            end: address.wrapping_add(size),
            kind,
            cost: Totals::of(first, second),
            otherwise: if is_conditional {
                Totals::not_taken(first, second)
            } else {
                Totals::under_it(first, second)
            },
        });
        self.steps.len() - 1
    }

    /// The instruction with this number is executed. Whether a branch is taken shows in the address of the next one.
    pub fn execute(&mut self, number: usize) {
        let Self { steps, open, undecided, conditional, closed } = self;
        let Some(step) = steps.get(number) else { return };
        if let Kind::Begin = step.kind {
            (*open, *undecided, *conditional) = (Some(Totals::default()), None, 0);
            return;
        }
        let Some(totals) = open else { return };
        if let Some(branch) = undecided.take().and_then(|number| steps.get(number)) {
            *totals += if step.address == branch.end { &branch.otherwise } else { &branch.cost };
        }
        match step.kind {
            Kind::Begin | Kind::End => closed.extend(open.take()),
            Kind::Conditional => *undecided = Some(number),
            Kind::Other(_) if *conditional > 0 => {
                *conditional -= 1;
                *totals += &step.otherwise;
            }
            Kind::Other(under_it) => {
                *conditional = under_it;
                *totals += &step.cost;
            }
        }
    }
}

impl Totals {
    /// An instruction; a branch with a condition as if it were taken.
    fn of(first: u16, second: u16) -> Self {
        Self::new(first, instruction::decode(first, second), true, m4::cycles(first, second))
    }

    /// A branch that is not taken.
    fn not_taken(first: u16, second: u16) -> Self {
        Self::new(first, instruction::decode(first, second), false, Some(m4::NOT_TAKEN))
    }

    /// An instruction that is skipped or not, which only a Cortex-M4 has.
    fn under_it(first: u16, second: u16) -> Self {
        Self::new(first, None, false, m4::cycles(first, second).map(|of| m4::Bounds { low: 1, ..of }))
    }

    fn new(first: u16, instruction: Option<Instruction>, taken: bool, bounds: Option<m4::Bounds>) -> Self {
        let cycles =
            |timing: Timing| instruction.map_or(0, |instruction| timing.cycles(instruction, taken).into());
        Self {
            instructions: 1,
            m0: cycles(CORTEX_M0),
            m0_plus: cycles(CORTEX_M0_PLUS),
            unknown: instruction.is_none().into(),
            linked: matches!(first >> 8, 0xb5 | 0xbd).into(),
            m4_low: bounds.map_or(0, |bounds| bounds.low.into()),
            m4_high: bounds.map_or(0, |bounds| bounds.high.into()),
            m4_unknown: bounds.is_none().into(),
        }
    }
}

impl AddAssign<&Totals> for Totals {
    fn add_assign(&mut self, other: &Self) {
        self.instructions += other.instructions;
        self.m0 += other.m0;
        self.m0_plus += other.m0_plus;
        self.unknown += other.unknown;
        self.linked += other.linked;
        self.m4_low += other.m4_low;
        self.m4_high += other.m4_high;
        self.m4_unknown += other.m4_unknown;
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
            let number = account.learn(address, first, second);
            account.execute(number);
        }
        account.regions().to_vec()
    }

    #[test]
    fn an_instruction_costs_what_it_costs_each_time() {
        let mut account = Account::new();
        let [begin, nop, end] = [BEGIN, NOP, END].map(|first| account.learn(0, first, 0));
        for number in [begin, nop, nop, end, nop, begin, nop, end] {
            account.execute(number);
        }
        let instructions: Vec<u64> = account.regions().iter().map(|totals| totals.instructions).collect();
        assert_eq!(instructions, [2, 1]);
    }

    #[test]
    fn nothing_counts_outside_a_region() {
        assert!(regions(&[(0, NOP, 0), (2, END, 0), (4, NOP, 0)]).is_empty());
        assert_eq!(regions(&[(0, NOP, 0), (2, BEGIN, 0), (4, END, 0), (6, NOP, 0)]), [Totals::default()]);
    }

    #[test]
    fn a_branch_is_taken_when_something_else_follows() {
        let of_branch = |m0, m0_plus, m4_low, m4_high| Totals {
            instructions: 1,
            m0,
            m0_plus,
            m4_low,
            m4_high,
            ..Totals::default()
        };
        let fallen = regions(&[(0, BEGIN, 0), (2, BNE, 0), (4, END, 0)]);
        let taken = regions(&[(0, BEGIN, 0), (2, BNE, 0), (0x40, END, 0)]);
        assert_eq!((fallen, taken), (vec![of_branch(1, 1, 1, 1)], vec![of_branch(3, 2, 2, 4)]));
    }

    #[test]
    fn a_branch_that_was_not_decided_is_not_carried_into_another_region() {
        let again = regions(&[(0, BEGIN, 0), (2, BNE, 0), (8, BEGIN, 0), (10, NOP, 0), (12, END, 0)]);
        assert_eq!(
            again,
            [Totals { instructions: 1, m0: 1, m0_plus: 1, m4_low: 1, m4_high: 1, ..Totals::default() }]
        );
    }

    #[test]
    fn what_has_no_number_is_told() {
        let [totals] = regions(&[(0, BEGIN, 0), (2, 0xbe00, 0), (4, 0xfb90, 0xf0f1), (8, END, 0)])[..] else {
            panic!("one region")
        };
        assert_eq!((totals.instructions, totals.unknown, totals.m0), (2, 2, 0));
        // BKPT has no bounds, SDIV has
        assert_eq!((totals.m4_low, totals.m4_high, totals.m4_unknown), (2, 12, 1));
    }

    #[test]
    fn a_line_has_all_of_a_region() {
        let totals = Totals {
            instructions: 1,
            m0: 2,
            m0_plus: 3,
            unknown: 4,
            linked: 5,
            m4_low: 6,
            m4_high: 7,
            m4_unknown: 8,
        };
        assert_eq!(totals.to_string(), "1,2,3,4,5,6,7,8");
    }

    #[test]
    fn what_stands_under_an_it_may_be_skipped() {
        // it eq; ldreq r0, [r1]; ldr r0, [r1]
        let [totals] =
            regions(&[(0, BEGIN, 0), (2, 0xbf08, 0), (4, 0x6808, 0), (6, 0x6808, 0), (8, END, 0)])[..]
        else {
            panic!("one region")
        };
        assert_eq!((totals.m4_low, totals.m4_high), (2, 1 + 3 + 3));
    }

    #[test]
    fn a_wide_branch_that_is_not_taken_goes_on_four_bytes_later() {
        let beq = (2, 0xf000, 0x8000);
        let [fallen] = regions(&[(0, BEGIN, 0), beq, (6, END, 0)])[..] else { panic!("one region") };
        let [taken] = regions(&[(0, BEGIN, 0), beq, (4, END, 0)])[..] else { panic!("one region") };
        assert_eq!((fallen.m4_high, taken.m4_high), (1, 4));
    }
}

//! The cycles of each instruction, as the manuals of the processors give them.
//!
//! * Cortex-M0: table 3-1 of the *Cortex-M0 Technical Reference Manual* (ARM DDI 0432C, section 3.3).
//! * Cortex-M0+: table 3-1 of the *Cortex-M0+ Technical Reference Manual* (ARM DDI 0484C, section 3.3).
//!
//! The table of the Cortex-M0 was compared with a copy of the manual. Of the Cortex-M0+, the rows of branches, BL and POP were not: they agree
//! with rp2040js, but for the cycle of the link register that it leaves out.
//!
//! Both tables hold for zero wait states. N is the number of registers, the program counter and the link register included.
//!
//! | instruction | Cortex-M0 | Cortex-M0+ |
//! |---|---|---|
//! | on registers, CPS, SEV, YIELD, NOP | 1 | 1 |
//! | MULS | 1 or 32 | 1 or 32 |
//! | load or store of one register | 2 | 2, or 1 from a single-cycle I/O port |
//! | LDM, STM, PUSH, POP | 1 + N | 1 + N |
//! | POP with the program counter | 4 + N | 3 + N |
//! | B with a condition | 3 if taken, else 1 | 2 if taken, else 1 |
//! | B, BX, BLX, MOV and ADD to the program counter | 3 | 2 |
//! | BL | 4 | 3 |
//! | MRS, MSR, DMB, DSB, ISB | 4 | 3 |
//! | WFE, WFI, without the waiting | 2 | 2 |
//! | SVC, BKPT | not given | not given |
//!
//! Where the tables leave a choice, this is taken:
//!
//! * **The fast multiplier**, 1 cycle. The maker of a chip chooses 1 or 32; RP2040, SAM C20 and LPC800 have the fast one, as their data
//!   sheets say, and so have others. With the small one every MULS costs 31 cycles more.
//! * Loads and stores of the Cortex-M0+ go to memory, 2 cycles: the fluid touches no I/O port.

use crate::instruction::Instruction;

/// What differs from one processor to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timing {
    /// What a branch that is taken costs.
    branch: u32,
    /// What BL costs.
    call: u32,
    /// What POP with the program counter costs besides one cycle a register.
    return_: u32,
    /// What MRS, MSR and a barrier cost.
    system: u32,
}

/// Cortex-M0 with the fast multiplier.
pub const CORTEX_M0: Timing = Timing { branch: 3, call: 4, return_: 4, system: 4 };

/// Cortex-M0+ with the fast multiplier.
pub const CORTEX_M0_PLUS: Timing = Timing { branch: 2, call: 3, return_: 3, system: 3 };

impl Timing {
    /// The cycles that an instruction takes; `taken` is whether a branch with a condition is taken, and means nothing for others.
    pub fn cycles(&self, instruction: Instruction, taken: bool) -> u32 {
        match instruction {
            Instruction::Simple | Instruction::Multiply => 1,
            Instruction::Access | Instruction::Wait => 2,
            Instruction::Multiple(registers) => 1 + u32::from(registers),
            Instruction::Return(registers) => self.return_ + u32::from(registers),
            Instruction::Conditional if !taken => 1,
            Instruction::Conditional | Instruction::Branch => self.branch,
            Instruction::Call => self.call,
            Instruction::System => self.system,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Instruction::*;

    #[test]
    fn the_numbers_are_those_of_the_manuals() {
        let known = [
            (Simple, false, 1, 1),
            (Multiply, false, 1, 1),
            (Access, false, 2, 2),
            (Multiple(1), false, 2, 2),
            (Multiple(8), false, 9, 9),
            (Return(1), false, 5, 4),
            (Return(5), false, 9, 8),
            (Conditional, false, 1, 1),
            (Conditional, true, 3, 2),
            (Branch, false, 3, 2),
            (Call, false, 4, 3),
            (System, false, 4, 3),
            (Wait, false, 2, 2),
        ];
        for (instruction, taken, m0, m0_plus) in known {
            let cycles = [CORTEX_M0, CORTEX_M0_PLUS].map(|timing| timing.cycles(instruction, taken));
            assert_eq!(cycles, [m0, m0_plus], "{instruction:?}");
        }
    }

    #[test]
    fn only_a_condition_asks_whether_it_is_taken() {
        for instruction in [Simple, Multiply, Access, Multiple(3), Return(3), Branch, Call, System, Wait] {
            for timing in [CORTEX_M0, CORTEX_M0_PLUS] {
                assert_eq!(timing.cycles(instruction, true), timing.cycles(instruction, false));
            }
        }
    }
}

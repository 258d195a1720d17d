//! The instructions of ARMv6-M, as far as the tables of cycles tell them apart.
//!
//! The encodings are those of chapter A5 of the ARMv6-M Architecture Reference Manual (ARM DDI 0419).

/// What an instruction costs depends on this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instruction {
    /// Works on registers alone, or is a hint that does nothing.
    Simple,
    /// MULS.
    Multiply,
    /// Loads or stores one register.
    Access,
    /// LDM, STM, PUSH, or POP without the program counter: the number of registers.
    Multiple(u8),
    /// POP with the program counter: the number of registers, the program counter included.
    Return(u8),
    /// B with a condition.
    Conditional,
    /// Always goes elsewhere: B, BX, BLX, and MOV and ADD to the program counter.
    Branch,
    /// BL.
    Call,
    /// MRS, MSR and the barriers DMB, DSB and ISB.
    System,
    /// WFE and WFI, the time of waiting excluded.
    Wait,
}

/// Whether an instruction that begins with this halfword has a second one.
pub fn is_wide(first: u16) -> bool {
    first >> 11 >= 0b11101
}

/// Decodes an instruction; a narrow one has any second halfword.
///
/// `None` is what the manuals give no number of cycles (SVC, BKPT and UDF, whose cost depends on the core's configuration), and what is
/// not in ARMv6-M.
pub fn decode(first: u16, second: u16) -> Option<Instruction> {
    use Instruction::*;
    let registers = (first & 0xff).count_ones() as u8;
    Some(match first >> 11 {
        // shifts, sums, moves and comparisons with immediate values
        0b00000..=0b00111 => Simple,
        0b01000 => return on_registers(first),
        // from a literal, by a register, by an immediate value, and on the stack
        0b01001..=0b10011 => Access,
        // addresses from the program counter and from the stack pointer
        0b10100 | 0b10101 => Simple,
        0b10110 | 0b10111 => return miscellaneous(first, registers),
        0b11000 | 0b11001 => Multiple(registers),
        0b11010 | 0b11011 => match first >> 8 & 0xf {
            0b1110 | 0b1111 => return None,
            _ => Conditional,
        },
        0b11100 => Branch,
        _ => return wide(first, second),
    })
}

/// Arithmetic on two registers, and what works on all sixteen of them.
fn on_registers(first: u16) -> Option<Instruction> {
    let is_program_counter = first & 0b1000_0111 == 0b1000_0111;
    match first >> 8 & 0b111 {
        0b000..=0b010 => Some(Instruction::Simple),
        0b011 if first >> 6 & 0b11 == 0b01 => Some(Instruction::Multiply),
        0b011 | 0b101 => Some(Instruction::Simple),
        0b100 | 0b110 if is_program_counter => Some(Instruction::Branch),
        0b100 | 0b110 => Some(Instruction::Simple),
        _ => Some(Instruction::Branch),
    }
}

/// The stack pointer, extension, reversal, PUSH, POP, CPS and hints.
fn miscellaneous(first: u16, registers: u8) -> Option<Instruction> {
    match first >> 8 & 0xf {
        0b0000 | 0b0010 | 0b0110 | 0b1010 => Some(Instruction::Simple),
        0b0100 => Some(Instruction::Multiple(registers)),
        0b0101 => Some(Instruction::Multiple(registers + 1)),
        0b1100 => Some(Instruction::Multiple(registers)),
        0b1101 => Some(Instruction::Return(registers + 1)),
        0b1111 => match first & 0xff {
            0x20 | 0x30 => Some(Instruction::Wait),
            hint if hint & 0xf == 0 => Some(Instruction::Simple),
            _ => None, // IT
        },
        _ => None,
    }
}

/// The few instructions of two halfwords.
fn wide(first: u16, second: u16) -> Option<Instruction> {
    if first >> 11 != 0b11110 || second >> 15 == 0 {
        None
    } else if second & 0xd000 == 0xd000 {
        Some(Instruction::Call)
    } else if second & 0xd000 == 0x8000 && matches!(first & 0xfff0, 0xf380 | 0xf3b0 | 0xf3e0) {
        Some(Instruction::System)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::Instruction::*;
    use super::*;

    /// Encodings as `arm-none-eabi-as` writes them.
    const KNOWN: [(u16, u16, &str, Option<Instruction>); 58] = [
        (0x2105, 0, "movs r1, #5", Some(Simple)),
        (0x4608, 0, "mov r0, r1", Some(Simple)),
        (0x46c9, 0, "mov r9, r9", Some(Simple)),
        (0x4697, 0, "mov pc, r2", Some(Branch)),
        (0x46bd, 0, "mov sp, r7", Some(Simple)),
        (0x1c48, 0, "adds r0, r1, #1", Some(Simple)),
        (0x4488, 0, "add r8, r1", Some(Simple)),
        (0x4487, 0, "add pc, r0", Some(Branch)),
        (0x4148, 0, "adcs r0, r1", Some(Simple)),
        (0xb082, 0, "sub sp, #8", Some(Simple)),
        (0xa801, 0, "add r0, sp, #4", Some(Simple)),
        (0xa001, 0, "adr r0, .+8", Some(Simple)),
        (0x4348, 0, "muls r0, r1", Some(Multiply)),
        (0x4388, 0, "bics r0, r1", Some(Simple)),
        (0x4308, 0, "orrs r0, r1", Some(Simple)),
        (0x43c8, 0, "mvns r0, r1", Some(Simple)),
        (0x2805, 0, "cmp r0, #5", Some(Simple)),
        (0x4548, 0, "cmp r0, r9", Some(Simple)),
        (0x45bf, 0, "cmp pc, r7", Some(Simple)),
        (0x42c8, 0, "cmn r0, r1", Some(Simple)),
        (0x0088, 0, "lsls r0, r1, #2", Some(Simple)),
        (0x41c8, 0, "rors r0, r1", Some(Simple)),
        (0x4801, 0, "ldr r0, [pc, #4]", Some(Access)),
        (0x5888, 0, "ldr r0, [r1, r2]", Some(Access)),
        (0x5688, 0, "ldrsb r0, [r1, r2]", Some(Access)),
        (0x6848, 0, "ldr r0, [r1, #4]", Some(Access)),
        (0x6048, 0, "str r0, [r1, #4]", Some(Access)),
        (0x7048, 0, "strb r0, [r1, #1]", Some(Access)),
        (0x8848, 0, "ldrh r0, [r1, #2]", Some(Access)),
        (0x9801, 0, "ldr r0, [sp, #4]", Some(Access)),
        (0x9001, 0, "str r0, [sp, #4]", Some(Access)),
        (0xc90d, 0, "ldm r1!, {r0, r2, r3}", Some(Multiple(3))),
        (0xc10d, 0, "stm r1!, {r0, r2, r3}", Some(Multiple(3))),
        (0xb470, 0, "push {r4, r5, r6}", Some(Multiple(3))),
        (0xb570, 0, "push {r4, r5, r6, lr}", Some(Multiple(4))),
        (0xbc70, 0, "pop {r4, r5, r6}", Some(Multiple(3))),
        (0xbd70, 0, "pop {r4, r5, r6, pc}", Some(Return(4))),
        (0xbd00, 0, "pop {pc}", Some(Return(1))),
        (0xd0fe, 0, "beq .", Some(Conditional)),
        (0xddfe, 0, "ble .", Some(Conditional)),
        (0xdefe, 0, "udf #254", None),
        (0xdf00, 0, "svc #0", None),
        (0xe7fe, 0, "b .", Some(Branch)),
        (0x4770, 0, "bx lr", Some(Branch)),
        (0x4780, 0, "blx r0", Some(Branch)),
        (0xf000, 0xf800, "bl .+4", Some(Call)),
        (0xf7ff, 0xfffe, "bl .", Some(Call)),
        (0xb2c8, 0, "uxtb r0, r1", Some(Simple)),
        (0xba08, 0, "rev r0, r1", Some(Simple)),
        (0xb672, 0, "cpsid i", Some(Simple)),
        (0xbe00, 0, "bkpt #0", None),
        (0xbf00, 0, "nop", Some(Simple)),
        (0xbf20, 0, "wfe", Some(Wait)),
        (0xbf08, 0, "it eq", None),
        (0xf3ef, 0x8010, "mrs r0, primask", Some(System)),
        (0xf380, 0x8810, "msr primask, r0", Some(System)),
        (0xf3bf, 0x8f4f, "dsb sy", Some(System)),
        (0xfb90, 0xf0f1, "sdiv r0, r0, r1, of ARMv7-M", None),
    ];

    #[test]
    fn what_an_assembler_writes_is_decoded() {
        for (first, second, text, expected) in KNOWN {
            assert_eq!(decode(first, second), expected, "{text}");
        }
    }

    #[test]
    fn an_instruction_is_wide_as_the_architecture_says() {
        for (first, _, text, _) in KNOWN {
            let wide = ["bl ", "mrs", "msr", "dsb", "sdiv"].iter().any(|name| text.starts_with(name));
            assert_eq!(is_wide(first), wide, "{text}");
        }
    }

    #[test]
    fn every_halfword_can_be_asked_for() {
        for first in 0..=u16::MAX {
            for second in [0, 0x8000, 0xd000, 0xffff] {
                let found = decode(first, second);
                assert!(found != Some(Call) || is_wide(first));
            }
        }
    }
}

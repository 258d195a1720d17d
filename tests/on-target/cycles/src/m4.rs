//! A lower and an upper bound of the cycles of a Cortex-M4 with floating point; it has a pipeline, which is not modelled here.
//!
//! Source: tables 3-1 and 7-1 of the *Cortex-M4 Technical Reference Manual* (ARM DDI 0439, later ARM 100166), for zero wait states, and
//! what its sections on load and store timings and on the floating-point unit say of instructions beside each other.
//!
//! The rows were not all compared with the manual: a bound that decides something is worth a look there.
//!
//! | instruction | at least | at most |
//! |---|---|---|
//! | on registers, products of any length | 1 | 1 |
//! | IT | 0, folded into the one before | 1 |
//! | SDIV, UDIV | 2 | 12 |
//! | load or store of a register, also VLDR and VSTR | 1, beside another one | 2, 1 more for a dependent address, 1 more for a literal |
//! | of several registers, also LDRD, STRD, VLDM, VPUSH | 1 + N | 2 + N |
//! | to the program counter | P more, P = 1 | P more, P = 3 |
//! | a branch that is taken, BL, BX, BLX | 1 + P, P = 1 | 1 + P, P = 3 |
//! | a branch that is not taken | 1 | 1 |
//! | TBB, TBH | 2 + P, P = 1 | 6, 1 more for a dependent address |
//! | VMLA, VFMA and their kin | 3 | 3, 1 more if the next one takes the result |
//! | VDIV, VSQRT | 1, if no floating point follows | 14, 1 more if the next one takes the result |
//! | other floating point | 1 | 1, 1 more if the next one takes the result |
//! | VMOV of two registers | 2 | 2 |
//! | MRS, MSR, CPS | 1 | 2 |
//! | barriers, hints that wait, exceptions | not bounded | |
//!
//! What stands under an IT may be skipped, in 1 cycle.

use crate::instruction::{self, Instruction};

/// Cycles, at least and at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bounds {
    /// Never fewer.
    pub low: u32,
    /// Never more.
    pub high: u32,
}

const fn bounds(low: u32, high: u32) -> Option<Bounds> {
    Some(Bounds { low, high })
}

/// A branch that is not taken.
pub const NOT_TAKEN: Bounds = Bounds { low: 1, high: 1 };

const BRANCH: Option<Bounds> = bounds(2, 4);

/// Loads or stores `n` registers, perhaps the program counter among them.
const fn several(n: u32, to_program_counter: bool) -> Option<Bounds> {
    if to_program_counter { bounds(2 + n, 5 + n) } else { bounds(1 + n, 2 + n) }
}

/// Loads or stores one register.
const fn single(is_literal: bool) -> Option<Bounds> {
    bounds(1, 3 + is_literal as u32)
}

/// How many of the next instructions an IT makes conditional; 0 for everything else.
pub fn conditional_after(first: u16) -> u32 {
    if first & 0xff00 == 0xbf00 && first & 0xf != 0 { 4 - first.trailing_zeros() } else { 0 }
}

/// Whether it is a branch that is taken or not: B with a condition, CBZ, CBNZ.
pub fn is_conditional(first: u16, second: u16) -> bool {
    let is_wide_one = first >> 11 == 0b11110 && second & 0xd000 == 0x8000 && first >> 6 & 0b1110 != 0b1110;
    instruction::decode(first, second) == Some(Instruction::Conditional) || is_compare(first) || is_wide_one
}

fn is_compare(first: u16) -> bool {
    first & 0xf500 == 0xb100
}

/// The bounds of an instruction, of a branch with a condition when it is taken; `None` for what has none.
pub fn cycles(first: u16, second: u16) -> Option<Bounds> {
    if instruction::is_wide(first) { wide(first, second) } else { narrow(first) }
}

fn narrow(first: u16) -> Option<Bounds> {
    if is_compare(first) {
        return BRANCH;
    }
    if conditional_after(first) > 0 {
        return bounds(0, 1);
    }
    if first & 0xffe8 == 0xb660 {
        return bounds(1, 2); // CPS
    }
    match instruction::decode(first, 0)? {
        Instruction::Simple | Instruction::Multiply => bounds(1, 1),
        Instruction::Access => single(first >> 11 == 0b01001),
        Instruction::Multiple(n) => several(n.into(), false),
        Instruction::Return(n) => several(n.into(), true),
        Instruction::Conditional | Instruction::Branch | Instruction::Call => BRANCH,
        Instruction::System | Instruction::Wait => None,
    }
}

fn wide(first: u16, second: u16) -> Option<Bounds> {
    let is_load = first >> 4 & 1 == 1;
    let is_literal = first & 0xf == 0xf;
    match first >> 8 {
        0xe8 | 0xe9 if first >> 6 & 1 == 0 => several(second.count_ones(), is_load && second >> 15 == 1),
        0xe8 if first & 0xfff0 == 0xe8d0 && second & 0xffe0 == 0xf000 => bounds(3, 7), // TBB, TBH
        0xe8 | 0xe9 => several(2, false),
        0xea | 0xeb | 0xfa => bounds(1, 1),
        0xec..=0xef if second >> 9 & 0b111 == 0b101 => floating(first, second),
        0xf0..=0xf7 if second >> 15 == 0 => bounds(1, 1),
        0xf0..=0xf7 => control(first, second),
        0xf8 | 0xf9 if is_load && second >> 12 == 0xf && first >> 5 & 0b11 == 0b10 => {
            bounds(3, 6 + u32::from(is_literal))
        }
        0xf8 | 0xf9 => single(is_literal),
        0xfb if matches!(first & 0xfff0, 0xfb90 | 0xfbb0) => bounds(2, 12),
        0xfb => bounds(1, 1),
        _ => None,
    }
}

/// Branches, and MRS and MSR.
fn control(first: u16, second: u16) -> Option<Bounds> {
    let is_special = matches!(first & 0xfff0, 0xf380 | 0xf3e0);
    match second & 0xd000 {
        0x8000 if is_special => bounds(1, 2),
        0x8000 if !is_conditional(first, second) => None,
        _ => BRANCH,
    }
}

/// Single precision.
fn floating(first: u16, second: u16) -> Option<Bounds> {
    let is_data_processing = second >> 4 & 1 == 0;
    if first >> 8 >= 0xee {
        if !is_data_processing {
            return bounds(1, 2); // VMOV of one register, VMRS
        }
        return match first >> 4 & 0b1011 {
            0b0000 | 0b0001 | 0b1001 | 0b1010 => bounds(3, 4),
            0b1000 => bounds(1, 15),
            0b1011 if first & 0xf == 1 && second >> 6 & 0b11 == 0b11 => bounds(1, 15),
            _ => bounds(1, 2),
        };
    }
    let registers = u32::from(second & 0xff);
    match first >> 4 & 0b1_1010 {
        0b0_0000 => bounds(2, 2), // VMOV of two registers
        0b1_0000 | 0b1_1000 => single(first & 0xf == 0xf),
        _ => several(registers, false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings as `arm-none-eabi-as -mcpu=cortex-m4 -mfpu=fpv4-sp-d16` writes them.
    const KNOWN: [(u16, u16, &str, u32, u32); 44] = [
        (0x4408, 0, "add r0, r1", 1, 1),
        (0xbf08, 0, "it eq", 0, 1),
        (0xb100, 0, "cbz r0, .+4", 2, 4),
        (0xb900, 0, "cbnz r0, .+4", 2, 4),
        (0xd0fe, 0, "beq .", 2, 4),
        (0x4770, 0, "bx lr", 2, 4),
        (0xf000, 0x8000, "beq.w .+4", 2, 4),
        (0xf000, 0xb800, "b.w .+4", 2, 4),
        (0xf7ff, 0xfffe, "bl .", 2, 4),
        (0x6848, 0, "ldr r0, [r1, #4]", 1, 3),
        (0x4801, 0, "ldr r0, [pc, #4]", 1, 4),
        (0xf8d1, 0x0100, "ldr.w r0, [r1, #256]", 1, 3),
        (0xf8df, 0x0100, "ldr.w r0, [pc, #256]", 1, 4),
        (0xf8c1, 0x0100, "str.w r0, [r1, #256]", 1, 3),
        (0xf851, 0xf022, "ldr.w pc, [r1, r2, lsl #2]", 3, 6),
        (0xf991, 0x0100, "ldrsb.w r0, [r1, #256]", 1, 3),
        (0xe9d1, 0x2300, "ldrd r2, r3, [r1]", 3, 4),
        (0xe9c1, 0x2302, "strd r2, r3, [r1, #8]", 3, 4),
        (0xe8b1, 0x000d, "ldmia.w r1!, {r0, r2, r3}", 4, 5),
        (0xe92d, 0x4ff0, "push {r4-r11, lr}", 10, 11),
        (0xe8bd, 0x8ff0, "pop {r4-r11, pc}", 11, 14),
        (0xbd70, 0, "pop {r4-r6, pc}", 6, 9),
        (0xe8d0, 0xf001, "tbb [r0, r1]", 3, 7),
        (0xeb00, 0x0081, "add.w r0, r0, r1, lsl #2", 1, 1),
        (0xf100, 0x0064, "add.w r0, r0, #100", 1, 1),
        (0xf640, 0x00ff, "movw r0, #2303", 1, 1),
        (0xfa01, 0xf002, "lsl.w r0, r1, r2", 1, 1),
        (0xfb01, 0x0002, "mla r0, r1, r2, r0", 1, 1),
        (0xfb81, 0x0102, "smull r0, r1, r1, r2", 1, 1),
        (0xfb90, 0xf0f1, "sdiv r0, r0, r1", 2, 12),
        (0xfbb0, 0xf0f1, "udiv r0, r0, r1", 2, 12),
        (0xf3ef, 0x8010, "mrs r0, primask", 1, 2),
        (0xee30, 0x0a20, "vadd.f32 s0, s0, s1", 1, 2),
        (0xee20, 0x0a20, "vmul.f32 s0, s0, s1", 1, 2),
        (0xee00, 0x0a20, "vmla.f32 s0, s0, s1", 3, 4),
        (0xeea0, 0x0a20, "vfma.f32 s0, s0, s1", 3, 4),
        (0xee80, 0x0a20, "vdiv.f32 s0, s0, s1", 1, 15),
        (0xeeb1, 0x0ac0, "vsqrt.f32 s0, s0", 1, 15),
        (0xeeb0, 0x0ac0, "vabs.f32 s0, s0", 1, 2),
        (0xee10, 0x0a10, "vmov r0, s0", 1, 2),
        (0xeef1, 0xfa10, "vmrs APSR_nzcv, fpscr", 1, 2),
        (0xed91, 0x0a01, "vldr s0, [r1, #4]", 1, 3),
        (0xec91, 0x0a04, "vldmia r1, {s0-s3}", 5, 6),
        (0xed2d, 0x8b04, "vpush {d8-d9}", 5, 6),
    ];

    #[test]
    fn what_an_assembler_writes_has_its_bounds() {
        for (first, second, text, low, high) in KNOWN {
            assert_eq!(cycles(first, second), bounds(low, high), "{text}");
        }
        assert_eq!(cycles(0xf3bf, 0x8f4f), None, "dsb sy");
        assert_eq!(cycles(0xbe00, 0), None, "bkpt #0");
    }

    #[test]
    fn branches_with_a_condition_are_told_from_others() {
        for (first, second, text, ..) in KNOWN {
            let expected = ["cbz", "cbnz", "beq"].iter().any(|name| text.starts_with(name));
            assert_eq!(is_conditional(first, second), expected, "{text}");
        }
    }

    #[test]
    fn an_it_says_how_many_follow() {
        let found = [0xbf08, 0xbf04, 0xbf0c, 0xbf01, 0xbf00, 0x4408].map(conditional_after);
        assert_eq!(found, [1, 2, 2, 4, 0, 0], "it, itt, ite, itttt, nop, add");
    }
}

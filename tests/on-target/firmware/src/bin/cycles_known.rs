//! Small loops whose cycles are known by hand. Each logs its name, its instructions, and its cycles on a Cortex-M0 and a Cortex-M0+.

#![no_std]
#![no_main]

use core::arch::asm;
use fluisim_firmware::{entry, exit};

/// Logs what is known, then runs instructions between the marks, with operands of `asm!` after a semicolon.
macro_rules! known {
    ($name:literal, $instructions:literal, $m0:literal, $m0_plus:literal: [$($line:literal),+] $($operand:tt)*) => {
        defmt::println!("{=str},{=u32},{=u32},{=u32}", $name, $instructions, $m0, $m0_plus);
        // SAFETY: it writes no register but those that are named, and no memory but that of the words, and balances the stack.
        unsafe { asm!("mov r9, r9", $($line,)+ "mov r10, r10" $($operand)*) };
    };
}

#[entry]
fn main() -> ! {
    straight();
    countdown();
    nested();
    multiply();
    memory();
    multiple();
    call();
    call_by_register();
    save_and_return();
    to_the_program_counter();
    system();
    exit(true)
}

/// Three instructions on registers: 3 cycles.
fn straight() {
    known!("straight", 3, 3, 3: ["movs r0, #1", "adds r0, r0, #2", "nop"], out("r0") _);
}

/// Ten rounds: the preparation 1, ten subtractions 10, nine branches that are taken 9 · 3 or 9 · 2, the last one 1.
fn countdown() {
    known!("countdown", 21, 39, 30: ["movs r0, #10", "2: subs r0, #1", "bne 2b"], out("r0") _);
}

/// Four rounds of five. An inner loop takes 1 + 5 + 4 · 3 + 1 = 19, or 1 + 5 + 4 · 2 + 1 = 15; the outer one 1 + 4 (19 + 1) +
/// 3 · 3 + 1 = 91, or 1 + 4 (15 + 1) + 3 · 2 + 1 = 72. Instructions: 1 + 4 (11 + 2) = 53.
fn nested() {
    known!(
        "nested", 53, 91, 72:
        ["movs r0, #4", "2: movs r1, #5", "3: subs r1, #1", "bne 3b", "subs r0, #1", "bne 2b"],
        out("r0") _, out("r1") _
    );
}

/// A product takes 1 with the fast multiplier: 2 + 8 · (1 + 1) + 7 branches of 3 or 2 + 1, with 26 instructions.
fn multiply() {
    known!(
        "multiply", 26, 40, 33:
        ["movs r0, #8", "movs r1, #3", "2: muls r1, r0, r1", "subs r0, #1", "bne 2b"],
        out("r0") _, out("r1") _
    );
}

/// Seven loads and stores of 2 each.
fn memory() {
    let mut words = [0_u32; 4];
    known!(
        "memory", 7, 14, 14:
        ["ldr r1, [r0]", "str r1, [r0, #4]", "ldrh r1, [r0, #2]", "strb r1, [r0, #8]", "ldrb r1, [r0, r1]",
         "ldr r1, [sp]", "str r1, [r0]"],
        in("r0") words.as_mut_ptr(), out("r1") _
    );
}

/// LDM and STM of three registers 1 + 3 each, PUSH and POP of two 1 + 2 each.
fn multiple() {
    let mut words = [0_u32; 6];
    known!(
        "multiple", 4, 14, 14:
        ["ldm r0!, {{r1, r2, r3}}", "stm r0!, {{r1, r2, r3}}", "push {{r1, r2}}", "pop {{r1, r2}}"],
        inout("r0") words.as_mut_ptr() => _, out("r1") _, out("r2") _, out("r3") _
    );
}

/// BL 4 or 3, BX 3 or 2, B over the function 3 or 2.
fn call() {
    known!("call", 3, 10, 7: ["bl 3f", "b 4f", "3: bx lr", "4:"], out("lr") _);
}

/// BLX 3 or 2 and BX 3 or 2 to and from a function of one NOP.
fn call_by_register() {
    known!("call by register", 3, 7, 5: ["blx r0"], in("r0") nothing as *const () as usize, out("lr") _);
}

/// One NOP and a return.
#[unsafe(naked)]
extern "C" fn nothing() {
    core::arch::naked_asm!("nop", "bx lr")
}

/// BL 4 or 3, PUSH of two registers 1 + 2, POP of two with the program counter 4 + 2 or 3 + 2, B 3 or 2.
fn save_and_return() {
    known!(
        "save and return", 4, 16, 13:
        ["bl 3f", "b 4f", "3: push {{r4, lr}}", "pop {{r4, pc}}", "4:"],
        out("lr") _
    );
}

/// ADR 1, and MOV to the program counter 3 or 2, over a NOP that is not executed.
fn to_the_program_counter() {
    known!(
        "to the program counter", 2, 4, 3:
        ["adr r0, 3f", "mov pc, r0", "nop", ".p2align 2", "3:"],
        out("r0") _
    );
}

/// MRS, MSR, DMB, DSB and ISB of 4 or 3 each, CPSIE of 1.
fn system() {
    known!(
        "system", 6, 21, 16:
        ["mrs r0, primask", "msr primask, r0", "dmb", "dsb", "isb", "cpsie i"],
        out("r0") _
    );
}

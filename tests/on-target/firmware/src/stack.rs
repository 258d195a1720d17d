//! How deep the stack has been: paint what is free of it, then look how much of the paint is gone.

use cortex_m::register::msp;

const PAINT: u32 = 0xc5c5_5c5c;
/// Bytes below the stack pointer that are left to the painter itself.
const SPARED: usize = 256;

unsafe extern "C" {
    /// The end of the static data, from the linker script: the stack may grow down to here.
    static mut __sheap: u32;
    /// Where the stack begins, at the top.
    static _stack_start: u32;
}

/// Paints the free part of the stack.
pub fn paint() {
    let mut word = &raw mut __sheap;
    let end = msp::read() as usize - SPARED;
    while (word as usize) < end {
        // SAFETY: between the static data and the stack pointer nothing lives.
        unsafe {
            word.write_volatile(PAINT);
            word = word.add(1);
        }
    }
}

/// The bytes that the stack has reached since [`paint`], everything from its top on included.
pub fn depth() -> usize {
    let mut word = &raw const __sheap;
    let top = &raw const _stack_start as usize;
    // SAFETY: RAM up to the top of the stack can be read.
    while (word as usize) < top && unsafe { word.read_volatile() } == PAINT {
        word = word.wrapping_add(1);
    }
    top - word as usize
}

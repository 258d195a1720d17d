//! Registers, by their addresses.

/// Polls before something that does not answer is given up: at least 40 ms at 125 MHz.
const PATIENCE: u32 = 1_000_000;

/// Writes a register.
#[inline(always)]
pub(crate) fn write(address: u32, value: u32) {
    // SAFETY: every address in this program is a register of the RP2040, aligned, and written by this core alone.
    unsafe { core::ptr::write_volatile(address as *mut u32, value) }
}

/// Reads a register.
#[inline(always)]
pub(crate) fn read(address: u32) -> u32 {
    // SAFETY: as for `write`.
    unsafe { core::ptr::read_volatile(address as *const u32) }
}

/// Sets bits of a register by its second alias, in one access.
#[inline(always)]
pub(crate) fn set(address: u32, bits: u32) {
    write(address + 0x2000, bits);
}

/// Clears bits of a register by its third alias, in one access.
#[inline(always)]
pub(crate) fn clear(address: u32, bits: u32) {
    write(address + 0x3000, bits);
}

/// Polls until it is so; false where that is given up.
pub(crate) fn wait(mut is_so: impl FnMut() -> bool) -> bool {
    (0..PATIENCE).any(|_| is_so())
}

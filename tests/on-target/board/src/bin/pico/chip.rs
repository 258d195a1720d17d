//! The clock, and what the pins do. Sections are those of the RP2040's data sheet.

use crate::registers::{clear, read, set, wait, write};

/// The processor's clock in Hz: 12 MHz · 125 / 6 / 2.
pub(crate) const CLOCK_HZ: u32 = 125_000_000;

const RESETS: u32 = 0x4000_c000;
const CLOCKS: u32 = 0x4000_8000;
const IO_BANK0: u32 = 0x4001_4000;
const PADS_BANK0: u32 = 0x4001_c000;
const XOSC: u32 = 0x4002_4000;
const PLL_SYS: u32 = 0x4002_8000;
const SIO: u32 = 0xd000_0000;

const OUT_SET: u32 = 0x14;
const OUT_CLEAR: u32 = 0x18;
const DRIVE_SET: u32 = 0x24;
const DRIVE_CLEAR: u32 = 0x28;

const CLK_REF_CTRL: u32 = CLOCKS + 0x30;
const CLK_REF_SELECTED: u32 = CLOCKS + 0x38;
const CLK_SYS_CTRL: u32 = CLOCKS + 0x3c;
const CLK_SYS_SELECTED: u32 = CLOCKS + 0x44;

/// Lets parts of the chip out of reset: bits of RESETS (2.14).
fn release(parts: u32) {
    clear(RESETS, parts);
    wait(|| read(RESETS + 8) & parts == parts);
}

/// From the ring oscillator, which runs after reset, to 125 MHz.
pub(crate) fn start_clock() {
    const PLL_SYS_PART: u32 = 1 << 12;
    // 2.16: the board's crystal has 12 MHz; it may take 1 ms to settle, counted in units of 256 periods
    write(XOSC + 0x0c, 12_000 / 256 + 1);
    write(XOSC, 0xfab << 12 | 0xaa0);
    wait(|| read(XOSC + 4) >> 31 == 1);
    // 2.15: the processor on the reference, and this on the crystal, while the PLL is changed
    clear(CLK_SYS_CTRL, 1);
    wait(|| read(CLK_SYS_SELECTED) == 1);
    write(CLK_REF_CTRL, 2);
    wait(|| read(CLK_REF_SELECTED) == 4);
    // 2.18: 12 MHz · 125 = 1500 MHz within the PLL, divided by 6 and 2
    set(RESETS, PLL_SYS_PART);
    release(PLL_SYS_PART);
    write(PLL_SYS, 1);
    write(PLL_SYS + 8, 125);
    clear(PLL_SYS + 4, 1 << 5 | 1); // power for it and its oscillator
    wait(|| read(PLL_SYS) >> 31 == 1);
    write(PLL_SYS + 0x0c, 6 << 16 | 2 << 12);
    clear(PLL_SYS + 4, 1 << 3); // power for its dividers
    // first which of the other sources, the PLL, then that it is one of them
    write(CLK_SYS_CTRL, 0);
    set(CLK_SYS_CTRL, 1);
    wait(|| read(CLK_SYS_SELECTED) == 2);
}

/// Lets what this program uses out of reset: pins, I²C 0 and DMA.
pub(crate) fn start_parts() {
    release(1 << 8 | 1 << 5 | 1 << 3 | 1 << 2);
}

/// Gives two pins to I²C 0 (2.19): function 3; input on, pull-up, Schmitt trigger, slow edges.
pub(crate) fn join_i2c(sda: u32, scl: u32) {
    for pin in [sda, scl] {
        write(PADS_BANK0 + 4 + 4 * pin, 1 << 6 | 1 << 4 | 1 << 3 | 1 << 1);
    }
    pulse(scl);
    for pin in [sda, scl] {
        write(IO_BANK0 + 4 + 8 * pin, 3);
    }
}

/// Pulls the clock of the bus low nine times: a chip that was being read when this one was reset then lets go of the data line.
fn pulse(scl: u32) {
    let pin = 1 << scl;
    write(SIO + OUT_CLEAR, pin); // low when it is driven, high by the pull-up when not
    write(IO_BANK0 + 4 + 8 * scl, 5);
    for _ in 0..9 {
        for change in [DRIVE_SET, DRIVE_CLEAR] {
            write(SIO + change, pin);
            cortex_m::asm::delay(CLOCK_HZ / 200_000); // 5 µs
        }
    }
}

/// A pin that is driven (2.3.1).
#[derive(Clone, Copy)]
pub(crate) struct Output(u32);

impl Output {
    /// The pin, low: function 5.
    pub(crate) fn new(pin: u32) -> Self {
        let output = Self(1 << pin);
        output.set(false);
        write(SIO + DRIVE_SET, output.0);
        write(IO_BANK0 + 4 + 8 * pin, 5);
        output
    }

    /// High or low.
    pub(crate) fn set(self, high: bool) {
        write(SIO + if high { OUT_SET } else { OUT_CLEAR }, self.0);
    }

    /// High while something is done: for a logic analyser, and for the emulator to count cycles by.
    pub(crate) fn during(self, mut work: impl FnMut()) {
        self.set(true);
        work();
        self.set(false);
    }
}

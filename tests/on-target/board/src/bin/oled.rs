//! The same fluid in greys on the display of a Stellaris LM3S6965 board: 128 × 64 pixels of 16 greys, SSD0323, as QEMU has it.
//!
//! The board has no sensor: what one would read is in a table. After as many frames as [`FRAMES`] says it stops and says so.

#![no_std]
#![no_main]

use fluisim_board::{DISPLAY, INSIDE, Pendant};
use static_cell::ConstStaticCell;

/// Where QEMU's loader puts the number of frames, behind what the linker knows of the RAM.
const FRAMES: u32 = 0x2000_fff0;

/// What a sensor reads, and until which frame.
const READINGS: [(u32, [i16; 2]); 3] = [(20, [0, 16384]), (120, [-16384, 0]), (u32::MAX, [0, -16384])];

const RCGC1: u32 = 0x400f_e104;
const RCGC2: u32 = 0x400f_e108;
const PORT_C: u32 = 0x4000_6000;
const PORT_D: u32 = 0x4000_7000;
const SSI0: u32 = 0x4000_8000;
/// In a port: which pins are driven, and which are digital.
const DIRECTION: u32 = 0x400;
const DIGITAL: u32 = 0x51c;
/// Pin 7 of port C: high for pixels, low for commands.
const PIXELS: u32 = 1 << 7;
/// Pin 0 of port D: selects the display.
const SELECT: u32 = 1;
/// In the status of the serial interface: there is room.
const ROOM: u32 = 1 << 1;
/// In the status of the serial interface: it is busy.
const BUSY: u32 = 1 << 4;

/// Writes go on from the first pixel: columns of two pixels, rows; the display is on.
const WINDOW: [u8; 7] = [0x15, 0, 63, 0x75, 0, 63, 0xaf];

static PENDANT: ConstStaticCell<Pendant> = ConstStaticCell::new(Pendant::new());

#[cortex_m_rt::entry]
fn main() -> ! {
    if let Some(pendant) = PENDANT.try_take() {
        start();
        pendant.fill();
        for frame in 0..read(FRAMES) {
            let reading =
                READINGS.iter().find(|(until, _)| frame < *until).map_or([0; 2], |(_, reading)| *reading);
            pendant.step(reading);
            pendant.step(reading);
            pendant.draw();
            send(pendant);
        }
        say(c"shown\n");
    }
    loop {
        cortex_m::asm::wfi();
    }
}

/// Clocks and pins of what is used; the serial interface as a master, 8 bits each, half the processor's clock.
fn start() {
    write(RCGC2, 1 << 3 | 1 << 2);
    write(RCGC1, 1 << 4);
    for (port, pin) in [(PORT_C, PIXELS), (PORT_D, SELECT)] {
        write(port + DIRECTION, pin);
        write(port + DIGITAL, pin);
    }
    set(PORT_D, SELECT, true);
    write(SSI0 + 4, 0);
    write(SSI0 + 0x10, 2);
    write(SSI0, 7);
    write(SSI0 + 4, 1 << 1);
}

/// Sends the picture: a byte is two pixels, the left one in the higher bits.
fn send(pendant: &Pendant) {
    WINDOW.into_iter().for_each(|byte| put(byte, false));
    for y in 0..DISPLAY[1] {
        for x in (0..DISPLAY[0]).step_by(2) {
            put(grey(pendant, x, y) << 4 | grey(pendant, x + 1, y), true);
        }
    }
}

/// One of 16 greys: of the fluid, and of a line about the display.
fn grey(pendant: &Pendant, x: usize, y: usize) -> u8 {
    let [right, bottom] = DISPLAY.map(|pixels| pixels - 1);
    if x == 0 || y == 0 || x == right || y == bottom {
        return 15;
    }
    // outside the picture, which has its first row at the bottom, there is no fluid
    pendant.picture().brightness(x.wrapping_sub(2), (INSIDE[1] + 1).wrapping_sub(y)) >> 4
}

/// Sends a byte, when all before it have been.
fn put(byte: u8, is_pixels: bool) {
    while read(SSI0 + 0xc) & BUSY != 0 {}
    set(PORT_C, PIXELS, is_pixels);
    while read(SSI0 + 0xc) & ROOM == 0 {}
    write(SSI0 + 8, byte.into());
    read(SSI0 + 8); // what came in meanwhile is nothing
}

/// Drives a pin: a port's data has an address for each choice of pins.
fn set(port: u32, pin: u32, high: bool) {
    write(port + (pin << 2), if high { pin } else { 0 });
}

/// Tells the emulator, by semihosting's call to write a text.
fn say(text: &core::ffi::CStr) {
    // SAFETY: the call reads the text, which ends with a zero.
    unsafe {
        core::arch::asm!("bkpt 0xab", inout("r0") 4 => _, in("r1") text.as_ptr(), options(readonly, nostack))
    }
}

fn write(address: u32, value: u32) {
    // SAFETY: every address is a register of the LM3S6965.
    unsafe { core::ptr::write_volatile(address as *mut u32, value) }
}

fn read(address: u32) -> u32 {
    // SAFETY: every address is a register of the LM3S6965, or the word that the loader fills.
    unsafe { core::ptr::read_volatile(address as *const u32) }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        cortex_m::asm::wfi();
    }
}

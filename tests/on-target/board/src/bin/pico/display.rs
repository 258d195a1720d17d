//! The display SSD1306, 128 × 64 pixels.

use crate::bus::{Bus, NoAnswer, STOP, Words};
use fluisim_board::{DISPLAY, INSIDE, Pendant};

const ADDRESS: u8 = 0x3c;
/// Before commands.
const COMMANDS: u8 = 0x00;
/// Before pixels.
const PIXELS: u16 = 0x40;

/// Sets it up, and leaves it dark until there is a picture.
#[rustfmt::skip]
const START: [u8; 25] = [
    COMMANDS,
    0xae,             // off
    0xd5, 0x80,       // its own clock
    0xa8, 63,         // 64 rows
    0xd3, 0, 0x40,    // from row 0
    0x8d, 0x14,       // makes the voltage of the pixels itself
    0x20, 0,          // bytes go along a row of bytes, then to the next row
    0xa1, 0xc8,       // the connector is at the top
    0xda, 0x12,       // how rows are wired
    0x81, 0x7f,       // half as bright as can be
    0xd9, 0xf1,       // charge
    0xdb, 0x40,       // and level of a row
    0xa4, 0xa6,       // what is in its memory, 1 is light
];

/// The next byte is the first of all, and the display is on.
const WINDOW: [u8; 8] = [COMMANDS, 0x21, 0, 127, 0x22, 0, 7, 0xaf];

/// Sets the display up.
pub(crate) fn start(bus: &mut Bus) -> Result<(), NoAnswer> {
    bus.write(ADDRESS, &START)
}

/// Begins to send a picture.
pub(crate) fn begin(bus: &mut Bus, words: &'static mut Words) {
    let _ = bus.write(ADDRESS, &WINDOW); // a display that does not answer is no reason to stop
    bus.begin(ADDRESS, words);
}

/// Puts the picture into words for the bus: a byte is eight pixels, the lowest bit at the top.
pub(crate) fn pack(pendant: &Pendant, words: &mut Words) {
    let [first, pixels @ ..] = words;
    *first = PIXELS;
    let lamps = pendant.picture().lamps();
    for (page, bytes) in pixels.chunks_exact_mut(DISPLAY[0]).enumerate() {
        frame(page, bytes);
        let [_, _, inside @ .., _, _] = bytes else { continue };
        for bit in 0..8 {
            // the display's rows go down from the frame's upper lines, the picture's up
            let row = (INSIDE[1] + 1).wrapping_sub(8 * page + bit);
            for (byte, lit) in inside.iter_mut().zip(lamps.get(row).into_iter().flatten()) {
                *byte |= u16::from(*lit) << bit;
            }
        }
    }
    if let Some(last) = pixels.last_mut() {
        *last |= STOP;
    }
}

/// A row of bytes with its part of the line about the display, and nothing else.
fn frame(page: usize, bytes: &mut [u16]) {
    bytes.fill(match page {
        0 => 0x01,
        7 => 0x80,
        _ => 0,
    });
    if let [first, .., last] = bytes {
        (*first, *last) = (0xff, 0xff);
    }
}

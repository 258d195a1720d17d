//! I²C 0 as the only master (4.3), and a channel of DMA that feeds it (2.5).

use crate::chip::CLOCK_HZ;
use crate::registers::{read, wait, write};
use core::sync::atomic::{Ordering, compiler_fence};

const I2C0: u32 = 0x4004_4000;
const CON: u32 = I2C0;
const TAR: u32 = I2C0 + 0x04;
const DATA_CMD: u32 = I2C0 + 0x10;
const FS_SCL_HCNT: u32 = I2C0 + 0x1c;
const FS_SCL_LCNT: u32 = I2C0 + 0x20;
const RAW_INTR_STAT: u32 = I2C0 + 0x34;
const CLR_TX_ABRT: u32 = I2C0 + 0x54;
const CLR_STOP_DET: u32 = I2C0 + 0x60;
const ENABLE: u32 = I2C0 + 0x6c;
const STATUS: u32 = I2C0 + 0x70;
const SDA_HOLD: u32 = I2C0 + 0x7c;
const DMA_CR: u32 = I2C0 + 0x88;
const DMA_TDLR: u32 = I2C0 + 0x8c;
const FS_SPKLEN: u32 = I2C0 + 0xa0;

/// In a word for the bus: read a byte.
const READ: u16 = 1 << 8;
/// In a word for the bus: after this byte, stop.
pub(crate) const STOP: u16 = 1 << 9;
/// In a word for the bus: before this byte, start again.
const RESTART: u16 = 1 << 10;

const TX_ABRT: u32 = 1 << 6;
const STOP_DET: u32 = 1 << 9;

/// Channel 0.
const DMA: u32 = 0x5000_0000;

/// The frequency of the bus: the fastest that the data sheets of the sensor and the display allow.
const BUS_HZ: u32 = 400_000;
/// Pulses shorter than 50 ns are taken for noise.
const SPIKE: u32 = CLOCK_HZ / 20_000_000 + 1;
/// The clock is low for so many periods and one more: 1.5 µs, where 1.3 are asked for.
const LOW: u32 = CLOCK_HZ / 1_000_000 * 3 / 2;
/// It is high for so many, and for 7 more and those of a spike: together a period of the bus.
const HIGH: u32 = CLOCK_HZ / BUS_HZ - (LOW + 1) - (SPIKE + 7);

/// Nobody is at the address, or the bus is stuck.
pub(crate) struct NoAnswer;

/// A transfer's words, which DMA copies to the bus.
pub(crate) type Words = [u16; 1025];

/// The bus, and the words that are on their way.
pub(crate) struct Bus {
    sending: Option<&'static mut Words>,
}

impl Bus {
    /// The bus, whose pins and parts have been started.
    pub(crate) fn start() -> Self {
        write(ENABLE, 0);
        // a master, fast mode, may start again, no slave, waits for each byte to be sent before it asks for the next
        write(CON, 1 << 8 | 1 << 6 | 1 << 5 | 2 << 1 | 1);
        write(FS_SCL_LCNT, LOW);
        write(FS_SCL_HCNT, HIGH);
        write(FS_SPKLEN, SPIKE);
        write(SDA_HOLD, CLOCK_HZ / 10_000_000 * 3 + 3); // 300 ns after the clock has fallen
        write(DMA_TDLR, 8); // asks for more when 8 words are left
        write(DMA_CR, 1 << 1);
        write(ENABLE, 1);
        Self { sending: None }
    }

    /// Sends bytes to an address.
    pub(crate) fn write(&mut self, address: u8, bytes: &[u8]) -> Result<(), NoAnswer> {
        self.finish();
        talk_to(address);
        for (place, byte) in bytes.iter().enumerate() {
            let stop = if place + 1 == bytes.len() { STOP } else { 0 };
            push(u16::from(*byte) | stop);
        }
        end()
    }

    /// Reads from a register of the chip at an address.
    pub(crate) fn read<const N: usize>(&mut self, address: u8, register: u8) -> Result<[u8; N], NoAnswer> {
        self.finish();
        talk_to(address);
        push(register.into());
        for place in 0..N {
            let again = if place == 0 { RESTART } else { 0 };
            push(READ | again | if place + 1 == N { STOP } else { 0 });
        }
        end()?;
        Ok([0; N].map(|_: u8| read(DATA_CMD) as u8))
    }

    /// Begins to send words to an address and returns at once.
    pub(crate) fn begin(&mut self, address: u8, words: &'static mut Words) {
        self.finish();
        talk_to(address);
        let words = self.sending.insert(words);
        compiler_fence(Ordering::SeqCst); // the words are in memory before the channel is told
        write(DMA, words.as_ptr() as u32);
        write(DMA + 4, DATA_CMD);
        write(DMA + 8, words.len() as u32);
        // asked for by I²C 0 (32), no interrupt, no other channel after it, reading on, 16 bits each, go
        write(DMA + 0x0c, 1 << 21 | 32 << 15 | 1 << 4 | 1 << 2 | 1);
    }

    /// Waits until what has begun is sent, and gives its words back; None where nothing had.
    pub(crate) fn finish(&mut self) -> Option<&'static mut Words> {
        let words = self.sending.take()?;
        wait(|| read(DMA + 0x0c) >> 24 & 1 == 0);
        let _ = end(); // a display that does not answer is no reason to stop
        compiler_fence(Ordering::SeqCst);
        Some(words)
    }
}

/// Says whom the next words are for, and forgets what has been.
fn talk_to(address: u8) {
    write(ENABLE, 0);
    write(TAR, address.into());
    write(ENABLE, 1);
    read(CLR_TX_ABRT);
    read(CLR_STOP_DET);
}

/// Hands a word to the bus when there is room.
fn push(word: u16) {
    wait(|| read(STATUS) & 1 << 1 != 0);
    write(DATA_CMD, word.into());
}

/// Waits until the bus has stopped.
fn end() -> Result<(), NoAnswer> {
    let stopped = wait(|| read(RAW_INTR_STAT) & STOP_DET != 0);
    if stopped && read(RAW_INTR_STAT) & TX_ABRT == 0 { Ok(()) } else { Err(NoAnswer) }
}

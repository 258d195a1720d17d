//! A pendant on a Raspberry Pi Pico: fluid on an SSD1306 that runs to the side that an LIS3DH says is down.
//!
//! A frame is sent by DMA while the next is computed, and the processor sleeps for what is left of its time.

#![no_std]
#![no_main]

mod bus;
mod chip;
mod display;
mod registers;
mod sensor;

use bus::{Bus, Words};
use chip::{CLOCK_HZ, Output};
use core::sync::atomic::{AtomicBool, Ordering};
use fluisim_board::Pendant;
use sensor::Sensor;
use static_cell::ConstStaticCell;

/// Frames a second: sending one takes 23.4 of the 25 ms.
const RATE: u32 = 40;
/// Steps of the fluid a frame.
const STEPS: u32 = 2;
/// Pins of the bus.
const SDA: u32 = 4;
const SCL: u32 = 5;
/// Pins that are high while the fluid moves, and while it is drawn.
const MOVES: u32 = 2;
const IS_DRAWN: u32 = 3;
/// The board's own lamp: on where no sensor answers.
const LAMP: u32 = 25;
/// What a sensor reads that lies upright.
const UPRIGHT: [i16; 2] = [0, 16384];

static PENDANT: ConstStaticCell<Pendant> = ConstStaticCell::new(Pendant::new());
/// A frame that is sent, and one that is made.
static WORDS: [ConstStaticCell<Words>; 2] = [const { ConstStaticCell::new([0; 1025]) }; 2];
/// Whether a frame is due.
static IS_DUE: AtomicBool = AtomicBool::new(false);

/// What the boot ROM runs first: it makes the flash readable, and goes on to the vectors behind it.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[cortex_m_rt::entry]
fn main() -> ! {
    chip::start_clock();
    chip::start_parts();
    chip::join_i2c(SDA, SCL);
    let mut bus = Bus::start();
    let lamp = Output::new(LAMP);
    let sensor = Sensor::start(&mut bus).ok();
    lamp.set(sensor.is_none());
    let _ = display::start(&mut bus); // a display that does not answer is no reason to stop
    start_ticks();
    if let (Some(pendant), Some(first), Some(second)) =
        (PENDANT.try_take(), WORDS[0].try_take(), WORDS[1].try_take())
    {
        run(pendant, [first, second], bus, sensor);
    }
    loop {
        cortex_m::asm::wfe();
    }
}

/// Frame after frame.
fn run(pendant: &mut Pendant, words: [&'static mut Words; 2], mut bus: Bus, sensor: Option<Sensor>) {
    let (moves, is_drawn) = (Output::new(MOVES), Output::new(IS_DRAWN));
    let [mut next, spare] = words;
    let mut spare = Some(spare);
    let mut tilt = UPRIGHT;
    pendant.fill();
    loop {
        is_drawn.during(|| {
            pendant.draw();
            display::pack(pendant, next);
        });
        wait_for_frame();
        let Some(free) = bus.finish().or_else(|| spare.take()) else { return };
        if let Some(Ok(reading)) = sensor.as_ref().map(|sensor| sensor.read(&mut bus)) {
            tilt = reading;
        }
        display::begin(&mut bus, next);
        next = free;
        moves.during(|| (0..STEPS).for_each(|_| pendant.step(tilt)));
    }
}

/// Sleeps until a frame is due. The interrupt leaves an event, so that one that comes before the sleep ends it at once.
fn wait_for_frame() {
    while !IS_DUE.load(Ordering::Relaxed) {
        cortex_m::asm::wfe();
    }
    IS_DUE.store(false, Ordering::Relaxed); // however late it is: frames are not made up for
}

/// Lets the processor's timer interrupt it once a frame.
fn start_ticks() {
    use cortex_m::peripheral::{Peripherals, syst::SystClkSource};
    if let Some(mut peripherals) = Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(CLOCK_HZ / RATE - 1);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
        peripherals.SYST.enable_interrupt();
    }
}

#[cortex_m_rt::exception]
fn SysTick() {
    IS_DUE.store(true, Ordering::Relaxed);
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        cortex_m::asm::wfe();
    }
}

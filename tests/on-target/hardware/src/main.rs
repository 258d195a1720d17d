//! Sixty frames a second on a microcontroller: a timer's interrupt keeps the time and reads the input, the main loop computes.
//!
//! The interrupt and the main loop share two words and nothing else. The simulation belongs to the main loop, which may be
//! interrupted anywhere in a frame; no interrupt is held off for longer than it takes to copy the input.

#![no_std]
#![no_main]

mod simulation;

use core::cell::Cell;
use core::sync::atomic::{AtomicU32, Ordering};
use critical_section::Mutex;
use defmt_rtt as _;
use simulation::Simulation;
use static_cell::ConstStaticCell;

include!(concat!(env!("OUT_DIR"), "/clock.rs"));

/// Frames a second.
const RATE: u32 = 60;

/// Known when the program is compiled, and checked then.
const _: () = assert!(Simulation::BYTES <= 4 * 1024);

/// Made by the linker in `.bss`, never on the stack.
static SIMULATION: ConstStaticCell<Simulation> = ConstStaticCell::new(Simulation::new());
/// Frames that the timer has asked for. Written by the interrupt alone, so that no read-modify-write has to be atomic.
static FRAMES: AtomicU32 = AtomicU32::new(0);
/// What the interrupt has read from a sensor last: more than a word, hence behind a critical section.
static PUSH: Mutex<Cell<[i16; 2]>> = Mutex::new(Cell::new([0; 2]));

/// Once a frame, in the interrupt.
fn tick() {
    let frame = FRAMES.load(Ordering::Relaxed).wrapping_add(1);
    FRAMES.store(frame, Ordering::Relaxed);
    // stands for a sensor: to and fro, a second each
    let push = if frame / RATE % 2 == 0 { 8 } else { -8 };
    critical_section::with(|section| PUSH.borrow(section).set([push, 0]));
}

fn run() -> ! {
    if let Some(simulation) = SIMULATION.try_take() {
        let mut done = 0;
        loop {
            let frame = FRAMES.load(Ordering::Relaxed);
            if frame == done {
                wait();
                continue;
            }
            if frame != done.wrapping_add(1) {
                defmt::warn!("{=u32} frames left out", frame.wrapping_sub(done).wrapping_sub(1));
            }
            done = frame;
            let push = critical_section::with(|section| PUSH.borrow(section).get());
            match simulation.frame(push) {
                Ok(density) if frame % RATE == 0 => defmt::info!("largest density {}", density),
                Ok(_) => {}
                Err(error) => defmt::error!("{}", error),
            }
        }
    }
    stop()
}

#[cfg(target_arch = "arm")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use cortex_m::peripheral::{Peripherals, syst::SystClkSource};
    if let Some(mut peripherals) = Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(CLOCK_HZ / RATE - 1);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
        peripherals.SYST.enable_interrupt();
    }
    run()
}

#[cfg(target_arch = "arm")]
#[cortex_m_rt::exception]
fn SysTick() {
    tick();
}

/// Sleeps until the next interrupt.
#[cfg(target_arch = "arm")]
fn wait() {
    cortex_m::asm::wfi();
}

#[cfg(target_arch = "riscv32")]
#[riscv_rt::entry]
fn main() -> ! {
    defmt::debug!("clock {=u32} Hz", CLOCK_HZ);
    run()
}

/// The ESP32-C3's timers belong to its board crate: here the next frame begins when the last is done.
#[cfg(target_arch = "riscv32")]
fn wait() {
    tick();
}

fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    defmt::error!("panic");
    stop()
}

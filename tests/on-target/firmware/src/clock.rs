//! Counts instructions: exactly under QEMU's `-icount shift=0`, where every instruction takes one nanosecond.

/// How many times a piece of work is repeated: SysTick sees 40 instructions at a time.
const REPEATS: u32 = 40;

/// Starts the counter.
#[cfg(target_arch = "arm")]
pub fn start() {
    use cortex_m::peripheral::{Peripherals, syst::SystClkSource};
    if let Some(mut peripherals) = Peripherals::take() {
        peripherals.SYST.set_clock_source(SystClkSource::Core);
        peripherals.SYST.set_reload(0x00ff_ffff);
        peripherals.SYST.clear_current();
        peripherals.SYST.enable_counter();
    }
}

/// Starts the counter.
#[cfg(target_arch = "riscv32")]
pub fn start() {}

/// Instructions since the start, modulo the counter's width.
#[cfg(target_arch = "arm")]
pub fn now() -> u32 {
    // SysTick counts down at 25 MHz
    (0x00ff_ffff - cortex_m::peripheral::SYST::get_current()).wrapping_mul(40)
}

/// Instructions since the start, modulo the counter's width.
#[cfg(target_arch = "riscv32")]
pub fn now() -> u32 {
    riscv::register::minstret::read() as u32
}

/// The instructions from one reading of [`now`] to the next, fewer than the counter's width.
pub fn between(begin: u32, end: u32) -> u32 {
    let taken = end.wrapping_sub(begin);
    if cfg!(target_arch = "arm") { taken % (40 << 24) } else { taken }
}

/// The instructions that one run of the work takes, in tenths.
pub fn tenths(mut work: impl FnMut()) -> u32 {
    let begin = now();
    for _ in 0..REPEATS {
        work();
    }
    let taken = between(begin, now());
    (u64::from(taken) * 10 / u64::from(REPEATS)) as u32
}

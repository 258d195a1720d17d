//! What every firmware here needs: start-up code, a log through semihosting, and an end that QEMU reports.

#![no_std]

pub mod clock;
#[cfg(target_arch = "arm")]
pub mod cycles;
pub mod fluid;
#[cfg(target_arch = "arm")]
pub mod stack;

#[cfg(target_arch = "arm")]
pub use cortex_m_rt::entry;
#[cfg(target_arch = "riscv32")]
pub use riscv_rt::entry;

#[cfg(target_arch = "arm")]
use cortex_m as _;
use defmt_semihosting as _;
#[cfg(target_arch = "riscv32")]
use riscv as _;

/// Ends QEMU with exit status 0 for success.
pub fn exit(success: bool) -> ! {
    semihosting::process::exit(if success { 0 } else { 1 })
}

/// Logs a digest.
pub fn log(item: fluisim_digest::Item) {
    defmt::println!("{}", defmt::Display2Format(&item));
}

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    defmt::error!("{}", defmt::Display2Format(info));
    exit(false)
}

#[cfg(target_arch = "arm")]
#[cortex_m_rt::exception]
unsafe fn HardFault(_frame: &cortex_m_rt::ExceptionFrame) -> ! {
    defmt::error!("hard fault");
    exit(false)
}

#[cfg(target_arch = "riscv32")]
#[unsafe(export_name = "ExceptionHandler")]
fn exception() -> ! {
    defmt::error!("exception");
    exit(false)
}

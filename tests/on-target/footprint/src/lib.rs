//! What the firmwares share: the panic handler, whose symbol betrays a path to a panic, and the typical uses.

#![no_std]

pub mod pendant;
pub mod typical;

#[cfg(target_os = "none")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    panic_is_reachable()
}

/// Linked only where something can panic.
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn panic_is_reachable() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// An entry point that runs `$use` on opaque storage, its RAM being `$Storage` and nothing else.
#[macro_export]
macro_rules! firmware {
    ($Storage:ty, $use:expr) => {
        static mut STORAGE: $Storage = <$Storage>::new();

        #[unsafe(link_section = ".ram_promised")]
        #[used]
        static RAM: u32 = size_of::<$Storage>() as u32;

        #[unsafe(no_mangle)]
        extern "C" fn _start() -> ! {
            // SAFETY: the only code that runs, once.
            let storage = unsafe { &mut *core::hint::black_box(&raw mut STORAGE) };
            let _ = core::hint::black_box($use(storage));
            loop {
                core::hint::spin_loop();
            }
        }
    };
}

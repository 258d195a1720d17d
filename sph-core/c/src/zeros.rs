//! Memory set to zero, as compilers for ARM ask for it: newlib's function takes 160 bytes of flash, this one a fifth. What builds the
//! archives makes it known to them alone, so that a program keeps its own.

use core::arch::asm;

/// Writes `count` zeros. In assembly, or the compiler would see what the loops do and have the function call itself.
///
/// # Safety
/// `to` points to `count` bytes that may be written.
unsafe fn clear(to: *mut u8, count: usize) {
    if count == 0 {
        return;
    }
    // SAFETY: words or bytes are written from the last to the first; words where all there is are words.
    unsafe {
        if (to as usize | count).is_multiple_of(4) {
            asm!("2: subs {n}, #4", "str {zero}, [{to}, {n}]", "bne 2b", to = in(reg) to, n = inout(reg) count => _, zero = in(reg) 0);
        } else {
            asm!("2: subs {n}, #1", "strb {zero}, [{to}, {n}]", "bne 2b", to = in(reg) to, n = inout(reg) count => _, zero = in(reg) 0);
        }
    }
}

macro_rules! clear {
    ($($name:ident)+) => {
        $(
            /// Writes `count` zeros: the name is that of ARM's run-time interface.
            ///
            /// # Safety
            /// As [`clear`].
            #[unsafe(no_mangle)]
            unsafe extern "C" fn $name(to: *mut u8, count: usize) {
                // SAFETY: as this function.
                unsafe { clear(to, count) };
            }
        )+
    };
}

clear! { __aeabi_memclr __aeabi_memclr4 __aeabi_memclr8 }

//! The digests of the fixed scene, for a host of WebAssembly: the module calls `emit` with each line's text.

#![no_std]

use core::fmt::{self, Write};

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    fn write(text: *const u8, length: usize);
}

struct Host;

impl Write for Host {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        // SAFETY: the host reads the bytes of a live string and nothing more.
        unsafe { write(text.as_ptr(), text.len()) };
        Ok(())
    }
}

/// Writes every digest, a line each; true when nothing went wrong.
#[unsafe(no_mangle)]
extern "C" fn digests() -> bool {
    let mut written = Ok(());
    let computed = fluisim_digest::all(|item| written = written.and_then(|()| writeln!(Host, "{item}")));
    computed.is_ok() && written.is_ok()
}

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}

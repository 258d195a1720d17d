//! Writes the memory map of the board, and says how to link for it.

use std::{env, fs, path::PathBuf};

/// The RP2040: its boot ROM runs the first 256 bytes of the flash, which make the rest of it readable.
const RP2040: &str = "MEMORY {
  BOOT2 : ORIGIN = 0x10000000, LENGTH = 0x100
  FLASH : ORIGIN = 0x10000100, LENGTH = 2048K - 0x100
  RAM : ORIGIN = 0x20000000, LENGTH = 256K
}
SECTIONS { .boot2 ORIGIN(BOOT2) : { KEEP(*(.boot2)); } > BOOT2 } INSERT BEFORE .text;
";

/// The LM3S6965, without the last 16 bytes of its RAM, which QEMU's loader fills.
const LM3S6965: &str = "MEMORY {
  FLASH : ORIGIN = 0x00000000, LENGTH = 256K
  RAM : ORIGIN = 0x20000000, LENGTH = 64K - 16
}
";

fn main() {
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets OUT_DIR"));
    let memory = match env::var("TARGET").expect("cargo sets TARGET").as_str() {
        "thumbv6m-none-eabi" => RP2040,
        "thumbv7m-none-eabi" => LM3S6965,
        _ => return, // built for the host, by an editor or by clippy
    };
    fs::write(out.join("memory.x"), memory).expect("OUT_DIR can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=--nmagic");
}

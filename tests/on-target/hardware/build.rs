//! Writes the memory map and the clock of the chip that `FLUISIM_MACHINE` names, and says how to link for it.

use std::{env, fs, path::PathBuf};

/// Flash and RAM, each origin and length, and the processor's clock after reset in Hz.
const CHIPS: [(&str, &str, &str, u32); 5] = [
    ("rp2040", "0x10000100, LENGTH = 2048K - 0x100", "0x20000000, LENGTH = 256K", 6_000_000),
    ("rp2350", "0x10000000, LENGTH = 4096K", "0x20000000, LENGTH = 512K", 11_000_000),
    ("stm32f411", "0x08000000, LENGTH = 512K", "0x20000000, LENGTH = 128K", 16_000_000),
    ("nrf52832", "0x00000000, LENGTH = 512K", "0x20000000, LENGTH = 64K", 64_000_000),
    ("esp32c3", "0x42000000, LENGTH = 4M", "0x3FC80000, LENGTH = 320K", 20_000_000),
];

fn main() {
    println!("cargo::rerun-if-env-changed=FLUISIM_MACHINE");
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets OUT_DIR"));
    let chip = env::var("FLUISIM_MACHINE").unwrap_or_default();
    let chip = CHIPS.iter().find(|(name, ..)| *name == chip);
    let clock = chip.map_or(1, |(.., clock)| *clock);
    fs::write(out.join("clock.rs"), format!("const CLOCK_HZ: u32 = {clock};"))
        .expect("OUT_DIR can be written");
    let Some((name, flash, ram, _)) = chip else {
        return; // built for the host, by an editor or by clippy
    };
    let mut memory = format!("MEMORY {{\n  FLASH : ORIGIN = {flash}\n  RAM : ORIGIN = {ram}\n}}\n");
    if *name == "esp32c3" {
        for (region, place) in [
            ("TEXT", "FLASH"),
            ("RODATA", "FLASH"),
            ("DATA", "RAM"),
            ("BSS", "RAM"),
            ("HEAP", "RAM"),
            ("STACK", "RAM"),
        ] {
            memory += &format!("REGION_ALIAS(\"REGION_{region}\", {place});\n");
        }
        println!("cargo::rustc-link-arg=-Tmemory.x");
    }
    fs::write(out.join("memory.x"), memory).expect("OUT_DIR can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg=-Tlink.x");
    println!("cargo::rustc-link-arg=-Tdefmt.x");
    println!("cargo::rustc-link-arg=--nmagic");
}

//! Writes the memory map of the machine that QEMU emulates, and says how to link for it.

use std::{env, fs, path::PathBuf};

/// The machines and their memory: flash and RAM, each origin and length; and the target that is run on each, unless
/// `FLUISIM_MACHINE` names another machine.
const MACHINES: [(&str, &str, &str, &str); 6] = [
    ("microbit", "0x00000000, LENGTH = 256K", "0x20000000, LENGTH = 16K", "thumbv6m-none-eabi"),
    ("lm3s6965evb", "0x00000000, LENGTH = 256K", "0x20000000, LENGTH = 64K", "thumbv7m-none-eabi"),
    ("mps2-an386", "0x00000000, LENGTH = 4M", "0x20000000, LENGTH = 4M", "thumbv7em-none-eabihf"),
    ("mps2-an505", "0x10000000, LENGTH = 4M", "0x38000000, LENGTH = 4M", "thumbv8m.main-none-eabihf"),
    ("rp2040", "0x10000000, LENGTH = 2M", "0x20000000, LENGTH = 256K", "thumbv6m-none-eabi"), // of rp2040js, not QEMU
    ("virt", "", "0x80000000, LENGTH = 16M", "riscv32imc-unknown-none-elf"),
];

const REGIONS: [&str; 6] = ["TEXT", "RODATA", "DATA", "BSS", "HEAP", "STACK"];

fn main() {
    println!("cargo::rerun-if-env-changed=FLUISIM_MACHINE");
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets OUT_DIR"));
    let triple = env::var("TARGET").expect("cargo sets TARGET");
    let machine = env::var("FLUISIM_MACHINE").ok();
    let is_meant =
        |name: &str, target: &str| machine.as_ref().map_or(target == triple, |machine| name == machine);
    let Some((name, flash, ram, _)) = MACHINES.iter().find(|(name, .., target)| is_meant(name, target))
    else {
        return; // built for the host, by an editor or by clippy
    };
    let mut memory = String::from("MEMORY {\n");
    if *name == "virt" {
        memory += &format!("  RAM : ORIGIN = {ram}\n}}\n");
        for region in REGIONS {
            memory += &format!("REGION_ALIAS(\"REGION_{region}\", RAM);\n");
        }
        println!("cargo::rustc-link-arg=-Tmemory.x");
    } else {
        memory += &format!("  FLASH : ORIGIN = {flash}\n  RAM : ORIGIN = {ram}\n}}\n");
    }
    fs::write(out.join("memory.x"), memory).expect("OUT_DIR can be written");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg=-Tlink.x");
    println!("cargo::rustc-link-arg=-Tdefmt.x");
    println!("cargo::rustc-link-arg=--nmagic");
}

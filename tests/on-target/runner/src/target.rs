//! The processors, and the machine that QEMU stands in for each with.

/// A compilation target and the emulated machine that its firmware runs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Target {
    /// The target's name, as rustc knows it.
    pub(crate) triple: &'static str,
    /// The machine's name, as QEMU and the firmware's build script know it.
    pub(crate) machine: &'static str,
}

/// The smallest first.
pub(crate) const TARGETS: [Target; 5] = [M0, M3, M4F, M33, RV32];

/// Cortex-M0 with 16 KiB of RAM, no floating point, no division.
pub(crate) const M0: Target = Target { triple: "thumbv6m-none-eabi", machine: "microbit" };
/// Cortex-M3.
pub(crate) const M3: Target = Target { triple: "thumbv7m-none-eabi", machine: "lm3s6965evb" };
/// Cortex-M4 with single-precision floating point.
pub(crate) const M4F: Target = Target { triple: "thumbv7em-none-eabihf", machine: "mps2-an386" };
/// Cortex-M33 with single-precision floating point.
pub(crate) const M33: Target = Target { triple: "thumbv8m.main-none-eabihf", machine: "mps2-an505" };
/// RISC-V with multiplication, without floating point.
pub(crate) const RV32: Target = Target { triple: "riscv32imc-unknown-none-elf", machine: "virt" };

impl Target {
    /// The first letters of the triple: thumb or riscv.
    pub(crate) fn architecture(&self) -> &'static str {
        &self.triple[..5]
    }

    /// The program and arguments that emulate the machine.
    pub(crate) fn qemu(&self) -> (&'static str, &'static [&'static str]) {
        match self.machine {
            "virt" => ("qemu-system-riscv32", &["-machine", "virt", "-bios", "none"]),
            "microbit" => ("qemu-system-arm", &["-machine", "microbit"]),
            "lm3s6965evb" => ("qemu-system-arm", &["-machine", "lm3s6965evb"]),
            "mps2-an505" => ("qemu-system-arm", &["-machine", "mps2-an505"]),
            _ => ("qemu-system-arm", &["-machine", "mps2-an386"]),
        }
    }
}

//! What a format costs on a processor: bytes of a particle, instructions of a pair.

use crate::kernel_choice::KernelName;
use crate::named_enum::named_enum;

named_enum! {
    /// A processor whose instructions were counted, see the folder `tests/on-target` of the project.
    Target {
        M0, "m0", "Cortex-M0: no product of 64 bits, no floating point";
        M4f, "m4f", "Cortex-M4F: floating point of 32 bits";
        Rv32, "rv32", "RISC-V with 32-bit integers and products";
    }
}

impl Target {
    /// Its name for the compiler.
    fn triple(self) -> &'static str {
        match self {
            Self::M0 => "thumbv6m-none-eabi",
            Self::M4f => "thumbv7em-none-eabihf",
            Self::Rv32 => "riscv32imc-unknown-none-elf",
        }
    }
}

/// Instructions counted under emulation, by target, scalar, kernel and work.
const COUNTS: &str = include_str!("instructions.csv");

/// Instructions of one pair of particles in reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instructions {
    /// For the density.
    pub density: f64,
    /// For a value's gradient.
    pub gradient: f64,
}

impl Instructions {
    /// Those of a saturating fixed-point number of a word of `bits`, which the position of its binary point does not change;
    /// `None` where they were not counted.
    #[must_use]
    pub fn of(target: Target, kernel: KernelName, bits: u32) -> Option<Self> {
        let scalar = match bits {
            16 => "saturating i4f12",
            32 => "saturating i16f16",
            _ => return None,
        };
        let count = |work: &str| {
            let key = [target.triple(), scalar, kernel.name(), work];
            COUNTS.lines().find_map(|line| {
                let cells: Vec<&str> = line.split(',').collect();
                (cells.len() == 5 && cells[..4] == key).then(|| cells[4].parse().ok())?
            })
        };
        Some(Self {
            density: count("density of a pair in reach")?,
            gradient: count("gradient of a pair in reach")?,
        })
    }
}

/// The narrowest word of the `fixed` crate that holds so many bits.
pub(super) fn word(bits: u32) -> Option<u32> {
    [8, 16, 32, 64].into_iter().find(|&word| bits <= word)
}

/// Bytes of a particle: its coordinates, its volume, and a value for each field, each in a word of so many bits. A mass that all
/// share takes none.
pub(super) fn bytes(bits: u32, dim: usize, fields: usize, has_masses: bool) -> u32 {
    let numbers = dim + 1 + fields + usize::from(has_masses);
    word(bits).unwrap_or(bits).div_ceil(8) * numbers as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_counted_is_found() {
        for &target in Target::ALL {
            let narrow = Instructions::of(target, KernelName::Poly6, 16).unwrap();
            let wide = Instructions::of(target, KernelName::Poly6, 32).unwrap();
            assert!(
                narrow.density > 0.0 && narrow.gradient > narrow.density && wide.density > narrow.density
            );
            assert_eq!(Instructions::of(target, KernelName::Poly6, 64), None);
            assert!(Instructions::of(target, KernelName::WendlandC2, 32).is_some());
        }
    }

    #[test]
    fn a_particle_takes_whole_words() {
        assert_eq!(bytes(13, 2, 1, false), 8);
        assert_eq!(bytes(19, 3, 0, true), 20);
    }
}

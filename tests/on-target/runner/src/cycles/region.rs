//! What the plugin writes.

use anyhow::{Context, Result};

/// A region's line, see `account::Totals` of the plugin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub(crate) instructions: u64,
    /// Cycles on a Cortex-M0.
    pub(crate) m0: u64,
    /// Cycles on a Cortex-M0+.
    pub(crate) m0_plus: u64,
    /// Instructions without a published number for these two.
    pub(crate) unknown: u64,
    /// PUSH with the link register and POP with the program counter.
    pub(crate) linked: u64,
    /// Cycles on a Cortex-M4, at least and at most.
    pub(crate) m4: [u64; 2],
    /// Instructions without bounds for a Cortex-M4.
    pub(crate) m4_unknown: u64,
}

/// The numbers of each line, of which there are `N`.
pub(crate) fn numbers<const N: usize>(text: &str) -> Result<Vec<[u64; N]>> {
    let line = |line: &str| {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<u64>, _>>().ok();
        numbers
            .and_then(|numbers| numbers.try_into().ok())
            .with_context(|| format!("expected {N} numbers, got {line:?}"))
    };
    text.lines().map(line).collect()
}

/// Reads the plugin's lines.
pub(crate) fn read(text: &str) -> Result<Vec<Region>> {
    let region = |[instructions, m0, m0_plus, unknown, linked, low, high, m4_unknown]: [u64; 8]| Region {
        instructions,
        m0,
        m0_plus,
        unknown,
        linked,
        m4: [low, high],
        m4_unknown,
    };
    Ok(numbers(text)?.into_iter().map(region).collect())
}

//! A plugin of QEMU that adds up the published cycles of the instructions that are executed.
//!
//! QEMU models no pipeline, but Cortex-M0 and Cortex-M0+ need none to be modelled: their manuals give each instruction a number of
//! cycles that depends on nothing but the instruction and on whether its branch is taken. [`instruction`] decodes what the manuals
//! tell apart, [`timing`] has their numbers and their sources, [`account`] adds up. For a Cortex-M4, [`m4`] gives a lower and an
//! upper bound. `plugin` is the shell that QEMU loads: `qemu-system-arm … -plugin libfluisim_cycles.so,out=FILE`, where the path of
//! `FILE` has no comma.
//!
//! Counted is what lies between two instructions that do nothing and that no compiler emits: `mov r9, r9` begins a region and
//! `mov r10, r10` ends it. Neither is in the sum. `FILE` gets a line for each region, in the order of their ends, see
//! [`account::Totals`].
//!
//! The sums leave out wait states of flash and RAM, the contention of a bus with DMA, and interrupts, which are not to come
//! inside a region.

pub mod account;
pub mod instruction;
pub mod m4;
#[cfg(not(test))] // its functions are QEMU's, which a test does not run in
mod plugin;
pub mod timing;

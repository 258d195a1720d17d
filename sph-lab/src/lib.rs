//! Number types for experiments: run the code of a firmware in a number format before that format is compiled for it.
//!
//! | type | question | answer |
//! |---|---|---|
//! | [`Emulated`] | what do so many bits give, rounded and overflowing this way? | the bits that the compiled type gives |
//! | [`Mini`] | and f16, bf16 or a posit of 16 bits? | their bits |
//! | [`Tally`] | how large does it get, and where does it leave its range? | magnitudes and saturations, place by place |
//! | [`Shadow`] | where does the error come from, and what does it decide? | errors and comparisons, place by place |
//! | [`Blame`] | what if only this place were rounded, or all but this one? | an error for each place |
//! | [`Interval`] | where is the result for certain, whatever the inputs in theirs are? | two numbers that it lies between |
//! | [`Running`] | how far from exact is this fixed-point result at most? | a bound that holds for certain |
//! | [`Dual`] | how does the result answer to its inputs? | exact derivatives |
//! | [`Chosen`] | any of them, chosen when the program runs | one type to compile for |
//!
//! Each is a [`Scalar`](sph_core::Scalar) of sph-core, so everything that is generic over the scalar runs on it unchanged, a
//! fluid as well as a field:
//!
//! ```
//! use sph_core::{BruteForce, KernelInfluence, Scalar, Sources, Uniform, kernel::Poly6};
//! use sph_lab::{Emulated, Format};
//!
//! // generic code, as a firmware has it
//! fn density<T: Scalar>() -> f64 {
//!     let row: Vec<[T; 1]> = (0..9).map(|i| [T::ratio(i, 7)]).collect();
//!     let sources = Sources::new(BruteForce::open(&row).unwrap(), Uniform(T::ratio(1, 7))).unwrap();
//!     let w = KernelInfluence::<T, 1, Poly6>::new(T::ratio(3, 7)).unwrap();
//!     sources.density_at(&w, &[T::ratio(3, 5)]).to_f64()
//! }
//!
//! let exact = density::<f64>();
//! let error = |name: &str| {
//!     let format: Format = name.parse().unwrap();
//!     (format.scope(density::<Emulated>) / exact - 1.0).abs()
//! };
//! assert!(error("i4f12") < 1e-3);
//! assert!(error("i4f12") > error("i4f20"));
//! ```

mod assign;
mod chosen;
mod dual;
mod emulated;
mod interval;
mod mini;
mod places;
mod running;

pub use chosen::{Choice, Chosen, ChosenSum};
pub use dual::{Dual, DualSum};
pub use emulated::{Emulated, EmulatedSum, Format, FormatError, Overflow, Rounding};
pub use interval::Interval;
pub use mini::{Mini, MiniFormat, MiniFormatError, MiniSum};
pub use places::{
    Blame, BlameSum, Blamed, Errors, Log, Operation, Place, Record, Saturations, Shadow, ShadowSum, Tally,
    TallyNear, TallyPack, TallySum, blame, watch,
};
pub use running::{Running, RunningSum};

//! Numbers that tell what happened to them place by place: a place is a line and column of the source, and an operation there.
//!
//! `#[track_caller]` hands the place over, so neither the code that is watched nor sph-core names its places.

mod blame;
mod lens;
mod log;
mod near;
mod place;
mod record;
mod recorder;
mod shadow;
mod tally;

pub use blame::{Blame, BlameSum, Blamed, blame};
pub use log::{Log, Saturations};
pub use near::{TallyNear, TallyPack};
pub use place::{Operation, Place};
pub use record::{Errors, Record};
pub use recorder::watch;
pub use shadow::{Shadow, ShadowSum};
pub use tally::{Tally, TallySum};

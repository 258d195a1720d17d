//! The library's lists as words of the command line.

use clap::ValueEnum;
use clap::builder::PossibleValue;

use crate::estimate_choice::Estimate;
use crate::kernel_choice::KernelName;
use crate::run::{CaseName, Solver};
use crate::study::{Target, UnitChoice};

macro_rules! words {
    ($($Enum:ident),+) => {$(
        impl ValueEnum for $Enum {
            fn value_variants<'a>() -> &'a [Self] {
                Self::ALL
            }

            fn to_possible_value(&self) -> Option<PossibleValue> {
                Some(PossibleValue::new(self.name()).help(self.about()))
            }
        }
    )+};
}

words!(KernelName, Estimate, CaseName, Solver, Target, UnitChoice);

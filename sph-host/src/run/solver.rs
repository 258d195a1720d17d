//! The list of the solvers, and what each computes in. `method` makes them.

use crate::kernel_choice::KernelName;
use crate::named_enum::named_enum;
use crate::scalar_choice::ScalarName;

named_enum! {
    /// How a case is simulated.
    Solver {
        Wcsph, "wcsph", "weakly compressible SPH: stands against experiment";
        Pbf, "pbf", "position-based fluid, as microcontrollers run it: dam-break and tilt";
    }
}

impl Solver {
    /// The scalars that it computes in, the default first.
    pub(crate) fn scalars(self) -> Vec<ScalarName> {
        match self {
            Self::Wcsph => vec![ScalarName::F64, ScalarName::F32],
            Self::Pbf => {
                let others = |scalar: &ScalarName| !matches!(scalar, ScalarName::F32 | ScalarName::F64);
                let others = ScalarName::ALL.iter().copied().filter(others);
                std::iter::once(ScalarName::F32).chain(others).collect()
            }
        }
    }

    /// The kernels that it sums with, the default first.
    pub(crate) fn kernels(self) -> Vec<KernelName> {
        match self {
            Self::Wcsph => {
                let others = |kernel: &KernelName| !kernel.is_singular() && *kernel != KernelName::WendlandC2;
                let others = KernelName::ALL.iter().copied().filter(others);
                std::iter::once(KernelName::WendlandC2).chain(others).collect()
            }
            Self::Pbf => vec![KernelName::Poly6],
        }
    }
}

//! The list of the solvers, and what each computes in. `method` makes them.

use crate::kernel_choice::KernelName;
use crate::named_enum::named_enum;
use crate::scalar_choice::ScalarName;

named_enum! {
    /// How a case is simulated.
    Solver {
        Wcsph, "wcsph", "weakly compressible SPH: stands against experiment";
        Incompressible, "incompressible", "incompressible SPH: the same with steps ten times as long; not for periodic boxes";
        Pbf, "pbf", "position-based fluid, as microcontrollers run it: dam-break and tilt";
    }
}

impl Solver {
    /// The scalar that it computes in without being told.
    pub(crate) fn usual_scalar(self) -> ScalarName {
        match self {
            Self::Wcsph => ScalarName::F64,
            Self::Incompressible | Self::Pbf => ScalarName::F32,
        }
    }

    /// Whether it computes in a scalar.
    pub(crate) fn takes(self, scalar: ScalarName) -> bool {
        match self {
            Self::Wcsph | Self::Incompressible => matches!(scalar, ScalarName::F64 | ScalarName::F32),
            Self::Pbf => scalar != ScalarName::F64,
        }
    }

    /// The scalars that it computes in, for people.
    pub(crate) fn scalars(self) -> String {
        let floats = ScalarName::FLOATS.iter().copied().filter(|&scalar| self.takes(scalar));
        let names = floats.map(ScalarName::name).collect::<Vec<_>>();
        match self {
            Self::Wcsph | Self::Incompressible => names.join(" or "),
            Self::Pbf => format!(
                "{}, floating point of 16 bits such as f16, or fixed point such as i16f16",
                names.join(", ")
            ),
        }
    }

    /// The kernels that it sums with, the default first.
    pub(crate) fn kernels(self) -> Vec<KernelName> {
        match self {
            Self::Wcsph | Self::Incompressible => {
                let others = |kernel: &KernelName| !kernel.is_singular() && *kernel != KernelName::WendlandC2;
                let others = KernelName::ALL.iter().copied().filter(others);
                std::iter::once(KernelName::WendlandC2).chain(others).collect()
            }
            Self::Pbf => vec![KernelName::Poly6],
        }
    }
}

//! Every public type can be logged under the feature `defmt`: compiled, not run.

#![cfg(feature = "defmt")]

use sph_core::field::{LinearBasis, LinearFit};
use sph_core::fluid::incompressible;
use sph_core::fluid::wcsph::{
    CellStorage, Forces, Limits, Liquid, OneByOne, Pair, ParticleStates, Particles, Scheme, Seen,
};
use sph_core::fluid::{
    BorrowedFluid, Disc, EquationOfState, Mask, OpenBox, Particle, PositionBasedFluid, Raster, Rejected,
    Settings, Shape, Wall,
};
use sph_core::kernel::conformance::{Law, Violation};
use sph_core::kernel::{self, Tabulated, Term, ViscosityLaplacian, WendlandC2};
use sph_core::{
    Axis, BruteForce, CellGrid, CellLayout, CellOrder, ClosureInfluence, Domain, Error, Field,
    InlineCellGrid, KernelInfluence, Neighbour, NeighbourList, Open, Parameter, PerSampleInfluence, Sources,
    Uniform,
};

type T = f32;
type Search = BruteForce<'static, T, 2>;

macro_rules! can_be_logged {
    ($($Type:ty),+ $(,)?) => {
        const _: () = {
            const fn formats<F: defmt::Format>() {}
            $(formats::<$Type>();)+
        };
    };
}

can_be_logged!(
    Error,
    Parameter,
    Law,
    Violation,
    Term,
    ViscosityLaplacian<T, 2>,
    Tabulated<WendlandC2, 65>,
    KernelInfluence<T, 2, WendlandC2>,
    PerSampleInfluence<'static, T, 2, WendlandC2>,
    ClosureInfluence<T, 2, fn(T, T) -> T>,
    Axis<T>,
    Domain<T, 2>,
    Open,
    CellLayout<T, 2>,
    CellLayout<T, 2, Open>,
    Search,
    CellGrid<'static, T, u8, 2>,
    CellGrid<'static, T, u8, 2, Open>,
    InlineCellGrid<u8, 65, 64>,
    CellOrder<'static, u8, 2>,
    Neighbour<T, 2>,
    NeighbourList<16, u8>,
    Uniform<T>,
    Sources<T, 2, Search, Uniform<T>>,
    Field<'static, T, 2, Search, Uniform<T>, Uniform<T>>,
    LinearBasis<T, 2>,
    LinearFit<T, 2>,
);

macro_rules! every_kernel_can_be_logged {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => { can_be_logged!($(kernel::$Kernel),+); };
}
sph_core::for_each_kernel!(every_kernel_can_be_logged);

macro_rules! every_scalar_can_be_logged {
    ([$($Name:ident: $Scalar:ty, $about:tt;)+]) => { can_be_logged!($($Scalar),+); };
}
sph_core::for_each_scalar!(every_scalar_can_be_logged);

type SignedDistance = fn(&[T; 2]) -> (T, [T; 2]);

can_be_logged!(
    Settings,
    Particle<T, 2>,
    Rejected<Particle<T, 2>>,
    PositionBasedFluid<T, OpenBox<T, 2>, 2, 64, 64>,
    BorrowedFluid<'static, T, OpenBox<T, 2>, 2>,
    sph_core::fluid::pbf::Pass,
    OpenBox<T, 2>,
    Disc<T>,
    Mask<'static, T>,
    Shape<T, SignedDistance, 2>,
    incompressible::Outcome,
    incompressible::Particles<'static, T, 2, ()>,
    incompressible::Scheme<T, 2, KernelInfluence<T, 2, WendlandC2>>,
    incompressible::Shape<T, 2>,
    incompressible::Surroundings<T, 2>,
    incompressible::OneByOne<'static, Search, T>,
    incompressible::Tuning<T>,
    incompressible::Wall<T>,
    Wall<T, 2>,
    Raster<8, 8>,
    EquationOfState<T>,
    Liquid<T, 2>,
    Scheme<T, 2, KernelInfluence<T, 2, WendlandC2>>,
    Limits<T>,
    ParticleStates<'static, T, 2>,
    Seen<T, 2>,
    Forces<T, 2>,
    Pair<T, 2>,
    OneByOne<CellStorage<'static, u16>>,
    Particles<'static, T, 2, OneByOne<CellStorage<'static, u16>>>,
    CellStorage<'static, u16>,
);

#[cfg(feature = "fixed")]
mod fixed_point {
    use sph_core::scalar::fixed::{Check, Checked, I16F16, Near14, Packed14, Saturate, Sum, Wrap, Wrapping};

    can_be_logged!(
        Wrap,
        Saturate,
        Check,
        Wrapping<I16F16>,
        Checked<I16F16>,
        Sum<I16F16, Check>,
        Near14,
        Packed14<2>,
    );
}

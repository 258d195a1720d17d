//! Digests of every kernel: influence, gradient, and both together, at distances from 0 to beyond the support.

use crate::{Fnv, Item, Scene};
use sph_core::kernel::{self, Kernel, Tabulated, ViscosityLaplacian, WendlandC2};
use sph_core::{Error, Influence, KernelInfluence, Scalar, ball};

/// How many distances.
const STEPS: i32 = 40;

pub(crate) fn digest<T: Scalar, const D: usize>(emit: &mut impl FnMut(Item)) -> Result<(), Error> {
    macro_rules! all {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
            if !kernel::$Kernel::SINGULAR {
                emit(of::<T, D, kernel::$Kernel>($name)?);
            }
        )+};
    }
    sph_core::for_each_kernel!(all);
    emit(of::<T, D, Tabulated<WendlandC2, 65>>("wendland-c2-table")?);
    emit(laplacian::<T, D>()?);
    Ok(())
}

fn item<T: Scalar, const D: usize>(by: &'static str, quantity: &'static str, digest: Fnv) -> Item {
    Item { scalar: T::NAME, dim: D, by, quantity, digest: digest.get() }
}

fn of<T: Scalar, const D: usize, K: Kernel>(by: &'static str) -> Result<Item, Error> {
    let w = KernelInfluence::<T, D, K>::new(Scene::<T, D>::support_radius())?;
    let mut digest = Fnv::new();
    for i in 0..=STEPS {
        let x = core::array::from_fn(|axis| T::ratio(i * (1 - 2 * axis as i32), STEPS + 16 * axis as i32));
        digest.add(w.influence_at(&x).canonical_bits());
        for component in w.gradient_at(&x) {
            digest.add(component.canonical_bits());
        }
    }
    Ok(item::<T, D>(by, "influence", digest))
}

fn laplacian<T: Scalar, const D: usize>() -> Result<Item, Error> {
    let support_radius = Scene::<T, D>::support_radius();
    let laplacian = ViscosityLaplacian::<T, D>::new(support_radius)?;
    let mut digest = Fnv::new();
    for i in 0..=STEPS {
        digest.add(laplacian.at_distance(T::ratio(i, STEPS)).canonical_bits());
    }
    digest.add(ball::volume::<T, D>(support_radius).canonical_bits());
    Ok(item::<T, D>("viscosity", "laplacian", digest))
}

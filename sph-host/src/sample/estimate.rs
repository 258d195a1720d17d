//! The estimates of a field: one list with name, meaning and implementation.

use sph_core::{Field, Scalar, Sources};

use super::found::Local;
use super::stencil::{Picked, Stencil};

/// Volumes of the particles about a point.
pub(super) type Volumes<'a, T, const D: usize> = Sources<T, D, Stencil<'a, T, D>, Picked<'a, T, D>>;

/// What fields are evaluated from on the exact path.
#[derive(Clone, Copy)]
pub(super) struct Around<'a, T, const D: usize> {
    pub(super) stencil: Stencil<'a, T, D>,
    pub(super) x: &'a [T; D],
    /// V_j
    pub(super) volumes: &'a [T],
    /// A_j, field by field.
    pub(super) values: &'a [Vec<T>],
    pub(super) gradient: bool,
}

/// How an estimate is computed; gradients that are not asked for are zero.
pub(super) trait Method<T: Scalar, const D: usize>: Sync {
    /// Appends what the fields are at a point, in sph-core's order of summation. Returns false where particles are in reach,
    /// but do not carry the estimate.
    fn exact(&self, around: Around<'_, T, D>, fields: &mut Vec<Option<Local<T, D>>>) -> bool;

    /// How the fast path computes it; `None` where that has it not.
    fn fast(&self) -> Option<FromSums<T, D>>;
}

/// What one field is from Σ V A W and Σ V A ∇W, and from Σ V W and Σ V ∇W where the estimate needs weights.
pub(super) type FromSums<T, const D: usize> = fn(&[T], &[T]) -> Option<Local<T, D>>;

/// Generates the list: name, meaning, and whether weights and masses are needed.
macro_rules! estimates {
    ($($(#[doc = $about:literal])* $Name:ident: $name:literal, $facts:expr;)*) => {
        /// Which sum stands for a field.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Estimate {
            $($(#[doc = $about])* $Name,)*
        }

        impl Estimate {
            /// All estimates.
            pub const ALL: &'static [Self] = &[$(Self::$Name),*];

            /// The name, such as `plain`.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$Name => $name),* }
            }

            /// What it is, in a few words.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self { $(Self::$Name => concat!($($about),*).trim_ascii_start()),* }
            }

            /// What it needs.
            pub(super) fn facts(self) -> Facts {
                match self { $(Self::$Name => $facts),* }
            }

            /// How it is computed.
            pub(super) fn method<'a, T: Scalar + 'a, const D: usize>(self) -> &'a dyn Method<T, D> {
                match self { $(Self::$Name => &$Name),* }
            }
        }

        $(struct $Name;)*
    };
}

/// What an estimate needs.
pub(super) struct Facts {
    /// Σ V W and, for gradients, Σ V ∇W.
    pub(super) weights: bool,
    /// It can do without masses: only the ratios of weights count.
    pub(super) without_mass: bool,
}

estimates! {
    /// Σ m/ρ A W, the paper's interpolation
    Plain: "plain", Facts { weights: false, without_mass: false };
    /// divided by Σ m/ρ W: exact for constants
    Shepard: "shepard", Facts { weights: true, without_mass: true };
    /// linear moving least squares: exact for linear fields
    Corrected: "corrected", Facts { weights: false, without_mass: false };
}

impl<'a, T: Scalar, const D: usize> Around<'a, T, D> {
    fn volumes(&self) -> Volumes<'a, T, D> {
        Sources::assume_checked(self.stencil, self.stencil.pick(self.volumes))
    }

    /// Appends what `evaluate` makes of each field.
    fn each(
        &self,
        volumes: &Volumes<'a, T, D>,
        fields: &mut Vec<Option<Local<T, D>>>,
        evaluate: impl Fn(
            &Field<'_, T, D, Stencil<'a, T, D>, Picked<'a, T, D>, Picked<'a, T, D>>,
        ) -> Option<Local<T, D>>,
    ) {
        for values in self.values {
            let field = Field::new(volumes, self.stencil.pick(values));
            fields.push(field.ok().and_then(|field| evaluate(&field)));
        }
    }
}

/// A value without its gradient.
fn alone<T: Scalar, const D: usize>(value: T) -> Local<T, D> {
    (value, [T::ZERO; D])
}

/// A sum and its gradient, which is zero where there is none.
pub(super) fn local<T: Scalar, const D: usize>(sums: &[T]) -> Local<T, D> {
    let slope = |axis: usize| sums.get(1 + axis).copied().unwrap_or(T::ZERO);
    (sums[0], std::array::from_fn(slope))
}

impl<T: Scalar, const D: usize> Method<T, D> for Plain {
    fn exact(&self, around: Around<'_, T, D>, fields: &mut Vec<Option<Local<T, D>>>) -> bool {
        let Around { stencil, x, .. } = around;
        around.each(&around.volumes(), fields, |field| {
            Some(match around.gradient {
                true => field.interpolate_with_gradient_at(stencil, x),
                false => alone(field.interpolate_at(stencil, x)),
            })
        });
        true
    }

    fn fast(&self) -> Option<FromSums<T, D>> {
        Some(|field, _| Some(local(field)))
    }
}

impl<T: Scalar, const D: usize> Method<T, D> for Shepard {
    fn exact(&self, around: Around<'_, T, D>, fields: &mut Vec<Option<Local<T, D>>>) -> bool {
        let Around { stencil, x, .. } = around;
        around.each(&around.volumes(), fields, |field| match around.gradient {
            true => field.shepard_gradient_at(stencil, x),
            false => field.shepard_at(stencil, x).map(alone),
        });
        true
    }

    fn fast(&self) -> Option<FromSums<T, D>> {
        Some(|field, weights| {
            let ((value, slope), (weight, weight_slope)) = (local::<T, D>(field), local::<T, D>(weights));
            if !weight.is_above_zero() {
                return None;
            }
            let value = value / weight;
            Some((value, std::array::from_fn(|axis| (slope[axis] - value * weight_slope[axis]) / weight)))
        })
    }
}

impl<T: Scalar, const D: usize> Method<T, D> for Corrected {
    fn exact(&self, around: Around<'_, T, D>, fields: &mut Vec<Option<Local<T, D>>>) -> bool {
        let Around { stencil, x, .. } = around;
        let volumes = around.volumes();
        let basis = volumes.linear_basis_at(stencil, x);
        around.each(&volumes, fields, |field| {
            let fit = field.fit_at(basis.as_ref()?, stencil, x)?;
            Some((fit.value, fit.gradient))
        });
        basis.is_some() || stencil.is_empty()
    }

    fn fast(&self) -> Option<FromSums<T, D>> {
        None
    }
}

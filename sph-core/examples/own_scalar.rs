//! A scalar of one's own: bfloat16, an f32 of which 8 significant bits are kept, to see what a density loses by it.
//!
//! `cargo run -p sph-core --example own_scalar`

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};
use sph_core::kernel::WendlandC2;
use sph_core::{Accumulator, Arithmetic, BruteForce, Error, KernelInfluence, Scalar, Sources, Uniform};

#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(crate) struct Bf16(f32);

/// The nearest bfloat16, ties to even.
fn round(x: f32) -> Bf16 {
    let bits = x.to_bits();
    Bf16(if x.is_finite() { f32::from_bits((bits + 0x7fff + (bits >> 16 & 1)) & 0xffff_0000) } else { x })
}

macro_rules! operator {
    ($Operator:ident $method:ident) => {
        impl $Operator for Bf16 {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                round(self.0.$method(other.0))
            }
        }
    };
}
operator!(Add add);
operator!(Sub sub);
operator!(Mul mul);
operator!(Div div);

impl Neg for Bf16 {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl AddAssign for Bf16 {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Bf16 {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Arithmetic for Bf16 {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    fn ratio(numerator: i32, denominator: i32) -> Self {
        round(numerator as f32 / denominator as f32)
    }

    fn positive_part(self) -> Self {
        Self(self.0.positive_part())
    }

    fn times(self, n: i32) -> Self {
        round(self.0 * n as f32)
    }
}

impl Scalar for Bf16 {
    type Sum = Sum;

    const NAME: &'static str = "bf16";
    const EPSILON: Self = Self(1.0 / 128.0);
    const MAX: Self = Self(f32::from_bits(0x7f7f_0000));

    fn from_f64(value: f64) -> Self {
        round(value as f32)
    }

    fn to_f64(self) -> f64 {
        self.0.into()
    }

    fn sqrt(self) -> Self {
        round(Scalar::sqrt(self.0))
    }

    fn is_finite(self) -> bool {
        self.0.is_finite()
    }

    fn floor_to_i32(self) -> i32 {
        self.0.floor_to_i32()
    }

    fn canonical_bits(self) -> u64 {
        self.0.canonical_bits()
    }
}

/// Terms are added in f32 and rounded once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sum(f32);

impl Accumulator<Bf16> for Sum {
    const ZERO: Self = Self(0.0);

    fn add(&mut self, term: Bf16) {
        self.0 += term.0;
    }

    fn total(self) -> Bf16 {
        round(self.0)
    }
}

fn density<T: Scalar>() -> Result<f64, Error> {
    let positions: Vec<[T; 2]> = (0..100).map(|i| [T::ratio(i % 10, 4), T::ratio(i / 10, 4)]).collect();
    let w = KernelInfluence::<T, 2, WendlandC2>::new(T::ONE)?;
    let sources = Sources::new(BruteForce::new(&positions)?, Uniform(T::ratio(1, 16)))?;
    Ok(sources.density_at(&w, &positions[44]).to_f64())
}

pub(crate) fn main() -> Result<(), Error> {
    let (exact, found) = (density::<f64>()?, density::<Bf16>()?);
    println!("density in f64 {exact:.5}, in {} {found:.5}", Bf16::NAME);
    assert!((found / exact - 1.0).abs() < 0.01 && found != exact);
    Ok(())
}

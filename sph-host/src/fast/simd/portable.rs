//! Registers that are arrays, for targets without registers here.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use sph_core::{Arithmetic, Lane};

use super::array::{first, less_than_mask, pack, total, transpose};
use super::{Isa, Real, Register};

/// Four numbers of any float: as wide as is seldom too wide.
const WIDTH: usize = 4;

/// A register that is an array.
#[derive(Clone, Copy)]
pub(super) struct Array<T>(pub(super) [T; WIDTH]);

/// The instruction set of [`Array`].
#[derive(Clone, Copy)]
pub(super) struct Portable;

macro_rules! operator {
    ($Operator:ident $method:ident, $Assign:ident $assign:ident, $operator:tt) => {
        operator!($Operator $method, $operator);

        impl<T: Real> $Assign for Array<T> {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    };
    ($Operator:ident $method:ident, $operator:tt) => {
        impl<T: Real> $Operator for Array<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for k in 0..WIDTH {
                    self.0[k] = self.0[k] $operator other.0[k];
                }
                self
            }
        }
    };
}

operator!(Add add, AddAssign add_assign, +);
operator!(Sub sub, SubAssign sub_assign, -);
operator!(Mul mul, *);
operator!(Div div, /);

impl<T: Real> Neg for Array<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for k in 0..WIDTH {
            self.0[k] = -self.0[k];
        }
        self
    }
}

impl<T: Real> Arithmetic for Array<T> {
    const ZERO: Self = Self([T::ZERO; WIDTH]);
    const ONE: Self = Self([T::ONE; WIDTH]);

    #[inline(always)]
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self([T::ratio(numerator, denominator); WIDTH])
    }

    #[inline(always)]
    fn positive_part(self) -> Self {
        self.max(Self::ZERO)
    }

    #[inline(always)]
    fn times(mut self, n: i32) -> Self {
        for k in 0..WIDTH {
            self.0[k] = self.0[k].times(n);
        }
        self
    }
}

impl<T: Real> Lane<T> for Array<T> {
    type Sum = Self;
    const EMPTY: Self = Self::ZERO;

    #[inline(always)]
    fn splat(value: T) -> Self {
        Self([value; WIDTH])
    }

    #[inline(always)]
    fn add_to(self, sum: &mut Self) {
        *sum += self;
    }

    #[inline(always)]
    fn join(sum: &mut Self, other: Self) {
        *sum += other;
    }

    #[inline(always)]
    fn total(sum: Self) -> T {
        total(sum.0)
    }

    #[inline(always)]
    fn where_above_zero(mut self, condition: Self) -> Self {
        for k in 0..WIDTH {
            self.0[k] = if condition.0[k] > T::ZERO { self.0[k] } else { T::ZERO };
        }
        self
    }
}

impl<T: Real> Register<T> for Array<T> {
    const WIDTH: usize = WIDTH;

    #[inline(always)]
    fn load(from: &[T]) -> Self {
        Self(*from.first_chunk().expect("numbers for a register"))
    }

    #[inline(always)]
    fn store(self, to: &mut [T]) {
        *to.first_chunk_mut().expect("room for a register") = self.0;
    }

    #[inline(always)]
    fn root(mut self) -> Self {
        for k in 0..WIDTH {
            self.0[k] = self.0[k].sqrt();
        }
        self
    }

    #[inline(always)]
    fn min(mut self, other: Self) -> Self {
        for k in 0..WIDTH {
            self.0[k] = if self.0[k] < other.0[k] { self.0[k] } else { other.0[k] };
        }
        self
    }

    #[inline(always)]
    fn max(mut self, other: Self) -> Self {
        for k in 0..WIDTH {
            self.0[k] = if self.0[k] > other.0[k] { self.0[k] } else { other.0[k] };
        }
        self
    }
}

impl<T: Real> Isa<T> for Portable {
    type Reg = Array<T>;
    type Parts<U: Copy> = [U; 4];

    #[inline(always)]
    fn parts<U: Copy>(value: U) -> [U; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn transpose<'a>(self, quadruple: impl Fn(usize) -> &'a [T; 4]) -> [Array<T>; 4] {
        let [a, b, c, d] = transpose(quadruple);
        [Array(a), Array(b), Array(c), Array(d)]
    }

    #[inline(always)]
    fn less_than_mask(self, a: Array<T>, b: Array<T>) -> u32 {
        less_than_mask(a.0, b.0)
    }

    #[inline(always)]
    fn pack(self, mask: u32, values: Array<T>, out: &mut [T]) {
        pack(mask, &values.0, out);
    }

    #[inline(always)]
    fn pack_places(self, mask: u32, places: &[u32], out: &mut [u32]) {
        pack(mask, first::<WIDTH>(places), out);
    }
}

#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")))]
mod dispatch {
    use super::super::sealed::Sealed;
    use super::super::{InstructionSet, Job};
    use super::Portable;

    impl Sealed for f32 {
        fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
            job.run(Portable)
        }
    }

    impl Sealed for f64 {
        fn dispatch<J: Job<Self>>(_: InstructionSet, job: J) -> J::Output {
            job.run(Portable)
        }
    }
}

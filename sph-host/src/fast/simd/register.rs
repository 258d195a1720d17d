//! A register as a type: what all instruction sets have in common.

/// Defines `$Name`, a register of `$WIDTH` numbers, by the instructions that calculate with it. `$token` is the pulp token that has
/// them, of which `$part` has the five that are named after it.
macro_rules! register {
    (
        $Name:ident: $WIDTH:literal x $Real:ident in $Vector:ty, by $token:ident: $Token:ty;
        $part:ident: $splat:ident $add:ident $sub:ident $mul:ident $div:ident;
        negate($na:ident) => $negate:expr;
        root($ra:ident) => $root:expr;
        min($ia:ident, $ib:ident) => $min:expr;
        max($xa:ident, $xb:ident) => $max:expr;
        where_above_zero($wa:ident, $wc:ident) => $where_above_zero:expr;
        total($ta:ident) => $total:expr;
    ) => {
        #[doc = concat!(stringify!($WIDTH), " numbers of type `", stringify!($Real), "`.")]
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(super) struct $Name(pub(super) $Vector);

        impl $Name {
            /// The proof that the processor has the instructions below.
            ///
            /// An operator has no argument to take a token from, and a constant such as zero none to keep it in.
            // SAFETY: Code that calculates with this register runs on a processor that has its instructions. The register and its
            // `Isa` are private to the module of one architecture. Outside of it, they have no name but the type parameter `I` of
            // `Job::run`, and `dispatch`, in the same module, is the only caller of `run` with this `Isa`: it does so after the
            // processor was found to have the instructions, which a processor does not lose.
            #[cfg_attr(
                target_arch = "wasm32",
                allow(unused_unsafe, reason = "safe there: known when compiled")
            )]
            const TOKEN: $Token = unsafe { <$Token>::new_unchecked() };
        }

        impl std::ops::Add for $Name {
            type Output = Self;

            #[inline(always)]
            fn add(self, other: Self) -> Self {
                Self(Self::TOKEN.$part.$add(self.0, other.0))
            }
        }

        impl std::ops::Sub for $Name {
            type Output = Self;

            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self(Self::TOKEN.$part.$sub(self.0, other.0))
            }
        }

        impl std::ops::Mul for $Name {
            type Output = Self;

            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                Self(Self::TOKEN.$part.$mul(self.0, other.0))
            }
        }

        impl std::ops::Div for $Name {
            type Output = Self;

            #[inline(always)]
            fn div(self, other: Self) -> Self {
                Self(Self::TOKEN.$part.$div(self.0, other.0))
            }
        }

        impl std::ops::Neg for $Name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                let ($token, $na) = (Self::TOKEN, self.0);
                Self($negate)
            }
        }

        impl std::ops::AddAssign for $Name {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl std::ops::SubAssign for $Name {
            #[inline(always)]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl sph_core::Arithmetic for $Name {
            const ZERO: Self = Self(pulp::cast([0.0 as $Real; $WIDTH]));
            const ONE: Self = Self(pulp::cast([1.0 as $Real; $WIDTH]));

            #[inline(always)]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                <Self as sph_core::Lane<$Real>>::splat(<$Real as sph_core::Arithmetic>::ratio(
                    numerator,
                    denominator,
                ))
            }

            #[inline(always)]
            fn positive_part(self) -> Self {
                crate::fast::simd::Register::<$Real>::max(self, Self::ZERO)
            }

            #[inline(always)]
            fn times(self, n: i32) -> Self {
                self * <Self as sph_core::Lane<$Real>>::splat(n as $Real)
            }
        }

        impl sph_core::Lane<$Real> for $Name {
            type Sum = Self;
            const EMPTY: Self = <Self as sph_core::Arithmetic>::ZERO;

            #[inline(always)]
            fn splat(value: $Real) -> Self {
                Self(Self::TOKEN.$part.$splat(value))
            }

            #[inline(always)]
            fn add_to(self, sum: &mut Self) {
                *sum = *sum + self;
            }

            #[inline(always)]
            fn join(sum: &mut Self, other: Self) {
                *sum = *sum + other;
            }

            #[inline(always)]
            fn total(sum: Self) -> $Real {
                let ($token, $ta) = (Self::TOKEN, sum.0);
                let _ = $token;
                $total
            }

            #[inline(always)]
            fn where_above_zero(self, condition: Self) -> Self {
                let ($token, $wa, $wc) = (Self::TOKEN, self.0, condition.0);
                Self($where_above_zero)
            }
        }

        impl crate::fast::simd::Register<$Real> for $Name {
            const WIDTH: usize = $WIDTH;

            #[inline(always)]
            fn load(from: &[$Real]) -> Self {
                Self(pulp::cast(*from.first_chunk::<$WIDTH>().expect("numbers for a register")))
            }

            #[inline(always)]
            fn store(self, to: &mut [$Real]) {
                *to.first_chunk_mut::<$WIDTH>().expect("room for a register") = pulp::cast(self.0);
            }

            #[inline(always)]
            fn root(self) -> Self {
                let ($token, $ra) = (Self::TOKEN, self.0);
                Self($root)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                let ($token, $ia, $ib) = (Self::TOKEN, self.0, other.0);
                Self($min)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                let ($token, $xa, $xb) = (Self::TOKEN, self.0, other.0);
                Self($max)
            }
        }
    };
}

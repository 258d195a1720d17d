//! `+=` and `−=` for every number type here.

/// Implements `+=` and `−=` by `+` and `−`; takes the type's parameters in brackets, and the type.
macro_rules! assign_operators {
    ([$($parameters:tt)*] $Scalar:ty) => {
        impl<$($parameters)*> std::ops::AddAssign for $Scalar {
            #[inline(always)]
            #[track_caller]
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl<$($parameters)*> std::ops::SubAssign for $Scalar {
            #[inline(always)]
            #[track_caller]
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }
    };
}
pub(crate) use assign_operators;

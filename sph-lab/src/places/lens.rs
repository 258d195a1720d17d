//! What every number that watches has in common: each operation is done on the number within, and then told.

/// Implements operators, `Arithmetic`, `Scalar` and the sum for a lens: a type with `value()`, its number of type `$T`, and
/// `made(operation, value, operands, exact)`, which makes the result of an operation, `exact` being the operation on f64s. Takes the
/// parameters in brackets, the type and its sum, and what the lens of a constant is.
macro_rules! lens {
    ([$($parameters:tt)*] $Lens:ty: $T:ty, $Sum:ty, $name:expr, $constant:path) => {
        $crate::places::lens::lens!(@operator [$($parameters)*] $Lens, Add add +, Operation::Add);
        $crate::places::lens::lens!(@operator [$($parameters)*] $Lens, Sub sub -, Operation::Subtract);
        $crate::places::lens::lens!(@operator [$($parameters)*] $Lens, Mul mul *, Operation::Multiply);
        $crate::places::lens::lens!(@operator [$($parameters)*] $Lens, Div div /, Operation::Divide);
        $crate::assign::assign_operators!([$($parameters)*] $Lens);

        impl<$($parameters)*> Arithmetic for $Lens {
            const ZERO: Self = $constant(<$T as Arithmetic>::ZERO, 0.0);
            const ONE: Self = $constant(<$T as Arithmetic>::ONE, 1.0);

            #[inline]
            #[track_caller]
            fn ratio(numerator: i32, denominator: i32) -> Self {
                let exact = f64::from(numerator) / f64::from(denominator);
                Self::made(Operation::Ratio, <$T as Arithmetic>::ratio(numerator, denominator), [], |[]| exact)
            }

            #[inline]
            fn positive_part(self) -> Self {
                self.with(self.value().positive_part(), |x| x.max(0.0))
            }

            #[inline]
            #[track_caller]
            fn times(self, n: i32) -> Self {
                Self::made(Operation::Times, self.value().times(n), [self], |[x]| x * f64::from(n))
            }
        }

        impl<$($parameters)*> Scalar for $Lens {
            type Sum = $Sum;

            const NAME: &'static str = $name;
            const EPSILON: Self = $constant(<$T as Scalar>::EPSILON, f64::EPSILON);
            const MAX: Self = $constant(<$T as Scalar>::MAX, f64::MAX);

            #[inline]
            #[track_caller]
            fn from_f64(value: f64) -> Self {
                Self::made(Operation::Convert, <$T as Scalar>::from_f64(value), [], |[]| value)
            }

            #[inline]
            fn to_f64(self) -> f64 {
                self.seen();
                Scalar::to_f64(self.value())
            }

            #[inline]
            #[track_caller]
            fn sqrt(self) -> Self {
                Self::made(Operation::Root, Scalar::sqrt(self.value()), [self], |[x]| x.max(0.0).sqrt())
            }

            #[inline]
            fn is_finite(self) -> bool {
                Scalar::is_finite(self.value())
            }

            #[inline]
            fn floor_to_i32(self) -> i32 {
                self.seen();
                Scalar::floor_to_i32(self.value())
            }

            #[inline]
            fn canonical_bits(self) -> u64 {
                self.seen();
                Scalar::canonical_bits(self.value())
            }

            #[inline]
            #[track_caller]
            fn split(self, bits: u32) -> (usize, Self) {
                self.seen();
                let (place, rest) = Scalar::split(self.value(), bits);
                let exact = |[x]: [f64; 1]| x * f64::from(1 << bits.min(12)) - place as f64;
                (place, Self::made(Operation::Split, rest, [self], exact))
            }

            #[inline]
            #[track_caller]
            fn constant<C: Table<ROWS, N>, const ROWS: usize, const N: usize>(row: usize, i: usize) -> Option<Self> {
                let exact = *C::VALUES.get(row)?.get(i)?;
                let value = <$T as Scalar>::constant::<C, ROWS, N>(row, i)?;
                Some(Self::made(Operation::Constant, value, [], |[]| exact))
            }
        }
    };
    (@operator [$($parameters:tt)*] $Lens:ty, $Trait:ident $method:ident $sign:tt, $operation:expr) => {
        impl<$($parameters)*> std::ops::$Trait for $Lens {
            type Output = Self;

            #[inline]
            #[track_caller]
            fn $method(self, other: Self) -> Self {
                Self::made($operation, self.value() $sign other.value(), [self, other], |[x, y]| x $sign y)
            }
        }
    };
}
pub(crate) use lens;

//! The integer that stored indices are kept in: the smallest that fits saves RAM.

/// u8, u16 or u32: how an index into the samples is stored.
pub trait Index: Copy + Default + Ord + core::fmt::Debug + Send + Sync + 'static {
    /// 0
    const ZERO: Self;
    /// The largest index, as usize.
    const MAX: usize;

    /// The index as usize.
    fn to_usize(self) -> usize;

    /// The index from usize; callers have checked that it is at most [`MAX`](Self::MAX).
    fn from_usize(index: usize) -> Self;
}

macro_rules! index {
    ($($Integer:ident)*) => {$(
        impl Index for $Integer {
            const ZERO: Self = 0;
            const MAX: usize = $Integer::MAX as usize;

            #[inline(always)]
            fn to_usize(self) -> usize {
                self as usize
            }

            #[inline(always)]
            fn from_usize(index: usize) -> Self {
                index as Self
            }
        }
    )*};
}

index!(u8 u16 u32);

//! The fluid's short numbers, which are sph-core's own whatever the format: counts of 2^−14.

use sph_core::Arithmetic;
use sph_core::scalar::compact::Compact;
use sph_core::scalar::fixed::{I32F32, Near14, Saturating};

use super::exact::low_bits;
use super::{Emulated, Format};

/// Bits behind the binary point of a short number.
const FRACTION: u32 = 14;

impl Compact for Emulated {
    type Near = Near14;

    fn offset(self, other: Self) -> Near14 {
        let format = Format::current();
        let difference = i128::from(self.count(format)) - i128::from(other.count(format));
        let difference = i128::from(low_bits(format, difference));
        let fraction = format.fraction_bits();
        let units = if fraction < FRACTION {
            (difference as i32).wrapping_shl(FRACTION - fraction)
        } else {
            (difference >> (fraction - FRACTION)) as i32
        };
        Near14::ratio(units, 1 << FRACTION)
    }

    fn from_near(near: Near14) -> Self {
        let format = Format::current();
        // a format with more bits than a short number has says which one it is
        let wide = Saturating::<I32F32>::from_near(near).to_bits();
        let units = i128::from(wide >> (32 - FRACTION));
        let fraction = format.fraction_bits();
        let count =
            if fraction < FRACTION { units >> (FRACTION - fraction) } else { units << (fraction - FRACTION) };
        Self::narrow(format, count)
    }
}

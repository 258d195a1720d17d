//! The raster of sph-core in arrays of the caller: densities of pixels, and lamps that do not flicker.

use crate::code::{self, of_result};
use crate::export::export;
use crate::fluid::{self, Fluid};
use crate::pointer;
use sph_core::fluid::raster::{self, draw_density, lamp_after};
use sph_core::scalar::compact::Compact;

/// Draws the density of a fluid into `rows` rows of `columns` pixels.
///
/// # Safety
/// As [`fluid::head`]; `density` as [`pointer::slice_mut`].
///
/// # Errors
/// [`code::NOT_FINITE`], [`code::BAD_ARGUMENT`] for a pixel of 0 or less, and as [`fluid::head`]; nothing is drawn then.
pub(crate) unsafe fn draw<T: Compact>(
    fluid: *const Fluid<T, 2>,
    pixel: T,
    [columns, rows]: [u16; 2],
    density: *mut u8,
) -> Result<(), i32> {
    let count = usize::from(columns).checked_mul(rows.into()).ok_or(code::BAD_ARGUMENT)?;
    // SAFETY: as this function; the fluid is not written.
    let (particles, density) =
        unsafe { (fluid::particles(fluid.cast_mut())?, pointer::slice_mut(density, count)?) };
    if !pixel.is_finite() {
        return Err(code::NOT_FINITE);
    }
    if pixel <= T::ZERO {
        return Err(code::BAD_ARGUMENT);
    }
    draw_density(particles, pixel, columns.into(), density);
    Ok(())
}

/// Lights lamps, of which each is 0 or 1.
///
/// # Safety
/// `density` as [`pointer::slice()`], `lamps` as [`pointer::slice_mut`].
unsafe fn light((density, lamps, count): (*const u8, *mut u8, usize), on: u8, off: u8) -> Result<(), i32> {
    if off > on {
        return Err(code::BAD_ARGUMENT);
    }
    // SAFETY: as this function.
    let (density, lamps) = unsafe { (pointer::slice(density, count)?, pointer::slice_mut(lamps, count)?) };
    for (lamp, &density) in lamps.iter_mut().zip(density) {
        *lamp = lamp_after(*lamp != 0, density, on, off).into();
    }
    Ok(())
}

export! { "";
    /// Lights lamps by the density of their pixels.
    fn light_lamps(density: *const u8, count: usize, on: u8, off: u8, lamps: *mut u8) -> i32 {
        // SAFETY: as the header says.
        of_result(unsafe { light((density, lamps, count), on, off) })
    }

    /// A density as a brightness.
    fn brightness(density: u8) -> i32 {
        raster::brightness(density).into()
    }
}

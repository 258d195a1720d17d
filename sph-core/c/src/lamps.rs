//! The raster of sph-core, in sizes that firmware has and that are known when the library is compiled.

use crate::code::{self, of_result};
use crate::export::export;
use crate::fluid::{self, Fluid};
use crate::{Q16, pointer};
use core::ffi::c_void;
use sph_core::fluid::Raster;
use sph_core::scalar::compact::Compact;

/// A raster in the caller's memory. C knows it as an opaque type.
#[repr(C)]
#[derive(Debug)]
pub struct Lamps<const W: usize, const H: usize> {
    kind: u32,
    raster: Raster<W, H>,
}

impl<const W: usize, const H: usize> Lamps<W, H> {
    const KIND: u32 = 0x6c00_0000 + ((W as u32) << 12) + H as u32;

    /// Makes a dark raster.
    ///
    /// # Safety
    /// `memory` points to `bytes` bytes that nobody else uses as long as the raster is used, `lamps` to room for a pointer.
    unsafe fn init(
        (memory, bytes): (*mut c_void, usize),
        on: u8,
        off: u8,
        lamps: *mut *mut Self,
    ) -> Result<(), i32> {
        let place: *mut Self = memory.cast();
        // SAFETY: as this function.
        unsafe { pointer::write(lamps, core::ptr::null_mut()) }?;
        pointer::check(place)?;
        if bytes < size_of::<Self>() {
            return Err(code::TOO_SMALL);
        }
        if off > on {
            return Err(code::BAD_ARGUMENT);
        }
        // SAFETY: `place` is aligned and large enough; `lamps` as this function.
        unsafe {
            place.write(Self { kind: Self::KIND, raster: Raster::with_thresholds(on, off) });
            pointer::write(lamps, place)
        }
    }

    /// The raster, after a look at whether there is one.
    ///
    /// # Safety
    /// A pointer that is not null points to memory that [`init`](Self::init) was called for; nobody else uses it during `'a`.
    unsafe fn raster<'a>(lamps: *mut Self) -> Result<&'a mut Raster<W, H>, i32> {
        pointer::check(lamps)?;
        // SAFETY: aligned, and a u32 in the caller's memory.
        if unsafe { (&raw const (*lamps).kind).read() } != Self::KIND {
            return Err(code::NOT_INITIALISED);
        }
        // SAFETY: `init` wrote a raster before it wrote this kind.
        Ok(unsafe { &mut (*lamps).raster })
    }

    /// Draws a fluid.
    ///
    /// # Safety
    /// As [`raster`](Self::raster) and [`fluid::head`].
    unsafe fn draw<T: Compact>(lamps: *mut Self, fluid: *const Fluid<T, 2>, pixel: T) -> Result<(), i32> {
        // SAFETY: as this function; the fluid is not written.
        let (raster, particles) = unsafe { (Self::raster(lamps)?, fluid::particles(fluid.cast_mut())?) };
        if !pixel.is_finite() {
            return Err(code::NOT_FINITE);
        }
        if pixel <= T::ZERO {
            return Err(code::BAD_ARGUMENT);
        }
        raster.update(particles, pixel);
        Ok(())
    }

    /// What a pixel is like.
    ///
    /// # Safety
    /// As [`raster`](Self::raster).
    unsafe fn pixel(
        lamps: *const Self,
        [column, row]: [u16; 2],
        look: fn(&Raster<W, H>, [usize; 2]) -> i32,
    ) -> i32 {
        // SAFETY: as this function; nothing is written.
        match unsafe { Self::raster(lamps.cast_mut()) } {
            Err(error) => error,
            Ok(_) if usize::from(column) >= W || usize::from(row) >= H => code::NOT_FOUND,
            Ok(raster) => look(raster, [column.into(), row.into()]),
        }
    }
}

/// The functions of a size.
macro_rules! lamps {
    ($($module:ident $prefix:literal $W:literal $H:literal;)+) => {
        $(
            #[doc = concat!($W, " × ", $H, " lamps.")]
            pub mod $module {
                use super::*;

                export! { $prefix;
                    /// A dark raster.
                    fn init(
                        memory: *mut c_void,
                        bytes: usize,
                        on: u8,
                        off: u8,
                        lamps: *mut *mut Lamps<$W, $H>,
                    ) -> i32 {
                        // SAFETY: as the header says.
                        of_result(unsafe { Lamps::init((memory, bytes), on, off, lamps) })
                    }

                    /// Draws a fluid in floating point.
                    fn draw_f32_2d(lamps: *mut Lamps<$W, $H>, fluid: *const Fluid<f32, 2>, pixel: f32) -> i32 {
                        // SAFETY: as the header says.
                        of_result(unsafe { Lamps::draw(lamps, fluid, pixel) })
                    }

                    /// Draws a fluid in fixed point.
                    fn draw_q16_2d(lamps: *mut Lamps<$W, $H>, fluid: *const Fluid<Q16, 2>, pixel: Q16) -> i32 {
                        // SAFETY: as the header says.
                        of_result(unsafe { Lamps::draw(lamps, fluid, pixel) })
                    }

                    /// Whether a lamp is on.
                    fn is_lit(lamps: *const Lamps<$W, $H>, column: u16, row: u16) -> i32 {
                        // SAFETY: as the header says.
                        unsafe { Lamps::pixel(lamps, [column, row], |raster, [x, y]| raster.is_lit(x, y).into()) }
                    }

                    /// The density of a pixel.
                    fn density(lamps: *const Lamps<$W, $H>, column: u16, row: u16) -> i32 {
                        // SAFETY: as the header says.
                        unsafe { Lamps::pixel(lamps, [column, row], |raster, [x, y]| raster.density(x, y).into()) }
                    }
                }
            }
        )+

        /// The sizes, and the bytes of each.
        pub const SIZES: &[(usize, usize, usize)] = &[$(($W, $H, size_of::<Lamps<$W, $H>>())),+];
        /// The types of all functions.
        pub const SIGNATURES: &[&[crate::export::Signature]] = &[$($module::SIGNATURES),+];
    };
}

lamps! {
    lamps_8x8 "lamps_8x8_" 8 8;
    lamps_16x16 "lamps_16x16_" 16 16;
    lamps_32x8 "lamps_32x8_" 32 8;
    lamps_32x32 "lamps_32x32_" 32 32;
    lamps_64x32 "lamps_64x32_" 64 32;
    lamps_128x64 "lamps_128x64_" 128 64;
}

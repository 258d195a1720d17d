//! Fields over arrays of the caller, as C calls them.
//!
//! The kernel is a number, its place in [`sph_core::kernel::LIST`].

use crate::Q16;
use crate::code::{self, of_result};
use crate::export::export;
use crate::sums::{self, Request, Results};
use core::ffi::{CStr, c_char};
use sph_core::{Arithmetic, for_each_kernel};

/// The functions of a number type and dimension.
macro_rules! fields {
    ($(#[$about:meta])+ $module:ident, $prefix:literal, $T:ty, $D:literal) => {
        $(#[$about])+
        pub mod $module {
            use super::*;

            export! { $prefix;
                /// ρ and ∇ρ at a point.
                fn density(
                    kernel: i32,
                    support_radius: $T,
                    positions: *const $T,
                    masses: *const $T,
                    count: usize,
                    point: *const [$T; $D],
                    density: *mut $T,
                    gradient: *mut [$T; $D],
                ) -> i32 {
                    let request = Request::<$T, $D> { kernel, support_radius, positions: positions.cast(), weights: masses, count };
                    // SAFETY: as the header says.
                    of_result(unsafe { sums::density(request, point, Results(density, gradient)) })
                }

                /// ρ at every sample.
                fn densities(
                    kernel: i32,
                    support_radius: $T,
                    positions: *const $T,
                    masses: *const $T,
                    count: usize,
                    densities: *mut $T,
                ) -> i32 {
                    let request = Request::<$T, $D> { kernel, support_radius, positions: positions.cast(), weights: masses, count };
                    // SAFETY: as the header says.
                    of_result(unsafe { sums::densities(request, densities) })
                }

                /// Σ V A W and its gradient at a point.
                fn interpolate(
                    kernel: i32,
                    support_radius: $T,
                    positions: *const $T,
                    volumes: *const $T,
                    values: *const $T,
                    count: usize,
                    point: *const [$T; $D],
                    value: *mut $T,
                    gradient: *mut [$T; $D],
                ) -> i32 {
                    let request = Request::<$T, $D> { kernel, support_radius, positions: positions.cast(), weights: volumes, count };
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        request.estimate(values, point, Results(value, gradient), |field, w, x| {
                            if gradient.is_null() {
                                Some((field.interpolate_at(w, x), [<$T>::ZERO; $D]))
                            } else {
                                Some(field.interpolate_with_gradient_at(w, x))
                            }
                        })
                    })
                }

                /// Shepard's form and its gradient at a point.
                fn shepard(
                    kernel: i32,
                    support_radius: $T,
                    positions: *const $T,
                    volumes: *const $T,
                    values: *const $T,
                    count: usize,
                    point: *const [$T; $D],
                    value: *mut $T,
                    gradient: *mut [$T; $D],
                ) -> i32 {
                    let request = Request::<$T, $D> { kernel, support_radius, positions: positions.cast(), weights: volumes, count };
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        request.estimate(values, point, Results(value, gradient), |field, w, x| {
                            field.shepard_gradient_at(w, x)
                        })
                    })
                }

                /// Moving least squares, value and slope, at a point.
                fn corrected(
                    kernel: i32,
                    support_radius: $T,
                    positions: *const $T,
                    volumes: *const $T,
                    values: *const $T,
                    count: usize,
                    point: *const [$T; $D],
                    value: *mut $T,
                    gradient: *mut [$T; $D],
                ) -> i32 {
                    let request = Request::<$T, $D> { kernel, support_radius, positions: positions.cast(), weights: volumes, count };
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        request.estimate(values, point, Results(value, gradient), |field, w, x| {
                            field.corrected_at(w, x).map(|fit| (fit.value, fit.gradient))
                        })
                    })
                }
            }
        }
    };
}

fields! {
    /// Fields in 32-bit floating point and two dimensions.
    f32_2d, "f32_2d_", f32, 2
}
fields! {
    /// Fields in 16.16 fixed point and two dimensions.
    q16_2d, "q16_2d_", Q16, 2
}
fields! {
    /// Fields in 32-bit floating point and three dimensions.
    f32_3d, "f32_3d_", f32, 3
}
fields! {
    /// Fields in 16.16 fixed point and three dimensions.
    q16_3d, "q16_3d_", Q16, 3
}

macro_rules! names {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
        /// The names, each with the zero that ends a string in C.
        const NAMES: &[&str] = &[$(concat!($name, "\0")),+];
    };
}
for_each_kernel!(names);

export! { "";
    /// The number of a kernel.
    fn kernel(name: *const c_char) -> i32 {
        if name.is_null() {
            return code::NULL;
        }
        // SAFETY: a string that ends with zero, as the header says.
        let name = unsafe { CStr::from_ptr(name) }.to_bytes_with_nul();
        NAMES.iter().position(|listed| listed.as_bytes() == name).map_or(code::NOT_FOUND, |place| place as i32)
    }

    /// The name of a kernel, null where there is none.
    fn kernel_name(kernel: i32) -> *const c_char {
        let name = usize::try_from(kernel).ok().and_then(|place| NAMES.get(place));
        name.map_or(core::ptr::null(), |name| name.as_ptr().cast())
    }

    /// V = m / ρ in floating point.
    fn f32_volumes(masses: *const f32, densities: *const f32, count: usize, volumes: *mut f32) -> i32 {
        // SAFETY: as the header says.
        of_result(unsafe { sums::volumes(masses, densities, count, volumes) })
    }

    /// V = m / ρ in fixed point.
    fn q16_volumes(masses: *const Q16, densities: *const Q16, count: usize, volumes: *mut Q16) -> i32 {
        // SAFETY: as the header says.
        of_result(unsafe { sums::volumes(masses, densities, count, volumes) })
    }
}

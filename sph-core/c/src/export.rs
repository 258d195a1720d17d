//! What C calls: every function with its types, which the test `header` holds against `fluisim.h`.
//!
//! The safety of all of them is the header's: pointers that are not null point to what the header says.

/// An exported function: its name, the types of its arguments and of its result.
pub struct Signature {
    /// The name that C knows.
    pub name: &'static str,
    /// The type of each argument.
    pub arguments: &'static [fn() -> &'static str],
    /// The type of the result.
    pub result: fn() -> &'static str,
}

/// Exports functions whose names begin with `fluisim_` and a prefix, and lists their types.
macro_rules! export {
    ($prefix:literal; $(
        $(#[$about:meta])+
        fn $name:ident($($argument:ident: $Type:ty),* $(,)?) -> $Result:ty $body:block
    )+) => {
        $(
            $(#[$about])+
            ///
            /// # Safety
            /// Pointers that are not null point to what `fluisim.h` says.
            #[unsafe(export_name = concat!("fluisim_", $prefix, stringify!($name)))]
            pub unsafe extern "C" fn $name($($argument: $Type),*) -> $Result $body
        )+

        /// The types of these functions.
        pub const SIGNATURES: &[$crate::export::Signature] = &[$($crate::export::Signature {
            name: concat!("fluisim_", $prefix, stringify!($name)),
            arguments: &[$(core::any::type_name::<$Type>),*],
            result: core::any::type_name::<$Result>,
        }),+];
    };
}
pub(crate) use export;

use crate::code::of_result;
use crate::fluid::{self, Fluid, Walls};
use crate::{Q16, change, code, pixels, pointer};
use core::ffi::c_void;
use sph_core::fluid::{Disc, Mask, OpenBox, Particle, Settings};

/// The number of particles or of places for them, or an error.
fn number(found: Result<u16, i32>) -> i32 {
    found.map_or_else(|error| error, i32::from)
}

/// Writes a number of a particle.
///
/// # Safety
/// As [`fluid::head`]; `out` as [`pointer::write`].
unsafe fn tell<T: sph_core::scalar::compact::Compact, V: Copy, const D: usize>(
    (fluid, index): (*const Fluid<T, D>, u16),
    out: *mut V,
    value: impl Fn(&Particle<T, D>) -> V,
) -> Result<(), i32> {
    // SAFETY: as this function; nothing is written.
    let particles = unsafe { fluid::particles(fluid.cast_mut()) }?;
    let particle = particles.get(usize::from(index)).ok_or(code::NOT_FOUND)?;
    // SAFETY: as this function.
    unsafe { pointer::write(out, value(particle)) }
}

/// The functions of a fluid of one number type and dimension.
macro_rules! fluid {
    ($(#[$about:meta])+ $module:ident, $prefix:literal, $T:ty, $D:literal, { $($more:tt)* }) => {
        $(#[$about])+
        pub mod $module {
            use super::*;

            export! { $prefix;
                /// The memory of a fluid.
                fn bytes(capacity: u16, cells: u32) -> usize {
                    Fluid::<$T, $D>::bytes(capacity, cells)
                }

                /// An empty fluid in a box.
                fn init_box(
                    memory: *mut c_void,
                    bytes: usize,
                    capacity: u16,
                    size: *const [$T; $D],
                    fluid: *mut *mut Fluid<$T, $D>,
                ) -> i32 {
                    static WALLS: Walls<$T, $D> = Walls::of::<OpenBox<$T, $D>>();
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        pointer::write(fluid, core::ptr::null_mut()).and_then(|()| {
                            let container = OpenBox::new(fluid::finite(size)?);
                            fluid::init((memory, bytes), capacity, container, &WALLS, fluid)
                        })
                    })
                }

                /// An empty fluid in a disc or ball.
                fn init_disc(
                    memory: *mut c_void,
                    bytes: usize,
                    capacity: u16,
                    radius: $T,
                    fluid: *mut *mut Fluid<$T, $D>,
                ) -> i32 {
                    static WALLS: Walls<$T, $D> = Walls::of::<Disc<$T>>();
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        pointer::write(fluid, core::ptr::null_mut()).and_then(|()| {
                            let container = fluid::disc(radius)?;
                            fluid::init((memory, bytes), capacity, container, &WALLS, fluid)
                        })
                    })
                }

                /// How the fluid behaves.
                fn settings(fluid: *const Fluid<$T, $D>, settings: *mut Behaviour) -> i32 {
                    // SAFETY: as the header says; the head is not written.
                    of_result(unsafe {
                        fluid::head(fluid.cast_mut())
                            .and_then(|head| pointer::write(settings, (*head.settings_mut()).into()))
                    })
                }

                /// Changes how the fluid behaves.
                fn set_settings(fluid: *mut Fluid<$T, $D>, settings: *const Behaviour) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe {
                        fluid::head(fluid).and_then(|head| {
                            *head.settings_mut() = pointer::read(settings)?.into();
                            Ok(())
                        })
                    })
                }

                /// Adds a particle.
                fn add(fluid: *mut Fluid<$T, $D>, position: *const [$T; $D], velocity: *const [$T; $D]) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { change::add(fluid, position, velocity) })
                }

                /// Removes a particle.
                fn remove(fluid: *mut Fluid<$T, $D>, index: u16) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { change::remove(fluid, index) })
                }

                /// Pokes the fluid.
                fn impulse(
                    fluid: *mut Fluid<$T, $D>,
                    centre: *const [$T; $D],
                    radius: $T,
                    change: *const [$T; $D],
                ) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { change::impulse(fluid, centre, radius, change) })
                }

                /// Moves the fluid by a frame.
                fn step(fluid: *mut Fluid<$T, $D>, acceleration: *const [$T; $D]) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { fluid::step(fluid, acceleration) })
                }

                /// How many particles there are.
                fn count(fluid: *const Fluid<$T, $D>) -> i32 {
                    // SAFETY: as the header says; the head is not written.
                    number(unsafe { fluid::head(fluid.cast_mut()) }.map(|head| head.len()))
                }

                /// How many particles there is room for.
                fn capacity(fluid: *const Fluid<$T, $D>) -> i32 {
                    // SAFETY: as the header says; the head is not written.
                    number(unsafe { fluid::head(fluid.cast_mut()) }.map(|head| head.capacity()))
                }

                /// Where a particle is.
                fn position(fluid: *const Fluid<$T, $D>, index: u16, position: *mut [$T; $D]) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { tell((fluid, index), position, Particle::position) })
                }

                /// How fast a particle is.
                fn velocity(fluid: *const Fluid<$T, $D>, index: u16, velocity: *mut [$T; $D]) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { tell((fluid, index), velocity, Particle::velocity) })
                }

                /// The pressure of a particle.
                fn pressure(fluid: *const Fluid<$T, $D>, index: u16, pressure: *mut $T) -> i32 {
                    // SAFETY: as the header says.
                    of_result(unsafe { tell((fluid, index), pressure, Particle::pressure) })
                }

                $($more)*
            }
        }
    };
    // In two dimensions there are masks and pixels.
    ($(#[$about:meta])+ $module:ident, $prefix:literal, $T:ty) => {
        fluid! { $(#[$about])+ $module, $prefix, $T, 2, {
            /// An empty fluid in a bitmap.
            fn init_mask(
                memory: *mut c_void,
                bytes: usize,
                capacity: u16,
                bits: *const u8,
                width: u8,
                height: u8,
                pixel: $T,
                fluid: *mut *mut Fluid<$T, 2>,
            ) -> i32 {
                static WALLS: Walls<$T, 2> = Walls::of::<Mask<'static, $T>>();
                // SAFETY: as the header says.
                of_result(unsafe {
                    pointer::write(fluid, core::ptr::null_mut()).and_then(|()| {
                        let bits = pointer::slice(bits, usize::from(width.div_ceil(8)) * usize::from(height))?;
                        let container = Mask::new(bits, width, pixel).map_err(code::of)?;
                        fluid::init((memory, bytes), capacity, container, &WALLS, fluid)
                    })
                })
            }

            /// Draws the density of the fluid.
            fn draw(fluid: *const Fluid<$T, 2>, pixel: $T, columns: u16, rows: u16, density: *mut u8) -> i32 {
                // SAFETY: as the header says.
                of_result(unsafe { pixels::draw(fluid, pixel, [columns, rows], density) })
            }
        } }
    };
}

fluid! {
    /// The fluid in 32-bit floating point and two dimensions.
    f32_2d, "f32_2d_", f32
}
fluid! {
    /// The fluid in 16.16 fixed point and two dimensions.
    q16_2d, "q16_2d_", Q16
}
fluid! {
    /// The fluid in 32-bit floating point and three dimensions.
    f32_3d, "f32_3d_", f32, 3, {}
}
fluid! {
    /// The fluid in 16.16 fixed point and three dimensions.
    q16_3d, "q16_3d_", Q16, 3, {}
}

/// `fluisim_settings`: [`Settings`] as C lays it out.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Behaviour {
    /// Passes of density and correction a frame.
    pub iterations: u8,
    /// XSPH viscosity in 1/256.
    pub viscosity: u8,
    /// Cohesion in 1/256.
    pub cohesion: u8,
}

impl From<Settings> for Behaviour {
    fn from(Settings { iterations, viscosity, cohesion }: Settings) -> Self {
        Self { iterations, viscosity, cohesion }
    }
}

impl From<Behaviour> for Settings {
    fn from(Behaviour { iterations, viscosity, cohesion }: Behaviour) -> Self {
        Self { iterations, viscosity, cohesion }
    }
}

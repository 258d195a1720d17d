//! The C interface: pointers that are null, misaligned or of another type, sizes that are wrong, and any numbers.

use arbitrary::{Result, Unstructured};
use core::ffi::c_void;
use core::ptr::null_mut;
use fluisim_c::export::{Behaviour, f32_2d, q16_2d, q16_3d};
use fluisim_c::{Q16, code, fields};
use sph_core::Scalar;

use crate::numbers::{number, vector, vectors};

/// Calls of one input at most.
const MOST: usize = 60;

/// The first byte chooses the functions.
pub fn c(data: &[u8]) {
    let Some((&choice, rest)) = data.split_first() else { return };
    let bytes = &mut Unstructured::new(rest);
    // Bytes that end too soon end the input.
    let _ = match choice % 5 {
        0 => f32_in_2d(bytes),
        1 => q16_in_2d(bytes),
        2 => q16_in_3d(bytes),
        3 => f32_sums(bytes),
        _ => q16_sums(bytes),
    };
}

/// A pointer to a value, to null, or between two values.
fn pointer<T>(value: &mut T, bytes: &mut Unstructured) -> Result<*mut T> {
    let pointer: *mut T = value;
    Ok(match bytes.arbitrary::<u8>()? {
        0 => null_mut(),
        1 => pointer.wrapping_byte_add(1),
        _ => pointer,
    })
}

macro_rules! fluids {
    ($name:ident, $c:ident, $T:ty, $D:literal) => {
        fn $name(bytes: &mut Unstructured) -> Result<()> {
            let mut memory = vec![0_u64; 2048];
            let mut fluid = null_mut();
            let mut size = vector::<$T, $D>(bytes)?;
            let capacity = bytes.arbitrary::<u8>()?.into();
            // SAFETY: pointers are to locals, null, or misaligned, and sizes are at most those of what they point to.
            unsafe {
                let place: *mut c_void = memory.as_mut_ptr().cast();
                let place = if bytes.arbitrary::<u8>()? == 0 { place.byte_add(2) } else { place };
                let room = bytes.int_in_range(0..=8 * 2046)?;
                let made = if bytes.arbitrary()? {
                    $c::init_disc(place, room, capacity, size[0], pointer(&mut fluid, bytes)?)
                } else {
                    $c::init_box(place, room, capacity, pointer(&mut size, bytes)?, &raw mut fluid)
                };
                assert_eq!(made == code::OK, !fluid.is_null());
                for _ in 0..MOST {
                    let fluid = if bytes.arbitrary::<u8>()? == 0 { null_mut() } else { fluid };
                    let mut at = vector::<$T, $D>(bytes)?;
                    let (first, second) = (pointer(&mut at, bytes)?, pointer(&mut size, bytes)?);
                    let index = bytes.arbitrary::<u8>()?.into();
                    let code = match bytes.arbitrary::<u8>()? % 10 {
                        0 => $c::remove(fluid, index),
                        1 => $c::impulse(fluid, first, number(bytes)?, second),
                        2 => {
                            let [iterations, viscosity, cohesion] = bytes.arbitrary()?;
                            let mut settings = Behaviour { iterations: iterations % 8, viscosity, cohesion };
                            $c::set_settings(fluid, pointer(&mut settings, bytes)?)
                        }
                        3 | 4 => $c::step(fluid, first),
                        5 => $c::position(fluid, index, second),
                        6 => $c::count(fluid),
                        _ => $c::add(fluid, first, second),
                    };
                    assert!(
                        code >= 0 || fluisim_c::code::CODES.iter().any(|(_, known)| *known == code),
                        "{code}"
                    );
                    check(&|index, out| $c::position(fluid, index, out));
                }
            }
            Ok(())
        }
    };
}

/// All positions are numbers.
fn check<T: Scalar, const D: usize>(position: &dyn Fn(u16, *mut [T; D]) -> i32) {
    let mut found = [T::ZERO; D];
    let mut index = 0;
    while position(index, &raw mut found) == code::OK {
        assert!(found.iter().all(|along| along.is_finite()), "{found:?}");
        index += 1;
    }
}

fluids!(f32_in_2d, f32_2d, f32, 2);
fluids!(q16_in_2d, q16_2d, Q16, 2);
fluids!(q16_in_3d, q16_3d, Q16, 3);

macro_rules! sums {
    ($name:ident, $c:ident, $T:ty, $D:literal) => {
        fn $name(bytes: &mut Unstructured) -> Result<()> {
            let positions = vectors::<$T, $D>(bytes, 8)?;
            let count = positions.len();
            let masses = (0..count).map(|_| number(bytes)).collect::<Result<Vec<$T>>>()?;
            let (kernel, h): (i8, $T) = (bytes.arbitrary()?, number(bytes)?);
            let (mut point, mut gradient, mut value) = (vector(bytes)?, [<$T>::from_f64(7.0); $D], h);
            let mut densities = masses.clone();
            // SAFETY: pointers are to locals, null, or misaligned, and lengths are those of the vectors.
            unsafe {
                let (kernel, at, m) = (kernel.into(), positions.as_ptr().cast::<$T>(), masses.as_ptr());
                fields::$c::densities(kernel, h, at, m, count, densities.as_mut_ptr());
                let (x, v, g) = (
                    pointer(&mut point, bytes)?,
                    pointer(&mut value, bytes)?,
                    pointer(&mut gradient, bytes)?,
                );
                fields::$c::density(kernel, h, at, m, count, x, v, g);
                fields::$c::interpolate(kernel, h, at, m, densities.as_ptr(), count, x, v, g);
                fields::$c::shepard(kernel, h, at, m, densities.as_ptr(), count, x, v, g);
                if fields::$c::corrected(kernel, h, at, m, densities.as_ptr(), count, x, v, g) == code::OK {
                    assert!(value.is_finite() && gradient.iter().all(|along| along.is_finite()));
                }
            }
            Ok(())
        }
    };
}

sums!(f32_sums, f32_2d, f32, 2);
sums!(q16_sums, q16_3d, Q16, 3);

//! The fluid through the functions of C has the bits of `PositionBasedFluid`, in every container.

use core::ptr::null_mut;
use fluisim_c::export::{f32_2d, f32_3d, q16_2d, q16_3d};
use fluisim_c::{Q16, code};
use sph_core::fluid::{Container, Disc, Mask, OpenBox, Particle, PositionBasedFluid, Settings};
use sph_core::scalar::compact::Compact;
use sph_core::{Arithmetic, Scalar};

const CAPACITY: u16 = 64;
const CELLS: usize = 1024;
/// Few for Miri, which interprets, and of few particles.
const FRAMES: i32 = if cfg!(miri) { 3 } else { 400 };
const PARTICLES: i32 = if cfg!(miri) { 8 } else { 30 };
/// Of a hundred frames the one before which a particle is removed.
const REMOVED_IN: i32 = if cfg!(miri) { 1 } else { 50 };

/// Bits of a badge: two chambers and a door, pixels of side 2.
const BITS: [u8; 5] = [0b1110_1110, 0b1110_1110, 0b1111_1110, 0b1110_1110, 0b1110_1110];

type Rust<T, C, const D: usize> = PositionBasedFluid<T, C, D, { CAPACITY as usize }, CELLS, u16>;

/// Gravity that turns, with a shake: a number an axis.
fn acceleration<T: Arithmetic, const D: usize>(frame: i32) -> [T; D] {
    let turn = [[0, -6, 2], [4, -4, 0], [6, 0, -5], [-4, 4, 3]][(frame / 40 % 4) as usize];
    core::array::from_fn(|axis| T::ratio(turn[axis] + (frame * 7 % 5 - 2) * 3, 1000))
}

/// A place for the k-th particle, half a spacing from its neighbours, around the middle of a container of size 6 or more.
fn place<T: Arithmetic, const D: usize>(k: i32) -> [T; D] {
    let side = if D == 2 { 6 } else { 3 };
    let mut rest = k;
    core::array::from_fn(|_| {
        let column = rest % side;
        rest /= side;
        T::ratio(2 * column + 9, 4)
    })
}

fn bits<T: Scalar, const D: usize>(numbers: [T; D]) -> [u64; D] {
    numbers.map(Scalar::canonical_bits)
}

/// Runs the same scene through both; `$init` is the container's function and its arguments.
macro_rules! scene {
    ($c:ident, $T:ty, $D:literal, $container:expr, $init:ident($($argument:expr),+)) => {{
        let mut memory = vec![0_u64; 4096];
        let mut fluid = null_mut();
        let mut rust = Rust::<$T, _, $D>::with_settings($container, if $D == 3 { Settings::IN_3D } else { Settings::DEFAULT });
        // SAFETY: the memory is a vector's that lives until the end; the other pointers are to locals.
        unsafe {
            let bytes = 8 * memory.len();
            let made = $c::$init(memory.as_mut_ptr().cast(), bytes, CAPACITY, $($argument,)+ &raw mut fluid);
            assert_eq!(made, code::OK);
            for k in 0..PARTICLES {
                let position = place::<$T, $D>(k);
                let velocity = [<$T>::ratio(k % 7 - 3, 200); $D];
                rust.add(Particle::new(position, velocity)).unwrap();
                assert_eq!($c::add(fluid, &position, &velocity), code::OK);
            }
            for frame in 0..FRAMES {
                let acceleration = acceleration::<$T, $D>(frame);
                if frame % 100 == REMOVED_IN {
                    rust.remove(3).unwrap();
                    assert_eq!($c::remove(fluid, 3), code::OK);
                }
                rust.step(acceleration);
                assert_eq!($c::step(fluid, &acceleration), code::OK, "frame {frame}");
                // a poke of nothing changes nothing
                let (centre, nothing) = (place(7), [<$T>::ZERO; $D]);
                assert_eq!($c::impulse(fluid, &centre, <$T>::ratio(3, 1), &nothing), code::OK);
            }
            assert_eq!($c::count(fluid), rust.len() as i32);
            for (index, particle) in rust.particles().iter().enumerate() {
                let (mut position, mut velocity, mut pressure) = ([<$T>::ZERO; $D], [<$T>::ZERO; $D], <$T>::ZERO);
                assert_eq!($c::position(fluid, index as u16, &mut position), code::OK);
                assert_eq!($c::velocity(fluid, index as u16, &mut velocity), code::OK);
                assert_eq!($c::pressure(fluid, index as u16, &mut pressure), code::OK);
                assert_eq!(bits(position), bits(particle.position()), "{index}");
                assert_eq!(bits(velocity), bits(particle.velocity()), "{index}");
                assert_eq!(bits([pressure]), bits([particle.pressure()]), "{index}");
                assert!(rust.container().contains(&position));
            }
        }
    }};
}

/// The mask on both sides: a function gives it the type.
fn mask<T: Compact>() -> Mask<'static, T> {
    Mask::new(&BITS, 7, T::ratio(2, 1)).unwrap()
}

#[test]
fn a_box_is_the_same_in_rust_and_in_c() {
    let size = [6.5_f32, 7.25];
    scene!(f32_2d, f32, 2, OpenBox::new(size), init_box(&size));
    let size = [6.5_f32, 7.25, 5.0];
    scene!(f32_3d, f32, 3, OpenBox::new(size), init_box(&size));
    // not a multiple of the step that positions are kept to
    let size = [Q16::from_bits(425_987), Q16::from_bits(475_133)];
    scene!(q16_2d, Q16, 2, OpenBox::new(size), init_box(&size));
    let size = [size[0], size[1], size[0]];
    scene!(q16_3d, Q16, 3, OpenBox::new(size), init_box(&size));
}

#[test]
fn a_disc_is_the_same_in_rust_and_in_c() {
    scene!(f32_2d, f32, 2, Disc::new(3.9), init_disc(3.9));
    scene!(f32_3d, f32, 3, Disc::new(3.9), init_disc(3.9));
    let radius = Q16::from_bits(255_591);
    scene!(q16_2d, Q16, 2, Disc::new(radius), init_disc(radius));
    scene!(q16_3d, Q16, 3, Disc::new(radius), init_disc(radius));
}

#[test]
fn a_mask_is_the_same_in_rust_and_in_c() {
    scene!(f32_2d, f32, 2, mask::<f32>(), init_mask(BITS.as_ptr(), 7, 5, 2.0));
    scene!(q16_2d, Q16, 2, mask::<Q16>(), init_mask(BITS.as_ptr(), 7, 5, Q16::ratio(2, 1)));
}

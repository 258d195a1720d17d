//! Fields, pixels and lamps through the functions of C have the bits of sph-core; pointers that cannot be followed are refused.

use core::ptr::{null, null_mut};
use fluisim_c::fields::{self, f32_2d, f32_3d, q16_2d, q16_3d};
use fluisim_c::{Q16, code, export, pixels};
use sph_core::fluid::raster::{draw_density, lamp_after};
use sph_core::fluid::{Particle, PositionBasedFluid};
use sph_core::kernel::WendlandC2;
use sph_core::{Arithmetic, BruteForce, Field, KernelInfluence, Sources};

const COUNT: usize = 12;

/// Places a third of h apart, three in a row.
fn positions<T: Arithmetic, const D: usize>() -> [[T; D]; COUNT] {
    core::array::from_fn(|k| {
        let column = [k % 3, k / 3, k % 2];
        core::array::from_fn(|axis| T::ratio(column[axis] as i32 + 1, 3))
    })
}

/// The estimates of one number type and dimension at one point, through C and in Rust.
macro_rules! fields {
    ($c:ident, $T:ty, $D:literal, $volumes:ident) => {{
        let (positions, masses) = (positions::<$T, $D>(), [<$T>::ratio(1, 9); COUNT]);
        let values: [$T; COUNT] = core::array::from_fn(|k| <$T>::ratio(k as i32 - 4, 5));
        let (point, h) = ([<$T>::ratio(7, 10); $D], <$T>::ONE);
        let w = KernelInfluence::<$T, $D, WendlandC2>::new(h).unwrap();
        let sources = Sources::new(BruteForce::new(&positions).unwrap(), &masses[..]).unwrap();
        let mut expected = [<$T>::ZERO; COUNT];
        sources.density(&w, &mut expected).unwrap();
        // SAFETY: pointers to locals and their lengths.
        unsafe {
            let kernel = fields::kernel(c"wendland-c2".as_ptr());
            let at: *const $T = positions.as_ptr().cast();
            let (mut densities, mut volumes) = ([<$T>::ZERO; COUNT], [<$T>::ZERO; COUNT]);
            let made = $c::densities(kernel, h, at, masses.as_ptr(), COUNT, densities.as_mut_ptr());
            assert_eq!((made, densities), (code::OK, expected));
            let made = fields::$volumes(masses.as_ptr(), densities.as_ptr(), COUNT, volumes.as_mut_ptr());
            assert_eq!(made, code::OK);
            let (mut value, mut gradient) = (<$T>::ZERO, [<$T>::ZERO; $D]);
            let (v, g) = (&raw mut value, &raw mut gradient);
            assert_eq!($c::density(kernel, h, at, masses.as_ptr(), COUNT, &point, v, g), code::OK);
            assert_eq!((value, gradient), sources.density_gradient_at(&w, &point));
            let made = $c::density(kernel, h, at, masses.as_ptr(), COUNT, &point, v, null_mut());
            assert_eq!((made, value), (code::OK, sources.density_at(&w, &point)));

            let sources = Sources::new(BruteForce::new(&positions).unwrap(), &volumes[..]).unwrap();
            let field = Field::new(&sources, &values[..]).unwrap();
            let (volumes, values) = (volumes.as_ptr(), values.as_ptr());
            assert_eq!($c::interpolate(kernel, h, at, volumes, values, COUNT, &point, v, g), code::OK);
            assert_eq!((value, gradient), field.interpolate_with_gradient_at(&w, &point));
            let made = $c::interpolate(kernel, h, at, volumes, values, COUNT, &point, v, null_mut());
            assert_eq!((made, value), (code::OK, field.interpolate_at(&w, &point)));
            assert_eq!($c::shepard(kernel, h, at, volumes, values, COUNT, &point, v, g), code::OK);
            assert_eq!(Some((value, gradient)), field.shepard_gradient_at(&w, &point));
            assert_eq!($c::corrected(kernel, h, at, volumes, values, COUNT, &point, v, g), code::OK);
            let fit = field.corrected_at(&w, &point).unwrap();
            assert_eq!((value, gradient), (fit.value, fit.gradient));

            let far = [<$T>::ratio(50, 1); $D];
            let made = $c::shepard(kernel, h, at, volumes, values, COUNT, &far, v, g);
            assert_eq!(made, code::UNDEFINED);
            let made = $c::shepard(kernel, h, null(), volumes, values, COUNT, &point, v, g);
            assert_eq!(made, code::NULL);
            let odd = at.wrapping_byte_add(1);
            assert_eq!($c::shepard(kernel, h, odd, volumes, values, COUNT, &point, v, g), code::MISALIGNED);
            let made = $c::shepard(kernel, h, at, volumes, values, usize::MAX, &point, v, g);
            assert_eq!(made, code::BAD_ARGUMENT);
            assert_eq!($c::shepard(99, h, at, volumes, values, COUNT, &point, v, g), code::NOT_FOUND);
            assert_eq!($c::densities(kernel, h, null(), null(), 0, null_mut()), code::OK);
        }
    }};
}

#[test]
fn fields_are_the_same_in_rust_and_in_c() {
    fields!(f32_2d, f32, 2, f32_volumes);
    fields!(f32_3d, f32, 3, f32_volumes);
    fields!(q16_2d, Q16, 2, q16_volumes);
    fields!(q16_3d, Q16, 3, q16_volumes);
}

#[test]
fn kernels_have_their_names_and_their_numbers() {
    for number in 0..sph_core::kernel::LIST.len() as i32 {
        // SAFETY: the name is a string that ends with zero.
        assert_eq!(unsafe { fields::kernel(fields::kernel_name(number)) }, number);
    }
    // SAFETY: null and a string that ends with zero.
    unsafe {
        assert!(fields::kernel_name(-1).is_null() && fields::kernel_name(1000).is_null());
        assert_eq!(fields::kernel(null()), code::NULL);
        assert_eq!(fields::kernel(c"poly".as_ptr()), code::NOT_FOUND);
    }
}

#[test]
fn pixels_and_lamps_are_the_same_in_rust_and_in_c() {
    use sph_core::fluid::OpenBox;
    let mut rust = PositionBasedFluid::<f32, _, 2, 16, 64, u16>::new(OpenBox::new([4.0, 4.0]));
    let mut memory = [0_u64; 512];
    let mut fluid = null_mut();
    let (mut density, mut expected, mut lamps) = ([7; 64], [0; 64], [0; 64]);
    // SAFETY: the memory lives until the end; the other pointers are to locals and their lengths.
    unsafe {
        let (at, bytes) = (memory.as_mut_ptr().cast(), size_of_val(&memory));
        assert_eq!(export::f32_2d::init_box(at, bytes, 16, &[4.0, 4.0], &raw mut fluid), code::OK);
        for k in 0..8 {
            let (position, velocity) = ([0.5 + 0.25 * k as f32, 1.0], [0.0; 2]);
            rust.add(Particle::new(position, velocity)).unwrap();
            assert_eq!(export::f32_2d::add(fluid, &position, &velocity), code::OK);
        }
        draw_density(rust.particles(), 0.5, 8, &mut expected);
        assert_eq!(export::f32_2d::draw(fluid, 0.5, 8, 8, density.as_mut_ptr()), code::OK);
        assert_eq!(density, expected);
        assert!(density.iter().any(|&density| density > 0));
        assert_eq!(pixels::light_lamps(density.as_ptr(), 64, 40, 20, lamps.as_mut_ptr()), code::OK);
        assert_eq!(lamps, expected.map(|density| u8::from(lamp_after(false, density, 40, 20))));
        assert_eq!(pixels::light_lamps(density.as_ptr(), 64, 20, 40, lamps.as_mut_ptr()), code::BAD_ARGUMENT);
    }
}

/// Memory that is too small, null or not aligned makes no fluid, and what is no fluid is refused.
#[test]
fn what_is_no_fluid_is_refused() {
    use fluisim_c::export::{f32_2d, q16_3d};
    let mut memory = [0_u64; 512];
    let mut fluid = null_mut();
    // SAFETY: as above; what is no fluid is memory that may be read.
    unsafe {
        let at: *mut core::ffi::c_void = memory.as_mut_ptr().cast();
        for (at, bytes) in [(null_mut(), 4096), (at, 16), (at, 0), (at.byte_add(1), 4000)] {
            assert_ne!(f32_2d::init_box(at, bytes, 16, &[4.0, 4.0], &raw mut fluid), code::OK);
            assert!(fluid.is_null());
        }
        assert_eq!(f32_2d::step(at.cast(), &[0.0; 2]), code::NOT_INITIALISED);
        assert_eq!(f32_2d::count(null()), code::NULL);
        assert_eq!(f32_2d::init_box(at, 4096, 16, &[4.0, 4.0], &raw mut fluid), code::OK);
        assert_eq!(q16_3d::count(fluid.cast()), code::NOT_INITIALISED);
        assert_eq!(f32_2d::position(fluid, 0, &mut [0.0; 2]), code::NOT_FOUND);
        assert_eq!(f32_2d::remove(fluid, 0), code::NOT_FOUND);
        assert_eq!(f32_2d::step(fluid, &[f32::NAN, 0.0]), code::NOT_FINITE);
        assert_eq!(f32_2d::step(fluid, null()), code::NULL);
        for _ in 0..16 {
            assert_eq!(f32_2d::add(fluid, &[1.0, 1.0], &[0.0; 2]), code::OK);
        }
        assert_ne!(f32_2d::add(fluid, &[1.0, 1.0], &[0.0; 2]), code::OK);
        assert_eq!(f32_2d::step(fluid, &[0.0, -0.01]), code::OK);
    }
}

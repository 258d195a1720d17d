//! Counts the instructions of a pair of samples, for every kernel, and of the cell grid.

#![no_std]
#![no_main]

use core::hint::black_box;
use fluisim_firmware::{clock, entry, exit};
use sph_core::kernel::{self, Kernel, Poly6, Tabulated, WendlandC2};
use sph_core::scalar::fixed::{I4F12, I16F16, Saturating, Wrapping};
use sph_core::{
    CellGrid, CellLayout, Error, Field, InlineCellGrid, KernelInfluence, Neighbours, Open, Scalar, Sources,
    Uniform,
};

const SAMPLES: usize = 64;

type Grid<'a, T> = CellGrid<'a, T, u8, 2, Open>;

#[entry]
fn main() -> ! {
    clock::start();
    let counted = in_scalar::<f32>("f32")
        .and_then(|()| in_scalar::<Saturating<I16F16>>("saturating i16f16"))
        .and_then(|()| in_scalar::<Wrapping<I16F16>>("wrapping i16f16"))
        .and_then(|()| in_16_bits::<Saturating<I4F12>>("saturating i4f12"))
        .and_then(|()| in_16_bits::<Wrapping<I4F12>>("wrapping i4f12"));
    exit(counted.is_ok())
}

fn in_scalar<T: Scalar>(scalar: &str) -> Result<(), Error> {
    macro_rules! all {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {$(
            if !kernel::$Kernel::SINGULAR {
                of_kernel::<T, kernel::$Kernel>(scalar, $name)?;
            }
        )+};
    }
    sph_core::for_each_kernel!(all);
    of_kernel::<T, Tabulated<WendlandC2, 65>>(scalar, "table of wendland c2")?;
    of_grid::<T>(scalar)
}

/// The kernels whose constants are in the range of 16 bits.
fn in_16_bits<T: Scalar>(scalar: &str) -> Result<(), Error> {
    of_kernel::<T, Poly6>(scalar, "poly6")?;
    of_kernel::<T, WendlandC2>(scalar, "wendland-c2")?;
    of_kernel::<T, Tabulated<WendlandC2, 65>>(scalar, "table of wendland c2")?;
    of_grid::<T>(scalar)
}

fn row(scalar: &str, work: &str, unit: &str, tenths: u32) {
    defmt::println!("{=str},{=str},{=str},{=u32}.{=u32}", scalar, work, unit, tenths / 10, tenths % 10);
}

/// The first `N` samples' instructions of `work` on a grid, less those on an empty one, for each sample.
fn a_pair<T: Scalar>(
    positions: &[[T; 2]],
    work: impl Fn(Grid<'_, T>, &[T; 2]) -> Result<T, Error>,
) -> Result<u32, Error> {
    let x = [T::ratio(3, 5), T::ratio(1, 2)];
    let taken = |positions: &[[T; 2]]| {
        let mut storage = InlineCellGrid::<u8, 17, SAMPLES>::new();
        let grid = storage.build(CellLayout::unbounded(T::ONE, [4, 4])?.open(), positions)?;
        work(grid, &x)?;
        Ok(clock::tenths(|| {
            let _ = black_box(work(grid, black_box(&x)));
        }))
    };
    Ok((taken(positions)? - taken(&[])?) / SAMPLES as u32)
}

fn of_kernel<T: Scalar, K: Kernel>(scalar: &str, kernel: &str) -> Result<(), Error> {
    let w = &KernelInfluence::<T, 2, K>::new(T::ONE)?;
    let place = |i: usize| T::ratio(10 + 9 * (i % 8) as i32, 100);
    let near: [[T; 2]; SAMPLES] = core::array::from_fn(|i| [place(i), place(i / 8)]);
    let far = [[T::ratio(3, 2); 2]; SAMPLES];
    let density = |grid: Grid<'_, T>, x: &[T; 2]| Ok(Sources::new(grid, Uniform(T::ONE))?.density_at(w, x));
    let gradient = |grid: Grid<'_, T>, x: &[T; 2]| {
        let sources = Sources::new(grid, Uniform(T::ratio(1, 64)))?;
        let [x, y] = Field::new(&sources, Uniform(T::ratio(3, 2)))?.gradient_at(w, x);
        Ok(x + y)
    };
    let equal =
        |grid: Grid<'_, T>, x: &[T; 2]| Ok(Sources::new(grid, Uniform(T::ONE))?.equal_density_at(w, x));
    row(scalar, kernel, "density of a pair out of reach", a_pair(&far, density)?);
    row(scalar, kernel, "density of a pair in reach", a_pair(&near, density)?);
    row(scalar, kernel, "density of equal masses of a pair in reach", a_pair(&near, equal)?);
    row(scalar, kernel, "gradient of a pair in reach", a_pair(&near, gradient)?);
    Ok(())
}

/// Eight by eight samples with spacing h/2, so 13 are in reach of each one inside.
fn of_grid<T: Scalar>(scalar: &str) -> Result<(), Error> {
    let positions: [[T; 2]; SAMPLES] =
        core::array::from_fn(|i| [T::ratio((i % 8) as i32, 2), T::ratio((i / 8) as i32, 2)]);
    let mut storage = InlineCellGrid::<u8, 17, SAMPLES>::new();
    let layout = CellLayout::unbounded(T::ONE, [4, 4])?.open();
    let build = clock::tenths(|| {
        black_box(storage.build(layout, black_box(&positions)).is_ok());
    });
    row(scalar, "cell grid", "rebuild for a sample", build / SAMPLES as u32);
    let grid = storage.build(layout, &positions)?;
    let query = clock::tenths(|| {
        for x in black_box(&positions) {
            black_box(grid.count(x, T::ONE));
        }
    });
    row(scalar, "cell grid", "query for a sample", query / SAMPLES as u32);
    Ok(())
}

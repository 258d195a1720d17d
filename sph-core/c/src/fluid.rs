//! The fluid in the caller's memory.
//!
//! ```text
//! 0          Fluid and its container, HEAD bytes
//! HEAD       `capacity` particles, of which `len` are there
//! …          `cells` numbers of 16 bits, the starts of the cells, for the solver alone
//! ```
//!
//! The functions here are written once, for both number types and dimensions. What depends on the container goes through a
//! table of functions that `init` stores, so that firmware holds the code of those containers alone that it makes.

use crate::{code, pointer};
use core::ffi::c_void;
use sph_core::fluid::{BorrowedFluid, Container, Disc, Particle, Settings};
use sph_core::scalar::compact::Compact;
use sph_core::{Error, Scalar};

/// Bytes before the particles: `16 + 6 * sizeof(void *)` in the header.
pub const HEAD: usize = 16 + 6 * size_of::<usize>();

/// The head of a fluid. C knows it as an opaque type.
#[repr(C)]
#[derive(Debug)]
pub struct Fluid<T: Compact, const D: usize> {
    kind: u32,
    cells: u32,
    pub(crate) walls: &'static Walls<T, D>,
    pub(crate) capacity: u16,
    pub(crate) len: u16,
    settings: Settings,
}

/// A head with the container behind it.
#[repr(C)]
struct Contained<T: Compact, C, const D: usize> {
    fluid: Fluid<T, D>,
    container: C,
}

/// What depends on the container. Both take a fluid that [`init`] made with this table.
#[derive(Debug)]
pub struct Walls<T: Compact, const D: usize> {
    pub(crate) contains: unsafe fn(*const Fluid<T, D>, &[T; D]) -> bool,
    step: unsafe fn(*mut Fluid<T, D>, *const [T; D]) -> i32,
}

impl<T: Compact, const D: usize> Walls<T, D> {
    /// The table of a container.
    #[must_use]
    pub const fn of<C: Container<T, D>>() -> Self {
        const {
            assert!(size_of::<Contained<T, C, D>>() <= HEAD, "HEAD is too small");
            assert!(align_of::<Contained<T, C, D>>() == align_of::<usize>(), "alignment of the head");
            assert!(align_of::<Particle<T, D>>() <= 4 && HEAD.is_multiple_of(align_of::<usize>()));
        }
        Self { contains: contains::<T, C, D>, step: step_in::<T, C, D> }
    }
}

/// What marks a fluid of this number type and dimension; the names of the two types differ in length.
const fn kind<T: Compact, const D: usize>() -> u32 {
    0x666c_7500 + 16 * T::NAME.len() as u32 + D as u32
}

impl<T: Compact, const D: usize> Fluid<T, D> {
    /// The memory of a fluid in bytes; the largest number there is where it is too much for the processor.
    #[must_use]
    pub fn bytes(capacity: u16, cells: u32) -> usize {
        // what `capacity` particles and the head take at most is far below the largest number
        const { assert!(Self::UP_TO_STARTS < isize::MAX as usize) };
        let most = (isize::MAX as usize).saturating_sub(Self::UP_TO_STARTS) / size_of::<u16>();
        match usize::try_from(cells) {
            Ok(cells) if cells <= most => HEAD
                .wrapping_add(usize::from(capacity).wrapping_mul(size_of::<Particle<T, D>>()))
                .wrapping_add(cells.wrapping_mul(size_of::<u16>())),
            _ => usize::MAX,
        }
    }

    /// What the head and the most particles there can be take.
    const UP_TO_STARTS: usize = HEAD + u16::MAX as usize * size_of::<Particle<T, D>>();

    /// How many particles there are.
    #[must_use]
    pub fn len(&self) -> u16 {
        self.len
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// How many particles there is room for.
    #[must_use]
    pub fn capacity(&self) -> u16 {
        self.capacity
    }

    /// How it behaves.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.settings
    }
}

/// The head, after a look at whether there is one.
///
/// # Safety
/// A pointer that is not null points to memory that `init` was called for, or to `HEAD` bytes; nobody else uses it during `'a`.
///
/// # Errors
/// As [`pointer::check`]; [`code::NOT_INITIALISED`].
pub unsafe fn head<'a, T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
) -> Result<&'a mut Fluid<T, D>, i32> {
    pointer::check(fluid)?;
    // SAFETY: aligned, and a u32 in the caller's memory.
    if unsafe { (&raw const (*fluid).kind).read() } != kind::<T, D>() {
        return Err(code::NOT_INITIALISED);
    }
    // SAFETY: `init` wrote a whole head before it wrote this kind.
    Ok(unsafe { &mut *fluid })
}

/// The room for the particles.
///
/// # Safety
/// `init` made the fluid.
pub(crate) unsafe fn room<T: Compact, const D: usize>(fluid: *mut Fluid<T, D>) -> *mut Particle<T, D> {
    // SAFETY: the memory has HEAD bytes and then the particles, whose alignment is at most the head's.
    unsafe { fluid.byte_add(HEAD) }.cast()
}

/// The particles.
///
/// # Safety
/// As [`head`].
///
/// # Errors
/// As [`head`].
pub unsafe fn particles<'a, T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
) -> Result<&'a mut [Particle<T, D>], i32> {
    // SAFETY: as this function.
    let len = unsafe { head(fluid) }?.len;
    // SAFETY: `add` wrote the first `len` particles; nobody else uses them by the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts_mut(room(fluid), len.into()) })
}

/// Makes an empty fluid in the caller's memory and writes a pointer to it. Memory that is refused is left as it is.
///
/// # Safety
/// `memory` points to `bytes` bytes that nobody else uses as long as the fluid is used, `fluid` to room for a pointer.
///
/// # Errors
/// [`code::BAD_ARGUMENT`] for a container whose size the solver refuses, [`code::TOO_SMALL`], and as [`pointer::check`].
pub unsafe fn init<T: Compact, C: Container<T, D>, const D: usize>(
    (memory, bytes): (*mut c_void, usize),
    capacity: u16,
    container: C,
    walls: &'static Walls<T, D>,
    fluid: *mut *mut Fluid<T, D>,
) -> Result<(), i32> {
    let place: *mut Contained<T, C, D> = memory.cast();
    pointer::check(place)?;
    let cells = cells(&container)?;
    if capacity == 0 {
        return Err(code::BAD_ARGUMENT);
    }
    let needed = Fluid::<T, D>::bytes(capacity, cells);
    if bytes < needed {
        return Err(code::TOO_SMALL);
    }
    let settings = if D == 3 { Settings::IN_3D } else { Settings::DEFAULT };
    let head = Fluid { kind: kind::<T, D>(), cells, walls, capacity, len: 0, settings };
    // SAFETY: `fluid` as this function; `place` is aligned and has `needed` bytes, HEAD of which are enough for the head and its
    // container; the starts lie behind the room for `capacity` particles, at an even address.
    unsafe {
        pointer::write(fluid, place.cast())?;
        place.write(Contained { fluid: head, container });
        starts(place.cast::<Fluid<T, D>>()).write_bytes(0, cells as usize);
    }
    Ok(())
}

/// The cells that the solver needs for a container: a solver without any says so.
fn cells<T: Compact, C: Container<T, D>, const D: usize>(container: &C) -> Result<u32, i32> {
    if !container.size().iter().all(|&length| length >= T::ratio(1, 4)) {
        return Err(code::BAD_ARGUMENT);
    }
    match BorrowedFluid::<T, C, D, u16>::trusted(container, Settings::DEFAULT, &mut [], &mut []) {
        Err(Error::CapacityExceeded { needed, .. }) => u32::try_from(needed).map_err(|_| code::TOO_SMALL),
        _ => Err(code::BAD_ARGUMENT),
    }
}

/// The starts of the cells.
///
/// # Safety
/// `init` wrote the head.
unsafe fn starts<T: Compact, const D: usize>(fluid: *mut Fluid<T, D>) -> *mut u16 {
    // SAFETY: the memory has room for `capacity` particles and then for the starts.
    unsafe { room(fluid).add((*fluid).capacity.into()).cast() }
}

/// # Safety
/// `init` made the fluid with a container of type `C`.
unsafe fn contains<T: Compact, C: Container<T, D>, const D: usize>(
    fluid: *const Fluid<T, D>,
    x: &[T; D],
) -> bool {
    // SAFETY: as this function.
    unsafe { &(*fluid.cast::<Contained<T, C, D>>()).container }.contains(x)
}

/// # Safety
/// `init` made the fluid with a container of type `C`; nobody else uses its memory. `acceleration` points to numbers.
unsafe fn step_in<T: Compact, C: Container<T, D>, const D: usize>(
    fluid: *mut Fluid<T, D>,
    acceleration: *const [T; D],
) -> i32 {
    // SAFETY: as this function; container, particles and starts lie apart from each other, and all of them are written.
    let (container, settings, particles, starts, acceleration) = unsafe {
        let Contained { fluid: head, container } = &*fluid.cast::<Contained<T, C, D>>();
        let particles = core::slice::from_raw_parts_mut(room(fluid), head.len.into());
        let starts = core::slice::from_raw_parts_mut(starts(fluid), head.cells as usize);
        (container, head.settings, particles, starts, *acceleration)
    };
    // `add` lets no particle in that is outside, and the solver keeps all of them inside
    match BorrowedFluid::<T, C, D, u16>::trusted(container, settings, particles, starts) {
        Ok(mut solver) => {
            solver.step(acceleration);
            code::OK
        }
        Err(_) => code::NOT_INITIALISED,
    }
}

/// Moves the fluid by a frame.
///
/// # Safety
/// As [`head`]; `acceleration` as [`pointer::read`].
///
/// # Errors
/// [`code::NOT_FINITE`], and as [`head`]; the fluid is then as before.
pub unsafe fn step<T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
    acceleration: *const [T; D],
) -> Result<(), i32> {
    // SAFETY: as this function; `init` stored the table that belongs to the container.
    let code = unsafe {
        given(fluid, acceleration)?;
        ((*fluid).walls.step)(fluid, acceleration)
    };
    code::to_result(code)
}

/// Looks at a fluid and at numbers for it: [`head`] and [`finite`] in one, compiled once for all that need both.
///
/// # Safety
/// As [`head`], but nothing is written; `numbers` as [`pointer::read`].
///
/// # Errors
/// As [`head`], then as [`finite`].
pub unsafe fn given<T: Compact, const D: usize>(
    fluid: *const Fluid<T, D>,
    numbers: *const [T; D],
) -> Result<(), i32> {
    #[inline(never)]
    unsafe fn code<T: Compact, const D: usize>(fluid: *const Fluid<T, D>, numbers: *const [T; D]) -> i32 {
        // SAFETY: as `given`.
        code::of_result(unsafe { head(fluid.cast_mut()).and_then(|_| finite(numbers).map(|_| ())) })
    }
    // SAFETY: as this function.
    code::to_result(unsafe { code(fluid, numbers) })
}

/// Numbers of the caller that have to be finite.
///
/// # Safety
/// As [`pointer::read`].
///
/// # Errors
/// [`code::NOT_FINITE`], and as [`pointer::check`].
pub unsafe fn finite<T: Scalar, const D: usize>(numbers: *const [T; D]) -> Result<[T; D], i32> {
    #[inline(never)]
    unsafe fn code<T: Scalar, const D: usize>(numbers: *const [T; D]) -> i32 {
        // SAFETY: as `finite`.
        code::of_result(unsafe { pointer::read(numbers) }.and_then(|numbers| {
            if numbers.iter().all(|number| number.is_finite()) { Ok(()) } else { Err(code::NOT_FINITE) }
        }))
    }
    // SAFETY: as this function; `code` looked at the pointer.
    code::to_result(unsafe { code(numbers) }).map(|()| unsafe { *numbers })
}

/// A disc, if the solver can work with its radius.
///
/// # Errors
/// [`code::NOT_FINITE`]; [`code::BAD_ARGUMENT`] for a radius below 1.
pub fn disc<T: Scalar>(radius: T) -> Result<Disc<T>, i32> {
    if !radius.is_finite() {
        return Err(code::NOT_FINITE);
    }
    if radius < T::ONE { Err(code::BAD_ARGUMENT) } else { Ok(Disc::new(radius)) }
}

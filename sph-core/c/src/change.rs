//! What changes a fluid between frames: particles added and removed, and pokes.

use crate::code;
use crate::fluid::{self, Fluid};
use sph_core::fluid::Particle;
use sph_core::scalar::compact::Compact;
use sph_core::vector::{norm_squared, sub};

/// Adds a particle; a null `velocity` is one at rest.
///
/// # Safety
/// As [`fluid::head`]; `position` and a `velocity` that is not null as [`crate::pointer::read`].
///
/// # Errors
/// [`code::FULL`], [`code::OUTSIDE`], [`code::NOT_FINITE`], and as [`fluid::head`]; the fluid is then as before.
pub(crate) unsafe fn add<T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
    position: *const [T; D],
    velocity: *const [T; D],
) -> Result<(), i32> {
    let at_rest = [T::ZERO; D];
    let velocity = if velocity.is_null() { &raw const at_rest } else { velocity };
    // SAFETY: as this function; `given` looked at the fluid and at both.
    let (head, position, velocity) = unsafe {
        fluid::given(fluid, position)?;
        fluid::given(fluid, velocity)?;
        (&mut *fluid, &*position, &*velocity)
    };
    let contains = head.walls.contains;
    // SAFETY: `init` stored the table that belongs to the container.
    if !unsafe { contains(fluid, position) } {
        return Err(code::OUTSIDE);
    }
    if head.len >= head.capacity {
        return Err(code::FULL);
    }
    let particle = Particle::trusted(*position, *velocity);
    // SAFETY: there is room for `capacity` particles, which is more than `len`.
    unsafe { fluid::room(fluid).add(head.len.into()).write(particle) };
    head.len = head.len.wrapping_add(1);
    Ok(())
}

/// Removes a particle and puts the last one in its place.
///
/// # Safety
/// As [`fluid::head`].
///
/// # Errors
/// [`code::NOT_FOUND`], and as [`fluid::head`].
pub(crate) unsafe fn remove<T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
    index: u16,
) -> Result<(), i32> {
    // SAFETY: as this function.
    let particles = unsafe { fluid::particles(fluid) }?;
    let last = *particles.last().ok_or(code::NOT_FOUND)?;
    let len = particles.len().wrapping_sub(1) as u16;
    *particles.get_mut(usize::from(index)).ok_or(code::NOT_FOUND)? = last;
    // SAFETY: as this function; the particles are not used any more.
    unsafe { fluid::head(fluid) }?.len = len;
    Ok(())
}

/// Adds `change` to the velocity of the particles no farther than `radius` from `centre`. The result is held at ±1 along each axis.
///
/// # Safety
/// As [`fluid::head`]; `centre` and `change` as [`crate::pointer::read`].
///
/// # Errors
/// [`code::NOT_FINITE`], [`code::BAD_ARGUMENT`] for a radius below 0, and as [`fluid::head`]; the fluid is then as before.
pub(crate) unsafe fn impulse<T: Compact, const D: usize>(
    fluid: *mut Fluid<T, D>,
    centre: *const [T; D],
    radius: T,
    change: *const [T; D],
) -> Result<(), i32> {
    // SAFETY: as this function; `given` looked at the fluid and at both.
    let (particles, centre, change) = unsafe {
        fluid::given(fluid, centre)?;
        fluid::given(fluid, change)?;
        (fluid::particles(fluid)?, *centre, *change)
    };
    if !radius.is_finite() {
        return Err(code::NOT_FINITE);
    }
    if radius < T::ZERO {
        return Err(code::BAD_ARGUMENT);
    }
    for particle in particles {
        let offset = sub(&particle.position(), &centre);
        // along each axis first: a square may end at the largest number of the range
        let is_near = offset.iter().all(|along| along.abs() <= radius);
        if is_near && norm_squared(&offset) <= radius * radius {
            let velocity = sph_core::vector::add(&particle.velocity(), &change);
            *particle = Particle::new(particle.position(), velocity).with_pressure(particle.pressure());
        }
    }
    Ok(())
}

//! From pointers of the caller to references: null and misaligned ones are refused; that the rest is right, the caller promises.

use crate::code;

/// Refuses what no reference can be made of.
///
/// # Errors
/// [`code::NULL`], [`code::MISALIGNED`].
pub fn check<T>(pointer: *const T) -> Result<(), i32> {
    if pointer.is_null() {
        Err(code::NULL)
    } else if !pointer.is_aligned() {
        Err(code::MISALIGNED)
    } else {
        Ok(())
    }
}

/// Refuses an array that is larger than memory can be.
fn check_array<T>(pointer: *const T, count: usize) -> Result<(), i32> {
    check(pointer)?;
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if bytes <= isize::MAX as usize => Ok(()),
        _ => Err(code::BAD_ARGUMENT),
    }
}

/// A value at the pointer.
///
/// # Safety
/// A pointer that is not null points to a `T` that may be read.
///
/// # Errors
/// As [`check`].
pub unsafe fn read<T: Copy>(pointer: *const T) -> Result<T, i32> {
    check(pointer)?;
    // SAFETY: not null, aligned, and a `T` by the caller's promise.
    Ok(unsafe { pointer.read() })
}

/// Writes a value to the pointer.
///
/// # Safety
/// A pointer that is not null points to room for a `T`.
///
/// # Errors
/// As [`check`].
pub unsafe fn write<T: Copy>(pointer: *mut T, value: T) -> Result<(), i32> {
    check(pointer)?;
    // SAFETY: not null, aligned, and room for a `T` by the caller's promise.
    unsafe { pointer.write(value) };
    Ok(())
}

/// Elements that are only read. None need no pointer.
///
/// # Safety
/// A pointer that is not null points to `count` elements, which nobody writes during `'a`.
///
/// # Errors
/// As [`check`]; [`code::BAD_ARGUMENT`] for more than memory can hold.
pub unsafe fn slice<'a, T>(pointer: *const T, count: usize) -> Result<&'a [T], i32> {
    if count == 0 {
        return Ok(&[]);
    }
    check_array(pointer, count)?;
    // SAFETY: not null, aligned, not larger than memory; `count` elements that nobody writes by the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts(pointer, count) })
}

/// Elements that are written. None need no pointer.
///
/// # Safety
/// A pointer that is not null points to `count` elements, which nobody else uses during `'a`.
///
/// # Errors
/// As [`slice()`].
pub unsafe fn slice_mut<'a, T>(pointer: *mut T, count: usize) -> Result<&'a mut [T], i32> {
    if count == 0 {
        return Ok(&mut []);
    }
    check_array(pointer, count)?;
    // SAFETY: not null, aligned, not larger than memory; `count` elements for us alone by the caller's promise.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, count) })
}

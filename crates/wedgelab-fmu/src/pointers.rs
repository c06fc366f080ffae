//! Pointers and counts from C, checked before they are used.

use std::ffi::{CStr, c_char};

use fmi::{Error, limits};

/// Returns the error of a pointer that is null, or cannot be one.
pub(crate) fn missing(what: &str) -> Error {
    Error::new(format!(
        "the pointer to {what} is null (or not aligned): give the address of as many of them as the call says"
    ))
}

/// Checks whether a call may be about so many values. (More than half of the address space are none at all.)
fn check_count<T>(count: usize, what: &str) -> Result<(), Error> {
    let most = if size_of::<T>() == 1 {
        limits::RECORD_FILE as usize
    } else {
        limits::FMU_VALUES
    };
    if count <= most {
        return Ok(());
    }
    Err(Error::new(format!(
        "{count} is given as the number of {what}; at most {most} are taken in one call"
    )))
}

/// Returns the slice that C means by a pointer and a count.
///
/// # Safety
/// A pointer that is not null points to so many values, which nobody changes while the slice lives.
pub(crate) unsafe fn slice<'a, T>(pointer: *const T, count: usize, what: &str) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    check_count::<T>(count, what)?;
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Returns the same to be written to.
///
/// # Safety
/// A pointer that is not null points to so many values, which nobody else uses while the slice lives.
pub(crate) unsafe fn slice_mut<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [T], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    check_count::<T>(count, what)?;
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Writes one value.
///
/// # Safety
/// A pointer that is not null may be written to.
pub(crate) unsafe fn put<T>(pointer: *mut T, value: T, what: &str) -> Result<(), Error> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    unsafe { pointer.write(value) };
    Ok(())
}

/// Returns a string from C.
///
/// # Safety
/// A pointer that is not null points to a string that ends with a zero byte and lives as long as the
/// reference.
pub(crate) unsafe fn string<'a>(pointer: *const c_char, what: &str) -> Result<&'a str, Error> {
    if pointer.is_null() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str()
        .map_err(|_| Error::new(format!("{what} is not UTF-8")))
}

/// Names of log categories from C.
///
/// # Safety
/// As [`slice`] and [`string`].
pub(crate) unsafe fn strings<'a>(
    pointer: *const *const c_char,
    count: usize,
    what: &str,
) -> Result<Vec<&'a str>, Error> {
    // SAFETY: by this function's contract.
    let pointers = unsafe { slice(pointer, count, what) }?;
    pointers
        .iter()
        // SAFETY: by this function's contract.
        .map(|pointer| unsafe { string(*pointer, what) })
        .collect()
}

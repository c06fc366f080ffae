//! Saved states behind pointers, and as bytes.

use std::ffi::c_void;

use fmi::Error;
use fmi::instance::Saved;

use crate::component::Component;
use crate::handles::{HandleKind, hand_out, is_alive, take_back};
use crate::pointers::{missing, put, slice, slice_mut};

/// A saved state behind a pointer.
type SavedState = Saved;

/// Returns the error of a pointer that leads to no saved state.
fn no_state(what: &str) -> Error {
    Error::new(format!(
        "the pointer to {what} leads to no state that is alive: it was freed, or comes from elsewhere; set \
         pointers to null before their first use"
    ))
}

/// Saves the instance's state where `target` points to, into what is there already or anew.
///
/// # Safety
/// `target` is null or points to a pointer that nobody else uses at the same time, nor the state it leads to.
pub(crate) unsafe fn save(component: &Component, target: *mut *mut c_void) -> Result<(), Error> {
    // SAFETY: by this function's contract.
    let [place] = (unsafe { slice_mut(target, 1, "the state") })? else {
        return Err(missing("the state"));
    };
    let saved: SavedState = component.instance.save();
    if place.is_null() {
        *place = hand_out(saved, HandleKind::State);
    } else if is_alive(*place, HandleKind::State) {
        // SAFETY: it is a state from here, which is alive, and by this function's contract nobody uses it.
        unsafe { *place.cast::<SavedState>() = saved };
    } else {
        return Err(no_state("the state to be written over"));
    }
    Ok(())
}

/// Returns the saved state behind a pointer.
///
/// # Safety
/// Nobody writes to the state or frees it while the reference lives.
pub(crate) unsafe fn saved<'a>(pointer: *mut c_void) -> Result<&'a SavedState, Error> {
    if pointer.is_null() {
        return Err(missing("the state"));
    }
    if !is_alive(pointer, HandleKind::State) {
        return Err(no_state("the state"));
    }
    // SAFETY: it is a state from here, which is alive and by this function's contract stays as it is.
    Ok(unsafe { &*pointer.cast::<SavedState>() })
}

/// Frees a saved state and sets its pointer to null.
///
/// # Safety
/// As [`save`].
pub(crate) unsafe fn free_saved(target: *mut *mut c_void) -> Result<(), Error> {
    if target.is_null() {
        return Ok(());
    }
    // SAFETY: by this function's contract.
    let [place] = (unsafe { slice_mut(target, 1, "the state") })? else {
        return Err(missing("the state"));
    };
    // SAFETY: by this function's contract; states are saved states.
    if !place.is_null() && !unsafe { take_back::<SavedState>(*place, HandleKind::State) } {
        return Err(no_state("the state to be freed"));
    }
    *place = std::ptr::null_mut();
    Ok(())
}

/// Writes a saved state as bytes.
///
/// # Safety
/// As [`saved`] and [`slice_mut`].
pub(crate) unsafe fn serialize(state: *mut c_void, target: *mut u8, size: usize) -> Result<(), Error> {
    // SAFETY: by this function's contract.
    let bytes = unsafe { saved(state) }?.to_bytes()?;
    if size < bytes.len() {
        return Err(Error::new(format!(
            "room for {size} bytes of a state that takes {}: the function that tells the size of a \
             serialized state tells it",
            bytes.len()
        )));
    }
    // SAFETY: by this function's contract.
    let target = unsafe { slice_mut(target, size, "the bytes") }?;
    let (head, tail) = target.split_at_mut(bytes.len());
    head.copy_from_slice(&bytes);
    // Blanks after JSON mean nothing.
    tail.fill(b' ');
    Ok(())
}

/// Reads a saved state from bytes.
///
/// # Safety
/// As [`slice`] and [`save`].
pub(crate) unsafe fn deserialize(
    bytes: *const u8,
    size: usize,
    target: *mut *mut c_void,
) -> Result<(), Error> {
    // SAFETY: by this function's contract.
    let bytes = unsafe { slice(bytes, size, "the bytes") }?;
    let state = SavedState::from_bytes(bytes)?;
    // SAFETY: by this function's contract. What the place held before is not freed: it may be uninitialized.
    unsafe {
        put(target, std::ptr::null_mut(), "the state")?;
        put(target, hand_out(state, HandleKind::State), "the state")?;
    }
    Ok(())
}

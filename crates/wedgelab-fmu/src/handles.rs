//! The pointers given to importers that are alive: one that was freed, or never was one of ours, is
//! recognized before it is used.

use std::collections::BTreeMap;
use std::ffi::c_void;
use std::sync::{PoisonError, RwLock};

/// The kind of a pointer's target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HandleKind {
    /// An instance.
    Instance,
    /// A saved state.
    State,
}

static ALIVE: RwLock<BTreeMap<usize, HandleKind>> = RwLock::new(BTreeMap::new());

/// Returns a pointer for something that C keeps.
pub(crate) fn hand_out<T>(thing: T, kind: HandleKind) -> *mut c_void {
    let pointer: *mut c_void = Box::into_raw(Box::new(thing)).cast();
    let mut alive = ALIVE.write().unwrap_or_else(PoisonError::into_inner);
    alive.insert(pointer as usize, kind);
    pointer
}

/// Returns whether a pointer comes from [`hand_out`] for this kind and has not been taken back. (Another
/// thing of this kind may have come to lie where a freed one was.)
pub(crate) fn is_alive(pointer: *const c_void, kind: HandleKind) -> bool {
    let alive = ALIVE.read().unwrap_or_else(PoisonError::into_inner);
    alive.get(&(pointer as usize)) == Some(&kind)
}

/// Frees a value that [`hand_out`] returned. Returns whether there was one.
///
/// # Safety
/// Every handle of this kind holds a value of type `T`, and nobody uses it at the same time.
pub(crate) unsafe fn take_back<T>(pointer: *mut c_void, kind: HandleKind) -> bool {
    let found = {
        let mut alive = ALIVE.write().unwrap_or_else(PoisonError::into_inner);
        let found = alive.get(&(pointer as usize)) == Some(&kind);
        if found {
            alive.remove(&(pointer as usize));
        }
        found
    };
    if found {
        // SAFETY: it was alive, so it comes from `Box::into_raw`; it is of this type by this function's
        // contract; and it was removed, so that nobody takes it back twice.
        drop(unsafe { Box::from_raw(pointer.cast::<T>()) });
    }
    found
}

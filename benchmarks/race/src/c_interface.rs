//! The equations for drivers in other languages: the C interface of `drivers/race.h`.
//!
//! A handle comes from [`race_open`] and goes to [`race_close`]. Vectors are as long as [`race_dimension`]
//! says. No panic crosses the border: a call that fails gives a null pointer, or something other than zero.
// A C interface is made of pointers; each use says why it holds. Valgrind runs it in the `race` check.
#![allow(unsafe_code)]

use std::ffi::{CStr, c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice::{from_raw_parts, from_raw_parts_mut};

use crate::equations::Equations;
use crate::problem::RaceProblem;

/// The target of a handle.
pub struct Handle {
    equations: Equations,
    rows: usize,
    interval: f64,
    duration: f64,
}

/// Opens the problem of this name; null if there is none.
///
/// # Safety
/// `name` is null or a text that ends in a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_open(name: *const c_char) -> *mut Handle {
    if name.is_null() {
        return std::ptr::null_mut();
    }
    // SAFETY: not null, and the caller promises a text that ends.
    let name = unsafe { CStr::from_ptr(name) };
    let open = || {
        let problem = RaceProblem::named(name.to_str().ok()?).ok()?;
        let (rows, interval, duration) = (problem.rows(), problem.interval, problem.duration);
        let equations = Equations::new(problem.system, &problem.start);
        Some(Handle {
            equations,
            rows,
            interval,
            duration,
        })
    };
    match catch_unwind(open) {
        Ok(Some(handle)) => Box::into_raw(Box::new(handle)),
        _ => std::ptr::null_mut(),
    }
}

/// Closes a handle; null is none.
///
/// # Safety
/// `handle` is null or comes from [`race_open`] and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_close(handle: *mut Handle) {
    if !handle.is_null() {
        // SAFETY: it was made by `Box::into_raw` in `race_open`, and is given back once.
        drop(unsafe { Box::from_raw(handle) });
    }
}

/// Number of states; 0 for null.
///
/// # Safety
/// `handle` is null or comes from [`race_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_dimension(handle: *const Handle) -> c_int {
    // SAFETY: null or alive, by the caller's promise.
    unsafe { handle.as_ref() }.map_or(0, |handle| handle.equations.dimension() as c_int)
}

/// Number of rows of a result, the start included; 0 for null.
///
/// # Safety
/// `handle` is null or comes from [`race_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_rows(handle: *const Handle) -> c_int {
    // SAFETY: null or alive, by the caller's promise.
    unsafe { handle.as_ref() }.map_or(0, |handle| handle.rows as c_int)
}

/// Time of a row, s; not a number for null.
///
/// # Safety
/// `handle` is null or comes from [`race_open`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_time(handle: *const Handle, row: c_int) -> f64 {
    // SAFETY: null or alive, by the caller's promise.
    unsafe { handle.as_ref() }.map_or(f64::NAN, |handle| {
        (f64::from(row) * handle.interval).min(handle.duration)
    })
}

/// Writes the state at the start and the error scales of the states; other than 0 for null.
///
/// # Safety
/// `handle` is null or comes from [`race_open`]; `start` and `scales` have room for [`race_dimension`]
/// numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_start(handle: *const Handle, start: *mut f64, scales: *mut f64) -> c_int {
    // SAFETY: null or alive, by the caller's promise.
    let Some(handle) = (unsafe { handle.as_ref() }) else {
        return 1;
    };
    let n = handle.equations.dimension();
    // SAFETY: the caller promises room for n numbers in each, apart from each other.
    let (start, scales) = unsafe { (from_raw_parts_mut(start, n), from_raw_parts_mut(scales, n)) };
    start.copy_from_slice(handle.equations.start());
    scales.copy_from_slice(handle.equations.scales());
    0
}

/// Writes the rates of the state; other than 0 if that fails.
///
/// # Safety
/// `handle` is null or comes from [`race_open`] and is used by one thread at a time; `state` and `rates` hold
/// [`race_dimension`] numbers and do not overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_rates(
    handle: *mut Handle,
    time: f64,
    state: *const f64,
    rates: *mut f64,
) -> c_int {
    // SAFETY: null or alive and not shared, by the caller's promise.
    let Some(handle) = (unsafe { handle.as_mut() }) else {
        return 1;
    };
    let n = handle.equations.dimension();
    // SAFETY: the caller promises n numbers in each, apart from each other.
    let (state, rates) = unsafe { (from_raw_parts(state, n), from_raw_parts_mut(rates, n)) };
    let call = || handle.equations.rates(time, state, rates);
    c_int::from(catch_unwind(AssertUnwindSafe(call)).is_err())
}

/// Writes the Jacobian matrix of the rates by the state, column by column; other than 0 if that fails.
///
/// # Safety
/// As [`race_rates`]; `jacobian` has room for the square of [`race_dimension`] numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn race_jacobian(
    handle: *mut Handle,
    time: f64,
    state: *const f64,
    jacobian: *mut f64,
) -> c_int {
    // SAFETY: null or alive and not shared, by the caller's promise.
    let Some(handle) = (unsafe { handle.as_mut() }) else {
        return 1;
    };
    let n = handle.equations.dimension();
    // SAFETY: the caller promises n and n·n numbers, apart from each other.
    let (state, jacobian) = unsafe { (from_raw_parts(state, n), from_raw_parts_mut(jacobian, n * n)) };
    let call = || handle.equations.jacobian(time, state, jacobian).is_ok();
    c_int::from(!catch_unwind(AssertUnwindSafe(call)).unwrap_or(false))
}

//! Functions of FMI 2.0 for co-simulation: steps, their status, derivatives of inputs and outputs.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_char, c_int, c_void};

use fmi::Error;

use super::{References, simple};
use crate::component::{OK, Status, call};
use crate::pointers::{put, slice};

/// The answer to questions about a step under way.
const NO_STEP: &str = "no step is under way: steps are finished when fmi2DoStep returns, and its status is \
                       all there is to know";

/// Sets derivatives of inputs for the next step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: *mut c_void,
    vr: References,
    n: usize,
    order: *const c_int,
    value: *const f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2SetRealInputDerivatives", c, |component| {
            let order = slice(order, n, "the orders")?;
            let (vr, value) = (slice(vr, n, "the references")?, slice(value, n, "the values")?);
            for ((vr, order), value) in vr.iter().zip(order).zip(value) {
                component.instance.set_input_derivative(*vr, *order, *value)?;
            }
            Ok(OK)
        })
    }
}

/// Derivatives of outputs are not offered (`maxOutputDerivativeOrder` is 0).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: *mut c_void,
    _vr: References,
    n: usize,
    _order: *const c_int,
    _value: *mut f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2GetRealOutputDerivatives", c, |_| match n {
            0 => Ok(OK),
            _ => Err(Error::new(
                "the FMU gives no derivatives of outputs (maxOutputDerivativeOrder is 0)",
            )),
        })
    }
}

/// Makes a step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: *mut c_void,
    time: f64,
    step: f64,
    _no_set_state_prior: c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { simple("fmi2DoStep", c, |instance| instance.do_step(time, step)) }
}

/// Steps are finished when they return: there is nothing to cancel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2CancelStep", c, |_| {
            Err(Error::new(
                "no step is under way: steps are finished when they return",
            ))
        })
    }
}

/// Gives the status of a step: there is none under way.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(c: *mut c_void, _kind: c_int, _value: *mut c_int) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call("fmi2GetStatus", c, |component| component.discard(NO_STEP)) }
}

/// Gives the last time that was reached (`fmi2LastSuccessfulTime`).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: *mut c_void, kind: c_int, value: *mut f64) -> Status {
    const LAST_SUCCESSFUL_TIME: c_int = 2;
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2GetRealStatus", c, |component| {
            if kind != LAST_SUCCESSFUL_TIME {
                return component.discard(&format!(
                    "there is no real status of the kind {kind}; {LAST_SUCCESSFUL_TIME} is the last \
                     successful time"
                ));
            }
            put(value, component.instance.time(), "the time")?;
            Ok(OK)
        })
    }
}

/// There is no such status.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(c: *mut c_void, _kind: c_int, _value: *mut c_int) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call("fmi2GetIntegerStatus", c, |component| component.discard(NO_STEP)) }
}

/// Tells whether the FMU wants the simulation to end (`fmi2Terminated`): never.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> Status {
    const TERMINATED: c_int = 3;
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2GetBooleanStatus", c, |component| {
            if kind != TERMINATED {
                return component.discard(&format!(
                    "there is no Boolean status of the kind {kind}; {TERMINATED} says whether the FMU wants \
                     to end"
                ));
            }
            put(value, 0, "the value")?;
            Ok(OK)
        })
    }
}

/// There is no such status.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: *mut c_void,
    _kind: c_int,
    _value: *mut *const c_char,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call("fmi2GetStringStatus", c, |component| component.discard(NO_STEP)) }
}

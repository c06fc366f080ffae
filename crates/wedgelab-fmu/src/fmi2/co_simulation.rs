//! Functions of FMI 2.0 for co-simulation: steps, their status, derivatives of inputs and outputs.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_char, c_int, c_void};

use super::References;
use crate::component::{self, OK, Status, functions};
use crate::pointers::{put, slice};

/// The answer to questions about a step under way.
const NO_STEP: &str = "no step is under way: steps are finished when fmi2DoStep returns, and its status is \
                       all there is to know";

functions! {
    /// Sets derivatives of inputs for the next step.
    fn fmi2SetRealInputDerivatives(
        vr: References,
        n: usize,
        order: *const c_int,
        value: *const f64,
    ) |component| {
        let order = slice(order, n, "the orders")?;
        let (vr, value) = (slice(vr, n, "the references")?, slice(value, n, "the values")?);
        for ((vr, order), value) in vr.iter().zip(order).zip(value) {
            component.instance.set_input_derivative(*vr, *order, *value)?;
        }
        Ok(())
    };

    /// Derivatives of outputs are not offered (`maxOutputDerivativeOrder` is 0).
    fn fmi2GetRealOutputDerivatives(
        _vr: References,
        n: usize,
        _order: *const c_int,
        _value: *mut f64,
    ) |_| match n {
        0 => Ok(()),
        _ => component::refuse("the FMU gives no derivatives of outputs (maxOutputDerivativeOrder is 0)"),
    };

    /// Makes a step.
    fn fmi2DoStep(time: f64, step: f64, _no_set_state_prior: c_int)
        |component| component.instance.do_step(time, step);

    /// Steps are finished when they return: there is nothing to cancel.
    fn fmi2CancelStep() |_| {
        component::refuse("no step is under way: steps are finished when they return")
    };

    /// Gives the status of a step: there is none under way.
    fn fmi2GetStatus(_kind: c_int, _value: *mut c_int) |component| component.discard(NO_STEP);

    /// Gives the last time that was reached (`fmi2LastSuccessfulTime`).
    fn fmi2GetRealStatus(kind: c_int, value: *mut f64) |component| {
        const LAST_SUCCESSFUL_TIME: c_int = 2;
        if kind != LAST_SUCCESSFUL_TIME {
            return component.discard(&format!(
                "there is no real status of the kind {kind}; {LAST_SUCCESSFUL_TIME} is the last \
                 successful time"
            ));
        }
        put(value, component.instance.time(), "the time")?;
        Ok(OK)
    };

    /// There is no such status.
    fn fmi2GetIntegerStatus(_kind: c_int, _value: *mut c_int) |component| component.discard(NO_STEP);

    /// Tells whether the FMU wants the simulation to end (`fmi2Terminated`): never.
    fn fmi2GetBooleanStatus(kind: c_int, value: *mut c_int) |component| {
        const TERMINATED: c_int = 3;
        if kind != TERMINATED {
            return component.discard(&format!(
                "there is no Boolean status of the kind {kind}; {TERMINATED} says whether the FMU wants \
                 to end"
            ));
        }
        put(value, 0, "the value")?;
        Ok(OK)
    };

    /// There is no such status.
    fn fmi2GetStringStatus(_kind: c_int, _value: *mut *const c_char)
        |component| component.discard(NO_STEP);
}

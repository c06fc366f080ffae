//! Functions of FMI 2.0 for model exchange: events, time, states, rates and event indicators.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_int, c_void};

use fmi::instance::{EventUpdate, Instance};

use super::simple;
use crate::component::{OK, Status, call};
use crate::pointers::{put, slice, slice_mut};

/// The outcome of event handling: `fmi2EventInfo`.
#[repr(C)]
pub struct EventInfo {
    /// Another update is needed.
    pub new_discrete_states_needed: c_int,
    /// The simulation must end.
    pub terminate_simulation: c_int,
    /// Nominal values have changed.
    pub nominals_of_continuous_states_changed: c_int,
    /// States have changed.
    pub values_of_continuous_states_changed: c_int,
    /// There is a time event ahead.
    pub next_event_time_defined: c_int,
    /// The time of the next event.
    pub next_event_time: f64,
}

/// Begins event mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { simple("fmi2EnterEventMode", c, Instance::enter_event_mode) }
}

/// Handles events.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(c: *mut c_void, info: *mut EventInfo) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2NewDiscreteStates", c, |component| {
            let found = |update: EventUpdate| EventInfo {
                new_discrete_states_needed: c_int::from(update.again),
                terminate_simulation: 0,
                nominals_of_continuous_states_changed: 0,
                values_of_continuous_states_changed: 0,
                next_event_time_defined: c_int::from(update.next_time.is_some()),
                next_event_time: update.next_time.unwrap_or(0.0),
            };
            // Before anything changes: a null pointer is refused as a whole.
            put(info, found(EventUpdate::default()), "the event info")?;
            let update = component.instance.update_discrete_states()?;
            put(info, found(update), "the event info")?;
            Ok(OK)
        })
    }
}

/// Begins continuous-time mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple(
            "fmi2EnterContinuousTimeMode",
            c,
            Instance::enter_continuous_time_mode,
        )
    }
}

/// Completes an integrator step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: *mut c_void,
    _no_set_state_prior: c_int,
    enter_event_mode: *mut c_int,
    terminate: *mut c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi2CompletedIntegratorStep", c, |component| {
            component.instance.completed_integrator_step()?;
            put(enter_event_mode, 0, "enterEventMode")?;
            put(terminate, 0, "terminateSimulation")?;
            Ok(OK)
        })
    }
}

/// Sets time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: *mut c_void, time: f64) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { simple("fmi2SetTime", c, |instance| instance.set_time(time)) }
}

/// Sets the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(c: *mut c_void, x: *const f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi2SetContinuousStates", c, |instance| {
            instance.set_states(slice(x, n, "the states")?)
        })
    }
}

/// Reads the rates of the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(c: *mut c_void, out: *mut f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi2GetDerivatives", c, |instance| {
            instance.rates(slice_mut(out, n, "the derivatives")?)
        })
    }
}

/// Reads the event indicators.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(c: *mut c_void, out: *mut f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi2GetEventIndicators", c, |instance| {
            instance.indicators(slice_mut(out, n, "the event indicators")?)
        })
    }
}

/// Reads the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(c: *mut c_void, out: *mut f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi2GetContinuousStates", c, |instance| {
            instance.states(slice_mut(out, n, "the states")?)
        })
    }
}

/// Reads the nominal values of the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: *mut c_void,
    out: *mut f64,
    n: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi2GetNominalsOfContinuousStates", c, |instance| {
            instance.nominals(slice_mut(out, n, "the nominal values")?)
        })
    }
}

//! Functions of FMI 3.0 for model exchange: updates at events, time, states, rates and event indicators.
#![allow(clippy::missing_safety_doc)]

use std::ffi::c_void;

use fmi::instance::Instance;

use super::simple;
use crate::component::{OK, Status, call};
use crate::pointers::{put, slice, slice_mut};

/// Handles events.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: *mut c_void,
    again: *mut bool,
    terminate: *mut bool,
    nominals_changed: *mut bool,
    values_changed: *mut bool,
    next_time_defined: *mut bool,
    next_time: *mut f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi3UpdateDiscreteStates", instance, |component| {
            // Before anything changes: a null pointer is refused as a whole.
            put(again, false, "discreteStatesNeedUpdate")?;
            put(terminate, false, "terminateSimulation")?;
            put(nominals_changed, false, "nominalsOfContinuousStatesChanged")?;
            put(values_changed, false, "valuesOfContinuousStatesChanged")?;
            put(next_time_defined, false, "nextEventTimeDefined")?;
            put(next_time, 0.0, "nextEventTime")?;
            let update = component.instance.update_discrete_states()?;
            put(again, update.again, "discreteStatesNeedUpdate")?;
            put(
                next_time_defined,
                update.next_time.is_some(),
                "nextEventTimeDefined",
            )?;
            put(next_time, update.next_time.unwrap_or(0.0), "nextEventTime")?;
            Ok(OK)
        })
    }
}

/// Begins continuous-time mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterContinuousTimeMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple(
            "fmi3EnterContinuousTimeMode",
            instance,
            Instance::enter_continuous_time_mode,
        )
    }
}

/// Completes an integrator step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: *mut c_void,
    _no_set_state_prior: bool,
    enter_event_mode: *mut bool,
    terminate: *mut bool,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        call("fmi3CompletedIntegratorStep", instance, |component| {
            component.instance.completed_integrator_step()?;
            put(enter_event_mode, false, "enterEventMode")?;
            put(terminate, false, "terminateSimulation")?;
            Ok(OK)
        })
    }
}

/// Sets time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: *mut c_void, time: f64) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { simple("fmi3SetTime", instance, |instance| instance.set_time(time)) }
}

/// Sets the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(instance: *mut c_void, x: *const f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3SetContinuousStates", instance, |instance| {
            instance.set_states(slice(x, n, "the states")?)
        })
    }
}

/// Reads the rates of the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStateDerivatives(
    instance: *mut c_void,
    out: *mut f64,
    n: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetContinuousStateDerivatives", instance, |instance| {
            instance.rates(slice_mut(out, n, "the derivatives")?)
        })
    }
}

/// Reads the event indicators.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetEventIndicators(instance: *mut c_void, out: *mut f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetEventIndicators", instance, |instance| {
            instance.indicators(slice_mut(out, n, "the event indicators")?)
        })
    }
}

/// Reads the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStates(instance: *mut c_void, out: *mut f64, n: usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetContinuousStates", instance, |instance| {
            instance.states(slice_mut(out, n, "the states")?)
        })
    }
}

/// Reads the nominal values of the states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(
    instance: *mut c_void,
    out: *mut f64,
    n: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetNominalsOfContinuousStates", instance, |instance| {
            instance.nominals(slice_mut(out, n, "the nominal values")?)
        })
    }
}

/// Gives the number of event indicators.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfEventIndicators(instance: *mut c_void, count: *mut usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetNumberOfEventIndicators", instance, |instance| {
            put(
                count,
                instance.description().entries.indicators.len(),
                "the number",
            )
        })
    }
}

/// Gives the number of continuous states.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfContinuousStates(instance: *mut c_void, count: *mut usize) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        simple("fmi3GetNumberOfContinuousStates", instance, |instance| {
            put(count, instance.description().entries.states.len(), "the number")
        })
    }
}

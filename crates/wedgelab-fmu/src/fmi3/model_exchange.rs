//! Functions of FMI 3.0 for model exchange: updates at events, time, states, rates and event indicators.
#![allow(clippy::missing_safety_doc)]

use std::ffi::c_void;

use crate::component::{Status, functions};
use crate::pointers::{put, slice, slice_mut};

functions! {
    /// Handles events.
    fn fmi3UpdateDiscreteStates(
        again: *mut bool,
        terminate: *mut bool,
        nominals_changed: *mut bool,
        values_changed: *mut bool,
        next_time_defined: *mut bool,
        next_time: *mut f64,
    ) |component| {
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
        Ok(())
    };

    /// Begins continuous-time mode.
    fn fmi3EnterContinuousTimeMode() |component| component.instance.enter_continuous_time_mode();

    /// Completes an integrator step.
    fn fmi3CompletedIntegratorStep(
        _no_set_state_prior: bool,
        enter_event_mode: *mut bool,
        terminate: *mut bool,
    ) |component| {
        component.instance.completed_integrator_step()?;
        put(enter_event_mode, false, "enterEventMode")?;
        put(terminate, false, "terminateSimulation")?;
        Ok(())
    };

    /// Sets time.
    fn fmi3SetTime(time: f64) |component| component.instance.set_time(time);

    /// Sets the states.
    fn fmi3SetContinuousStates(x: *const f64, n: usize) |component| {
        component.instance.set_states(slice(x, n, "the states")?)
    };

    /// Reads the rates of the states.
    fn fmi3GetContinuousStateDerivatives(out: *mut f64, n: usize) |component| {
        component.instance.rates(slice_mut(out, n, "the derivatives")?)
    };

    /// Reads the event indicators.
    fn fmi3GetEventIndicators(out: *mut f64, n: usize) |component| {
        component.instance.indicators(slice_mut(out, n, "the event indicators")?)
    };

    /// Reads the states.
    fn fmi3GetContinuousStates(out: *mut f64, n: usize) |component| {
        component.instance.states(slice_mut(out, n, "the states")?)
    };

    /// Reads the nominal values of the states.
    fn fmi3GetNominalsOfContinuousStates(out: *mut f64, n: usize) |component| {
        component.instance.nominals(slice_mut(out, n, "the nominal values")?)
    };

    /// Gives the number of event indicators.
    fn fmi3GetNumberOfEventIndicators(count: *mut usize) |component| {
        put(
            count,
            component.instance.description().entries.indicators.len(),
            "the number",
        )
    };

    /// Gives the number of continuous states.
    fn fmi3GetNumberOfContinuousStates(count: *mut usize) |component| {
        put(count, component.instance.description().entries.states.len(), "the number")
    };
}

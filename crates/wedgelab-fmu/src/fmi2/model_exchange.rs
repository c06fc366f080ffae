//! Functions of FMI 2.0 for model exchange: events, time, states, rates and event indicators.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_int, c_void};

use fmi::instance::EventUpdate;

use crate::component::{Status, functions};
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

functions! {
    /// Begins event mode.
    fn fmi2EnterEventMode() |component| component.instance.enter_event_mode();

    /// Handles events.
    fn fmi2NewDiscreteStates(info: *mut EventInfo) |component| {
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
        Ok(())
    };

    /// Begins continuous-time mode.
    fn fmi2EnterContinuousTimeMode() |component| component.instance.enter_continuous_time_mode();

    /// Completes an integrator step.
    fn fmi2CompletedIntegratorStep(
        _no_set_state_prior: c_int,
        enter_event_mode: *mut c_int,
        terminate: *mut c_int,
    ) |component| {
        component.instance.completed_integrator_step()?;
        put(enter_event_mode, 0, "enterEventMode")?;
        put(terminate, 0, "terminateSimulation")?;
        Ok(())
    };

    /// Sets time.
    fn fmi2SetTime(time: f64) |component| component.instance.set_time(time);

    /// Sets the states.
    fn fmi2SetContinuousStates(x: *const f64, n: usize) |component| {
        component.instance.set_states(slice(x, n, "the states")?)
    };

    /// Reads the rates of the states.
    fn fmi2GetDerivatives(out: *mut f64, n: usize) |component| {
        component.instance.rates(slice_mut(out, n, "the derivatives")?)
    };

    /// Reads the event indicators.
    fn fmi2GetEventIndicators(out: *mut f64, n: usize) |component| {
        component.instance.indicators(slice_mut(out, n, "the event indicators")?)
    };

    /// Reads the states.
    fn fmi2GetContinuousStates(out: *mut f64, n: usize) |component| {
        component.instance.states(slice_mut(out, n, "the states")?)
    };

    /// Reads the nominal values of the states.
    fn fmi2GetNominalsOfContinuousStates(out: *mut f64, n: usize) |component| {
        component.instance.nominals(slice_mut(out, n, "the nominal values")?)
    };
}

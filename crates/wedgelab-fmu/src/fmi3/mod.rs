//! The functions of FMI 3.0, in the order of the standard's header; those of model exchange alone are in
//! [`model_exchange`], those that only clocks, scheduled execution and other types of variables need in
//! [`others`].
//!
//! # Safety
//! All functions share the standard's contract: an instance comes from [`fmi3InstantiateModelExchange`] or
//! [`fmi3InstantiateCoSimulation`] and has not been freed, a pointer to an array points to as many values as
//! the call says, strings end with a zero byte, and no instance is used by two threads at once. Null pointers
//! are refused.
#![allow(clippy::missing_safety_doc)]

pub mod model_exchange;
pub mod others;

use std::ffi::{c_char, c_void};
use std::path::Path;

use fmi::Error;
use fmi::description::Version;
use fmi::element::Interface;
use fmi::instance::Instance;

use crate::component::{Logger, Logger3, Status, free, functions, get, instantiate, set};
use crate::pointers::{put, slice, slice_mut, string, strings};
use crate::states::{deserialize, free_saved, save, saved, serialize};

pub(crate) type References = *const u32;
/// The importer's logger; none is possible.
pub type LogMessage = Option<unsafe extern "C" fn(*mut c_void, i32, *const c_char, *const c_char)>;
/// The importer's intermediate update; it is never called (`providesIntermediateUpdate` is not set).
pub type IntermediateUpdate =
    Option<unsafe extern "C" fn(*mut c_void, f64, bool, bool, bool, bool, *mut bool, *mut f64)>;

/// Returns the version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

functions! {
    /// Switches the log.
    fn fmi3SetDebugLogging(on: bool, count: usize, categories: *const *const c_char) |component| {
        component.set_logging(on, &strings(categories, count, "the log categories")?)?;
        Ok(())
    };
}

/// Makes an instance of one kind; `check` looks at what else was asked for.
unsafe fn make(
    function: &'static str,
    [name, token, resources]: [*const c_char; 3],
    interface: Interface,
    logging: bool,
    environment: *mut c_void,
    log_message: LogMessage,
    check: impl FnOnce() -> Result<(), Error>,
) -> *mut c_void {
    let logger = match log_message {
        Some(log_message) => Logger::Three(log_message as Logger3, environment),
        None => Logger::None,
    };
    let make = |name: &str| -> Result<Instance, Error> {
        check()?;
        // SAFETY: the standard's contract, see the module; null pointers are looked for.
        let (token, resources) = unsafe {
            (
                string(token, "the instantiation token")?,
                string(resources, "the path of the resources")?,
            )
        };
        Instance::new(name, token, Path::new(resources), Version::Three, interface)
    };
    // SAFETY: as above; the logger is the importer's.
    unsafe { instantiate(function, logger, name, logging, make) }
}

/// Makes an instance for model exchange; null, with a message, if it cannot be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    logging: bool,
    environment: *mut c_void,
    log_message: LogMessage,
) -> *mut c_void {
    let texts = [name, token, resources];
    // SAFETY: the standard's contract, see the module.
    unsafe {
        make(
            "fmi3InstantiateModelExchange",
            texts,
            Interface::ModelExchange,
            logging,
            environment,
            log_message,
            || Ok(()),
        )
    }
}

/// Makes an instance for co-simulation; null, with a message, if it cannot be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    logging: bool,
    event_mode_used: bool,
    _early_return_allowed: bool,
    _required_intermediate_variables: References,
    required_count: usize,
    environment: *mut c_void,
    log_message: LogMessage,
    _intermediate_update: IntermediateUpdate,
) -> *mut c_void {
    let check = || {
        if event_mode_used {
            return Err(Error::new(
                "the FMU has no event mode in co-simulation (hasEventMode is not set)",
            ));
        }
        if required_count > 0 {
            return Err(Error::new(
                "the FMU gives no intermediate updates (providesIntermediateUpdate is not set)",
            ));
        }
        Ok(())
    };
    let texts = [name, token, resources];
    // SAFETY: the standard's contract, see the module.
    unsafe {
        make(
            "fmi3InstantiateCoSimulation",
            texts,
            Interface::CoSimulation,
            logging,
            environment,
            log_message,
            check,
        )
    }
}

/// The FMU has no scheduled execution.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: bool,
    logging: bool,
    environment: *mut c_void,
    log_message: LogMessage,
    _clock_update: Option<unsafe extern "C" fn(*mut c_void)>,
    _lock_preemption: Option<unsafe extern "C" fn()>,
    _unlock_preemption: Option<unsafe extern "C" fn()>,
) -> *mut c_void {
    let why = "the FMU has no scheduled execution: make an instance for model exchange or co-simulation";
    // SAFETY: the standard's contract, see the module.
    unsafe {
        make(
            "fmi3InstantiateScheduledExecution",
            [name, token, resources],
            Interface::CoSimulation,
            logging,
            environment,
            log_message,
            || Err(Error::new(why)),
        )
    }
}

/// Frees an instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: *mut c_void) {
    // SAFETY: the standard's contract, see the module.
    unsafe { free(instance) };
}

functions! {
    /// Begins the initialization.
    fn fmi3EnterInitializationMode(
        tolerance_defined: bool,
        tolerance: f64,
        start: f64,
        stop_defined: bool,
        stop: f64,
    ) |component| {
        let tolerance = tolerance_defined.then_some(tolerance);
        component.instance.set_experiment(start, stop_defined.then_some(stop), tolerance)?;
        component.instance.enter_initialization()
    };

    /// Ends the initialization.
    fn fmi3ExitInitializationMode() |component| component.instance.exit_initialization();

    /// Begins event mode.
    fn fmi3EnterEventMode() |component| component.instance.enter_event_mode();

    /// Ends the simulation.
    fn fmi3Terminate() |component| component.instance.terminate();

    /// Goes back to the state after instantiation.
    fn fmi3Reset() |component| {
        component.instance.reset();
        Ok(())
    };

    /// Reads variables of the type Float64.
    fn fmi3GetFloat64(vr: References, n: usize, values: *mut f64, count: usize) |component| {
        same(n, count)?;
        get(component, (vr, n), values, Instance::get_float)
    };

    /// Sets variables of the type Float64.
    fn fmi3SetFloat64(vr: References, n: usize, values: *const f64, count: usize) |component| {
        same(n, count)?;
        set(component, (vr, n), values, Instance::may_set_float, Instance::set_float)
    };

    /// Reads variables of the type Int32.
    fn fmi3GetInt32(vr: References, n: usize, values: *mut i32, count: usize) |component| {
        same(n, count)?;
        get(component, (vr, n), values, Instance::get_integer)
    };

    /// Sets variables of the type Int32.
    fn fmi3SetInt32(vr: References, n: usize, values: *const i32, count: usize) |component| {
        same(n, count)?;
        set(component, (vr, n), values, Instance::may_set_integer, Instance::set_integer)
    };

    /// Reads variables of the type Boolean.
    fn fmi3GetBoolean(vr: References, n: usize, values: *mut bool, count: usize) |component| {
        same(n, count)?;
        get(component, (vr, n), values, Instance::get_boolean)
    };

    /// Sets variables of the type Boolean.
    fn fmi3SetBoolean(vr: References, n: usize, values: *const u8, count: usize) |component| {
        same(n, count)?;
        set(
            component,
            (vr, n),
            values,
            |instance, vr, value| instance.may_set_boolean(vr, value != 0),
            |instance, vr, value| instance.set_boolean(vr, value != 0),
        )
    };
}

/// Checks the counts. All variables are scalars: there is one value a reference.
fn same(references: usize, values: usize) -> Result<(), Error> {
    if references == values {
        return Ok(());
    }
    Err(Error::new(format!(
        "{references} references and {values} values: all variables are scalars, so give one value for each \
         reference"
    )))
}

functions! {
    /// Saves the state.
    fn fmi3GetFMUState(state: *mut *mut c_void) |component| save(component, state);

    /// Goes back to a saved state.
    fn fmi3SetFMUState(state: *mut c_void) |component| {
        component.instance.restore(saved(state)?)
    };

    /// Frees a saved state.
    fn fmi3FreeFMUState(state: *mut *mut c_void) |_| free_saved(state);

    /// Gives the size of a saved state, bytes.
    fn fmi3SerializedFMUStateSize(state: *mut c_void, size: *mut usize) |_| {
        put(size, saved(state)?.to_bytes()?.len(), "the size")?;
        Ok(())
    };

    /// Writes a saved state as bytes.
    fn fmi3SerializeFMUState(state: *mut c_void, bytes: *mut u8, size: usize) |_| {
        serialize(state, bytes, size)
    };

    /// Reads a saved state from bytes.
    fn fmi3DeserializeFMUState(bytes: *const u8, size: usize, state: *mut *mut c_void) |_| {
        deserialize(bytes, size, state)
    };

    /// Derivatives along a direction.
    fn fmi3GetDirectionalDerivative(
        unknowns: References,
        unknown_count: usize,
        knowns: References,
        known_count: usize,
        seed: *const f64,
        seed_count: usize,
        out: *mut f64,
        out_count: usize,
    ) |component| {
        let unknowns = slice(unknowns, unknown_count, "the unknowns")?;
        let knowns = slice(knowns, known_count, "the knowns")?;
        let seed = slice(seed, seed_count, "the seed")?;
        let out = slice_mut(out, out_count, "the sensitivities")?;
        component
            .instance
            .directional_derivative(unknowns, knowns, seed, out)?;
        Ok(())
    };

    /// Makes a step. It is always made whole: no early return, no events to be handled.
    fn fmi3DoStep(
        time: f64,
        step: f64,
        _no_set_state_prior: bool,
        event_handling_needed: *mut bool,
        terminate: *mut bool,
        early_return: *mut bool,
        last_successful_time: *mut f64,
    ) |component| {
        put(event_handling_needed, false, "eventHandlingNeeded")?;
        put(terminate, false, "terminateSimulation")?;
        put(early_return, false, "earlyReturn")?;
        put(
            last_successful_time,
            component.instance.time(),
            "lastSuccessfulTime",
        )?;
        component.instance.do_step(time, step)?;
        put(
            last_successful_time,
            component.instance.time(),
            "lastSuccessfulTime",
        )?;
        Ok(())
    };
}

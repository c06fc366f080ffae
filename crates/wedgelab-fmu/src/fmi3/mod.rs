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

use crate::component::{Logger, Logger3, OK, Status, call, free, instantiate, read, write};
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

/// Switches the log.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: *mut c_void,
    on: bool,
    count: usize,
    categories: *const *const c_char,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SetDebugLogging", instance, |component| {
            component.set_logging(on, &strings(categories, count, "the log categories")?)?;
            Ok(OK)
        })
    }
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

/// Runs a call without results.
unsafe fn simple(
    function: &'static str,
    instance: *mut c_void,
    run: impl FnOnce(&mut Instance) -> Result<(), Error>,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call(function, instance, |component| {
            run(&mut component.instance).map(|()| OK)
        })
    }
}

/// Begins the initialization.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: *mut c_void,
    tolerance_defined: bool,
    tolerance: f64,
    start: f64,
    stop_defined: bool,
    stop: f64,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        simple("fmi3EnterInitializationMode", instance, |instance| {
            let tolerance = tolerance_defined.then_some(tolerance);
            instance.set_experiment(start, stop_defined.then_some(stop), tolerance)?;
            instance.enter_initialization()
        })
    }
}

/// Ends the initialization.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        simple(
            "fmi3ExitInitializationMode",
            instance,
            Instance::exit_initialization,
        )
    }
}

/// Begins event mode.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterEventMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { simple("fmi3EnterEventMode", instance, Instance::enter_event_mode) }
}

/// Ends the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { simple("fmi3Terminate", instance, Instance::terminate) }
}

/// Goes back to the state after instantiation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        simple("fmi3Reset", instance, |instance| {
            instance.reset();
            Ok(())
        })
    }
}

/// Reads variables of the type Float64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *mut f64,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3GetFloat64", instance, |component| {
            same(n, count)?;
            let (vr, values) = (
                slice(vr, n, "the references")?,
                slice_mut(values, n, "the values")?,
            );
            read(vr, values, |vr| component.instance.get_float(vr))
        })
    }
}

/// Sets variables of the type Float64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *const f64,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SetFloat64", instance, |component| {
            same(n, count)?;
            let (vr, values) = (slice(vr, n, "the references")?, slice(values, n, "the values")?);
            let instance = &mut component.instance;
            write(instance, vr, values, Instance::may_set_float, Instance::set_float)
        })
    }
}

/// Reads variables of the type Int32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt32(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *mut i32,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3GetInt32", instance, |component| {
            same(n, count)?;
            let (vr, values) = (
                slice(vr, n, "the references")?,
                slice_mut(values, n, "the values")?,
            );
            read(vr, values, |vr| component.instance.get_integer(vr))
        })
    }
}

/// Sets variables of the type Int32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt32(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *const i32,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SetInt32", instance, |component| {
            same(n, count)?;
            let (vr, values) = (slice(vr, n, "the references")?, slice(values, n, "the values")?);
            let instance = &mut component.instance;
            write(
                instance,
                vr,
                values,
                Instance::may_set_integer,
                Instance::set_integer,
            )
        })
    }
}

/// Reads variables of the type Boolean.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBoolean(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *mut bool,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3GetBoolean", instance, |component| {
            same(n, count)?;
            let (vr, values) = (
                slice(vr, n, "the references")?,
                slice_mut(values, n, "the values")?,
            );
            read(vr, values, |vr| component.instance.get_boolean(vr))
        })
    }
}

/// Sets variables of the type Boolean.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBoolean(
    instance: *mut c_void,
    vr: References,
    n: usize,
    values: *const u8,
    count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SetBoolean", instance, |component| {
            same(n, count)?;
            let (vr, values) = (slice(vr, n, "the references")?, slice(values, n, "the values")?);
            write(
                &mut component.instance,
                vr,
                values,
                |instance, vr, value| instance.may_set_boolean(vr, value != 0),
                |instance, vr, value| instance.set_boolean(vr, value != 0),
            )
        })
    }
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

/// Saves the state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: *mut c_void, state: *mut *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi3GetFMUState", instance, |component| save(component, state)) }
}

/// Goes back to a saved state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: *mut c_void, state: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SetFMUState", instance, |component| {
            component.instance.restore(saved(state)?).map(|()| OK)
        })
    }
}

/// Frees a saved state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: *mut c_void, state: *mut *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi3FreeFMUState", instance, |_| free_saved(state)) }
}

/// Gives the size of a saved state, bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: *mut c_void,
    state: *mut c_void,
    size: *mut usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SerializedFMUStateSize", instance, |_| {
            put(size, saved(state)?.to_bytes()?.len(), "the size")?;
            Ok(OK)
        })
    }
}

/// Writes a saved state as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: *mut c_void,
    state: *mut c_void,
    bytes: *mut u8,
    size: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3SerializeFMUState", instance, |_| {
            serialize(state, bytes, size)
        })
    }
}

/// Reads a saved state from bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: *mut c_void,
    bytes: *const u8,
    size: usize,
    state: *mut *mut c_void,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3DeserializeFMUState", instance, |_| {
            deserialize(bytes, size, state)
        })
    }
}

/// Derivatives along a direction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: *mut c_void,
    unknowns: References,
    unknown_count: usize,
    knowns: References,
    known_count: usize,
    seed: *const f64,
    seed_count: usize,
    out: *mut f64,
    out_count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3GetDirectionalDerivative", instance, |component| {
            let unknowns = slice(unknowns, unknown_count, "the unknowns")?;
            let knowns = slice(knowns, known_count, "the knowns")?;
            let seed = slice(seed, seed_count, "the seed")?;
            let out = slice_mut(out, out_count, "the sensitivities")?;
            component
                .instance
                .directional_derivative(unknowns, knowns, seed, out)?;
            Ok(OK)
        })
    }
}

/// Makes a step. It is always made whole: no early return, no events to be handled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: *mut c_void,
    time: f64,
    step: f64,
    _no_set_state_prior: bool,
    event_handling_needed: *mut bool,
    terminate: *mut bool,
    early_return: *mut bool,
    last_successful_time: *mut f64,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi3DoStep", instance, |component| {
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
            Ok(OK)
        })
    }
}

//! The functions of FMI 2.0, in the order of the standard's header: here those of both interfaces, in
//! [`model_exchange`] and [`co_simulation`] those of one.
//!
//! # Safety
//! All functions share the standard's contract: a component comes from [`fmi2Instantiate`] and has not been
//! freed, a pointer to an array points to as many values as the call says, strings end with a zero byte, and
//! no component is used by two threads at once. Null pointers are refused.
#![allow(clippy::missing_safety_doc)]

pub mod co_simulation;
pub mod model_exchange;

use std::ffi::{c_char, c_int, c_void};

use fmi::description::Version;
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::{Error, resources};

use crate::component::{Logger, Logger2, Status, free, functions, get, instantiate, none_of, set};
use crate::pointers::{put, slice, slice_mut, string, strings};
use crate::states::{deserialize, free_saved, save, saved, serialize};

/// The functions of an importer: `fmi2CallbackFunctions`.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct CallbackFunctions {
    /// Takes messages.
    pub logger:
        Option<unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...)>,
    /// Not used.
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    /// Not used.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Not used: steps are finished when they return.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    /// Given back with every message.
    pub component_environment: *mut c_void,
}

type References = *const u32;

/// Returns the platform types.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// Returns the version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

functions! {
    /// Switches the log.
    fn fmi2SetDebugLogging(on: c_int, count: usize, categories: *const *const c_char) |component| {
        component.set_logging(on != 0, &strings(categories, count, "the log categories")?)?;
        Ok(())
    };
}

/// Makes an instance; null, with a message, if it cannot be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resource_location: *const c_char,
    functions: *const CallbackFunctions,
    _visible: c_int,
    logging: c_int,
) -> *mut c_void {
    // SAFETY: the standard's contract, see the module; null pointers are looked for.
    let logger = match unsafe { functions.as_ref() } {
        Some(CallbackFunctions {
            logger: Some(logger),
            component_environment,
            ..
        }) => Logger::Two(*logger as Logger2, *component_environment),
        _ => Logger::None,
    };
    let make = |name: &str| -> Result<Instance, Error> {
        // SAFETY: as above.
        let (guid, location) = unsafe {
            (
                string(guid, "the GUID")?,
                string(resource_location, "the location of the resources")?,
            )
        };
        let interface = match kind {
            0 => Interface::ModelExchange,
            1 => Interface::CoSimulation,
            other => {
                return Err(Error::new(format!(
                    "there is no kind {other} of FMUs; 0 is model exchange, 1 is co-simulation"
                )));
            }
        };
        let folder = resources::folder_of_uri(location)?;
        Instance::new(name, guid, &folder, Version::Two, interface)
    };
    // SAFETY: as above; the logger is the importer's.
    unsafe { instantiate("fmi2Instantiate", logger, name, logging != 0, make) }
}

/// Frees an instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: *mut c_void) {
    // SAFETY: the standard's contract, see the module.
    unsafe { free(c) };
}

functions! {
    /// Sets tolerance, start and stop time.
    fn fmi2SetupExperiment(
        tolerance_defined: c_int,
        tolerance: f64,
        start: f64,
        stop_defined: c_int,
        stop: f64,
    ) |component| {
        let stop = (stop_defined != 0).then_some(stop);
        let tolerance = (tolerance_defined != 0).then_some(tolerance);
        component.instance.set_experiment(start, stop, tolerance)?;
        Ok(())
    };

    /// Begins the initialization.
    fn fmi2EnterInitializationMode() |component| component.instance.enter_initialization();

    /// Ends the initialization.
    fn fmi2ExitInitializationMode() |component| component.instance.exit_initialization();

    /// Ends the simulation.
    fn fmi2Terminate() |component| component.instance.terminate();

    /// Goes back to the state after instantiation.
    fn fmi2Reset() |component| {
        component.instance.reset();
        Ok(())
    };

    /// Reads real variables.
    fn fmi2GetReal(vr: References, n: usize, value: *mut f64) |component| {
        get(component, (vr, n), value, Instance::get_float)
    };

    /// Reads integer variables.
    fn fmi2GetInteger(vr: References, n: usize, value: *mut c_int) |component| {
        get(component, (vr, n), value, Instance::get_integer)
    };

    /// Reads Boolean variables.
    fn fmi2GetBoolean(vr: References, n: usize, value: *mut c_int) |component| {
        get(component, (vr, n), value, |instance, vr| instance.get_boolean(vr).map(c_int::from))
    };

    /// Reads strings: there are none.
    fn fmi2GetString(_vr: References, n: usize, _value: *mut *const c_char) |_| none_of(n, "string");

    /// Sets real variables.
    fn fmi2SetReal(vr: References, n: usize, value: *const f64) |component| {
        set(component, (vr, n), value, Instance::may_set_float, Instance::set_float)
    };

    /// Sets integer variables.
    fn fmi2SetInteger(vr: References, n: usize, value: *const c_int) |component| {
        set(component, (vr, n), value, Instance::may_set_integer, Instance::set_integer)
    };

    /// Sets Boolean variables.
    fn fmi2SetBoolean(vr: References, n: usize, value: *const c_int) |component| {
        set(
            component,
            (vr, n),
            value,
            |instance, vr, value| instance.may_set_boolean(vr, value != 0),
            |instance, vr, value| instance.set_boolean(vr, value != 0),
        )
    };

    /// Sets strings: there are none.
    fn fmi2SetString(_vr: References, n: usize, _value: *const *const c_char) |_| none_of(n, "string");

    /// Saves the state.
    fn fmi2GetFMUstate(state: *mut *mut c_void) |component| save(component, state);

    /// Goes back to a saved state.
    fn fmi2SetFMUstate(state: *mut c_void) |component| {
        component.instance.restore(saved(state)?)
    };

    /// Frees a saved state.
    fn fmi2FreeFMUstate(state: *mut *mut c_void) |_| free_saved(state);

    /// Gives the size of a saved state, bytes.
    fn fmi2SerializedFMUstateSize(state: *mut c_void, size: *mut usize) |_| {
        put(size, saved(state)?.to_bytes()?.len(), "the size")?;
        Ok(())
    };

    /// Writes a saved state as bytes.
    fn fmi2SerializeFMUstate(state: *mut c_void, bytes: *mut c_char, size: usize) |_| {
        serialize(state, bytes.cast(), size)
    };

    /// Reads a saved state from bytes.
    fn fmi2DeSerializeFMUstate(bytes: *const c_char, size: usize, state: *mut *mut c_void) |_| {
        deserialize(bytes.cast(), size, state)
    };

    /// Derivatives along a direction.
    fn fmi2GetDirectionalDerivative(
        unknowns: References,
        unknown_count: usize,
        knowns: References,
        known_count: usize,
        seed: *const f64,
        out: *mut f64,
    ) |component| {
        let unknowns = slice(unknowns, unknown_count, "the unknowns")?;
        let knowns = slice(knowns, known_count, "the knowns")?;
        let seed = slice(seed, known_count, "the seed")?;
        let out = slice_mut(out, unknown_count, "the derivatives")?;
        component
            .instance
            .directional_derivative(unknowns, knowns, seed, out)?;
        Ok(())
    };
}

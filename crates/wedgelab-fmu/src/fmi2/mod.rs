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

use crate::component::{Logger, Logger2, OK, Status, call, free, instantiate, none_of, read, write};
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

/// Switches the log.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: *mut c_void,
    on: c_int,
    count: usize,
    categories: *const *const c_char,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetDebugLogging", c, |component| {
            component.set_logging(on != 0, &strings(categories, count, "the log categories")?)?;
            Ok(OK)
        })
    }
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

/// Sets tolerance, start and stop time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: *mut c_void,
    tolerance_defined: c_int,
    tolerance: f64,
    start: f64,
    stop_defined: c_int,
    stop: f64,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetupExperiment", c, |component| {
            let stop = (stop_defined != 0).then_some(stop);
            let tolerance = (tolerance_defined != 0).then_some(tolerance);
            component.instance.set_experiment(start, stop, tolerance)?;
            Ok(OK)
        })
    }
}

/// Runs a call without results.
unsafe fn simple(
    function: &'static str,
    c: *mut c_void,
    run: impl FnOnce(&mut Instance) -> Result<(), Error>,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call(function, c, |component| run(&mut component.instance).map(|()| OK)) }
}

/// Begins the initialization.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { simple("fmi2EnterInitializationMode", c, Instance::enter_initialization) }
}

/// Ends the initialization.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { simple("fmi2ExitInitializationMode", c, Instance::exit_initialization) }
}

/// Ends the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { simple("fmi2Terminate", c, Instance::terminate) }
}

/// Goes back to the state after instantiation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        simple("fmi2Reset", c, |instance| {
            instance.reset();
            Ok(())
        })
    }
}

/// Reads real variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(c: *mut c_void, vr: References, n: usize, value: *mut f64) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2GetReal", c, |component| {
            let (vr, value) = (
                slice(vr, n, "the references")?,
                slice_mut(value, n, "the values")?,
            );
            read(vr, value, |vr| component.instance.get_float(vr))
        })
    }
}

/// Reads integer variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: *mut c_void,
    vr: References,
    n: usize,
    value: *mut c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2GetInteger", c, |component| {
            let (vr, value) = (
                slice(vr, n, "the references")?,
                slice_mut(value, n, "the values")?,
            );
            read(vr, value, |vr| component.instance.get_integer(vr))
        })
    }
}

/// Reads Boolean variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: *mut c_void,
    vr: References,
    n: usize,
    value: *mut c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2GetBoolean", c, |component| {
            let (vr, value) = (
                slice(vr, n, "the references")?,
                slice_mut(value, n, "the values")?,
            );
            read(vr, value, |vr| {
                component.instance.get_boolean(vr).map(c_int::from)
            })
        })
    }
}

/// Reads strings: there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: *mut c_void,
    _vr: References,
    n: usize,
    _value: *mut *const c_char,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi2GetString", c, |_| none_of(n, "string")) }
}

/// Sets real variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(c: *mut c_void, vr: References, n: usize, value: *const f64) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetReal", c, |component| {
            let (vr, value) = (slice(vr, n, "the references")?, slice(value, n, "the values")?);
            let instance = &mut component.instance;
            write(instance, vr, value, Instance::may_set_float, Instance::set_float)
        })
    }
}

/// Sets integer variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: *mut c_void,
    vr: References,
    n: usize,
    value: *const c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetInteger", c, |component| {
            let (vr, value) = (slice(vr, n, "the references")?, slice(value, n, "the values")?);
            let instance = &mut component.instance;
            write(
                instance,
                vr,
                value,
                Instance::may_set_integer,
                Instance::set_integer,
            )
        })
    }
}

/// Sets Boolean variables.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: *mut c_void,
    vr: References,
    n: usize,
    value: *const c_int,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetBoolean", c, |component| {
            let (vr, value) = (slice(vr, n, "the references")?, slice(value, n, "the values")?);
            write(
                &mut component.instance,
                vr,
                value,
                |instance, vr, value| instance.may_set_boolean(vr, value != 0),
                |instance, vr, value| instance.set_boolean(vr, value != 0),
            )
        })
    }
}

/// Sets strings: there are none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: *mut c_void,
    _vr: References,
    n: usize,
    _value: *const *const c_char,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi2SetString", c, |_| none_of(n, "string")) }
}

/// Saves the state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: *mut c_void, state: *mut *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi2GetFMUstate", c, |component| save(component, state)) }
}

/// Goes back to a saved state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: *mut c_void, state: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SetFMUstate", c, |component| {
            component.instance.restore(saved(state)?).map(|()| OK)
        })
    }
}

/// Frees a saved state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: *mut c_void, state: *mut *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe { call("fmi2FreeFMUstate", c, |_| free_saved(state)) }
}

/// Gives the size of a saved state, bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: *mut c_void,
    state: *mut c_void,
    size: *mut usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SerializedFMUstateSize", c, |_| {
            put(size, saved(state)?.to_bytes()?.len(), "the size")?;
            Ok(OK)
        })
    }
}

/// Writes a saved state as bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: *mut c_void,
    state: *mut c_void,
    bytes: *mut c_char,
    size: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2SerializeFMUstate", c, |_| {
            serialize(state, bytes.cast(), size)
        })
    }
}

/// Reads a saved state from bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: *mut c_void,
    bytes: *const c_char,
    size: usize,
    state: *mut *mut c_void,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2DeSerializeFMUstate", c, |_| {
            deserialize(bytes.cast(), size, state)
        })
    }
}

/// Derivatives along a direction.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: *mut c_void,
    unknowns: References,
    unknown_count: usize,
    knowns: References,
    known_count: usize,
    seed: *const f64,
    out: *mut f64,
) -> Status {
    // SAFETY: the standard's contract, see the module.
    unsafe {
        call("fmi2GetDirectionalDerivative", c, |component| {
            let unknowns = slice(unknowns, unknown_count, "the unknowns")?;
            let knowns = slice(knowns, known_count, "the knowns")?;
            let seed = slice(seed, known_count, "the seed")?;
            let out = slice_mut(out, unknown_count, "the derivatives")?;
            component
                .instance
                .directional_derivative(unknowns, knowns, seed, out)?;
            Ok(OK)
        })
    }
}

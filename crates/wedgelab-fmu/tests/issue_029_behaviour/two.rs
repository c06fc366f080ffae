//! FMI 2.0.

use std::collections::BTreeSet;
use std::ffi::{CString, c_char, c_int, c_void};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut, without_provenance_mut};

use fmi::description::Version;
use wedgelab_fmu::fmi2::co_simulation::*;
use wedgelab_fmu::fmi2::model_exchange::*;
use wedgelab_fmu::fmi2::*;

use super::{ALONE, Driver, ERROR, Fmu, Log, Names, OK, Row, row};

type Fixed =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, *const c_char);
type Variadic = unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...);

unsafe extern "C" fn note(
    environment: *mut c_void,
    name: *const c_char,
    status: c_int,
    category: *const c_char,
    format: *const c_char,
    text: *const c_char,
) {
    unsafe {
        assert_eq!(std::ffi::CStr::from_ptr(format), c"%s");
        assert!(!name.is_null());
        (*environment.cast::<Log>()).note(status, category, text);
    }
}

/// Returns the callbacks of an importer, with a logger.
pub fn callbacks(log: &Log) -> CallbackFunctions {
    CallbackFunctions {
        // The one argument after the format lies where a sixth one does.
        logger: Some(unsafe { std::mem::transmute::<Fixed, Variadic>(note) }),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: log.environment(),
    }
}

/// Returns the folder's URI.
pub fn uri(fmu: &Fmu) -> CString {
    CString::new(format!("file://{}", fmu.path().display())).unwrap()
}

fn instance(fmu: &Fmu, log: &Log, kind: c_int, logging: c_int) -> *mut c_void {
    let made = unsafe {
        fmi2Instantiate(
            c"wedge".as_ptr(),
            kind,
            fmu.token.as_ptr(),
            uri(fmu).as_ptr(),
            &callbacks(log),
            0,
            logging,
        )
    };
    assert!(!made.is_null(), "{:?}", log.take());
    made
}

fn save(c: *mut c_void) -> *mut c_void {
    let mut state = null_mut();
    unsafe { fmi2GetFMUstate(c, &mut state) };
    state
}

/// Returns a state that was freed.
fn freed(c: *mut c_void) -> *mut c_void {
    let state = save(c);
    let mut copy = state;
    unsafe { fmi2FreeFMUstate(c, &mut copy) };
    state
}

/// Calls a function with a state, and frees it.
fn with_state(c: *mut c_void, run: impl FnOnce(*mut c_void) -> i32) -> i32 {
    let mut state = save(c);
    let status = run(state);
    unsafe { fmi2FreeFMUstate(c, &mut state) };
    status
}

const NOBODY: u32 = 1_000_000;
const FAR_TOO_MANY: usize = usize::MAX;

fn rows(names: Names) -> Vec<Row> {
    let Names {
        input,
        output,
        mass,
        mode,
        option,
        truth,
        states,
        indicators,
        ..
    } = names;
    let mut rows = vec![
        row!(fmi2SetDebugLogging:
            "off" => |c| fmi2SetDebugLogging(c, 0, 0, null()),
            "one" => |c| fmi2SetDebugLogging(c, 0, 1, [c"logStatusDiscard".as_ptr()].as_ptr()),
            "! unknown" => |c| fmi2SetDebugLogging(c, 1, 1, [c"logWeather".as_ptr()].as_ptr()),
            "! unknown, off" => |c| fmi2SetDebugLogging(c, 0, 1, [c"".as_ptr()].as_ptr()),
            "! null" => |c| fmi2SetDebugLogging(c, 1, 1, null()),
            "! null name" => |c| fmi2SetDebugLogging(c, 1, 1, [null()].as_ptr()),
            "! no UTF-8" => |c| fmi2SetDebugLogging(c, 1, 1, [c"\xff".as_ptr()].as_ptr()),
            "! too many" => |c| fmi2SetDebugLogging(c, 1, FAR_TOO_MANY, [null()].as_ptr())),
        row!(fmi2SetupExperiment:
            "good" => |c| fmi2SetupExperiment(c, 1, 1e-6, 0.0, 1, 1.0),
            "! NaN" => |c| fmi2SetupExperiment(c, 0, 0.0, f64::NAN, 0, 0.0),
            "! stop" => |c| fmi2SetupExperiment(c, 0, 0.0, 1.0, 1, 0.5),
            "! tolerance" => |c| fmi2SetupExperiment(c, 1, -1.0, 0.0, 0, 0.0)),
        row!(fmi2EnterInitializationMode: "good" => |c| fmi2EnterInitializationMode(c)),
        row!(fmi2ExitInitializationMode: "good" => |c| fmi2ExitInitializationMode(c)),
        row!(fmi2Terminate: "good" => |c| fmi2Terminate(c)),
        row!(fmi2Reset: "good" => |c| fmi2Reset(c)),
        row!(fmi2GetReal:
            "good" => |c| fmi2GetReal(c, &output, 1, &mut 0.0),
            "nothing" => |c| fmi2GetReal(c, null(), 0, null_mut()),
            "! unknown" => |c| fmi2GetReal(c, &NOBODY, 1, &mut 0.0),
            "! last" => |c| fmi2GetReal(c, &u32::MAX, 1, &mut 0.0),
            "! type" => |c| fmi2GetReal(c, &mode, 1, &mut 0.0),
            "! null references" => |c| fmi2GetReal(c, null(), 1, &mut 0.0),
            "! null values" => |c| fmi2GetReal(c, &output, 1, null_mut()),
            "! misaligned" => |c| fmi2GetReal(c, &output, 1, without_provenance_mut(9)),
            "! too many" => |c| fmi2GetReal(c, &output, FAR_TOO_MANY, &mut 0.0)),
        row!(fmi2GetInteger:
            "good" => |c| fmi2GetInteger(c, &mode, 1, &mut 0),
            "! unknown" => |c| fmi2GetInteger(c, &NOBODY, 1, &mut 0),
            "! type" => |c| fmi2GetInteger(c, &output, 1, &mut 0),
            "! null" => |c| fmi2GetInteger(c, &mode, 1, null_mut()),
            "! too many" => |c| fmi2GetInteger(c, &mode, usize::MAX / 4, &mut 0)),
        row!(fmi2GetBoolean:
            "good" => |c| fmi2GetBoolean(c, &truth, 1, &mut 0),
            "! unknown" => |c| fmi2GetBoolean(c, &NOBODY, 1, &mut 0),
            "! null" => |c| fmi2GetBoolean(c, null(), 1, &mut 0),
            "! too many" => |c| fmi2GetBoolean(c, &truth, 1 << 40, &mut 0)),
        row!(fmi2GetString:
            "nothing" => |c| fmi2GetString(c, null(), 0, null_mut()),
            "! one" => |c| fmi2GetString(c, &input, 1, &mut null()),
            "! null" => |c| fmi2GetString(c, null(), 1, null_mut())),
        row!(fmi2SetReal:
            "good" => |c| fmi2SetReal(c, &input, 1, &1e-4),
            "mass" => |c| fmi2SetReal(c, &mass, 1, &20.0),
            "! output" => |c| fmi2SetReal(c, &output, 1, &1.0),
            "! unknown" => |c| fmi2SetReal(c, &NOBODY, 1, &1.0),
            "! NaN" => |c| fmi2SetReal(c, &input, 1, &f64::NAN),
            "! infinite" => |c| fmi2SetReal(c, &input, 1, &f64::INFINITY),
            "! null" => |c| fmi2SetReal(c, &input, 1, null()),
            "! too many" => |c| fmi2SetReal(c, &input, FAR_TOO_MANY, &1.0)),
        row!(fmi2SetInteger:
            "good" => |c| fmi2SetInteger(c, &option, 1, &1),
            "! far" => |c| fmi2SetInteger(c, &option, 1, &77),
            "! unknown" => |c| fmi2SetInteger(c, &NOBODY, 1, &1),
            "! null" => |c| fmi2SetInteger(c, null(), 1, &1),
            "! too many" => |c| fmi2SetInteger(c, &option, FAR_TOO_MANY, &1)),
        row!(fmi2SetBoolean:
            "good" => |c| fmi2SetBoolean(c, &truth, 1, &1),
            "! unknown" => |c| fmi2SetBoolean(c, &NOBODY, 1, &1),
            "! type" => |c| fmi2SetBoolean(c, &input, 1, &1),
            "! null" => |c| fmi2SetBoolean(c, &truth, 1, null())),
        row!(fmi2SetString:
            "nothing" => |c| fmi2SetString(c, null(), 0, null()),
            "! one" => |c| fmi2SetString(c, &input, 1, &c"".as_ptr())),
        row!(fmi2GetDirectionalDerivative:
        "good" => |c| fmi2GetDirectionalDerivative(c, &output, 1, &input, 1, &1.0, &mut 0.0),
        "! unknown" => |c| fmi2GetDirectionalDerivative(c, &NOBODY, 1, &input, 1, &1.0, &mut 0.0),
        "! known" => |c| fmi2GetDirectionalDerivative(c, &output, 1, &mass, 1, &1.0, &mut 0.0),
        "! null" => |c| fmi2GetDirectionalDerivative(c, &output, 1, &input, 1, null(), &mut 0.0),
        "! too many" => |c| {
            fmi2GetDirectionalDerivative(c, &output, FAR_TOO_MANY, &input, 1, &1.0, &mut 0.0)
        }),
    ];
    rows.extend(states_rows());
    rows.extend(co_simulation_rows(names));
    rows.extend(exchange_rows(states, indicators));
    rows
}

fn states_rows() -> Vec<Row> {
    vec![
        row!(fmi2GetFMUstate:
            "good" => |c| {
                let mut state = null_mut();
                let status = fmi2GetFMUstate(c, &mut state);
                fmi2FreeFMUstate(c, &mut state);
                status
            },
            "! null" => |c| fmi2GetFMUstate(c, null_mut()),
            "! freed" => |c| { let mut state = freed(c); fmi2GetFMUstate(c, &mut state) },
            "! none" => |c| fmi2GetFMUstate(c, &mut c.wrapping_byte_add(8))),
        row!(fmi2SetFMUstate:
            "good" => |c| with_state(c, |state| fmi2SetFMUstate(c, state)),
            "! null" => |c| fmi2SetFMUstate(c, null_mut()),
            "! freed" => |c| fmi2SetFMUstate(c, freed(c)),
            "! an instance" => |c| fmi2SetFMUstate(c, c)),
        row!(fmi2FreeFMUstate:
            "null" => |c| fmi2FreeFMUstate(c, null_mut()),
            "! freed" => |c| { let mut state = freed(c); fmi2FreeFMUstate(c, &mut state) },
            "! an instance" => |c| { let mut state = c; fmi2FreeFMUstate(c, &mut state) }),
        row!(fmi2SerializedFMUstateSize:
            "good" => |c| with_state(c, |state| fmi2SerializedFMUstateSize(c, state, &mut 0)),
            "! null state" => |c| fmi2SerializedFMUstateSize(c, null_mut(), &mut 0),
            "! null size" => |c| with_state(c, |state| fmi2SerializedFMUstateSize(c, state, null_mut())),
            "! freed" => |c| fmi2SerializedFMUstateSize(c, freed(c), &mut 0)),
        row!(fmi2SerializeFMUstate:
            "! short" => |c| with_state(c, |state| fmi2SerializeFMUstate(c, state, [0; 8].as_mut_ptr(), 8)),
            "! null state" => |c| fmi2SerializeFMUstate(c, null_mut(), [0; 8].as_mut_ptr(), 8),
            "! null bytes" => |c| with_state(c, |state| fmi2SerializeFMUstate(c, state, null_mut(), 1 << 20)),
            "! too many" => |c| with_state(c, |state| {
                fmi2SerializeFMUstate(c, state, [0; 8].as_mut_ptr(), FAR_TOO_MANY)
            }),
            "! freed" => |c| fmi2SerializeFMUstate(c, freed(c), [0; 8].as_mut_ptr(), 8)),
        row!(fmi2DeSerializeFMUstate:
            "! none" => |c| fmi2DeSerializeFMUstate(c, c"{}".as_ptr(), 2, &mut null_mut()),
            "! nothing" => |c| fmi2DeSerializeFMUstate(c, c"".as_ptr(), 0, &mut null_mut()),
            "! null bytes" => |c| fmi2DeSerializeFMUstate(c, null(), 2, &mut null_mut()),
            "! too many" => |c| fmi2DeSerializeFMUstate(c, c"{}".as_ptr(), FAR_TOO_MANY, &mut null_mut()),
            "! null state" => |c| fmi2DeSerializeFMUstate(c, c"{}".as_ptr(), 2, null_mut())),
    ]
}

fn co_simulation_rows(names: Names) -> Vec<Row> {
    let Names { input, output, .. } = names;
    vec![
        row!(fmi2SetRealInputDerivatives:
            "good" => |c| fmi2SetRealInputDerivatives(c, &input, 1, &1, &0.1),
            "! order" => |c| fmi2SetRealInputDerivatives(c, &input, 1, &2, &0.1),
            "! NaN" => |c| fmi2SetRealInputDerivatives(c, &input, 1, &1, &f64::NAN),
            "! output" => |c| fmi2SetRealInputDerivatives(c, &output, 1, &1, &0.1),
            "! null" => |c| fmi2SetRealInputDerivatives(c, &input, 1, null(), &0.1)),
        row!(fmi2GetRealOutputDerivatives:
            "nothing" => |c| fmi2GetRealOutputDerivatives(c, null(), 0, null(), null_mut()),
            "! one" => |c| fmi2GetRealOutputDerivatives(c, &output, 1, &1, &mut 0.0)),
        row!(fmi2DoStep:
            "good" => |c| fmi2DoStep(c, 0.0, 1e-4, 0),
            "! zero" => |c| fmi2DoStep(c, 0.0, 0.0, 0),
            "! back" => |c| fmi2DoStep(c, 0.0, -1e-3, 0),
            "! NaN" => |c| fmi2DoStep(c, 0.0, f64::NAN, 0),
            "! elsewhere" => |c| fmi2DoStep(c, 1.0, 1e-3, 0)),
        row!(fmi2CancelStep: "! none" => |c| fmi2CancelStep(c)),
        row!(fmi2GetStatus:
            "! do step" => |c| fmi2GetStatus(c, 0, &mut 0),
            "! unknown" => |c| fmi2GetStatus(c, -7, null_mut())),
        row!(fmi2GetRealStatus:
            "good" => |c| fmi2GetRealStatus(c, 2, &mut 0.0),
            "! kind" => |c| fmi2GetRealStatus(c, 0, &mut 0.0),
            "! null" => |c| fmi2GetRealStatus(c, 2, null_mut())),
        row!(fmi2GetIntegerStatus: "! none" => |c| fmi2GetIntegerStatus(c, 0, &mut 0)),
        row!(fmi2GetBooleanStatus:
            "good" => |c| fmi2GetBooleanStatus(c, 3, &mut 0),
            "! kind" => |c| fmi2GetBooleanStatus(c, 1, &mut 0),
            "! null" => |c| fmi2GetBooleanStatus(c, 3, null_mut())),
        row!(fmi2GetStringStatus: "! none" => |c| fmi2GetStringStatus(c, 1, &mut null())),
    ]
}

fn exchange_rows(states: usize, indicators: usize) -> Vec<Row> {
    vec![
        row!(fmi2EnterEventMode: "good" => |c| fmi2EnterEventMode(c)),
        row!(fmi2NewDiscreteStates:
            "good" => |c| fmi2NewDiscreteStates(c, MaybeUninit::uninit().as_mut_ptr()),
            "! null" => |c| fmi2NewDiscreteStates(c, null_mut())),
        row!(fmi2EnterContinuousTimeMode: "good" => |c| fmi2EnterContinuousTimeMode(c)),
        row!(fmi2CompletedIntegratorStep:
            "good" => |c| fmi2CompletedIntegratorStep(c, 1, &mut 0, &mut 0),
            "! null" => |c| fmi2CompletedIntegratorStep(c, 1, null_mut(), &mut 0)),
        row!(fmi2SetTime:
            "good" => |c| fmi2SetTime(c, 1e-3),
            "! NaN" => |c| fmi2SetTime(c, f64::NAN)),
        row!(fmi2SetContinuousStates:
            "good" => |c| fmi2SetContinuousStates(c, vec![0.0; states].as_ptr(), states),
            "! short" => |c| fmi2SetContinuousStates(c, [0.0].as_ptr(), 1),
            "! NaN" => |c| fmi2SetContinuousStates(c, vec![f64::NAN; states].as_ptr(), states),
            "! null" => |c| fmi2SetContinuousStates(c, null(), states)),
        row!(fmi2GetDerivatives:
            "good" => |c| fmi2GetDerivatives(c, vec![0.0; states].as_mut_ptr(), states),
            "! short" => |c| fmi2GetDerivatives(c, [0.0].as_mut_ptr(), 1),
            "! null" => |c| fmi2GetDerivatives(c, null_mut(), states)),
        row!(fmi2GetEventIndicators:
            "good" => |c| fmi2GetEventIndicators(c, vec![0.0; indicators].as_mut_ptr(), indicators),
            "! short" => |c| fmi2GetEventIndicators(c, [0.0].as_mut_ptr(), 1)),
        row!(fmi2GetContinuousStates:
            "good" => |c| fmi2GetContinuousStates(c, vec![0.0; states].as_mut_ptr(), states),
            "! none" => |c| fmi2GetContinuousStates(c, null_mut(), 0),
            "! too many" => |c| fmi2GetContinuousStates(c, [0.0].as_mut_ptr(), FAR_TOO_MANY)),
        row!(fmi2GetNominalsOfContinuousStates:
            "good" => |c| fmi2GetNominalsOfContinuousStates(c, vec![0.0; states].as_mut_ptr(), states),
            "! short" => |c| fmi2GetNominalsOfContinuousStates(c, [0.0].as_mut_ptr(), 1)),
    ]
}

#[test]
fn issue_029_every_refused_call_of_fmi_2_has_a_message() {
    let _alone = ALONE.lock();
    let fmu = Fmu::new(Version::Two);
    let log = Log::default();
    let rows = rows(fmu.names);
    let driver = Driver {
        version: Version::Two,
        rows: &rows,
        log: &log,
        save: &save,
        restore: &|c, state| unsafe { fmi2SetFMUstate(c, state) },
        others: &[
            "fmi2GetTypesPlatform",
            "fmi2GetVersion",
            "fmi2Instantiate",
            "fmi2FreeInstance",
        ],
    };
    driver.check_names();
    let mut refused = BTreeSet::new();
    for kind in [0, 1] {
        // Whether logging is on or off.
        for logging in [0, 1] {
            let c = instance(&fmu, &log, kind, logging);
            let drive = |phase: &str, refused: &mut _| driver.drive(c, phase, refused);
            drive("instantiated", &mut refused);
            assert_eq!(unsafe { fmi2EnterInitializationMode(c) }, OK);
            drive("initialization", &mut refused);
            assert_eq!(unsafe { fmi2ExitInitializationMode(c) }, OK);
            drive("event or step", &mut refused);
            if kind == 0 {
                assert_eq!(unsafe { fmi2EnterContinuousTimeMode(c) }, OK);
                drive("continuous time", &mut refused);
            } else {
                let far = -1e300;
                unsafe {
                    assert_eq!(fmi2SetReal(c, &fmu.names.longitudinal, 1, &far), OK);
                    assert_eq!(fmi2DoStep(c, 0.0, 1e-3, 0), ERROR);
                }
                drive("failed", &mut refused);
            }
            assert_eq!(unsafe { fmi2Terminate(c) }, OK);
            drive("terminated", &mut refused);
            unsafe { fmi2FreeInstance(c) };
            log.take();
            driver.drive_nobody(c);
            // What is freed already, or never was, is left alone.
            unsafe {
                fmi2FreeInstance(c);
                fmi2FreeInstance(null_mut());
            }
        }
    }
    driver.check_refused(&refused);
}

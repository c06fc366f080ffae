//! FMI 3.0.

use std::collections::BTreeSet;
use std::ffi::{c_char, c_void};
use std::ptr::{null, null_mut, without_provenance_mut};

use fmi::description::Version;
use wedgelab_fmu::fmi3::model_exchange::*;
use wedgelab_fmu::fmi3::others::*;
use wedgelab_fmu::fmi3::*;

use super::instantiation::path_of;
use super::{ALONE, Driver, ERROR, Fmu, Log, Names, OK, Row, row};

/// An importer's logger.
pub unsafe extern "C" fn note(
    environment: *mut c_void,
    status: i32,
    category: *const c_char,
    text: *const c_char,
) {
    unsafe { (*environment.cast::<Log>()).note(status, category, text) };
}

fn instance(fmu: &Fmu, log: &Log, exchange: bool, logging: bool) -> *mut c_void {
    let (name, token, path) = (c"wedge".as_ptr(), fmu.token.as_ptr(), path_of(fmu));
    let environment = log.environment();
    let made = unsafe {
        if exchange {
            fmi3InstantiateModelExchange(
                name,
                token,
                path.as_ptr(),
                false,
                logging,
                environment,
                Some(note),
            )
        } else {
            let (name, path, note) = (name, path.as_ptr(), Some(note as _));
            fmi3InstantiateCoSimulation(
                name,
                token,
                path,
                false,
                logging,
                false,
                false,
                null(),
                0,
                environment,
                note,
                None,
            )
        }
    };
    assert!(!made.is_null(), "{:?}", log.take());
    made
}

fn save(c: *mut c_void) -> *mut c_void {
    let mut state = null_mut();
    unsafe { fmi3GetFMUState(c, &mut state) };
    state
}

/// Returns a state that was freed.
fn freed(c: *mut c_void) -> *mut c_void {
    let state = save(c);
    let mut copy = state;
    unsafe { fmi3FreeFMUState(c, &mut copy) };
    state
}

/// Calls a function with a state, and frees it.
fn with_state(c: *mut c_void, run: impl FnOnce(*mut c_void) -> i32) -> i32 {
    let mut state = save(c);
    let status = run(state);
    unsafe { fmi3FreeFMUState(c, &mut state) };
    status
}

const NOBODY: u32 = 1_000_000;
const FAR_TOO_MANY: usize = usize::MAX;

fn step(c: *mut c_void, time: f64, length: f64) -> i32 {
    unsafe { fmi3DoStep(c, time, length, true, &mut true, &mut true, &mut true, &mut 0.0) }
}

fn rows(names: Names) -> Vec<Row> {
    let Names {
        input,
        output,
        mass,
        mode,
        option,
        truth,
        ..
    } = names;
    let mut rows = vec![
        row!(fmi3SetDebugLogging:
            "off" => |c| fmi3SetDebugLogging(c, false, 0, null()),
            "one" => |c| fmi3SetDebugLogging(c, true, 1, [c"logEvents".as_ptr()].as_ptr()),
            "! unknown" => |c| fmi3SetDebugLogging(c, true, 1, [c"logWeather".as_ptr()].as_ptr()),
            "! null" => |c| fmi3SetDebugLogging(c, true, 1, null()),
            "! null name" => |c| fmi3SetDebugLogging(c, false, 1, [null()].as_ptr()),
            "! too many" => |c| fmi3SetDebugLogging(c, true, FAR_TOO_MANY, [null()].as_ptr())),
        row!(fmi3EnterInitializationMode:
            "good" => |c| fmi3EnterInitializationMode(c, true, 1e-6, 0.0, true, 1.0),
            "! NaN" => |c| fmi3EnterInitializationMode(c, false, 0.0, f64::NAN, false, 0.0),
            "! stop" => |c| fmi3EnterInitializationMode(c, false, 0.0, 1.0, true, 0.5),
            "! tolerance" => |c| fmi3EnterInitializationMode(c, true, 2.0, 0.0, false, 0.0)),
        row!(fmi3ExitInitializationMode: "good" => |c| fmi3ExitInitializationMode(c)),
        row!(fmi3EnterEventMode: "good" => |c| fmi3EnterEventMode(c)),
        row!(fmi3Terminate: "good" => |c| fmi3Terminate(c)),
        row!(fmi3Reset: "good" => |c| fmi3Reset(c)),
        row!(fmi3GetFloat64:
            "good" => |c| fmi3GetFloat64(c, &output, 1, &mut 0.0, 1),
            "nothing" => |c| fmi3GetFloat64(c, null(), 0, null_mut(), 0),
            "! unknown" => |c| fmi3GetFloat64(c, &NOBODY, 1, &mut 0.0, 1),
            "! type" => |c| fmi3GetFloat64(c, &mode, 1, &mut 0.0, 1),
            "! null" => |c| fmi3GetFloat64(c, &output, 1, null_mut(), 1),
            "! misaligned" => |c| fmi3GetFloat64(c, &output, 1, without_provenance_mut(9), 1),
            "! lengths" => |c| fmi3GetFloat64(c, &output, 1, [0.0; 2].as_mut_ptr(), 2),
            "! too many" => |c| fmi3GetFloat64(c, &output, FAR_TOO_MANY, &mut 0.0, FAR_TOO_MANY)),
        row!(fmi3GetInt32:
            "good" => |c| fmi3GetInt32(c, &mode, 1, &mut 0, 1),
            "! unknown" => |c| fmi3GetInt32(c, &NOBODY, 1, &mut 0, 1),
            "! null" => |c| fmi3GetInt32(c, null(), 1, &mut 0, 1),
            "! lengths" => |c| fmi3GetInt32(c, &mode, 1, &mut 0, 0)),
        row!(fmi3GetBoolean:
            "good" => |c| fmi3GetBoolean(c, &truth, 1, &mut false, 1),
            "! unknown" => |c| fmi3GetBoolean(c, &NOBODY, 1, &mut false, 1),
            "! null" => |c| fmi3GetBoolean(c, &truth, 1, null_mut(), 1),
            "! lengths" => |c| fmi3GetBoolean(c, &truth, 1, &mut false, 7)),
        row!(fmi3SetFloat64:
            "good" => |c| fmi3SetFloat64(c, &input, 1, &1e-4, 1),
            "mass" => |c| fmi3SetFloat64(c, &mass, 1, &20.0, 1),
            "! output" => |c| fmi3SetFloat64(c, &output, 1, &1.0, 1),
            "! unknown" => |c| fmi3SetFloat64(c, &NOBODY, 1, &1.0, 1),
            "! infinite" => |c| fmi3SetFloat64(c, &input, 1, &f64::NEG_INFINITY, 1),
            "! null" => |c| fmi3SetFloat64(c, &input, 1, null(), 1),
            "! lengths" => |c| fmi3SetFloat64(c, &input, 1, &1.0, 0),
            "! too many" => |c| fmi3SetFloat64(c, &input, FAR_TOO_MANY, &1.0, FAR_TOO_MANY)),
        row!(fmi3SetInt32:
            "good" => |c| fmi3SetInt32(c, &option, 1, &1, 1),
            "! far" => |c| fmi3SetInt32(c, &option, 1, &-1, 1),
            "! null" => |c| fmi3SetInt32(c, &option, 1, null(), 1),
            "! lengths" => |c| fmi3SetInt32(c, &option, 1, &1, 2)),
        row!(fmi3SetBoolean:
            "good" => |c| fmi3SetBoolean(c, &truth, 1, &1, 1),
            "! type" => |c| fmi3SetBoolean(c, &option, 1, &1, 1),
            "! null" => |c| fmi3SetBoolean(c, null(), 1, &1, 1),
            "! lengths" => |c| fmi3SetBoolean(c, &truth, 1, &1, 0)),
        row!(fmi3GetDirectionalDerivative:
            "good" => |c| fmi3GetDirectionalDerivative(c, &output, 1, &input, 1, &1.0, 1, &mut 0.0, 1),
            "! unknown" => |c| fmi3GetDirectionalDerivative(c, &NOBODY, 1, &input, 1, &1.0, 1, &mut 0.0, 1),
            "! seeds" => |c| {
                fmi3GetDirectionalDerivative(c, &output, 1, &input, 1, [1.0; 2].as_ptr(), 2, &mut 0.0, 1)
            },
            "! room" => |c| fmi3GetDirectionalDerivative(c, &output, 1, &input, 1, &1.0, 1, null_mut(), 0),
            "! null" => |c| fmi3GetDirectionalDerivative(c, null(), 1, &input, 1, &1.0, 1, &mut 0.0, 1)),
        row!(fmi3DoStep:
            "good" => |c| step(c, 0.0, 1e-4),
            "! zero" => |c| step(c, 0.0, 0.0),
            "! NaN" => |c| step(c, f64::NAN, 1e-3),
            "! elsewhere" => |c| step(c, -1.0, 1e-3),
            "! null" => |c| fmi3DoStep(c, 0.0, 1e-4, true, &mut true, &mut true, &mut true, null_mut())),
    ];
    rows.extend(states_rows());
    rows.extend(exchange_rows(names));
    rows.extend(types_rows(input));
    rows.extend(other_rows(input, output));
    rows
}

fn states_rows() -> Vec<Row> {
    vec![
        row!(fmi3GetFMUState:
            "good" => |c| {
                let mut state = null_mut();
                let status = fmi3GetFMUState(c, &mut state);
                fmi3FreeFMUState(c, &mut state);
                status
            },
            "! null" => |c| fmi3GetFMUState(c, null_mut()),
            "! freed" => |c| fmi3GetFMUState(c, &mut freed(c))),
        row!(fmi3SetFMUState:
            "good" => |c| with_state(c, |state| fmi3SetFMUState(c, state)),
            "! null" => |c| fmi3SetFMUState(c, null_mut()),
            "! freed" => |c| fmi3SetFMUState(c, freed(c))),
        row!(fmi3FreeFMUState:
            "null" => |c| fmi3FreeFMUState(c, null_mut()),
            "! freed" => |c| fmi3FreeFMUState(c, &mut freed(c)),
            "! misaligned" => |c| fmi3FreeFMUState(c, without_provenance_mut(9))),
        row!(fmi3SerializedFMUStateSize:
            "good" => |c| with_state(c, |state| fmi3SerializedFMUStateSize(c, state, &mut 0)),
            "! null state" => |c| fmi3SerializedFMUStateSize(c, null_mut(), &mut 0),
            "! null size" => |c| with_state(c, |state| fmi3SerializedFMUStateSize(c, state, null_mut()))),
        row!(fmi3SerializeFMUState:
            "! short" => |c| with_state(c, |state| fmi3SerializeFMUState(c, state, [0; 8].as_mut_ptr(), 8)),
            "! freed" => |c| fmi3SerializeFMUState(c, freed(c), [0; 8].as_mut_ptr(), 8),
            "! null" => |c| with_state(c, |state| fmi3SerializeFMUState(c, state, null_mut(), 1 << 20))),
        row!(fmi3DeserializeFMUState:
            "! none" => |c| fmi3DeserializeFMUState(c, b"[[".as_ptr(), 2, &mut null_mut()),
            "! null bytes" => |c| fmi3DeserializeFMUState(c, null(), 2, &mut null_mut()),
            "! too many" => |c| fmi3DeserializeFMUState(c, b"[[".as_ptr(), FAR_TOO_MANY, &mut null_mut()),
            "! null state" => |c| fmi3DeserializeFMUState(c, b"[[".as_ptr(), 2, null_mut())),
    ]
}

fn exchange_rows(names: Names) -> Vec<Row> {
    let Names {
        states, indicators, ..
    } = names;
    vec![
        row!(fmi3UpdateDiscreteStates:
            "good" => |c| fmi3UpdateDiscreteStates(
                c, &mut true, &mut true, &mut true, &mut true, &mut true, &mut 0.0),
            "! null" => |c| fmi3UpdateDiscreteStates(
                c, &mut true, &mut true, &mut true, &mut true, &mut true, null_mut())),
        row!(fmi3EnterContinuousTimeMode: "good" => |c| fmi3EnterContinuousTimeMode(c)),
        row!(fmi3CompletedIntegratorStep:
            "good" => |c| fmi3CompletedIntegratorStep(c, true, &mut true, &mut true),
            "! null" => |c| fmi3CompletedIntegratorStep(c, true, &mut true, null_mut())),
        row!(fmi3SetTime:
            "good" => |c| fmi3SetTime(c, 1e-3),
            "! infinite" => |c| fmi3SetTime(c, f64::INFINITY)),
        row!(fmi3SetContinuousStates:
            "good" => |c| fmi3SetContinuousStates(c, vec![0.0; states].as_ptr(), states),
            "! short" => |c| fmi3SetContinuousStates(c, [0.0].as_ptr(), 1),
            "! null" => |c| fmi3SetContinuousStates(c, null(), states)),
        row!(fmi3GetContinuousStateDerivatives:
            "good" => |c| fmi3GetContinuousStateDerivatives(c, vec![0.0; states].as_mut_ptr(), states),
            "! null" => |c| fmi3GetContinuousStateDerivatives(c, null_mut(), states)),
        row!(fmi3GetEventIndicators:
            "good" => |c| fmi3GetEventIndicators(c, vec![0.0; indicators].as_mut_ptr(), indicators),
            "! none" => |c| fmi3GetEventIndicators(c, null_mut(), 0)),
        row!(fmi3GetContinuousStates:
            "good" => |c| fmi3GetContinuousStates(c, vec![0.0; states].as_mut_ptr(), states),
            "! short" => |c| fmi3GetContinuousStates(c, [0.0].as_mut_ptr(), 1)),
        row!(fmi3GetNominalsOfContinuousStates:
            "good" => |c| fmi3GetNominalsOfContinuousStates(c, vec![0.0; states].as_mut_ptr(), states),
            "! too many" => |c| fmi3GetNominalsOfContinuousStates(c, [0.0].as_mut_ptr(), FAR_TOO_MANY)),
        row!(fmi3GetNumberOfEventIndicators:
            "good" => |c| fmi3GetNumberOfEventIndicators(c, &mut 0),
            "! null" => |c| fmi3GetNumberOfEventIndicators(c, null_mut())),
        row!(fmi3GetNumberOfContinuousStates:
            "good" => |c| fmi3GetNumberOfContinuousStates(c, &mut 0),
            "! null" => |c| fmi3GetNumberOfContinuousStates(c, null_mut())),
    ]
}

/// A function for variables of a type that there is none of.
macro_rules! none_of {
    ($input:ident: $($name:ident),+) => {
        vec![$(row!($name:
            "nothing" => |c| $name(c, null(), 0, null_mut(), 0),
            "! one" => |c| $name(c, &$input, 1, null_mut(), 1),
            "! too many" => |c| $name(c, null(), FAR_TOO_MANY, null_mut(), 0))),+]
    };
}

fn types_rows(input: u32) -> Vec<Row> {
    let mut rows = none_of!(input:
        fmi3GetFloat32, fmi3SetFloat32, fmi3GetInt8, fmi3SetInt8, fmi3GetUInt8, fmi3SetUInt8, fmi3GetInt16,
        fmi3SetInt16, fmi3GetUInt16, fmi3SetUInt16, fmi3GetUInt32, fmi3SetUInt32, fmi3GetInt64, fmi3SetInt64,
        fmi3GetUInt64, fmi3SetUInt64, fmi3GetString, fmi3SetString);
    rows.extend([
        row!(fmi3GetBinary: "! one" => |c| fmi3GetBinary(c, &input, 1, &mut 0, &mut null(), 1)),
        row!(fmi3SetBinary: "! one" => |c| fmi3SetBinary(c, &input, 1, &0, &null(), 1)),
        row!(fmi3GetClock: "! one" => |c| fmi3GetClock(c, &input, 1, &mut false)),
        row!(fmi3SetClock: "! one" => |c| fmi3SetClock(c, &input, 1, &false)),
    ]);
    rows
}

fn other_rows(input: u32, output: u32) -> Vec<Row> {
    vec![
        row!(fmi3GetNumberOfVariableDependencies:
            "! any" => |c| fmi3GetNumberOfVariableDependencies(c, output, &mut 0)),
        row!(fmi3GetVariableDependencies:
            "! any" => |c| fmi3GetVariableDependencies(
                c, output, null_mut(), null_mut(), null_mut(), null_mut(), 0)),
        row!(fmi3GetAdjointDerivative:
            "! any" => |c| fmi3GetAdjointDerivative(c, &output, 1, &input, 1, &1.0, 1, &mut 0.0, 1)),
        row!(fmi3EnterConfigurationMode: "! any" => |c| fmi3EnterConfigurationMode(c)),
        row!(fmi3ExitConfigurationMode: "! any" => |c| fmi3ExitConfigurationMode(c)),
        row!(fmi3GetIntervalDecimal: "! one" => |c| fmi3GetIntervalDecimal(c, &input, 1, &mut 0.0, &mut 0)),
        row!(fmi3GetIntervalFraction:
            "! one" => |c| fmi3GetIntervalFraction(c, &input, 1, &mut 0, &mut 0, &mut 0)),
        row!(fmi3GetShiftDecimal: "! one" => |c| fmi3GetShiftDecimal(c, &input, 1, &mut 0.0)),
        row!(fmi3GetShiftFraction: "! one" => |c| fmi3GetShiftFraction(c, &input, 1, &mut 0, &mut 0)),
        row!(fmi3SetIntervalDecimal: "! one" => |c| fmi3SetIntervalDecimal(c, &input, 1, &0.0)),
        row!(fmi3SetIntervalFraction: "! one" => |c| fmi3SetIntervalFraction(c, &input, 1, &0, &0)),
        row!(fmi3SetShiftDecimal: "! one" => |c| fmi3SetShiftDecimal(c, &input, 1, &0.0)),
        row!(fmi3SetShiftFraction: "! one" => |c| fmi3SetShiftFraction(c, &input, 1, &0, &0)),
        row!(fmi3EvaluateDiscreteStates: "good" => |c| fmi3EvaluateDiscreteStates(c)),
        row!(fmi3EnterStepMode: "! any" => |c| fmi3EnterStepMode(c)),
        row!(fmi3GetOutputDerivatives:
            "! one" => |c| fmi3GetOutputDerivatives(c, &output, 1, &1, &mut 0.0, 1)),
        row!(fmi3ActivateModelPartition: "! any" => |c| fmi3ActivateModelPartition(c, 0, 0.0)),
    ]
}

#[test]
fn issue_029_every_refused_call_of_fmi_3_has_a_message() {
    let _alone = ALONE.lock();
    let fmu = Fmu::new(Version::Three);
    let log = Log::default();
    let rows = rows(fmu.names);
    let driver = Driver {
        version: Version::Three,
        rows: &rows,
        log: &log,
        save: &save,
        restore: &|c, state| unsafe { fmi3SetFMUState(c, state) },
        others: &[
            "fmi3GetVersion",
            "fmi3InstantiateModelExchange",
            "fmi3InstantiateCoSimulation",
            "fmi3InstantiateScheduledExecution",
            "fmi3FreeInstance",
        ],
    };
    driver.check_names();
    let mut refused = BTreeSet::new();
    for exchange in [true, false] {
        // Whether logging is on or off.
        for logging in [false, true] {
            let c = instance(&fmu, &log, exchange, logging);
            let drive = |phase: &str, refused: &mut _| driver.drive(c, phase, refused);
            drive("instantiated", &mut refused);
            assert_eq!(
                unsafe { fmi3EnterInitializationMode(c, false, 0.0, 0.0, false, 0.0) },
                OK
            );
            drive("initialization", &mut refused);
            assert_eq!(unsafe { fmi3ExitInitializationMode(c) }, OK);
            drive("event or step", &mut refused);
            if exchange {
                assert_eq!(unsafe { fmi3EnterContinuousTimeMode(c) }, OK);
                drive("continuous time", &mut refused);
            } else {
                let far = -1e300;
                assert_eq!(
                    unsafe { fmi3SetFloat64(c, &fmu.names.longitudinal, 1, &far, 1) },
                    OK
                );
                assert_eq!(step(c, 0.0, 1e-3), ERROR);
                drive("failed", &mut refused);
            }
            assert_eq!(unsafe { fmi3Terminate(c) }, OK);
            drive("terminated", &mut refused);
            unsafe { fmi3FreeInstance(c) };
            log.take();
            driver.drive_nobody(c);
            unsafe {
                fmi3FreeInstance(c);
                fmi3FreeInstance(null_mut());
            }
        }
    }
    driver.check_refused(&refused);
}

//! Functions of FMI 3.0 for features that the FMU does not have: other types of variables, clocks,
//! configuration, scheduled execution, adjoint and output derivatives. They do nothing when asked for
//! nothing, and refuse everything else.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_char, c_void};

use fmi::Error;

use super::References;
use crate::component::{OK, Status, call, none_of};

/// Refuses a call.
unsafe fn refuse(function: &'static str, instance: *mut c_void, why: &str) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call(function, instance, |_| Err(Error::new(why))) }
}

/// Refuses a call for anything.
unsafe fn nothing(function: &'static str, instance: *mut c_void, count: usize, what: &str) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call(function, instance, |_| none_of(count, what)) }
}

/// There are no variables of the type Float32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat32(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut f32,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetFloat32", instance, n, "Float32") }
}

/// There are no variables of the type Float32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat32(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const f32,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetFloat32", instance, n, "Float32") }
}

/// There are no variables of the type Int8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt8(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut i8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetInt8", instance, n, "Int8") }
}

/// There are no variables of the type Int8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt8(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const i8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetInt8", instance, n, "Int8") }
}

/// There are no variables of the type UInt8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt8(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut u8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetUInt8", instance, n, "UInt8") }
}

/// There are no variables of the type UInt8.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt8(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const u8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetUInt8", instance, n, "UInt8") }
}

/// There are no variables of the type Int16.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt16(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut i16,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetInt16", instance, n, "Int16") }
}

/// There are no variables of the type Int16.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt16(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const i16,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetInt16", instance, n, "Int16") }
}

/// There are no variables of the type UInt16.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt16(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut u16,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetUInt16", instance, n, "UInt16") }
}

/// There are no variables of the type UInt16.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt16(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const u16,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetUInt16", instance, n, "UInt16") }
}

/// There are no variables of the type UInt32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt32(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut u32,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetUInt32", instance, n, "UInt32") }
}

/// There are no variables of the type UInt32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt32(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const u32,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetUInt32", instance, n, "UInt32") }
}

/// There are no variables of the type Int64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt64(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut i64,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetInt64", instance, n, "Int64") }
}

/// There are no variables of the type Int64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt64(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const i64,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetInt64", instance, n, "Int64") }
}

/// There are no variables of the type UInt64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt64(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut u64,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetUInt64", instance, n, "UInt64") }
}

/// There are no variables of the type UInt64.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt64(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const u64,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetUInt64", instance, n, "UInt64") }
}

/// There are no variables of the type String.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetString(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut *const c_char,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetString", instance, n, "String") }
}

/// There are no variables of the type String.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetString(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const *const c_char,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetString", instance, n, "String") }
}

/// There are no variables of the type Binary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBinary(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _sizes: *mut usize,
    _values: *mut *const u8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetBinary", instance, n, "Binary") }
}

/// There are no variables of the type Binary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBinary(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _sizes: *const usize,
    _values: *const *const u8,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetBinary", instance, n, "Binary") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetClock(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *mut bool,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetClock", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetClock(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _values: *const bool,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetClock", instance, n, "Clock") }
}

/// Dependencies are in the description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    instance: *mut c_void,
    _vr: u32,
    _count: *mut usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3GetNumberOfVariableDependencies",
            instance,
            "the FMU gives dependencies in its description (providesPerElementDependencies is not set)",
        )
    }
}

/// Dependencies are in the description.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    instance: *mut c_void,
    _dependent: u32,
    _elements: *mut usize,
    _independents: *mut u32,
    _independent_elements: *mut usize,
    _kinds: *mut i32,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3GetVariableDependencies",
            instance,
            "the FMU gives dependencies in its description (providesPerElementDependencies is not set)",
        )
    }
}

/// There are no adjoint derivatives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: *mut c_void,
    _unknowns: References,
    _unknown_count: usize,
    _knowns: References,
    _known_count: usize,
    _seed: *const f64,
    _seed_count: usize,
    _out: *mut f64,
    _out_count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3GetAdjointDerivative",
            instance,
            "the FMU gives no adjoint derivatives (providesAdjointDerivatives is not set)",
        )
    }
}

/// There are no structural parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterConfigurationMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3EnterConfigurationMode",
            instance,
            "the FMU has no structural parameters: there is nothing to configure",
        )
    }
}

/// There are no structural parameters.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitConfigurationMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3ExitConfigurationMode",
            instance,
            "the FMU has no structural parameters: there is nothing to configure",
        )
    }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalDecimal(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _intervals: *mut f64,
    _qualifiers: *mut i32,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetIntervalDecimal", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalFraction(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _counters: *mut u64,
    _resolutions: *mut u64,
    _qualifiers: *mut i32,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetIntervalFraction", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetShiftDecimal(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _shifts: *mut f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetShiftDecimal", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetShiftFraction(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _counters: *mut u64,
    _resolutions: *mut u64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetShiftFraction", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetIntervalDecimal(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _intervals: *const f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetIntervalDecimal", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetIntervalFraction(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _counters: *const u64,
    _resolutions: *const u64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetIntervalFraction", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetShiftDecimal(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _shifts: *const f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetShiftDecimal", instance, n, "Clock") }
}

/// There are no clocks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetShiftFraction(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _counters: *const u64,
    _resolutions: *const u64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3SetShiftFraction", instance, n, "Clock") }
}

/// There are no algebraic loops over discrete states: nothing to evaluate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EvaluateDiscreteStates(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { call("fmi3EvaluateDiscreteStates", instance, |_| Ok(OK)) }
}

/// Co-simulation has no event mode to come from (hasEventMode is not set).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterStepMode(instance: *mut c_void) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3EnterStepMode",
            instance,
            "the FMU has no event mode in co-simulation: step mode begins with the end of the initialization",
        )
    }
}

/// There are no derivatives of outputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: *mut c_void,
    _vr: References,
    n: usize,
    _orders: *const i32,
    _values: *mut f64,
    _count: usize,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe { nothing("fmi3GetOutputDerivatives", instance, n, "derivative of an output") }
}

/// There is no scheduled execution.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ActivateModelPartition(
    instance: *mut c_void,
    _clock: u32,
    _time: f64,
) -> Status {
    // SAFETY: the standard's contract, see the module above.
    unsafe {
        refuse(
            "fmi3ActivateModelPartition",
            instance,
            "the FMU has no scheduled execution",
        )
    }
}

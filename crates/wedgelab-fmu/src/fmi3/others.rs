//! Functions of FMI 3.0 for features that the FMU does not have: other types of variables, clocks,
//! configuration, scheduled execution, adjoint and output derivatives. They do nothing when asked for
//! nothing, and refuse everything else.
#![allow(clippy::missing_safety_doc)]

use std::ffi::{c_char, c_void};

use super::References;
use crate::component::{Status, functions, none_of, refuse};

const NO_DEPENDENCIES: &str =
    "the FMU gives dependencies in its description (providesPerElementDependencies is not set)";
const NO_STEP_MODE: &str =
    "the FMU has no event mode in co-simulation: step mode begins with the end of the initialization";

functions! {
    /// There are no variables of the type Float32.
    fn fmi3GetFloat32(_vr: References, n: usize, _values: *mut f32, _count: usize)
        |_| none_of(n, "Float32");

    /// There are no variables of the type Float32.
    fn fmi3SetFloat32(_vr: References, n: usize, _values: *const f32, _count: usize)
        |_| none_of(n, "Float32");

    /// There are no variables of the type Int8.
    fn fmi3GetInt8(_vr: References, n: usize, _values: *mut i8, _count: usize) |_| none_of(n, "Int8");

    /// There are no variables of the type Int8.
    fn fmi3SetInt8(_vr: References, n: usize, _values: *const i8, _count: usize) |_| none_of(n, "Int8");

    /// There are no variables of the type UInt8.
    fn fmi3GetUInt8(_vr: References, n: usize, _values: *mut u8, _count: usize) |_| none_of(n, "UInt8");

    /// There are no variables of the type UInt8.
    fn fmi3SetUInt8(_vr: References, n: usize, _values: *const u8, _count: usize) |_| none_of(n, "UInt8");

    /// There are no variables of the type Int16.
    fn fmi3GetInt16(_vr: References, n: usize, _values: *mut i16, _count: usize) |_| none_of(n, "Int16");

    /// There are no variables of the type Int16.
    fn fmi3SetInt16(_vr: References, n: usize, _values: *const i16, _count: usize)
        |_| none_of(n, "Int16");

    /// There are no variables of the type UInt16.
    fn fmi3GetUInt16(_vr: References, n: usize, _values: *mut u16, _count: usize)
        |_| none_of(n, "UInt16");

    /// There are no variables of the type UInt16.
    fn fmi3SetUInt16(_vr: References, n: usize, _values: *const u16, _count: usize)
        |_| none_of(n, "UInt16");

    /// There are no variables of the type UInt32.
    fn fmi3GetUInt32(_vr: References, n: usize, _values: *mut u32, _count: usize)
        |_| none_of(n, "UInt32");

    /// There are no variables of the type UInt32.
    fn fmi3SetUInt32(_vr: References, n: usize, _values: *const u32, _count: usize)
        |_| none_of(n, "UInt32");

    /// There are no variables of the type Int64.
    fn fmi3GetInt64(_vr: References, n: usize, _values: *mut i64, _count: usize) |_| none_of(n, "Int64");

    /// There are no variables of the type Int64.
    fn fmi3SetInt64(_vr: References, n: usize, _values: *const i64, _count: usize)
        |_| none_of(n, "Int64");

    /// There are no variables of the type UInt64.
    fn fmi3GetUInt64(_vr: References, n: usize, _values: *mut u64, _count: usize)
        |_| none_of(n, "UInt64");

    /// There are no variables of the type UInt64.
    fn fmi3SetUInt64(_vr: References, n: usize, _values: *const u64, _count: usize)
        |_| none_of(n, "UInt64");

    /// There are no variables of the type String.
    fn fmi3GetString(_vr: References, n: usize, _values: *mut *const c_char, _count: usize)
        |_| none_of(n, "String");

    /// There are no variables of the type String.
    fn fmi3SetString(_vr: References, n: usize, _values: *const *const c_char, _count: usize)
        |_| none_of(n, "String");

    /// There are no variables of the type Binary.
    fn fmi3GetBinary(
        _vr: References,
        n: usize,
        _sizes: *mut usize,
        _values: *mut *const u8,
        _count: usize,
    ) |_| none_of(n, "Binary");

    /// There are no variables of the type Binary.
    fn fmi3SetBinary(
        _vr: References,
        n: usize,
        _sizes: *const usize,
        _values: *const *const u8,
        _count: usize,
    ) |_| none_of(n, "Binary");

    /// There are no clocks.
    fn fmi3GetClock(_vr: References, n: usize, _values: *mut bool) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3SetClock(_vr: References, n: usize, _values: *const bool) |_| none_of(n, "Clock");

    /// Dependencies are in the description.
    fn fmi3GetNumberOfVariableDependencies(_vr: u32, _count: *mut usize)
        |_| refuse(NO_DEPENDENCIES);

    /// Dependencies are in the description.
    fn fmi3GetVariableDependencies(
        _dependent: u32,
        _elements: *mut usize,
        _independents: *mut u32,
        _independent_elements: *mut usize,
        _kinds: *mut i32,
        _count: usize,
    ) |_| refuse(NO_DEPENDENCIES);

    /// There are no adjoint derivatives.
    fn fmi3GetAdjointDerivative(
        _unknowns: References,
        _unknown_count: usize,
        _knowns: References,
        _known_count: usize,
        _seed: *const f64,
        _seed_count: usize,
        _out: *mut f64,
        _out_count: usize,
    ) |_| refuse("the FMU gives no adjoint derivatives (providesAdjointDerivatives is not set)");

    /// There are no structural parameters.
    fn fmi3EnterConfigurationMode()
        |_| refuse("the FMU has no structural parameters: there is nothing to configure");

    /// There are no structural parameters.
    fn fmi3ExitConfigurationMode()
        |_| refuse("the FMU has no structural parameters: there is nothing to configure");

    /// There are no clocks.
    fn fmi3GetIntervalDecimal(
        _vr: References,
        n: usize,
        _intervals: *mut f64,
        _qualifiers: *mut i32,
    ) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3GetIntervalFraction(
        _vr: References,
        n: usize,
        _counters: *mut u64,
        _resolutions: *mut u64,
        _qualifiers: *mut i32,
    ) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3GetShiftDecimal(_vr: References, n: usize, _shifts: *mut f64) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3GetShiftFraction(_vr: References, n: usize, _counters: *mut u64, _resolutions: *mut u64)
        |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3SetIntervalDecimal(_vr: References, n: usize, _intervals: *const f64) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3SetIntervalFraction(
        _vr: References,
        n: usize,
        _counters: *const u64,
        _resolutions: *const u64,
    ) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3SetShiftDecimal(_vr: References, n: usize, _shifts: *const f64) |_| none_of(n, "Clock");

    /// There are no clocks.
    fn fmi3SetShiftFraction(
        _vr: References,
        n: usize,
        _counters: *const u64,
        _resolutions: *const u64,
    ) |_| none_of(n, "Clock");

    /// There are no algebraic loops over discrete states: nothing to evaluate.
    fn fmi3EvaluateDiscreteStates() |_| Ok(());

    /// Co-simulation has no event mode to come from (hasEventMode is not set).
    fn fmi3EnterStepMode()
        |_| refuse(NO_STEP_MODE);

    /// There are no derivatives of outputs.
    fn fmi3GetOutputDerivatives(
        _vr: References,
        n: usize,
        _orders: *const i32,
        _values: *mut f64,
        _count: usize,
    ) |_| none_of(n, "derivative of an output");

    /// There is no scheduled execution.
    fn fmi3ActivateModelPartition(_clock: u32, _time: f64)
        |_| refuse("the FMU has no scheduled execution");
}

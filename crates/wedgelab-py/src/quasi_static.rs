//! The quasi-static element over arrays.

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Array<'py> = Bound<'py, PyArray1<f64>>;

/// Steady sliding of massless wedges, one an entry: all arrays have the same length; angles in rad (toe
/// positive out), forces in N, direction +1 up and -1 down, slope +1 friction up the slope, -1 down, 0 as the
/// motion chooses. Gives column normal force, column friction, slope normal force (NaN where the wedge jams),
/// the jam margin, and the branch.
#[pyfunction]
#[pyo3(signature = (angle, toe, column_friction, slope_friction, coil_force, direction, slope))]
pub fn slide<'py>(
    py: Python<'py>,
    angle: PyReadonlyArray1<'py, f64>,
    toe: PyReadonlyArray1<'py, f64>,
    column_friction: PyReadonlyArray1<'py, f64>,
    slope_friction: PyReadonlyArray1<'py, f64>,
    coil_force: PyReadonlyArray1<'py, f64>,
    direction: PyReadonlyArray1<'py, f64>,
    slope: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Array<'py>, Array<'py>, Array<'py>, Array<'py>, Array<'py>)> {
    let (angle, toe) = (angle.as_slice()?, toe.as_slice()?);
    let (column_friction, slope_friction) = (column_friction.as_slice()?, slope_friction.as_slice()?);
    let (coil_force, direction, slope) = (coil_force.as_slice()?, direction.as_slice()?, slope.as_slice()?);
    let count = angle.len();
    let others = [toe, column_friction, slope_friction, coil_force, direction, slope];
    if others.iter().any(|other| other.len() != count) {
        return Err(PyValueError::new_err("the arrays differ in length"));
    }
    let mut out = [(); 5].map(|()| Vec::with_capacity(count));
    py.detach(|| {
        for at in 0..count {
            let wedge = QuasiStaticWedge {
                angle: angle[at],
                toe: toe[at],
                column_friction: column_friction[at],
                slope_friction: slope_friction[at],
            };
            let row = one(&wedge, coil_force[at], direction[at], slope[at]);
            for (column, value) in out.iter_mut().zip(row) {
                column.push(value);
            }
        }
    });
    let [a, b, c, d, e] = out.map(|values| PyArray1::from_vec(py, values));
    Ok((a, b, c, d, e))
}

fn one(wedge: &QuasiStaticWedge, coil_force: f64, direction: f64, slope: f64) -> [f64; 5] {
    let direction = if direction > 0.0 {
        SlidingDirection::Up
    } else {
        SlidingDirection::Down
    };
    let branch = match slope {
        0.0 => wedge.branch(direction),
        up if up > 0.0 => SlopeFriction::UpSlope,
        _ => SlopeFriction::DownSlope,
    };
    let margin = wedge.jam_margin(direction, branch);
    match wedge.slide(direction, branch, coil_force) {
        Some(sliding) => [
            sliding.column_normal,
            sliding.column_friction,
            sliding.slope_normal,
            margin,
            branch.sign(),
        ],
        None => [f64::NAN, f64::NAN, f64::NAN, margin, branch.sign()],
    }
}

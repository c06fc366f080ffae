//! The wedge in a loop of the user's: step by step, with save and restore.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use study::stepping::{CoilInput, NeighbourState, Neighbours, SteppedState, SteppedWedge, SteppingError};

use crate::errors::{guarded, simple};
use crate::model_case::NativeCase;

type Six = [f64; 6];
/// Force and moment.
type Load = ([f64; 3], [f64; 3]);
/// Loads on bolster and side frame, coil compression and force, normal forces and friction losses of column
/// and slope.
type ReadingTuple = (Load, Load, f64, f64, [f64; 2], [f64; 2]);

/// A wedge between neighbours that are moved from outside.
#[pyclass(module = "wedgelab._wedgelab", name = "NativeWedge")]
pub struct NativeWedge {
    wedge: SteppedWedge,
}

fn refused(py: Python<'_>, error: &SteppingError) -> PyErr {
    let help = match error {
        SteppingError::NoStep { .. } => "give a positive dt in s, or as a text such as \"1 ms\"",
        SteppingError::Value { .. } => "the step was not made",
        SteppingError::State(_) | SteppingError::Version { .. } | SteppingError::OtherCase => {
            "restore takes what save of a wedge of the same case has given"
        }
        _ => "restore a saved state, or begin anew with smaller steps",
    };
    simple(py, "StepError", &error.to_string(), help)
}

/// Returns the place of a neighbor from its present one and the one given: without rates, the mean rates on
/// the way.
fn place(from: &NeighbourState, position: Six, rate: Option<Six>, duration: f64) -> NeighbourState {
    match rate {
        Some(rate) => NeighbourState { position, rate },
        None => from.reached(position, duration),
    }
}

#[pymethods]
impl NativeWedge {
    /// At time zero, neighbours where the motions of the case begin, or at these places (positions, rates).
    #[new]
    fn new(
        py: Python<'_>,
        case: &NativeCase,
        bolster: Option<(Six, Six)>,
        side_frame: Option<(Six, Six)>,
    ) -> PyResult<Self> {
        guarded(py, || {
            let mut start = Neighbours::of(&case.case.parameters, 0.0);
            let given = |(position, rate)| NeighbourState { position, rate };
            if let Some(bolster) = bolster {
                start.bolster = given(bolster);
            }
            if let Some(side_frame) = side_frame {
                start.side_frame = given(side_frame);
            }
            let wedge = SteppedWedge::starting(&case.case, &start).map_err(|error| refused(py, &error))?;
            Ok(Self { wedge })
        })
    }

    /// Makes one step. A neighbour without a position stays where it is; without rates, they are the mean
    /// rates on the way.
    #[pyo3(signature = (duration, bolster, bolster_rate, side_frame, side_frame_rate))]
    fn step(
        &mut self,
        py: Python<'_>,
        duration: f64,
        bolster: Six,
        bolster_rate: Option<Six>,
        side_frame: Option<Six>,
        side_frame_rate: Option<Six>,
    ) -> PyResult<()> {
        let wedge = &mut self.wedge;
        guarded(py, || {
            let from = *wedge.neighbours();
            let side = match side_frame {
                Some(position) => place(&from.side_frame, position, side_frame_rate, duration),
                None => place(
                    &from.side_frame,
                    from.side_frame.position,
                    Some([0.0; 6]),
                    duration,
                ),
            };
            let end = Neighbours {
                side_frame: side,
                bolster: place(&from.bolster, bolster, bolster_rate, duration),
            };
            // Before the rates that follow from it are looked at.
            if !(duration > 0.0 && duration.is_finite()) {
                let (step, time) = (duration, wedge.time());
                return Err(refused(py, &SteppingError::NoStep { step, time }));
            }
            wedge.step(&end, duration).map_err(|error| refused(py, &error))
        })
    }

    /// Time, s.
    #[getter]
    fn time(&self) -> f64 {
        self.wedge.time()
    }

    /// Positions and rates of bolster and side frame.
    #[getter]
    fn places(&self) -> [(Six, Six); 2] {
        let neighbours = self.wedge.neighbours();
        [neighbours.bolster, neighbours.side_frame].map(|place| (place.position, place.rate))
    }

    /// Loads on bolster and side frame, coil compression and force, normal forces and friction losses of
    /// column and slope.
    fn reading(&mut self, py: Python<'_>) -> PyResult<ReadingTuple> {
        let wedge = &mut self.wedge;
        guarded(py, || {
            let reading = wedge.reading().map_err(|error| refused(py, &error))?;
            let load = |load: &mechanics::system::Load<f64>| (load.force.0, load.moment.0);
            Ok((
                load(&reading.on_bolster),
                load(&reading.on_side_frame),
                reading.coil_compression,
                reading.coil_force,
                reading.normal_forces,
                reading.friction_losses,
            ))
        })
    }

    /// Names of the columns of `row`.
    fn columns(&self) -> Vec<String> {
        let columns = self.wedge.columns().iter();
        columns.map(|column| column.name.clone()).collect()
    }

    /// Returns the row that a run would write now, SI.
    fn row<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let wedge = &mut self.wedge;
        let row = guarded(py, || Ok(wedge.row()))?;
        Ok(PyArray1::from_vec(py, row))
    }

    /// Sets the coil's force from the case, from a stiffness (N/m), or given (N).
    #[pyo3(signature = (stiffness, force))]
    fn set_coil(&mut self, py: Python<'_>, stiffness: Option<f64>, force: Option<f64>) -> PyResult<()> {
        let coil = match (stiffness, force) {
            (None, None) => CoilInput::Internal,
            (Some(stiffness), None) => CoilInput::Stiffness(stiffness),
            (None, Some(force)) => CoilInput::Force(force),
            _ => {
                let message = "both a stiffness and a force of the coil are given";
                return Err(simple(py, "StepError", message, "give one of them"));
            }
        };
        let wedge = &mut self.wedge;
        guarded(py, || wedge.set_coil(coil).map_err(|error| refused(py, &error)))
    }

    /// Coefficients of friction of column and slope, from now on.
    fn set_friction(&mut self, py: Python<'_>, column: f64, slope: f64) -> PyResult<()> {
        let wedge = &mut self.wedge;
        guarded(py, || {
            wedge
                .set_friction([column, slope])
                .map_err(|error| refused(py, &error))
        })
    }

    /// Returns all that is needed to go on with the same bits.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = guarded(py, || {
            self.wedge.state().to_bytes().map_err(|error| refused(py, &error))
        })?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Goes to a saved state.
    fn restore(&mut self, py: Python<'_>, state: &[u8]) -> PyResult<()> {
        let wedge = &mut self.wedge;
        guarded(py, || {
            let state = SteppedState::from_bytes(state).map_err(|error| refused(py, &error))?;
            wedge.restore(&state).map_err(|error| refused(py, &error))
        })
    }
}

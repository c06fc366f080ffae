//! A case as a driver gets it that has the equations in its own language: the parameters, not the right-hand
//! side.

use serde::Serialize;
use wedge::parameters::Parameters;

use crate::equations::Equations;
use crate::problem::RaceProblem;

/// A wedge with its start, for `drivers/wedge_case.m`. SI units; the state is that of [`Equations`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WedgeCase {
    /// Parameters of the wedge.
    pub parameters: Parameters,
    /// The state at the start.
    pub start: Vec<f64>,
    /// The error scale of each state.
    pub scales: Vec<f64>,
    /// The times of the rows of a result, s.
    pub times: Vec<f64>,
}

impl WedgeCase {
    /// Returns the case of this name.
    ///
    /// # Errors
    /// There is no such problem, or it is no wedge.
    pub fn named(name: &str) -> Result<Self, String> {
        let problem = RaceProblem::named(name).map_err(|error| error.to_string())?;
        let times = (0..problem.rows()).map(|row| problem.time(row)).collect();
        let parameters = problem
            .parameters
            .ok_or_else(|| format!("{name} is no wedge: it has no parameters to hand over"))?;
        let equations = Equations::new(problem.system, &problem.start);
        Ok(Self {
            parameters,
            start: equations.start().to_vec(),
            scales: equations.scales().to_vec(),
            times,
        })
    }

    /// Returns it as JSON, an argument of the driver.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn json(&self) -> Result<String, String> {
        serde_json::to_string(self).map_err(|error| error.to_string())
    }
}

//! The part of the yaw commanded by input bodies that is reached.

use mechanics::connection::Law;
use mechanics::system::Model;
use nucars::truck::Truck;
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use crate::run::RowTable;
use crate::summary::SummaryValue;

/// The share of the commanded yaw below which it counts as not reached.
const REACHED: f64 = 0.5;

/// The yaw of a driven body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct YawSummary {
    /// Number of the driven body in the file.
    pub body: u32,
    /// Mean of the yaw that its input body commands, over the second half of the run.
    pub commanded: SummaryValue,
    /// Mean of the yaw that it reaches, over the same time.
    pub reached: SummaryValue,
}

/// Returns an input body that yaws, and the free body that a yaw spring ties to it, by their places in the
/// model.
pub(super) fn drive(model: &Model) -> Option<(usize, usize)> {
    let yaws = |body: usize| !model.bodies[body].frame.motions[5].is_constant();
    let free = |body: usize| model.bodies[body].free[5];
    model.connections.iter().find_map(|connection| {
        let Law::Springs(springs) = &connection.law else {
            return None;
        };
        let turns = springs.iter().any(|(coordinate, _)| *coordinate == 5);
        let ends = [(connection.a, connection.b), (connection.b, connection.a)];
        ends.into_iter()
            .find(|(input, body)| turns && yaws(*input) && free(*body))
    })
}

/// Returns whether an input body commands a yaw.
#[must_use]
pub fn is_commanded(truck: &Truck) -> bool {
    drive(&truck.model).is_some()
}

/// Commanded and reached yaw of a run, if one is commanded.
pub(super) fn summary(truck: &Truck, table: &RowTable, units: Units) -> Option<YawSummary> {
    let (input, body) = drive(&truck.model)?;
    let motions = &truck.model.bodies[input].frame.motions;
    let number = truck.bodies[body];
    let (times, yaws) = (table.column("time"), table.column(&format!("body_{number}_yaw")));
    let late = times.len() / 2..times.len();
    let count = late.len().max(1) as f64;
    let commanded: f64 = times[late.clone()]
        .iter()
        .map(|time| motions[5].evaluate(*time, *time)[0])
        .sum();
    let reached: f64 = yaws.get(late)?.iter().sum();
    Some(YawSummary {
        body: number,
        commanded: SummaryValue::new(commanded / count, Kind::Angle, units),
        reached: SummaryValue::new(reached / count, Kind::Angle, units),
    })
}

impl YawSummary {
    /// Returns whether less than half of the commanded yaw is reached.
    #[must_use]
    pub fn is_missed(&self) -> bool {
        let (commanded, reached) = (self.commanded.value, self.reached.value);
        reached * commanded.signum() < REACHED * commanded.abs()
    }

    /// Returns the warning for its user.
    #[must_use]
    pub fn warning(&self) -> String {
        format!(
            "body {} is commanded to yaw by {:.4} rad and reaches {:.1e} rad on the mean over the second \
             half of the run: the springs that drive it hold it more than they yaw it",
            self.body, self.commanded.value, self.reached.value
        )
    }
}

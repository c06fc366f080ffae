//! A run of the explorer, of a wedge, of a truck or of a car: its data for the page, and its files.

use std::io;
use std::ops::ControlFlow;
use std::sync::Arc;

use quantity::Kind;
use report::run_files::{RunFiles, TABLES};
use report::summary;
use report::view::View;
use report::view::run::{Detail, Recording};
use serde::Serialize;
use study::car::CarCase;
use study::car::motions::MotionTable;
use study::car::run::CarResult;
use study::case::{Case, FieldSection};
use study::contacts::ContactTable;
use study::models::{AnyCase, AnySummary};
use study::output_files::{OutputFiles, TableFormat};
use study::result::RunResult;
use study::run::{Run, RunCase};
use study::summary::RunSummary;
use study::truck::run::TruckResult;
use study::truck::{TruckCase, WEDGE_NAMES};
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;

use super::api::Refused;

/// The result of a case.
#[derive(Debug)]
pub enum Outcome {
    /// A wedge.
    Wedge(Box<(Case, RunResult)>),
    /// A truck, with the corners of its wedges.
    Truck(Box<(TruckCase, TruckResult, Option<ContactTable>)>),
    /// A car, with the motions of its bodies.
    Car(Box<(CarCase, CarResult, Option<MotionTable>)>),
    /// A vehicle.
    Vehicle(Box<(VehicleCase, VehicleResult)>),
}

/// An axis of the loop: a column of the run, and in words.
#[derive(Debug, Serialize)]
pub struct LoopAxis {
    column: String,
    name: String,
}

impl LoopAxis {
    fn new(column: &str, name: &str) -> Self {
        Self {
            column: column.to_owned(),
            name: name.to_owned(),
        }
    }
}

/// The loop that is shown over earlier ones.
#[derive(Debug, Serialize)]
pub struct Loop {
    title: &'static str,
    x: LoopAxis,
    y: LoopAxis,
    /// A description of the energy below.
    energy_of: &'static str,
    /// Of what it is the energy: of a cycle, or of the whole run.
    energy_per: &'static str,
    /// Energy, J; none where there are no cycles.
    energy: Option<f64>,
    /// The reason if there is none, else empty.
    missing: String,
}

/// Runs a case while it is wanted.
///
/// # Errors
/// It cannot begin, is no longer wanted, or its averages are no numbers.
pub fn compute(case: AnyCase, wanted: impl Fn() -> bool) -> Result<Outcome, Refused> {
    let mut replaced = false;
    let mut goes_on = |_: f64| match wanted() {
        true => ControlFlow::Continue(()),
        false => {
            replaced = true;
            ControlFlow::Break("another run took its place".to_owned())
        }
    };
    let outcome = match case {
        AnyCase::Wedge(case) => {
            let result = started(Run::new(&*case))?.finish_while(&mut goes_on);
            Outcome::Wedge(Box::new((Arc::unwrap_or_clone(case), result)))
        }
        AnyCase::Truck(case) => {
            let run = started(Run::with_contacts(&*case))?;
            let (result, contacts) = run.finish_with_contacts(&mut goes_on);
            Outcome::Truck(Box::new((Arc::unwrap_or_clone(case), result, contacts)))
        }
        AnyCase::HalfTruck(_) => return Err(Refused::mistake("", NO_HALF_TRUCK.to_owned(), "")),
        AnyCase::Car(case) => {
            let run = started(Run::with_motions(&case))?;
            let (result, motions) = run.finish_with_motions(&mut goes_on);
            Outcome::Car(Box::new((Arc::unwrap_or_clone(case), result, motions)))
        }
        AnyCase::Vehicle(case) => {
            let result = started(Run::new(&*case))?.finish_while(&mut goes_on);
            Outcome::Vehicle(Box::new((Arc::unwrap_or_clone(case), result)))
        }
    };
    if replaced {
        return Err(Refused::Replaced);
    }
    outcome.finite()?;
    Ok(outcome)
}

/// The reason for refusing half-trucks.
pub const NO_HALF_TRUCK: &str =
    "the explorer takes wedges, trucks, cars and vehicles, not the half-trucks of NUCARS's files";

fn started<C: RunCase>(run: Result<Run<C>, study::run::RunError>) -> Result<Run<C>, Refused> {
    run.map_err(|error| Refused::mistake("", format!("the run cannot begin: {error}"), OUT_OF_PROPORTION))
}

const OUT_OF_PROPORTION: &str = "look for values that are out of proportion";

impl Outcome {
    /// Returns whether it is that of a case.
    pub fn is_of(&self, case: &AnyCase) -> bool {
        match (self, case) {
            (Self::Wedge(own), AnyCase::Wedge(case)) => own.0 == **case,
            (Self::Truck(own), AnyCase::Truck(case)) => own.0 == **case,
            (Self::Car(own), AnyCase::Car(case)) => own.0 == **case,
            (Self::Vehicle(own), AnyCase::Vehicle(case)) => own.0 == **case,
            _ => false,
        }
    }

    /// Returns the name of its case.
    pub fn name(&self) -> &str {
        match self {
            Self::Wedge(own) => &own.0.name,
            Self::Truck(own) => &own.0.name,
            Self::Car(own) => &own.0.name,
            Self::Vehicle(own) => &own.0.name,
        }
    }

    /// Returns the fields of its case.
    pub fn fields(&self) -> Vec<FieldSection> {
        match self {
            Self::Wedge(own) => own.0.fields().to_vec(),
            Self::Truck(own) => own.0.fields().to_vec(),
            Self::Car(own) => own.0.fields().to_vec(),
            Self::Vehicle(own) => own.0.fields().to_vec(),
        }
    }

    /// Refuses results whose averages are not finite: no number can be shown for them. Rows always are.
    pub fn finite(&self) -> Result<(), Refused> {
        let found = match self {
            Self::Wedge(own) => own.1.summary.not_finite(),
            // Runs of the others stop where a number is none.
            Self::Truck(_) | Self::Car(_) | Self::Vehicle(_) => None,
        };
        match found {
            Some(what) => Err(Refused::mistake(
                "",
                format!("{what} is not a finite number"),
                OUT_OF_PROPORTION,
            )),
            None => Ok(()),
        }
    }

    /// Returns the view that the page draws.
    pub fn view(&self) -> View {
        match self {
            Self::Wedge(own) => {
                let recording = Recording::of_wedge(own, Detail::Full);
                View::new(own.1.summary.units, [recording], [])
            }
            Self::Truck(own) => {
                let (case, result, contacts) = &**own;
                let recording =
                    Recording::of_three_piece_truck(case, result, contacts.as_ref(), Detail::Thinned);
                View::new(result.summary.units(), [recording], [])
            }
            Self::Car(own) => {
                let (case, result, motions) = &**own;
                let recording = Recording::of_car(case, result, motions.as_ref(), Detail::Thinned);
                View::new(result.summary.units(), [recording], [])
            }
            Self::Vehicle(own) => {
                let (case, result) = &**own;
                let recording = Recording::of_vehicle(case, result, Detail::Thinned);
                View::new(result.summary.units, [recording], [])
            }
        }
    }

    /// Returns its summary, of a wedge without the list of events.
    pub fn summary(&self) -> AnySummary {
        match self {
            Self::Wedge(own) => {
                let mut summary = own.1.summary.clone();
                summary.events.listed.clear();
                summary.into()
            }
            Self::Truck(own) => own.1.summary.clone().into(),
            Self::Car(own) => own.1.summary.clone().into(),
            Self::Vehicle(own) => own.1.summary.clone().into(),
        }
    }

    /// Returns the loop of it.
    pub fn shown_loop(&self) -> Loop {
        match self {
            Self::Wedge(own) => loop_of_wedge(&own.1),
            Self::Truck(own) => loop_of_truck(&own.1),
            Self::Car(own) => loop_of_car(&own.0, &own.1),
            Self::Vehicle(own) => loop_of_vehicle(&own.1),
        }
    }

    /// Writes one of its files, but not the case. Returns the type of what was written.
    pub fn write(&self, file: &str, out: &mut Vec<u8>) -> io::Result<&'static str> {
        let Some((format, _)) = TABLES.into_iter().find(|(_, name)| *name == file) else {
            match self {
                Self::Wedge(own) => summary::write_json(&own.1.summary, out)?,
                Self::Truck(own) => summary::write_json(&own.1.summary, out)?,
                Self::Car(own) => summary::write_json(&own.1.summary, out)?,
                Self::Vehicle(own) => summary::write_json(&own.1.summary, out)?,
            }
            return Ok("application/json");
        };
        // All columns, whatever the case keeps in folders.
        let all = OutputFiles::default();
        match self {
            Self::Wedge(own) => own.0.write_table(&own.1, format, &all, out)?,
            Self::Truck(own) => own.0.write_table(&own.1, format, &all, out)?,
            Self::Car(own) => own.0.write_table(&own.1, format, &all, out)?,
            Self::Vehicle(own) => own.0.write_table(&own.1, format, &all, out)?,
        }
        Ok(match format {
            TableFormat::Csv => "text/csv",
            TableFormat::Mat => "application/octet-stream",
            TableFormat::Parquet => "application/vnd.apache.parquet",
        })
    }
}

/// Returns the vertical motion of the first body that moves, or its first column.
fn loop_of_vehicle(result: &VehicleResult) -> Loop {
    let columns = result.columns.iter().skip(1);
    let up = columns.clone().find(|own| own.name.ends_with("_z"));
    let shown = up.or_else(|| columns.clone().next());
    let (column, name) = shown.map_or(("time", "time"), |own| (own.name.as_str(), own.text.as_str()));
    let losses = result.column("losses").and_then(<[f64]>::last);
    Loop {
        title: "Motion over time",
        x: LoopAxis::new("time", "time"),
        y: LoopAxis::new(column, name),
        energy_of: "Energy lost in all elements",
        energy_per: "run",
        energy: losses.copied(),
        missing: String::new(),
    }
}

fn joules(value: f64, units: quantity::System) -> f64 {
    value / Kind::Energy.from_si(units)
}

/// The period that energies of periodic motions are of.
const CYCLE: &str = "cycle";

fn loop_of_wedge(result: &RunResult) -> Loop {
    let averages = &result.summary.averages;
    let energy = averages.energy_per_cycle.get("side_frame");
    Loop {
        title: "Vertical wedge force over the bolster's travel",
        x: LoopAxis::new("bolster_vertical", "bolster, vertical"),
        y: LoopAxis::new("vertical_wedge_force", "vertical force on the side frame"),
        energy_of: "Energy lost in friction at the side frame",
        energy_per: CYCLE,
        energy: energy.map(|energy| joules(energy.value, result.summary.units)),
        missing: averages.missing.clone(),
    }
}

/// Returns the loop of warp where the truck warps, of roll where the bolster rolls, else of the vertical
/// motion.
fn loop_of_truck(result: &TruckResult) -> Loop {
    let range = |name: &str| range(result.column(name));
    let (title, x, y) = if range("warp_angle") > 1e-3 {
        (
            "Warp moment over the warp angle",
            ("warp_angle", "warp angle"),
            ("warp_moment", "warp moment on the bolster"),
        )
    } else if range("bolster_roll") > 1e-3 {
        (
            "Roll moment over the bolster's roll",
            ("bolster_roll", "bolster, roll"),
            ("bolster_roll_moment", "roll moment on the bolster"),
        )
    } else {
        (
            "Load of the left nest over the bolster's travel",
            ("bolster_z", "bolster, vertical"),
            ("left_nest_vertical_force", "load of the left nest"),
        )
    };
    let cycles = &result.summary.cycles;
    // Lands are named after the wedges beside them.
    let is_of = |name: &str, wedge: &str| name.starts_with(wedge) && !name.contains("_land_");
    let of_wedges = |name: &str| WEDGE_NAMES.iter().any(|wedge| is_of(name, wedge));
    let losses = cycles.losses.iter().filter(|(name, _)| of_wedges(name));
    let sum: f64 = losses.map(|(_, loss)| loss.value).sum();
    Loop {
        title,
        x: LoopAxis::new(x.0, x.1),
        y: LoopAxis::new(y.0, y.1),
        energy_of: "Energy lost at the four wedges",
        energy_per: CYCLE,
        energy: (cycles.count > 0).then(|| joules(sum, result.summary.units())),
        missing: cycles.missing.clone(),
    }
}

/// Returns the greatest value of a column less its least.
fn range(column: Option<&[f64]>) -> f64 {
    let values = column.unwrap_or_default().iter();
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| {
        (least.min(*value), most.max(*value))
    });
    most - least
}

/// Over the distance: the roll of the body where it rolls by more than 0.5 deg, the lateral force of the
/// leading axle's wheel that pushes more where the track curves, else the vertical force of the leading left
/// wheel.
fn loop_of_car(case: &CarCase, result: &CarResult) -> Loop {
    let most = |name: &str| {
        let values = result.column(name).unwrap_or_default().iter();
        values.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let distances = result.column("distance").unwrap_or_default();
    let line = &case.parameters.track.center_line;
    let curves = distances.iter().any(|at| line.at(*at).curvature[0] != 0.0);
    let [left, right] = ["axle_1_left_lateral", "axle_1_right_lateral"];
    let (title, column, name) = if range(result.column("body_roll")) > 0.5_f64.to_radians() {
        (
            "Roll of the body over the distance",
            "body_roll",
            "roll of the body, left side up",
        )
    } else if curves {
        let outer = if most(left) > most(right) { left } else { right };
        (
            "Lateral force of a wheel of the leading axle over the distance",
            outer,
            "lateral force, positive where it spreads the gauge",
        )
    } else {
        (
            "Vertical force of the leading left wheel over the distance",
            "axle_1_left_vertical",
            "vertical force",
        )
    };
    let losses: f64 = result.summary.wedge_losses.values().map(|loss| loss.value).sum();
    Loop {
        title,
        x: LoopAxis::new("distance", "distance along the track"),
        y: LoopAxis::new(column, name),
        energy_of: "Energy lost in friction at the eight wedges",
        energy_per: "run",
        energy: Some(joules(losses, result.summary.units)),
        missing: String::new(),
    }
}

//! The summary of a run of any model, by the schema that it names.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use study::car::summary::{CarSummary, SCHEMA as CAR};
use study::half_truck::{HalfTruckSummary, SCHEMA as HALF_TRUCK};
use study::summary::{RunSummary, SCHEMA as WEDGE, Summary, SummaryValue};
use study::truck::summary::{SCHEMA as TRUCK, TruckSummary};
use study::wheelset::summary::{SCHEMA as WHEELSET, WheelsetSummary};

use super::RunFolderError;

/// The schemas that this version reads, with the commands that write them.
pub(super) const SCHEMAS: [(&str, &str); 5] = [
    (WEDGE, "run"),
    (HALF_TRUCK, "nucars run"),
    (TRUCK, "run"),
    (CAR, "run"),
    (WHEELSET, "wheelrail run"),
];

/// The summary of a run of any model.
#[derive(Clone, Debug)]
pub enum AnySummary {
    /// Of a wedge.
    Wedge(Box<Summary>),
    /// Of a half-truck from files of NUCARS.
    HalfTruck(Box<HalfTruckSummary>),
    /// Of a three-piece truck.
    Truck(Box<TruckSummary>),
    /// Of a car.
    Car(Box<CarSummary>),
    /// Of a wheelset.
    Wheelset(Box<WheelsetSummary>),
}

/// Does the same with the summary of whatever model.
macro_rules! each {
    ($any:expr, $summary:ident => $do:expr) => {
        match $any {
            AnySummary::Wedge($summary) => $do,
            AnySummary::HalfTruck($summary) => $do,
            AnySummary::Truck($summary) => $do,
            AnySummary::Car($summary) => $do,
            AnySummary::Wheelset($summary) => $do,
        }
    };
}

/// The energy ledger at the end of a run.
#[derive(Clone, Copy, Debug)]
pub struct Ledger<'s> {
    /// Its entries by name.
    pub entries: &'s BTreeMap<String, SummaryValue>,
    /// Largest residual at any output time.
    pub largest_residual: &'s SummaryValue,
    /// The first output time with this residual, s.
    pub largest_residual_time: f64,
}

/// The schema that every document of the program names.
#[derive(Deserialize)]
struct Named {
    schema: Option<String>,
}

impl AnySummary {
    /// Understands the content of a `summary.json`.
    pub(super) fn parse(file: &Path, bytes: &[u8]) -> Result<Self, RunFolderError> {
        let named: Named = parsed(file, bytes)?;
        let schema = named.schema.unwrap_or_default();
        Ok(match schema.as_str() {
            WEDGE => Self::Wedge(Box::new(parsed(file, bytes)?)),
            HALF_TRUCK => Self::HalfTruck(Box::new(parsed(file, bytes)?)),
            TRUCK => Self::Truck(Box::new(parsed(file, bytes)?)),
            CAR => Self::Car(Box::new(parsed(file, bytes)?)),
            WHEELSET => Self::Wheelset(Box::new(parsed(file, bytes)?)),
            _ => return Err(RunFolderError::schema(file, &schema)),
        })
    }

    /// Returns the part that the summaries of all models have.
    #[must_use]
    pub fn shared(&self) -> &dyn RunSummary {
        each!(self, summary => summary.as_ref())
    }

    /// Returns the schema that it names.
    #[must_use]
    pub fn schema(&self) -> &str {
        each!(self, summary => &summary.schema)
    }

    /// Returns the name of the model, with its article.
    #[must_use]
    pub fn what(&self) -> &'static str {
        match self {
            Self::Wedge(_) => "a friction wedge",
            Self::HalfTruck(_) => "a half-truck from files of NUCARS",
            Self::Truck(_) => "a three-piece truck",
            Self::Car(_) => "a car on track",
            Self::Wheelset(_) => "a wheelset on a track",
        }
    }

    /// Returns the case's title; may be empty.
    #[must_use]
    pub fn title(&self) -> &str {
        match self {
            Self::Wedge(own) => &own.title,
            Self::HalfTruck(own) => &own.title,
            Self::Truck(own) => &own.title,
            Self::Car(own) => &own.title,
            Self::Wheelset(_) => "",
        }
    }

    /// Returns the program that wrote it, with its version.
    #[must_use]
    pub fn program(&self) -> &str {
        each!(self, summary => &summary.program)
    }

    /// Returns the number of rows of its table.
    #[must_use]
    pub fn rows(&self) -> usize {
        each!(self, summary => summary.rows)
    }

    /// Returns the assumptions.
    #[must_use]
    pub fn assumptions(&self) -> &[String] {
        each!(self, summary => &summary.assumptions)
    }

    /// Returns its energy ledger.
    #[must_use]
    pub fn ledger(&self) -> Ledger<'_> {
        match self {
            Self::HalfTruck(own) => Ledger {
                entries: &own.ledger,
                largest_residual: &own.largest_residual,
                largest_residual_time: own.largest_residual_time,
            },
            Self::Wedge(own) => Ledger::of(&own.ledger),
            Self::Truck(own) => Ledger::of(&own.ledger),
            Self::Car(own) => Ledger::of(&own.ledger),
            Self::Wheelset(own) => Ledger::of(&own.ledger),
        }
    }

    /// Returns the steps of the integrator, and its relative tolerance.
    #[must_use]
    pub fn solver(&self) -> (u64, f64) {
        match self {
            Self::Wedge(own) => (own.solver.statistics.steps, own.solver.relative_tolerance),
            Self::HalfTruck(own) => (own.statistics.steps, own.relative_tolerance),
            Self::Truck(own) => (own.statistics.steps, own.relative_tolerance),
            Self::Car(own) => (own.solver.steps, own.relative_tolerance),
            Self::Wheelset(own) => (own.statistics.steps, own.relative_tolerance),
        }
    }
}

impl<'s> Ledger<'s> {
    fn of(own: &'s study::summary::LedgerSummary) -> Self {
        Self {
            entries: &own.entries,
            largest_residual: &own.largest_residual,
            largest_residual_time: own.largest_residual_time,
        }
    }
}

fn parsed<T: DeserializeOwned>(file: &Path, bytes: &[u8]) -> Result<T, RunFolderError> {
    serde_json::from_slice(bytes).map_err(|error| RunFolderError::damaged(file, &error))
}

//! The worst run of a regime, of whatever runs on a track.

use std::io;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use staging::{FileError, Folder};
use study::car::CarCase;
use study::car::limits::LimitSet;
use study::models::AnyCase;
use study::run::Run;
use study::summary::RunSummary;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;

use crate::figures::Exhibit;
use crate::figures::car::{self, CarRun};
use crate::figures::vehicle;
use crate::models::ReportCase;
use crate::page::{FILE_NAME, in_unit};
use crate::view::run::{Detail, Recording};

/// The duration around the worst value that is shown moving, s.
const SECOND: f64 = 1.0;

/// A run on a track with its case.
#[derive(Clone, Debug)]
pub enum TrackRun {
    /// Of a car, with the motions of its bodies.
    Car(Box<CarRun>),
    /// Of a vehicle.
    Vehicle(Box<(VehicleCase, VehicleResult)>),
}

impl TrackRun {
    /// Runs a case under another name, whose summary compares with limits, as long as it may; `None` of
    /// models that run on no track, and of cases that do not begin.
    pub fn of(
        case: &AnyCase,
        name: &str,
        limits: &Arc<LimitSet>,
        mut go_on: impl FnMut() -> ControlFlow<String>,
    ) -> Option<Self> {
        match case {
            AnyCase::Car(case) => {
                let mut case = case.named(name);
                case.limits = Some(limits.clone());
                let started = Run::with_motions(&case).ok()?;
                let (result, motions) = started.finish_with_motions(|_| go_on());
                Some(Self::Car(Box::new(CarRun {
                    case,
                    result,
                    motions,
                })))
            }
            AnyCase::Vehicle(case) => {
                let mut case = case.named(name);
                case.limits = Some(limits.clone());
                let result = Run::new(&case).ok()?.finish_while(|_| go_on());
                Some(Self::Vehicle(Box::new((case, result))))
            }
            _ => None,
        }
    }

    /// Returns its summary.
    #[must_use]
    pub fn summary(&self) -> &dyn RunSummary {
        match self {
            Self::Car(own) => &own.result.summary,
            Self::Vehicle(own) => &own.1.summary,
        }
    }

    /// Writes its files and its page into a folder below one.
    ///
    /// # Errors
    /// Something cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        match self {
            Self::Car(own) => write::<CarCase>(own, path),
            Self::Vehicle(own) => write::<VehicleCase>(own, path),
        }
    }

    /// Returns its figures.
    pub(super) fn exhibits(&self) -> Vec<Exhibit> {
        match self {
            Self::Car(own) => car::exhibits(own),
            Self::Vehicle(own) => vehicle::exhibits(&own.1),
        }
    }

    /// Returns whether there are motions of its bodies.
    pub(super) fn moves(&self) -> bool {
        match self {
            Self::Car(own) => own.motions.is_some(),
            Self::Vehicle(_) => true,
        }
    }

    /// Returns the rows around a time (s), or all of them.
    pub(super) fn around(&self, time: Option<f64>) -> Recording {
        let cut = |times: Option<&[f64]>, values: &mut Vec<Vec<f64>>| {
            let (Some(begin), Some(times)) = (time, times) else {
                return;
            };
            let from = times.partition_point(|time| *time < begin - 0.5 * SECOND);
            let to = times.partition_point(|time| *time <= begin + 0.5 * SECOND);
            for column in values {
                *column = column.get(from..to).unwrap_or_default().to_vec();
            }
        };
        match self {
            Self::Car(own) => {
                let (mut result, mut motions) = (own.result.clone(), own.motions.clone());
                let times = own.result.column("time");
                cut(times, &mut result.values);
                if let Some(motions) = &mut motions {
                    cut(times, &mut motions.values);
                }
                Recording::of_car(&own.case, &result, motions.as_ref(), Detail::Thinned)
            }
            Self::Vehicle(own) => {
                let (case, result) = &**own;
                let mut around = result.clone();
                cut(result.column("time"), &mut around.values);
                Recording::of_vehicle(case, &around, Detail::Thinned)
            }
        }
    }

    /// Returns of each wedge its name, the energy that its friction took, the share of the time in which no
    /// point slips; none of a vehicle, whose losses are by element.
    pub(super) fn wedges(&self) -> Vec<[String; 3]> {
        let Self::Car(own) = self else {
            return Vec::new();
        };
        let summary = &own.result.summary;
        let rows = summary.wedge_losses.iter().map(|(name, loss)| {
            let locked = summary.wedge_locked.get(name);
            let locked = locked.map(|share| format!("{:.0} % of the time", 100.0 * share));
            [
                name.replace('_', " "),
                in_unit(loss.value, &loss.unit),
                locked.unwrap_or_else(|| "–".to_owned()),
            ]
        });
        rows.collect()
    }
}

/// The same run gives the same files.
fn write<C: ReportCase>(shown: &C::Shown, path: &Path) -> Result<(), FileError> {
    let (case, result) = C::parts(shown);
    let names = [case.names(&case.output_files()), vec![FILE_NAME]].concat();
    let folder = Folder::check(path.to_owned(), &names, true)?;
    case.write(&folder, result)?;
    folder.write(|files| {
        files.add(FILE_NAME, |out| {
            let page = C::page(shown).map_err(io::Error::other)?;
            out.write_all(page.as_bytes())
        })
    })
}

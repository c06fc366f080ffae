//! The runs from which claims are decided, identified by their parameters, not by their names.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;

use mechanics::motion::Motion;
use quantity::{Kind, System as Units};
use study::case::Case;
use study::half_truck::HalfTruckResult;
use study::half_truck::catalog::{CatalogEntry, ToeCase, WedgeType, YawCase};
use study::metrics::Cycle;
use study::result::RunResult;
use wedge::face::FaceDirection;
use wedge::parameters::Damping;

use crate::agreement::{COMPONENT, truck_column};

/// Direction of the toe angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Toe {
    /// The gap between column and bolster opens downwards.
    Out,
    /// Column and bolster are parallel.
    None,
    /// The gap closes downwards.
    In,
}

/// The shape of the wedge's slope face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum SlopeShape {
    /// Flat, as in the thesis's runs.
    #[default]
    Flat,
    /// Curved along the slope.
    CurvedUp,
    /// Curved across it.
    CurvedAcross,
}

/// The key of one of the twelve runs: damping, toe, yaw; and of runs beside them with a curved slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct RunId {
    /// True if the damping is constant; variable otherwise.
    pub constant: bool,
    /// Direction of the toe angle.
    pub toe: Toe,
    /// True if the bolster is yawed.
    pub yawed: bool,
    /// The shape of the wedge's slope face.
    pub slope: SlopeShape,
}

impl RunId {
    /// Returns the kind of a case, by its parameters.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        let parameters = &case.parameters;
        Self {
            constant: parameters.damping == Damping::Constant,
            toe: match parameters.toe {
                toe if toe > 0.0 => Toe::Out,
                toe if toe < 0.0 => Toe::In,
                _ => Toe::None,
            },
            yawed: !matches!(&parameters.bolster.coordinates[5], Motion::Constant(yaw) if *yaw == 0.0),
            slope: match &parameters.slope_face.wedge_surface {
                own if own.profile.is_flat() => SlopeShape::Flat,
                own if own.direction == FaceDirection::Up => SlopeShape::CurvedUp,
                _ => SlopeShape::CurvedAcross,
            },
        }
    }
}

impl RunId {
    /// Returns the kind of case that a half-truck's run is compared with; `None` for yaw as printed, which is
    /// no yaw.
    #[must_use]
    pub fn of_truck(entry: &CatalogEntry) -> Option<Self> {
        Some(Self {
            constant: entry.damping == Damping::Constant,
            toe: match entry.toe {
                ToeCase::Out => Toe::Out,
                ToeCase::None => Toe::None,
                ToeCase::In => Toe::In,
            },
            yawed: match entry.yaw {
                YawCase::Straight => false,
                YawCase::Intended => true,
                YawCase::Printed => return None,
            },
            slope: SlopeShape::Flat,
        })
    }
}

/// A run that a predicate names: of the stand-alone wedge, or of the half-truck with wedges of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct EvidenceSource {
    run: RunId,
    wedges: Option<WedgeType>,
}

impl fmt::Display for EvidenceSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(wedges) = self.wedges {
            write!(f, "type {}, ", wedges.code())?;
        }
        self.run.fmt(f)
    }
}

impl fmt::Display for RunId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.constant { "constant" } else { "variable" })?;
        f.write_str(match self.toe {
            Toe::Out => ", toe out",
            Toe::None => ", no toe",
            Toe::In => ", toe in",
        })?;
        f.write_str(if self.yawed { ", yawed" } else { "" })?;
        f.write_str(match self.slope {
            SlopeShape::Flat => "",
            SlopeShape::CurvedUp => ", slope curved along",
            SlopeShape::CurvedAcross => ", slope curved across",
        })
    }
}

/// The names that predicates have for the runs: `vd` and `cd` for variable and constant damping; `up` and
/// `across` at the end for a slope that is curved along it and across it; `68` and `69` for the half-truck
/// with wedges of that type.
#[allow(non_upper_case_globals)] // They stand for the names of arguments.
pub(super) mod runs {
    use study::half_truck::catalog::WedgeType;

    use super::{EvidenceSource, RunId, SlopeShape, Toe};

    const fn id(constant: bool, toe: Toe, yawed: bool) -> EvidenceSource {
        EvidenceSource {
            run: RunId {
                constant,
                toe,
                yawed,
                slope: SlopeShape::Flat,
            },
            wedges: None,
        }
    }

    const fn curved(slope: SlopeShape, flat: EvidenceSource) -> EvidenceSource {
        EvidenceSource {
            run: RunId { slope, ..flat.run },
            wedges: None,
        }
    }

    const fn truck(wedges: WedgeType, alone: EvidenceSource) -> EvidenceSource {
        EvidenceSource {
            run: alone.run,
            wedges: Some(wedges),
        }
    }

    pub(in crate::claims) const vd_out: EvidenceSource = id(false, Toe::Out, false);
    pub(in crate::claims) const vd_none: EvidenceSource = id(false, Toe::None, false);
    pub(in crate::claims) const vd_in: EvidenceSource = id(false, Toe::In, false);
    pub(in crate::claims) const vd_out_yaw: EvidenceSource = id(false, Toe::Out, true);
    pub(in crate::claims) const vd_none_yaw: EvidenceSource = id(false, Toe::None, true);
    pub(in crate::claims) const vd_in_yaw: EvidenceSource = id(false, Toe::In, true);
    pub(in crate::claims) const cd_out: EvidenceSource = id(true, Toe::Out, false);
    pub(in crate::claims) const cd_none: EvidenceSource = id(true, Toe::None, false);
    pub(in crate::claims) const cd_in: EvidenceSource = id(true, Toe::In, false);
    pub(in crate::claims) const cd_out_yaw: EvidenceSource = id(true, Toe::Out, true);
    pub(in crate::claims) const cd_none_yaw: EvidenceSource = id(true, Toe::None, true);
    pub(in crate::claims) const cd_in_yaw: EvidenceSource = id(true, Toe::In, true);

    pub(in crate::claims) const vd_out_up: EvidenceSource = curved(SlopeShape::CurvedUp, vd_out);
    pub(in crate::claims) const vd_out_across: EvidenceSource = curved(SlopeShape::CurvedAcross, vd_out);
    pub(in crate::claims) const cd_out_up: EvidenceSource = curved(SlopeShape::CurvedUp, cd_out);
    pub(in crate::claims) const cd_out_across: EvidenceSource = curved(SlopeShape::CurvedAcross, cd_out);

    pub(in crate::claims) const vd_out_68: EvidenceSource = truck(WedgeType::Plain, vd_out);
    pub(in crate::claims) const vd_out_69: EvidenceSource = truck(WedgeType::Spatial, vd_out);
    pub(in crate::claims) const vd_out_yaw_68: EvidenceSource = truck(WedgeType::Plain, vd_out_yaw);
    pub(in crate::claims) const vd_out_yaw_69: EvidenceSource = truck(WedgeType::Spatial, vd_out_yaw);
    pub(in crate::claims) const cd_out_68: EvidenceSource = truck(WedgeType::Plain, cd_out);
    pub(in crate::claims) const cd_out_69: EvidenceSource = truck(WedgeType::Spatial, cd_out);
    pub(in crate::claims) const cd_out_yaw_68: EvidenceSource = truck(WedgeType::Plain, cd_out_yaw);
    pub(in crate::claims) const cd_out_yaw_69: EvidenceSource = truck(WedgeType::Spatial, cd_out_yaw);
}

/// The runs that there are.
#[derive(Clone, Debug, Default)]
pub struct Evidence<'a> {
    runs: BTreeMap<RunId, (&'a Case, &'a RunResult)>,
    trucks: BTreeMap<(RunId, WedgeType), &'a HalfTruckResult>,
}

impl<'a> Evidence<'a> {
    /// Takes runs; each is known by its case's parameters. Of two runs of one kind the later one counts.
    pub fn new(runs: impl IntoIterator<Item = (&'a Case, &'a RunResult)>) -> Self {
        Self {
            runs: runs
                .into_iter()
                .map(|(case, result)| (RunId::of(case), (case, result)))
                .collect(),
            trucks: BTreeMap::new(),
        }
    }

    /// Returns the same with runs of the half-truck; those with yaw as printed are not looked at. A run of
    /// the half-truck is compared with the stand-alone run of its damping, toe and yaw, which tells the
    /// cycle.
    #[must_use]
    pub fn with_trucks(
        mut self,
        trucks: impl IntoIterator<Item = (&'a CatalogEntry, &'a HalfTruckResult)>,
    ) -> Self {
        let known = trucks
            .into_iter()
            .filter_map(|(entry, result)| Some(((RunId::of_truck(entry)?, entry.wedges), result)));
        self.trucks.extend(known);
        self
    }

    /// Returns the same with the places of two runs exchanged: what would be found if one were taken for the
    /// other.
    #[must_use]
    pub fn exchanged(mut self, one: RunId, other: RunId) -> Self {
        let (first, second) = (self.runs.remove(&one), self.runs.remove(&other));
        self.runs.extend(second.map(|run| (one, run)));
        self.runs.extend(first.map(|run| (other, run)));
        self
    }

    /// Units in which values are shown: those of the first run, inch-pound without any.
    #[must_use]
    pub fn units(&self) -> Units {
        self.runs
            .values()
            .next()
            .map_or(Units::Us, |(_, result)| result.summary.units)
    }

    /// Returns a run that is there, complete, and moves in cycles.
    fn find(&self, source: EvidenceSource) -> Result<Seen<'a>, String> {
        let Some((case, result)) = self.runs.get(&source.run) else {
            return Err(format!("the run \"{}\" was not made", source.run));
        };
        let table = match source.wedges {
            None => TableOf::Alone(result),
            Some(wedges) => match self.trucks.get(&(source.run, wedges)) {
                Some(result) => TableOf::Truck(result),
                None => return Err(format!("the run \"{source}\" was not made")),
            },
        };
        if table.has_failed() {
            return Err(format!(
                "the energy ledger of the run \"{source}\" does not close"
            ));
        }
        if !table.is_complete() {
            let time = table.column("time").and_then(<[f64]>::last).copied();
            return Err(format!(
                "the run \"{source}\" stopped at {:.3} s",
                time.unwrap_or_default()
            ));
        }
        let Some(cycle) = Cycle::of(&case.parameters) else {
            return Err(format!(
                "the bolster's vertical motion in the run \"{}\" is not one sine or triangle",
                source.run
            ));
        };
        Ok(Seen {
            source,
            case,
            table,
            cycle,
        })
    }
}

/// The table of a run, under the names of the stand-alone wedge's columns.
#[derive(Clone, Copy)]
enum TableOf<'a> {
    Alone(&'a RunResult),
    Truck(&'a HalfTruckResult),
}

impl<'a> TableOf<'a> {
    fn is_complete(self) -> bool {
        match self {
            Self::Alone(result) => result.summary.complete,
            Self::Truck(result) => result.summary.complete,
        }
    }

    fn has_failed(self) -> bool {
        match self {
            Self::Alone(result) => result.summary.failed.is_some(),
            Self::Truck(result) => result.summary.failed.is_some(),
        }
    }

    /// Returns a column, SI. The leading left wedge of a half-truck has the column's names where it has what
    /// they stand for.
    fn column(self, name: &str) -> Option<&'a [f64]> {
        match self {
            Self::Alone(result) => result.column(name),
            Self::Truck(result) => truck_column(result, name),
        }
    }
}

/// A run found.
#[derive(Clone, Copy)]
struct Seen<'a> {
    source: EvidenceSource,
    case: &'a Case,
    table: TableOf<'a>,
    cycle: Cycle,
}

/// A value that was found, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct NotedValue {
    /// Run and quantity of the value.
    pub label: String,
    /// The value, SI.
    pub value: f64,
    /// The quantity that it stands for.
    pub kind: Kind,
}

/// The notes that predicates make as they are evaluated.
#[derive(Debug, Default)]
struct Notes {
    values: RefCell<Vec<NotedValue>>,
    gaps: RefCell<Vec<String>>,
}

/// A run as a predicate sees it.
#[derive(Clone, Copy)]
pub(super) struct ClaimView<'a> {
    seen: Seen<'a>,
    notes: &'a Notes,
}

impl<'a> ClaimView<'a> {
    /// Returns its name in words.
    pub(super) fn name(self) -> String {
        self.seen.source.to_string()
    }

    pub(super) fn case(self) -> &'a Case {
        self.seen.case
    }

    /// Friction energy per cycle at the side frame, as the summary has it, J; NaN without.
    pub(super) fn energy_per_cycle(self) -> f64 {
        let (energy, units) = match self.seen.table {
            TableOf::Alone(result) => {
                let summary = &result.summary;
                (summary.averages.energy_per_cycle.get("side_frame"), summary.units)
            }
            TableOf::Truck(result) => {
                let wedge = result.summary.wedges.get(COMPONENT);
                (
                    wedge.and_then(|wedge| wedge.energy_per_cycle.as_ref()),
                    result.summary.units,
                )
            }
        };
        energy.map_or(f64::NAN, |energy| energy.value / Kind::Energy.from_si(units))
    }

    /// Relative residual of the energy ledger.
    pub(super) fn ledger_residual(self) -> f64 {
        match self.seen.table {
            TableOf::Alone(result) => result.summary.ledger.largest_relative_residual,
            TableOf::Truck(result) => result.summary.largest_relative_residual,
        }
    }

    /// Returns whether the run's table has a column.
    pub(super) fn has(self, name: &str) -> bool {
        self.seen.table.column(name).is_some()
    }

    pub(super) fn cycle(self) -> Cycle {
        self.seen.cycle
    }

    /// Returns a column, SI; without it the claim cannot be decided.
    pub(super) fn column(self, name: &str) -> &'a [f64] {
        self.seen.table.column(name).unwrap_or_else(|| {
            self.missing(format!("there is no column {name}"));
            &[]
        })
    }

    /// Notes a value; one that is not a number makes the claim undecidable.
    pub(super) fn note(self, label: String, value: f64, kind: Kind) -> f64 {
        if value.is_nan() {
            self.missing(format!("there is no {label}"));
        }
        let value_found = NotedValue { label, value, kind };
        let mut values = self.notes.values.borrow_mut();
        if !values.contains(&value_found) {
            values.push(value_found);
        }
        value
    }

    fn missing(self, what: String) {
        let mut gaps = self.notes.gaps.borrow_mut();
        if !gaps.contains(&what) {
            gaps.push(what);
        }
    }
}

/// The verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum ClaimVerdict {
    /// The runs show what is claimed.
    #[serde(rename = "holds")]
    Holds,
    /// They show something else: a finding.
    #[serde(rename = "does not hold")]
    DoesNot,
    /// They say nothing of it.
    #[serde(rename = "cannot be decided")]
    CannotBeDecided,
}

impl ClaimVerdict {
    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::DoesNot => "does not hold",
            Self::CannotBeDecided => "cannot be decided",
        }
    }
}

/// The outcome of a predicate.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimFinding {
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// The values that it rests on.
    pub values: Vec<NotedValue>,
    /// The reason if it cannot be decided, else empty.
    pub undecided: String,
}

impl ClaimFinding {
    /// Returns the finding of a claim that the runs cannot decide.
    #[must_use]
    pub fn undecided(why: impl Into<String>) -> Self {
        Self {
            verdict: ClaimVerdict::CannotBeDecided,
            values: Vec::new(),
            undecided: why.into(),
        }
    }
}

/// Evaluates a predicate on the runs that it names.
pub(super) fn decide<const N: usize>(
    evidence: &Evidence<'_>,
    runs: [EvidenceSource; N],
    holds: impl Fn([ClaimView<'_>; N]) -> bool,
) -> ClaimFinding {
    let found = runs.map(|id| evidence.find(id));
    let missing: Vec<&str> = found
        .iter()
        .filter_map(|found| found.as_ref().err().map(String::as_str))
        .collect();
    if !missing.is_empty() {
        return ClaimFinding::undecided(missing.join("; "));
    }
    let notes = Notes::default();
    let views: Vec<ClaimView<'_>> = found
        .into_iter()
        .flatten()
        .map(|seen| ClaimView { seen, notes: &notes })
        .collect();
    let Ok(views) = <[ClaimView<'_>; N]>::try_from(views) else {
        return ClaimFinding::undecided("runs are missing");
    };
    let holds = holds(views);
    let gaps = notes.gaps.take();
    ClaimFinding {
        verdict: match (gaps.is_empty(), holds) {
            (false, _) => ClaimVerdict::CannotBeDecided,
            (true, true) => ClaimVerdict::Holds,
            (true, false) => ClaimVerdict::DoesNot,
        },
        values: notes.values.take(),
        undecided: gaps.join("; "),
    }
}

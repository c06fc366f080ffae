//! An assessment: a car in regimes, at speeds and in conditions, and what is left to the limits of rules.
//!
//! It is a [study](crate::design) whose list of variants has a row each regime, condition and speed; a
//! study's folder, table and cluster serve it as they are. What is more here is the assessment of a record
//! ([`Assessment::assess`]).

pub mod conditions;
pub mod dependence;
pub mod refined;
mod study_text;
mod verdict;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use mechanics::energy_balance::Verdict;
use quantity::{Kind, Quantity};

use self::conditions::Condition;
use self::study_text::{is_shaken, text};
pub use self::verdict::{LimitVerdict, WorstSpeed, verdicts, worst_run};
use crate::car;
use crate::car::limits::{Limit, LimitSet, Mark};
use crate::car::regime::Regime;
use crate::car::statistics::Rules;
use crate::case::problem::Problem;
use crate::case::{self, CaseError};
use crate::design::{Study, StudySource, Value};
use crate::models::{AnyCase, CaseSource, built_in, no_built_in};
use crate::records::{Record, Status};

/// The name of the study's text, which is made here.
const STUDY: &str = "assessment.toml";

/// The request.
#[derive(Clone, Debug)]
pub struct Request {
    /// The car: a case file, or the name of a built-in case.
    pub car: PathBuf,
    /// Values laid over the car, as `--set` takes them.
    pub set: Vec<String>,
    /// Names or files of regimes; none: all that are built in.
    pub regimes: Vec<String>,
    /// Speeds for all regimes; none: those of each regime.
    pub speeds: Vec<Quantity>,
    /// Names or files of conditions; none: as the case says.
    pub conditions: Vec<String>,
    /// Name or file of the limits.
    pub limits: String,
    /// Whether more speeds are looked at about the worst one of each regime ([`refined`]).
    pub refine: bool,
    /// Frictions of wheel on rail at which runs near limits are looked at again ([`dependence`]).
    pub frictions: Vec<f64>,
}

/// Frictions of wheel on rail that are looked at if none are asked for: of damp and of dry rails.
pub const FRICTIONS: [f64; 2] = [0.3, 0.5];

/// A car in regimes, at speeds and in conditions.
#[derive(Clone, Debug)]
pub struct Assessment {
    /// The request.
    pub request: Request,
    /// The car as it is given.
    base: AnyCase,
    /// The car's name.
    pub car: String,
    /// The runs.
    pub study: Study,
    /// The regimes.
    pub regimes: Vec<Regime>,
    /// The conditions.
    pub conditions: Vec<Condition>,
    /// The limits.
    pub limits: Arc<LimitSet>,
    /// Windows and filters of the statistics: those of the limits, else those of the case.
    rules: Rules,
}

/// The verdict on one limit in a run.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptLimit {
    /// Its number in the set.
    pub limit: usize,
    /// The measured value, in its unit; `None` if the run has none.
    pub value: Option<f64>,
    /// The limit for this run, in its unit; `None` if its formula lacks something.
    pub allowed: Option<f64>,
    /// The margin, in parts of the limit; negative where it is not kept.
    pub margin: Option<f64>,
}

/// A run beside the limits that are set for its regime.
#[derive(Clone, Debug, PartialEq)]
pub struct Assessed {
    /// The run's number.
    pub run: u64,
    /// The number of its regime.
    pub regime: usize,
    /// The number of its condition.
    pub condition: usize,
    /// Its speed as typed.
    pub speed: String,
    /// The same, m/s.
    pub speed_si: f64,
    /// The way in which it ended.
    pub status: &'static str,
    /// The remark: why it has no numbers, or where the car derailed; may be empty.
    pub note: String,
    /// True if a wheel left its rail: no limit is kept then, and values are of the part until then.
    pub derailed: bool,
    /// The limits.
    pub checks: Vec<KeptLimit>,
    /// Measures, SI, in the study's order; none if it has none.
    pub measures: Vec<f64>,
    /// True if no one asked for its speed: it lies beside the worst one.
    pub refined: bool,
}

impl Assessed {
    /// Returns whether a limit is kept.
    #[must_use]
    pub fn keeps(&self, check: &KeptLimit) -> Option<bool> {
        match self.derailed {
            true => Some(false),
            false => check.margin.map(|margin| margin >= 0.0),
        }
    }

    /// Returns the least margin, in parts of its limit; minus infinity if a wheel left its rail. `None` if
    /// nothing was measured, or no limit is set.
    #[must_use]
    pub fn least(&self) -> Option<f64> {
        if self.derailed {
            return Some(f64::NEG_INFINITY);
        }
        let margins = self.checks.iter().filter_map(|check| check.margin);
        margins.min_by(f64::total_cmp)
    }
}

impl Assessment {
    /// Makes an assessment's study.
    ///
    /// # Errors
    /// The car, a regime, a condition or the limits cannot be read, or do not go together.
    pub fn new(request: &Request) -> Result<Self, CaseError> {
        let limits = LimitSet::named_or_read(&request.limits)?;
        let regimes = match request.regimes.as_slice() {
            [] => Regime::all().to_vec(),
            names => {
                let named = names.iter().map(|name| Regime::named_or_read(name));
                named.collect::<Result<Vec<_>, _>>()?
            }
        };
        if let Some(twice) = repeated(&regimes) {
            let problem = Problem::new(format!("the regime {twice} is named twice"));
            return Err(problem.help("name each regime once").into());
        }
        let car = car_of(&request.car, &request.set)?;
        let conditions = match request.conditions.as_slice() {
            [] => Condition::all().iter().take(1).cloned().collect(),
            names => Condition::chosen(names, car.1.car().is_some())?,
        };
        Self::with(request.clone(), car, Arc::new(limits), (regimes, conditions))
    }

    /// Makes it of a car, limits, regimes and conditions that are read.
    pub(crate) fn with(
        request: Request,
        (source, base): (CaseSource, AnyCase),
        limits: Arc<LimitSet>,
        (regimes, conditions): (Vec<Regime>, Vec<Condition>),
    ) -> Result<Self, CaseError> {
        let shaken = is_shaken(&request, (&source, &base), &regimes, &conditions)?;
        let set = (limits.output.as_slice(), shaken);
        let text = text(&regimes, &conditions, &request, &base, set)?;
        let study = Study::of_source(StudySource {
            name: STUDY.to_owned(),
            text,
            folder: PathBuf::new(),
            case: source,
        });
        let study = study.map_err(|error| CaseError::new(error.into_problems().map(of_parts)))?;
        let rules = rules(&study.case(0)?).unwrap_or_default();
        Ok(Self {
            car: base.name().to_owned(),
            base,
            request,
            study,
            regimes,
            conditions,
            limits,
            rules,
        })
    }

    /// Returns what a limit is set for, with its windows named: wheel L/V lasting 50 ms.
    #[must_use]
    pub fn quantity(&self, limit: &Limit) -> String {
        self.rules.in_words(&limit.quantity)
    }

    /// Returns why this is no certificate, each reason in words; none if it is one: all that the rule asks
    /// for was looked at, with values read in it, and is kept.
    #[must_use]
    pub fn falls_short(&self, verdicts: &[LimitVerdict]) -> Vec<String> {
        let limits = &self.limits;
        let mut reasons = Vec::new();
        match limits.not_covered.as_deref() {
            None => reasons.push("the file of limits does not say what the rule asks for beyond them".into()),
            Some([]) => {}
            Some(all) => reasons.push(format!("{} of the rule not covered", counted(all.len(), "part"))),
        }
        for mark in [Mark::Remembered, Mark::Guess] {
            let count = limits.limits.iter().filter(|own| own.mark == Some(mark)).count();
            if count > 0 {
                let what = match mark {
                    Mark::Guess => "a guess",
                    _ => "from memory",
                };
                reasons.push(format!("{} {what}", counted(count, "limit")));
            }
        }
        let named = limits.limits.iter().flat_map(|own| own.regimes.iter().flatten());
        let mut missing: Vec<&str> = named
            .map(String::as_str)
            .filter(|name| !self.regimes.iter().any(|own| own.name == *name))
            .collect();
        missing.sort_unstable();
        missing.dedup();
        if !missing.is_empty() {
            reasons.push(format!("no runs of {}", missing.join(", ").replace('_', " ")));
        }
        if !self.request.speeds.is_empty() || !self.request.refine {
            reasons.push("speeds are not those of the regimes with more about the worst ones".into());
        }
        let count = |word: &str| verdicts.iter().filter(|own| own.word() == word).count();
        for word in ["exceeded", "unknown"] {
            if count(word) > 0 {
                reasons.push(format!("{} {word}", counted(count(word), "limit")));
            }
        }
        reasons
    }

    /// Returns the regimes that no limit is set for, by name.
    #[must_use]
    pub fn without_limits(&self) -> Vec<&str> {
        let limited = |regime: &&Regime| !self.limits.limits.iter().any(|limit| limit.is_for(&regime.name));
        let without = self.regimes.iter().filter(limited);
        without.map(|regime| regime.name.as_str()).collect()
    }

    /// Returns the verdicts of a run on the limits.
    #[must_use]
    pub fn assess(&self, values: &[Option<Value>], record: &Record) -> Assessed {
        let value = |name: &str| {
            let place = self.study.factors.iter().position(|factor| factor.name() == name);
            place.and_then(|place| values.get(place)?.as_ref())
        };
        let name = |path: &str| {
            value(path)
                .map(|own| own.shown().into_owned())
                .unwrap_or_default()
        };
        let [regime, condition] = ["regime", "condition"].map(name);
        let speed = value("speed.value");
        let measures = self.study.measures();
        let measured = |name: &str| measures.get(&record.measures, name);
        let derailed = measured("derailed").is_some_and(|own| own > 0.5);
        let mut note = match (derailed, measured("end_distance")) {
            (true, Some(at)) => {
                let feet = at * Kind::Distance.from_si(quantity::System::Us);
                let also = if record.reason.is_empty() { "" } else { "; " };
                format!(
                    "derailed {feet:.0} ft along the track: the run ends there, and values and margins are \
                     of the part until then{also}{}",
                    record.reason
                )
            }
            _ => record.reason.clone(),
        };
        let number = self
            .regimes
            .iter()
            .position(|own| own.name == regime)
            .unwrap_or(0);
        // What is taken in curves does not count on straight track.
        let curved = self.regimes.get(number).is_none_or(|own| own.curved);
        let place = |limit: &Limit| limit.is_for(&regime) && (curved || !limit.measure.is_of_curves());
        let limits = self.limits.limits.iter().enumerate();
        let closes = measured("ledger_residual").is_none_or(|own| Verdict::of(own) != Verdict::Failed);
        let usable = record.status == Status::Complete || record.status == Status::Derailed && closes;
        let checks = limits.filter(|(_, limit)| place(limit)).map(|(number, limit)| {
            let found = measured(limit.measure.name).filter(|_| usable);
            let value = found.map(|own| limit.in_unit(own));
            let allowed = limit.number(&measured);
            KeptLimit {
                limit: number,
                value,
                allowed,
                margin: value
                    .zip(allowed)
                    .map(|(value, allowed)| limit.margin(value, allowed)),
            }
        });
        let checks: Vec<KeptLimit> = checks.collect();
        let names = |lacks: &dyn Fn(&KeptLimit) -> bool| {
            let own = checks.iter().filter(|own| usable && lacks(own));
            let names: Vec<&str> = own.map(|own| &*self.limits.limits[own.limit].name).collect();
            names.join(", ")
        };
        for (names, why) in [
            (
                names(&|own| own.value.is_none()),
                "no value: rows are too far apart for the filter (simulation.output_interval), or the run is \
                 too short or has no such place",
            ),
            (
                names(&|own| own.allowed.is_none()),
                "no limit: the car lacks what its formula needs (static loads, a flange)",
            ),
        ] {
            if !names.is_empty() {
                let also = if note.is_empty() { "" } else { "; " };
                note += &format!("{also}{names}: {why}");
            }
        }
        Assessed {
            run: record.number,
            regime: number,
            condition: self
                .conditions
                .iter()
                .position(|own| own.name == condition)
                .unwrap_or(0),
            speed: speed.map(|own| own.shown().into_owned()).unwrap_or_default(),
            speed_si: speed.and_then(|own| own.in_unit("m/s")).unwrap_or(f64::NAN),
            status: if derailed { Status::Derailed } else { record.status }.name(),
            note,
            derailed,
            checks,
            measures: record.measures.0.clone(),
            refined: false,
        }
    }
}

/// Returns a number of things: `1 limit`, `2 limits`.
#[must_use]
pub fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        count => format!("{count} {what}s"),
    }
}

/// Returns the first regime that is there twice.
pub(crate) fn repeated(regimes: &[Regime]) -> Option<&str> {
    let names = regimes.iter().map(|own| own.name.as_str()).enumerate();
    let mut twice = names.filter(|(place, name)| regimes[..*place].iter().any(|own| own.name == *name));
    twice.next().map(|(_, name)| name)
}

/// Returns the rules of the statistics of what runs on a track; `None` of other models.
fn rules(case: &AnyCase) -> Option<Rules> {
    match case {
        AnyCase::Car(own) => Some(own.rules),
        AnyCase::Vehicle(own) => own.description.on_track.as_ref().map(|_| own.rules),
        _ => None,
    }
}

/// Reads the car, or the vehicle.
pub(crate) fn car_of(path: &Path, set: &[String]) -> Result<(CaseSource, AnyCase), CaseError> {
    let name = path.to_str().unwrap_or_default();
    let source = match built_in(name) {
        Some(own) if !path.is_file() => CaseSource::File {
            name: format!("{name}.toml"),
            text: own.text().to_owned(),
            folder: PathBuf::new(),
        },
        None if !path.exists() && path.extension().is_none() => {
            return Err(match car::builtin::text(name) {
                Err(error) => no_built_in(name, error),
                Ok(_) => no_car(path),
            });
        }
        _ => CaseSource::File {
            name: path.display().to_string(),
            text: case::text_of(path)?,
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
        },
    };
    let case = source.case(set)?;
    match rules(&case) {
        Some(_) => Ok((source, case)),
        None => Err(no_car(path)),
    }
}

fn no_car(path: &Path) -> CaseError {
    let problem = Problem::new(format!("{} is no case of a car on a track", path.display()));
    problem
        .help(
            "regimes are for cars and for vehicles with wheelsets: write model = \"car\", or take a built-in \
             one such as car_tangent_loaded",
        )
        .into()
}

/// Returns a mistake in the study's text, which nobody wrote, as one of what that was made of.
fn of_parts(problem: Problem) -> Problem {
    if problem.source_name() != Some(STUDY) {
        return problem;
    }
    let message = format!("regimes, conditions and --set do not fit: {}", problem.message());
    Problem::new(message).help(
        "a key is set by one of them: take it out of the others, or name other regimes or conditions; of \
         speed, duration and settling each regime takes care",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_what_does_not_fit_is_not_shown_in_a_text_that_nobody_wrote() {
        let request = |set: &str, condition: &str| Request {
            car: PathBuf::from("car_tangent_loaded"),
            set: vec![set.to_owned()],
            regimes: vec!["spiral".to_owned()],
            speeds: Vec::new(),
            conditions: vec![condition.to_owned()],
            limits: "aar_chapter_xi".to_owned(),
            refine: true,
            frictions: Vec::new(),
        };
        for (set, condition) in [
            ("simulation.duration=3 s", "as_given"),
            ("start.settle=1 s", "as_given"),
        ] {
            let error = Assessment::new(&request(set, condition)).unwrap_err();
            for problem in error.problems() {
                assert_eq!(problem.source_name(), None, "{problem}");
                assert!(problem.message().contains("--set"), "{problem}");
                assert!(problem.advice().is_some(), "{problem}");
            }
        }
    }
}

//! What wedge rise costs: a car in regimes over wedge rise and speed, and the rise at which each limit is
//! reached.
//!
//! A [`Survey`] asks a car one [`Question`] for each limit of each regime. Its runs are chosen one batch
//! after the other from what is known ([`plan`]): the ends of the rises at all speeds, rises between at
//! the worst speeds, then halves of the gap in which a limit is reached down to a sixteenth of an inch,
//! then other speeds, then other conditions, each alone, and the worst two of them together. The same
//! runs come from the same car, so that a survey that was killed goes on where it was. What they say of
//! limits is in [`answer`], what rigs say of the truck in [`rigs`].
//!
//! Limits of the method: all wedges rise alike unless a condition says otherwise; a resonance between two
//! speeds may stay unseen; a condition is looked at where the car itself reaches the limit, so that one
//! that moves the worst speed seems better than it is; tracks and limits are those of the regimes' files,
//! with their marks.

pub mod answer;
pub mod bracket;
pub mod level;
pub mod plan;
pub mod rigs;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use quantity::{Kind, Quantity};
use serde::{Deserialize, Serialize};

use self::bracket::{Rise, SIXTEENTH};
pub use self::level::Level;
use crate::assessment::conditions::Condition;
use crate::assessment::{Assessment, Request, car_of};
use crate::car::CarCase;
use crate::car::limits::{Limit, LimitSet};
use crate::car::regime::Regime;
use crate::case::CaseError;
use crate::case::problem::Problem;
use crate::design::Study;
use crate::models::{AnyCase, CaseSource};
use crate::records::{self, Record};

/// Regimes that are run if none are asked for: rocking, bouncing, curves, hunting.
pub const REGIMES: [&str; 5] = [
    "twist_and_roll",
    "pitch_and_bounce",
    "dynamic_curving",
    "constant_curve",
    "hunting",
];
/// Most runs, if no other number is asked for.
pub const RUNS: usize = 200;
/// The key of the rise of all wedges.
const RISE: &str = "truck.wedge.rise";
/// The highest rise that is looked at if none is asked for: 1.25 in, or what the pockets hold.
const TOP: Rise = 20;
/// The step of the grid of rises: a quarter of an inch.
pub const STEP: Rise = 4;
const MILE_PER_HOUR: f64 = 0.447_04;

/// The request.
#[derive(Clone, Debug)]
pub struct RiseRequest {
    /// The car: a case file, or the name of a built-in case.
    pub car: PathBuf,
    /// Values laid over the car, as `--set` takes them.
    pub set: Vec<String>,
    /// Names or files of regimes; none: [`REGIMES`].
    pub regimes: Vec<String>,
    /// Name or file of the limits.
    pub limits: String,
    /// The highest rise to look at.
    pub to: Option<Quantity>,
    /// What else is varied: names of levels, names or files of conditions; none asked for: [`level::all`].
    pub factors: Option<Vec<String>>,
    /// Most runs.
    pub most: usize,
    /// Whether the car itself is run at all rises and all speeds.
    pub full: bool,
}

/// A survey of a car over wedge rise.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The request.
    pub request: RiseRequest,
    /// The car's name.
    pub name: String,
    /// The car's case as it is given.
    pub car: Arc<CarCase>,
    source: CaseSource,
    /// The regimes.
    pub regimes: Vec<Regime>,
    /// The limits.
    pub limits: Arc<LimitSet>,
    /// What else is varied.
    pub levels: Vec<Level>,
    /// The highest rise that is looked at.
    pub top: Rise,
}

/// What a run is made of; a run with another value is another run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wanted {
    /// Numbers of the levels, rising; none: the car itself.
    pub state: Vec<usize>,
    /// The number of the regime.
    pub regime: usize,
    /// The speed, hundredths of a mile an hour.
    pub speed: u32,
    /// The rise.
    pub rise: Rise,
}

/// One limit in one regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Question {
    /// The number of the regime.
    pub regime: usize,
    /// The number of the limit.
    pub limit: usize,
}

/// What a run says of a limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfLimit {
    /// Its name.
    pub limit: String,
    /// Its unit.
    pub unit: String,
    /// The measured value, in its unit; none if there is none.
    pub value: Option<f64>,
    /// The limit for this run, in its unit; none if its formula lacks something.
    pub limit_value: Option<f64>,
    /// The margin, in parts of the limit; negative where it is not kept.
    pub margin: Option<f64>,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfRun {
    /// The way in which it ended.
    pub status: String,
    /// Why it has no numbers, or where the car derailed; may be empty.
    pub note: String,
    /// True if a wheel left its rail: no limit is kept then.
    pub derailed: bool,
    /// The limits of its regime.
    pub limits: Vec<OfLimit>,
}

/// The runs that are known.
pub type Known = BTreeMap<Wanted, OfRun>;

/// A run that can begin.
#[derive(Clone, Debug)]
pub struct Prepared {
    assessment: Assessment,
    case: AnyCase,
}

impl Survey {
    /// Makes a survey.
    ///
    /// # Errors
    /// The car, a regime, a condition or the limits cannot be read, or do not go together; the car is none
    /// with wedges that rise; the highest rise is more than a pocket holds.
    pub fn new(request: RiseRequest) -> Result<Self, CaseError> {
        let limits = Arc::new(LimitSet::named_or_read(&request.limits)?);
        let names: Vec<String> = match request.regimes.as_slice() {
            [] => REGIMES.map(str::to_owned).into(),
            names => names.to_vec(),
        };
        let regimes = names.iter().map(|name| Regime::named_or_read(name));
        let regimes: Vec<Regime> = regimes.collect::<Result<_, _>>()?;
        if let Some(twice) = crate::assessment::repeated(&regimes) {
            let problem = Problem::new(format!("the regime {twice} is named twice"));
            return Err(problem.help("name each regime once").into());
        }
        let (source, base) = car_of(&request.car, &request.set)?;
        let AnyCase::Car(car) = base else {
            let message = format!("{} is no case of the model \"car\"", request.car.display());
            let problem = Problem::new(message);
            return Err(problem
                .help("a survey of wedge rise is for cars on three-piece trucks")
                .into());
        };
        if let Some(own) = request.set.iter().find(|own| sets_rise(own)) {
            let problem = Problem::new(format!("--set {own}: the rise is what a survey varies"));
            return Err(problem.help("leave it out; --to says up to which rise").into());
        }
        let levels = match &request.factors {
            None => level::all(),
            Some(names) => level::chosen(names)?,
        };
        let top = top_of(&car, request.to.as_ref())?;
        let survey = Self {
            name: car.name.clone(),
            car,
            source,
            regimes,
            limits,
            levels,
            top,
            request,
        };
        if survey.questions().is_empty() {
            let message = format!("{} sets no limit for any of the regimes", survey.limits.title);
            let problem = Problem::new(message);
            return Err(problem
                .help("name other regimes, or limits that are for these")
                .into());
        }
        // What does not go together with a rise is said now, not after an hour.
        let first = survey.wanted(&[], 0, survey.speeds(0)[0], 0);
        survey.prepare(&first)?;
        Ok(survey)
    }

    /// Returns the questions, by regime and limit.
    #[must_use]
    pub fn questions(&self) -> Vec<Question> {
        let of = |(number, regime): (usize, &Regime)| {
            let limits = self.limits.limits.iter().enumerate();
            let (name, curved) = (regime.name.clone(), regime.curved);
            limits
                .filter(move |(_, own)| own.is_for(&name) && (curved || !own.measure.is_of_curves()))
                .map(move |(limit, _)| Question {
                    regime: number,
                    limit,
                })
                .collect::<Vec<_>>()
        };
        self.regimes.iter().enumerate().flat_map(of).collect()
    }

    /// Returns the limit of a question.
    #[must_use]
    pub fn limit(&self, question: Question) -> &Limit {
        &self.limits.limits[question.limit]
    }

    /// Returns the speeds of a regime, hundredths of a mile an hour.
    #[must_use]
    pub fn speeds(&self, regime: usize) -> Vec<u32> {
        let all = self.regimes[regime].speeds.iter();
        all.map(|own| (own.to_si() / MILE_PER_HOUR * 100.0).round() as u32)
            .collect()
    }

    /// Returns the grid of rises.
    #[must_use]
    pub fn rises(&self) -> Vec<Rise> {
        let mut all: Vec<Rise> = (0..=self.top).step_by(STEP as usize).collect();
        if all.last() != Some(&self.top) {
            all.push(self.top);
        }
        all
    }

    /// Returns the runs of the whole grid: all rises at all speeds.
    #[must_use]
    pub fn grid_count(&self) -> usize {
        let speeds: usize = self.regimes.iter().map(|own| own.speeds.len()).sum();
        speeds * self.rises().len()
    }

    /// Returns the mean duration of a run of the grid, s.
    #[must_use]
    pub fn run_time(&self) -> f64 {
        let all = self.regimes.iter().flat_map(|regime| {
            regime
                .speeds
                .iter()
                .map(|speed| regime.distance.to_si() / speed.to_si())
        });
        let (count, sum) = all.fold((0.0, 0.0), |(count, sum), own| (count + 1.0, sum + own));
        sum / f64::max(count, 1.0)
    }

    fn wanted(&self, state: &[usize], regime: usize, speed: u32, rise: Rise) -> Wanted {
        Wanted {
            state: state.to_vec(),
            regime,
            speed,
            rise,
        }
    }

    /// Returns the name of a run, which can be that of a file.
    #[must_use]
    pub fn name_of(&self, wanted: &Wanted) -> String {
        format!(
            "{}_{}_{}_rise_{}_16",
            self.state_name(&wanted.state),
            self.regimes[wanted.regime].name,
            mph(wanted.speed),
            wanted.rise
        )
    }

    /// Returns the name of a state: `as_given`, or those of its levels.
    #[must_use]
    pub fn state_name(&self, state: &[usize]) -> String {
        match state {
            [] => "as_given".to_owned(),
            several => {
                let names: Vec<&str> = several.iter().map(|own| self.levels[*own].name()).collect();
                names.join("+")
            }
        }
    }

    /// Makes the case of a run.
    ///
    /// # Errors
    /// The conditions, the regime and the car do not go together.
    pub fn prepare(&self, wanted: &Wanted) -> Result<Prepared, CaseError> {
        let rise = f64::from(wanted.rise) / 16.0;
        let mut set = self.request.set.clone();
        set.push(format!("{RISE}=\"{rise} in\""));
        let levels: Vec<&Level> = wanted.state.iter().map(|own| &self.levels[*own]).collect();
        let condition = Condition {
            name: self.state_name(&wanted.state),
            title: String::new(),
            set: levels.iter().flat_map(|own| own.condition.set.clone()).collect(),
        };
        let mut regime = self.regimes[wanted.regime].clone();
        for class in levels.iter().filter_map(|own| own.track_class) {
            regime.track = level::roughened(&regime.track, class)?;
        }
        let speed = format!("{} mph", mph(wanted.speed));
        let request = Request {
            car: self.request.car.clone(),
            set,
            regimes: Vec::new(),
            speeds: Quantity::parse_as(&speed, Kind::TravelSpeed)
                .into_iter()
                .collect(),
            conditions: Vec::new(),
            limits: self.request.limits.clone(),
            refine: false,
            frictions: Vec::new(),
        };
        let car = (self.source.clone(), AnyCase::Car(self.car.clone()));
        let parts = (vec![regime], vec![condition]);
        let assessment = Assessment::with(request, car, self.limits.clone(), parts)?;
        let case = assessment.study.case(0)?;
        Ok(Prepared { assessment, case })
    }

    /// Returns what came of a run that cannot begin.
    #[must_use]
    pub fn refused(&self, error: CaseError) -> OfRun {
        let reasons: Vec<&str> = error.problems().iter().map(Problem::message).collect();
        OfRun {
            status: records::Status::Refused.name().to_owned(),
            note: reasons.join("; "),
            derailed: false,
            limits: Vec::new(),
        }
    }
}

impl Prepared {
    /// Returns the case.
    #[must_use]
    pub fn case(&self) -> &AnyCase {
        &self.case
    }

    /// Returns the study whose only run it is.
    #[must_use]
    pub fn study(&self) -> &Study {
        &self.assessment.study
    }

    /// Runs it.
    #[must_use]
    pub fn run(&self) -> OfRun {
        self.of(&records::run_case(self.study(), 0, &self.case))
    }

    /// Returns what came of it, from its record.
    #[must_use]
    pub fn of(&self, record: &Record) -> OfRun {
        let own = self.assessment.assess(&self.study().values(0), record);
        let limits = own.checks.iter().map(|check| {
            let limit = &self.assessment.limits.limits[check.limit];
            OfLimit {
                limit: limit.name.clone(),
                unit: limit.unit.clone(),
                value: check.value,
                limit_value: check.allowed,
                margin: check.margin,
            }
        });
        OfRun {
            limits: limits.collect(),
            status: own.status.to_owned(),
            note: own.note,
            derailed: own.derailed,
        }
    }
}

/// Returns a speed in hundredths of a mile an hour as people write it.
#[must_use]
pub fn mph(speed: u32) -> f64 {
    f64::from(speed) / 100.0
}

/// Returns a rise as a gauge has it: `1 3/16 in`.
#[must_use]
pub fn inches(rise: Rise) -> String {
    let (whole, mut part, mut of) = (rise / 16, rise % 16, 16);
    while part > 0 && part % 2 == 0 {
        (part, of) = (part / 2, of / 2);
    }
    match (whole, part) {
        (whole, 0) => format!("{whole} in"),
        (0, part) => format!("{part}/{of} in"),
        (whole, part) => format!("{whole} {part}/{of} in"),
    }
}

/// Returns whether a setting says the rise or the depths of wear of wedges.
fn sets_rise(set: &str) -> bool {
    let key = set.split('=').next().unwrap_or_default().trim();
    let wears = ["rise", "column_wear", "slope_wear"];
    let mut parts = key.rsplit('.');
    parts.next().is_some_and(|last| wears.contains(&last)) && parts.any(|own| own == "wedge")
}

/// Returns the highest rise to look at.
fn top_of(car: &CarCase, asked: Option<&Quantity>) -> Result<Rise, CaseError> {
    let wedges = car.parameters.trucks.iter().flat_map(|truck| &truck.wedges);
    let pocket = wedges.map(|own| own.rise_limit).fold(f64::INFINITY, f64::min);
    let held = (pocket / SIXTEENTH * (1.0 + 1e-9)).floor() as Rise;
    let refused = |message: String, help: &str| Err(Problem::new(message).help(help).into());
    let Some(asked) = asked else {
        return match TOP.min(held) {
            0 => refused(
                format!(
                    "the pockets hold a rise of {:.3} in: nothing is left to vary",
                    pocket / 0.0254
                ),
                "give the pocket's own value as truck.wedge.rise_limit",
            ),
            top => Ok(top),
        };
    };
    let sixteenths = asked.to_si() / SIXTEENTH;
    if asked.to_si() > pocket * (1.0 + 1e-9) {
        return refused(
            format!(
                "a rise of {asked} is more than the pockets hold, {:.3} in",
                pocket / 0.0254
            ),
            "lower --to, or give the rise that the pocket holds as truck.wedge.rise_limit",
        );
    }
    match (sixteenths - sixteenths.round()).abs() < 1e-6 && sixteenths.round() >= 1.0 {
        true => Ok(sixteenths.round() as Rise),
        false => refused(
            format!("a rise of {asked} is no whole number of sixteenths of an inch"),
            "a gauge shows no more: write for example --to \"1.25 in\"; 1/16 in are 1.5875 mm",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rises_are_written_as_on_a_gauge() {
        let all = [0, 1, 4, 6, 16, 17, 20].map(inches);
        assert_eq!(
            all,
            [
                "0 in",
                "1/16 in",
                "1/4 in",
                "3/8 in",
                "1 in",
                "1 1/16 in",
                "1 1/4 in"
            ]
        );
    }

    #[test]
    fn input_settings_of_the_rise_are_known() {
        assert!(sets_rise("truck.wedge.rise=0.5 in"));
        assert!(sets_rise("front_truck.wedge.leading_left.column_wear=0.1 in"));
        assert!(!sets_rise("truck.wedge.rise_limit=2 in"));
        assert!(!sets_rise("truck.friction.column=0.3"));
    }
}

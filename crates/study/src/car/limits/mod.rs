//! Limits that rules set, as data, and what is left to them.
//!
//! ```toml
//! title = "our rules"
//! edition = "2026"                          # may be left out
//! source = "letter of 2026-03-01"
//! [output]                                  # windows and filters of the rule; left out: those of the case
//! wheel_filter = "25 Hz"
//! [[limits]]
//! name = "body_roll"                        # of its own in this file
//! quantity = "body roll, greatest less least"
//! measure = "body_roll_peak_to_peak"        # of docs/regimes.md
//! regimes = ["twist_and_roll"]              # or "all"
//! at_most = "6 deg"                         # or at_least; a pure number without quotes; or a formula
//! paragraph = "3.2"                         # these may be left out
//! mark = "source"                           # source, derived, remembered, guess
//! remark = ""
//! [[not_covered]]                           # what the rule asks for, and these limits do not have
//! what = "impact tests"
//! reason = "not simulated"
//! ```
//!
//! `not_covered = []` says that the limits are all that the rule asks for; without the key nobody says so.
//! Formulas: [`value`]. Of each value that is built in ([`LimitSet::built_in`]) the mark says whether it was
//! read in its source or is remembered: check the latter against your edition.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

use input::FileType;
use quantity::{SixDigits, System as Units};
use serde::{Deserialize, Serialize};

use self::value::{Known, LimitValue};
use super::figures::CarFigures;
use super::named::{self, BuiltInOrFile, built_in, find};
use super::statistics::{Rules, Statistic};
use super::worst::Worst;
use crate::case::CaseError;

pub(crate) mod read;
pub mod value;

/// What is there at rest, %.
const WHOLE: f64 = 100.0;
/// The built-in sets, by name; the first one is that of freight cars.
const BUILT_IN: [(&str, &str); 6] = built_in![
    "limits/",
    "aar_chapter_xi",
    "aar_chapter_xi_1993",
    "fra_213_333",
    "fra_213_57",
    "fra_238_appendix_c",
    "en_14363",
];

static ALL: LazyLock<Vec<LimitSet>> = LazyLock::new(|| {
    // That all of them can be read, a test holds.
    let sets = BUILT_IN.iter();
    sets.filter_map(|(name, text)| LimitSet::parse(&format!("{name}.toml"), text).ok())
        .collect()
});

/// On which side of a limit values must lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// At or below it.
    AtMost,
    /// At or above it.
    AtLeast,
}

impl Bound {
    /// Returns its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::AtMost => "at_most",
            Self::AtLeast => "at_least",
        }
    }
}

/// The origin of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Read in its source.
    Source,
    /// Derived from such values.
    Derived,
    /// From memory.
    Remembered,
    /// A guess.
    Guess,
}

impl Mark {
    /// Returns its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Source => "source",
            Self::Derived => "derived",
            Self::Remembered => "remembered",
            Self::Guess => "guess",
        }
    }
}

/// What a rule asks for, and its limits do not have.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotCovered {
    /// What it is.
    pub what: String,
    /// The paragraph; may be empty.
    pub paragraph: String,
    /// Why it is missing; may be empty.
    pub reason: String,
}

/// A limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Its name.
    pub name: String,
    /// The limited quantity in words.
    pub quantity: String,
    /// The paragraph of the rule; may be empty.
    pub paragraph: String,
    /// Where its value is from; `None`: from the source of the whole set.
    pub mark: Option<Mark>,
    /// The measured data.
    pub measure: &'static Worst,
    /// The regimes that it is set for; `None`: all.
    pub regimes: Option<Vec<String>>,
    /// Its side.
    pub bound: Bound,
    /// Its value.
    pub value: LimitValue,
    /// Its unit as typed.
    pub unit: String,
    /// Further remarks; may be empty.
    pub remark: String,
    /// Its unit in SI.
    si: f64,
}

/// Limits of one source.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitSet {
    /// The file's name without its ending.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// The edition or the date of the rule; may be empty.
    pub edition: String,
    /// Their source.
    pub source: String,
    /// Windows and filters of the rule, as `--set` takes them.
    pub output: Vec<String>,
    /// The limits.
    pub limits: Vec<Limit>,
    /// What the rule asks for beyond them; `None` if the file does not say.
    pub not_covered: Option<Vec<NotCovered>>,
    /// The file.
    pub text: String,
}

impl LimitCheck {
    /// Returns where its statistic is taken, in words.
    #[must_use]
    pub fn worst_at(&self) -> String {
        match self.place.as_str() {
            "" => self.statistic.replace('_', " "),
            place => place.to_owned(),
        }
    }
}

/// A limit beside the worst statistic of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitCheck {
    /// The limit's name; empty in older summaries.
    #[serde(default)]
    pub name: String,
    /// The limited quantity.
    pub quantity: String,
    /// Regimes that it is set for.
    pub regimes: String,
    /// The statistic that is worst.
    pub statistic: String,
    /// Where that is taken, in words; empty in older summaries.
    #[serde(default)]
    pub place: String,
    /// When that begins, s.
    #[serde(default)]
    pub time: Option<f64>,
    /// Its value: filtered, or raw where nothing is filtered.
    pub value: f64,
    /// The limit.
    pub limit: f64,
    /// Their unit.
    pub unit: String,
    /// By how much the limit is kept ([`Limit::margin`]): negative where it is not.
    pub margin: f64,
    /// True if the value is raw, although the limit is for filtered values: then the margin is none.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub unfiltered: bool,
}

impl Limit {
    /// Returns whether it is set for a regime.
    #[must_use]
    pub fn is_for(&self, regime: &str) -> bool {
        let regimes = self.regimes.as_ref();
        regimes.is_none_or(|own| own.iter().any(|name| name == regime))
    }

    /// Returns the regimes in words.
    #[must_use]
    pub fn regimes_in_words(&self) -> String {
        let words = match &self.regimes {
            None => "all".to_owned(),
            Some(names) => names.join(", ").replace('_', " "),
        };
        match self.remark.as_str() {
            "" => words,
            remark => format!("{words} ({remark})"),
        }
    }

    /// Returns a value of its measure (SI) in its unit.
    #[must_use]
    pub fn in_unit(&self, value: f64) -> f64 {
        value / self.si
    }

    /// Returns the limit for a car and its run, in its unit; `None` where a formula lacks something.
    #[must_use]
    pub fn number(&self, known: Known<'_>) -> Option<f64> {
        match &self.value {
            LimitValue::Number(value) => Some(*value),
            LimitValue::Formula(own) => own.value(known).map(|own| self.in_unit(own)),
        }
    }

    /// Returns its value in words, with its unit: a number or a formula.
    #[must_use]
    pub fn value_in_words(&self) -> String {
        match &self.value {
            LimitValue::Number(value) => self.with_unit(*value),
            LimitValue::Formula(own) => own.words((&self.unit, self.si)),
        }
    }

    /// Returns a number of its unit with that unit.
    #[must_use]
    pub fn with_unit(&self, value: f64) -> String {
        match self.unit.as_str() {
            "" => SixDigits(value).to_string(),
            unit => format!("{} {unit}", SixDigits(value)),
        }
    }

    /// Returns it beside the worst of the statistics of a run, whose numbers are in these units; `None`
    /// if the run has none of its kind.
    #[must_use]
    fn check(
        &self,
        statistics: &BTreeMap<String, Statistic>,
        known: Known<'_>,
        (rules, units): (&Rules, Units),
    ) -> Option<LimitCheck> {
        let worst = self.measure.of(statistics)?;
        let value = self.in_unit(worst.value.value / self.measure.kind.from_si(units));
        let limit = self.number(known)?;
        Some(LimitCheck {
            name: self.name.clone(),
            time: worst.time,
            quantity: rules.in_words(&self.quantity),
            regimes: self.regimes_in_words(),
            statistic: worst.statistic.to_owned(),
            place: worst.place.to_owned(),
            value,
            limit,
            unit: self.unit.clone(),
            margin: self.margin(value, limit),
            unfiltered: !worst.filtered && self.measure.is_filtered(),
        })
    }

    /// Returns the margin of a value to the limit, both in its unit: negative where it is not kept. Of a
    /// greatest value it is in parts of the limit; of a least share of what is there at rest it is in parts
    /// of the way from there to the limit, so that 1 is "nothing lost".
    #[must_use]
    pub fn margin(&self, value: f64, limit: f64) -> f64 {
        match self.bound {
            Bound::AtMost => (limit - value) / limit.abs(),
            Bound::AtLeast if self.unit == "%" && limit < WHOLE => (value - limit) / (WHOLE - limit),
            Bound::AtLeast => (value - limit) / limit.abs(),
        }
    }
}

impl LimitSet {
    /// Returns the built-in sets.
    #[must_use]
    pub fn built_in() -> &'static [Self] {
        &ALL
    }

    /// Returns the built-in set of this name, or reads a file.
    ///
    /// # Errors
    /// There is neither; or something in the file is wrong: all mistakes are reported together.
    pub fn named_or_read(text: &str) -> Result<Self, CaseError> {
        match find("there are no limits", text, Self::built_in(), |own| &own.name)? {
            BuiltInOrFile::BuiltIn(own) => Ok(own.clone()),
            BuiltInOrFile::File(path) => Self::read(path),
        }
    }

    /// Reads a file of limits.
    ///
    /// # Errors
    /// It cannot be read, or something in it is wrong; all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let help = "`wedgelab regime --show aar_chapter_xi` prints limits to begin with";
        let text = named::read(path, "file of limits", &[FileType::Limits], help)?;
        let source = path.display().to_string();
        let set = Self::parse(&source, &text)?;
        read::try_out(&set, &source)?;
        Ok(set)
    }

    /// As [`LimitSet::read`], from a text that `source` names in messages. Whether a car takes the windows is
    /// not tried.
    ///
    /// # Errors
    /// As [`LimitSet::read`].
    pub fn parse(source: &str, text: &str) -> Result<Self, CaseError> {
        read::parse(source, text)
    }

    /// Returns whether the limits are all that the rule asks for, each read in its source: only then what is
    /// made with them may be called a certificate.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let doubtful = |own: &Limit| matches!(own.mark, Some(Mark::Remembered | Mark::Guess));
        self.not_covered.as_ref().is_some_and(Vec::is_empty) && !self.limits.iter().any(doubtful)
    }

    /// Returns its title with its edition and its source.
    #[must_use]
    pub fn title_with_source(&self) -> String {
        format!("{}; {}", self.title_with_edition(), self.source)
    }

    /// Returns its title with its edition.
    #[must_use]
    pub fn title_with_edition(&self) -> String {
        match self.edition.as_str() {
            "" => self.title.clone(),
            edition => format!("{}, {edition}", self.title),
        }
    }
}

/// Returns what is known of a car and a run, whose statistics are in these units, SI.
fn known<'k>(
    figures: &'k CarFigures,
    statistics: &'k BTreeMap<String, Statistic>,
    units: Units,
) -> impl Fn(&str) -> Option<f64> + 'k {
    move |name| {
        let own = figures.named(name);
        own.or_else(|| {
            let measure = Worst::named(name)?;
            Some(measure.of(statistics)?.value.value / measure.kind.from_si(units))
        })
    }
}

/// Returns the limits of a set beside the worst of the statistics of a run of a vehicle with these figures,
/// whose numbers are in these units, taken by these rules.
#[must_use]
pub fn of(
    set: &LimitSet,
    (figures, statistics): (&CarFigures, &BTreeMap<String, Statistic>),
    (rules, units): (&Rules, Units),
) -> Vec<LimitCheck> {
    let known = known(figures, statistics, units);
    let limits = set.limits.iter();
    let checks = limits.filter_map(|limit| limit.check(statistics, &known, (rules, units)));
    checks.collect()
}

#[cfg(test)]
mod tests {
    use input::limits::LIMITS as MOST;

    use super::*;

    #[test]
    fn issue_048_more_limits_than_can_be_compared_are_refused() {
        let file = |count: usize| {
            let one = |k| {
                format!(
                    "[[limits]]\nname = \"l{k}\"\nquantity = \"roll\"\nmeasure = \"body_roll_peak_to_peak\"\n\
                     regimes = [\"r{k}\"]\nat_most = \"6 deg\"\n"
                )
            };
            let all: String = (0..count).map(one).collect();
            format!("title = \"many\"\nsource = \"ours\"\n{all}")
        };
        assert_eq!(
            LimitSet::parse("many.toml", &file(MOST)).unwrap().limits.len(),
            MOST
        );
        let error = LimitSet::parse("many.toml", &file(MOST + 1)).unwrap_err();
        let problem = &error.problems()[0];
        assert!(problem.message().contains("at most 1000"), "{problem}");
        assert!(problem.line_and_column().is_some() && problem.advice().is_some());
    }
}

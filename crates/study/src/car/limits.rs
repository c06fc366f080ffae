//! Limits that rules set, as data, and what is left to them.
//!
//! ```toml
//! title = "our rules"
//! source = "letter of 2026-03-01"
//! [[limits]]
//! name = "body_roll"                        # of its own in this file
//! quantity = "body roll, greatest less least"
//! measure = "body_roll_peak_to_peak"        # of docs/regimes.md
//! regimes = ["twist_and_roll"]              # or "all"
//! at_most = "6 deg"                         # or at_least; a pure number without quotes
//! remark = ""                               # may be left out
//! ```
//!
//! Those that are built in ([`LimitSet::built_in`]) are remembered: check them against your edition.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

use input::FileType;
use input::limits::LIMITS as MOST;
use quantity::{Kind, Quantity, System as Units, nearest};
use serde::{Deserialize, Serialize};

use super::named::{self, BuiltInOrFile, find};
use super::statistics::{Rules, Statistic};
use super::worst::{WORST, Worst};
use crate::case::CaseError;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::{CaseSection, Range};
use crate::case::tree::{self, NodeValue, TableNode};

const KEYS: [&str; 3] = ["title", "source", "limits"];
const LIMIT_KEYS: [&str; 7] = [
    "name", "quantity", "measure", "regimes", "at_most", "at_least", "remark",
];
/// What is there at rest, %.
const WHOLE: f64 = 100.0;
const HELP: &str = "write [[limits]] and below it name, quantity, measure, regimes and at_most or at_least";
/// The built-in sets, by name; the first one is that of freight cars.
const BUILT_IN: [(&str, &str); 2] = [
    (
        "aar_chapter_xi",
        include_str!("../../regimes/limits/aar_chapter_xi.toml"),
    ),
    (
        "fra_213_333",
        include_str!("../../regimes/limits/fra_213_333.toml"),
    ),
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

/// A limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Its name.
    pub name: String,
    /// The limited quantity in words.
    pub quantity: String,
    /// The measured data.
    pub measure: &'static Worst,
    /// The regimes that it is set for; `None`: all.
    pub regimes: Option<Vec<String>>,
    /// Its side.
    pub bound: Bound,
    /// Its value in its unit.
    pub value: f64,
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
    /// Their source.
    pub source: String,
    /// The limits.
    pub limits: Vec<Limit>,
    /// The file.
    pub text: String,
}

/// A limit beside the worst statistic of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LimitCheck {
    /// The limited quantity.
    pub quantity: String,
    /// Regimes that it is set for.
    pub regimes: String,
    /// The statistic that is worst.
    pub statistic: String,
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

    /// Returns it beside the worst of the statistics of a run, whose numbers are in these units, and when
    /// that begins, s; `None` if the run has none of its kind.
    #[must_use]
    pub fn check(
        &self,
        statistics: &BTreeMap<String, Statistic>,
        (rules, units): (&Rules, Units),
    ) -> Option<(LimitCheck, Option<f64>)> {
        let worst = self.measure.of(statistics)?;
        let value = self.in_unit(worst.value.value / self.measure.kind.from_si(units));
        let check = LimitCheck {
            quantity: rules.in_words(&self.quantity),
            regimes: self.regimes_in_words(),
            statistic: worst.statistic.to_owned(),
            value,
            limit: self.value,
            unit: self.unit.clone(),
            margin: self.margin(value),
            unfiltered: !worst.filtered && self.measure.is_filtered(),
        };
        Some((check, worst.time))
    }

    /// Returns the margin of a value in its unit: negative where the limit is not kept. Of a greatest value
    /// it is in parts of the limit; of a least share of what is there at rest it is in parts of the way from
    /// there to the limit, so that 1 is "nothing lost".
    #[must_use]
    pub fn margin(&self, value: f64) -> f64 {
        match self.bound {
            Bound::AtMost => (self.value - value) / self.value.abs(),
            Bound::AtLeast if self.unit == "%" && self.value < WHOLE => {
                (value - self.value) / (WHOLE - self.value)
            }
            Bound::AtLeast => (value - self.value) / self.value.abs(),
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
        Self::parse(&path.display().to_string(), &text)
    }

    /// As [`LimitSet::read`], from a text that `source` names in messages.
    ///
    /// # Errors
    /// As [`LimitSet::read`].
    pub fn parse(source: &str, text: &str) -> Result<Self, CaseError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let failed = |problems| CaseError::new(problems).of("file of limits");
        let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
        let mut problems = Problems::new();
        let stem = Path::new(source).file_stem().and_then(|stem| stem.to_str());
        let set = read(&tree, stem.unwrap_or("limits"), text, &mut problems);
        let set = set.filter(|_| problems.is_empty());
        set.ok_or_else(|| failed(problems))
    }
}

fn read(tree: &TableNode, name: &str, text: &str, problems: &mut Problems) -> Option<LimitSet> {
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a file of limits", problems);
    let title = top.text("title", problems).map(|(text, _)| text.to_owned());
    // Limits without a source are limits that nobody can check.
    let source = top.text("source", problems).map(|(text, _)| text.to_owned());
    let node = top.require("limits", HELP, problems)?;
    let items = match &node.value {
        NodeValue::List(items) if (1..=MOST).contains(&items.len()) => items.as_slice(),
        NodeValue::List(items) if items.len() > MOST => {
            let message = format!("`limits` has {} limits; at most {MOST} are read", items.len());
            let problem = Problem::new(message).at(&node.place).label("too many");
            problems.push(problem.help("write several files, and a certificate with each"));
            &[]
        }
        _ => {
            let problem = Problem::new("`limits` is no list of limits").at(&node.place);
            problems.push(problem.label("tables are expected").help(HELP));
            &[]
        }
    };
    let mut found: Vec<(Limit, &tree::TreeNode)> = Vec::new();
    for (number, item) in items.iter().enumerate() {
        let NodeValue::Table(table) = &item.value else {
            let problem = Problem::new("a limit is no table").at(&item.place);
            problems.push(problem.label("a table is expected").help(HELP));
            continue;
        };
        let own = CaseSection {
            path: format!("limits[{number}]"),
            table,
            place: Some(item.place.clone()),
        };
        let Some(limit) = limit(&own, problems) else {
            continue;
        };
        for (other, _) in &found {
            contradiction(other, &limit, &own, problems);
        }
        found.push((limit, item));
    }
    Some(LimitSet {
        name: name.to_owned(),
        title: title?,
        source: source?,
        limits: found.into_iter().map(|(limit, _)| limit).collect(),
        text: text.to_owned(),
    })
}

/// Reads a limit.
fn limit(own: &CaseSection<'_>, problems: &mut Problems) -> Option<Limit> {
    own.allow(&LIMIT_KEYS, &[], problems);
    let text = |key: &str, problems: &mut Problems| own.text(key, problems).map(|(text, _)| text.to_owned());
    let name = text("name", problems);
    let quantity = text("quantity", problems);
    let remark = match own.table.get("remark") {
        Some(_) => text("remark", problems),
        None => Some(String::new()),
    };
    let measure = own.text("measure", problems).and_then(|(text, node)| {
        let measure = Worst::named(text);
        if measure.is_none() {
            let names = WORST.iter().map(|own| own.name);
            let help = match nearest(text, names.clone()) {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!("there are {}", names.collect::<Vec<_>>().join(", ")),
            };
            let problem = Problem::new(format!("there is no measure \"{text}\"")).at(&node.place);
            problems.push(problem.label("this measure").help(help));
        }
        measure
    });
    let regimes = regimes(own, problems);
    let sides = [Bound::AtMost, Bound::AtLeast].map(|bound| (bound.name(), bound));
    let mut given = sides.into_iter().filter(|(key, _)| own.table.get(key).is_some());
    let (key, bound) = match (given.next(), given.next()) {
        (Some(side), None) => side,
        (first, _) => {
            let what = if first.is_some() { "both" } else { "neither" };
            let message = format!("`{}` has {what} of `at_most` and `at_least`", own.path);
            let mut problem = Problem::new(message).label("one of them is expected");
            if let Some(place) = &own.place {
                problem = problem.at(place);
            }
            let help = "write for example at_most = 0.8; two limits of one measure are two [[limits]]";
            problems.push(problem.help(help));
            return None;
        }
    };
    let measure = measure?;
    let (value, unit, si) = value(own, key, measure, problems)?;
    Some(Limit {
        name: name?,
        quantity: quantity?,
        measure,
        regimes: regimes?,
        bound,
        value,
        unit,
        remark: remark?,
        si,
    })
}

/// Reads the value of a limit, its unit, and that in SI.
fn value(
    own: &CaseSection<'_>,
    key: &str,
    measure: &Worst,
    problems: &mut Problems,
) -> Option<(f64, String, f64)> {
    if measure.unit.is_empty() && measure.kind == Kind::Dimensionless {
        let value = own.number(key, Range::Positive, "0.8", problems)?;
        return Some((value, String::new(), 1.0));
    }
    if measure.kind != Kind::Dimensionless {
        let quantity = own.quantity(key, measure.kind, Range::Positive, problems)?;
        let si = Quantity::new(1.0, quantity.unit_text()).ok()?.to_si();
        // Accelerations of a ride are given in g, which case files call g0.
        let unit = match quantity.unit_text() {
            "g0" => "g",
            unit => unit,
        };
        return Some((quantity.value(), unit.to_owned(), si));
    }
    // A share, as it is measured: in %.
    let (text, node) = own.text(key, problems)?;
    let unit = measure.unit;
    let number = text
        .strip_suffix(unit)
        .and_then(|own| own.trim().parse::<f64>().ok());
    match number.filter(|own| own.is_finite() && *own > 0.0) {
        Some(value) => Some((value, unit.to_owned(), 1.0)),
        None => {
            let message = format!(
                "`{}` is \"{text}\"; a share in {unit} is expected",
                own.path_of(key)
            );
            let problem = Problem::new(message).at(&node.place).label("above zero");
            problems.push(problem.help(format!("write for example {key} = \"10 {unit}\"")));
            None
        }
    }
}

/// Reads the regimes of a limit; `None` inside: all.
fn regimes(own: &CaseSection<'_>, problems: &mut Problems) -> Option<Option<Vec<String>>> {
    let help = "write regimes = \"all\", or names of regimes: [\"twist_and_roll\"]";
    let node = own.require("regimes", help, problems)?;
    let names = match &node.value {
        NodeValue::Text(text) if text == "all" => return Some(None),
        NodeValue::List(items) if !items.is_empty() => items
            .iter()
            .map(|item| match &item.value {
                NodeValue::Text(text) => Some(text.clone()),
                _ => None,
            })
            .collect::<Option<Vec<String>>>(),
        _ => None,
    };
    if names.is_none() {
        let problem = Problem::new(format!("`{}` names no regimes", own.path_of("regimes")));
        problems.push(problem.at(&node.place).label("names of regimes").help(help));
    }
    names.map(Some)
}

/// Notes what two limits cannot both be.
fn contradiction(first: &Limit, second: &Limit, own: &CaseSection<'_>, problems: &mut Problems) {
    let place = own.table.entry("name").map(|entry| &entry.key_place);
    let mut note = |message: String, label: &str, help: &str| {
        let problem = Problem::new(message).label(label);
        problems.push(
            match place {
                Some(place) => problem.at(place),
                None => problem,
            }
            .help(help),
        );
    };
    if first.name == second.name {
        let message = format!("there are two limits `{}`", first.name);
        note(message, "the second one", "give each limit a name of its own");
        return;
    }
    let common = match (&first.regimes, &second.regimes) {
        (Some(names), _) => names.iter().find(|name| second.is_for(name)).map(String::as_str),
        (None, Some(names)) => names.first().map(String::as_str),
        (None, None) => Some("all regimes"),
    };
    let (Some(regime), true) = (common, first.measure == second.measure) else {
        return;
    };
    let [low, high] = match (first.bound, second.bound) {
        (Bound::AtLeast, Bound::AtMost) => [first, second],
        (Bound::AtMost, Bound::AtLeast) => [second, first],
        _ => {
            let message = format!(
                "`{}` and `{}` limit `{}` on the same side in {regime}",
                first.name, second.name, first.measure.name
            );
            let help = "the stricter one is enough: leave the other out, or set it for other regimes";
            note(message, "which of them counts?", help);
            return;
        }
    };
    if low.value * low.si > high.value * high.si {
        let message = format!(
            "`{}` wants at least {} {} and `{}` at most {} {} of `{}` in {regime}",
            low.name, low.value, low.unit, high.name, high.value, high.unit, low.measure.name
        );
        note(
            message,
            "nothing keeps both",
            "correct one of them, or set them for other regimes",
        );
    }
}

/// Returns the limits of freight cars beside the worst of the statistics of a run, whose numbers are in these
/// units, taken by these rules.
#[must_use]
pub fn of(statistics: &BTreeMap<String, Statistic>, (rules, units): (&Rules, Units)) -> Vec<LimitCheck> {
    let limits = LimitSet::built_in()
        .first()
        .into_iter()
        .flat_map(|set| &set.limits);
    let checks = limits.filter_map(|limit| limit.check(statistics, (rules, units)));
    checks.map(|(check, _)| check).collect()
}

#[cfg(test)]
mod tests {
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

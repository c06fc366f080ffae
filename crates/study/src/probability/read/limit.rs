//! Reading the limit: the plan's own, or one of a rule by its name.

use std::path::Path;

use quantity::{Kind, SixDigits, System, nearest};

use crate::car::limits::read::number;
use crate::car::limits::value::LimitValue;
use crate::car::limits::{Bound, Limit, LimitSet};
use crate::car::worst::Worst;
use crate::case::problem::{Problem, Problems, TomlLocation};
use crate::case::section::{CaseSection, Range};
use crate::measures::Definitions;
use crate::probability::Goal;
use crate::probability::plan::PlanLimit;

/// A limit of a rule.
pub(super) struct Named {
    limit: Limit,
    /// Windows and filters of the rule, as `--set` takes them.
    pub output: Vec<String>,
    value: f64,
    rule: String,
    place: TomlLocation,
}

/// Reads the limit that is named, if one is.
pub(super) fn named(top: &CaseSection<'_>, folder: &Path, problems: &mut Problems) -> Option<Named> {
    top.table.get("limit")?;
    for key in ["measure", "at_most", "at_least"] {
        if let Some(entry) = top.table.entry(key) {
            let problem = Problem::new(format!("the plan has both `limit` and `{key}`"));
            let problem = problem.at(&entry.key_place).label("one of them is expected");
            problems.push(problem.help("`limit` names measure, side and value of a rule; take one out"));
        }
    }
    let (text, node) = top.text("limit", problems)?;
    let mut wrong = |message: String, help: String| {
        let problem = Problem::new(message).at(&node.place).label("this limit");
        problems.push(problem.help(help));
        None
    };
    const HELP: &str = "write set and name of a limit: limit = \"aar_chapter_xi.body_roll\"; `wedgelab \
                        regime --show aar_chapter_xi` prints names and values";
    let Some((set, name)) = text.rsplit_once('.') else {
        return wrong(format!("\"{text}\" names no limit of a set"), HELP.to_owned());
    };
    let beside = folder.join(set);
    let path = match beside.is_file() {
        true => beside.display().to_string(),
        false => set.to_owned(),
    };
    let set = match LimitSet::named_or_read(&path) {
        Ok(set) => set,
        Err(error) => {
            let advice = error
                .problems()
                .first()
                .and_then(|own| own.advice())
                .unwrap_or(HELP);
            return wrong(error.to_string(), advice.to_owned());
        }
    };
    let Some(limit) = set.limits.iter().find(|own| own.name == name) else {
        let names = set.limits.iter().map(|own| own.name.as_str());
        let help = match nearest(name, names.clone()) {
            Some(near) => format!("did you mean \"{}.{near}\"?", set.name),
            None => format!("there are {}", names.collect::<Vec<_>>().join(", ")),
        };
        return wrong(format!("{} has no limit \"{name}\"", set.name), help);
    };
    let LimitValue::Number(value) = limit.value else {
        let message = format!(
            "the limit {name} is a formula ({}), which differs from run to run",
            limit.value_in_words()
        );
        let help = format!(
            "write its number: measure = \"{}\" and {}",
            limit.measure.name,
            limit.bound.name()
        );
        return wrong(message, help);
    };
    let source = match set.source.is_empty() {
        true => String::new(),
        false => format!(" ({})", set.source),
    };
    Some(Named {
        value,
        output: set.output.clone(),
        rule: format!("{}.{name}{source}", set.name),
        place: node.place.clone(),
        limit: limit.clone(),
    })
}

/// Reads the limit, given the measures of the case.
pub(super) fn read(
    top: &CaseSection<'_>,
    named: Option<Named>,
    measures: &Definitions,
    problems: &mut Problems,
) -> Option<PlanLimit> {
    if let Some(named) = named {
        let limit = &named.limit;
        let Some(place) = measures.place(limit.measure.name) else {
            let message = format!("runs of this case have no measure \"{}\"", limit.measure.name);
            let problem = Problem::new(message).at(&named.place).label("a limit of it");
            problems.push(problem.help("limits of rules are for cars; write `measure` and its limit"));
            return None;
        };
        return Some(PlanLimit {
            measure: limit.measure.name.to_owned(),
            text: limit.quantity.clone(),
            kind: measures[place].kind,
            goal: Goal {
                bound: limit.bound,
                limit: named.value / limit.in_unit(1.0),
            },
            value: named.value,
            unit: limit.unit.clone(),
            rule: named.rule,
        });
    }
    if top.table.get("limit").is_some() {
        return None;
    }
    const HELP: &str = "write measure = \"body_roll_peak_to_peak\" and at_most = \"6 deg\"; \
                        docs/study.md and docs/car.md list measures";
    top.require("measure", HELP, problems)?;
    let (name, node) = top.text("measure", problems)?;
    let Some(place) = measures.place(name) else {
        let names = measures.iter().map(|own| &*own.name);
        let help = match nearest(name, names.clone()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("there are {}", names.collect::<Vec<_>>().join(", ")),
        };
        let problem = Problem::new(format!("runs of this case have no measure \"{name}\""));
        problems.push(problem.at(&node.place).label("this measure").help(help));
        return None;
    };
    let measure = &measures[place];
    let sides = [Bound::AtMost, Bound::AtLeast];
    let mut given = sides
        .into_iter()
        .filter(|bound| top.table.get(bound.name()).is_some());
    let (Some(bound), None) = (given.next(), given.next()) else {
        let both = sides.iter().all(|bound| top.table.get(bound.name()).is_some());
        let what = if both { "both" } else { "neither" };
        let problem = Problem::new(format!("the plan has {what} of `at_most` and `at_least`"));
        let help = "one of them is the limit of the measure: the probability is that to lie beyond it";
        problems.push(problem.at(&node.place).label("its limit is expected").help(help));
        return None;
    };
    let share = Worst::named(name).filter(|own| own.kind == Kind::Dimensionless && !own.unit.is_empty());
    let (value, unit, si) = if let Some(worst) = share {
        match number(top, bound.name(), worst, problems)? {
            (LimitValue::Number(value), unit, si) => (value, unit, si),
            (LimitValue::Formula(_), ..) => return None,
        }
    } else if measure.kind.unit(System::Si).is_empty() {
        let value = top.number(bound.name(), Range::Any, "0.8", problems)?;
        (value, String::new(), 1.0)
    } else {
        let found = top.quantity(bound.name(), measure.kind, Range::Any, problems)?;
        let si = found.to_si() / found.value();
        let unit = found.unit_text().to_owned();
        (found.value(), unit, if si.is_finite() { si } else { 1.0 })
    };
    Some(PlanLimit {
        measure: name.to_owned(),
        text: measure.text.clone().into_owned(),
        kind: measure.kind,
        goal: Goal {
            bound,
            limit: value * si,
        },
        value,
        unit,
        rule: String::new(),
    })
}

impl PlanLimit {
    /// Returns its value with the unit, as typed.
    #[must_use]
    pub fn in_words(&self) -> String {
        match self.unit.as_str() {
            "" => SixDigits(self.value).to_string(),
            unit => format!("{} {unit}", SixDigits(self.value)),
        }
    }
}

//! Reading a file of limits.

use std::path::Path;

use input::limits::LIMITS as MOST;
use quantity::{Kind, Quantity, nearest};

use super::value::{Formula, LimitValue, fits};
use super::{Bound, Limit, LimitSet, Mark, NotCovered};
use crate::car::named::try_on_car;
use crate::car::worst::{WORST, Worst};
use crate::case::CaseError;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::{self, CaseSection, Names, Range};
use crate::case::tree::{self, NodeValue, TableNode};
use crate::design;

const KEYS: [&str; 6] = ["title", "edition", "source", "output", "limits", "not_covered"];
const LIMIT_KEYS: [&str; 9] = [
    "name",
    "quantity",
    "measure",
    "regimes",
    "at_most",
    "at_least",
    "paragraph",
    "mark",
    "remark",
];
const HELP: &str = "write [[limits]] and below it name, quantity, measure, regimes and at_most or at_least";
pub(crate) const MARKS: Names<Mark> = &[
    ("source", Mark::Source),
    ("derived", Mark::Derived),
    ("remembered", Mark::Remembered),
    ("guess", Mark::Guess),
];
/// Formulas, and the keys of each.
const FORMULAS: Names<&[&str]> = &[
    ("nadal", &["formula", "friction"]),
    ("net_axle", &["formula", "base", "load"]),
    ("prudhomme", &["formula", "share", "base"]),
    ("wheel_load", &["formula", "base", "most"]),
    ("table", &["formula", "by", "points"]),
];

/// Reads a file; `name` is that of the set.
pub(super) fn parse(source: &str, text: &str) -> Result<LimitSet, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("file of limits");
    let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
    let mut problems = Problems::new();
    let stem = Path::new(source).file_stem().and_then(|stem| stem.to_str());
    let set = read(&tree, stem.unwrap_or("limits"), text, &mut problems);
    let set = set.filter(|_| problems.is_empty());
    set.ok_or_else(|| failed(problems))
}

/// Tries the windows of a set on the car of which nothing is given; mistakes are shown in its file.
pub(super) fn try_out(set: &LimitSet, source: &str) -> Result<(), CaseError> {
    let tree = tree::parse(&TomlSource::new(source, set.text.as_str())).map_err(CaseError::new)?;
    let place = |path: Option<&str>| {
        path.and_then(|path| tree.place_of(path))
            .or(tree.place_of("output"))
    };
    try_on_car(&set.output, place).map_err(|error| error.of("file of limits"))
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
    let edition = top.optional_text("edition", problems);
    let node = top.require("limits", HELP, problems)?;
    if let NodeValue::List(items) = &node.value
        && !(1..=MOST).contains(&items.len())
    {
        let problem = match items.len() {
            0 => Problem::new("`limits` is no list of limits: it is empty").label("none"),
            count => Problem::new(format!("`limits` has {count} limits; at most {MOST} are read"))
                .label("too many"),
        };
        let problem = problem.at(&node.place);
        problems.push(problem.help(match items.len() {
            0 => HELP,
            _ => "write several files, and an assessment with each",
        }));
        return None;
    }
    let mut found: Vec<Limit> = Vec::new();
    for own in top.tables("limits", problems) {
        let Some(limit) = limit(&own, problems) else {
            continue;
        };
        for other in &found {
            contradiction(other, &limit, &own, problems);
        }
        found.push(limit);
    }
    let output = match top.table.entry("output") {
        Some(_) => top.section("output", problems).map(|own| {
            let settings = design::settings(own.table);
            settings.into_iter().map(|own| format!("output.{own}")).collect()
        }),
        None => Some(Vec::new()),
    };
    let not_covered = top.table.get("not_covered").map(|_| not_covered(&top, problems));
    Some(LimitSet {
        name: name.to_owned(),
        title: title?,
        edition: edition?,
        source: source?,
        output: output?,
        limits: found,
        not_covered,
        text: text.to_owned(),
    })
}

/// Reads what a rule asks for and the limits do not have.
fn not_covered(top: &CaseSection<'_>, problems: &mut Problems) -> Vec<NotCovered> {
    let all = top.tables("not_covered", problems);
    let read = all.iter().filter_map(|own| {
        own.allow(&["what", "paragraph", "reason"], &[], problems);
        let what = own.text("what", problems).map(|(text, _)| text.to_owned());
        let paragraph = own.optional_text("paragraph", problems);
        let reason = own.optional_text("reason", problems);
        Some(NotCovered {
            what: what?,
            paragraph: paragraph?,
            reason: reason?,
        })
    });
    read.collect()
}

/// Reads a limit.
fn limit(own: &CaseSection<'_>, problems: &mut Problems) -> Option<Limit> {
    own.allow(&LIMIT_KEYS, &[], problems);
    let text = |key: &str, problems: &mut Problems| own.text(key, problems).map(|(text, _)| text.to_owned());
    let name = text("name", problems);
    let quantity = text("quantity", problems);
    let remark = own.optional_text("remark", problems);
    let paragraph = own.optional_text("paragraph", problems);
    let mark = match own.table.get("mark") {
        Some(_) => own.choice("mark", MARKS, problems).map(Some),
        None => Some(None),
    };
    let measure = own.text("measure", problems).and_then(|(text, node)| {
        let measure = Worst::named(text);
        if measure.is_none() {
            problems.push(no_measure(text).at(&node.place).label("this measure"));
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
    let value = match own.table.get(key).map(|node| &node.value) {
        Some(NodeValue::Table(_)) => formula(own, key, measure, problems),
        _ => number(own, key, measure, problems),
    };
    let (value, unit, si) = value?;
    Some(Limit {
        name: name?,
        quantity: quantity?,
        paragraph: paragraph?,
        mark: mark?,
        measure,
        regimes: regimes?,
        bound,
        value,
        unit,
        remark: remark?,
        si,
    })
}

fn no_measure(text: &str) -> Problem {
    let names = WORST.iter().map(|own| own.name);
    let help = match nearest(text, names.clone()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => format!("there are {}", names.collect::<Vec<_>>().join(", ")),
    };
    Problem::new(format!("there is no measure \"{text}\"")).help(help)
}

/// The value of a limit, its unit, and that in SI.
pub(crate) type Value = (LimitValue, String, f64);

/// Reads a value that is a number or a quantity.
pub(crate) fn number(
    own: &CaseSection<'_>,
    key: &str,
    measure: &Worst,
    problems: &mut Problems,
) -> Option<Value> {
    if measure.unit.is_empty() && measure.kind == Kind::Dimensionless {
        let value = own.number(key, Range::Positive, "0.8", problems)?;
        return Some((LimitValue::Number(value), String::new(), 1.0));
    }
    if measure.kind != Kind::Dimensionless {
        let quantity = own.quantity(key, measure.kind, Range::Positive, problems)?;
        let (unit, si) = unit_of(&quantity)?;
        return Some((LimitValue::Number(quantity.value()), unit, si));
    }
    // A share, as it is measured: in %.
    let (text, node) = own.text(key, problems)?;
    let unit = measure.unit;
    let number = text
        .strip_suffix(unit)
        .and_then(|own| own.trim().parse::<f64>().ok());
    match number.filter(|own| own.is_finite() && *own > 0.0) {
        Some(value) => Some((LimitValue::Number(value), unit.to_owned(), 1.0)),
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

/// Returns the unit of a quantity as limits show it, and that in SI.
fn unit_of(quantity: &Quantity) -> Option<(String, f64)> {
    let si = Quantity::new(1.0, quantity.unit_text()).ok()?.to_si();
    // Accelerations of a ride are given in g, which case files call g0.
    let unit = match quantity.unit_text() {
        "g0" => "g",
        unit => unit,
    };
    Some((unit.to_owned(), si))
}

/// Reads a value that is a formula.
fn formula(own: &CaseSection<'_>, key: &str, measure: &Worst, problems: &mut Problems) -> Option<Value> {
    let own = own.section(key, problems)?;
    let keys = own.choice("formula", FORMULAS, problems)?;
    own.allow(keys, &[], problems);
    let (name, node) = own.text("formula", problems)?;
    if !fits(name, measure.kind) || !measure.unit.is_empty() {
        let message = format!("the formula {name} gives no limit of {}", measure.name);
        let problem = Problem::new(message).at(&node.place).label("of another kind");
        problems.push(problem.help("nadal and net_axle limit ratios, prudhomme and wheel_load forces"));
        return None;
    }
    let plain = |formula: Formula| Some((LimitValue::Formula(formula), String::new(), 1.0));
    let force =
        |key: &str, problems: &mut Problems| own.quantity(key, Kind::Force, Range::Positive, problems);
    match name {
        "nadal" => {
            let friction = match own.table.get("friction") {
                Some(_) => {
                    Some(own.number("friction", Range::UpTo(2.0, "between 0 and 2"), "0.5", problems)?)
                }
                None => None,
            };
            plain(Formula::Nadal { friction })
        }
        "net_axle" => {
            let base = own.number("base", Range::Positive, "0.4", problems);
            let load = force("load", problems);
            plain(Formula::NetAxle {
                base: base?,
                load: load?.to_si(),
            })
        }
        "prudhomme" => {
            let share = own.number("share", Range::Positive, "0.85", problems);
            let base = force("base", problems)?;
            let (unit, si) = unit_of(&base)?;
            let formula = Formula::Prudhomme {
                share: share?,
                base: base.to_si(),
            };
            Some((LimitValue::Formula(formula), unit, si))
        }
        "wheel_load" => {
            let (base, most) = (force("base", problems), force("most", problems));
            let base = base?;
            let (unit, si) = unit_of(&base)?;
            let formula = Formula::WheelLoad {
                base: base.to_si(),
                most: most?.to_si(),
            };
            Some((LimitValue::Formula(formula), unit, si))
        }
        _ => table(&own, measure, problems),
    }
}

/// Reads a limit over another measure.
fn table(own: &CaseSection<'_>, measure: &Worst, problems: &mut Problems) -> Option<Value> {
    let (text, node) = own.text("by", problems)?;
    let Some(by) = Worst::named(text) else {
        problems.push(no_measure(text).at(&node.place).label("this measure"));
        return None;
    };
    let help = "write points = [[place, limit], [place, limit]], each with its unit, places rising";
    let node = own.require("points", help, problems)?;
    let path = own.path_of("points");
    let wrong = |message: String, problems: &mut Problems| {
        let problem = Problem::new(message).at(&node.place).label("pairs are expected");
        problems.push(problem.help(help));
    };
    let items = match &node.value {
        NodeValue::List(items) if (1..=MOST).contains(&items.len()) => items,
        _ => {
            wrong(format!("`{path}` is no list of 1 to {MOST} pairs"), problems);
            return None;
        }
    };
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut unit: Option<(String, f64)> = None;
    for (number, item) in items.iter().enumerate() {
        let path = format!("{path}[{number}]");
        let NodeValue::List(pair) = &item.value else {
            wrong(format!("`{path}` is no pair"), problems);
            return None;
        };
        let [place, limit] = pair.as_slice() else {
            wrong(format!("`{path}` has {} entries, not two", pair.len()), problems);
            return None;
        };
        let mut read = |node: &tree::TreeNode, kind: Kind, which: usize| match (&node.value, kind) {
            (NodeValue::Number(value), Kind::Dimensionless) if value.is_finite() => {
                Some((*value, String::new(), 1.0))
            }
            _ => {
                let path = format!("{path}[{which}]");
                let quantity = section::quantity(node, &path, kind, Range::NotNegative, problems)?;
                let (unit, si) = unit_of(&quantity)?;
                Some((quantity.to_si(), unit, si))
            }
        };
        let (x, ..) = read(place, by.kind, 0)?;
        let (y, own_unit, si) = read(limit, measure.kind, 1)?;
        if points.last().is_some_and(|[before, _]| *before >= x) {
            wrong(
                format!("`{path}` does not lie beyond the point before it"),
                problems,
            );
            return None;
        }
        unit.get_or_insert((own_unit, si));
        points.push([x, y]);
    }
    let (unit, si) = unit?;
    Some((LimitValue::Formula(Formula::Table { by, points }), unit, si))
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
    let (LimitValue::Number(least), LimitValue::Number(most)) = (&low.value, &high.value) else {
        return;
    };
    if least * low.si > most * high.si {
        let message = format!(
            "`{}` wants at least {least} {} and `{}` at most {most} {} of `{}` in {regime}",
            low.name, low.unit, high.name, high.unit, low.measure.name
        );
        note(
            message,
            "nothing keeps both",
            "correct one of them, or set them for other regimes",
        );
    }
}

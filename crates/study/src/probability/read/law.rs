//! Reading the distribution of an uncertain parameter, with its mark.

use crate::car::limits::Mark;
use crate::car::limits::read::MARKS;
use crate::case::problem::{Problem, Problems, TomlLocation};
use crate::case::section::{CaseSection, Names};
use crate::case::tree::{NodeValue, TableNode};
use crate::design::{Value, value};
use crate::probability::distribution::Distribution;
use crate::probability::plan::{Uncertain, UncertainValues};

#[derive(Clone, Copy, PartialEq)]
enum Law {
    Uniform,
    Normal,
    Lognormal,
    Triangular,
    Discrete,
}

const LAWS: Names<Law> = &[
    ("uniform", Law::Uniform),
    ("normal", Law::Normal),
    ("lognormal", Law::Lognormal),
    ("triangular", Law::Triangular),
    ("discrete", Law::Discrete),
];
const ALL_KEYS: [&str; 13] = [
    "distribution",
    "from",
    "to",
    "mean",
    "deviation",
    "median",
    "factor",
    "mode",
    "values",
    "weights",
    "also",
    "mark",
    "text",
];
const MARK_HELP: &str = "write mark = \"source\" with a text that names it, or \"derived\", \"remembered\", \
                         \"guess\"";

impl Law {
    /// Returns the keys of its numbers.
    fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Uniform => &["from", "to"],
            Self::Normal => &["mean", "deviation", "from", "to"],
            Self::Lognormal => &["median", "factor", "from", "to"],
            Self::Triangular => &["from", "mode", "to"],
            Self::Discrete => &["values", "weights"],
        }
    }

    fn example(self) -> &'static str {
        match self {
            Self::Uniform => "{ distribution = \"uniform\", from = 0.3, to = 0.5, mark = \"guess\" }",
            Self::Normal => {
                "{ distribution = \"normal\", mean = 0.4, deviation = 0.05, from = 0.2, to = 0.6, mark = \
                 \"guess\" }; from and to cut it off and may be left out"
            }
            Self::Lognormal => {
                "{ distribution = \"lognormal\", median = 0.4, factor = 1.1, mark = \"guess\" }: 68 % of \
                 values lie between median / factor and median * factor; from and to cut it off and may be \
                 left out"
            }
            Self::Triangular => {
                "{ distribution = \"triangular\", from = 0.3, mode = 0.4, to = 0.5, mark = \"guess\" }"
            }
            Self::Discrete => {
                "{ distribution = \"discrete\", values = [0.3, 0.4], weights = [1, 3], mark = \"guess\" }"
            }
        }
    }
}

/// Returns whether a table is a distribution rather than the way to others.
pub(super) fn is_law(table: &TableNode) -> bool {
    let mut entries = table.entries.iter();
    entries.any(|entry| ALL_KEYS.contains(&entry.key.as_str()))
}

/// Reads an uncertain parameter, and the values that are tried with their places.
pub(super) fn read(
    section: &CaseSection<'_>,
    problems: &mut Problems,
) -> Option<(Uncertain, Vec<(Value, TomlLocation)>)> {
    let before = problems.count();
    let law = section.choice("distribution", LAWS, problems);
    let known = law.map_or(&ALL_KEYS[..], Law::keys);
    let keys: Vec<&str> = ["distribution", "also", "mark", "text"]
        .iter()
        .chain(known)
        .copied()
        .collect();
    section.allow(&keys, &[], problems);
    let mark = section
        .require("mark", MARK_HELP, problems)
        .and_then(|_| section.choice("mark", MARKS, problems));
    let text = section.optional_text("text", problems);
    if let (Some(Mark::Source), Some(text), Some(node)) = (mark, &text, section.table.get("mark"))
        && text.trim().is_empty()
    {
        let message = format!("`{}` is from a source that is not named", section.path);
        let help = "write text = \"...\" with the source and its date, or mark = \"remembered\"";
        problems.push(
            Problem::new(message)
                .at(&node.place)
                .label("a `text` is expected")
                .help(help),
        );
    }
    let mut paths = vec![section.path.clone()];
    paths.extend(also(section, problems));
    let mut written = Vec::new();
    let values = match law? {
        Law::Discrete => discrete(section, &mut written, problems),
        law => numbers(section, law, &mut written, problems),
    };
    let uncertain = Uncertain {
        paths,
        values: values?,
        mark: mark?,
        text: text?,
    };
    (problems.count() == before).then_some((uncertain, written))
}

/// Reads the parameters that take the same value.
fn also(section: &CaseSection<'_>, problems: &mut Problems) -> Vec<String> {
    let Some(node) = section.table.get("also") else {
        return Vec::new();
    };
    let items = match &node.value {
        NodeValue::List(items) => items.as_slice(),
        _ => &[],
    };
    let names = items.iter().map(|item| match &item.value {
        NodeValue::Text(text) => Some(text.clone()),
        _ => None,
    });
    match names
        .collect::<Option<Vec<_>>>()
        .filter(|names| !names.is_empty())
    {
        Some(names) => names,
        None => {
            let problem = Problem::new(format!("`{}.also` is no list of parameters", section.path));
            let problem = problem.at(&node.place).label("names in quotes");
            problems.push(problem.help("write also = [\"friction.slope\"]"));
            Vec::new()
        }
    }
}

/// Reads the numbers of a distribution.
fn numbers(
    section: &CaseSection<'_>,
    law: Law,
    written: &mut Vec<(Value, TomlLocation)>,
    problems: &mut Problems,
) -> Option<UncertainValues> {
    let mut unit: Option<String> = None;
    let mut read = |key: &str, open: Option<f64>, problems: &mut Problems| -> Option<f64> {
        if let (Some(open), None) = (open, section.table.get(key)) {
            return Some(open);
        }
        let help = format!("write {}", law.example());
        let node = section.require(key, &help, problems)?;
        let own = value(&section.path, node);
        let mut wrong = |message: String, label: &str| {
            problems.push(Problem::new(message).at(&node.place).label(label).help(&*help));
            None
        };
        let Value::Number { unit: typed, .. } = &own else {
            let message = format!(
                "`{}.{key}` is {}, which is no number",
                section.path,
                node.place.text()
            );
            return wrong(message, "a number with its unit is expected");
        };
        // A factor is a pure number, whatever is uncertain.
        let unit = match key {
            "factor" => String::new(),
            _ => unit.get_or_insert_with(|| typed.clone()).clone(),
        };
        let Some(number) = own.in_unit(&unit).filter(|own| own.is_finite()) else {
            let message = format!(
                "`{}.{key}` is {}, not in the unit of the others",
                section.path,
                own.shown()
            );
            return wrong(message, "another kind of quantity");
        };
        if key == "from" || key == "to" {
            written.push((own, node.place.clone()));
        }
        Some(number)
    };
    let infinite = [Some(f64::NEG_INFINITY), Some(f64::INFINITY)];
    let of = match law {
        Law::Uniform => Distribution::Uniform {
            from: read("from", None, problems)?,
            to: read("to", None, problems)?,
        },
        Law::Normal => Distribution::Normal {
            mean: read("mean", None, problems)?,
            deviation: read("deviation", None, problems)?,
            from: read("from", infinite[0], problems)?,
            to: read("to", infinite[1], problems)?,
        },
        Law::Lognormal => Distribution::Lognormal {
            median: read("median", None, problems)?,
            factor: read("factor", None, problems)?,
            from: read("from", Some(0.0), problems)?,
            to: read("to", infinite[1], problems)?,
        },
        Law::Triangular => Distribution::Triangular {
            from: read("from", None, problems)?,
            mode: read("mode", None, problems)?,
            to: read("to", None, problems)?,
        },
        Law::Discrete => return None,
    };
    let unit = unit.unwrap_or_default();
    match sense(&of) {
        None => Some(UncertainValues::Numbers { of, unit }),
        Some((key, message)) => {
            let place = section.table.get(key).map(|node| &node.place);
            let problem = Problem::new(format!("`{}`: {message}", section.path));
            let problem = match place.or(section.place.as_ref()) {
                Some(place) => problem.at(place),
                None => problem,
            };
            problems.push(
                problem
                    .label("this number")
                    .help(format!("write {}", law.example())),
            );
            None
        }
    }
}

/// Returns what is wrong with the numbers of a distribution, and with which.
fn sense(of: &Distribution) -> Option<(&'static str, &'static str)> {
    let [from, to] = of.ends();
    let (key, wrong, message) = match *of {
        Distribution::Normal { deviation, .. } if deviation <= 0.0 => {
            ("deviation", true, "a standard deviation is greater than zero")
        }
        Distribution::Lognormal { median, .. } if median <= 0.0 => (
            "median",
            true,
            "the median of a lognormal distribution is greater than zero",
        ),
        Distribution::Lognormal { factor, .. } if factor <= 1.0 => (
            "factor",
            true,
            "the factor of a lognormal distribution is greater than 1",
        ),
        Distribution::Lognormal { from, .. } if from < 0.0 => {
            ("from", true, "a lognormal distribution has no values below zero")
        }
        Distribution::Triangular { mode, .. } if mode < from || mode > to => {
            ("mode", true, "the likeliest value lies between the ends")
        }
        _ => ("to", from >= to, "the greatest value is not above the least one"),
    };
    wrong.then_some((key, message)).or_else(|| {
        // What is cut off must leave something, and numbers must be in reach.
        let reached = [-8.0, 0.0, 8.0].map(|u| of.at(u));
        let wide = reached.iter().any(|own| !own.is_finite());
        let nothing = reached[0] >= reached[2];
        let small = "almost nothing of the distribution lies between the ends";
        let large = "these numbers lead beyond all numbers";
        (nothing || wide).then_some(("distribution", if wide { large } else { small }))
    })
}

/// Reads discrete values and their weights.
fn discrete(
    section: &CaseSection<'_>,
    written: &mut Vec<(Value, TomlLocation)>,
    problems: &mut Problems,
) -> Option<UncertainValues> {
    let help = format!("write {}", Law::Discrete.example());
    let mut list = |key: &str| {
        let node = section.require(key, &help, problems)?;
        match &node.value {
            NodeValue::List(items) if items.len() > 1 => Some((node, items)),
            _ => {
                let message = format!("`{}.{key}` is no list of two or more", section.path);
                let problem = Problem::new(message).at(&node.place).label("a list is expected");
                problems.push(problem.help(&*help));
                None
            }
        }
    };
    let (values, weights) = (list("values"), list("weights"));
    let ((_, values), (node, weights)) = (values?, weights?);
    written.extend(
        values
            .iter()
            .map(|item| (value(&section.path, item), item.place.clone())),
    );
    let numbers: Option<Vec<f64>> = weights
        .iter()
        .map(|item| match item.value {
            NodeValue::Number(own) if own >= 0.0 && own.is_finite() => Some(own),
            _ => None,
        })
        .collect();
    let numbers = numbers.filter(|own| own.len() == values.len() && own.iter().sum::<f64>() > 0.0);
    let Some(weights) = numbers else {
        let message = format!(
            "`{}.weights` are not {} numbers, zero or greater, with a sum above zero",
            section.path,
            values.len()
        );
        let problem = Problem::new(message)
            .at(&node.place)
            .label("one weight a value is expected");
        problems.push(problem.help(help));
        return None;
    };
    Some(UncertainValues::Discrete {
        values: written.iter().map(|(value, _)| value.clone()).collect(),
        weights,
    })
}

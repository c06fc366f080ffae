//! The reference of case keys: every key of every model, with its defaults and what it means.

use std::fmt::Write;

use study::case::{Field, Input};
use study::models::{AnyCase, ModelKeys, Variant, case_keys};

/// The heading and introduction of a model's sections.
const HEADINGS: [(&str, &str); 4] = [
    (
        "A wedge",
        "`model = \"wedge\"`, or a case without `model`. Defaults are those of the thesis; where they depend \
         on the damping, that of variable damping comes first.",
    ),
    (
        "A truck",
        "`model = \"truck\"`. Where a default depends on the rig or on the damping, each value stands once.",
    ),
    (
        "A car on track",
        "`model = \"car\"`. The keys of trucks are those of a truck, below `truck.` for both, `front_truck.` \
         and `rear_truck.` for one, without its motions, loads and rigs.",
    ),
    (
        "A vehicle",
        "`model = \"vehicle\"`: see [vehicles](vehicle.md). Bodies and elements have names of your own: here \
         `NAME` stands for one of these, and the name of an element is that of its kind. The other keys \
         of `trucks.NAME` are those of a car's truck.",
    ),
];

/// A key: its path, the values that it has in the cases, what it means, what may stand there.
pub struct Key {
    pub path: String,
    values: Vec<String>,
    pub help: String,
    input: Input,
}

/// Returns the page.
pub fn page() -> String {
    let mut page = String::from(
        "# Keys of cases\n\n\
         All keys of all models, as the program knows them; `cargo run --release -p study --example \
         case_keys` writes this page. Values are text with units; US customary and SI units mix freely. A \
         key is what `--set` takes; in a file the part before the last point is the name of a table. \
         `wedgelab case NAME` prints a whole case with the same words. The files in [schema](schema) say the \
         same to editors (JSON Schema): a printed case names its schema in the first line, and \
         `wedgelab case --schema MODEL` prints it.\n",
    );
    for ((_, model), (title, about)) in case_keys().zip(HEADINGS) {
        let _ = write!(
            page,
            "\n## {title}\n\n{about}\n\n| key | in built-in cases | meaning |\n|---|---|---|\n"
        );
        for key in keys(model.cases) {
            let values: Vec<String> = key.values.iter().map(|value| cell(value)).collect();
            let _ = writeln!(
                page,
                "| `{}` | {} | {} |",
                key.path,
                values.join(", "),
                meaning(&key)
            );
        }
    }
    page
}

/// Returns the schema of a model's cases as its file.
pub fn schema(model: &str, keys: &ModelKeys) -> String {
    serde_json::to_string_pretty(&keys.schema(model)).unwrap() + "\n"
}

/// Returns the keys of all cases of a model, in the order in which they first appear.
pub fn keys(cases: &[Variant]) -> Vec<Key> {
    let mut keys: Vec<Key> = Vec::new();
    for (name, overrides) in cases {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let case = AnyCase::built_in(name, &overrides).unwrap().unwrap();
        let mut last = 0;
        let fields = case.fields().into_iter().flat_map(|section| section.fields);
        // A car's trucks have the keys of trucks.
        let is_of_truck = |path: &str| match case {
            AnyCase::Car(_) => path.starts_with("truck."),
            AnyCase::Vehicle(_) => {
                path.starts_with("trucks.") && !path.ends_with(".at") && !path.ends_with(".under")
            }
            _ => false,
        };
        for mut field in fields.filter(|field| !is_of_truck(&field.path)) {
            field.path = general(&field.path);
            let value = shown(&field);
            if let Some(place) = keys.iter().position(|key| key.path == field.path) {
                last = place + 1;
                let values = &mut keys[place].values;
                if !values.contains(&value) && !["name", "title"].contains(&field.path.as_str()) {
                    values.push(value);
                }
            } else {
                let Field {
                    path, help, input, ..
                } = field;
                let values = vec![value];
                keys.insert(
                    last,
                    Key {
                        path,
                        values,
                        help,
                        input,
                    },
                );
                last += 1;
            }
        }
    }
    keys
}

/// Returns the path of a key with `NAME` for the name of a body, and without numbers after those of elements.
fn general(path: &str) -> String {
    let parts: Vec<&str> = path.split('.').collect();
    match parts.as_slice() {
        [table @ ("bodies" | "wheelsets" | "trucks"), _, rest @ ..] => {
            format!("{table}.NAME.{}", rest.join("."))
        }
        ["elements", name, rest @ ..] => {
            let kind = name.trim_end_matches(|sign: char| sign.is_ascii_digit() || sign == '_');
            let kind = if kind == "traction" { "bushing" } else { kind };
            format!("elements.{kind}.{}", rest.join("."))
        }
        _ => path.to_owned(),
    }
}

/// Returns a value on one line, cut where it is long.
fn shown(field: &Field) -> String {
    let text = field.text.split_whitespace().collect::<Vec<_>>().join(" ");
    match text.char_indices().nth(70) {
        Some((end, _)) => format!("{} ...", &text[..end]),
        None => text,
    }
}

fn cell(value: &str) -> String {
    if value.is_empty() {
        return "nothing".to_owned();
    }
    format!("`{}`", value.replace('|', "\\|"))
}

fn meaning(key: &Key) -> String {
    let help = key
        .help
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .replace('|', "\\|");
    let choices = match &key.input {
        Input::Choice { choices } => format!("one of {}", list(choices)),
        Input::Several { choices, .. } => format!("some of {}", list(choices)),
        _ if help.is_empty() => return implied(&key.path).to_owned(),
        _ => return help,
    };
    if help.is_empty() {
        choices
    } else {
        format!("{help}; {choices}")
    }
}

/// Returns what a key means whose name says it to those who know the case.
fn implied(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or_default() {
        "longitudinal" | "lateral" | "vertical" | "roll" | "pitch" | "yaw" => {
            "motion: one held value, a shape, or a list to be added up"
        }
        "duration" if path == "simulation.duration" => "simulated time",
        _ if path.split('.').count() > 2 => "of this motion",
        _ => "",
    }
}

fn list(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

//! The sections of a wedge's case as classes of Python, from the schema.

use std::fmt::Write;

use serde_json::Value;
use study::models::case_keys;

use super::page::{Key, keys};

/// Sections and the classes of Python; both faces have one.
const CLASSES: [(&str, &str, &str); 9] = [
    ("wedge", "WedgeSection", "``[wedge]``"),
    ("control_coil", "ControlCoilSection", "``[control_coil]``"),
    ("contact", "ContactSection", "``[contact]``"),
    ("friction", "FrictionSection", "``[friction]``"),
    (
        "column_face",
        "FaceSection",
        "``[column_face]`` or ``[slope_face]``",
    ),
    ("side_frame", "SideFrameSection", "``[side_frame]``"),
    ("bolster", "BolsterSection", "``[bolster]``"),
    ("environment", "EnvironmentSection", "``[environment]``"),
    ("simulation", "SimulationSection", "``[simulation]``"),
];

const HEAD: &str = "\"\"\"The sections of a case, as typed objects.

Every dimensional value is a text with a unit (``\"32 deg\"``), a `Quantity`, or a number in SI units: m, N,
s, rad, rad/s, N/m, N s/m, N m s/rad, kg m^2, m/s^2. What is ``None`` is left out, and takes the value of the
case that is changed, or of the thesis. The sections of a case that was made hold every value, with
quantities as `Quantity`.
\"\"\"

# Written by `cargo run --release -p study --example case_keys`.

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ._motions import MotionLike, Points, QuantityLike, Section, Triple
";

/// Returns the module of Python.
pub fn sections() -> String {
    let (model, wedge) = case_keys().next().unwrap();
    let (schema, keys) = (wedge.schema(model), keys(wedge.cases));
    let mut names = CLASSES.map(|(_, class, _)| class);
    names.sort_unstable();
    let names: String = names.iter().map(|name| format!("    \"{name}\",\n")).collect();
    let mut page = format!("{HEAD}\n__all__ = [\n{names}]\n");
    for (section, class, title) in CLASSES {
        let own = keys.iter().filter_map(|key| {
            let (of, name) = key.path.split_once('.')?;
            (of == section && !name.contains('.')).then_some((name, key))
        });
        page += &one(class, title, own, &schema["properties"][section]["properties"]);
    }
    page
}

/// Returns the class of a section.
fn one<'k>(
    class: &str,
    title: &str,
    keys: impl Iterator<Item = (&'k str, &'k Key)>,
    schema: &Value,
) -> String {
    let mut page =
        format!("\n\n@dataclass(frozen=True)\nclass {class}(Section):\n    \"\"\"{title}\"\"\"\n\n");
    let (mut words, mut motions) = (Vec::new(), Vec::new());
    for (name, key) in keys {
        let hint = hint(&schema[name]);
        match hint {
            "MotionLike" => motions.push(name),
            // The toe has its direction in words.
            "QuantityLike" if name != "toe" => {}
            "Triple" | "Points | str" => {}
            _ => words.push(name),
        }
        let help = key.help.split_whitespace().collect::<Vec<_>>().join(" ");
        // The name of a motion's definition says what it is of.
        let of = schema[name]["allOf"][0]["$ref"]
            .as_str()
            .and_then(|of| of.rsplit('/').next());
        let help = sentence(match of {
            Some(of) if help.is_empty() => of,
            _ => &help,
        });
        let _ = write!(page, "    {name}: {hint} | None = None\n    \"\"\"{help}\"\"\"\n");
    }
    for (kind, names) in [("_words", words), ("_motions", motions)] {
        if !names.is_empty() {
            let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            let _ = write!(page, "\n    {kind} = frozenset({{{}}})\n", names.join(", "));
        }
    }
    page
}

/// Returns a comment of a case as a sentence of Python's documentation.
fn sentence(help: &str) -> String {
    let mut letters = help.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string());
    let text = format!("{}{}", first.unwrap_or_default(), letters.as_str());
    // Names in quotes become literals.
    let pieces = text.split('"').enumerate();
    let text: String = pieces
        .map(|(at, piece)| {
            if at % 2 == 1 {
                format!("``\"{piece}\"``")
            } else {
                piece.to_owned()
            }
        })
        .collect();
    format!("{text}.")
}

/// Returns the type of a key.
fn hint(schema: &Value) -> &'static str {
    let one = |schema: &Value| match schema["type"].as_str() {
        Some("string") if schema["pattern"].is_string() => "QuantityLike",
        Some("string") => "str",
        Some("boolean") => "bool",
        Some("number") => "float",
        Some("object") => "Mapping[str, Any]",
        Some("array") => match schema["items"]["type"].as_str() {
            Some("string") if schema["items"]["pattern"].is_string() => "Triple",
            Some("string") => "Sequence[str]",
            Some("integer") => "Sequence[int]",
            _ => "Sequence[Sequence[float]]",
        },
        _ => "Any",
    };
    match (&schema["allOf"], &schema["anyOf"]) {
        (Value::Array(_), _) => "MotionLike",
        (_, Value::Array(forms)) if forms.iter().any(|form| form["type"] == "object") => {
            "str | Mapping[str, Any]"
        }
        (_, Value::Array(_)) => "Points | str",
        _ => one(schema),
    }
}

//! Motions as typed, and their reading.

use super::document::PROFILES;
use super::problem::{Problem, Problems};
use super::section::{self, Range, Section, name_of};
use super::table::{self, QuantityTable};
use super::tables::Tables;
use super::tree::{Node, Value};
use super::units::in_system;
use quantity::{Kind, Quantity, System, nearest};
use std::fmt::Write;

/// How one coordinate of a neighbour moves, as typed. Lengths or angles, by the coordinate.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// It is held.
    Constant(Quantity),
    /// `amplitude sin(frequency t + phase)`
    Sine {
        /// Amplitude.
        amplitude: Quantity,
        /// Frequency; `Hz` and `rpm` count cycles.
        frequency: Quantity,
        /// Phase at time zero.
        phase: Quantity,
    },
    /// A triangle wave that rises from zero.
    Triangle {
        /// Amplitude.
        amplitude: Quantity,
        /// Frequency.
        frequency: Quantity,
    },
    /// A sine whose frequency changes linearly with time and then stays.
    SweptSine {
        /// Amplitude.
        amplitude: Quantity,
        /// Frequency at time zero.
        start_frequency: Quantity,
        /// Frequency from `duration` on.
        end_frequency: Quantity,
        /// Time of the sweep.
        duration: Quantity,
    },
    /// From zero to the amplitude, which it then holds.
    Ramp {
        /// The value held at the end.
        amplitude: Quantity,
        /// Time it begins.
        start: Quantity,
        /// Time it takes.
        duration: Quantity,
        /// Its shape.
        profile: Profile,
    },
    /// A cubic spline through time and value.
    Table(QuantityTable),
    /// A sum of motions.
    Sum(Vec<Motion>),
    /// Nothing until a time, then a motion that counts its time from there.
    From {
        /// When it begins.
        start: Quantity,
        /// The motion.
        motion: Box<Motion>,
    },
}

/// The shape of a ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Profile {
    /// Rate and acceleration are zero at both ends.
    Smooth,
    /// Constant rate.
    Linear,
    /// Half a period of a cosine: the rate is zero at both ends.
    HalfCosine,
}

const SHAPES: [&str; 6] = ["constant", "sine", "triangle", "swept_sine", "ramp", "table"];
const EXAMPLE: &str = "write for example { shape = \"sine\", amplitude = \"1 in\", frequency = \"2 rad/s\" \
                       }, or one held value";

/// Reads a motion whose values measure `kind`. `tables` says where those in files lie.
pub(crate) fn read(
    node: &Node,
    path: &str,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<Motion> {
    match &node.value {
        Value::List(items) if items.is_empty() => {
            let problem = Problem::new(format!("`{path}` is an empty sum of motions"));
            problems.push(problem.at(&node.place).label("nothing to add up").help(EXAMPLE));
            None
        }
        Value::List(items) => {
            let mut parts = Vec::new();
            for (at, item) in items.iter().enumerate() {
                let path = format!("{path}[{at}]");
                if matches!(item.value, Value::List(_)) {
                    let problem = Problem::new(format!("`{path}` is a list; a motion is expected"));
                    problems.push(problem.at(&item.place).label("a sum within a sum").help(EXAMPLE));
                } else {
                    parts.push(read(item, &path, kind, tables, problems));
                }
            }
            Some(Motion::Sum(parts.into_iter().collect::<Option<_>>()?))
        }
        Value::Table(table) => {
            let place = Some(node.place.clone());
            let section = Section {
                path: path.into(),
                table,
                place,
            };
            read_shape(&section, kind, tables, problems)
        }
        _ => section::quantity(node, path, kind, Range::Any, problems).map(Motion::Constant),
    }
}

fn read_shape(
    section: &Section<'_>,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<Motion> {
    section.require("shape", EXAMPLE, problems)?;
    let (shape, node) = section.text("shape", problems)?;
    let (keys, optional): (&[&str], &[&str]) = match shape {
        "constant" => (&["value"], &[]),
        "sine" => (&["amplitude", "frequency"], &["phase", "start"]),
        "triangle" => (&["amplitude", "frequency"], &["start"]),
        "swept_sine" => (
            &["amplitude", "start_frequency", "end_frequency", "duration"],
            &["start"],
        ),
        "ramp" => (&["amplitude", "duration"], &["start", "profile"]),
        "table" => (&[], &["file", "points"]),
        _ => {
            let all = format!("write one of \"{}\"", SHAPES.join("\", \""));
            let help = match nearest(shape, SHAPES) {
                Some(near) => format!("did you mean \"{near}\"? {all}"),
                None => all,
            };
            let problem = Problem::new(format!("there is no motion of shape \"{shape}\""));
            problems.push(problem.at(&node.place).label("not one of the shapes").help(help));
            return None;
        }
    };
    let known: Vec<&str> = ["shape"].iter().chain(keys).chain(optional).copied().collect();
    section.allow(&known, &[], problems);
    if shape != "ramp" && section.table.get("start").is_some() {
        let start = section.quantity("start", Kind::Time, Range::NotNegative, problems);
        let motion = Box::new(read_known_shape(shape, section, kind, tables, problems)?);
        return Some(Motion::From {
            start: start?,
            motion,
        });
    }
    read_known_shape(shape, section, kind, tables, problems)
}

/// Reads a motion of this shape, without the time that it starts at.
fn read_known_shape(
    shape: &str,
    section: &Section<'_>,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<Motion> {
    let mut quantity = |key: &str, kind, range| section.quantity(key, kind, range, problems);
    match shape {
        "constant" => Some(Motion::Constant(quantity("value", kind, Range::Any)?)),
        "sine" | "triangle" => {
            let amplitude = quantity("amplitude", kind, Range::Any);
            let frequency = quantity("frequency", Kind::Frequency, Range::Positive);
            if shape == "triangle" {
                return Some(Motion::Triangle {
                    amplitude: amplitude?,
                    frequency: frequency?,
                });
            }
            let phase = match section.table.get("phase") {
                Some(_) => quantity("phase", Kind::Angle, Range::Any),
                None => Quantity::new(0.0, "deg").ok(),
            };
            Some(Motion::Sine {
                amplitude: amplitude?,
                frequency: frequency?,
                phase: phase?,
            })
        }
        "swept_sine" => {
            let amplitude = quantity("amplitude", kind, Range::Any);
            let start_frequency = quantity("start_frequency", Kind::Frequency, Range::NotNegative);
            let end_frequency = quantity("end_frequency", Kind::Frequency, Range::NotNegative);
            let duration = quantity("duration", Kind::Time, Range::Positive);
            Some(Motion::SweptSine {
                amplitude: amplitude?,
                start_frequency: start_frequency?,
                end_frequency: end_frequency?,
                duration: duration?,
            })
        }
        "ramp" => {
            let amplitude = quantity("amplitude", kind, Range::Any);
            let duration = quantity("duration", Kind::Time, Range::Positive);
            let start = match section.table.get("start") {
                Some(_) => quantity("start", Kind::Time, Range::Any),
                None => Quantity::new(0.0, "s").ok(),
            };
            let profile = match section.table.get("profile") {
                Some(_) => section.choice("profile", PROFILES, problems),
                None => Some(Profile::Smooth),
            };
            Some(Motion::Ramp {
                amplitude: amplitude?,
                start: start?,
                duration: duration?,
                profile: profile?,
            })
        }
        _ => {
            let form = table::Form::motion(kind);
            table::read_either(section, "file", "points", &form, tables, problems).map(Motion::Table)
        }
    }
}

impl Motion {
    /// Returns it as written in a case file, without the key; its values measure `kind`. In the units of a
    /// system, or as typed.
    pub(crate) fn to_toml_in(&self, kind: Kind, system: Option<System>) -> String {
        system.map_or_else(|| self.to_toml(), |system| self.in_system(kind, system).to_toml())
    }

    /// Returns the same motion, its quantities in the units of a system.
    fn in_system(&self, kind: Kind, system: System) -> Self {
        let mut own = self.clone();
        match &mut own {
            Motion::Constant(value)
            | Motion::Sine { amplitude: value, .. }
            | Motion::Triangle { amplitude: value, .. }
            | Motion::SweptSine { amplitude: value, .. }
            | Motion::Ramp { amplitude: value, .. } => *value = in_system(value, kind, system),
            Motion::Table(table) => *table = table.in_system([Kind::Time, kind], system),
            Motion::Sum(parts) => {
                for part in parts {
                    *part = part.in_system(kind, system);
                }
            }
            Motion::From { motion, .. } => **motion = motion.in_system(kind, system),
        }
        own
    }

    /// Returns it as written in a case file, without the key.
    pub(super) fn to_toml(&self) -> String {
        let text = |quantity: &Quantity| toml::Value::from(quantity.text()).to_string();
        let shape = |shape: &str, values: &[(&str, String)]| {
            let mut line = format!("{{ shape = \"{shape}\"");
            for (key, value) in values {
                // Writing to a String cannot fail.
                let _ = write!(line, ", {key} = {value}");
            }
            line + " }"
        };
        match self {
            Motion::Constant(value) => text(value),
            Motion::Sine {
                amplitude,
                frequency,
                phase,
            } => shape(
                "sine",
                &[
                    ("amplitude", text(amplitude)),
                    ("frequency", text(frequency)),
                    ("phase", text(phase)),
                ],
            ),
            Motion::Triangle { amplitude, frequency } => shape(
                "triangle",
                &[("amplitude", text(amplitude)), ("frequency", text(frequency))],
            ),
            Motion::SweptSine {
                amplitude,
                start_frequency,
                end_frequency,
                duration,
            } => shape(
                "swept_sine",
                &[
                    ("amplitude", text(amplitude)),
                    ("start_frequency", text(start_frequency)),
                    ("end_frequency", text(end_frequency)),
                    ("duration", text(duration)),
                ],
            ),
            Motion::Ramp {
                amplitude,
                start,
                duration,
                profile,
            } => shape(
                "ramp",
                &[
                    ("amplitude", text(amplitude)),
                    ("start", text(start)),
                    ("duration", text(duration)),
                    ("profile", format!("\"{}\"", name_of(PROFILES, profile))),
                ],
            ),
            Motion::Table(table) => match &table.file {
                Some(file) => shape("table", &[("file", toml::Value::from(file.as_str()).to_string())]),
                None => shape("table", &[("points", table.points_to_toml())]),
            },
            Motion::Sum(parts) => {
                let parts: Vec<String> = parts.iter().map(Motion::to_toml).collect();
                format!("[\n    {},\n]", parts.join(",\n    "))
            }
            Motion::From { start, motion } => {
                let line = motion.to_toml();
                let open = line.strip_suffix(" }").unwrap_or(&line);
                format!("{open}, start = {} }}", text(start))
            }
        }
    }

    /// Returns the quantities of its shape, by their keys; none of a held value, a table, or a sum.
    pub(super) fn parts(&self) -> Vec<(&'static str, &Quantity)> {
        match self {
            Motion::Sine {
                amplitude,
                frequency,
                phase,
            } => vec![
                ("amplitude", amplitude),
                ("frequency", frequency),
                ("phase", phase),
            ],
            Motion::Triangle { amplitude, frequency } => {
                vec![("amplitude", amplitude), ("frequency", frequency)]
            }
            Motion::SweptSine {
                amplitude,
                start_frequency,
                end_frequency,
                duration,
            } => vec![
                ("amplitude", amplitude),
                ("start_frequency", start_frequency),
                ("end_frequency", end_frequency),
                ("duration", duration),
            ],
            Motion::Ramp {
                amplitude,
                start,
                duration,
                ..
            } => vec![("amplitude", amplitude), ("start", start), ("duration", duration)],
            Motion::From { start, motion } => {
                let mut parts = motion.parts();
                parts.push(("start", start));
                parts
            }
            Motion::Constant(_) | Motion::Table(_) | Motion::Sum(_) => Vec::new(),
        }
    }

    /// Returns the tables in it, to be changed.
    pub(crate) fn tables_mut(&mut self) -> Vec<&mut QuantityTable> {
        match self {
            Motion::Table(table) => vec![table],
            Motion::Sum(parts) => parts.iter_mut().flat_map(Motion::tables_mut).collect(),
            Motion::From { motion, .. } => motion.tables_mut(),
            _ => Vec::new(),
        }
    }

    /// Returns the tables in it.
    pub(crate) fn tables(&self) -> Vec<&QuantityTable> {
        match self {
            Motion::Table(table) => vec![table],
            Motion::Sum(parts) => parts.iter().flat_map(Motion::tables).collect(),
            Motion::From { motion, .. } => motion.tables(),
            _ => Vec::new(),
        }
    }
}

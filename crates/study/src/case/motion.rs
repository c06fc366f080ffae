//! Motions as typed, and their reading.

use super::problem::{Problem, Problems};
use super::section::{self, CaseSection, Names, Range, name_of};
use super::table::{self, QuantityTable};
use super::tables::Tables;
use super::tree::{NodeValue, TreeNode};
use super::units::in_system;
use mechanics::motion::{Motion, Piece, RampProfile};
use mechanics::spline::Spline;
use quantity::{Kind, Quantity, System, nearest};
use std::fmt::Write;

/// The motion of one coordinate of a neighbour, as typed. Lengths or angles, by the coordinate.
#[derive(Clone, Debug, PartialEq)]
pub enum CaseMotion {
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
        profile: MotionProfile,
    },
    /// A cubic spline through time and value.
    Table(QuantityTable),
    /// A sum of motions.
    Sum(Vec<CaseMotion>),
    /// Nothing until a time, then a motion that counts its time from there.
    From {
        /// Its start.
        start: Quantity,
        /// The motion.
        motion: Box<CaseMotion>,
    },
}

/// The shape of a ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MotionProfile {
    /// Rate and acceleration are zero at both ends.
    Smooth,
    /// Constant rate.
    Linear,
    /// Half a period of a cosine: the rate is zero at both ends.
    HalfCosine,
}

/// Names of the profiles of ramps.
pub(crate) const PROFILES: Names<MotionProfile> = &[
    ("smooth", MotionProfile::Smooth),
    ("linear", MotionProfile::Linear),
    ("half_cosine", MotionProfile::HalfCosine),
];

/// The ways of writing a motion, as lines of comments in a case.
pub(crate) const SHAPES_WRITTEN: &str = "one held value, a list of motions to be added up, or one of\n\
    # { shape = \"sine\", amplitude, frequency, phase, start }         frequency in rad/s, Hz or rpm\n\
    # { shape = \"triangle\", amplitude, frequency, start }\n\
    # { shape = \"swept_sine\", amplitude, start_frequency, end_frequency, duration, start }   then \
    end_frequency\n\
    # { shape = \"ramp\", amplitude, start, duration, profile }            profile \"smooth\", \
    \"linear\" or \"half_cosine\"; then held\n\
    # { shape = \"table\", file = \"motion.csv\" }                            a cubic spline; or points = \
    [[time, value], ...]";

pub(crate) const SHAPES: [&str; 6] = ["constant", "sine", "triangle", "swept_sine", "ramp", "table"];
const EXAMPLE: &str = "write for example { shape = \"sine\", amplitude = \"1 in\", frequency = \"2 rad/s\" \
                       }, or one held value";

/// Reads a motion whose values measure `kind`. `tables` says where those in files lie.
pub(crate) fn read(
    node: &TreeNode,
    path: &str,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<CaseMotion> {
    match &node.value {
        NodeValue::List(items) if items.is_empty() => {
            let problem = Problem::new(format!("`{path}` is an empty sum of motions"));
            problems.push(problem.at(&node.place).label("nothing to add up").help(EXAMPLE));
            None
        }
        NodeValue::List(items) => {
            let mut parts = Vec::new();
            for (at, item) in items.iter().enumerate() {
                let path = format!("{path}[{at}]");
                if matches!(item.value, NodeValue::List(_)) {
                    let problem = Problem::new(format!("`{path}` is a list; a motion is expected"));
                    problems.push(problem.at(&item.place).label("a sum within a sum").help(EXAMPLE));
                } else {
                    parts.push(read(item, &path, kind, tables, problems));
                }
            }
            Some(CaseMotion::Sum(parts.into_iter().collect::<Option<_>>()?))
        }
        NodeValue::Table(table) => {
            let place = Some(node.place.clone());
            let section = CaseSection {
                path: path.into(),
                table,
                place,
            };
            read_shape(&section, kind, tables, problems)
        }
        _ => section::quantity(node, path, kind, Range::Any, problems).map(CaseMotion::Constant),
    }
}

fn read_shape(
    section: &CaseSection<'_>,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<CaseMotion> {
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
        return Some(CaseMotion::From {
            start: start?,
            motion,
        });
    }
    read_known_shape(shape, section, kind, tables, problems)
}

/// Reads a motion of this shape, without the time that it starts at.
fn read_known_shape(
    shape: &str,
    section: &CaseSection<'_>,
    kind: Kind,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<CaseMotion> {
    let mut quantity = |key: &str, kind, range| section.quantity(key, kind, range, problems);
    match shape {
        "constant" => Some(CaseMotion::Constant(quantity("value", kind, Range::Any)?)),
        "sine" | "triangle" => {
            let amplitude = quantity("amplitude", kind, Range::Any);
            let frequency = quantity("frequency", Kind::Frequency, Range::Positive);
            if shape == "triangle" {
                return Some(CaseMotion::Triangle {
                    amplitude: amplitude?,
                    frequency: frequency?,
                });
            }
            let phase = match section.table.get("phase") {
                Some(_) => quantity("phase", Kind::Angle, Range::Any),
                None => Quantity::new(0.0, "deg").ok(),
            };
            Some(CaseMotion::Sine {
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
            Some(CaseMotion::SweptSine {
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
                None => Some(MotionProfile::Smooth),
            };
            Some(CaseMotion::Ramp {
                amplitude: amplitude?,
                start: start?,
                duration: duration?,
                profile: profile?,
            })
        }
        _ => {
            let form = table::TableForm::motion(kind);
            table::read_either(section, "file", "points", &form, tables, problems).map(CaseMotion::Table)
        }
    }
}

impl CaseMotion {
    /// Returns it as written in a case file, without the key; its values measure `kind`. In the units of a
    /// system, or as typed.
    pub(crate) fn to_toml_in(&self, kind: Kind, system: Option<System>) -> String {
        system.map_or_else(|| self.to_toml(), |system| self.in_system(kind, system).to_toml())
    }

    /// Returns the same motion, its quantities in the units of a system.
    fn in_system(&self, kind: Kind, system: System) -> Self {
        let mut own = self.clone();
        match &mut own {
            CaseMotion::Constant(value)
            | CaseMotion::Sine { amplitude: value, .. }
            | CaseMotion::Triangle { amplitude: value, .. }
            | CaseMotion::SweptSine { amplitude: value, .. }
            | CaseMotion::Ramp { amplitude: value, .. } => *value = in_system(value, kind, system),
            CaseMotion::Table(table) => *table = table.in_system([Kind::Time, kind], system),
            CaseMotion::Sum(parts) => {
                for part in parts {
                    *part = part.in_system(kind, system);
                }
            }
            CaseMotion::From { motion, .. } => **motion = motion.in_system(kind, system),
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
            CaseMotion::Constant(value) => text(value),
            CaseMotion::Sine {
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
            CaseMotion::Triangle { amplitude, frequency } => shape(
                "triangle",
                &[("amplitude", text(amplitude)), ("frequency", text(frequency))],
            ),
            CaseMotion::SweptSine {
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
            CaseMotion::Ramp {
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
            CaseMotion::Table(table) => match &table.file {
                Some(file) => shape("table", &[("file", toml::Value::from(file.as_str()).to_string())]),
                None => shape("table", &[("points", table.points_to_toml())]),
            },
            CaseMotion::Sum(parts) => {
                let parts: Vec<String> = parts.iter().map(CaseMotion::to_toml).collect();
                format!("[\n    {},\n]", parts.join(",\n    "))
            }
            CaseMotion::From { start, motion } => {
                let line = motion.to_toml();
                let open = line.strip_suffix(" }").unwrap_or(&line);
                format!("{open}, start = {} }}", text(start))
            }
        }
    }

    /// Returns the quantities of its shape, by their keys; none of a held value, a table, or a sum.
    pub(super) fn parts(&self) -> Vec<(&'static str, &Quantity)> {
        match self {
            CaseMotion::Sine {
                amplitude,
                frequency,
                phase,
            } => vec![
                ("amplitude", amplitude),
                ("frequency", frequency),
                ("phase", phase),
            ],
            CaseMotion::Triangle { amplitude, frequency } => {
                vec![("amplitude", amplitude), ("frequency", frequency)]
            }
            CaseMotion::SweptSine {
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
            CaseMotion::Ramp {
                amplitude,
                start,
                duration,
                ..
            } => vec![("amplitude", amplitude), ("start", start), ("duration", duration)],
            CaseMotion::From { start, motion } => {
                let mut parts = motion.parts();
                parts.push(("start", start));
                parts
            }
            CaseMotion::Constant(_) | CaseMotion::Table(_) | CaseMotion::Sum(_) => Vec::new(),
        }
    }

    /// Returns the tables in it, to be changed.
    pub(crate) fn tables_mut(&mut self) -> Vec<&mut QuantityTable> {
        match self {
            CaseMotion::Table(table) => vec![table],
            CaseMotion::Sum(parts) => parts.iter_mut().flat_map(CaseMotion::tables_mut).collect(),
            CaseMotion::From { motion, .. } => motion.tables_mut(),
            _ => Vec::new(),
        }
    }

    /// Returns the tables in it.
    pub(crate) fn tables(&self) -> Vec<&QuantityTable> {
        match self {
            CaseMotion::Table(table) => vec![table],
            CaseMotion::Sum(parts) => parts.iter().flat_map(CaseMotion::tables).collect(),
            CaseMotion::From { motion, .. } => motion.tables(),
            _ => Vec::new(),
        }
    }
}

/// Returns a motion, SI.
pub(crate) fn to_si(typed: &CaseMotion) -> Result<Motion, String> {
    Ok(match typed {
        CaseMotion::Constant(value) => Motion::Constant(value.to_si()),
        CaseMotion::Sine {
            amplitude,
            frequency,
            phase,
        } => Motion::Sine {
            amplitude: amplitude.to_si(),
            angular_frequency: frequency.to_si(),
            phase: phase.to_si(),
        },
        CaseMotion::Triangle { amplitude, frequency } => Motion::Triangle {
            amplitude: amplitude.to_si(),
            angular_frequency: frequency.to_si(),
        },
        CaseMotion::SweptSine {
            amplitude,
            start_frequency,
            end_frequency,
            duration,
        } => Motion::SweptSine {
            amplitude: amplitude.to_si(),
            start: start_frequency.to_si(),
            end: end_frequency.to_si(),
            duration: duration.to_si(),
        },
        CaseMotion::Ramp {
            amplitude,
            start,
            duration,
            profile,
        } => Motion::Ramp {
            amplitude: amplitude.to_si(),
            start: start.to_si(),
            duration: duration.to_si(),
            profile: match profile {
                MotionProfile::Smooth => RampProfile::Smooth,
                MotionProfile::Linear => RampProfile::Linear,
                MotionProfile::HalfCosine => RampProfile::HalfCosine,
            },
        },
        CaseMotion::Table(table) => Motion::Table(spline(table)?),
        CaseMotion::Sum(parts) => Motion::Sum(parts.iter().map(to_si).collect::<Result<_, _>>()?),
        CaseMotion::From { start, motion: own } => Motion::Sequence(vec![Piece {
            start: start.to_si(),
            motion: to_si(own)?,
        }]),
    })
}

fn spline(table: &QuantityTable) -> Result<Spline, String> {
    let (times, values) = table
        .rows
        .iter()
        .map(|[time, value]| (time.to_si(), value.to_si()))
        .unzip();
    Spline::new(times, values).map_err(|error| error.to_string())
}

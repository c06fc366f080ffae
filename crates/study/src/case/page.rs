//! A case as a complete, commented case file, and as fields: written line by line as it is read.

use super::field::{Field, FieldSection, Reach, Written};
use super::motion::{CaseMotion, PROFILES};
use super::table::QuantityTable;
use quantity::Kind;
use std::fmt::Write;

/// Angles of wedges that are thought of first, 15 to 55 deg, rad.
pub(crate) const ANGLES: Reach = Reach::Between(0.261_799_387_799_149_4, 0.959_931_088_596_881_3);
/// A depth of wear that is thought of first, m.
pub(crate) const WEAR: f64 = 0.25 * 0.0254;
/// A toe or turn that is thought of first, rad.
pub(crate) const TURN: f64 = 0.02;
pub(crate) const FRICTION: Reach = Reach::Between(0.0, 1.0);

/// Fields of the quantities of a motion, also of each part of a sum: `vertical.amplitude`,
/// `vertical.0.amplitude`.
pub(crate) fn write_motion(page: &mut Page, path: &str, motion: &CaseMotion, kind: Kind, most: f64) {
    let signed = Reach::Signed(most);
    for (part, value) in motion.parts() {
        let written = match part {
            "amplitude" => Written::quantity(value, kind, signed),
            "phase" => Written::quantity(value, Kind::Angle, Reach::Signed(std::f64::consts::PI)),
            "start" => Written::quantity(value, Kind::Time, Reach::FromZero(1.0)),
            "duration" => Written::quantity(value, Kind::Time, Reach::Positive),
            _ => Written::quantity(value, Kind::Frequency, Reach::Positive),
        };
        page.field(&format!("{path}.{part}"), &written, "");
    }
    match motion {
        CaseMotion::Ramp { profile, .. } => {
            page.field(
                &format!("{path}.profile"),
                &Written::choice(PROFILES, profile),
                "",
            );
        }
        CaseMotion::Table(table) if table.file.is_none() => {
            write_points(page, &format!("{path}.points"), table, kind, signed);
        }
        CaseMotion::Sum(parts) => {
            for (number, part) in parts.iter().enumerate() {
                let path = format!("{path}.{number}");
                match part {
                    CaseMotion::Constant(value) => {
                        page.field(&path, &Written::quantity(value, kind, signed), "");
                    }
                    _ => write_motion(page, &path, part, kind, most),
                }
            }
        }
        _ => {}
    }
}

/// A table with more points than this has no fields of its own for them.
const POINTS: usize = 12;

/// Fields of the second column of a table in the case: `points.3.1`.
pub(crate) fn write_points(page: &mut Page, path: &str, table: &QuantityTable, kind: Kind, reach: Reach) {
    if table.file.is_some() || table.rows.len() > POINTS {
        return;
    }
    for (number, [_, value]) in table.rows.iter().enumerate() {
        page.field(
            &format!("{path}.{number}.1"),
            &Written::quantity(value, kind, reach),
            "",
        );
    }
}

/// Returns a comment of several lines without the signs that begin them.
pub(crate) fn uncommented(comment: &str) -> String {
    comment.replace("\n# ", "\n")
}

/// The text and the fields so far.
#[derive(Default)]
pub(crate) struct Page {
    pub text: String,
    pub sections: Vec<FieldSection>,
}

/// Comments begin in this column where the value leaves room.
const COMMENT_COLUMN: usize = 40;

/// A comment that would make the line longer than this goes above it.
const WIDEST: usize = 118;

impl Page {
    // Writing to a String cannot fail, so results of `write!` are dropped below.

    pub fn section(&mut self, name: &str, about: &str) {
        self.text.push('\n');
        if !about.is_empty() {
            self.comment(about);
        }
        let _ = writeln!(self.text, "[{name}]");
        self.sections.push(FieldSection {
            name: name.to_owned(),
            about: uncommented(about),
            fields: Vec::new(),
        });
    }

    fn comment(&mut self, comment: &str) {
        let _ = writeln!(self.text, "# {comment}");
    }

    pub fn line(&mut self, key: &str, value: Written, comment: &str) {
        self.field(key, &value, comment);
        let line = format!("{key} = {}", value.toml);
        if comment.is_empty() {
            let _ = writeln!(self.text, "{line}");
        } else if line.contains('\n') || line.len().max(COMMENT_COLUMN) + comment.len() > WIDEST {
            self.comment(comment);
            let _ = writeln!(self.text, "{line}");
        } else {
            let _ = writeln!(self.text, "{line:<COMMENT_COLUMN$} # {comment}");
        }
    }

    /// A key that is left out, with an example.
    pub fn absent(&mut self, key: &str, example: &str, comment: &str) {
        self.comment(comment);
        self.comment(&format!("{key} = {example}"));
        self.field(key, &Written::toml(String::new()), comment);
    }

    /// A field that is no line of its own.
    pub fn field(&mut self, key: &str, value: &Written, comment: &str) {
        if self.sections.is_empty() {
            self.sections.push(FieldSection {
                name: String::new(),
                about: String::new(),
                fields: Vec::new(),
            });
        }
        if let Some(section) = self.sections.last_mut() {
            let path = match section.name.as_str() {
                "" => key.to_owned(),
                name => format!("{name}.{key}"),
            };
            section.fields.push(Field {
                path,
                help: comment.to_owned(),
                text: value.typed(),
                input: value.input.clone(),
            });
        }
    }
}

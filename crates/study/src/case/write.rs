//! A document as a complete, commented case file.

use super::document::{
    ActsAt, CaseDocument, CoilForce, Coordinate, DIRECTIONS, Damping, FrictionLaw, METHODS, NeighbourSection,
    PROFILES, SYSTEMS, Start, Toe, ToeDirection,
};
use super::face::{self, FaceSection};
use super::field::{Field, FieldSection, Input, Reach, TypedNumber, Written, quoted};
use super::motion::CaseMotion;
use super::table::QuantityTable;
use quantity::{Kind, System};
use std::fmt::Write;

impl CaseDocument {
    /// Returns the whole case as TOML: every key, in groups, each with what it means, and with the reason
    /// where the thesis leaves a choice. Reads back to the same document and the same SI bits.
    pub fn to_toml(&self) -> String {
        self.written().text
    }

    /// Returns the whole case as fields, in the order of [`CaseDocument::to_toml`] and with its texts.
    pub fn fields(&self) -> Vec<FieldSection> {
        self.written().sections
    }

    fn written(&self) -> Page {
        let mut page = Page::default();
        page.line(
            "name",
            Written::text(&self.name),
            "a folder name: results go there",
        );
        page.line("title", Written::text(&self.title), "one line for people");
        self.write_wedge(&mut page);
        self.write_coil(&mut page);
        self.write_contact_and_friction(&mut page);
        for ((name, about), face) in face::SECTIONS.into_iter().zip(face::ABOUT).zip(&self.faces) {
            page.section(name, about);
            for line in face.lines() {
                match line.value {
                    Some(value) => page.line(line.key, value, line.comment),
                    None => page.absent(line.key, line.example, line.comment),
                }
            }
        }
        self.write_neighbours(&mut page);
        self.write_simulation(&mut page);
        page
    }

    /// Returns the same case with the points of tables from files written into it, so that it runs from
    /// anywhere.
    #[must_use]
    pub fn with_tables_embedded(mut self) -> Self {
        let motions = self
            .side_frame
            .coordinates
            .iter_mut()
            .chain(&mut self.bolster.coordinates);
        for table in motions.flat_map(|motion| motion.tables_mut()) {
            table.file = None;
        }
        for file in self.faces.iter_mut().flat_map(FaceSection::files_mut) {
            *file = None;
        }
        if let CoilForce::Table(table) = &mut self.control_coil.force {
            table.file = None;
        }
        self
    }

    fn write_wedge(&self, page: &mut Page) {
        let wedge = &self.wedge;
        page.section(
            "wedge",
            "The wedge: a right triangular prism. x is longitudinal (from the column towards the \
             bolster), y lateral, z up.",
        );
        page.line(
            "damping",
            Written::choice(Damping::NAMES, &wedge.damping),
            "\"variable\": the coil stands on the side frame; \"constant\": in the bolster",
        );
        page.line(
            "angle",
            Written::quantity(&wedge.angle, Kind::Angle, ANGLES),
            "between the slope and the vertical",
        );
        page.line(
            "height",
            Written::quantity(&wedge.height, Kind::Length, Reach::Positive),
            "of the vertical face",
        );
        page.line(
            "width",
            Written::quantity(&wedge.width, Kind::Length, Reach::Positive),
            "across the track",
        );
        page.line(
            "weight",
            Written::quantity(&wedge.weight, Kind::Force, Reach::Positive),
            "a force; the mass is the weight over standard gravity",
        );
        page.line(
            "inertia",
            Written::triple(&wedge.inertia, Kind::Inertia, Reach::Positive),
            "roll, pitch, yaw. The thesis gives no unit; lb in^2 is the only plausible one",
        );
        page.line(
            "center_of_gravity",
            Written::triple(&wedge.center_of_gravity, Kind::Length, Reach::Signed(0.0254)),
            "from the point above the coil. It is taken as the prism's centroid, which places \
             the faces",
        );
        wedge.rise.write(page, [&wedge.column_wear, &wedge.slope_wear]);
        page.line(
            "free_coordinates",
            Written::several(Coordinate::NAMES, &wedge.free_coordinates),
            "of x, y, z, roll, pitch, yaw; the others are held",
        );
    }

    fn write_coil(&self, page: &mut Page) {
        let coil = &self.control_coil;
        page.section("control_coil", "The control coil.");
        match &coil.force {
            CoilForce::Stiffness(stiffness) => {
                page.line(
                    "stiffness",
                    Written::quantity(stiffness, Kind::Stiffness, Reach::Positive),
                    "or table = [[compression, force], ...] or table = \"coil.csv\"",
                );
            }
            CoilForce::Table(table) => {
                let kinds = [Kind::Length, Kind::Force];
                let written = |system: Option<System>| match (&table.file, system) {
                    (Some(file), _) => quoted(file),
                    (None, None) => table.points_to_toml(),
                    (None, Some(system)) => table.in_system(kinds, system).points_to_toml(),
                };
                page.line(
                    "table",
                    Written::toml_in_units(written),
                    "compression and force; straight between the points",
                );
                write_points(page, "table", table, kinds[1], Reach::FromZero(4448.0));
            }
        }
        page.line(
            "free_length",
            Written::quantity(&coil.free_length, Kind::Length, Reach::Positive),
            "without force",
        );
        let preload = match self.wedge.damping {
            super::Damping::Variable => "in the nominal position; the thesis: just free",
            super::Damping::Constant => {
                "in the nominal position; the thesis: 7.25 in - 3702.2/1979 in, \
                 a preload of 3702.2 lbf"
            }
        };
        page.line(
            "nominal_length",
            Written::quantity(&coil.nominal_length, Kind::Length, Reach::Positive),
            preload,
        );
        page.line(
            "damping",
            Written::quantity(&coil.damping, Kind::Damping, Reach::FromZero(2000.0)),
            "along the coil",
        );
        page.line(
            "rotational_damping",
            Written::quantity(
                &coil.rotational_damping,
                Kind::RotationalDamping,
                Reach::FromZero(1.0),
            ),
            "of the wedge's rotations; the thesis uses the same number as along the coil",
        );
        page.line(
            "acts_at",
            Written::choice(ActsAt::NAMES, &coil.acts_at),
            "\"center_of_gravity\": the thesis's moment equations hold no moment of the coil; or \
             \"seat\", with its moment",
        );
        page.line(
            "pulls",
            Written::truth(coil.pulls),
            "the thesis's coil pushes and pulls; false: it lifts off at its free length",
        );
    }

    fn write_contact_and_friction(&self, page: &mut Page) {
        let (contact, friction) = (&self.contact, &self.friction);
        page.section("contact", "Contact of the wedge's corners with column and slope.");
        page.line(
            "stiffness",
            Written::quantity(&contact.stiffness, Kind::Stiffness, Reach::Wide),
            "per corner. The thesis gives none; four of 2.5e5 lbf/in give its limits and \
             orderings",
        );
        page.line(
            "damping",
            Written::quantity(&contact.damping, Kind::Damping, Reach::FromZero(5000.0)),
            "per corner; never pulls. The thesis has none",
        );
        page.section(
            "friction",
            "Friction at the column (side frame) and at the slope (bolster).",
        );
        let law = if friction.column_law == friction.slope_law {
            Written::choice(FrictionLaw::NAMES, &friction.column_law)
        } else {
            let (column, slope) = (friction.column_law.name(), friction.slope_law.name());
            Written::toml(format!("{{ column = \"{column}\", slope = \"{slope}\" }}"))
        };
        page.line(
            "law",
            law,
            "\"tanh\" (the thesis's; creeps under load) or \"bristle\" (holds); or { column = \
             ..., slope = ... }",
        );
        page.line(
            "column",
            Written::number(friction.column, FRICTION),
            "coefficient of friction",
        );
        page.line(
            "slope",
            Written::number(friction.slope, FRICTION),
            "coefficient of friction",
        );
        page.line(
            "directions",
            Written::choice(DIRECTIONS, &friction.directions),
            "\"two\": against the slip; \"one\": along a face's line of travel alone, one tangent a face as \
             in the thesis's equations",
        );
        page.line(
            "reference_speed",
            Written::quantity(&friction.reference_speed, Kind::Speed, Reach::Wide),
            "tanh: below it friction fades. It is part of the result: ten times it moves the \
             forces by 20 to 30 %",
        );
        page.line(
            "bristle_stiffness",
            Written::quantity(&friction.bristle_stiffness, Kind::Stiffness, Reach::Wide),
            "bristle: tangential, per face. Not in the thesis: from the comparison program",
        );
        page.line(
            "bristle_damping",
            Written::quantity(&friction.bristle_damping, Kind::Damping, Reach::Wide),
            "bristle: tangential, per face. From the comparison program",
        );
    }

    fn write_neighbours(&self, page: &mut Page) {
        page.section(
            "side_frame",
            "The side frame. It may move in every coordinate; see [bolster] for motions.",
        );
        page.line(
            "toe",
            toe(&self.toe),
            "out: the gap between column and bolster opens downwards; in: it closes",
        );
        page.line(
            "toe_pivot",
            Written::quantity(&self.toe_pivot, Kind::Length, Reach::Signed(0.5)),
            "the column turns about a point so far above the middle of the wedge's face. The thesis does \
             not say",
        );
        write_neighbour(page, &self.side_frame, "the centre of the column");
        page.section(
            "bolster",
            "The bolster. A motion is one held value, a list of motions to be added up, or one of\n\
             # { shape = \"sine\", amplitude, frequency, phase, start }         frequency in rad/s, Hz or \
             rpm\n# { shape = \"triangle\", amplitude, frequency, start }\n\
             # { shape = \"swept_sine\", amplitude, start_frequency, end_frequency, duration }   then \
             end_frequency\n\
             # { shape = \"ramp\", amplitude, start, duration, profile }            \
             profile \"smooth\", \"linear\" or \"half_cosine\"; then held\n\
             # { shape = \"table\", file = \"motion.csv\" }                            a cubic spline; or \
             points = [[time, value], ...]",
        );
        write_neighbour(
            page,
            &self.bolster,
            "the pocket's centre: about the truck's, one wedge could not follow a yaw",
        );
    }

    fn write_simulation(&self, page: &mut Page) {
        let simulation = &self.simulation;
        page.section("environment", "");
        page.line(
            "gravity",
            Written::quantity(
                &self.environment.gravity,
                Kind::Acceleration,
                Reach::FromZero(9.80665),
            ),
            "standard gravity",
        );
        page.section("simulation", "How to run it.");
        page.line(
            "duration",
            Written::quantity(&simulation.duration, Kind::Time, Reach::Positive),
            "",
        );
        page.line(
            "output_interval",
            Written::quantity(&simulation.output_interval, Kind::Time, Reach::Positive),
            "time between two rows of the result; steps are chosen freely",
        );
        page.line(
            "relative_tolerance",
            Written::number(simulation.relative_tolerance, Reach::Wide),
            "of the integrator, between 0 and 1",
        );
        page.line(
            "start",
            Written::choice(Start::NAMES, &simulation.start),
            "\"rest\": nominal position, corners may start inside; \"touching\"; or \
             \"equilibrium\"",
        );
        page.line(
            "output_units",
            Written::choice(SYSTEMS, &simulation.output_units),
            "\"us\" (in, lbf) or \"si\" (m, N)",
        );
        page.line(
            "method",
            Written::choice(METHODS, &simulation.method),
            "\"rodas5p\"; \"tr-bdf2\" and \"esdirk3\" damp vibrations",
        );
    }
}

/// Angles of wedges that are thought of first, 15 to 55 deg, rad.
pub(crate) const ANGLES: Reach = Reach::Between(0.261_799_387_799_149_4, 0.959_931_088_596_881_3);
/// A depth of wear that is thought of first, m.
pub(crate) const WEAR: f64 = 0.25 * 0.0254;
/// A toe or turn that is thought of first, rad.
pub(crate) const TURN: f64 = 0.02;
pub(crate) const FRICTION: Reach = Reach::Between(0.0, 1.0);

pub(crate) fn toe(toe: &Toe) -> Written {
    let mut number = TypedNumber::of(&toe.angle, Kind::Angle, Reach::Signed(TURN));
    if toe.direction == Some(ToeDirection::In) {
        number.value = -number.value;
        number.si = -number.si;
    }
    number.signs = Some([ToeDirection::In, ToeDirection::Out].map(ToeDirection::name));
    Written {
        toml: quoted(&toe.text()),
        input: Input::Number(number),
    }
}

fn write_neighbour(page: &mut Page, section: &NeighbourSection, center: &str) {
    match &section.center {
        Some(point) => {
            let point = Written::triple(point, Kind::Length, Reach::Signed(0.0254));
            page.line("center", point, "the point it turns about");
        }
        None => page.absent(
            "center",
            r#"["0 in", "0 in", "0 in"]"#,
            &format!("the point it turns about; left out, {center}"),
        ),
    }
    for (at, (key, motion)) in NeighbourSection::COORDINATES
        .iter()
        .zip(&section.coordinates)
        .enumerate()
    {
        let (kind, most) = if at < 3 {
            (Kind::Length, 0.0254)
        } else {
            (Kind::Angle, TURN)
        };
        if let CaseMotion::Constant(value) = motion {
            page.line(key, Written::quantity(value, kind, Reach::Signed(most)), "");
            continue;
        }
        page.line(
            key,
            Written::toml_in_units(|system| motion.to_toml_in(kind, system)),
            "",
        );
        write_motion(page, key, motion, kind, most);
    }
}

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
fn write_points(page: &mut Page, path: &str, table: &QuantityTable, kind: Kind, reach: Reach) {
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
            about: about.replace("\n# ", "\n"),
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

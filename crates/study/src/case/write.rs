//! A document as a complete, commented case file.

use super::document::{CaseDocument, CoilForce, METHODS, NeighbourSection, SYSTEMS};
use super::section::name_of;
use quantity::Quantity;
use std::fmt::Write;

impl CaseDocument {
    /// The whole case as TOML: every key, in groups, each with what it means, and with the reason
    /// where the thesis leaves a choice. Reads back to the same document and the same SI bits.
    pub fn to_toml(&self) -> String {
        let mut page = Page::default();
        page.line("name", text(&self.name), "a folder name: results go there");
        page.line("title", text(&self.title), "one line for people");
        self.write_wedge(&mut page);
        self.write_coil(&mut page);
        self.write_contact_and_friction(&mut page);
        self.write_neighbours(&mut page);
        self.write_simulation(&mut page);
        page.text
    }

    /// The same case with the points of tables from files written into it, so that it runs from
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
            text(wedge.damping.name()),
            "\"variable\": the coil stands on the side frame; \"constant\": in the bolster",
        );
        page.line(
            "angle",
            quantity(&wedge.angle),
            "between the slope and the vertical",
        );
        page.line("height", quantity(&wedge.height), "of the vertical face");
        page.line("width", quantity(&wedge.width), "across the track");
        page.line(
            "weight",
            quantity(&wedge.weight),
            "a force; the mass is the weight over standard gravity",
        );
        page.line(
            "inertia",
            triple(&wedge.inertia),
            "roll, pitch, yaw. The thesis gives no unit; lb in^2 is the only plausible one",
        );
        page.line(
            "center_of_gravity",
            triple(&wedge.center_of_gravity),
            "from the point above the coil. It is taken as the prism's centroid, which places \
             the faces",
        );
        page.line(
            "column_wear",
            quantity(&wedge.column_wear),
            "what column and wedge have lost there, together: the column lies deeper by it",
        );
        page.line(
            "slope_wear",
            quantity(&wedge.slope_wear),
            "the same at the slope; a worn wedge rises. Begin with start = \"equilibrium\"",
        );
        let free: Vec<String> = wedge.free_coordinates.iter().map(|c| text(c.name())).collect();
        page.line(
            "free_coordinates",
            format!("[{}]", free.join(", ")),
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
                    quantity(stiffness),
                    "or table = [[compression, force], ...] or table = \"coil.csv\"",
                );
            }
            CoilForce::Table(table) => {
                let value = table
                    .file
                    .as_ref()
                    .map_or_else(|| table.points_to_toml(), |file| text(file));
                page.line(
                    "table",
                    value,
                    "compression and force; straight between the points",
                );
            }
        }
        page.line("free_length", quantity(&coil.free_length), "without force");
        let preload = match self.wedge.damping {
            super::Damping::Variable => "in the nominal position; the thesis: just free",
            super::Damping::Constant => {
                "in the nominal position; the thesis: 7.25 in - 3702.2/1979 in, \
                 a preload of 3702.2 lbf"
            }
        };
        page.line("nominal_length", quantity(&coil.nominal_length), preload);
        page.line("damping", quantity(&coil.damping), "along the coil");
        page.line(
            "rotational_damping",
            quantity(&coil.rotational_damping),
            "of the wedge's rotations; the thesis uses the same number as along the coil",
        );
        page.line(
            "acts_at",
            text(coil.acts_at.name()),
            "\"center_of_gravity\": the thesis's moment equations hold no moment of the coil; or \
             \"seat\", with its moment",
        );
        page.line(
            "pulls",
            coil.pulls.to_string(),
            "the thesis's coil pushes and pulls; false: it lifts off at its free length",
        );
    }

    fn write_contact_and_friction(&self, page: &mut Page) {
        let (contact, friction) = (&self.contact, &self.friction);
        page.section("contact", "Contact of the wedge's corners with column and slope.");
        page.line(
            "stiffness",
            quantity(&contact.stiffness),
            "per corner. The thesis gives none; four of 2.5e5 lbf/in give its limits and \
             orderings",
        );
        page.line(
            "damping",
            quantity(&contact.damping),
            "per corner; never pulls. The thesis has none",
        );
        page.section(
            "friction",
            "Friction at the column (side frame) and at the slope (bolster).",
        );
        let law = if friction.column_law == friction.slope_law {
            text(friction.column_law.name())
        } else {
            let (column, slope) = (friction.column_law.name(), friction.slope_law.name());
            format!("{{ column = \"{column}\", slope = \"{slope}\" }}")
        };
        page.line(
            "law",
            law,
            "\"tanh\" (the thesis's; creeps under load) or \"bristle\" (holds); or { column = \
             ..., slope = ... }",
        );
        page.line("column", number(friction.column), "coefficient of friction");
        page.line("slope", number(friction.slope), "coefficient of friction");
        page.line(
            "reference_speed",
            quantity(&friction.reference_speed),
            "tanh: below it friction fades. It is part of the result: ten times it moves the \
             forces by 20 to 30 %",
        );
        page.line(
            "bristle_stiffness",
            quantity(&friction.bristle_stiffness),
            "bristle: tangential, per face. Not in the thesis: from the comparison program",
        );
        page.line(
            "bristle_damping",
            quantity(&friction.bristle_damping),
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
            text(&self.toe.text()),
            "out: the gap between column and bolster opens downwards; in: it closes",
        );
        write_neighbour(page, &self.side_frame, "the centre of the column");
        page.section(
            "bolster",
            "The bolster. A motion is one held value, a list of motions to be added up, or one of\n\
             # { shape = \"sine\", amplitude, frequency, phase }                frequency in rad/s, Hz or rpm\n\
             # { shape = \"triangle\", amplitude, frequency }\n\
             # { shape = \"swept_sine\", amplitude, start_frequency, end_frequency, duration }   then end_frequency\n\
             # { shape = \"ramp\", amplitude, start, duration, profile }            profile \"smooth\" or \"linear\"; then held\n\
             # { shape = \"table\", file = \"motion.csv\" }                            a cubic spline; \
             or points = [[time, value], ...]",
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
        page.line("gravity", quantity(&self.environment.gravity), "standard gravity");
        page.section("simulation", "How to run it.");
        page.line("duration", quantity(&simulation.duration), "");
        page.line(
            "output_interval",
            quantity(&simulation.output_interval),
            "time between two rows of the result; steps are chosen freely",
        );
        page.line(
            "relative_tolerance",
            number(simulation.relative_tolerance),
            "of the integrator, between 0 and 1",
        );
        page.line(
            "start",
            text(simulation.start.name()),
            "\"rest\": nominal position, corners may start inside; \"touching\"; or \
             \"equilibrium\"",
        );
        page.line(
            "output_units",
            text(name_of(SYSTEMS, &simulation.output_units)),
            "\"us\" (in, lbf) or \"si\" (m, N)",
        );
        page.line(
            "method",
            text(name_of(METHODS, &simulation.method)),
            "\"rodas4\", \"rodas42\", \"rodas4p\", \"rodas4p2\" or \"rodas5p\"",
        );
    }
}

fn write_neighbour(page: &mut Page, section: &NeighbourSection, center: &str) {
    match &section.center {
        Some(point) => page.line("center", triple(point), "the point it turns about"),
        None => {
            page.comment(&format!("the point it turns about; left out, {center}"));
            page.comment("center = [\"0 in\", \"0 in\", \"0 in\"]");
        }
    }
    for (key, motion) in NeighbourSection::COORDINATES.iter().zip(&section.coordinates) {
        page.line(key, motion.to_toml(), "");
    }
}

/// The text so far.
#[derive(Default)]
struct Page {
    text: String,
}

/// Comments begin in this column where the value leaves room.
const COMMENT_COLUMN: usize = 40;

/// A comment that would make the line longer than this goes above it.
const WIDEST: usize = 118;

impl Page {
    // Writing to a String cannot fail, so results of `write!` are dropped below.

    fn section(&mut self, name: &str, about: &str) {
        self.text.push('\n');
        if !about.is_empty() {
            self.comment(about);
        }
        let _ = writeln!(self.text, "[{name}]");
    }

    fn comment(&mut self, comment: &str) {
        let _ = writeln!(self.text, "# {comment}");
    }

    fn line(&mut self, key: &str, value: String, comment: &str) {
        let line = format!("{key} = {value}");
        if comment.is_empty() {
            let _ = writeln!(self.text, "{line}");
        } else if line.contains('\n') || line.len().max(COMMENT_COLUMN) + comment.len() > WIDEST {
            self.comment(comment);
            let _ = writeln!(self.text, "{line}");
        } else {
            let _ = writeln!(self.text, "{line:<COMMENT_COLUMN$} # {comment}");
        }
    }
}

fn text(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn quantity(quantity: &Quantity) -> String {
    text(quantity.text())
}

fn triple(quantities: &[Quantity; 3]) -> String {
    let [a, b, c] = quantities.each_ref().map(quantity);
    format!("[{a}, {b}, {c}]")
}

/// The shortest decimal that reads back to the same bits.
fn number(number: f64) -> String {
    format!("{number:?}")
}

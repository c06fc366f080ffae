//! The sections of a single wedge's case, key by key.

use quantity::Kind;
use wedge::face::FaceProperties;
use wedge::parameters::{Contact, Damping, Parameters, WedgeBody};

use super::coil::thesis_coil;
use super::face::{self, FaceSection};
use super::field::Reach;
use super::friction::Laws;
use super::model::Model;
use super::motion;
use super::names::{DAMPINGS, DIRECTIONS, Law, STARTS};
use super::page::ANGLES;
use super::problem::{Problem, Problems, TomlSource};
use super::rise::{RiseSection, check_thickness};
use super::section::Range;
use super::toe::Toe;
use super::tree::{self, TableNode};
use super::{Case, Simulation};
use crate::reader::{CaseReader, DAMPING, LENGTH, QuantityForm, STIFFNESS, check_motions};

/// Wedge angles that make sense.
pub(crate) const ANGLE: Range = Range::Between(
    0.0,
    std::f64::consts::FRAC_PI_2,
    "between 0 deg and 90 deg, both excluded",
);
const GRAVITY: QuantityForm = (Kind::Acceleration, Range::NotNegative, Reach::FromZero(9.80665));
const PLACE: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(0.0254));
const INERTIA: QuantityForm = (Kind::Inertia, Range::Positive, Reach::Positive);
/// lbf/in, in N/m.
const POUND_PER_INCH: f64 = 4.448_221_615_260_5 / 0.0254;
/// Stiffness and damping of a bristle, N/m and N·s/m.
const BRISTLE: [f64; 2] = [1e6 * POUND_PER_INCH, 1e3 * POUND_PER_INCH];

/// The name of values that the case leaves out, as a source.
const DEFAULTS: &str = "the thesis's values";

/// The bolster's motion in the thesis's runs, which completes a motion of the same shape.
const BOLSTER: &str = "[bolster]\nvertical = { shape = \"sine\", amplitude = \"1 in\", frequency = \
                       \"2 rad/s\", phase = \"0 deg\" }\n";

/// Keys and tables that only trucks and cars have, beside those that a single wedge has too, and why.
const OF_TRUCKS: [(&str, &str, &str); 3] = [
    (
        "wedge",
        "kind",
        "a single wedge is always one rigid body; `wedgelab quasi-static` tells of a massless one",
    ),
    (
        "wedge",
        "slope_across",
        "a slope across pushes the wedge against a side of its pocket, and a single wedge has none",
    ),
    ("", "split", "a single wedge is one rigid body"),
];

/// Completes a motion of the bolster that has the shape of the thesis's.
pub(super) fn complete(tree: &mut TableNode, problems: &mut Problems) {
    match tree::parse(&TomlSource::new(DEFAULTS, BOLSTER)) {
        Ok(usual) => tree.complete_from(&usual),
        Err(broken) => problems.append(broken),
    }
}

/// Reads a case, section by section.
pub(super) fn case(r: &mut CaseReader<'_>, default_name: &str) -> Option<Case> {
    let nothing_given = !r.gives_values(DEFAULTS);
    let comment = "a single wedge; or \"truck\" or \"car\"";
    let [name, title] = r.head(default_name, Model::Wedge, comment)?;
    for (section, key, why) in OF_TRUCKS {
        of_trucks(r, section, key, why);
    }
    r.section(
        "wedge",
        "The wedge: a right triangular prism. x is longitudinal (from the column towards the bolster), y \
         lateral, z up.",
    );
    let mut damping = Damping::Variable;
    let comment = "\"variable\": the coil stands on the side frame; \"constant\": in the bolster";
    r.choice("damping", DAMPINGS, &mut damping, comment);
    let mut own = wedge::thesis::parameters(damping, 0.0, 0.0);
    let mut rise = RiseSection::default();
    body(r, &mut own, &mut rise);
    r.section("control_coil", "The control coil.");
    thesis_coil(r, &mut own.coil, damping);
    r.section("contact", "Contact of the wedge's corners with column and slope.");
    let comment = "per corner. The thesis gives none; four of 2.5e5 lbf/in give its limits and orderings";
    contact(r, &mut own.contact, comment);
    friction(r, &mut own);
    faces(r, &mut own);
    r.section(
        "side_frame",
        "The side frame. It may move in every coordinate; see [bolster] for motions.",
    );
    own.toe = Toe::read(r, own.toe);
    let pivot = (Kind::Length, Range::Any, Reach::Signed(0.5));
    let comment = "the column turns about a point so far above the middle of the wedge's face. The thesis \
                   does not say";
    r.quantity("toe_pivot", pivot, &mut own.toe_pivot, comment);
    let center = "the point it turns about; left out, the centre of the column";
    r.motions(&mut own.side_frame, false, center);
    let about = format!("The bolster. A motion is {}", motion::SHAPES_WRITTEN);
    r.section("bolster", &about);
    let center = "the point it turns about; left out, the pocket's centre: about the truck's, one wedge \
                  could not follow a yaw";
    r.motions(&mut own.bolster, false, center);
    if let Some(wear) = rise.wear([own.wedge.angle, own.toe, 0.0]) {
        own.wear = wear;
    }
    r.section("environment", "");
    r.quantity("gravity", GRAVITY, &mut own.gravity, "standard gravity");
    let simulation = simulation(r, &mut own);
    let text = r.finish("a case");
    if r.problems.is_empty()
        && let Err(error) = own.validate()
    {
        let problem = Problem::new(format!("`{}`: {error}", error.path));
        r.problem(
            error.path,
            problem.help("see `wedgelab case` for a case that is valid"),
        );
    }
    Some(Case {
        name,
        title,
        parameters: own,
        simulation,
        nothing_given,
        text,
    })
}

/// Notes a key, or a table, that only trucks and cars have.
fn of_trucks(r: &mut CaseReader<'_>, section: &str, key: &'static str, why: &str) {
    let (path, what) = match section {
        "" => (key.to_owned(), "a table"),
        section => (format!("{section}.{key}"), "a key"),
    };
    if r.has(&path) {
        let problem = Problem::new(format!("`{path}` is {what} of trucks and cars: {why}"));
        let help = "leave it out, or write model = \"truck\" in the first line";
        r.problem_at_key(&path, problem.label("of another model").help(help));
        r.expect(section, &[key]);
    }
}

fn body(r: &mut CaseReader<'_>, own: &mut Parameters, rise: &mut RiseSection) {
    let WedgeBody {
        angle,
        height,
        width,
        mass,
        inertia,
        center_of_gravity,
        free,
    } = &mut own.wedge;
    let comment = "between the slope and the vertical";
    r.quantity("angle", (Kind::Angle, ANGLE, ANGLES), angle, comment);
    r.quantity("height", LENGTH, height, "of the vertical face");
    r.quantity("width", LENGTH, width, "across the track");
    r.weight(mass, "a force; the mass is the weight over standard gravity");
    let comment = "roll, pitch, yaw. The thesis gives no unit; lb in^2 is the only plausible one";
    r.triple_in("lb in^2", "inertia", INERTIA, inertia, comment);
    let comment =
        "from the point above the coil. It is taken as the prism's centroid, which places the faces";
    r.triple("center_of_gravity", PLACE, center_of_gravity, comment);
    let angles = [*angle, 0.0, 0.0];
    rise.read(r, &mut own.wear, angles);
    check_thickness(r, [*height, *angle], &rise.wear(angles).unwrap_or(own.wear));
    let comment = "of x, y, z, roll, pitch, yaw; the others are held";
    r.free_coordinates(free, Some("the wedge could not move"), comment);
}

/// Reads the contact of corners, or of anything else that pushes and never pulls.
pub(crate) fn contact(r: &mut CaseReader<'_>, contact: &mut Contact, of: &str) {
    r.quantity("stiffness", STIFFNESS, &mut contact.stiffness, of);
    r.quantity(
        "damping",
        DAMPING,
        &mut contact.damping,
        "the same; it never pulls",
    );
}

fn friction(r: &mut CaseReader<'_>, own: &mut Parameters) {
    r.section(
        "friction",
        "Friction at the column (side frame) and at the slope (bolster).",
    );
    let mut laws = Laws::new(Law::Tanh, BRISTLE);
    laws.read(r, [&mut own.column_friction, &mut own.slope_friction]);
    own.column_friction.law = laws.law(0);
    own.slope_friction.law = laws.law(1);
    let comment = "\"two\": against the slip; \"one\": along a face's line of travel alone, one tangent a \
                   face as in the thesis's equations";
    r.choice(
        "directions",
        DIRECTIONS,
        &mut own.column_face.friction_directions,
        comment,
    );
    own.slope_face.friction_directions = own.column_face.friction_directions;
}

fn faces(r: &mut CaseReader<'_>, own: &mut Parameters) {
    let faces = [&mut own.column_face, &mut own.slope_face];
    for ((name, about), face) in face::SECTIONS.into_iter().zip(face::ABOUT).zip(faces) {
        r.section(name, about);
        let mut section = FaceSection::default();
        r.face(&mut section);
        match section.resolve() {
            Ok(resolved) => {
                *face = FaceProperties {
                    friction_directions: face.friction_directions,
                    ..resolved
                };
            }
            Err((key, error)) => {
                let path = r.path(key);
                r.problem_at(&path, Problem::new(format!("`{path}`: {error}")));
            }
        }
    }
}

fn simulation(r: &mut CaseReader<'_>, own: &mut Parameters) -> Simulation {
    let interval = "time between two rows of the result; steps are chosen freely";
    let (simulation, duration) = r.simulation(
        Simulation::default(),
        interval,
        "\"us\" (in, lbf) or \"si\" (m, N)",
    );
    let comment = "\"rest\": nominal position, corners may start inside; \"touching\"; or \"equilibrium\"";
    r.choice("start", STARTS, &mut own.start, comment);
    if let Some(duration) = &duration {
        check_motions(r, duration);
    }
    simulation
}

//! The sections of the wedges: for all four, and for single ones over them.

use mechanics::friction::FrictionLaw;
use quantity::Kind;
use truck::coils;
use truck::{
    CROWN_RADIUS, ControlCoil, Geometry, Parameters, SERVICE_GRID, Spring, WEDGE_NAMES, Wedge, WedgeKind,
};
use wedge::face::{FaceDirection, Rectangle};
use wedge::parameters::{ControlCoil as ThesisCoil, Damping};

use super::control_coils::{CoilKind, Named, thesis_coil};
use super::sections::{Condition, columns, wedge_places};
use super::wedge_kinds::ACROSS;
use crate::case::face::{self, FaceSection};
use crate::case::face_values::Surface;
use crate::case::field::Reach;
use crate::case::friction::Laws;
use crate::case::names::Law;
use crate::case::page::ANGLES;
use crate::case::problem::Problem;
use crate::case::read::{ANGLE, contact};
use crate::case::rise::{RiseSection, check_thickness};
use crate::case::section::{Names, Range};
use crate::case::toe::Toe;
use crate::reader::{CLEARANCE, CaseReader, DAMPING, LENGTH, STIFFNESS};

/// A wedge while its sections are read: laws of friction keep their numbers while another one is chosen.
#[derive(Clone)]
pub(crate) struct Draft {
    pub(super) wedge: Wedge,
    laws: Laws,
    /// Where its control coil stands.
    pub(super) damping: Damping,
    pub(super) kind: CoilKind,
    pub(super) spring: Spring,
    pub(super) thesis: ThesisCoil,
    pub(super) to_center: [f64; 3],
    faces: [FaceSection; 2],
    rise: RiseSection,
    /// The catalog of coils, and what is taken of it.
    pub(super) known: Vec<coils::CoilKind>,
    pub(super) named: Named,
}

/// Returns the faces of wedges in service, column and slope: see [`Parameters::in_service`].
fn in_service() -> [FaceSection; 2] {
    let column = FaceSection {
        grid: SERVICE_GRID,
        ..FaceSection::default()
    };
    let slope = FaceSection {
        wedge_surface: Surface::crown(CROWN_RADIUS, FaceDirection::Across),
        ..column.clone()
    };
    [column, slope]
}

impl Draft {
    fn new(parameters: &Parameters, friction: f64, known: &[coils::CoilKind]) -> Self {
        let [wedge, ..] = &parameters.wedges;
        let mut wedge = wedge.clone();
        wedge.column_friction.coefficient = friction;
        wedge.slope_friction.coefficient = friction;
        wedge.split.friction.coefficient = friction;
        let (thesis, to_center) = thesis_coil(parameters.damping);
        let spring = match wedge.control_coil {
            ControlCoil::Shear(spring) => spring,
            ControlCoil::Thesis(..) | ControlCoil::Table(_) | ControlCoil::Nothing => Spring::default(),
        };
        let bristle = match wedge.column_friction.law {
            FrictionLaw::Bristle { stiffness, damping } => [stiffness, damping],
            FrictionLaw::Tanh { .. } => [0.0; 2],
        };
        let named = Named::usual(parameters.damping, &spring, &thesis);
        Self {
            wedge,
            laws: Laws::new(Law::Bristle, bristle),
            damping: parameters.damping,
            kind: CoilKind::Shear,
            spring,
            thesis,
            to_center,
            faces: in_service(),
            rise: RiseSection::default(),
            known: known.to_vec(),
            named,
        }
    }

    fn finished(self) -> Wedge {
        let mut wedge = self.wedge;
        if let Some(wear) = self.rise.wear(wedge.rise_angles()) {
            wedge.wear = wear;
        }
        wedge.column_friction.law = self.laws.law(0);
        wedge.slope_friction.law = self.laws.law(1);
        wedge.split.friction.law = self.laws.law(1);
        // What cannot be resolved was noted where it was read.
        let [column, slope] = self
            .faces
            .each_ref()
            .map(|face| face.resolve().unwrap_or_default());
        (wedge.column_face, wedge.slope_face) = (column, slope);
        wedge.control_coil = match self.kind {
            CoilKind::Shear | CoilKind::Named => ControlCoil::Shear(self.spring),
            CoilKind::Thesis => ControlCoil::Thesis(self.thesis, self.to_center),
            CoilKind::Nothing => ControlCoil::Nothing,
        };
        wedge
    }

    /// Checks the faces, whose sections stand below this path.
    fn check_faces(&self, r: &mut CaseReader<'_>, path: &str) {
        let wedge = &self.wedge;
        let bottom = wedge.height * libm::tan(wedge.angle);
        let width = match wedge.kind {
            WedgeKind::Split => 0.5 * wedge.width,
            WedgeKind::Body | WedgeKind::Massless => wedge.width,
        };
        for (number, (face, name)) in self.faces.iter().zip(face::SECTIONS).enumerate() {
            let rectangle = Rectangle {
                lower: [if number == 0 { 0.0 } else { bottom }, 0.0],
                upper: [0.0, wedge.height],
                width,
                faces_backward: number == 0,
            };
            let wrong = match face.resolve() {
                Err((key, error)) => Some((format!("{name}.{key}"), error.to_string())),
                Ok(own) => own
                    .validate(&rectangle, number)
                    .err()
                    .map(|error| (error.path.to_owned(), error.to_string())),
            };
            if let Some((key, reason)) = wrong {
                r.problem(
                    &format!("{path}{key}"),
                    Problem::new(reason).label("out of range"),
                );
            }
            let usual = [&in_service()[number], &FaceSection::default()].contains(&face);
            if wedge.kind == WedgeKind::Massless && !usual {
                let message = format!("`{path}{name}` is of no effect: a massless wedge has no faces");
                let help = "leave it out, or write wedge.kind = \"body\"";
                r.problem(
                    &format!("{path}{name}"),
                    Problem::new(message).label("no effect").help(help),
                );
            }
        }
    }

    fn toe(&mut self, r: &mut CaseReader<'_>) {
        self.wedge.toe = Toe::read(r, self.wedge.toe);
    }

    fn body(&mut self, r: &mut CaseReader<'_>) {
        let wedge = &mut self.wedge;
        const KINDS: Names<WedgeKind> = &[
            ("body", WedgeKind::Body),
            ("massless", WedgeKind::Massless),
            ("split", WedgeKind::Split),
        ];
        let comment = "\"body\": a rigid body with faces in contact; \"massless\": the industry's \
                       quasi-static element; \"split\": two halves beside each other";
        r.choice("kind", KINDS, &mut wedge.kind, comment);
        let angle = (Kind::Angle, ANGLE, ANGLES);
        r.quantity(
            "angle",
            angle,
            &mut wedge.angle,
            "between the slope and the vertical",
        );
        let across = (Kind::Angle, ACROSS, Reach::Signed(0.2));
        let comment =
            "of the slope's normal with the plane along the track; positive: it pushes the wedge outboard";
        r.quantity("slope_across", across, &mut wedge.slope_across, comment);
        r.quantity("height", LENGTH, &mut wedge.height, "of the vertical face");
        r.quantity("width", LENGTH, &mut wedge.width, "across the track");
        r.weight(
            &mut wedge.mass,
            "a force; the mass is the weight over standard gravity",
        );
        let inertia = (Kind::Inertia, Range::Positive, Reach::Positive);
        let comment = "roll, pitch, yaw: a steel prism at 32 deg, whatever the angle";
        r.triple("inertia", inertia, &mut wedge.inertia, comment);
        let angles = wedge.rise_angles();
        self.rise.read(r, &mut wedge.wear, angles);
        let comment = "that the pocket holds, or of the mark at which inspectors replace it: a guess. It \
                       limits nothing, but what stands higher is told";
        r.quantity("rise_limit", LENGTH, &mut wedge.rise_limit, comment);
        self.rise.check_limit(r, wedge.rise_limit);
        let wear = self.rise.wear(angles).unwrap_or(wedge.wear);
        check_thickness(r, [wedge.height, wedge.angle], &wear);
        let comment = "of x, y, z, roll, pitch, yaw; the others are held";
        r.free_coordinates(&mut wedge.free, Some("the wedge could not move"), comment);
        let comment = "of the pocket's sides to each side; the thesis's wedge has none";
        r.quantity(
            "side_clearance",
            CLEARANCE,
            &mut wedge.pocket_sides.clearance,
            comment,
        );
        r.quantity(
            "side_stiffness",
            STIFFNESS,
            &mut wedge.pocket_sides.stiffness,
            "of a pocket's side",
        );
        r.quantity(
            "side_damping",
            DAMPING,
            &mut wedge.pocket_sides.damping,
            "of a pocket's side",
        );
    }

    fn friction(&mut self, r: &mut CaseReader<'_>) {
        let wedge = &mut self.wedge;
        let faces = [&mut wedge.column_friction, &mut wedge.slope_friction];
        self.laws.read(r, faces);
    }
}

/// Reads the sections that all four wedges share, in their places among the others: first `wedge`, then those
/// that come after it.
pub(crate) fn all(
    r: &mut CaseReader<'_>,
    parameters: &mut Parameters,
    friction: f64,
    known: &[coils::CoilKind],
) -> Draft {
    let mut draft = Draft::new(parameters, friction, known);
    r.section(
        "wedge",
        "All four wedges: right triangular prisms. [wedge.leading_left], leading_right, trailing_left, \
         trailing_right\n\
         # set one: with these keys and toe, and tables friction, contact, control_coil, column_face, \
         slope_face, split.",
    );
    draft.body(r);
    wedge_places(r, &mut parameters.geometry);
    let about = match parameters.damping {
        Damping::Variable => {
            "The control coils; they stand on the side frames (truck.damping = \"variable\")."
        }
        Damping::Constant => "The control coils; they stand on the bolster (truck.damping = \"constant\").",
    };
    r.section("control_coil", about);
    draft.coil(r, "control_coil");
    r.section(
        "contact",
        "Contact of the wedges' corners with columns and slopes.",
    );
    contact(
        r,
        &mut draft.wedge.contact,
        "per corner; the answer hangs on it where a nest locks",
    );
    r.section(
        "friction",
        "Friction of the wedges at columns (side frames) and slopes (bolster).",
    );
    draft.friction(r);
    for (number, (name, about)) in face::SECTIONS.into_iter().zip(face::ABOUT).enumerate() {
        r.section(name, about);
        r.face(&mut draft.faces[number]);
    }
    if draft.wedge.kind == WedgeKind::Split {
        draft.wedge.split.coil_distance = draft.wedge.half_shift();
        r.section(
            "split",
            "Between the halves of split wedges, and how the control coil presses them.",
        );
        draft.split(r, "split");
    } else if r.has("split") {
        draft.split(r, "split");
    }
    draft.check_faces(r, "");
    draft.check_across(r, "wedge.");
    draft.check_split(r, "wedge.");
    draft
}

/// Reads the sections of a wedge that stands for itself.
pub(crate) fn alone(r: &mut CaseReader<'_>, damping: Damping, known: &[coils::CoilKind]) -> Wedge {
    let mut draft = Draft::new(&Parameters::new(damping), Condition::New.friction(), known);
    r.section("wedge", "The wedge: a right triangular prism.");
    draft.body(r);
    draft.toe(r);
    r.section("control_coil", "Its control coil.");
    draft.coil(r, "control_coil");
    r.section("contact", "Contact of its corners with column and slope.");
    contact(r, &mut draft.wedge.contact, "per corner");
    r.section("friction", "Friction at its column and slope.");
    draft.friction(r);
    for (number, (name, about)) in face::SECTIONS.into_iter().zip(face::ABOUT).enumerate() {
        r.section(name, about);
        r.face(&mut draft.faces[number]);
    }
    draft.check_faces(r, "");
    draft.check_across(r, "wedge.");
    if draft.wedge.kind != WedgeKind::Body {
        let problem = Problem::new("a wedge of a vehicle is one rigid body");
        let help = "leave wedge.kind out";
        r.problem("wedge.kind", problem.label("not here").help(help));
    }
    draft.finished()
}

/// Reads toe and distance of the columns.
pub(crate) fn columns_of_all(r: &mut CaseReader<'_>, geometry: &mut Geometry, draft: &mut Draft) {
    draft.toe(r);
    columns(r, geometry, &draft.wedge);
}

/// Reads the sections of single wedges over `base`.
pub(crate) fn single(r: &mut CaseReader<'_>, parameters: &mut Parameters, base: &Draft) {
    for (name, wedge) in WEDGE_NAMES.into_iter().zip(&mut parameters.wedges) {
        let mut draft = base.clone();
        let path = format!("wedge.{name}");
        let [column_face, slope_face] = face::SECTIONS;
        let parts = [
            "friction",
            "contact",
            "control_coil",
            column_face,
            slope_face,
            "split",
        ];
        if r.overlay(&path, "One wedge: what is not given is as for all four.") {
            draft.body(r);
            draft.toe(r);
            if draft.wedge.width != base.wedge.width || draft.wedge.kind != base.wedge.kind {
                draft.wedge.split.coil_distance = draft.wedge.half_shift();
            }
        }
        for part in parts {
            let path = format!("{path}.{part}");
            if r.overlay(&path, "") {
                match part {
                    "friction" => draft.friction(r),
                    "contact" => contact(r, &mut draft.wedge.contact, "per corner"),
                    "split" => draft.split(r, &path),
                    own if own == column_face => r.face(&mut draft.faces[0]),
                    own if own == slope_face => r.face(&mut draft.faces[1]),
                    _ => draft.coil(r, &path),
                }
            }
        }
        if draft.faces != base.faces {
            draft.check_faces(r, &format!("wedge.{name}."));
        }
        let shape = |own: &Draft| {
            let wedge = &own.wedge;
            let sizes = [wedge.slope_across, wedge.angle, wedge.height, wedge.width];
            (
                sizes,
                wedge.kind,
                wedge.split,
                [wedge.mass, wedge.inertia[0], wedge.inertia[2]],
                own.kind,
            )
        };
        if shape(&draft) != shape(base) {
            draft.check_across(r, &format!("{path}."));
            draft.check_split(r, &format!("{path}."));
        }
        *wedge = draft.finished();
    }
}

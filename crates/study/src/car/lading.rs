//! The sections of the car body and of what it carries.

use car::{ACCELEROMETER_HEIGHTS, Couplers, Mass, Parameters, TRUCK_DISTANCES, Torsion};
use quantity::{Kind, STANDARD_GRAVITY};
use truck::Lading;

use crate::case::field::{Reach, Written, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names, Range};
use crate::reader::schema::Form;
use crate::reader::{CaseReader, LENGTH, QuantityForm};
use crate::truck::sections;

/// The kinds of lading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LadingKind {
    Loaded,
    Empty,
    Masses,
}

const KINDS: Names<LadingKind> = &[
    ("loaded", LadingKind::Loaded),
    ("empty", LadingKind::Empty),
    ("masses", LadingKind::Masses),
];

/// Reads `lading.kind`, on which defaults of other sections hang.
pub(super) fn kind(r: &mut CaseReader<'_>) -> LadingKind {
    let mut kind = LadingKind::Loaded;
    r.section("lading", "What the car carries.");
    let comment =
        "\"loaded\": 200,400 lbf, with the car 263,000 lbf on rail; \"empty\"; \"masses\": those below";
    r.choice("kind", KINDS, &mut kind, comment);
    kind
}

impl LadingKind {
    /// Returns the lading for which a car of this kind is built.
    pub(super) fn usual(self) -> Lading {
        match self {
            Self::Loaded | Self::Masses => Lading::Loaded,
            Self::Empty => Lading::Empty,
        }
    }
}

/// A mass as typed.
struct Typed {
    mass: Mass,
    toml: String,
}

/// Reads the masses of the lading; the section has begun.
pub(super) fn masses(r: &mut CaseReader<'_>, kind: LadingKind) -> Vec<Mass> {
    if kind != LadingKind::Masses {
        if r.has("lading.masses") {
            let problem = Problem::new("`lading.masses` has no effect: the lading is another");
            let help = "write lading.kind = \"masses\"";
            r.problem("lading.masses", problem.label("not used").help(help));
        }
        r.expect("lading", &["masses"]);
        return match kind {
            LadingKind::Loaded => vec![Mass::usual()],
            _ => Vec::new(),
        };
    }
    let comment = "rigid masses: weight; place forward, to the left, above the top of rail; inertia about \
                   x, y, z; off the middle allowed";
    let read = r.other(
        "masses",
        Form::Other,
        comment,
        Vec::new(),
        list,
        |list: &Vec<Typed>| {
            let lines: Vec<String> = list.iter().map(|own| format!("\n    {},", own.toml)).collect();
            Written::toml(format!("[{}\n]", lines.concat()))
        },
    );
    if read.is_empty() && !r.has("lading.masses") {
        let problem = Problem::new("`lading.kind` is \"masses\", but there are none").label("which masses?");
        let help = "write lading.masses = [{ name = \"coil\", weight = \"40 kip\", place = [\"0 in\", \"10 \
                    in\", \"70 in\"], inertia = [\"0 lbf in s^2\", \"0 lbf in s^2\", \"0 lbf in s^2\"] }], \
                    or lading.kind = \"empty\"";
        r.problem("lading.kind", problem.help(help));
    }
    read.into_iter().map(|own| own.mass).collect()
}

/// Reads the height of the whole car's center of gravity that the lading shall make, m.
pub(super) fn center_of_gravity(r: &mut CaseReader<'_>) -> Option<f64> {
    let mut height = None;
    let comment = "of the whole car above the top of rail in the nominal layout: the lading is raised or \
                   lowered to make it; left out: it stays where it is";
    r.optional("center_of_gravity", LENGTH, &mut height, "\"98 in\"", comment);
    height
}

/// Raises the lading until the center of gravity of the whole car has a height (m). Returns the warning about
/// a car that carries nothing.
pub(super) fn raise(r: &mut CaseReader<'_>, parameters: &mut Parameters, height: f64) -> Option<String> {
    let lading: f64 = parameters.lading.iter().map(|own| own.mass).sum();
    if lading <= 0.0 {
        return Some(
            "`lading.center_of_gravity` has no effect, since the car carries nothing: raise the body itself \
             by car.height"
                .to_owned(),
        );
    }
    let mass = parameters.weight() / parameters.gravity;
    let up = (height - parameters.height_of_center()) * mass / lading;
    for own in &mut parameters.lading {
        own.place[2] += up;
    }
    let lowest = parameters
        .lading
        .iter()
        .map(|own| own.place[2])
        .fold(f64::INFINITY, f64::min);
    if !up.is_finite() || lowest < 0.0 {
        let message = format!(
            "with the center of gravity of the whole car at {:.1} in the lading would lie below the rails",
            height / 0.0254
        );
        let problem = Problem::new(message).label("too low");
        let help =
            "heights are above the top of rail: 98 in is the highest that rules allow, 60 to 85 in are usual";
        r.problem("lading.center_of_gravity", problem.help(help));
    }
    None
}

fn list(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Vec<Typed>> {
    let mut list = Vec::new();
    for (number, own) in section.tables("masses", problems).into_iter().enumerate() {
        own.allow_in(
            &["name", "weight", "place", "inertia"],
            &[],
            "a mass of the lading",
            problems,
        );
        let name = match own.table.get("name") {
            Some(_) => own.text("name", problems).map(|(text, _)| text.to_owned()),
            None => Some(format!("mass {}", number + 1)),
        };
        let weight = own.quantity("weight", Kind::Force, Range::Positive, problems);
        let place = own.triple("place", Kind::Length, Range::Any, problems);
        let inertia = own.triple("inertia", Kind::Inertia, Range::NotNegative, problems);
        let (name, weight, place, inertia) = (name?, weight?, place?, inertia?);
        let triple = |own: &[quantity::Quantity; 3]| {
            let texts = own.each_ref().map(|one| quoted(one.text()));
            format!("[{}]", texts.join(", "))
        };
        list.push(Typed {
            toml: format!(
                "{{ name = {}, weight = {}, place = {}, inertia = {} }}",
                quoted(&name),
                quoted(weight.text()),
                triple(&place),
                triple(&inertia)
            ),
            mass: Mass {
                name,
                mass: weight.to_si() / STANDARD_GRAVITY,
                place: place.each_ref().map(quantity::Quantity::to_si),
                inertia: inertia.each_ref().map(quantity::Quantity::to_si),
            },
        });
    }
    Some(list)
}

/// Reads the twist of the body.
fn torsion(r: &mut CaseReader<'_>) -> Option<Torsion> {
    const STIFFNESS: QuantityForm = (Kind::Moment, Range::Positive, Reach::Wide);
    let mut stiffness = None;
    let comment = "of the body against twist between the truck centers, per rad; left out: the body is rigid";
    r.optional(
        "torsion_stiffness",
        STIFFNESS,
        &mut stiffness,
        "\"1e8 lbf in\"",
        comment,
    );
    const USUAL: f64 = 0.02;
    let mut damping = USUAL;
    let comment = "of its twist, share of the critical one: a guess";
    let reach = Reach::FromZero(0.1);
    r.number(
        "torsion_damping",
        Range::NotNegative,
        reach,
        &mut damping,
        comment,
    );
    // A completed case has the usual value.
    if damping != USUAL && !r.gives("torsion_stiffness") {
        let problem = Problem::new("`car.torsion_damping` has no effect: the body is rigid");
        let help = "give car.torsion_stiffness, or leave both out";
        r.problem_at(&r.path("torsion_damping"), problem.label("unused").help(help));
    }
    // One that was refused stays zero.
    let stiffness = stiffness.filter(|own| *own > 0.0);
    stiffness.map(|stiffness| Torsion { stiffness, damping })
}

/// The section of the body.
pub(super) fn body(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section(
        "car",
        "The car body without lading. Axes: x forward, y left, z up from the top of rail, origin midway \
         between the trucks.",
    );
    sections::rigid_body(r, &mut parameters.body);
    let distance: QuantityForm = (
        Kind::Length,
        Range::Between(TRUCK_DISTANCES[0], TRUCK_DISTANCES[1], "between 1 and 100 m"),
        Reach::Positive,
    );
    r.quantity(
        "truck_distance",
        distance,
        &mut parameters.truck_distance,
        "from the center of one truck to that of the other",
    );
    let height: QuantityForm = (
        Kind::Length,
        Range::UpTo(ACCELEROMETER_HEIGHTS[1], "between 0 and 10 m"),
        Reach::Positive,
    );
    r.optional(
        "accelerometer_height",
        height,
        &mut parameters.accelerometer_height,
        "\"30 in\"",
        "of the accelerometers over the truck centers, above the top of rail; left out: that of the center \
         plate",
    );
    parameters.torsion = torsion(r);
    let Couplers { height, distance, .. } = &mut parameters.couplers;
    let comment = "of the couplers above the top of rail in the nominal layout: a guess";
    r.quantity("coupler_height", LENGTH, height, comment);
    let comment = "from one pulling face to the other: 53 ft 1 in";
    r.quantity("coupler_distance", LENGTH, distance, comment);
    let gravity: QuantityForm = (
        Kind::Acceleration,
        Range::NotNegative,
        Reach::FromZero(STANDARD_GRAVITY),
    );
    r.quantity("gravity", gravity, &mut parameters.gravity, "standard gravity");
}

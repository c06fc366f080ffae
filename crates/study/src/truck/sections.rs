//! The sections of a truck's case, key by key.

mod car_body;
mod coils;
mod geometry;
mod load_springs;
mod wheelsets;

use mechanics::friction::FrictionLaw;
use quantity::Kind;
use truck::{Bolster, Clearance, Geometry, Lading, Parameters, RigidBody, WedgeKind, empirical_warp};
use wedge::parameters::{Damping, FaceFriction};

pub(super) use car_body::car_body;
pub(crate) use car_body::{bearing_keys, center_plate, doubts_of_bearing, plate_keys, side_bearings};
pub(crate) use coils::{
    coils, counts as coil_counts, height as coil_height, kind as coil_kind, together as coils_together,
};
pub(crate) use geometry::{columns, truck_places, wedge_places};
pub(crate) use load_springs::load_springs;
pub(super) use load_springs::spring_stiffnesses;
pub(super) use wheelsets::wheelsets;
pub(crate) use wheelsets::{adapter, adapter_keys};

use crate::case::field::Reach;
use crate::case::friction::COEFFICIENT;
use crate::case::motion;
use crate::case::names::{DAMPINGS, STARTS};
use crate::case::page::FRICTION;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range, choice};
use crate::reader::{CLEARANCE, CaseReader, DAMPING, QuantityForm, STIFFNESS};

/// A named condition of a truck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// A friction of the wedges of 0.4.
    New,
    /// A friction of 0.25; nothing is worn.
    LessFriction,
}

impl Condition {
    /// Returns the friction of wedges on both faces.
    pub(crate) fn friction(self) -> f64 {
        match self {
            Self::New => 0.4,
            Self::LessFriction => 0.25,
        }
    }
}

/// The load of a truck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// Nothing: the bolster is alone.
    Nothing,
    /// Half a car, rigid with the bolster.
    HalfCar,
    /// Half a car's body on center plate and side bearings.
    CarBody,
}

/// The last one is an older name, and is read.
const CONDITIONS: Names<Condition> = &[
    ("new", Condition::New),
    ("mu_0.25", Condition::LessFriction),
    ("worn", Condition::LessFriction),
];
pub(crate) const LOADS: Names<Load> = &[
    ("nothing", Load::Nothing),
    ("half_car", Load::HalfCar),
    ("car_body", Load::CarBody),
];
pub(crate) const LADINGS: Names<Lading> = &[("loaded", Lading::Loaded), ("empty", Lading::Empty)];

/// What the point about which a body turns means.
const TURNS_ABOUT: &str = "the point it turns about, in truck axes; left out, its center of gravity";
/// kip·in, in N·m.
const KIP_INCH: f64 = 112.984_829_027_616_7;
/// A height above the top of rail.
const HEIGHT: QuantityForm = (Kind::Length, Range::Positive, Reach::Positive);
const INERTIA: QuantityForm = (Kind::Inertia, Range::Positive, Reach::Positive);
const LIFT: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(0.0254));
const TIME: QuantityForm = (Kind::Time, Range::NotNegative, Reach::FromZero(1.0));

/// Reads the named condition of a truck, and where its control coils stand; `friction` says what wins over
/// the condition.
pub(crate) fn condition_and_damping(r: &mut CaseReader<'_>, friction: &str) -> (Condition, Damping) {
    let (mut condition, mut damping) = (Condition::New, Damping::Variable);
    let comment = format!(
        "\"new\": wedges have a friction of 0.4; \"mu_0.25\" (before: \"worn\"): 0.25, and nothing is \
         worn: wear is wedge.rise. {friction} wins over it"
    );
    r.choice("condition", CONDITIONS, &mut condition, &comment);
    let comment = "\"variable\": control coils stand on the side frames; \"constant\": on the bolster";
    r.choice("damping", DAMPINGS, &mut damping, comment);
    (condition, damping)
}

pub(crate) fn rigid_body(r: &mut CaseReader<'_>, body: &mut RigidBody) {
    r.weight(
        &mut body.mass,
        "a force; the mass is the weight over standard gravity",
    );
    r.triple(
        "inertia",
        INERTIA,
        &mut body.inertia,
        "about x, y, z through the center of gravity",
    );
    let comment = "of the center of gravity above the top of rail";
    r.quantity("height", HEIGHT, &mut body.height, comment);
}

fn clearance(r: &mut CaseReader<'_>, stop: &mut Clearance) {
    r.quantity(
        "clearance",
        CLEARANCE,
        &mut stop.clearance,
        "to each side, in the nominal layout",
    );
    r.quantity("stiffness", STIFFNESS, &mut stop.stiffness, "beyond it");
    r.quantity(
        "damping",
        DAMPING,
        &mut stop.damping,
        "beyond it; a stop never pulls",
    );
}

/// Friction with a bristle.
fn friction(r: &mut CaseReader<'_>, friction: &mut FaceFriction) {
    r.number(
        "friction",
        COEFFICIENT,
        FRICTION,
        &mut friction.coefficient,
        "coefficient of friction",
    );
    if let FrictionLaw::Bristle { stiffness, damping } = &mut friction.law {
        r.quantity(
            "bristle_stiffness",
            STIFFNESS,
            stiffness,
            "tangential, of all points together",
        );
        r.quantity("bristle_damping", DAMPING, damping, "the same");
    }
}

pub(crate) fn bolster(r: &mut CaseReader<'_>, parameters: &mut Parameters, load: Load, lading: Lading) {
    if load == Load::HalfCar {
        parameters.bolster = Bolster::with_half_car(lading);
    }
    let Bolster {
        body,
        free,
        motion,
        applied,
    } = &mut parameters.bolster;
    let about = format!(
        "The bolster, with load.kind = \"half_car\" together with half a car. A motion is {}",
        motion::SHAPES_WRITTEN
    );
    r.section("bolster", &about);
    let comment = "of x, y, z, roll, pitch, yaw; the others are held. [] prescribes the motions below";
    r.free_coordinates(free, None, comment);
    rigid_body(r, body);
    r.motions(motion, free.contains(&true), TURNS_ABOUT);
    r.loads("bolster", applied, *free);
}

pub(crate) fn side_frames(
    r: &mut CaseReader<'_>,
    parameters: &mut Parameters,
    columns: impl FnOnce(&mut CaseReader<'_>, &mut Geometry),
) {
    let mut base = parameters.side_frames[0].clone();
    r.section(
        "side_frame",
        "Both side frames; [left_side_frame] and [right_side_frame] set one.",
    );
    columns(r, &mut parameters.geometry);
    let comment = "of both side frames; [] prescribes the motions below";
    r.free_coordinates(&mut base.free, None, comment);
    rigid_body(r, &mut base.body);
    r.motions(&mut base.motion, base.free.contains(&true), TURNS_ABOUT);
    r.loads("side_frame", &mut base.applied, base.free);
    parameters.side_frames = [base.clone(), base];
    for (name, own) in ["left_side_frame", "right_side_frame"]
        .into_iter()
        .zip(&mut parameters.side_frames)
    {
        if r.overlay(name, "One side frame: what is not given is as in [side_frame].") {
            r.free_coordinates(&mut own.free, None, "of this side frame");
            rigid_body(r, &mut own.body);
            r.motions(&mut own.motion, own.free.contains(&true), TURNS_ABOUT);
        }
        r.loads(name, &mut own.applied, own.free);
    }
}

/// An empirical warp spring of NUCARS's files, by a truck's condition.
#[derive(Clone, Copy, PartialEq)]
enum WarpSpring {
    Nothing,
    Worn,
    New,
    Stiff,
}

pub(crate) fn warp_spring(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section(
        "warp_spring",
        "An empirical spring in each nest between the yaw of bolster and side frame, with a stop at 30 \
         mrad: in NUCARS's\n\
         # files it stands for what massless wedges leave out. With wedge bodies warp would be counted \
         twice.",
    );
    const KINDS: Names<WarpSpring> = &[
        ("nothing", WarpSpring::Nothing),
        ("worn", WarpSpring::Worn),
        ("new", WarpSpring::New),
        ("stiff", WarpSpring::Stiff),
    ];
    let mut kind = WarpSpring::Nothing;
    let comment =
        "\"nothing\"; \"worn\", \"new\" or \"stiff\" (an H-frame): moment of a nest 52.5, 255, 1275 kip in";
    r.choice("kind", KINDS, &mut kind, comment);
    let kip_inches = match kind {
        WarpSpring::Nothing => return,
        WarpSpring::Worn => 52.5,
        WarpSpring::New => 255.0,
        WarpSpring::Stiff => 1275.0,
    };
    let mut moment = kip_inches * KIP_INCH;
    let form = (Kind::Moment, Range::Positive, Reach::Positive);
    r.quantity("moment", form, &mut moment, "of a nest at 30 mrad");
    parameters.warp_spring = empirical_warp(moment).ok();
}

pub(crate) fn stops(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section("gib", "Gibs: lateral stops between bolster and side frame.");
    clearance(r, &mut parameters.gib);
    geometry::gib(r, &mut parameters.geometry);
    let about = "Lands: longitudinal stops between bolster and side frame, four a column.";
    r.section("lands", about);
    clearance(r, &mut parameters.lands);
    geometry::lands(r, &mut parameters.geometry);
}

/// Reads where a run starts. Returns the time for which the truck settles first, s.
pub(crate) fn start(r: &mut CaseReader<'_>, parameters: &mut Parameters) -> f64 {
    r.section(
        "start",
        "Where the run starts; simulation.start is read as start.kind.",
    );
    let comment = "\"rest\": nominal layout, faces may start inside; \"touching\"; or \"equilibrium\" \
                   (without friction)";
    // The key of a single wedge's case.
    if let Some(node) = r.at("simulation.start") {
        if r.has("start.kind") {
            let problem = Problem::new("`simulation.start` and `start.kind` say the same");
            r.problem(
                "simulation.start",
                problem.label("said twice").help("leave one of them out"),
            );
        } else if let Some(start) = choice(node, "simulation.start", STARTS, r.problems) {
            parameters.start = start;
        }
    }
    r.choice("kind", STARTS, &mut parameters.start, comment);
    let comment = "height above the nominal layout at which a free bolster starts, with the wedges";
    r.quantity("lift", LIFT, &mut parameters.lift, comment);
    let mut settle = 0.0;
    let comment = "so long all motions are held first, with friction; results begin after it";
    r.quantity("settle", TIME, &mut settle, comment);
    if parameters.lift != 0.0 && parameters.bolster.is_prescribed() {
        let problem =
            Problem::new("`start.lift` raises a free bolster, but this one has a prescribed motion");
        let help = "write bolster.vertical instead, or load.kind = \"half_car\"";
        r.problem(
            "start.lift",
            problem.label("this would have no effect").help(help),
        );
    }
    settle
}

/// Wedges without mass between prescribed neighbors leave nothing that moves.
pub(crate) fn check_something_moves(r: &mut CaseReader<'_>, parameters: &Parameters) {
    let massless = |wedge: &truck::Wedge| wedge.kind == WedgeKind::Massless;
    let held = |free: [bool; 6]| free == [false; 6];
    let frames = parameters.side_frames.iter().all(|own| held(own.free));
    if parameters.wedges.iter().all(massless)
        && frames
        && parameters.bolster.is_prescribed()
        && parameters.car_body.is_none()
    {
        let message = "nothing can move: bolster and side frames are prescribed, and no wedge has mass";
        let help = "free the side frames on their adapters and drive the wheelsets, as \
                    truck_warp_axles_constant_rising does";
        let problem = Problem::new(message).label("no mass").help(help);
        r.problem("wedge.kind", problem);
    }
}

//! The sections of a truck's case, key by key.

use mechanics::friction::FrictionLaw;
use quantity::Kind;
use truck::empirical_warp;
use truck::nest::{CatalogCoil, springs, whole_nest};
use truck::{
    Adapter, Bolster, CarBody, Clearance, FrictionAdapter, Lading, NestCoil, Parameters, RigidBody,
    SideBearing, SideBearings, Spring, WedgeKind, Wheelsets,
};
use wedge::parameters::{Contact, Damping, FaceFriction, Start};

use super::reader::{CLEARANCE, DAMPING, Form, LENGTH, PRELOAD, Reader, STIFFNESS};
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::read::COEFFICIENT;
use crate::case::section::{Names, Range, choice};
use crate::case::write::FRICTION;

/// A named condition of a truck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// As built.
    New,
    /// Worn: less friction on the wedges.
    Worn,
}

impl Condition {
    /// Returns the friction of wedges on both faces.
    pub(super) fn friction(self) -> f64 {
        match self {
            Self::New => 0.4,
            Self::Worn => 0.25,
        }
    }
}

/// What a truck carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Load {
    /// Nothing: the bolster is alone.
    Nothing,
    /// Half a car, rigid with the bolster.
    HalfCar,
    /// Half a car's body on center plate and side bearings.
    CarBody,
}

pub(super) const CONDITIONS: Names<Condition> = &[("new", Condition::New), ("worn", Condition::Worn)];
pub(super) const DAMPINGS: Names<Damping> =
    &[("variable", Damping::Variable), ("constant", Damping::Constant)];
pub(super) const LOADS: Names<Load> = &[
    ("nothing", Load::Nothing),
    ("half_car", Load::HalfCar),
    ("car_body", Load::CarBody),
];
pub(super) const LADINGS: Names<Lading> = &[("loaded", Lading::Loaded), ("empty", Lading::Empty)];
const STARTS: Names<Start> = &[
    ("rest", Start::Rest),
    ("touching", Start::Touching),
    ("equilibrium", Start::Equilibrium),
];

/// kip·in, in N·m.
const KIP_INCH: f64 = 112.984_829_027_616_7;
/// A height above the top of rail.
const HEIGHT: Form = (Kind::Length, Range::Positive, Reach::Positive);
const INERTIA: Form = (Kind::Inertia, Range::Positive, Reach::Positive);
const LIFT: Form = (Kind::Length, Range::Any, Reach::Signed(0.0254));
const TIME: Form = (Kind::Time, Range::NotNegative, Reach::FromZero(1.0));

fn rigid_body(r: &mut Reader<'_>, body: &mut RigidBody) {
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

fn clearance(r: &mut Reader<'_>, stop: &mut Clearance) {
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

pub(super) fn contact(r: &mut Reader<'_>, contact: &mut Contact, of: &str) {
    r.quantity("stiffness", STIFFNESS, &mut contact.stiffness, of);
    r.quantity(
        "damping",
        DAMPING,
        &mut contact.damping,
        "the same; it never pulls",
    );
}

/// Friction with a bristle.
fn friction(r: &mut Reader<'_>, friction: &mut FaceFriction) {
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

pub(super) fn bolster(r: &mut Reader<'_>, parameters: &mut Parameters, load: Load, lading: Lading) {
    if load == Load::HalfCar {
        parameters.bolster = Bolster::with_half_car(lading);
    }
    let Bolster {
        body,
        free,
        motion,
        applied,
    } = &mut parameters.bolster;
    r.section(
        "bolster",
        "The bolster, with load.kind = \"half_car\" together with half a car. A motion is one held value, a list of\n\
         # motions to be added up, or one of\n\
         # { shape = \"sine\", amplitude, frequency, phase, start }         frequency in rad/s, Hz or rpm\n\
         # { shape = \"triangle\", amplitude, frequency, start }\n\
         # { shape = \"swept_sine\", amplitude, start_frequency, end_frequency, duration, start }   then end_frequency\n\
         # { shape = \"ramp\", amplitude, start, duration, profile }            profile \"smooth\", \"linear\" or \"half_cosine\"\n\
         # { shape = \"table\", file = \"motion.csv\" }                            a cubic spline; or points = [[time, value], ...]",
    );
    let comment = "of x, y, z, roll, pitch, yaw; the others are held. [] prescribes the motions below";
    r.free_coordinates(free, None, comment);
    rigid_body(r, body);
    r.motions(motion, free.contains(&true));
    r.loads("bolster", applied, *free);
}

pub(super) fn side_frames(
    r: &mut Reader<'_>,
    parameters: &mut Parameters,
    toe: impl FnOnce(&mut Reader<'_>),
) {
    let mut base = parameters.side_frames[0].clone();
    r.section(
        "side_frame",
        "Both side frames; [left_side_frame] and [right_side_frame] set one.",
    );
    toe(r);
    let comment = "of both side frames; [] prescribes the motions below";
    r.free_coordinates(&mut base.free, None, comment);
    rigid_body(r, &mut base.body);
    r.motions(&mut base.motion, base.free.contains(&true));
    r.loads("side_frame", &mut base.applied, base.free);
    parameters.side_frames = [base.clone(), base];
    for (name, own) in ["left_side_frame", "right_side_frame"]
        .into_iter()
        .zip(&mut parameters.side_frames)
    {
        if r.overlay(name, "One side frame: what is not given is as in [side_frame].") {
            r.free_coordinates(&mut own.free, None, "of this side frame");
            rigid_body(r, &mut own.body);
            r.motions(&mut own.motion, own.free.contains(&true));
        }
        r.loads(name, &mut own.applied, own.free);
    }
}

/// Kinds of adapters.
#[derive(Clone, Copy, PartialEq)]
enum AdapterKind {
    Friction,
    Pad,
    Nothing,
}

pub(super) fn wheelsets(r: &mut Reader<'_>, parameters: &mut Parameters) {
    let mut wheelsets = Wheelsets {
        motions: std::array::from_fn(|_| wedge::parameters::NeighbourMotion::fixed()),
        adapter: Adapter::friction(),
    };
    r.section(
        "wheelset",
        "Both wheelsets, prescribed; [leading_wheelset] and [trailing_wheelset] set one.",
    );
    r.motions(&mut wheelsets.motions[0], false);
    wheelsets.motions[1] = wheelsets.motions[0].clone();
    for (name, own) in ["leading_wheelset", "trailing_wheelset"]
        .into_iter()
        .zip(&mut wheelsets.motions)
    {
        if r.overlay(name, "One wheelset: what is not given is as in [wheelset].") {
            r.motions(own, false);
        }
    }
    r.section("adapter", "Where side frames stand on the bearings.");
    const KINDS: Names<AdapterKind> = &[
        ("friction", AdapterKind::Friction),
        ("pad", AdapterKind::Pad),
        ("nothing", AdapterKind::Nothing),
    ];
    let mut kind = AdapterKind::Friction;
    let comment = "\"friction\": steel on steel; \"pad\": elastomeric; \"nothing\": wheelsets and adapters are left out";
    r.choice("kind", KINDS, &mut kind, comment);
    match kind {
        AdapterKind::Friction => {
            if let Adapter::Friction(adapter) = &mut wheelsets.adapter {
                friction_adapter(r, adapter);
            }
        }
        AdapterKind::Pad => {
            wheelsets.adapter = Adapter::pad();
            if let Adapter::Pad(pad) = &mut wheelsets.adapter {
                r.quantity(
                    "preload",
                    PRELOAD,
                    &mut pad.preload,
                    "of an adapter in the nominal layout",
                );
                r.quantity(
                    "stiffness",
                    STIFFNESS,
                    &mut pad.stiffness,
                    "vertical: as steel, a guess",
                );
                let comment = "along and across: the least of claim 32 of US patent 9,637,143";
                r.quantity("shear_stiffness", STIFFNESS, &mut pad.shear_stiffness, comment);
                let comment = "of its two springs: yaw stiffness is the shear stiffness times its square";
                r.quantity("half_distance", LENGTH, &mut pad.half_distance, comment);
                r.quantity(
                    "damping",
                    DAMPING,
                    &mut pad.damping,
                    "of every direction: a guess",
                );
            }
        }
        AdapterKind::Nothing => {
            parameters.wheelsets = None;
            for (name, own) in ["left_side_frame", "right_side_frame"]
                .iter()
                .zip(&parameters.side_frames)
            {
                if own.free.contains(&true) {
                    let message = format!("the {} has nothing to stand on", name.replace('_', " "));
                    let help = "write side_frame.free_coordinates = [] to prescribe its motion, or keep the adapters";
                    r.problem(
                        "adapter.kind",
                        Problem::new(message).label("no adapters").help(help),
                    );
                }
            }
            return;
        }
    }
    parameters.wheelsets = Some(wheelsets);
}

fn friction_adapter(r: &mut Reader<'_>, adapter: &mut FrictionAdapter) {
    let FrictionAdapter {
        preload,
        contact: own,
        friction: law,
        longitudinal,
        lateral,
    } = adapter;
    r.quantity(
        "preload",
        PRELOAD,
        preload,
        "of each of the two points in the nominal layout",
    );
    contact(r, own, "of each of the two points");
    friction(r, law);
    let comment = "to each side; 0.0468 in allow 30 mrad of yaw";
    r.quantity(
        "longitudinal_clearance",
        CLEARANCE,
        &mut longitudinal.clearance,
        comment,
    );
    r.quantity(
        "longitudinal_stiffness",
        STIFFNESS,
        &mut longitudinal.stiffness,
        "of each of the two stops",
    );
    r.quantity(
        "longitudinal_damping",
        DAMPING,
        &mut longitudinal.damping,
        "the same",
    );
    r.quantity(
        "lateral_clearance",
        CLEARANCE,
        &mut lateral.clearance,
        "to each side",
    );
    r.quantity(
        "lateral_stiffness",
        STIFFNESS,
        &mut lateral.stiffness,
        "of the stop",
    );
    r.quantity("lateral_damping", DAMPING, &mut lateral.damping, "the same");
}

/// Whether load coils are groups or single coils.
#[derive(Clone, Copy, PartialEq)]
enum NestKind {
    Groups,
    SingleCoils,
}

/// The places of a 3 × 3 nest, along x and along y, in the order of the names below.
const PLACES: [[i8; 2]; 9] = [
    [1, 1],
    [1, 0],
    [1, -1],
    [0, 1],
    [0, 0],
    [0, -1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
];

/// All coils of a nest by name.
const COILS: Names<(CatalogCoil, [i8; 2])> = &{
    const NAMES: [[&str; 9]; 2] = [
        [
            "outer_leading_left",
            "outer_leading_middle",
            "outer_leading_right",
            "outer_middle_left",
            "outer_middle_middle",
            "outer_middle_right",
            "outer_trailing_left",
            "outer_trailing_middle",
            "outer_trailing_right",
        ],
        [
            "inner_leading_left",
            "inner_leading_middle",
            "inner_leading_right",
            "inner_middle_left",
            "inner_middle_middle",
            "inner_middle_right",
            "inner_trailing_left",
            "inner_trailing_middle",
            "inner_trailing_right",
        ],
    ];
    let mut all = [("", (CatalogCoil::D5Outer, [0; 2])); 18];
    let mut at = 0;
    while at < 18 {
        let kind = if at < 9 {
            CatalogCoil::D5Outer
        } else {
            CatalogCoil::D5Inner
        };
        all[at] = (NAMES[at / 9][at % 9], (kind, PLACES[at % 9]));
        at += 1;
    }
    all
};

pub(super) fn load_springs(r: &mut Reader<'_>, parameters: &mut Parameters) {
    r.section("load_springs", "Load coils between bolster and side frames.");
    const KINDS: Names<NestKind> = &[
        ("groups", NestKind::Groups),
        ("single_coils", NestKind::SingleCoils),
    ];
    let mut kind = NestKind::Groups;
    let comment =
        "\"groups\": four springs a nest; \"single_coils\": D5 coils at their places in a 3 x 3 nest";
    r.choice("nest", KINDS, &mut kind, comment);
    let Some(first) = parameters.load_coils[0].first().copied() else {
        return;
    };
    let mut coil = first.spring;
    r.quantity(
        "preload",
        PRELOAD,
        &mut coil.preload,
        "of a quarter of a nest in the nominal layout",
    );
    let mut stiffness_ratio = coil.shear_stiffness / coil.stiffness;
    if kind == NestKind::Groups {
        spring_stiffnesses(r, &mut coil, true);
    } else {
        let comment = "shear stiffness of the coils over their stiffness";
        r.number(
            "shear_ratio",
            Range::NotNegative,
            Reach::Positive,
            &mut stiffness_ratio,
            comment,
        );
    }
    r.quantity(
        "damping",
        DAMPING,
        &mut coil.damping,
        "of a quarter of a nest, in every direction",
    );
    let total = 4.0 * coil.preload;
    for (nest, key) in parameters
        .load_coils
        .iter_mut()
        .zip(["missing_left", "missing_right"])
    {
        if kind == NestKind::Groups {
            nest.iter_mut().for_each(|own| own.spring = coil);
            continue;
        }
        let mut missing = Vec::new();
        let comment =
            "coils that are broken or missing, such as \"outer_leading_left\"; the others keep their loads";
        r.several(key, COILS, &mut missing, comment);
        let coils = whole_nest(parameters.damping);
        if let Some(absent) = missing.iter().find(|coil| !coils.contains(coil)) {
            let name = COILS
                .iter()
                .find(|(_, coil)| coil == absent)
                .map_or("", |(name, _)| name);
            let names: Vec<&str> = COILS
                .iter()
                .filter(|(_, own)| coils.contains(own))
                .map(|(name, _)| *name)
                .collect();
            let problem = Problem::new(format!("this nest has no coil `{name}`")).label("no such coil");
            let help = format!("its coils are {}", names.join(", "));
            r.problem(&format!("load_springs.{key}"), problem.help(help));
        }
        let all = springs(&coils, total, stiffness_ratio);
        let present = coils.iter().zip(all).filter(|(coil, _)| !missing.contains(coil));
        let damping = 4.0 * coil.damping / coils.len() as f64;
        *nest = present
            .map(|(_, own)| NestCoil {
                spring: Spring {
                    damping,
                    ..own.spring
                },
                ..own
            })
            .collect();
        if nest.is_empty() {
            let problem = Problem::new("a nest without any coil carries nothing");
            r.problem(
                &format!("load_springs.{key}"),
                problem.help("leave at least one coil in it"),
            );
        }
    }
}

/// The keys of a spring's stiffnesses.
pub(super) fn spring_stiffnesses(r: &mut Reader<'_>, spring: &mut Spring, quarter: bool) {
    let of = if quarter {
        "of a quarter of a nest"
    } else {
        "along it"
    };
    r.quantity("stiffness", STIFFNESS, &mut spring.stiffness, of);
    let comment = "along and across the track";
    let shear = (Kind::Stiffness, Range::NotNegative, Reach::Wide);
    r.quantity("shear_stiffness", shear, &mut spring.shear_stiffness, comment);
    let [mut travel, mut stiffness] = [0, 1].map(|k| spring.solid.map(|solid| solid[k]));
    let comment = "from the nominal layout until its coils touch; left out, it never goes solid";
    r.optional("solid_travel", LENGTH, &mut travel, "\"1.4 in\"", comment);
    if travel.is_some() {
        r.optional(
            "solid_stiffness",
            STIFFNESS,
            &mut stiffness,
            "\"2.5e5 lbf/in\"",
            "beyond it",
        );
        if stiffness.is_none() {
            let problem = Problem::new("a coil that goes solid needs `solid_stiffness`");
            r.problem(
                "load_springs",
                problem.help("write for example solid_stiffness = \"2.5e5 lbf/in\""),
            );
        }
    }
    spring.solid = travel
        .zip(stiffness)
        .map(|(travel, stiffness)| [travel, stiffness]);
}

/// An empirical warp spring of NUCARS's files, by a truck's condition.
#[derive(Clone, Copy, PartialEq)]
enum WarpSpring {
    Nothing,
    Worn,
    New,
    Stiff,
}

pub(super) fn warp_spring(r: &mut Reader<'_>, parameters: &mut Parameters) {
    r.section(
        "warp_spring",
        "An empirical spring in each nest between the yaw of bolster and side frame, with a stop at 30 mrad: in NUCARS's\n\
         # files it stands for what massless wedges leave out. With wedge bodies warp would be counted twice.",
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

pub(super) fn stops(r: &mut Reader<'_>, parameters: &mut Parameters) {
    r.section("gib", "Gibs: lateral stops between bolster and side frame.");
    clearance(r, &mut parameters.gib);
    let about = "Lands: longitudinal stops between bolster and side frame, four a column.";
    r.section("lands", about);
    clearance(r, &mut parameters.lands);
}

pub(super) fn car_body(r: &mut Reader<'_>, parameters: &mut Parameters, load: Load, lading: Lading) {
    if load != Load::CarBody {
        for section in ["car_body", "center_plate", "side_bearing"] {
            if r.has(section) {
                let problem = Problem::new(format!("[{section}] has no effect: there is no car body"));
                r.problem(
                    section,
                    problem.label("unused").help("write load.kind = \"car_body\""),
                );
                // Its keys are not looked at.
                r.expect("", &["car_body", "center_plate", "side_bearing"]);
            }
        }
        return;
    }
    let bearings = match lading {
        Lading::Loaded => SideBearings::rollers(),
        Lading::Empty => SideBearings::constant_contact(),
    };
    let mut car = CarBody::new(lading, bearings);
    r.section(
        "car_body",
        "Half a car's body, on center plate and side bearings.",
    );
    let comment = "half a car on one truck falls over in pitch";
    r.free_coordinates(&mut car.free, Some("the car body could not move"), comment);
    rigid_body(r, &mut car.body);
    r.loads("car_body", &mut car.applied, car.free);
    let plate = &mut car.center_plate;
    r.section(
        "center_plate",
        "The center plate: two rings of points with friction, and a rim.",
    );
    r.quantity(
        "height",
        HEIGHT,
        &mut plate.height,
        "of its surface above the top of rail",
    );
    if let [outer, inner] = plate.rings.as_mut_slice() {
        r.quantity(
            "radius",
            LENGTH,
            outer,
            "of the outer ring; the inner one has a third of it",
        );
        *inner = *outer / 3.0;
    }
    contact(r, &mut plate.contact, "of each of the 16 points: a guess");
    friction(r, &mut plate.friction);
    r.quantity(
        "rim_clearance",
        CLEARANCE,
        &mut plate.rim.clearance,
        "on the radius: a guess",
    );
    r.quantity("rim_stiffness", STIFFNESS, &mut plate.rim.stiffness, "of the rim");
    r.quantity("rim_damping", DAMPING, &mut plate.rim.damping, "of the rim");
    r.section("side_bearing", "Side bearings.");
    let mut rolls = matches!(car.side_bearings.kind, SideBearing::Roller(_));
    const KINDS: Names<bool> = &[("roller", true), ("constant_contact", false)];
    r.choice(
        "kind",
        KINDS,
        &mut rolls,
        "\"roller\": a clearance; \"constant_contact\": a preloaded spring with friction",
    );
    let mut own = if rolls {
        SideBearings::rollers()
    } else {
        SideBearings::constant_contact()
    };
    r.quantity("distance", LENGTH, &mut own.distance, "from the truck's center");
    match &mut own.kind {
        SideBearing::Roller(stop) => clearance(r, stop),
        SideBearing::ConstantContact {
            preload,
            contact: soft,
            travel,
            solid,
            friction: law,
        } => {
            r.quantity("preload", PRELOAD, preload, "in the nominal layout");
            contact(r, soft, "until it is solid");
            r.quantity("travel", CLEARANCE, travel, "until it is solid");
            r.quantity("solid_stiffness", STIFFNESS, &mut solid.stiffness, "beyond it");
            r.quantity("solid_damping", DAMPING, &mut solid.damping, "beyond it");
            friction(r, law);
        }
    }
    car.side_bearings = own;
    if car.side_bearings.preload() > car.body.mass * parameters.gravity {
        let message = "the side bearings' preloads are more than the body's weight";
        let help = "lower side_bearing.preload: AAR allows 85 % of a quarter of the body's weight";
        r.problem(
            "side_bearing.preload",
            Problem::new(message).label("lifts the body").help(help),
        );
    }
    parameters.car_body = Some(car);
}

/// Reads where a run starts. Returns the time for which the truck settles first, s.
pub(super) fn start(r: &mut Reader<'_>, parameters: &mut Parameters) -> f64 {
    r.section(
        "start",
        "Where the run starts; simulation.start is read as start.kind.",
    );
    let comment = "\"rest\": nominal layout, faces may start inside; \"touching\"; or \"equilibrium\" (without friction)";
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
pub(super) fn check_something_moves(r: &mut Reader<'_>, parameters: &Parameters) {
    let massless = |wedge: &truck::Wedge| wedge.kind == WedgeKind::Massless;
    let held = |free: [bool; 6]| free == [false; 6];
    let frames = parameters.side_frames.iter().all(|own| held(own.free));
    if parameters.wedges.iter().all(massless)
        && frames
        && parameters.bolster.is_prescribed()
        && parameters.car_body.is_none()
    {
        let message = "nothing can move: bolster and side frames are prescribed, and no wedge has mass";
        let help = "free the side frames on their adapters and drive the wheelsets, as truck_warp_axles_constant_rising does";
        let problem = Problem::new(message).label("no mass").help(help);
        r.problem("wedge.kind", problem);
    }
}

//! All sections of a car's case, in the order of the completed case.

use car::{Drive, Parameters, Start, StartKind};
use integrate::Method;
use quantity::{Kind, Quantity, System};
use rolling::track::RailSupport;

use super::checks;
use super::couplers;
use super::lading::{self, LadingKind};
use super::statistics::Rules;
use super::{rails, track, trucks, wheels};
use crate::case::field::{Reach, Written, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names, Range, quantity};
use crate::case::tree::NodeValue;
use crate::case::{Simulation, page};
use crate::damage::{self, DamageLaws};
use crate::output_files::OutputFiles;
use crate::reader::schema::Form;
use crate::reader::{CaseReader, DAMPING, QuantityForm};
use crate::track::{Notes, Support};

/// The contents of the sections.
pub(super) struct CarSections {
    pub parameters: Parameters,
    pub rules: Rules,
    pub damage: DamageLaws,
    pub output_files: OutputFiles,
    pub simulation: Simulation,
    pub stability: StabilityKeys,
    pub doubts: Vec<String>,
}

/// The drive of the car, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
enum DriveKind {
    Held,
    OverDistance,
    OverTime,
    Coasting,
}

const DRIVES: Names<DriveKind> = &[
    ("held", DriveKind::Held),
    ("over_distance", DriveKind::OverDistance),
    ("over_time", DriveKind::OverTime),
    ("coasting", DriveKind::Coasting),
];
/// The starts, by name.
pub(super) const STARTS: Names<StartKind> = &[
    ("equilibrium", StartKind::Equilibrium),
    ("nominal", StartKind::Nominal),
    ("shaken", StartKind::Shaken),
];

/// Speed of a car that none is given for, mph.
const USUAL_SPEED: f64 = 40.0;
const MILE_PER_HOUR: f64 = 0.447_04;
const SHIFT: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(0.0127));

/// Reads all sections; `None` if there is no car to speak of: what is wrong has been noted.
pub(super) fn everything(r: &mut CaseReader<'_>) -> Option<CarSections> {
    let carried = lading::kind(r);
    let masses = lading::masses(r, carried);
    let raised = lading::center_of_gravity(r);
    let straight = track::tangent(1000.0)?;
    let mut parameters = Parameters::new(carried.usual(), straight, USUAL_SPEED * MILE_PER_HOUR).ok()?;
    parameters.lading = masses;
    lading::body(r, &mut parameters);
    parameters.trucks = trucks::trucks(r, carried.usual());
    for own in &mut parameters.trucks {
        own.gravity = parameters.gravity;
    }
    let line = track::track(r);
    let sprung = !matches!(&line, Some(read) if read.support == Support::Rigid);
    if let Some(read) = &line {
        parameters.track = read.track.clone();
        parameters.support = rail_support(&read.support, parameters.gravity);
    }
    let rails = rails::rails(r);
    let of_wheels = wheels::wheels(r, &mut parameters, rails, sprung);
    let nothing_to_raise = raised.and_then(|height| lading::raise(r, &mut parameters, height));
    speed(r, &mut parameters);
    couplers::couplers(r, &mut parameters.couplers);
    start(r, &mut parameters);
    let damage = damage::read(r);
    let mut rules = Rules::default();
    super::output::output(r, &mut rules);
    let mut output_files = OutputFiles::of_car();
    output_files.read(r);
    let simulation = simulation(r);
    let stability = stability(r);
    // Without a track there is no place to look at.
    let Notes { mut doubts, files } = line?.notes;
    r.files.extend(files);
    doubts.extend(of_wheels);
    doubts.extend(nothing_to_raise);
    doubts.extend(checks::all(r, &parameters, &simulation, carried));
    Some(CarSections {
        parameters,
        rules,
        damage,
        output_files,
        simulation,
        stability,
        doubts,
    })
}

/// What `wedgelab stability` looks at besides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StabilityKeys {
    /// Warp stiffness of a truck in the linear benchmark, N·m/rad, if it is asked for.
    pub benchmark_warp: Option<f64>,
    /// Whether the car's body is held, so that each truck runs alone.
    pub body_held: bool,
}

/// Reads `[stability]`.
fn stability(r: &mut CaseReader<'_>) -> StabilityKeys {
    const BODIES: Names<bool> = &[("free", false), ("held", true)];
    r.section(
        "stability",
        "What `wedgelab stability` looks at besides; runs take nothing of it.",
    );
    let mut moment = None;
    let form: QuantityForm = (Kind::Moment, Range::Positive, Reach::Positive);
    let comment = "of a nest at 30 mrad of warp in the linear benchmark (adapters and plates tied, plates \
                   free in yaw, no friction): NUCARS has 255 kip in for a new truck; left out: no benchmark";
    r.optional("warp_moment", form, &mut moment, "\"255000 lbf in\"", comment);
    let mut body_held = false;
    let comment = "\"held\": it moves forward and nothing else, so that each truck runs alone";
    r.choice("body", BODIES, &mut body_held, comment);
    StabilityKeys {
        benchmark_warp: moment.map(|own: f64| 2.0 * own / 0.030),
        body_held,
    }
}

/// Returns the springs under the rails.
pub(crate) fn rail_support(support: &Support, gravity: f64) -> Option<RailSupport> {
    support.rail().map(|rail| RailSupport {
        preload: rail.mass * gravity,
        ..rail.clone()
    })
}

/// Reads `[speed]`.
pub(crate) fn speed(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section("speed", "How fast it goes.");
    let mut kind = DriveKind::Held;
    let comment = "\"held\": a force on the body along the track holds the value; \"over_distance\", \
                   \"over_time\": the same with the values below; \"coasting\": no force";
    r.choice("kind", DRIVES, &mut kind, comment);
    let mut gain = 1e5;
    if kind != DriveKind::Coasting {
        r.quantity("gain", DAMPING, &mut gain, "force by what lacks in speed");
    } else {
        r.expect("speed", &["gain"]);
    }
    let over = match kind {
        DriveKind::OverDistance => Some(&DISTANCES),
        DriveKind::OverTime => Some(&TIMES),
        DriveKind::Held | DriveKind::Coasting => None,
    };
    if let Some(over) = over {
        if let Some(speeds) = speeds_over(r, over) {
            parameters.drive = match kind {
                DriveKind::OverTime => Drive::History { gain, speeds },
                _ => Drive::Over { gain, speeds },
            };
        }
        return;
    }
    let range = match kind {
        DriveKind::Coasting => Range::NotNegative,
        _ => Range::Positive,
    };
    if kind == DriveKind::Held
        && let Some(node) = r.at("speed.value")
        && let NodeValue::Text(text) = &node.value
        && Quantity::parse_as(text, Kind::TravelSpeed).is_ok_and(|own| own.to_si() == 0.0)
    {
        let problem = Problem::new("`speed.value` is zero, but a car that is held at a speed rolls");
        let help = "write speed.kind = \"coasting\" for a car that stands, or a speed";
        r.problem("speed.value", problem.label("does not roll").help(help));
        return;
    }
    let value = &mut parameters.start.speed;
    r.quantity(
        "value",
        (Kind::TravelSpeed, range, Reach::Positive),
        value,
        "at the start; wheels roll",
    );
    parameters.drive = match kind {
        DriveKind::Coasting => Drive::Coasting,
        _ => Drive::Held { gain },
    };
}

/// Speeds over something: its key, what it is, its kind and range, the range of the speeds, an example.
struct Over {
    key: &'static str,
    comment: &'static str,
    kind: Kind,
    range: Range,
    speeds: Range,
    example: &'static str,
}

const DISTANCES: Over = Over {
    key: "over_distance",
    comment: "distances along the track and speeds, straight between them",
    kind: Kind::Distance,
    range: Range::Any,
    speeds: Range::NotNegative,
    example: "over_distance = [[\"0 ft\", \"60 mph\"], [\"3000 ft\", \"30 mph\"]]",
};
const TIMES: Over = Over {
    key: "over_time",
    comment: "times and speeds, straight between them; held where a car that follows them is",
    kind: Kind::Time,
    range: Range::NotNegative,
    speeds: Range::Positive,
    example: "over_time = [[\"0 s\", \"60 mph\"], [\"40 s\", \"30 mph\"]]",
};

type Pairs = Vec<[Quantity; 2]>;

/// Reads speeds over something, SI; `None` notes what is wrong.
fn speeds_over(r: &mut CaseReader<'_>, over: &'static Over) -> Option<Vec<[f64; 2]>> {
    let key = over.key;
    let read = |section: &CaseSection<'_>, problems: &mut Problems| pairs(section, over, problems).map(Some);
    let typed = r.other(key, Form::Rows, over.comment, None, read, write_speeds);
    let Some(typed) = typed.filter(|typed| !typed.is_empty()) else {
        if !r.has(&format!("speed.{key}")) {
            let problem = Problem::new(format!("`speed.kind` is \"{key}\", but `speed.{key}` is missing"));
            let help = format!("write {}", over.example);
            r.problem("speed.kind", problem.label("which speeds?").help(help));
        }
        return None;
    };
    let si = typed.iter().map(|pair| pair.each_ref().map(Quantity::to_si));
    Some(si.collect())
}

fn pairs(section: &CaseSection<'_>, over: &Over, problems: &mut Problems) -> Option<Pairs> {
    let Over { key, kind, range, .. } = over;
    let node = section.table.get(key)?;
    let what_it_is = match kind {
        Kind::Time => "time",
        _ => "distance",
    };
    let wrong = |what: &str| {
        Problem::new(format!("`speed.{key}` {what}"))
            .label(format!("pairs of {what_it_is} and speed"))
            .help(format!("write {}", over.example))
    };
    let NodeValue::List(items) = &node.value else {
        problems.push(wrong("is no list").at(&node.place));
        return None;
    };
    let mut pairs: Pairs = Vec::new();
    for (number, item) in items.iter().enumerate() {
        let NodeValue::List(pair) = &item.value else {
            problems.push(wrong("holds what is no pair").at(&item.place));
            return None;
        };
        let [at, speed] = pair.as_slice() else {
            problems.push(wrong("holds what is no pair").at(&item.place));
            return None;
        };
        let path = format!("speed.{key}[{number}]");
        let at = quantity(at, &path, *kind, *range, problems);
        let speed = quantity(speed, &path, Kind::TravelSpeed, over.speeds, problems);
        let pair = [at?, speed?];
        if pairs
            .last()
            .is_some_and(|before| before[0].to_si() >= pair[0].to_si())
        {
            problems.push(wrong(&format!("must have growing {what_it_is}s")).at(&item.place));
            return None;
        }
        pairs.push(pair);
    }
    Some(pairs)
}

fn write_speeds(pairs: &Option<Pairs>) -> Written {
    let texts = pairs
        .iter()
        .flatten()
        .map(|[at, speed]| format!("[{}, {}]", quoted(at.text()), quoted(speed.text())));
    Written::toml(format!("[{}]", texts.collect::<Vec<_>>().join(", ")))
}

fn start(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section("start", "Where the run starts.");
    let speed = parameters.start.speed;
    parameters.start = Start::at(parameters.reach() + 1.0, speed);
    let own = &mut parameters.start;
    let comment = "\"equilibrium\": at rest on straight track, without friction; \"nominal\": the loaded \
                   layout; \"shaken\": what friction holds after 3 s at 60 mph on track of FRA class 3";
    r.choice("kind", STARTS, &mut own.kind, comment);
    let distance: QuantityForm = (Kind::Distance, Range::NotNegative, Reach::Positive);
    r.quantity(
        "distance",
        distance,
        &mut own.distance,
        "of the middle of the car along the track",
    );
    let settle: QuantityForm = (Kind::Time, Range::NotNegative, Reach::FromZero(2.0));
    r.quantity(
        "settle",
        settle,
        &mut own.settle,
        "statistics leave out what is before it",
    );
    let mut shift = 0.0;
    let comment = "of all wheelsets to the left, a disturbance; axle_1_shift to axle_4_shift set one";
    r.quantity("axle_shift", SHIFT, &mut shift, comment);
    own.wheelset_shifts = [shift; 4];
    for (key, shift) in ["axle_1_shift", "axle_2_shift", "axle_3_shift", "axle_4_shift"]
        .into_iter()
        .zip(&mut own.wheelset_shifts)
    {
        let mut given = r.has(&format!("start.{key}")).then_some(*shift);
        r.optional(key, SHIFT, &mut given, "\"0.1 in\"", "of this wheelset");
        *shift = given.unwrap_or(*shift);
    }
    r.quantity(
        "body_shift",
        SHIFT,
        &mut own.body_shift,
        "of the car body to the left",
    );
    let heading: QuantityForm = (Kind::Angle, Range::Any, Reach::Signed(page::TURN));
    r.quantity(
        "heading",
        heading,
        &mut own.heading,
        "of the track in the fixed frame: changes nothing",
    );
    match &parameters.drive {
        Drive::Over { speeds, .. } => own.speed = checks::speed_at(speeds, own.distance),
        Drive::History { speeds, .. } => own.speed = checks::speed_at(speeds, 0.0),
        Drive::Held { .. } | Drive::Coasting => {}
    }
}

fn simulation(r: &mut CaseReader<'_>) -> Simulation {
    let usual = Simulation {
        duration: 20.0,
        output_interval: 0.005,
        relative_tolerance: 1e-4,
        output_units: System::Us,
        // It damps the vibrations of contacts, and takes a tenth of the steps of others on rough track.
        method: Method::TrBdf2,
    };
    let interval = "time between two rows of the result; filters need 4 rows a period";
    let units = "\"us\" (ft, mph, in, lbf, g) or \"si\" (m, N)";
    r.simulation(usual, interval, units).0
}

impl LadingKind {
    /// Returns the key that decides it, for messages.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Masses => "lading.masses",
            Self::Loaded | Self::Empty => "lading.kind",
        }
    }
}

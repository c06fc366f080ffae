//! Lock-up maps: where a wedge locks up over two of its parameters, by closed form and by runs.
//!
//! The closed form is the lock-up margin of the massless wedge ([`mechanics::quasi_static`]). The run is a
//! rig: the case's wedge starts in equilibrium, the bolster presses it against the column at a constant speed
//! and does nothing else. The faces close on the wedge: if it slides at both faces when the rig ends, it gets
//! out of the way, and its normal force is that of the massless wedge; if it holds at one of them (more than
//! half of the normal force is carried by points that stick), it is locked, and its force has grown against
//! the stiffness of the contacts. Neither knows of the other.
//!
//! Limits: other motions of the case are left out. Near the boundary the rig is too short to tell: a wedge
//! that slides must be pressed the farther the smaller its margin.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicUsize, Ordering};

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use mechanics::system::ContactState;
use quantity::{Kind, Quantity, System as Units};
use wedge::face::Grid;
use wedge::outputs::FACES;

use crate::case::{Case, CaseError, Tables, bounds};
use crate::closed_form;
use crate::outcome::Outcome;
use crate::result::RunResult;
use crate::run::Run;
use crate::summary::RunSummary;

/// Travel and duration of the bolster's press.
const PRESS: &str = "bolster.longitudinal={ shape = \"ramp\", amplitude = \"-0.3 in\", duration = \"1.5 s\", \
                     profile = \"linear\" }";
/// The other settings of the rig.
const RIG: [&str; 12] = [
    PRESS,
    "bolster.lateral=0 in",
    "bolster.vertical=0 in",
    "bolster.roll=0 deg",
    "bolster.pitch=0 deg",
    "side_frame.longitudinal=0 in",
    "side_frame.lateral=0 in",
    "side_frame.vertical=0 in",
    "side_frame.roll=0 deg",
    "side_frame.pitch=0 deg",
    "side_frame.yaw=0 deg",
    "simulation.start=equilibrium",
];
/// Its duration, with which it ends while the bolster still moves.
const TIMES: [&str; 2] = ["simulation.duration=1.5 s", "simulation.output_interval=0.05 s"];
/// A wedge is locked where more than this part of a face's normal force is carried by points that stick.
const HOLDS: f64 = 0.5;
/// Angles of toe and yaw stay below, rad.
const MOST_TILT: f64 = std::f64::consts::FRAC_PI_8;

/// A parameter that a map goes over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapAxis {
    /// The wedge's angle.
    Angle,
    /// The coefficient of friction of both faces.
    Friction,
    /// The toe, positive out.
    Toe,
    /// The radius of a crown up the wedge's vertical face.
    Crown,
    /// The yaw of the pocket.
    Yaw,
}

impl MapAxis {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Angle, Self::Friction, Self::Toe, Self::Crown, Self::Yaw];

    /// Returns its name, as typed.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Friction => "friction",
            Self::Toe => "toe",
            Self::Crown => "crown",
            Self::Yaw => "yaw",
        }
    }

    /// Returns its name for people.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Angle => "wedge angle",
            Self::Friction => "coefficient of friction of both faces",
            Self::Toe => "toe, positive out",
            Self::Crown => "radius of the crown of the vertical face",
            Self::Yaw => "yaw of the pocket",
        }
    }

    /// Returns the unit in which it is shown, and the factor to it from SI.
    #[must_use]
    pub fn unit(self, units: Units) -> (&'static str, f64) {
        match self {
            Self::Friction => ("", 1.0),
            Self::Crown => (Kind::Length.label(units), Kind::Length.from_si(units)),
            Self::Angle | Self::Toe | Self::Yaw => ("deg", 1f64.to_degrees()),
        }
    }

    /// Returns the settings that give a case this value (SI), as `--set` takes them.
    fn set(self, value: f64) -> Vec<String> {
        match self {
            Self::Angle => vec![format!("wedge.angle={value} rad")],
            Self::Friction => ["column", "slope"]
                .map(|face| format!("friction.{face}={value}"))
                .into(),
            Self::Toe => {
                let way = if value < 0.0 { "in" } else { "out" };
                vec![format!("side_frame.toe={} rad {way}", value.abs())]
            }
            Self::Crown => vec![
                // The corners alone would not meet a crown.
                "column_face.grid=[9, 2]".to_owned(),
                format!(
                    "column_face.wedge_surface={{ shape = \"crown\", radius = \"{value} m\", direction = \
                     \"up\" }}"
                ),
            ],
            Self::Yaw => vec![format!("bolster.yaw={value} rad")],
        }
    }

    /// Reads a value. Returns SI, or what is wrong.
    fn read(self, text: &str) -> Result<f64, String> {
        let text = text.trim();
        let quantity = |text: &str, kind: Kind, example: &str| {
            Quantity::parse_as(text.trim(), kind)
                .map(|found| found.to_si())
                .map_err(|error| format!("{}: {error}; write for example \"{example}\"", self.name()))
        };
        let beyond = |range: &str| Err(format!("{} is {text}; it must be {range}", self.name()));
        match self {
            Self::Angle => match quantity(text, Kind::Angle, "32 deg")? {
                angle if angle > 0.0 && angle < std::f64::consts::FRAC_PI_2 => Ok(angle),
                _ => beyond("between 0 deg and 90 deg, both excluded"),
            },
            Self::Friction => match text.parse::<f64>() {
                Ok(value) if (0.0..=bounds::FRICTION).contains(&value) => Ok(value),
                Ok(_) => beyond("between 0 and 10"),
                Err(_) => beyond("a number without unit, such as 0.4"),
            },
            Self::Toe => {
                let (size, sign) = match text.rsplit_once(char::is_whitespace) {
                    Some((size, "out")) => (size, 1.0),
                    Some((size, "in")) => (size, -1.0),
                    _ => (text, 0.0),
                };
                match quantity(size, Kind::Angle, "0.5 deg out")? {
                    size if sign == 0.0 && size != 0.0 => {
                        beyond("given with its direction, such as \"0.5 deg out\" or \"0.5 deg in\"")
                    }
                    size if (0.0..MOST_TILT).contains(&size) => Ok(sign * size),
                    _ => beyond("not negative and below 22.5 deg, in or out"),
                }
            }
            Self::Crown => match quantity(text, Kind::Length, "60 in")? {
                radius if radius > 0.0 && radius <= bounds::largest(Kind::Length) => Ok(radius),
                _ => beyond(&format!("positive and {}", bounds::words(Kind::Length))),
            },
            Self::Yaw => match quantity(text, Kind::Angle, "12 mrad")? {
                yaw if yaw.abs() < MOST_TILT => Ok(yaw),
                _ => beyond("below 22.5 deg, either sign"),
            },
        }
    }
}

/// An axis of a map with its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapRange {
    /// The parameter.
    pub axis: MapAxis,
    /// Its ends, SI, increasing.
    pub ends: [f64; 2],
}

impl MapRange {
    /// Reads a text such as `angle=20 deg..50 deg`, whichever end comes first.
    ///
    /// # Errors
    /// The mistake, and the text to write instead.
    pub fn parse(text: &str) -> Result<Self, String> {
        const HOW: &str = "write for example \"angle=20 deg..50 deg\" or \"friction=0.1..0.6\"";
        let names = MapAxis::ALL.map(MapAxis::name).join(", ");
        let (name, values) = text
            .split_once('=')
            .ok_or(format!("an axis has a name and a range; {HOW}"))?;
        let name = name.trim();
        let axis = MapAxis::ALL.into_iter().find(|axis| axis.name() == name);
        let axis = axis.ok_or(format!("there is no axis `{name}`; choose two of {names}"))?;
        let (from, to) = values
            .split_once("..")
            .ok_or(format!("{name} needs a range; {HOW}"))?;
        match [axis.read(from)?, axis.read(to)?] {
            [from, to] if from == to => Err(format!(
                "{name} goes from {values}: one point only; give two different values"
            )),
            [from, to] => Ok(Self {
                axis,
                ends: [from.min(to), from.max(to)],
            }),
        }
    }

    /// Returns so many values, evenly apart, both ends included; radii by a constant factor.
    #[must_use]
    pub fn values(&self, points: usize) -> Vec<f64> {
        let [from, to] = self.ends;
        let last = points.saturating_sub(1).max(1) as f64;
        (0..points)
            .map(|number| {
                let share = number as f64 / last;
                match self.axis {
                    MapAxis::Crown => from * libm::pow(to / from, share),
                    _ => from + (to - from) * share,
                }
            })
            .collect()
    }
}

/// The outcome of a rig.
#[derive(Clone, Debug, PartialEq)]
pub enum RigOutcome {
    /// The wedge holds at a face: it is locked.
    Locks,
    /// It slides at both faces.
    Slides,
    /// The faces do not close upwards; no rig was run.
    PushedOut,
    /// The rig could not begin or did not come to its end, and why.
    Unknown(String),
}

impl RigOutcome {
    /// Returns its name in tables.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Locks => "locks",
            Self::Slides => "slides",
            Self::PushedOut => "pushed_out",
            Self::Unknown(_) => "unknown",
        }
    }
}

/// A point of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPoint {
    /// The closing angle of the faces, rad.
    pub closing_angle: f64,
    /// The lock-up margin, rad.
    pub margin: f64,
    /// The column's normal force along the track over the load, of the massless wedge on which the faces
    /// close; none where it locks up.
    pub expected_ratio: Option<f64>,
    /// The outcome of the rig.
    pub found: RigOutcome,
    /// Parts of the normal forces of column and slope that are carried by points that stick, at the rig's
    /// end.
    pub holding: [f64; 2],
    /// The column's normal force along the track over the load (the coil's force less the weight), at the
    /// rig's end.
    pub ratio: f64,
}

impl MapPoint {
    /// Returns whether what the rig found contradicts the sign of the margin.
    #[must_use]
    pub fn contradicts(&self) -> bool {
        match self.found {
            RigOutcome::Locks => self.margin > 0.0,
            RigOutcome::Slides => self.margin <= 0.0,
            _ => false,
        }
    }
}

/// A lock-up map.
#[derive(Clone, Debug, PartialEq)]
pub struct LockUpMap {
    /// Its axes.
    pub spans: [MapRange; 2],
    /// Values along each, SI.
    pub values: [Vec<f64>; 2],
    /// Its points, the second axis changing fastest.
    pub cells: Vec<MapPoint>,
    /// The reason if it was ended early: points whose rigs were not run have the closed form alone.
    pub interrupted: Option<String>,
}

/// Returns the rig of a case with these values of the axes.
fn rig(text: &str, values: [(MapAxis, f64); 2]) -> Result<Case, CaseError> {
    let mut set: Vec<String> = RIG.iter().chain(&TIMES).map(|text| (*text).to_owned()).collect();
    set.extend(values.into_iter().flat_map(|(axis, value)| axis.set(value)));
    Case::parse("the lock-up rig", text, Tables::nowhere(), &set)
}

/// Returns the map of a case: `points` along each axis, on so many threads. `go_on` is asked before each rig,
/// with its number, and may end the map with a reason; what was found until then is kept.
///
/// # Errors
/// The same axis twice, fewer than two points, a value that the case refuses, or it is ended before any rig
/// was.
pub fn map(
    case: &Case,
    spans: [MapRange; 2],
    points: usize,
    threads: usize,
    go_on: impl Fn(usize) -> ControlFlow<String> + Sync,
) -> Result<LockUpMap, MapError> {
    let [first, second] = spans;
    if first.axis == second.axis {
        return Err(MapError::SameAxis(first.axis));
    }
    if points < 2 {
        return Err(MapError::OnePoint(points));
    }
    let text = case.to_toml_embedded();
    let values = spans.map(|span| span.values(points));
    let at = |number: usize| {
        let [x, y] = &values;
        [
            (first.axis, x[number / points]),
            (second.axis, y[number % points]),
        ]
    };
    // The corners first: a value that the case refuses is refused before anything runs.
    let last = points * points - 1;
    for corner in [0, points - 1, last + 1 - points, last] {
        rig(text, at(corner))?;
    }
    let next = AtomicUsize::new(0);
    let done = Mutex::new((vec![None; points * points], None));
    let worker = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number > last {
                return;
            }
            let outcome = match go_on(number) {
                ControlFlow::Break(reason) => Err(MapError::Interrupted(reason)),
                ControlFlow::Continue(()) => {
                    rig(text, at(number)).map(|case| cell(&case)).map_err(Into::into)
                }
            };
            let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
            match outcome {
                Ok(cell) => done.0[number] = Some(cell),
                Err(error) => {
                    done.1.get_or_insert(error);
                    next.store(last + 1, Ordering::Relaxed);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(worker);
        }
    });
    let (cells, error) = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    let interrupted = match error {
        None => None,
        Some(MapError::Interrupted(reason)) if cells.iter().any(Option::is_some) => Some(reason),
        Some(error) => return Err(error),
    };
    let mut map = LockUpMap {
        spans,
        values: values.clone(),
        cells: Vec::with_capacity(cells.len()),
        interrupted,
    };
    for (number, cell) in cells.into_iter().enumerate() {
        let cell = cell.unwrap_or_else(|| {
            let (wedge, yaw) = map.massless(case, at(number).map(|(_, value)| value));
            let reason = map.interrupted.clone().unwrap_or_default();
            closed(&wedge, yaw, RigOutcome::Unknown(reason))
        });
        map.cells.push(cell);
    }
    Ok(map)
}

impl LockUpMap {
    /// Returns the closed form at a point of the map's plane (SI): the wedge and its yaw.
    #[must_use]
    pub fn massless(&self, case: &Case, values: [f64; 2]) -> (QuasiStaticWedge, f64) {
        let mut wedge = closed_form::wedge(&case.parameters);
        let mut yaw = closed_form::yaw(&case.parameters);
        for (span, value) in self.spans.iter().zip(values) {
            match span.axis {
                MapAxis::Angle => wedge.angle = value,
                MapAxis::Friction => (wedge.column_friction, wedge.slope_friction) = (value, value),
                MapAxis::Toe => wedge.toe = value,
                MapAxis::Yaw => yaw = value,
                MapAxis::Crown => {}
            }
        }
        (wedge, yaw)
    }

    /// Returns the numbers of rigs that locked and slid, and of those that contradict the margin.
    #[must_use]
    pub fn counts(&self) -> [usize; 3] {
        let count = |of: &dyn Fn(&MapPoint) -> bool| self.cells.iter().filter(|cell| of(cell)).count();
        [
            count(&|cell| cell.found == RigOutcome::Locks),
            count(&|cell| cell.found == RigOutcome::Slides),
            count(&MapPoint::contradicts),
        ]
    }

    /// Returns the largest lock-up margin, either sign, at which a rig contradicts it, rad; 0 if none does.
    #[must_use]
    pub fn disagreement(&self) -> f64 {
        let wrong = self.cells.iter().filter(|cell| cell.contradicts());
        wrong.fold(0.0, |most, cell| most.max(cell.margin.abs()))
    }
}

/// Returns the closed form at a point whose rig was not run; `why` unless the faces open upwards.
fn closed(wedge: &QuasiStaticWedge, yaw: f64, why: RigOutcome) -> MapPoint {
    let slide = wedge.slide(SlidingDirection::Down, SlopeFriction::UpSlope, 1.0);
    let closing_angle = wedge.closing_angle(yaw);
    MapPoint {
        closing_angle,
        margin: wedge.lock_up_margin(yaw),
        expected_ratio: slide.map(|slide| slide.column_normal * libm::cos(wedge.toe)),
        found: if closing_angle <= 0.0 {
            RigOutcome::PushedOut
        } else {
            why
        },
        holding: [f64::NAN; 2],
        ratio: f64::NAN,
    }
}

/// Runs a rig.
fn cell(case: &Case) -> MapPoint {
    let wedge = closed_form::wedge(&case.parameters);
    let yaw = closed_form::yaw(&case.parameters);
    let mut cell = closed(&wedge, yaw, RigOutcome::Slides);
    if cell.found == RigOutcome::PushedOut {
        return cell;
    }
    let result = match Run::new(case) {
        Ok(run) => run.finish(|_| ()),
        Err(error) => {
            cell.found = RigOutcome::Unknown(error.to_string());
            return cell;
        }
    };
    match result.summary.outcome() {
        Outcome::Complete => {}
        Outcome::Failed(reason) => {
            cell.found = RigOutcome::Unknown(reason);
            return cell;
        }
        Outcome::Stopped(end) | Outcome::Derailed(end) => {
            cell.found = RigOutcome::Unknown(end.reason);
            return cell;
        }
    }
    let last = |name: &str| {
        let column = result.column(name).and_then(|values| values.last().copied());
        column.unwrap_or(f64::NAN)
    };
    let parameters = &case.parameters;
    let load = last("coil_force") - parameters.wedge.mass * parameters.gravity;
    if load <= 0.0 {
        cell.found = RigOutcome::Unknown("the coil does not carry the wedge's weight at the end".to_owned());
        return cell;
    }
    cell.ratio = last("longitudinal_wedge_force") / load;
    let faces = [&parameters.column_face, &parameters.slope_face];
    cell.holding = [0, 1].map(|face| holding(&result, FACES[face], &faces[face].grid));
    cell.found = match cell.holding.iter().any(|share| *share > HOLDS) {
        true => RigOutcome::Locks,
        false => RigOutcome::Slides,
    };
    cell
}

/// Returns the part of a face's normal force that is carried by points that stick, at the end; 0 without
/// load.
fn holding(result: &RunResult, face: &str, grid: &Grid) -> f64 {
    let last = |name: &str| result.column(name).and_then(|values| values.last().copied());
    let (mut sticking, mut all) = (0.0, 0.0);
    for (point, corner) in grid.points().iter().zip(grid.names()) {
        // A grid's points have pressures on parts of the face; the four corners have forces.
        let number = format!("{face}_{}", point.number());
        let corner = format!("{face}_{corner}");
        let pressure = last(&format!("{number}_pressure")).map(|pressure| pressure * point.weight);
        let load = pressure.or_else(|| last(&format!("{corner}_normal_force")));
        let state = last(&format!("{number}_state")).or_else(|| last(&format!("{corner}_state")));
        let (load, state) = (load.unwrap_or(0.0), state.unwrap_or(0.0) as u8);
        all += load;
        if ContactState::from_number(state) == ContactState::Stick {
            sticking += load;
        }
    }
    if all > 0.0 { sticking / all } else { 0.0 }
}

/// Reasons why there is no map.
#[derive(Debug, thiserror::Error)]
pub enum MapError {
    /// Both axes are the same.
    #[error("both axes are the {}", .0.name())]
    SameAxis(MapAxis),
    /// A map of one point.
    #[error("{0} points along an axis are no map")]
    OnePoint(usize),
    /// The case refuses a value.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// It was interrupted before any rig was run, and why.
    #[error("{0}")]
    Interrupted(String),
}

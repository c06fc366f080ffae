//! Wear of a wedge's faces over many cycles of its motion.
//!
//! A cycle is run, the law of wear says what volume it takes at each contact point, and the depths of the
//! faces (`wedge_wear`) grow by that many times as many cycles as a step has; then the next run shows what
//! the worn wedge does. The volume that a point stands for is its depth times its part of the face, so that
//! the sum over the map is the sum over the points, on every grid.
//!
//! Steps are explicit. A place that is worn deeper by its elastic penetration is no longer pressed: a step
//! that wears more than twice that overshoots, and high and low places would change about from step to step.
//! No point may be worn in a step by more than [`LIMIT`] of its mean penetration, weighted by its slip; steps
//! that are too long are divided.
//!
//! A counterface is worn by a stated ratio of what the wedge's face loses, where the points are at the time
//! ([`counterface`]). Without a ratio counterfaces keep their shapes.

pub mod archard;
pub mod counterface;
pub mod coupon;
pub mod cycle;
pub mod energy;
pub mod mounted;

use std::ops::ControlFlow;

use thiserror::Error;
use wedge::face::{DepthMap, FaceProperties};
use wedge::outputs::FACES;

use crate::case::face::SECTIONS as FACE_SECTIONS;
use crate::case::{Case, CaseError, Tables};
use crate::run::RunError;
use archard::Archard;
use counterface::{Counterfaces, Lattice};
use cycle::{CycleWork, PointWork};
use energy::WearByEnergy;

/// The largest depth that a step may add at a point, relative to the point's penetration.
pub const LIMIT: f64 = 0.5;

/// A law of wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WearLaw {
    /// By load and path.
    Archard(Archard),
    /// By energy.
    Energy(WearByEnergy),
}

impl WearLaw {
    /// Returns the volume that one cycle takes at a point, m³.
    #[must_use]
    pub fn volume(&self, work: &PointWork) -> f64 {
        match self {
            Self::Archard(law) => law.volume(work.load_times_path),
            Self::Energy(law) => law.volume(work.energy),
        }
    }
}

/// The plan of advancing wear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WearPlan {
    /// Cycles of the bolster.
    pub cycles: f64,
    /// Steps at least.
    pub steps: u32,
    /// Steps at most.
    pub most_steps: u32,
    /// The law.
    pub law: WearLaw,
    /// The wear of the counterfaces over that of the wedge's faces: the ratio of their coefficients of wear;
    /// zero or positive.
    pub counterface: f64,
}

/// Reasons why wear is not computed.
#[derive(Debug, Error)]
pub enum WearError {
    /// The bolster's motion does not repeat.
    #[error("the bolster's vertical motion makes no whole cycle after the first half period")]
    NoCycle,
    /// A run cannot begin or go on.
    #[error("{0}")]
    Run(RunError),
    /// A run's results are nonsense.
    #[error("a run has failed: {0}")]
    Failed(String),
    /// The worn wedge is no valid case.
    #[error("the worn wedge is no valid case: {0}")]
    Case(Box<CaseError>),
    /// The steps would be too many.
    #[error(
        "about {needed:.0} steps are needed, at most {most} are allowed: no point may be worn in a step by \
         more than half of its penetration, which one cycle wears by {part:.2e} of it"
    )]
    TooManySteps {
        /// Their number.
        needed: f64,
        /// The number allowed.
        most: u32,
        /// Depth that one cycle wears, relative to the penetration.
        part: f64,
    },
}

/// Reasons why wear goes no further.
#[derive(Debug)]
pub enum WearStop {
    /// The caller asked for it.
    Interrupted(String),
    /// It cannot.
    Error(WearError),
}

impl From<WearError> for WearStop {
    fn from(error: WearError) -> Self {
        Self::Error(error)
    }
}

/// The wear of a face at some number of cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceWear {
    /// Depth at each point in the order of its grid, with that of the case at the start, m.
    pub depths: Vec<f64>,
    /// Mean pressure over the cycle at each point, Pa.
    pub pressures: Vec<f64>,
    /// Volume worn since the start, m³.
    pub volume: f64,
    /// Volume that a cycle takes, m³.
    pub volume_per_cycle: f64,
    /// Energy that friction takes in a cycle, J.
    pub loss: f64,
    /// Mean normal force, N.
    pub mean_force: f64,
}

/// The wear of a counterface at some number of cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct CounterfaceWear {
    /// Its depths, with those of the case at the start; none where nothing is worn.
    pub map: Option<DepthMap>,
    /// Volume worn since the start, m³.
    pub volume: f64,
}

/// The wedge after some number of cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct WearState {
    /// Cycles since the start.
    pub cycles: f64,
    /// Its faces.
    pub faces: [FaceWear; FACES.len()],
    /// Their counterfaces, where these are worn.
    pub counterfaces: Option<[CounterfaceWear; FACES.len()]>,
    /// Mean height of the wedge over that at the start, m.
    pub rise: f64,
    /// Equivalent viscous damping of the column's friction, N·s/m.
    pub damping: f64,
    /// By how much the points' energies miss the ledger's, relative.
    pub mismatch: f64,
}

/// The course of wear: states at the start and after each step.
#[derive(Debug)]
pub struct WearHistory {
    /// The states.
    pub states: Vec<WearState>,
    /// The case with the depths of the last state.
    pub case: Case,
    /// The reason if it ended before the last cycle.
    pub stopped: Option<WearStop>,
}

/// Advances the wear of a wedge. `go_on` is asked after each step of a run, with the part of all cycles done
/// and the time that the run has reached. States computed before a stop are kept.
///
/// # Errors
/// There is not even the state at the start, or the steps would be too many.
pub fn advance(
    case: &Case,
    plan: &WearPlan,
    mut go_on: impl FnMut(f64, f64) -> ControlFlow<String>,
) -> Result<WearHistory, WearStop> {
    let areas = areas(case);
    let mut history = WearHistory {
        states: Vec::new(),
        case: case.clone(),
        stopped: None,
    };
    let mut next = case.clone();
    let mut wear = start(case);
    let mut volumes = [0.0; FACES.len()];
    let lattices = (plan.counterface > 0.0).then(|| lattices(case));
    let mut counterfaces = lattices.as_ref().map(Counterfaces::new);
    let (mut cycles, mut height) = (0.0, None);
    loop {
        let done = cycles / plan.cycles;
        let work = match CycleWork::of(&next, lattices.as_ref(), &mut |time| go_on(done, time)) {
            Ok(work) => work,
            Err(stop) if history.states.is_empty() => return Err(stop),
            Err(stop) => {
                history.stopped = Some(stop);
                return Ok(history);
            }
        };
        let first = *height.get_or_insert(work.height);
        let mut seen = state(case, &work, &wear, volumes, plan, cycles, first);
        seen.counterfaces = counterfaces.as_ref().map(|own| own.wear(case));
        history.states.push(seen);
        history.case.clone_from(&next);
        let left = plan.cycles - cycles;
        if left <= 0.0 {
            return Ok(history);
        }
        let part = largest_part(&history.case, &work, plan, &areas);
        let step = (plan.cycles / f64::from(plan.steps.max(1))).min(if part > 0.0 {
            LIMIT / part
        } else {
            f64::INFINITY
        });
        // Rounding makes no step of its own at the end.
        let last = step > left * (1.0 - 1e-9);
        let step = if last { left } else { step };
        let steps = (history.states.len() - 1) as f64 + left / step;
        if steps > f64::from(plan.most_steps) * (1.0 + 1e-9) {
            let error = WearError::TooManySteps {
                needed: steps.ceil(),
                most: plan.most_steps,
                part,
            };
            if history.states.len() == 1 {
                return Err(error.into());
            }
            history.stopped = Some(error.into());
            return Ok(history);
        }
        for face in 0..FACES.len() {
            for (point, own) in work.points[face].iter().enumerate() {
                let volume = step * plan.law.volume(own);
                wear[face][point] += volume / areas[face][point];
                volumes[face] += volume;
            }
        }
        if let (Some(own), Some(work)) = (&mut counterfaces, &work.counterfaces) {
            own.add(work, |own| step * plan.counterface * plan.law.volume(own));
        }
        cycles = if last { plan.cycles } else { cycles + step };
        next = match worn(case, &wear, counterfaces.as_ref()) {
            Ok(next) => next,
            Err(error) => {
                history.stopped = Some(error.into());
                return Ok(history);
            }
        };
    }
}

/// Returns both faces of a case.
fn faces(case: &Case) -> [&FaceProperties; FACES.len()] {
    [&case.parameters.column_face, &case.parameters.slope_face]
}

/// Returns the area of the face that each point stands for, m².
fn areas(case: &Case) -> [Vec<f64>; FACES.len()] {
    let rectangles = case.parameters.rectangles();
    let faces = faces(case);
    [0, 1].map(|face| faces[face].areas(&rectangles[face]))
}

/// Returns the depths that the points of a case have from the start.
fn start(case: &Case) -> [Vec<f64>; FACES.len()] {
    let (rectangles, faces) = (case.parameters.rectangles(), faces(case));
    [0, 1].map(|face| {
        let depth = |point| {
            let (up, across) = rectangles[face].distances(point);
            let map = faces[face].wedge_wear.as_ref();
            map.map_or(0.0, |map| map.depth(up, across))
        };
        faces[face].grid.points().iter().map(depth).collect()
    })
}

/// Returns the greatest depth that one cycle wears at a point, relative to its penetration.
fn largest_part(case: &Case, work: &CycleWork, plan: &WearPlan, areas: &[Vec<f64>; 2]) -> f64 {
    let (rectangles, faces) = (case.parameters.rectangles(), faces(case));
    let mut largest = 0.0_f64;
    for face in 0..FACES.len() {
        let points = faces[face].points(&rectangles[face], &case.parameters.contact);
        for ((point, own), area) in points.iter().zip(&work.points[face]).zip(&areas[face]) {
            if own.load_times_path > 0.0 && own.path > 0.0 {
                let penetration = own.load_times_path / own.path / point.stiffness;
                // Both partners open the gap.
                let both = (1.0 + plan.counterface) * plan.law.volume(own);
                largest = largest.max(both / area / penetration);
            }
        }
    }
    largest
}

/// Returns the summary of a cycle.
fn state(
    case: &Case,
    work: &CycleWork,
    wear: &[Vec<f64>; 2],
    volumes: [f64; 2],
    plan: &WearPlan,
    cycles: f64,
    first_height: f64,
) -> WearState {
    let areas = areas(case);
    let face = |face: usize| {
        let points = work.points[face].iter().zip(&areas[face]);
        FaceWear {
            depths: wear[face].clone(),
            pressures: points
                .map(|(own, area)| own.impulse / work.period / area)
                .collect(),
            volume: volumes[face],
            volume_per_cycle: work.points[face].iter().map(|own| plan.law.volume(own)).sum(),
            loss: work.losses[face],
            mean_force: work.mean_force(face),
        }
    };
    let cycle = crate::metrics::Cycle::of(&case.parameters);
    WearState {
        cycles,
        faces: [face(0), face(1)],
        counterfaces: None,
        rise: work.height - first_height,
        damping: cycle.map_or(0.0, |cycle| cycle.equivalent_damping(work.losses[0])),
        mismatch: work.mismatch(),
    }
}

/// Returns the lattices of both counterfaces.
fn lattices(case: &Case) -> [Lattice; FACES.len()] {
    let (rectangles, faces) = (case.parameters.rectangles(), faces(case));
    [0, 1].map(|face| Lattice::new(faces[face], &rectangles[face]))
}

/// Returns a case with these depths at the points of its faces, and of its counterfaces where these are worn.
fn worn(
    case: &Case,
    depths: &[Vec<f64>; 2],
    counterfaces: Option<&Counterfaces<'_>>,
) -> Result<Case, WearError> {
    let set = |section: &str, key: &str, map: DepthMap| {
        let points = map
            .points()
            .map(|point| point.map(|value| format!("\"{value:?} m\"")));
        let rows: Vec<String> = points.map(|point| format!("[{}]", point.join(", "))).collect();
        format!("{section}.{key}=[{}]", rows.join(", "))
    };
    let mut overrides = Vec::new();
    for (section, map) in FACE_SECTIONS.into_iter().zip(maps(case, depths)) {
        overrides.extend(map.map(|map| set(section, "wedge_wear", map)));
    }
    let counterfaces = counterfaces.into_iter().flat_map(|own| own.wear(case));
    for (section, worn) in FACE_SECTIONS.into_iter().zip(counterfaces) {
        overrides.extend(worn.map.map(|map| set(section, "counterface_wear", map)));
    }
    Case::parse(
        "case.toml",
        case.to_toml_embedded(),
        Tables::nowhere(),
        &overrides,
    )
    .map_err(|error| WearError::Case(Box::new(error)))
}

/// Returns these depths at the points of both faces as maps; none where there is nothing worn and no map
/// before.
#[must_use]
pub fn maps(case: &Case, depths: &[Vec<f64>; 2]) -> [Option<DepthMap>; 2] {
    let (rectangles, faces) = (case.parameters.rectangles(), faces(case));
    [0, 1].map(|face| {
        let points = faces[face].grid.points();
        let points: Vec<[f64; 3]> = points
            .iter()
            .zip(&depths[face])
            .map(|(point, depth)| {
                let (up, across) = rectangles[face].distances(point);
                [up, across, *depth]
            })
            .collect();
        DepthMap::new(&points).ok()
    })
}

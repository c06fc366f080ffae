//! The losses of a cycle of a truck, and the equivalent damping of its bounce.

use mechanics::motion::Motion;
use truck::Parameters;

use super::TruckCase;
use super::run;
use crate::contacts::{TakesCorners, corners};
use crate::losses::stroke::Stroke;
use crate::losses::{EnergySummary, Equivalent, Window};
use crate::metrics::{Cycle, FirstHarmonic, first_harmonic, harmonic};
use crate::run::Run;

/// The number of the vertical coordinate among those of a body.
const VERTICAL: usize = 2;
/// Bounce with a smaller amplitude is rounding, m.
const NO_BOUNCE: f64 = 1e-9;

/// The motion or load that defines the cycles of a truck: its first periodic motion, or else its first
/// periodic load.
#[derive(Clone, Copy, Debug)]
pub(super) struct CycleDrive {
    pub stroke: Stroke,
    /// The coordinate that moves or is loaded: 0 to 5 for x, y, z, roll, pitch, yaw.
    coordinate: usize,
    /// True if side frames or wheelsets move.
    below: bool,
}

/// Returns the drive of a truck, if something is periodic.
pub(super) fn drive(parameters: &Parameters) -> Option<CycleDrive> {
    let Parameters {
        bolster,
        side_frames,
        wheelsets,
        car_body,
        ..
    } = parameters;
    let mut courses: Vec<(&[Motion; 6], bool)> = vec![(&bolster.motion.coordinates, false)];
    courses.extend(side_frames.iter().map(|own| (&own.motion.coordinates, true)));
    let wheelsets = wheelsets.iter().flat_map(|wheelsets| &wheelsets.motions);
    courses.extend(wheelsets.map(|motion| (&motion.coordinates, true)));
    courses.push((&bolster.applied, false));
    courses.extend(side_frames.iter().map(|own| (&own.applied, false)));
    courses.extend(car_body.iter().map(|car| (&car.applied, false)));
    courses.into_iter().find_map(|(course, below)| {
        let mut coordinates = course.iter().enumerate();
        coordinates.find_map(|(coordinate, motion)| {
            let stroke = Stroke::of(motion)?;
            Some(CycleDrive {
                stroke,
                coordinate,
                below,
            })
        })
    })
}

/// Returns the whole cycles after the first.
pub(super) fn window(case: &TruckCase) -> Option<Window> {
    let (ends, cycles) = run::window(case)?;
    let stroke = drive(&case.parameters)?.stroke;
    Some(Window { ends, cycles, stroke })
}

/// Returns the energies of a cycle of a run; `column` gives the values of a column.
pub(super) fn of<'c>(run: &Run<TruckCase>, column: &impl Fn(&str) -> &'c [f64]) -> EnergySummary {
    let case = &run.case;
    let units = case.simulation.output_units;
    let Some(drive) = drive(&case.parameters) else {
        return EnergySummary::none("no motion or load is a sine or a triangle");
    };
    let Some(window) = window(case) else {
        return EnergySummary::none("no whole cycle after the first one");
    };
    let mut names: Vec<String> = Vec::with_capacity(run.system.point_count());
    for mounted in run.system.faces() {
        let (name, points) = (&mounted.element.name, mounted.element.points.len());
        names.extend((1..=points).map(|point| format!("{name}_{point}")));
    }
    for corner in corners(&run.system, &run.recorder.wedges()) {
        names[corner.place] = corner.name;
    }
    let Some((summary, lost)) = run.recorder.losses.summary(&run.system, &names, units) else {
        return EnergySummary::none("the run stopped before its last whole cycle ended");
    };
    let bounce = (drive.coordinate == VERTICAL)
        .then(|| bounce(case, &window, drive.below, column))
        .flatten();
    EnergySummary {
        equivalent: bounce.map(|(cycle, harmonic)| Equivalent::new(lost, &cycle, harmonic, units)),
        ..summary
    }
}

/// Returns the cycle of the bolster's vertical motion (where side frames or wheelsets are what moves:
/// relative to the mean of the side frames), and stiffness and damping of the first harmonic of the nests'
/// force. The amplitude is that of the prescribed motion, if it is one sine or triangle, else that of the
/// first harmonic. `None` if there is no such motion.
fn bounce<'c>(
    case: &TruckCase,
    window: &Window,
    below: bool,
    column: &impl Fn(&str) -> &'c [f64],
) -> Option<(Cycle, Option<FirstHarmonic>)> {
    let times = column("time");
    let frames = ["left", "right"].map(|side| column(&format!("{side}_side_frame_z")));
    let nests = ["left", "right"].map(|side| column(&format!("{side}_nest_vertical_force")));
    let mean = |row: usize| {
        if below {
            0.5 * (frames[0][row] + frames[1][row])
        } else {
            0.0
        }
    };
    let rows = column("bolster_z").iter().enumerate();
    let travel: Vec<f64> = rows.map(|(row, z)| z - mean(row)).collect();
    let force: Vec<f64> = nests[0]
        .iter()
        .zip(nests[1])
        .map(|(left, right)| left + right)
        .collect();
    let frequency = 2.0 * std::f64::consts::PI / window.stroke.period;
    let ends = (window.ends[0], window.ends[1]);
    let cycle = match Cycle::of_motion(&case.parameters.bolster.motion.coordinates[VERTICAL]) {
        Some(cycle) => cycle,
        None => {
            let [cos, sin] = harmonic(times, &travel, frequency, ends)?;
            let amplitude = (cos * cos + sin * sin).sqrt();
            (amplitude > NO_BOUNCE).then(|| Cycle::sine(amplitude, frequency))?
        }
    };
    Some((cycle, first_harmonic(times, &travel, &force, frequency, ends)))
}

//! The start of a car: at rest on straight track, moved along the track.

use std::ops::Range;
use std::sync::Arc;

use mechanics::body::Body;
use mechanics::connection::Law;
use mechanics::friction::FrictionLaw;
use mechanics::orientation::fixed;
use mechanics::system::{AtRest, NoEquilibrium, Observation, StaticFriction, System};
use mechanics::vector::{Matrix, Vector};
use rolling::wheel::Search;
use rolling::wheelset::coordinate;
use truck::{TruckFrame, WedgeLoads};
use wheelrail::track::{CenterLine, Line, RailLines, Segment, Track};

use crate::assemble::Nominal;
use crate::body::{Carried, Pose, angles};
use crate::error::BuildError;
use crate::parameters::{Drive, Parameters, Wheels};
use crate::tipping::has_tipped;

/// The coordinates of a wheelset along its axle and about the vertical.
const ASIDE: [usize; 2] = [0, 4];

/// A car at rest on straight perfect track, from the middle between the trucks.
#[derive(Clone, Debug)]
pub(crate) struct Resting {
    /// The poses of all bodies.
    pub poses: Vec<Pose>,
    /// The internal states: deflections of bristles and accumulators, m.
    pub internal: Vec<f64>,
    /// Those of elements, such as the rolls of rails.
    pub states: Vec<(String, [f64; 2])>,
    /// The wedges of both trucks.
    pub wedges: [[WedgeLoads; 4]; 2],
    /// The warning of a state that is nearly at rest.
    pub warning: Option<String>,
    /// True if the body has turned over.
    has_tipped: bool,
}

/// A car that stands on straight perfect track and coasts.
struct Standing {
    nominal: Nominal,
    /// Distance of the middle between the trucks along the track, m.
    middle: f64,
}

impl Standing {
    fn new(
        parameters: &Parameters,
        carried: &Carried,
        searches: &[[Search; 2]],
        offsets: [f64; 2],
    ) -> Result<Self, BuildError> {
        let middle = parameters.reach() + 10.0;
        let straight = CenterLine::new(
            &[Segment::Tangent(2.0 * middle)],
            parameters.track.center_line.rail_distance(),
            &[],
        );
        let track = Track {
            center_line: straight?,
            irregularities: Vec::new(),
        };
        let lines = Arc::new(RailLines::new(track, offsets));
        let still = Parameters {
            drive: Drive::Coasting,
            ..parameters.clone()
        };
        let mut nominal = Nominal::new(&still, carried, searches, &lines, 0.0);
        for body in &mut nominal.model.bodies {
            if !body.is_prescribed() && body.free[3] {
                body.frame.origin[0] += middle;
            }
        }
        nominal.carry();
        Ok(Self { nominal, middle })
    }

    /// Lets it come to rest from its bodies' initial coordinates, with these internal states, if there are
    /// any. `fails` makes the error of a car that does not.
    fn rest(
        self,
        internal: &[f64],
        fails: impl FnOnce(&mut System, usize, NoEquilibrium) -> BuildError,
    ) -> Result<Resting, BuildError> {
        let body = self.nominal.numbers.body;
        let wheelsets = self.nominal.numbers.wheelsets;
        let bolsters = self.nominal.numbers.bolsters;
        let trucks = self.nominal.trucks;
        let mut system = System::new(self.nominal.model)?;
        let own = internal_states(&system);
        let mut state = system.initial_state();
        if internal.len() == own.len() {
            state[own.clone()].copy_from_slice(internal);
        }
        let found = system.start_at_rest(0.0, &state, StaticFriction::Following);
        let AtRest { state, warning } = found.map_err(|error| fails(&mut system, body, error))?;
        let seen: Observation = system.observe(0.0, &state);
        // Nothing holds the car along the track.
        let rolled = wheelsets.map(|number| seen.bodies[number].travel.0[0]);
        let middle = self.middle + 0.25 * rolled.iter().sum::<f64>();
        let wedges = [0, 1].map(|t| {
            let [x, ..] = seen.bodies[bolsters[t]].center_of_gravity.0;
            let frame = TruckFrame {
                origin: Vector([x, 0.0, 0.0]),
                axes: Matrix::identity(),
            };
            trucks[t].loads(&seen, &frame).wedges
        });
        let poses = seen.bodies.iter().zip(system.bodies()).map(|(state, body)| {
            let moved = if body.free[3] { middle } else { 0.0 };
            Pose {
                place: state.origin - Vector([moved, 0.0, 0.0]),
                rotation: state.rotation,
            }
        });
        let poses = poses.collect();
        Ok(Resting {
            has_tipped: has_tipped(&mut system, body, &state),
            poses,
            internal: state[own].to_vec(),
            states: system.element_states(&state),
            wedges,
            warning,
        })
    }
}

/// Returns the places of the internal states in the state of a system.
pub(crate) fn internal_states(system: &System) -> Range<usize> {
    let layout = system.layout();
    2 * layout.speeds..2 * layout.speeds + layout.internals
}

/// Returns the equilibrium at rest on straight track, without friction of the wedges.
pub(crate) fn at_rest(
    parameters: &Parameters,
    carried: &Carried,
    searches: &[[Search; 2]],
    offsets: [f64; 2],
) -> Result<Resting, BuildError> {
    // Tipped over, bodies may come to rest too.
    if let Some(tipping) = parameters.tips_over() {
        return Err(BuildError::Tips(tipping));
    }
    let mut standing = Standing::new(parameters, carried, searches, offsets)?;
    let nominal = &mut standing.nominal;
    // Wedges are without friction; plates and adapters hold, since nothing else does.
    for (carried, .., face) in &mut nominal.model.faces {
        if nominal.numbers.wedges.iter().flatten().any(|own| own == carried) {
            face.coefficient = 0.0;
            face.law = FrictionLaw::Tanh { reference_speed: 1.0 };
        }
    }
    // Hysteresis has none either.
    for connection in &mut nominal.model.connections {
        match &mut connection.law {
            Law::Wedge(wedge) => (wedge.column_friction, wedge.slope_friction) = (0.0, 0.0),
            Law::Surface(surface) => surface.coefficient = 0.0,
            Law::Springs(_) | Law::Gap(..) => {}
        }
    }
    let found = standing.rest(&[], |system, body, error| {
        parameters.no_equilibrium(system, body, error)
    })?;
    match found.has_tipped {
        true => Err(BuildError::Tips(parameters.leans_over())),
        false => Ok(found),
    }
}

/// Returns what the car rests in from these poses and internal states, with all friction. Wheelsets that
/// are held neither move aside nor turn.
pub(crate) fn at_rest_from(
    (parameters, carried, searches, offsets): (&Parameters, &Carried, &[[Search; 2]], [f64; 2]),
    poses: &[Pose],
    internal: &[f64],
    holds: bool,
) -> Result<Resting, BuildError> {
    let mut standing = Standing::new(parameters, carried, searches, offsets)?;
    let middle = Vector([standing.middle, 0.0, 0.0]);
    let nominal = &mut standing.nominal;
    for (number, _) in nominal.groups.clone() {
        let pose = Pose {
            place: poses[number].place + middle,
            ..poses[number]
        };
        put_body(&mut nominal.model.bodies[number], &pose);
    }
    for number in nominal.numbers.wheelsets.into_iter().filter(|_| holds) {
        for coordinate in ASIDE {
            nominal.model.bodies[number].free[coordinate] = false;
        }
    }
    for number in nominal.numbers.rails.into_iter().flatten().flatten() {
        let [x, y, z] = poses[number].place.0;
        nominal.model.bodies[number].initial = [x, y, z, 0.0, 0.0, 0.0];
    }
    nominal.carry();
    let found = standing.rest(internal, |_, _, error| BuildError::ShakenRest(error))?;
    match found.has_tipped {
        true => Err(BuildError::Tips(parameters.leans_over())),
        false => Ok(found),
    }
}

/// Lets a body start in a pose in fixed axes.
fn put_body(body: &mut Body, pose: &Pose) {
    let frame = fixed(body.frame.orientation);
    let own: Matrix<f64> = frame.transpose().times(pose.rotation);
    let turn = angles(&own);
    let place: Vector<f64> = frame.apply_transposed(pose.place - Vector(body.frame.origin));
    body.initial = [place.0[0], place.0[1], place.0[2], turn[0], turn[1], turn[2]];
}

/// The poses of trucks and body on the track at the start, in fixed axes.
pub(crate) struct Placement {
    /// Of front truck, rear truck and body: the pose of the axes that are forward, left, up in the nominal
    /// layout, from the middle between the trucks.
    groups: [Pose; 3],
    /// Their angular velocities about the vertical, and velocities of their centers.
    angular_velocities: [Vector<f64>; 3],
    moving: [Vector<f64>; 3],
}

impl Placement {
    pub fn new(parameters: &Parameters, lines: &RailLines, axes: Matrix<f64>) -> Self {
        let (start, half) = (&parameters.start, 0.5 * parameters.truck_distance);
        let of = |v: [f64; 3]| -> Vector<f64> { axes.apply(Vector(v)) };
        // Axes along a chord between two sections, upright as their mean is.
        let between = |[front, rear]: [(Vector<f64>, Vector<f64>); 2]| -> Pose {
            let along = front.0 - rear.0;
            let x = along.scale::<f64, f64>(1.0 / length(along));
            let up = front.1 + rear.1;
            let left: Vector<f64> = up.cross(x);
            let y = left.scale::<f64, f64>(1.0 / length(left));
            let z: Vector<f64> = x.cross(y);
            let sum = front.0 + rear.0;
            Pose {
                place: sum.scale(0.5),
                rotation: Matrix([0, 1, 2].map(|row| [x.0[row], y.0[row], z.0[row]])),
            }
        };
        // The middle between the actual rails, and up there.
        let section = |distance: f64| {
            let [left, right] = [Line::Left, Line::Right].map(|line| lines.section_at(line, distance));
            let [a, b] = [of(left.origin), of(right.origin)];
            let up: Vector<f64> = of(left.axes[0]).cross(a - b);
            ((a + b).scale(0.5), up.scale::<f64, f64>(1.0 / length(up)))
        };
        let mut trucks = [0, 1].map(|t| {
            let center = start.distance + [half, -half][t];
            let axle = parameters.trucks[t].geometry.axle();
            between([section(center + axle), section(center - axle)])
        });
        let ends = trucks.map(|pose| (pose.place, pose.rotation.column(2)));
        let mut body = between(ends);
        let along = |distance: f64| {
            let section = lines.section_at(Line::Center, distance);
            let angular_velocities = Vector([0.0, 0.0, section.curvature * start.speed]);
            (angular_velocities, section.curvature)
        };
        let angular_velocities =
            [start.distance + half, start.distance - half, start.distance].map(|at| along(at).0);
        let moving = [trucks[0], trucks[1], body].map(|pose| {
            let ahead: Vector<f64> = pose.rotation.column(0);
            ahead.scale(start.speed)
        });
        // Poses of the nominal layout's origin, the middle between the trucks.
        for (pose, center) in trucks.iter_mut().zip([half, -half]) {
            pose.place = pose.place - pose.rotation.column(0).scale::<f64, f64>(center);
        }
        let aside: Vector<f64> = body.rotation.column(1);
        body.place += aside.scale(start.body_shift);
        Self {
            groups: [trucks[0], trucks[1], body],
            angular_velocities,
            moving,
        }
    }

    /// Moves all bodies to where they start; returns the rates of their coordinates.
    pub fn put(
        &self,
        nominal: &mut Nominal,
        poses: &[Pose],
        parameters: &Parameters,
    ) -> Vec<(usize, [f64; 6])> {
        let half = 0.5 * parameters.truck_distance;
        let mut speeds = Vec::new();
        for &(number, group) in &nominal.groups {
            let base = &self.groups[group];
            let mut pose = poses[number].after(base);
            let wheelset = nominal.numbers.wheelsets.iter().position(|own| *own == number);
            if let Some(w) = wheelset {
                let axle: Vector<f64> = base.rotation.column(1);
                pose.place += axle.scale(parameters.start.wheelset_shifts[w]);
            }
            let body = &mut nominal.model.bodies[number];
            let frame = fixed(body.frame.orientation);
            put_body(body, &pose);
            let center = match group {
                2 => base.place,
                _ => {
                    let ahead: Vector<f64> = base.rotation.column(0);
                    base.place + ahead.scale::<f64, f64>([half, -half][group])
                }
            };
            let swing: Vector<f64> = self.angular_velocities[group].cross(pose.place - center);
            let velocity: Vector<f64> = frame.apply_transposed(self.moving[group] + swing);
            let mut rates = [velocity.0[0], velocity.0[1], velocity.0[2], 0.0, 0.0, 0.0];
            // Both kinds of bodies have the heading as their first angle.
            rates[4] = self.angular_velocities[group].0[2];
            if let Some(w) = wheelset {
                rates[3] = parameters.start.speed / parameters.axle_radius(w);
                if let Wheels::OnRails(wheels) = &parameters.wheels {
                    let [rise, rate] = wheels.rise(w);
                    for (k, own) in [coordinate::VERTICAL, coordinate::ROLL].into_iter().enumerate() {
                        body.initial[own] += rise[k];
                        rates[own] += rate[k] * rates[3];
                    }
                }
            }
            speeds.push((number, rates));
        }
        if let Some(rails) = nominal.numbers.rails {
            for (w, number) in rails
                .into_iter()
                .enumerate()
                .flat_map(|(w, pair)| pair.map(|own| (w, own)))
            {
                let moved: Vector<f64> = self.groups[w / 2].rotation.apply(poses[number].place);
                nominal.model.bodies[number].initial = [moved.0[0], moved.0[1], moved.0[2], 0.0, 0.0, 0.0];
            }
        }
        nominal.carry();
        speeds
    }
}

fn length(v: Vector<f64>) -> f64 {
    v.dot::<f64, f64>(v).sqrt()
}

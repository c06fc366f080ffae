//! From the document to plain SI numbers.

use super::Simulation;
use super::document as typed;
use super::face::SECTIONS;
use super::motion::{CaseMotion as TypedMotion, MotionProfile};
use super::table::QuantityTable;
use mechanics::characteristic::Characteristic;
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use mechanics::motion::{Motion, Piece, RampProfile};
use mechanics::spline::Spline;
use quantity::{Quantity, STANDARD_GRAVITY};
use wedge::face::FaceProperties;
use wedge::parameters::{
    Contact, ControlCoil, Damping, FaceFriction, NeighbourMotion, Parameters, Start, Wear, WedgeBody,
};

/// The mistake of a document that cannot be resolved: the path of the value, and why.
pub(super) struct Unresolved {
    pub path: String,
    pub reason: String,
}

/// Returns the physical parameters. `document` has been checked value by value.
pub(super) fn parameters(document: &typed::CaseDocument) -> Result<Parameters, Unresolved> {
    let parameters = Parameters {
        damping: match document.wedge.damping {
            typed::Damping::Variable => Damping::Variable,
            typed::Damping::Constant => Damping::Constant,
        },
        wedge: wedge(&document.wedge),
        wear: {
            let own = &document.wedge;
            let angles = [own.angle.to_si(), document.toe.to_si(), 0.0];
            own.rise.wear(angles).unwrap_or_else(|| Wear {
                column: own.column_wear.to_si(),
                slope: own.slope_wear.to_si(),
            })
        },
        coil: coil(&document.control_coil)?,
        contact: Contact {
            stiffness: document.contact.stiffness.to_si(),
            damping: document.contact.damping.to_si(),
        },
        column_friction: face(
            &document.friction,
            document.friction.column_law,
            document.friction.column,
        ),
        slope_friction: face(
            &document.friction,
            document.friction.slope_law,
            document.friction.slope,
        ),
        column_face: face_properties(document, 0)?,
        slope_face: face_properties(document, 1)?,
        toe: document.toe.to_si(),
        toe_pivot: document.toe_pivot.to_si(),
        side_frame: neighbour("side_frame", &document.side_frame)?,
        bolster: neighbour("bolster", &document.bolster)?,
        gravity: document.environment.gravity.to_si(),
        start: match document.simulation.start {
            typed::Start::Rest => Start::Rest,
            typed::Start::Touching => Start::Touching,
            typed::Start::Equilibrium => Start::Equilibrium,
        },
    };
    match parameters.validate() {
        Ok(()) => Ok(parameters),
        Err(error) => Err(Unresolved {
            path: error.path.into(),
            reason: error.to_string(),
        }),
    }
}

/// Returns the settings of the run.
pub(super) fn simulation(section: &typed::SimulationSection) -> Simulation {
    Simulation {
        duration: section.duration.to_si(),
        output_interval: section.output_interval.to_si(),
        relative_tolerance: section.relative_tolerance,
        output_units: section.output_units,
        method: section.method,
    }
}

fn si3(values: &[Quantity; 3]) -> [f64; 3] {
    [values[0].to_si(), values[1].to_si(), values[2].to_si()]
}

fn wedge(section: &typed::WedgeSection) -> WedgeBody {
    let mut free = [false; 6];
    for coordinate in &section.free_coordinates {
        free[*coordinate as usize] = true;
    }
    WedgeBody {
        angle: section.angle.to_si(),
        height: section.height.to_si(),
        width: section.width.to_si(),
        mass: section.weight.to_si() / STANDARD_GRAVITY,
        inertia: si3(&section.inertia),
        center_of_gravity: si3(&section.center_of_gravity),
        free,
    }
}

fn coil(section: &typed::CoilSection) -> Result<ControlCoil, Unresolved> {
    let law = match &section.force {
        typed::CoilForce::Stiffness(stiffness) => CoilLaw::Linear {
            stiffness: stiffness.to_si(),
        },
        typed::CoilForce::Table(table) => {
            let points = table
                .rows
                .iter()
                .map(|[x, force]| [x.to_si(), force.to_si()])
                .collect();
            CoilLaw::Table(Characteristic::new(points).map_err(|error| Unresolved {
                path: "control_coil.table".into(),
                reason: error.to_string(),
            })?)
        }
    };
    Ok(ControlCoil {
        law,
        free_length: section.free_length.to_si(),
        nominal_length: section.nominal_length.to_si(),
        damping: section.damping.to_si(),
        rotational_damping: section.rotational_damping.to_si(),
        acts_at: match section.acts_at {
            typed::ActsAt::CenterOfGravity => CoilLine::CenterOfGravity,
            typed::ActsAt::Seat => CoilLine::Seat,
        },
        pulls: section.pulls,
    })
}

fn face(section: &typed::FrictionSection, law: typed::FrictionLaw, coefficient: f64) -> FaceFriction {
    let law = match law {
        typed::FrictionLaw::Tanh => FrictionLaw::Tanh {
            reference_speed: section.reference_speed.to_si(),
        },
        typed::FrictionLaw::Bristle => FrictionLaw::Bristle {
            stiffness: section.bristle_stiffness.to_si(),
            damping: section.bristle_damping.to_si(),
        },
    };
    FaceFriction { coefficient, law }
}

fn face_properties(document: &typed::CaseDocument, number: usize) -> Result<FaceProperties, Unresolved> {
    document.faces[number]
        .resolve()
        .map(|face| FaceProperties {
            friction_directions: document.friction.directions,
            ..face
        })
        .map_err(|(key, error)| Unresolved {
            path: format!("{}.{key}", SECTIONS[number]),
            reason: error.to_string(),
        })
}

fn neighbour(path: &str, section: &typed::NeighbourSection) -> Result<NeighbourMotion, Unresolved> {
    let mut coordinates = NeighbourMotion::fixed().coordinates;
    for ((coordinate, typed), key) in coordinates
        .iter_mut()
        .zip(&section.coordinates)
        .zip(typed::NeighbourSection::COORDINATES)
    {
        *coordinate = motion(typed).map_err(|reason| Unresolved {
            path: format!("{path}.{key}"),
            reason,
        })?;
    }
    Ok(NeighbourMotion {
        center: section.center.as_ref().map(si3),
        coordinates,
    })
}

/// Returns a motion, SI.
pub(crate) fn motion(typed: &TypedMotion) -> Result<Motion, String> {
    Ok(match typed {
        TypedMotion::Constant(value) => Motion::Constant(value.to_si()),
        TypedMotion::Sine {
            amplitude,
            frequency,
            phase,
        } => Motion::Sine {
            amplitude: amplitude.to_si(),
            angular_frequency: frequency.to_si(),
            phase: phase.to_si(),
        },
        TypedMotion::Triangle { amplitude, frequency } => Motion::Triangle {
            amplitude: amplitude.to_si(),
            angular_frequency: frequency.to_si(),
        },
        TypedMotion::SweptSine {
            amplitude,
            start_frequency,
            end_frequency,
            duration,
        } => Motion::SweptSine {
            amplitude: amplitude.to_si(),
            start: start_frequency.to_si(),
            end: end_frequency.to_si(),
            duration: duration.to_si(),
        },
        TypedMotion::Ramp {
            amplitude,
            start,
            duration,
            profile,
        } => Motion::Ramp {
            amplitude: amplitude.to_si(),
            start: start.to_si(),
            duration: duration.to_si(),
            profile: match profile {
                MotionProfile::Smooth => RampProfile::Smooth,
                MotionProfile::Linear => RampProfile::Linear,
                MotionProfile::HalfCosine => RampProfile::HalfCosine,
            },
        },
        TypedMotion::Table(table) => Motion::Table(spline(table)?),
        TypedMotion::Sum(parts) => Motion::Sum(parts.iter().map(motion).collect::<Result<_, _>>()?),
        TypedMotion::From { start, motion: own } => Motion::Sequence(vec![Piece {
            start: start.to_si(),
            motion: motion(own)?,
        }]),
    })
}

fn spline(table: &QuantityTable) -> Result<Spline, String> {
    let (times, values) = table
        .rows
        .iter()
        .map(|[time, value]| (time.to_si(), value.to_si()))
        .unzip();
    Spline::new(times, values).map_err(|error| error.to_string())
}

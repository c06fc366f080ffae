//! The assumptions of a run in words.

use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::contact::FrictionDirections;
use mechanics::friction::FrictionLaw;
use mechanics::surface::SurfaceProfile;
use wedge::Wedge;
use wedge::face::{FaceDirection, FaceProperties, Grid};
use wedge::parameters::{Damping, FaceFriction, STANDARD_GRAVITY, Start, Wear};

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Returns the assumptions of a run.
#[must_use]
pub fn of(wedge: &Wedge) -> Vec<String> {
    let p = &wedge.parameters;
    let mut list = Vec::new();
    let stiffness = p.contact.stiffness * INCH / POUND_FORCE;
    list.push(format!(
        "Contact stiffness is {stiffness:.4e} lbf/in per corner ({:.4e} per face): the thesis gives none; \
         2.5e5 is the value that reproduces its force levels.",
        4.0 * stiffness
    ));
    if p.contact.damping == 0.0 {
        list.push(
            "Contacts have no damping: they ring, and runs without yaw are chaotic in detail.".to_owned(),
        );
    }
    list.push(match p.damping {
        Damping::Variable => "The coil stands on the side frame (variable damping).".to_owned(),
        Damping::Constant => "The coil stands in the bolster pocket (constant damping).".to_owned(),
    });
    list.push(match p.coil.acts_at {
        CoilLine::CenterOfGravity => "The coil's force acts through the centre of gravity although its \
                                      length is measured at the wedge's bottom, as in the thesis's moment \
                                      equations; the work of the guiding couple that this takes is in the \
                                      ledger as coil_guide_work."
            .to_owned(),
        CoilLine::Seat => "The coil's force acts where the coil ends, at the wedge's bottom, with its \
                           moment."
            .to_owned(),
    });
    if p.coil.pulls {
        list.push(match p.coil.law {
            CoilLaw::Linear { .. } => "The coil pushes and pulls, as in the thesis.".to_owned(),
            CoilLaw::Table(_) => {
                "The coil's table goes on beyond its ends with their slopes, also into tension.".to_owned()
            }
            CoilLaw::Given { .. } => "The coil's force is given from outside.".to_owned(),
        });
    }
    let faces = [
        ("column", &p.column_friction, &p.column_face),
        ("slope", &p.slope_friction, &p.slope_face),
    ];
    for (name, friction, face) in faces {
        list.push(friction_assumption(name, &face.friction(friction)));
        if face.friction_directions == FrictionDirections::One {
            list.push(format!(
                "Friction at the {name} acts along the face's line of travel alone, one tangent as in the \
                 thesis's equations: nothing holds a corner across."
            ));
        }
        list.extend(of_face(name, face));
    }
    if p.toe_pivot != 0.0 {
        list.push(format!(
            "Toe turns the column about a point {:.4} in above the middle of the wedge's face.",
            p.toe_pivot / INCH
        ));
    }
    list.push(match p.start {
        Start::Rest => "The run starts at rest in the nominal position, whatever penetrates: with toe or \
                        yaw the first moments are a release of stored energy."
            .to_owned(),
        Start::Touching => format!(
            "The run starts at rest; column and pocket were moved apart by {:.6} and {:.6} in until nothing \
             penetrates.",
            wedge.column_shift / INCH,
            wedge.pocket_shift / INCH
        ),
        Start::Equilibrium => "The run starts in frictionless static equilibrium.".to_owned(),
    });
    if p.wear != Wear::default() {
        let flat = [&p.column_face, &p.slope_face].into_iter().all(|face| {
            let surfaces = [&face.wedge_surface, &face.counterface];
            surfaces.into_iter().all(|own| own.profile.is_flat())
                && face.wedge_wear.is_none()
                && face.counterface_wear.is_none()
        });
        list.push(format!(
            "The faces are worn by {:.4} in (column) and {:.4} in (slope){}: a rigid wedge stands {:.4} in \
             higher for it.",
            p.wear.column / INCH,
            p.wear.slope / INCH,
            if flat { ", and still flat" } else { "" },
            p.wedge_rise() / INCH
        ));
    }
    let faces = [
        p.column_face.friction(&p.column_friction),
        p.slope_face.friction(&p.slope_friction),
    ];
    if faces.iter().any(|own| own.coefficient > 0.0) {
        list.push(
            "Friction holds a wedge where it came to rest, so the start matters for seconds.".to_owned(),
        );
    }
    list.push(
        "The bolster turns about the centre of its pocket's slope unless a centre is named; the side frame \
         about the centre of its column face."
            .to_owned(),
    );
    list.push(
        "Face A lies at p1 - h1/3 in the wedge frame, so that the centre of gravity is as far from it as \
         the prism's centroid; moments of inertia are principal, about the centre of gravity."
            .to_owned(),
    );
    let held: Vec<&str> = mechanics::body::COORDINATES
        .into_iter()
        .zip(p.wedge.free)
        .filter_map(|(name, free)| (!free).then_some(name))
        .collect();
    if !held.is_empty() {
        list.push(format!("Held coordinates of the wedge: {}.", held.join(", ")));
    }
    if p.gravity != STANDARD_GRAVITY {
        list.push(format!("Gravity is {} m/s².", p.gravity));
    }
    list
}

/// Returns the properties of a face beyond four corners, flat surfaces and one coefficient of friction;
/// `None` if nothing.
pub(crate) fn of_face(name: &str, face: &FaceProperties) -> Option<String> {
    let mut parts = Vec::new();
    if face.grid != Grid::default() {
        parts.push(format!(
            "{} x {} points with the weights of the trapezoidal rule, so that it resists tilting less than \
             four corners",
            face.grid.up, face.grid.across
        ));
    }
    for (own, whose) in [
        (&face.wedge_surface, "the wedge's"),
        (&face.counterface, "the opposite"),
    ] {
        let way = match own.direction {
            FaceDirection::Up => "up",
            FaceDirection::Across => "across",
        };
        match &own.profile {
            SurfaceProfile::Flat => {}
            SurfaceProfile::Arc { curvature } => {
                let kind = if *curvature < 0.0 { "hollow" } else { "crowned" };
                let flat = own.half_flat().map_or(String::new(), |half| {
                    format!(", worn flat over {:.4} in in its middle", 2.0 * half / INCH)
                });
                parts.push(format!(
                    "{whose} surface {kind} {way} the face by a radius of {:.4} in{flat}",
                    1.0 / (curvature.abs() * INCH)
                ));
            }
            SurfaceProfile::Table(_) => {
                parts.push(format!("{whose} surface by a table of depths {way} the face"))
            }
        }
    }
    for (map, whose) in [
        (&face.wedge_wear, "the wedge's"),
        (&face.counterface_wear, "the opposite"),
    ] {
        let Some(map) = map else { continue };
        let deepest = map
            .points()
            .map(|[.., depth]| depth)
            .fold(f64::NEG_INFINITY, f64::max);
        parts.push(format!(
            "{whose} surface worn by a map of depths, {:.4e} in at most",
            deepest / INCH
        ));
    }
    if let Some(sliding) = face.sliding_friction {
        parts.push(format!(
            "a coefficient of sliding of {sliding}, half way there at {:.3e} in/s",
            face.stribeck_speed / INCH
        ));
    }
    if let Some(load) = face.friction_half_load {
        parts.push(format!(
            "half of its friction coefficient at {:.4e} lbf",
            load / POUND_FORCE
        ));
    }
    if !face.friction_map.is_empty() {
        parts.push("friction by a map over the face".to_owned());
    }
    if let Some(pad) = &face.pad {
        parts.push(format!(
            "a pad of {:.4e} lbf/in, which is no steel on steel and stands for all of the contact's \
             stiffness",
            pad.stiffness * INCH / POUND_FORCE
        ));
    }
    (!parts.is_empty()).then(|| format!("The {name} has {}.", parts.join("; ")))
}

fn friction_assumption(face: &str, friction: &FaceFriction) -> String {
    match friction.law {
        FrictionLaw::Tanh { reference_speed } => format!(
            "Friction at the {face}: tanh law, μ = {}, v0 = {:.3e} in/s: it never sticks truly, a corner \
             that holds half its limit creeps by {:.2e} in/s; v0 is part of the model (ten times v0 moves \
             the branches by a fifth and more).",
            friction.coefficient,
            reference_speed / INCH,
            friction.law.creep_speed(0.5) / INCH
        ),
        FrictionLaw::Bristle { stiffness, damping } => format!(
            "Friction at the {face}: bristle law, μ = {}, {:.3e} lbf/in and {:.3e} lbf s/in per face: it \
             holds a load without creep.",
            friction.coefficient,
            stiffness * INCH / POUND_FORCE,
            damping * INCH / POUND_FORCE
        ),
    }
}

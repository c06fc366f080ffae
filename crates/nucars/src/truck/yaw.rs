//! The bolster's yaw as the files mean it.
//!
//! Printed: a rotation spring of 1e6 in-lb/rad is to yaw the bolster against two longitudinal springs of 1e6 lb/in at
//! y = ±39.5 in, that is 3.12e9 in-lb/rad, and reaches 2e-6 of 0.012 rad. A translation's stiffness was copied to a rotation.

use mechanics::motion::Motion;
use mechanics::small::{Curve, Kind, Law, Model};

use super::choices::Yaw;
use super::convert::MOMENT;

/// Stiffness of the yaw spring that drives the bolster as intended, in-lb/rad.
pub(super) const PRINTED_UNITS_STIFFNESS: f64 = 1e10;
/// The same, N·m/rad.
pub const DRIVEN_YAW_STIFFNESS: f64 = PRINTED_UNITS_STIFFNESS * MOMENT;

/// Changes a model so that its input bodies yaw what they drive. Gives the numbers of the connections that were left out,
/// counted before.
pub fn intended_yaw(model: &mut Model, yaw: Yaw) -> Vec<usize> {
    match yaw {
        Yaw::AsPrinted => Vec::new(),
        Yaw::Dropped => drop_springs(model),
        Yaw::Driven => {
            drive_bodies(model);
            Vec::new()
        }
    }
}

/// Whether a body is moved by histories.
fn moved(model: &Model, body: usize) -> Option<&[Motion; 6]> {
    match &model.bodies.get(body)?.kind {
        Kind::Prescribed { motions } => Some(motions),
        Kind::Free { .. } => None,
    }
}

fn drop_springs(model: &mut Model) -> Vec<usize> {
    let mut dropped = Vec::new();
    for (number, connection) in model.connections.iter().enumerate() {
        let Law::Springs(springs) = &connection.law else {
            continue;
        };
        let center = |body: usize| model.bodies[body].center_of_gravity[1];
        let only = |coordinate: usize| springs.iter().all(|(own, _)| *own == coordinate);
        // Longitudinal, between an input body and a body that lies beside it.
        let inputs = [connection.a, connection.b]
            .into_iter()
            .filter(|body| drives(model, *body))
            .count();
        if inputs == 1 && only(0) && (center(connection.a) - center(connection.b)).abs() > 1e-9 {
            dropped.push(number);
        }
    }
    let stiff = Curve::linear(DRIVEN_YAW_STIFFNESS);
    let yawing: Vec<bool> = model
        .connections
        .iter()
        .map(|connection| {
            [connection.a, connection.b]
                .into_iter()
                .any(|body| moved(model, body).is_some_and(|motions| !motions[5].is_constant()))
        })
        .collect();
    for (connection, yawing) in model.connections.iter_mut().zip(yawing) {
        if let (Law::Springs(springs), true) = (&mut connection.law, yawing) {
            for (_, spring) in springs.iter_mut().filter(|(coordinate, _)| *coordinate == 5) {
                spring.spring = Some(stiff.clone());
                spring.compression_limit = f64::NEG_INFINITY;
                spring.extension_limit = f64::INFINITY;
            }
        }
    }
    let mut number = 0;
    model.connections.retain(|_| {
        number += 1;
        !dropped.contains(&(number - 1))
    });
    dropped
}

/// Whether a body is an input body: prescribed, and not the ground at the origin.
fn drives(model: &Model, body: usize) -> bool {
    moved(model, body).is_some() && model.bodies[body].center_of_gravity != [0.0; 3]
}

fn drive_bodies(model: &mut Model) {
    let yaw = (0..model.bodies.len()).find_map(|body| {
        let motion = &moved(model, body)?[5];
        (!motion.is_constant()).then(|| (motion.clone(), model.bodies[body].center_of_gravity[1]))
    });
    let Some((yaw, middle)) = yaw else { return };
    for body in 0..model.bodies.len() {
        if !drives(model, body) {
            continue;
        }
        let beside = model.bodies[body].center_of_gravity[1] - middle;
        if beside == 0.0 {
            continue;
        }
        if let Kind::Prescribed { motions } = &mut model.bodies[body].kind {
            let own = motions[0].clone();
            motions[0] = Motion::Sum(vec![own, yaw.scaled(-beside)]);
        }
    }
}

//! The bolster's yaw as the files mean it.
//!
//! Printed: a rotation spring of 1e6 in-lb/rad is to yaw the bolster against two longitudinal springs of 1e6
//! lb/in at y = ±39.5 in, that is 3.12e9 in-lb/rad, and reaches 2e-6 of 0.012 rad. A translation's stiffness
//! was copied to a rotation.

use std::ops::Range;

use mechanics::connection::Law;
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::Model;

use super::choices::Yaw;
use super::units::MOMENT;

/// Stiffness of the yaw spring that drives the bolster as intended, in-lb/rad.
pub(super) const PRINTED_UNITS_STIFFNESS: f64 = 1e10;
/// The same, N·m/rad.
pub const DRIVEN_YAW_STIFFNESS: f64 = PRINTED_UNITS_STIFFNESS * MOMENT;

/// Changes a model so that its input bodies yaw what they drive. Gives the numbers of the connections that
/// were left out, counted before.
///
/// `inputs` are the input bodies.
pub fn intended_yaw(model: &mut Model, inputs: Range<usize>, yaw: Yaw) -> Vec<usize> {
    match yaw {
        Yaw::AsPrinted => Vec::new(),
        Yaw::Dropped => drop_springs(model, &inputs),
        Yaw::Driven => {
            drive_bodies(model, inputs);
            Vec::new()
        }
    }
}

/// Returns whether a body is an input body: prescribed, and not at the origin.
fn drives(model: &Model, inputs: &Range<usize>, body: usize) -> bool {
    inputs.contains(&body) && model.bodies[body].frame.origin != [0.0; 3]
}

/// Returns whether a body is yawed by a history.
fn is_yawed(model: &Model, body: usize) -> bool {
    !model.bodies[body].frame.motions[5].is_constant()
}

fn drop_springs(model: &mut Model, inputs: &Range<usize>) -> Vec<usize> {
    let mut dropped = Vec::new();
    for (number, connection) in model.connections.iter().enumerate() {
        let Law::Springs(springs) = &connection.law else {
            continue;
        };
        let center = |body: usize| model.bodies[body].frame.origin[1];
        let only = |coordinate: usize| springs.iter().all(|(direction, _)| *direction == coordinate);
        // Longitudinal, between an input body and a body that lies beside it.
        let driving = [connection.a, connection.b]
            .into_iter()
            .filter(|body| drives(model, inputs, *body))
            .count();
        if driving == 1 && only(0) && (center(connection.a) - center(connection.b)).abs() > 1e-9 {
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
                .any(|body| is_yawed(model, body))
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

fn drive_bodies(model: &mut Model, inputs: Range<usize>) {
    let Some(yawed) = (0..model.bodies.len()).find(|body| is_yawed(model, *body)) else {
        return;
    };
    let frame = &model.bodies[yawed].frame;
    let (yaw, middle) = (frame.motions[5].clone(), frame.origin[1]);
    for body in inputs.clone() {
        if !drives(model, &inputs, body) {
            continue;
        }
        let frame = &mut model.bodies[body].frame;
        let beside = frame.origin[1] - middle;
        if beside == 0.0 {
            continue;
        }
        let driven = frame.motions[0].clone();
        frame.motions[0] = Motion::Sum(vec![driven, yaw.scaled(-beside)]);
    }
}

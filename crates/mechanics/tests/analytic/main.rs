//! Motions, friction laws, contacts, coils and the massless wedge against closed forms, differences and
//! second derivations.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

#[path = "../common/mod.rs"]
mod common;

mod coil;
mod contact;
mod equivalent_linearization;
mod friction;
mod massless_wedge;
mod motions;

use common::{
    ALL, Random, UP, add, body, coil, cross, difference, face, ground, model, norm, rodrigues, times,
};
use integrate::Problem;
use mechanics::body::Body;
use mechanics::characteristic::Characteristic;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::contact::Interface;
use mechanics::frame::Frame;
use mechanics::friction::{FrictionLaw, bristle, tanh};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::motion::{Motion, RampProfile};
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection, SlopeFriction};
use mechanics::spline::{Spline, SplineError};
use mechanics::system::System;
use mechanics::vector::{Matrix, Vector};
use numerics::scalar::Dual;
use std::f64::consts::PI;

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!(
        (value - expected).abs() <= tolerance,
        "{value} instead of {expected} (within {tolerance})"
    );
}

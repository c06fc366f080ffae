//! Dry friction in a plane between two bodies: see [`mechanics::connection::SurfaceFriction`].

use std::sync::Arc;

use mechanics::connection::{Accumulator, Connection, Law, SurfaceFriction};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use quantity::Kind;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// Friction in the plane across an axis: a bristle in series with a slider, one circle for both directions.
/// The bristle holds a load that stands still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFriction {
    /// The axis of the normal force: 0 x, 1 y, 2 z.
    pub axis: usize,
    /// Normal force in the nominal layout, N.
    pub normal_force: f64,
    /// Growth of the normal force with the compression along the axis, N/m.
    pub normal_stiffness: f64,
    /// Coefficient of friction.
    pub coefficient: f64,
    /// Stiffness of the bristle, N/m.
    pub bristle_stiffness: f64,
    /// Damping of the bristle, N·s/m.
    pub bristle_damping: f64,
    /// True if the normal force acts on the bodies; false where it is that of a clamp, whose two sides
    /// cancel.
    pub pushes: bool,
}

impl CatalogElement for DryFriction {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let [(a, at), (b, _)] = place.ends;
        // Extension is positive where the bodies part: the force is negative where they press.
        let spring = Curve::linear(self.normal_stiffness).scaled(1.0, -self.normal_force);
        let law = SurfaceFriction {
            coordinates: [self.axis, (self.axis + 1) % 3, (self.axis + 2) % 3],
            spring,
            damper: None,
            coefficient: self.coefficient,
            accumulator: Accumulator::Bristle {
                stiffness: self.bristle_stiffness,
                damping: self.bristle_damping,
            },
            clamped: !self.pushes,
            directions: FrictionDirections::Two,
        };
        // Between markers it acts at any heading; bodies whose frames move have differences of coordinates.
        let rest = [a, b]
            .iter()
            .all(|body| place.model.bodies[*body].frame.is_fixed());
        let markers = [0, 1].map(|end| place.marker(end, [0.0; 3]).1);
        place.model.connections.push(Connection {
            name: place.name.to_owned(),
            account: place.name.to_owned(),
            a,
            b,
            point: at,
            markers: rest.then_some(markers),
            law: Law::Surface(law),
        });
        let number = place.model.connections.len() - 1;
        for (place_in_law, axis) in [(1, (self.axis + 1) % 3), (2, (self.axis + 2) % 3)] {
            let axis = ["x", "y", "z"][axis];
            let text = format!("friction force on end A along {axis}");
            place.channel(&format!("force_{axis}"), Kind::Force, &text, move |view| {
                -view.seen.connections[number].forces[place_in_law]
            });
            let text = format!("slip and deflection of the bristle along {axis}");
            place.channel(
                &format!("displacement_{axis}"),
                Kind::Length,
                &text,
                move |view| view.seen.connections[number].extensions[place_in_law],
            );
        }
        Ok(())
    }

    fn at_rest(&self) -> Option<Arc<dyn CatalogElement>> {
        Some(Arc::new(Self {
            coefficient: 0.0,
            ..*self
        }))
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

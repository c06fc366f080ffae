//! Center plates, side bearings and adapters, as trucks have them: see [`truck::Joint`].

use std::sync::Arc;

use mechanics::friction::FrictionLaw;
use quantity::Kind;
use truck::{Adapter, CenterPlate, Hysteresis, Joint, SideBearing};
use wedge::parameters::FaceFriction;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A flat center plate: end A, above, on end B.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    /// Its numbers; its height is that of its place.
    pub plate: CenterPlate,
    /// Load in the nominal layout, N.
    pub load: f64,
}

/// A side bearing: end A, above, on end B.
#[derive(Clone, Debug, PartialEq)]
pub struct Bearing(pub SideBearing);

/// An adapter: end A, above, on end B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxleAdapter {
    /// Its numbers.
    pub adapter: Adapter,
    /// Distances across from its middle to each of two points and of two longitudinal stops, m.
    pub across: [f64; 2],
}

fn joint<'p>(place: &'p mut Place<'_>) -> Joint<'p> {
    let [(a, _), (b, _)] = place.ends;
    Joint {
        pitching: true,
        bodies: [a, b],
        from: [0.0; 3],
        model: &mut *place.model,
    }
}

/// Friction that is none.
pub(super) fn none() -> FaceFriction {
    FaceFriction {
        coefficient: 0.0,
        law: FrictionLaw::Tanh { reference_speed: 1.0 },
    }
}

impl CatalogElement for Plate {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let (name, [(_, [x, y, height]), _]) = (place.name, place.ends);
        let face = place.model.faces.len();
        let plate = CenterPlate {
            height,
            ..self.plate.clone()
        };
        joint(place).add_center_plate(name, [x, y], &plate, self.load);
        place.face_channels("", face);
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

impl CatalogElement for Bearing {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let (name, [(_, at), _]) = (place.name, place.ends);
        let (face, connection) = (place.model.faces.len(), place.model.connections.len());
        joint(place).add_side_bearing(name, at, &self.0);
        if place.model.faces.len() > face {
            place.face_channels("", face);
        }
        if place.model.connections.len() > connection {
            let text = "force of the hysteresis on end A along z of end B, positive in compression";
            place.channel("hysteresis_force", Kind::Force, text, move |view| {
                -view.seen.connections[connection].forces[2]
            });
        }
        Ok(())
    }

    fn at_rest(&self) -> Option<Arc<dyn CatalogElement>> {
        let SideBearing::ConstantContact { hysteresis, .. } = &self.0 else {
            return None;
        };
        hysteresis.map(|own| {
            let mut resting = self.clone();
            if let SideBearing::ConstantContact { hysteresis, .. } = &mut resting.0 {
                *hysteresis = Some(Hysteresis { limit: 0.0, ..own });
            }
            Arc::new(resting) as Arc<dyn CatalogElement>
        })
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

impl CatalogElement for AxleAdapter {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let (name, [(_, at), _]) = (place.name, place.ends);
        let face = place.model.faces.len();
        joint(place).add_adapter(name, at, &self.adapter, self.across);
        if place.model.faces.len() > face {
            place.face_channels("", face);
        }
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

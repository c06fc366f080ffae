//! A friction wedge with mass between a pocket and a column: see [`truck::add_wedge`].

use std::sync::Arc;

use ::wedge::parameters::Damping;
use mechanics::body::Body;
use quantity::Kind;
use truck::{Wedge, WedgeKind, WedgeMount, add_wedge, wedge_body};

use super::plate::none;
use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A friction wedge: end A is the body with the pocket (a bolster), end B that with the column (a side
/// frame). Its center of gravity is at the place of both ends.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionWedge {
    /// Its numbers.
    pub wedge: Wedge,
    /// Where its control coil stands: on the body with the column (variable) or in the pocket (constant).
    pub damping: Damping,
    /// +1: the column lies ahead of it (+x), -1: behind.
    pub end: f64,
}

impl CatalogElement for FrictionWedge {
    fn bodies(&self, name: &str, [at, _]: [[f64; 3]; 2]) -> Vec<Body> {
        vec![wedge_body(name, &self.wedge, at, self.end)]
    }

    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        if self.wedge.kind != WedgeKind::Body {
            return Err("a wedge of a vehicle is one body: leave its kind out".to_owned());
        }
        let [(bolster, at), (side_frame, _)] = place.ends;
        let mount = WedgeMount {
            name: place.name,
            body: place.own[0],
            side_frame,
            bolster,
            damping: self.damping,
            end: self.end,
            center: at,
            from: [0.0; 3],
            gaps: [0.0; 2],
        };
        let coils = place.model.coils.len();
        let own = add_wedge(place.model, &self.wedge, &mount);
        for (name, face) in ["column", "slope"].into_iter().zip(own.faces) {
            place.face_channels(name, face);
        }
        if place.model.coils.len() > coils {
            let text = "load of the control coil, positive in compression";
            place.channel("coil_force", Kind::Force, text, move |view| {
                view.seen.coils[coils].coil.spring
            });
        } else if let Some(coil) = own.coil {
            let text = "load of the control coil on the wedge, up";
            place.channel("coil_force", Kind::Force, text, move |view| {
                view.seen.elements[coil].force.0[2]
            });
        }
        Ok(())
    }

    fn at_rest(&self) -> Option<Arc<dyn CatalogElement>> {
        let mut own = self.clone();
        (own.wedge.column_friction, own.wedge.slope_friction) = (none(), none());
        for face in [&mut own.wedge.column_face, &mut own.wedge.slope_face] {
            if let Some(pad) = &mut face.pad {
                (pad.friction, pad.shear) = (0.0, None);
            }
        }
        Some(Arc::new(own))
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

//! Stops with clearances along one axis: see [`mechanics::elements::Stop`].

use std::f64::consts::FRAC_PI_2;

use mechanics::elements::Stop;
use quantity::Kind;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A stop along an axis of end B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisStop {
    /// The axis: 0 x, 1 y, 2 z.
    pub axis: usize,
    /// Clearances of end A towards negative and positive, m; infinite: no stop on that side.
    pub clearances: [f64; 2],
    /// Stiffness beyond, N/m.
    pub stiffness: f64,
    /// Damping beyond, N·s/m.
    pub damping: f64,
}

impl CatalogElement for AxisStop {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let law = Stop {
            name: place.name.to_owned(),
            clearances: self.clearances,
            stiffness: self.stiffness,
            damping: self.damping,
        };
        // The law acts along x of marker B.
        let turned = [[0.0; 3], [0.0, 0.0, FRAC_PI_2], [0.0, -FRAC_PI_2, 0.0]][self.axis];
        let [a, b] = [place.marker(0, [0.0; 3]), place.marker(1, turned)];
        let own = law.clone();
        let text = "force on end A, positive along the axis";
        place.channel("force", Kind::Force, text, move |view| {
            let motion = view.relative(a, b);
            own.load(motion.position.0[0], motion.velocity.0[0])[0]
        });
        let text = "way of end A from the nominal layout along the axis";
        place.channel("displacement", Kind::Length, text, move |view| {
            view.relative(a, b).position.0[0]
        });
        place.element(law, a, b);
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}

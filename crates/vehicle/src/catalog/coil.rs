//! Coils that stand on a seat: see [`mechanics::elements::ShearSpring`].

use quantity::Kind;
use truck::Spring;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A coil that carries end A on a seat at end B, upright: preload, shear stiffness, solid height, lift-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coil {
    /// Its numbers.
    pub spring: Spring,
    /// Length that is drawn below its place, m.
    pub length: f64,
}

impl CatalogElement for Coil {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let law = self.spring.law(place.name.to_owned());
        let ends = [0, 1].map(|end| place.marker(end, [0.0; 3]));
        let [a, b] = ends;
        let own = law.clone();
        place.channel(
            "force",
            Kind::Force,
            "load, positive in compression",
            move |view| own.load(view.relative(a, b).position.0[2]),
        );
        let text = "shortening from the nominal layout";
        place.channel("compression", Kind::Length, text, move |view| {
            -view.relative(a, b).position.0[2]
        });
        place.wrench_channels(&law, ends, ([true, true, false], [false; 3]));
        place.element(law, a, b);
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Coil
    }

    fn drawn_between(&self, [a, [x, y, z]]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        [a, [x, y, z - self.length]]
    }
}

//! Draft gears between the pivots of two couplers: see [`mechanics::elements::DraftGear`].

use mechanics::curve::Curve;
use mechanics::elements::DraftGear as Law;
use quantity::Kind;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A friction draft gear along the line between its ends; pushes and compressions are positive.
#[derive(Clone, Debug, PartialEq)]
pub struct DraftGear {
    /// Force over compression on the way in, N by m, from zero.
    pub loading: Curve,
    /// How far the line extends, and is compressed, without force, m.
    pub slack: [f64; 2],
    /// The share of the force that is left on the way out.
    pub returned: f64,
    /// Speed over which loading turns to unloading, m/s.
    pub reference_speed: f64,
}

impl CatalogElement for DraftGear {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let [(_, from), (_, to)] = place.ends;
        let way: [f64; 3] = std::array::from_fn(|k| from[k] - to[k]);
        let length = way.iter().fold(0.0, |sum: f64, own| libm::hypot(sum, *own));
        if length == 0.0 {
            return Err("its ends are at one place; give the pivots of both couplers".to_owned());
        }
        let law = Law {
            name: place.name.to_owned(),
            length,
            slack: self.slack,
            loading: self.loading.clone(),
            returned: self.returned,
            reference_speed: self.reference_speed,
        };
        let [a, b] = [0, 1].map(|end| place.marker(end, [0.0; 3]));
        let own = law.clone();
        let text = "push along the line between its ends, positive in buff";
        place.channel("force", Kind::Force, text, move |view| {
            let motion = view.relative(a, b);
            let [compression, rate] = own.compression(motion.position, motion.velocity);
            own.push(compression, rate)[0]
        });
        let own = law.clone();
        let text = "shortening of the line from the nominal layout, slack included";
        place.channel("compression", Kind::Length, text, move |view| {
            let motion = view.relative(a, b);
            own.compression(motion.position, motion.velocity)[0]
        });
        place.element(law, a, b);
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Line
    }
}

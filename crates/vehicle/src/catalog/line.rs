//! Springs, dampers, links and gaps along the line between two points: see [`mechanics::elements::Strut`].

use mechanics::curve::Curve;
use mechanics::elements::Strut;
use quantity::Kind;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A spring and a damper along the line between its ends. Pushes and compressions are positive; compression
/// counts from the nominal layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Push over the compression, N by m; at zero the load in the nominal layout.
    pub spring: Curve,
    /// Push over the rate of compression, N by m/s.
    pub damper: Curve,
    /// The largest tension and the largest compression that it carries, N.
    pub limits: [f64; 2],
    /// How far it extends, and is compressed, without force, m; none: no slack.
    pub slack: Option<[f64; 2]>,
    /// True if it is drawn as a coil.
    pub is_coil: bool,
}

impl Line {
    /// Returns a linear spring with a damper: load in the nominal layout (N), stiffness (N/m), damping
    /// (N·s/m).
    #[must_use]
    pub fn linear(load: f64, stiffness: f64, damping: f64) -> Self {
        Self {
            spring: Curve::linear(stiffness).scaled(1.0, load),
            damper: Curve::linear(damping),
            limits: [f64::INFINITY; 2],
            slack: None,
            is_coil: stiffness > 0.0,
        }
    }
}

impl CatalogElement for Line {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let [(_, from), (_, to)] = place.ends;
        let way: [f64; 3] = std::array::from_fn(|k| from[k] - to[k]);
        let length = way.iter().fold(0.0, |sum: f64, own| libm::hypot(sum, *own));
        if length == 0.0 {
            return Err(
                "its ends are at one place, so that its line has no direction; give them two places, \
                        or take a bushing"
                    .to_owned(),
            );
        }
        let strut = Strut::new(
            place.name,
            length,
            self.spring.clone(),
            self.damper.clone(),
            self.limits,
        );
        let strut = match self.slack {
            Some(slack) => strut.with_slack(slack),
            None => strut,
        };
        let [a, b] = [0, 1].map(|end| place.marker(end, [0.0; 3]));
        let own = strut.clone();
        let text = "push along the line between its ends, positive in compression";
        place.channel("force", Kind::Force, text, move |view| {
            let motion = view.relative(a, b);
            let [compression, rate] = own.compression(motion.position, motion.velocity);
            own.push(compression, rate)[0]
        });
        let own = strut.clone();
        let text = "shortening from the nominal layout";
        place.channel("compression", Kind::Length, text, move |view| {
            let motion = view.relative(a, b);
            own.compression(motion.position, motion.velocity)[0]
        });
        let own = strut.clone();
        place.channel("compression_rate", Kind::Speed, "its rate", move |view| {
            let motion = view.relative(a, b);
            own.compression(motion.position, motion.velocity)[1]
        });
        place.element(strut, a, b);
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        match self.is_coil {
            true => Drawn::Coil,
            false => Drawn::Line,
        }
    }
}

//! Margins of a wedge to lock-up: the jam margins of its angles and coefficients of friction, in numbers and
//! in words.
//!
//! They are those of the massless wedge ([`mechanics::quasi_static`]), with the coefficients of rest of the
//! faces as they are (a pad's where a face has one). Units: rad. Limits: coefficients that depend on speed,
//! load or place count with their values at rest, without load and map; crowns do not count, because the
//! normal of a crown that rests on a flat counterface is the counterface's.

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use crate::summary_value::SummaryValue;

/// The jam margins of a wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JamMargins {
    /// Angle at which column and slope close on the wedge.
    pub closing_angle: SummaryValue,
    /// The closing angle less the friction angles of both faces: where it is not positive, a wedge on which
    /// the faces close locks up.
    pub lock_up: SummaryValue,
    /// The same for steady sliding while the bolster goes down, with the friction that the toe chooses.
    pub down: SummaryValue,
    /// The same while it goes up.
    pub up: SummaryValue,
    /// Their message in words.
    pub statement: String,
}

impl JamMargins {
    /// Returns the margins of a wedge whose pocket is yawed by `yaw` (rad).
    #[must_use]
    pub fn new(wedge: &QuasiStaticWedge, yaw: f64, units: Units) -> Self {
        let angle = |value: f64| SummaryValue::new(value, Kind::Angle, units);
        let going = |direction| angle(wedge.jam_margin(direction, wedge.branch(direction)));
        Self {
            closing_angle: angle(wedge.closing_angle(yaw)),
            lock_up: angle(wedge.lock_up_margin(yaw)),
            down: going(SlidingDirection::Down),
            up: going(SlidingDirection::Up),
            statement: statement(wedge, yaw),
        }
    }
}

/// Returns the margins in one sentence, angles in degrees.
#[must_use]
pub fn statement(wedge: &QuasiStaticWedge, yaw: f64) -> String {
    if let Some(warning) = expelled(wedge, yaw) {
        return warning;
    }
    let degrees = |value: f64| format!("{:.2} deg", value.to_degrees());
    let closing = wedge.closing_angle(yaw);
    let margin = wedge.lock_up_margin(yaw);
    let beginning = format!(
        "the faces close at {}, the friction angles of column and slope add up to {}",
        degrees(closing),
        degrees(closing - margin)
    );
    let critical = libm::tan(0.5 * closing);
    if margin > 0.0 {
        format!(
            "{beginning}: {} are left, a wedge on which the faces close slides out of the way; with equal \
             coefficients it locks up from {critical:.3} on",
            degrees(margin)
        )
    } else {
        format!(
            "{beginning}: {} too much, a wedge on which the faces close locks up, and its normal forces grow \
             against the stiffness of the contacts; with equal coefficients it slides below {critical:.3}",
            degrees(-margin)
        )
    }
}

/// Returns the warning about faces that do not close upwards.
#[must_use]
pub fn expelled(wedge: &QuasiStaticWedge, yaw: f64) -> Option<String> {
    let closing = wedge.closing_angle(yaw);
    (closing <= 0.0).then(|| {
        format!(
            "column and slope do not close upwards: the wedge angle of {:.2} deg and the toe of {:.2} deg in \
             leave {:.2} deg between them, so that nothing holds the wedge against its coil and it is pushed \
             out; give a larger wedge.angle or less toe in",
            wedge.angle.to_degrees(),
            -wedge.toe.to_degrees(),
            closing.to_degrees()
        )
    })
}

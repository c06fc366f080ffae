//! Choices where no public text defines the industry's elements: each with its default, named in words for
//! the output of a run.

use serde::{Deserialize, Serialize};

/// Criterion for the wedge's branch (loading, unloading).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Branch {
    /// By the direction of the friction force: at a reversal the force unloads along the accumulator through
    /// zero and loads up to the other branch's limit.
    FrictionForce,
    /// By the direction of the vertical velocity, smoothed by `tanh(v / reference_speed)`; the coefficients
    /// are then fully mobilized also while sticking, and the force snaps at a reversal.
    Velocity {
        /// Reference speed, m/s.
        reference_speed: f64,
    },
}

/// Criterion for the direction of a profile wedge's slope friction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SlopeDirection {
    /// By the toe: it follows the column's friction, mobilized by the same fraction. It may feed energy where
    /// the bolster swings longitudinally.
    Toe,
    /// By the wedge's slip on the slope, smoothed by `tanh(slip / reference_speed)`: it never feeds energy,
    /// creeps under a held load, and vanishes where there is neither toe nor longitudinal motion.
    OwnSlip {
        /// Reference speed, m/s.
        reference_speed: f64,
    },
}

/// Treatment of a wedge that the bolster pushes back beyond its drawn position (negative rise).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NegativeRise {
    /// The coil's curve goes on.
    Extend,
    /// The rise stops at zero.
    Stop,
}

/// The action of a damper in series with a gap while the gap closes and opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GapTension {
    /// Beyond the lower end it only pushes, beyond the upper end it only pulls, together with its spring.
    Never,
    /// It acts in both directions beyond both ends.
    Allowed,
}

/// The choices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Inclination of the column under a wedge whose toe is only a direction (types 6.3, 6.7, 6.8), rad: its
    /// size, the sign follows the direction. It enters the normal force, nothing else. Default 0: a vertical
    /// column on the branch of the direction.
    pub plain_toe_angle: f64,
    /// Criterion for the branch. Default: the friction force.
    pub branch: Branch,
    /// The direction of slope friction of wedges with a profile. Default: by the toe.
    pub slope: SlopeDirection,
    /// True if the rate of the wedge's rise enters the slip velocity on the column. Default: false, the
    /// slip velocity is the vertical extension's rate. If true, longitudinal swinging moves the column's
    /// friction, and the slope's, which follows it, can excite the swinging.
    pub rise_in_slip: bool,
    /// Negative rise. Default: the coil's curve goes on.
    pub negative_rise: NegativeRise,
    /// Factor on the damping of all force accumulators. Default 1; towards 0 the accumulator becomes the
    /// elastic-ideally slipping element of a return mapping.
    pub accumulator_damping: f64,
    /// Dampers behind a gap. Default: never tension.
    pub gap_tension: GapTension,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            plain_toe_angle: 0.0,
            branch: Branch::FrictionForce,
            slope: SlopeDirection::Toe,
            rise_in_slip: false,
            negative_rise: NegativeRise::Extend,
            accumulator_damping: 1.0,
            gap_tension: GapTension::Never,
        }
    }
}

/// Decisions that are no option.
const FIXED: [&str; 11] = [
    "small displacements: levers of the drawn layout, no gyroscopic terms, no geometric stiffness of weights",
    "wedge: quasi-static balance of a massless wedge",
    "wedge: vertical and lateral friction share one circle, the normal force being taken at the fraction \
     Fz/|F|",
    "wedge: the column's normal force is capped by its limit, also where no steady sliding exists (the \
     wedge is then reported as jammed)",
    "wedge: a zero toe takes the toe-out branch",
    "wedge: the profile of the column is taken at the vertical extension, not at the wedge's own height",
    "wedge components: vertical is the whole force (coil where it stands on the side frame, friction, \
     inclined normal force); longitudinal is the force across the column",
    "coil groups (type 1.3): no coupling of shear into roll",
    "surface friction (type 6.5): the limit is taken from the spring's force without the damper's",
    "coils never pull, vertical springs as their limits say; a limit holds for the sum of spring and damper",
    "viscous wedges (types 6.3, 6.7): friction = velocity times LVB, at most the friction limit; one \
     coefficient (6.3) holds for both faces, toe out",
];

impl Options {
    /// Returns the choices and the decisions that are none, in words.
    #[must_use]
    pub fn describe(&self) -> Vec<String> {
        let degrees = self.plain_toe_angle.to_degrees();
        let mut lines = vec![match self.plain_toe_angle {
            0.0 => "wedge without a toe angle: vertical column on the branch of its toe direction".to_owned(),
            _ => format!("wedge without a toe angle: column inclined by {degrees} deg in its toe direction"),
        }];
        lines.push(match self.branch {
            Branch::FrictionForce => {
                "wedge: the branch follows the direction of the friction force".to_owned()
            }
            Branch::Velocity { reference_speed } => {
                format!("wedge: the branch follows the vertical velocity over {reference_speed} m/s")
            }
        });
        lines.push(match self.slope {
            SlopeDirection::Toe => {
                "wedge: the toe's sign decides which way the slope slips, also under yaw; while the wedge \
                 sticks both friction coefficients are scaled by the mobilised fraction"
                    .to_owned()
            }
            SlopeDirection::OwnSlip { reference_speed } => {
                format!(
                    "wedge: slope friction acts against the slip on the slope, over {reference_speed} \
                         m/s"
                )
            }
        });
        lines.push(
            match self.rise_in_slip {
                false => "wedge: the rate of its rise does not enter the slip velocity on the column",
                true => "wedge: the rate of its rise enters the slip velocity on the column",
            }
            .to_owned(),
        );
        lines.push(
            match self.negative_rise {
                NegativeRise::Extend => "wedge: a negative rise goes on along the coil's curve",
                NegativeRise::Stop => "wedge: the rise stops at zero",
            }
            .to_owned(),
        );
        lines.push(format!(
            "force accumulators: bristles in rate form, their damping multiplied by {}",
            self.accumulator_damping
        ));
        lines.push(
            match self.gap_tension {
                GapTension::Never => "dampers behind a gap (type 1.2): never tension",
                GapTension::Allowed => "dampers behind a gap (type 1.2): both directions",
            }
            .to_owned(),
        );
        lines.extend(FIXED.iter().map(|text| (*text).to_owned()));
        lines
    }
}

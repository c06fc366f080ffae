//! Choices that the files leave open.

use mechanics::connection::Options;
use mechanics::contact::FrictionDirections;
use serde::{Deserialize, Serialize};

/// The shape BEND: from zero to the amplitude within its first coefficient, then held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bend {
    /// Half a cosine.
    #[default]
    HalfCosine,
    /// A straight line.
    Linear,
}

/// The yaw of the bolster, which the printed files do not reach: longitudinal springs at both sides hold it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Yaw {
    /// As the files say.
    #[default]
    AsPrinted,
    /// As they mean it: the longitudinal springs to the outer input bodies are left out, and the yaw spring
    /// is made stiff and without limit.
    Dropped,
    /// As they mean it: the outer input bodies move along by -y ψ, and the yaw spring stays.
    Driven,
}

impl Yaw {
    /// Returns its name, as in options.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "printed",
            Self::Dropped => "drop",
            Self::Driven => "drive",
        }
    }
}

/// The model of the wedges of types 6.8 and 6.9.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Wedges {
    /// The files' law: a wedge without mass.
    #[default]
    Massless,
    /// A body with mass between its pocket and its column. What adds it knows bodies and contact; a
    /// [`Truck`](super::Truck) has massless wedges.
    Bodies,
}

/// The properties of a wedge's body that the files do not give; those left open take a default of what adds
/// the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WedgeBody {
    /// Mass, kg.
    pub mass: Option<f64>,
    /// Height of the vertical face, m.
    pub height: Option<f64>,
    /// Width across the track, m.
    pub width: Option<f64>,
    /// Stiffness of each corner's contact, N/m.
    pub contact_stiffness: Option<f64>,
    /// Damping of each corner's contact, N·s/m.
    pub contact_damping: Option<f64>,
    /// The directions in which friction acts on a face.
    pub friction_directions: Option<FrictionDirections>,
}

/// The choices.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choices {
    /// Those of the elements.
    pub elements: Options,
    /// The shape BEND.
    pub bend: Bend,
    /// The bolster's yaw.
    pub yaw: Yaw,
    /// Speed along the track, m/s; only distance-based histories and inputs with lag need it.
    pub speed: Option<f64>,
    /// The model of the wedges of types 6.8 and 6.9.
    pub wedges: Wedges,
    /// Properties of the wedges' bodies.
    pub wedge_body: WedgeBody,
}

impl Choices {
    /// Returns the choices in words, with the decisions that are no option.
    #[must_use]
    pub fn describe(&self) -> Vec<String> {
        let mut lines = vec![
            match self.bend {
                Bend::HalfCosine => "shape BEND: rises as half a cosine within its first coefficient, then \
                                     held"
                    .to_owned(),
                Bend::Linear => {
                    "shape BEND: rises straight within its first coefficient, then held".to_owned()
                }
            },
            "shape CUSP: peaks of exp(-|t|/c1), one in the middle of each c2".to_owned(),
            "shapes SIN, SSIN: the phase is the integral of a frequency that grows from c1 to c2 over the \
             segment"
                .to_owned(),
            "base of a segment: straight from its start to its end value".to_owned(),
            match self.yaw {
                Yaw::AsPrinted => "yaw: the springs that drive the bolster are those of the files".to_owned(),
                Yaw::Dropped => format!(
                    "yaw as intended: the longitudinal springs to the outer input bodies are left out; the \
                     yaw spring has {:.0e} in-lb/rad and no limit",
                    super::yaw::PRINTED_UNITS_STIFFNESS
                ),
                Yaw::Driven => "yaw as intended: the outer input bodies move along the track by -y times \
                                the yaw"
                    .to_owned(),
            },
            match self.speed {
                Some(speed) => format!("speed along the track: {speed} m/s"),
                None => "no speed along the track".to_owned(),
            },
        ];
        lines.extend(self.elements.describe());
        lines
    }
}

//! Parameters of a stand-alone wedge: validated, immutable, in SI units.
//!
//! Frames and signs: x longitudinal (positive from the column towards the bolster), y lateral, z up; the
//! origin lies at the coil's seat level below the nominal position of the wedge frame's origin. Toe out is
//! positive.

use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use mechanics::motion::Motion;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::face::{FaceProperties, Rectangle};

/// Standard gravity, m/s².
pub const STANDARD_GRAVITY: f64 = 9.806_65;

/// The body on which the control coil stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Damping {
    /// On the side frame: its force follows the bolster's travel, the bolster can lift off.
    Variable,
    /// In the bolster pocket: its force is nearly constant.
    Constant,
}

impl Damping {
    /// Returns its name, as in case files and names of files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Variable => "variable",
            Self::Constant => "constant",
        }
    }
}

/// The wedge body: a right triangular prism with mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WedgeBody {
    /// Wedge angle θ between the vertical and the slope, rad.
    pub angle: f64,
    /// Height h2 of the vertical face, m.
    pub height: f64,
    /// Lateral width h3, m.
    pub width: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Moments of inertia about the center of gravity (roll, pitch, yaw), kg·m².
    pub inertia: [f64; 3],
    /// Center of gravity from the wedge frame's origin, m.
    pub center_of_gravity: [f64; 3],
    /// The free coordinates among x, y, z, roll, pitch, yaw.
    pub free: [bool; 6],
}

/// The control coil.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ControlCoil {
    /// Force by compression.
    pub law: CoilLaw,
    /// Free length, m.
    pub free_length: f64,
    /// Length in the nominal position, m.
    pub nominal_length: f64,
    /// Damping, N·s/m.
    pub damping: f64,
    /// Damping of rotations, N·m·s.
    pub rotational_damping: f64,
    /// Its line of action.
    pub acts_at: CoilLine,
    /// True if it can pull.
    pub pulls: bool,
}

/// Depth of wear of the faces. The wear of wedge and neighbor together is one depth: it opens the gap of
/// their faces, measured along the normal of the neighbor's surface, which recedes by it and stays flat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Wear {
    /// Depth of wear of the column and the wedge's vertical face together, m.
    pub column: f64,
    /// Depth of wear of the pocket's slope and the wedge's slope face together, m.
    pub slope: f64,
}

impl Wear {
    /// Returns the depths by which a wedge rises by `rise` (m); the column and the wedge's vertical face have
    /// `column_share` of the sum of both depths, from 0 to 1. The reverse of [`Wear::rise`].
    #[must_use]
    pub fn of_rise(rise: f64, column_share: f64, [angle, toe, across]: [f64; 3]) -> Self {
        let slope_share = 1.0 - column_share;
        let by_slope = slope_share * libm::cos(toe) / libm::cos(across);
        let sum = rise * libm::sin(angle + toe) / (column_share * libm::cos(angle) + by_slope);
        Self {
            column: column_share * sum,
            slope: slope_share * sum,
        }
    }

    /// Returns the height of a wedge with worn faces above an unworn one when both touch column and slope,
    /// bolster and side frame being where they were, m: `(w_c cos θ + w_s cos φ / cos β) / sin(θ + φ)` with
    /// the depths of wear w_c and w_s, the wedge angle θ, the toe φ and the slope's angle across β (rad).
    ///
    /// It follows from the two faces that both touch. The wedge's displacement (x, z) takes up the wear along
    /// both normals: `x cos φ - z sin φ = -w_c` and `(x cos θ + z sin θ) cos β = w_s`. Rigid faces; with
    /// elastic contacts the rise is less by what the unworn wedge, under its greater coil force, is pressed
    /// in more.
    #[must_use]
    pub fn rise(&self, [angle, toe, across]: [f64; 3]) -> f64 {
        let by_slope = self.slope * libm::cos(toe) / libm::cos(across);
        (self.column * libm::cos(angle) + by_slope) / libm::sin(angle + toe)
    }
}

/// The normal contact law, per corner.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Stiffness per corner, N/m.
    pub stiffness: f64,
    /// Damping per corner, N·s/m; it never pulls.
    pub damping: f64,
}

/// Friction of one face.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaceFriction {
    /// Coefficient of friction.
    pub coefficient: f64,
    /// The law; bristle stiffness and damping are per face.
    pub law: FrictionLaw,
}

/// The prescribed motion of a neighbor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NeighbourMotion {
    /// The point that it turns about, m; `None`: the center of its face (pocket or column).
    pub center: Option<[f64; 3]>,
    /// Motions of x, y, z (m), roll, pitch, yaw (rad).
    pub coordinates: [Motion; 6],
}

impl NeighbourMotion {
    /// Returns a neighbor that stands still.
    #[must_use]
    pub fn fixed() -> Self {
        Self {
            center: None,
            coordinates: std::array::from_fn(|_| Motion::Constant(0.0)),
        }
    }
}

/// The start of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// The nominal position, at rest, whatever penetrates.
    Rest,
    /// The same, with column and pocket moved apart (along x) until nothing penetrates.
    Touching,
    /// Frictionless static equilibrium at the neighbors' position at time zero.
    Equilibrium,
}

/// A stand-alone wedge between side frame and bolster.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// The body on which the coil stands.
    pub damping: Damping,
    /// The wedge.
    pub wedge: WedgeBody,
    /// Wear of the faces.
    #[serde(default)]
    pub wear: Wear,
    /// The control coil.
    pub coil: ControlCoil,
    /// Normal contact.
    pub contact: Contact,
    /// Friction at the column.
    pub column_friction: FaceFriction,
    /// Friction at the slope.
    pub slope_friction: FaceFriction,
    /// The wedge's vertical face at the column.
    #[serde(default)]
    pub column_face: FaceProperties,
    /// The wedge's slope face at the slope of the pocket.
    #[serde(default)]
    pub slope_face: FaceProperties,
    /// Toe angle of the column, rad; positive is toe out.
    pub toe: f64,
    /// Height of the point about which toe turns the column, above the middle of the wedge's vertical face in
    /// its nominal position, m.
    #[serde(default)]
    pub toe_pivot: f64,
    /// Motion of the side frame.
    pub side_frame: NeighbourMotion,
    /// Motion of the bolster.
    pub bolster: NeighbourMotion,
    /// Gravity, m/s².
    pub gravity: f64,
    /// The start of the run.
    pub start: Start,
}

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{path} is {got}; it must be {expected}")]
pub struct ParameterError {
    /// The parameter's key in a case file, such as `wedge.angle`.
    pub path: &'static str,
    /// Its value, SI.
    pub got: f64,
    /// The condition.
    pub expected: &'static str,
}

impl Parameters {
    /// Checks every range.
    ///
    /// # Errors
    /// The first parameter that is outside its range.
    pub fn validate(&self) -> Result<(), ParameterError> {
        let angle = (0.0, std::f64::consts::FRAC_PI_2);
        let w = &self.wedge;
        check(
            "wedge.angle",
            w.angle,
            w.angle > angle.0 && w.angle < angle.1,
            "between 0° and 90°",
        )?;
        positive("wedge.height", w.height)?;
        positive("wedge.width", w.width)?;
        positive("wedge.weight", w.mass)?;
        for inertia in w.inertia {
            positive("wedge.inertia", inertia)?;
        }
        for p in w.center_of_gravity {
            check("wedge.center_of_gravity", p, p.is_finite(), "finite")?;
        }
        check(
            "wedge.free_coordinates",
            0.0,
            w.free.contains(&true),
            "at least one coordinate",
        )?;
        not_negative("wedge.column_wear", self.wear.column)?;
        not_negative("wedge.slope_wear", self.wear.slope)?;
        let c = &self.coil;
        match &c.law {
            CoilLaw::Linear { stiffness } => positive("control_coil.stiffness", *stiffness)?,
            CoilLaw::Table(_) => {}
            CoilLaw::Given { force } => check("control_coil.force", *force, force.is_finite(), "finite")?,
        }
        positive("control_coil.free_length", c.free_length)?;
        positive("control_coil.nominal_length", c.nominal_length)?;
        not_negative("control_coil.damping", c.damping)?;
        not_negative("control_coil.rotational_damping", c.rotational_damping)?;
        positive("contact.stiffness", self.contact.stiffness)?;
        not_negative("contact.damping", self.contact.damping)?;
        friction("friction.column", &self.column_friction)?;
        friction("friction.slope", &self.slope_friction)?;
        let faces = [&self.column_face, &self.slope_face];
        for (number, (face, rectangle)) in faces.into_iter().zip(&self.rectangles()).enumerate() {
            face.validate(rectangle, number)?;
        }
        check(
            "side_frame.toe",
            self.toe,
            self.toe.abs() < 0.25 * angle.1,
            "below 22.5°",
        )?;
        check(
            "side_frame.toe_pivot",
            self.toe_pivot,
            self.toe_pivot.abs() < 1.0,
            "less than 1 m (39.4 in) above or below the middle of the face",
        )?;
        not_negative("environment.gravity", self.gravity)
    }

    /// Returns the length h1 of the wedge's bottom, m: `h2 tan θ`.
    #[must_use]
    pub fn bottom_length(&self) -> f64 {
        self.wedge.height * libm::tan(self.wedge.angle)
    }

    /// Returns the longitudinal position of the vertical face in the wedge frame, m: `p1 - h1/3`, so that the
    /// center of gravity is the prism's centroid.
    #[must_use]
    pub fn column_face_position(&self) -> f64 {
        self.wedge.center_of_gravity[0] - self.bottom_length() / 3.0
    }

    /// Returns the vertical face and the slope face in the wedge frame.
    #[must_use]
    pub fn rectangles(&self) -> [Rectangle; 2] {
        let (column, height) = (self.column_face_position(), self.wedge.height);
        let slope = column + self.bottom_length();
        [(column, true), (slope, false)].map(|(lower, faces_backward)| Rectangle {
            lower: [lower, 0.0],
            upper: [column, height],
            width: self.wedge.width,
            faces_backward,
        })
    }

    /// Returns the height by which wear of the faces lifts the wedge, m: [`Wear::rise`].
    #[must_use]
    pub fn wedge_rise(&self) -> f64 {
        self.wear.rise([self.wedge.angle, self.toe, 0.0])
    }
}

fn friction(path: &'static str, face: &FaceFriction) -> Result<(), ParameterError> {
    not_negative(path, face.coefficient)?;
    match face.law {
        FrictionLaw::Tanh { reference_speed } => positive("friction.reference_speed", reference_speed),
        FrictionLaw::Bristle { stiffness, damping } => {
            positive("friction.bristle_stiffness", stiffness)?;
            positive("friction.bristle_damping", damping)
        }
    }
}

pub(crate) fn positive(path: &'static str, value: f64) -> Result<(), ParameterError> {
    check(
        path,
        value,
        value > 0.0 && value.is_finite(),
        "positive and finite",
    )
}

pub(crate) fn not_negative(path: &'static str, value: f64) -> Result<(), ParameterError> {
    check(
        path,
        value,
        value >= 0.0 && value.is_finite(),
        "zero or positive, and finite",
    )
}

pub(crate) fn check(
    path: &'static str,
    got: f64,
    holds: bool,
    expected: &'static str,
) -> Result<(), ParameterError> {
    if holds {
        Ok(())
    } else {
        Err(ParameterError { path, got, expected })
    }
}

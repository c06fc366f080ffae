//! Results of a wedge run: the output table, and the values at one instant.
//!
//! Signs: the *longitudinal wedge force* is Σ N n_c·x over the column corners (Steets 2007, eq. 5-2); the
//! *vertical wedge force* is the column friction as it acts on the side frame, positive up; the *vertical
//! force on the side frame* is the same less the coil's spring force where the coil stands on the side frame
//! (eq. 5-3). Moments act on the wedge, about its center of gravity. Friction powers are Σ F_t·v (eqs. 5-4,
//! 5-5), never positive with tanh.

use std::ops::Range;

use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, Observation, System};
use mechanics::vector::Vector;
use quantity::Kind;

use crate::assemble::{BOLSTER, COLUMN, SIDE_FRAME, SLOPE, WEDGE};
use crate::face::{FaceProperties, Grid, Rectangle};
use crate::parameters::{Damping, Parameters};
use crate::resultants::Resultants;

/// The names of the corners of a face, in the order of its contact points; left is +y.
pub const CORNERS: [&str; 4] = ["lower_right", "lower_left", "upper_right", "upper_left"];
/// The names of the faces in results.
pub const FACES: [&str; 2] = ["column", "slope"];

/// The contact points of both faces in their order, by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PointNames {
    names: [Vec<String>; 2],
}

impl PointNames {
    /// Returns those of a wedge.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            names: [&parameters.column_face, &parameters.slope_face].map(|face| face.grid.names()),
        }
    }

    /// Returns the points of a face among all.
    #[must_use]
    pub fn range(&self, face: usize) -> Range<usize> {
        let [column, slope] = [0, 1].map(|face| self.names[face].len());
        match face {
            COLUMN => 0..column,
            _ => column..column + slope,
        }
    }

    /// Returns the names of the points of a face.
    #[must_use]
    pub fn of(&self, face: usize) -> &[String] {
        &self.names[face]
    }

    /// Returns the face of a point, and its name there.
    #[must_use]
    pub fn face_and_name(&self, point: usize) -> (usize, &str) {
        let face = usize::from(point >= self.names[COLUMN].len());
        let own = point - self.range(face).start;
        (face, self.names[face].get(own).map_or("", String::as_str))
    }
}

/// Inputs of all columns at one instant.
struct Instant<'s> {
    observation: &'s Observation,
    contact_states: &'s [u8],
    start_energy: f64,
    derived: Resultants,
    ledger: Ledger,
}

/// The energy ledger at one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Ledger {
    /// Work done by the prescribed motions.
    pub motion_work: f64,
    /// Work done by the coil's guiding couple (only when its force acts at the center of gravity).
    pub coil_guide_work: f64,
    /// Stored energy, less that at the start.
    pub stored: f64,
    /// Lost in friction at the side frame.
    pub side_frame_friction_loss: f64,
    /// Lost in friction at the bolster.
    pub bolster_friction_loss: f64,
    /// Lost in contact damping.
    pub contact_damping_loss: f64,
    /// Lost in the coil's damping.
    pub coil_damping_loss: f64,
    /// Work less stored energy and losses.
    pub residual: f64,
}

impl Ledger {
    /// Returns the ledger of a state whose stored energy is `stored` more than that at the start (J), with
    /// these quadratures.
    #[must_use]
    pub fn new(system: &System, stored: f64, quadratures: &[f64]) -> Self {
        let mut ledger = Self {
            stored,
            ..Self::default()
        };
        for (energy_term, value) in system.energy_terms().iter().zip(quadratures) {
            let entry = match (energy_term.kind, energy_term.element.as_str()) {
                (EnergyTermKind::MotionWork, _) => &mut ledger.motion_work,
                (EnergyTermKind::FrictionLoss, "column") => &mut ledger.side_frame_friction_loss,
                (EnergyTermKind::FrictionLoss, _) => &mut ledger.bolster_friction_loss,
                (EnergyTermKind::ContactDampingLoss, _) => &mut ledger.contact_damping_loss,
                (EnergyTermKind::CoilDampingLoss, _) => &mut ledger.coil_damping_loss,
                (EnergyTermKind::CoilGuideWork, _) => &mut ledger.coil_guide_work,
                // Losses of connections: a wedge has none.
                _ => continue,
            };
            *entry += value;
        }
        ledger.residual = ledger.motion_work + ledger.coil_guide_work
            - ledger.stored
            - ledger.side_frame_friction_loss
            - ledger.bolster_friction_loss
            - ledger.contact_damping_loss
            - ledger.coil_damping_loss;
        ledger
    }

    /// Returns the entries of the energy balance of a run.
    #[must_use]
    pub fn entries(&self) -> Entries {
        Entries {
            work: self.motion_work,
            losses: self.side_frame_friction_loss
                + self.bolster_friction_loss
                + self.contact_damping_loss
                + self.coil_damping_loss,
            stored_change: self.stored,
            residual: self.residual,
            admissible: 0.0,
            exchanged: 0.0,
        }
    }
}

/// Name, value and text of a column of stored energy.
type StoredRow = (&'static str, fn(&Instant<'_>) -> f64, &'static str);
/// Name, value and text of a column of work or losses.
type SpentRow = (&'static str, fn(&Ledger) -> f64, &'static str);
type Value = Box<dyn Fn(&Instant<'_>) -> f64 + Send + Sync>;

/// The output table of wedge runs.
pub struct Outputs {
    columns: Vec<Column>,
    values: Vec<Value>,
    damping: Damping,
}

impl Outputs {
    /// Returns the table for a wedge of these parameters.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        let mut table = Self {
            columns: Vec::new(),
            values: Vec::new(),
            damping: parameters.damping,
        };
        table.fixed_columns();
        table.motion_columns();
        table.corner_columns(&PointNames::new(parameters));
        table.neighbour_columns();
        table.energy_columns();
        let faces = [&parameters.column_face, &parameters.slope_face];
        for (face, (own, rectangle)) in faces.into_iter().zip(parameters.rectangles()).enumerate() {
            if own.grid != Grid::default() {
                table.grid_columns(face, &PointNames::new(parameters), own, &rectangle);
            }
        }
        table
    }

    /// Returns the columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns the values of all columns (SI) at one instant; `contact_states` are those of the contact
    /// points, `start_energy` the stored energy at the start (J). Returns the ledger, which is among them.
    pub fn values(
        &self,
        system: &System,
        observation: &Observation,
        contact_states: &[u8],
        start_energy: f64,
        out: &mut Vec<f64>,
    ) -> Ledger {
        let instant = Instant {
            observation,
            contact_states,
            start_energy,
            derived: Resultants::of_observation(self.damping, observation),
            ledger: Self::ledger(system, observation, start_energy),
        };
        out.extend(self.values.iter().map(|value| value(&instant)));
        instant.ledger
    }

    /// Returns the energy ledger at one instant.
    #[must_use]
    pub fn ledger(system: &System, observation: &Observation, start_energy: f64) -> Ledger {
        Ledger::new(
            system,
            observation.energies.total() - start_energy,
            &observation.quadratures,
        )
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        place: (&'static str, &'static str),
        text: impl Into<String>,
        value: impl Fn(&Instant<'_>) -> f64 + Send + Sync + 'static,
    ) {
        let (frame, reference) = place;
        self.columns.push(Column {
            name: name.into(),
            kind,
            frame: frame.into(),
            reference: reference.into(),
            text: text.into(),
        });
        self.values.push(Box::new(value));
    }

    /// The columns whose names are fixed for all time, in their order.
    fn fixed_columns(&mut self) {
        let nominal = ("fixed", "nominal position");
        let none = ("fixed", "");
        let cg = ("fixed", "wedge center of gravity");
        self.add("time", Kind::Time, ("", ""), "time", |s| s.observation.time);
        self.add(
            "bolster_vertical",
            Kind::Length,
            nominal,
            "vertical displacement of the bolster",
            |s| displacement(s, BOLSTER).0[2],
        );
        for (name, kind, k) in [
            ("wedge_x", Kind::Length, 0),
            ("wedge_z", Kind::Length, 2),
            ("wedge_pitch", Kind::Angle, 4),
            ("wedge_yaw", Kind::Angle, 5),
        ] {
            self.add(
                name,
                kind,
                nominal,
                "displacement of the wedge frame's origin, or angle",
                move |s| s.observation.bodies[WEDGE].coordinates[k],
            );
        }
        self.add(
            "longitudinal_wedge_force",
            Kind::Force,
            none,
            "sum of the column's normal forces on the wedge along x (eq. 5-2)",
            |s| s.derived.longitudinal,
        );
        self.add(
            "vertical_wedge_force",
            Kind::Force,
            none,
            "column friction as it acts on the side frame, positive up (eq. 5-1)",
            |s| s.derived.vertical,
        );
        self.add(
            "vertical_force_on_side_frame",
            Kind::Force,
            none,
            "the same, less the coil's spring force where the coil stands on the side frame (eq. 5-3, \
             reversed)",
            |s| s.derived.vertical_on_side_frame,
        );
        for (name, face, text) in [
            (
                "side_frame_friction_power",
                COLUMN,
                "power of the column's friction, Σ F_t·v (eq. 5-4)",
            ),
            (
                "bolster_friction_power",
                SLOPE,
                "power of the slope's friction, Σ F_t·v (eq. 5-5)",
            ),
        ] {
            self.add(name, Kind::Power, none, text, move |s| {
                s.observation.faces[face].friction_power
            });
        }
        for (name, face) in [("side_frame_dissipation", COLUMN), ("bolster_dissipation", SLOPE)] {
            let text = "the part of the friction power that is lost; never positive";
            self.add(name, Kind::Power, none, text, move |s| {
                -s.observation.faces[face].friction_loss
            });
        }
        self.moment_columns("side_frame", COLUMN, cg);
        self.add(
            "coil_force",
            Kind::Force,
            ("along the coil", ""),
            "spring force, positive when it pushes",
            |s| s.observation.coils[0].coil.spring,
        );
        self.add(
            "coil_length",
            Kind::Length,
            ("along the coil", ""),
            "length of the coil",
            |s| s.observation.coils[0].coil.length,
        );
    }

    fn moment_columns(&mut self, neighbour: &str, face: usize, place: (&'static str, &'static str)) {
        for (k, axis) in ["roll", "pitch", "yaw"].into_iter().enumerate() {
            let text = format!("{axis} moment of the {neighbour}'s contact forces on the wedge");
            self.add(
                format!("{neighbour}_{axis}_moment"),
                Kind::Moment,
                place,
                text,
                move |s| s.derived.moments[face].0[k],
            );
        }
    }

    fn motion_columns(&mut self) {
        let nominal = ("fixed", "nominal position");
        self.moment_columns("bolster", SLOPE, ("fixed", "wedge center of gravity"));
        for (name, kind, k) in [("wedge_y", Kind::Length, 1), ("wedge_roll", Kind::Angle, 3)] {
            self.add(
                name,
                kind,
                nominal,
                "displacement of the wedge frame's origin, or angle",
                move |s| s.observation.bodies[WEDGE].coordinates[k],
            );
        }
        for (k, axis) in ["x", "y", "z", "roll", "pitch", "yaw"].into_iter().enumerate() {
            let kind = if k < 3 { Kind::Speed } else { Kind::AngularSpeed };
            self.add(
                format!("wedge_{axis}_rate"),
                kind,
                nominal,
                "rate of the coordinate",
                move |s| s.observation.bodies[WEDGE].speeds[k],
            );
        }
        for (body, name) in [(BOLSTER, "bolster"), (SIDE_FRAME, "side_frame")] {
            for (k, axis) in ["longitudinal", "lateral", "vertical"].into_iter().enumerate() {
                if (body, k) != (BOLSTER, 2) {
                    let text = format!("{axis} displacement of the {name}'s turning center");
                    self.add(format!("{name}_{axis}"), Kind::Length, nominal, text, move |s| {
                        displacement(s, body).0[k]
                    });
                }
                let text = format!("{axis} velocity of the {name}'s turning center");
                self.add(
                    format!("{name}_{axis}_rate"),
                    Kind::Speed,
                    ("fixed", ""),
                    text,
                    move |s| s.observation.bodies[body].velocity.0[k],
                );
            }
            for (k, axis) in ["roll", "pitch", "yaw"].into_iter().enumerate() {
                let text = format!("{axis} angle of the {name}");
                self.add(format!("{name}_{axis}"), Kind::Angle, nominal, text, move |s| {
                    angles(s, body)[k]
                });
                let text = format!("angular velocity of the {name} about the {axis} axis");
                self.add(
                    format!("{name}_{axis}_rate"),
                    Kind::AngularSpeed,
                    ("fixed", ""),
                    text,
                    move |s| s.observation.bodies[body].angular_velocity.0[k],
                );
            }
        }
    }

    fn corner_columns(&mut self, points: &PointNames) {
        for (face, face_name) in FACES.into_iter().enumerate() {
            let first = points.range(face).start;
            for (point, corner_name) in CORNERS.into_iter().enumerate() {
                let corner = format!("{face_name}_{corner_name}");
                let place = ("fixed", "the corner");
                self.add(
                    format!("{corner}_gap"),
                    Kind::Length,
                    place,
                    "signed distance, negative inside",
                    move |s| s.observation.faces[face].points[point].gap,
                );
                let text = "normal force on the wedge";
                self.add(
                    format!("{corner}_normal_force"),
                    Kind::Force,
                    place,
                    text,
                    move |s| s.observation.faces[face].points[point].normal,
                );
                for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    let text = format!("{axis} part of the friction force on the wedge");
                    self.add(
                        format!("{corner}_friction_force_{axis}"),
                        Kind::Force,
                        place,
                        text,
                        move |s| s.observation.faces[face].friction_forces[point].0[k],
                    );
                }
                let text = "speed along the surface";
                self.add(
                    format!("{corner}_slip_speed"),
                    Kind::Speed,
                    place,
                    text,
                    move |s| {
                        let [a, b] = s.observation.faces[face].points[point].slip;
                        (a * a + b * b).sqrt()
                    },
                );
                let text = "contact state: 0 open, 1 stick, 2 slip";
                self.add(format!("{corner}_state"), Kind::Count, ("", ""), text, move |s| {
                    f64::from(s.contact_states[first + point])
                });
            }
        }
    }

    /// Pressure and contact state of each point of a grid, row by row from the lowest one, each from right to
    /// left.
    fn grid_columns(&mut self, face: usize, names: &PointNames, own: &FaceProperties, rectangle: &Rectangle) {
        let first = names.range(face).start;
        let (points, areas) = (own.grid.points(), own.areas(rectangle));
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|point| (points[*point].row, points[*point].column));
        for point in order {
            let name = format!("{}_{}", FACES[face], points[point].number());
            let area = areas[point];
            self.add(
                format!("{name}_pressure"),
                Kind::Pressure,
                ("fixed", "the point"),
                "normal force over the part of the face that the point stands for",
                move |s| s.observation.faces[face].points[point].normal / area,
            );
            let text = "contact state: 0 open, 1 stick, 2 slip";
            self.add(format!("{name}_state"), Kind::Count, ("", ""), text, move |s| {
                f64::from(s.contact_states[first + point])
            });
        }
    }

    fn neighbour_columns(&mut self) {
        for (name, reference) in [
            ("side_frame", "center of the column face"),
            ("bolster", "center of the pocket's slope"),
        ] {
            let bolster = name == "bolster";
            for (moment, kind) in [(false, Kind::Force), (true, Kind::Moment)] {
                for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                    let what = if moment { "moment" } else { "force" };
                    let text = format!("net {what} on the {name} from wedge and coil");
                    self.add(
                        format!("net_{what}_on_{name}_{axis}"),
                        kind,
                        ("fixed", reference),
                        text,
                        move |s| {
                            let (f, m) = if bolster {
                                &s.derived.on_bolster
                            } else {
                                &s.derived.on_side_frame
                            };
                            if moment { m.0[k] } else { f.0[k] }
                        },
                    );
                }
            }
        }
    }

    fn energy_columns(&mut self) {
        let none = ("", "");
        let stored: [StoredRow; 6] = [
            (
                "kinetic_energy",
                |s| s.observation.energies.kinetic,
                "kinetic energy",
            ),
            (
                "coil_energy",
                |s| s.observation.energies.coil,
                "energy stored in the coil",
            ),
            (
                "contact_energy",
                |s| s.observation.energies.contact,
                "energy stored in the contact springs",
            ),
            (
                "bristle_energy",
                |s| s.observation.energies.bristle,
                "energy stored in the friction bristles",
            ),
            (
                "gravity_energy",
                |s| s.observation.energies.gravity,
                "potential energy of the weight",
            ),
            (
                "stored_energy_change",
                |s| s.observation.energies.total() - s.start_energy,
                "all stored energy, less that at the start",
            ),
        ];
        let spent: [SpentRow; 7] = [
            (
                "motion_work",
                |l| l.motion_work,
                "work done by the prescribed motions",
            ),
            (
                "side_frame_friction_loss",
                |l| l.side_frame_friction_loss,
                "energy lost in friction at the column",
            ),
            (
                "bolster_friction_loss",
                |l| l.bolster_friction_loss,
                "energy lost in friction at the slope",
            ),
            (
                "contact_damping_loss",
                |l| l.contact_damping_loss,
                "energy lost in contact damping",
            ),
            (
                "coil_damping_loss",
                |l| l.coil_damping_loss,
                "energy lost in the coil's damping",
            ),
            (
                "coil_guide_work",
                |l| l.coil_guide_work,
                "work of the couple that guides the coil's force",
            ),
            (
                "ledger_residual",
                |l| l.residual,
                "work less stored energy and losses",
            ),
        ];
        for (name, value, text) in stored {
            self.add(name, Kind::Energy, none, text, value);
        }
        for (name, value, text) in spent {
            self.add(name, Kind::Energy, none, text, move |s| value(&s.ledger));
        }
    }
}

/// Returns the displacement of a neighbor's turning center from its position at zero motion.
fn displacement(instant: &Instant<'_>, body: usize) -> Vector<f64> {
    instant.observation.bodies[body].travel
}

/// Returns the roll, pitch and yaw of a neighbor.
fn angles(instant: &Instant<'_>, body: usize) -> [f64; 3] {
    // R = Ry(pitch) Rz(yaw) Rx(roll)
    let r = instant.observation.bodies[body].rotation.0;
    [
        libm::atan2(-r[1][2], r[1][1]),
        libm::atan2(-r[2][0], r[0][0]),
        libm::asin(r[1][0].clamp(-1.0, 1.0)),
    ]
}

//! The columns of a truck's results.

use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, Observation, System};
use mechanics::vector::{Matrix, Vector};
use quantity::{Kind, System as Units};
use truck::{
    BOLSTER, BuildError, CAR_BODY, HALVES, HalfLoads, Loads, Parameters, SIDE_FRAMES, Truck, TruckStatics,
    WEDGE_NAMES, WHEELSETS, WarpMoment, WedgeKind, WedgeLoads,
};

use super::TruckCase;
use crate::statics::StaticTable;

/// The source of values: an observation, its loads, and the stored energy at the start, J.
struct Seen<'s> {
    observation: &'s Observation,
    loads: &'s Loads,
    start_energy: f64,
}

/// The table of a truck's results, for any observation of its system.
pub struct TruckTable {
    truck: Truck,
    columns: Columns,
    wedges_at_start: [WedgeLoads; 4],
    statics: TruckStatics,
}

impl TruckTable {
    /// Returns the table of a case.
    ///
    /// # Errors
    /// The case makes no truck.
    pub fn new(case: &TruckCase) -> Result<Self, BuildError> {
        let truck = Truck::new(&case.parameters)?;
        let columns = Columns::new(&truck, &case.parameters);
        let seen = truck.system.clone().observe(0.0, &truck.initial_state);
        Ok(Self {
            wedges_at_start: truck.loads(&seen).wedges,
            statics: truck.statics(&seen),
            truck,
            columns,
        })
    }

    /// Returns the truck.
    #[must_use]
    pub fn truck(&self) -> &Truck {
        &self.truck
    }

    /// Returns the wedges at the start.
    #[must_use]
    pub fn wedges_at_start(&self) -> &[WedgeLoads; 4] {
        &self.wedges_at_start
    }

    /// Returns the static table of the start.
    #[must_use]
    pub fn static_table(&self, units: Units) -> StaticTable {
        let mut table = StaticTable::default();
        table.add_truck("", &self.statics, &self.wedges_at_start, units);
        table
    }

    /// Returns the equations of motion.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.truck.system
    }

    /// Returns the columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns.columns
    }

    /// Returns the number of columns at the beginning with fixed names: time, bolster, warp, nests, wedges.
    #[must_use]
    pub fn fixed(&self) -> usize {
        self.columns.fixed
    }

    /// Appends the values of all columns (SI) at an observation; `start_energy` (J) is the stored energy at
    /// the start. Returns the loads.
    pub fn read(&self, observation: &Observation, start_energy: f64, out: &mut Vec<f64>) -> Loads {
        let loads = self.truck.loads(observation);
        let seen = Seen {
            observation,
            loads: &loads,
            start_energy,
        };
        out.extend(self.columns.values.iter().map(|value| value(&seen)));
        loads
    }
}

type Value = Box<dyn Fn(&Seen<'_>) -> f64 + Send + Sync>;

/// The table: what its columns are, and how their values are taken.
struct Columns {
    columns: Vec<Column>,
    /// Number of columns at the beginning with fixed names.
    fixed: usize,
    values: Vec<Value>,
}

/// Names of a body's displacements and angles in columns.
const COORDINATES: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// A part of the warp moment: the ending of its column's name, in words, and from the loads.
type Part = (&'static str, &'static str, fn(&WarpMoment) -> f64);

/// The parts of the warp moment.
pub const PARTS: [Part; 7] = [
    ("load_coils", "load coils", |moment| moment.load_coils),
    ("control_coils", "control coils", |moment| moment.control_coils),
    ("slopes", "slopes", |moment| moment.slopes),
    ("pocket_sides", "pocket sides", |moment| moment.pocket_sides),
    ("lands", "lands", |moment| moment.lands),
    ("gibs", "gibs", |moment| moment.gibs),
    ("warp_springs", "empirical warp springs", |moment| {
        moment.warp_springs
    }),
];

impl Columns {
    fn new(truck: &Truck, parameters: &Parameters) -> Self {
        let mut own = Self {
            columns: Vec::new(),
            fixed: 0,
            values: Vec::new(),
        };
        own.add("time", Kind::Time, "time", |seen| seen.observation.time);
        own.body(truck, BOLSTER, "bolster", &[2]);
        own.add(
            "warp_angle",
            Kind::Angle,
            "mean yaw of the side frames less that of the bolster",
            |seen| seen.loads.warp_angle,
        );
        let text = "moment about the truck's z axis that all elements exert on the bolster";
        own.add("warp_moment", Kind::Moment, text, |seen| {
            seen.loads.warp_moment.total()
        });
        let wheelsets = parameters.wheelsets.is_some();
        if wheelsets {
            let text = "distance of the axles from the center, times the leading wheelset's lateral force \
                        on the side frames less the trailing one's";
            own.add("interaxle_shear_moment", Kind::Moment, text, |seen| {
                seen.loads.interaxle_shear_moment
            });
        }
        for (side, name) in ["left", "right"].into_iter().enumerate() {
            let text = "load on the side frame from all that bolster, wedges and coils exert, positive down";
            own.add(
                format!("{name}_nest_vertical_force"),
                Kind::Force,
                text,
                move |seen| seen.loads.nest_vertical[side],
            );
        }
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            own.wedge(number, name);
        }
        own.fixed = own.columns.len();
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            if parameters.wedges[number].kind == WedgeKind::Split {
                own.halves(number, name);
            }
        }
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            own.add(format!("{name}_rise"), Kind::Length, RISE, move |seen| {
                seen.loads.wedges[number].rise
            });
        }
        own.parts_of_warp_moment();
        own.body(truck, BOLSTER, "bolster", &[0, 1, 3, 4, 5]);
        let text =
            "moment about x at the bolster's center of gravity that coils, slopes and stops exert on it";
        own.add("bolster_roll_moment", Kind::Moment, text, |seen| {
            seen.loads.roll_moment
        });
        let mut others = vec![
            (SIDE_FRAMES, "left_side_frame"),
            (SIDE_FRAMES + 1, "right_side_frame"),
        ];
        if wheelsets {
            others.extend([
                (WHEELSETS, "leading_wheelset"),
                (WHEELSETS + 1, "trailing_wheelset"),
            ]);
        }
        if parameters.car_body.is_some() {
            others.push((CAR_BODY, "car_body"));
            own.center_plate();
        }
        for (body, name) in others {
            own.body(truck, body, name, &[0, 1, 2, 3, 4, 5]);
        }
        own.losses_of_wedges(&truck.system);
        own.energies(&truck.system);
        own
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        text: &str,
        value: impl Fn(&Seen<'_>) -> f64 + Send + Sync + 'static,
    ) {
        self.columns.push(Column {
            name: name.into(),
            kind,
            frame: "x forward, y left, z up".into(),
            reference: "".into(),
            text: text.to_owned(),
        });
        self.values.push(Box::new(value));
    }

    /// Displacements of a body's center of gravity from its nominal place, and its angles.
    fn body(&mut self, truck: &Truck, body: usize, name: &str, coordinates: &[usize]) {
        let own = &truck.system.bodies()[body];
        let nominal: [f64; 3] = std::array::from_fn(|k| own.frame.origin[k] + own.center_of_gravity[k]);
        for &k in coordinates {
            let name = format!("{name}_{}", COORDINATES[k]);
            if k < 3 {
                let text = "displacement of the center of gravity from its nominal place";
                self.add(name, Kind::Length, text, move |seen| {
                    let Vector(place) = seen.observation.bodies[body].center_of_gravity;
                    place[k] - nominal[k]
                });
            } else {
                self.add(
                    name,
                    Kind::Angle,
                    "angle from the nominal attitude",
                    move |seen| angles(&seen.observation.bodies[body].rotation)[k - 3],
                );
            }
        }
    }

    fn wedge(&mut self, number: usize, name: &str) {
        let text = "normal force of the column";
        self.add(format!("{name}_column_normal"), Kind::Force, text, move |seen| {
            seen.loads.wedges[number].column_normal
        });
        let text = "friction of the column alone on the side frame, along z, positive up";
        self.add(
            format!("{name}_column_friction_z"),
            Kind::Force,
            text,
            move |seen| seen.loads.wedges[number].column_friction_z,
        );
        let text = "normal force of the slope";
        self.add(format!("{name}_slope_normal"), Kind::Force, text, move |seen| {
            seen.loads.wedges[number].slope_normal
        });
        for (k, coordinate) in COORDINATES.into_iter().enumerate() {
            let name = format!("{name}_{coordinate}");
            if k < 3 {
                let text = "displacement of its center of gravity from its nominal place";
                self.add(name, Kind::Length, text, move |seen| {
                    seen.loads.wedges[number].displacement[k]
                });
            } else {
                let text = "its angle in truck axes";
                self.add(name, Kind::Angle, text, move |seen| {
                    seen.loads.wedges[number].angles[k - 3]
                });
            }
        }
    }

    /// The halves of a split wedge.
    fn halves(&mut self, number: usize, name: &str) {
        for own in of_halves() {
            self.add(format!("{name}_{}", own.name), own.kind, own.text, move |seen| {
                (own.value)(&seen.loads.wedges[number])
            });
        }
    }

    fn parts_of_warp_moment(&mut self) {
        for (name, text, part) in PARTS {
            let text = format!("part of the warp moment: that of the {text}");
            self.add(format!("warp_moment_{name}"), Kind::Moment, &text, move |seen| {
                part(&seen.loads.warp_moment)
            });
        }
    }

    fn center_plate(&mut self) {
        let text = "normal force of the center plate";
        self.add("center_plate_load", Kind::Force, text, |seen| {
            seen.loads.center_plate.load
        });
        for (k, name) in ["roll", "pitch", "turning"].into_iter().enumerate() {
            let text =
                "moment of the center plate on the bolster about the truck's axes, at the plate's height";
            self.add(
                format!("center_plate_{name}_moment"),
                Kind::Moment,
                text,
                move |seen| seen.loads.center_plate.moment[k],
            );
        }
    }

    fn losses_of_wedges(&mut self, system: &System) {
        for name in WEDGE_NAMES {
            for (face, massless) in [
                ("column", Some(EnergyTermKind::ColumnFriction)),
                ("slope", Some(EnergyTermKind::SlopeFriction)),
                ("split", None),
            ] {
                let element = format!("{name}_{face}");
                let [outboard, inboard] = HALVES.map(|half| format!("{name}_{half}_{face}"));
                let faces = [&element, &outboard, &inboard];
                let terms = system.energy_terms().iter().enumerate();
                let own = terms.filter(|(_, term)| match term.kind {
                    EnergyTermKind::FrictionLoss => faces.contains(&&term.element),
                    kind => Some(kind) == massless && term.element == name,
                });
                let places: Vec<usize> = own.map(|(place, _)| place).collect();
                if !places.is_empty() {
                    let text = "energy lost in its friction since the start";
                    self.add(
                        format!("{element}_friction_loss"),
                        Kind::Energy,
                        text,
                        move |seen| {
                            places
                                .iter()
                                .map(|place| seen.observation.quadratures[*place])
                                .sum()
                        },
                    );
                }
            }
        }
    }

    fn energies(&mut self, system: &System) {
        let of_kinds = |kinds: &[EnergyTermKind]| -> Vec<usize> {
            let terms = system.energy_terms().iter().enumerate();
            terms
                .filter(|(_, term)| kinds.contains(&term.kind))
                .map(|(place, _)| place)
                .collect()
        };
        for (name, kinds, text) in [
            (
                "motion_work",
                &[EnergyTermKind::MotionWork][..],
                "work of all prescribed motions and applied loads since the start",
            ),
            (
                "friction_loss",
                &[
                    EnergyTermKind::FrictionLoss,
                    EnergyTermKind::ColumnFriction,
                    EnergyTermKind::SlopeFriction,
                    EnergyTermKind::WedgeKinematics,
                ],
                "energy lost in friction since the start, with the kinematics of massless wedges",
            ),
            (
                "contact_damping_loss",
                &[EnergyTermKind::ContactDampingLoss],
                "energy lost in the damping of contacts since the start",
            ),
            (
                "element_loss",
                &[EnergyTermKind::ElementLoss],
                "energy lost in coils and stops since the start",
            ),
        ] {
            let places = of_kinds(kinds);
            self.add(name, Kind::Energy, text, move |seen| {
                places
                    .iter()
                    .map(|place| seen.observation.quadratures[*place])
                    .sum()
            });
        }
        let text = "energy stored, less that at the start";
        self.add("stored_energy_change", Kind::Energy, text, |seen| {
            seen.observation.energies.total() - seen.start_energy
        });
        let text = "work less stored energy and losses";
        self.add("ledger_residual", Kind::Energy, text, |seen| {
            -seen.observation.residual(seen.start_energy)
        });
    }
}

/// Roll, pitch and yaw (rad) of a rotation R = Ry Rz Rx.
fn angles(rotation: &Matrix<f64>) -> [f64; 3] {
    let Matrix(r) = rotation;
    [
        libm::atan2(-r[1][2], r[1][1]),
        libm::atan2(-r[2][0], r[0][0]),
        libm::asin(r[1][0].clamp(-1.0, 1.0)),
    ]
}

/// The text of the columns of wedges' rises, of trucks and of trucks under cars.
pub(crate) const RISE: &str =
    "height in its pocket above that of an unworn wedge in the nominal layout, as a gauge shows it";

/// A column of a split wedge's halves.
pub(crate) struct HalfColumn {
    /// Its name after that of the wedge.
    pub name: String,
    pub kind: Kind,
    pub text: &'static str,
    /// Its value by the loads of the wedge, SI.
    pub value: Box<dyn Fn(&WedgeLoads) -> f64 + Send + Sync>,
}

/// Returns the columns of a split wedge's halves, of trucks and of trucks under cars.
pub(crate) fn of_halves() -> Vec<HalfColumn> {
    type Take = fn(&HalfLoads) -> f64;
    let forces: [(&str, &str, Take); 2] = [
        (
            "column_normal",
            "normal force of the half's part of the column",
            |half| half.column_normal,
        ),
        (
            "slope_normal",
            "normal force of the half's part of the slope",
            |half| half.slope_normal,
        ),
    ];
    let mut columns = Vec::new();
    for (half, half_name) in HALVES.into_iter().enumerate() {
        for (name, text, value) in forces {
            columns.push(HalfColumn {
                name: format!("{half_name}_{name}"),
                kind: Kind::Force,
                text,
                value: Box::new(move |wedge| value(&wedge.halves[half])),
            });
        }
        for (k, coordinate) in COORDINATES.into_iter().enumerate() {
            let name = format!("{half_name}_{coordinate}");
            columns.push(if k < 3 {
                HalfColumn {
                    name,
                    kind: Kind::Length,
                    text: "displacement of the half's center of gravity from its nominal place",
                    value: Box::new(move |wedge| wedge.halves[half].displacement[k]),
                }
            } else {
                HalfColumn {
                    name,
                    kind: Kind::Angle,
                    text: "the half's angle in truck axes",
                    value: Box::new(move |wedge| wedge.halves[half].angles[k - 3]),
                }
            });
        }
    }
    columns.push(HalfColumn {
        name: "split_normal".to_owned(),
        kind: Kind::Force,
        text: "normal force between the halves",
        value: Box::new(|wedge| wedge.split_normal),
    });
    columns
}

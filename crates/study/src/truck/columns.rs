//! The columns of a truck's results.

use mechanics::body::COORDINATES;
use mechanics::channel::{Channels, Seen, WithLoads};
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, Observation, System};
use mechanics::vector::{Matrix, Vector};
use quantity::{Kind, System as Units};
use truck::{
    BOLSTER, BuildError, CAR_BODY, Loads, Parameters, SIDE_FRAMES, Truck, TruckStatics, WEDGE_NAMES,
    WHEELSETS, WarpMoment, WedgeLoads,
};

use super::TruckCase;
use super::channels::{FACES, FRICTION, TruckChannels, losses_at, places_of};
use crate::statics::StaticTable;

/// The table of a truck's results, for any observation of its system.
pub struct TruckTable {
    truck: Truck,
    columns: Channels<WithLoads<Loads>>,
    fixed: usize,
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
        let Table { columns, fixed, .. } = Table::new(&truck, &case.parameters);
        let seen = truck.system.clone().observe(0.0, &truck.initial_state);
        Ok(Self {
            wedges_at_start: truck.loads(&seen).wedges,
            statics: truck.statics(&seen),
            truck,
            columns,
            fixed,
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
        self.fixed
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
        self.columns.read(&seen, out);
        loads
    }
}

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

/// The axes of a truck on its own.
const AXES: &str = "x forward, y left, z up";

/// The columns on their way.
struct Table<'t> {
    truck: &'t Truck,
    columns: Channels<WithLoads<Loads>>,
    /// Number of columns at the beginning with fixed names.
    fixed: usize,
}

impl<'t> Table<'t> {
    fn new(truck: &'t Truck, parameters: &Parameters) -> Self {
        let mut own = Self {
            truck,
            columns: Channels::default(),
            fixed: 0,
        };
        own.add("time", Kind::Time, "time", |seen| seen.observation.time);
        own.body(BOLSTER, "bolster", &[2]);
        own.common().warp_angle();
        own.common().warp_moment();
        let wheelsets = parameters.wheelsets.is_some();
        if wheelsets {
            let text = "distance of the axles from the center, times the leading wheelset's lateral force \
                        on the side frames less the trailing one's";
            own.add("interaxle_shear_moment", Kind::Moment, text, |seen| {
                seen.loads.interaxle_shear_moment
            });
        }
        own.common().nests();
        own.common().wedges();
        own.fixed = own.columns.columns.len();
        own.common().halves(parameters);
        own.common().rises();
        for (name, text, part) in PARTS {
            let text = format!("part of the warp moment: that of the {text}");
            own.add(format!("warp_moment_{name}"), Kind::Moment, text, move |seen| {
                part(&seen.loads.warp_moment)
            });
        }
        own.body(BOLSTER, "bolster", &[0, 1, 3, 4, 5]);
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
            own.common().center_plate();
            own.common().side_bearings(parameters);
        }
        for (body, name) in others {
            own.body(body, name, &[0, 1, 2, 3, 4, 5]);
        }
        own.losses_of_wedges();
        own.energies();
        own
    }

    /// Returns what adds the columns that a truck under a car has, too.
    fn common(&mut self) -> TruckChannels<'_, Loads> {
        TruckChannels {
            table: &mut self.columns,
            prefix: String::new(),
            frame: AXES,
            of: (|own, _| own, 0),
        }
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        text: impl Into<String>,
        value: impl Fn(&Seen<'_, Loads>) -> f64 + Send + Sync + 'static,
    ) {
        self.columns.add(name, kind, AXES, text, value);
    }

    /// Displacements of a body's center of gravity from its nominal place, and its angles.
    fn body(&mut self, body: usize, name: &str, coordinates: &[usize]) {
        let own = &self.truck.system.bodies()[body];
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
                let text = "angle from the nominal attitude";
                self.add(name, Kind::Angle, text, move |seen| {
                    angles(&seen.observation.bodies[body].rotation)[k - 3]
                });
            }
        }
    }

    fn losses_of_wedges(&mut self) {
        for wedge in WEDGE_NAMES {
            for face in FACES {
                let places = losses_at(&self.truck.system, wedge, &[face]);
                if !places.is_empty() {
                    let text = "energy lost in its friction since the start";
                    let name = format!("{wedge}_{face}_friction_loss");
                    self.columns.add_energy(name, AXES, text, places);
                }
            }
        }
    }

    fn energies(&mut self) {
        for (name, kinds, text) in [
            (
                "motion_work",
                &[EnergyTermKind::MotionWork][..],
                "work of all prescribed motions and applied loads since the start",
            ),
            (
                "friction_loss",
                &FRICTION,
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
            let places = places_of(&self.truck.system, |kind, _| kinds.contains(&kind));
            self.columns.add_energy(name, AXES, text, places);
        }
        self.columns.add_stored(AXES);
        self.columns.add_residual(AXES);
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

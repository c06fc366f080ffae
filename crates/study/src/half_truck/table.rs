//! The columns of a half-truck's results.
//!
//! Always there: time, the vertical input, every wedge, the bodies' displacements, the energies. Forces of
//! connections are those of the files: positive in extension, on body A they act against the stroke.

use mechanics::body::COORDINATES;
use mechanics::motion::Motion;
use mechanics::output::Column;
use mechanics::system::{ContactState, EnergyTermKind, Model, Observation, System};
use nucars::tree::{DofQuantity, ElementQuantity};
use quantity::Kind;

use super::HalfTruckCase;
use super::requests::Request;
use super::wedge_bodies::MountedWedge;
use super::wedge_seen::{Source, column_moment, friction_loss};

/// Takes a value from an observation and the stored energy at the start (J).
type Value = Box<dyn Fn(&Observation, f64) -> f64 + Send + Sync>;

/// The table: descriptions and how values are taken from an observation.
pub(super) struct OutputTable {
    pub columns: Vec<Column>,
    values: Vec<Value>,
}

impl OutputTable {
    pub fn new(case: &HalfTruckCase, system: &System) -> Self {
        let truck = &case.truck;
        let mut table = Self {
            columns: Vec::new(),
            values: Vec::new(),
        };
        table.add("time", Kind::Time, "time", |seen| seen.time);
        if let Some(body) = input_body(&truck.model) {
            let text = "vertical displacement of the input body that drives the bolster";
            table.add("input_vertical", Kind::Length, text, move |seen| {
                seen.bodies[body].coordinates[2]
            });
            let text = "its velocity";
            table.add("input_vertical_rate", Kind::Speed, text, move |seen| {
                seen.bodies[body].speeds[2]
            });
        }
        for place in case.wedges() {
            let number = truck.connections[place];
            table.wedge(place, number, &truck.model, &case.source(place));
            if let Some(wedge) = case.wedge_body(place) {
                table.wedge_body(number, wedge, system);
            }
        }
        // Those of the files; wedges' bodies come after them.
        let bodies = truck.model.bodies.iter().enumerate();
        for (body, own) in bodies.take(truck.bodies.len()) {
            for coordinate in (0..6).filter(|k| own.free[*k]) {
                let displacement = Request::Body {
                    quantity: DofQuantity::Displacement,
                    body,
                    coordinate,
                };
                table.request(&displacement, case);
            }
        }
        for request in &case.requests {
            table.request(request, case);
        }
        table.energies(system);
        // A data file may ask twice for the same.
        let mut seen = std::collections::BTreeSet::new();
        let keep: Vec<bool> = table
            .columns
            .iter()
            .map(|column| seen.insert(column.name.clone()))
            .collect();
        let mut kept = keep.iter();
        table.columns.retain(|_| kept.next().is_some_and(|keep| *keep));
        let mut kept = keep.iter();
        table.values.retain(|_| kept.next().is_some_and(|keep| *keep));
        table
    }

    /// Appends the values of all columns (SI) at one instant; `start_energy` is the stored energy at the
    /// start, J.
    pub fn read(&self, seen: &Observation, start_energy: f64, out: &mut Vec<f64>) {
        out.extend(self.values.iter().map(|value| value(seen, start_energy)));
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        text: impl Into<String>,
        value: impl Fn(&Observation) -> f64 + Send + Sync + 'static,
    ) {
        self.push(
            name.into(),
            kind,
            text.into(),
            Box::new(move |seen, _| value(seen)),
        );
    }

    fn push(&mut self, name: String, kind: Kind, text: String, value: Value) {
        self.columns.push(Column {
            name,
            kind,
            frame: "x forward, y left, z up".into(),
            reference: "".into(),
            text,
        });
        self.values.push(value);
    }

    fn wedge(&mut self, place: usize, number: u32, model: &Model, source: &Source) {
        let wedge = format!("wedge_{number}");
        let at = || {
            let source = source.clone();
            move |seen: &Observation| source.at(seen)
        };
        self.add(
            format!("{wedge}_column_friction"),
            Kind::Force,
            "friction of the column on the side frame, positive up",
            {
                let at = at();
                move |seen| at(seen).column_friction
            },
        );
        self.add(
            format!("{wedge}_column_normal_force"),
            Kind::Force,
            "normal force of the column",
            {
                let at = at();
                move |seen| at(seen).column_normal
            },
        );
        self.add(
            format!("{wedge}_slope_normal_force"),
            Kind::Force,
            "normal force of the slope",
            {
                let at = at();
                move |seen| at(seen).slope_normal
            },
        );
        self.add(
            format!("{wedge}_slope_friction"),
            Kind::Force,
            "friction of the slope on the wedge, positive up the slope",
            {
                let at = at();
                move |seen| at(seen).slope_friction
            },
        );
        self.add(
            format!("{wedge}_coil_force"),
            Kind::Force,
            "force of the control coil, positive pushing",
            {
                let at = at();
                move |seen| at(seen).coil
            },
        );
        self.add(
            format!("{wedge}_vertical_force"),
            Kind::Force,
            "vertical force on the side frame, positive up: friction and inclined normal force, and the \
             coil where it stands on the side frame",
            {
                let at = at();
                move |seen| at(seen).force[2]
            },
        );
        let coordinates = model.connections[place].law.coordinates();
        if coordinates.contains(&0) || matches!(source, Source::Body(_)) {
            self.add(
                format!("{wedge}_longitudinal_force"),
                Kind::Force,
                "force of the column across it",
                {
                    let at = at();
                    move |seen| at(seen).force[0].abs()
                },
            );
        }
        let lateral = coordinates.iter().position(|own| *own == 1);
        if lateral.is_some() {
            self.add(
                format!("{wedge}_lateral_force"),
                Kind::Force,
                "lateral friction of the column, in the sense of the stroke",
                {
                    let at = at();
                    move |seen| at(seen).force[1]
                },
            );
        }
        self.add(
            format!("{wedge}_stroke"),
            Kind::Length,
            "vertical displacement of the bolster against the side frame",
            move |seen| seen.connections[place].extensions[0],
        );
        self.add(
            format!("{wedge}_stroke_rate"),
            Kind::Speed,
            "its rate",
            move |seen| seen.connections[place].velocities[0],
        );
        let other = [
            ("longitudinal", coordinates.iter().position(|own| *own == 0)),
            ("lateral", lateral),
        ];
        for (name, component) in other {
            let Some(component) = component else { continue };
            self.add(
                format!("{wedge}_{name}_stroke"),
                Kind::Length,
                format!("{name} displacement of the bolster against the side frame"),
                move |seen| seen.connections[place].extensions[component],
            );
            self.add(
                format!("{wedge}_{name}_stroke_rate"),
                Kind::Speed,
                "its rate",
                move |seen| seen.connections[place].velocities[component],
            );
        }
        self.add(
            format!("{wedge}_friction_power"),
            Kind::Power,
            "power of the column's vertical friction, negative where energy is lost",
            {
                let at = at();
                move |seen| at(seen).friction_power
            },
        );
        self.add(
            format!("{wedge}_rise"),
            Kind::Length,
            "rise of the wedge in its pocket",
            {
                let at = at();
                move |seen| at(seen).rise
            },
        );
        if let Source::Massless(_) = source {
            self.add(
                format!("{wedge}_jammed"),
                Kind::Count,
                "1 where no steady sliding exists and only the limit holds the normal force",
                {
                    let at = at();
                    move |seen| f64::from(u8::from(at(seen).jammed))
                },
            );
        }
        self.add(
            format!("{wedge}_state"),
            Kind::Count,
            "state of its friction: 0 open, 1 stick, 2 slip",
            {
                let at = at();
                move |seen| f64::from(at(seen).state.unwrap_or(ContactState::Open) as u8)
            },
        );
    }

    /// Adds the columns that only a wedge with a body has.
    fn wedge_body(&mut self, number: u32, wedge: &MountedWedge, system: &System) {
        let (name, body) = (format!("wedge_{number}"), wedge.body);
        for (k, coordinate) in COORDINATES.into_iter().enumerate() {
            let name = format!("{name}_{coordinate}");
            if k < 3 {
                let (text, center) = ("displacement of its center of gravity", wedge.center[k]);
                self.add(name, Kind::Length, text, move |seen| {
                    seen.bodies[body].center_of_gravity.0[k] - center
                });
            } else {
                self.add(name, Kind::Angle, "its angle", move |seen| {
                    seen.bodies[body].coordinates[k]
                });
            }
        }
        for (k, axis) in ["roll", "pitch", "yaw"].into_iter().enumerate() {
            let own = wedge.clone();
            self.add(
                format!("{name}_column_moment_{axis}"),
                Kind::Moment,
                "moment of the column's forces on the wedge about its center of gravity",
                move |seen| column_moment(seen, &own)[k],
            );
        }
        for (face, place) in ["column", "slope"].into_iter().zip(wedge.faces) {
            if let Some(place) = friction_loss(system, place) {
                self.add(
                    format!("{name}_{face}_friction_loss"),
                    Kind::Energy,
                    "energy lost in its friction since the start",
                    move |seen| seen.quadratures[place],
                );
            }
        }
    }

    fn request(&mut self, request: &Request, case: &HalfTruckCase) {
        let truck = &case.truck;
        match request {
            Request::Body {
                quantity,
                body,
                coordinate,
            } => {
                let (body, coordinate) = (*body, *coordinate);
                let stem = format!("body_{}_{}", truck.bodies[body], COORDINATES[coordinate]);
                let turns = coordinate >= 3;
                let kinds = |a, b| if turns { b } else { a };
                match quantity {
                    DofQuantity::Displacement => self.add(
                        stem,
                        kinds(Kind::Length, Kind::Angle),
                        "displacement of the centre of gravity, or angle",
                        move |seen| seen.bodies[body].coordinates[coordinate],
                    ),
                    DofQuantity::Velocity => self.add(
                        format!("{stem}_rate"),
                        kinds(Kind::Speed, Kind::AngularSpeed),
                        "its rate",
                        move |seen| seen.bodies[body].speeds[coordinate],
                    ),
                    DofQuantity::Acceleration => self.add(
                        format!("{stem}_acceleration"),
                        Kind::Acceleration,
                        "its acceleration",
                        move |seen| seen.bodies[body].accelerations[coordinate],
                    ),
                    DofQuantity::Force => {
                        let own = &truck.model.bodies[body];
                        let inertia = if turns {
                            own.inertia[coordinate - 3]
                        } else {
                            own.mass
                        };
                        self.add(
                            format!("{stem}_force"),
                            kinds(Kind::Force, Kind::Moment),
                            "sum of all forces or moments: inertia times acceleration",
                            move |seen| inertia * seen.bodies[body].accelerations[coordinate],
                        );
                    }
                }
            }
            Request::Connection {
                quantity,
                connection,
                component,
            } => {
                let (connection, component) = (*connection, *component);
                let coordinate = truck.model.connections[connection].law.coordinates()[component];
                let kinds = |a, b| if coordinate >= 3 { b } else { a };
                let place = format!("{}_{}", truck.connections[connection], component + 1);
                match quantity {
                    ElementQuantity::Force => self.add(
                        format!("force_{place}"),
                        kinds(Kind::Force, Kind::Moment),
                        "force or moment of a connection, extension positive",
                        force(case, connection, component),
                    ),
                    ElementQuantity::Stroke => self.add(
                        format!("stroke_{place}"),
                        kinds(Kind::Length, Kind::Angle),
                        "stroke of a connection, extension positive",
                        move |seen| seen.connections[connection].extensions[component],
                    ),
                    ElementQuantity::Velocity => self.add(
                        format!("velocity_{place}"),
                        kinds(Kind::Speed, Kind::AngularSpeed),
                        "rate of a connection's stroke",
                        move |seen| seen.connections[connection].velocities[component],
                    ),
                }
            }
            Request::Sum { name, terms } => {
                let number = 1 + self
                    .columns
                    .iter()
                    .filter(|own| own.name.starts_with("sum_"))
                    .count();
                let terms = terms.iter();
                let terms: Vec<_> = terms
                    .map(|(connection, component, factor)| (force(case, *connection, *component), *factor))
                    .collect();
                self.add(format!("sum_{number}"), Kind::Force, name.clone(), move |seen| {
                    terms.iter().map(|(force, factor)| factor * force(seen)).sum()
                });
            }
        }
    }

    fn energies(&mut self, system: &System) {
        type Stored = fn(&Observation) -> f64;
        let stored: [(&str, Stored, &str); 5] = [
            ("kinetic_energy", |seen| seen.energies.kinetic, "kinetic energy"),
            (
                "gravity_energy",
                |seen| seen.energies.gravity,
                "potential energy of the weights",
            ),
            (
                "spring_energy",
                |seen| seen.energies.spring,
                "energy of the springs",
            ),
            (
                "coil_energy",
                |seen| seen.energies.coil,
                "energy of the wedges' coils",
            ),
            (
                "accumulator_energy",
                |seen| seen.energies.bristle,
                "energy of the force accumulators",
            ),
        ];
        for (name, value, text) in stored {
            self.add(name, Kind::Energy, text, value);
        }
        if !system.faces().is_empty() {
            let text = "energy of the contacts of wedges' bodies";
            self.add("contact_energy", Kind::Energy, text, |seen| seen.energies.contact);
            let text = "energy of the coils of wedges' bodies and of the sides of their pockets";
            self.add("element_energy", Kind::Energy, text, |seen| seen.energies.element);
        }
        let mut kinds: Vec<(EnergyTermKind, Vec<usize>)> = Vec::new();
        for (number, energy_term) in system.energy_terms().iter().enumerate() {
            match kinds.iter_mut().find(|(kind, _)| *kind == energy_term.kind) {
                Some((_, places)) => places.push(number),
                None => kinds.push((energy_term.kind, vec![number])),
            }
        }
        for (kind, places) in kinds {
            let text = "work or loss since the start";
            self.add(ledger_name(kind), Kind::Energy, text, move |seen| {
                let (first, others) = places.split_first().map_or((0, &[][..]), |(a, b)| (*a, b));
                let others = others.iter().map(|place| seen.quadratures[*place]);
                others.fold(seen.quadratures[first], |sum, own| sum + own)
            });
        }
        let text = "work less stored energy and losses";
        let residual = Box::new(|seen: &Observation, start_energy| -seen.residual(start_energy));
        self.push("ledger_residual".into(), Kind::Energy, text.into(), residual);
    }
}

/// Returns the name of a column of the ledger: friction of faces is that of wedges' bodies.
pub(super) fn ledger_name(kind: EnergyTermKind) -> &'static str {
    match kind {
        EnergyTermKind::FrictionLoss => "wedge_friction_loss",
        other => other.name(),
    }
}

/// Takes the force of a component of a connection, extension positive: of a wedge's body that on the side
/// frame.
fn force(
    case: &HalfTruckCase,
    connection: usize,
    component: usize,
) -> Box<dyn Fn(&Observation) -> f64 + Send + Sync> {
    let wedge = case.wedge_body(connection);
    let along = wedge.and_then(|wedge| wedge.components.get(component).copied());
    match along {
        Some(coordinate) => {
            let source = case.source(connection);
            Box::new(move |seen| source.at(seen).force[coordinate])
        }
        None => Box::new(move |seen| seen.connections[connection].forces[component]),
    }
}

/// Returns the first prescribed body that moves up and down.
pub(super) fn input_body(model: &Model) -> Option<usize> {
    let moves = |body: &mechanics::body::Body| !body.frame.motions[2].is_constant();
    model.bodies.iter().position(moves)
}

/// Returns its vertical motion.
pub(super) fn input_motion(model: &Model) -> Option<&Motion> {
    Some(&model.bodies[input_body(model)?].frame.motions[2])
}

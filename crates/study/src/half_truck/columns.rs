//! The columns of a half-truck's results.
//!
//! Always there: time, the vertical input, every wedge, the bodies' displacements, the energies. Forces of
//! connections are those of the files: positive in extension, on body A they act against the stroke.

use mechanics::body::COORDINATES;
use mechanics::channel::{Channels, Seen, WithLoads};
use mechanics::motion::Motion;
use mechanics::output::Column;
use mechanics::system::{ContactState, EnergyTermKind, Model, Observation, System};
use nucars::tree::{DofQuantity, ElementQuantity};
use quantity::Kind;

use super::HalfTruckCase;
use super::requests::Request;
use super::wedge_bodies::MountedWedge;
use super::wedge_seen::{SeenWedge, Source, column_moment, friction_loss};

/// The axes that components refer to.
const AXES: &str = "x forward, y left, z up";

/// The columns of the results of a half-truck, to be evaluated at any instant.
pub struct Columns(Channels<WithLoads<()>>);

impl Columns {
    /// Returns the columns that a run of the case writes; `system` is that of its model.
    #[must_use]
    pub fn new(case: &HalfTruckCase, system: &System) -> Self {
        let truck = &case.truck;
        let mut own = Self(Channels::default());
        own.add("time", Kind::Time, "time", |seen| seen.time);
        if let Some(body) = input_body(&truck.model) {
            let text = "vertical displacement of the input body that drives the bolster";
            own.add("input_vertical", Kind::Length, text, move |seen| {
                seen.bodies[body].coordinates[2]
            });
            let text = "its velocity";
            own.add("input_vertical_rate", Kind::Speed, text, move |seen| {
                seen.bodies[body].speeds[2]
            });
        }
        for place in case.wedges() {
            let number = truck.connections[place];
            own.wedge(place, number, &truck.model, case.source(place));
            if let Some(wedge) = case.wedge_body(place) {
                own.wedge_body(number, wedge, system);
            }
        }
        // Those of the files; wedges' bodies come after them.
        let bodies = truck.model.bodies.iter().enumerate();
        for (body, moved) in bodies.take(truck.bodies.len()) {
            for coordinate in (0..6).filter(|k| moved.free[*k]) {
                let displacement = Request::Body {
                    quantity: DofQuantity::Displacement,
                    body,
                    coordinate,
                };
                own.request(&displacement, case);
            }
        }
        for request in &case.requests {
            own.request(request, case);
        }
        own.energies(system);
        own
    }

    /// Returns the descriptions of the columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.0.columns
    }

    /// Appends the values of all columns (SI) at one instant. The residual of the energy ledger is not
    /// meaningful among them: it counts from a start with no stored energy.
    pub fn read(&self, seen: &Observation, out: &mut Vec<f64>) {
        self.read_since(0.0, seen, out);
    }

    /// The same with the energy stored at the start, J.
    pub(super) fn read_since(&self, start_energy: f64, observation: &Observation, out: &mut Vec<f64>) {
        let seen = Seen {
            observation,
            loads: &(),
            start_energy,
        };
        self.0.read(&seen, out);
    }

    /// Adds a column, once: a data file may ask twice for the same.
    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        text: impl Into<String>,
        value: impl Fn(&Observation) -> f64 + Send + Sync + 'static,
    ) {
        let name = name.into();
        if self.0.columns.iter().all(|own| own.name != name) {
            self.0
                .add(name, kind, AXES, text, move |seen| value(seen.observation));
        }
    }

    fn wedge(&mut self, place: usize, number: u32, model: &Model, source: Source) {
        let mut own = WedgeColumns {
            name: format!("wedge_{number}"),
            columns: Vec::new(),
            values: Vec::new(),
        };
        let text = "friction of the column on the side frame, positive up";
        own.add("column_friction", Kind::Force, text, |own, _| own.column_friction);
        let text = "normal force of the column";
        own.add("column_normal_force", Kind::Force, text, |own, _| {
            own.column_normal
        });
        let text = "normal force of the slope";
        own.add("slope_normal_force", Kind::Force, text, |own, _| own.slope_normal);
        let text = "friction of the slope on the wedge, positive up the slope";
        own.add("slope_friction", Kind::Force, text, |own, _| own.slope_friction);
        let text = "force of the control coil, positive pushing";
        own.add("coil_force", Kind::Force, text, |own, _| own.coil);
        let text = "vertical force on the side frame, positive up: friction and inclined normal force, and \
                    the coil where it stands on the side frame";
        own.add("vertical_force", Kind::Force, text, |own, _| own.force[2]);
        let coordinates = model.connections[place].law.coordinates();
        if coordinates.contains(&0) || matches!(source, Source::Body(_)) {
            let text = "force of the column across it";
            own.add("longitudinal_force", Kind::Force, text, |own, _| {
                own.force[0].abs()
            });
        }
        let component = |coordinate| coordinates.iter().position(|own| *own == coordinate);
        if component(1).is_some() {
            let text = "lateral friction of the column, in the sense of the stroke";
            own.add("lateral_force", Kind::Force, text, |own, _| own.force[1]);
        }
        for (coordinate, start, way) in [
            (None, "", "vertical"),
            (Some(0), "longitudinal_", "longitudinal"),
            (Some(1), "lateral_", "lateral"),
        ] {
            // The first component is the vertical one.
            let Some(component) = coordinate.map_or(Some(0), component) else {
                continue;
            };
            let text = format!("{way} displacement of the bolster against the side frame");
            own.add(&format!("{start}stroke"), Kind::Length, &text, move |_, seen| {
                seen.connections[place].extensions[component]
            });
            let name = format!("{start}stroke_rate");
            own.add(&name, Kind::Speed, "its rate", move |_, seen| {
                seen.connections[place].velocities[component]
            });
        }
        let text = "power of the column's vertical friction, negative where energy is lost";
        own.add("friction_power", Kind::Power, text, |own, _| own.friction_power);
        let text = "rise of the wedge in its pocket";
        own.add("rise", Kind::Length, text, |own, _| own.rise);
        if let Source::Massless(_) = source {
            let text = "1 where no steady sliding exists and only the limit holds the normal force";
            own.add("jammed", Kind::Count, text, |own, _| {
                f64::from(u8::from(own.jammed))
            });
        }
        let text = "state of its friction: 0 open, 1 stick, 2 slip";
        own.add("state", Kind::Count, text, |own, _| {
            f64::from(own.state.unwrap_or(ContactState::Open) as u8)
        });
        let WedgeColumns { columns, values, .. } = own;
        self.0
            .extend(Channels::new(columns, move |seen: &Seen<'_, ()>, row| {
                let own = source.at(seen.observation);
                row.extend(values.iter().map(|value| value(&own, seen.observation)));
            }));
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
                    .columns()
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
        let text = "kinetic energy";
        self.add("kinetic_energy", Kind::Energy, text, |seen| seen.energies.kinetic);
        let text = "potential energy of the weights";
        self.add("gravity_energy", Kind::Energy, text, |seen| seen.energies.gravity);
        let text = "energy of the springs";
        self.add("spring_energy", Kind::Energy, text, |seen| seen.energies.spring);
        let text = "energy of the wedges' coils";
        self.add("coil_energy", Kind::Energy, text, |seen| seen.energies.coil);
        let text = "energy of the force accumulators";
        self.add("accumulator_energy", Kind::Energy, text, |seen| {
            seen.energies.bristle
        });
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
            self.0.add_energy(ledger_name(kind), AXES, text, places);
        }
        self.0.add_residual(AXES);
    }
}

/// The columns of a wedge, which are read together.
struct WedgeColumns {
    name: String,
    columns: Vec<Column>,
    values: Vec<OfWedge>,
}

type OfWedge = Box<dyn Fn(&SeenWedge, &Observation) -> f64 + Send + Sync>;

impl WedgeColumns {
    fn add(
        &mut self,
        ending: &str,
        kind: Kind,
        text: &str,
        value: impl Fn(&SeenWedge, &Observation) -> f64 + Send + Sync + 'static,
    ) {
        let name = format!("{}_{ending}", self.name);
        self.columns.push(Column::new(name, kind, AXES, text));
        self.values.push(Box::new(value));
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

//! Quantities that systems have in common.

use std::collections::{BTreeMap, BTreeSet};

use mechanics::body::{Body, COORDINATES};
use mechanics::orientation::fixed;
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, System, scales};
use mechanics::vector::Vector;
use quantity::Kind;

use super::ports::{FactorPort, LoadPort, MotionPort, PortDirection, Ports, Reading, coordinates};
use crate::element::{Entries, QuantityEntry, rate_input, relative_residual};

/// Returns the kinds of a coordinate and of its rate.
pub(crate) fn kinds(coordinate: usize) -> (Kind, Kind) {
    if coordinate < 3 {
        (Kind::Length, Kind::Speed)
    } else {
        (Kind::Angle, Kind::AngularSpeed)
    }
}

/// Returns the input that loads a coordinate of a body, such as `force_on_body_x` or `moment_on_body_roll`.
pub(crate) fn load(prefix: &str, on: &str, coordinate: usize, text: &str) -> QuantityEntry {
    let axis = ["x", "y", "z"][coordinate % 3];
    let (load, kind) = if coordinate < 3 {
        ("force", Kind::Force)
    } else {
        ("moment", Kind::Moment)
    };
    let name = format!("{prefix}{load}_on_{on}_{}", COORDINATES[coordinate]);
    QuantityEntry::of(kind, name, format!("{load} on {text}, {axis} axis")).starting(0.0)
}

/// The inputs of a plant in the making, and its ports.
#[derive(Debug, Default)]
pub(crate) struct Inputs {
    entries: Vec<QuantityEntry>,
    ports: Ports,
}

impl Inputs {
    /// Adds inputs for value and rate of a coordinate of a prescribed body; they start where its own motion
    /// does, at rest.
    pub fn add_motion(&mut self, (body, own): (usize, &Body), coordinate: usize, name: &str, text: &str) {
        let [value, ..] = own.frame.motions[coordinate].evaluate(0.0, 0.0);
        let (kind, rate_kind) = kinds(coordinate);
        let position = self.entries.len();
        self.entries.push(QuantityEntry {
            rate: Some(position + 1),
            ..QuantityEntry::of(kind, name, text).starting(value)
        });
        self.entries.push(rate_input(rate_kind, name));
        self.ports.motions.push(MotionPort {
            body,
            coordinate,
            position,
            rate: position + 1,
        });
    }

    /// Adds inputs for all coordinates of a prescribed body of the case.
    pub fn add_motions(&mut self, (body, own): (usize, &Body)) {
        for (coordinate, axis) in COORDINATES.into_iter().enumerate() {
            let name = format!("{}_{axis}_motion", own.name);
            let text = "displacement of the prescribed body from its nominal place, or angle; read if motion \
                        = 0";
            self.add_motion((body, own), coordinate, &name, text);
        }
    }

    /// Adds an input that is a load along a displacement.
    pub fn add_load(&mut self, direction: PortDirection, entry: QuantityEntry) {
        self.ports.loads.push(LoadPort {
            input: self.entries.len(),
            direction,
        });
        self.entries.push(entry);
    }

    /// Adds an input that is the factor of an element, times a sign.
    pub fn add_factor(&mut self, element: usize, sign: f64, entry: QuantityEntry) {
        self.ports.factors.push(FactorPort {
            input: self.entries.len(),
            element,
            sign,
        });
        self.entries.push(entry);
    }

    /// Adds inputs for force and moment along every free coordinate of a body, at its center of gravity; of a
    /// body whose reference frame is turned, along the fixed axes.
    pub fn add_loads(&mut self, (body, own): (usize, &Body), name: &str, words: &str) {
        let text = format!("{words} from outside, at its center of gravity");
        for axis in 0..6 {
            let direction = PortDirection::along_axis((body, own), axis);
            if (0..6).all(|k| own.free[k] || direction.row[k] == 0.0) {
                self.add_load(direction, load("", name, axis, &text));
            }
        }
    }

    /// Adds inputs for the displacements of what a rail lies on, along the fixed axes.
    pub fn add_rail_bed(&mut self, (body, own): (usize, &Body)) {
        for (coordinate, axis) in COORDINATES.into_iter().enumerate().take(3) {
            let name = format!("{}_{axis}_motion", own.name);
            let text = "displacement of what the rail lies on under this wheel, along the fixed axes, added \
                        to the track's irregularities; read if motion = 0";
            self.add_motion((body, own), coordinate, &name, text);
        }
    }

    /// Returns all quantities and ports of a system with these inputs. `own` are those that the model has of
    /// its own: options, states, columns, contact states. What the table has, and no state, mode or input of
    /// that name is, is an output or a column.
    pub fn finish(
        self,
        system: &System,
        own: Entries,
        table: &[Column],
        is_output: impl Fn(usize, &Column) -> bool,
    ) -> (Entries, Ports) {
        let (layout, mut ports) = (system.layout(), self.ports);
        let mut entries = Entries {
            inputs: self.entries,
            accumulators: layout.quadratures + 1,
            kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
            ..own
        };
        let known = [&entries.states, &entries.modes, &entries.inputs]
            .into_iter()
            .flatten();
        // The ledger is another one here: it counts the work of the loads too.
        let known = known.chain(&entries.columns).map(|entry| entry.name.clone());
        let mut known: BTreeSet<String> = known.chain(["time".to_owned()]).collect();
        let mut columns = Vec::new();
        for (number, column) in table.iter().enumerate() {
            if !known.insert(column.name.clone()) {
                continue;
            }
            let entry = QuantityEntry::of(column.kind, &column.name, input::shortened(&column.text));
            if is_output(number, column) {
                entries.outputs.push(entry);
                ports.outputs.push(Reading::Table(number));
            } else {
                columns.push(entry);
                ports.columns.push(number);
            }
        }
        entries.columns.splice(0..0, columns);
        (entries, ports)
    }
}

/// Returns the options of a system whose prescribed bodies inputs may move; `motion` and `start` are their
/// texts, and how it starts if nothing is said.
pub(crate) fn options(motion: &str, (start, text): (i32, &str)) -> Vec<QuantityEntry> {
    let [derive_rates, inputs_at_end] = steps("prescribed bodies");
    vec![
        QuantityEntry::integer("motion", Some(0), [0, 1], motion),
        QuantityEntry::integer("start", Some(start), [0, 1], text),
        derive_rates,
        inputs_at_end,
    ]
}

/// Returns the options of communication steps in which `bodies` are moved.
pub(crate) fn steps(bodies: &str) -> [QuantityEntry; 2] {
    let rates = format!(
        "co-simulation: rates of {bodies} are found from their positions, the inputs *_rate are not read"
    );
    let at_end = "co-simulation: inputs are those of the end of a communication step (else of its beginning, \
                  and continued)";
    [
        QuantityEntry::boolean("derive_rates", false, rates),
        QuantityEntry::boolean("inputs_at_end", false, at_end),
    ]
}

/// Returns contact state and event indicator of a contact; `words` say what it is.
pub(crate) fn contact(name: &str, words: &str) -> (QuantityEntry, QuantityEntry) {
    let state = QuantityEntry::integer(
        &format!("{name}_state"),
        None,
        [0, 2],
        format!("contact state of {words}: 0 open, 1 stick, 2 slip"),
    );
    let indicator = QuantityEntry::real(
        format!("{name}_event_indicator"),
        None,
        None,
        format!("event indicator: positive while the contact state of {words} lasts"),
    );
    (state, indicator)
}

/// Returns contact states and event indicators of all points of faces, in the order of the contact states.
pub(crate) fn contacts(system: &System) -> (Vec<QuantityEntry>, Vec<QuantityEntry>) {
    let faces = 0..system.faces().len();
    let points = |face: usize| 0..system.faces()[face].element.points.len();
    let all = faces.flat_map(|face| points(face).map(move |number| (face, number)));
    let names = all.map(|(face, number)| point(system, face, number));
    names.map(|name| contact(&name, &name.replace('_', " "))).unzip()
}

/// Returns the name of a point of a face.
fn point(system: &System, face: usize, point: usize) -> String {
    format!("{}_point_{}", system.faces()[face].element.name, point + 1)
}

/// Returns the positions of all free bodies, then their rates, each with the name of its body and coordinate.
pub(crate) fn motions(system: &System, name: impl Fn(usize) -> String) -> Vec<QuantityEntry> {
    let text =
        "displacement of the center of gravity, or angle, from the drawn position, in the truck's axes";
    states(system, text, |body, k| {
        format!("{}_{}", name(body), COORDINATES[k])
    })
}

/// As [`motions`], of bodies whose reference frames stand in any way along the fixed axes: a coordinate has
/// the name of the fixed axis along or about which it goes in the nominal layout, and `minus` if it goes the
/// other way. `word` stands before the axis.
pub(crate) fn motions_along_axes(system: &System, word: &str) -> Vec<QuantityEntry> {
    let text = "displacement of the origin along a fixed axis, or angle about it, from the nominal layout; \
                angles of a body follow each other";
    states(system, text, |body, k| {
        let own = &system.bodies()[body];
        let Vector(axis) = fixed(own.frame.orientation).column(k % 3);
        let longest = (0..3).max_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs()));
        let number = longest.unwrap_or(k % 3);
        let sign = if axis[number] < 0.0 { "minus_" } else { "" };
        format!("{}_{word}{sign}{}", own.name, COORDINATES[number + k / 3 * 3])
    })
}

/// Returns positions, then rates; `name` gives the name of a coordinate of a body.
fn states(system: &System, text: &str, name: impl Fn(usize, usize) -> String) -> Vec<QuantityEntry> {
    let mut states = Vec::new();
    for rate in [false, true] {
        for (body, k) in coordinates(system) {
            let (name, rate_text) = (name(body, k), "rate of the position of the same name");
            states.push(motion_state(&name, k, rate, if rate { rate_text } else { text }));
        }
    }
    states
}

/// Returns the state that is a coordinate, 0 to 5, of this name, or its rate.
pub(crate) fn motion_state(name: &str, coordinate: usize, rate: bool, text: &str) -> QuantityEntry {
    let (kind, rate_kind) = kinds(coordinate);
    let (nominal, rate_nominal) = if coordinate < 3 {
        (scales::DISPLACEMENT, scales::VELOCITY)
    } else {
        (scales::ANGLE, scales::ANGULAR_VELOCITY)
    };
    if rate {
        QuantityEntry::of(rate_kind, format!("{name}_rate"), text).of_size(rate_nominal)
    } else {
        QuantityEntry::of(kind, name, text).of_size(nominal)
    }
}

/// Returns all states of a system: motions, which are outputs too, internal states, and what is accumulated.
pub(crate) fn all_states(system: &System) -> Vec<QuantityEntry> {
    let mut states = motions(system, |body| system.bodies()[body].name.clone());
    for state in &mut states {
        state.output = true;
    }
    states.extend(internals(system));
    states.extend(accumulators(system));
    states
}

/// Returns the internal states of a system: bristles by the points of their faces, others by their numbers.
pub(crate) fn internals(system: &System) -> Vec<QuantityEntry> {
    let mut names = vec![String::new(); system.layout().internals];
    for (face, own) in system.faces().iter().enumerate() {
        for internal in 0..own.internal_count {
            let name = format!(
                "{}_deflection_{}",
                point(system, face, internal / 2),
                internal % 2 + 1
            );
            if let Some(slot) = names.get_mut(own.first_internal + internal) {
                *slot = name;
            }
        }
    }
    let named = names.into_iter().enumerate().map(|(number, name)| {
        if name.is_empty() {
            format!("internal_{}", number + 1)
        } else {
            name
        }
    });
    named
        .map(|name| deflection(name, "deflection of the bristle of a contact point"))
        .collect()
}

/// Returns the quadratures of a system, then the work of the loads. Of elements of one name the further ones
/// get a number.
pub(crate) fn accumulators(system: &System) -> Vec<QuantityEntry> {
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    let own = system.energy_terms().iter().map(move |term| {
        let text = match term.kind {
            EnergyTermKind::MotionWork => "work of the prescribed bodies since the start",
            kind if kind.is_work() => "work since the start",
            _ => "loss since the start",
        };
        let name = term.name();
        let count = known.entry(name.clone()).or_default();
        *count += 1;
        match *count {
            1 => accumulated(&name, text),
            again => accumulated(&format!("{name}_{again}"), text),
        }
    });
    let loads = accumulated("load_work", "work of all loads from outside since the start");
    own.chain([loads]).collect()
}

/// Returns the deflection of a bristle.
pub(crate) fn deflection(name: impl Into<String>, text: &str) -> QuantityEntry {
    QuantityEntry::of(Kind::Length, name, text).of_size(scales::DEFLECTION)
}

/// Returns work or a loss that is accumulated.
pub(crate) fn accumulated(name: &str, text: &str) -> QuantityEntry {
    QuantityEntry::of(Kind::Energy, name, text).of_size(scales::ENERGY)
}

/// Returns the three columns of the energy ledger.
pub(crate) fn ledger(residual: &str) -> Vec<QuantityEntry> {
    let stored = "kinetic, elastic and gravity energy since the start";
    vec![
        QuantityEntry::of(Kind::Energy, "stored_energy_change", stored),
        QuantityEntry::of(Kind::Energy, "ledger_residual", residual),
        relative_residual(),
    ]
}

//! Quantities that systems have in common.

use std::collections::{BTreeMap, BTreeSet};

use mechanics::body::{Body, COORDINATES};
use mechanics::orientation::fixed;
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, System, scales};
use mechanics::vector::Vector;
use quantity::Kind;

use super::ports::{LoadPort, MotionPort, PortDirection, Ports, Reading, coordinates};
use crate::element::{Entries, QuantityEntry, rate_of, relative_residual};
use crate::unit::Unit;

/// Returns the unit of a kind.
#[expect(clippy::unnecessary_wraps, reason = "as entries have it")]
pub(crate) fn unit(kind: Kind) -> Option<Unit> {
    Some(Unit::Of(kind))
}

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
    QuantityEntry::real(
        format!("{prefix}{load}_on_{on}_{}", COORDINATES[coordinate]),
        unit(kind),
        Some(0.0),
        format!("{load} on {text}, {axis} axis"),
    )
}

/// Adds inputs for value and rate of a coordinate of a prescribed body; they start where its own motion does,
/// at rest.
pub(crate) fn add_motion(
    (inputs, ports): (&mut Vec<QuantityEntry>, &mut Ports),
    (body, own): (usize, &Body),
    coordinate: usize,
    (name, text): (&str, &str),
) {
    let [value, ..] = own.frame.motions[coordinate].evaluate(0.0, 0.0);
    let (kind, rate_kind) = kinds(coordinate);
    let position = inputs.len();
    let mut entry = QuantityEntry::real(name, unit(kind), Some(value), text);
    entry.rate = Some(position + 1);
    inputs.push(entry);
    inputs.push(QuantityEntry::real(
        format!("{name}_rate"),
        unit(rate_kind),
        Some(0.0),
        rate_of(name),
    ));
    ports.motions.push(MotionPort {
        body,
        coordinate,
        position,
        rate: position + 1,
    });
}

/// Adds inputs for force and moment along every free coordinate of a body.
pub(crate) fn add_loads(
    (inputs, ports): (&mut Vec<QuantityEntry>, &mut Ports),
    (body, own): (usize, &Body),
    (name, text): (&str, &str),
) {
    for coordinate in (0..6).filter(|k| own.free[*k]) {
        ports.loads.push(LoadPort {
            input: inputs.len(),
            direction: PortDirection::coordinate(body, coordinate),
        });
        inputs.push(load("", name, coordinate, text));
    }
}

/// Puts what a table has, and no state, mode or input of that name is, among outputs or columns.
pub(crate) fn add_table(
    (entries, ports): (&mut Entries, &mut Ports),
    table: &[Column],
    is_output: impl Fn(usize, &Column) -> bool,
) {
    let own = [&entries.states, &entries.modes, &entries.inputs]
        .into_iter()
        .flatten();
    let mut known: BTreeSet<String> = own.map(|entry| entry.name.clone()).collect();
    known.insert("time".to_owned());
    // The ledger is another one here: it counts the work of the loads too.
    known.extend(entries.columns.iter().map(|entry| entry.name.clone()));
    let mut columns = Vec::new();
    for (number, column) in table.iter().enumerate() {
        if !known.insert(column.name.clone()) {
            continue;
        }
        let text = input::shortened(&column.text);
        let entry = QuantityEntry::real(&column.name, unit(column.kind), None, text);
        if is_output(number, column) {
            entries.outputs.push(entry);
            ports.outputs.push(Reading::Table(number));
        } else {
            columns.push(entry);
            ports.columns.push(number);
        }
    }
    entries.columns.splice(0..0, columns);
}

/// Returns the options of a system whose prescribed bodies inputs may move; `motion` and `start` are their
/// texts, and how it starts if nothing is said.
pub(crate) fn options(motion: &str, (start, text): (i32, &str)) -> Vec<QuantityEntry> {
    vec![
        QuantityEntry::integer("motion", Some(0), [0, 1], motion),
        QuantityEntry::integer("start", Some(start), [0, 1], text),
        QuantityEntry::boolean(
            "derive_rates",
            false,
            "co-simulation: rates of prescribed bodies are found from their positions, the inputs *_rate \
             are not read",
        ),
        QuantityEntry::boolean(
            "inputs_at_end",
            false,
            "co-simulation: inputs are those of the end of a communication step (else of its beginning, and \
             continued)",
        ),
    ]
}

/// Returns contact state and event indicator of a contact.
pub(crate) fn contact(name: &str) -> (QuantityEntry, QuantityEntry) {
    let words = name.replace('_', " ");
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
    all.map(|(face, number)| contact(&point(system, face, number)))
        .unzip()
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
/// other way.
pub(crate) fn motions_along_axes(system: &System) -> Vec<QuantityEntry> {
    let text = "displacement of the origin along a fixed axis, or angle about it, from the nominal layout; \
                angles of a body follow each other";
    states(system, text, |body, k| {
        let own = &system.bodies()[body];
        let Vector(axis) = fixed(own.frame.orientation).column(k % 3);
        let longest = (0..3).max_by(|a, b| axis[*a].abs().total_cmp(&axis[*b].abs()));
        let number = longest.unwrap_or(k % 3);
        let sign = if axis[number] < 0.0 { "minus_" } else { "" };
        format!("{}_{sign}{}", own.name, COORDINATES[number + k / 3 * 3])
    })
}

/// Returns positions, then rates; `name` gives the name of a coordinate of a body.
fn states(system: &System, text: &str, name: impl Fn(usize, usize) -> String) -> Vec<QuantityEntry> {
    let mut states = Vec::new();
    for rate in [false, true] {
        for (body, k) in coordinates(system) {
            let name = name(body, k);
            let (kind, nominal, name) = match (rate, k < 3) {
                (false, true) => (kinds(k).0, scales::DISPLACEMENT, name),
                (false, false) => (kinds(k).0, scales::ANGLE, name),
                (true, true) => (kinds(k).1, scales::VELOCITY, format!("{name}_rate")),
                (true, false) => (kinds(k).1, scales::ANGULAR_VELOCITY, format!("{name}_rate")),
            };
            let text = if rate {
                "rate of the position of the same name"
            } else {
                text
            };
            states.push(with_nominal(
                QuantityEntry::real(name, unit(kind), None, text),
                nominal,
            ));
        }
    }
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
pub(crate) fn deflection(name: String, text: &str) -> QuantityEntry {
    with_nominal(
        QuantityEntry::real(name, unit(Kind::Length), None, text),
        scales::DEFLECTION,
    )
}

/// Returns work or a loss that is accumulated.
pub(crate) fn accumulated(name: &str, text: &str) -> QuantityEntry {
    with_nominal(
        QuantityEntry::real(name, unit(Kind::Energy), None, text),
        scales::ENERGY,
    )
}

fn with_nominal(mut entry: QuantityEntry, nominal: f64) -> QuantityEntry {
    entry.nominal = Some(nominal);
    entry
}

/// Returns the three columns of the energy ledger.
pub(crate) fn ledger(residual: &str) -> Vec<QuantityEntry> {
    [
        (
            "stored_energy_change",
            "kinetic, elastic and gravity energy since the start",
        ),
        ("ledger_residual", residual),
    ]
    .map(|(name, text)| QuantityEntry::real(name, unit(Kind::Energy), None, text))
    .into_iter()
    .chain([relative_residual()])
    .collect()
}

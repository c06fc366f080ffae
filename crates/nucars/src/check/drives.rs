//! Turning a body through a spring while other springs hold it.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::shown;
use crate::finding::{Finding, Findings, Severity};
use crate::source::Span;
use crate::tree::{Connection, DofKind, Element, HistoryShape, InputFile, Law, PiecewiseLinear, SystemFile};

/// A turn of a body that input bodies command through springs.
#[derive(Clone, Debug)]
pub struct SpringDrive {
    /// The body that is to turn.
    pub body: u32,
    /// The axis: roll, pitch or yaw.
    pub axis: DofKind,
    /// The connections that command the turn.
    pub connections: Vec<u32>,
    /// Their stiffness in all, in·lb/rad.
    pub stiffness: f64,
    /// The input body of the first of them.
    pub input_body: u32,
    /// The connections between the body and input bodies whose displacements hold it.
    pub held_by: Vec<u32>,
    /// Their rotational stiffness on it, in·lb/rad: stiffness times lever squared, about the point where that
    /// is least.
    pub holding: f64,
    place: Span,
}

/// A spring of an input body on a body.
struct Spring<'a> {
    connection: &'a Connection,
    dof: DofKind,
    stiffness: f64,
    input_body: u32,
    place: Span,
}

/// Returns all turns that are commanded through springs, by body and axis.
pub fn drives(file: &SystemFile) -> Vec<SpringDrive> {
    let inputs: HashSet<u32> = file.input_bodies.iter().map(|body| *body.id).collect();
    let functions: HashMap<u32, &PiecewiseLinear> = file
        .piecewise_linear
        .iter()
        .rev()
        .map(|function| (*function.id, function))
        .collect();
    let slopes: HashMap<u32, f64> = file
        .characteristics
        .iter()
        .rev()
        .filter_map(|characteristic| match &characteristic.law {
            Law::Limits { stiffness, .. } => {
                Some((*characteristic.id, functions.get(&**stiffness)?.slope(0.0)))
            }
            _ => None,
        })
        .collect();
    let mut springs: BTreeMap<u32, Vec<Spring<'_>>> = BTreeMap::new();
    for connection in &file.connections {
        if !matches!(
            connection.element,
            Element::Parallel(_) | Element::ParallelGroup(_)
        ) {
            continue;
        }
        let (body, input_body) = match (
            inputs.contains(&*connection.body_a),
            inputs.contains(&*connection.body_b),
        ) {
            (false, true) => (*connection.body_a, *connection.body_b),
            (true, false) => (*connection.body_b, *connection.body_a),
            _ => continue,
        };
        let pairs = connection
            .element
            .dofs()
            .iter()
            .zip(connection.element.characteristics());
        for (dof, characteristic) in pairs {
            let Some(stiffness) = slopes.get(&**characteristic) else {
                continue;
            };
            springs.entry(body).or_default().push(Spring {
                connection,
                dof: dof.kind,
                stiffness: *stiffness,
                input_body,
                place: dof.span.to(characteristic.span),
            });
        }
    }
    let mut found = Vec::new();
    for (body, springs) in springs {
        for axis in [DofKind::Roll, DofKind::Pitch, DofKind::Yaw] {
            found.extend(drive(body, axis, &springs));
        }
    }
    found
}

/// Returns the displacements that oppose a turn, each with the coordinate that is its lever.
fn levers(axis: DofKind) -> [(DofKind, usize); 2] {
    match axis {
        DofKind::Roll => [(DofKind::Y, 2), (DofKind::Z, 1)],
        DofKind::Pitch => [(DofKind::X, 2), (DofKind::Z, 0)],
        _ => [(DofKind::X, 1), (DofKind::Y, 0)],
    }
}

fn drive(body: u32, axis: DofKind, springs: &[Spring<'_>]) -> Option<SpringDrive> {
    let rotational: Vec<&Spring<'_>> = springs.iter().filter(|spring| spring.dof == axis).collect();
    let first = rotational.first()?;
    let mut held_by = Vec::new();
    let mut holding = 0.0;
    for (dof, along) in levers(axis) {
        let holds = || {
            springs
                .iter()
                .filter(|spring| spring.dof == dof && spring.stiffness > 0.0)
        };
        let place = |spring: &Spring<'_>| *spring.connection.position[along];
        let stiffness: f64 = holds().map(|spring| spring.stiffness).sum();
        let centre = holds()
            .map(|spring| spring.stiffness * place(spring))
            .sum::<f64>()
            / stiffness;
        for spring in holds() {
            let lever = place(spring) - centre;
            // Rounding leaves a lever where all springs are in one line.
            if lever.abs() > 1e-9 * centre.abs().max(1.0) {
                holding += spring.stiffness * lever * lever;
                held_by.push(*spring.connection.id);
            }
        }
    }
    held_by.sort_unstable();
    Some(SpringDrive {
        body,
        axis,
        connections: rotational.iter().map(|spring| *spring.connection.id).collect(),
        stiffness: rotational.iter().map(|spring| spring.stiffness).sum(),
        input_body: first.input_body,
        held_by,
        holding,
        place: first.place,
    })
}

/// The ratio by which the holding springs must be stiffer for a warning.
const MUCH: f64 = 20.0;

fn list(connections: &[u32]) -> String {
    let several = if connections.len() > 1 { "s" } else { "" };
    let mut numbers: Vec<String> = connections.iter().take(8).map(u32::to_string).collect();
    if connections.len() > 8 {
        numbers.push("...".to_owned());
    }
    format!("connection{several} {}", numbers.join(", "))
}

/// Warns of turns that the displacement springs forbid.
pub(super) fn check(file: &SystemFile, findings: &mut Findings) {
    for drive in drives(file) {
        if drive.holding <= MUCH * drive.stiffness || findings.is_full_of(Severity::Warning) {
            continue;
        }
        let axis = drive.axis.name();
        let message = format!(
            "{} cannot {axis} body {}: {} in·lb/rad, against {} in·lb/rad by which {} hold it",
            list(&drive.connections),
            drive.body,
            shown(drive.stiffness),
            shown(drive.holding),
            list(&drive.held_by)
        );
        let help = format!(
            "of a commanded {axis} only one part in {} arrives; give the turn a characteristic of its own \
             with a much higher stiffness and limit, or leave out the springs that hold it",
            shown(1.0 + drive.holding / drive.stiffness)
        );
        let dress = |finding: Finding| finding.label("turns the body").help(help);
        findings.add(Severity::Warning, "held-turn", drive.place, message, dress);
    }
}

/// Warns of turns that an input file commands and that do not arrive.
pub(super) fn check_with_input(file: &SystemFile, input: &InputFile, findings: &mut Findings) {
    for drive in drives(file) {
        if drive.holding <= MUCH * drive.stiffness || findings.is_full_of(Severity::Warning) {
            continue;
        }
        let Some(body) = file.input_body(drive.input_body) else {
            continue;
        };
        let index = body.dofs.iter().position(|dof| dof.kind == drive.axis);
        let Some(number) = index.and_then(|index| body.histories.get(index)) else {
            continue;
        };
        let Some(history) = input.history(**number) else {
            continue;
        };
        let amplitude = history
            .segments
            .iter()
            .filter(|segment| *segment.shape != HistoryShape::Null)
            .map(|segment| segment.amplitude.abs())
            .fold(0.0, f64::max);
        if amplitude == 0.0 {
            continue;
        }
        let arrives = amplitude * drive.stiffness / (drive.stiffness + drive.holding);
        findings.warning(
            "turn-does-not-arrive",
            number.span,
            format!(
                "history {number} asks for a {} of {} rad, of which {} rad arrive at body {}",
                drive.axis.name(),
                shown(amplitude),
                shown(arrives),
                drive.body
            ),
            format!(
                "{} hold the body with {} in·lb/rad against the {} in·lb/rad of {}",
                list(&drive.held_by),
                shown(drive.holding),
                shown(drive.stiffness),
                list(&drive.connections)
            ),
        );
    }
}

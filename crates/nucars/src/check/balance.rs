//! Weight against what the connections carry in the undeformed position.

use std::collections::HashMap;

use super::shown;
use crate::finding::{Findings, Severity};
use crate::tree::{DofKind, Element, Law, PiecewiseLinear, SystemFile};

/// Standard gravity in the files' units, in/s²; the static loads in the printed files were calculated with
/// 386.09.
pub const GRAVITY: f64 = 386.0886;

/// A body's weight and what carries it when nothing is deformed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// The body.
    pub body: u32,
    /// Its weight, lb.
    pub weight: f64,
    /// The vertical force of all connections on it at stroke 0, lb, up. Without friction; a wedge whose
    /// coil's force is constant keeps that force inside the bolster.
    pub carried: f64,
}

/// Returns the balance of all bodies with a vertical degree of freedom.
pub fn vertical_balance(file: &SystemFile) -> Vec<Balance> {
    let functions: HashMap<u32, &PiecewiseLinear> = file
        .piecewise_linear
        .iter()
        .rev()
        .map(|function| (*function.id, function))
        .collect();
    let laws: HashMap<u32, &Law> = file
        .characteristics
        .iter()
        .rev()
        .map(|characteristic| (*characteristic.id, &characteristic.law))
        .collect();
    let mut up: HashMap<u32, f64> = HashMap::new();
    for connection in &file.connections {
        let force = pull(&connection.element, &laws, &functions);
        if force != 0.0 {
            *up.entry(*connection.body_a).or_default() -= force;
            *up.entry(*connection.body_b).or_default() += force;
        }
    }
    let vertical = file
        .bodies
        .iter()
        .filter(|body| body.dofs.iter().any(|dof| dof.kind == DofKind::Z));
    vertical
        .map(|body| Balance {
            body: *body.id,
            weight: *body.mass * GRAVITY,
            carried: up.get(&*body.id).copied().unwrap_or(0.0),
        })
        .collect()
}

/// Returns the vertical force with which a connection draws A down and B up at stroke 0; what pushes them
/// apart is negative.
fn pull(element: &Element, laws: &HashMap<u32, &Law>, functions: &HashMap<u32, &PiecewiseLinear>) -> f64 {
    let at_rest = |function: u32| {
        functions
            .get(&function)
            .map_or(0.0, |function| function.value(0.0))
    };
    let several = element.characteristics().len() > 1;
    let mut pull = 0.0;
    for (index, dof) in element.dofs().iter().enumerate() {
        if dof.kind != DofKind::Z {
            continue;
        }
        let index = if several { index } else { 0 };
        let Some(law) = element
            .characteristics()
            .get(index)
            .and_then(|id| laws.get(&**id))
        else {
            continue;
        };
        pull += match law {
            Law::Limits {
                stiffness,
                extension,
                compression,
                ..
            } => at_rest(**stiffness).min(**extension).max(**compression),
            Law::Gap {
                stiffness, high, low, ..
            } if 0.0 <= **low || 0.0 >= **high => at_rest(**stiffness),
            Law::SurfaceFriction { normal, .. } if index == 0 => at_rest(**normal).min(0.0),
            Law::ViscousWedge { coil, force, .. }
            | Law::ViscousToeWedge { coil, force, .. }
            | Law::StickSlipWedge { coil, force, .. }
                if **coil != 0 =>
            {
                (at_rest(**coil) - **force).min(0.0)
            }
            Law::StickSlipWedge3d { coil, variable, .. } if **variable => at_rest(**coil).min(0.0),
            _ => 0.0,
        };
    }
    pull
}

/// Warns of bodies that are out of balance by more than a fiftieth of their weight.
pub(super) fn check(file: &SystemFile, findings: &mut Findings) {
    if file.lost.characteristics || file.lost.piecewise_linear || file.lost.connections {
        return;
    }
    for balance in vertical_balance(file) {
        let Balance { weight, carried, .. } = balance;
        if (carried - weight).abs() <= 0.02 * weight.abs() {
            continue;
        }
        let found = file.body(balance.body);
        let Some(body) = found.filter(|_| !findings.is_full_of(Severity::Warning)) else {
            return;
        };
        let reason = if carried.abs() < 0.02 * weight {
            "the vertical functions carry no preload"
        } else if carried < weight {
            "the vertical functions carry too little preload"
        } else {
            "nothing holds it down against the preload"
        };
        findings.warning(
            "preload",
            body.mass.span,
            format!(
                "body {} is not in balance when nothing is deformed: its weight is {} lb, connections push \
                 it up by {} lb",
                body.id,
                shown(weight),
                shown(carried)
            ),
            format!(
                "{reason}: shift them so that they carry the static load at stroke 0, or look for the \
                 equilibrium first"
            ),
        );
    }
}

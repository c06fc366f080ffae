//! Numbers that refer to something that is not there, and things nothing refers to.

use std::collections::{HashMap, HashSet};

use super::{repeated, some_of};
use crate::finding::{Finding, Findings, Severity};
use crate::source::Spanned;
use crate::tree::{Dof, DofKind, Law, SystemFile};

pub(super) fn check(file: &SystemFile, findings: &mut Findings) {
    let bodies = file.bodies.iter().map(|body| body.id);
    repeated(
        bodies.chain(file.input_bodies.iter().map(|body| body.id)),
        "body",
        findings,
    );
    repeated(file.connections.iter().map(|one| one.id), "connection", findings);
    repeated(
        file.characteristics.iter().map(|one| one.id),
        "characteristic",
        findings,
    );
    repeated(
        file.piecewise_linear.iter().map(|one| one.id),
        "function",
        findings,
    );
    bodies_of_connections(file, findings);
    characteristics_of_connections(file, findings);
    functions_of_characteristics(file, findings);
}

fn unresolved(findings: &mut Findings, what: &str, number: Spanned<u32>, by: &str, there: &str) {
    let dress = |finding: Finding| {
        finding
            .label("refers to nothing")
            .help(format!("there are {there}"))
    };
    let message = format!("{by} refers to {what} {number}, which is not there");
    findings.add(Severity::Error, "unresolved", number.span, message, dress);
}

fn bodies_of_connections(file: &SystemFile, findings: &mut Findings) {
    if file.lost.bodies {
        return;
    }
    let bodies = file.bodies.iter().map(|body| (*body.id, &body.dofs));
    let inputs = file.input_bodies.iter().map(|body| (*body.id, &body.dofs));
    let dofs: HashMap<u32, &Vec<Spanned<Dof>>> = bodies.chain(inputs).collect();
    let rigid: HashSet<u32> = file.bodies.iter().map(|body| *body.id).collect();
    for connection in &file.connections {
        if findings.is_full() {
            return;
        }
        let by = format!("connection {}", connection.id);
        let ends = [connection.body_a, connection.body_b];
        if *ends[0] == *ends[1] {
            let message = format!("{by} connects body {} with itself", ends[0]);
            findings.error(
                "same-body",
                ends[1].span,
                message,
                "a connection has two different bodies; 0 is the ground",
            );
            continue;
        }
        for end in ends {
            if *end != 0 && !dofs.contains_key(&*end) {
                let there = format!("the bodies {} and the ground, 0", some_of(dofs.keys().copied()));
                unresolved(findings, "body", end, &by, &there);
            }
        }
        if !ends.iter().any(|end| end.value == 0 || rigid.contains(&**end))
            && ends.iter().all(|end| dofs.contains_key(&**end))
        {
            let message = format!("{by} connects two input bodies");
            findings.warning(
                "no-body",
                ends[0].span,
                message,
                "it moves nothing: one of them should have a mass",
            );
        }
        for dof in connection.element.dofs() {
            lacking(&dofs, connection.id, ends, *dof, findings);
        }
    }
}

/// Complains about a direction that bodies lack.
fn lacking(
    dofs: &HashMap<u32, &Vec<Spanned<Dof>>>,
    connection: Spanned<u32>,
    ends: [Spanned<u32>; 2],
    dof: Spanned<Dof>,
    findings: &mut Findings,
) {
    // A turn moves the points of a body too.
    let also: &[DofKind] = match dof.kind {
        DofKind::X => &[DofKind::Pitch, DofKind::Yaw],
        DofKind::Y => &[DofKind::Roll, DofKind::Yaw],
        DofKind::Z => &[DofKind::Roll, DofKind::Pitch],
        _ => &[],
    };
    let known: Vec<_> = ends.into_iter().filter(|end| end.value != 0).collect();
    let has = |end: &Spanned<u32>| {
        dofs.get(&**end).is_none_or(|other| {
            other
                .iter()
                .any(|other| other.value == dof.value || also.contains(&other.kind))
        })
    };
    let without: Vec<_> = known.iter().filter(|end| !has(end)).collect();
    let Some(first) = without.first() else { return };
    let name = dof.kind.name();
    let help = "leave the direction out of the connection, or give the body the degree of freedom";
    if without.len() == known.len() {
        let message = format!("connection {connection} acts in {name}, which none of its bodies can do");
        findings.error("lacking-dof", dof.span, message, help);
    } else {
        let message = format!("connection {connection} acts in {name}, which body {first} cannot do");
        findings.warning("lacking-dof", dof.span, message, help);
    }
}

fn characteristics_of_connections(file: &SystemFile, findings: &mut Findings) {
    if file.lost.characteristics {
        return;
    }
    let there: HashSet<u32> = file.characteristics.iter().map(|one| *one.id).collect();
    let mut used = HashSet::new();
    let laws: HashMap<u32, &Law> = file
        .characteristics
        .iter()
        .rev()
        .map(|one| (*one.id, &one.law))
        .collect();
    for connection in &file.connections {
        if findings.is_full() {
            return;
        }
        let code = connection.element.code();
        for characteristic in connection.element.characteristics() {
            used.insert(**characteristic);
            if !there.contains(&**characteristic) {
                let list = format!("the characteristics {}", some_of(there.iter().copied()));
                unresolved(
                    findings,
                    "characteristic",
                    *characteristic,
                    &format!("connection {}", connection.id),
                    &list,
                );
            }
            if let Some(law) = laws
                .get(&**characteristic)
                .filter(|law| !law.serves(&connection.element))
            {
                findings.error(
                    "two-forms",
                    characteristic.span,
                    format!(
                        "connection {} of type {code} cannot use characteristic {characteristic}, which is \
                         one of type {}",
                        connection.id,
                        law.types()
                    ),
                    "the values of a characteristic mean what the type of most of its connections says: \
                     give this one its own",
                );
            }
        }
    }
    if file.lost.connections {
        return;
    }
    for characteristic in file.characteristics.iter().filter(|one| !used.contains(&*one.id)) {
        if findings.is_full_of(Severity::Warning) {
            return;
        }
        findings.warning(
            "unused",
            characteristic.id.span,
            format!("no connection uses characteristic {}", characteristic.id),
            "put a `!` before it if it is not needed",
        );
    }
}

fn functions_of_characteristics(file: &SystemFile, findings: &mut Findings) {
    if file.lost.piecewise_linear {
        return;
    }
    let there: HashSet<u32> = file.piecewise_linear.iter().map(|one| *one.id).collect();
    let mut used = HashSet::new();
    for characteristic in &file.characteristics {
        for function in characteristic.law.functions() {
            used.insert(*function);
            if !there.contains(&*function) && !findings.is_full() {
                let list = format!("the functions {}; 0 is none", some_of(there.iter().copied()));
                unresolved(
                    findings,
                    "function",
                    function,
                    &format!("characteristic {}", characteristic.id),
                    &list,
                );
            }
        }
    }
    // What a characteristic without connection means is not known: it may use any function.
    let any_unknown = file
        .characteristics
        .iter()
        .any(|one| matches!(one.law, Law::Unused { .. }));
    if file.lost.characteristics || any_unknown {
        return;
    }
    for function in file
        .piecewise_linear
        .iter()
        .filter(|one| !used.contains(&*one.id))
    {
        if findings.is_full_of(Severity::Warning) {
            return;
        }
        findings.warning(
            "unused",
            function.id.span,
            format!("no characteristic uses function {}", function.id),
            "put a `!` before it if it is not needed",
        );
    }
}

//! Checks of system files.

use std::collections::HashSet;

use super::{balance, doubts, drives, references, shown};
use crate::finding::{Finding, Findings, Severity};
use crate::read::Read;
use crate::source::{Span, Spanned};
use crate::tree::{Dof, DofKind, Element, InputFile, Law, SystemFile};

/// Checks a system file alone.
pub fn system(read: &Read<SystemFile>) -> Findings {
    let mut findings = Findings::new(&read.source);
    let file = &read.tree;
    bodies(file, &mut findings);
    connections(file, &mut findings);
    laws(file, &mut findings);
    functions(file, &mut findings);
    references::check(file, &mut findings);
    let broken = findings.has_errors() || read.findings.has_errors();
    if !broken {
        balance::check(file, &mut findings);
        drives::check(file, &mut findings);
        doubts::check(file, &mut findings);
    }
    findings
}

/// Checks a system file with the input file that drives it: whether its histories are there, and arrive.
pub fn system_with_input(read: &Read<SystemFile>, input: &InputFile) -> Findings {
    let mut findings = Findings::new(&read.source);
    if !input.lost {
        let numbers: HashSet<u32> = input.histories.iter().map(|history| *history.number).collect();
        for body in &read.tree.input_bodies {
            for history in body
                .histories
                .iter()
                .filter(|history| !numbers.contains(&***history))
            {
                if findings.is_full() {
                    return findings;
                }
                let message = format!(
                    "input body {} takes history {history}, which is not in the input file",
                    body.id
                );
                let help = format!("its histories are {}", super::some_of(numbers.iter().copied()));
                findings.error("unresolved", history.span, message, help);
            }
        }
    }
    if !read.findings.has_errors() && !findings.has_errors() {
        drives::check_with_input(&read.tree, input, &mut findings);
    }
    findings
}

fn twice(dofs: &[Spanned<Dof>], what: &str, findings: &mut Findings) {
    let mut seen = HashSet::new();
    for dof in dofs {
        if !seen.insert(**dof) {
            let message = format!("{what} has the degree of freedom {dof} twice");
            findings.error(
                "repeated-dof",
                dof.span,
                message,
                "each can stand there once; correct the list and its count",
            );
        }
    }
}

fn bodies(file: &SystemFile, findings: &mut Findings) {
    for body in &file.bodies {
        if findings.is_full() {
            return;
        }
        twice(&body.dofs, &format!("body {}", body.id), findings);
        zero_is_ground(body.id, findings);
        let has = |kind: DofKind| body.dofs.iter().any(|dof| dof.kind == kind);
        if *body.mass <= 0.0 && body.dofs.iter().any(|dof| dof.kind.is_translation()) {
            let message = format!("the mass of body {} is {}", body.id, body.mass);
            findings.error(
                "mass",
                body.mass.span,
                message,
                "a mass is above 0, in lb·s²/in: weight in lb over 386.09",
            );
        }
        for (inertia, kind) in body
            .inertia
            .iter()
            .zip([DofKind::Roll, DofKind::Pitch, DofKind::Yaw])
        {
            if **inertia <= 0.0 && has(kind) {
                let message = format!("the {} inertia of body {} is {inertia}", kind.name(), body.id);
                findings.error(
                    "mass",
                    inertia.span,
                    message,
                    "a moment of inertia is above 0, in lb·in·s²",
                );
            }
        }
    }
    for body in &file.input_bodies {
        if findings.is_full() {
            return;
        }
        twice(&body.dofs, &format!("input body {}", body.id), findings);
        zero_is_ground(body.id, findings);
    }
}

fn zero_is_ground(id: Spanned<u32>, findings: &mut Findings) {
    if *id == 0 {
        findings.error(
            "ground",
            id.span,
            "a body has the number 0".to_owned(),
            "0 is the ground; number bodies from 1 on",
        );
    }
}

fn connections(file: &SystemFile, findings: &mut Findings) {
    for connection in &file.connections {
        if findings.is_full() {
            return;
        }
        let dofs = connection.element.dofs();
        let what = format!("connection {}", connection.id);
        twice(dofs, &what, findings);
        let codes: Vec<u32> = dofs.iter().map(|dof| dof.kind.code()).collect();
        let (expected, why): (&[u32], _) = match connection.element {
            Element::CoilGroup(_) => (&[2, 3, 4], "lateral, vertical, roll"),
            Element::StickSlipWedge(_) | Element::ViscousWedge(_) | Element::ViscousToeWedge(_) => {
                (&[3, 2], "vertical, lateral")
            }
            Element::StickSlipWedge3d(_) => (&[3, 1, 2], "vertical, longitudinal, lateral"),
            _ => continue,
        };
        let place = dofs.first().map_or(connection.kind.0, |first| {
            dofs.last().map_or(first.span, |last| first.span.to(last.span))
        });
        if codes != expected {
            let list: Vec<String> = expected.iter().map(u32::to_string).collect();
            let message = format!(
                "the directions of {what} are not those of type {}",
                connection.element.code()
            );
            findings.error(
                "directions",
                place,
                message,
                format!("write {}: {why}", list.join(" ")),
            );
        }
    }
}

fn positive(value: Spanned<f64>, what: &str, id: u32, findings: &mut Findings) {
    if *value <= 0.0 {
        let message = format!("the {what} of characteristic {id} is {value}");
        findings.error("range", value.span, message, "it must be above 0");
    }
}

fn not_negative(value: Spanned<f64>, what: &str, id: u32, findings: &mut Findings) {
    if *value < 0.0 {
        let message = format!("the {what} of characteristic {id} is {value}");
        findings.error("range", value.span, message, "it must not be below 0");
    }
}

fn wedge_angle(angle: Spanned<f64>, id: u32, findings: &mut Findings) {
    if !(0.0..90.0).contains(&*angle) || *angle == 0.0 {
        let message = format!("the wedge angle of characteristic {id} is {angle} degrees");
        let help = "it lies between 0 and 90 degrees, measured from the vertical";
        findings.error("range", angle.span, message, help);
    }
}

fn laws(file: &SystemFile, findings: &mut Findings) {
    for characteristic in &file.characteristics {
        if findings.is_full() {
            return;
        }
        let id = *characteristic.id;
        match &characteristic.law {
            Law::Limits {
                extension,
                compression,
                ..
            } => {
                if **extension < **compression {
                    let message = format!(
                        "the limit of characteristic {id} in extension, {extension}, is below that in \
                         compression, {compression}"
                    );
                    findings.error(
                        "range",
                        extension.span,
                        message,
                        "first extension, then compression: 1.0E9 -1.0E9",
                    );
                }
            }
            Law::Gap { high, low, .. } => {
                if **high < **low {
                    let message =
                        format!("the gap of characteristic {id} ends at {high} and begins at {low}");
                    findings.error(
                        "range",
                        high.span,
                        message,
                        "first the upper end, then the lower one",
                    );
                }
            }
            Law::ViscousWedge {
                angle,
                force,
                viscosity,
                friction,
                ..
            } => {
                wedge_angle(*angle, id, findings);
                not_negative(*force, "force", id, findings);
                positive(*viscosity, "LVB", id, findings);
                not_negative(*friction, "coefficient of friction", id, findings);
            }
            Law::ViscousToeWedge {
                angle,
                force,
                viscosity,
                slope_friction,
                column_friction,
                ..
            } => {
                wedge_angle(*angle, id, findings);
                not_negative(*force, "force", id, findings);
                positive(*viscosity, "LVB", id, findings);
                not_negative(*slope_friction, "Mu1", id, findings);
                not_negative(*column_friction, "Mu2", id, findings);
            }
            Law::SurfaceFriction {
                normal,
                stiffness,
                bristle_damping,
                friction,
                ..
            } => {
                if **normal == 0 {
                    let message = format!("characteristic {id} has no function for the normal force");
                    findings.error(
                        "no-normal-force",
                        normal.span,
                        message,
                        "friction needs a normal force: name a function",
                    );
                }
                bristle(*stiffness, *bristle_damping, id, findings);
                not_negative(*friction, "coefficient of friction", id, findings);
            }
            Law::StickSlipWedge {
                angle,
                force,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                normal_limit,
                ..
            } => {
                wedge_angle(*angle, id, findings);
                not_negative(*force, "force", id, findings);
                bristle(*stiffness, *bristle_damping, id, findings);
                not_negative(*slope_friction, "Mu1", id, findings);
                not_negative(*column_friction, "Mu2", id, findings);
                positive(*normal_limit, "FWNMAX", id, findings);
            }
            Law::StickSlipWedge3d {
                coil,
                angle,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                direction,
                normal_limit,
                ..
            } => {
                wedge_angle(*angle, id, findings);
                bristle(*stiffness, *bristle_damping, id, findings);
                not_negative(*slope_friction, "Mu1", id, findings);
                not_negative(*column_friction, "Mu2", id, findings);
                positive(*normal_limit, "FWNMAX", id, findings);
                if direction.abs() != 1.0 {
                    let message = format!("XDIR of characteristic {id} is {direction}");
                    findings.error(
                        "range",
                        direction.span,
                        message,
                        "1 for a leading wedge, -1 for a trailing one",
                    );
                }
                if **coil == 0 {
                    let message = format!("characteristic {id} has no function for the coil");
                    findings.error(
                        "no-coil",
                        coil.span,
                        message,
                        "type 6.9 has no constant force: name a function",
                    );
                }
            }
            Law::Unused { .. } => {}
        }
    }
}

fn bristle(stiffness: Spanned<f64>, damping: Spanned<f64>, id: u32, findings: &mut Findings) {
    positive(stiffness, "Ka", id, findings);
    not_negative(damping, "Ca", id, findings);
}

fn functions(file: &SystemFile, findings: &mut Findings) {
    for function in &file.piecewise_linear {
        if findings.is_full() {
            return;
        }
        let span: Span = function.id.span;
        if function.abscissae.len() < 2 {
            let message = format!("function {} has {} points", function.id, function.abscissae.len());
            findings.error(
                "points",
                span,
                message,
                "it needs two at least: for a constant, the same ordinate twice",
            );
        }
        let pairs = function.abscissae.windows(2);
        let wrong = pairs.filter(|pair| *pair[1] <= *pair[0]);
        for pair in wrong.take(3) {
            let message = format!(
                "the abscissae of function {} do not increase: {} comes after {}",
                function.id,
                shown(*pair[1]),
                shown(*pair[0])
            );
            let dress = |finding: Finding| {
                finding
                    .label("not above the one before")
                    .help("ordinates stand first, abscissae after them; abscissae increase strictly")
            };
            findings.add(Severity::Error, "abscissae", pair[1].span, message, dress);
        }
    }
}

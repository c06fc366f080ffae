//! Warnings of values that can be computed but are probably not meant.

use std::collections::HashMap;

use super::shown;
use crate::finding::{Finding, Findings, Severity};
use crate::source::Spanned;
use crate::tree::{DofKind, Law, PiecewiseLinear, SystemFile, Toe};

pub(super) fn check(file: &SystemFile, findings: &mut Findings) {
    shared_by_turns(file, findings);
    copied_stops(file, findings);
    jamming(file, findings);
    notes(file, findings);
}

/// A spring in lb/in that also serves a turn, in in·lb/rad.
fn shared_by_turns(file: &SystemFile, findings: &mut Findings) {
    let mut uses: HashMap<u32, [Vec<u32>; 2]> = HashMap::new();
    for connection in &file.connections {
        let characteristics = connection.element.characteristics();
        if characteristics.len() != connection.element.dofs().len() {
            continue;
        }
        for (dof, characteristic) in connection.element.dofs().iter().zip(characteristics) {
            let [straight, rotational] = uses.entry(**characteristic).or_default();
            let list = if dof.kind.is_translation() {
                straight
            } else {
                rotational
            };
            if list.len() < 50 && !list.contains(&*connection.id) {
                list.push(*connection.id);
            }
        }
    }
    for characteristic in &file.characteristics {
        let Some([straight, rotational]) = uses.get(&*characteristic.id) else {
            continue;
        };
        if straight.is_empty() || rotational.is_empty() || findings.is_full_of(Severity::Warning) {
            continue;
        }
        let numbers = |list: &[u32]| super::some_of(list.iter().copied());
        let message = format!(
            "characteristic {} serves displacements (connections {}) and turns (connections {})",
            characteristic.id,
            numbers(straight),
            numbers(rotational)
        );
        let help = "the same numbers are lb/in for the one and in·lb/rad for the other, a thousand times \
                    less on a lever of 40 in: give the turns a characteristic of their own";
        let dress = |finding: Finding| finding.label("used for both").help(help);
        findings.add(
            Severity::Warning,
            "shared-by-turns",
            characteristic.id.span,
            message,
            dress,
        );
    }
}

/// Two functions that rise to the same stop at the same abscissa although their free ways differ: the
/// abscissa was probably copied. The slope of the stop tells.
fn copied_stops(file: &SystemFile, findings: &mut Findings) {
    let last_three = |function: &PiecewiseLinear| -> Option<[(f64, f64); 2]> {
        let mut points = function.points().rev();
        let last = points.next()?;
        Some([points.next()?, last])
    };
    // Keyed by the bits of the last abscissa, so that large files take no square of time.
    let mut by_end: HashMap<u64, Vec<&PiecewiseLinear>> = HashMap::new();
    for function in file
        .piecewise_linear
        .iter()
        .filter(|function| function.abscissae.len() >= 3)
    {
        let Some([_, (end, _)]) = last_three(function) else {
            continue;
        };
        let same_end = by_end.entry(end.to_bits()).or_default();
        let suspicious = same_end.iter().take(50).find_map(|other| {
            let [(knee, low), (end, high)] = last_three(function)?;
            let [(other_knee, other_low), (_, other_high)] = last_three(other)?;
            let slopes = [
                (high - low) / (end - knee),
                (other_high - other_low) / (end - other_knee),
            ];
            let alike = (high - other_high).abs() <= 0.01 * high.abs() && low == other_low && low != 0.0;
            let apart = slopes[0] * 3.0 < slopes[1] || slopes[1] * 3.0 < slopes[0];
            (alike && apart && knee != other_knee).then_some((*other, slopes))
        });
        if let Some((other, slopes)) = suspicious {
            // The softer one has the longer way to the stop's end.
            let (odd, base, soft, stiff) = if slopes[0] < slopes[1] {
                (function, other, slopes[0], slopes[1])
            } else {
                (other, function, slopes[1], slopes[0])
            };
            let place = odd.abscissae.last().map_or(odd.id.span, |last| last.span);
            let message = format!(
                "the stop of function {} ends at {} as that of function {}, though it begins earlier: {} \
                 against {} lb/in",
                odd.id,
                shown(end),
                base.id,
                shown(soft),
                shown(stiff)
            );
            let dress = |finding: Finding| {
                finding
                    .label("perhaps copied")
                    .help("give the stop the length of the other one if it is to be as stiff")
            };
            findings.add(Severity::Warning, "copied-stop", place, message, dress);
        }
        same_end.push(function);
        if findings.is_full_of(Severity::Warning) {
            return;
        }
    }
}

/// Wedges that jam when the bolster goes down: with toe in, friction alone holds them. The massless wedge in
/// steady sliding has N = F (cos θ + b μ₁ sin θ) / D with D = (sin θ - b μ₁ cos θ)(cos φ + a μ₂ sin φ) + (sin
/// φ - a μ₂ cos φ) (cos θ + b μ₁ sin θ), a = 1 going down, b = 1 for toe in; where D is not positive there is
/// no such N.
fn jamming(file: &SystemFile, findings: &mut Findings) {
    let faces: HashMap<u32, &PiecewiseLinear> = file
        .piecewise_linear
        .iter()
        .rev()
        .map(|function| (*function.id, function))
        .collect();
    for characteristic in &file.characteristics {
        let (angle, slope_friction, column_friction, face, place) = match &characteristic.law {
            Law::StickSlipWedge {
                angle,
                slope_friction,
                column_friction,
                toe,
                ..
            }
            | Law::ViscousToeWedge {
                angle,
                slope_friction,
                column_friction,
                toe,
                ..
            } if **toe == Toe::In => (angle, slope_friction, column_friction, 0.0, toe.span),
            Law::StickSlipWedge3d {
                angle,
                slope_friction,
                column_friction,
                face,
                ..
            } => {
                let lean = faces.get(&**face).map_or(0.0, |face| -face.slope(0.0).atan());
                if lean >= 0.0 {
                    continue;
                }
                (angle, slope_friction, column_friction, lean, face.span)
            }
            _ => continue,
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        let (sin_face, cos_face) = face.sin_cos();
        let (slope, column) = (**slope_friction, **column_friction);
        let margin = (sin - slope * cos) * (cos_face + column * sin_face)
            + (sin_face - column * cos_face) * (cos + slope * sin);
        if margin <= 0.0 && !findings.is_full_of(Severity::Warning) {
            findings.warning(
                "jam",
                place,
                format!(
                    "the wedge of characteristic {} jams when the bolster goes down (margin {})",
                    characteristic.id,
                    shown(margin)
                ),
                "with toe in and so much friction only FWNMAX limits the force at the column",
            );
        }
    }
}

/// Title and notes against the data.
fn notes(file: &SystemFile, findings: &mut Findings) {
    let variable = file.characteristics.iter().find_map(|one| match &one.law {
        Law::StickSlipWedge3d { variable, .. } if **variable => Some(*one.id),
        Law::StickSlipWedge { coil, .. } | Law::ViscousToeWedge { coil, .. } if **coil != 0 => Some(*one.id),
        _ => None,
    });
    let lines = std::iter::once(&file.title.text).chain(&file.title.notes);
    for line in lines.take(1000) {
        let text = line.to_lowercase();
        if let Some(id) = variable.filter(|_| text.contains("constant damp") && !text.contains("variable")) {
            findings.warning(
                "title",
                line.span,
                "the text speaks of constant damping, but the wedges' coils are variable".to_owned(),
                format!("characteristic {id} says so; correct the one or the other"),
            );
        }
        if text.contains("constrain") {
            constrained(file, line, &text, findings);
        }
    }
}

fn constrained(file: &SystemFile, line: &Spanned<String>, text: &str, findings: &mut Findings) {
    let heaviest = file
        .bodies
        .iter()
        .max_by(|one, other| one.mass.total_cmp(&other.mass));
    let Some(body) = heaviest else { return };
    let names: [(DofKind, &[&str]); 6] = [
        (DofKind::X, &["longitudinal", "long.", " x"]),
        (DofKind::Y, &["lateral", "latl", " y"]),
        (DofKind::Z, &["vert", " z"]),
        (DofKind::Roll, &["roll"]),
        (DofKind::Pitch, &["pitch"]),
        (DofKind::Yaw, &["yaw"]),
    ];
    let more: Vec<&str> = names
        .iter()
        .filter(|(kind, words)| {
            body.dofs.iter().any(|dof| dof.kind == *kind) && !words.iter().any(|word| text.contains(word))
        })
        .map(|(kind, _)| kind.name())
        .collect();
    if !more.is_empty() && more.len() < 6 {
        findings.warning(
            "title",
            line.span,
            format!(
                "the text names fewer freedoms than body {} has: {} too",
                body.id,
                more.join(", ")
            ),
            "take them out of the body's list, or out of the text",
        );
    }
}

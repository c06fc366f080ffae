//! Sentences on where and why the models do not agree. The reasons were found in the built-in runs (contact
//! states, strokes, motions of the bodies); the numbers are those of the runs at hand.

use quantity::{Kind, System as Units};
use report::figures::digits;
use study::half_truck::catalog::WedgeType;
use wedge::parameters::Damping;

use super::{AgreementGroup, ComparedModel, Stroke};

/// Returns the sentences.
pub(super) fn of(group: &AgreementGroup, units: Units) -> Vec<String> {
    let mut remarks = Vec::new();
    remarks.push(slope(group).to_owned());
    remarks.extend(group.strokes.iter().map(|stroke| loops(group, stroke, units)));
    if let Some(stroke) = group.strokes.first() {
        remarks.push(springs(group, stroke, units));
    }
    if group.damping == Damping::Variable {
        remarks.push(
            "In the first cycle the types rattle from branch to branch between 1.6 and 2.4 s: the input \
             starts with its full speed, which sets the undamped input springs ringing at about 15 Hz, and \
             the friction of that cycle quiets them. The thesis's rows, 0.1 s apart, hide such ringing; \
             loop areas here, from rows 0.01 s apart, miss some 2 % of the energy that it takes, which the \
             energies hold."
                .to_owned(),
        );
        remarks.push(
            "With the bolster lifted off, the types' forces are exactly zero. The stand-alone wedge has a \
             mass: it stands on its coil with its weight, and rings."
                .to_owned(),
        );
    }
    if group.yawed {
        remarks.extend(yaw(group));
    }
    remarks
}

/// Returns the sentence on why the stand-alone model differs from all quasi-static ones.
fn slope(group: &AgreementGroup) -> &'static str {
    match (group.damping, group.yawed) {
        (Damping::Constant, _) => {
            "The quasi-static models are on eq. 5-1's plateaus at once after a reversal. In the stand-alone \
             model the slope sticks then, and wedge and bolster move as one body, which the toe squeezes \
             between column and pocket going up (the force climbs) and eases going down (it falls); the \
             slope slips, and the plateau is reached, only after half the stroke. So its mean is lower \
             going up and higher going down, and the loop is about the same."
        }
        (Damping::Variable, false) => {
            "After the bottom reversal the slope of the stand-alone model sticks for some 0.3 s: its force \
             stays below that of eq. 5-1 until the slope slips. Going down it follows eq. 5-1. The types \
             are on eq. 5-1's line at once, either way."
        }
        (Damping::Variable, true) => {
            "After the bottom reversal the slope of the stand-alone model sticks for some 0.3 s, so that \
             its force begins below that of eq. 5-1. For the rest it is above: the yawed pocket bears on \
             one side and presses the wedge lower, and the coil with it."
        }
    }
}

/// Returns the sentence on a type's loop in the half-truck.
fn loops(group: &AgreementGroup, stroke: &Stroke, units: Units) -> String {
    let energy = |value: f64| {
        let value = value * Kind::Energy.from_si(units);
        format!("{} {}", digits(value), Kind::Energy.label(units))
    };
    let length = |value: f64| digits(value * Kind::Length.from_si(units));
    let rest = if group.yawed {
        "the lateral slip and the ringing that come with the half-truck's swing in yaw"
    } else {
        "the accumulators of the friction, which have to turn at each reversal, and the stroke's ringing"
    };
    format!(
        "Type {}: alone under the input's full stroke{} its loop is {}; in the half-truck it is {} ({}). \
         Its stroke goes from {} to {} {}: that alone makes {}; the rest, {}, is from {rest}.",
        stroke.wedges.code(),
        if stroke.wedges == WedgeType::Spatial && group.damping == Damping::Variable {
            " (with the wedge's rise in its pocket, which eases the coil by 0.6 %)"
        } else {
            ""
        },
        energy(stroke.alone),
        energy(stroke.found),
        percent(stroke.found / stroke.alone - 1.0),
        length(stroke.ends[0]),
        length(stroke.ends[1]),
        Kind::Length.label(units),
        percent(stroke.shortened / stroke.alone - 1.0),
        percent(stroke.found / stroke.shortened - 1.0),
    )
}

/// Returns the sentence on stroke lost or gained.
fn springs(group: &AgreementGroup, stroke: &Stroke, units: Units) -> String {
    let length = |value: f64| {
        let value = value * Kind::Length.from_si(units);
        format!("{} {}", digits(value), Kind::Length.label(units))
    };
    let (frame, input) = (length(stroke.side_frame), length(stroke.input_springs));
    match group.damping {
        Damping::Variable => format!(
            "The stroke is deeper than the input's: the files' springs have no preload with variable \
             damping, so that the bolster's load hangs on the input springs (the bolster is up to {input} \
             off the input), and the unloaded side frames stand up to {frame} high on their bearings. The \
             force grows with the depth, and the loop with its square."
        ),
        Damping::Constant => format!(
            "The stroke is shorter than the input's: input springs (up to {input}) and side frames (up to \
             {frame}) give way to the spring groups and the friction."
        ),
    }
}

/// Returns the sentence on the effect of yaw.
fn yaw(group: &AgreementGroup) -> Vec<String> {
    let mut texts = vec![
        "Yawed as intended, the half-truck's bolster is held in yaw by its springs and wedges alone and \
         swings about 0.012 rad, slowly dying out. The wedges slide sideways along the column with it, and \
         as one friction acts against both slips, its vertical part, which is looked at here, is smaller; \
         compare means, not samples. The stand-alone bolster holds its yaw, and its wedge cannot move \
         sideways."
            .to_owned(),
    ];
    if group
        .models
        .iter()
        .any(|numbers| numbers.model == ComparedModel::Type(WedgeType::Spatial))
    {
        texts.push(
            "Type 6.9 feels the swing more than type 6.8: its pocket goes to and fro along the track, which \
             lifts the wedge against the coil."
                .to_owned(),
        );
    }
    texts
}

/// Returns a share in per cent, with its sign.
pub(crate) fn percent(share: f64) -> String {
    let sign = if share < 0.0 { "\u{2212}" } else { "+" };
    format!("{sign}{:.1} %", 100.0 * share.abs())
}

//! The section `[damage]`: coefficients of wear and rolling contact fatigue of wheels and rails, of wear of
//! wedges.

use quantity::Kind;

use super::DamageLaws;
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::Range;
use crate::reader::{CaseReader, QuantityForm};
use crate::wear::mounted::WedgeLaw;

/// Reads `[damage]` of a truck, which has wedges alone; written where it is given only.
pub(crate) fn read_of_wedges(r: &mut CaseReader<'_>) -> WedgeLaw {
    let mut law = WedgeLaw::default();
    if r.overlay("damage", "Wear of wedges by Archard's law: guesses.") {
        law.read(r);
    }
    law
}

/// Reads `[damage]`, which is written where it is given only.
pub(crate) fn read(r: &mut CaseReader<'_>) -> DamageLaws {
    let mut laws = DamageLaws::default();
    let about = "Damage of wheels and rails: coefficients of Archard's law over pressure and sliding speed, \
                 and the\n# damage function of rolling contact fatigue. Numbers are remembered from \
                 publications; they were measured dry.\n# Wear of wedges by Archard's law: guesses.";
    if !r.overlay("damage", about) {
        return laws;
    }
    let own = &mut laws.wear;
    let pressure: QuantityForm = (Kind::Pressure, Range::Positive, Reach::Positive);
    r.quantity("hardness", pressure, &mut own.hardness, "of wheels and rails");
    let [slow, middling, fast] = &mut own.coefficients;
    for (key, value, comment) in [
        ("wear_slow", slow, "of slow sliding: 1e-4 to 10e-4"),
        ("wear_middling", middling, "of middling speeds: 30e-4 to 40e-4"),
        ("wear_fast", fast, "of fast sliding: 1e-4 to 10e-4"),
        (
            "wear_pressed",
            &mut own.pressed,
            "of high pressures: 300e-4 to 400e-4",
        ),
    ] {
        r.number(key, Range::NotNegative, Reach::FromZero(1e-3), value, comment);
    }
    let speed: QuantityForm = (Kind::Speed, Range::Positive, Reach::Positive);
    let [from, to] = &mut own.speeds;
    r.quantity("middling_from", speed, from, "sliding speed");
    r.quantity("middling_to", speed, to, "sliding speed");
    let comment = "pressures are high above this share of the hardness";
    r.number(
        "pressed_from",
        Range::Positive,
        Reach::Positive,
        &mut own.share,
        comment,
    );
    if own.speeds[0] > own.speeds[1] {
        let problem = Problem::new("middling speeds end before they begin");
        let help = "write damage.middling_to larger than damage.middling_from";
        r.problem("damage.middling_to", problem.label("too small").help(help));
    }
    let force: QuantityForm = (Kind::Force, Range::NotNegative, Reach::FromZero(100.0));
    let mut ends = [15.0, 65.0, 175.0];
    let [from, most, end] = &mut ends;
    r.quantity("fatigue_from", force, from, "wear number from which cracks grow");
    let comment = "wear number at which they grow most: 1e-5 of the life a passage";
    r.quantity("fatigue_most", force, most, comment);
    let comment = "wear number from which wear takes away more than they grow";
    r.quantity("fatigue_end", force, end, comment);
    if ends[0] >= ends[1] || ends[1] >= ends[2] {
        let problem = Problem::new("the wear numbers of the damage function do not rise");
        let help = "write damage.fatigue_from < damage.fatigue_most < damage.fatigue_end";
        r.problem("damage.fatigue_most", problem.label("out of order").help(help));
    } else {
        laws.fatigue.points = ends
            .into_iter()
            .zip([0.0, 1.0, 0.0])
            .map(|(at, own)| [at, own])
            .collect();
    }
    laws.wedges.read(r);
    laws
}

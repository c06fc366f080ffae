//! The section `[friction]`: friction of wheel on rail by zone, rail, distance and slip.
//!
//! `wheels.friction` is the coefficient of all contacts that nothing is said of here. Sections are written
//! where they are given only.

use std::sync::Arc;

use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::friction::{Falling, Friction, Zones};

use super::changes::{self, Change, Entries};
use super::profiles::SIDES;
use crate::case::field::Reach;
use crate::case::friction::COEFFICIENT;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range};
use crate::reader::CaseReader;

/// Length over which coefficients go over into the next ones, from their place on, m.
const CHANGE: f64 = 1.0;
const REACH: Reach = Reach::FromZero(0.5);

/// Reads `[friction]`, `[friction.left]`, `[friction.right]`; `law` has `wheels.friction`. Returns the laws
/// of contacts on both rails.
pub(super) fn laws(r: &mut CaseReader<'_>, mut law: ContactLaw) -> [ContactLaw; 2] {
    let usual = law.friction.zones.tread;
    let mut zones = Zones {
        tread: usual,
        gauge_face: usual,
    };
    let mut falling = Falling {
        ratio: 1.0,
        decay: wheelrail::friction::DRY.decay,
    };
    let mut changes = Vec::new();
    let about = "Friction of wheel on rail where it is not wheels.friction everywhere. [friction.left] and \
                 [friction.right] take tread, gauge_face and over_distance of one rail.";
    if r.overlay("friction", about) {
        gauge_face(r, &mut zones);
        let comment =
            "of friction at high slip to that at none: 0.4 on dry rails (Polach); 1: it does not fall";
        let range = Range::Between(0.0, 1.0, "between 0 and 1");
        r.number("ratio", range, REACH, &mut falling.ratio, comment);
        let comment = "B of exp(-B w) with the slip velocity w, s/m: 0.6 on dry rails (Polach)";
        r.number("decay", Range::NotNegative, REACH, &mut falling.decay, comment);
        reduction(r, &mut law.creep);
        changes = over_distance(r, zones);
    }
    SIDES.map(|side| {
        let mut zones = zones;
        let mut own = changes.clone();
        let about = "One rail: what is not given is as in [friction].";
        if r.overlay(&format!("friction.{side}"), about) {
            let comment = "on treads: below a contact angle of 20 deg";
            let both = zones.gauge_face == zones.tread;
            r.number("tread", COEFFICIENT, REACH, &mut zones.tread, comment);
            if both {
                zones.gauge_face = zones.tread;
            }
            gauge_face(r, &mut zones);
            if r.gives("over_distance") {
                own = over_distance(r, zones);
            } else {
                r.also_known("over_distance");
            }
        }
        ContactLaw {
            friction: made(r, (zones, &own), falling, side),
            ..law.clone()
        }
    })
}

/// Reads Polach's reduction factors.
fn reduction(r: &mut CaseReader<'_>, creep: &mut CreepLaw) {
    const KEYS: [&str; 2] = ["adhesion_factor", "slip_factor"];
    let CreepLaw::Polach(own) = creep else {
        for key in KEYS {
            r.also_known(key);
            if r.gives(key) {
                let problem = Problem::new(format!("`friction.{key}` is of Polach's creep law alone"));
                let help = "leave it out, or write wheels.creep = \"polach\"";
                r.problem(&format!("friction.{key}"), problem.label("no effect").help(help));
            }
        }
        return;
    };
    let range = Range::Between(0.0, 1.0, "between 0 and 1");
    let comment = "kA of Polach's law, which lowers the slope in the area of adhesion: 1 dry";
    r.number(KEYS[0], range, REACH, &mut own.adhesion, comment);
    let comment = "kS of Polach's law, in the area of slip: with falling friction 0.4 on dry rails";
    r.number(KEYS[1], range, REACH, &mut own.slip, comment);
}

fn gauge_face(r: &mut CaseReader<'_>, zones: &mut Zones) {
    let comment = "above a contact angle of 30 deg; linear in the angle from that of the tread at 20 deg";
    r.number("gauge_face", COEFFICIENT, REACH, &mut zones.gauge_face, comment);
}

/// Reads `over_distance`; what a place does not say is as `zones` have it.
fn over_distance(r: &mut CaseReader<'_>, zones: Zones) -> Vec<Change<Zones>> {
    let comment = "from places along the track on, within 1 m: [{ from = \"500 ft\", tread = 0.2, gauge_face \
                   = 0.15 }]";
    let entries = Entries {
        keys: &["from", "tread", "gauge_face"],
        what: "friction over distance",
        instead: "",
    };
    let read = |own: &CaseSection<'_>, problems: &mut Problems| {
        let mut coefficient = |key: &str, usual: f64| match own.table.get(key) {
            Some(_) => own.number(key, COEFFICIENT, "0.3", problems),
            None => Some(usual),
        };
        let tread = coefficient("tread", zones.tread)?;
        // Without zones the tread's holds for both.
        let usual = match zones.tread == zones.gauge_face {
            true => tread,
            false => zones.gauge_face,
        };
        let gauge_face = coefficient("gauge_face", usual)?;
        Some(Zones { tread, gauge_face })
    };
    changes::over_distance(r, comment, &entries, read, |Zones { tread, gauge_face }| {
        format!("tread = {tread}, gauge_face = {gauge_face}")
    })
}

fn made(
    r: &mut CaseReader<'_>,
    (zones, changes): (Zones, &[Change<Zones>]),
    falling: Falling,
    side: &str,
) -> Friction {
    let steps: Vec<(f64, Zones)> = changes.iter().map(|own| (own.from.to_si(), own.to)).collect();
    let over = changes::places(&zones, &steps, CHANGE).unwrap_or_else(|number| {
        let message = format!(
            "friction from {} on begins before the change before it ends: places must rise by more than 1 m",
            changes[number].from
        );
        let path = match r.has(&format!("friction.{side}.over_distance")) {
            true => format!("friction.{side}.over_distance"),
            false => "friction.over_distance".to_owned(),
        };
        let help = "give places in their order along the track";
        r.problem(&path, Problem::new(message).label("too near").help(help));
        Vec::new()
    });
    Friction {
        zones,
        over: (!over.is_empty()).then(|| Arc::from(over)),
        falling: (falling.ratio < 1.0).then_some(falling),
    }
}

/// Returns friction in words: `0.4`, or what it depends on.
pub(crate) fn in_words(friction: &Friction) -> String {
    let Zones { tread, gauge_face } = friction.zones;
    let mut words = match tread == gauge_face {
        true => format!("{tread}"),
        false => format!(
            "{tread} on the tread (contact angle below 20 deg), {gauge_face} on the gauge face (above 30 deg)"
        ),
    };
    if let Some(over) = &friction.over {
        let all = || friction.all();
        let (least, most) = (
            all().fold(f64::INFINITY, f64::min),
            all().fold(f64::NEG_INFINITY, f64::max),
        );
        words += &format!(
            ", between {least} and {most} over distance ({} changes)",
            over.len().div_ceil(2)
        );
    }
    if let Some(Falling { ratio, decay }) = friction.falling {
        words += &format!(
            ", falling with the slip velocity w by {ratio} + {:.4} exp(-{decay} s/m w)",
            1.0 - ratio
        );
    }
    words
}

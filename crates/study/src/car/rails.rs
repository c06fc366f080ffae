//! The section `[rails]`: profiles of both rails, over distance too, and gauge.

use std::sync::Arc;

use car::ProfiledWheels;
use quantity::Kind as Measure;
use wheelrail::contact::Side;
use wheelrail::profile::{Profile, ProfileKind, ReadOptions, SlicedProfile, names, nominal};

use super::changes::{self, Change, Entries};
use super::profiles::{self, DEVIATION, NamedProfile, SIDES, named, named_or, profile, sliced, wrong};
use crate::case::field::{Reach, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range};
use crate::reader::{CaseReader, LENGTH, QuantityForm};

const INCH: f64 = 0.0254;
const PLACE: QuantityForm = (Measure::Distance, Range::Any, Reach::Wide);

/// Rails as read: profiles (left, right), those that change along the track, gauge, its depth; what is
/// doubtful about them.
pub(crate) struct Rails {
    pub(super) profiles: Option<[Arc<Profile>; 2]>,
    pub(super) over: [Option<Arc<SlicedProfile>>; 2],
    pub(super) gauge: f64,
    pub(super) gauge_depth: f64,
    pub(super) doubts: Vec<String>,
}

impl Rails {
    /// Returns whether one changes along the track.
    pub(super) fn varies(&self) -> bool {
        self.over.iter().any(Option::is_some)
    }
}

/// A rail as typed.
#[derive(Clone, Debug)]
struct Rail {
    named: NamedProfile,
    inclination: f64,
    /// Whether the inclination is given: then it is that of all profiles.
    inclined: bool,
    /// The section that names them, and profiles over distance.
    changes: (String, Vec<Change<String>>),
    slices_from: f64,
}

/// What holds for both rails.
struct Both {
    gauge_depth: f64,
    deviation: f64,
    change_length: f64,
}

/// A rail with its sections over distance, if they change.
type Made = (Arc<Profile>, Option<Arc<SlicedProfile>>);

/// Reads `[rails]`.
pub(crate) fn rails(r: &mut CaseReader<'_>) -> Rails {
    r.section(
        "rails",
        "The rails. [rails.left] and [rails.right] take profile, inclination, over_distance and slices_from \
         of one.",
    );
    let comment = "\"136re\" (nominal, from memory), \"136re_8in\", \"60e1\", or a file: CSV with units, \
                   Simpack, \
                   MiniProf, VAMPIRE, a list of sections (.slcs)";
    let named_both = named(r, "rails", "136re", comment);
    let range = Range::Between(-0.5, 0.5, "between -0.5 and 0.5: a slope");
    let reach = Reach::Between(0.0, 0.05);
    let comment = "towards the track's center, 1:40; 0 for profiles from files, which mostly have it";
    let mut inclination = usual(&named_both.name);
    r.number("inclination", range, reach, &mut inclination, comment);
    let inclined = r.gives("inclination");
    let comment = "other profiles from places along the track on: [{ from = \"500 ft\", profile = \
                   \"worn.csv\" }]";
    let changes = ("rails".to_owned(), over_distance(r, comment));
    let mut change_length = 1.0;
    let form: QuantityForm = (Measure::Length, Range::Positive, Reach::Positive);
    let comment = "over which a profile goes over into the next one of over_distance, from its place on";
    r.quantity("change_length", form, &mut change_length, comment);
    let mut slices_from = 0.0;
    let comment = "along the track: where place 0 of a list of sections (.slcs) lies";
    r.quantity("slices_from", PLACE, &mut slices_from, comment);
    let mut gauge = 56.5 * INCH;
    r.quantity("gauge", LENGTH, &mut gauge, "between the gauge sides");
    let mut gauge_depth = nominal::GAUGE_DEPTH;
    let comment = "below the datum of the rail, z = 0 of its file, where gauge is measured";
    r.quantity("gauge_depth", LENGTH, &mut gauge_depth, comment);
    let mut deviation = DEVIATION;
    let form: QuantityForm = (Measure::Length, Range::NotNegative, Reach::FromZero(1e-4));
    let comment = "how far a spline may lie from the points of a file";
    r.quantity("deviation", form, &mut deviation, comment);
    let whole = Rail {
        named: named_both,
        inclination,
        inclined,
        changes,
        slices_from,
    };
    let sides = SIDES.map(|name| {
        let path = format!("rails.{name}");
        if !r.overlay(&path, "One rail: what is not given is as in [rails].") {
            return None;
        }
        let mut rail = whole.clone();
        rail.named = named_or(r, &path, &whole.named);
        if rail.named != whole.named && !inclined {
            rail.inclination = usual(&rail.named.name);
        }
        let comment = "as for both rails";
        r.number("inclination", range, reach, &mut rail.inclination, comment);
        rail.inclined |= r.gives("inclination");
        let given = r.gives("over_distance");
        let changes = over_distance(r, comment);
        if given || r.gives("profile") {
            rail.changes = (path, changes);
        }
        r.quantity("slices_from", PLACE, &mut rail.slices_from, comment);
        Some(rail)
    });
    let both = Both {
        gauge_depth,
        deviation,
        change_length,
    };
    let mut doubts = Vec::new();
    let alike = sides.iter().all(Option::is_none);
    let mut own = |i: usize| {
        let side = (!alike).then_some([Side::Left, Side::Right][i]);
        made(r, sides[i].as_ref().unwrap_or(&whole), &both, side, &mut doubts)
    };
    let left = own(0);
    let right = if alike { left.clone() } else { own(1) };
    let (profiles, over) = match left.zip(right) {
        Some(((left, left_over), (right, right_over))) => (Some([left, right]), [left_over, right_over]),
        None => (None, [None, None]),
    };
    Rails {
        profiles,
        over,
        gauge,
        gauge_depth,
        doubts,
    }
}

/// Returns the usual inclination of a profile of this name.
fn usual(name: &str) -> f64 {
    match names::rail(name) {
        Ok(Some((_, usual))) => usual,
        _ => 0.0,
    }
}

/// Reads `over_distance`: names of profiles.
fn over_distance(r: &mut CaseReader<'_>, comment: &str) -> Vec<Change<String>> {
    let entries = Entries {
        keys: &["from", "profile"],
        what: "a profile over distance",
        instead: "; a list of sections (.slcs) may have 2000",
    };
    let read = |own: &CaseSection<'_>, problems: &mut Problems| {
        own.text("profile", problems).map(|(name, _)| name.to_owned())
    };
    changes::over_distance(r, comment, &entries, read, |name| {
        format!("profile = {}", quoted(name))
    })
}

/// Returns a rail as it stands.
fn made(
    r: &mut CaseReader<'_>,
    rail: &Rail,
    both: &Both,
    side: Option<Side>,
    doubts: &mut Vec<String>,
) -> Option<Made> {
    let options = ReadOptions {
        deviation: both.deviation,
        side,
        ..ReadOptions::default()
    };
    let path = format!("{}.over_distance", rail.changes.0);
    if profiles::is_list(r, &rail.named, ProfileKind::Rail) {
        if !rail.changes.1.is_empty() {
            let message = format!(
                "`{}` is a list of sections, and `{path}` gives profiles too",
                rail.named.path
            );
            let help = "write one of them: the list, or over_distance with single profiles";
            r.problem(&path, Problem::new(message).help(help));
            return None;
        }
        let list = sliced(r, &rail.named, ProfileKind::Rail, &options, doubts)?.from(rail.slices_from);
        let list = match rail.inclination {
            0.0 => list,
            slope => list.inclined(slope),
        };
        let first = list.profiles().first()?.clone();
        return Some((first, Some(Arc::new(list))));
    }
    let mut stands = |named: &NamedProfile, slope: f64| {
        let own = profile(r, named, ProfileKind::Rail, &options, doubts)?;
        Some(match slope {
            0.0 => own,
            slope => own.inclined(slope),
        })
    };
    let base = Arc::new(stands(&rail.named, rail.inclination)?);
    // Each file is read once.
    let mut known: Vec<(&str, Arc<Profile>)> = vec![(&rail.named.name, base.clone())];
    let mut steps: Vec<(f64, Arc<Profile>)> = Vec::new();
    for Change { from, to: name } in &rail.changes.1 {
        let found = known.iter().find(|(other, _)| other == name);
        let own = match found {
            Some((_, own)) => own.clone(),
            None => {
                let named = NamedProfile {
                    path: path.clone(),
                    name: name.clone(),
                };
                let slope = match rail.inclined {
                    true => rail.inclination,
                    false => usual(name),
                };
                let own = stands(&named, slope)?;
                // Every profile stands with its gauge side and its top where the first one has them.
                let place = |of: &Profile| [of.gauge_point(both.gauge_depth), of.top()[1]];
                let ([y, z], [own_y, own_z]) = (place(&base), place(&own));
                let own = Arc::new(own.moved([y - own_y, z - own_z]));
                known.push((name, own.clone()));
                own
            }
        };
        steps.push((from.to_si(), own));
    }
    if steps.is_empty() {
        return Some((base, None));
    }
    match changes::places(&base, &steps, both.change_length) {
        Ok(slices) => match SlicedProfile::of_rails(&path, slices) {
            Ok(over) => Some((base, Some(Arc::new(over)))),
            Err(error) => {
                wrong(r, &path, &error);
                None
            }
        },
        Err(number) => {
            let Change { from, to: name } = &rail.changes.1[number];
            let message = format!(
                "`{path}`: the profile {} begins at {from}, before the one before it is reached",
                profiles::shown(r, name)
            );
            let help = format!(
                "places must rise, each by more than rails.change_length ({} m)",
                both.change_length
            );
            r.problem(&path, Problem::new(message).label("too near").help(help));
            None
        }
    }
}

/// Notes rails that change where the vehicle stands at the start, up to a distance along the track, m.
pub(crate) fn begin_behind(r: &mut CaseReader<'_>, wheels: &ProfiledWheels, reached: f64) {
    for (over, name) in wheels.rails_over.iter().zip(SIDES) {
        let Some(over) = over else {
            continue;
        };
        let first = over.places().first().copied().unwrap_or(f64::INFINITY);
        // Changes that end before the vehicle stands count too: it comes to rest on the first section.
        if first >= reached || over.profiles().len() == 1 {
            continue;
        }
        let message = format!(
            "the {name} rail changes from {:.1} m along the track on, where the vehicle stands at the start, \
             up to {:.1} m: it comes to rest on the first section",
            first, reached
        );
        let help = format!(
            "let the changes begin at {:.1} m or behind it (from of over_distance, or slices_from), or start \
             earlier",
            reached + 0.1
        );
        r.problem(
            "rails.over_distance",
            Problem::new(message).label("too early").help(help),
        );
        return;
    }
}

/// Returns the assumptions about rails that change along the track.
pub(crate) fn over_in_words(rails: &[Option<Arc<SlicedProfile>>; 2]) -> impl Iterator<Item = String> {
    let changing = SIDES.into_iter().zip(rails);
    changing.filter_map(|(side, over)| {
        let places = over.as_ref()?.places();
        Some(format!(
            "The {side} rail changes along the track: {} sections from {:.1} to {:.1} m; between two of them \
             points at equal shares of their visible lengths go over into each other in proportion to the \
             distance, rounded within 5 mm of each section; before the first and behind the last one the \
             rail stays as it is there.",
            places.len(),
            places.first()?,
            places.last()?,
        ))
    })
}

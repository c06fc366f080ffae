//! Wheels that are not round: the keys `flats` and `out_of_round` of `[wheels]` and of its sections for some
//! wheels, and profiles from lists of sections around a wheel.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use car::{Parameters, ProfiledWheels, Wheels};
use quantity::{Kind, Number, Quantity};
use wheelrail::contact::{Flat, HIGHEST_ORDER, Harmonic, OutOfRound, SlicedWheel, WheelForm};
use wheelrail::profile::{ProfileError, SlicedProfile};

use super::profiles::{SIDES, wrong};
use crate::case::field::Written;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range};
use crate::reader::CaseReader;
use crate::reader::schema::Form;

/// Keys of wheels that are not round.
const KEYS: [&str; 2] = ["flats", "out_of_round"];
/// Most entries of a list.
const MOST: usize = 100;
/// Rows in the time in which a wheel passes half of a flat or an eighth of a wave, from which on peaks are
/// met.
const ROWS: f64 = 4.0;

/// A list as typed, with the full path of the key that gives it.
#[derive(Clone, Debug, PartialEq)]
struct Given<T> {
    path: String,
    list: Vec<T>,
}

impl<T> Default for Given<T> {
    fn default() -> Self {
        Self {
            path: String::new(),
            list: Vec::new(),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
struct TypedFlat {
    length: Quantity,
    depth: Option<Quantity>,
    angle: Option<Quantity>,
}

#[derive(Clone, Debug, PartialEq)]
struct TypedHarmonic {
    order: u32,
    amplitude: Quantity,
    angle: Option<Quantity>,
}

/// What is said of the roundness of a wheel.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Roundness {
    flats: Given<TypedFlat>,
    harmonics: Given<TypedHarmonic>,
}

/// Reads the keys of the current section, whose path this is; what it does not give is as in `base`.
pub(super) fn roundness(r: &mut CaseReader<'_>, section: &str, base: &Roundness) -> Roundness {
    let comment = "flats of the wheel, fresh (a chord) or worn to a depth: [{ length = \"50 mm\", angle = \
                   \"180 deg\" }]; angle in the wheel, from what is down at the start forward";
    let flats = list(
        r,
        "flats",
        comment,
        (section, &base.flats),
        (&["length", "depth", "angle"], "a flat"),
        |own, problems| {
            let length = own.quantity("length", Kind::Length, Range::Positive, problems);
            let depth = optional(own, "depth", Kind::Length, Range::Positive, problems);
            let angle = optional(own, "angle", Kind::Angle, Range::Any, problems);
            Some(TypedFlat {
                length: length?,
                depth: depth?,
                angle: angle?,
            })
        },
        |own| {
            let depth = own.depth.as_ref().map(|depth| format!(", depth = \"{depth}\""));
            let angle = own.angle.as_ref().map(|angle| format!(", angle = \"{angle}\""));
            let (depth, angle) = (depth.unwrap_or_default(), angle.unwrap_or_default());
            format!("{{ length = \"{}\"{depth}{angle} }}", own.length)
        },
    );
    let comment = "harmonics of the radius, order 1 is eccentricity: [{ order = 3, amplitude = \"0.1 mm\", \
                   angle = \"0 deg\" }]; largest at this angle";
    let harmonics = list(
        r,
        "out_of_round",
        comment,
        (section, &base.harmonics),
        (&["order", "amplitude", "angle"], "a harmonic"),
        |own, problems| {
            let order = order(own, problems);
            let amplitude = own.quantity("amplitude", Kind::Length, Range::Positive, problems);
            let angle = optional(own, "angle", Kind::Angle, Range::Any, problems);
            Some(TypedHarmonic {
                order: order?,
                amplitude: amplitude?,
                angle: angle?,
            })
        },
        |own| {
            let angle = own.angle.as_ref().map(|angle| format!(", angle = \"{angle}\""));
            let angle = angle.unwrap_or_default();
            format!(
                "{{ order = {}, amplitude = \"{}\"{angle} }}",
                own.order, own.amplitude
            )
        },
    );
    Roundness { flats, harmonics }
}

/// Reads a list of tables, if it is given.
fn list<T: Clone>(
    r: &mut CaseReader<'_>,
    key: &'static str,
    comment: &str,
    (section, base): (&str, &Given<T>),
    (keys, what): (&[&str], &str),
    read: impl Fn(&CaseSection<'_>, &mut Problems) -> Option<T>,
    write: impl Fn(&T) -> String,
) -> Given<T> {
    let given = r.gives(key);
    let path = format!("{section}.{key}");
    let all = |own: &CaseSection<'_>, problems: &mut Problems| {
        let tables = own.tables(key, problems);
        if tables.len() > MOST {
            let message = format!("`{path}` has {} entries", tables.len());
            let help = format!("at most {MOST} are read; profiles around a wheel come from a list .slcw");
            problems.push(Problem::new(message).label("too many").help(help));
            return None;
        }
        let mut list = Vec::with_capacity(tables.len());
        for own in tables {
            own.allow_in(keys, &[], what, problems);
            list.push(read(&own, problems)?);
        }
        Some(list)
    };
    let list = r.other(key, Form::Other, comment, Vec::new(), all, |list: &Vec<T>| {
        let all: Vec<String> = list.iter().map(&write).collect();
        Written::toml(format!("[{}]", all.join(", ")))
    });
    match given {
        true => Given { path, list },
        false => base.clone(),
    }
}

/// A quantity that may be left out; nothing if it is wrong.
fn optional(
    own: &CaseSection<'_>,
    key: &str,
    kind: Kind,
    range: Range,
    problems: &mut Problems,
) -> Option<Option<Quantity>> {
    match own.table.get(key) {
        None => Some(None),
        Some(_) => own.quantity(key, kind, range, problems).map(Some),
    }
}

/// The order of a harmonic.
fn order(own: &CaseSection<'_>, problems: &mut Problems) -> Option<u32> {
    let highest = f64::from(HIGHEST_ORDER);
    let range = Range::Between(0.5, highest + 0.5, "a whole number from 1 to 100");
    let value = own.number("order", range, "3", problems)?;
    if value.fract() != 0.0 {
        let path = own.path_of("order");
        let message = format!("`{path}` is {}; it must be a whole number", Number(value));
        let help = "waves in a turn: 1 is eccentricity, 2 an oval, 3 a triangle";
        problems.push(Problem::new(message).label("not whole").help(help));
        return None;
    }
    Some(value as u32)
}

impl Roundness {
    /// Returns the same with what `side` says where it says no more than `all`.
    pub(super) fn over(mut self, side: &Self, all: &Self) -> Self {
        if self.flats == all.flats {
            self.flats = side.flats.clone();
        }
        if self.harmonics == all.harmonics {
            self.harmonics = side.harmonics.clone();
        }
        self
    }

    /// Returns the form of a wheel of a radius (m), with its sections around it; `profile` is the path of
    /// the key that names them. None of a round wheel, or of one with a mistake.
    pub(super) fn form(
        &self,
        r: &mut CaseReader<'_>,
        radius: f64,
        (sliced, profile): (Option<&SlicedProfile>, &str),
        doubts: &mut Vec<String>,
    ) -> Option<WheelForm> {
        let none = self.flats.list.is_empty() && self.harmonics.list.is_empty();
        if let Some(list) = sliced {
            if !none {
                let path = match self.flats.list.is_empty() {
                    true => &self.harmonics.path,
                    false => &self.flats.path,
                };
                let message =
                    format!("`{profile}` is a list of sections around the wheel, and `{path}` is given too");
                let help = "write one of them: the sections have the form of the wheel";
                r.problem(path, Problem::new(message).label("two forms").help(help));
                return None;
            }
            doubts.extend(gap(list, profile).filter(|doubt| !doubts.contains(doubt)));
            let made = SlicedWheel::new(list, radius).map_err(|error| wrong(r, profile, &error));
            return made.ok().map(|made| WheelForm::Sliced(Arc::new(made)));
        }
        if none {
            return None;
        }
        let flats = self.flats.list.iter().map(|own| Flat {
            length: own.length.to_si(),
            depth: own.depth.as_ref().map(|depth| depth.to_si()),
            angle: own.angle.as_ref().map_or(PI, Quantity::to_si),
        });
        let flats: Vec<Flat> = flats.collect();
        let harmonics = self.harmonics.list.iter().map(|own| Harmonic {
            order: own.order,
            amplitude: own.amplitude.to_si(),
            angle: own.angle.as_ref().map_or(0.0, Quantity::to_si),
        });
        let mut refused = |path: &str, error: &ProfileError| {
            let problem = Problem::new(format!("`{path}`: {error}")).help(error.remedy());
            r.problem(path, problem.label("no such wheel"));
        };
        if let Err(error) = OutOfRound::new(radius, flats.clone(), Vec::new()) {
            refused(&self.flats.path, &error);
            return None;
        }
        match OutOfRound::new(radius, flats, harmonics.collect()) {
            Ok(made) => Some(WheelForm::OutOfRound(Arc::new(made))),
            Err(error) => {
                refused(&self.harmonics.path, &error);
                None
            }
        }
    }
}

/// Returns the doubt about a list that leaves more than a quarter of the wheel open between different
/// sections.
fn gap(list: &SlicedProfile, path: &str) -> Option<String> {
    let (places, profiles) = (list.places(), list.profiles());
    let count = places.len();
    let mut gaps = (0..count).map(|k| {
        let next = (k + 1) % count;
        let turn = if next == 0 { TAU } else { 0.0 };
        (places[next] + turn - places[k], k, next)
    });
    let (gap, from, to) =
        gaps.find(|(gap, from, to)| *gap > FRAC_PI_2 && !Arc::ptr_eq(&profiles[*from], &profiles[*to]))?;
    if profiles[from] == profiles[to] {
        return None;
    }
    Some(format!(
        "`{path}`: between the sections at {:.1} and {:.1} deg the wheel goes over straight from one into \
         the other within {:.0} deg; give sections between them",
        places[from].to_degrees(),
        places[to].to_degrees(),
        gap.to_degrees()
    ))
}

/// Notes wheels that are not round where they are linear.
pub(super) fn refuse_linear(r: &mut CaseReader<'_>) {
    let sections = SIDES.map(|side| format!("wheels.{side}")).into_iter();
    let axles = [1, 2, 3, 4].into_iter().flat_map(|axle| {
        let own = format!("wheels.axle_{axle}");
        let sides = SIDES.map(|side| format!("{own}.{side}"));
        [own].into_iter().chain(sides)
    });
    let all: Vec<String> = ["wheels".to_owned()]
        .into_iter()
        .chain(sections)
        .chain(axles)
        .collect();
    for path in all.iter().flat_map(|own| KEYS.map(|key| format!("{own}.{key}"))) {
        if r.has(&path) {
            let problem = Problem::new(format!("`{path}` is given, but linear wheels are round"));
            let help = "leave it out, or write wheels.geometry = \"profiles\"";
            r.problem(&path, problem.label("not with linear wheels").help(help));
        }
    }
}

/// Returns the doubt about rows that are too far apart (s) for the peaks under wheels that are not round, at
/// the largest speed (m/s).
pub(crate) fn rows_too_far_apart(wheels: &ProfiledWheels, speed: f64, interval: f64) -> Option<String> {
    let passing = wheels.longest_step(speed);
    let enough = passing / ROWS;
    (interval > passing).then(|| {
        format!(
            "a wheel that is not round passes half of a flat or an eighth of a wave within {:.2} ms at \
             {speed:.1} m/s, and rows are {:.2} ms apart: peaks of wheel forces lie between rows; write \
             simulation.output_interval = \"{:.2} ms\" or less, and look at raw columns, since filters \
             take peaks off",
            1e3 * passing,
            1e3 * interval,
            1e3 * enough
        )
    })
}

/// Returns the doubt about the rows of a car's run.
pub(super) fn of_rows(parameters: &Parameters, interval: f64) -> Option<String> {
    let Wheels::OnRails(wheels) = &parameters.wheels else {
        return None;
    };
    rows_too_far_apart(wheels, parameters.drive.fastest(parameters.start.speed), interval)
}

/// Returns the assumptions about wheels that are not round: once where all wheelsets are alike.
pub(super) fn in_words(forms: &[[Option<WheelForm>; 2]; 4]) -> Vec<String> {
    let alike = of_wheelset(&forms[0], "each wheelset");
    if forms.iter().all(|own| of_wheelset(own, "each wheelset") == alike) {
        return alike;
    }
    let axles = (1..).zip(forms);
    axles
        .flat_map(|(axle, own)| of_wheelset(own, &format!("axle {axle}")))
        .collect()
}

/// Returns those about the wheels of a wheelset (`whose`).
pub(crate) fn of_wheelset(forms: &[Option<WheelForm>; 2], whose: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (side, form) in SIDES.into_iter().zip(forms) {
        let form = match form {
            None => continue,
            Some(WheelForm::Sliced(_)) => {
                "its profile changes around it by sections, straight between them, and it touches with the \
                 section that is down"
                    .to_owned()
            }
            Some(WheelForm::OutOfRound(own)) => {
                let flats = own.flats().iter().map(|flat| {
                    let worn = if flat.depth.is_some() { "worn" } else { "fresh" };
                    let (length, depth) = (1e3 * flat.length, 1e3 * flat.depth_in(own.radius()));
                    format!("a {worn} flat of {length:.1} mm, {depth:.3} mm deep")
                });
                let waves = own.harmonics().iter();
                let waves = waves.map(|wave| {
                    let amplitude = 1e3 * wave.amplitude;
                    format!("order {} with {amplitude:.3} mm", wave.order)
                });
                let all: Vec<String> = flats.chain(waves).collect();
                format!(
                    "{}; it touches with the curvature of the round wheel, so that peaks under fresh \
                     flats, whose ends are edges, are estimates",
                    all.join(", ")
                )
            }
        };
        words.push(format!("The {side} wheel of {whose} is not round: {form}."));
    }
    words
}

//! The parameters that the thesis leaves open, with their ranges; and the points at which the twelve runs are
//! made.
//!
//! Points of the space are those of the Sobol' sequence, by number: more points keep the earlier ones. Every
//! point is a list of values as `--set` takes them, so that each can be run alone. Runs are integrated as the
//! cases say: methods that damp the vibrations of contacts turn more verdicts
//! ([0058](../../../../docs/decisions/0058-verdicts-over-what-is-open.md)).

use quantity::Number;
use serde::Serialize;
use study::design::{Factor, Levels, Sobol, Value};

/// The seed of the shift of the Sobol' sequence.
const SEED: u64 = 1;
/// Of so many points of the space one is run again with each other friction.
const OTHER_FRICTION: u64 = 8;
/// The stiffnesses (lbf/in, a corner) that are run with all else as decided: six a decade.
const LADDER: [f64; 13] = [
    2.5e4, 3.7e4, 5.4e4, 7.9e4, 1.16e5, 1.7e5, 2.5e5, 3.7e5, 5.4e5, 7.9e5, 1.16e6, 1.7e6, 2.5e6,
];
/// The place of the stiffness in the list of parameters.
pub(super) const STIFFNESS: usize = 0;
/// Its key.
const STIFFNESS_KEY: &str = "contact.stiffness";

/// A parameter that the thesis leaves open.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenParameter {
    /// The description.
    pub name: &'static str,
    /// Its key and its values.
    pub factor: Factor,
    /// The names of its values, if they are no range.
    pub labels: &'static [&'static str],
    /// The settings that the cases take.
    pub decided: &'static str,
    /// The reason for the range.
    pub reason: &'static str,
}

/// The division of points into two sides by a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cut {
    /// Coordinates below this, and the others.
    Below(f64),
    /// This choice, and the others.
    Choice(usize),
}

impl OpenParameter {
    /// Returns the cuts that are tried: a range at its quarters, choices one against the others.
    pub(super) fn cuts(&self) -> Vec<Cut> {
        match &self.factor.levels {
            Levels::Range { .. } => [0.25, 0.5, 0.75].map(Cut::Below).to_vec(),
            Levels::Values(values) if values.len() == 2 => vec![Cut::Choice(0)],
            Levels::Values(values) => (0..values.len()).map(Cut::Choice).collect(),
        }
    }

    /// Returns whether a coordinate is on the first side of a cut.
    pub(super) fn is_first(&self, cut: Cut, coordinate: f64) -> bool {
        match cut {
            Cut::Below(limit) => coordinate < limit,
            Cut::Choice(choice) => self.choice(coordinate) == choice,
        }
    }

    fn choice(&self, coordinate: f64) -> usize {
        let count = self.labels.len();
        ((coordinate * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Returns the names of the sides of a cut.
    pub(super) fn sides(&self, cut: Cut) -> [String; 2] {
        match cut {
            Cut::Below(limit) => {
                let value = shown(&self.factor.at(limit));
                [format!("below {value}"), format!("above {value}")]
            }
            Cut::Choice(choice) => {
                let label = |choice: usize| self.labels.get(choice).copied().unwrap_or_default();
                match self.labels.len() {
                    2 => [label(choice).to_owned(), label(1 - choice).to_owned()],
                    _ => [label(choice).to_owned(), "otherwise".to_owned()],
                }
            }
        }
    }

    /// Returns its values in words.
    #[must_use]
    pub fn range(&self) -> String {
        match &self.factor.levels {
            Levels::Range { logarithmic, .. } => {
                let ends = [0.0, 1.0].map(|end| shown(&self.factor.at(end)));
                let scale = if *logarithmic { ", logarithmic" } else { "" };
                format!("{} to {}{scale}", ends[0], ends[1])
            }
            Levels::Values(_) => self.labels.join("; "),
        }
    }
}

/// Returns a value to two digits, with its unit.
fn shown(value: &Value) -> String {
    match value {
        Value::Number { value, unit } => {
            let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(*value);
            format!("{rounded:e} {unit}")
        }
        Value::Toml(text) => text.clone(),
    }
}

fn choices(
    name: &'static str,
    key: &str,
    values: &[&str],
    labels: &'static [&'static str],
    reason: &'static str,
) -> OpenParameter {
    let values = values.iter().map(|toml| Value::Toml((*toml).to_owned()));
    OpenParameter {
        name,
        factor: Factor::new(vec![key.to_owned()], Levels::Values(values.collect())),
        labels,
        decided: labels.first().copied().unwrap_or_default(),
        reason,
    }
}

/// A range by logarithms.
fn range(key: &str, [from, to]: [f64; 2], unit: &str) -> Factor {
    let unit = unit.to_owned();
    let levels = Levels::Range {
        from,
        to,
        unit,
        logarithmic: true,
        count: 1,
    };
    Factor::new(vec![key.to_owned()], levels)
}

/// Returns the parameters that the thesis leaves open.
#[must_use]
pub fn open_parameters() -> Vec<OpenParameter> {
    vec![
        OpenParameter {
            name: "contact stiffness",
            factor: range(STIFFNESS_KEY, [LADDER[0], LADDER[LADDER.len() - 1]], "lbf/in"),
            labels: &[],
            decided: "2.5e5 lbf/in",
            reason: "a corner; the thesis gives none. A tenth to ten times a quarter of the comparison \
                     program's accumulator",
        },
        choices(
            "contact damping",
            "contact.damping",
            &["\"0 lbf s/in\"", "\"1 lbf s/in\"", "\"10 lbf s/in\""],
            &["none", "1 lbf s/in", "10 lbf s/in"],
            "a corner; eq. 3-7 has none. 10 lbf s/in is 5 % of critical of the wedge on a face",
        ),
        choices(
            "coil's line of action",
            "control_coil.acts_at",
            &["\"center_of_gravity\"", "\"seat\""],
            &["through the center of gravity", "through the seat"],
            "eqs. 3-13 and 3-18 hold no moment of the coil, whose length is measured at B",
        ),
        choices(
            "start",
            "simulation.start",
            &["\"rest\"", "\"touching\"", "\"equilibrium\""],
            &[
                "nominal position",
                "just touching",
                "equilibrium without friction",
            ],
            "the thesis's \u{201c}static position\u{201d} fits neither model",
        ),
        choices(
            "inertia",
            "wedge.inertia",
            &[
                "[\"100 lb in^2\", \"100 lb in^2\", \"100 lb in^2\"]",
                "[\"564 lb in^2\", \"145 lb in^2\", \"500 lb in^2\"]",
                "[\"100 lbf in s^2\", \"100 lbf in s^2\", \"100 lbf in s^2\"]",
            ],
            &[
                "100 lb in\u{b2} each",
                "a uniform prism",
                "100 lbf in s\u{b2} each",
            ],
            "no unit is given for 100; a uniform prism has about 564, 145, 500 lb in\u{b2}",
        ),
        choices(
            "place of B",
            "wedge.center_of_gravity",
            &[
                "[\"-1.0734 in\", \"0 in\", \"2.0417 in\"]",
                "[\"0 in\", \"0 in\", \"2.0417 in\"]",
                "[\"-2.1468 in\", \"0 in\", \"2.0417 in\"]",
            ],
            &[
                "1.07 in towards the bolster",
                "below the center of gravity",
                "2.15 in towards the bolster",
            ],
            "on the wedge's bottom, from the center of gravity, which stays that of the prism; the thesis \
             does not say where the faces are from B",
        ),
        OpenParameter {
            name: "reference speed of friction",
            factor: range("friction.reference_speed", [1e-4, 1e-2], "in/s"),
            labels: &[],
            decided: "0.001 in/s",
            reason: "eq. 3-8 gives tanh and this speed, but not why: it is a number of the method",
        },
        choices(
            "toe's pivot",
            "side_frame.toe_pivot",
            &["\"0 in\"", "\"-8.44 in\"", "\"13.3 in\""],
            &[
                "the middle of the wedge's face",
                "8.44 in below, where the coil stands",
                "13.3 in above",
            ],
            "the thesis gives the angle of the column, not the point about which it turns. The coil's seat \
             is that of constant damping; so far above is a guess at the side frame's pedestals",
        ),
    ]
}

/// Another law or other directions of friction, apart from the space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct OtherFriction {
    /// The description.
    pub name: &'static str,
    /// The settings of it.
    pub set: &'static str,
}

/// Those that are run: another law, and one tangent a face or two.
pub const FRICTIONS: [OtherFriction; 2] = [
    OtherFriction {
        name: "bristles",
        set: "friction.law=\"bristle\"",
    },
    OtherFriction {
        name: "one tangent a face",
        set: "friction.directions=\"one\"",
    },
];

/// The place of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PointPlace {
    /// All as decided.
    Decided,
    /// A point of the space, by number.
    Space(u64),
    /// The same with another friction, by its place in [`FRICTIONS`].
    OtherFriction(usize, u64),
    /// Contact stiffness of this number, all else as decided.
    Stiffness(usize),
}

/// The space and the points in it.
#[derive(Clone, Debug)]
pub struct Space {
    /// The open parameters.
    pub parameters: Vec<OpenParameter>,
    sobol: Sobol,
}

impl Default for Space {
    fn default() -> Self {
        let parameters = open_parameters();
        let sobol = Sobol::new(parameters.len(), Some(SEED));
        Self { parameters, sobol }
    }
}

impl Space {
    /// Returns the points with so many in the space.
    #[must_use]
    pub fn places(&self, points: u64) -> Vec<PointPlace> {
        let others = 0..points.div_ceil(OTHER_FRICTION);
        let others = (0..FRICTIONS.len()).flat_map(|friction| {
            let points = others.clone();
            points.map(move |point| PointPlace::OtherFriction(friction, point))
        });
        [PointPlace::Decided]
            .into_iter()
            .chain((0..LADDER.len()).map(PointPlace::Stiffness))
            .chain((0..points).map(PointPlace::Space))
            .chain(others)
            .collect()
    }

    /// Coordinates of a point of the space, each from 0 to below 1.
    #[must_use]
    pub fn coordinates(&self, point: u64) -> Vec<f64> {
        (0..self.parameters.len())
            .map(|dimension| self.sobol.coordinate(point, dimension))
            .collect()
    }

    /// Returns the contact stiffness at a place, lbf/in a corner; `None` where all is as decided.
    #[must_use]
    pub fn stiffness(&self, place: PointPlace) -> Option<f64> {
        match place {
            PointPlace::Decided => None,
            PointPlace::Stiffness(number) => LADDER.get(number).copied(),
            PointPlace::Space(point) | PointPlace::OtherFriction(_, point) => {
                let coordinate = self.sobol.coordinate(point, STIFFNESS);
                self.parameters[STIFFNESS].factor.at(coordinate).in_unit("lbf/in")
            }
        }
    }

    /// Returns the settings there, as `--set` takes them.
    #[must_use]
    pub fn set(&self, place: PointPlace) -> Vec<String> {
        let of_point = |point: u64| {
            let coordinates = self.coordinates(point);
            let set = self
                .parameters
                .iter()
                .zip(coordinates)
                .flat_map(|(parameter, at)| {
                    let value = parameter.factor.at(at);
                    let paths = parameter.factor.paths.iter();
                    let set = paths.map(|path| format!("{path}={}", value.to_toml(path)));
                    set.collect::<Vec<_>>()
                });
            set.collect::<Vec<String>>()
        };
        match place {
            PointPlace::Decided => Vec::new(),
            PointPlace::Space(point) => of_point(point),
            PointPlace::OtherFriction(friction, point) => {
                let mut set = of_point(point);
                set.extend(FRICTIONS.get(friction).map(|friction| friction.set.to_owned()));
                set
            }
            PointPlace::Stiffness(number) => LADDER
                .get(number)
                .map(|stiffness| format!("{STIFFNESS_KEY}=\"{} lbf/in\"", Number(*stiffness)))
                .into_iter()
                .collect(),
        }
    }
}

impl PointPlace {
    /// Returns its name in files.
    #[must_use]
    pub fn key(self) -> String {
        match self {
            Self::Decided => "decided".to_owned(),
            Self::Space(point) => format!("space {point}"),
            Self::OtherFriction(friction, point) => format!("friction {friction} {point}"),
            Self::Stiffness(number) => format!("stiffness {number}"),
        }
    }

    /// Returns the place of this name.
    #[must_use]
    pub fn of_key(key: &str) -> Option<Self> {
        let words: Vec<&str> = key.split(' ').collect();
        match words.as_slice() {
            ["decided"] => Some(Self::Decided),
            ["space", point] => Some(Self::Space(point.parse().ok()?)),
            ["friction", friction, point] => {
                Some(Self::OtherFriction(friction.parse().ok()?, point.parse().ok()?))
            }
            ["stiffness", number] => Some(Self::Stiffness(number.parse().ok()?)),
            _ => None,
        }
    }
}

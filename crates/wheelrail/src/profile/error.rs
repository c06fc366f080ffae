//! Reasons why no profile was made: the mistake, its place, and the remedy.

use std::fmt;
use std::path::PathBuf;

use input::file::ReadError;
use quantity::length_hint;
use thiserror::Error;

const INCH: f64 = 0.0254;

/// The place of a mistake.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProfilePlace {
    /// The file as named, or the name of a profile that is no file.
    pub name: String,
    /// The line, from 1; none if the mistake concerns the whole.
    pub line: Option<usize>,
}

impl ProfilePlace {
    /// Returns the whole of a file or profile.
    #[must_use]
    pub fn whole(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            line: None,
        }
    }

    /// Returns a line (from 1) of a file.
    #[must_use]
    pub fn line(name: &str, line: usize) -> Self {
        Self {
            name: name.to_owned(),
            line: Some(line),
        }
    }
}

impl fmt::Display for ProfilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}, line {line}", self.name),
            None => write!(f, "{}", self.name),
        }
    }
}

/// Reasons why no profile was made. Each message names the place; [`ProfileError::remedy`] says what to do.
#[derive(Debug, Error)]
pub enum ProfileError {
    /// The file was not read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The name of the file does not say what is in it.
    #[error("{}: the type of this profile file is not known by its name", path.display())]
    UnknownFile {
        /// The file as named.
        path: PathBuf,
    },
    /// A list of sections where one section is expected.
    #[error("{}: this is a list of sections along a rail or around a wheel, where one section is \
             expected", path.display())]
    ListOfSlices {
        /// The file as named.
        path: PathBuf,
    },
    /// Neither a file nor a profile that is built in.
    #[error("there is neither a file nor a nominal {kind} `{name}`")]
    NoSuchProfile {
        /// The name.
        name: String,
        /// Wheel or rail.
        kind: &'static str,
        /// Names that are built in.
        names: &'static str,
    },
    /// A profile that has a name but no drawing here.
    #[error("the profile {name} is not built in: {why}")]
    NotBuiltIn {
        /// The name.
        name: &'static str,
        /// The reason.
        why: &'static str,
    },
    /// The name of a built-in profile with a number that is none.
    #[error("`{name}` names no profile")]
    Name {
        /// The name.
        name: String,
        /// The advice.
        remedy: String,
    },
    /// A line is not what it should be.
    #[error("{place}: {found}")]
    Line {
        /// The place.
        place: ProfilePlace,
        /// The mistake.
        found: String,
        /// The advice.
        remedy: String,
    },
    /// A rail where a wheel is expected, or a wheel where a rail is.
    #[error("{place}: this is the profile of a {found}; a {expected} is expected")]
    Kind {
        /// The place.
        place: ProfilePlace,
        /// The kind that the file names.
        found: &'static str,
        /// The requested thing.
        expected: &'static str,
    },
    /// A wheel by its shape where a rail is expected, or a rail where a wheel is.
    #[error("{place}: this looks like a {found}, where a {expected} is expected: {sign}")]
    Shape {
        /// The place.
        place: ProfilePlace,
        /// The kind that the shape tells.
        found: &'static str,
        /// The requested kind.
        expected: &'static str,
        /// The part of the shape that tells it.
        sign: String,
    },
    /// Too few points.
    #[error("{place}: {points} different points are too few for a profile")]
    TooFew {
        /// The place.
        place: ProfilePlace,
        /// Their number.
        points: usize,
    },
    /// The size shows that the unit is not the one stated.
    #[error(
        "{place}: the points span {:.3} mm across the track, where a {kind} spans {}",
        width * 1e3, expected
    )]
    Units {
        /// The place.
        place: ProfilePlace,
        /// Wheel or rail.
        kind: &'static str,
        /// Their width, m.
        width: f64,
        /// Widths that occur.
        expected: &'static str,
        /// The advice.
        remedy: String,
    },
    /// The curve meets itself.
    #[error(
        "{place}: the profile crosses itself near y = {:.3} mm, z = {:.3} mm (with {other})",
        at[0] * 1e3, at[1] * 1e3
    )]
    SelfCrossing {
        /// The start of one of the crossing pieces.
        place: ProfilePlace,
        /// The other one.
        other: ProfilePlace,
        /// The point of crossing, m.
        at: [f64; 2],
    },
    /// The profile lies on the wrong side of its datum.
    #[error("{place}: {found}")]
    Orientation {
        /// The place.
        place: ProfilePlace,
        /// The mistake.
        found: String,
        /// The advice.
        remedy: String,
    },
    /// The datum of a rail is not its top.
    #[error(
        "{rail}: its highest point is at z = {:.3} mm; the gauge is measured {:.3} mm below z = 0, the top \
         of rail of the file, which is {} its highest point",
        top * 1e3, depth * 1e3, from_top(depth + top)
    )]
    Datum {
        /// The rail.
        rail: String,
        /// Height of its highest point above its datum, m.
        top: f64,
        /// Depth below the datum at which gauge is measured, m.
        depth: f64,
    },
    /// The wheelset does not fit between the rails.
    #[error(
        "the flanges of wheel {wheel} are {:.1} mm apart over their active faces, but the gauge of rail \
         {rail} is {:.1} mm",
        span * 1e3, gauge * 1e3
    )]
    WiderThanGauge {
        /// The wheel.
        wheel: String,
        /// The rail.
        rail: String,
        /// Distance of the active faces of the flanges at the depth where gauge is measured, m.
        span: f64,
        /// The gauge, m.
        gauge: f64,
    },
    /// The wheels of a wheelset in the middle of the track do not stand on both rails.
    #[error(
        "the wheels do not reach both rails: at a gauge of {:.1} mm ({:.2} in) wheels that span {:.1} mm \
         ({:.2} in) over the outer edges of their rims do not stand on their treads",
        gauge * 1e3, gauge / INCH, span * 1e3, span / INCH
    )]
    ShortOfRails {
        /// The gauge, m.
        gauge: f64,
        /// Distance of the outer edges of the rims, m.
        span: f64,
        /// The largest gauge at which they stand on both treads, m; none if there is none.
        largest: Option<f64>,
    },
    /// There is no slice on both sides of a place.
    #[error(
        "{name}: the slices reach from {} to {} {}; there is none on both sides of {place}",
        range[0], range[1], if *of_wheel { "rad" } else { "m" }
    )]
    NoSlice {
        /// The list.
        name: String,
        /// The place, m or rad.
        place: f64,
        /// The first and the last slice, m or rad.
        range: [f64; 2],
        /// Whether places are angles.
        of_wheel: bool,
    },
    /// Tables of contacts are asked for on a rail whose section changes.
    #[error("tables of contacts are those of one section; the rail's section changes along the track")]
    Varying,
    /// Tables of contacts are asked for with a wheel whose profile changes around it.
    #[error("tables of contacts are those of one section; the wheel's profile changes around it")]
    Sliced,
    /// Lines and arcs do not join.
    #[error("{place}: element {element} (from 1) {found}")]
    Joint {
        /// The profile.
        place: ProfilePlace,
        /// The element, from 1.
        element: usize,
        /// The mistake.
        found: String,
        /// The advice.
        remedy: &'static str,
    },
    /// A length is outside its range.
    #[error("{what} is {value} m; it must be between {} and {} m", range[0], range[1])]
    Length {
        /// The length's name.
        what: &'static str,
        /// Its value, m.
        value: f64,
        /// The smallest and the largest, m.
        range: [f64; 2],
    },
    /// A number is not admissible.
    #[error("{what} is {value}; it must be {must}")]
    Number {
        /// The number's name.
        what: &'static str,
        /// Its value, SI.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
}

impl ProfileError {
    /// Returns the line of the file, from 1, if the mistake lies in one.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::Line { place, .. }
            | Self::Kind { place, .. }
            | Self::Shape { place, .. }
            | Self::TooFew { place, .. }
            | Self::Units { place, .. }
            | Self::SelfCrossing { place, .. }
            | Self::Orientation { place, .. }
            | Self::Joint { place, .. } => place.line,
            Self::Read(_)
            | Self::UnknownFile { .. }
            | Self::ListOfSlices { .. }
            | Self::NoSuchProfile { .. }
            | Self::NotBuiltIn { .. }
            | Self::Name { .. }
            | Self::Datum { .. }
            | Self::WiderThanGauge { .. }
            | Self::ShortOfRails { .. }
            | Self::NoSlice { .. }
            | Self::Varying
            | Self::Sliced
            | Self::Length { .. }
            | Self::Number { .. } => None,
        }
    }

    /// Returns the remedy.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            Self::Read(error) => error.help().unwrap_or_else(|| "name another file".into()),
            Self::UnknownFile { .. } => {
                "name it .csv (points with a header of units), .prw or .prr (Simpack, wheel or rail), .whl \
                 or .ban (MiniProf), .whe or .rai \
                 (VAMPIRE)"
                    .into()
            }
            Self::ListOfSlices { .. } => {
                "name one of the files that it lists; `wedgelab wheelrail` takes rails from .slcs (--at) and \
                 wheels from .slcw (--wheel-angle)"
                    .into()
            }
            Self::NoSuchProfile { names, .. } => format!("name a file of points, or {names}"),
            Self::NotBuiltIn { .. } => {
                "name a file of its points, as measured or from the drawing (.csv, .prw, .whl, .whe)".into()
            }
            Self::Name { remedy, .. } => remedy.clone(),
            Self::Line { remedy, .. } | Self::Units { remedy, .. } | Self::Orientation { remedy, .. } => {
                remedy.clone()
            }
            Self::Kind { .. } => "exchange the files of wheel and rail".into(),
            Self::Shape { expected, .. } => format!(
                "name a file of a {expected} here, or {}; if wheel and rail are exchanged, exchange them",
                match *expected {
                    "rail" => "136re",
                    _ => "aar_1b",
                }
            ),
            Self::Datum { top, depth, .. } => {
                let [lift, deeper, depth] = [-top, depth - top, *depth].map(|length| 1e3 * length);
                let shift = format!(
                    "if z = 0 is not the top of rail, add {lift:.3} mm to z of all points, in a file of \
                     Simpack by shift.z"
                );
                match deeper > 0.0 {
                    true => format!(
                        "{shift}; if it is, as that of a new rail beside a worn one, a gauge depth of \
                         {deeper:.3} mm lies {depth:.3} mm below the highest point"
                    ),
                    false => shift,
                }
            }
            Self::TooFew { .. } => {
                "give at least five points, closer together where the profile is curved".into()
            }
            Self::SelfCrossing { .. } => {
                "order the points along the profile, and take away points that were measured twice".into()
            }
            Self::WiderThanGauge { .. } => {
                "look at unit and datum of the wheel profile, at the distance of the wheels and at the gauge"
                    .into()
            }
            Self::ShortOfRails { largest, .. } => match largest {
                Some(largest) => format!(
                    "lower the gauge to {:.1} mm ({:.2} in) or less, or set the wheels further apart",
                    largest * 1e3,
                    largest / INCH
                ),
                None => "look at gauge, distance of the tape circles and the units of both profiles".into(),
            },
            Self::NoSlice { range, .. } => format!("name a place between {} and {}", range[0], range[1]),
            Self::Varying | Self::Sliced => "search the contacts: no tables (`wheels.tables = false`)".into(),
            Self::Joint { remedy, .. } => (*remedy).into(),
            Self::Length { what, value, range } => length_hint(*value, *range)
                .unwrap_or_else(|| format!("give a {what} between {} and {} m", range[0], range[1])),
            Self::Number { what, must, .. } => format!("give a {what} that is {must}"),
        }
    }
}

/// Returns a depth (m) below a point in words.
fn from_top(depth: f64) -> String {
    let side = if depth < 0.0 { "above" } else { "below" };
    format!("{:.3} mm {side}", 1e3 * depth.abs())
}

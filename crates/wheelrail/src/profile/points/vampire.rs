//! Points from the files of VAMPIRE: `.whe` wheels, `.rai` and `.ral` rails.
//!
//! Four lines come first: `WHEELPROFILE` or `RAILPROFILE`; a title; `TREADDATUM` or `GAUGEPOINT` with
//! `EUROPEAN`, `US1`, `US2` (rails: `US`) or `CUSTOM` and a length; `FLANGEBACK` or `GAUGE` with a length. A
//! row has y and z of the left and y and z of the right profile, y to the right from the middle of the track.
//! Lengths are mm; commas and spaces separate; after `!`, `"` and `%` comes a comment.
//!
//! | | EUROPEAN | US, US1 | US2 |
//! |---|---|---|---|
//! | tape circle from the back of the flange | 70 mm | 2 27/32 in | 3 1/16 in |
//! | gauge point below the highest point | 14 mm | 5/8 in | |
//!
//! `FLANGEBACK` is the distance of the backs of both flanges. z is positive up in rails; files with the other
//! sense exist, so that the shape decides. A rail's top of rail is its highest point, its y = 0 the middle of
//! its points.
//!
//! Source: the program CONTACT's reader of such files (its open source, 2008 to 2025). No file of VAMPIRE
//! itself was at hand.

use input::Separated;
use quantity::INCH;

use super::{Points, WheelDatum, line_error, number_of};
use crate::contact::Side;
use crate::profile::{ProfileError, ProfileKind, ProfileNotice, StatedLengths};

const MILLIMETER: f64 = 1e-3;
/// Sides that differ by more than this are two profiles, m: points are written with 0.001 mm.
const ALIKE: f64 = 5e-6;
const HEADER: &str = "VAMPIRE's files begin with WHEELPROFILE or RAILPROFILE, a title, TREADDATUM or \
                      GAUGEPOINT, and FLANGEBACK or GAUGE, in lines of their own";
const ROW: &str = "write y and z of the left and y and z of the right profile in a row, in mm";

impl Points {
    /// Reads VAMPIRE's format; `name` is what messages call it. Without a side the right one is taken.
    ///
    /// # Errors
    /// A line is wrong, or there are too many.
    pub fn from_vampire(name: &str, text: &str, side: Option<Side>) -> Result<Self, ProfileError> {
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line.trim()));
        let mut header = || {
            lines.next().ok_or_else(|| {
                let found = "the file ends within its header".to_owned();
                line_error(name, text.lines().count().max(1), found, HEADER)
            })
        };
        let (number, first) = header()?;
        let kind = match first.to_ascii_uppercase().as_str() {
            "WHEELPROFILE" => ProfileKind::Wheel,
            "RAILPROFILE" => ProfileKind::Rail,
            _ => {
                let found = "neither WHEELPROFILE nor RAILPROFILE stands here".to_owned();
                return Err(line_error(name, number, found, HEADER));
            }
        };
        header()?;
        let (datum, distance) = (header()?, header()?);
        let keys = match kind {
            ProfileKind::Wheel => ["TREADDATUM", "FLANGEBACK"],
            ProfileKind::Rail => ["GAUGEPOINT", "GAUGE"],
        };
        let depth = place_of(name, datum, keys[0], kind)?;
        let distance = MILLIMETER * length_after(name, distance, keys[1])?;
        let mut read = Self {
            kind: Some(kind),
            any_sense: true,
            top_is_datum: true,
            ..Self::new(name, &[])
        };
        match kind {
            ProfileKind::Wheel => {
                read.datum = Some(WheelDatum::FlangeBack);
                read.tape_from_back = Some(depth);
                read.stated = StatedLengths {
                    tape_distance: Some(distance + 2.0 * depth),
                    ..StatedLengths::default()
                };
            }
            ProfileKind::Rail => {
                read.stated = StatedLengths {
                    gauge_depth: Some(depth),
                    ..StatedLengths::default()
                };
            }
        }
        let mut table = Separated::of("");
        let mut differ: f64 = 0.0;
        for (number, line) in lines {
            let line = line.split(['!', '"', '%']).next().unwrap_or("");
            let mut cells = line
                .split(|sign: char| sign.is_whitespace() || sign == ',')
                .filter(|cell| !cell.is_empty())
                .peekable();
            if cells.peek().is_none() {
                continue;
            }
            let mut row = [0.0; 4];
            for value in &mut row {
                let Some(cell) = cells.next() else {
                    let found = "a row has less than four numbers".to_owned();
                    return Err(line_error(name, number, found, ROW));
                };
                *value = MILLIMETER * number_of(&mut table, name, number, cell)?;
            }
            let [left, right] = [[-row[0], row[1]], [row[2], row[3]]];
            for axis in 0..2 {
                differ = differ.max((left[axis] - right[axis]).abs());
            }
            let [y, z] = if side == Some(Side::Left) { left } else { right };
            let y = if kind == ProfileKind::Wheel {
                y - 0.5 * distance
            } else {
                y
            };
            read.push([y, z], number)?;
        }
        if kind == ProfileKind::Rail {
            let ends = read
                .points
                .iter()
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [y, _]| {
                    [low.min(*y), high.max(*y)]
                });
            let middle = 0.5 * (ends[0] + ends[1]);
            read.points.iter_mut().for_each(|point| point[0] -= middle);
        }
        if differ > ALIKE && side.is_none() {
            read.notices.push(ProfileNotice {
                text: format!(
                    "{name}: left and right profiles differ by up to {:.3} mm; the right one is used",
                    1e3 * differ
                ),
                advice: format!(
                    "name the file for each side (--left-{0}, --right-{0})",
                    kind.word()
                ),
            });
        }
        Ok(read)
    }
}

/// Returns the length (m) that a line states for the tape circle or the gauge point.
fn place_of(
    name: &str,
    (number, line): (usize, &str),
    key: &str,
    kind: ProfileKind,
) -> Result<f64, ProfileError> {
    let upper = line.to_ascii_uppercase();
    let value = upper.strip_prefix(key).map(str::trim);
    let known = match (kind, value) {
        (ProfileKind::Wheel, Some("EUROPEAN")) => Some(70e-3),
        (ProfileKind::Wheel, Some("US1")) => Some((2.0 + 27.0 / 32.0) * INCH),
        (ProfileKind::Wheel, Some("US2")) => Some((3.0 + 1.0 / 16.0) * INCH),
        (ProfileKind::Rail, Some("EUROPEAN")) => Some(14e-3),
        (ProfileKind::Rail, Some("US")) => Some(0.625 * INCH),
        _ => None,
    };
    if let Some(known) = known {
        return Ok(known);
    }
    match value.and_then(|value| value.strip_prefix("CUSTOM")) {
        Some(length) => Ok(MILLIMETER * number_of(&mut Separated::of(""), name, number, length.trim())?),
        None => Err(line_error(
            name,
            number,
            format!("this line must name the {key}"),
            HEADER,
        )),
    }
}

/// Returns the length (mm) behind a word.
fn length_after(name: &str, (number, line): (usize, &str), key: &str) -> Result<f64, ProfileError> {
    let upper = line.to_ascii_uppercase();
    match upper.strip_prefix(key) {
        Some(length) => number_of(&mut Separated::of(""), name, number, length.trim()),
        None => Err(line_error(
            name,
            number,
            format!("this line must name the {key}"),
            HEADER,
        )),
    }
}

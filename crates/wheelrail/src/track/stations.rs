//! Mileposts and other distances of a recording, in either direction, as distances along a track.
//!
//! Mileposts are signs: two of them are seldom 5280 ft apart. Where one side of a sign counts otherwise than
//! the other, a **station equation** says that two readings are one place. The distance along the track is
//! continuous there: the readings behind the equation are shifted by `back - ahead`. An equation applies
//! between the two rows whose distance it brings nearest to the usual one, so that readings that occur twice
//! (`back` beyond `ahead`) are told apart by the order of the rows.
//!
//! A recording may run toward **falling** readings. Its distances then count from its first row, and what is
//! left for someone who looks toward rising readings is right for the car.

use quantity::{Kind, Quantity, SixDigits};

/// One foot, m.
const FOOT: f64 = 0.3048;
/// One mile, m.
pub(super) const MILE: f64 = 5280.0 * FOOT;
/// Tolerance with which a row may lie beyond an equation, m: mileposts have three decimals or more.
const TOLERANCE: f64 = 0.001 * MILE;

/// Two readings that are one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationEquation {
    /// The reading on the side of lower ones, m.
    pub back: f64,
    /// The reading on the side of higher ones, m.
    pub ahead: f64,
}

/// The direction in which a track is run, of the readings along it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Running {
    /// Readings rise.
    #[default]
    Rising,
    /// Readings fall; left and right are those of someone who looks toward rising ones.
    Falling,
    /// Readings fall; left and right are those of the car.
    FallingOwnSides,
}

/// Returns the place (m) that a text says: `MP 100.25`, `MP 100 + 253 ft`, `100+0253` (feet), `km 12+345`
/// (meters), or a length such as `100.25 mi`. A number alone counts in `unit` (m), with feet behind a plus
/// where that is a mile.
#[must_use]
pub fn place_of(text: &str, unit: f64) -> Option<f64> {
    let text = text.trim();
    if let Ok(length) = Quantity::parse_as(text, Kind::Length) {
        return Some(length.to_si());
    }
    let lower = text.to_ascii_lowercase();
    let (rest, unit) = match (lower.strip_prefix("mp"), lower.strip_prefix("km")) {
        (Some(rest), _) => (rest, MILE),
        (_, Some(rest)) => (rest, 1000.0),
        _ => (lower.as_str(), unit),
    };
    let number = |text: &str| {
        text.trim()
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite())
    };
    match rest.split_once('+') {
        None => Some(unit * number(rest)?),
        Some((post, beyond)) => {
            let small = if unit == 1000.0 { 1.0 } else { FOOT };
            let beyond = match number(beyond) {
                Some(beyond) => beyond * small,
                None => Quantity::parse_as(beyond.trim(), Kind::Length).ok()?.to_si(),
            };
            Some(unit * number(post)? + beyond)
        }
    }
}

/// A place along a recording, in words.
#[derive(Clone, Copy, Debug)]
pub(super) enum PlaceKind {
    /// A distance.
    Distance,
    /// A milepost.
    Milepost,
}

impl PlaceKind {
    /// Returns a place (m) in words.
    pub(super) fn said(self, place: f64) -> String {
        match self {
            Self::Distance => format!("{} m", SixDigits(place)),
            Self::Milepost => {
                let post = (place / MILE).floor();
                format!("MP {post} + {:.1} ft", (place - post * MILE) / FOOT)
            }
        }
    }
}

/// Where the distances of a recording cannot be.
#[derive(Debug)]
pub(super) struct Step {
    /// The row, from 0, that lies at or before the row before it.
    pub row: usize,
    /// What is found there.
    pub found: String,
    /// What to do.
    pub remedy: String,
}

/// Returns the distances (m) along the track of readings (m) row by row, and whether the rows are to be
/// turned round, which they are where readings rise but the track is run toward falling ones.
pub(super) fn along(
    readings: &[f64],
    kind: PlaceKind,
    running: Running,
    equations: &[StationEquation],
) -> Result<(Vec<f64>, bool), Step> {
    let (Some(first), Some(last)) = (readings.first(), readings.last()) else {
        return Ok((Vec::new(), false));
    };
    let falls = last < first;
    if falls && running == Running::Rising {
        let row = (1..readings.len()).find(|&row| readings[row] <= readings[row - 1]);
        return Err(not_rising(readings, row.unwrap_or(1), kind, falls));
    }
    let mut rising: Vec<f64> = readings.to_vec();
    if falls {
        rising.reverse();
    }
    let count = rising.len();
    let continuous = without_jumps(&rising, equations);
    if let Some(row) = (1..count).find(|&row| continuous[row] <= continuous[row - 1]) {
        // The later one of both rows in the file.
        let row = if falls { count - row } else { row };
        return Err(not_rising(readings, row, kind, falls));
    }
    let mut distances = continuous;
    match (running, kind) {
        (Running::Rising, PlaceKind::Distance) => {}
        (Running::Rising, PlaceKind::Milepost) => {
            let start = distances[0];
            distances.iter_mut().for_each(|own| *own -= start);
        }
        (Running::Falling | Running::FallingOwnSides, _) => {
            let end = distances[count - 1];
            distances.iter_mut().for_each(|own| *own = end - *own);
            distances.reverse();
        }
    }
    Ok((distances, running != Running::Rising && !falls))
}

fn not_rising(readings: &[f64], row: usize, kind: PlaceKind, falls: bool) -> Step {
    let [before, own] = [readings[row - 1], readings[row]].map(|place| kind.said(place));
    let what = match kind {
        PlaceKind::Distance => "distance",
        PlaceKind::Milepost => "milepost",
    };
    let again = readings.windows(2).filter(|pair| pair[1] < pair[0]).count();
    let remedy = match (kind, falls) {
        (_, _) if readings[row] == readings[row - 1] => {
            "distances must differ from row to row: write mileposts with more decimals (six for rows 1 ft \
             apart), or with feet in a column milepost_offset"
                .to_owned()
        }
        (_, true) if 2 * again > readings.len() => {
            "distances must rise from row to row; write direction = \"falling\" if the car ran toward \
             falling ones: left and right are then exchanged, unless sides = \"running\""
                .to_owned()
        }
        (PlaceKind::Milepost, _) => {
            let [back, ahead] = if falls { [&own, &before] } else { [&before, &own] };
            format!(
                "distances must go on from row to row; where a mile is not 5280 ft long write \
                 [[station_equations]] with back = \"{back}\" and ahead = \"{ahead}\""
            )
        }
        (PlaceKind::Distance, _) => "distances must rise from row to row".to_owned(),
    };
    Step {
        row,
        found: format!("the {what} {own} follows {before}"),
        remedy,
    }
}

/// Returns rising readings (m) without the jumps of the equations.
fn without_jumps(rising: &[f64], equations: &[StationEquation]) -> Vec<f64> {
    if equations.is_empty() {
        return rising.to_vec();
    }
    let mut steps: Vec<f64> = rising.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let mut open: Vec<StationEquation> = equations.to_vec();
    let mut shift = 0.0;
    let mut continuous = Vec::with_capacity(rising.len());
    continuous.extend(rising.first());
    for pair in rising.windows(2) {
        let away = |step: f64| (step - usual).abs();
        let with = |own: &StationEquation| own.back - pair[0] + pair[1] - own.ahead;
        let applies = |own: &StationEquation| {
            pair[0] <= own.back + TOLERANCE
                && pair[1] >= own.ahead - TOLERANCE
                && with(own) > 0.0
                && away(with(own)) < away(pair[1] - pair[0])
        };
        if let Some(number) = open.iter().position(applies) {
            let own = open.remove(number);
            shift += own.back - own.ahead;
        }
        continuous.push(pair[1] + shift);
    }
    continuous
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_places_as_people_write_them() {
        for (text, feet) in [
            ("MP 100.25", Some(100.25 * 5280.0)),
            ("mp 100 + 253 ft", Some(528_253.0)),
            ("100+0253", Some(528_253.0)),
            ("100.25 mi", Some(100.25 * 5280.0)),
            ("km 12+345", Some(12_345.0 / FOOT)),
            ("MP 100 + 10 m", Some(528_000.0 + 10.0 / FOOT)),
            ("MP", None),
            ("100+", None),
            ("MP nan", None),
        ] {
            let found = place_of(text, MILE).map(|place| place / FOOT);
            match (found, feet) {
                (Some(found), Some(feet)) => assert!((found - feet).abs() < 1e-6, "{text}: {found}"),
                other => assert_eq!(other, (None, None), "{text}"),
            }
        }
    }
}

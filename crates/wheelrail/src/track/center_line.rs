//! The center line of a track: tangents, spirals and curves, with superelevation and grade.
//!
//! In a spiral curvature and superelevation change by one of the laws of [`super::spiral`]. Heading and
//! position are continuous by construction. The heading is a polynomial of the distance in each piece, with
//! a wave beside it in some spirals; the position is its integral, exact for tangents and curves and by
//! Gauss's rule with 8 points on pieces of at most 20 m of a spiral. Grades change linearly between given
//! places. Before its start and beyond its end the track goes on as it is there, without a change of
//! curvature.

use super::segments::{CurveElements, Segment, TrackError};
use super::spiral::{self, NoParabola, Part, Wave};

/// Longest piece of a spiral for one application of Gauss's rule, m.
const LONGEST_PIECE: f64 = 20.0;
/// Largest curvature of a table, 1/m.
const SHARPEST: f64 = 1.0;
/// Points of Gauss's rule on -1 .. 1 and their weights (half of them; the others are symmetric).
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_5],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_3],
];

/// A piece on which curvature and superelevation are polynomials of the distance from its start, and a wave.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    start: f64,
    /// Coefficients, from the constant on.
    curvature: [f64; 4],
    superelevation: [f64; 4],
    wave: Option<Wave>,
    heading: f64,
    place: [f64; 2],
}

/// A center line.
#[derive(Clone, Debug, PartialEq)]
pub struct CenterLine {
    pieces: Vec<Piece>,
    length: f64,
    rail_distance: f64,
    /// Distance (m), grade, and height (m) at given places.
    grades: Vec<[f64; 3]>,
}

/// The center line at a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Place, m.
    pub position: [f64; 3],
    /// Heading, rad.
    pub heading: f64,
    /// Curvature, 1/m, and its rate by the distance, 1/m².
    pub curvature: [f64; 2],
    /// Superelevation, m, and its rate by the distance.
    pub superelevation: [f64; 2],
    /// Rise by the distance.
    pub grade: f64,
    /// Its rate by the distance, 1/m.
    pub grade_rate: f64,
    /// Roll of the track's plane, rad: positive where the left rail is raised, about the forward axis.
    pub roll: f64,
}

/// Returns a cubic and its derivative.
fn value_and_rate([c0, c1, c2, c3]: &[f64; 4], t: f64) -> [f64; 2] {
    [
        c0 + t * (c1 + t * (c2 + t * c3)),
        c1 + t * (2.0 * c2 + 3.0 * t * c3),
    ]
}

impl Piece {
    /// Returns the same with another start: curvature and superelevation continue.
    fn from(&self, start: f64) -> Self {
        let t = start - self.start;
        let at = |cubic: [f64; 4]| {
            let [value, rate] = value_and_rate(&cubic, t);
            let [.., c2, c3] = cubic;
            [value, rate, c2 + 3.0 * c3 * t, c3]
        };
        Self {
            start,
            curvature: at(self.curvature),
            superelevation: at(self.superelevation),
            wave: self.wave.map(|wave| Wave {
                phase: wave.phase + wave.rate * t,
                ..wave
            }),
            ..*self
        }
    }

    /// Returns curvature (1/m) and superelevation (m) at a distance (m) from the start of the piece, with
    /// their rates.
    fn elements(&self, t: f64) -> [[f64; 2]; 2] {
        let mut found = [&self.curvature, &self.superelevation].map(|cubic| value_and_rate(cubic, t));
        if let Some(wave) = &self.wave {
            let (sine, cosine) = libm::sincos(wave.rate * t + wave.phase);
            for (own, amplitude) in found.iter_mut().zip([wave.curvature, wave.superelevation]) {
                own[0] += amplitude * cosine;
                own[1] -= amplitude * wave.rate * sine;
            }
        }
        found
    }

    /// Returns heading at a distance (m) from the start of the track.
    fn heading(&self, distance: f64) -> f64 {
        let t = distance - self.start;
        let [c0, c1, c2, c3] = self.curvature;
        let polynomial = self.heading + t * (c0 + t * (0.5 * c1 + t * (c2 / 3.0 + t * 0.25 * c3)));
        match &self.wave {
            None => polynomial,
            Some(wave) => {
                let change = libm::sin(wave.rate * t + wave.phase) - libm::sin(wave.phase);
                polynomial + wave.curvature / wave.rate * change
            }
        }
    }

    /// Returns the place in plan, m.
    fn place(&self, distance: f64) -> [f64; 2] {
        let t = distance - self.start;
        let [x, y] = self.place;
        if self.curvature[1..] == [0.0; 3] && self.wave.is_none() {
            // Chord and direction of an arc.
            let half = 0.5 * t * self.curvature[0];
            let chord = if half.abs() < 1e-4 {
                t * (1.0 - half * half / 6.0)
            } else {
                t * libm::sin(half) / half
            };
            let (sine, cosine) = libm::sincos(self.heading + half);
            return [x + chord * cosine, y + chord * sine];
        }
        let count = (t.abs() / LONGEST_PIECE).ceil().max(1.0);
        let half = 0.5 * t / count;
        let mut sum = [0.0; 2];
        for i in 0..count as usize {
            let middle = self.start + half * (2.0 * i as f64 + 1.0);
            for [abscissa, weight] in GAUSS {
                for side in [-abscissa, abscissa] {
                    let (sine, cosine) = libm::sincos(self.heading(middle + half * side));
                    sum[0] += weight * cosine;
                    sum[1] += weight * sine;
                }
            }
        }
        [x + half * sum[0], y + half * sum[1]]
    }
}

impl CenterLine {
    /// Returns the center line of these segments; the centers of the rails are `rail_distance` (m) apart
    /// (59.5 in in North America). `grades` holds places (m, rising) and the grade there; between them it is
    /// linear, beyond them constant.
    ///
    /// # Errors
    /// [`TrackError`]: with the segment and what to do.
    pub fn new(segments: &[Segment], rail_distance: f64, grades: &[[f64; 2]]) -> Result<Self, TrackError> {
        if segments.is_empty() {
            return Err(TrackError::Empty);
        }
        let own = |index: usize| match segments.get(index)? {
            Segment::Tangent(_) => Some(CurveElements::default()),
            Segment::Curve(_, elements) => Some(*elements),
            Segment::Spiral(..) => None,
        };
        let mut pieces = Vec::new();
        let (mut start, mut heading, mut place) = (0.0, 0.0, [0.0; 2]);
        let mut before = own(0);
        for (index, segment) in segments.iter().enumerate() {
            let number = index + 1;
            let (Segment::Tangent(length) | Segment::Spiral(length, _) | Segment::Curve(length, _)) =
                *segment;
            if !(length > 0.0 && length.is_finite()) {
                return Err(TrackError::Length {
                    segment: number,
                    length,
                });
            }
            let loose = |place| TrackError::LooseSpiral {
                segment: number,
                place,
            };
            let [from, to] = match own(index) {
                Some(elements) => [before.unwrap_or(elements), elements],
                None => {
                    let from = before.ok_or(loose("at the start"))?;
                    [
                        from,
                        own(index + 1).ok_or(loose("before the end or another spiral"))?,
                    ]
                }
            };
            let form = match segment {
                Segment::Spiral(_, form) => Some(*form),
                Segment::Tangent(_) | Segment::Curve(..) => None,
            };
            if form.is_none() && from != to {
                return Err(TrackError::Jump {
                    segment: number,
                    before: from,
                    after: to,
                });
            }
            let superelevation = to.superelevation;
            if superelevation.is_nan() || superelevation.abs() >= rail_distance {
                return Err(TrackError::Superelevation {
                    segment: number,
                    superelevation,
                    distance: rail_distance,
                });
            }
            let curvature = [from.curvature, to.curvature];
            let raised = [from.superelevation, superelevation];
            let parts = spiral::parts(form.unwrap_or_default(), length, curvature, raised);
            let parts = parts.map_err(|reason| TrackError::CubicParabola {
                segment: number,
                reason: match reason {
                    NoParabola::TwoCurves => "it needs a tangent on one side".to_owned(),
                    NoParabola::Longest(longest) => {
                        format!("it would turn back; to this curve it is at most {longest:.1} m long")
                    }
                },
            })?;
            let begin = start;
            for part in parts {
                start = append(
                    &mut pieces,
                    begin,
                    &part,
                    form.is_some(),
                    (&mut heading, &mut place),
                );
            }
            before = Some(to);
        }
        Ok(Self {
            pieces,
            length: start,
            rail_distance,
            grades: heights(grades)?,
        })
    }

    /// Returns the center line whose curvature (1/m, positive to the left) and superelevation (m, positive
    /// where the right rail is raised) are given at distances (m, from 0) and linear between them;
    /// `rail_distance` and `grades` as for [`CenterLine::new`].
    ///
    /// # Errors
    /// [`TrackError`]: distances do not begin at 0 and rise, or a superelevation is too large.
    pub fn of_table(
        distances: &[f64],
        curvature: &[f64],
        superelevation: &[f64],
        rail_distance: f64,
        grades: &[[f64; 2]],
    ) -> Result<Self, TrackError> {
        let rows = distances.len().min(curvature.len()).min(superelevation.len());
        if rows < 2 {
            return Err(TrackError::Empty);
        }
        let mut pieces: Vec<Piece> = Vec::with_capacity(rows - 1);
        let (mut heading, mut place) = (0.0, [0.0; 2]);
        for k in 0..rows {
            let (distance, own) = (distances[k], superelevation[k]);
            let rises = match k {
                0 => distance == 0.0,
                _ => distance > distances[k - 1],
            };
            if !(rises && curvature[k].abs() <= SHARPEST && own.is_finite()) {
                return Err(TrackError::Row { row: k + 1, distance });
            }
            if own.abs() >= rail_distance {
                return Err(TrackError::Superelevation {
                    segment: k + 1,
                    superelevation: own,
                    distance: rail_distance,
                });
            }
        }
        for k in 0..rows - 1 {
            let length = distances[k + 1] - distances[k];
            let linear = |values: &[f64]| [values[k], (values[k + 1] - values[k]) / length, 0.0, 0.0];
            let piece = Piece {
                start: distances[k],
                curvature: linear(curvature),
                superelevation: linear(superelevation),
                wave: None,
                heading,
                place,
            };
            (heading, place) = (piece.heading(distances[k + 1]), piece.place(distances[k + 1]));
            pieces.push(piece);
        }
        Ok(Self {
            pieces,
            length: distances[rows - 1],
            rail_distance,
            grades: heights(grades)?,
        })
    }

    /// Returns the length of the segments, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Returns the distance of the rails' centers, m.
    #[must_use]
    pub fn rail_distance(&self) -> f64 {
        self.rail_distance
    }

    /// Returns whether there is no superelevation anywhere.
    #[must_use]
    pub fn is_level_across(&self) -> bool {
        let level = |piece: &Piece| {
            let wave = piece.wave.map_or(0.0, |wave| wave.superelevation);
            piece.superelevation == [0.0; 4] && wave == 0.0
        };
        self.pieces.iter().all(level)
    }

    /// Returns the center line at a distance (m).
    #[must_use]
    pub fn at(&self, distance: f64) -> Station {
        let number = self
            .pieces
            .partition_point(|piece| piece.start <= distance)
            .max(1)
            - 1;
        let mut piece = self.pieces[number];
        if distance < 0.0 || distance > self.length {
            // As at the end, without a change.
            let end = distance.clamp(0.0, self.length);
            let [curvature, superelevation] = piece.elements(end - piece.start);
            piece = Piece {
                start: end,
                curvature: [curvature[0], 0.0, 0.0, 0.0],
                superelevation: [superelevation[0], 0.0, 0.0, 0.0],
                wave: None,
                heading: piece.heading(end),
                place: piece.place(end),
            };
        }
        let t = distance - piece.start;
        let [curvature, superelevation] = piece.elements(t);
        let [x, y] = piece.place(distance);
        let [grade, grade_rate, z] = self.grade_and_height(distance);
        Station {
            position: [x, y, z],
            heading: piece.heading(distance),
            curvature,
            superelevation,
            grade,
            grade_rate,
            roll: -libm::asin(superelevation[0] / self.rail_distance),
        }
    }

    /// Grade, its rate (1/m) and height (m).
    fn grade_and_height(&self, distance: f64) -> [f64; 3] {
        let number = self.grades.partition_point(|[place, ..]| *place <= distance);
        let before = number.checked_sub(1).and_then(|number| self.grades.get(number));
        match (before, self.grades.get(number)) {
            (Some([s0, g0, z0]), Some([s1, g1, _])) => {
                let t = distance - s0;
                let rate = (g1 - g0) / (s1 - s0);
                [g0 + t * rate, rate, z0 + t * (g0 + 0.5 * t * rate)]
            }
            (Some([s, g, z]), None) | (None, Some([s, g, z])) => [*g, 0.0, z + g * (distance - s)],
            (None, None) => [0.0; 3],
        }
    }

    /// Returns the distance (m) at which the center line's normal plane holds a point (x, y in m), by
    /// Newton's method from a distance nearby.
    #[must_use]
    pub fn project(&self, point: [f64; 2], nearby: f64) -> f64 {
        let mut distance = nearby;
        for _ in 0..30 {
            let station = self.at(distance);
            let (sine, cosine) = libm::sincos(station.heading);
            let offset = [point[0] - station.position[0], point[1] - station.position[1]];
            let along = offset[0] * cosine + offset[1] * sine;
            let across = offset[1] * cosine - offset[0] * sine;
            // The derivative of `along` by the distance; it vanishes at the center of the curve.
            let slope = (1.0 - station.curvature[0] * across).max(0.1);
            let step = along / slope;
            distance += step;
            if step.abs() < 1e-12 * (1.0 + distance.abs()) {
                break;
            }
        }
        distance
    }
}

/// Appends a part of a segment that begins at `begin` (m) and moves heading (rad) and place (m) on to its
/// end, which it returns (m). A spiral is kept in pieces for one application of Gauss's rule each, so that a
/// place anywhere in it costs the same.
fn append(
    pieces: &mut Vec<Piece>,
    begin: f64,
    part: &Part,
    spiral: bool,
    (heading, place): (&mut f64, &mut [f64; 2]),
) -> f64 {
    let [from, to] = part.reach;
    let length = to - from;
    let count = match spiral {
        true => (length / LONGEST_PIECE).ceil().max(1.0) as usize,
        false => 1,
    };
    let begin = begin + from;
    let whole = Piece {
        start: begin,
        curvature: part.curvature,
        superelevation: part.superelevation,
        wave: part.wave,
        heading: *heading,
        place: *place,
    };
    let mut end = begin;
    for number in 0..count {
        let own = whole.from(if number == 0 {
            begin
        } else {
            begin + length * number as f64 / count as f64
        });
        let own = Piece {
            heading: *heading,
            place: *place,
            ..own
        };
        end = begin + length * (number + 1) as f64 / count as f64;
        (*heading, *place) = (own.heading(end), own.place(end));
        pieces.push(own);
    }
    end
}

/// Returns places, grades and heights of a profile whose height is zero at distance zero or, if it begins
/// later, at its first place.
fn heights(grades: &[[f64; 2]]) -> Result<Vec<[f64; 3]>, TrackError> {
    let mut out: Vec<[f64; 3]> = Vec::new();
    for (index, &[place, grade]) in grades.iter().enumerate() {
        let height = match out.last() {
            None => 0.0,
            Some([before, ..]) if place <= *before => {
                return Err(TrackError::Grade {
                    number: index + 1,
                    place,
                });
            }
            Some([before, slope, height]) => height + 0.5 * (slope + grade) * (place - before),
        };
        if !place.is_finite() || !grade.is_finite() {
            return Err(TrackError::Grade {
                number: index + 1,
                place,
            });
        }
        out.push([place, grade, height]);
    }
    Ok(out)
}

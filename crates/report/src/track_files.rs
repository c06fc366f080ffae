//! The files of `wedgelab track show`: what a car will meet over the distance, and what inspectors measure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use wheelrail::track::{RailPlace, Track};

use crate::output_table::OutputTable;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "track.csv";
/// The figure.
pub const FIGURE: &str = "track.svg";
/// The same as a picture.
pub const PICTURE: &str = "track.png";
/// All of them.
pub const NAMES: [&str; 3] = [TABLE, FIGURE, PICTURE];

/// The chords of inspectors, ft.
pub const CHORDS: [f64; 3] = [31.0, 62.0, 124.0];

const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;
/// 100 ft, m: the chord of the degree of curve.
const DEGREE_CHORD: f64 = 30.48;

/// One of the four irregularities that are measured along chords.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeasuredTrack {
    /// Left (0) or right (1) rail.
    pub rail: usize,
    /// True for the alignment (lateral), false for the profile (vertical).
    pub lateral: bool,
}

impl MeasuredTrack {
    /// All four.
    pub const ALL: [Self; 4] = {
        const fn measured(rail: usize, lateral: bool) -> MeasuredTrack {
            MeasuredTrack { rail, lateral }
        }
        [
            measured(0, false),
            measured(1, false),
            measured(0, true),
            measured(1, true),
        ]
    };

    /// Returns its name in columns.
    #[must_use]
    pub fn name(self) -> String {
        let what = if self.lateral { "alignment" } else { "profile" };
        format!("{}_{what}", ["left", "right"][self.rail])
    }

    fn of(self, rails: &[RailPlace; 2]) -> f64 {
        let place = &rails[self.rail];
        if self.lateral {
            place.lateral[0]
        } else {
            place.vertical[0]
        }
    }
}

/// The largest mid-chord offset of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// The offset, m.
    pub offset: f64,
    /// The distance along the track, m.
    pub at: f64,
}

/// A track at a distance.
struct Row {
    /// The distance, m.
    distance: f64,
    rails: [RailPlace; 2],
    /// Mid-chord offsets, m, by [`MeasuredTrack::ALL`] and [`CHORDS`].
    offsets: [[f64; 3]; 4],
}

/// A track over the distance.
pub struct Survey<'t> {
    track: &'t Track,
    interval: f64,
    rows: Vec<Row>,
}

impl<'t> Survey<'t> {
    /// Returns a track, a row each `interval` (m) and at its end.
    #[must_use]
    pub fn new(track: &'t Track, interval: f64) -> Self {
        let length = track.center_line.length();
        let count = (length / interval).ceil() as usize;
        let row = |i: usize| {
            let distance = (i as f64 * interval).min(length);
            let rails = track.rails(distance);
            let ends =
                CHORDS.map(|chord| [-0.5, 0.5].map(|half| track.rails(distance + half * chord * FOOT)));
            let offsets = MeasuredTrack::ALL.map(|measured| {
                [0, 1, 2].map(|chord: usize| {
                    let [a, b] = &ends[chord];
                    measured.of(&rails) - 0.5 * (measured.of(a) + measured.of(b))
                })
            });
            Row {
                distance,
                rails,
                offsets,
            }
        };
        Self {
            track,
            interval,
            rows: (0..=count).map(row).collect(),
        }
    }

    /// Returns the distance between two rows, m.
    #[must_use]
    pub fn interval(&self) -> f64 {
        self.interval
    }

    /// Returns a rail's profile or alignment (m) at rows at equal distances: the last one, at the track's
    /// end, is left out.
    #[must_use]
    pub fn values(&self, measured: MeasuredTrack) -> Vec<f64> {
        let rows = self.rows.iter().take(self.rows.len().saturating_sub(1));
        rows.map(|row| measured.of(&row.rails)).collect()
    }

    /// Returns the largest mid-chord offsets, by what is measured and by chord.
    #[must_use]
    pub fn largest(&self) -> Vec<(MeasuredTrack, [Largest; 3])> {
        let of = |number: usize| {
            [0, 1, 2].map(|chord: usize| {
                let start = Largest { offset: 0.0, at: 0.0 };
                self.rows.iter().fold(start, |most, row| {
                    let (offset, at) = (row.offsets[number][chord], row.distance);
                    if offset.abs() > most.offset.abs() {
                        Largest { offset, at }
                    } else {
                        most
                    }
                })
            })
        };
        MeasuredTrack::ALL
            .into_iter()
            .enumerate()
            .map(|(number, measured)| (measured, of(number)))
            .collect()
    }

    /// Returns the curvature (1/m) whose size is largest; positive to the left.
    #[must_use]
    pub fn sharpest(&self) -> f64 {
        let curvatures = self
            .rows
            .iter()
            .map(|row| self.track.center_line.at(row.distance).curvature[0]);
        curvatures.fold(
            0.0,
            |most: f64, own| if own.abs() > most.abs() { own } else { most },
        )
    }

    /// Writes the rows.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let rows = self.rows.iter();
        let rows = rows.map(|row| (self.track.center_line.at(row.distance), row));
        let mut table = OutputTable::new(rows, Units::Us);
        table.rounded("distance_ft", Kind::Count, |(_, row)| row.distance / FOOT);
        for (axis, name) in ["x_ft", "y_ft", "z_ft"].into_iter().enumerate() {
            table.rounded(name, Kind::Count, move |(own, _)| own.position[axis] / FOOT);
        }
        table.number("heading", Kind::Angle, |(own, _)| own.heading);
        table.rounded("curvature_per_ft", Kind::Count, |(own, _)| {
            own.curvature[0] * FOOT
        });
        table.rounded("degree_of_curve", Kind::Count, |(own, _)| {
            degree(own.curvature[0])
        });
        table.rounded("superelevation_in", Kind::Count, |(own, _)| {
            own.superelevation[0] / INCH
        });
        table.number("grade", Kind::Count, |(own, _)| own.grade);
        for measured in MeasuredTrack::ALL {
            let name = format!("{}_in", measured.name());
            table.rounded(&name, Kind::Count, move |(_, row)| measured.of(&row.rails) / INCH);
        }
        table.rounded("cross_level_in", Kind::Count, |(own, row)| {
            let [left, right] = &row.rails;
            (own.superelevation[0] + right.vertical[0] - left.vertical[0]) / INCH
        });
        table.rounded("gauge_deviation_in", Kind::Count, |(_, row)| {
            (row.rails[0].lateral[0] - row.rails[1].lateral[0]) / INCH
        });
        for (number, measured) in MeasuredTrack::ALL.into_iter().enumerate() {
            for (place, chord) in CHORDS.into_iter().enumerate() {
                let name = format!("{}_offset_{chord}_ft_in", measured.name());
                table.rounded(&name, Kind::Count, move |(_, row)| {
                    row.offsets[number][place] / INCH
                });
            }
        }
        table.write_csv(out)
    }

    /// Returns the figure.
    #[must_use]
    pub fn figure(&self, name: &str) -> Figure {
        let over = |value: &dyn Fn(&Row) -> f64| -> Vec<(f64, f64)> {
            self.rows
                .iter()
                .map(|row| (row.distance / FOOT, value(row)))
                .collect()
        };
        let curve = |label: &str, colour, line, points| PlotCurve::new(label, (colour, line), points);
        let (blue, red) = (Colour::Blue, Colour::Vermillion);
        let panel = |title: &str, y_label: &str, curves| Panel::new(title, "distance (ft)", y_label, curves);
        let pair = |value: &dyn Fn(&Row, usize) -> f64| {
            let sides = [("left", blue, Line::Solid), ("right", red, Line::Dashed)]
                .into_iter()
                .enumerate();
            sides
                .map(|(rail, (label, colour, line))| {
                    curve(label, colour, line, over(&|row| value(row, rail) / INCH))
                })
                .collect()
        };
        let line = &self.track.center_line;
        let curvature = over(&|row| degree(line.at(row.distance).curvature[0]));
        let superelevation = over(&|row| line.at(row.distance).superelevation[0] / INCH);
        Figure {
            columns: 2,
            ..Figure::new(
                format!("Track {name}"),
                "Curvature is positive to the left, superelevation where the right rail is raised, \
                      lateral irregularities to the left, vertical ones up. Offsets are mid-chord offsets \
                      of a chord of 62 ft.",
                [
                    panel(
                        "(a) curvature",
                        "degree of curve",
                        vec![curve("", blue, Line::Solid, curvature)],
                    ),
                    panel(
                        "(b) superelevation",
                        "right above left (in)",
                        vec![curve("", blue, Line::Solid, superelevation)],
                    ),
                    panel(
                        "(c) profile",
                        "vertical irregularity (in)",
                        pair(&|row, rail| row.rails[rail].vertical[0]),
                    ),
                    panel(
                        "(d) alignment",
                        "lateral irregularity (in)",
                        pair(&|row, rail| row.rails[rail].lateral[0]),
                    ),
                    panel(
                        "(e) 62 ft offsets of profile",
                        "mid-chord offset (in)",
                        pair(&|row, rail| row.offsets[rail][1]),
                    ),
                    panel(
                        "(f) 62 ft offsets of alignment",
                        "mid-chord offset (in)",
                        pair(&|row, rail| row.offsets[2 + rail][1]),
                    ),
                ],
            )
        }
    }
}

/// Returns the degree of curve (degrees, left positive) of a curvature (1/m).
#[must_use]
pub fn degree(curvature: f64) -> f64 {
    (2.0 * libm::asin((0.5 * curvature * DEGREE_CHORD).clamp(-1.0, 1.0))).to_degrees()
}

//! The figures of the thesis's stand-alone runs: for each damping, without and with yaw, the three toe cases.

use drawing::thin::window;
use drawing::{Colour, Figure, Line, Mark, Panel, PlotCurve};
use quantity::{Kind, System as Units};
use report::figures::{CaseOutcome, Exhibit, axis, capital, curve, digits, points, toe_style, yaw};
use study::metrics::Cycle;
use wedge::parameters::Damping;

/// The quantity that a series of figures shows.
struct Quantity {
    column: &'static str,
    name: &'static str,
    kind: Kind,
    /// The description for the caption.
    about: &'static str,
    /// The thesis's figures: variable damping without and with yaw, constant damping without and with yaw.
    thesis: [&'static str; 4],
    /// Its loop over the displacement, likewise; `None`: no loop is drawn.
    loops: Option<[&'static str; 4]>,
    /// True if it is drawn with constant damping too.
    constant: bool,
    /// True if the figure shows windows besides the whole run.
    windows: bool,
}

const QUANTITIES: [Quantity; 7] = [
    Quantity {
        column: "vertical_wedge_force",
        name: "vertical wedge force",
        kind: Kind::Force,
        about: "the friction of the column as it acts on the side frame, positive up",
        thesis: ["", "", "figure 6-3", "figure 6-12"],
        loops: Some(["", "", "figure 6-4", "figure 6-13"]),
        constant: true,
        windows: true,
    },
    Quantity {
        column: "vertical_force_on_side_frame",
        name: "vertical force on the side frame",
        kind: Kind::Force,
        about: "the column's friction on the side frame less the force of the coil that stands on it (eq. \
                5-3), positive up: the thesis's scripts draw this as the vertical wedge force of variable \
                damping",
        thesis: ["figure 5-3", "figure 5-11", "", ""],
        loops: Some(["figure 5-4", "figure 5-12", "", ""]),
        constant: false,
        windows: true,
    },
    Quantity {
        column: "longitudinal_wedge_force",
        name: "longitudinal wedge force",
        kind: Kind::Force,
        about: "the column's normal forces along the track (eq. 5-2)",
        thesis: ["figure 5-6", "figure 5-14", "figure 6-6", "figure 6-15"],
        loops: None,
        constant: true,
        windows: true,
    },
    Quantity {
        column: "side_frame_friction_power",
        name: "rate of energy dissipation at the side frame",
        kind: Kind::Power,
        about: "the power of the column's friction (eq. 5-4): negative where energy is lost",
        thesis: ["figure 5-8", "figure 5-16", "figure 6-8", "figure 6-17"],
        loops: None,
        constant: true,
        windows: true,
    },
    Quantity {
        column: "bolster_friction_power",
        name: "rate of energy dissipation at the bolster",
        kind: Kind::Power,
        about: "the power of the slope's friction (eq. 5-5, which the thesis does not draw): negative where \
                energy is lost",
        thesis: ["", "", "", ""],
        loops: None,
        constant: true,
        windows: true,
    },
    Quantity {
        column: "side_frame_pitch_moment",
        name: "pitch moment",
        kind: Kind::Moment,
        about: "the moment of the column's forces on the wedge about its centre of gravity",
        thesis: ["", "figure 5-17", "figure 6-9", "figure 6-18"],
        loops: None,
        constant: true,
        windows: false,
    },
    Quantity {
        column: "side_frame_yaw_moment",
        name: "yaw moment",
        kind: Kind::Moment,
        about: "the moment of the column's forces on the wedge about its centre of gravity",
        thesis: ["", "figure 5-18", "", "figure 6-19"],
        loops: None,
        constant: true,
        windows: false,
    },
];

/// Time windows of a group of runs, s.
pub(super) struct Windows {
    /// The start of the thesis's curves of the whole run.
    start: f64,
    /// The start of those of the moments.
    moments_start: f64,
    pub(super) zooms: &'static [(f64, f64)],
    /// The thesis's piece of the loop.
    pub(super) of_loop: (f64, f64),
    /// The times of the phases (1) to (4) in that piece, and in the first zoom.
    phases: [f64; 4],
}

/// In the order of [`Quantity::thesis`]. The bolster's lowest place is at 2.356 and 5.498 s, its highest at
/// 3.927 and 7.069 s.
const WINDOWS: [Windows; 4] = [
    Windows {
        start: 0.0,
        moments_start: 0.0,
        zooms: &[(4.0, 7.0)],
        of_loop: (0.0, 4.0),
        phases: [2.75, 3.75, 2.0, 2.35],
    },
    Windows {
        start: 0.1,
        moments_start: 0.1,
        zooms: &[(4.0, 7.0)],
        of_loop: (3.0, 7.0),
        phases: [5.89, 6.75, 5.14, 5.49],
    },
    Windows {
        start: 0.5,
        moments_start: 0.0,
        zooms: &[(4.0, 7.0), (3.5, 7.5)],
        of_loop: (3.5, 7.5),
        phases: [5.51, 6.27, 7.08, 4.71],
    },
    Windows {
        start: 0.4,
        moments_start: 0.1,
        zooms: &[(4.0, 7.0), (3.5, 7.5)],
        of_loop: (3.5, 7.5),
        phases: [5.51, 6.27, 7.08, 4.71],
    },
];

/// The phases in words.
const PHASES: [&str; 2] = [
    "(1) wedge and bolster move up, (2) the bolster has lifted off, (3) the wedge slips down the column, \
     (4) it sticks at the lowest place before the motion turns",
    "(1) the bolster begins to rise and the wedge sticks, (2) it slips up, (3) the bolster begins to sink \
     and the wedge sticks, (4) it slips down",
];

/// Returns the windows of a group of runs: variable damping without and with yaw, constant damping without
/// and with yaw.
pub(super) fn windows(number: usize) -> &'static Windows {
    &WINDOWS[number]
}

/// Returns the remark about the beginning of the curves that is not drawn.
pub(super) fn cut_text(curves: &[PlotCurve], start: f64, kind: Kind, units: Units) -> String {
    let before = curves.iter().flat_map(|curve| {
        let points = curve.points.iter();
        points.filter(move |point| point.0 < start).map(|point| point.1)
    });
    let (low, high) = before.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    if low > high {
        return String::new();
    }
    format!(
        " The first {start} s are cut, as in the thesis: there the wedge is released from its start, and \
         the values lie between {} and {} {}.",
        digits(low),
        digits(high),
        kind.label(units)
    )
}

/// Runs of one damping, without or with yaw.
struct Group<'o> {
    /// Its place in the tables above.
    number: usize,
    damping: Damping,
    yaw: f64,
    runs: Vec<&'o CaseOutcome>,
    units: Units,
}

/// The figures of the runs of one damping, without or with yaw.
#[derive(Clone, Debug, PartialEq)]
pub struct Chapter {
    /// Their damping.
    pub damping: Damping,
    /// True if the bolster is yawed.
    pub yawed: bool,
    /// Their figures, in the order of the thesis.
    pub exhibits: Vec<Exhibit>,
}

/// Returns all figures that these runs allow. Figure 6-14, which needs runs without and with yaw, stands at
/// the end of constant damping with yaw.
#[must_use]
pub fn chapters(outcomes: &[CaseOutcome]) -> Vec<Chapter> {
    let mut chapters: Vec<Chapter> = groups(outcomes).iter().map(Group::chapter).collect();
    let last = chapters
        .iter_mut()
        .rfind(|chapter| chapter.damping == Damping::Constant && chapter.yawed);
    if let Some(chapter) = last {
        chapter.exhibits.extend(with_and_without_yaw(outcomes));
    }
    chapters
}
fn groups(outcomes: &[CaseOutcome]) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for outcome in outcomes {
        let (damping, yaw) = (outcome.0.parameters.damping, yaw(&outcome.0));
        match groups
            .iter_mut()
            .find(|group| group.damping == damping && group.yaw == yaw)
        {
            Some(group) => group.runs.push(outcome),
            None => groups.push(Group {
                number: 2 * usize::from(damping == Damping::Constant) + usize::from(yaw != 0.0),
                damping,
                yaw,
                runs: vec![outcome],
                units: outcome.1.summary.units,
            }),
        }
    }
    groups
}

impl Group<'_> {
    fn chapter(&self) -> Chapter {
        let mut exhibits = Vec::new();
        for quantity in &QUANTITIES {
            if self.damping == Damping::Constant && !quantity.constant {
                continue;
            }
            exhibits.push(self.over_time(quantity));
            exhibits.extend(self.over_displacement(quantity));
        }
        Chapter {
            damping: self.damping,
            yawed: self.yaw != 0.0,
            exhibits,
        }
    }

    fn name(&self, what: &str) -> String {
        let yaw = if self.yaw == 0.0 { "" } else { "_yawed" };
        format!("{}{yaw}_{what}", self.damping.name())
    }

    fn title(&self, what: &str) -> String {
        let yaw = if self.yaw == 0.0 {
            "bolster not yawed".to_owned()
        } else {
            format!("bolster yawed by {} rad", self.yaw)
        };
        format!("{} damping, {yaw}: {what}", capital(self.damping.name()))
    }

    fn curves(&self, x: &str, y: &str) -> Vec<PlotCurve> {
        self.runs
            .iter()
            .map(|(case, result)| {
                let (label, colour, line) = toe_style(case.parameters.toe);
                curve(result, x, y, (&label, colour, line))
            })
            .collect()
    }

    fn end(&self) -> f64 {
        let ends = self
            .runs
            .iter()
            .filter_map(|(_, result)| result.column("time")?.last());
        ends.fold(0.0, |latest: f64, end| latest.max(*end))
    }

    fn over_time(&self, quantity: &Quantity) -> Exhibit {
        let windows = &WINDOWS[self.number];
        let curves = self.curves("time", quantity.column);
        let start = if quantity.windows {
            windows.start
        } else {
            windows.moments_start
        };
        let end = self.end();
        let zooms: Vec<(f64, f64)> = if quantity.windows {
            windows
                .zooms
                .iter()
                .copied()
                .filter(|zoom| zoom.1 <= end)
                .collect()
        } else {
            Vec::new()
        };
        let mut panels = vec![Panel {
            title: if zooms.is_empty() {
                String::new()
            } else {
                "(a) the whole run".to_owned()
            },
            x_label: "time (s)".to_owned(),
            y_label: axis(quantity.name, quantity.kind, self.units),
            x_window: (start < end).then_some((start, end)),
            curves: curves.clone(),
            span: zooms.len().max(1),
            ..Panel::default()
        }];
        for (zoom, letter) in zooms.iter().zip('b'..) {
            let marks = if quantity.loops.is_some() && letter == 'b' {
                self.marks(&curves, |time| time, *zoom)
            } else {
                Vec::new()
            };
            panels.push(Panel {
                title: format!("({letter}) {} to {} s", zoom.0, zoom.1),
                x_window: Some(*zoom),
                curves: curves.clone(),
                marks,
                span: 1,
                ..panels[0].clone()
            });
        }
        let mut caption = format!(
            "{} over time, for each toe angle: {}.",
            capital(quantity.name),
            quantity.about
        );
        if !zooms.is_empty() {
            caption += &format!(
                " (a) From {start} s to the end; {}.",
                zooms
                    .iter()
                    .zip('b'..)
                    .map(|(zoom, letter)| format!("({letter}) from {} to {} s", zoom.0, zoom.1))
                    .collect::<Vec<_>>()
                    .join("; ")
            );
        }
        if quantity.loops.is_some() && !zooms.is_empty() {
            caption += &format!(" {}.", PHASES[self.number / 2]);
        }
        caption += &cut_text(&curves, start, quantity.kind, self.units);
        Exhibit {
            name: self.name(quantity.column),
            thesis: quantity.thesis[self.number].to_owned(),
            figure: Figure {
                title: self.title(quantity.name),
                caption,
                columns: if zooms.is_empty() { 1 } else { 2 },
                panels,
                ..Figure::default()
            },
        }
    }

    /// Returns the numbers of the phases at the curve of toe out, or at the first one.
    fn marks(
        &self,
        curves: &[PlotCurve],
        shift: impl Fn(f64) -> f64,
        (left, right): (f64, f64),
    ) -> Vec<Mark> {
        let chosen = self.runs.iter().position(|(case, _)| case.parameters.toe > 0.0);
        let Some(curve) = curves.get(chosen.unwrap_or(0)) else {
            return Vec::new();
        };
        let period = self.runs.iter().find_map(|(case, _)| Cycle::of(&case.parameters));
        let period = period.map_or(f64::INFINITY, |cycle| cycle.period());
        let mut marks = Vec::new();
        for (number, phase) in WINDOWS[self.number].phases.into_iter().enumerate() {
            let time = [phase, phase + period, phase - period]
                .into_iter()
                .map(&shift)
                .find(|time| (left..=right).contains(time));
            let point = time.and_then(|time| curve.points.iter().find(|point| point.0 >= time));
            if let Some(point) = point {
                marks.push(Mark {
                    at: *point,
                    text: format!("({})", number + 1),
                });
            }
        }
        marks
    }

    /// Returns the loop over the wedge's displacement, as in the thesis, and over the bolster's.
    fn over_displacement(&self, quantity: &Quantity) -> Option<Exhibit> {
        let thesis = quantity.loops?[self.number];
        let windows = &WINDOWS[self.number];
        let piece = windows.of_loop;
        let mut panels = Vec::new();
        for (column, title, x_label) in [
            (
                "wedge_z",
                "(a) over the wedge's displacement",
                "wedge vertical displacement",
            ),
            (
                "bolster_vertical",
                "(b) over the bolster's displacement",
                "bolster vertical displacement",
            ),
        ] {
            let mut curves = self.curves(column, quantity.column);
            let mut marks = Vec::new();
            for (number, (curve, (_, result))) in curves.iter_mut().zip(&self.runs).enumerate() {
                let times = result.column("time").unwrap_or_default();
                let timed: Vec<(f64, (f64, f64))> = times
                    .iter()
                    .copied()
                    .zip(curve.points.iter().copied())
                    .filter(|(time, _)| (piece.0..=piece.1).contains(time))
                    .collect();
                let chosen = self.runs.iter().position(|(case, _)| case.parameters.toe > 0.0);
                if number == chosen.unwrap_or(0) {
                    for (phase, time) in windows.phases.into_iter().enumerate() {
                        if let Some((_, at)) = timed.iter().find(|(own, _)| *own >= time) {
                            marks.push(Mark {
                                at: *at,
                                text: format!("({})", phase + 1),
                            });
                        }
                    }
                }
                curve.points = timed.into_iter().map(|(_, point)| point).collect();
            }
            panels.push(Panel {
                title: title.to_owned(),
                x_label: axis(x_label, Kind::Length, self.units),
                y_label: axis(quantity.name, quantity.kind, self.units),
                curves,
                marks,
                ..Panel::default()
            });
        }
        let caption = format!(
            "Hysteresis: {} from {} to {} s over (a) the vertical displacement of the wedge from its \
             nominal place, as the thesis draws it, and (b) that of the bolster. It is {}. {}.",
            quantity.name,
            piece.0,
            piece.1,
            quantity.about,
            PHASES[self.number / 2]
        );
        let what = format!("{}, hysteresis", quantity.name);
        Some(Exhibit {
            name: self.name(&format!("{}_loop", quantity.column)),
            thesis: thesis.to_owned(),
            figure: Figure {
                title: self.title(&what),
                caption,
                panels,
                common_axes: false,
                flow: None,
                ..Figure::default()
            },
        })
    }
}

/// Figure 6-14: the longitudinal force of constant damping, toe out, without and with yaw.
fn with_and_without_yaw(outcomes: &[CaseOutcome]) -> Option<Exhibit> {
    let runs: Vec<&CaseOutcome> = outcomes
        .iter()
        .filter(|(case, _)| case.parameters.damping == Damping::Constant && case.parameters.toe > 0.0)
        .collect();
    let plain = runs.iter().find(|(case, _)| yaw(case) == 0.0)?;
    let yawed = runs.iter().find(|(case, _)| yaw(case) != 0.0)?;
    let (x, y, start) = ("time", "longitudinal_wedge_force", 0.5);
    let units = plain.1.summary.units;
    let with = format!("yawed by {} rad", yaw(&yawed.0));
    let curves = vec![
        curve(&plain.1, x, y, ("not yawed", Colour::Blue, Line::Solid)),
        curve(&yawed.1, x, y, (&with, Colour::Vermillion, Line::DashDot)),
    ];
    let end = points(&plain.1, x, y).last()?.0;
    let peak = curves.iter().map(|curve| {
        let before = curve.points.iter().filter(|point| point.0 < start);
        before.map(|point| point.1).fold(0.0, f64::max)
    });
    let peak = peak.fold(0.0, f64::max);
    let shown = window(&curves[0].points, (start, end)).len();
    (shown > 1).then(|| Exhibit {
        name: "constant_longitudinal_wedge_force_with_and_without_yaw".to_owned(),
        thesis: "figure 6-14".to_owned(),
        figure: Figure {
            title: "Constant damping, toe out: longitudinal wedge force without and with yaw".to_owned(),
            caption: format!(
                "Longitudinal wedge force (eq. 5-2) over time, constant damping, toe out, without and with \
                 yaw of the bolster. The first {start} s are cut, as in the thesis: there it reaches {} {}.",
                digits(peak),
                Kind::Force.label(units)
            ),
            panels: vec![Panel {
                x_label: "time (s)".to_owned(),
                y_label: axis("longitudinal wedge force", Kind::Force, units),
                curves,
                x_window: Some((start, end)),
                ..Panel::default()
            }],
            ..Figure::default()
        },
    })
}

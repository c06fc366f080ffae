//! The figures that compare the stand-alone wedge with the comparison program's types 6.8 and 6.9 (thesis,
//! chapters 5 and 6, appendix D): toe out, each damping, without and with yaw.
//!
//! The types are our reading of them in a half-truck made from the printed files; no output of that program
//! is known. Their columns are those of the leading left wedge, drawn under the names of the stand-alone
//! wedge's columns that stand for the same ([`crate::agreement::truck_column`]).

use drawing::{Colour, Figure, Line, Panel, PlotCurve};
use mechanics::quasi_static::SlidingDirection;
use quantity::{Kind, System as Units};
use report::csv::converted;
use report::figures::{CaseOutcome, Exhibit, axis, capital, curve};
use study::closed_form;
use study::half_truck::HalfTruckResult;
use study::half_truck::catalog::WedgeType;
use study::metrics::Cycle;
use wedge::parameters::Damping;

use super::thesis::{Windows, cut_text, windows};
use crate::agreement::{Set, TruckOutcome, equation_5_1, sets, truck_column};

/// The quantity that a figure shows.
struct Quantity {
    /// The stand-alone wedge's column.
    column: &'static str,
    name: &'static str,
    kind: Kind,
    /// The subject of the comparison, for the caption.
    about: &'static str,
    /// The thesis's figures: variable damping without and with yaw, constant damping without and with yaw.
    thesis: [&'static str; 4],
    /// Its loop, likewise.
    loops: Option<[&'static str; 4]>,
    /// True if it is drawn with constant damping too.
    constant: bool,
    /// The value of eq. 5-1 that is drawn with it.
    equation: Option<usize>,
}

const QUANTITIES: [Quantity; 4] = [
    Quantity {
        column: "vertical_force_on_side_frame",
        name: "vertical force on the side frame",
        kind: Kind::Force,
        about: "friction and inclined normal force of the column on the side frame less the force of the \
                coil that stands on it, positive up, of all models alike: the thesis draws this of its own \
                model (eq. 5-3), and says that its curves of types 6.8 and 6.9 are friction alone, which \
                the next figures compare",
        thesis: ["figure 5-1", "figure 5-9", "", ""],
        loops: Some(["figure 5-2", "figure 5-10", "", ""]),
        constant: false,
        equation: None,
    },
    Quantity {
        column: "vertical_wedge_force",
        name: "vertical wedge force",
        kind: Kind::Force,
        about: "the friction of the column as it acts on the side frame, positive up, of all models alike",
        thesis: ["", "", "figure 6-1", "figure 6-10"],
        loops: Some(["", "", "figure 6-2", "figure 6-11"]),
        constant: true,
        equation: Some(0),
    },
    Quantity {
        column: "longitudinal_wedge_force",
        name: "longitudinal wedge force",
        kind: Kind::Force,
        about: "the column's forces along the track; type 6.8 has none. Of the stand-alone model the normal \
                forces only (eq. 5-2), of the others the friction's part too, which is 0.15 % of it with \
                0.2° of toe",
        thesis: ["figure 5-5", "figure 5-13", "figure 6-5", ""],
        loops: None,
        constant: true,
        equation: Some(1),
    },
    Quantity {
        column: "side_frame_friction_power",
        name: "rate of energy dissipation",
        kind: Kind::Power,
        about: "the power of the column's friction on the side frame, negative where energy is lost. The \
                thesis's scripts make the types' curves from their force and velocity (in chapter 5 its \
                size); here it is the friction's own power",
        thesis: ["figure 5-7", "figure 5-15", "figure 6-7", "figure 6-16"],
        loops: None,
        constant: true,
        equation: None,
    },
];

/// The stand-alone wedge's curves with yaw and variable damping begin with the thesis's fifth row.
const FIRST_ROW: [f64; 4] = [0.0, 0.04, 0.0, 0.0];
/// The start of the thesis's curves of the whole run, s.
const START: [f64; 4] = [0.0, 0.0, 0.5, 0.5];

/// Returns the style of the curves of a type.
fn style(wedges: WedgeType) -> (&'static str, Colour, Line) {
    match wedges {
        WedgeType::Spatial => ("our reading of type 6.9", Colour::Vermillion, Line::DashDot),
        WedgeType::Plain => ("our reading of type 6.8", Colour::Black, Line::Dashed),
    }
}

const ALONE: (&str, Colour, Line) = ("stand-alone model", Colour::Blue, Line::Solid);
/// Number of points of eq. 5-1 over the stroke.
const BRANCH_POINTS: u32 = 100;
const EQUATION: (&str, Colour, Line) = ("eq. 5-1", Colour::Green, Line::Dotted);

/// Returns the figures that these runs allow.
#[must_use]
pub fn exhibits(outcomes: &[CaseOutcome], trucks: &[TruckOutcome]) -> Vec<Exhibit> {
    let mut exhibits = Vec::new();
    for set in sets(outcomes, trucks) {
        let sheet = Sheet::new(&set);
        for quantity in &QUANTITIES {
            if set.damping == Damping::Constant && !quantity.constant {
                continue;
            }
            exhibits.push(sheet.over_time(quantity));
            exhibits.extend(sheet.over_displacement(quantity));
        }
    }
    exhibits
}

/// A comparison being drawn.
struct Sheet<'o> {
    set: &'o Set<'o>,
    /// Its place in the tables above.
    number: usize,
    windows: &'static Windows,
    units: Units,
}

impl<'o> Sheet<'o> {
    fn new(set: &'o Set<'o>) -> Self {
        let number = 2 * usize::from(set.damping == Damping::Constant) + usize::from(set.yawed);
        Self {
            set,
            number,
            windows: windows(number),
            units: set.alone.1.summary.units,
        }
    }

    fn name(&self, what: &str) -> String {
        let yaw = if self.set.yawed { "_yawed" } else { "" };
        format!("{}{yaw}_compared_{what}", self.set.damping.name())
    }

    fn title(&self, what: &str) -> String {
        let yaw = if self.set.yawed { "yawed" } else { "not yawed" };
        format!(
            "{} damping, toe out, {yaw}: {what}",
            capital(self.set.damping.name())
        )
    }

    /// Returns one column over another for all models; then eq. 5-1.
    fn curves(&self, x: &str, quantity: &Quantity) -> Vec<PlotCurve> {
        let mut curves = vec![curve(&self.set.alone.1, x, quantity.column, ALONE)];
        for (entry, result) in self.set.trucks.iter().copied() {
            let values = truck_column(result, quantity.column);
            curves.extend(values.and_then(|values| {
                self.truck_curve(
                    result,
                    x,
                    values.iter().copied(),
                    quantity.kind,
                    style(entry.wedges),
                )
            }));
        }
        let spatial = self
            .set
            .trucks
            .iter()
            .find(|(entry, _)| entry.wedges == WedgeType::Spatial);
        if quantity.equation.is_some() && x != "time" {
            curves.extend(self.branches());
        } else if let (Some(part), Some((_, result))) = (quantity.equation, spatial) {
            curves.extend(equation_5_1(&self.set.alone.0, result).and_then(|values| {
                let values = values.into_iter().map(|value| value[part]);
                self.truck_curve(result, x, values, quantity.kind, EQUATION)
            }));
        }
        curves
    }

    /// Eq. 5-1 over the input's stroke: both branches.
    fn branches(&self) -> Option<PlotCurve> {
        let parameters = &self.set.alone.0.parameters;
        let cycle = Cycle::of(parameters)?;
        let (low, high) = (cycle.middle - cycle.amplitude, cycle.middle + cycle.amplitude);
        let mut points = Vec::new();
        for direction in [SlidingDirection::Up, SlidingDirection::Down] {
            for part in 0..=BRANCH_POINTS {
                let z = low + (high - low) * f64::from(part) / f64::from(BRANCH_POINTS);
                let force = closed_form::vertical_wedge_force(parameters, z, direction)?;
                points.push((
                    converted(z, Kind::Length, self.units),
                    converted(force, Kind::Force, self.units),
                ));
            }
            points.push((f64::NAN, f64::NAN));
        }
        let (label, colour, line) = EQUATION;
        Some(PlotCurve::new(label, (colour, line), points))
    }

    fn truck_curve(
        &self,
        result: &HalfTruckResult,
        x: &str,
        values: impl Iterator<Item = f64>,
        kind: Kind,
        (label, colour, line): (&str, Colour, Line),
    ) -> Option<PlotCurve> {
        let x_kind = if x == "time" { Kind::Time } else { Kind::Length };
        // Loops of the half-truck are drawn over its stroke.
        let x = if x == "bolster_vertical" { "wedge_z" } else { x };
        let points = truck_column(result, x)?.iter().zip(values);
        Some(PlotCurve::new(
            label,
            (colour, line),
            points.map(|(x, y)| (converted(*x, x_kind, self.units), converted(y, kind, self.units))),
        ))
    }

    fn over_time(&self, quantity: &Quantity) -> Exhibit {
        let mut curves = self.curves("time", quantity);
        let (start, first) = (START[self.number], FIRST_ROW[self.number]);
        curves[0].points.retain(|point| point.0 >= first - 1e-9);
        let end = curves
            .iter()
            .filter_map(|curve| curve.points.last())
            .fold(0.0, |end: f64, point| end.max(point.0));
        let zooms: Vec<(f64, f64)> = self
            .windows
            .zooms
            .iter()
            .copied()
            .filter(|zoom| zoom.1 <= end)
            .collect();
        let mut panels = vec![Panel {
            x_window: (start < end).then_some((start, end)),
            span: zooms.len().max(1),
            ..Panel::new(
                "(a) the whole run",
                "time (s)",
                axis(quantity.name, quantity.kind, self.units),
                curves.clone(),
            )
        }];
        for (zoom, letter) in zooms.iter().zip('b'..) {
            panels.push(Panel {
                title: format!("({letter}) {} to {} s", zoom.0, zoom.1),
                x_window: Some(*zoom),
                span: 1,
                ..panels[0].clone()
            });
        }
        let mut caption = format!("{} over time: {}.", capital(quantity.name), quantity.about);
        caption += &self.labels(quantity, true);
        if start > 0.0 {
            caption += &cut_text(&curves, start, quantity.kind, self.units);
        }
        if first > 0.0 {
            caption += &format!(
                " The stand-alone model's first {first} s, in which it is released, are left out as in the \
                 thesis."
            );
        }
        Exhibit {
            name: self.name(quantity.column),
            thesis: quantity.thesis[self.number].to_owned(),
            figure: Figure {
                columns: if zooms.is_empty() { 1 } else { 2 },
                ..Figure::new(self.title(quantity.name), caption, panels)
            },
        }
    }

    /// Returns the labels of the curves.
    fn labels(&self, quantity: &Quantity, over_time: bool) -> String {
        let mut text = " Types 6.8 and 6.9 are our reading of them, in the half-truck: no output of the \
                        comparison program is known."
            .to_owned();
        if let Some(part) = quantity.equation {
            let what = ["friction", "longitudinal force"][part];
            let under = if over_time {
                "the coil force that type 6.9 has in its run, in the direction of the input"
            } else {
                "the coil force that the input's full stroke gives"
            };
            text += &format!(
                " Eq. 5-1, with its misprint put right, and its like for the way down, is drawn as the \
                 {what} of steady sliding, under {under}."
            );
        }
        if self.set.yawed {
            text += " The half-truck is yawed as its files intend; as printed they hardly yaw.";
        }
        text
    }

    fn over_displacement(&self, quantity: &Quantity) -> Option<Exhibit> {
        let thesis = quantity.loops?[self.number];
        let piece = self.windows.of_loop;
        let panel = |x: &str, title: &str, x_label: &str| {
            let mut curves = self.curves(x, quantity);
            let times = self.curves("time", quantity);
            for (curve, timed) in curves
                .iter_mut()
                .zip(&times)
                .filter(|(curve, _)| curve.label != EQUATION.0)
            {
                let mut rows = timed.points.iter();
                curve.points.retain(|_| {
                    rows.next()
                        .is_some_and(|row| (piece.0..=piece.1).contains(&row.0))
                });
            }
            Panel::new(
                title,
                axis(x_label, Kind::Length, self.units),
                axis(quantity.name, quantity.kind, self.units),
                curves,
            )
        };
        let panels = vec![
            panel(
                "wedge_z",
                "(a) over the wedge's displacement",
                "wedge displacement, or stroke",
            ),
            panel(
                "bolster_vertical",
                "(b) over the bolster's displacement",
                "bolster displacement, or stroke",
            ),
        ];
        let caption = format!(
            "Hysteresis: {} from {} to {} s over the vertical displacement, of the stand-alone model that \
             of (a) its wedge, as in the thesis, and (b) its bolster; of types 6.8 and 6.9, which know no \
             displacement of the wedge, the stroke (bolster against side frame) in both. It is {}.{}",
            quantity.name,
            piece.0,
            piece.1,
            quantity.about,
            self.labels(quantity, false)
        );
        Some(Exhibit {
            name: self.name(&format!("{}_loop", quantity.column)),
            thesis: thesis.to_owned(),
            figure: Figure::new(
                self.title(&format!("{}, hysteresis", quantity.name)),
                caption,
                panels,
            ),
        })
    }
}

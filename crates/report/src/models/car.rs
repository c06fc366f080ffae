//! A car on track.

use std::time::Duration;

use quantity::Kind;
use study::car::CarCase;
use study::car::motions::MotionTable;
use study::car::run::CarResult;
use study::car::summary::CarSummary;
use study::models::AnyCase;
use study::run::{Run, RunError};
use study::statics::StaticTable;
use study::summary::{RunSummary, SummaryValue};

use super::limits;
use super::{GoOn, Loop, LoopAxis, ReportCase, ReportSummary, joules, range, with_note};
use crate::figures::car::CarRun;
use crate::figures::side_by_side::Wanted;
use crate::page;
use crate::run_files::RunFiles;
use crate::run_folder::key_numbers::{KeyNumber, of_rise};
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};

impl ReportSummary for CarSummary {
    fn key_numbers(&self, _: Option<&AnyCase>) -> Vec<KeyNumber> {
        let mut numbers = limits::key_numbers(self.limits());
        for ((what, value), kind) in [
            ("speed at the start", &self.speed[0]),
            ("speed at the end", &self.speed[1]),
            ("distance at the end", &self.distance[1]),
        ]
        .into_iter()
        .zip([Kind::TravelSpeed, Kind::TravelSpeed, Kind::Distance])
        {
            numbers.push(KeyNumber::new(what, "one output time", value, kind));
        }
        if let Some(first) = self.wedge_losses.values().next() {
            let sum = SummaryValue {
                value: self.wedge_losses.values().map(|loss| loss.value).sum(),
                unit: first.unit.clone(),
            };
            numbers.push(KeyNumber::new(
                "friction energy of all wedges",
                "the whole run",
                &sum,
                Kind::Energy,
            ));
        }
        numbers.extend(of_rise(&self.wedge_rise));
        numbers
    }

    fn overlays(&self, _: &ResultTable) -> Vec<Wanted> {
        let wheels = |name: &str, title: &str, caption: &str, what: &str| {
            let places = [
                (1, "left", "(a) axle 1, left"),
                (1, "right", "(b) axle 1, right"),
                (3, "left", "(c) axle 3, left"),
                (3, "right", "(d) axle 3, right"),
            ];
            let own = places.map(|(axle, side, title)| (format!("axle_{axle}_{side}_{what}"), title));
            let own: Vec<(&str, &str)> = own.iter().map(|(name, title)| (name.as_str(), *title)).collect();
            Wanted::new(name, title, caption, "distance", &own)
        };
        vec![
            wheels(
                "wheel_loads",
                "Vertical wheel forces, leading axles",
                "Vertical force on the rail, filtered where the run filters.",
                "vertical",
            ),
            wheels(
                "lateral_forces",
                "Lateral wheel forces, leading axles",
                "Lateral force on the rail, positive where it spreads the gauge, filtered where the run \
                 filters.",
                "lateral",
            ),
            wheels(
                "l_over_v",
                "L/V, leading axles",
                "Lateral over vertical force, filtered where the run filters.",
                "l_over_v",
            ),
            Wanted::new(
                "car_body",
                "Car body",
                "Roll against the track, accelerations at the front truck center, speed.",
                "distance",
                &[
                    ("body_roll", "(a) roll"),
                    ("body_at_truck_1_lateral_acceleration", "(b) lateral acceleration"),
                    (
                        "body_at_truck_1_vertical_acceleration",
                        "(c) vertical acceleration",
                    ),
                    ("speed", "(d) speed"),
                ],
            ),
            Wanted::new(
                "car_trucks",
                "Trucks",
                "Warp angles, and the normal force of the leading left column of each truck.",
                "distance",
                &[
                    ("truck_1_warp_angle", "(a) warp, front truck"),
                    ("truck_2_warp_angle", "(b) warp, rear truck"),
                    ("truck_1_leading_left_column_normal", "(c) column, front truck"),
                    ("truck_2_leading_left_column_normal", "(d) column, rear truck"),
                ],
            ),
            Wanted::new(
                "car_warp_loops",
                "Warp moment over warp angle",
                "Warp moment on each bolster over the warp angle of its truck.",
                "",
                &[],
            )
            .with([1, 2].map(|truck| {
                [
                    format!("truck_{truck}_warp_angle"),
                    format!("truck_{truck}_warp_moment"),
                    ["(a) front truck", "(b) rear truck"][truck - 1].to_owned(),
                ]
            })),
        ]
    }

    fn over_distance(&self) -> bool {
        true
    }

    fn statics(&self) -> Option<&StaticTable> {
        Some(&self.statics)
    }
}

impl ReportCase for CarCase {
    /// The motions of its bodies.
    type Along = Option<MotionTable>;
    type Shown = CarRun;

    fn start(&self) -> Result<Run<Self>, RunError> {
        Run::with_motions(self)
    }

    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (CarResult, Self::Along) {
        run.finish_with_motions(go_on)
    }

    fn shown(self, result: CarResult, motions: Self::Along) -> CarRun {
        CarRun {
            case: self,
            result,
            motions,
        }
    }

    fn parts(shown: &CarRun) -> (&Self, &CarResult) {
        (&shown.case, &shown.result)
    }

    fn recording(shown: &CarRun, detail: Detail) -> Recording {
        Recording::of_car(&shown.case, &shown.result, shown.motions.as_ref(), detail)
    }

    fn page(shown: &CarRun) -> Result<String, serde_json::Error> {
        page::car_run::render(shown)
    }

    /// Its limits, and what its start locks in.
    fn in_words(summary: &CarSummary, _: Duration) -> (TerminalTable, String) {
        let (table, about) = limits::beside(summary);
        (table, with_note(&about, summary.start_in_words()))
    }

    /// Over the distance: the roll of the body where it rolls by more than 0.5 deg, the lateral force of the
    /// leading axle's wheel that pushes more where the track curves, else the vertical force of the leading
    /// left wheel.
    fn shown_loop(&self, result: &CarResult) -> Loop {
        let most = |name: &str| {
            let values = result.column(name).unwrap_or_default().iter();
            values.fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let distances = result.column("distance").unwrap_or_default();
        let line = &self.parameters.track.center_line;
        let curves = distances.iter().any(|at| line.at(*at).curvature[0] != 0.0);
        let [left, right] = ["axle_1_left_lateral", "axle_1_right_lateral"];
        let (title, column, name) = if range(result.column("body_roll")) > 0.5_f64.to_radians() {
            (
                "Roll of the body over the distance",
                "body_roll",
                "roll of the body, left side up",
            )
        } else if curves {
            let outer = if most(left) > most(right) { left } else { right };
            (
                "Lateral force of a wheel of the leading axle over the distance",
                outer,
                "lateral force, positive where it spreads the gauge",
            )
        } else {
            (
                "Vertical force of the leading left wheel over the distance",
                "axle_1_left_vertical",
                "vertical force",
            )
        };
        let losses: f64 = result.summary.wedge_losses.values().map(|loss| loss.value).sum();
        Loop {
            title,
            x: LoopAxis::new("distance", "distance along the track"),
            y: LoopAxis::new(column, name),
            energy_of: "Energy lost in friction at the eight wedges",
            energy_per: "run",
            energy: Some(joules(losses, result.summary.units)),
            missing: String::new(),
        }
    }
}

impl RunFiles for CarCase {}

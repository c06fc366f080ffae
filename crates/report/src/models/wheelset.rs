//! A wheelset on a track.

use quantity::Kind;
use study::models::AnyCase;
use study::wheelset::WheelsetCase;
use study::wheelset::summary::WheelsetSummary;

use super::ReportSummary;
use crate::figures::side_by_side::Wanted;
use crate::run_files::RunFiles;
use crate::run_folder::key_numbers::{KeyNumber, extremes};
use crate::table::ResultTable;

impl ReportSummary for WheelsetSummary {
    fn key_numbers(&self, _: Option<&AnyCase>) -> Vec<KeyNumber> {
        let mut numbers = Vec::new();
        if let Some(hunting) = &self.hunting {
            let window = "least damped vibration about steady rolling";
            numbers.extend([
                KeyNumber::plain("hunting frequency", window, hunting.frequency_hz, "Hz"),
                KeyNumber::plain("hunting damping ratio", window, hunting.damping_ratio, ""),
            ]);
        }
        for (name, kind) in [("lateral", Kind::Length), ("yaw", Kind::Angle)] {
            let suffix = kind.suffix(self.units);
            numbers.extend(extremes(
                self.extremes.get(&format!("{name}_{suffix}")),
                (&format!("least {name}"), &format!("largest {name}")),
                kind,
                self.units,
            ));
        }
        numbers
    }

    fn overlays(&self, _: &ResultTable) -> Vec<Wanted> {
        let columns = [
            ("lateral", "(a) lateral"),
            ("yaw", "(b) yaw"),
            ("left_vertical", "(c) left wheel, vertical force"),
            ("right_vertical", "(d) right wheel, vertical force"),
        ];
        vec![Wanted::new(
            "wheelset",
            "Wheelset over distance",
            "Place and yaw of the wheelset on the track, and its wheel forces.",
            "distance",
            &columns,
        )]
    }

    fn over_distance(&self) -> bool {
        true
    }
}

impl RunFiles for WheelsetCase {}

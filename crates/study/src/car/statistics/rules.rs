//! What statistics are taken: times, distances, filters.

use quantity::SixDigits;

use super::FOOT;

/// The rules of statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Cutoff of the filter of wheel forces, Hz.
    pub wheel_filter: f64,
    /// Duration of an exceedance, s.
    pub hold_time: f64,
    /// The same over a distance, m.
    pub hold_distance: f64,
    /// Distance of a truck side's L/V, m.
    pub side_distance: f64,
    /// Share of the rows in curves below the value reported.
    pub percentile: f64,
    /// Cutoff of the filter of accelerations, Hz.
    pub acceleration_filter: f64,
    /// Distance of the standard deviation of accelerations, m.
    pub deviation_distance: f64,
    /// Time of the rms of accelerations, s.
    pub rms_time: f64,
    /// Window of the range of accelerations, s.
    pub range_time: f64,
    /// Window of the rms of accelerations about a line, s.
    pub rmst_time: f64,
    /// Ends of the band of the accelerations of trucks, Hz.
    pub truck_band: [f64; 2],
    /// Window of the rms of these, about zero and about a line, s.
    pub truck_rms_time: f64,
    /// Length of sections of the run, m.
    pub section_length: f64,
    /// Distance of sliding means, m.
    pub mean_distance: f64,
    /// Deviations beyond the mean of sections that count, of L/V and of axles' lateral forces.
    pub section_factor_safety: f64,
    /// The same of wheels' vertical forces and of accelerations.
    pub section_factor: f64,
    /// True if results have filtered columns.
    pub filtered_columns: bool,
}

impl Rules {
    /// Returns a text in which hold times and distances are named with their values: `L/V lasting 50 ms`.
    #[must_use]
    pub fn in_words(&self, text: &str) -> String {
        let feet = |length: f64| format!("{} ft", SixDigits(length / FOOT));
        [
            (
                "that lasts for the hold time",
                format!("lasting {} ms", SixDigits(1e3 * self.hold_time)),
            ),
            (
                "that lasts over the hold distance",
                format!("lasting {}", feet(self.hold_distance)),
            ),
            (
                "over the side distance",
                format!("over {}", feet(self.side_distance)),
            ),
            (
                "within the range time",
                format!("within {} s", SixDigits(self.range_time)),
            ),
            (
                "over the RMSt time",
                format!("over {} s", SixDigits(self.rmst_time)),
            ),
            (
                "over the truck's rms time",
                format!("over {} s", SixDigits(self.truck_rms_time)),
            ),
            (
                "over the deviation distance",
                format!("over {}", feet(self.deviation_distance)),
            ),
            (
                "over the mean distance",
                format!("over {} m", SixDigits(self.mean_distance)),
            ),
        ]
        .into_iter()
        .fold(text.to_owned(), |text, (before, value)| {
            text.replace(before, &value)
        })
    }
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            wheel_filter: 15.0,
            hold_time: 0.05,
            hold_distance: 3.0 * FOOT,
            side_distance: 6.0 * FOOT,
            percentile: 0.95,
            acceleration_filter: 10.0,
            deviation_distance: 2000.0 * FOOT,
            rms_time: 2.0,
            range_time: 1.0,
            rmst_time: 4.0,
            truck_band: [0.5, 10.0],
            truck_rms_time: 2.0,
            section_length: 100.0,
            mean_distance: 2.0,
            section_factor_safety: 3.0,
            section_factor: 2.2,
            filtered_columns: true,
        }
    }
}

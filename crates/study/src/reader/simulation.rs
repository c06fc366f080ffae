//! The settings of a case's run.

use input::limits;
use quantity::{Kind, Quantity};

use super::{CaseReader, QuantityForm};
use crate::case::Simulation;
use crate::case::field::Reach;
use crate::case::names::{METHODS, SYSTEMS};
use crate::case::problem::Problem;
use crate::case::section::Range;

/// Numbers have sixteen digits; a narrower tolerance is never met.
const TOLERANCE: Range = Range::Between(1e-15, 1.0, "between 1e-15 and 1, both excluded");
const TIME: QuantityForm = (Kind::Time, Range::Positive, Reach::Positive);

impl CaseReader<'_> {
    /// Reads `[simulation]`; the texts say what interval and units mean. Returns the duration as typed too.
    pub fn simulation(
        &mut self,
        usual: Simulation,
        interval_means: &str,
        units_mean: &str,
    ) -> (Simulation, Option<Quantity>) {
        let mut simulation = usual;
        self.section("simulation", "How to run it.");
        let duration = self.quantity("duration", TIME, &mut simulation.duration, "");
        let interval = &mut simulation.output_interval;
        let interval = self.quantity("output_interval", TIME, interval, interval_means);
        let comment = "of the integrator, between 0 and 1";
        let tolerance = &mut simulation.relative_tolerance;
        self.number("relative_tolerance", TOLERANCE, Reach::Wide, tolerance, comment);
        self.choice("output_units", SYSTEMS, &mut simulation.output_units, units_mean);
        let comment = "\"rodas5p\"; \"tr-bdf2\" and \"esdirk3\" damp vibrations";
        self.choice("method", METHODS, &mut simulation.method, comment);
        if let (Some(duration), Some(interval)) = (&duration, &interval) {
            self.check_rows(duration, interval);
        }
        (simulation, duration)
    }

    /// Notes an output interval that is longer than the run, or gives too many rows.
    fn check_rows(&mut self, duration: &Quantity, interval: &Quantity) {
        let problem = if interval.to_si() > duration.to_si() {
            let message =
                format!("`simulation.output_interval` ({interval}) is longer than the duration ({duration})");
            let help = "write an interval that is shorter, for example \"0.01 s\", or a longer duration";
            Problem::new(message).label("longer than the run").help(help)
        } else if duration.to_si() / interval.to_si() >= limits::OUTPUT_ROWS as f64 {
            let most = limits::OUTPUT_ROWS;
            let message = format!("{duration} in steps of {interval} are more than {most} output times");
            let least = duration.to_si() / (most / 2) as f64;
            let help = format!("write a longer interval, for example \"{least:.1e} s\"");
            Problem::new(message).label("too short").help(help)
        } else {
            return;
        };
        let given = ["output_interval", "duration"]
            .into_iter()
            .find(|key| self.gives(key));
        self.problem_at(&self.path(given.unwrap_or("duration")), problem);
    }
}

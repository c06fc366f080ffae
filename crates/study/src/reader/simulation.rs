//! The settings of a case's run.

use quantity::{Kind, Quantity};

use super::{CaseReader, QuantityForm};
use crate::case::Simulation;
use crate::case::document::{METHODS, SYSTEMS};
use crate::case::duration::check_rows;
use crate::case::field::Reach;
use crate::case::read::TOLERANCE;
use crate::case::section::Range;

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
        if let (Some(duration), Some(interval), Some(section)) = (&duration, &interval, self.given()) {
            check_rows(&section, duration, interval, self.problems);
        }
        (simulation, duration)
    }
}

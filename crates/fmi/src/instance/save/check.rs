//! Checks of a saved state against an instance: everything that could lead it astray is checked before it is
//! taken over.

use super::super::check_experiment;
use super::{Instance, Phase, Saved};
use crate::Error;
use crate::element::Interface;
use crate::error::{check_finite, check_lengths, damaged};
use crate::extrapolate::KEPT_POINTS;
use crate::watch::Doubt;

impl Saved {
    /// Checks whether it can be a state of this instance, as far as that can be said without its element.
    pub(super) fn check(&self, instance: &Instance) -> Result<(), Error> {
        let (own, found) = (&instance.values, &self.values);
        check_lengths([
            ("parameters", found.parameters.len(), own.parameters.len()),
            ("options", found.options.len(), own.options.len()),
            ("inputs", found.inputs.len(), own.inputs.len()),
            ("start_inputs", found.start_inputs.len(), own.inputs.len()),
            ("slopes", found.slopes.len(), own.slopes.len()),
            ("set", found.set.len(), own.set.len()),
            ("doubts", found.doubts.len(), own.doubts.len()),
        ])?;
        check_experiment(self.experiment)
            .map_err(|error| Error::new(format!("the saved state is damaged: {error}")))?;
        check_finite("time", [&self.time])?;
        check_finite("parameters", &found.parameters)?;
        check_finite("inputs", &found.inputs)?;
        check_finite("start_inputs", &found.start_inputs)?;
        check_finite("slopes", found.slopes.iter().flatten())?;
        check_finite("doubts", found.doubts.iter().flat_map(Doubt::values))?;
        self.check_options(instance)?;
        self.check_phase()?;
        self.check_past(own.inputs.len())
    }

    fn check_past(&self, inputs: usize) -> Result<(), Error> {
        if self.values.past.len() > KEPT_POINTS {
            let expected = format!("a list of at most {KEPT_POINTS}");
            return Err(damaged(
                "past",
                format!("a list of {}", self.values.past.len()),
                expected,
            ));
        }
        // An importer that integrates may go back in time.
        let mut span = match self.interface {
            Interface::CoSimulation => [self.experiment.start, self.time],
            Interface::ModelExchange => [f64::NEG_INFINITY, f64::INFINITY],
        };
        for (number, point) in self.values.past.iter().enumerate() {
            check_lengths([("past", point.inputs.len(), inputs)])?;
            check_finite("past", point.inputs.iter().chain([&point.time]))?;
            let [least, greatest] = span;
            if point.time < least || number > 0 && point.time == least || point.time > greatest {
                let expected = "after the one before, and not after the instance's";
                return Err(damaged("the time of an earlier point", point.time, expected));
            }
            span[0] = point.time;
        }
        Ok(())
    }

    fn check_options(&self, instance: &Instance) -> Result<(), Error> {
        for (entry, value) in instance
            .description
            .entries
            .options
            .iter()
            .zip(&self.values.options)
        {
            let [least, greatest] = entry.reach.unwrap_or([0.0, 1.0]);
            if !(least..=greatest).contains(&f64::from(*value)) {
                return Err(damaged(
                    &entry.name,
                    value,
                    format!("between {least} and {greatest}"),
                ));
            }
        }
        Ok(())
    }

    /// Checks whether phase, interface, element and times belong together.
    fn check_phase(&self) -> Result<(), Error> {
        let exchange = self.interface == Interface::ModelExchange;
        let possible = match self.phase {
            Phase::Event | Phase::Continuous => exchange,
            Phase::Step | Phase::Failed => !exchange,
            Phase::Instantiated | Phase::Initialization | Phase::Terminated => true,
        };
        if !possible {
            return Err(damaged(
                "phase",
                self.phase.name(),
                "one of this kind of interface",
            ));
        }
        let started = !self.phase.is_before_start();
        if started && self.element.is_none() {
            return Err(damaged(
                "element",
                "missing",
                "there from the end of the initialization on",
            ));
        }
        if !started && self.time != self.experiment.start {
            return Err(damaged(
                "time",
                self.time,
                format!("the start time, {} s", self.experiment.start),
            ));
        }
        // A step that has failed may have left the element on its way.
        let may_differ = matches!(self.phase, Phase::Failed | Phase::Terminated);
        match self.element.as_ref().map(|element| element.time) {
            Some(time) if time != self.time && !may_differ => Err(damaged(
                "the element's time",
                time,
                format!("{} s, as the instance's", self.time),
            )),
            _ => Ok(()),
        }
    }
}

//! Simulating: steps of co-simulation, and what model exchange asks for.

use super::{Instance, Phase, Values};
use crate::element::Interface;
use crate::extrapolate::{Known, Point, Understanding, end_of_step};
use crate::watch::positions;
use crate::{Category, Error, Severity};

/// The changes by handling events.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventUpdate {
    /// Another update is needed.
    pub again: bool,
    /// The time of the next time event (s), if there is one.
    pub next_time: Option<f64>,
}

/// In all phases in which model exchange evaluates equations.
const EVALUATES: &[Phase] = &[
    Phase::Initialization,
    Phase::Event,
    Phase::Continuous,
    Phase::Terminated,
];

impl Instance {
    pub(super) fn option(&self, name: &str) -> bool {
        let place = self
            .description
            .entries
            .options
            .iter()
            .position(|entry| entry.name == name);
        place
            .and_then(|place| self.values.options.get(place))
            .is_some_and(|value| *value != 0)
    }

    /// Makes a step from a time (s) that must be the one reached, of a length (s).
    ///
    /// # Errors
    /// Called out of order, another time, a length that is none, a step beyond the stop time; or the
    /// integration cannot go on: the instance has then failed.
    pub fn do_step(&mut self, time: f64, length: f64) -> Result<(), Error> {
        self.require("a step is made", &[Phase::Step])?;
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::new(format!(
                "a communication step of {length} s: it must be positive and finite"
            )));
        }
        let slack = 1e-9 * length.max(self.time.abs()).max(1e-3);
        let off = (time - self.time).abs();
        if off.is_nan() || off > slack {
            return Err(Error::new(format!(
                "the step begins at {time} s, but the instance has reached {} s; go back with a saved state",
                self.time
            )));
        }
        let end = time + length;
        if end <= self.time {
            return Err(Error::new(format!(
                "a communication step of {length} s from {time} s ends at {end} s, which is not after the \
                 time reached, {} s: make it longer",
                self.time
            )));
        }
        if let Some(stop) = self.experiment.stop.filter(|stop| end > stop + slack) {
            return Err(Error::new(format!(
                "the step ends at {end} s, beyond the stop time {stop} s of the experiment"
            )));
        }
        let how = Understanding {
            derive_rates: self.option("derive_rates"),
            at_end: self.option("inputs_at_end"),
        };
        let point = Point {
            time: if how.at_end { end } else { self.time },
            inputs: self.values.inputs.clone(),
        };
        self.watch_inputs(&point, length, Some(how));
        // The inputs of the initialization hold until others are set for the same time.
        if let Some(start) = self.values.past.pop_if(|past| past.time >= point.time) {
            let knows_more = self.values.slopes.iter().any(Option::is_some);
            self.values.restartable &= start.inputs == point.inputs && !knows_more;
        }
        if let Err(error) = self.begin_again(&point, how) {
            self.phase = Phase::Failed;
            return Err(error);
        }
        let known = Known {
            time: point.time,
            values: &self.values.inputs,
            slopes: &self.values.slopes,
            set: &self.values.set,
            past: &self.values.past,
        };
        let inputs = end_of_step(&self.description.entries.inputs, known, length, how);
        let before: Vec<u8> = match &self.element {
            Some(element) if self.log_events => element.modes().to_vec(),
            _ => Vec::new(),
        };
        let element = self.build()?;
        let attempts = element.attempts();
        let stepped = element.step(&inputs, end);
        let attempts = element.attempts().saturating_sub(attempts);
        self.changed();
        self.watch_effort(attempts, length, end);
        if let Err(error) = stepped {
            self.phase = Phase::Failed;
            return Err(error);
        }
        self.time = end;
        self.values.keep(point);
        self.values.slopes.fill(None);
        self.log_modes(&before);
        self.watch_element();
        Ok(())
    }

    /// Makes the start anew, and the first step if it has been made, with rates of positions whose rate is
    /// not given: they are known as soon as there are two points. Else neighbours would start at rest and
    /// jerk, and friction remembers that for seconds.
    fn begin_again(&mut self, point: &Point, how: Understanding) -> Result<(), Error> {
        let Values {
            past, set, inputs, ..
        } = &self.values;
        let [first] = &past[..] else { return Ok(()) };
        if !self.values.restartable || first.time != self.experiment.start {
            return Ok(());
        }
        let length = point.time - first.time;
        let entries = &self.description.entries.inputs;
        let known = Known {
            time: first.time,
            values: &first.inputs,
            slopes: &[],
            set,
            past: &[],
        };
        let mut end = end_of_step(entries, known, length, how);
        let (mut start, own) = (first.inputs.clone(), inputs.clone());
        for (position, rate) in positions(entries) {
            // A rate that was set in the initialization holds.
            if how.derives(set, position, rate) && start[rate] == 0.0 {
                start[rate] = (point.inputs[position] - start[position]) / length;
                (end[position], end[rate]) = (point.inputs[position], start[rate]);
            }
        }
        if start == first.inputs {
            return Ok(());
        }
        let time = self.time;
        self.values.inputs = start;
        self.element = None;
        let built = self.build().map(|_| ());
        self.values.inputs = own;
        built?;
        if how.at_end {
            Ok(())
        } else {
            self.build()?.step(&end, time)
        }
    }

    /// Logs which contact states are others than before.
    fn log_modes(&mut self, before: &[u8]) {
        let Some(element) = self.element.as_ref().filter(|_| self.log_events) else {
            return;
        };
        const NAMES: [&str; 3] = ["open", "stick", "slip"];
        let name = |mode: u8| NAMES.get(usize::from(mode)).copied().unwrap_or("?");
        let changes: Vec<String> = before
            .iter()
            .zip(element.modes())
            .zip(&self.description.entries.modes)
            .filter(|((from, to), _)| from != to)
            .map(|((from, to), entry)| {
                format!(
                    "{}: {} to {} by {} s",
                    entry.name,
                    name(*from),
                    name(*to),
                    self.time
                )
            })
            .collect();
        for text in changes {
            self.say(Severity::Warning, Category::Events, text);
        }
    }

    fn exchange(&self, what: &str, phases: &[Phase]) -> Result<(), Error> {
        if self.interface == Interface::CoSimulation {
            return Err(Error::new(format!(
                "{what}: this belongs to model exchange, the instance is one of co-simulation"
            )));
        }
        self.require(what, phases)
    }

    /// Begins event mode.
    ///
    /// # Errors
    /// Called out of order.
    pub fn enter_event_mode(&mut self) -> Result<(), Error> {
        self.exchange("event mode begins", &[Phase::Continuous, Phase::Event])?;
        self.phase = Phase::Event;
        Ok(())
    }

    /// Begins continuous-time mode.
    ///
    /// # Errors
    /// Called out of order.
    pub fn enter_continuous_time_mode(&mut self) -> Result<(), Error> {
        self.exchange("continuous-time mode begins", &[Phase::Event, Phase::Continuous])?;
        self.phase = Phase::Continuous;
        Ok(())
    }

    /// Handles events: brings the contact states up to date.
    ///
    /// # Errors
    /// Called out of order.
    pub fn update_discrete_states(&mut self) -> Result<EventUpdate, Error> {
        self.exchange("discrete states are updated", &[Phase::Event])?;
        let element = self.fresh()?;
        let before = element.modes().to_vec();
        let next_time = element.next_time_event();
        element.update_modes();
        self.changed();
        self.log_modes(&before);
        Ok(EventUpdate {
            again: false,
            next_time,
        })
    }

    /// Completes a step of the importer's integrator.
    ///
    /// # Errors
    /// Called out of order.
    pub fn completed_integrator_step(&mut self) -> Result<(), Error> {
        self.exchange("an integrator step is complete", &[Phase::Continuous])?;
        self.fresh()?;
        let past = self.values.past.last();
        let Some(length) = past
            .map(|past| self.time - past.time)
            .filter(|length| *length != 0.0)
        else {
            return Ok(());
        };
        let point = Point {
            time: self.time,
            inputs: self.values.inputs.clone(),
        };
        if length > 0.0 {
            self.watch_inputs(&point, length, None);
        }
        self.values.past.retain(|past| past.time < point.time);
        self.values.keep(point);
        self.watch_element();
        Ok(())
    }

    /// Sets time, s.
    ///
    /// # Errors
    /// Called out of order, or a time that is not finite.
    pub fn set_time(&mut self, time: f64) -> Result<(), Error> {
        self.exchange("time is set", &[Phase::Event, Phase::Continuous])?;
        let states = self.build()?.states().to_vec();
        self.build()?.set_states(time, &states)?;
        self.time = time;
        self.stale = true;
        self.changed();
        Ok(())
    }

    /// Sets the continuous states.
    ///
    /// # Errors
    /// Called out of order, a wrong number, or values that are not finite.
    pub fn set_states(&mut self, states: &[f64]) -> Result<(), Error> {
        self.exchange("states are set", &[Phase::Event, Phase::Continuous])?;
        let time = self.time;
        self.build()?.set_states(time, states)?;
        self.changed();
        Ok(())
    }

    /// Reads the continuous states.
    ///
    /// # Errors
    /// Called out of order, or a wrong number.
    pub fn states(&mut self, out: &mut [f64]) -> Result<(), Error> {
        self.exchange("states are read", EVALUATES)?;
        self.length("states", out.len(), self.description.entries.states.len())?;
        let element = self.fresh()?;
        out.copy_from_slice(element.states());
        Ok(())
    }

    /// Reads the rates of the continuous states.
    ///
    /// # Errors
    /// Called out of order, or a wrong number.
    pub fn rates(&mut self, out: &mut [f64]) -> Result<(), Error> {
        self.exchange("rates are read", EVALUATES)?;
        self.length("rates", out.len(), self.description.entries.states.len())?;
        self.fresh()?.rates(out)
    }

    /// Reads the event indicators.
    ///
    /// # Errors
    /// Called out of order, or a wrong number.
    pub fn indicators(&mut self, out: &mut [f64]) -> Result<(), Error> {
        self.exchange("event indicators are read", EVALUATES)?;
        self.length(
            "event indicators",
            out.len(),
            self.description.entries.indicators.len(),
        )?;
        self.fresh()?.indicators(out);
        Ok(())
    }

    /// Reads the nominal values of the continuous states.
    ///
    /// # Errors
    /// A wrong number, or an instance of co-simulation.
    pub fn nominals(&mut self, out: &mut [f64]) -> Result<(), Error> {
        self.exchange(
            "nominal values are read",
            &[
                Phase::Instantiated,
                Phase::Initialization,
                Phase::Event,
                Phase::Continuous,
                Phase::Terminated,
            ],
        )?;
        self.length("nominal values", out.len(), self.description.entries.states.len())?;
        for (target, entry) in out.iter_mut().zip(&self.description.entries.states) {
            *target = entry.nominal.unwrap_or(1.0);
        }
        Ok(())
    }

    fn length(&self, what: &str, found: usize, expected: usize) -> Result<(), Error> {
        if found == expected {
            return Ok(());
        }
        Err(Error::new(format!(
            "room for {found} {what} is given; there are {expected}"
        )))
    }
}

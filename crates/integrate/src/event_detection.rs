//! Location of events: the times within a step at which discrete states change.

use std::ops::Range;

use crate::dense_output::DenseOutput;
use crate::event::{Event, EventGroup};
use crate::problem::{Problem, ProblemStructure};
use crate::root_search::RootSearch;
use crate::statistics::Statistics;
use crate::tuning::events as tuning;
use numerics::lanes::LANES;

/// The discrete states of a problem, and the events of the last step.
#[derive(Clone, Debug)]
pub(crate) struct EventDetector {
    /// Discrete states at the time reached, and at the start of the last step.
    pub discrete_states: Vec<u8>,
    pub before: Vec<u8>,
    /// Events of the last step.
    pub events: Vec<Event>,
    groups: Vec<Group>,
    /// Event variables at the point evaluated last.
    variables: Vec<f64>,
    /// Event variables at the start of the step, at the point up to which events are being located, at the
    /// end of the step, and at the high end of the bracket.
    at_start: Vec<f64>,
    at_target: Vec<f64>,
    at_end: Vec<f64>,
    at_high: Vec<f64>,
    /// True if `at_start` is valid.
    start_known: bool,
    /// Event functions at the variables evaluated last, for the current discrete states.
    functions: Vec<f64>,
    search: RootSearch,
    /// Discrete states that are not checked again in this step: `next_discrete_state` returned the same
    /// state.
    muted: Vec<bool>,
    /// Discrete states that have changed at the current instant.
    changed: Vec<bool>,
    /// States at a point of the step; only those of the last evaluation are valid.
    x: Vec<f64>,
    dimension: usize,
    /// Number of dynamic states, padded.
    leading: usize,
}

/// A group of discrete states.
#[derive(Clone, Debug)]
struct Group {
    discrete_states: Range<usize>,
    variables: Range<usize>,
    /// Ranges of the states on which the variables depend; they begin and end at multiples of [`LANES`].
    states: Vec<Range<usize>>,
    /// Fraction of the step from which on events are located.
    from: f64,
}

/// There are more events in a step than the options allow.
struct TooManyEvents;

impl EventDetector {
    pub fn new(structure: &ProblemStructure, discrete_states: Vec<u8>, capacity: usize) -> Self {
        let (dimension, leading) = (structure.dimension(), structure.padded_dynamic_states());
        let count = discrete_states.len();
        let capacity = if count == 0 { 0 } else { capacity };
        let groups: Vec<Group> = match count {
            0 => Vec::new(),
            _ => structure.event_groups.iter().map(Group::new).collect(),
        };
        let largest = groups.iter().map(|group| group.discrete_states.len()).max();
        let variables = vec![0.0; groups.last().map_or(0, |group| group.variables.end)];
        Self {
            before: discrete_states.clone(),
            discrete_states,
            events: Vec::with_capacity(capacity),
            groups,
            at_start: variables.clone(),
            at_target: variables.clone(),
            at_end: variables.clone(),
            at_high: variables.clone(),
            variables,
            start_known: false,
            functions: vec![0.0; count],
            search: RootSearch::new(largest.unwrap_or(0)),
            muted: vec![false; count],
            changed: vec![false; count],
            x: vec![0.0; dimension.next_multiple_of(LANES)],
            dimension,
            leading,
        }
    }

    /// Forgets the event variables at the time reached: the right-hand side has changed.
    pub fn forget(&mut self) {
        self.start_known = false;
    }

    /// Evaluates the event variables at the end of a step, before [`EventDetector::detect`]. A separate call:
    /// right after other functions were evaluated at the same state it may cost the problem little.
    pub fn evaluate_end<P: Problem>(&mut self, problem: &mut P, time: f64, x: &[f64]) {
        problem.event_variables(None, time, x, &mut self.at_end);
    }

    /// Locates all events in a step, after [`EventDetector::evaluate_end`].
    pub fn detect<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        maximum: usize,
        statistics: &mut Statistics,
    ) {
        self.events.clear();
        self.before.copy_from_slice(&self.discrete_states);
        self.muted.fill(false);
        for group in &mut self.groups {
            group.from = 0.0;
        }
        if self.detect_all(problem, dense, maximum).is_err() {
            statistics.events_unresolved += 1;
        }
        std::mem::swap(&mut self.at_start, &mut self.at_end);
        self.start_known = true;
        statistics.events += self.events.len() as u64;
        if self.groups.len() > 1 {
            sort_by_time(&mut self.events);
        }
    }

    fn detect_all<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        maximum: usize,
    ) -> Result<(), TooManyEvents> {
        for &to in tuning::INTERMEDIATE {
            dense.evaluate(to, &mut self.x[..self.leading]);
            let x = &self.x[..self.dimension];
            problem.event_variables(None, dense.time(to), x, &mut self.at_target);
            self.detect_up_to(problem, dense, to, maximum)?;
        }
        self.at_target.copy_from_slice(&self.at_end);
        self.detect_up_to(problem, dense, 1.0, maximum)
    }

    /// Locates the events of all groups up to a fraction of the step, whose event variables are in
    /// `at_target`.
    fn detect_up_to<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        to: f64,
        maximum: usize,
    ) -> Result<(), TooManyEvents> {
        for number in 0..self.groups.len() {
            // Several events may follow each other; each search begins at the last event.
            while self.groups[number].from <= to && self.changes_at_target(problem, number) {
                self.resolve(problem, dense, number, to, maximum)?;
            }
        }
        Ok(())
    }

    /// Evaluates the event functions of a group from the variables in `at_target`; returns whether a discrete
    /// state must change there.
    #[inline(always)]
    fn changes_at_target<P: Problem>(&mut self, problem: &mut P, number: usize) -> bool {
        let group = &self.groups[number];
        let variables = &self.at_target[group.variables.clone()];
        group.event_functions(
            problem,
            number,
            variables,
            &self.discrete_states,
            &mut self.functions,
        );
        self.must_change(number)
    }

    /// Evaluates the event variables and functions of a group at a fraction of the step.
    #[inline]
    fn evaluate<P: Problem>(&mut self, problem: &mut P, dense: &DenseOutput<'_>, number: usize, theta: f64) {
        let group = &self.groups[number];
        dense.evaluate_ranges(theta, &group.states, &mut self.x);
        let x = &self.x[..self.dimension];
        let variables = &mut self.variables[group.variables.clone()];
        problem.event_variables(Some(number), dense.time(theta), x, variables);
        group.event_functions(
            problem,
            number,
            variables,
            &self.discrete_states,
            &mut self.functions,
        );
    }

    /// Returns whether a discrete state of a group must change, by the event functions evaluated last.
    #[inline]
    fn must_change(&self, number: usize) -> bool {
        let states = self.groups[number].discrete_states.clone();
        self.functions[states.clone()]
            .iter()
            .zip(&self.muted[states])
            .any(|(function, muted)| *function <= 0.0 && !muted)
    }

    /// Locates the next event of a group up to a fraction of the step, at which a discrete state must change.
    #[inline(never)]
    fn resolve<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        number: usize,
        to: f64,
        maximum: usize,
    ) -> Result<(), TooManyEvents> {
        let resolution =
            (tuning::TIME_RESOLUTION * f64::EPSILON * dense.end.abs() / dense.step).max(tuning::RESOLUTION);
        let theta = self.locate(problem, dense, number, to, resolution);
        self.change(problem, dense.time(theta), number, maximum)?;
        // An event that leads at once to the next one is told apart by the resolution.
        self.groups[number].from = theta + resolution;
        Ok(())
    }

    /// Returns the first fraction of the step up to `to` at which a discrete state of a group must change,
    /// given that one must at `to`. Leaves the event variables there in `at_high`, and the event functions.
    fn locate<P: Problem>(
        &mut self,
        problem: &mut P,
        dense: &DenseOutput<'_>,
        number: usize,
        to: f64,
        resolution: f64,
    ) -> f64 {
        let group = &self.groups[number];
        let (states, variables, from) = (group.discrete_states.clone(), group.variables.clone(), group.from);
        let count = states.len();
        self.search.clear();
        self.search.values_mut()[..count].copy_from_slice(&self.functions[states.clone()]);
        self.search.set_high(to);
        if from == 0.0 && self.start_known {
            let start = &self.at_start[variables.clone()];
            self.variables[variables.clone()].copy_from_slice(start);
            group.event_functions(problem, number, start, &self.discrete_states, &mut self.functions);
        } else {
            self.evaluate(problem, dense, number, from);
        }
        if self.must_change(number) {
            self.at_high[variables.clone()].copy_from_slice(&self.variables[variables]);
            return from;
        }
        self.at_high[variables.clone()].copy_from_slice(&self.at_target[variables.clone()]);
        self.search.values_mut()[..count].copy_from_slice(&self.functions[states.clone()]);
        self.search.set_low(from);
        loop {
            let (low, high) = self.search.ends();
            if high - low <= resolution {
                break;
            }
            let theta = self.search.next_point(self.first_zero(number), resolution);
            self.evaluate(problem, dense, number, theta);
            self.search.values_mut()[..count].copy_from_slice(&self.functions[states.clone()]);
            if self.must_change(number) {
                self.search.set_high(theta);
                self.at_high[variables.clone()].copy_from_slice(&self.variables[variables.clone()]);
            } else {
                self.search.set_low(theta);
            }
        }
        self.functions[states].copy_from_slice(&self.search.high()[..count]);
        self.search.ends().1
    }

    /// Returns the expected time of the first zero of a group's event functions.
    fn first_zero(&self, number: usize) -> f64 {
        let muted = &self.muted[self.groups[number].discrete_states.clone()];
        let all = self.search.high().iter().zip(muted).enumerate();
        all.filter(|(_, (function, muted))| **function <= 0.0 && !**muted)
            .map(|(index, _)| self.search.zero(index))
            .fold(f64::INFINITY, f64::min)
    }

    /// Changes all discrete states of a group that must change at an instant, each once, by the event
    /// variables in `at_high` and the event functions there.
    fn change<P: Problem>(
        &mut self,
        problem: &mut P,
        time: f64,
        number: usize,
        maximum: usize,
    ) -> Result<(), TooManyEvents> {
        let group = &self.groups[number];
        let states = group.discrete_states.clone();
        let variables = &self.at_high[group.variables.clone()];
        self.changed[states.clone()].fill(false);
        while let Some(index) = states
            .clone()
            .find(|&i| self.functions[i] <= 0.0 && !self.muted[i] && !self.changed[i])
        {
            if self.events.len() >= maximum {
                return Err(TooManyEvents);
            }
            let from = self.discrete_states[index];
            let to = problem.next_discrete_state(number, variables, index - states.start, from);
            if to == from {
                self.muted[index] = true;
                continue;
            }
            self.changed[index] = true;
            self.discrete_states[index] = to;
            self.events.push(Event {
                time,
                index,
                from,
                to,
            });
            // The event functions of other discrete states may depend on this one.
            group.event_functions(
                problem,
                number,
                variables,
                &self.discrete_states,
                &mut self.functions,
            );
        }
        Ok(())
    }
}

impl Group {
    fn new(group: &EventGroup) -> Self {
        let mut states: Vec<Range<usize>> = Vec::with_capacity(group.states.len());
        for range in &group.states {
            let start = range.start / LANES * LANES;
            let end = range.end.next_multiple_of(LANES);
            match states.last_mut() {
                Some(last) if last.start <= start && start <= last.end => last.end = last.end.max(end),
                _ => states.push(start..end),
            }
        }
        Self {
            discrete_states: group.discrete_states.clone(),
            variables: group.variables.clone(),
            states,
            from: 0.0,
        }
    }

    /// Writes the event functions of this group to their place among those of all groups.
    #[inline]
    fn event_functions<P: Problem>(
        &self,
        problem: &mut P,
        number: usize,
        variables: &[f64],
        discrete_states: &[u8],
        functions: &mut [f64],
    ) {
        let states = self.discrete_states.clone();
        problem.event_functions(
            number,
            variables,
            &discrete_states[states.clone()],
            &mut functions[states],
        );
    }
}

/// Sorts the events of all groups by time, those of the same instant in their order. (Few are out of order.)
fn sort_by_time(events: &mut [Event]) {
    for end in 1..events.len() {
        let mut at = end;
        while at > 0 && events[at - 1].time > events[at].time {
            events.swap(at - 1, at);
            at -= 1;
        }
    }
}

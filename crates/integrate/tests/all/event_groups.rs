//! Discrete states in groups: location of events, and its cost.

use std::f64::consts::PI;

use integrate::{Event, EventGroup, Integrator, Options, Problem, ProblemStructure};

use numerics::Singular;

/// x_i = sin(ω_i t), each a state of its own, with a discrete state that goes to 1 above a half and back
/// below its negative.
#[derive(Clone)]
struct Waves {
    frequencies: Vec<f64>,
    scales: Vec<f64>,
    grouped: bool,
    /// Number of event variables computed for all groups at once, and for single groups.
    together: usize,
    alone: usize,
}

const TOP: f64 = 0.5;

impl Waves {
    fn new(count: usize, grouped: bool) -> Self {
        Self {
            frequencies: (0..count).map(|i| 1.0 + 0.013 * i as f64).collect(),
            scales: vec![1.0; count],
            grouped,
            together: 0,
            alone: 0,
        }
    }

    /// Returns the events of a discrete state up to a time, by the inverse of the sine.
    fn exact(&self, index: usize, end: f64) -> Vec<Event> {
        let frequency = self.frequencies[index];
        let phases = (0_i32..).map(|half| f64::from(half) * PI + libm::asin(TOP));
        let times = phases
            .map(|phase| phase / frequency)
            .take_while(|time| *time < end);
        let event = |(number, time): (usize, f64)| Event {
            time,
            index,
            from: (number % 2) as u8,
            to: 1 - (number % 2) as u8,
        };
        times.enumerate().map(event).collect()
    }
}

/// Returns the event function of a discrete state.
fn event_function(state: u8, x: f64) -> f64 {
    if state == 0 { TOP - x } else { TOP + x }
}

impl Problem for Waves {
    fn structure(&self) -> ProblemStructure {
        let count = self.frequencies.len();
        let group = |range: std::ops::Range<usize>| EventGroup {
            discrete_states: range.clone(),
            variables: range.clone(),
            states: vec![range],
        };
        ProblemStructure {
            event_groups: if self.grouped {
                (0..count).map(|i| group(i..i + 1)).collect()
            } else {
                vec![group(0..count)]
            },
            ..ProblemStructure::new(vec![1.0; count])
        }
    }
    fn derivative(&mut self, time: f64, _: &[f64], dx: &mut [f64]) {
        for (dx, frequency) in dx.iter_mut().zip(&self.frequencies) {
            *dx = frequency * libm::cos(frequency * time);
        }
    }
    fn linearize(&mut self, time: f64, _: &[f64], _: &[f64], df_dt: &mut [f64]) {
        for (rate, frequency) in df_dt.iter_mut().zip(&self.frequencies) {
            *rate = -frequency * frequency * libm::sin(frequency * time);
        }
    }
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.scales.fill(shift);
        Ok(())
    }
    fn solve(&mut self, b: &mut [f64]) {
        for (value, shift) in b.iter_mut().zip(&self.scales) {
            *value /= shift;
        }
    }
    fn event_variables(&mut self, group: Option<usize>, _: f64, x: &[f64], variables: &mut [f64]) {
        match group {
            Some(group) if self.grouped => {
                self.alone += 1;
                variables[0] = x[group];
            }
            _ => {
                self.together += variables.len();
                variables.copy_from_slice(x);
            }
        }
    }
    fn event_functions(&mut self, _: usize, variables: &[f64], states: &[u8], functions: &mut [f64]) {
        for ((function, state), variable) in functions.iter_mut().zip(states).zip(variables) {
            *function = event_function(*state, *variable);
        }
    }
    fn next_discrete_state(&mut self, _: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        assert!(
            event_function(state, variables[index]) <= 0.0,
            "called although the state lasts"
        );
        1 - state
    }
}

const END: f64 = 20.0;

/// Returns all changes, and what was computed.
fn run(count: usize, grouped: bool) -> (Vec<Event>, Waves) {
    let options = Options {
        fixed_step: Some(0.05),
        ..Options::default()
    };
    let start = vec![0.0; count];
    let mut integrator = Integrator::new(Waves::new(count, grouped), options, 0.0, &start).unwrap();
    let mut events = Vec::new();
    while integrator.time() < END {
        integrator.step_to(END).unwrap();
        assert!(integrator.events().is_sorted_by(|a, b| a.time <= b.time));
        events.extend_from_slice(integrator.events());
    }
    assert_eq!(integrator.statistics().events, events.len() as u64);
    assert_eq!(integrator.statistics().events_unresolved, 0);
    (events, integrator.problem().clone())
}

#[test]
fn analytic_events_of_many_discrete_states_are_located_group_by_group() {
    for grouped in [true, false] {
        let (found, waves) = run(40, grouped);
        let mut expected: Vec<Event> = (0..40).flat_map(|i| waves.exact(i, END)).collect();
        expected.sort_by(|a, b| a.time.total_cmp(&b.time));
        assert_eq!(found.len(), expected.len());
        assert!(found.len() > 200);
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(
                (found.index, found.from, found.to),
                (expected.index, expected.from, expected.to)
            );
            assert!(
                (found.time - expected.time).abs() < 1e-9,
                "{found:?}, exactly {expected:?}"
            );
        }
    }
}

#[test]
fn limits_the_cost_of_an_event_does_not_depend_on_the_number_of_groups() {
    let cost = |count: usize, grouped: bool| {
        let (events, waves) = run(count, grouped);
        let sweeps = waves.together as f64 / count as f64;
        (sweeps, waves.alone as f64 / events.len() as f64)
    };
    let ((few_sweeps, few), (many_sweeps, many)) = (cost(5, true), cost(80, true));
    assert!(
        few_sweeps == many_sweeps,
        "{few_sweeps} and {many_sweeps} evaluations of all"
    );
    assert!(few < 12.0 && many < 12.0, "{few} and {many} variables an event");
    assert!(many < 1.2 * few, "{few} and {many} variables an event");
    // Without groups each event evaluates all.
    let (together, _) = cost(80, false);
    assert!(
        together > 4.0 * many_sweeps,
        "{together} and {many_sweeps} evaluations of all"
    );
}

#[test]
fn steps_and_states_are_the_same_if_events_are_not_recorded() {
    let run = |record_events: bool| {
        let options = Options {
            record_events,
            relative_tolerance: 1e-8,
            ..Options::default()
        };
        let mut integrator = Integrator::new(Waves::new(5, true), options, 0.0, &[0.0; 5]).unwrap();
        while integrator.time() < 10.0 {
            integrator.step_to(10.0).unwrap();
            assert_eq!(
                integrator.discrete_states().len(),
                if record_events { 5 } else { 0 }
            );
            assert!(record_events || integrator.events().is_empty());
        }
        (integrator.x().to_vec(), integrator.state())
    };
    let ((x, recorded), (same, bare)) = (run(true), run(false));
    assert_eq!(x, same);
    assert_eq!(recorded.statistics.steps, bare.statistics.steps);
    assert_eq!(bare.statistics.events, 0);
    assert!(recorded.statistics.events > 10);
    // A state without discrete states does not continue a run that records them.
    assert!(Integrator::resume(Waves::new(5, true), Options::default(), bare).is_err());
}

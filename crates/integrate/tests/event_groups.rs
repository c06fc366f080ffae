//! Switches in groups: what is found of many, and what that costs.

#![allow(clippy::unwrap_used)] // it may stop where it stands

use std::f64::consts::PI;

use integrate::{Event, EventGroup, Integrator, Options, Problem, Singular};

/// x_i = sin(ω_i t), each a state of its own, with a switch that goes to 1 above a half and back below its
/// negative.
#[derive(Clone)]
struct Waves {
    frequencies: Vec<f64>,
    scales: Vec<f64>,
    grouped: bool,
    /// How many signs were computed for all switches at once, and for single groups.
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

    /// The changes of a switch up to a time, by the inverse of the sine.
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

/// The margin of a switch.
fn margin(mode: u8, x: f64) -> f64 {
    if mode == 0 { TOP - x } else { TOP + x }
}

impl Problem for Waves {
    fn dimension(&self) -> usize {
        self.frequencies.len()
    }
    fn scales(&self) -> &[f64] {
        &self.scales
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
    fn discrete_state_count(&self) -> usize {
        self.dimension()
    }
    fn event_variable_count(&self) -> usize {
        self.dimension()
    }
    fn event_variables(&mut self, _: f64, x: &[f64], signs: &mut [f64]) {
        self.together += signs.len();
        signs.copy_from_slice(x);
    }
    fn event_groups(&self) -> Vec<EventGroup> {
        let count = self.dimension();
        let group = |range: std::ops::Range<usize>| EventGroup {
            discrete_states: range.clone(),
            variables: range.clone(),
            states: vec![range],
        };
        if self.grouped {
            (0..count).map(|i| group(i..i + 1)).collect()
        } else {
            vec![group(0..count)]
        }
    }
    fn group_event_variables(&mut self, group: usize, time: f64, x: &[f64], signs: &mut [f64]) {
        if self.grouped {
            self.alone += 1;
            signs[0] = x[group];
        } else {
            self.event_variables(time, x, signs);
        }
    }
    fn group_event_functions(&mut self, _: usize, signs: &[f64], modes: &[u8], margins: &mut [f64]) {
        for ((margin_of, mode), sign) in margins.iter_mut().zip(modes).zip(signs) {
            *margin_of = margin(*mode, *sign);
        }
    }
    fn next_discrete_state(&mut self, _: usize, signs: &[f64], index: usize, mode: u8) -> u8 {
        assert!(
            margin(mode, signs[index]) <= 0.0,
            "asked where the switch is to stay"
        );
        1 - mode
    }
}

const END: f64 = 20.0;

/// All changes, and what was computed.
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
fn analytic_changes_of_many_switches_are_found_group_by_group() {
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
fn limits_the_cost_of_a_change_does_not_depend_on_the_number_of_groups() {
    let cost = |count: usize, grouped: bool| {
        let (events, waves) = run(count, grouped);
        let looks = waves.together as f64 / count as f64;
        (looks, waves.alone as f64 / events.len() as f64)
    };
    let ((few_looks, few), (many_looks, many)) = (cost(5, true), cost(80, true));
    assert!(
        few_looks == many_looks,
        "{few_looks} and {many_looks} looks at all"
    );
    assert!(few < 12.0 && many < 12.0, "{few} and {many} signs a change");
    assert!(many < 1.2 * few, "{few} and {many} signs a change");
    // Without groups each change looks at all.
    let (together, _) = cost(80, false);
    assert!(
        together > 4.0 * many_looks,
        "{together} and {many_looks} looks at all"
    );
}

#[test]
fn nothing_but_events_is_missing_where_switches_are_not_recorded() {
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
    // A state without modes does not continue a run that records them.
    assert!(Integrator::resume(Waves::new(5, true), Options::default(), bare).is_err());
}

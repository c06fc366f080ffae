//! limits: runs side by side have the bits of each run alone, whoever is beside them, also beside runs that fail.
#![allow(missing_docs, clippy::unwrap_used)]

use integrate::{
    Call, Integrator, Method, OneByOne, Options, Ordinary, Progress, Reason, StepError, Team, Together,
};

/// What a run is: its problem, options, start, end, and how often its steps must stop.
struct Plan {
    problem: fn() -> Ordinary<'static>,
    options: Options,
    start: Vec<f64>,
    end: f64,
    every: f64,
}

/// All that a run shows, as bits and text.
#[derive(Clone, Debug, Default, PartialEq)]
struct Trace {
    steps: Vec<Vec<u64>>,
    events: Vec<String>,
    end: String,
}

impl Plan {
    fn begin(&self) -> Integrator<Ordinary<'static>> {
        Integrator::new((self.problem)(), self.options.clone(), 0.0, &self.start).unwrap()
    }

    fn limit(&self, integrator: &Integrator<Ordinary<'_>>) -> f64 {
        let next = (integrator.time() / self.every).floor() + 1.0;
        self.end.min(next * self.every)
    }

    /// Notes a step; whether the run is over.
    fn note(
        &self,
        trace: &mut Trace,
        run: &mut Integrator<Ordinary<'_>>,
        outcome: Result<(), StepError>,
    ) -> bool {
        let failed = outcome.is_err();
        if !failed {
            let mut middle = run.x().to_vec();
            run.interpolate(0.5 * (run.previous_time() + run.time()), &mut middle);
            let values = [run.time()];
            let values = values
                .iter()
                .chain(run.x())
                .chain(run.derivative())
                .chain(&middle);
            trace.steps.push(values.map(|value| value.to_bits()).collect());
            trace
                .events
                .extend(run.events().iter().map(|event| format!("{event:?}")));
        }
        let over = failed || run.time() >= self.end;
        if over {
            trace.end = format!("{outcome:?} {:?} {:?}", run.statistics(), run.state());
        }
        over
    }

    fn alone(&self) -> Trace {
        let mut run = self.begin();
        let mut trace = Trace::default();
        loop {
            let outcome = run.step_to(self.limit(&run));
            if self.note(&mut trace, &mut run, outcome) {
                return trace;
            }
        }
    }
}

/// A mass shaken across a rough floor, with thin layers and switches.
fn rough() -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0, 1.0],
        |t, x, dx| {
            let grip = libm::tanh(x[0] / 1e-5);
            dx[0] = 3.0 * libm::sin(5.0 * t) - grip;
            dx[1] = grip * x[0];
        },
        |_, x, j| {
            let grip = libm::tanh(x[0] / 1e-5);
            let slope = (1.0 - grip * grip) / 1e-5;
            j.copy_from_slice(&[-slope, 0.0, slope * x[0] + grip, 0.0]);
        },
    )
    .time_derivative(|t, _, df_dt| df_dt[0] = 15.0 * libm::cos(5.0 * t))
    .kinks(0, 1, |_, x, signs| signs.directions[0] = [x[0] / 1e-5, 0.0])
    .layer_bounds(vec![1e-5, f64::INFINITY])
    .switches(
        1,
        |_, x, modes| modes[0] = u8::from(x[0] < 0.0),
        |_, x, modes, margins| margins[0] = if modes[0] == 0 { x[0] } else { -x[0] } + 1e-7,
        |_, _, _, mode| 1 - mode,
    )
}

/// A mass that falls on a spring, without a word about kinks or stiffness.
fn fall() -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0, 5.0],
        |_, x, dx| {
            dx[0] = x[1];
            dx[1] = -9.81 - 250_000.0 * x[0].min(0.0);
        },
        |_, x, j| j.copy_from_slice(&[0.0, 1.0, if x[0] < 0.0 { -250_000.0 } else { 0.0 }, 0.0]),
    )
}

/// Explicitly while it flies.
fn bounce() -> Ordinary<'static> {
    fall()
        .kinks(1, 0, |_, x, signs| signs.values[0] = x[0])
        .stiffness(|_, x| if x[0] < 0.0 { 500.0 } else { 1.0 })
}

/// Explicit steps that get across kinks, which nobody tells.
fn blind_bounce() -> Ordinary<'static> {
    fall().stiffness(|_, _| 1.0)
}

/// Five states with jumps of the right-hand side in time.
fn jumps() -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0; 5],
        |t, x, dx| {
            let push = if t <= 0.3 {
                1.0
            } else if t <= 1.1 {
                -2.0
            } else {
                0.5
            };
            for i in 0..5 {
                dx[i] = push - libm::pow(10.0, i as f64) * x[i];
            }
        },
        |_, _, j| (0..5).for_each(|i| j[6 * i] = -libm::pow(10.0, i as f64)),
    )
    .breaks(vec![0.3, 1.1])
}

/// It has no value below zero, where it goes.
fn falls_out() -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0; 2],
        |_, x, dx| {
            dx[0] = -x[0].sqrt() - 1.0;
            dx[1] = -x[1];
        },
        |_, x, j| {
            j[0] = -0.5 / x[0].sqrt();
            j[3] = -1.0;
        },
    )
}

/// The same, where its explicit steps are taken.
fn falls_out_explicitly() -> Ordinary<'static> {
    falls_out().stiffness(|_, _| 1.0)
}

/// It comes to infinity at time 1.
fn blows_up() -> Ordinary<'static> {
    Ordinary::new(
        vec![1.0],
        |_, x, dx| dx[0] = x[0] * x[0],
        |_, x, j| j[0] = 2.0 * x[0],
    )
}

fn plans() -> Vec<Plan> {
    type Kind = (fn() -> Ordinary<'static>, Vec<f64>, f64);
    let kinds: [Kind; 7] = [
        (rough, vec![0.0, 0.0], 4.0),
        (bounce, vec![0.5, 0.0], 1.5),
        (falls_out, vec![1.0, 1.0], 3.0),
        (blind_bounce, vec![0.5, 0.0], 1.5),
        (jumps, vec![1.0; 5], 2.0),
        (blows_up, vec![1.0], 2.0),
        (falls_out_explicitly, vec![1.0, 1.0], 3.0),
    ];
    let mut plans = Vec::new();
    for (number, method) in Method::ALL.into_iter().enumerate() {
        for (kind, (problem, start, end)) in kinds.iter().enumerate() {
            let options = Options {
                method,
                relative_tolerance: [1e-3, 1e-5, 1e-7][(number + kind) % 3],
                explicit_steps: (number + kind) % 4 != 3,
                maximum_steps: if (number, kind) == (3, 0) { 20 } else { 100_000 },
                fixed_step: ((number + kind) % 6 == 5).then_some(0.01),
                ..Options::default()
            };
            plans.push(Plan {
                problem: *problem,
                options,
                start: start.clone(),
                end: *end,
                every: [f64::INFINITY, 0.37, 0.05][(2 * number + kind) % 3],
            });
        }
    }
    plans
}

/// Evaluates one after the other from the last, and counts how many it gets at once.
struct Counting {
    places: usize,
    calls: Vec<usize>,
}

impl Together for Counting {
    type Problem = Ordinary<'static>;

    fn places(&self) -> usize {
        self.places
    }

    fn put(&mut self, place: usize, _: &Ordinary<'static>) {
        assert!(place < self.places);
    }

    fn derivatives(&mut self, calls: &mut [Option<Call<'_, Ordinary<'static>>>]) {
        assert_eq!(calls.len(), self.places);
        self.calls.push(calls.iter().flatten().count());
        for call in calls.iter_mut().rev().flatten() {
            call.evaluate();
        }
    }
}

/// Runs all plans in a team; `moves`: after how many steps a run changes its place.
fn in_team<T: Together<Problem = Ordinary<'static>>>(
    plans: &[Plan],
    team: &mut Team<T>,
    moves: usize,
) -> Vec<Trace> {
    let mut traces = vec![Trace::default(); plans.len()];
    let mut queue: Vec<_> = (0..plans.len())
        .rev()
        .map(|plan| (plan, plans[plan].begin()))
        .collect();
    let mut at = [usize::MAX; 8];
    let mut steps = 0;
    loop {
        while let Some(place) = team.free_place()
            && let Some((plan, run)) = queue.pop()
        {
            let limit = plans[plan].limit(&run);
            team.put(place, run, limit);
            at[place] = plan;
        }
        let Some((place, outcome)) = team.step() else {
            return traces;
        };
        let (plan, run) = (at[place], team.run(place).unwrap());
        steps += 1;
        if plans[plan].note(&mut traces[plan], run, outcome) {
            team.take(place).unwrap();
        } else if steps % moves == 0 {
            // Others come before it goes on.
            let run = team.take(place).unwrap();
            queue.insert(0, (plan, run));
        } else {
            let limit = plans[plan].limit(run);
            team.begin(place, limit);
        }
    }
}

#[test]
fn limits_a_run_in_a_team_has_the_bits_of_the_run_alone() {
    let plans = plans();
    let alone: Vec<Trace> = plans.iter().map(Plan::alone).collect();
    let seen = |word: &str| alone.iter().filter(|trace| trace.end.contains(word)).count();
    for (word, least) in [
        ("Ok(())", 12),
        ("NotFinite", 6),
        ("reason: Error", 3),
        ("MaximumSteps", 1),
    ] {
        assert!(seen(word) >= least, "{word}: {}", seen(word));
    }
    assert!(alone.iter().any(|trace| trace.events.len() > 3));
    for (places, moves) in [(1, usize::MAX), (2, 7), (4, usize::MAX), (4, 11), (8, 3)] {
        let mut team = Team::new(OneByOne::new(places));
        let found = in_team(&plans, &mut team, moves);
        for (number, (found, alone)) in found.iter().zip(&alone).enumerate() {
            assert!(
                found == alone,
                "plan {number} in a team of {places}: {}",
                found.end
            );
        }
    }
}

#[test]
fn limits_a_team_asks_for_all_at_once() {
    let plans = plans();
    let plans = &plans[..12];
    let mut team = Team::new(Counting {
        places: 4,
        calls: Vec::new(),
    });
    let found = in_team(plans, &mut team, usize::MAX);
    assert!(
        found
            .iter()
            .zip(plans)
            .all(|(found, plan)| *found == plan.alone())
    );
    // All places are full until no run is left to come; then they become empty one after the other.
    let calls = &team.together().calls;
    assert!(calls.is_sorted_by(|a, b| a >= b));
    assert!(calls.iter().filter(|count| **count == 4).count() > calls.len() / 2);
}

#[test]
fn limits_more_places_than_a_team_has_are_not_used() {
    let mut team = Team::new(OneByOne::<Ordinary<'_>>::new(100));
    assert!(team.run(7).is_none() && team.run(8).is_none());
    assert_eq!(team.free_place(), Some(0));
    let mut nobody = Team::new(OneByOne::<Ordinary<'_>>::new(0));
    assert_eq!((nobody.free_place(), nobody.step()), (None, None));
}

#[test]
fn input_a_step_that_cannot_begin_is_told_by_the_next_step_of_the_team() {
    let plans = plans();
    let mut team = Team::new(OneByOne::new(2));
    team.put(0, plans[0].begin(), 1.0);
    team.put(1, plans[1].begin(), -1.0);
    let mut failed = 0;
    for _ in 0..10 {
        match team.step() {
            Some((0, outcome)) => {
                outcome.unwrap();
                team.begin(0, 1.0);
            }
            Some((place, outcome)) => {
                assert_eq!(place, 1);
                assert_eq!(outcome.unwrap_err().reason, Reason::Limit { limit: -1.0 });
                failed += 1;
            }
            None => unreachable!(),
        }
    }
    assert_eq!(failed, 1);
    // It can still be taken out.
    assert_eq!(team.take(1).unwrap().time(), 0.0);
    assert!(team.take(1).is_none());
}

#[test]
fn limits_a_step_dropped_on_its_way_is_made_anew() {
    for plan in plans().iter().take(2) {
        let (mut run, mut other) = (plan.begin(), plan.begin());
        let mut dropped = 0;
        while run.time() < plan.end {
            if other.begin_step(plan.end).is_ok() {
                for _ in 0..dropped % 4 {
                    if other.go_on() == Ok(Progress::Wants) {
                        other.wanted().evaluate();
                    }
                }
            }
            // Before anything was accepted.
            assert_eq!(run.time(), other.time());
            run.step_to(plan.end).unwrap();
            other.step_to(plan.end).unwrap();
            assert_eq!(run.x(), other.x());
            dropped += 1;
        }
        assert!(dropped > 20, "{dropped} steps");
    }
}

#[test]
fn input_without_a_step_begun_nothing_goes_on() {
    let plan = &plans()[0];
    let mut run = plan.begin();
    assert_eq!(run.go_on(), Ok(Progress::Accepted));
    assert_eq!((run.time(), run.statistics().steps), (0.0, 0));
}

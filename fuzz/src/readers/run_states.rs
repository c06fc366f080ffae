//! Saved states of runs of every model, as `wedgelab run --continue` reads them. What is accepted goes on for
//! a few steps, and can be saved and continued again.

use std::fmt::Debug;

use study::result::RunResult;
use study::run::{Recorder, Run, RunCase, saved};

use super::states::DICTIONARY;
use super::{ReadOutcome, Reader, models, refused_as_written};

/// Steps of the integrator that are made from a state, or from the start.
const STEPS: usize = 3;

/// The reader of the saved states of a model: its name, what it is about, and its case.
macro_rules! reader {
    ($constant:ident, $name:literal, $of:literal, $case:path) => {
        #[doc = concat!("Saved states of ", $of, ".")]
        pub const $constant: Reader = Reader {
            name: $name,
            about: concat!(
                "saved states of ",
                $of,
                ", and three steps of the integrator from there"
            ),
            corpus: || $case().map_or_else(Vec::new, corpus),
            dictionary: DICTIONARY,
            read: |input| $case().map_or(ReadOutcome::NO_TEXT, |case| read(case, input)),
        };
    };
}

reader!(WEDGES, "run_states", "runs of wedges", models::wedge);
reader!(TRUCKS, "truck_states", "runs of trucks", models::truck);
reader!(
    HALF_TRUCKS,
    "half_truck_states",
    "runs of half-trucks",
    models::half_truck
);
reader!(CARS, "car_states", "runs of cars", models::car);
reader!(
    WHEELSETS,
    "wheelset_states",
    "runs of wheelsets",
    models::wheelset
);

/// States along a run, each in its file. The files have the name of the case in place of its text, so that
/// what is mutated is the state.
fn corpus<C: RunCase>(case: &C) -> Vec<Vec<u8>> {
    let mut states = Vec::new();
    let Ok(mut run) = Run::new(case) else {
        return states;
    };
    for _ in 0..=STEPS {
        states.extend(saved::to_bytes(case.name(), &run.state()));
        for _ in 0..10 {
            if run.is_finished() || run.advance().is_err() {
                return states;
            }
        }
    }
    states
}

fn read<C, S>(case: &C, input: &[u8]) -> ReadOutcome
where
    C: RunCase<Output = RunResult<S>>,
    <C::Recorder as Recorder>::Counts: Debug,
{
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let state = match saved::parse::<C>("state.json", text, case.name()) {
        Ok(state) => state,
        Err(error) => return ReadOutcome::refused(&error),
    };
    match Run::resume(case, state) {
        Ok(run) => advanced(run, |run| saved_again(case, run)),
        Err(error) => ReadOutcome::refused_with(&error.to_string()),
    }
}

/// Makes a few steps; `unless_stopped` looks at the run that made them. Its rows are finite.
pub(super) fn advanced<C, S>(mut run: Run<C>, unless_stopped: impl FnOnce(&Run<C>)) -> ReadOutcome
where
    C: RunCase<Output = RunResult<S>>,
{
    let mut all = ReadOutcome::ACCEPTED;
    for _ in 0..STEPS {
        if run.is_finished() {
            break;
        }
        if let Err(error) = run.advance() {
            all = all.or(ReadOutcome::refused_with(&error.to_string()));
            break;
        }
    }
    if all.message == 0 {
        unless_stopped(&run);
    }
    let result = run.result(None);
    let mut values = result.values.iter().flatten();
    assert!(values.all(|value| value.is_finite()), "not finite: in a row");
    all
}

/// What goes on can be saved, and goes on from there.
fn saved_again<C: RunCase>(case: &C, run: &Run<C>) {
    let state = run.state();
    let text = saved::to_bytes(case.name(), &state).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    match saved::parse::<C>("again.json", &text, case.name()) {
        Ok(again) => assert!(again == state, "another state: {}", case.name()),
        Err(error) => refused_as_written(&error),
    }
    if let Err(error) = Run::resume(case, state) {
        refused_as_written(&error);
    }
}

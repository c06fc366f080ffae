//! Saved states: of driven wedges, of instances of FMUs. What is accepted goes on for a few steps.

use std::sync::LazyLock;

use fmi::description::Version;
use fmi::element::Interface;
use fmi::half_truck::HalfTruck;
use fmi::instance::{Instance, Saved};
use fmi::source::{FmuModel, Source};
use serde::Deserialize;
use study::half_truck::files::Settings;
use study::progress::most_attempts;
use study::stepping::{Neighbours, SteppedState, SteppedWedge};

use super::{ReadOutcome, Reader, models};

/// States of driven wedges.
pub const DRIVEN: Reader = Reader {
    name: "driven_states",
    about: "saved states of driven wedges, and three steps from there",
    corpus: driven_corpus,
    dictionary: DICTIONARY,
    read: driven,
};

/// States of instances of FMUs.
pub const INSTANCES: Reader = Reader {
    name: "instances",
    about: "saved states of FMUs, and three steps from there",
    corpus: instance_corpus,
    dictionary: DICTIONARY,
    read: instance,
};

pub(super) const DICTIONARY: &[&[u8]] = &[
    b"null",
    b"true",
    b"false",
    b"[]",
    b"{}",
    b"\"version\":1",
    b"\"time\":",
    b"\"x\":",
    b"\"discrete_states\":",
    b"\"proposed_step\":",
    b"\"interval_start\":",
    b"\"next_row\":",
    b"\"statistics\":",
    b"18446744073709551615",
    b"-1",
    b"1e308",
    b"5e-324",
    b"0.0",
    b"255",
    b"\"zone_step\"",
    b"\\ud800",
];

/// Steps that are made from a state.
const STEPS: usize = 3;
/// Most attempts of one step of the integrator: each halves it at least, down to the resolution of time.
const ATTEMPTS_OF_A_STEP: u64 = 60;
/// Length of a driven step, s.
const STEP: f64 = 1e-3;

fn driven_corpus() -> Vec<Vec<u8>> {
    let Some(case) = models::wedge() else {
        return Vec::new();
    };
    let mut states = Vec::new();
    let Ok(mut wedge) = SteppedWedge::new(case) else {
        return states;
    };
    for number in 0..=STEPS {
        let time = number as f64 * STEP;
        if number > 0
            && wedge
                .step_to(&Neighbours::of(&case.parameters, time), time)
                .is_err()
        {
            break;
        }
        states.extend(wedge.state().to_bytes());
    }
    states
}

fn driven(input: &[u8]) -> ReadOutcome {
    let Some(case) = models::wedge() else {
        return ReadOutcome::NO_TEXT;
    };
    let state = match SteppedState::from_bytes(input) {
        Ok(state) => state,
        Err(error) => return ReadOutcome::refused_with(&error.to_string()),
    };
    let Ok(mut wedge) = SteppedWedge::new(case) else {
        return ReadOutcome::NO_TEXT;
    };
    let before = wedge.state();
    if let Err(error) = wedge.restore(&state) {
        assert!(wedge.state() == before, "changed although refused: {error}");
        return ReadOutcome::refused_with(&error.to_string());
    }
    let mut all = ReadOutcome::ACCEPTED;
    for _ in 0..STEPS {
        let (time, before) = (wedge.time() + STEP, attempts(&wedge));
        let stepped = wedge.step_to(&Neighbours::of(&case.parameters, time), time);
        let took = attempts(&wedge).saturating_sub(before);
        // The step that exceeds the number is made, with the attempts that it takes.
        assert!(
            took <= most_attempts(STEP) + ATTEMPTS_OF_A_STEP,
            "too many attempts: {took}"
        );
        all.attempts += took;
        if let Err(error) = stepped {
            all = all.or(ReadOutcome::refused_with(&error.to_string()));
            break;
        }
        let _ = wedge.reading();
        let _ = wedge.row();
    }
    assert!(wedge.state().to_bytes().is_ok(), "no bytes: of a state");
    all
}

/// Returns the attempted steps of a wedge's integrator so far.
fn attempts(wedge: &SteppedWedge) -> u64 {
    let statistics = wedge.statistics();
    statistics.steps + statistics.rejected()
}

/// The FMUs whose states are read.
const MODELS: [(FmuModel, Version, Interface); 5] = [
    (FmuModel::Wedge, Version::Two, Interface::CoSimulation),
    (FmuModel::Wedge, Version::Three, Interface::ModelExchange),
    (FmuModel::QuasiStatic, Version::Two, Interface::CoSimulation),
    (FmuModel::Truck, Version::Two, Interface::CoSimulation),
    // An integration that hardly progresses takes longer here than an execution may: the attempts that the
    // rule of all runs admits cost five times those of a wedge.
    (FmuModel::HalfTruck, Version::Three, Interface::ModelExchange),
];

/// A half-truck whose states are read.
static HALF_TRUCK: LazyLock<Option<HalfTruck>> =
    LazyLock::new(|| HalfTruck::built_in("nucars_69_constant_toe_out", &Settings::default()).ok());

/// Returns a new instance.
fn new_instance(place: usize) -> Option<Instance> {
    let (model, version, interface) = MODELS[place];
    let source = match model {
        FmuModel::HalfTruck => Source::HalfTruck(Box::new(HALF_TRUCK.as_ref()?.clone())),
        _ => Source::of_case(model, models::wedge()?.clone())?,
    };
    Instance::of("fuzz", None, source, version, interface).ok()
}

/// Returns an instance after its first steps.
fn started_instance(place: usize) -> Option<Instance> {
    let mut instance = new_instance(place)?;
    instance.set_experiment(0.0, None, None).ok()?;
    instance.enter_initialization().ok()?;
    instance.exit_initialization().ok()?;
    Some(instance)
}

fn instance_corpus() -> Vec<Vec<u8>> {
    let mut states = Vec::new();
    for place in 0..MODELS.len() {
        let fresh = new_instance(place);
        states.extend(fresh.and_then(|instance| instance.save().to_bytes().ok()));
        let Some(mut instance) = started_instance(place) else {
            continue;
        };
        states.extend(instance.save().to_bytes());
        if instance.interface() == Interface::CoSimulation && instance.do_step(0.0, STEP).is_ok() {
            states.extend(instance.save().to_bytes());
        }
    }
    states
}

fn instance(input: &[u8]) -> ReadOutcome {
    let saved = match Saved::from_bytes(input) {
        Ok(saved) => saved,
        Err(error) => return ReadOutcome::refused_with(&error.to_string()),
    };
    // That of another FMU is refused by its token; which one this is may be seen in the text.
    let place = TOKENS.iter().position(|token| *token == token_of(input));
    match new_instance(place.unwrap_or(0)) {
        Some(instance) => restore(instance, &saved),
        None => ReadOutcome::NO_TEXT,
    }
}

/// The marks that distinguish the FMUs: token and kind of interface.
static TOKENS: LazyLock<Vec<Option<[String; 2]>>> = LazyLock::new(|| {
    let saved = (0..MODELS.len()).map(|place| new_instance(place)?.save().to_bytes().ok());
    saved.map(|bytes| token_of(&bytes?)).collect()
});

/// Token and kind of interface of a saved state.
fn token_of(saved: &[u8]) -> Option<[String; 2]> {
    #[derive(Deserialize)]
    struct Head {
        token: String,
        interface: String,
    }
    let head: Head = serde_json::from_slice(saved).ok()?;
    Some([head.token, head.interface])
}

fn restore(mut instance: Instance, saved: &Saved) -> ReadOutcome {
    let before = instance.save();
    if let Err(error) = instance.restore(saved) {
        assert!(instance.save() == before, "changed although refused: {error}");
        return ReadOutcome::refused_with(&error.to_string());
    }
    let mut all = ReadOutcome::ACCEPTED;
    for _ in 0..STEPS {
        if instance.interface() == Interface::CoSimulation {
            all.attempts += most_attempts(STEP);
        }
        if let Err(error) = go_on(&mut instance) {
            all = all.or(ReadOutcome::refused_with(&error));
            break;
        }
    }
    for reference in 0..instance.description().variables.len() {
        let _ = instance.get_float(reference as u32);
    }
    assert!(instance.save().to_bytes().is_ok(), "no bytes: of a state");
    all
}

/// Makes a step, or the calls of an importer's solver.
fn go_on(instance: &mut Instance) -> Result<(), String> {
    let text = |error: fmi::Error| error.to_string();
    let time = instance.time();
    if instance.interface() == Interface::CoSimulation {
        return instance.do_step(time, STEP).map_err(text);
    }
    let mut states = vec![0.0; instance.description().entries.states.len()];
    let mut rates = states.clone();
    instance.enter_continuous_time_mode().map_err(text)?;
    instance.states(&mut states).map_err(text)?;
    instance.rates(&mut rates).map_err(text)?;
    instance.set_time(time + STEP).map_err(text)?;
    instance.set_states(&states).map_err(text)?;
    instance.enter_event_mode().map_err(text)?;
    instance.update_discrete_states().map_err(text)?;
    Ok(())
}

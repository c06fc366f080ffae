//! Saved states: continued with the same bits, in this and in another instance.

use fmi::element::Interface;
use fmi::instance::Saved;

use super::{NAME, Part, half_truck};

const STEP: f64 = 1e-3;

/// Steps with a load that swings, and with inputs that move if they count.
fn go_on(part: &mut Part, steps: u32) -> Vec<u64> {
    for _ in 0..steps {
        let time = part.instance.time();
        part.set("force_on_body_1_z", 2e4 * (30.0 * time).sin());
        part.set("moment_on_body_3_pitch", 1e2 * (11.0 * time).cos());
        let first = part.description.entries.inputs[0].name.clone();
        part.set(&first, 0.02 * time);
        part.set(&format!("{first}_rate"), 0.02);
        part.step(STEP);
    }
    part.states().iter().map(|state| state.to_bits()).collect()
}

#[test]
fn a_saved_state_continues_with_the_same_bits() {
    for (name, motion) in [
        (NAME, 0),
        (NAME, 1),
        // Its motions have a discontinuity at 0.1 s.
        ("nucars_68_variable_toe_in_yaw", 1),
    ] {
        let part = || {
            let mut part = Part::of(half_truck(name, 20.0), Interface::CoSimulation);
            part.choose("motion", motion);
            part.begin();
            part
        };
        let mut straight = part();
        go_on(&mut straight, 60);
        let saved = straight.instance.save();
        let there = go_on(&mut straight, 60);
        straight.instance.restore(&saved).unwrap();
        assert_eq!(go_on(&mut straight, 60), there, "{name} {motion}: back");
        // As bytes, into another instance, which chose otherwise and has not begun.
        let mut other = Part::of(half_truck(name, 20.0), Interface::CoSimulation);
        let bytes = saved.to_bytes().unwrap();
        other
            .instance
            .restore(&Saved::from_bytes(&bytes).unwrap())
            .unwrap();
        assert_eq!(other.instance.save(), saved);
        assert_eq!(go_on(&mut other, 60), there, "{name} {motion}: elsewhere");
        // Several instances do not know of each other.
        let (mut one, mut two) = (part(), part());
        let mut last = Vec::new();
        for _ in 0..12 {
            last = go_on(&mut one, 10);
            go_on(&mut two, 10);
        }
        assert_eq!(last, there, "{name} {motion}: beside another");
    }
}

#[test]
fn an_instance_for_model_exchange_goes_back_to_a_saved_state() {
    let mut part = Part::of(
        half_truck("nucars_68_variable_toe_in_yaw", 20.0),
        Interface::ModelExchange,
    );
    part.choose("motion", 1);
    part.begin();
    part.instance.update_discrete_states().unwrap();
    part.instance.enter_continuous_time_mode().unwrap();
    part.instance.set_time(0.03).unwrap();
    let mut states: Vec<f64> = part.states();
    for (k, state) in states.iter_mut().enumerate() {
        *state += 1e-4 * (k as f64).sin();
    }
    part.instance.set_states(&states).unwrap();
    part.set("force_on_body_1_z", 1e3);
    let look = |part: &mut Part| {
        let mut rates = vec![0.0; states.len()];
        part.instance.rates(&mut rates).unwrap();
        let mut indicators = vec![0.0; part.description.entries.indicators.len()];
        part.instance.indicators(&mut indicators).unwrap();
        rates.extend(indicators);
        rates
    };
    let here = look(&mut part);
    let saved = part.instance.save();
    // Beyond the discontinuity, where the motions are others.
    part.instance.set_time(0.5).unwrap();
    part.instance.enter_event_mode().unwrap();
    part.instance.update_discrete_states().unwrap();
    assert_ne!(look(&mut part), here);
    part.instance.restore(&saved).unwrap();
    assert_eq!(look(&mut part), here);
    assert_eq!(part.instance.save(), saved);
}

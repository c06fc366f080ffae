//! Loss and equivalent damping against closed forms: dampers, Coulomb friction over amplitude, frequency,
//! load and toe, bristles below break-away.

use std::f64::consts::PI;

use study::case::builtin;
use study::closed_form::energy_per_cycle;
use study::losses::{EnergySummary, Equivalent};
use study::metrics::{Cycle, FirstHarmonic};
use study::run::Run;
use study::truck;

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Returns the energies of a built-in wedge with values set over it, SI, and the closed form of what its
/// column loses each cycle, J.
fn wedge(name: &str, set: &[&str]) -> (EnergySummary, Option<f64>) {
    let common = ["simulation.output_units=si", "simulation.duration=1.6 s"];
    let set: Vec<String> = common.iter().chain(set).map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &set).unwrap();
    let summary = Run::new(&case).unwrap().finish(|_| ()).summary;
    assert!(
        summary.complete && summary.energy.is_some(),
        "{}",
        summary.energy.missing
    );
    (summary.energy, energy_per_cycle(&case.parameters))
}

fn loss_of(energy: &EnergySummary, term: &str) -> f64 {
    energy.losses[term].total.as_ref().unwrap().value
}

#[track_caller]
fn near(found: f64, expected: f64, share: f64, what: &str) {
    assert!(
        (found / expected - 1.0).abs() <= share,
        "{what}: {found:e}, {expected:e} expected"
    );
}

/// By definition: a damper has its own damping and ratio, Coulomb friction F has 4F/(πωA).
#[test]
fn analytic_equivalents_of_a_damper_and_of_coulomb_friction() {
    let (amplitude, frequency, stiffness, damping, friction) = (0.02, 7.0, 4e5, 300.0, 900.0);
    let cycle = Cycle::sine(amplitude, frequency);
    let harmonic = Some(FirstHarmonic {
        stiffness,
        damping: 0.0,
    });
    let units = quantity::System::Si;
    let damper = Equivalent::new(
        PI * damping * frequency * amplitude * amplitude,
        &cycle,
        harmonic,
        units,
    );
    near(damper.damping.value, damping, 1e-14, "damper");
    // At the frequency of the drive: ζ = c ω / (2 k).
    near(
        damper.damping_ratio.unwrap(),
        0.5 * damping * frequency / stiffness,
        1e-14,
        "damping ratio",
    );
    near(
        damper.stored_energy.unwrap().value,
        0.5 * stiffness * amplitude * amplitude,
        1e-14,
        "stored",
    );
    let slider = Equivalent::new(4.0 * friction * amplitude, &cycle, None, units);
    near(
        slider.damping.value,
        4.0 * friction / (PI * frequency * amplitude),
        1e-14,
        "slider",
    );
    assert_eq!((slider.damping_ratio, slider.stiffness), (None, None));
}

/// A wedge without friction whose coil has a damper: the equivalent damping is the coil's, but for the
/// contacts' elasticity, in inverse proportion to their stiffness; without it by extrapolation.
#[test]
fn analytic_a_coil_with_a_damper_has_its_own_damping() {
    // Where the coil presses all the time.
    let motion =
        "bolster.vertical=[{ shape = \"sine\", amplitude = \"0.5 in\", frequency = \"2 Hz\" }, \"-1 in\"]";
    let [soft, stiff] = ["2.5e5", "1e6"].map(|stiffness| {
        let stiffness = format!("contact.stiffness={stiffness} lbf/in");
        let (friction, damping) = (
            ["friction.column=0", "friction.slope=0"],
            "control_coil.damping=40 lbf*s/in",
        );
        let (energy, _) = wedge(
            "vdrun_toe_0_psi_0",
            &[&friction[..], &[damping, motion, &stiffness]].concat(),
        );
        let lost = loss_of(&energy, "coil_coil_damping_loss");
        near(lost, energy.loss.unwrap().value, 1e-6, "all is lost in the coil");
        energy.equivalent.unwrap().damping.value
    });
    let damping = 40.0 * POUND_FORCE / INCH;
    near(stiff, damping, 0.01, "damping");
    near(stiff + (stiff - soft) / 3.0, damping, 1e-3, "rigid contacts");
}

/// In full slip the column loses what the closed form says. With constant damping that is proportional to the
/// load and the same at every frequency; over the amplitude it is a line, which begins where the contacts'
/// elasticity is overcome. More is lost with toe in, less with toe out. The slope has no friction: at no toe
/// nothing decides which way it points.
#[test]
fn analytic_loss_over_amplitude_frequency_load_and_toe() {
    const RIGID: &str = "contact.stiffness=1e7 lbf/in";
    let at = |amplitude: &str, frequency: &str, more: &[&str]| {
        let motion = format!(
            "bolster.vertical={{ shape = \"sine\", amplitude = \"{amplitude} in\", frequency = \"{frequency} \
             Hz\" }}"
        );
        let set = [&["friction.slope=0", &motion], more].concat();
        let (energy, closed) = wedge("cdrun_toe_0_psi_0", &set);
        (loss_of(&energy, "column_friction_loss"), closed.unwrap())
    };
    let [small, base, large] = ["0.25", "0.5", "1"].map(|amplitude| at(amplitude, "2", &[RIGID]));
    near(
        large.0 - base.0,
        large.1 - base.1,
        1e-3,
        "growth with the amplitude",
    );
    near(
        large.0 - base.0,
        2.0 * (base.0 - small.0),
        1e-3,
        "a line over the amplitude",
    );
    for (frequency, tolerance) in [("1", 2e-3), ("4", 5e-3)] {
        near(at("0.5", frequency, &[RIGID]).0, base.0, tolerance, frequency);
    }
    for length in ["7 in", "8 in"] {
        let (found, closed) = at(
            "0.5",
            "2",
            &[RIGID, &format!("control_coil.free_length={length}")],
        );
        near(found / base.0, closed / base.1, 0.01, length);
    }
    let toes = ["2 deg in", "0.5 deg in", "0 deg", "0.5 deg out", "2 deg out"];
    let toes = toes.map(|toe| at("0.5", "2", &[&format!("side_frame.toe={toe}")]).0);
    assert!(toes.windows(2).all(|pair| pair[0] > pair[1]), "{toes:?}");
}

/// Bristles below break-away: their dashpots alone lose energy, in proportion to frequency and to the square
/// of the amplitude; no face slips.
#[test]
fn analytic_bristles_below_break_away_lose_what_their_dashpots_lose() {
    let at = |amplitude: &str, frequency: &str| {
        let motion = format!(
            "bolster.vertical={{ shape = \"sine\", amplitude = \"{amplitude} in\", frequency = \"{frequency} \
             Hz\" }}"
        );
        let (energy, _) = wedge(
            "cdrun_toe_0_psi_0",
            &["friction.law=bristle", "simulation.duration=2.1 s", &motion],
        );
        let own = &energy.losses["column_friction_loss"];
        let total = own.total.as_ref().unwrap().value;
        assert!(own.by_state["stick"].value > 0.999 * total, "{own:?}");
        total
    };
    let base = at("1e-4", "2");
    near(at("2e-4", "2"), 4.0 * base, 0.02, "twice the amplitude");
    near(at("1e-4", "4"), 2.0 * base, 0.02, "twice the frequency");
}

/// A truck's bounce: equivalent damping from the ledger is that of the first harmonic of its force, the ratio
/// is that of its loop, and a truck without friction has next to none.
#[test]
fn cross_code_the_bounce_of_a_truck() {
    let set = |more: &[&str]| -> Vec<String> {
        let common = ["simulation.output_units=si", "simulation.output_interval=0.002 s"];
        common.iter().chain(more).map(|text| (*text).to_owned()).collect()
    };
    let case = truck::builtin::case_with("truck_vertical_variable", &set(&[])).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    let found = result.summary.energy.equivalent.clone().unwrap();
    let own = truck::loop_curve::LoopCurve::of(&case, &result).unwrap();
    near(found.amplitude.value, own.amplitude, 1e-3, "amplitude");
    let omega = 2.0 * PI * found.frequency;
    let of_loop = own.energy / (PI * omega * own.amplitude * own.amplitude);
    near(found.damping.value, of_loop, 0.02, "damping");
    let stiffness = found.stiffness.unwrap().value;
    near(
        found.damping_ratio.unwrap(),
        own.energy / (2.0 * PI * stiffness * own.amplitude * own.amplitude),
        0.02,
        "ratio",
    );
    let set = set(&["friction.column=0", "friction.slope=0"]);
    let case = truck::builtin::case_with("truck_vertical_constant", &set).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    let without = result.summary.energy.equivalent.unwrap();
    assert!(without.damping_ratio.unwrap() < 2e-3, "{without:?}");
    let (coils, adapters) = (8.0 * 6468.7, 8.0 * 5e5);
    let expected = coils * adapters / (coils + adapters) * POUND_FORCE / INCH;
    near(without.stiffness.unwrap().value, expected, 5e-3, "stiffness");
    // Roll has no bounce.
    let case = truck::builtin::case_with("truck_roll_constant", &[]).unwrap();
    let energy = Run::new(&case).unwrap().finish(|_| ()).summary.energy;
    assert!(energy.is_some() && energy.equivalent.is_none());
}

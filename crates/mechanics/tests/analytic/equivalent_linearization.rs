//! Equivalent linearization of sliders, and motions of linear models.
use std::f64::consts::{PI, TAU};

use mechanics::linear::{Equivalent, SecondOrder, Slider};
use nalgebra::DMatrix;

const SLIDER: Slider = Slider {
    stiffness: 2e6,
    damping: 0.0,
    limit: 500.0,
};

/// In-phase and out-of-phase parts of the first harmonic of a spring with a slider that is moved by `a cos
/// θ`, over its amplitude: the slider is followed in small steps until its cycle repeats.
fn by_steps(slider: &Slider, amplitude: f64) -> [f64; 2] {
    const STEPS: usize = 200_000;
    let mut slipped = 0.0_f64;
    let mut parts = [0.0; 2];
    for _ in 0..3 {
        parts = [0.0; 2];
        for step in 0..STEPS {
            let angle = TAU * (step as f64 + 0.5) / STEPS as f64;
            let (sine, cosine) = angle.sin_cos();
            let held = slider.limit / slider.stiffness;
            let place = amplitude * cosine;
            slipped = slipped.clamp(place - held, place + held);
            let force = slider.stiffness * (place - slipped);
            parts[0] += force * cosine;
            parts[1] -= force * sine;
        }
    }
    parts.map(|own| own * 2.0 / (STEPS as f64 * amplitude))
}

#[test]
fn analytic_describing_function_of_a_slider() {
    let held = SLIDER.limit / SLIDER.stiffness;
    let frequency = 7.0;
    for times in [1.01, 1.5, 2.0, 5.0, 40.0] {
        let amplitude = times * held;
        let [stiffness, loss] = by_steps(&SLIDER, amplitude);
        let own = SLIDER.equivalent(amplitude, frequency);
        let within = 1e-3 * SLIDER.stiffness / times;
        assert!(
            (own.stiffness - stiffness).abs() < within,
            "{times}: {own:?} {stiffness}"
        );
        assert!(
            (own.damping * frequency - loss).abs() < within,
            "{times}: {own:?} {loss}"
        );
        // The loss in a cycle: a parallelogram.
        let area = 4.0 * SLIDER.limit * (amplitude - held);
        let of_damper = PI * own.damping * frequency * amplitude * amplitude;
        assert!((of_damper / area - 1.0).abs() < 1e-12);
    }
}

#[test]
fn limits_of_a_slider_are_stuck_and_absent() {
    let slider = Slider {
        damping: 30.0,
        ..SLIDER
    };
    assert_eq!(slider.equivalent(0.0, 1.0), slider.stuck());
    assert_eq!(
        slider.equivalent(slider.limit / slider.stiffness, 1.0),
        slider.stuck()
    );
    assert_eq!(slider.equivalent(f64::INFINITY, 1.0), Equivalent::NONE);
    let far = slider.equivalent(1e6, 1.0);
    assert!(far.stiffness < 1e-6 * slider.stiffness && far.damping < 1e-2);
}

/// A chain of masses between springs and dampers: `λ² m = -(k + c λ) 4 sin²(j π/(2(n + 1)))`.
#[test]
fn analytic_modes_of_a_chain() {
    let n = 30;
    let (mass, stiffness, damping) = (3.0, 700.0, 0.4);
    let chain = |own: f64| {
        DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
            0 => -2.0 * own,
            1 => own,
            _ => 0.0,
        })
    };
    let system = SecondOrder {
        mass: DMatrix::identity(n, n) * mass,
        stiffness: chain(stiffness),
        damping: chain(damping),
    };
    let modes = system.modes(5.0, 2 * n).unwrap();
    assert_eq!(modes.len(), n);
    let mut found: Vec<[f64; 2]> = modes
        .iter()
        .map(|own| [own.growth(), TAU * own.frequency()])
        .collect();
    found.sort_by(|a, b| a[1].total_cmp(&b[1]));
    for (j, [growth, frequency]) in (1..).zip(found) {
        let square = 4.0 * (f64::from(j) * PI / (2.0 * (n as f64 + 1.0))).sin().powi(2);
        let expected = -0.5 * damping * square / mass;
        let vibrates = (stiffness * square / mass - expected * expected).sqrt();
        assert!(
            (growth - expected).abs() < 1e-7 * vibrates,
            "{j}: {growth} {expected}"
        );
        assert!(
            (frequency / vibrates - 1.0).abs() < 1e-7,
            "{j}: {frequency} {vibrates}"
        );
    }
    // Few steps find the motions near the shift, to the same numbers.
    let few = system.modes(0.5, 24).unwrap();
    let slowest = modes
        .iter()
        .map(|own| own.frequency())
        .fold(f64::INFINITY, f64::min);
    assert!(
        few.iter()
            .any(|own| (own.frequency() / slowest - 1.0).abs() < 1e-7)
    );
    assert!(few.len() < n);
}

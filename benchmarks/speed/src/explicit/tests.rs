//! The explicit car is a car: it stands in equilibrium, keeps its energy where nothing takes it, bounces at
//! the frequency of the closed form.

use super::parts::{Faces, Lading, Losses};
use super::*;

/// Body, bolsters and wedges.
fn sprung(number: &usize) -> bool {
    *number < 3 || (7..WHEELSETS).contains(number)
}

#[test]
fn limits_it_stands_still_and_its_wheels_carry_its_weight() {
    for lading in [Lading::Loaded, Lading::Empty] {
        let mut car = Car::new(lading, Losses::All, Faces::Corners, 20.0, Vec::new());
        car.settle(2.0);
        let (place, _) = car.body(0);
        while car.time < 0.5 {
            car.step();
        }
        let carried: f64 = car.loads.iter().flatten().sum();
        assert!(
            (carried / car.weight() - 1.0).abs() < 1e-3,
            "{carried} of {}",
            car.weight()
        );
        for load in car.loads.iter().flatten() {
            assert!((8.0 * load / car.weight() - 1.0).abs() < 0.02, "{load}");
        }
        let (after, velocity) = car.body(0);
        let moved = sub(after, place);
        assert!(dot(moved, moved).sqrt() < 1e-4, "{moved:?}");
        assert!(dot(velocity, velocity).sqrt() < 1e-3, "{velocity:?}");
    }
}

#[test]
fn energy_stays_without_losses() {
    let mut car = Car::new(Lading::Loaded, Losses::Nothing, Faces::Corners, 20.0, Vec::new());
    car.settle(1.5);
    let at_rest = car.energy();
    car.shift((0..BODIES).filter(sprung), [0.0, 0.0, 0.003]);
    let start = car.energy();
    assert!(start - at_rest > 1.0, "{}", start - at_rest);
    while car.time < 0.5 {
        car.step();
        if car.time % 0.01 < STEP {
            let gained = (car.energy() - start) / (start - at_rest);
            assert!((-0.02..1e-3).contains(&gained), "{gained} at {} s", car.time);
        }
    }
}

/// Coils of nests and of wedges, which go up and down with the bolster, in series with plates, adapters and
/// wheels, carry body, bolsters and wedges.
#[test]
fn analytic_it_bounces_at_the_frequency_of_a_mass_on_springs() {
    let mut car = Car::new(Lading::Loaded, Losses::Nothing, Faces::Corners, 20.0, Vec::new());
    car.settle(2.0);
    let (place, _) = car.body(0);
    let coils = 4.0 * (4.0 * 5369.5 + 2.0 * 1937.0) * POUND_PER_INCH;
    let plates = 2.0 * 8.0 * 6e6 * POUND_PER_INCH;
    let adapters = 8.0 * 2.0 * 1e6 * POUND_PER_INCH;
    let wheels = 8.0 * car.hertz.stiffness_at(car.weight() / 8.0);
    let stiffness = 1.0
        / [coils, plates, adapters, wheels]
            .map(|own| 1.0 / own)
            .iter()
            .sum::<f64>();
    let mass: f64 = (0..BODIES)
        .filter(sprung)
        .map(|number| car.bodies[number].mass)
        .sum();
    let expected = (stiffness / mass).sqrt() / std::f64::consts::TAU;
    car.shift((0..BODIES).filter(sprung), [0.0, 0.0, 0.001]);
    let (mut before, mut crossings) = (0.001, Vec::new());
    while car.time < 1.2 {
        car.step();
        let above = car.body(0).0[2] - place[2];
        if before > 0.0 && above <= 0.0 {
            crossings.push(car.time - STEP * above / (above - before));
        }
        before = above;
    }
    let period = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    assert!(
        (1.0 / period / expected - 1.0).abs() < 5e-3,
        "{} Hz, expected {expected} Hz",
        1.0 / period
    );
}

//! analytic, limits: laws of wear and rolling contact fatigue, and what they leave on a profile.

use wheelrail::damage::{DamageFunction, Dose, Surface, WearMap};

/// A patch that slides as a whole wears by k N v t / H, whatever the region of the map.
#[test]
fn analytic_a_sliding_patch_wears_as_archard_says() {
    let map = WearMap::default();
    let (normal, friction) = (80e3, 0.35);
    for (sliding, pressure, k) in [
        (0.1, 1e9, 5e-4),
        (0.2, 1e9, 35e-4),
        (0.69, 1e9, 35e-4),
        (0.71, 1e9, 5e-4),
        (0.5, 2.41e9, 350e-4),
        (3.0, 2.39e9, 5e-4),
    ] {
        let expected = k * normal * sliding / 3e9;
        let found = map.rate(friction * normal * sliding, normal, pressure, friction);
        assert!(
            (found / expected - 1.0).abs() < 1e-12,
            "{sliding} {pressure}: {found} {expected}"
        );
    }
    // Neither a lifted wheel nor one without friction wears.
    assert_eq!(map.rate(10.0, 0.0, 1e9, 0.3), 0.0);
    assert_eq!(map.rate(0.0, 1e4, 1e9, 0.0), 0.0);
}

#[test]
fn analytic_the_damage_function_is_straight_between_its_points() {
    let function = DamageFunction::default();
    for (wear_number, expected) in [
        (0.0, 0.0),
        (15.0, 0.0),
        (40.0, 0.5),
        (65.0, 1.0),
        (120.0, 0.5),
        (175.0, 0.0),
        (230.0, -0.5),
    ] {
        let found = function.at(wear_number);
        assert!((found - expected).abs() < 1e-12, "{wear_number}: {found}");
    }
}

/// All that patches do is on the profile, where they were: moments of first and second order are those of
/// parabolas, and what hangs over an end is in the last place.
#[test]
fn analytic_a_surface_has_all_that_patches_do() {
    let mut surface = Surface::new([-0.05, 0.03], 0.5e-3);
    let dose = Dose {
        volume: 2e-9,
        square: 1.5e-9,
        energy: 30.0,
        fatigue: 0.4,
    };
    let (middle, half) = (4.13e-3, 5.2e-3);
    surface.add(middle, half, &dose);
    let sum = surface.sum();
    for (found, expected) in [
        (sum.volume, dose.volume),
        (sum.square, dose.square),
        (sum.energy, dose.energy),
        (sum.fatigue, dose.fatigue),
    ] {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    }
    let moment = |power: i32| -> f64 {
        let each = surface.middles().zip(&surface.places);
        each.map(|(y, own)| (y - middle).powi(power) * own.volume)
            .sum::<f64>()
            / dose.volume
    };
    assert!(moment(1).abs() < 1e-5, "{}", moment(1));
    // b²/5, and w²/12 of places of a width w.
    let expected = half * half / 5.0;
    assert!(
        (moment(2) / expected - 1.0).abs() < 0.01,
        "{} {expected}",
        moment(2)
    );
    surface.add(0.031, 2e-3, &dose);
    assert!((surface.sum().energy / (2.0 * dose.energy) - 1.0).abs() < 1e-12);
    assert!(surface.places[surface.places.len() - 1].energy > 0.4 * dose.energy);
    // A patch narrower than a place.
    surface.add(-0.0499, 1e-5, &dose);
    assert!((surface.places[0].energy - dose.energy).abs() < 1e-9);
}

//! Free rolling, the reach of wheels, and lengths in another unit.

use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::loaded::{Attitude, LoadError, Seat};
use wheelrail::profile::{Profile, ProfileError, nominal};
use wheelrail::wheelset::{Layout, RigidWheelset};

const INCH: f64 = 0.0254;
const LOAD: f64 = 146_800.0;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.27,
};

fn wheelset_of(wheel: &Profile, gauge: f64, radius: f64) -> Result<RigidWheelset, ProfileError> {
    let rail = nominal::rail_136re().unwrap().inclined(1.0 / 40.0);
    let layout = Layout {
        tape_distance: nominal::TAPE_DISTANCE,
        gauge,
        gauge_depth: nominal::GAUGE_DEPTH,
    };
    RigidWheelset::new([wheel; 2], [radius; 2], [&rail; 2], layout, STEEL)
}

fn wheelset(gauge: f64) -> RigidWheelset {
    wheelset_of(&nominal::aar_1b().unwrap(), gauge, 18.0 * INCH).unwrap()
}

fn law(creep: CreepLaw, friction: f64) -> ContactLaw {
    ContactLaw {
        friction: Friction::constant(friction),
        damping: 0.0,
        creep,
        slowest: 0.0,
    }
}

fn attitude(lateral: f64, yaw: f64) -> Attitude {
    Attitude {
        lateral,
        yaw,
        roll: 0.0,
        speed: 20.0,
        pitch_rate: f64::NAN,
    }
}

/// Longitudinal forces and torques of both wheels at a pitch rate.
fn forces(wheelset: &RigidWheelset, attitude: &Attitude, rate: f64, law: &ContactLaw) -> [[f64; 2]; 2] {
    let attitude = Attitude {
        pitch_rate: rate,
        ..*attitude
    };
    [Side::Left, Side::Right].map(|side| {
        let wheel = wheelset.loaded(side, &attitude, LOAD, law).unwrap();
        [wheel.patches.iter().map(|patch| patch.fx).sum(), wheel.torque]
    })
}

/// For every law and position the torques cancel; in the middle, where the longitudinal forces are equal,
/// they balance the spin moments alone.
#[test]
fn issue_048_a_free_wheelset_has_no_torque_about_its_axle() {
    let wheelset = wheelset(56.5 * INCH);
    let grid = StripGrid {
        cells: 20,
        strips: 20,
    };
    for creep in [
        CreepLaw::Linear,
        CreepLaw::ShenHedrickElkins,
        CreepLaw::Polach(polach::DRY),
        CreepLaw::Fastsim(grid),
    ] {
        let law = law(creep, 0.3);
        for (lateral, yaw) in [(0.0, 0.0), (0.006, 0.0), (-0.009, 0.004), (0.0085, -0.01)] {
            let attitude = attitude(lateral, yaw);
            let rate = wheelset.free_rolling(&attitude, LOAD, &law).unwrap();
            let [left, right] = forces(&wheelset, &attitude, rate, &law);
            let scale = LOAD * 18.0 * INCH;
            assert!(
                (left[1] + right[1]).abs() < 1e-8 * scale,
                "{creep:?} {lateral} {yaw}"
            );
            assert!((rate * 18.0 * INCH / 20.0 + 1.0).abs() < 0.05, "{rate}");
            if lateral == 0.0 && yaw == 0.0 {
                assert!(
                    left[0].abs() < 1e-4 * LOAD && (left[0] - right[0]).abs() < 1e-6 * LOAD,
                    "{left:?}"
                );
            } else {
                assert!(left[0] * right[0] < 0.0, "{left:?} {right:?}");
            }
        }
    }
}

/// A cone of 1:20 in the middle of the track rolls on the radius at which it touches.
#[test]
fn issue_048_a_centered_wheelset_rolls_on_its_rolling_radius() {
    let wheelset = wheelset_of(&nominal::cone(0.05, 0.05).unwrap(), 56.5 * INCH, 0.4572).unwrap();
    let law = law(CreepLaw::Polach(polach::DRY), 0.3);
    let rate = wheelset.free_rolling(&attitude(0.0, 0.0), LOAD, &law).unwrap();
    let radius = wheelset.position(0.0, 0.0).unwrap().touches[0].radius;
    assert!((radius - 0.4572).abs() > 1e-5, "{radius}");
    assert!((-rate * radius / 20.0 - 1.0).abs() < 2e-6, "{rate} {radius}");
}

/// Without friction and off both rails every spin is free.
#[test]
fn issue_048_limits_of_free_rolling() {
    let wheelset = wheelset(56.5 * INCH);
    let usual = -20.0 / (18.0 * INCH);
    let dry = law(CreepLaw::Polach(polach::DRY), 0.3);
    for (lateral, law) in [
        (0.003, law(CreepLaw::Polach(polach::DRY), 0.0)),
        (0.003, law(CreepLaw::Frictionless, 0.3)),
        (0.3, dry.clone()),
    ] {
        let rate = wheelset
            .free_rolling(&attitude(lateral, 0.0), LOAD, &law)
            .unwrap();
        assert!((rate - usual).abs() < 1e-12, "{lateral}: {rate}");
    }
    let error = wheelset
        .free_rolling(&attitude(5.0, 0.0), LOAD, &dry)
        .unwrap_err();
    assert!(
        error.remedy().contains("did you give inches (\"5 in\")"),
        "{}",
        error.remedy()
    );
    let error = wheelset
        .free_rolling(&attitude(0.0, 0.0), -1.0, &dry)
        .unwrap_err();
    assert!(matches!(error, LoadError::Number { .. }));
}

/// The largest gauge that the error names is that at which the wheels stand on their treads, and beyond it
/// they do not.
#[test]
fn issue_048_wheels_that_do_not_reach_both_rails_are_told() {
    for gauge in [56.0, 56.5, 58.0, 62.0] {
        assert!(wheelset(gauge * INCH).check_reach().is_ok(), "{gauge}");
    }
    let law = law(CreepLaw::Polach(polach::DRY), 0.3);
    for gauge in [64.0, 66.0, 72.0] {
        let error = wheelset(gauge * INCH).check_reach().unwrap_err();
        let text = error.to_string();
        assert!(text.contains("the wheels do not reach both rails"), "{text}");
        assert!(
            text.contains(&format!("{gauge:.2} in")) && text.contains("64.81 in"),
            "{text}"
        );
        let ProfileError::ShortOfRails { largest, .. } = error else {
            panic!("{text}");
        };
        let largest = largest.unwrap();
        for (more, stands) in [(-1e-6, true), (1e-4, false)] {
            let wheelset = wheelset(largest + more);
            let attitude = Attitude {
                pitch_rate: -20.0 / (18.0 * INCH),
                ..attitude(0.0, 0.0)
            };
            let seat = wheelset.loaded(Side::Left, &attitude, 1.0, &law).unwrap().seat;
            assert_eq!(seat == Seat::OnRail, stands, "{largest} {seat:?}");
        }
    }
}

/// Bounds are in order, and inches and millimeters are asked for.
#[test]
fn issue_048_lengths_in_another_unit_are_hinted_at() {
    let wheel = nominal::aar_1b().unwrap();
    for (gauge, radius, parts) in [
        (
            56.5,
            18.0 * INCH,
            ["gauge is 56.5 m", "between 0.1 and 10 m", "inches (\"56.5 in\")"],
        ),
        (
            1435.0,
            18.0 * INCH,
            [
                "gauge is 1435 m",
                "between 0.1 and 10 m",
                "millimeters (\"1435 mm\")",
            ],
        ),
        (
            56.5 * INCH,
            18.0,
            [
                "wheel radius is 18 m",
                "between 0.05 and 2 m",
                "inches (\"18 in\")",
            ],
        ),
    ] {
        let error = wheelset_of(&wheel, gauge, radius).unwrap_err();
        let text = format!("{error}; {}", error.remedy());
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}

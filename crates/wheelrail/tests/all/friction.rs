//! Friction by zone, distance and slip; worn measured profiles against CONTACT.

use std::path::Path;
use std::sync::Arc;

use numerics::scalar::Dual;
use wheelrail::contact::{ContactLaw, CreepLaw, PatchForm, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::friction::{DRY, Falling, Friction, Zones};
use wheelrail::hertz::Material;
use wheelrail::loaded::{Attitude, LoadedWheel};
use wheelrail::profile::{Profile, ProfileKind, ReadOptions, WheelDatum};
use wheelrail::wheelset::{Layout, RigidWheelset};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Polach's falling friction is its formula, zones are linear in the angle on both sides, places linear in
/// the distance; derivatives are those of differences.
#[test]
fn analytic_friction_by_angle_distance_and_slip() {
    let falling = Friction {
        falling: Some(DRY),
        ..Friction::constant(0.5)
    };
    for w in [0.0_f64, 1e-3, 0.1, 1.0, 5.0] {
        let exact = 0.5 * (0.6 * (-0.6 * w).exp() + 0.4);
        let found = falling.at(0.05, 0.0, [0.6 * w, -0.8 * w]);
        assert!((found / exact - 1.0).abs() < 1e-6, "{w}: {found} {exact}");
    }
    let oiled = Friction::by_zone(0.4, 0.15);
    for (angle, exact) in [
        (-3.0, 0.4),
        (19.9, 0.4),
        (25.0, 0.275),
        (-22.5, 0.3375),
        (30.1, 0.15),
        (70.0, 0.15),
    ] {
        let found = oiled.at((angle * DEGREE).tan(), 0.0, [0.0; 2]);
        assert!((found - exact).abs() < 1e-12, "{angle}: {found}");
    }
    let spot = |tread, gauge_face| Zones { tread, gauge_face };
    let wet = Friction {
        over: Some(Arc::new([(100.0, spot(0.4, 0.3)), (110.0, spot(0.2, 0.1))])),
        falling: Some(Falling {
            ratio: 0.5,
            decay: 2.0,
        }),
        ..oiled
    };
    for (place, exact) in [(0.0, 0.4), (105.0, 0.3), (110.0, 0.2), (900.0, 0.2)] {
        assert!((wet.at(0.0, place, [0.0; 2]) - exact).abs() < 1e-12, "{place}");
    }
    let values = [(23.0 * DEGREE).tan(), 103.0, 0.3, -0.2];
    let wide: [Dual<4>; 4] = std::array::from_fn(|i| Dual::variable(values[i], i));
    let exact = wet.at(wide[0], wide[1], [wide[2], wide[3]]);
    for i in 0..4 {
        let at = |step: f64| {
            let mut moved = values;
            moved[i] += step;
            wet.at(moved[0], moved[1], [moved[2], moved[3]])
        };
        let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
        assert!(
            (exact.derivative[i] - difference).abs() < 1e-7,
            "{i}: {difference}"
        );
    }
    assert!(!wet.is_zero() && Friction::constant(0.0).is_zero());
}

/// A worn wheel on a worn high rail of a heavy-haul railway, pressed down by a load (N), with friction 0.35
/// on the tread and 0.2 on the gauge face.
pub fn pressed(load: f64, form: PatchForm) -> LoadedWheel {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/worn");
    // y counts from the back of the flange. 70 mm from it z is zero, where the radius is measured.
    let options = ReadOptions {
        datum: Some(WheelDatum::FlangeBack),
        tape_from_back: Some(0.070),
        ..ReadOptions::default()
    };
    let wheel = folder.join("worn_high_mileage.prw");
    let wheel = Profile::read_with(&wheel, ProfileKind::Wheel, &options).unwrap();
    let rail = Profile::read(&folder.join("site_b_hr.prr"), ProfileKind::Rail, 0.0).unwrap();
    let layout = Layout {
        tape_distance: 1.3474 + 2.0 * 0.070,
        gauge: 1.4351,
        gauge_depth: 15.875e-3,
    };
    let material = Material {
        youngs_modulus: 2.0 * 82e9 * 1.28,
        poisson: 0.28,
    };
    let wheelset = RigidWheelset::new([&wheel; 2], [0.444; 2], [&rail; 2], layout, material)
        .unwrap()
        .with_patches(form);
    let law = ContactLaw {
        friction: Friction::by_zone(0.35, 0.2),
        damping: 0.0,
        creep: CreepLaw::Fastsim(StripGrid {
            cells: 40,
            strips: 40,
        }),
        slowest: 0.0,
    };
    let attitude = Attitude {
        lateral: 14.74e-3,
        yaw: 0.0050,
        roll: -0.0013,
        speed: 15.0,
        pitch_rate: -32.10,
    };
    wheelset.loaded(Side::Right, &attitude, load, &law).unwrap()
}

/// Places (mm), normal forces and creep forces along and across (N) of the patches, and the lateral force on
/// the rail: the program CONTACT, case `force_site_b` of its test bank (revision of 2025).
#[test]
fn cross_code_worn_profiles_with_friction_by_zone() {
    type Reference<'r> = (f64, &'r [[f64; 4]], f64);
    let references: [Reference<'_>; 2] = [
        (3.7e3, &[[723.4359, 4309.0, 848.9, -143.3]], 2214.0),
        (
            32.5e3,
            &[
                [723.3751, 16240.0, 3192.0, -545.8],
                [755.9430, 18590.0, 6477.0, -624.0],
            ],
            8869.0,
        ),
    ];
    for (load, patches, lateral) in references {
        let found = pressed(load, PatchForm::Ellipse);
        let mut own: Vec<_> = found
            .patches
            .iter()
            .filter(|own| own.normal > 1e-3 * load)
            .collect();
        own.sort_by(|a, b| a.y.total_cmp(&b.y));
        assert_eq!(own.len(), patches.len(), "{own:?}");
        for (own, [y, normal, x, across]) in own.iter().zip(patches) {
            assert!((1e3 * own.y - y).abs() < 0.1, "{own:?} {y}");
            assert!((own.normal / normal - 1.0).abs() < 0.01, "{own:?} {normal}");
            let size = x.hypot(*across);
            assert!(
                (own.fx - x).hypot(own.fy - across) < 0.03 * size,
                "{own:?} {x} {across}"
            );
        }
        assert!(
            (found.force[0] / lateral - 1.0).abs() < 0.03,
            "{:?} {lateral}",
            found.force
        );
        let along: f64 = own.iter().map(|own| own.fx).sum();
        let expected: f64 = patches.iter().map(|[_, _, x, _]| x).sum();
        assert!((along / expected - 1.0).abs() < 0.01, "{along} {expected}");
    }
}

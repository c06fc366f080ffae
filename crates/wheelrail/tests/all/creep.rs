//! Creep forces against Kalker's table, against CONTACT and another program, their limits and derivatives.

use numerics::scalar::Dual;
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::{
    Coefficients, CreepForces, Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins,
};

const SHEAR: f64 = 82e9;
const FINE: StripGrid = StripGrid {
    cells: 200,
    strips: 200,
};

fn patch(axes: [f64; 2], load: f64, friction: f64) -> Patch<f64> {
    Patch {
        axes,
        load,
        friction,
        shear_modulus: SHEAR,
        coefficients: Coefficients::of(axes[0] / axes[1], 0.28),
    }
}

/// Returns the patch of CONTACT's example `tractcurv`.
fn traction() -> Patch<f64> {
    patch([6.305e-3, 12.611e-3], 106.7e3, 0.33)
}

fn creepage([longitudinal, lateral, spin]: [f64; 3]) -> Creepage<f64> {
    Creepage {
        longitudinal,
        lateral,
        spin,
    }
}

type Law = fn(&Patch<f64>, &Creepage<f64>) -> CreepForces<f64>;

fn laws() -> [(&'static str, Law); 4] {
    [
        ("linear", |p, c| linear::forces(p, c)),
        ("Shen-Hedrick-Elkins", |p, c| shen_hedrick_elkins::forces(p, c)),
        ("Polach", |p, c| polach::forces(p, c, polach::DRY)),
        ("FASTSIM", |p, c| fastsim::forces(p, c, FINE)),
    ]
}

/// The table's own digits at its nodes, and the values at a Poisson's ratio of 0.28 (parabola of 1/C) and
/// 0.5.
#[test]
fn reproduction_kalkers_coefficients_to_the_digits_of_the_table() {
    let close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    for (ratio, poisson, [c11, c22, c23, c33]) in [
        (0.1, 0.0, [2.51, 2.51, 0.334, 6.42]),
        (0.5, 0.25, [3.62, 3.01, 0.929, 1.93]),
        (1.0, 0.5, [5.20, 3.98, 1.63, 1.16]),
        (1.0 / 0.9, 0.25, [4.22, 3.81, 1.59, 1.11]),
        (2.0, 0.25, [5.10, 4.90, 2.62, 0.819]),
        (10.0, 0.5, [12.9, 16.0, 18.0, 0.228]),
        (25.0, 0.5, [12.9, 16.0, 18.0, 0.228]),
    ] {
        let found = Coefficients::of(ratio, poisson);
        close(found.c11, c11);
        close(found.c22, c22);
        close(found.c23, c23);
        close(found.c33, c33);
    }
    let between = Coefficients::of(0.5, 0.28).c11;
    assert!((between - 3.734).abs() < 1e-3, "{between}");
}

/// Ratio |Fx| / (μN) over longitudinal creepage: CONTACT's exact theory (example `tractcurv`), and FASTSIM
/// with 30 × 30 cells, Polach, Shen-Hedrick-Elkins in another program.
#[test]
fn reproduction_traction_curve_of_contact() {
    let patch = traction();
    let limit = 0.33 * 106.7e3;
    let grid = StripGrid {
        cells: 30,
        strips: 30,
    };
    for (creep, contact, expected) in [
        (4e-4, 0.2588, [0.2515, 0.2682, 0.2518]),
        (1.2e-3, 0.6482, [0.6160, 0.6588, 0.6214]),
        (1.6e-3, 0.7831, [0.7404, 0.7706, 0.7484]),
        (2.4e-3, 0.9467, [0.9002, 0.8908, 0.9107]),
        (3.6e-3, 0.9991, [0.9900, 0.9571, 0.9951]),
    ] {
        let creepage = creepage([creep, 0.0, 0.0]);
        let found = [
            fastsim::forces(&patch, &creepage, grid),
            polach::forces(&patch, &creepage, polach::DRY),
            shen_hedrick_elkins::forces(&patch, &creepage),
        ]
        .map(|forces| -forces.x / limit);
        for ((found, expected), band) in found.iter().zip(expected).zip([0.06, 0.08, 0.06]) {
            assert!(
                (found - expected).abs() < 1.5e-3,
                "{creep}: {found}, {expected} in another program"
            );
            assert!(
                (found / contact - 1.0).abs() < band,
                "{creep}: {found}, CONTACT {contact}"
            );
        }
    }
}

/// CONTACT's example `fastsim`: lateral creepage with spin, 200 × 200 cells, parabolic bound.
#[test]
fn reproduction_lateral_creepage_with_spin_of_contact() {
    let patch = patch([8e-3, 4e-3], 82e3, 0.3);
    let forces = fastsim::forces(&patch, &creepage([0.0, -6.25e-4, 0.625]), FINE);
    // CONTACT's own FASTSIM, and another implementation of the same steps.
    for (y, moment, within) in [(-15_640.0, -37.98, 0.03), (-15_941.0, -37.568, 0.002)] {
        assert!((forces.y / y - 1.0).abs() < within, "{} N, {y} N", forces.y);
        assert!(
            (forces.spin_moment / moment - 1.0).abs() < within,
            "{} {moment} N·m",
            forces.spin_moment
        );
    }
    assert!(forces.x.abs() < 1e-6 * forces.y.abs());
    let polach = polach::forces(&patch, &creepage([0.0, -6.25e-4, 0.625]), polach::DRY);
    assert!((polach.y / -15_917.0 - 1.0).abs() < 0.02, "{}", polach.y);
    let cubic = shen_hedrick_elkins::forces(&patch, &creepage([0.0, -6.25e-4, 0.625]));
    assert!((cubic.y / -13_082.0 - 1.0).abs() < 0.01, "{}", cubic.y);
}

/// Returns the power that forces and spin moment take over the reference speed, and the sum of the sizes of
/// its parts.
fn dissipation(law: Law, patch: &Patch<f64>, c: &Creepage<f64>) -> [f64; 2] {
    let found = law(patch, c);
    let parts = [
        -found.x * c.longitudinal,
        -found.y * c.lateral,
        -found.spin_moment * c.spin,
    ];
    [parts.iter().sum(), parts.iter().map(|part| part.abs()).sum()]
}

/// Creepages and spins of all sizes on ellipses from 1:8 to 8:1.
fn cases(mut see: impl FnMut(&Patch<f64>, &Creepage<f64>)) {
    for ratio in [0.125, 0.4, 1.0, 2.0, 4.0, 8.0_f64] {
        let size: f64 = 6e-3;
        let own = patch([size * ratio.sqrt(), size / ratio.sqrt()], 80e3, 0.4);
        for x in [0.0, 3e-4, 3e-3, 3e-2] {
            for y in [0.0, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2] {
                for spin in [0.03, 0.1, 0.3, 1.0, 2.0] {
                    for sign in [-1.0, 1.0] {
                        see(&own, &creepage([x, y, sign * spin]));
                    }
                }
            }
        }
    }
}

/// No law gives power, at any ellipse, creepage and spin.
#[test]
fn energy_creep_forces_and_spin_moments_never_give_power() {
    const COARSE: StripGrid = StripGrid {
        cells: 20,
        strips: 20,
    };
    let [linear, cubic, closed, _] = laws();
    let strips: (&str, Law) = ("FASTSIM", |p, c| fastsim::forces(p, c, COARSE));
    cases(|patch, creepage| {
        for (name, law) in [linear, cubic, closed, strips] {
            let [power, size] = dissipation(law, patch, creepage);
            assert!(
                power >= -1e-12 * size,
                "{name} {creepage:?} {:?}: {power} {size}",
                patch.axes
            );
        }
    });
}

/// With the spin moment of linear theory beside reduced forces that law would give power: by the sum of
/// squares in its head, here on a slender ellipse at half of full saturation, and on a round one far beyond.
#[test]
fn limits_an_unreduced_spin_moment_would_give_power() {
    for (axes, lateral, spin) in [([15e-3, 2e-3], 2.5e-3, 0.3), ([6e-3, 6e-3], 0.1, 5.0)] {
        let own = patch(axes, 80e3, 0.4);
        let mut worst = f64::INFINITY;
        for factor in [0.25, 0.5, 1.0, 2.0, 4.0] {
            let c = creepage([0.0, lateral, factor * spin]);
            let reduced = shen_hedrick_elkins::forces(&own, &c);
            let whole = linear::forces(&own, &c).spin_moment;
            worst = worst.min(-reduced.y * c.lateral - whole * c.spin);
        }
        assert!(worst < 0.0, "{axes:?}: {worst}");
    }
}

/// At small creepages all laws are Kalker's, FASTSIM but for its factor 1 + (2/n)²/8 with n strips.
#[test]
fn limits_small_creepages_have_linear_forces() {
    let patch = traction();
    for direction in [[1e-6, 0.0, 0.0], [0.0, 1e-6, 0.0], [6e-7, -8e-7, 0.0]] {
        let expected = linear::forces(&patch, &creepage(direction));
        let size = expected.x.hypot(expected.y);
        for (name, law) in laws() {
            let found = law(&patch, &creepage(direction));
            assert!(
                (found.x.hypot(found.y) / size - 1.0).abs() < 2e-3,
                "{name}: {found:?} {expected:?}"
            );
            // Polach's force opposes the creepage, Kalker's is turned a little.
            if name != "Polach" {
                assert!(
                    (found.x - expected.x).abs() < 2e-3 * size,
                    "{name}: {found:?} {expected:?}"
                );
                assert!(
                    (found.y - expected.y).abs() < 2e-3 * size,
                    "{name}: {found:?} {expected:?}"
                );
            }
        }
    }
    for strips in [5, 11, 21] {
        let grid = StripGrid { cells: 40, strips };
        // Far from saturation: no cell slips, but for those at the trailing edge.
        let free = Patch {
            friction: 1e6,
            ..patch
        };
        let found = fastsim::forces(&free, &creepage([1e-6, 0.0, 0.0]), grid).x;
        let expected = linear::forces(&free, &creepage([1e-6, 0.0, 0.0])).x;
        let factor = 1.0 + (2.0 / strips as f64).powi(2) / 8.0;
        assert!(
            (found / expected / factor - 1.0).abs() < 1e-3,
            "{strips}: {}",
            found / expected
        );
    }
}

/// Forces never exceed μN, oppose the creepage and change their signs with it; pure spin and rest are finite.
#[test]
fn limits_saturation_symmetry_and_rest() {
    let patch = traction();
    let limit = patch.limit();
    for (name, law) in laws().into_iter().skip(1) {
        for creep in [
            [0.0; 3],
            [0.0, 0.0, 0.8],
            [3e-3, -2e-3, 0.0],
            [0.1, 0.2, 0.0],
            [1e-3, -1e-3, 0.3],
        ] {
            let forces = law(&patch, &creepage(creep));
            let size = forces.x.hypot(forces.y);
            assert!(
                size.is_finite() && forces.spin_moment.is_finite(),
                "{name} at {creep:?}"
            );
            assert!(
                size <= 1.0001 * limit,
                "{name} at {creep:?}: {} of μN",
                size / limit
            );
            let back = law(&patch, &creepage(creep.map(|part| -part)));
            assert!((forces.x + back.x).abs() < 1e-9 * limit && (forces.y + back.y).abs() < 1e-9 * limit);
        }
        assert!(law(&patch, &creepage([0.1, 0.2, 0.0])).x < -0.3 * limit, "{name}");
    }
    let rest = polach::forces(&patch, &creepage([0.0; 3]), polach::DRY);
    assert_eq!([rest.x, rest.y], [0.0; 2]);
}

/// Derivatives by creepages, spin and load against differences.
#[test]
fn analytic_derivatives_against_differences() {
    let at = [8e-4, -5e-4, 0.2, 106.7e3];
    let steps = [1e-8, 1e-8, 1e-5, 1.0];
    let hertz_like = |load: Dual<4>| Patch {
        axes: [load * 6e-8, load * 1.2e-7],
        load,
        friction: Dual::from(0.33),
        shear_modulus: SHEAR,
        coefficients: Coefficients::of(Dual::from(0.5), 0.28),
    };
    let plain = |load: f64| Patch {
        axes: [load * 6e-8, load * 1.2e-7],
        load,
        friction: 0.33,
        shear_modulus: SHEAR,
        coefficients: Coefficients::of(0.5, 0.28),
    };
    let variable = |k: usize| Dual::<4>::variable(at[k], k);
    let dual = Creepage {
        longitudinal: variable(0),
        lateral: variable(1),
        spin: variable(2),
    };
    let patch = hertz_like(variable(3));
    let found = [
        linear::forces(&patch, &dual),
        shen_hedrick_elkins::forces(&patch, &dual),
        polach::forces(&patch, &dual, polach::DRY),
    ];
    for ((name, law), found) in laws().into_iter().zip(found) {
        for k in 0..4 {
            let moved = |sign: f64| {
                let mut moved = at;
                moved[k] += sign * steps[k];
                let forces = law(&plain(moved[3]), &creepage([moved[0], moved[1], moved[2]]));
                [forces.x, forces.y, forces.spin_moment]
            };
            let (up, down) = (moved(1.0), moved(-1.0));
            let dual = [found.x, found.y, found.spin_moment];
            for i in 0..3 {
                let expected = (up[i] - down[i]) / (2.0 * steps[k]);
                let size = expected.abs() + 1e-5 * up[i].abs() / steps[k] * 1e-3;
                let found = dual[i].derivative[k];
                assert!(
                    (found - expected).abs() < 1e-4 * size,
                    "{name}, {i} by {k}: {found} {expected}"
                );
            }
        }
    }
    // FASTSIM by one number with derivatives: the value is the same.
    let coarse = StripGrid {
        cells: 21,
        strips: 21,
    };
    let value = fastsim::forces(&plain(at[3]), &creepage([at[0], at[1], at[2]]), coarse).x;
    assert!((fastsim::forces(&patch, &dual, coarse).x.value - value).abs() < 1e-9 * value.abs());
}

/// Without friction there are no forces; with much spin on a slender ellipse Polach's stay within μN.
#[test]
fn limits_no_friction_and_slender_patches_with_spin() {
    let slippery = Patch {
        friction: 0.0,
        ..traction()
    };
    for (name, law) in laws().into_iter().skip(1) {
        let forces = law(&slippery, &creepage([1e-3, -2e-3, 0.3]));
        assert!(forces.x == 0.0 && forces.y == 0.0, "{name}: {forces:?}");
        assert!(forces.spin_moment.is_finite(), "{name}: {forces:?}");
    }
    for ratio in [0.12, 0.14, 0.2, 0.5, 1.0, 5.0] {
        let patch = patch([ratio * 8e-3, 8e-3], 80e3, 0.3);
        for lateral in [1e-4, 1e-3, 1e-2, 0.1, 1.0] {
            for spin in [0.1, 1.0, 10.0, 100.0] {
                let forces = polach::forces(&patch, &creepage([0.0, lateral, spin]), polach::DRY);
                let share = forces.x.hypot(forces.y) / patch.limit();
                assert!(
                    share <= 1.0 + 1e-12,
                    "a/b {ratio}, {lateral}, {spin}: {share} of μN"
                );
            }
        }
    }
}

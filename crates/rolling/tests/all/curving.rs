//! analytic: about steady curving going on is neutral; vibrations are those that runs show, and become those
//! of straight track.

use crate::common;
use common::{POLACH, after, freight, on_rails, track};
use integrate::{Integrator, Options};
use rolling::rig::{RigStart, Setup};
use rolling::track::RailSupport;
use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::track::{CurveElements, Segment};

const SPEED: f64 = 20.0;

/// Returns a curve to the left of a radius (m), from its beginning on; soft yaw springs, so that the wheelset
/// swings.
fn curve(radius: f64, sprung: bool) -> Setup {
    let elements = CurveElements {
        curvature: 1.0 / radius,
        superelevation: 0.05,
    };
    let mut setup = on_rails(
        &freight(),
        track(&[Segment::Curve(2000.0, elements)], Vec::new()),
        POLACH,
        SPEED,
    );
    setup.carriage.stiffness = [2e6, 2e6];
    setup.carriage.damping = [0.0; 2];
    setup.support = sprung.then(|| RailSupport::default_support("rail", 9.81));
    setup
}

/// Returns the least damped vibration between 1 and 60 rad/s.
fn least(found: &[[f64; 2]]) -> [f64; 2] {
    *found
        .iter()
        .find(|[_, frequency]| (1.0..60.0).contains(frequency))
        .expect("a vibration")
}

/// Going on along the curve and spinning on are neutral: two eigenvalues of zero, on rigid and on sprung
/// rails. The Jacobian matrix alone has one, since a step along the curve turns.
#[test]
fn analytic_going_on_along_a_curve_is_neutral() {
    for sprung in [false, true] {
        let setup = curve(1000.0, sprung);
        let start = RigStart {
            distance: 400.0,
            ..RigStart::default()
        };
        let (mut rig, x) = after(&setup, start, 1e-6, 6.0);
        let near = |found: &[[f64; 2]]| -> Vec<f64> {
            let mut sizes: Vec<f64> = found.iter().map(|[a, b]| a.hypot(*b)).collect();
            sizes.sort_by(f64::total_cmp);
            sizes
        };
        let turning = near(&rig.vibrations(&setup.lines, 6.0, &x, 1.0).unwrap());
        let alone = near(&rig.system.eigenvalues(6.0, &x, 1.0).unwrap());
        assert!(turning[1] < 1e-5 && turning[2] > 1e-2, "{turning:?}");
        assert!(alone[0] < 1e-5 && alone[1] > 1e-4, "{alone:?}");
    }
}

/// Pushed aside by 0.02 mm the wheelset swings back at the growth and the frequency that the eigenvalue says.
#[test]
fn analytic_vibrations_in_a_curve_are_those_of_runs() {
    let setup = curve(750.0, false);
    let (mut rig, x) = after(
        &setup,
        RigStart {
            distance: 10.0,
            ..RigStart::default()
        },
        1e-6,
        8.0,
    );
    let [growth, frequency] = least(&rig.vibrations(&setup.lines, 8.0, &x, 20.0).unwrap());
    assert!(growth < 0.0, "{growth}");
    let options = Options {
        relative_tolerance: 1e-8,
        ..Options::default()
    };
    // The difference of a pushed run to the steady one, to the left, over time.
    let mut pushed = x.clone();
    let seen = rig.system.observe(8.0, &x);
    let section = setup
        .lines
        .section(wheelrail::track::Line::Center, seen.bodies[1].origin.0);
    let [forward, left] = [
        rolling::wheelset::coordinate::FORWARD,
        rolling::wheelset::coordinate::LATERAL,
    ]
    .map(|own| rig.system.position_of(1, own).unwrap());
    pushed[forward] += 2e-5 * section.axes[1][0];
    pushed[left] += 2e-5 * section.axes[1][1];
    let times: Vec<f64> = (0..=600).map(|k| 8.0 + 0.005 * f64::from(k)).collect();
    let lateral = |start: &[f64]| -> Vec<f64> {
        let mut rig = rig.clone();
        let mut integrator = Integrator::new(rig.system.clone(), options.clone(), 8.0, start).unwrap();
        let mut x = start.to_vec();
        times
            .iter()
            .map(|time| {
                while integrator.time() < *time {
                    integrator.step_to(11.5).unwrap();
                }
                integrator.interpolate(*time, &mut x);
                let seen = rig.system.observe(*time, &x);
                rig.relative(&setup.lines, &seen)[1]
            })
            .collect()
    };
    let (steady, swung) = (lateral(&x), lateral(&pushed));
    let difference: Vec<f64> = swung.iter().zip(&steady).map(|(a, b)| a - b).collect();
    // Extremes of the swing after the first quarter second: half periods apart, each smaller by exp(growth
    // T/2).
    let mut extremes: Vec<[f64; 2]> = Vec::new();
    for k in 50..difference.len() - 1 {
        let [before, own, next] = [difference[k - 1], difference[k], difference[k + 1]];
        if (own - before) * (next - own) < 0.0 {
            let bend = before - 2.0 * own + next;
            let share = 0.5 * (before - next) / bend;
            extremes.push([
                times[k] + 0.005 * share,
                own - 0.125 * (next - before) * (next - before) / bend,
            ]);
        }
    }
    assert!(extremes.len() >= 3, "{}", extremes.len());
    let [first, third] = [extremes[0], extremes[2]];
    let period = third[0] - first[0];
    let measured = [
        (third[1] / first[1]).ln() / period,
        std::f64::consts::TAU / period,
    ];
    assert!(
        (measured[1] / frequency - 1.0).abs() < 0.01,
        "{measured:?} {growth} {frequency}"
    );
    assert!(
        (measured[0] - growth).abs() < 0.02 * frequency,
        "{measured:?} {growth} {frequency}"
    );
}

/// In a curve of 100 km radius vibrations are those of straight track, with linear creep forces: Polach's law
/// rounds a corner at zero creepage.
#[test]
fn limits_vibrations_in_a_wide_curve_are_those_of_straight_track() {
    let law = ContactLaw {
        creep: CreepLaw::Linear,
        ..POLACH
    };
    let level = CurveElements {
        curvature: 1e-5,
        superelevation: 0.0,
    };
    let start = RigStart {
        distance: 10.0,
        ..RigStart::default()
    };
    let found = [Segment::Curve(2000.0, level), Segment::Tangent(2000.0)].map(|segment| {
        let mut setup = on_rails(&freight(), track(&[segment], Vec::new()), law.clone(), SPEED);
        setup.carriage.damping = [0.0; 2];
        let (mut rig, x) = after(&setup, start, 1e-6, 4.0);
        least(&rig.vibrations(&setup.lines, 4.0, &x, 20.0).unwrap())
    });
    let [[growth, frequency], [expected, other]] = found;
    assert!((growth - expected).abs() < 1e-3 * other, "{found:?}");
    assert!((frequency / other - 1.0).abs() < 1e-3, "{found:?}");
}

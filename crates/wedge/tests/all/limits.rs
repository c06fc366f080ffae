//! Limits with closed forms: steady sliding, ringing in lift-off, the jam ramp, sticking and creep, symmetry.

use crate::common;
use common::{INCH, LBF, LBF_PER_IN, TOE, YAW, bristle, column_forces, free, run, with_law};
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::ContactState;
use wedge::outputs::Outputs;
use wedge::parameters::{Damping, Parameters, Start};
use wedge::{COLUMN, SLOPE, WEDGE, Wedge, thesis};

const BOTH: [Damping; 2] = [Damping::Variable, Damping::Constant];

/// Steady sliding, toe out: column friction over the force that pushes the wedge up; `a` is +1 going down, -1
/// up.
fn sliding_ratio(angle: f64, toe: f64, mu: f64, a: f64) -> f64 {
    mu * (angle.cos() - a * mu * angle.sin()) / ((1.0 + mu * mu) * (angle + toe).sin())
}

/// Mean column friction over the coil force less the weight, one value a branch (up, down), where the
/// bolster's phase lies within the given degrees; planar, toe out.
fn sliding(damping: Damping, contact_damping: f64, windows: [(f64, f64); 2]) -> [Vec<f64>; 2] {
    let mut parameters = thesis::parameters(damping, TOE, 0.0);
    parameters.wedge.free = free(&["x", "z"]);
    parameters.contact.damping = contact_damping * LBF_PER_IN;
    let wedge = Wedge::new(parameters).unwrap();
    let mut sums = [[(0.0, 0.0); 4]; 2];
    run(&wedge, 1e-6, (10.0, 0.01), |observation, _| {
        let phase = (2.0 * observation.time).to_degrees();
        let (cycle, phase) = ((phase / 360.0) as usize, phase % 360.0);
        for (sums, (from, to)) in sums.iter_mut().zip(windows) {
            if phase >= from && phase <= to {
                let net = observation.coils[0].spring_force.0[2] / LBF - 50.0;
                sums[cycle].0 += column_forces(observation).1 / LBF / net;
                sums[cycle].1 += 1.0;
            }
        }
    });
    sums.map(|sums| sums.iter().filter(|s| s.1 > 0.0).map(|s| s.0 / s.1).collect())
}

#[test]
fn steady_sliding_reaches_the_closed_forms_with_constant_damping() {
    let angle = 37.5_f64.to_radians();
    let (down, up) = (
        sliding_ratio(angle, TOE, 0.4, 1.0),
        sliding_ratio(angle, TOE, 0.4, -1.0),
    );
    assert!((down - 0.310).abs() < 5e-4 && (up - 0.585).abs() < 5e-4);
    // The last part of each branch in which the slope still slides well above the reference speed. The very
    // first branch is the start's.
    let [ups, downs] = sliding(Damping::Constant, 0.0, [(55.0, 60.0), (235.0, 240.0)]);
    println!("up {up} {ups:?} down {down} {downs:?}");
    assert!(ups.len() >= 3 && downs.len() >= 3);
    for ratio in &ups[1..] {
        assert!((ratio / up - 1.0).abs() < 5e-3, "up {ratio}, closed form {up}");
    }
    for ratio in downs {
        assert!(
            (ratio / -down - 1.0).abs() < 5e-3,
            "down {ratio}, closed form {down}"
        );
    }
}

/// The coil force changes while the faces slide. Without contact damping the contacts ring along the whole
/// branch, and the mean comes within 4 % of the closed forms by its end; with a little of it the closed forms
/// are met.
#[test]
fn steady_sliding_comes_near_the_closed_forms_with_variable_damping() {
    let angle = 32_f64.to_radians();
    let (down, up) = (
        sliding_ratio(angle, TOE, 0.4, 1.0),
        sliding_ratio(angle, TOE, 0.4, -1.0),
    );
    for (contact_damping, tolerance) in [(0.0, 0.04), (50.0, 0.005)] {
        let [ups, downs] = sliding(
            Damping::Variable,
            contact_damping,
            [(320.0, 330.0), (255.0, 264.0)],
        );
        println!("damping {contact_damping}: up {up} {ups:?} down {down} {downs:?}");
        assert!(ups.len() >= 3 && downs.len() >= 3);
        for ratio in ups {
            assert!(
                (ratio / up - 1.0).abs() < tolerance,
                "up {ratio}, closed form {up}"
            );
        }
        for ratio in downs {
            assert!(
                (ratio / -down - 1.0).abs() < tolerance,
                "down {ratio}, closed form {down}"
            );
        }
    }
}

/// The wedge on its coil, bolster lifted away: a damped oscillation about the sag, known exactly.
#[test]
fn a_lifted_off_wedge_rings_on_its_coil() {
    let (stiffness, mass, damping): (f64, f64, f64) = (3000.0, 50.0 / 386.088_582_677, 1.0);
    let omega = (stiffness / mass).sqrt();
    let ratio = 0.5 * damping / (stiffness * mass).sqrt();
    let (sag, decay) = (50.0 / stiffness, ratio * omega);
    // The specification's digits.
    assert!((omega / std::f64::consts::TAU - 24.2).abs() < 0.05);
    assert!((ratio - 0.025).abs() < 5e-4);
    assert!((1.0 / decay - 0.259).abs() < 5e-4);
    assert!((sag - 0.0167).abs() < 5e-5);
    let damped = omega * (1.0 - ratio * ratio).sqrt();
    for coordinates in [&["z"][..], &["x", "z", "pitch", "yaw"]] {
        let mut parameters = thesis::parameters(Damping::Variable, 0.0, 0.0);
        parameters.wedge.free = free(coordinates);
        parameters.bolster.coordinates[2] = Motion::Constant(INCH);
        let wedge = Wedge::new(parameters).unwrap();
        let (mut worst, mut pressed) = ([0.0_f64; 2], 0.0_f64);
        let mut crossings = Vec::new();
        let mut before = (0.0, 0.0);
        for (tolerance, worst) in [1e-6, 1e-9].into_iter().zip(&mut worst) {
            crossings.clear();
            run(&wedge, tolerance, (1.5, 0.001), |observation, _| {
                let t = observation.time;
                let z = observation.bodies[WEDGE].coordinates[2] / INCH;
                let swing = (damped * t).cos() + decay / damped * (damped * t).sin();
                let exact = -sag * (1.0 - (-decay * t).exp() * swing);
                *worst = worst.max((z - exact).abs());
                pressed = observation
                    .faces
                    .iter()
                    .flat_map(|f| &f.points)
                    .fold(pressed, |m, p| m.max(p.normal));
                let rate = z + sag;
                if t > 0.0 && before.1 > 0.0 && rate <= 0.0 {
                    crossings.push(before.0 + 0.001 * before.1 / (before.1 - rate));
                }
                before = (t, rate);
            });
        }
        println!("{coordinates:?}: {worst:?} in, contacts up to {pressed:e} N");
        // Errors of some forty periods add up.
        let scale = mechanics::system::scales::DISPLACEMENT / INCH;
        assert!(worst[0] < 100.0 * 1e-6 * scale, "{worst:?}");
        assert!(worst[1] < 100.0 * 1e-9 * scale, "{worst:?}");
        let periods = (crossings.len() - 1) as f64;
        let frequency = periods / (crossings[crossings.len() - 1] - crossings[0]);
        assert!(
            (frequency - damped / std::f64::consts::TAU).abs() < 1e-3,
            "{frequency} Hz"
        );
    }
}

/// Toe in, the slope stuck, the column sliding down: the narrowing gap is taken up by the contact springs.
///
/// Wedge and slope move together along the slope's normal by δ; the column's penetration grows by
/// `dz tan|φ| - δ cos θ`, and balance along the slope's normal asks for k_s δ = N_c (cos θ + μ sin θ):
/// `dN_c/dz = tan|φ| / (1/k_c + cos θ (cos θ + μ sin θ) / k_s)`. What is left out is the column's tilt in the
/// balance, of relative order tan φ: the tolerance is twice that.
#[test]
fn a_jam_is_an_elastic_ramp() {
    let formula = |angle: f64, toe: f64, mu: f64, [column, slope]: [f64; 2]| {
        toe.abs().tan() / (1.0 / column + angle.cos() * (angle.cos() + mu * angle.sin()) / slope)
    };
    let thesis_angle = 37.5_f64.to_radians();
    let digits = formula(thesis_angle, TOE, 0.4, [1e6; 2]);
    assert!((digits - 1915.0).abs() < 0.5, "{digits}");
    for (angle, toe, mu, preload) in [
        // So much preload that all four corners of the toed column carry.
        (thesis_angle, TOE, 0.4, 30e3),
        (thesis_angle, 0.5 * TOE, 0.4, 30e3),
        (32_f64.to_radians(), TOE, 0.4, 30e3),
        (thesis_angle, TOE, 0.5, 30e3),
        // The thesis's preload: the column's upper edge alone carries, and is half as stiff.
        (thesis_angle, TOE, 0.4, 3702.2),
    ] {
        let mut parameters = thesis::parameters(Damping::Constant, -toe, 0.0);
        parameters.wedge.free = free(&["x", "z"]);
        parameters.wedge.angle = angle;
        parameters.coil.free_length = parameters.coil.nominal_length + preload / 1979.0 * INCH;
        parameters.contact.damping = 100.0 * LBF_PER_IN;
        parameters.column_friction.coefficient = mu;
        parameters.column_friction.law = FrictionLaw::Tanh {
            reference_speed: 1e-4 * INCH,
        };
        // Stiff enough to be rigid: 1e-5 of the contact's compliance.
        parameters.slope_friction.coefficient = mu;
        parameters.slope_friction.law = FrictionLaw::Bristle {
            stiffness: 1e11 * LBF_PER_IN,
            damping: 1e6 * LBF_PER_IN,
        };
        parameters.start = Start::Equilibrium;
        parameters.bolster.coordinates[2] = Motion::Ramp {
            amplitude: -1.5 * INCH,
            start: 0.0,
            duration: 3.0,
            profile: RampProfile::Smooth,
        };
        let wedge = Wedge::new(parameters).unwrap();
        let mut points = Vec::new();
        run(&wedge, 1e-8, (2.2, 0.01), |observation, contact_states| {
            if observation.time < 1.2 {
                return;
            }
            let (normal, vertical) = column_forces(observation);
            assert!(
                (vertical / normal / -mu - 1.0).abs() < 1e-4 + 2.0 * TOE.tan(),
                "the column slides down"
            );
            assert!(
                contact_states[4..]
                    .iter()
                    .all(|contact_state| *contact_state == ContactState::Stick as u8),
                "the slope sticks: {contact_states:?}"
            );
            let closed = observation.faces[COLUMN]
                .points
                .iter()
                .filter(|p| p.gap < 0.0)
                .count();
            points.push((observation.bodies[1].travel.0[2] / INCH, normal / LBF, closed));
        });
        let (first, last) = (points[0], points[points.len() - 1]);
        let closed = if preload > 1e4 { 4 } else { 2 };
        assert!(points.iter().all(|p| p.2 == closed), "{points:?}");
        let slope = (last.1 - first.1) / (first.0 - last.0);
        let expected = formula(angle, toe, mu, [2.5e5 * closed as f64, 1e6]);
        println!(
            "{slope} {expected} over {} in, from {} lbf",
            first.0 - last.0,
            first.1
        );
        assert!(
            (slope / expected - 1.0).abs() < 2.0 * toe.tan(),
            "{slope} {expected}"
        );
        // A straight line.
        for (z, force, _) in &points {
            let line = first.1 + slope * (first.0 - z);
            assert!((force - line).abs() < 1e-3 * (last.1 - first.1), "{force} {line}");
        }
    }
}

/// Without yaw nothing turns the wedge about z or pushes it sideways.
#[test]
fn without_yaw_there_is_no_yaw_moment_and_no_lateral_force() {
    for damping in BOTH {
        for toe in [-TOE, 0.0, TOE] {
            let wedge = Wedge::new(thesis::parameters(damping, toe, 0.0)).unwrap();
            let outputs = Outputs::new(&wedge.parameters);
            let column = |name: &str| outputs.columns().iter().position(|c| c.name == name).unwrap();
            let zeros = [
                "wedge_yaw",
                "side_frame_yaw_moment",
                "bolster_yaw_moment",
                "side_frame_roll_moment",
            ]
            .map(column);
            let lateral = ["net_force_on_side_frame_y", "net_force_on_bolster_y"].map(column);
            let mut observer = wedge.system.clone();
            let _ = observer.observe(0.0, &wedge.initial_state);
            let mut largest = (0.0_f64, 0.0_f64, 0.0_f64);
            run(&wedge, 1e-6, (2.0, 0.01), |observation, contact_states| {
                let mut row = Vec::new();
                outputs.values(&observer, observation, contact_states, 0.0, &mut row);
                for i in zeros {
                    largest.0 = largest.0.max(row[i].abs());
                }
                for i in lateral {
                    largest.1 = largest.1.max(row[i].abs());
                }
                largest.2 = largest.2.max(column_forces(observation).0);
            });
            println!("{damping:?} {toe}: {largest:?}");
            // Left and right corners cancel; what is left is rounding of the forces.
            assert!(largest.2 > 1000.0);
            assert!(
                largest.0 < 1e-9 * largest.2 && largest.1 < 1e-9 * largest.2,
                "{largest:?}"
            );
        }
    }
    // And yaw makes both.
    let wedge = Wedge::new(thesis::parameters(Damping::Constant, 0.0, YAW)).unwrap();
    let mut most = 0.0_f64;
    run(&wedge, 1e-6, (1.0, 0.01), |observation, _| {
        most = most.max(
            observation.faces[SLOPE]
                .normal_forces
                .iter()
                .map(|f| f.0[1])
                .sum::<f64>()
                .abs(),
        );
    });
    assert!(most / LBF > 10.0);
}

/// Returns a wedge whose weight the column alone holds: pressed on by a shifted side frame, on a coil that is
/// hardly there.
fn hanging(law: FrictionLaw, load: f64) -> Parameters {
    let mut parameters = thesis::parameters(Damping::Variable, 0.0, 0.0);
    parameters.wedge.free = free(&["z"]);
    parameters.coil.law = CoilLaw::Linear {
        stiffness: 1e-6 * LBF_PER_IN,
    };
    parameters.coil.damping = 0.0;
    parameters.coil.acts_at = CoilLine::Seat;
    parameters.bolster.coordinates[2] = Motion::Constant(INCH);
    // μ N = 50 lbf / load.
    parameters.side_frame.coordinates[0] = Motion::Constant(50.0 / load / 0.4 / 1e6 * INCH);
    with_law(parameters, law)
}

#[test]
fn tanh_creeps_under_a_held_load_as_predicted() {
    for load in [0.25_f64, 0.5, 0.9] {
        let speed = 1e-3;
        let law = FrictionLaw::Tanh {
            reference_speed: speed * INCH,
        };
        let wedge = Wedge::new(hanging(law, load)).unwrap();
        let mut fallen = [0.0; 2];
        run(&wedge, 1e-8, (10.0, 1.0), |observation, _| {
            let z = -observation.bodies[WEDGE].coordinates[2] / INCH;
            if (observation.time - 1.0).abs() < 1e-9 {
                fallen[0] = z;
            }
            fallen[1] = z;
        });
        let predicted = speed * load.atanh() * 9.0;
        // The coil takes 1e-6 lbf/in times the way; the integrator 1e-8 of 0.39 in a step.
        let found = fallen[1] - fallen[0];
        println!("load {load}: crept {found} in 9 s, predicted {predicted}");
        assert!((found / predicted - 1.0).abs() < 1e-5, "{found} {predicted}");
        assert!((law.creep_speed(load) / INCH - speed * load.atanh()).abs() < 1e-15);
    }
}

#[test]
fn the_bristle_holds_a_load_without_creep() {
    for load in [0.25, 0.5, 0.9] {
        let wedge = Wedge::new(hanging(bristle(), load)).unwrap();
        let mut places = Vec::new();
        run(&wedge, 1e-8, (11.0, 1.0), |observation, contact_states| {
            places.push(-observation.bodies[WEDGE].coordinates[2] / INCH);
            assert!(
                observation.time == 0.0
                    || contact_states[..4]
                        .iter()
                        .all(|contact_state| *contact_state == ContactState::Stick as u8)
            );
        });
        // Elastic: weight over the bristle's stiffness.
        let expected = 50.0 / 1e6;
        assert!((places[1] / expected - 1.0).abs() < 1e-6, "{places:?}");
        assert!(
            (places[11] - places[1]).abs() < 1e-12,
            "{:e} in over 10 s",
            places[11] - places[1]
        );
    }
    // Beyond its limit it slides, with the acceleration that is left: g (1 - 1/load).
    let wedge = Wedge::new(hanging(bristle(), 1.25)).unwrap();
    let mut last = (0.0, 0.0);
    run(&wedge, 1e-8, (0.5, 0.5), |observation, _| {
        last = (observation.time, -observation.bodies[WEDGE].speeds[2] / INCH);
    });
    let expected = 386.0886 * 0.2 * last.0;
    assert!((last.1 / expected - 1.0).abs() < 1e-3, "{last:?} {expected}");
}

/// Slope and column together: the bolster rises and stays. The bristle keeps every force for ten seconds;
/// tanh lets go.
#[test]
fn a_held_bolster_is_held_by_bristles_and_not_by_tanh() {
    let case = |law| {
        let mut parameters = thesis::parameters(Damping::Constant, TOE, 0.0);
        parameters.start = Start::Touching;
        parameters.contact.damping = 100.0 * LBF_PER_IN;
        parameters.bolster.coordinates[2] = Motion::Ramp {
            amplitude: 0.2 * INCH,
            start: 0.0,
            duration: 1.0,
            profile: RampProfile::Smooth,
        };
        let wedge = Wedge::new(with_law(parameters, law)).unwrap();
        let mut rows = Vec::new();
        run(&wedge, 1e-8, (12.0, 0.5), |observation, contact_states| {
            let forces = column_forces(observation);
            rows.push((
                observation.time,
                forces.0 / LBF,
                forces.1 / LBF,
                contact_states.to_vec(),
            ));
        });
        rows
    };
    let held = case(bristle());
    let (first, last) = (&held[4], &held[24]);
    println!("bristle: {first:?} {last:?}");
    assert!(first.2.abs() > 500.0, "friction carries a load: {first:?}");
    assert!((last.1 / first.1 - 1.0).abs() < 1e-6 && (last.2 / first.2 - 1.0).abs() < 1e-6);
    let let_go = case(FrictionLaw::Tanh {
        reference_speed: 1e-3 * INCH,
    });
    let (first, last) = (&let_go[4], &let_go[24]);
    println!("tanh: {first:?} {last:?}");
    // It falls by a quarter and more within ten seconds, all corners "sticking".
    assert!(last.2 / first.2 < 0.75, "{first:?} {last:?}");
}

//! analytic, energy: rails as beams that two wheels share.

use integrate::{Integrator, Options};
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::system::{Model, System};
use rolling::beam::RailBeam;
use rolling::track::{RailSupport, rail_body};

const WHEELBASE: f64 = 1.778;

/// Deflection of a beam on springs by finite differences: `EI w'''' + k w = P δ`, ends far away and free to
/// sink, by elimination of its five diagonals; at the load and at a distance.
fn by_differences(bending: f64, foundation: f64, load: f64, distance: f64) -> [f64; 2] {
    let step = distance / 80.0;
    let half = 1600;
    let count = 2 * half + 1;
    let own = bending / (step * step * step * step);
    // Rows of a symmetric matrix of bandwidth 2; beyond the ends nothing moves.
    let mut rows = vec![[6.0 * own + foundation, -4.0 * own, own]; count];
    let mut right = vec![0.0; count];
    right[half] = load / step;
    for k in 0..count {
        for beside in 1..3 {
            if k + beside >= count {
                break;
            }
            let factor = rows[k][beside] / rows[k][0];
            for other in beside..3 {
                rows[k + beside][other - beside] -= factor * rows[k][other];
            }
            right[k + beside] -= factor * right[k];
        }
    }
    for k in (0..count).rev() {
        for beside in 1..3 {
            if k + beside < count {
                right[k] -= rows[k][beside] * right[k + beside];
            }
        }
        right[k] /= rows[k][0];
    }
    [right[half], right[half + 80]]
}

/// The closed form of the beam on springs against its differential equation.
#[test]
fn analytic_the_beam_deflects_as_its_equation_says() {
    let beam = RailBeam::rail_136re();
    let stiffness = 80e6;
    for bending in beam.bending {
        let rate = (stiffness / (8.0 * bending)).cbrt();
        let foundation = 4.0 * bending * rate.powi(4);
        let found = by_differences(bending, foundation, 1e5, WHEELBASE);
        for (found, at) in found.into_iter().zip([0.0, WHEELBASE]) {
            let closed = 1e5 * RailBeam::deflection(stiffness, bending, at);
            assert!(
                (found - closed).abs() < 2e-3 * 1e5 / stiffness,
                "{at}: {found} {closed}"
            );
        }
    }
    // Torsion: the roll under a moment turns it into the rail on both sides and into the foundation along it.
    let (own, ahead) = (beam.roll(0.0), beam.roll(1e-6));
    assert!(((own - ahead) / 1e-6 * 2.0 * beam.torsion - 1.0).abs() < 1e-5);
    let step = 1e-3;
    let spread: f64 = (0..20_000)
        .map(|k| beam.roll(step * (f64::from(k) + 0.5)) * step)
        .sum();
    assert!((2.0 * spread * beam.roll_stiffness - 1.0).abs() < 1e-5);
}

/// Two pieces of rail under loads (N, up) on springs that they share; they start unloaded.
fn two_pieces(support: &RailSupport, beam: &RailBeam, loads: [f64; 2]) -> (System, Vec<f64>) {
    let shared = beam.shared(support, WHEELBASE);
    let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
    let mut pieces = [rail_body(support), rail_body(support)];
    for (number, piece) in pieces.iter_mut().enumerate() {
        piece.name = format!("piece {number}");
    }
    let [first, second] = pieces;
    let mut model = Model::new(vec![ground, first, second], [0.0, 0.0, -9.81]);
    let track = Marker::new([0.0; 3], [0.0; 3]);
    for (number, up) in loads.into_iter().enumerate() {
        let loaded = RailSupport {
            name: format!("springs {number}"),
            preload: shared.ground.preload + up,
            ..shared.ground.clone()
        };
        model.add(loaded, (number + 1, track), (0, track));
    }
    model.add(shared.between, (1, track), (2, track));
    let system = System::new(model).unwrap();
    let start = system.initial_state();
    (system, start)
}

/// Two wheels press two pieces of rail down as one beam, to what the closed form says, and the ledger closes
/// on the way.
#[test]
fn analytic_two_wheels_on_one_beam() {
    let support = RailSupport::default_support("rail", 9.81);
    let beam = RailBeam::rail_136re();
    let loads = [-150e3, -90e3];
    let (mut system, start) = two_pieces(&support, &beam, loads);
    let stored = system.observe(0.0, &start).energies.total();
    let options = Options {
        relative_tolerance: 1e-9,
        ..Options::default()
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &start).unwrap();
    while integrator.time() < 1.0 {
        integrator.step_to(1.0).unwrap();
    }
    let seen = system.observe(integrator.time(), integrator.x());
    let deflection = |at: f64| RailBeam::deflection(support.stiffness[1], beam.bending[1], at);
    let [own, other] = [deflection(0.0), deflection(WHEELBASE)];
    for (number, [near, far]) in [[loads[0], loads[1]], [loads[1], loads[0]]]
        .into_iter()
        .enumerate()
    {
        let expected = own * near + other * far;
        let found = seen.bodies[number + 1].origin.0[2];
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }
    // The neighbor counts.
    assert!(other > 0.05 * own, "{own} {other}");
    let residual = seen.residual(stored);
    assert!(
        residual.abs() < 1e-6 * seen.losses.abs(),
        "{residual} {}",
        seen.losses
    );
}

/// Level springs are the inverse of the base's flexibility; rolls are those of the moments under both wheels.
#[test]
fn analytic_the_base_moves_aside_and_the_rail_rolls() {
    let support = RailSupport::default_support("rail", 9.81);
    let beam = RailBeam::rail_136re();
    let shared = beam.shared(&support, WHEELBASE);
    let forces = [30e3, -10e3];
    let base = |at: f64| RailBeam::deflection(support.stiffness[0], beam.bending[0], at);
    let moments = forces.map(|force| force * beam.height);
    let rolls = beam.rolls(moments.map(|moment| moment / beam.rolling().stiffness), WHEELBASE);
    for k in 0..2 {
        let other = 1 - k;
        let moved = |i: usize| base(0.0) * forces[i] + base(WHEELBASE) * forces[1 - i];
        let [ground, between] = [shared.ground.stiffness[0], shared.between.stiffness[0]];
        let force = ground * moved(k) + between * (moved(k) - moved(other));
        assert!((force / forces[k] - 1.0).abs() < 1e-12, "{force}");
        let roll = beam.roll(0.0) * moments[k] + beam.roll(WHEELBASE) * moments[other];
        assert!((rolls[k] / roll - 1.0).abs() < 1e-12, "{rolls:?} {roll}");
    }
}

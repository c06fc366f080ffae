//! analytic, energy: cars on rails that the wheels of a truck share as beams.

use car::{Car, Parameters, StartKind};
use integrate::Problem;
use rolling::beam::RailBeam;

use crate::common::{at_start, curve, loaded, run, tangent};

fn on_beams(mut parameters: Parameters) -> Parameters {
    if let Some(support) = &mut parameters.support {
        support.beam = Some(RailBeam::rail_136re());
    }
    parameters
}

/// Under a car at rest rails sink as beams on springs do under both wheels of a truck; rolls and gauge
/// follow from the forces and their places by the closed form.
#[test]
fn analytic_rails_under_a_car_at_rest() {
    let parameters = on_beams(loaded(tangent(200.0), 0.0));
    let car = Car::new(&parameters).unwrap();
    let loads = at_start(&car);
    let mut system = car.system.clone();
    let seen = system.observe(0.0, &car.initial_state);
    let support = parameters.support.as_ref().unwrap();
    let beam = support.beam.as_ref().unwrap();
    let wheelbase = parameters.trucks[0].geometry.wheelbase;
    let flexibility = |direction: usize| {
        [0.0, wheelbase]
            .map(|at| RailBeam::deflection(support.stiffness[direction], beam.bending[direction], at))
    };
    let ([near, far], [aside, far_aside]) = (flexibility(1), flexibility(0));
    let rails = car.numbers.rails.unwrap();
    // Moments of the patches about the base, in axes of the head.
    let mut moments = [[0.0; 2]; 4];
    car.patches(&seen, |w, side, patch| {
        let (normal, across, place) = (patch.patch.normal(), patch.patch.across(), patch.patch.place);
        let on_rail = |k: usize| {
            -(normal[k] * patch.forces.normal + across[k] * patch.forces.creep.y) * patch.patch.share
        };
        moments[w][side] += on_rail(1) * (place[2] + beam.height) - on_rail(2) * (place[1] - beam.base);
    });
    let roll = |at: f64| {
        let rate = (beam.roll_stiffness / beam.torsion).sqrt();
        libm::exp(-rate * at) / (2.0 * (beam.torsion * beam.roll_stiffness).sqrt())
    };
    for w in 0..4 {
        let other = [1, 0, 3, 2][w];
        let mut widening = 0.0;
        for side in 0..2 {
            let (own, beside) = (&loads.wheels[w][side], &loads.wheels[other][side]);
            let sunk = near * own.vertical + far * beside.vertical;
            let found = -seen.bodies[rails[w][side]].origin.0[2];
            assert!((found / sunk - 1.0).abs() < 1e-3, "{w} {side}: {found} {sunk}");
            let expected = roll(0.0) * moments[w][side] + roll(wheelbase) * moments[other][side];
            assert!(
                (own.rail_roll - expected).abs() < 0.01 * expected.abs(),
                "{} {expected}",
                own.rail_roll
            );
            widening += aside * own.lateral + far_aside * beside.lateral + beam.height * expected;
        }
        let found = loads.axles[w].gauge_widening;
        assert!(
            (found - widening).abs() < 0.01 * widening.abs(),
            "{w}: {found} {widening}"
        );
    }
    // The neighbor is felt.
    assert!(far > 0.05 * near);
}

/// In a curve the high rail rolls outwards under the leading axle, the gauge widens, and the ledger closes.
#[test]
fn energy_a_curve_on_shared_rails() {
    let track = curve(6.0, 1.0, 0.075, 150.0);
    let ran = run(&on_beams(loaded(track, 10.0)), 12.0, 0.5, 1e-5);
    assert!(ran.residual < 1e-3, "{}", ran.residual);
    let last = ran.last();
    let leading = &last.wheels[0];
    // The track curves to the left: the right rail is the high one.
    assert!(leading[1].lateral > 5e3, "{leading:?}");
    assert!(
        leading[1].rail_roll > 0.0 && leading[1].rail_roll < 0.02,
        "{leading:?}"
    );
    assert!(last.axles[0].gauge_widening > 1e-4, "{:?}", last.axles[0]);
    assert!(last.axles[0].gauge_widening < 0.01, "{:?}", last.axles[0]);
}

/// What friction holds after shaking holds on rails that roll: the car comes to rest and starts so, as well
/// as on pieces of rail.
#[test]
fn limits_a_shaken_car_rests_on_shared_rails() {
    let shaken = |mut parameters: Parameters| {
        parameters.start.kind = StartKind::Shaken;
        let car = Car::new(&parameters).map_err(|error| error.to_string()).unwrap();
        assert_eq!(car.start_warning, None);
        let mut system = car.system.clone();
        let mut rates = vec![0.0; car.initial_state.len()];
        system.derivative(0.0, &car.initial_state, &mut rates);
        let speeds = system.layout().speeds;
        let own = &rates[speeds..2 * speeds];
        own.iter().fold(0.0, |most: f64, own| most.max(own.abs()))
    };
    let pieces = loaded(tangent(200.0), 0.0);
    let [on_pieces, shared] = [pieces.clone(), on_beams(pieces)].map(shaken);
    assert!(shared < 0.1 && shared < 2.0 * on_pieces, "{shared} {on_pieces}");
}

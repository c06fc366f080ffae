//! Momentum of a whole truck.

use integrate::Problem;
use mechanics::vector::Vector;
use truck::{CarBody, Lading, Parameters, SideBearings, Truck};
use wedge::parameters::Damping;

/// A truck in free fall without wheelsets, all its bodies free, displaced, turned and moving: what acts
/// between them changes neither momentum nor angular momentum of the whole.
#[test]
fn analytic_a_free_truck_keeps_its_momentum() {
    for damping in [Damping::Constant, Damping::Variable] {
        let mut parameters = Parameters::new(damping);
        parameters.gravity = 0.0;
        parameters.wheelsets = None;
        parameters.bolster.free = [true; 6];
        let mut car = CarBody::new(Lading::Loaded, SideBearings::constant_contact());
        car.free = [true; 6];
        parameters.car_body = Some(car);
        let mut truck = Truck::new(&parameters).unwrap();
        let system = &mut truck.system;
        let mut x = truck.initial_state.clone();
        let n = system.layout().speeds;
        assert_eq!(n, 48);
        // Numbers that lie evenly between -1 and 1.
        let mut even = (1..).map(|i| 2.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract() - 1.0);
        for value in &mut x[..n] {
            *value += 3e-3 * even.next().unwrap();
        }
        for value in &mut x[n..2 * n] {
            *value = 0.3 * even.next().unwrap();
        }
        for value in &mut x[2 * n..2 * n + system.layout().internals] {
            *value = 1e-5 * even.next().unwrap();
        }
        let mut dx = vec![0.0; x.len()];
        system.derivative(0.0, &x, &mut dx);
        let h = 1e-7;
        let mut momenta = |sign: f64| {
            let moved: Vec<f64> = x.iter().zip(&dx).map(|(x, rate)| x + sign * h * rate).collect();
            let observation = system.observe(0.0, &moved);
            let (mut linear, mut angular) = (Vector([0.0; 3]), Vector([0.0; 3]));
            let bodies = observation.bodies.iter().zip(system.bodies());
            for (state, body) in bodies.filter(|(_, body)| !body.is_prescribed()) {
                let own: Vector<f64> = state.rotation.apply_transposed(state.angular_velocity);
                let spin = Vector([0, 1, 2].map(|k| body.inertia[k] * own.0[k]));
                let momentum: Vector<f64> = state.velocity.scale(body.mass);
                linear += momentum;
                angular += state.center_of_gravity.cross::<f64, f64>(momentum);
                angular += state.rotation.apply::<f64, f64>(spin);
            }
            [linear, angular]
        };
        let (up, down) = (momenta(1.0), momenta(-1.0));
        // Against the largest force on a body.
        let masses = truck.system.bodies().iter().filter(|body| !body.is_prescribed());
        let forces = masses.enumerate().flat_map(|(number, body)| {
            let rates = &dx[n + 6 * number..][..3];
            rates.iter().map(|rate| (rate * body.mass).abs())
        });
        let largest = forces.fold(0.0, f64::max);
        assert!(largest > 1e5, "{largest}");
        for (up, down) in up.into_iter().zip(down) {
            for rate in (up - down).0 {
                assert!((rate / (2.0 * h)).abs() < 1e-6 * largest, "{rate:e} of {largest}");
            }
        }
    }
}

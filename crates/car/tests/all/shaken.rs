//! Cars that start with what friction holds after they have been shaken.

use crate::common;
use car::{BuildError, Car, Parameters, StartKind, Wheels};
use common::{INCH, MPH, POUND_FORCE, at_start, curve, loaded, massless, put_on_gauge, run, tangent};
use integrate::Problem;
use wheelrail::contact::CreepLaw;

fn starting(mut parameters: Parameters, kind: StartKind) -> Parameters {
    parameters.start.kind = kind;
    parameters
}

/// Returns the loaded car, shaken, at a speed (mph).
fn shaken(speed: f64) -> Parameters {
    starting(loaded(tangent(200.0), speed * MPH), StartKind::Shaken)
}

/// Returns the column forces of all wedges at the start, lbf.
fn columns(parameters: &Parameters) -> Vec<f64> {
    let loads = at_start(&Car::new(parameters).unwrap());
    let wedges = loads.trucks.iter().flat_map(|truck| &truck.wedges);
    wedges.map(|own| own.column_normal / POUND_FORCE).collect()
}

fn sum(values: &[f64]) -> f64 {
    values.iter().sum()
}

/// Returns the largest acceleration of the bodies above the wheelsets (m/s², rad/s²), and that of wheelsets
/// and rails beside the spin.
fn accelerations(parameters: &Parameters) -> [f64; 2] {
    let mut car = Car::new(parameters).unwrap();
    let x = car.initial_state.clone();
    let mut rates = vec![0.0; x.len()];
    car.system.derivative(0.0, &x, &mut rates);
    let first = car.system.layout().speeds;
    let mut largest = [0.0_f64; 2];
    for number in 0..car.system.bodies().len() {
        let wheelset = car.numbers.wheelsets.contains(&number);
        let mut rails = car.numbers.rails.into_iter().flatten().flatten();
        let below = wheelset || rails.any(|own| own == number);
        if car.numbers.carriers.contains(&number) {
            continue;
        }
        for coordinate in (0..6).filter(|own| !wheelset || *own != 3) {
            if let Some(place) = car.system.position_of(number, coordinate) {
                let own = &mut largest[usize::from(below)];
                *own = own.max(rates[first + place].abs());
            }
        }
    }
    largest
}

/// At the start nothing moves but for the wheels' creep, as in the equilibrium, and a second on perfect track
/// does not change what is locked in.
#[test]
fn analytic_a_shaken_car_is_at_rest() {
    let shaken = shaken(18.0);
    let [above, below] = accelerations(&shaken);
    let [above_usual, below_usual] = accelerations(&starting(shaken.clone(), StartKind::Equilibrium));
    let ran = run(&shaken, 1.0, 0.1, 1e-5);
    let start = columns(&shaken);
    for (time, loads) in &ran.loads {
        let wedges = loads.trucks.iter().flat_map(|truck| &truck.wedges);
        for (own, start) in wedges.zip(&start) {
            let force = own.column_normal / POUND_FORCE;
            assert!((force / start - 1.0).abs() < 5e-3, "{time}: {force} {start}");
        }
    }
    assert!(ran.residual < 1e-3, "{}", ran.residual);
    assert!(above < above_usual + 1e-3, "{above} {above_usual}");
    assert!(below < 1.02 * below_usual, "{below} {below_usual}");
}

/// Columns carry less than without friction, and more than where the car comes to rest from the nominal
/// layout, which is the other end of what friction can hold.
#[test]
fn limits_columns_lie_between_those_of_the_other_starts() {
    let own = shaken(18.0);
    let shaken = columns(&own);
    let equilibrium = columns(&starting(own.clone(), StartKind::Equilibrium));
    let nominal = run(&starting(own.clone(), StartKind::Nominal), 1.5, 0.1, 1e-5);
    let wedges = nominal.last().trucks.iter().flat_map(|truck| &truck.wedges);
    let nominal: Vec<f64> = wedges.map(|own| own.column_normal / POUND_FORCE).collect();
    for (own, most) in shaken.iter().zip(&equilibrium) {
        assert!(*own < 0.95 * most && *own > 0.7 * most, "{own} {most}");
    }
    assert!(sum(&shaken) > sum(&nominal), "{shaken:?} {nominal:?}");
    let before = Car::new(&own).unwrap().before_shaking.unwrap();
    let before = before.iter().flatten().map(|own| own.column_normal / POUND_FORCE);
    for (before, own) in before.zip(&equilibrium) {
        assert!((before / own - 1.0).abs() < 1e-6, "{before} {own}");
    }
}

/// What is locked in is no more than friction holds: at no point is the friction above its limit, and some
/// points hold a good part of it.
#[test]
fn limits_friction_at_the_start_keeps_its_limit() {
    let mut car = Car::new(&shaken(18.0)).unwrap();
    let x = car.initial_state.clone();
    let seen = car.system.observe(0.0, &x);
    let mut most = 0.0_f64;
    for (face, mounted) in seen.faces.iter().zip(car.system.faces()) {
        for (normal, friction) in face.normal_forces.iter().zip(&face.friction_forces) {
            let [normal, friction] = [normal, friction].map(|own| own.dot::<f64, f64>(*own).sqrt());
            let limit = mounted.element.coefficient * normal;
            assert!(
                friction <= limit * (1.0 + 1e-9) + 1e-6,
                "{}: {friction} of {limit}",
                mounted.element.name
            );
            if limit > 0.0 {
                most = most.max(friction / limit);
            }
        }
    }
    assert!(most > 0.5, "{most}");
}

/// Speed, place and track change no bit of what is locked in; nor does computing it once more, on two threads
/// at the same time.
#[test]
fn reproducible_a_shaken_car_is_the_same_at_all_speeds() {
    let internal = |parameters: &Parameters| -> Vec<u64> {
        let car = Car::new(parameters).unwrap();
        let layout = car.system.layout();
        let own = &car.initial_state[2 * layout.speeds..2 * layout.speeds + layout.internals];
        own.iter().map(|own| own.to_bits()).collect()
    };
    let first = internal(&shaken(18.0));
    assert!(first.iter().any(|own| f64::from_bits(*own).abs() > 1e-6));
    assert_eq!(first, internal(&shaken(50.0)));
    let mut elsewhere = starting(loaded(curve(5.0, 1.0, 0.1, 200.0), 25.0 * MPH), StartKind::Shaken);
    elsewhere.start.distance = 60.0;
    assert_eq!(first, internal(&elsewhere));
    // Cars with other names are shaken for themselves.
    let threads = ["coal", "ore"].map(|name| {
        let mut own = shaken(18.0);
        own.lading[0].name = name.to_owned();
        std::thread::spawn(move || {
            let car = Car::new(&own).unwrap();
            car.initial_state
                .iter()
                .map(|own| own.to_bits())
                .collect::<Vec<u64>>()
        })
    });
    let [one, other] = threads.map(|own| own.join().unwrap());
    assert_eq!(one, other);
    let whole = Car::new(&shaken(18.0)).unwrap().initial_state;
    assert_eq!(one, whole.iter().map(|own| own.to_bits()).collect::<Vec<u64>>());
}

/// A car that starts in a curve, or with axles and body aside, has the same locked in.
#[test]
fn limits_a_shaken_car_starts_in_a_curve_and_aside() {
    let straight = columns(&shaken(18.0));
    let mut bent = starting(
        loaded(curve(7.5, 1.0, 4.0 * INCH, 200.0), 28.0 * MPH),
        StartKind::Shaken,
    );
    bent.start.distance = 150.0;
    let mut aside = shaken(18.0);
    aside.start.wheelset_shifts = [0.2 * INCH; 4];
    aside.start.body_shift = 0.1 * INCH;
    for (parameters, far) in [(bent, 0.2), (aside, 0.02)] {
        for (own, straight) in columns(&parameters).iter().zip(&straight) {
            assert!((own / straight - 1.0).abs() < far, "{own} {straight}");
        }
        let ran = run(&parameters, 0.5, 0.1, 1e-5);
        let usual = run(&starting(parameters, StartKind::Equilibrium), 0.5, 0.1, 1e-5);
        assert!((ran.time - 0.5).abs() < 1e-9);
        assert!(
            ran.residual < 2.0 * usual.residual.max(1e-4),
            "{} {}",
            ran.residual,
            usual.residual
        );
    }
}

/// Rails that do not give way, bases that can be moved, tables of contacts and wedges without mass.
#[test]
fn limits_other_cars_are_shaken_too() {
    let mut rigid = shaken(18.0);
    rigid.support = None;
    let mut movable = shaken(18.0);
    movable.movable_rails = true;
    if let Wheels::OnRails(wheels) = &mut movable.wheels {
        wheels.tables = true;
    }
    for parameters in [rigid, movable, massless(shaken(18.0))] {
        let start = columns(&parameters);
        let ran = run(&parameters, 0.3, 0.1, 1e-4);
        let wedges = ran.last().trucks.iter().flat_map(|truck| &truck.wedges);
        for (own, start) in wedges.zip(&start) {
            let force = own.column_normal / POUND_FORCE;
            assert!(
                force > 1e3 && (force / start - 1.0).abs() < 0.02,
                "{force} {start}"
            );
        }
    }
}

/// A car that leaves the rails while it is shaken says when and where, and what needs no shaking.
#[test]
fn input_cars_that_cannot_be_shaken_are_refused() {
    let mut wide = shaken(18.0);
    put_on_gauge(&mut wide, 60.5);
    if let Wheels::OnRails(wheels) = &mut wide.wheels {
        for law in wheels.laws.iter_mut() {
            law.creep = CreepLaw::Frictionless;
        }
    }
    let error = Car::new(&wide).unwrap_err();
    let text = error.to_string();
    assert!(
        matches!(error, BuildError::Shaking { time, .. } if time > 0.0),
        "{text}"
    );
    for part in ["left its rail", "FRA class 3", "start in equilibrium"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

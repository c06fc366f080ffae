//! Elements that create energy, in a system that rolls along as a car does: whether they hide it or book it
//! as a negative loss, they are found; the same system without them has nothing to say.

use crate::common::{body, ground, options};
use integrate::{Integrator, Method};
use mechanics::element::{Element, Wrench};
use mechanics::elements::ShearSpring;
use mechanics::energy_balance::{EnergyBalance, Verdict};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::plausibility::{FindingKind, Location, Plausibility, PlausibilityFinding};
use mechanics::system::{Model, System};
use mechanics::vector::Vector;
use numerics::scalar::Real;

const TOLERANCE: f64 = 1e-4;
const SPEED: f64 = 20.0;
const INTERVAL: f64 = 0.01;

/// A force across the deflection, `q (0, -z, y)`: no energy belongs to it.
#[derive(Clone, Debug)]
struct Follower {
    strength: f64,
    /// True if its power is booked as a loss.
    booked: bool,
}

impl Element for Follower {
    fn name(&self) -> &str {
        "follower"
    }

    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let [_, y, z] = motion.position.0;
        let force = Vector([S::zero(), z * -self.strength, y * self.strength]);
        let power = if self.booked {
            -force.dot::<S, S>(motion.velocity)
        } else {
            S::zero()
        };
        Wrench {
            force,
            moment: Vector::zero(),
            powers: [power, S::zero()],
        }
    }

    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}

/// Returns a body of 25 t on springs on a frame of 5 t on springs on the ground, which both move ahead with
/// 20 m/s: the lower springs are dragged along, since they act up and aside alone.
fn car(follower: Option<Follower>) -> (System, Vec<f64>) {
    let free = [true, true, true, false, false, false];
    let bodies = vec![
        body(
            "body",
            25e3,
            [1.0; 3],
            [0.0; 3],
            free,
            [0.0, 0.05, 1.0, 0.0, 0.0, 0.0],
        ),
        body("frame", 5e3, [1.0; 3], [0.0; 3], free, [0.0; 6]),
        ground(),
    ];
    let mut model = Model::new(bodies, [0.0, 0.0, -9.81]);
    let spring = |name: &str, load: f64, stiffness: f64| ShearSpring {
        name: name.to_owned(),
        preload: load * 9.81,
        stiffness,
        shear_stiffness: 0.8 * stiffness,
        damping: 0.002 * stiffness,
        solid: None,
    };
    let nominal = Marker::new([0.0, 0.0, 1.0], [0.0; 3]);
    let own = Marker::new([0.0; 3], [0.0; 3]);
    model.add(spring("upper", 25e3, 3e6), (0, own), (1, nominal));
    model.add(Rail(spring("lower", 30e3, 3e7)), (1, own), (2, own));
    if let Some(follower) = follower {
        model.add(follower, (0, own), (1, nominal));
    }
    let system = System::new(model).unwrap();
    let mut x = system.initial_state();
    let first = system.layout().speeds;
    for number in 0..2 {
        x[first + system.position_of(number, 0).unwrap()] = SPEED;
    }
    (system, x)
}

/// A spring that does not act along the track.
#[derive(Clone, Debug)]
struct Rail(ShearSpring);

impl Rail {
    fn across<S: Real>(motion: &RelativeMotion<S>) -> RelativeMotion<S> {
        let mut across = *motion;
        (across.position.0[0], across.velocity.0[0]) = (S::zero(), S::zero());
        across
    }
}

impl Element for Rail {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        self.0.evaluate(&Self::across(motion))
    }

    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        self.0.energy(&Self::across(motion))
    }
}

/// Runs a car for some seconds with output times as a run has them.
fn run(follower: Option<Follower>, duration: f64) -> (EnergyBalance, Vec<PlausibilityFinding>, System) {
    let (mut system, x) = car(follower);
    let start = system.energies(0.0, &x).total();
    let mut balance = EnergyBalance::new(start);
    let mut plausibility = Plausibility::new(&mut system, 0.0, &x);
    let mut integrator =
        Integrator::new(system.clone(), options(Method::TrBdf2, TOLERANCE), 0.0, &x).unwrap();
    let (mut row, mut buffer) = (1.0, x);
    while integrator.time() < duration {
        integrator.step_to(duration).unwrap();
        while row * INTERVAL <= integrator.time() {
            let time = row * INTERVAL;
            integrator.interpolate(time, &mut buffer);
            system.segment_like(integrator.problem());
            let seen = system.observe(time, &buffer);
            let mut entries = system.ledger_entries(&seen, start);
            entries.admissible = TOLERANCE * system.energy_of_speed_errors(time, &buffer);
            balance.note(time, &entries);
            plausibility.note(&mut system, time, &buffer);
            row += 1.0;
        }
    }
    let mut findings = plausibility.findings(&system, &balance, INTERVAL);
    // Both leave the place where they started.
    findings.retain(|finding| finding.kind != FindingKind::Displacement);
    (balance, findings, system)
}

#[test]
fn issue_047_a_car_on_springs_has_nothing_to_say() {
    for duration in [0.1, 0.4, 1.0, 4.0] {
        let (balance, findings, _) = run(None, duration);
        println!("{duration} s: {:.1e}", balance.relative_residual());
        assert_eq!(balance.verdict(), Verdict::Closed, "{balance:?}");
        assert!(findings.is_empty(), "{findings:?}");
    }
    // One step may err by the momenta times a thousandth of a meter per second.
    let (balance, ..) = run(None, 0.1);
    let momenta = 30e3 * SPEED * 10.0 * TOLERANCE;
    assert!((balance.admissible / momenta - 1.0).abs() < 1e-2, "{balance:?}");
}

#[test]
fn issue_047_an_element_that_hides_what_it_creates_fails_the_ledger() {
    let strength = 2e5;
    let follower = |booked| Some(Follower { strength, booked });
    let (balance, findings, _) = run(follower(false), 4.0);
    println!("{:.1e} of {balance:?}", balance.relative_residual());
    assert_eq!(balance.verdict(), Verdict::Failed, "{balance:?}");
    assert!(findings.is_empty(), "{findings:?}");
}

#[test]
fn issue_047_an_element_that_books_what_it_creates_is_found() {
    let strength = 2e5;
    let (balance, findings, system) = run(
        Some(Follower {
            strength,
            booked: true,
        }),
        4.0,
    );
    assert_eq!(balance.verdict(), Verdict::Closed, "{balance:?}");
    assert_eq!(findings.len(), 1, "{findings:?}");
    let [finding] = findings[..] else { return };
    assert_eq!(finding.kind, FindingKind::EnergyCreated);
    let Location::EnergyTerm(number) = finding.location else {
        panic!("{finding:?}")
    };
    assert_eq!(system.energy_terms()[number].name(), "follower_element_loss");
    // What it created is what the bodies have more than without it, to the share that the dampers take.
    assert!(
        finding.value > 1000.0 && finding.value > 100.0 * finding.limit,
        "{finding:?}"
    );
    assert!(finding.time.is_some_and(|time| time > 3.5), "{finding:?}");
    let words = finding.words(&finding.location.describe(&system), quantity::System::Si);
    assert!(
        words.starts_with("`follower_element_loss` is a loss below zero"),
        "{words}"
    );
}

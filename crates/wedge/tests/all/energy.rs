//! The energy ledger: work of the motions = change of the stored energy + losses, each of them integrated
//! from its own force and velocity. It closes for every combination, and does not close when one entry is
//! left out.

use crate::common;
use common::{End, INCH, LBF, LBF_IN, LBF_PER_IN, TOE, YAW, bristle, run, with_law};
use mechanics::characteristic::Characteristic;
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::energy_balance::EnergyBalance;
use mechanics::friction::FrictionLaw;
use mechanics::motion::{Motion, RampProfile};
use mechanics::system::EnergyTermKind;
use wedge::parameters::{Damping, Parameters, Start};
use wedge::{Wedge, thesis};

const BOTH: [Damping; 2] = [Damping::Variable, Damping::Constant];
/// As the thesis's runs.
const UNTIL: f64 = 10.0;

/// Runs and checks on the way: losses never negative and never falling, and with tanh no friction power into
/// the wedge. Returns the end and the relative residual of the ledger.
fn checked(parameters: Parameters, tolerance: f64, until: f64) -> (End, f64) {
    let wedge = Wedge::new(parameters).unwrap();
    let losses: Vec<usize> = (0..wedge.system.energy_terms().len())
        .filter(|&i| {
            !matches!(
                wedge.system.energy_terms()[i].kind,
                EnergyTermKind::MotionWork | EnergyTermKind::CoilGuideWork
            )
        })
        .collect();
    let tanh = [
        &wedge.parameters.column_friction,
        &wedge.parameters.slope_friction,
    ]
    .map(|f| matches!(f.law, FrictionLaw::Tanh { .. }));
    let mut start = None;
    let mut balance = EnergyBalance::default();
    let mut before = vec![0.0; wedge.system.energy_terms().len()];
    let mut fall = 0.0_f64;
    let end = run(&wedge, tolerance, (until, 0.01), |observation, _| {
        let start = *start.get_or_insert(observation.energies.total());
        let ledger = wedge::outputs::Outputs::ledger(&wedge.system, observation, start);
        balance.note(observation.time, &ledger.entries());
        for (face, tanh) in observation.faces.iter().zip(tanh) {
            assert!(
                face.friction_loss >= 0.0,
                "friction adds energy at {} s",
                observation.time
            );
            assert!(!tanh || face.friction_power <= 0.0);
            // Equal with tanh.
            assert!(!tanh || (face.friction_power + face.friction_loss).abs() <= 1e-12 * face.friction_loss);
        }
        for &i in &losses {
            fall = fall.max(before[i] - observation.quadratures[i]);
        }
        before.copy_from_slice(&observation.quadratures);
    });
    // What went through the wedge.
    let entries = end.ledger.entries();
    let work = entries.work.abs().max(entries.losses);
    // Losses are integrated without an error control of their own: they may swing by as much as the ledger
    // may be off.
    assert!(fall < 1e-5 * work, "a loss falls by {fall:e} of {work} J");
    (end, balance.relative_residual())
}

#[test]
fn yawed_cases_close_to_1e_5_at_the_default_tolerance() {
    for damping in BOTH {
        for toe in [TOE, 0.0, -TOE] {
            let (end, residual) = checked(thesis::parameters(damping, toe, YAW), 1e-6, UNTIL);
            println!(
                "{damping:?} toe {toe:.4} yawed: work {:.1} lbf in, residual {residual:.2e}, {} steps",
                end.ledger.motion_work / LBF_IN,
                end.steps
            );
            assert!(residual < 1e-5, "{damping:?}, toe {toe}: {residual:e}");
        }
    }
}

#[test]
fn ringing_cases_close_to_1e_4_and_better_with_the_tolerance() {
    for damping in BOTH {
        for toe in [TOE, 0.0, -TOE] {
            let residuals = [1e-5, 1e-6, 1e-7]
                .map(|tolerance| checked(thesis::parameters(damping, toe, 0.0), tolerance, 4.0).1);
            println!("{damping:?} toe {toe:.4}: {residuals:?}");
            assert!(residuals[1] < 1e-4, "{damping:?}, toe {toe}: {residuals:?}");
            assert!(
                residuals[2] < residuals[0],
                "{damping:?}, toe {toe}: {residuals:?}"
            );
        }
    }
}

/// Every entry is needed: without it the ledger is off by itself.
#[test]
fn leaving_one_entry_out_makes_the_ledger_fail() {
    let mut parameters = thesis::parameters(Damping::Variable, TOE, YAW);
    parameters.contact.damping = 50.0 * LBF_PER_IN;
    parameters.coil.damping = 20.0 * LBF_PER_IN;
    let (end, residual) = checked(parameters, 1e-6, 4.0);
    let l = end.ledger;
    assert!(residual < 1e-5, "{residual:e}");
    let entries = [
        ("side frame friction", l.side_frame_friction_loss),
        ("bolster friction", l.bolster_friction_loss),
        ("contact damping", l.contact_damping_loss),
        ("coil damping", l.coil_damping_loss),
        ("stored energy", l.stored),
        ("coil guide", -l.coil_guide_work),
        ("motion", -l.motion_work),
    ];
    for (name, entry) in entries {
        let without = (l.residual + entry).abs() / l.motion_work;
        println!("without {name}: {without:.2e}");
        assert!(without > 1e-5, "{name}: {without:e}");
    }
    // The losses of friction by far.
    assert!(l.side_frame_friction_loss > 0.1 * l.motion_work);
    // All entries add up to the work by themselves.
    let sum: f64 = entries.iter().map(|(_, entry)| entry).sum();
    assert!((sum / l.motion_work).abs() < 1e-5);
}

#[test]
fn the_ledger_closes_for_every_kind_of_case() {
    type Change = fn(&mut Parameters);
    let changes: [(&str, Change); 14] = [
        ("bristle", |p| *p = with_law(p.clone(), bristle())),
        ("bristle at the slope", |p| p.slope_friction.law = bristle()),
        ("contact damping", |p| p.contact.damping = 50.0 * LBF_PER_IN),
        ("coil at its seat", |p| p.coil.acts_at = CoilLine::Seat),
        ("coil at its seat, all six free", |p| {
            p.coil.acts_at = CoilLine::Seat;
            p.wedge.free = [true; 6];
            p.contact.damping = 50.0 * LBF_PER_IN;
        }),
        ("a table of the coil", |p| {
            let points = [
                [-2.0, -4000.0],
                [0.0, 0.0],
                [0.5, 1200.0],
                [1.0, 4000.0],
                [3.0, 9000.0],
            ];
            let points = points.map(|[x, f]| [x * INCH, f * LBF]).to_vec();
            p.coil.law = CoilLaw::Table(Characteristic::new(points).unwrap());
        }),
        ("a coil that does not pull", |p| p.coil.pulls = false),
        ("no gravity, no friction", |p| {
            p.gravity = 0.0;
            (p.column_friction.coefficient, p.slope_friction.coefficient) = (0.0, 0.0);
            p.contact.damping = 50.0 * LBF_PER_IN;
        }),
        ("different friction", |p| {
            (p.column_friction.coefficient, p.slope_friction.coefficient) = (0.5, 0.1);
        }),
        ("touching start", |p| p.start = Start::Touching),
        ("equilibrium start", |p| p.start = Start::Equilibrium),
        ("a bolster that turns", |p| {
            p.wedge.free = [true; 6];
            p.contact.damping = 50.0 * LBF_PER_IN;
            for (k, amplitude) in [(3, 2e-3), (4, 3e-3), (5, 4e-3)] {
                p.bolster.coordinates[k] = Motion::Sine {
                    amplitude,
                    angular_frequency: 3.0 + k as f64,
                    phase: 0.3,
                };
            }
            p.bolster.center = Some([0.3, 0.1, 0.2]);
        }),
        ("a side frame that moves", |p| {
            for (k, amplitude) in [(0, 5e-5), (1, 1e-3), (2, 1e-2), (3, 2e-3), (4, 1e-3), (5, 2e-3)] {
                p.side_frame.coordinates[k] = Motion::Sine {
                    amplitude,
                    angular_frequency: 2.5 + k as f64,
                    phase: 0.0,
                };
            }
            p.contact.damping = 50.0 * LBF_PER_IN;
        }),
        ("motions with corners", |p| {
            p.bolster.coordinates[2] = Motion::Sum(vec![
                Motion::Triangle {
                    amplitude: INCH,
                    angular_frequency: 2.0,
                },
                Motion::Ramp {
                    amplitude: 0.1 * INCH,
                    start: 0.5,
                    duration: 0.7,
                    profile: RampProfile::Linear,
                },
            ]);
        }),
    ];
    for damping in BOTH {
        for (name, change) in &changes {
            let mut parameters = thesis::parameters(damping, TOE, YAW);
            change(&mut parameters);
            let (end, residual) = checked(parameters, 1e-6, 4.0);
            println!(
                "{damping:?}, {name}: work {:.1} lbf in, residual {residual:.2e}, {} steps",
                end.ledger.motion_work / LBF_IN,
                end.steps
            );
            assert!(residual < 1e-5, "{damping:?}, {name}: {residual:e}");
        }
    }
}

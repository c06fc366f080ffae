//! The same bits across saving, restoring, other instances.

use study::stepping::{CoilInput, SteppedState, SteppedWedge};

use crate::common::{YAWED, at, case, drive};

const BRISTLE: &str = "friction.law=\"bristle\"";

fn bits(wedge: &mut SteppedWedge) -> Vec<u64> {
    let row = wedge.row();
    let states = wedge.states().to_vec();
    row.iter().chain(&states).map(|value| value.to_bits()).collect()
}

#[test]
fn a_wedge_goes_on_from_saved_bytes_with_the_same_bits() {
    for (name, overrides) in [
        (YAWED, &[][..]),
        ("vdrun_toe_0_psi_0", &[][..]),
        (YAWED, &[BRISTLE, "simulation.start=\"touching\""][..]),
    ] {
        let case = case(name, overrides);
        let mut wedge = at(&case, 0.4, 1e-3);
        let bytes = wedge.state().to_bytes().unwrap();
        let here = bits(&mut wedge);
        drive(&case, &mut wedge, 0.8, 1e-3);
        let there = bits(&mut wedge);
        assert_ne!(here, there);

        // The same wedge goes back, a new one goes on.
        wedge.restore(&SteppedState::from_bytes(&bytes).unwrap()).unwrap();
        assert_eq!(bits(&mut wedge), here, "{name}");
        let mut other = SteppedWedge::new(&case).unwrap();
        other.restore(&SteppedState::from_bytes(&bytes).unwrap()).unwrap();
        assert_eq!(bits(&mut other), here, "{name}");
        for wedge in [&mut wedge, &mut other] {
            drive(&case, wedge, 0.8, 1e-3);
            assert_eq!(bits(wedge), there, "{name}");
            assert_eq!(
                wedge.state(),
                {
                    let mut straight = at(&case, 0.8, 1e-3);
                    bits(&mut straight);
                    straight.state()
                },
                "{name}: counts and step-size control too"
            );
        }
    }
}

#[test]
fn a_restored_wedge_knows_another_start_coil_and_friction() {
    let case = case(YAWED, &["simulation.start=\"touching\""]);
    let mut start = crate::common::place(&case, 0.0);
    start.bolster.position[5] = 0.004;
    let mut wedge = SteppedWedge::starting(&case, &start).unwrap();
    wedge.set_coil(CoilInput::Stiffness(4e5)).unwrap();
    wedge.set_friction([0.3, 0.2]).unwrap();
    start.bolster.position[2] = 1e-4;
    wedge.step(&start, 0.01).unwrap();
    let state = wedge.state();
    let mut other = SteppedWedge::new(&case).unwrap();
    other.restore(&state).unwrap();
    for wedge in [&mut wedge, &mut other] {
        start.bolster.position[2] = 2e-4;
        wedge.step(&start, 0.01).unwrap();
    }
    assert_eq!(bits(&mut wedge), bits(&mut other));
    assert_eq!(wedge.state(), other.state());
}

#[test]
fn wedges_do_not_disturb_each_other() {
    let case = case(YAWED, &[]);
    let mut alone = at(&case, 0.1, 1e-3);
    let mut four: Vec<SteppedWedge> = (0..4).map(|_| SteppedWedge::new(&case).unwrap()).collect();
    for number in 1..=100 {
        for wedge in &mut four {
            drive(&case, wedge, f64::from(number) * 1e-3, 1e-3);
        }
    }
    let alone = bits(&mut alone);
    for wedge in &mut four {
        assert_eq!(bits(wedge), alone);
    }
}

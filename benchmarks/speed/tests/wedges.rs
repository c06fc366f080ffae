//! The systems of many wedges are what the benchmark says they are.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use benchmarks::wedges::{Arrangement, wedges};
use integrate::{Integrator, Options, Problem};
use mechanics::system::System;

fn rates(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let mut dx = vec![0.0; x.len()];
    system.next_time_discontinuity(0.0);
    system.derivative(time, x, &mut dx);
    dx
}

#[test]
fn analytic_each_uncoupled_wedge_does_what_one_does() {
    let count = 7;
    let (mut one, mut many) = (
        wedges(1, Arrangement::Uncoupled).unwrap(),
        wedges(count, Arrangement::Uncoupled).unwrap(),
    );
    let (n, time) = (one.layout().speeds, 0.3);
    let (start, all) = (one.initial_state(), many.initial_state());
    let (alone, together) = (rates(&mut one, time, &start), rates(&mut many, time, &all));
    assert_eq!(many.layout().speeds, count * n);
    assert!(
        alone[n..2 * n]
            .iter()
            .any(|acceleration| acceleration.abs() > 1.0)
    );
    for wedge in together[count * n..2 * count * n].chunks_exact(n) {
        assert_eq!(wedge, &alone[n..2 * n]);
    }
}

/// A force on one body of the chain changes the accelerations of it and its neighbors alone: no two bodies
/// further apart are coupled.
#[test]
fn limits_bodies_of_the_chain_feel_their_neighbours_alone() {
    let mut chain = wedges(5, Arrangement::Chained).unwrap();
    let options = Options {
        fixed_step: Some(1e-5),
        ..Options::default()
    };
    let mut integrator = Integrator::new(chain.clone(), options, 0.0, &chain.initial_state()).unwrap();
    for _ in 0..2000 {
        integrator.step_to(f64::INFINITY).unwrap();
    }
    let (time, x) = (integrator.time(), integrator.x().to_vec());
    let before = rates(&mut chain, time, &x);
    let count = chain.layout().speeds;
    // Four coordinates a body; the first of them is x. Pushed to and fro, so that a contact that is open just
    // now closes.
    let coupled_to = |chain: &mut System, body: usize| -> Vec<usize> {
        let pushed = [-1e-4, 1e-4].map(|push| {
            let mut x = x.clone();
            x[4 * body] += push;
            rates(chain, time, &x)
        });
        let is_coupled = |other: &usize| {
            let at = count + 4 * other;
            pushed.iter().any(|after| after[at..at + 4] != before[at..at + 4])
        };
        (0..count / 4).filter(is_coupled).collect()
    };
    // Neighbor ahead of wedge k: free body 2k; wedge k: 2k + 1; the neighbor behind it: 2k - 2.
    assert_eq!(count / 4, 10);
    assert_eq!(coupled_to(&mut chain, 5), [2, 4, 5]);
    assert_eq!(coupled_to(&mut chain, 4), [4, 5, 7]);
    assert_eq!(coupled_to(&mut chain, 7), [4, 6, 7]);
}

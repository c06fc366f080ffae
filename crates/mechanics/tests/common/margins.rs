//! Event functions of a whole system. Other crates use this file too.

use integrate::Problem;
use mechanics::system::System;

/// Event functions of all contact points, and the next contact states, from the event variables of all at
/// once.
pub fn margins(system: &mut System, time: f64, x: &[f64], contact_states: &[u8]) -> (Vec<f64>, Vec<u8>) {
    let mut variables = vec![f64::NAN; system.structure().event_variables()];
    system.event_variables(None, time, x, &mut variables);
    let (mut margins, mut next) = (vec![f64::NAN; contact_states.len()], contact_states.to_vec());
    for (number, group) in system.structure().event_groups.into_iter().enumerate() {
        let (own, variables) = (group.discrete_states, &variables[group.variables]);
        system.event_functions(
            number,
            variables,
            &contact_states[own.clone()],
            &mut margins[own.clone()],
        );
        for (index, next) in next[own].iter_mut().enumerate() {
            *next = system.next_discrete_state(number, variables, index, *next);
        }
    }
    (margins, next)
}

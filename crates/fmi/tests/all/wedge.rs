//! The wedge behind the variables: its directional derivatives.

use fmi::description::Description;
use fmi::description::Version;
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::source::{FmuModel, Source};
use fmi::variable::{Variable, VariableRole};
use study::case::builtin;

/// Returns the references of the variables of some roles.
fn those(description: &Description, is: fn(VariableRole) -> bool) -> Vec<u32> {
    let own = description.variables.iter().filter(|own| is(own.role));
    own.map(|own: &Variable| own.reference).collect()
}

/// Every directional derivative of rates and outputs against central differences, by each state and each
/// input, in each mode of the coil, with both laws of friction.
#[test]
fn analytic_derivatives_of_a_wedge_are_those_of_differences() {
    const BRISTLE: &[&str] = &["friction.law=\"bristle\"", "contact.damping=\"50 lbf s/in\""];
    for (overrides, coil_mode) in [(&[][..], 0), (BRISTLE, 0), (&[][..], 1), (&[][..], 2)] {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let case = builtin::case_with("cdrun_toe_out_0.2_psi_0.012", &overrides).unwrap();
        let make = |interface| {
            let source = Source::of_case(FmuModel::Wedge, case.clone()).unwrap();
            let mut instance = Instance::of("wedge", None, source, Version::Three, interface).unwrap();
            let description = instance.description().clone();
            let mut set = |name: &str, value: f64| {
                let mut all = description.variables.iter();
                let own = all.find(|own| own.name == name).unwrap();
                match own.role {
                    VariableRole::Option(_) => {
                        instance.set_integer(own.reference, value as i32).unwrap();
                    }
                    _ => instance.set_float(own.reference, value).unwrap(),
                }
            };
            set("coil_mode", f64::from(coil_mode));
            set("coil_stiffness_input", 3e5);
            set("coil_force_input", 2e4);
            set("bolster_z_rate", 0.05);
            instance.enter_initialization().unwrap();
            instance.exit_initialization().unwrap();
            (instance, description)
        };
        // A state on the way: the wedge slides, and its bristles are bent.
        let (mut driven, description) = make(Interface::CoSimulation);
        for step in 0..30 {
            driven.do_step(f64::from(step) * 1e-3, 1e-3).unwrap();
        }
        let state_references = those(&description, |role| matches!(role, VariableRole::State(_)));
        let states = state_references.iter().map(|own| driven.get_float(*own).unwrap());
        let states: Vec<f64> = states.collect();
        let (mut instance, _) = make(Interface::ModelExchange);
        instance.enter_continuous_time_mode().unwrap();
        let input_references = those(&description, |role| matches!(role, VariableRole::Input(_)));
        let inputs = input_references.iter().map(|own| driven.get_float(*own).unwrap());
        let inputs: Vec<f64> = inputs.collect();
        let unknowns = those(&description, |role| {
            matches!(role, VariableRole::Rate(_) | VariableRole::Output(_))
        });
        let knowns = state_references.iter().chain(&input_references);
        for (number, known) in knowns.enumerate() {
            // Far below the lengths over which the laws bend, far above rounding; the coil's stiffness and
            // force are numbers of another size.
            let is_of_coil = number >= states.len() + 24;
            let h = if is_of_coil { 1e-3 } else { 3e-9 };
            let mut evaluate = |change: f64| {
                let (mut states, mut inputs) = (states.clone(), inputs.clone());
                let place = states.iter_mut().chain(&mut inputs).nth(number);
                *place.unwrap() += change;
                instance.set_states(&states).unwrap();
                for (reference, value) in input_references.iter().zip(&inputs) {
                    instance.set_float(*reference, *value).unwrap();
                }
                let values = unknowns.iter().map(|own| instance.get_float(*own).unwrap());
                values.collect::<Vec<f64>>()
            };
            let (plus, minus) = (evaluate(h), evaluate(-h));
            evaluate(0.0);
            let mut exact = vec![0.0; unknowns.len()];
            instance
                .directional_derivative(&unknowns, &[*known], &[1.0], &mut exact)
                .unwrap();
            for (index, exact) in exact.iter().enumerate() {
                let difference = (plus[index] - minus[index]) / (2.0 * h);
                // What rounding leaves of a difference of values of this size.
                let noise = 1e-13 * plus[index].abs().max(1e5) / h;
                let error = (difference - exact).abs();
                assert!(
                    error < 1e-5 * exact.abs() + noise,
                    "coil mode {coil_mode}, known {number}, unknown {index}: {exact} against {difference}"
                );
            }
        }
    }
}

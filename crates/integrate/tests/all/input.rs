//! Each invalid input gives a typed error.

use integrate::{
    FunctionProblem, Integrator, Method, Options, Reason, STATE_VERSION, SetupError, Statistics,
};

fn decay(scales: Vec<f64>) -> FunctionProblem<'static> {
    let n = scales.len();
    FunctionProblem::new(
        scales,
        |_, x, dx| dx.iter_mut().zip(x).for_each(|(d, x)| *d = -x),
        move |_, _, j| (0..n).for_each(|i| j[i * (n + 1)] = -1.0),
    )
}

fn setup(options: Options, scales: &[f64], time: f64, x: &[f64]) -> SetupError {
    let error = Integrator::new(decay(scales.to_vec()), options, time, x).unwrap_err();
    assert!(!error.to_string().is_empty());
    error
}

#[test]
fn wrong_options_are_named() {
    let wrong = |options: Options| match setup(options, &[1.0], 0.0, &[1.0]) {
        SetupError::Option { name, .. } => name,
        other => panic!("{other}"),
    };
    let standard = Options::default;
    for tolerance in [0.0, -1e-6, f64::NAN, 1.0, f64::INFINITY] {
        assert_eq!(
            wrong(Options {
                relative_tolerance: tolerance,
                ..standard()
            }),
            "relative_tolerance"
        );
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(
            wrong(Options {
                initial_step: Some(step),
                ..standard()
            }),
            "initial_step"
        );
        assert_eq!(
            wrong(Options {
                fixed_step: Some(step),
                ..standard()
            }),
            "fixed_step"
        );
    }
    assert_eq!(
        wrong(Options {
            maximum_step: 0.0,
            ..standard()
        }),
        "maximum_step"
    );
    assert_eq!(
        wrong(Options {
            minimum_step: 1.0,
            maximum_step: 0.5,
            ..standard()
        }),
        "minimum_step"
    );
    assert_eq!(
        wrong(Options {
            safety: 1.0,
            ..standard()
        }),
        "safety"
    );
    assert_eq!(
        wrong(Options {
            minimum_factor: f64::NAN,
            ..standard()
        }),
        "minimum_factor"
    );
    assert_eq!(
        wrong(Options {
            maximum_factor: 1.0,
            ..standard()
        }),
        "maximum_factor"
    );
}

#[test]
fn wrong_starts_are_named() {
    let standard = Options::default;
    assert_eq!(
        setup(standard(), &[1.0; 3], 0.0, &[1.0; 2]),
        SetupError::Dimension {
            what: "states",
            expected: 3,
            found: 2
        }
    );
    assert!(matches!(
        setup(standard(), &[1.0; 3], 0.0, &[1.0, f64::NAN, 0.0]),
        SetupError::NotFiniteState { index: 1, value } if value.is_nan()
    ));
    assert!(matches!(
        setup(standard(), &[1.0], f64::NAN, &[1.0]),
        SetupError::Time(_)
    ));
    assert!(matches!(
        setup(standard(), &[1.0, 0.0], 0.0, &[1.0; 2]),
        SetupError::Scale { index: 1, .. }
    ));
    assert!(matches!(
        setup(standard(), &[f64::NAN], 0.0, &[1.0]),
        SetupError::Scale { index: 0, .. }
    ));
    assert_eq!(
        setup(standard(), &[f64::INFINITY], 0.0, &[1.0]),
        SetupError::NothingControlled
    );
    let problem = FunctionProblem::new(
        vec![1.0],
        |_, x, dx| dx[0] = libm::log(x[0]),
        |_, x, j| j[0] = 1.0 / x[0],
    );
    let error = Integrator::new(problem, standard(), 0.0, &[-1.0]).unwrap_err();
    assert!(matches!(error, SetupError::NotFiniteDerivative { index: 0, .. }));
}

#[test]
fn wrong_states_are_refused() {
    let mut integrator = Integrator::new(decay(vec![1.0; 2]), Options::default(), 0.0, &[1.0; 2]).unwrap();
    integrator.step_to(1.0).unwrap();
    let good = integrator.state();
    let resume = |state| Integrator::resume(decay(vec![1.0; 2]), Options::default(), state).map(|_| ());
    assert_eq!(resume(good.clone()), Ok(()));
    let mut state = good.clone();
    state.version = STATE_VERSION + 1;
    assert_eq!(
        resume(state),
        Err(SetupError::Version {
            found: STATE_VERSION + 1
        })
    );
    let mut state = good.clone();
    state.x.push(0.0);
    assert_eq!(
        resume(state),
        Err(SetupError::Dimension {
            what: "states",
            expected: 2,
            found: 3
        })
    );
    let mut state = good.clone();
    state.discrete_states.push(0);
    assert_eq!(
        resume(state),
        Err(SetupError::Dimension {
            what: "discrete states",
            expected: 0,
            found: 1
        })
    );
    let mut state = good.clone();
    state.x[1] = f64::INFINITY;
    assert!(matches!(
        resume(state),
        Err(SetupError::NotFiniteState { index: 1, .. })
    ));
    let mut state = good.clone();
    state.proposed_step = f64::NAN;
    assert!(matches!(
        resume(state),
        Err(SetupError::Damaged {
            name: "proposed_step",
            ..
        })
    ));
    let mut state = good;
    state.interval_start = 1e9;
    assert!(matches!(
        resume(state),
        Err(SetupError::Damaged {
            name: "interval_start",
            ..
        })
    ));
}

#[test]
fn a_limit_must_lie_ahead() {
    let mut integrator = Integrator::new(decay(vec![1.0]), Options::default(), 1.0, &[1.0]).unwrap();
    for limit in [f64::NAN, 1.0, 0.5, f64::NEG_INFINITY] {
        let error = integrator.step_to(limit).unwrap_err();
        assert!(matches!(error.reason, Reason::Limit { .. }), "{error}");
    }
    assert_eq!(integrator.time(), 1.0);
    integrator.step_to(f64::INFINITY).unwrap();
}

#[test]
fn the_end_of_the_domain_is_reported_and_the_last_step_kept() {
    // x' = -1 until there is no derivative any more below zero
    let problem = FunctionProblem::new(
        vec![1.0, 1.0],
        |_, x, dx| {
            dx[0] = 0.0;
            dx[1] = if x[1] < 0.0 { f64::NAN } else { -1.0 };
        },
        |_, _, _| {},
    );
    let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[0.0, 1.0]).unwrap();
    let error = loop {
        if let Err(error) = integrator.step_to(f64::INFINITY) {
            break error;
        }
    };
    assert_eq!(
        (error.reason, error.index),
        (Reason::NotFinite, Some(1)),
        "{error}"
    );
    assert!((error.time - 1.0).abs() < 1e-9, "{error}");
    assert!(integrator.statistics().rejected_not_finite > 5);
    assert_eq!(integrator.time(), error.time);
    let (middle, mut x) = (0.5 * (integrator.previous_time() + integrator.time()), [0.0; 2]);
    integrator.interpolate(middle, &mut x);
    assert!(
        (x[1] - (1.0 - middle)).abs() < 1e-12,
        "the last step can still be interpolated"
    );
}

#[test]
fn a_pole_and_a_jump_end_with_the_state_to_blame() {
    let pole = FunctionProblem::new(
        vec![1.0, 1.0],
        |_, x, dx| {
            dx[0] = -x[0];
            dx[1] = x[1] * x[1];
        },
        |_, x, j| j.copy_from_slice(&[-1.0, 0.0, 0.0, 2.0 * x[1]]),
    );
    let options = Options {
        minimum_step: 1e-9,
        ..Options::default()
    };
    let mut integrator = Integrator::new(pole, options, 0.0, &[1.0, 1.0]).unwrap();
    let error = loop {
        if let Err(error) = integrator.step_to(f64::INFINITY) {
            break error;
        }
    };
    assert_eq!(error.index, Some(1), "{error}");
    assert!((error.time - 1.0).abs() < 1e-3 && error.step < 1e-8, "{error}");
    assert!(
        error.scaled_error > 1.0 && error.to_string().contains("state 1"),
        "{error}"
    );
}

#[test]
fn the_number_of_steps_is_bounded() {
    let options = Options {
        maximum_steps: 10,
        maximum_step: 0.01,
        ..Options::default()
    };
    let mut integrator = Integrator::new(decay(vec![1.0]), options, 0.0, &[1.0]).unwrap();
    for _ in 0..10 {
        integrator.step_to(f64::INFINITY).unwrap();
    }
    let error = integrator.step_to(f64::INFINITY).unwrap_err();
    assert_eq!(error.reason, Reason::MaximumSteps { maximum: 10 });
}

#[test]
fn a_singular_matrix_shortens_the_step_or_is_reported() {
    // J = 1/(γh) for a first step of h: the matrix is zero.
    let rate = 1.0 / 0.1 / Method::Rodas5P.tableau().gamma;
    let problem = || {
        FunctionProblem::new(
            vec![1.0],
            move |_, x, dx| dx[0] = rate * x[0],
            move |_, _, j| j[0] = rate,
        )
    };
    let options = Options {
        initial_step: Some(0.1),
        ..Options::default()
    };
    let mut integrator = Integrator::new(problem(), options, 0.0, &[1e-9]).unwrap();
    integrator.step_to(f64::INFINITY).unwrap();
    assert_eq!(integrator.statistics().rejected_singular, 1);
    let options = Options {
        fixed_step: Some(0.1),
        ..Options::default()
    };
    let mut integrator = Integrator::new(problem(), options, 0.0, &[1e-9]).unwrap();
    let error = integrator.step_to(f64::INFINITY).unwrap_err();
    assert_eq!(error.reason, Reason::Singular { block: 0 });
    let broken = FunctionProblem::new(vec![1.0], |_, x, dx| dx[0] = x[0], |_, _, j| j[0] = f64::INFINITY);
    let mut integrator = Integrator::new(broken, Options::default(), 0.0, &[1.0]).unwrap();
    let error = integrator.step_to(f64::INFINITY).unwrap_err();
    assert_eq!(error.reason, Reason::Singular { block: 0 });
}

#[test]
fn a_time_discontinuity_must_be_later_than_the_start() {
    struct Backwards(FunctionProblem<'static>);
    impl integrate::Problem for Backwards {
        fn structure(&self) -> integrate::ProblemStructure {
            self.0.structure()
        }
        fn next_time_discontinuity(&mut self, start: f64) -> f64 {
            1.0 - start
        }
        fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
            self.0.derivative(time, x, dx);
        }
        fn linearize(&mut self, time: f64, x: &[f64], dx: &[f64], df_dt: &mut [f64]) {
            self.0.linearize(time, x, dx, df_dt);
        }
        fn factor(&mut self, shift: f64) -> Result<(), numerics::Singular> {
            self.0.factor(shift)
        }
        fn solve(&mut self, b: &mut [f64]) {
            self.0.solve(b);
        }
    }
    let problem = || Backwards(decay(vec![1.0]));
    let error = Integrator::new(problem(), Options::default(), 0.6, &[1.0]).unwrap_err();
    assert!(matches!(error, SetupError::TimeDiscontinuity { .. }), "{error}");
    let mut integrator = Integrator::new(problem(), Options::default(), 0.0, &[1.0]).unwrap();
    while integrator.time() < 1.0 {
        integrator.step_to(f64::INFINITY).unwrap();
    }
    let error = integrator.step_to(f64::INFINITY).unwrap_err();
    assert_eq!(error.reason, Reason::TimeDiscontinuity { end: 0.0 }, "{error}");
}

#[test]
fn options_pass_through_text() {
    let options = Options {
        maximum_step: f64::INFINITY,
        ..Options::default()
    };
    let text = serde_json::to_string(&options).unwrap();
    assert_eq!(serde_json::from_str::<Options>(&text).unwrap(), options);
    let short: Options =
        serde_json::from_str(r#"{"method": "rodas5p", "relative_tolerance": 1e-7}"#).unwrap();
    assert_eq!(short.method, integrate::Method::Rodas5P);
    assert!(serde_json::from_str::<Options>(r#"{"tolerance": 1e-7}"#).is_err());
    let error = serde_json::from_str::<Options>(r#"{"method": "rodas4"}"#).unwrap_err();
    assert!(error.to_string().contains("`rodas5p`"), "{error}");
    let error = "rodas4".parse::<Method>().unwrap_err().to_string();
    assert!(
        error.contains("`rodas4`") && error.contains("Rodas5P, TR-BDF2 or ESDIRK3"),
        "{error}"
    );
}

/// Summaries and saved states of older programs name predicted discontinuities by another word.
#[test]
fn statistics_with_the_older_name_of_a_counter_are_read() {
    let statistics = Statistics {
        discontinuities_predicted: 7,
        ..Statistics::default()
    };
    let text = serde_json::to_string(&statistics).unwrap();
    assert!(text.contains(r#""discontinuities_predicted":7"#), "{text}");
    let older = text.replace("discontinuities_predicted", "kinks_foreseen");
    assert_eq!(serde_json::from_str::<Statistics>(&older).unwrap(), statistics);
}

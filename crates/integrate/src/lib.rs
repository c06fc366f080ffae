//! Integration of stiff, piecewise smooth ordinary differential equations `x' = f(t, x)` by implicit one-step
//! methods: a Rosenbrock method (Rodas5P), which needs one linear system per stage, and ESDIRK methods
//! (TR-BDF2, ESDIRK3), whose stages are solved by Newton's method. The crate knows no physics, but it is made
//! for mechanical systems with contact and regularized dry friction.
//!
//! A [`Problem`] provides its right-hand side and its own structured linear algebra; [`FunctionProblem`]
//! makes one from closures, with a dense matrix. An [`Integrator`] makes accepted steps with a [`Method`].
//! Nothing is allocated in a step, and the same input gives the same bits on every system.
//!
//! # Van der Pol's equation
//!
//! ```
//! use integrate::{FunctionProblem, Integrator, Method, Options};
//! // x'' = μ (1 - x²) x' - x
//! let mu = 1000.0;
//! let problem = FunctionProblem::new(
//!     vec![1.0, 1000.0], // error scales
//!     |_, x, dx| {
//!         dx[0] = x[1];
//!         dx[1] = mu * (1.0 - x[0] * x[0]) * x[1] - x[0];
//!     },
//!     |_, x, jacobian| {
//!         jacobian[1] = 1.0;
//!         jacobian[2] = -2.0 * mu * x[0] * x[1] - 1.0;
//!         jacobian[3] = mu * (1.0 - x[0] * x[0]);
//!     },
//! );
//! let options = Options { method: Method::Rodas5P, relative_tolerance: 1e-8, ..Options::default() };
//! let mut integrator = Integrator::new(problem, options, 0.0, &[2.0, 0.0])?;
//! let mut x = [0.0; 2];
//! while integrator.time() < 2000.0 {
//!     integrator.step_to(2000.0)?;
//!     if integrator.previous_time() < 500.0 && integrator.time() >= 500.0 {
//!         integrator.interpolate(500.0, &mut x); // dense output
//!     }
//! }
//! assert!((integrator.x()[0] - 1.706_167_7).abs() < 1e-4);
//! assert!(x[0] > 1.0 && x[0] < 2.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where to find what
//!
//! | what | where |
//! |---|---|
//! | the problem: required and optional functions | [`Problem`], [`ProblemStructure`] (`problem.rs`), [`FunctionProblem`] |
//! | a step: attempt, error test, acceptance | [`Integrator::step_to`] (`integrator/step.rs`) |
//! | stages of Rosenbrock, explicit and ESDIRK methods | `integrator/{rosenbrock,explicit,esdirk}.rs` |
//! | coefficients of the methods, with citations | [`Method::tableau`] (`methods/`) |
//! | error norm and tolerances | [`ProblemStructure::scales`], [`ProblemStructure::error_bounds`], [`Options`] |
//! | step-size controller (PI, Gustafsson) | `controller.rs` |
//! | modified Newton: Jacobian cache, line search | `newton/` |
//! | switching to a nonstiff method | [`Problem::spectral_radius_bound`] (`integrator/explicit.rs`) |
//! | discontinuities in time | [`Problem::next_time_discontinuity`] |
//! | predicted discontinuities in state; slip reversal | [`Problem::discontinuities`] (`discontinuity*.rs`) |
//! | discrete states and events (root functions) | [`Problem::event_variables`] and after (`event*.rs`) |
//! | root search | `root_search.rs` |
//! | dense output and its correction | [`Integrator::interpolate`] (`integrator/interpolation.rs`) |
//! | save and resume with the same bits | [`State`], [`Integrator::resume`], [`Integrator::restore`] |
//! | counters | [`Statistics`] |
//! | numbers with derivatives, SIMD lanes, linear algebra | the crate `numerics` |
//! | every tuning constant, with its source | `tuning.rs` |
//!
//! # Modules
//!
//! A module uses only modules of the lines before its own (the test `limits_modules` checks that):
//!
//! ```text
//! tuning  limits  vector
//! methods  error  event
//! validation  root_search
//! dense_output  discontinuity  options
//! problem  statistics  controller
//! function_problem  event_detection  discontinuity_prediction  newton
//! state
//! integrator
//! ```
//!
//! # Terms
//!
//! - *Dynamic states*: the states on which the right-hand side depends; the others are quadratures.
//! - *Discontinuity*: a jump of f or of one of its derivatives.
//! - *Slip*: slip velocity of a contact over the reference speed of its regularized friction law, a plane
//!   vector. *Regularization zone*: slips of size below about 1 (with a tail to 4), where friction depends on
//!   slip; *slip reversal*, *stick-to-slip transition*: a slip passes through or leaves its zone.
//! - *Discrete state*, *event*: a recorded state such as open, sticking or slipping, and its change.
//! - *Contact state*: which contacts are closed, and how friction holds each (the active set); a Jacobian
//!   matrix is valid in one contact state.
//! - *ρ*: a bound of the spectral radius of ∂f/∂x; *h·ρ*: the scaled step.

#![warn(missing_docs)]

mod controller;
mod dense_output;
mod discontinuity;
mod discontinuity_prediction;
mod error;
mod event;
mod event_detection;
mod function_problem;
mod integrator;
mod limits;
mod methods;
mod newton;
mod options;
mod problem;
mod root_search;
mod state;
mod statistics;
mod tuning;
mod validation;
mod vector;

pub use discontinuity::DiscontinuityFunctions;
pub use error::{Reason, SetupError, StepError};
pub use event::{Event, EventGroup};
pub use function_problem::FunctionProblem;
pub use integrator::Integrator;
pub use limits::{MAXIMUM_COUNT, STATE_VERSION};
pub use methods::tableau::{Family, MAXIMUM_STAGES, Tableau};
pub use methods::{Method, UnknownMethod};
pub use options::Options;
pub use problem::{Problem, ProblemStructure};
pub use state::State;
pub use statistics::Statistics;

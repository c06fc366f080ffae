//! All tuning constants of the integrator, by the part that uses them.
//!
//! Each constant states its unit, what it does, and what its value rests on: a citation, a decision record
//! (`docs/decisions/NNNN-*.md`), a row of the table in `docs/decisions/0045-what-was-tried.md`, or "chosen,
//! not measured". Constants without a unit are ratios. "Tolerances" are multiples of the admissible error of
//! a step.
//!
//! Terms: h is the step, ρ a bound of the spectral radius of the Jacobian matrix (1/s), so h·ρ is the scaled
//! step. A *slip* is a plane vector in units of the width of its regularization zone (slip velocity over the
//! reference speed of the friction law), see [`crate::DiscontinuityFunctions`].
//!
//! Decision records up to 0044 use other words: kink (discontinuity), layer (regularization zone), landing
//! (step to a discontinuity), strike (a contact closes), breaking away (stick-to-slip transition), piece
//! (contact state), guess (stage prediction), settled (corrected dense output), sign and margin (event
//! variable and function), switch and mode (discrete state), stiffness or fastest answer (bound of the
//! spectral radius).

/// Defaults of [`crate::Options`].
pub mod options {
    /// Safety factor of the step-size controller. Hairer & Wanner (1996), section IV.8; values from 0.855 to
    /// 0.945 and 0.7 to 0.85 need as many right-hand sides (decisions 0045, 0028).
    pub const SAFETY: f64 = 0.9;
    /// Smallest factor by which the controller changes a step. Hairer & Wanner (1996), section IV.8.
    pub const MINIMUM_FACTOR: f64 = 0.2;
    /// Largest factor by which the controller enlarges a step. Hairer & Wanner (1996), code RODAS; factors 3,
    /// 2 and 1.5 give fewer rejections and more steps, no gain (decision 0045).
    pub const MAXIMUM_FACTOR: f64 = 6.0;
    /// Safety factor for ESDIRK methods. With [`ESDIRK_MAXIMUM_FACTOR`]: 61,600 instead of 68,500 right-hand
    /// sides for the six yawed runs of the thesis, the same errors (decision 0045).
    pub const ESDIRK_SAFETY: f64 = 0.8;
    /// Largest growth factor for ESDIRK methods: the stage predictor needs steps of similar length. As
    /// [`ESDIRK_SAFETY`].
    pub const ESDIRK_MAXIMUM_FACTOR: f64 = 2.0;
    /// Relative tolerance. Chosen, not measured: results of users have their own.
    pub const RELATIVE_TOLERANCE: f64 = 1e-6;
    /// Largest number of events in one step. Chosen, not measured: a bound against chatter without end.
    pub const MAXIMUM_EVENTS: usize = 64;
}

/// Step-size controller.
pub mod controller {
    /// The smallest error root that enters the trend (integral part). It is the root of an error of 0.01,
    /// below which errors do not count: 0.01 as in Hairer & Wanner's RADAU5 and RODAS (`ERRACC = max(0.01,
    /// ERR)`).
    pub const MINIMUM_ERROR_ROOT: f64 = 0.3;
    /// Largest factor after a second rejection in a row: at a discontinuity the error has low order in h, so
    /// the factor of the controller would creep towards it. Chosen, not measured.
    pub const REPEATED_REJECTION_FACTOR: f64 = 0.5;
    /// Growth of Rosenbrock steps is the root of what the error would allow up to this factor, and
    /// `1/√SLOW_GROWTH_LIMIT` of it beyond. Errors where friction sticks grow with h⁸ to h¹⁵. Powers of 0.7,
    /// 0.4, 0.3 and 0.2 instead of 0.5 were compared: decision 0029. Low gain smooths: G. Söderlind, ACM TOMS
    /// 29 (2003) 1.
    pub const SLOW_GROWTH_LIMIT: f64 = 2.0;
}

/// First step: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.
/// (1993), section II.4.
pub mod first_step {
    /// Error that the two trial lengths aim at (step 1 and step 5 of the algorithm).
    pub const TARGET: f64 = 0.01;
    /// Derivatives below this, in units of the tolerance per second, are taken for zero.
    pub const SMALL_DERIVATIVE: f64 = 1e-10;
    /// First trial length where the derivative is zero, relative to the time or one second.
    pub const DEFAULT: f64 = 1e-6;
    /// The first step is at most this multiple of the first trial length (step 6 of the algorithm).
    pub const MAXIMUM_FACTOR: f64 = 100.0;
    /// Smallest first step, in units of the resolution of the time. Chosen, not measured.
    pub const RESOLUTION: f64 = 16.0;
}

/// Length of a step: limits, failures, discontinuities.
pub mod step {
    /// A step that would reach this part of the distance to the next limit goes all the way; no tiny step
    /// remains. Chosen, not measured.
    pub const STRETCH: f64 = 0.99;
    /// A step that would go beyond this part of the distance to the next limit is cut to this part: two equal
    /// steps instead of a long and a short one. Chosen, not measured.
    pub const HALVE: f64 = 0.5;
    /// A step shorter than this part of the planned step counts as truncated; rounding alone shortens steps
    /// by less. Decision 0028.
    pub const TRUNCATED: f64 = 1.0 - 1e-6;
    /// Factor after a singular matrix. Chosen, not measured.
    pub const SINGULAR_FACTOR: f64 = 0.5;
    /// Factor after a failure of Newton's method or a value that is not finite. CVODE uses 0.25 (SUNDIALS,
    /// `ETACF`).
    pub const FAILURE_FACTOR: f64 = 0.25;
    /// Smallest step, in units of the resolution of the time. Chosen, not measured.
    pub const RESOLUTION: f64 = 4.0;

    /// First step after a discontinuity, as a part of the step planned before it. The error across it says
    /// nothing. With the step through a regularization zone: 23,100 to 18,800 rejections (decision 0045).
    pub const AFTER_DISCONTINUITY: f64 = 0.5;
    /// Largest h·ρ of the first step after an explicit step to a discontinuity where ρ grows: a contact
    /// closed. Without it yawed runs have 60 % more rejections (decision 0049).
    pub const AFTER_CLOSING_H_RHO: f64 = 0.5;
    /// After a step to a discontinuity crossed it, this part of the distance is tried. Decision 0028.
    pub const RETRY_BEFORE_DISCONTINUITY: f64 = 0.8;
}

/// Attempts of Rosenbrock and explicit steps.
pub mod attempt {
    /// Steps with h·ρ up to this are explicit. Tsitouras' pair is stable down to -3.5 on the real axis and
    /// nearly so up to 2 on the imaginary one; bounds ρ are 2.3 to 4.3 times the largest eigenvalue. Bounds
    /// of 1, 2, 3, 5 and 8 were compared: decision 0023.
    pub const EXPLICIT_H_RHO: f64 = 3.0;
    /// Errors of explicit steps are multiplied by this. Their estimate is about five times the error, that of
    /// Rosenbrock methods ten to twenty times, and the energy balance is to close alike. Factors 3, 4, 6 and
    /// 8 were compared: decision 0039.
    pub const EXPLICIT_ERROR_WEIGHT: f64 = 4.0;
    /// Errors of Rosenbrock steps with a stick-to-slip transition are multiplied by this: they are up to 400
    /// times the estimate. Factors 1, 10 and 30 were compared: decision 0027.
    pub const STICK_TO_SLIP_ERROR_WEIGHT: f64 = 10.0;
}

/// Correction of the dense output.
pub mod dense_output {
    /// Nothing is corrected in steps with h·ρ below this: the dense output is as exact as the ends of the
    /// step. Decision 0029.
    pub const STIFF_H_RHO: f64 = 100.0;
    /// Nothing is corrected in a step whose correction at its midpoint is below this, in tolerances.
    /// Decision 0029.
    pub const NEGLIGIBLE: f64 = 0.002;
    /// The iteration ends at corrections below this, in tolerances.
    /// Chosen, not measured.
    pub const CONVERGED: f64 = 0.002;
    /// The matrix is evaluated again if a correction shrinks by less than this factor. Chosen, not measured.
    pub const SLOW: f64 = 0.2;
    /// The iteration is given up if a correction shrinks by less than this factor. Chosen, not measured.
    pub const DIVERGED: f64 = 0.7;
    /// Largest number of iterations. Chosen, not measured.
    pub const MAXIMUM_ITERATIONS: u32 = 8;
}

/// Newton's method of the ESDIRK methods.
pub mod newton {
    /// Largest last correction with a valid matrix, in tolerances. Decisions 0026 and 0033.
    pub const LAST_CORRECTION: f64 = 0.03;
    /// The same where the problem gives error bounds in regularization zones, in units of these bounds.
    /// Decision 0026.
    pub const LAST_CORRECTION_IN_ZONE: f64 = 0.4;
    /// Largest remainder after a correction with an old matrix, estimated from the last two corrections, in
    /// admissible last corrections. 0.1 is 4 % cheaper with 9 % larger errors: decision 0033.
    pub const REMAINDER: f64 = 0.01;
    /// The same if the stage ends in another contact state than its matrix. Decision 0033.
    pub const REMAINDER_OTHER_STATE: f64 = 0.001;
    /// The matrix is used again while corrections shrink by this factor; 0.3 and 0.5 are no cheaper: decision
    /// 0033.
    pub const CONTRACTION: f64 = 0.2;
    /// A line search starts if the next correction points back by more than this part of the last one, and
    /// ends where it is smaller. 0.3 and 0.5 give 7 to 35 % more matrices: decision 0033.
    pub const LINE_SEARCH: f64 = 0.1;
    /// Largest number of Jacobian matrices per stage. Chosen, not measured.
    pub const MAXIMUM_MATRICES: u32 = 8;
    /// Largest number of evaluations in a line search. Chosen, not measured.
    pub const MAXIMUM_LINE_SEARCH: u32 = 12;
}

/// Contact state (active set) for which a Jacobian matrix is valid.
pub mod contact_state {
    /// Entries of ∂φ/∂u may differ by this. 0.2 saves a sixth of the matrices, but the energy balance then
    /// closes to 1.5e-3 of the work instead of 0.9e-3: decision 0034.
    pub const TANGENT_DIFFERENCE: f64 = 0.1;
    /// Components of φ may differ by this. Decision 0034.
    pub const FORCE_DIFFERENCE: f64 = 0.5;
}

/// Prediction of discontinuities by extrapolating the dense output, and the regularization zones of slips.
pub mod discontinuity {
    /// Longest extrapolation, in lengths of the last step: the largest growth of a step, as
    /// [`super::options::MAXIMUM_FACTOR`].
    pub const HORIZON: f64 = 6.0;
    /// The extrapolation ends where its error, that of the step times the fifth power of the extrapolated
    /// length, reaches this, in tolerances. Chosen, not measured.
    pub const MAXIMUM_ERROR: f64 = 100.0;
    /// Largest distance after a discontinuity at which a step ends, and largest width of the bracket around
    /// it, in lengths of the last step; in proportion to the error of the extrapolation below. Decision 0012;
    /// other values changed nothing beyond the scatter (decision 0045).
    pub const OVERSHOOT: f64 = 2e-3;
    /// Smallest part of [`OVERSHOOT`]. As above.
    pub const MINIMUM_OVERSHOOT: f64 = 1e-6;
    /// Safety factor on the error of the extrapolation for the same purpose. As above.
    pub const OVERSHOOT_SAFETY: f64 = 4.0;
    /// A discontinuity nearer than this, in lengths of the last step, gets no step of its own. Chosen, not
    /// measured.
    pub const NEAREST: f64 = 1e-4;
    /// The same for the edge of a zone: the next step starts in the zone. Chosen, not measured.
    pub const NEAREST_ZONE: f64 = 0.05;
    /// Largest number of evaluations of a search. Chosen, not measured.
    pub const MAXIMUM_ITERATIONS: usize = 15;

    /// Edge of a regularization zone: the slip at which the step should end before a reversal. The force is
    /// then saturated, tanh(4) = 0.9993. Chosen, not measured.
    pub const ZONE_EDGE: f64 = 4.0;
    /// Slips above this are watched for reversal: twice [`ZONE_EDGE`]. Chosen, not measured.
    pub const WATCHED: f64 = 2.0 * ZONE_EDGE;
    /// Reversal is predicted if the component across the old direction is smaller than this at the edge;
    /// otherwise the slip only turns. Decision 0012 ("within a few reference speeds"); the number: chosen,
    /// not measured.
    pub const REVERSAL_WIDTH: f64 = 5.0 * ZONE_EDGE;

    /// Error bounds in zones widen in proportion to the smallest slip: an error may be this part of it.
    /// Decision 0012.
    pub const BOUND_WIDENING: f64 = 0.05;
    /// Stick-to-slip transition: the slip was below this at the start of the step ...
    pub const STICKING: f64 = 3.0;
    /// ... and has grown by this much ...
    pub const RELEASE_GROWTH: f64 = 1.0;
    /// ... and by this factor at its end. All three: decision 0027.
    pub const RELEASE_FACTOR: f64 = 1.5;
    /// The friction law still holds slips below this, if only by the tail of tanh: such steps have their
    /// dense output corrected. Decision 0029.
    pub const TAIL: f64 = 12.0;
}

/// Location of events in a step.
pub mod events {
    /// Event functions of implicit steps are evaluated at these fractions of the step besides its end.
    /// Explicit steps, a radian of the fastest oscillation long, are evaluated at their end alone: decision
    /// 0029.
    pub const INTERMEDIATE: &[f64] = &[0.5];
    /// Width of the bracket around an event, as a fraction of the step. 1e-7 saves 1.2 % of the instructions,
    /// 1e-9 1 % with larger errors in the times (decision 0045).
    pub const RESOLUTION: f64 = 1e-12;
    /// The same in units of the resolution of the time. Chosen, not measured.
    pub const TIME_RESOLUTION: f64 = 4.0;
}

/// Root search: the first zero of several functions.
pub mod root_search {
    /// The next point lies this far beyond the expected zero, in units of the resolution, so that the bracket
    /// closes from both sides. Chosen, not measured.
    pub const NUDGE: f64 = 0.4;
    /// The nudge grows by this power of two each time the intended end of the bracket did not move. Chosen,
    /// not measured.
    pub const NUDGE_GROWTH_BITS: i32 = 2;
    /// The growth of the nudge stops after this many times. Chosen, not measured.
    pub const MAXIMUM_NUDGE_GROWTH: i32 = 10;
    /// Every this many iterations the bracket must have shrunk ...
    pub const CHECK_INTERVAL: u32 = 3;
    /// ... to this part, which bisection would have reached, or it is halved: the idea of R. P. Brent,
    /// *Algorithms for Minimization without Derivatives* (1973), chapter 4.
    pub const CHECK_SHRINKAGE: f64 = 0.125;
    /// After this many iterations every one halves the bracket. Chosen, not measured.
    pub const BISECT_AFTER: u32 = 24;
    /// Points keep at least this distance from the ends of the bracket, in units of the resolution or its
    /// width. Chosen, not measured.
    pub const END_DISTANCE: f64 = 0.25;
    /// Newton iterations for the zero of the cubic, from that of the parabola. Chosen, not measured.
    pub const CUBIC_ITERATIONS: usize = 2;
}

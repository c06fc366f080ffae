//! Plausibility of a run: whether its bodies stayed where the model means something.
//!
//! The equations have a solution also where they no longer describe a machine: a surface is an unbounded
//! plane, a contact spring can be compressed without limit, a coil can be turned inside out. [`Plausibility`]
//! is shown a run at each output time, keeps the worst value of each quantity at each place, and gives a
//! [`PlausibilityFinding`] for each that exceeds its limit. It knows bodies, contact faces, coils, other
//! force elements and connections of a [`System`](crate::system::System), whatever they stand for. It changes
//! nothing in a run, and allocates nothing after its construction.
//!
//! Limits, with their reasons, are the constants of this module; lengths are taken from the model itself.

mod check;
mod finding;
mod observer;

pub use finding::{FindingKind, Location, PlausibilityFinding};
pub use observer::{FaceRecord, Plausibility, PlausibilityRecord, WorstValue};

/// Largest penetration of a contact point, as a share of the smallest extent of its face. Up to 1 % the
/// angles and levers of the undeformed faces are exact to about a percent.
pub const PENETRATION_SHARE: f64 = 0.01;

/// Largest tilt of a face against its surface since the start, rad. At 0.2 rad (11°) one edge stands off by
/// a fifth of the face's length: not its corners would touch next, but edges and sides that the model does
/// not have.
pub const LARGEST_TILT: f64 = 0.2;

/// Largest rotation of a body with linearized kinematics, rad. At 0.1 rad the cosine that linearization
/// sets to 1 is smaller by 0.5 %.
pub const LARGEST_SMALL_ANGLE: f64 = 0.1;

/// Largest contact energy that overlap at the start may release, as a share of the run's energy scale
/// (largest of work, losses, change of stored energy, and stored energy at the start, which does not depend
/// on how long the run is). Beyond a fifth, the release and not the motion determines the energies of the
/// run.
pub const RELEASED_SHARE: f64 = 0.2;

/// Largest coefficient of friction. Dry steel on steel stays below 0.8.
pub const LARGEST_FRICTION: f64 = 1.0;

/// Largest compression of a coil, as a share of its free length. No railway coil has a solid height of less
/// than a third of its free length.
pub const LARGEST_COMPRESSION_SHARE: f64 = 2.0 / 3.0;

/// Admissible lengthening of a coil, as a share of its free length: up to 2 % it stays on its seat.
pub const LIFTED_SHARE: f64 = 0.02;

/// Largest scatter of the normal force of a face between output times: the mean absolute second difference
/// of successive values over their mean, or over the weight of the body if that is larger. Smooth motion at
/// a hundred output times a period has 0.003; independent random values that deviate from their mean by 10
/// % have 0.2.
pub const LARGEST_SCATTER: f64 = 0.2;

/// Extent of a face, as a share of its other one, below which it has none: of points on a line what is left
/// across is rounding.
pub const LEAST_EXTENT_SHARE: f64 = 0.01;

/// Least limit of a length, as a share of the size of the model: smaller ones are rounding of places, and no
/// limits.
pub const LEAST_LENGTH_SHARE: f64 = 1e-6;

/// Output times a period that show a vibration's amplitude to 5 %.
pub const ROWS_A_PERIOD: f64 = 10.0;

/// Output times from which on scatter is judged.
pub const FEWEST_ROWS: u64 = 20;

//! Sensitivity of the verdicts on the thesis's statements to parameters that the thesis leaves open.
//!
//! The twelve runs are made at many points of a space of open parameters ([`open_parameters`]), and each
//! statement is decided at each of them: of the points that decide it, it holds at all of them (*always*), at
//! half or more (*mostly*), at fewer (*seldom*), or at none (*never*). The parameter that decides is the one
//! whose single cut tells best where it holds ([`deciding`]), and pairs of parameters are named where they
//! tell more than any of them alone ([`Pair`]). Another law and other directions of friction stand apart from
//! the space.
//!
//! "Always" is said of the points that were run: of n points without an exception, a share of 3/n or more
//! without it would have been met in 95 of 100 such samples.

mod axes;
mod outcome;
mod pairs;
mod point;
mod points_file;
mod space;
mod split;
mod stiffness;

pub use axes::{AXES, FigureAxis};
pub use outcome::{
    Extent, FILE_NAME, OfFriction, ParameterShown, SCHEMA, Sensitivity, Statement, Tally, UnderFriction,
};
pub use pairs::{Pair, PairShown};
pub use point::{PointOutcome, compute};
pub use points_file::{FOLDER, POINTS_FILE, PointsFile, PointsFileError};
pub use space::{FRICTIONS, OpenParameter, OtherFriction, PointPlace, Space, open_parameters};
pub use split::{Side, Split, deciding};
pub use stiffness::{Alone, Mean, OfStiffness, StiffnessPart};

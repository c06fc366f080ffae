//! Numbers and linear algebra for the equations of multibody systems.
//!
//! | what | where |
//! |---|---|
//! | laws written once over a scalar; numbers with derivatives | [`scalar`]: [`scalar::Real`], [`scalar::Dual`] |
//! | four numbers at a time | [`lanes`] |
//! | block-sparse LU factorization | [`BlockLu`] |
//! | linear algebra of second-order systems: positions, internal states and quadratures eliminated | [`partitioned`] |
//! | whether the processor has the instructions that the program was compiled for | [`processor`] |
//!
//! Elementary functions come from a Rust library and sums have a fixed order: the same input gives the same
//! bits on every system.
//!
//! ```
//! use numerics::scalar::{Dual, Real};
//! fn force<S: Real>(compression: S) -> S {
//!     compression * compression * 3.0
//! }
//! assert_eq!(force(2.0), 12.0);
//! assert_eq!(force(Dual::<1>::variable(2.0, 0)).derivative, [12.0]);
//! ```

#![warn(missing_docs)]

mod block_lu;
mod dense_block;
pub mod lanes;
pub mod partitioned;
pub mod processor;
pub mod scalar;

pub use block_lu::{BlockLu, Singular};

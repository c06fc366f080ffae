//! Tests of `numerics`, one program: what is linked once is not linked thirty times.
#![allow(clippy::unwrap_used, missing_docs)]

mod block_lu;
mod partitioned;

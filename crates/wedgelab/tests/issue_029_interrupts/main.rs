//! Issue 29: signals and kills leave no hidden folder and no half file, say what was kept, and the next start
//! goes on.

#![cfg(unix)]
#![allow(clippy::unwrap_used)]

mod brief;
mod common;
mod left_over;
mod others;
mod reproduction;
mod runs;
mod studies;

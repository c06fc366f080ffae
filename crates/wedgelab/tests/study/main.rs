//! `wedgelab study` and `wedgelab fit`, as a user calls them, and as machines treat them.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod common;
mod damaged;
mod fit;
mod input;
mod killed;
mod table;

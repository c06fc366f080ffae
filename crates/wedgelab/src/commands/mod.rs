//! The commands, one file each: arguments and what they do.

pub mod case;
pub mod nucars;
pub mod quasi_static;
pub mod reproduce;
pub mod run;

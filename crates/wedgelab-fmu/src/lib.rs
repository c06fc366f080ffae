//! The binary of wedgelab's functional mock-up units: the C interface of FMI 2.0 and FMI 3.0, every function
//! of both.
//!
//! Nothing is computed here: each function turns pointers into slices, calls [`fmi::instance::Instance`], and
//! turns the result into a status and messages for the importer's log. Null pointers, unknown references
//! and calls out of order are errors; a panic does not leave the library: it becomes an error, and the
//! instance refuses everything after it. Whatever is refused (`Error`, `Discard`, an instance that cannot be
//! made) is sent to the importer's logger with the name of the function, if there is a logger, also while
//! logging is switched off. Without an instance (null, or freed) there is none: then the status is all.
//!
//! The functions of both versions lie in one library, whose names do not collide. Their signatures are those
//! of the standard's headers; a test compiles a C program against these.
#![allow(non_snake_case)]

mod component;
pub mod fmi2;
pub mod fmi3;
mod handles;
mod pointers;
mod states;

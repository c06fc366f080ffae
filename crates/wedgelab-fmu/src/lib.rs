//! The binary of wedgelab's functional mock-up units: the C interface of FMI 2.0 and FMI 3.0, every function of both.
//!
//! Nothing is computed here: each function turns pointers into slices, calls [`fmi::instance::Instance`], and turns what comes out into
//! a status and messages for the importer's log. Null pointers, unknown references and calls out of order are errors; a panic does not
//! leave the library: it becomes an error, and the instance refuses everything after it.
//!
//! The functions of both versions lie in one library, whose names do not collide. Their signatures are those of the standard's
//! headers; a test compiles a C program against these.
#![allow(non_snake_case)]

mod component;
pub mod fmi2;
pub mod fmi3;

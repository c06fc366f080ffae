//! Broken inputs for every reader: a corpus of real files, kinds of mutation, and the rules for each
//! reader.
//!
//! [`readers::ALL`] names the readers. A reader takes any bytes and either accepts or refuses them; it panics
//! if it breaks a promise: a place outside the text, a message longer than [`limits::LONGEST_MESSAGE`], a
//! document that is another one once it is written and read again. [`inputs::Inputs`] makes the bytes: input
//! `n` of a seed is a function of reader, seed and `n` alone, so that whatever is found is found again by
//! these three.
//!
//! The program `fuzz` (`cargo xtask fuzz`) runs readers in processes of their own, so that aborts, overflows
//! of the stack, hangs and memory are seen too.

pub mod inputs;
pub mod limits;
pub mod mutate;
pub mod readers;
pub mod reference;
pub mod shown;

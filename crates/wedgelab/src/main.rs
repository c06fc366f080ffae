//! The command line of Wedgelab.
fn main() {}

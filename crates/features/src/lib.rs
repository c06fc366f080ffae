//! No code. Cargo compiles a dependency anew for every set of its features, and everything above it: this
//! crate asks for the features that the command, the tests and the Python package have together, so that one
//! build serves all. The check `features` (`cargo xtask test --only features`) compares them.

//! Benchmarks: how fast, with caveats.
//!
//! Wall times depend on the machine and on what else it does: compare within one run, and trust ratios of 1.2 and more.
//! Instruction counts (`valgrind --tool=callgrind`) repeat to the last digit for the same binary.

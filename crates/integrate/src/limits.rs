//! Version and limits of saved states.

/// Version of the layout of [`crate::State`]. States of other versions are refused.
pub const STATE_VERSION: u32 = 14;

/// Largest admissible counter in a saved state. A run of a million steps per second reaches it in thirty
/// years, and no counter below it can overflow in a run.
pub const MAXIMUM_COUNT: u64 = 1_000_000_000_000_000;

/// Largest admissible size of a state in a saved state: up to it products of three states are finite, and a
/// problem can be evaluated. A run whose states are larger cannot go on, but would try for long.
pub(crate) const LARGEST_STATE: f64 = 1e100;

/// Largest admissible number of rejections in a row in a saved state. Each rejection shortens the step, so a
/// few thousand lead from the longest step to none.
pub(crate) const MAXIMUM_REJECTIONS: u32 = 1_000_000;

//! Small motions about a state, and motions of a given amplitude by equivalent linearization.
//!
//! With the displacements q of all free coordinates from a state at rest or in steady motion,
//!
//! ```text
//! M q¨ = K q + D q˙ + Σ_j f_j (k_j s_j + c_j s˙_j),   s_j = g_j q
//! ```
//!
//! where j counts the directions in which friction acts: s is the slip displacement there, f the generalized
//! force of a unit friction force. A bristle that sticks is a spring, `k = K_b`, `c = C_b`; without friction
//! both are zero; at an amplitude both follow from the describing function of a slider
//! ([`Slider::equivalent`]). K and D hold all else: springs, creep of wheels, weights.
//!
//! | what | where |
//! |---|---|
//! | the matrices of a system | [`System::linear_model`](crate::system::System::linear_model), [`LinearModel`] |
//! | stiffness and damping of friction over the amplitude | [`Slider`] |
//! | growth, frequency and shape of slow motions | [`SecondOrder::modes`] |

mod model;
mod modes;
mod slider;

pub(crate) use model::Entry;
pub use model::{LinearModel, SliderPlace, SlidingPair};
pub(crate) use modes::inverse_eigenvalues;
pub use modes::{LinearMode, NoVibration, SecondOrder};
pub use slider::{Equivalent, Slider};

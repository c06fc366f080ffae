//! Damage of wheels and rails in rolling: wear and rolling contact fatigue, and what they leave on a profile.

mod archard;
mod fatigue;
mod surface;

pub use archard::WearMap;
pub use fatigue::DamageFunction;
pub use surface::{Dose, Surface};

//! Bushings: see [`mechanics::elements::Bushing`].

use mechanics::elements::Bushing as Law;

use super::{CatalogElement, Place};

/// Springs and dampers along and about x, y, z of end B.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bushing {
    /// Force on end A in the nominal layout, N.
    pub load: [f64; 3],
    /// Stiffness, N/m.
    pub stiffness: [f64; 3],
    /// Damping, N·s/m.
    pub damping: [f64; 3],
    /// Stiffness of rotations, N·m/rad.
    pub rotational_stiffness: [f64; 3],
    /// Damping of rotations, N·m·s/rad.
    pub rotational_damping: [f64; 3],
    /// Roll, pitch, yaw of its axes in the nominal layout, rad.
    pub turned: [f64; 3],
}

impl CatalogElement for Bushing {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let law = Law {
            name: place.name.to_owned(),
            load: self.load,
            stiffness: self.stiffness,
            damping: self.damping,
            rotational_load: [0.0; 3],
            rotational_stiffness: self.rotational_stiffness,
            rotational_damping: self.rotational_damping,
        };
        let ends = [0, 1].map(|end| place.marker(end, self.turned));
        let acts = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] != 0.0 || b[k] != 0.0);
        let along = acts(self.stiffness, self.damping);
        let along = [0, 1, 2].map(|k| along[k] || self.load[k] != 0.0);
        let about = acts(self.rotational_stiffness, self.rotational_damping);
        place.wrench_channels(&law, ends, (along, about));
        place.element(law, ends[0], ends[1]);
        Ok(())
    }
}

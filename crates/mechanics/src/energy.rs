//! The energies of a system: what is stored, and the quadratures of works and dissipations.

/// Energies of the whole system, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Potential energy in the gravity field.
    pub gravity: f64,
    /// Energy of the coils, those of massless wedges included.
    pub coil: f64,
    /// Energy of the contact springs.
    pub contact: f64,
    /// Energy of the bristles of contact points and of the force accumulators of connections.
    pub bristle: f64,
    /// Energy of the springs of connections, also behind gaps and under surfaces.
    pub spring: f64,
    /// Energy of other force elements.
    pub element: f64,
}

impl Energies {
    /// Returns all of it.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.gravity + self.coil + self.contact + self.bristle + self.spring + self.element
    }
}

/// The description of the integrand of a quadrature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EnergyTerm {
    /// Its kind.
    pub kind: EnergyTermKind,
    /// The element's name; empty for the work of the motions, and where elements of a kind stand together.
    pub element: String,
}

impl EnergyTerm {
    /// Returns its name, as in results: of the element, if it has one, and of the kind.
    #[must_use]
    pub fn name(&self) -> String {
        match (self.kind, self.element.as_str()) {
            (EnergyTermKind::MotionWork, _) => "motion_work".to_owned(),
            (kind, "") => kind.name().to_owned(),
            (kind, element) => format!("{element}_{}", kind.name()),
        }
    }
}

/// Kinds of quadratures; all in J.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum EnergyTermKind {
    /// Work done by all prescribed motions.
    MotionWork,
    /// Energy lost in friction.
    FrictionLoss,
    /// Energy lost in contact damping.
    ContactDampingLoss,
    /// Energy lost in a coil's damping.
    CoilDampingLoss,
    /// Work done by a coil's guiding couple.
    CoilGuideWork,
    /// Energy lost in another force element.
    ElementLoss,
    /// Work that another force element puts in, of either sign ([`crate::element::Element::does_work`]).
    ElementWork,
    /// Energy lost in dampers of springs.
    SpringDamping,
    /// Energy lost in dampers in series with gaps.
    GapDamping,
    /// Energy lost in surface friction.
    SurfaceFriction,
    /// Energy lost in the normal dampers of surface friction.
    SurfaceDamping,
    /// Energy lost in the friction of massless wedges on their columns.
    ColumnFriction,
    /// Work of massless wedges' friction on their slopes; over a cycle a loss, while the friction force
    /// rebounds it gives back.
    SlopeFriction,
    /// Work that goes into the simplified kinematics of massless wedges (see [`crate::connection::Wedge`]);
    /// small, of either sign.
    WedgeKinematics,
}

impl EnergyTermKind {
    /// Returns whether it is work that is put in, not a loss.
    #[must_use]
    pub fn is_work(self) -> bool {
        matches!(self, Self::MotionWork | Self::CoilGuideWork | Self::ElementWork)
    }

    /// Returns its name, as in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MotionWork => "input_work",
            Self::FrictionLoss => "friction_loss",
            Self::ContactDampingLoss => "contact_damping_loss",
            Self::CoilDampingLoss => "coil_damping_loss",
            Self::CoilGuideWork => "coil_guide_work",
            Self::ElementLoss => "element_loss",
            Self::ElementWork => "element_work",
            Self::SpringDamping => "spring_damping_loss",
            Self::GapDamping => "gap_damping_loss",
            Self::SurfaceFriction => "surface_friction_loss",
            Self::SurfaceDamping => "surface_damping_loss",
            Self::ColumnFriction => "wedge_column_loss",
            Self::SlopeFriction => "wedge_slope_loss",
            Self::WedgeKinematics => "wedge_kinematics_work",
        }
    }
}

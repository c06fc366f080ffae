//! The rigid bodies of a description.

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::motion::Motion;
use truck::{Applied, unloaded};
use wedge::parameters::NeighbourMotion;

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    /// Its name.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Principal moments of inertia about the center of gravity, along the fixed axes, kg·m².
    pub inertia: [f64; 3],
    /// Its center of gravity in the nominal layout, m.
    pub place: [f64; 3],
    /// The free coordinates among x, y, z, roll, pitch, yaw; the others are held. If none is free, its motion
    /// is prescribed.
    pub free: [bool; 6],
    /// The prescribed motion; about the center of gravity if no center is given.
    pub motion: NeighbourMotion,
    /// Loads over time on its free coordinates.
    pub applied: Applied,
    /// How it starts.
    pub start: BodyStart,
    /// Edges along x, y, z of the box that is drawn for it, m; none: those of a box of its mass and inertia.
    pub size: Option<[f64; 3]>,
}

/// The start of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyStart {
    /// Displacement of its coordinates from the nominal layout, or from the rest that the run starts from: x,
    /// y, z (m), roll, pitch, yaw (rad).
    pub displacement: [f64; 6],
    /// Their rates, m/s and rad/s.
    pub rates: [f64; 6],
}

impl RigidBody {
    /// Returns a body with six free coordinates: mass (kg), moments of inertia (kg·m²), place (m).
    #[must_use]
    pub fn new(name: &str, mass: f64, inertia: [f64; 3], place: [f64; 3]) -> Self {
        Self {
            name: name.to_owned(),
            mass,
            inertia,
            place,
            free: [true; 6],
            motion: NeighbourMotion::fixed(),
            applied: unloaded(),
            start: BodyStart::default(),
            size: None,
        }
    }

    /// Returns whether its motion is prescribed.
    #[must_use]
    pub fn is_prescribed(&self) -> bool {
        !self.free.contains(&true)
    }

    /// Returns the edges of the box that is drawn for it, m: as given, or of the solid box with its mass and
    /// moments of inertia; a cube of half a meter where there is none.
    #[must_use]
    pub fn box_size(&self) -> [f64; 3] {
        if let Some(size) = self.size {
            return size;
        }
        let [x, y, z] = self.inertia;
        // Iₓ = m (b² + c²)/12 and so on.
        let squares = [y + z - x, z + x - y, x + y - z].map(|sum| 6.0 * sum / self.mass);
        match squares.iter().all(|own| *own > 0.0 && own.is_finite()) {
            true => squares.map(f64::sqrt),
            false => [0.5; 3],
        }
    }

    /// Returns its start by the coordinates of its reference frame, which is turned on a track
    /// ([`car::upright`]): displacements and rates.
    pub(crate) fn start_in_frame(&self, on_track: bool) -> [[f64; 6]; 2] {
        let own = [self.start.displacement, self.start.rates];
        match on_track {
            false => own,
            true => own.map(|[x, y, z, roll, pitch, yaw]| [x, z, -y, roll, yaw, -pitch]),
        }
    }

    /// Returns its loads over time by these coordinates.
    pub(crate) fn loads_in_frame(&self, on_track: bool) -> Applied {
        let own = self.applied.clone();
        match on_track {
            false => own,
            true => {
                let [x, y, z, roll, pitch, yaw] = own;
                [x, z, y.scaled(-1.0), roll, yaw, pitch.scaled(-1.0)]
            }
        }
    }

    /// Returns the body as the core knows it, in the nominal layout.
    pub(crate) fn body(&self) -> Body {
        if self.is_prescribed() {
            let mut frame = Frame::fixed(self.motion.center.unwrap_or(self.place), [0.0; 3]);
            frame.motions.clone_from(&self.motion.coordinates);
            let center_of_gravity = std::array::from_fn(|k| self.place[k] - frame.origin[k]);
            return Body {
                center_of_gravity,
                ..Body::prescribed(&self.name, frame)
            };
        }
        let mut body = Body::free(&self.name, self.mass, self.inertia, [0.0; 6]);
        body.frame = Frame::fixed(self.place, [0.0; 3]);
        body.free = self.free;
        body
    }

    /// Returns whether one of its coordinates (0 to 5) can change.
    #[must_use]
    pub fn moves(&self, coordinate: usize) -> bool {
        match self.is_prescribed() {
            // A turn about a point aside moves its center of gravity too.
            true => {
                let own = &self.motion.coordinates;
                let turns = self.motion.center.is_some() && own[3..].iter().any(|own| !own.is_constant());
                !own[coordinate].is_constant() || (coordinate < 3 && turns)
            }
            false => self.free[coordinate],
        }
    }

    /// Returns the same body with its motion and its loads held as they are at time zero.
    pub(crate) fn held(&self) -> Self {
        let mut held = self.clone();
        for course in held.motion.coordinates.iter_mut().chain(&mut held.applied) {
            *course = Motion::Constant(course.evaluate(0.0, 0.0)[0]);
        }
        held
    }
}

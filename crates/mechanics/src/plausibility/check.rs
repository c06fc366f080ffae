//! The quantities checked in a system, and the limits that follow from its geometry at the start.

use super::{
    FindingKind, LARGEST_COMPRESSION_SHARE, LARGEST_SMALL_ANGLE, LARGEST_TILT, LEAST_EXTENT_SHARE,
    LEAST_LENGTH_SHARE, LIFTED_SHARE, Location, PENETRATION_SHARE,
};
use crate::body::Body;
use crate::coil::CoilLaw;
use crate::connection::Law;
use crate::link::RelativeMotion;
use crate::system::{EnergyTermKind, System};
use crate::vector::Vector;
use quantity::Kind;

/// A quantity at a place, and its limit (SI).
#[derive(Clone, Copy, Debug)]
pub(super) struct PlausibilityCheck {
    pub kind: FindingKind,
    pub location: Location,
    pub limit: f64,
}

/// A face at the start.
#[derive(Clone, Debug)]
pub(super) struct FaceStart {
    /// The surface's normal, in axes of the body that carries the points.
    pub normal: Vector<f64>,
    /// The mean of the points, body axes, and where it was seen from the mount, m.
    pub middle: Vector<f64>,
    pub place: Vector<f64>,
    /// Estimated frequency at which the body vibrates on all points of the face, Hz.
    pub frequency: f64,
    /// Weight of the body, N: smaller normal forces do not matter.
    pub weight: f64,
}

/// All checks, in the order in which [`super::Plausibility::note`] finds the values.
#[derive(Clone, Debug, Default)]
pub(super) struct Checks {
    pub all: Vec<PlausibilityCheck>,
    pub faces: Vec<FaceStart>,
    /// Distances between the markers of other force elements at the start, m.
    pub distances: Vec<f64>,
    /// Bodies that move, and whose displacements count as small: with linearized kinematics, or with
    /// connections that act on differences of coordinates.
    pub linearized: Vec<usize>,
    /// The energy terms that are losses.
    pub losses: Vec<usize>,
    /// Least limit of a length, m.
    least_length: f64,
}

impl Checks {
    /// Returns the checks of a system that was placed at its start.
    pub fn new(system: &System) -> Self {
        let size = system_size(system);
        let free = system.bodies().iter().filter(|body| !body.is_prescribed());
        let scale = free.fold(size, |most, body| most.max(gyration(body)));
        let mut checks = Self {
            least_length: LEAST_LENGTH_SHARE * scale,
            ..Self::default()
        };
        for face in 0..system.faces().len() {
            checks.add_face(system, face);
        }
        for coil in 0..system.coils().len() {
            checks.add_coil(system, coil);
        }
        for element in 0..system.element_count() {
            checks.distances.push(system.element_distance(element));
            checks.add(FindingKind::Displacement, Location::Element(element), size);
        }
        for (number, body) in system.bodies().iter().enumerate() {
            // Connections between markers see relative motions, wherever the bodies are.
            let on_coordinates = || system.connections().iter().filter(|own| own.markers.is_none());
            let ends = || on_coordinates().flat_map(|own| [own.a, own.b]);
            let small = body.linearized || ends().any(|end| end == number);
            if small && (!body.is_prescribed() || body.is_moving_prescribed()) {
                checks.linearized.push(number);
                let location = Location::Body(number);
                for _ in 0..3 {
                    checks.add(FindingKind::Displacement, location, size);
                }
                for coordinate in 3..6 {
                    checks.add(FindingKind::LargeAngle(coordinate), location, LARGEST_SMALL_ANGLE);
                }
            }
        }
        for (number, connection) in system.connections().iter().enumerate() {
            if let Law::Wedge(wedge) = &connection.law {
                // Compression is negative deflection.
                let points = wedge.coil.points();
                let last = points.first().filter(|_| !is_straight(points));
                let limit = last.map_or(f64::INFINITY, |[compressed, _]| -compressed);
                checks.add(FindingKind::BeyondTable, Location::Connection(number), limit);
            }
        }
        for (number, term) in system.energy_terms().iter().enumerate() {
            // What the simplified kinematics of massless wedges take is of either sign.
            if !term.kind.is_work() && term.kind != EnergyTermKind::WedgeKinematics {
                checks.losses.push(number);
                // The limit is known when the run has ended.
                checks.add(
                    FindingKind::EnergyCreated,
                    Location::EnergyTerm(number),
                    f64::INFINITY,
                );
            }
        }
        checks
    }

    fn add(&mut self, kind: FindingKind, location: Location, limit: f64) {
        let least = match kind.quantity() {
            Kind::Length => self.least_length,
            _ => 0.0,
        };
        let limit = if limit > least { limit } else { f64::INFINITY };
        self.all.push(PlausibilityCheck {
            kind,
            location,
            limit,
        });
    }

    fn add_face(&mut self, system: &System, face: usize) {
        let mounted = &system.faces()[face];
        let (points, body) = (&mounted.element.points, &system.bodies()[mounted.body]);
        let relative: RelativeMotion<f64> = system.face_relative(face);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        let (mut middle, mut stiffness) = (Vector::zero(), 0.0);
        for point in points {
            let arm: Vector<f64> = relative.rotation.apply(point.position);
            for k in 0..3 {
                low[k] = low[k].min(arm.0[k]);
                high[k] = high[k].max(arm.0[k]);
            }
            middle += point.position.scale::<f64, f64>(1.0 / points.len() as f64);
            stiffness += point.stiffness;
        }
        let extents = [1, 2].map(|k| high[k] - low[k]);
        let least = self
            .least_length
            .max(LEAST_EXTENT_SHARE * extents[0].max(extents[1]));
        // Points on a line have no extent across it, but for rounding.
        let extents = extents.map(|extent| if extent > least { extent } else { f64::INFINITY });
        let mut size = extents[0].min(extents[1]);
        if size.is_infinite() && !points.is_empty() {
            // A face without extents: the diameter of gyration stands for the size of the body.
            size = gyration(body);
        }
        let location = Location::Face { face, point: None };
        self.add(FindingKind::Separation, location, size);
        for extent in extents {
            self.add(FindingKind::SlidOff, location, extent);
        }
        self.add(FindingKind::Penetration, location, PENETRATION_SHARE * size);
        self.add(FindingKind::Tilt, location, LARGEST_TILT);
        let other = &system.bodies()[mounted.on];
        let inverse_mass = 1.0 / body.mass
            + if other.is_prescribed() {
                0.0
            } else {
                1.0 / other.mass
            };
        self.faces.push(FaceStart {
            normal: relative
                .rotation
                .apply_transposed::<f64, f64>(Vector([1.0, 0.0, 0.0])),
            middle,
            place: relative.at(middle).position,
            weight: system.weight(mounted.body),
            frequency: (stiffness * inverse_mass).sqrt() / std::f64::consts::TAU,
        });
    }

    fn add_coil(&mut self, system: &System, number: usize) {
        let coil = &system.coils()[number].element;
        let location = Location::Coil(number);
        let last = match &coil.law {
            CoilLaw::Table(table) if !is_straight(table.points()) => table
                .points()
                .last()
                .map_or(f64::INFINITY, |[compression, _]| *compression),
            _ => f64::INFINITY,
        };
        self.add(
            FindingKind::Solid,
            location,
            LARGEST_COMPRESSION_SHARE * coil.free_length,
        );
        self.add(FindingKind::BeyondTable, location, last);
        // A force from outside does not end with the free length.
        let lifted = match coil.law {
            CoilLaw::Given { .. } => f64::INFINITY,
            _ => LIFTED_SHARE * coil.free_length,
        };
        self.add(FindingKind::Lifted { pulls: coil.pulls }, location, lifted);
    }
}

/// Returns the largest diameter of gyration of a body, m.
fn gyration(body: &Body) -> f64 {
    let inertia = body.inertia.iter().fold(0.0, |most: f64, own| most.max(*own));
    2.0 * (inertia / body.mass).sqrt()
}

/// Returns whether a table of abscissa and ordinate is straight: then it stands for a stiffness, whatever
/// its reach.
fn is_straight(points: &[[f64; 2]]) -> bool {
    let slope = |pair: &[[f64; 2]]| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
    let mut slopes = points.windows(2).map(slope);
    let first = slopes.next().unwrap_or(0.0);
    slopes.all(|slope| (slope - first).abs() <= 1e-9 * first.abs())
}

/// Returns the diagonal of the box around all origins of bodies and points of connections in the drawn
/// layout, m.
fn system_size(system: &System) -> f64 {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let origins = system.bodies().iter().map(|body| {
        let origin = body.frame.origin;
        // The initial coordinates of a body in its frame, whose axes may be turned: their size matters.
        std::array::from_fn(|k| origin[k] + body.initial[k])
    });
    let points = system.connections().iter().map(|connection| connection.point);
    for point in origins.chain(points) {
        let point: [f64; 3] = point;
        for k in 0..3 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    let squares = low
        .iter()
        .zip(&high)
        .map(|(low, high)| (high - low) * (high - low));
    squares.sum::<f64>().sqrt()
}

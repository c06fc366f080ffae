//! The car body with its lading as one rigid body, and angles of bodies.

use mechanics::vector::{Matrix, Vector};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use crate::parameters::Parameters;

/// Mass properties of body and lading together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    /// Mass, kg.
    pub mass: f64,
    /// Center of gravity: forward, to the left, above the top of rail, m.
    pub center: [f64; 3],
    /// Principal moments of inertia, kg·m², about the axes that are the columns of `axes`: the principal
    /// axes that are nearest to forward, left, up.
    pub inertia: [f64; 3],
    /// See `inertia`.
    pub axes: Matrix<f64>,
}

impl Carried {
    pub fn new(parameters: &Parameters) -> Self {
        let (mass, center) = (parameters.carried_mass(), parameters.center_of_gravity());
        let own = &parameters.body;
        let mut parts = vec![(own.mass, [0.0, 0.0, own.height], own.inertia)];
        parts.extend(
            parameters
                .lading
                .iter()
                .map(|own| (own.mass, own.place, own.inertia)),
        );
        let mut tensor = Matrix3::zeros();
        for (mass, place, inertia) in parts {
            let arm = Vector3::from_fn(|k, _| place[k] - center[k]);
            tensor += Matrix3::from_diagonal(&Vector3::from(inertia));
            tensor += (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * mass;
        }
        let sides = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| tensor[(i, j)].abs());
        let largest = tensor.diagonal().max();
        if sides.iter().all(|side| *side <= 1e-12 * largest) {
            return Self {
                mass,
                center,
                inertia: [0, 1, 2].map(|k| tensor[(k, k)]),
                axes: Matrix([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
            };
        }
        let solved = SymmetricEigen::new(tensor);
        // Forward is the axis with the largest part forward, then left; up completes them.
        let column = |k: usize| solved.eigenvectors.column(k).into_owned();
        let nearest = |axis: usize, but: Option<usize>| {
            let others = (0..3).filter(|k| Some(*k) != but);
            let part = |k: usize| column(k)[axis].abs();
            others
                .max_by(|a, b| part(*a).total_cmp(&part(*b)))
                .unwrap_or(axis)
        };
        let forward = nearest(0, None);
        let left = nearest(1, Some(forward));
        let up = 3 - forward - left;
        let towards = |k: usize, axis: usize| column(k) * if column(k)[axis] < 0.0 { -1.0 } else { 1.0 };
        let (x, y) = (towards(forward, 0), towards(left, 1));
        let z = x.cross(&y);
        Self {
            mass,
            center,
            inertia: [forward, left, up].map(|k| solved.eigenvalues[k]),
            axes: Matrix([0, 1, 2].map(|row| [x[row], y[row], z[row]])),
        }
    }
}

/// Returns the angles (roll, pitch, yaw in the order of the core: pitch, yaw, roll) of a rotation, rad.
pub(crate) fn angles(rotation: &Matrix<f64>) -> [f64; 3] {
    let Matrix(r) = rotation;
    [
        libm::atan2(-r[1][2], r[1][1]),
        libm::atan2(-r[2][0], r[0][0]),
        libm::asin(r[1][0].clamp(-1.0, 1.0)),
    ]
}

/// A pose: a place (m) and a rotation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub place: Vector<f64>,
    pub rotation: Matrix<f64>,
}

impl Pose {
    /// Returns the pose that this one leads to from `base`.
    pub fn after(&self, base: &Self) -> Self {
        let moved: Vector<f64> = base.rotation.apply(self.place);
        Self {
            place: base.place + moved,
            rotation: base.rotation.times(self.rotation),
        }
    }

    /// Returns the pose in the middle of this one and another, which is turned by little.
    pub fn between(&self, other: &Self) -> Self {
        let column = |k: usize| -> Vector<f64> { self.rotation.column(k) + other.rotation.column(k) };
        let unit = |own: Vector<f64>| -> Vector<f64> { own.scale(1.0 / own.dot::<f64, f64>(own).sqrt()) };
        let x = unit(column(0));
        let z = unit(x.cross(column(1)));
        let y: Vector<f64> = z.cross(x);
        Self {
            place: (self.place + other.place).scale(0.5),
            rotation: Matrix([0, 1, 2].map(|row| [x.0[row], y.0[row], z.0[row]])),
        }
    }

    /// Returns the pose that leads from `base` to this one.
    pub fn before(&self, base: &Self) -> Self {
        Self {
            place: base.rotation.apply_transposed(self.place - base.place),
            rotation: base.rotation.transpose().times(self.rotation),
        }
    }
}

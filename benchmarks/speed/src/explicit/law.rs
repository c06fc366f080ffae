//! Forces between a point of one body and another body.

use super::vector::V;

/// A force on a point by its displacement from its nominal place and its velocity, both in the axes of a
/// link: z is the normal of faces and the axis of coils.
#[derive(Clone, Copy, Debug)]
pub enum Law {
    /// A coil: preload N, stiffnesses along and across N/m, damping N·s/m, travel m until it is solid.
    Coil {
        preload: f64,
        along: f64,
        across: f64,
        damping: f64,
        travel: f64,
    },
    /// A face that only pushes: stiffness N/m, damping N·s/m, gap m (negative: pressed in the nominal place),
    /// and a slider with dry friction across (Cundall and Strack, 1979): coefficient, stiffness N/m, damping
    /// N·s/m, the slider's number.
    Face {
        stiffness: f64,
        damping: f64,
        gap: f64,
        friction: f64,
        slider_stiffness: f64,
        slider_damping: f64,
        slider: usize,
    },
    /// A stop to both sides of an axis: clearance m, stiffness N/m, damping N·s/m.
    Stop {
        axis: usize,
        clearance: f64,
        stiffness: f64,
        damping: f64,
    },
    /// A rim about the point: clearance m, stiffness N/m, damping N·s/m.
    Rim {
        clearance: f64,
        stiffness: f64,
        damping: f64,
    },
}

/// Stiffness of a solid coil, N/m.
const SOLID: f64 = 250_000.0 * super::POUND_PER_INCH;

/// The answer of a law: force N, stored energy J, normal force N.
pub struct Answer {
    pub force: V,
    pub energy: f64,
    pub normal: f64,
}

impl Law {
    /// Returns the force on the point, displaced by `d` (m), at the velocity `v` (m/s) and with the slider's
    /// deflection `z` (m).
    #[inline(always)]
    pub fn force(&self, d: V, v: V, z: [f64; 2]) -> Answer {
        let (mut force, mut energy, mut normal) = ([0.0; 3], 0.0, 0.0);
        match *self {
            Self::Coil {
                preload,
                along,
                across,
                damping,
                travel,
            } => {
                let over = (-d[2] - travel).max(0.0);
                force = [
                    -across * d[0] - damping * v[0],
                    -across * d[1] - damping * v[1],
                    preload - along * d[2] - damping * v[2] + SOLID * over,
                ];
                energy = 0.5
                    * (across * (d[0] * d[0] + d[1] * d[1]) + along * d[2] * d[2] + SOLID * over * over)
                    - preload * d[2];
            }
            Self::Face {
                stiffness,
                damping,
                gap,
                friction,
                slider_stiffness,
                slider_damping,
                ..
            } => {
                let overlap = -d[2] - gap;
                if overlap > 0.0 {
                    normal = (stiffness * overlap - damping * v[2]).max(0.0);
                    let [x, y] = [0, 1].map(|k| -slider_stiffness * z[k] - slider_damping * v[k]);
                    let (size, limit) = ((x * x + y * y).sqrt(), friction * normal);
                    let share = if size > limit { limit / size } else { 1.0 };
                    force = [share * x, share * y, normal];
                    energy = 0.5 * stiffness * overlap * overlap;
                }
            }
            Self::Stop {
                axis,
                clearance,
                stiffness,
                damping,
            } => {
                let over = d[axis].abs() - clearance;
                if over > 0.0 {
                    let side = d[axis].signum();
                    force[axis] = -side * (stiffness * over + damping * side * v[axis]).max(0.0);
                    energy = 0.5 * stiffness * over * over;
                }
            }
            Self::Rim {
                clearance,
                stiffness,
                damping,
            } => {
                let radius = (d[0] * d[0] + d[1] * d[1]).sqrt();
                let over = radius - clearance;
                if over > 0.0 {
                    let [x, y] = [d[0] / radius, d[1] / radius];
                    let size = (stiffness * over + damping * (x * v[0] + y * v[1])).max(0.0);
                    force = [-size * x, -size * y, 0.0];
                    energy = 0.5 * stiffness * over * over;
                }
            }
        }
        Answer {
            force,
            energy,
            normal,
        }
    }
}

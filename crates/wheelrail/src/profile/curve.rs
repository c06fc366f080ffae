//! Plane curves of lines, arcs and cubics, one after the other, by a parameter close to arc length.
//!
//! The parameter is in m. Lines and arcs are parametrized by arc length, cubics of splines by chord length.

/// A point of a curve with its derivatives by the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// y and z, m.
    pub position: [f64; 2],
    /// Derivatives of y and z by the parameter.
    pub tangent: [f64; 2],
    /// Second derivatives of y and z by the parameter, 1/m.
    pub second: [f64; 2],
}

impl CurvePoint {
    /// Returns the direction of the curve, rad from the y axis, -π to π.
    #[must_use]
    pub fn angle(&self) -> f64 {
        libm::atan2(self.tangent[1], self.tangent[0])
    }

    /// Returns the curvature, 1/m: positive where the curve turns from y towards z.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        let ([y, z], [yy, zz]) = (self.tangent, self.second);
        let speed = libm::hypot(y, z);
        (y * zz - z * yy) / (speed * speed * speed)
    }
}

/// The form of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CurveForm {
    /// A line or an arc: start, direction there (rad), signed curvature (1/m).
    Arc {
        start: [f64; 2],
        angle: f64,
        curvature: f64,
    },
    /// y and z as cubics: four coefficients each, from the constant on.
    Cubic([[f64; 4]; 2]),
}

/// A piece of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Parameter at its start, m.
    pub start: f64,
    pub form: CurveForm,
}

impl Piece {
    fn at(&self, parameter: f64) -> CurvePoint {
        let t = parameter - self.start;
        match self.form {
            CurveForm::Arc {
                start: [y, z],
                angle,
                curvature,
            } => {
                // Chord of the arc: length t sin(β)/β at the angle of its middle, with β = κ t / 2.
                let half = 0.5 * curvature * t;
                let chord = match half.abs() < 1e-4 {
                    true => t * (1.0 - half * half / 6.0),
                    false => t * libm::sin(half) / half,
                };
                let (sine, cosine) = libm::sincos(angle + half);
                let (sin, cos) = libm::sincos(angle + 2.0 * half);
                CurvePoint {
                    position: [y + chord * cosine, z + chord * sine],
                    tangent: [cos, sin],
                    second: [-curvature * sin, curvature * cos],
                }
            }
            CurveForm::Cubic(coefficients) => {
                let value = |c: &[f64; 4]| c[0] + t * (c[1] + t * (c[2] + t * c[3]));
                let slope = |c: &[f64; 4]| c[1] + t * (2.0 * c[2] + t * 3.0 * c[3]);
                let second = |c: &[f64; 4]| 2.0 * c[2] + 6.0 * t * c[3];
                let [y, z] = &coefficients;
                CurvePoint {
                    position: [value(y), value(z)],
                    tangent: [slope(y), slope(z)],
                    second: [second(y), second(z)],
                }
            }
        }
    }
}

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileCurve {
    pieces: Vec<Piece>,
    end: f64,
}

impl ProfileCurve {
    /// Returns the curve of pieces (at least one, by rising parameter) up to the parameter `end`.
    pub(super) fn new(pieces: Vec<Piece>, end: f64) -> Self {
        debug_assert!(!pieces.is_empty());
        Self { pieces, end }
    }

    /// Returns the smallest and largest parameter, m.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.pieces[0].start, self.end]
    }

    /// Returns the parameters (m) of the joints of pieces, with the start and without the end.
    pub fn joints(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().map(|piece| piece.start)
    }

    /// Returns the point at a parameter (m); beyond the ends the last pieces go on.
    #[must_use]
    pub fn at(&self, parameter: f64) -> CurvePoint {
        let next = self.pieces.partition_point(|piece| piece.start <= parameter);
        self.pieces[next.saturating_sub(1)].at(parameter)
    }

    /// Returns points at most `spacing` (m) apart by the parameter, both ends among them, and their
    /// parameters.
    #[must_use]
    pub fn sample(&self, spacing: f64) -> Vec<(f64, CurvePoint)> {
        let [start, end] = self.range();
        let count = libm::ceil((end - start) / spacing).max(1.0) as usize;
        (0..=count)
            .map(|i| {
                let parameter = start + (end - start) * (i as f64 / count as f64);
                (parameter, self.at(parameter))
            })
            .collect()
    }

    /// Returns the curve turned about the origin by an angle (rad, from y towards z) and then moved (m).
    #[must_use]
    pub fn moved(&self, turn: f64, shift: [f64; 2]) -> Self {
        let (sine, cosine) = libm::sincos(turn);
        let rotate = |[y, z]: [f64; 2]| [y * cosine - z * sine, y * sine + z * cosine];
        let pieces = self.pieces.iter().map(|piece| {
            let form = match piece.form {
                CurveForm::Arc {
                    start,
                    angle,
                    curvature,
                } => {
                    let [y, z] = rotate(start);
                    CurveForm::Arc {
                        start: [y + shift[0], z + shift[1]],
                        angle: angle + turn,
                        curvature,
                    }
                }
                CurveForm::Cubic([a, b]) => {
                    let mut moved = [[0.0; 4]; 2];
                    for power in 0..4 {
                        [moved[0][power], moved[1][power]] = rotate([a[power], b[power]]);
                    }
                    moved[0][0] += shift[0];
                    moved[1][0] += shift[1];
                    CurveForm::Cubic(moved)
                }
            };
            Piece { form, ..*piece }
        });
        Self::new(pieces.collect(), self.end)
    }
}

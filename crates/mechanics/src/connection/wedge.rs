//! The industry's friction wedge as an element without mass (the comparison program's types 6.3, 6.7, 6.8,
//! 6.9).
//!
//! Body A is the bolster, body B the side frame. A coil pushes a massless wedge up between the pocket's slope
//! (angle θ from the vertical) and the column (inclined by φ, positive where the gap widens downwards: toe
//! out). With x the signed mobilized fraction of friction (positive when the column's friction on the wedge
//! acts up, |x| = 1 when it slips), and α = -μ_s (toe out, no toe) or +μ_s (toe in), balance of the wedge
//! (see [`crate::quasi_static`]) gives
//!
//! ```text
//! N(x) = F_s (cos θ + α x sin θ) / D(x),   D(x) = sin(θ+φ) - x (α + μ_c) cos(θ+φ) - x² α μ_c sin(θ+φ)
//! ```
//!
//! The column's friction is a force accumulator ([`Accumulator`]) in the vertical and the lateral coordinate,
//! with trial force T. It slips where |T| exceeds `μ_c N(-T_z/|T|)`; while it sticks x follows from
//! `F_t = μ_c x N(x)`, a quadratic equation. N is at most [`Wedge::normal_limit`], also where D is not
//! positive: there no steady sliding exists, the wedge jams.
//!
//! Kinematics with a column profile h(z) (depth in m over the vertical extension, positive away from the
//! bolster) and direction d (+1: the column lies ahead, +x of the bolster): gap `e = -d s_x + h(s_z)`,
//! `φ = -atan h'(s_z)`, rise of the wedge in its pocket `r = e / tan θ`; extension of the coil `s_z + r`
//! (coil on the side frame) or `r` (coil in the bolster). Without a profile r = 0. Forces in the direction of
//! the extension: `f_z = -(F_s [coil on the side frame] + F_t cos φ - N sin φ)`,
//! `f_x = d (N cos φ + F_t sin φ)`, f_y lateral friction. Without a profile f_x = 0, and a given inclination
//! enters N only. Units: N, m, s, rad.
//!
//! Energy. Stored: the coil's, the accumulator's. Lost: the accumulator's losses (column); the power of the
//! slope's friction, `-α x N_s r˙ / cos θ`, which may be negative, because its direction is that of the
//! column's friction and not that of its own slip. Taking the profile at the bolster's height instead of the
//! wedge's, the slip velocity without the rise, capping N and stopping the rise leave the wedge's constraint
//! forces with a small power (tan φ / tan θ of the column's: 0.6 % at 0.2°, all but 1e-4 of it by the slip
//! velocity); it is integrated from its own forces and velocities and is a ledger entry of its own.
//!
//! Source: names of the parameters and variables from published input files and their comments; the law
//! itself is derived, choices are listed in [`crate::connection::Options`]. Defects: no mass, no moments, no
//! lift-off ringing. The slope's friction is no slider of its own: if the bolster swings along x, it can feed
//! energy (the slope's entry of the ledger is then negative), above all if the wedge is jammed (toe in with
//! much friction: a half-truck with yaw then chatters at hundreds of hertz) and with
//! [`crate::connection::Options::rise_in_slip`]; [`SlopeDirection::OwnSlip`] is the remedy, with
//! `-μ_s tanh(slip/v0)` in place of `α x`. Where `μ_c x N(x)` is not monotonic (steep angles with high
//! friction) sticking and slipping disagree about N at the limit.

use numerics::scalar::Real;

use super::accumulator::{Accumulator, Friction, FrictionRule, SpatialForce, friction_of};
use super::options::{Branch, NegativeRise, Options, SlopeDirection};
use crate::curve::Curve;
use crate::friction::Friction as Slip;

/// The column that the wedge slides on.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnFace {
    /// A toe that is only a direction (types 6.3, 6.7, 6.8): vertical and lateral forces.
    Plain {
        /// Toe out (or none); else toe in.
        toe_out: bool,
    },
    /// A profile (type 6.9): vertical, longitudinal and lateral forces.
    Profile {
        /// Depth (m, positive away from the bolster) over the vertical extension (m).
        depth: Curve,
        /// +1: the column lies ahead of the wedge (+x), -1: behind.
        direction: f64,
    },
}

/// A massless friction wedge. Body A of its connection is the bolster, body B the side frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Wedge {
    /// Wedge angle θ from the vertical, rad, between 0 and π/2.
    pub angle: f64,
    /// Force of the coil, N by m of its extension, extension positive: negative where it pushes. It never
    /// pulls.
    pub coil: Curve,
    /// Force added to the coil's, N, positive pushing.
    pub preload: f64,
    /// True if the coil stands in the bolster's pocket (constant damping); false if on the side frame
    /// (variable damping).
    pub coil_in_bolster: bool,
    /// The column.
    pub column: ColumnFace,
    /// Coefficient of friction of the slope.
    pub slope_friction: f64,
    /// Coefficient of friction of the column.
    pub column_friction: f64,
    /// The force accumulator of the column's friction.
    pub accumulator: Accumulator,
    /// Greatest normal force of the column, N.
    pub normal_limit: f64,
}

/// A piece of the column with one inclination.
#[derive(Clone, Copy, Debug)]
struct Face {
    cosine: f64,
    sine: f64,
    /// sin(θ+φ), cos(θ+φ).
    sum: [f64; 2],
    /// ±μ_s.
    alpha: f64,
}

/// The law, prepared.
#[derive(Clone, Debug)]
pub(crate) struct WedgeLaw {
    sine: f64,
    cosine: f64,
    /// 1/tan θ.
    cotangent: f64,
    coil: Curve,
    coil_in_bolster: bool,
    /// Profile and direction.
    profile: Option<(Curve, f64)>,
    faces: Vec<Face>,
    friction: f64,
    pub accumulator: Accumulator,
    limit: f64,
    branch: Branch,
    rise_in_slip: bool,
    stops: bool,
    slope_friction: f64,
    /// Reference speed, where the slope follows its own slip.
    own_slip: Option<f64>,
}

/// The contact at the column, and the slope's coefficient (signed: positive up the slope).
struct Contact<S: Real> {
    slip: Slip<S>,
    x: S,
    slope: S,
    normal: S,
    inside: WedgeState,
}

/// The internal forces and deflections of a wedge, N and m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WedgeState {
    /// Force of the coil.
    pub coil_force: f64,
    /// Stroke of the coil.
    pub coil_extension: f64,
    /// Rise of the wedge in its pocket.
    pub rise: f64,
    /// Normal force of the column.
    pub column_normal: f64,
    /// Friction of the column along it, on the wedge, positive up.
    pub column_friction: f64,
    /// Lateral friction, on the bolster.
    pub lateral_friction: f64,
    /// Normal force of the slope.
    pub slope_normal: f64,
    /// Friction of the slope along it, on the wedge, positive up.
    pub slope_friction: f64,
    /// Signed fraction of the mobilized friction, x.
    pub mobilised: f64,
    /// Limit of the friction in its present direction.
    pub friction_limit: f64,
    /// True if only the cap limits the normal force: no steady sliding in the friction's present direction.
    pub jammed: bool,
}

impl WedgeLaw {
    pub fn new(law: &Wedge, options: &Options) -> Self {
        let (sine, cosine) = libm::sincos(law.angle);
        let face = |slope: f64, toe_out: bool| {
            let toe = -libm::atan(slope);
            let (sum_sine, sum_cosine) = libm::sincos(law.angle + toe);
            Face {
                cosine: libm::cos(toe),
                sine: libm::sin(toe),
                sum: [sum_sine, sum_cosine],
                alpha: if toe_out {
                    -law.slope_friction
                } else {
                    law.slope_friction
                },
            }
        };
        let (profile, faces) = match &law.column {
            ColumnFace::Plain { toe_out } => {
                let size = libm::tan(options.plain_toe_angle);
                (None, vec![face(if *toe_out { -size } else { size }, *toe_out)])
            }
            ColumnFace::Profile { depth, direction } => (
                Some((depth.clone(), *direction)),
                depth
                    .slopes()
                    .iter()
                    .map(|slope| face(*slope, *slope <= 0.0))
                    .collect(),
            ),
        };
        Self {
            sine,
            cosine,
            cotangent: cosine / sine,
            coil: law.coil.scaled(-1.0, law.preload).clamped(0.0, f64::INFINITY),
            coil_in_bolster: law.coil_in_bolster,
            profile,
            faces,
            friction: law.column_friction,
            accumulator: law.accumulator.with_damping(options.accumulator_damping),
            limit: law.normal_limit,
            branch: options.branch,
            rise_in_slip: options.rise_in_slip,
            stops: options.negative_rise == NegativeRise::Stop,
            slope_friction: law.slope_friction,
            own_slip: match options.slope {
                SlopeDirection::Toe => None,
                SlopeDirection::OwnSlip { reference_speed } => Some(reference_speed),
            },
        }
    }

    /// Returns whether it has a longitudinal force.
    pub fn is_spatial(&self) -> bool {
        self.profile.is_some()
    }

    /// Returns the column's normal force at the signed fraction `x` with the slope's friction coefficient
    /// `slope` (signed: positive up the slope), and whether it is the cap.
    #[inline(always)]
    fn normal<S: Real>(&self, face: &Face, coil: S, x: S, slope: S) -> (S, bool) {
        let [s, c] = face.sum;
        let column = x * self.friction;
        let divisor = (slope + column) * -c - slope * column * s + s;
        let dividend = coil * (slope * self.sine + self.cosine);
        if divisor.value() <= 0.0 || dividend.value() > self.limit * divisor.value() {
            (S::from(self.limit), true)
        } else {
            (dividend / divisor, false)
        }
    }

    /// Returns the signed fraction that holds the friction `ratio · coil force`; `own` is the slope's
    /// coefficient if it does not follow the column.
    #[inline(always)]
    fn fraction<S: Real>(&self, face: &Face, ratio: S, own: Option<S>) -> S {
        let [s, c] = face.sum;
        let (alpha, friction) = (face.alpha, self.friction);
        let x = if let Some(slope) = own {
            let divisor = (slope * self.sine + self.cosine) + ratio * (slope * s + c);
            ratio * (slope * -c + s) / (divisor * friction)
        } else {
            let linear = ratio * ((alpha + friction) * c) + friction * self.cosine;
            let quadratic = -(ratio * (alpha * friction * s) + friction * alpha * self.sine);
            let root = linear * linear - quadratic * ratio * (4.0 * s);
            let root = if root.value() > 0.0 {
                root.sqrt()
            } else {
                S::zero()
            };
            ratio * (2.0 * s) / (linear + root)
        };
        if x.value().abs() <= 1.0 {
            x
        } else {
            S::from(f64::copysign(1.0, ratio.value()))
        }
    }

    /// Returns the wedge at extensions and rates (vertical, longitudinal, lateral) and deflections (vertical,
    /// lateral).
    #[inline(always)]
    pub fn evaluate<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> SpatialForce<S> {
        self.evaluate_with(extensions, rates, deflection, rule, |_| {})
    }

    /// Returns the same; `report` receives the internal forces and motions.
    #[inline(always)]
    pub fn evaluate_with<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
        report: impl FnOnce(WedgeState),
    ) -> SpatialForce<S> {
        let (mut face, mut rise, mut rise_rate, mut direction) = (&self.faces[0], S::zero(), S::zero(), 0.0);
        // the gap's rate that a wedge stopped in its pocket does not follow
        let mut pressed = S::zero();
        if let Some((depth, ahead)) = &self.profile {
            let piece = depth.piece(extensions[0].value());
            face = &self.faces[piece];
            direction = *ahead;
            rise = (depth.evaluate(extensions[0]) - extensions[1] * direction) * self.cotangent;
            rise_rate = (rates[0] * depth.slopes()[piece] - rates[1] * direction) * self.cotangent;
            if self.stops && rise.value() < 0.0 {
                pressed = rise_rate * (1.0 / self.cotangent);
                (rise, rise_rate) = (S::zero(), S::zero());
            }
        }
        let extension = if self.coil_in_bolster {
            rise
        } else {
            extensions[0] + rise
        };
        let coil = self.coil.evaluate(extension);
        let mut along = rates[0];
        if self.rise_in_slip && direction != 0.0 {
            along = rates[0] * (1.0 / face.cosine) + rise_rate * face.cosine;
        }
        let velocity = [along, rates[2]];
        // up the slope, against the wedge's own slip
        let own = match self.own_slip {
            Some(speed) if direction != 0.0 && rule != FrictionRule::Free => {
                Some((rise_rate * (1.0 / (self.cosine * speed))).tanh() * -self.slope_friction)
            }
            _ => None,
        };
        let Contact {
            slip,
            x,
            slope,
            normal,
            inside,
        } = self.column(face, coil, own, velocity, deflection, rule);
        // friction on the wedge along the column, up
        let up = slip.force[0];
        let (p_cos, p_sin) = (face.cosine, face.sine);
        let carried = if self.coil_in_bolster { S::zero() } else { coil };
        let mut force = [-(carried + up), S::zero(), -slip.force[1]];
        let mut powers = [slip.loss, S::zero(), S::zero()];
        let mut slope_normal = S::zero();
        if self.profile.is_some() {
            let across = normal * p_cos + up * p_sin;
            let along_column = up * p_cos - normal * p_sin;
            force = [-(carried + along_column), across * direction, -slip.force[1]];
            if coil.value() > 0.0 {
                slope_normal = across / (slope * self.sine + self.cosine);
                powers[1] = -(slope * slope_normal * rise_rate * (1.0 / self.cosine));
                let lifted = slope_normal * (slope * -self.cosine + self.sine);
                let unbalanced = coil + along_column - lifted;
                let mismatch = rates[0] * (1.0 / p_cos) + rise_rate * p_cos - along;
                powers[2] = (unbalanced + normal * p_sin) * rise_rate - up * mismatch - across * pressed;
            }
        } else if coil.value() > 0.0 {
            slope_normal = (normal * p_cos + up * p_sin) / (slope * self.sine + self.cosine);
        }
        report(WedgeState {
            coil_force: coil.value(),
            coil_extension: extension.value(),
            rise: rise.value(),
            column_normal: normal.value(),
            column_friction: up.value(),
            lateral_friction: slip.force[1].value(),
            slope_normal: slope_normal.value(),
            slope_friction: (slope * slope_normal).value(),
            mobilised: x.value(),
            ..inside
        });
        SpatialForce {
            force,
            rate: slip.rate,
            powers,
            friction: Friction {
                normal: coil.value(),
                load: slip.load,
                force: [up.value(), slip.force[1].value()],
            },
        }
    }

    /// Returns the column's friction, normal force and fraction; `own` is the slope's coefficient if it does
    /// not follow the column.
    #[inline(always)]
    fn column<S: Real>(
        &self,
        face: &Face,
        coil: S,
        own: Option<S>,
        velocity: [S; 2],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> Contact<S> {
        let zero = S::zero();
        let slope_at = |x: S| own.unwrap_or(x * face.alpha);
        let at = |slip: Slip<S>, x: S, inside: WedgeState| {
            let slope = slope_at(x);
            let normal = self.normal(face, coil, x, slope).0;
            Contact {
                slip,
                x,
                slope,
                normal,
                inside,
            }
        };
        if coil.value() <= 0.0 || rule == FrictionRule::Free {
            let slip = friction_of(&self.accumulator, zero, rule, velocity, deflection);
            return at(slip, zero, WedgeState::default());
        }
        let trial = self.accumulator.trial(velocity, deflection);
        let square = trial[0] * trial[0] + trial[1] * trial[1];
        let size = square.value().sqrt();
        let by_velocity = match self.branch {
            Branch::Velocity { reference_speed } => Some(-(velocity[0] * (1.0 / reference_speed)).tanh()),
            Branch::FrictionForce => None,
        };
        let direction = if size > 0.0 { -trial[0].value() / size } else { 0.0 };
        let x = by_velocity.map_or(direction, S::value);
        let slope = own.map_or(x * face.alpha, S::value);
        let (normal, jammed) = self.normal(face, coil.value(), x, slope);
        let limit = normal * self.friction;
        let inside = WedgeState {
            friction_limit: limit,
            jammed: jammed && size > 0.0,
            ..WedgeState::default()
        };
        if size <= limit || rule == FrictionRule::Stuck {
            let held = rule.limit(S::from(limit), coil.value());
            let slip = friction_of(&self.accumulator, held, rule, velocity, deflection);
            let x = match by_velocity {
                Some(x) => x,
                None if self.friction > 0.0 => self.fraction(face, slip.force[0] / coil, own),
                None => zero,
            };
            return at(slip, x, inside);
        }
        let x = by_velocity.unwrap_or_else(|| -(trial[0] / square.sqrt()));
        let held = self.normal(face, coil, x, slope_at(x)).0 * self.friction;
        let slip = friction_of(&self.accumulator, held, rule, velocity, deflection);
        at(slip, if self.friction > 0.0 { x } else { zero }, inside)
    }

    /// Returns the energy of the coil, J; zero at zero extension of the coil.
    pub fn energy(&self, coil_extension: f64) -> f64 {
        -self.coil.integral(coil_extension)
    }
}

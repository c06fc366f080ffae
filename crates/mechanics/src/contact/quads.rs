//! The points of a face four at a time, and how its resultant changes with the motion of its body.
//!
//! Forces: [`ContactFace::touch`] in lanes. Changes: the law is differentiated by what it sees of a point (gap, gap rate, slip,
//! deflection: 4 or 6 derivatives whatever the number of coordinates), the rest is the chain rule of points on a rigid body. With a
//! small change δp of the body's origin, θ of its rotation, δv and δω of its velocities, all in mount axes,
//!
//! ```text
//! δr = θ × r,   δg = (δp + δr)·n,   δv_P = δv + δω × r + ω × δr,   δM = r × δF + δr × F
//! ```

use integrate::lanes::{LANES, LaneDual, LaneMask, Lanes};
use integrate::scalar::{Dual, Mask, Number};

use super::{ContactFace, ContactPoint, FaceResultant, Grade, PointContact};
use crate::body::Kinematics;
use crate::link::{Relative, Sight};
use crate::surface::Plane;
use crate::vector::{Matrix, Vector};

/// Four points; missing ones are open.
#[derive(Clone, Debug)]
struct Quad {
    position: Vector<Lanes>,
    grade: Grade<Lanes>,
    present: LaneMask,
    count: usize,
}

/// What the law's outputs are: force along the normal and two tangents, losses in friction and in contact damping, rates of the bristle.
const OUTPUTS: usize = 7;
/// What it sees: gap, its rate, slip, deflection.
const INPUTS: usize = 6;

/// The derivatives of the law at four points.
#[derive(Clone, Copy, Debug)]
struct Slopes {
    /// Whether there is anything but zeros.
    active: bool,
    arm: Vector<Lanes>,
    force: Vector<Lanes>,
    by: [[Lanes; OUTPUTS]; INPUTS],
}

/// The points of a face, ready for evaluation, and the derivatives where [`ContactFace::linearize`] was called last.
#[derive(Clone, Debug, Default)]
pub(crate) struct Points {
    quads: Vec<Quad>,
    slopes: Vec<Slopes>,
    spin: [f64; 3],
    resultant: FaceResultant<f64>,
}

impl Default for FaceResultant<f64> {
    fn default() -> Self {
        Self {
            force: Vector::zero(),
            moment: Vector::zero(),
            friction_loss: 0.0,
            damping_loss: 0.0,
        }
    }
}

impl Points {
    /// The points of a face.
    pub fn new(points: &[ContactPoint]) -> Self {
        let quads: Vec<Quad> = points.chunks(LANES).map(Quad::new).collect();
        let none = Lanes::zero();
        let slopes = Slopes {
            active: false,
            arm: Vector::zero(),
            force: Vector::zero(),
            by: [[none; OUTPUTS]; INPUTS],
        };
        Self {
            slopes: vec![slopes; quads.len()],
            quads,
            ..Self::default()
        }
    }
}

impl Quad {
    fn new(points: &[ContactPoint]) -> Self {
        // Missing points are copies of the first one that are never closed.
        let lanes = |value: &dyn Fn(&ContactPoint) -> f64| {
            Lanes::new(std::array::from_fn(|i| {
                value(points.get(i).unwrap_or(&points[0]))
            }))
        };
        Self {
            position: Vector([0, 1, 2].map(|k| lanes(&move |point| point.position.0[k]))),
            grade: Grade {
                stiffness: lanes(&|point| point.stiffness),
                damping: lanes(&|point| point.damping),
                share: lanes(&|point| point.share),
            },
            present: LaneMask::new(std::array::from_fn(|i| i < points.len())),
            count: points.len(),
        }
    }

    /// The deflections of the quad that begins with point `first`: zero where there are none.
    #[inline(always)]
    fn deflection(&self, deflections: &[f64], first: usize) -> [Lanes; 2] {
        let Some(own) = deflections.get(2 * first..2 * (first + self.count)) else {
            return [Lanes::zero(); 2];
        };
        let mut out = [[0.0; LANES]; 2];
        for (i, e) in own.chunks_exact(2).enumerate() {
            (out[0][i], out[1][i]) = (e[0], e[1]);
        }
        out.map(Lanes::new)
    }
}

/// Sums of forces and powers in lanes.
#[derive(Clone, Copy)]
struct Sums {
    force: Vector<Lanes>,
    moment: Vector<Lanes>,
    losses: [Lanes; 2],
}

impl Sums {
    #[inline(always)]
    fn none() -> Self {
        Self {
            force: Vector::zero(),
            moment: Vector::zero(),
            losses: [Lanes::zero(); 2],
        }
    }

    #[inline(always)]
    fn add(&mut self, force: Vector<Lanes>, moment: Vector<Lanes>, losses: [Lanes; 2]) {
        self.force += force;
        self.moment += moment;
        self.losses[0] += losses[0];
        self.losses[1] += losses[1];
    }

    #[inline(always)]
    fn over_lanes(&self) -> FaceResultant<f64> {
        let ([fx, fy, fz], [mx, my, mz]) = (self.force.0, self.moment.0);
        let [fx, fy, fz, mx] = Lanes::sums([fx, fy, fz, mx]);
        let [my, mz, friction_loss, damping_loss] = Lanes::sums([my, mz, self.losses[0], self.losses[1]]);
        FaceResultant {
            force: Vector([fx, fy, fz]),
            moment: Vector([mx, my, mz]),
            friction_loss,
            damping_loss,
        }
    }
}

impl ContactFace<Plane> {
    #[inline(always)]
    fn locate_quad(&self, quad: &Quad, relative: &Relative<f64>) -> (PointContact<Lanes>, LaneMask) {
        let at: PointContact<Lanes> = self.locate(quad.position, relative);
        let closed = at.gap.below(Lanes::zero()).and(quad.present);
        (at, closed)
    }

    /// The resultant of all points; `rates` receives the rates of the internal states.
    #[inline(always)]
    pub(crate) fn resultant(
        &self,
        points: &Points,
        relative: &Relative<f64>,
        deflections: &[f64],
        rates: &mut [f64],
    ) -> FaceResultant<f64> {
        let mut sums = Sums::none();
        for (number, quad) in points.quads.iter().enumerate() {
            let (at, closed) = self.locate_quad(quad, relative);
            if closed.none() && deflections.is_empty() {
                continue;
            }
            let first = LANES * number;
            let touch = self.touch(&quad.grade, closed, &at, quad.deflection(deflections, first));
            let [t1, t2] = touch.friction.force;
            let force = Vector([touch.normal, t1, t2]);
            sums.add(
                force,
                at.arm.cross(force),
                [touch.friction.loss, touch.damping_loss],
            );
            if !deflections.is_empty() {
                let rate = touch.friction.rate.map(Lanes::to_array);
                for i in 0..quad.count {
                    rates[2 * (first + i)] = rate[0][i];
                    rates[2 * (first + i) + 1] = rate[1][i];
                }
            }
        }
        sums.over_lanes()
    }

    /// Gap and friction load of every point.
    #[inline(always)]
    pub(crate) fn signs(
        &self,
        points: &Points,
        relative: &Relative<f64>,
        deflections: &[f64],
        mut each: impl FnMut(usize, f64, f64),
    ) {
        for (number, quad) in points.quads.iter().enumerate() {
            let (at, closed) = self.locate_quad(quad, relative);
            let first = LANES * number;
            let load = self.load(&quad.grade, closed, &at, quad.deflection(deflections, first));
            let (gap, load) = (at.gap.to_array(), load.to_array());
            for i in 0..quad.count {
                each(first + i, gap[i], load[i]);
            }
        }
    }

    /// Gap and slip of every point.
    #[inline(always)]
    pub(crate) fn motions(
        &self,
        points: &Points,
        relative: &Relative<f64>,
        mut each: impl FnMut(usize, f64, [f64; 2]),
    ) {
        for (number, quad) in points.quads.iter().enumerate() {
            let (at, _) = self.locate_quad(quad, relative);
            let (gap, slip) = (at.gap.to_array(), at.slip.map(Lanes::to_array));
            for i in 0..quad.count {
                each(LANES * number + i, gap[i], [slip[0][i], slip[1][i]]);
            }
        }
    }

    /// Differentiates the law at every point; for [`Points::change`].
    pub(crate) fn linearize(&self, points: &mut Points, relative: &Relative<f64>, deflections: &[f64]) {
        points.spin = relative.angular_velocity.0;
        let mut sums = Sums::none();
        for (number, (quad, slopes)) in points.quads.iter().zip(&mut points.slopes).enumerate() {
            let (at, closed) = self.locate_quad(quad, relative);
            slopes.active = !(closed.none() && deflections.is_empty());
            if !slopes.active {
                continue;
            }
            let deflection = quad.deflection(deflections, LANES * number);
            let losses = if deflections.is_empty() {
                self.differentiate::<4>(quad, closed, &at, deflection, slopes)
            } else {
                self.differentiate::<6>(quad, closed, &at, deflection, slopes)
            };
            slopes.arm = at.arm;
            sums.add(slopes.force, at.arm.cross(slopes.force), losses);
        }
        points.resultant = sums.over_lanes();
    }

    /// The law's derivatives by the first `N` of its inputs; the losses.
    #[inline(always)]
    fn differentiate<const N: usize>(
        &self,
        quad: &Quad,
        closed: LaneMask,
        at: &PointContact<Lanes>,
        deflection: [Lanes; 2],
        slopes: &mut Slopes,
    ) -> [Lanes; 2] {
        let lift = LaneDual::<N>::lift;
        let variable = LaneDual::<N>::variable;
        let seeded = PointContact {
            place: Vector::zero(),
            arm: Vector::zero(),
            gap: variable(at.gap, 0),
            gap_rate: variable(at.gap_rate, 1),
            slip: [variable(at.slip[0], 2), variable(at.slip[1], 3)],
            normal: LaneDual::zero(),
            friction: crate::friction::Friction::none(),
            damping_loss: LaneDual::zero(),
        };
        let deflection = if N == INPUTS {
            [variable(deflection[0], 4), variable(deflection[1], 5)]
        } else {
            deflection.map(lift)
        };
        let touch = self.touch(&quad.grade, closed, &seeded, deflection);
        let ([t1, t2], [r1, r2]) = (touch.friction.force, touch.friction.rate);
        let outputs = [
            touch.normal,
            t1,
            t2,
            touch.friction.loss,
            touch.damping_loss,
            r1,
            r2,
        ];
        slopes.force = Vector([touch.normal.value, t1.value, t2.value]);
        for input in 0..N {
            for (output, value) in outputs.iter().enumerate() {
                slopes.by[input][output] = value.derivative[input];
            }
        }
        [touch.friction.loss.value, touch.damping_loss.value]
    }
}

impl Points {
    /// The resultant with its derivatives, from how the body moves; `rates` sees the rates of the internal states, if there are any
    /// (`internal`).
    #[inline(always)]
    pub fn change<const N: usize>(
        &self,
        columns: &[Column; N],
        internal: bool,
        mut rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> FaceResultant<Dual<N>> {
        let value = &self.resultant;
        let mut sum = FaceResultant {
            force: Vector::<Dual<N>>::lift(value.force),
            moment: Vector::lift(value.moment),
            friction_loss: Dual::from(value.friction_loss),
            damping_loss: Dual::from(value.damping_loss),
        };
        let mut changes = [Sums::none(); N];
        for (number, (quad, slopes)) in self.quads.iter().zip(&self.slopes).enumerate() {
            if !slopes.active {
                continue;
            }
            let mut rate = [[[0.0; LANES]; 2]; N];
            for k in 0..N {
                let own = slopes.along(&columns[k], Vector(self.spin), internal, &mut changes[k]);
                rate[k] = own.map(Lanes::to_array);
            }
            if internal {
                for i in 0..quad.count {
                    rates(
                        LANES * number + i,
                        std::array::from_fn(|k| rate[k].map(|lanes| lanes[i])),
                    );
                }
            }
        }
        for k in 0..N {
            let change = changes[k].over_lanes();
            for c in 0..3 {
                sum.force.0[c].derivative[k] = change.force.0[c];
                sum.moment.0[c].derivative[k] = change.moment.0[c];
            }
            sum.friction_loss.derivative[k] = change.friction_loss;
            sum.damping_loss.derivative[k] = change.damping_loss;
        }
        sum
    }

    /// For every point with internal states: how their rates (row-major), the forces at the point (mount axes, with its arm) and the
    /// friction loss change with them.
    pub fn internal_slopes(&self, mut each: impl FnMut(usize, &InternalSlopes)) {
        for (number, (quad, slopes)) in self.quads.iter().zip(&self.slopes).enumerate() {
            let by = [slopes.by[4], slopes.by[5]].map(|row| row.map(Lanes::to_array));
            let arm = slopes.arm.0.map(Lanes::to_array);
            for i in 0..quad.count {
                each(
                    LANES * number + i,
                    &InternalSlopes {
                        rate: [by[0][5][i], by[1][5][i], by[0][6][i], by[1][6][i]],
                        force: [0, 1].map(|e| Vector([0, 1, 2].map(|c| by[e][c][i]))),
                        arm: Vector(arm.map(|lanes| lanes[i])),
                        loss: [by[0][3][i], by[1][3][i]],
                    },
                );
            }
        }
    }
}

/// The derivatives of a point's law by its two internal states.
pub(crate) struct InternalSlopes {
    /// Of their rates, row-major.
    pub rate: [f64; 4],
    /// Of the force, by each of them.
    pub force: [Vector<f64>; 2],
    /// From the body's origin to the point.
    pub arm: Vector<f64>,
    /// Of the friction loss.
    pub loss: [f64; 2],
}

/// A small change of a body's motion, mount axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column {
    /// Of position (δp) and rotation (θ); none: only the velocities change.
    pose: Option<(Vector<f64>, Vector<f64>)>,
    velocity: Vector<f64>,
    spin: Vector<f64>,
}

impl Column {
    /// No change.
    const NONE: Self = Self {
        pose: None,
        velocity: Vector([0.0; 3]),
        spin: Vector([0.0; 3]),
    };

    /// All changes of a relative motion.
    #[inline(always)]
    pub fn all<const N: usize>(relative: &Relative<Dual<N>>) -> [Self; N] {
        let mut columns = [Self::NONE; N];
        for (k, column) in columns.iter_mut().enumerate() {
            *column = Self::new(relative, k);
        }
        columns
    }

    /// Those of a body seen from a mount by its free coordinates and their rates: what [`Column::all`] gives for the same, from the
    /// axes of the coordinates.
    #[inline(always)]
    pub fn of_body<const N: usize>(
        sight: &Sight<f64>,
        seeded: &Kinematics<Dual<N>>,
        free: &[usize],
    ) -> [Self; N] {
        let mut columns = [Self::NONE; N];
        let n = free.len();
        let none = Vector::zero();
        for (j, &k) in free.iter().enumerate() {
            if k < 3 {
                let place = sight.rotation.column(k);
                columns[j].pose = Some((place, none));
                columns[j].velocity = sight.angular_velocity.cross(place);
                columns[n + j].velocity = place;
            } else {
                let turn = sight.rotation.apply(seeded.turn.axes[k - 3].value());
                let spin = Vector(seeded.angular_velocity.0.map(|component| component.derivative[j]));
                columns[j].pose = Some((none, turn));
                columns[j].spin = sight.rotation.apply(spin);
                columns[n + j].spin = turn;
            }
        }
        columns
    }

    #[inline(always)]
    fn new<const N: usize>(relative: &Relative<Dual<N>>, k: usize) -> Self {
        let part =
            |v: &Vector<Dual<N>>| Vector([v.0[0].derivative[k], v.0[1].derivative[k], v.0[2].derivative[k]]);
        let Matrix(r) = &relative.rotation;
        // δR Rᵀ is the skew matrix of θ.
        let entry = |i: usize, j: usize| {
            r[i][0].derivative[k] * r[j][0].value
                + r[i][1].derivative[k] * r[j][1].value
                + r[i][2].derivative[k] * r[j][2].value
        };
        let (place, turn) = (
            part(&relative.position),
            Vector([entry(2, 1), entry(0, 2), entry(1, 0)]),
        );
        Self {
            pose: (place != Vector::zero() || turn != Vector::zero()).then_some((place, turn)),
            velocity: part(&relative.velocity),
            spin: part(&relative.angular_velocity),
        }
    }
}

impl Slopes {
    /// Adds the change of the resultant along a change of the motion; the rates of the internal states.
    #[inline(always)]
    fn along(&self, column: &Column, spin: Vector<f64>, internal: bool, sums: &mut Sums) -> [Lanes; 2] {
        let by = &self.by;
        let swing: Vector<Lanes> = column.spin.cross(self.arm);
        let mut velocity: Vector<Lanes> = column.velocity + swing;
        let mut moment = Vector::zero();
        let mut out = [Lanes::zero(); OUTPUTS];
        let outputs = if internal { OUTPUTS } else { OUTPUTS - 2 };
        if let Some((place, turn)) = column.pose {
            let arm: Vector<Lanes> = turn.cross(self.arm);
            let carried: Vector<Lanes> = spin.cross(arm);
            velocity += carried;
            moment = arm.cross(self.force);
            let gap = arm.0[0] + place.0[0];
            for (out, by) in out[..outputs].iter_mut().zip(&by[0]) {
                *out = *by * gap;
            }
        }
        let [normal, slip1, slip2] = velocity.0;
        for o in 0..outputs {
            out[o] += by[1][o] * normal;
            // Neither the normal force nor the loss in contact damping depend on slip.
            if o != 0 && o != 4 {
                out[o] += by[2][o] * slip1 + by[3][o] * slip2;
            }
        }
        let force = Vector([out[0], out[1], out[2]]);
        moment += self.arm.cross(force);
        sums.add(force, moment, [out[3], out[4]]);
        [out[5], out[6]]
    }
}

//! The explicit dependence of the rates on time, through the motions of prescribed bodies and reference
//! frames.

use numerics::scalar::Dual;

use super::forces::Mountable;
use super::jacobian::rates_along;
use super::{FrameState, Mounted, System};
use crate::body::Kinematics;
use crate::element::tangent::{Change, combined, force_of, moment_of, sum};
use crate::element::{Marked, Wrench};
use crate::frame::FrameMotion;
use crate::link::{RelativeFrame, RelativeMotion};
use crate::vector::{Matrix, Vector};

impl System {
    /// The partial derivative of all rates by time.
    pub(super) fn differentiate_time(&mut self, time: f64, x: &[f64], df_dt: &mut [f64]) {
        let layout = self.layout;
        let [_, d_speeds, d_internal, d_quadratures] = layout.split_mut(df_dt);
        for (body, load) in self.load_rate.iter_mut().enumerate() {
            *load = (Vector::zero(), [0.0; 3]);
            let Some(number) = self.free_number[body] else {
                continue;
            };
            if self.frames[body].fixed || self.free[number].body != body {
                continue;
            }
            // The inertia forces change with a moving reference frame: this needs its jerk.
            let clock = Dual::<1>::variable(time, 0);
            let frame = self.bodies[body].frame.evaluate(clock, self.reference);
            let free = &self.free[number];
            let mut coordinates = self.bodies[body].initial;
            let mut speeds = [0.0; 6];
            for (j, &k) in free.free.iter().enumerate() {
                coordinates[k] = x[free.offset + j];
                speeds[k] = x[layout.speeds + free.offset + j];
            }
            let kinematics = Kinematics::<Dual<1>>::new(
                coordinates.map(Dual::from),
                speeds.map(Dual::from),
                free.rigid.rolls,
            );
            let accelerations = &self.accelerations[body];
            let (force, moment) = kinematics.inertia(&free.rigid, &frame, true, self.gravity, accelerations);
            *load = (
                -rate_of(&force),
                self.kinematics[body].about_axes(&-rate_of(&moment)),
            );
        }
        let bodies = (&self.frames[..], &self.kinematics[..]);
        for face in self
            .faces
            .iter()
            .filter(|face| face.moves && face.points.are_active())
        {
            let rates = &mut d_internal[face.first_internal..][..face.internal_count];
            let load_rate = &mut self.load_rate;
            element_in_time(face, bodies, rates, load_rate, d_quadratures);
        }
        for coil in self.coils.iter().filter(|coil| coil.moves) {
            element_in_time(coil, bodies, &mut [], &mut self.load_rate, d_quadratures);
        }
        for element in self.elements.iter().filter(|element| element.moves) {
            let rates = &mut d_internal[element.first_internal..][..element.internal_count];
            let load_rate = &mut self.load_rate;
            element_in_time(element, bodies, rates, load_rate, d_quadratures);
        }
        for (number, _) in &self.factors {
            let element = &self.elements[*number];
            let states = element.states(layout.split(x)[2]);
            factor_in_time(
                element,
                (&self.kinematics, states),
                &mut self.load_rate,
                d_quadratures,
            );
        }
        for free in &self.free {
            let (mut force, mut moments) = self.load_rate[free.body];
            if let Some(carrier) = free.carrier {
                let (own, [_, pitch, yaw]) = self.load_rate[carrier];
                force += own;
                (moments[1], moments[2]) = (moments[1] + pitch, moments[2] + yaw);
            }
            for k in 0..3 {
                force.0[k] += self.loads[free.body][k];
                moments[k] += self.loads[free.body][3 + k];
            }
            let target = &mut d_speeds[free.offset..free.offset + free.free.len()];
            if let Some(linear) = &free.linear {
                for (j, target) in target.iter_mut().enumerate() {
                    let k = free.free[j];
                    *target = if k < 3 { force.0[k] } else { moments[k - 3] } / linear.inertia[j];
                }
                continue;
            }
            let accelerations = self.kinematics[free.body].accelerations(&free.rigid, &force, moments);
            for (target, &k) in target.iter_mut().zip(&free.free) {
                *target = accelerations[k];
            }
        }
    }
}

/// Adds the derivatives by time of one element's wrenches and powers.
#[inline(always)]
fn element_in_time<E: Mountable>(
    mounted: &Mounted<E>,
    (frames, kinematics): (&[FrameState], &[Kinematics<f64>]),
    d_internal: &mut [f64],
    load_rate: &mut [(Vector<f64>, [f64; 3])],
    d_quadratures: &mut [f64],
) {
    if let Some(translation) = &mounted.translation {
        let acceleration = translation.acceleration(frames[mounted.on].jets());
        let loads = (&kinematics[mounted.body], &mut load_rate[mounted.body]);
        return translating_in_time(mounted, acceleration, d_internal, loads, d_quadratures);
    }
    let on = lift_kinematics(&kinematics[mounted.on]);
    let (a, b) = (
        moving(&frames[mounted.body].motion),
        moving(&frames[mounted.on].motion),
    );
    let relative_frame = RelativeFrame::new(&a, &b, &on, &mounted.marker);
    let body: RelativeMotion<Dual<1>> = relative_frame.relative(&kinematics[mounted.body]);
    let relative = body.at(mounted.element.marker());
    let change = Change::of(&relative);
    rates_along(&mounted.rate_tangents, &change, d_internal);
    let tangent = &mounted.tangent;
    let column = tangent.by.along(&change);
    let wrench = Wrench::with_change(tangent, &column);
    // about the body's origin
    let arm: Vector<Dual<1>> = body.rotation.apply(mounted.element.marker());
    let wrench = Wrench {
        moment: wrench.moment + arm.cross::<Dual<1>, Dual<1>>(wrench.force),
        ..wrench
    };
    let mut add = |number: usize, (force, moment): (Vector<Dual<1>>, Vector<Dual<1>>)| {
        let (sum, moments) = &mut load_rate[number];
        *sum += rate_of(&force);
        let about = kinematics[number].about_axes(&rate_of(&moment));
        for (sum, moment) in moments.iter_mut().zip(about) {
            *sum += moment;
        }
    };
    add(
        mounted.body,
        wrench.on_body(&relative_frame, &kinematics[mounted.body]),
    );
    if mounted.on_free {
        add(mounted.on, wrench.reaction(&body, &on, &mounted.marker));
    }
    for (energy_term, power) in mounted.energy_terms.iter().zip(wrench.powers) {
        if let Some(energy_term) = energy_term {
            d_quadratures[*energy_term] += power.derivative[0];
        }
    }
    if mounted.prescribed {
        d_quadratures[0] += wrench.prescribed_power(&body, &relative_frame).derivative[0];
    }
}

/// Adds the derivatives by time of an element's wrench and powers through its factor.
fn factor_in_time(
    mounted: &Mounted<Marked>,
    (kinematics, states): (&[Kinematics<f64>], [f64; 2]),
    load_rate: &mut [(Vector<f64>, [f64; 3])],
    d_quadratures: &mut [f64],
) {
    let [_, rate] = mounted.element.factor;
    if rate == 0.0 {
        return;
    }
    let (frame, body) = (&mounted.relative_frame, &kinematics[mounted.body]);
    let relative: RelativeMotion<f64> = frame.relative(body);
    let (wrench, _) = mounted.element.times(rate, &relative, states);
    let mut add = |number: usize, (force, moment): (Vector<f64>, Vector<f64>)| {
        let (sum, moments) = &mut load_rate[number];
        *sum += force;
        let about = kinematics[number].about_axes(&moment);
        for (sum, moment) in moments.iter_mut().zip(about) {
            *sum += moment;
        }
    };
    add(mounted.body, wrench.on_body(frame, body));
    if mounted.on_free {
        let on = &kinematics[mounted.on];
        add(mounted.on, wrench.reaction(&relative, on, &mounted.marker));
    }
    for (energy_term, power) in mounted.energy_terms.iter().zip(wrench.powers) {
        if let Some(energy_term) = energy_term {
            d_quadratures[*energy_term] += power;
        }
    }
    if mounted.prescribed {
        d_quadratures[0] += wrench.prescribed_power(&relative, frame);
    }
}

/// The same if marker B translates; `acceleration` is that of the body's frame relative to it.
/// Without this runs take 0 to 7 % more instructions.
#[inline(always)]
fn translating_in_time<E: Mountable>(
    mounted: &Mounted<E>,
    acceleration: Vector<f64>,
    d_internal: &mut [f64],
    (body, (load, moments)): (&Kinematics<f64>, &mut (Vector<f64>, [f64; 3])),
    d_quadratures: &mut [f64],
) {
    let (relative_frame, tangent) = (&mounted.relative_frame, &mounted.tangent);
    let change = Change {
        position: relative_frame.velocity,
        velocity: acceleration,
        ..Change::NONE
    };
    rates_along(&mounted.rate_tangents, &change, d_internal);
    let column = sum(
        combined(&tangent.by.position, change.position),
        combined(&tangent.by.velocity, change.velocity),
    );
    let (force, moment) = (force_of(&column), moment_of(&column));
    let to_frame = |v: Vector<f64>| -> Vector<f64> { relative_frame.rotation.apply_transposed(v) };
    *load += to_frame(force);
    let own: Vector<f64> = body.orientation.rotation.apply_transposed(to_frame(moment));
    let force_on_body: Vector<f64> = body.orientation.rotation.apply_transposed(to_frame(force));
    let about = own + mounted.element.marker().cross::<f64, f64>(force_on_body);
    for (sum, moment) in moments.iter_mut().zip(body.about_axes(&about)) {
        *sum += moment;
    }
    for (energy_term, part) in mounted.energy_terms.iter().zip(&column) {
        if let Some(energy_term) = energy_term {
            d_quadratures[*energy_term] += part.at(3);
        }
    }
    if mounted.prescribed {
        let work: f64 = relative_frame.marker_velocity.dot(force);
        d_quadratures[0] += work - acceleration.dot::<f64, f64>(tangent.force);
    }
}

/// Returns the derivatives of a vector that carries one.
#[inline(always)]
fn rate_of(v: &Vector<Dual<1>>) -> Vector<f64> {
    Vector(v.0.map(|component| component.derivative[0]))
}

/// Returns a frame's pose and velocity with their derivatives by time; accelerations have none here.
fn moving(motion: &FrameMotion<f64>) -> FrameMotion<Dual<1>> {
    let with = |value: Vector<f64>, rate: Vector<f64>| {
        Vector(std::array::from_fn(|k| Dual {
            value: value.0[k],
            derivative: [rate.0[k]],
        }))
    };
    let spin = |j: usize| -> Vector<f64> { motion.angular_velocity.cross(motion.rotation.column(j)) };
    let columns = [0, 1, 2].map(|j| with(motion.rotation.column(j), spin(j)).0);
    FrameMotion {
        position: with(motion.position, motion.velocity),
        rotation: Matrix(columns).transpose(),
        velocity: with(motion.velocity, motion.acceleration),
        angular_velocity: with(motion.angular_velocity, motion.angular_acceleration),
        acceleration: Vector::lift(motion.acceleration),
        angular_acceleration: Vector::lift(motion.angular_acceleration),
    }
}

fn lift_kinematics(kinematics: &Kinematics<f64>) -> Kinematics<Dual<1>> {
    Kinematics {
        position: Vector::lift(kinematics.position),
        velocity: Vector::lift(kinematics.velocity),
        orientation: crate::orientation::Orientation {
            rotation: Matrix::lift(kinematics.orientation.rotation),
            axes: kinematics.orientation.axes.map(Vector::lift),
        },
        rates: kinematics.rates.map(Dual::from),
        spin: Vector::lift(kinematics.spin),
    }
}

//! Wheelsets whose wheels are not round.

use std::sync::Arc;

use rolling::rig::{Rig, RigStart, Setup, Wheels};
use rolling::track::RailSupport;
use rolling::wheel::Search;
use wheelrail::contact::{
    ContactLaw, ContactTable, Flat, Harmonic, OutOfRound, Side, SlicedWheel, WheelForm,
};
use wheelrail::profile::{SlicedProfile, nominal};
use wheelrail::track::Segment;

use super::impact::{self, LOAD, TRACK, UNSPRUNG};
use super::{POLACH, freight, on_rails, track};

/// Nominal radii of the wheels of [`wheelset`] and of those that meet a joint, m.
pub const RADIUS: f64 = 0.4572;
pub const ON_CONES: f64 = 0.46;
/// Distance at which runs begin, m.
const START: f64 = 5.0;

pub fn out_of_round(radius: f64, flats: Vec<Flat>, harmonics: Vec<Harmonic>) -> WheelForm {
    WheelForm::OutOfRound(Arc::new(OutOfRound::new(radius, flats, harmonics).unwrap()))
}

/// The nominal wheel beside its axle by this much (m), by 36 sections around it.
pub fn eccentric_by_slices(radius: f64, aside: f64) -> WheelForm {
    let wheel = nominal::aar_1b().unwrap();
    let slices = (0..36).map(|k| {
        let angle = std::f64::consts::TAU * f64::from(k) / 36.0;
        (angle, Arc::new(wheel.moved([0.0, -aside * libm::cos(angle)])))
    });
    let list = SlicedProfile::of_wheels("wheel", slices.collect()).unwrap();
    WheelForm::Sliced(Arc::new(SlicedWheel::new(&list, radius).unwrap()))
}

/// Gives the wheels of a setup forms.
pub fn put(setup: &mut Setup, forms: [Option<WheelForm>; 2]) {
    let Wheels::OnRails { search, .. } = &mut setup.wheels else {
        return;
    };
    for (search, form) in search.iter_mut().zip(forms) {
        let Some(form) = form else { continue };
        *search = match &*search {
            Search::Exact(pair) => Search::Exact(Arc::new(pair.under(form))),
            Search::Table(table) => Search::Table(Arc::new(
                ContactTable::new(table.pair().under(form), 1e-4).unwrap(),
            )),
        };
    }
}

/// Nominal wheels under a carriage with a contact damping (s/m) at a speed (m/s).
pub fn wheelset(
    forms: [Option<WheelForm>; 2],
    damping: f64,
    speed: f64,
    support: Option<RailSupport>,
) -> Setup {
    let law = ContactLaw { damping, ..POLACH };
    let mut setup = on_rails(
        &freight(),
        track(&[Segment::Tangent(200.0)], Vec::new()),
        law,
        speed,
    );
    setup.support = support;
    put(&mut setup, forms);
    setup
}

/// Returns P1 (N above the static load) of a wheelset without damping of the contacts and with a fresh flat
/// (m) on both wheels, as [`impact::setup`], at a speed (m/s): by the elements, by two masses, and by the
/// closed form of a joint for the velocity at which the wheel meets its rail.
pub fn first_peaks(length: f64, speed: f64) -> [f64; 3] {
    let within = 2e-3;
    let angle = (0.5 * length + 0.03) / ON_CONES;
    let flat = Flat {
        length,
        depth: None,
        angle,
    };
    let mut setup = impact::setup(Vec::new(), speed, 0.0);
    let form = out_of_round(ON_CONES, vec![flat], Vec::new());
    put(&mut setup, [Some(form.clone()), Some(form)]);
    let start = RigStart {
        distance: START,
        ..RigStart::default()
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let mut stiffness = 0.0;
    let seen = rig.system.observe(0.0, &rig.start);
    rig.patches(&seen, |side, patch| {
        if side == Side::Left {
            stiffness = patch.patch.ellipse.stiffness;
        }
    });
    let middle = angle * ON_CONES / speed;
    let found = impact::loads(&rig, &rig.start, middle + within);
    let masses = two_masses_over_a_flat(stiffness, [length, speed, 0.0, within]);
    let hertz = 1.5 * stiffness * (LOAD / stiffness).powf(1.0 / 3.0);
    let [closed, _] = impact::closed_forms(meeting_velocity(length, speed), hertz);
    let largest = |loads: &[[f64; 2]]| impact::largest(loads, f64::NEG_INFINITY, f64::INFINITY);
    [largest(&found), largest(&masses), closed]
}

/// Speed (m/s) above which a wheel does not follow its flat: rail and wheel, both under the static load, come
/// together with `a = P0 (1/m_u + 1/m_t)`, and an end of the chord lets the axle down with V²/R.
pub fn separation_speed() -> f64 {
    (LOAD * (1.0 / UNSPRUNG + 1.0 / TRACK[0]) * ON_CONES).sqrt()
}

/// Velocity (m/s) at which a wheel meets its rail at the end of a fresh flat (m): that of the chord, `V l /
/// R`; faster than the critical speed V_c the wheel flies for `l / (V + V_c)` and comes down with `V_c l /
/// R` at any speed.
pub fn meeting_velocity(length: f64, speed: f64) -> f64 {
    speed.min(separation_speed()) * length / ON_CONES
}

/// Loads (s from the middle of a fresh flat, N) of two masses, the wheel on Hertz's spring `k d^1.5`, whose
/// axle rides over a chord: by the classical Runge-Kutta method.
pub fn two_masses_over_a_flat(stiffness: f64, [length, speed, damping, end]: [f64; 4]) -> Vec<[f64; 2]> {
    let [mass, spring, damper] = TRACK;
    let rest = [(LOAD / stiffness).powf(2.0 / 3.0), LOAD / spring];
    let half = libm::asin(0.5 * length / ON_CONES);
    // Height of the axle over a level rail less the radius, and its rate.
    let height = |time: f64| {
        let angle = time * speed / ON_CONES;
        let left = half - angle.abs();
        match left > 0.0 {
            false => [0.0, 0.0],
            true => {
                let (sine, cosine) = libm::sincos(left);
                [-ON_CONES * (1.0 - cosine), sine.copysign(angle * sine) * speed]
            }
        }
    };
    let force = |time: f64, x: &[f64; 4]| {
        let [height, rate] = height(time);
        let elastic = stiffness * (rest[0] + x[0] - x[1] + height).max(0.0).powf(1.5);
        (elastic * (1.0 + 1.5 * damping * (x[2] - x[3] + rate))).max(0.0)
    };
    let rates = |time: f64, x: &[f64; 4]| {
        let load = force(time, x);
        [
            x[2],
            x[3],
            (LOAD - load) / UNSPRUNG,
            (load - LOAD - spring * x[1] - damper * x[3]) / mass,
        ]
    };
    let step = 1e-6;
    let begin = -0.6 * length / speed;
    let mut x = [0.0; 4];
    let mut found = Vec::new();
    for k in 0..((end - begin) / step) as usize {
        let time = begin + step * k as f64;
        let add = |x: &[f64; 4], d: &[f64; 4], h: f64| [0, 1, 2, 3].map(|i| x[i] + h * d[i]);
        let a = rates(time, &x);
        let b = rates(time + 0.5 * step, &add(&x, &a, 0.5 * step));
        let c = rates(time + 0.5 * step, &add(&x, &b, 0.5 * step));
        let d = rates(time + step, &add(&x, &c, step));
        x = [0, 1, 2, 3].map(|i| x[i] + step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        found.push([time + step, force(time + step, &x)]);
    }
    found
}

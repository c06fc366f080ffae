//! Contact states of every point: open, stick, slip; when they change.
//!
//! Contact states are recorded. They do not change the forces. Thresholds with hysteresis keep rounding from
//! counting as events:
//! - a point closes where its gap falls to [`CLOSING_GAP`], and opens where it grows to [`OPENING_GAP`], at
//!   which its normal force ends: a point without normal force is open;
//! - it starts to slip where the load of its friction law rises to [`SLIP_LOAD`], and sticks again where it
//!   falls to [`STICK_LOAD`]. The load is |v|/v0 with tanh and |T|/(μN) with the bristle.

use std::ops::Range;

use integrate::{DiscontinuityFunctions, EventGroup};
use numerics::lanes::{LANES, LaneMask, Lanes};
use numerics::scalar::{Blend, Number};

use super::System;
use crate::contact::{CurvedMotion, PlaneMotion};
use crate::contact_state::{ContactState, SLIP_LOAD, STICK_LOAD};
use crate::friction::FrictionLaw;
use crate::link::RelativeMotion;

/// A point closes at this gap, m: where it is pressed in by 1e-11 in. Gaps are rounded to some 1e-14 in; and
/// contacts a million times as stiff as usual are pressed in by more.
pub const CLOSING_GAP: f64 = -2.54e-13;
/// A point opens at this gap, m.
pub const OPENING_GAP: f64 = 0.0;
/// The width of the band of hysteresis between them, m.
const BAND: f64 = OPENING_GAP - CLOSING_GAP;
/// Gap and friction load of a point.
#[derive(Clone, Copy, Debug)]
struct PointVariables {
    gap: f64,
    load: f64,
    law: usize,
}

impl PointVariables {
    /// Returns the contact state after the event function has become zero.
    fn next(self, contact_state: ContactState) -> ContactState {
        match contact_state {
            ContactState::Open => self.closed(),
            _ if self.gap >= OPENING_GAP => ContactState::Open,
            ContactState::Stick if self.load >= SLIP_LOAD[self.law] => ContactState::Slip,
            ContactState::Slip if self.load <= STICK_LOAD[self.law] => ContactState::Stick,
            same => same,
        }
    }

    fn closed(self) -> ContactState {
        if self.load < SLIP_LOAD[self.law] {
            ContactState::Stick
        } else {
            ContactState::Slip
        }
    }
}

/// Returns a law's index in [`SLIP_LOAD`] and [`STICK_LOAD`].
#[inline(always)]
fn threshold(law: &FrictionLaw) -> usize {
    usize::from(matches!(law, FrictionLaw::Bristle { .. }))
}

/// Up to four numbers, the rest zeros.
#[inline(always)]
fn take(numbers: &[f64]) -> Lanes {
    Lanes::new(std::array::from_fn(|i| numbers.get(i).copied().unwrap_or(0.0)))
}

/// Writes up to four numbers.
#[inline(always)]
fn put(target: &mut [f64], numbers: Lanes) {
    target.copy_from_slice(&numbers.to_array()[..target.len()]);
}

/// Returns the event functions of up to four points: positive while the contact state lasts. See
/// [`PointVariables::next`].
#[inline(always)]
fn margins_of(contact_states: &[u8], gap: Lanes, load: Lanes, law: usize) -> Lanes {
    let stays_open = gap - CLOSING_GAP;
    let which = |contact_state: ContactState| {
        LaneMask::new(std::array::from_fn(|i| {
            contact_states.get(i) == Some(&(contact_state as u8))
        }))
    };
    let stays_closed = (OPENING_GAP - gap) / BAND;
    let (stays_stuck, keeps_slipping) = (SLIP_LOAD[law] - load, load - STICK_LOAD[law]);
    let friction = Lanes::blend(which(ContactState::Stick), stays_stuck, keeps_slipping);
    // Without a force the load has no meaning; nor has NaN.
    let bears = gap.below(OPENING_GAP.into()).and(friction.below(stays_closed));
    let stays = Lanes::blend(bears, friction, stays_closed);
    Lanes::blend(which(ContactState::Open), stays_open, stays)
}

impl System {
    /// Updates the contact kinematics of all points at the state of the last [`System::update_kinematics`].
    /// The functions below need it.
    #[inline(always)]
    pub(super) fn update_points(&mut self) {
        // Computed anew, runs would take 0 to 5 % more instructions.
        if self.points_updated {
            return;
        }
        self.points_updated = true;
        for number in 0..self.faces.len() {
            self.update_face_points(number);
        }
    }

    /// The same for one face.
    #[inline(always)]
    fn update_face_points(&mut self, number: usize) {
        let face = &mut self.faces[number];
        let kinematics = &self.kinematics[face.body];
        if face.points.is_curved() {
            let (shape, relative) = (
                &face.element.surface.shape,
                face.relative_frame.relative(kinematics),
            );
            face.points.update(&CurvedMotion {
                shape,
                relative: &relative,
            });
            return;
        }
        if face.plain && face.points.update_if_open(&face.relative_frame, kinematics) {
            return;
        }
        let plane = if face.plain {
            PlaneMotion::of(&face.relative_frame, kinematics, face.element.surface.first_arm)
        } else {
            PlaneMotion::new(
                &face.relative_frame.relative(kinematics),
                face.element.surface.first_arm,
            )
        };
        face.points.update(&plane);
    }

    /// Calls `each` with the numbers (among all points) of up to four points of a face, their gaps and loads,
    /// and the law's index in [`SLIP_LOAD`]. The contact kinematics must be up to date.
    #[inline(always)]
    fn face_blocks(&self, number: usize, x: &[f64], mut each: impl FnMut(Range<usize>, Lanes, Lanes, usize)) {
        let [_, _, internal, _] = self.layout.split(x);
        let face = &self.faces[number];
        let deflections = &internal[face.first_internal..][..face.internal_count];
        let law = threshold(&face.element.law);
        let first = self.first_points[number];
        face.element
            .event_variables(&face.points, deflections, |own, gap, load| {
                each(first + own.start..first + own.end, gap, load, law);
            });
    }

    /// Writes gaps and loads of the points of a face, whose contact kinematics must be up to date.
    #[inline(always)]
    fn write_face_event_variables(&self, number: usize, x: &[f64], variables: &mut [f64]) {
        let first = self.first_points[number];
        let (gaps, loads) = variables.split_at_mut(variables.len() / 2);
        self.face_blocks(number, x, |points, gap, load, _| {
            let own = points.start - first..points.end - first;
            put(&mut gaps[own.clone()], gap);
            put(&mut loads[own], load);
        });
    }

    /// Returns the points of a face among all points.
    pub(super) fn points_of(&self, face: usize) -> Range<usize> {
        let first = self.first_points[face];
        first..first + self.faces[face].element.points.len()
    }

    /// Writes the functions that predict discontinuities: the gap of every point (m), and the slip of closed
    /// points over the reference speed of their law (NaN for open points and bristles).
    pub(super) fn discontinuity_functions(
        &mut self,
        time: f64,
        x: &[f64],
        functions: &mut DiscontinuityFunctions,
    ) {
        self.update_kinematics(time, x);
        self.update_points();
        for (number, face) in self.faces.iter().enumerate() {
            let own = self.points_of(number);
            let scale = match face.element.law {
                FrictionLaw::Tanh { reference_speed } => 1.0 / reference_speed,
                FrictionLaw::Bristle { .. } => f64::NAN,
            };
            face.points.motions(|i, gap, slip| {
                functions.values[own.start + i] = gap;
                let closed = if gap < 0.0 { scale } else { f64::NAN };
                let slip = face.element.surface.seen(slip);
                functions.slips[own.start + i] = slip.map(|part| part * closed);
            });
        }
    }

    pub(super) fn find_contact_states(&mut self, x: &[f64], contact_states: &mut [u8]) {
        self.update_points();
        for number in 0..self.faces.len() {
            self.face_blocks(number, x, |points, gap, load, law| {
                for (i, contact_state) in contact_states[points].iter_mut().enumerate() {
                    let (gap, load) = (gap.at(i), load.at(i));
                    *contact_state = if gap < CLOSING_GAP {
                        PointVariables { gap, load, law }.closed()
                    } else {
                        ContactState::Open
                    } as u8;
                }
            });
        }
    }

    /// Writes the event variables of all points: gaps of the points of the first face, their loads, and so
    /// on.
    pub(super) fn point_event_variables(&mut self, x: &[f64], variables: &mut [f64]) {
        self.update_points();
        for number in 0..self.faces.len() {
            self.write_face_event_variables(number, x, &mut variables[self.event_variable_range(number)]);
        }
    }

    /// Returns the range of a face's event variables among all.
    fn event_variable_range(&self, face: usize) -> Range<usize> {
        let points = self.points_of(face);
        2 * points.start..2 * points.end
    }

    /// Writes the event variables of one face, which depend only on the bodies at its ends.
    pub(super) fn face_event_variables(
        &mut self,
        number: usize,
        time: f64,
        x: &[f64],
        variables: &mut [f64],
    ) {
        if self.update_face(number, time, x) {
            self.update_face_points(number);
        }
        self.write_face_event_variables(number, x, variables);
    }

    /// Writes the event functions of the points of one face from its event variables.
    pub(super) fn face_margins(
        &self,
        number: usize,
        variables: &[f64],
        contact_states: &[u8],
        margins: &mut [f64],
    ) {
        let law = threshold(&self.faces[number].element.law);
        let (gaps, loads) = variables.split_at(contact_states.len());
        let variables_of_blocks = gaps.chunks(LANES).zip(loads.chunks(LANES));
        let points = margins.chunks_mut(LANES).zip(contact_states.chunks(LANES));
        for ((margins, contact_states), (gaps, loads)) in points.zip(variables_of_blocks) {
            put(margins, margins_of(contact_states, take(gaps), take(loads), law));
        }
    }

    /// Returns the next contact state of one point of a face, from the face's event variables.
    pub(super) fn next_contact_state(
        &self,
        number: usize,
        variables: &[f64],
        index: usize,
        contact_state: u8,
    ) -> u8 {
        let (gaps, loads) = variables.split_at(variables.len() / 2);
        let variables = PointVariables {
            gap: gaps[index],
            load: loads[index],
            law: threshold(&self.faces[number].element.law),
        };
        variables.next(ContactState::from_number(contact_state)) as u8
    }

    /// Returns the event groups: the points of each face, with the states that they depend on.
    pub(super) fn point_groups(&self) -> Vec<EventGroup> {
        let group = |number: usize| {
            let face = &self.faces[number];
            let mut states = Vec::new();
            for body in face.touches(&self.free_number) {
                let free = &self.free[body];
                for part in [free.offset, self.layout.speeds + free.offset] {
                    states.push(part..part + free.free.len());
                }
            }
            let first = 2 * self.layout.speeds + face.first_internal;
            states.push(first..first + face.internal_count);
            EventGroup {
                discrete_states: self.points_of(number),
                variables: self.event_variable_range(number),
                states,
            }
        };
        (0..self.faces.len()).map(group).collect()
    }
}

impl System {
    /// Writes the creep speed of each contact point at a state, m/s: the speed of irrecoverable sliding, in
    /// any contact state.
    ///
    /// With tanh this is the slip speed, with the bristle the slip speed less the rate of the bristle; where
    /// friction acts along one tangent alone, along that.
    pub fn creep_speeds(&mut self, time: f64, x: &[f64], speeds: &mut [f64]) {
        self.update_kinematics(time, x);
        let [_, _, internal, _] = self.layout.split(x);
        for (number, face) in self.faces.iter().enumerate() {
            let target = &mut speeds[self.points_of(number)];
            let relative: RelativeMotion<f64> = face.relative_frame.relative(&self.kinematics[face.body]);
            let deflections = &internal[face.first_internal..][..face.internal_count];
            face.element.evaluate(&relative, deflections, |point, contact| {
                let slip = face.element.surface.seen(contact.slip);
                let [a, b] = [0, 1].map(|k| slip[k] - contact.friction.rate[k]);
                target[point] = if contact.normal > 0.0 {
                    (a * a + b * b).sqrt()
                } else {
                    0.0
                };
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each lane against the definition at the head of the module.
    #[test]
    fn limits_margins_of_four_points_are_those_of_each() {
        let contact_states = [
            ContactState::Open,
            ContactState::Stick,
            ContactState::Slip,
            ContactState::Stick,
        ]
        .map(|contact_state| contact_state as u8);
        let half = 0.5 * CLOSING_GAP;
        for law in 0..2 {
            for gaps in [
                [half; 4],
                [-1e-6, -1e-6, -1e-6, 2.0 * BAND],
                [1e-6, half, half, 0.0],
            ] {
                for load in [0.0, 0.5, 1.0, 1.5, 3.0, f64::NAN] {
                    let found =
                        margins_of(&contact_states, Lanes::new(gaps), Lanes::from(load), law).to_array();
                    for ((contact_state, gap), found) in contact_states.iter().zip(gaps).zip(found) {
                        let opens = (OPENING_GAP - gap) / BAND;
                        // Without a normal force there is no friction.
                        let expected = match ContactState::from_number(*contact_state) {
                            ContactState::Open => gap - CLOSING_GAP,
                            _ if gap >= OPENING_GAP || load.is_nan() => opens,
                            ContactState::Stick => opens.min(SLIP_LOAD[law] - load),
                            ContactState::Slip => opens.min(load - STICK_LOAD[law]),
                        };
                        assert_eq!(
                            found, expected,
                            "contact state {contact_state}, gap {gap}, load {load}"
                        );
                    }
                }
            }
        }
        let alone = margins_of(&[0], Lanes::from(0.3), Lanes::from(9.0), 0);
        assert_eq!(alone.at(0), 0.3 - CLOSING_GAP);
    }
}

//! The observer that a run shows its output times to.

use integrate::MAXIMUM_COUNT;
use serde::{Deserialize, Serialize};

use super::check::{Checks, PlausibilityCheck};
use super::{
    FEWEST_ROWS, FindingKind, LARGEST_FRICTION, LARGEST_SCATTER, Location, PlausibilityFinding,
    RELEASED_SHARE, ROWS_A_PERIOD,
};
use crate::connection::Law;
use crate::energy_balance::EnergyBalance;
use crate::link::RelativeMotion;
use crate::system::System;
use crate::vector::Vector;

/// No value of a saved record is larger: sums of such values are finite.
const LARGEST: f64 = 1e300;

/// The worst value of one quantity at one place so far (SI).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct WorstValue {
    /// The value, zero or positive.
    pub value: f64,
    /// The first output time with it, s.
    pub time: f64,
    /// The first output time at which the limit was exceeded, s.
    pub since: Option<f64>,
    /// The point of the face that it was found at.
    pub point: usize,
}

/// The record of a face along a run (SI).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaceRecord {
    /// Energy in the contact springs at the start, J.
    pub start_energy: f64,
    /// The largest at any later output time, J.
    pub largest_energy: f64,
    /// Sum of the normal forces at the last output time and at the one before, N.
    pub forces: [f64; 2],
    /// Sum of the absolute second differences of that force, N.
    pub changes: f64,
    /// Sum of that force over the output times, N.
    pub sum: f64,
}

/// The plausibility record of a run so far, to be saved with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PlausibilityRecord {
    /// Output times seen.
    pub rows: u64,
    /// The worst values, in a fixed order.
    pub worst: Vec<WorstValue>,
    /// The contact faces.
    pub faces: Vec<FaceRecord>,
}

impl PlausibilityRecord {
    /// Returns whether it can be the record of a run: no value is negative or out of all bounds.
    fn is_sound(&self) -> bool {
        let size = |value: f64| (0.0..LARGEST).contains(&value);
        let worst = |worst: &WorstValue| {
            let times = size(worst.time) && worst.since.is_none_or(size);
            times && size(worst.value) && worst.point as u64 <= MAXIMUM_COUNT
        };
        let face = |face: &FaceRecord| {
            let values = [face.start_energy, face.largest_energy, face.changes, face.sum];
            values.into_iter().chain(face.forces).all(size)
        };
        let counted = (1..=MAXIMUM_COUNT).contains(&self.rows);
        counted && self.worst.iter().all(worst) && self.faces.iter().all(face)
    }
}

/// Observes a run at its output times, and finds implausible values in it.
#[derive(Clone, Debug)]
pub struct Plausibility {
    checks: Checks,
    record: PlausibilityRecord,
}

impl Plausibility {
    /// Returns the observer of a run that starts at `time` (s) in state `x`; that start is the first output
    /// time.
    #[must_use]
    pub fn new(system: &mut System, time: f64, x: &[f64]) -> Self {
        system.place_at(time, x);
        let checks = Checks::new(system);
        let record = PlausibilityRecord {
            rows: 0,
            worst: vec![WorstValue::default(); checks.all.len()],
            faces: vec![FaceRecord::default(); checks.faces.len()],
        };
        let mut observer = Self { checks, record };
        observer.note(system, time, x);
        observer
    }

    /// Returns the observer of a run that goes on; `time` (s) and `x` are those of its start. Returns
    /// `None` if the record cannot be that of a run of this system.
    #[must_use]
    pub fn resume(system: &mut System, time: f64, x: &[f64], record: PlausibilityRecord) -> Option<Self> {
        system.place_at(time, x);
        let checks = Checks::new(system);
        let fits = record.worst.len() == checks.all.len() && record.faces.len() == checks.faces.len();
        (fits && record.is_sound()).then_some(Self { checks, record })
    }

    /// Returns the record so far.
    #[must_use]
    pub fn record(&self) -> &PlausibilityRecord {
        &self.record
    }

    /// Returns all limits that follow from the system: the kind, the place and the limit (SI; infinite where
    /// there is none).
    pub fn limits(&self) -> impl Iterator<Item = (FindingKind, Location, f64)> {
        let all = self.checks.all.iter();
        all.map(|check| (check.kind, check.location, check.limit))
    }

    /// Takes an output time (s) and the state then into account.
    pub fn note(&mut self, system: &mut System, time: f64, x: &[f64]) {
        system.place_at(time, x);
        let mut next = 0;
        let (checks, worst) = (&self.checks.all, &mut self.record.worst);
        let mut keep = |value: f64, point: usize| {
            let (check, kept) = (&checks[next], &mut worst[next]);
            next += 1;
            // What is not a number stops the run; it is not judged here.
            if value > kept.value && value.is_finite() {
                (kept.value, kept.time, kept.point) = (value, time, point);
                if value > check.limit && kept.since.is_none() {
                    kept.since = Some(time);
                }
            }
        };
        let first = self.record.rows == 0;
        for (number, (start, record)) in self.checks.faces.iter().zip(&mut self.record.faces).enumerate() {
            let relative = system.face_relative(number);
            let face = &system.faces()[number].element;
            let (mut gap, mut depth, mut deepest) = (f64::INFINITY, 0.0, 0);
            let (mut energy, mut force) = (0.0, 0.0);
            for (i, point) in face.points.iter().enumerate() {
                let own = face.geometry(point, &relative).gap;
                gap = gap.min(own);
                if -own > depth {
                    (depth, deepest) = (-own, i);
                }
                energy += face.stored(point, own, None)[0];
                force += point.stiffness * (-own).max(0.0);
            }
            let moved: Vector<f64> = relative.at(start.middle).position - start.place;
            keep(gap, 0);
            keep(moved.0[1].abs(), 0);
            keep(moved.0[2].abs(), 0);
            // An overlap at the start is judged by the energy that it releases.
            keep(if first { 0.0 } else { depth }, deepest);
            keep(tilt(&relative, start.normal), 0);
            record.note(self.record.rows, energy, force);
        }
        for (number, coil) in system.coils().iter().enumerate() {
            let compression = coil.element.free_length - system.coil_length(number);
            keep(compression, 0);
            keep(compression, 0);
            keep(-compression, 0);
        }
        for (number, start) in self.checks.distances.iter().enumerate() {
            keep((system.element_distance(number) - start).abs(), 0);
        }
        for body in &self.checks.linearized {
            for coordinate in system.linearized_coordinates(*body) {
                keep(coordinate.abs(), 0);
            }
        }
        system.wedge_coil_deflections(x, |_, deflection| keep(-deflection, 0));
        let [.., quadratures] = system.layout().split(x);
        for loss in &self.checks.losses {
            keep(-quadratures[*loss], 0);
        }
        self.record.rows += 1;
    }

    /// Returns the findings so far of a run that goes on, without those that only the whole of it shows:
    /// what overlap at the start releases, scatter from output time to output time, and losses below zero,
    /// whose limit is the residual of the run's ledger.
    #[must_use]
    pub fn present(&self, system: &System) -> Vec<PlausibilityFinding> {
        let mut findings = self.findings(system, &EnergyBalance::new(0.0), 0.0);
        findings.retain(|own| own.kind != FindingKind::EnergyCreated);
        findings
    }

    /// Returns the findings, by kind of element and place; `balance` is the run's energy balance, and
    /// `interval` its output interval, s.
    #[must_use]
    pub fn findings(
        &self,
        system: &System,
        balance: &EnergyBalance,
        interval: f64,
    ) -> Vec<PlausibilityFinding> {
        let mut findings = Vec::new();
        let limit = |check: &PlausibilityCheck| match check.kind {
            FindingKind::EnergyCreated => balance.resolution(),
            _ => check.limit,
        };
        let pairs = self.checks.all.iter().zip(&self.record.worst);
        for (check, worst) in pairs.filter(|(check, worst)| worst.value > limit(check)) {
            let location = match (check.kind, check.location) {
                (FindingKind::Penetration, Location::Face { face, .. }) => Location::Face {
                    face,
                    point: Some(worst.point),
                },
                (_, location) => location,
            };
            findings.push(PlausibilityFinding {
                kind: check.kind,
                location,
                time: Some(worst.time),
                since: worst.since,
                value: worst.value,
                limit: limit(check),
            });
        }
        let scale = balance.turnover().max(balance.stored_at_start);
        for (number, face) in self.record.faces.iter().enumerate() {
            let finding = |kind: FindingKind, value: f64, limit: f64| PlausibilityFinding {
                kind,
                location: Location::Face {
                    face: number,
                    point: None,
                },
                time: None,
                since: None,
                value,
                limit,
            };
            let (released, limit) = (face.start_energy - face.largest_energy, RELEASED_SHARE * scale);
            // Without a scale nothing has happened but rounding.
            if self.record.rows > 1 && scale > 0.0 && released > limit {
                findings.push(finding(FindingKind::StoredAtStart, released, limit));
            }
            let start = &self.checks.faces[number];
            let (frequency, scatter) = (start.frequency, face.scatter(self.record.rows, start.weight));
            let limit = 1.0 / (ROWS_A_PERIOD * frequency);
            if scatter > LARGEST_SCATTER && interval > limit {
                let kind = FindingKind::CoarseOutput { frequency, scatter };
                findings.push(finding(kind, interval, limit));
            }
        }
        findings.extend(frictions(system));
        findings
    }
}

impl FaceRecord {
    /// Takes energy (J) and normal force (N) at an output time into account; `rows` were seen before.
    fn note(&mut self, rows: u64, energy: f64, force: f64) {
        if rows == 0 {
            self.start_energy = energy;
            // The force of an overlap at the start is none of the motion's.
            return;
        }
        self.largest_energy = self.largest_energy.max(energy);
        let [last, before] = self.forces;
        if rows > 2 {
            self.changes += (force - 2.0 * last + before).abs();
        }
        self.sum += force;
        self.forces = [force, last];
    }

    /// Returns the scatter of the normal force ([`LARGEST_SCATTER`]) of a body of this weight (N); zero
    /// where there is not enough to judge.
    fn scatter(&self, rows: u64, weight: f64) -> f64 {
        let scale = self.sum.max(weight * rows as f64);
        if rows < FEWEST_ROWS || scale <= 0.0 {
            return 0.0;
        }
        self.changes / scale
    }
}

/// Returns the angle between a direction of the body (unit vector, body axes) and the x axis of the mount,
/// rad.
fn tilt(relative: &RelativeMotion<f64>, normal: Vector<f64>) -> f64 {
    let [x, y, z] = relative.rotation.apply::<f64, f64>(normal).0;
    libm::atan2((y * y + z * z).sqrt(), x)
}

/// Returns the coefficients of friction that are out of proportion.
fn frictions(system: &System) -> impl Iterator<Item = PlausibilityFinding> {
    let faces = system.faces().iter().enumerate().map(|(face, mounted)| {
        let location = Location::Face { face, point: None };
        (location, mounted.element.coefficient)
    });
    let connections = system
        .connections()
        .iter()
        .enumerate()
        .map(|(number, connection)| {
            let coefficient = match &connection.law {
                Law::Surface(surface) => surface.coefficient,
                Law::Wedge(wedge) => wedge.slope_friction.max(wedge.column_friction),
                Law::Springs(_) | Law::Gap(..) => 0.0,
            };
            (Location::Connection(number), coefficient)
        });
    let all = faces.chain(connections);
    all.filter(|(_, coefficient)| *coefficient > LARGEST_FRICTION)
        .map(|(location, value)| PlausibilityFinding {
            kind: FindingKind::Friction,
            location,
            time: None,
            since: None,
            value,
            limit: LARGEST_FRICTION,
        })
}

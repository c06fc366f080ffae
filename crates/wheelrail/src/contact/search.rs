//! Contact search: where a wheel overlaps its rail, without memory of earlier searches.
//!
//! The rigid profiles overlap by h(y) along the silhouette. Each interval with h > 0 is an area of contact;
//! the three deepest are kept, and become patches, see `patch.rs`. Stations 0.5 mm apart are compared first,
//! with the rail as straight lines; near contact the overlap is exact, and ends of intervals are found by
//! Newton's method. Patches narrower than the spacing are found by the slopes at stations.
//!
//! Limits: a fourth area is left out; intervals end where the wheel ends; at large yaw parts of the flange's
//! throat are hidden behind others, which is judged at stations 0.5 mm apart.

use std::sync::Arc;

use numerics::scalar::{Dual, Real};

use super::ellipse::Ellipses;
use super::patch::ContactPatch;
use super::pose::{Frame, ProfileNode, WheelPose};
use super::section::{RailSection, STATIONS, WheelSection};
use super::strips::StripLoads;
use super::turned::{TurnedWheel, WheelForm};
use super::varying::{Stretch, VaryingRail};
use crate::hertz::Material;
use crate::profile::{Profile, ProfileError};

/// Most areas of contact of a wheel.
pub const AREAS: usize = 3;
/// Overlap that a station may lack beside a patch that is narrower than the spacing of stations, m.
const BETWEEN_STATIONS: f64 = 2e-5;
/// Overlap that stations may lack for the space between them to be looked through in pieces, m; number of
/// pieces.
const BESIDE: f64 = 2e-6;
const SUBDIVISIONS: usize = 4;
/// Distance beyond its ends over which the rail is compared, along its end slopes, m.
const BEYOND: f64 = 5e-3;
/// Overlap below which there is no patch, m: a load of less than 1e-6 N.
pub(super) const NOTHING: f64 = 1e-12;

/// A wheel and a rail prepared for the search.
#[derive(Clone, Debug)]
pub struct ContactPair {
    pub(super) wheel: WheelSection,
    /// What the wheel is if it is not round.
    form: Option<WheelForm>,
    pub(super) rail: Rail,
    pub(super) ellipses: Ellipses,
    patch: PatchForm,
}

/// What patches are taken for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PatchForm {
    /// Hertz's ellipses.
    #[default]
    Ellipse,
    /// Strips.
    Strips,
}

/// The rail of a pair.
#[derive(Clone, Debug)]
pub(super) enum Rail {
    Constant(Arc<RailSection>),
    Varying(Arc<VaryingRail>),
}

impl Rail {
    /// Returns the rail at a place along the track, m.
    #[inline(always)]
    pub fn at(&self, place: f64) -> Stretch<'_> {
        match self {
            Self::Constant(section) => Stretch::Constant(section),
            Self::Varying(rail) => rail.at(place),
        }
    }
}

/// An interval of overlap by the parameter of the wheel's profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    pub ends: [IntervalEnd; 2],
    /// Largest overlap at its stations.
    pub peak: f64,
    /// Its first and last station.
    pub stations: [usize; 2],
}

/// An end of an interval.
#[derive(Clone, Copy, Debug)]
pub(super) enum IntervalEnd {
    /// The overlap is zero between a parameter outside and one inside.
    Root([f64; 2]),
    /// The wheel ends there.
    Cut(f64),
}

/// The overlap at the stations.
pub(super) struct Scan {
    pub overlap: [f64; STATIONS],
    /// Its derivative by y where the overlap is exact: near zero overlap.
    slope: [f64; STATIONS],
    first: usize,
    last: usize,
}

/// The touching of rigid profiles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidTouch {
    /// Largest overlap, m; negative if they are apart.
    pub overlap: f64,
    /// Its place: x from the wheel's center, y, z on the rail, m.
    pub place: [f64; 3],
    /// Slope of the plane of contact.
    pub slope: f64,
    /// y on the wheel's profile, m.
    pub profile: f64,
    /// Radius of the wheel there, m.
    pub radius: f64,
}

/// The finder of the patches of a wheel on its rail: the search, or tables.
pub trait FindPatches {
    /// Gives each patch at a pose to `take`, with the loads on its strips if it is no ellipse.
    fn find<S: Real>(&self, pose: &WheelPose<S>, take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>));

    /// Gives each patch at a pose to `take`, and the same patches with other derivatives to `also`: both
    /// poses have the same values.
    fn find_both<S: Real, T: Real>(
        &self,
        pose: &WheelPose<S>,
        other: &WheelPose<T>,
        take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
        mut also: impl FnMut(ContactPatch<T>),
    ) {
        self.find(pose, take);
        self.find(other, |patch, _| also(patch));
    }

    /// Gives each patch at a pose to `take`.
    #[inline(always)]
    fn search<S: Real>(&self, pose: &WheelPose<S>, mut take: impl FnMut(ContactPatch<S>)) {
        self.find(pose, |patch, _| take(patch));
    }

    /// Returns the material.
    fn material(&self) -> Material;
}

impl FindPatches for ContactPair {
    /// The deepest area comes first.
    fn find<S: Real>(
        &self,
        pose: &WheelPose<S>,
        mut take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
    ) {
        let rail = self.rail.at(pose.along.value());
        let wheel = self.turned(pose.angle.value());
        let frame = Frame::new(pose, &wheel, &rail);
        let plain = frame.lifted::<f64>();
        self.areas(&plain, |scan, intervals| {
            self.formed(&frame, &plain, scan, intervals, &mut take);
        });
    }

    /// One search serves both.
    fn find_both<S: Real, T: Real>(
        &self,
        pose: &WheelPose<S>,
        other: &WheelPose<T>,
        mut take: impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
        mut also: impl FnMut(ContactPatch<T>),
    ) {
        let rail = self.rail.at(pose.along.value());
        let wheel = self.turned(pose.angle.value());
        let frame = Frame::new(pose, &wheel, &rail);
        let beside = Frame::new(other, &wheel, &rail);
        let plain = frame.lifted::<f64>();
        self.areas(&plain, |scan, intervals| {
            self.formed(&frame, &plain, scan, intervals, &mut take);
            self.formed(&beside, &plain, scan, intervals, &mut |patch, _| also(patch));
        });
    }

    fn material(&self) -> Material {
        self.ellipses.material()
    }
}

impl ContactPair {
    /// Returns a wheel of a nominal radius (m) and a rail, as it stands on the track, of a material.
    ///
    /// # Errors
    /// A profile is of the wrong kind or without its datum, or a number is not admissible.
    pub fn new(
        wheel: &Profile,
        radius: f64,
        rail: &Profile,
        material: Material,
    ) -> Result<Self, ProfileError> {
        let range = [0.05, 2.0];
        if !(radius > range[0] && radius < range[1]) {
            return Err(ProfileError::Length {
                what: "wheel radius",
                value: radius,
                range,
            });
        }
        let ellipses = Ellipses::new(material).map_err(|_| ProfileError::Number {
            what: "Young's modulus (Pa) or Poisson's ratio",
            value: material.youngs_modulus,
            must: "positive, the ratio between 0 and 0.5",
        })?;
        Ok(Self {
            wheel: WheelSection::new(wheel, radius)?,
            form: None,
            rail: Rail::Constant(Arc::new(RailSection::new(rail)?)),
            ellipses,
            patch: PatchForm::default(),
        })
    }

    /// Returns the same wheel and rail with patches of a form.
    #[must_use]
    pub fn with_patches(&self, patch: PatchForm) -> Self {
        Self {
            patch,
            ..self.clone()
        }
    }

    /// Returns what its patches are taken for.
    #[must_use]
    pub fn patch_form(&self) -> PatchForm {
        self.patch
    }

    /// Returns the same wheel on a rail whose section changes along the track.
    #[must_use]
    pub fn on(&self, rail: Arc<VaryingRail>) -> Self {
        Self {
            rail: Rail::Varying(rail),
            ..self.clone()
        }
    }

    /// Returns the same rail under a wheel that is not round.
    #[must_use]
    pub fn under(&self, form: WheelForm) -> Self {
        Self {
            form: Some(form),
            ..self.clone()
        }
    }

    /// Returns the form of a wheel that is not round.
    #[must_use]
    pub fn form(&self) -> Option<&WheelForm> {
        self.form.as_ref()
    }

    /// Returns the wheel at the angle that is down, rad.
    #[inline(always)]
    pub(super) fn turned(&self, angle: f64) -> TurnedWheel<'_> {
        match &self.form {
            None => TurnedWheel::Round(&self.wheel),
            Some(form) => form.at(&self.wheel, angle),
        }
    }

    /// Returns whether the section of the rail changes along the track.
    #[must_use]
    pub fn varies(&self) -> bool {
        matches!(self.rail, Rail::Varying(_))
    }

    /// Returns the nominal radius of the wheel, m.
    #[must_use]
    pub fn nominal_radius(&self) -> f64 {
        self.wheel.nominal_radius()
    }

    /// Returns the range of y (m) that the rail's section covers at a place along the track, m.
    #[must_use]
    pub fn rail_range(&self, along: f64) -> [f64; 2] {
        self.rail.at(along).range()
    }

    /// Returns the range of y (m) of the wheel's profile that the search covers.
    #[must_use]
    pub fn wheel_range(&self) -> [f64; 2] {
        let stations = self.wheel.stations();
        let at = |k: usize| stations.get(k).map_or(0.0, |station| station[0]);
        [at(0), at(stations.len().saturating_sub(1))]
    }

    /// Returns y (m) on the wheel's profile at which the face of the flange ends and its tip begins: where
    /// the slope falls below nine tenths of its largest; none if the wheel has no flange.
    #[must_use]
    pub fn flange_crest(&self) -> Option<f64> {
        let faces = self.wheel.stations().iter().filter(|station| station[0] < 0.0);
        let steepest = faces.clone().map(|station| -station[2]).fold(0.0, f64::max);
        let mut face = faces.filter(|station| -station[2] > 0.9 * steepest);
        face.next().filter(|_| steepest > 0.5).map(|station| station[0])
    }

    /// Returns all patches at a pose.
    #[must_use]
    pub fn patches_at(&self, pose: &WheelPose<f64>) -> Vec<ContactPatch<f64>> {
        let mut found = Vec::with_capacity(AREAS);
        self.search(pose, |patch| found.push(patch));
        found
    }

    /// Returns the same, none where the place is beside the rail.
    pub(crate) fn touch_over_rail(&self, pose: &WheelPose<f64>) -> Option<RigidTouch> {
        let [low, high] = self.rail_range(pose.along);
        self.touch(pose)
            .filter(|touch| (low..=high).contains(&touch.place[1]))
    }

    /// Returns how far (m) the wheel must be lowered at a pose until it bears on its rail: zero where it
    /// overlaps it, none where it is not over it.
    #[must_use]
    pub fn lift(&self, pose: &WheelPose<f64>) -> Option<f64> {
        self.touch(pose).map(|touch| (-touch.overlap).max(0.0))
    }

    /// Returns the place where the rigid profiles overlap most, or are closest; none if the wheel is not over
    /// the rail.
    #[must_use]
    pub fn touch(&self, pose: &WheelPose<f64>) -> Option<RigidTouch> {
        let rail = self.rail.at(pose.along);
        let wheel = self.turned(pose.angle);
        let frame = Frame::new(pose, &wheel, &rail);
        let scan = self.scan(&frame)?;
        let stations = scan.first..=scan.last;
        let highest = stations
            .clone()
            .map(|k| scan.overlap[k])
            .fold(f64::NEG_INFINITY, f64::max);
        if highest == f64::NEG_INFINITY {
            return None;
        }
        let mut best: Option<RigidTouch> = None;
        for k in stations {
            let own = scan.overlap[k];
            let [before, after] = scan.neighbors(k);
            if own < highest - BETWEEN_STATIONS || own < before || own < after {
                continue;
            }
            let at = self.stationary(&frame, around(&frame, &scan, k));
            let node = frame.node(at);
            if best.is_none_or(|best| node.overlap > best.overlap) {
                best = Some(RigidTouch {
                    overlap: node.overlap,
                    place: node.place,
                    slope: node.slope,
                    profile: node.profile,
                    radius: node.radius,
                });
            }
        }
        best
    }

    /// Gives the patches of intervals to `take`.
    #[inline(always)]
    fn formed<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        plain: &Frame<'_, f64>,
        scan: &Scan,
        intervals: &[Option<Interval>; AREAS],
        take: &mut impl FnMut(ContactPatch<S>, Option<&StripLoads<S>>),
    ) {
        match self.patch {
            PatchForm::Ellipse => {
                for interval in intervals.iter().flatten() {
                    self.patches(frame, plain, scan, interval, &mut |patch| take(patch, None));
                }
            }
            PatchForm::Strips => {
                self.patches_on_strips(frame, plain, scan, intervals, |patch, strips| {
                    take(patch, Some(strips));
                });
            }
        }
    }

    /// Gives the deepest areas of overlap to `take`, with the overlap at the stations.
    fn areas(&self, plain: &Frame<'_, f64>, take: impl FnOnce(&Scan, &[Option<Interval>; AREAS])) {
        let Some(mut scan) = self.scan(plain) else {
            return;
        };
        let mut intervals: [Option<Interval>; AREAS] = [None; AREAS];
        self.intervals(plain, &mut scan, |interval| keep(&mut intervals, interval));
        take(&scan, &intervals);
    }

    /// Returns the overlap at the stations that lie over the rail, by its straight lines; minus infinity
    /// where there is none. Nothing if no station does.
    fn scan(&self, frame: &Frame<'_, f64>) -> Option<Scan> {
        let mut scan = Scan {
            overlap: [f64::NEG_INFINITY; STATIONS],
            slope: [0.0; STATIONS],
            first: usize::MAX,
            last: 0,
        };
        let [low, high] = frame.rail_range();
        let mut reached = f64::NEG_INFINITY;
        let wheel = frame.wheel;
        let [begin, end] = frame.reach([low - BEYOND, high + BEYOND], wheel.nominal_radius());
        for k in wheel.first_from(begin)..wheel.count() {
            let station = wheel.station(k);
            if station[0] > end {
                break;
            }
            let Some([y, z]) = frame.station(station) else {
                continue;
            };
            // What turns back is hidden.
            if y <= reached {
                continue;
            }
            reached = y;
            if y < low - BEYOND || y > high + BEYOND {
                continue;
            }
            scan.overlap[k] = frame.coarse(y) - z;
            scan.first = scan.first.min(k);
            scan.last = k;
        }
        (scan.first != usize::MAX).then_some(scan)
    }

    /// Gives the intervals with overlap to `take`; the scan becomes exact near them.
    fn intervals(&self, frame: &Frame<'_, f64>, scan: &mut Scan, mut take: impl FnMut(Interval)) {
        // Exact are stations near zero overlap, their neighbors, and those beside a change of sign.
        let near = |overlap: f64| overlap.abs() < BETWEEN_STATIONS;
        let mut before = f64::NEG_INFINITY;
        for k in scan.first..=scan.last {
            let own = scan.overlap[k];
            let [_, after] = scan.neighbors(k);
            let changes = (own > 0.0) != (before > 0.0) || (own > 0.0) != (after > 0.0);
            if own > f64::NEG_INFINITY && (near(own) || near(before) || near(after) || changes) {
                let node = frame.node(frame.wheel.parameter(k));
                (scan.overlap[k], scan.slope[k]) = (node.overlap, node.overlap_slope);
            }
            before = own;
        }
        let mut k = scan.first;
        while k <= scan.last {
            let own = scan.overlap[k];
            if own > 0.0 {
                let begin = k;
                let mut peak = own;
                while k < scan.last && scan.overlap[k + 1] > 0.0 {
                    k += 1;
                    peak = peak.max(scan.overlap[k]);
                }
                let end = |inside: usize, outside: Option<usize>| {
                    let at = frame.wheel.parameter(inside);
                    match outside.filter(|outside| scan.overlap[*outside] > f64::NEG_INFINITY) {
                        Some(outside) => IntervalEnd::Root([frame.wheel.parameter(outside), at]),
                        None => IntervalEnd::Cut(at),
                    }
                };
                take(Interval {
                    ends: [
                        end(begin, begin.checked_sub(1)),
                        end(k, (k < STATIONS - 1).then_some(k + 1)),
                    ],
                    peak,
                    stations: [begin, k],
                });
            } else if k < scan.last {
                self.narrow(frame, scan, k, &mut take);
            }
            k += 1;
        }
    }

    /// Gives an interval of overlap between a station and the next one, neither of which overlaps.
    fn narrow(&self, frame: &Frame<'_, f64>, scan: &Scan, k: usize, take: &mut impl FnMut(Interval)) {
        let [own, next] = [scan.overlap[k], scan.overlap[k + 1]];
        let near = |overlap: f64, within: f64| overlap <= 0.0 && overlap > -within;
        if !(near(own, BETWEEN_STATIONS) && near(next, BETWEEN_STATIONS)) {
            return;
        }
        let [from, to] = [k, k + 1].map(|station| frame.wheel.parameter(station));
        let slopes = [scan.slope[k], scan.slope[k + 1]];
        let simple = slopes[0] > 0.0 && slopes[1] < 0.0;
        // Rising or falling over both stations, the overlap may still have a maximum between them.
        let pieces = match own.max(next) > -BESIDE && !simple {
            true => SUBDIVISIONS,
            false => 1,
        };
        let mut before = (from, slopes[0]);
        for piece in 1..=pieces {
            let after = match piece == pieces {
                true => (to, slopes[1]),
                false => {
                    let at = from + (to - from) * piece as f64 / pieces as f64;
                    (at, frame.node(at).overlap_slope)
                }
            };
            if before.1 > 0.0 && after.1 < 0.0 {
                let at = self.stationary(frame, [before.0, after.0]);
                let peak = frame.node(at).overlap;
                if peak > NOTHING {
                    take(Interval {
                        ends: [before.0, after.0].map(|end| IntervalEnd::Root([end, at])),
                        peak,
                        stations: [k, k],
                    });
                }
            }
            before = after;
        }
    }

    /// Returns the node at a parameter with derivatives by the parameter.
    #[inline(always)]
    pub(super) fn along(&self, frame: &Frame<'_, f64>, parameter: f64) -> ProfileNode<Dual<1>> {
        let lifted = frame.lifted::<Dual<1>>();
        lifted.node(Dual::variable(parameter, 0))
    }

    /// Returns the parameter within an interval at which the overlap is largest or smallest: where its slope
    /// is zero.
    pub(super) fn stationary(&self, frame: &Frame<'_, f64>, ends: [f64; 2]) -> f64 {
        zero(ends, |parameter| {
            let slope = self.along(frame, parameter).overlap_slope;
            [slope.value, slope.derivative[0]]
        })
    }

    /// Returns the parameter near a station at which the slope of the overlap is zero, and true; the
    /// station's own and false if the slope does not change its sign beside it.
    pub(super) fn turning(&self, frame: &Frame<'_, f64>, scan: &Scan, k: usize) -> (f64, bool) {
        let at = |station: usize| {
            let parameter = frame.wheel.parameter(station);
            let node = frame.node(parameter);
            (parameter, node.overlap_slope)
        };
        let (own, slope) = at(k);
        for beside in [k.saturating_sub(1), k + 1] {
            let (other, other_slope) = at(beside);
            if scan.overlap[beside] > f64::NEG_INFINITY && slope * other_slope < 0.0 {
                return (self.stationary(frame, [other, own]), true);
            }
        }
        (own, false)
    }

    /// Returns an end of an interval.
    pub(super) fn end<S: Real>(&self, frame: &Frame<'_, S>, plain: &Frame<'_, f64>, end: IntervalEnd) -> S {
        match end {
            IntervalEnd::Cut(at) => S::from(at),
            IntervalEnd::Root(ends) => {
                let overlap = |parameter| self.along(plain, parameter).overlap;
                let at = zero(ends, |parameter| {
                    let found = overlap(parameter);
                    [found.value, found.derivative[0]]
                });
                // Newton's step gives the derivatives of the root.
                let slope = overlap(at).derivative[0];
                let residual = frame.node(S::from(at)).overlap;
                S::from(at) - residual * slope.recip()
            }
        }
    }
}

/// Parameters of the neighbors of a station, or of itself where there is none.
fn around(frame: &Frame<'_, f64>, scan: &Scan, k: usize) -> [f64; 2] {
    let [before, after] = scan.neighbors(k);
    let beside = |overlap: f64, other: usize| match overlap > f64::NEG_INFINITY {
        true => frame.wheel.parameter(other),
        false => frame.wheel.parameter(k),
    };
    [beside(before, k.saturating_sub(1)), beside(after, k + 1)]
}

impl Scan {
    /// Returns the overlap at both neighbors of a station.
    fn neighbors(&self, k: usize) -> [f64; 2] {
        let before = k.checked_sub(1).map_or(f64::NEG_INFINITY, |k| self.overlap[k]);
        [
            before,
            self.overlap.get(k + 1).copied().unwrap_or(f64::NEG_INFINITY),
        ]
    }
}

/// Puts an interval among the deepest ones, in their order.
fn keep(intervals: &mut [Option<Interval>; AREAS], mut new: Interval) {
    for slot in intervals {
        match slot {
            Some(old) if old.peak >= new.peak => {}
            Some(old) => std::mem::swap(old, &mut new),
            None => {
                *slot = Some(new);
                return;
            }
        }
    }
}

/// Returns a zero of a function between two parameters by Newton's method within a bracket; the function
/// returns value and slope. Without a change of sign it returns the end with the smaller value.
fn zero([a, b]: [f64; 2], function: impl Fn(f64) -> [f64; 2]) -> f64 {
    let (mut from, mut to) = ([a, function(a)[0]], [b, function(b)[0]]);
    if from[1] * to[1] > 0.0 || a == b {
        return if from[1].abs() < to[1].abs() { a } else { b };
    }
    let mut at = a + (b - a) * (from[1] / (from[1] - to[1]));
    if !at.is_finite() {
        return a;
    }
    for _ in 0..60 {
        let [value, slope] = function(at);
        if value == 0.0 {
            return at;
        }
        *(if value * from[1] > 0.0 { &mut from } else { &mut to }) = [at, value];
        let newton = at - value / slope;
        let (low, high) = (from[0].min(to[0]), from[0].max(to[0]));
        let next = match newton > low && newton < high {
            true => newton,
            false => 0.5 * (low + high),
        };
        if (next - at).abs() < 1e-15 || high - low < 1e-15 {
            return next;
        }
        at = next;
    }
    at
}

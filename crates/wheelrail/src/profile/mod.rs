//! Profiles of wheels and rails in their section planes.
//!
//! **Axes.** y points to the field side, away from the track's center, and z up, on either side of the track;
//! so one profile serves left and right. A wheel's origin lies in its tape circle: its radius at a point is
//! the nominal radius less z. A rail's datum is z = 0, the top of rail of its file, from which the depth of
//! the gauge is measured; rails are placed by gauge and highest point. Curves lead from the gauge side to the
//! field side. SI units.
//!
//! | profile | from |
//! |---|---|
//! | [`nominal`] | cone, cylinder; wheels AAR-1B and AAR 1:20, rail 136RE from memory, to be checked against
//! drawings |
//! | [`european`] | wheel S1002, rail 60E1 |
//! | [`worn`] | the AAR-1B with a hollow tread, a guess |
//! | [`names`] | all of these by name |
//! | [`chain`](mod@chain) | lines and arcs that join tangentially |
//! | [`Points`] | files: CSV with units, Simpack, MiniProf, VAMPIRE; a spline along them with a stated
//! deviation |
//! | [`SlicedProfile`] | CONTACT's lists of files over distance or angle, linear between them |

pub mod chain;
mod check;
pub mod curve;
mod datum;
pub mod error;
pub mod european;
pub mod figures;
pub mod names;
pub mod nominal;
pub mod points;
mod shape;
mod slices;
mod spline;
mod visible;
pub mod worn;

use std::path::Path;

pub use chain::ChainElement;
pub use curve::{CurvePoint, ProfileCurve};
pub use datum::{TAPE_FROM_BACK, WheelDatum};
pub use error::{ProfileError, ProfilePlace};
pub use figures::{WheelFigures, flangeway_clearance};
pub use points::Points;
pub use slices::{NamedSlice, SlicedProfile};
pub use spline::Deviation;
pub(crate) use visible::{visible_from, zero_of};

use crate::contact::Side;

/// Points closer than this to the one before them are left out, m: measured profiles repeat points, and the
/// direction between two such points is noise.
pub const SMALLEST_SPACING: f64 = 1e-5;
/// Spacing at which extreme points of profiles are looked for, m.
const FINE: f64 = 2e-5;

/// Spacing at which chains are looked through for crossings, m.
const COARSE: f64 = 2e-4;

/// A datum this close to the highest point of a rail is that point, m: rounding of lines and arcs.
const ROUNDING: f64 = 1e-9;
/// A datum further than this from the highest point of a rail is no top of rail but by wear, m: it lies 0.5
/// mm below in rails whose points are inclined by 1:20.
const NEAR_TOP: f64 = 2e-3;
/// Depths below the highest point at which gauge is measured then, m: 9 mm on tramways to 16 mm.
const DEPTHS: [f64; 2] = [8e-3, 17e-3];

/// Wheel or rail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProfileKind {
    /// A wheel.
    Wheel,
    /// A rail.
    Rail,
}

impl ProfileKind {
    /// Returns its name.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Wheel => "wheel",
            Self::Rail => "rail",
        }
    }
}

/// How a file is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Largest distance of splines from the points, m; zero: through them.
    pub deviation: f64,
    /// Where y = 0 of a wheel's points lies; none: as the format says, the tape circle if it says nothing.
    pub datum: Option<WheelDatum>,
    /// Distance of the tape circle from the back of the flange, m; none: that of the file, or
    /// [`TAPE_FROM_BACK`].
    pub tape_from_back: Option<f64>,
    /// The side of the track, for files that have both; none: the right one.
    pub side: Option<Side>,
}

/// Lengths that a file states, m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StatedLengths {
    /// Nominal radius of the wheel.
    pub radius: Option<f64>,
    /// Distance of the tape circles of the wheelset.
    pub tape_distance: Option<f64>,
    /// Depth below the datum of the rail at which gauge is measured.
    pub gauge_depth: Option<f64>,
}

/// A doubt about a profile that was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileNotice {
    /// What is doubtful: where, and how much.
    pub text: String,
    /// What to do.
    pub advice: String,
}

/// A profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    name: String,
    kind: ProfileKind,
    curve: ProfileCurve,
    deviation: Deviation,
    note: &'static str,
    stated: StatedLengths,
    notices: Vec<ProfileNotice>,
    /// y of the back of a wheel's flange, m, where it is known.
    back: Option<f64>,
    /// Depth of a rail's datum below its highest point, m; 0 for wheels.
    datum_depth: f64,
}

impl Profile {
    /// Returns the profile of a curve that leads from the gauge side to the field side; a rail's datum is
    /// z = 0.
    #[must_use]
    pub fn of_curve(name: &str, kind: ProfileKind, curve: ProfileCurve) -> Self {
        let mut profile = Self {
            name: name.to_owned(),
            kind,
            curve,
            deviation: Deviation::default(),
            note: "",
            stated: StatedLengths::default(),
            notices: Vec::new(),
            back: None,
            datum_depth: 0.0,
        };
        if kind == ProfileKind::Rail {
            let [_, top] = profile.top();
            profile.datum_depth = if top.abs() < ROUNDING { 0.0 } else { top };
        }
        profile
    }

    /// Returns the profile of lines and arcs that join tangentially, from the point of the first element
    /// nearest to `start` (m) to the point of the last one nearest to `end`; see [`chain`](mod@chain).
    ///
    /// # Errors
    /// The elements do not join, or the profile crosses itself.
    pub fn of_chain(
        name: &str,
        kind: ProfileKind,
        start: [f64; 2],
        elements: &[ChainElement],
        end: [f64; 2],
    ) -> Result<Self, ProfileError> {
        let curve = chain::chain(name, start, elements, end)?;
        let sample = curve.sample(COARSE);
        let points: Vec<[f64; 2]> = sample.iter().map(|(_, point)| point.position).collect();
        check::crossings(&Points::new(name, &points)).map_err(|error| match error {
            ProfileError::SelfCrossing { at, .. } => ProfileError::SelfCrossing {
                place: ProfilePlace::whole(name),
                other: ProfilePlace::whole("itself"),
                at,
            },
            other => other,
        })?;
        Ok(Self::of_curve(name, kind, curve))
    }

    /// Returns the profile along points: a spline that lies at most `deviation` (m) from each of them,
    /// through them if that is zero.
    ///
    /// # Errors
    /// The points are too few, cross themselves, have a wrong unit or orientation, or the deviation is
    /// negative.
    pub fn of_points(points: &Points, kind: ProfileKind, deviation: f64) -> Result<Self, ProfileError> {
        if !(deviation >= 0.0 && deviation.is_finite()) {
            return Err(ProfileError::Number {
                what: "deviation from the points",
                value: deviation,
                must: "zero or positive",
            });
        }
        let checked = check::checked(points, kind)?;
        let (curve, deviation) = spline::fit(&checked.points, deviation);
        let of_wheel = kind == ProfileKind::Wheel;
        let from_back = match checked.datum {
            Some(WheelDatum::FlangeBack) => Some(checked.tape_from_back.unwrap_or(TAPE_FROM_BACK)),
            _ => checked.tape_from_back,
        };
        Ok(Self {
            deviation,
            stated: checked.stated,
            notices: checked.notices,
            back: from_back.filter(|_| of_wheel).map(|length| -length),
            ..Self::of_curve(&checked.name, kind, curve)
        })
    }

    /// Reads a profile from a file of points as its format says; see [`points`] for formats and
    /// [`Profile::of_points`] for `deviation` (m).
    ///
    /// # Errors
    /// The file is not read, or there are no good points in it.
    pub fn read(path: &Path, kind: ProfileKind, deviation: f64) -> Result<Self, ProfileError> {
        let options = ReadOptions {
            deviation,
            ..ReadOptions::default()
        };
        Self::read_with(path, kind, &options)
    }

    /// Reads a profile from a file of points; see [`points`] for formats.
    ///
    /// # Errors
    /// The file is not read, or there are no good points in it.
    pub fn read_with(path: &Path, kind: ProfileKind, options: &ReadOptions) -> Result<Self, ProfileError> {
        let mut points = Points::read(path, options.side)?;
        points.datum = options.datum.or(points.datum);
        points.tape_from_back = options.tape_from_back.or(points.tape_from_back);
        Self::of_points(&points, kind, options.deviation)
    }

    /// Returns its name: the file, or that of a nominal profile.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns whether it is a wheel or a rail.
    #[must_use]
    pub fn kind(&self) -> ProfileKind {
        self.kind
    }

    /// Returns the remark about its source that users must see; empty if there is nothing.
    #[must_use]
    pub fn note(&self) -> &str {
        self.note
    }

    /// Returns the largest distance of the curve from the points it was made of; zero for lines and arcs.
    #[must_use]
    pub fn deviation(&self) -> Deviation {
        self.deviation
    }

    /// Returns the lengths that its file states.
    #[must_use]
    pub fn stated(&self) -> StatedLengths {
        self.stated
    }

    /// Returns the doubts about it.
    #[must_use]
    pub fn notices(&self) -> &[ProfileNotice] {
        &self.notices
    }

    /// Returns y (m) of the back of a wheel's flange; none where it is not known.
    #[must_use]
    pub fn flange_back(&self) -> Option<f64> {
        self.back
    }

    /// Returns its curve.
    #[must_use]
    pub fn curve(&self) -> &ProfileCurve {
        &self.curve
    }

    /// Returns the curvature (1/m) at a parameter of the curve (m), positive where the body is convex.
    #[must_use]
    pub fn convexity(&self, parameter: f64) -> f64 {
        let curvature = self.curve.at(parameter).curvature();
        match self.kind {
            ProfileKind::Wheel => curvature,
            ProfileKind::Rail => -curvature,
        }
    }

    /// Returns the profile inclined towards the track's center by a slope, such as 1/40, about its origin. A
    /// rail's datum stays as far below its highest point as before.
    #[must_use]
    pub fn inclined(&self, slope: f64) -> Self {
        Self {
            curve: self.curve.moved(libm::atan(slope), [0.0; 2]),
            ..self.clone()
        }
    }

    /// Returns the profile moved (m), a rail with its datum.
    #[must_use]
    pub fn moved(&self, shift: [f64; 2]) -> Self {
        Self {
            curve: self.curve.moved(0.0, shift),
            ..self.clone()
        }
    }

    /// Returns the highest point (m).
    #[must_use]
    pub fn top(&self) -> [f64; 2] {
        self.extreme(|[_, z]| Some(z)).unwrap_or_default()
    }

    /// Returns the lowest point (m), on a wheel the tip of the flange.
    #[must_use]
    pub fn bottom(&self) -> [f64; 2] {
        self.extreme(|[_, z]| Some(-z)).unwrap_or_default()
    }

    /// Returns how far (m) the datum of a rail, z = 0 of its file, lies below its highest point: positive for
    /// rails that are inclined in their points, negative for worn ones beside the new section.
    #[must_use]
    pub fn datum_depth(&self) -> f64 {
        self.datum_depth
    }

    /// Returns y (m) of the point of a rail at which gauge is measured: the innermost one not lower than
    /// `depth` (m) below the datum.
    #[must_use]
    pub fn gauge_point(&self, depth: f64) -> f64 {
        let level = self.top()[1] - self.datum_depth - depth;
        self.extreme(|[y, z]| (z >= level).then_some(-y))
            .map_or(0.0, |[y, _]| y)
    }

    /// Returns y (m) of the active face of a wheel's flange at a depth (m) below the tape circle: the
    /// outermost point of the flange not higher than that. Returns none if the wheel has no flange: if its
    /// lowest point lies less than 15 mm below the tape circle.
    #[must_use]
    pub fn flange_face(&self, depth: f64) -> Option<f64> {
        if self.bottom()[1] > -check::FLANGE {
            return None;
        }
        self.extreme(|[y, z]| (y < 0.0 && z <= -depth).then_some(y))
            .map(|[y, _]| y)
    }

    /// Returns the point at which a function is largest; none if it has a value nowhere.
    fn extreme(&self, function: impl Fn([f64; 2]) -> Option<f64>) -> Option<[f64; 2]> {
        let value = |parameter| function(self.curve.at(parameter).position).unwrap_or(f64::NEG_INFINITY);
        let mut best = (f64::NEG_INFINITY, self.curve.range()[0]);
        let sample = self.curve.sample(FINE);
        for (parameter, point) in &sample {
            let found = function(point.position).unwrap_or(f64::NEG_INFINITY);
            if found > best.0 {
                best = (found, *parameter);
            }
        }
        if best.0 == f64::NEG_INFINITY {
            return None;
        }
        // Halve steps around the best sample.
        let [low, high] = self.curve.range();
        let mut step = FINE;
        while step > 1e-13 {
            let trials = [(best.1 - step).max(low), (best.1 + step).min(high)];
            match trials
                .into_iter()
                .map(|at| (value(at), at))
                .find(|trial| trial.0 > best.0)
            {
                Some(better) => best = better,
                None => step *= 0.5,
            }
        }
        Some(self.curve.at(best.1).position)
    }
}

/// Checks that the gauge can be measured on rails (left, right), and that a wheelset fits between them: the
/// active faces of its flanges, at the depth where gauge is measured, must be closer than the gauge.
///
/// `tape_distance` is the distance of the tape circles; `gauge` is measured `depth` below the datums of the
/// rails. All in m.
///
/// # Errors
/// The wheelset is wider than the gauge, or the datum of a rail is not its top.
pub fn check_gauge(
    wheels: [&Profile; 2],
    rails: [&Profile; 2],
    tape_distance: f64,
    gauge: f64,
    depth: f64,
) -> Result<(), ProfileError> {
    for rail in rails {
        let below_top = depth + rail.datum_depth;
        if rail.datum_depth.abs() > NEAR_TOP && !(DEPTHS[0]..=DEPTHS[1]).contains(&below_top) {
            return Err(ProfileError::Datum {
                rail: rail.name.clone(),
                top: rail.datum_depth,
                depth,
            });
        }
    }
    // Wheels without flanges fit everywhere.
    let clearance = flangeway_clearance(wheels, rails, tape_distance, gauge, depth);
    match clearance.is_none_or(|clearance| clearance > 0.0) {
        true => Ok(()),
        false => Err(ProfileError::WiderThanGauge {
            wheel: wheels[0].name.clone(),
            rail: rails[0].name.clone(),
            span: gauge - 2.0 * clearance.unwrap_or_default(),
            gauge,
        }),
    }
}

//! Wheels and rails on the command line: profiles, radii and distances, for both sides or for each.

use std::f64::consts::PI;
use std::path::Path;
use std::sync::Arc;

use clap::{Args, ValueEnum};
use quantity::{INCH, Kind as Measure, Quantity};
use wheelrail::contact::Side;
use wheelrail::hertz::Material;
use wheelrail::profile::{
    Profile, ProfileError, ProfileKind, ProfileNotice, ReadOptions, SlicedProfile, TAPE_FROM_BACK,
    WheelDatum, flangeway_clearance, names, nominal,
};
use wheelrail::wheelset::{Layout, RigidWheelset};

use crate::failure::{Failure, Message, say};

/// Sides by index: left, right.
pub(super) const SIDES: [Side; 2] = [Side::Left, Side::Right];
const WORDS: [&str; 2] = ["left", "right"];

/// Wheels and rails, and where they are.
#[derive(Debug, Args)]
pub(super) struct WheelRailPair {
    /// Profile of the wheels
    wheel: String,
    /// Profile of the rails
    rail: String,
    /// Profile of the left wheel, where it is not WHEEL
    #[arg(long, value_name = "WHEEL")]
    left_wheel: Option<String>,
    /// Profile of the right wheel, where it is not WHEEL
    #[arg(long, value_name = "WHEEL")]
    right_wheel: Option<String>,
    /// Profile of the left rail, where it is not RAIL
    #[arg(long, value_name = "RAIL")]
    left_rail: Option<String>,
    /// Profile of the right rail, where it is not RAIL
    #[arg(long, value_name = "RAIL")]
    right_rail: Option<String>,
    /// Gauge
    #[arg(long, default_value = "56.5 in", value_parser = length)]
    gauge: Quantity,
    /// Depth below the datum of the rail, z = 0 of its file, at which gauge is measured [default: that of the
    /// file; 5/8 in; 14 mm for rails from .prr]
    #[arg(long, value_name = "DEPTH", value_parser = length)]
    gauge_depth: Option<Quantity>,
    /// Distance of the tape circles of the wheels [default: that of the file; 59.5 in; 1500 mm for wheels
    /// from .prw and those whose tape circle lies 70 mm from the back of the flange]
    #[arg(long, value_name = "DISTANCE", value_parser = length)]
    tape_distance: Option<Quantity>,
    /// Nominal radius of the wheels [default: that of the file; 18 in; 460 mm for wheels from .prw]
    #[arg(long, value_parser = length)]
    radius: Option<Quantity>,
    /// Nominal radius of the left wheel, where it is another one
    #[arg(long, value_name = "RADIUS", value_parser = length)]
    left_radius: Option<Quantity>,
    /// Nominal radius of the right wheel, where it is another one
    #[arg(long, value_name = "RADIUS", value_parser = length)]
    right_radius: Option<Quantity>,
    /// Where y = 0 of wheels from files lies [default: as the file says; tape]
    #[arg(long, value_enum)]
    datum: Option<Datum>,
    /// Distance of the tape circle from the back of the flange [default: that of the file; 70 mm]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    tape_from_back: Option<Quantity>,
    /// Place along a rail from .slcs; left out, a run takes the whole rail, with its places along the track
    #[arg(long, value_name = "LENGTH", value_parser = any_length, allow_hyphen_values = true)]
    at: Option<Quantity>,
    /// Angle around a wheel from .slcw
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    wheel_angle: Option<Quantity>,
    /// Inclination of the rails, such as 1:40 or 0 [default: 1:40 for nominal rails, 0 for files]
    #[arg(long, value_name = "SLOPE", value_parser = slope)]
    inclination: Option<f64>,
    /// Largest distance of splines from the points of a file [default: 0.02 mm; 0 for contact]
    #[arg(long, value_name = "LENGTH", value_parser = length_or_zero)]
    deviation: Option<Quantity>,
    /// Largest lateral shift
    #[arg(long, value_name = "SHIFT", default_value = "0.5 in", value_parser = length)]
    pub(super) shift: Quantity,
}

/// The datum of the points of a wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Datum {
    /// The tape circle
    Tape,
    /// The back of the flange
    FlangeBack,
}

/// Wheels and rails, left and right, as read.
#[derive(Debug)]
pub(super) struct ProfiledPair {
    /// Wheels.
    pub(super) wheels: [Profile; 2],
    /// Rails, inclined.
    pub(super) rails: [Profile; 2],
    /// Nominal radii, m.
    pub(super) radii: [f64; 2],
    /// Distances.
    pub(super) layout: Layout,
    /// Rails whose sections change, and the place at which they are taken (m).
    pub(super) sliced: [Option<(SlicedProfile, f64)>; 2],
    /// Rails whose sections change along the track, as runs take them.
    pub(super) over: [Option<Arc<SlicedProfile>>; 2],
}

impl ProfiledPair {
    /// Returns whether both sides are alike.
    pub(super) fn is_symmetric(&self) -> bool {
        let [left, right] = self.radii;
        self.wheels[0] == self.wheels[1] && self.rails[0] == self.rails[1] && left == right
    }

    /// Returns the flangeway clearance to each side, m; none without flanges.
    pub(super) fn flangeway_clearance(&self) -> Option<f64> {
        let Layout {
            tape_distance,
            gauge,
            gauge_depth,
        } = self.layout;
        flangeway_clearance(
            self.wheels.each_ref(),
            self.rails.each_ref(),
            tape_distance,
            gauge,
            gauge_depth,
        )
    }

    /// Returns the rigid wheelset on its rails.
    pub(super) fn rigid(&self, material: Material) -> Result<RigidWheelset, Failure> {
        let ([left, right], [left_rail, right_rail]) = (&self.wheels, &self.rails);
        RigidWheelset::new(
            [left, right],
            self.radii,
            [left_rail, right_rail],
            self.layout,
            material,
        )
        .map_err(|error| wrong(&error))
    }
}

pub(super) fn length(text: &str) -> Result<Quantity, String> {
    let quantity = length_or_zero(text)?;
    if quantity.to_si() > 0.0 {
        Ok(quantity)
    } else {
        Err("it must be positive".to_owned())
    }
}

fn length_or_zero(text: &str) -> Result<Quantity, String> {
    let quantity = any_length(text)?;
    if quantity.to_si() >= 0.0 && quantity.to_si() < 10.0 {
        Ok(quantity)
    } else {
        Err("it must lie between 0 and 10 m".to_owned())
    }
}

fn any_length(text: &str) -> Result<Quantity, String> {
    Quantity::parse_as(text, Measure::Length).map_err(|error| error.to_string())
}

fn angle(text: &str) -> Result<Quantity, String> {
    let quantity = Quantity::parse_as(text, Measure::Angle).map_err(|error| error.to_string())?;
    match quantity.to_si().abs() <= 2.0 * PI {
        true => Ok(quantity),
        false => Err("it must lie within one turn".to_owned()),
    }
}

/// Returns a slope as a ratio (1:40) or a number.
fn slope(text: &str) -> Result<f64, String> {
    names::slope(text).ok_or_else(|| "write for example 1:40 or 0.025, between -0.5 and 0.5".to_owned())
}

/// Default of the largest distance of splines from the points of a file, m.
pub(super) const DEVIATION: f64 = 2e-5;

pub(super) fn wrong(error: &ProfileError) -> Failure {
    Message::new(error.to_string(), error.remedy()).into()
}

/// Tells doubts about a file.
fn warn(notices: &[ProfileNotice]) {
    for notice in notices {
        say(&format!("warning: {}; {}", notice.text, notice.advice));
    }
}

/// Simpack's files mostly hold European profiles.
fn is_simpack(name: &str) -> bool {
    let extension = Path::new(name)
        .extension()
        .and_then(|extension| extension.to_str());
    extension.is_some_and(|own| own.eq_ignore_ascii_case("prw") || own.eq_ignore_ascii_case("prr"))
}

impl WheelRailPair {
    /// Returns the names of wheel and rail; where both sides differ, both names.
    pub(super) fn names(&self) -> [String; 2] {
        [self.wheels(), self.rails()].map(|[left, right]| match left == right {
            true => left.to_owned(),
            false => format!("{left} (left), {right} (right)"),
        })
    }

    fn wheels(&self) -> [&str; 2] {
        [&self.left_wheel, &self.right_wheel].map(|own| own.as_deref().unwrap_or(&self.wheel))
    }

    fn rails(&self) -> [&str; 2] {
        [&self.left_rail, &self.right_rail].map(|own| own.as_deref().unwrap_or(&self.rail))
    }

    /// Reads the profiles and tells what is doubtful about them; splines lie at most `deviation` (m) from
    /// their points if nothing is given.
    pub(super) fn read(&self, deviation: f64) -> Result<ProfiledPair, Failure> {
        self.read_over(deviation, false)
    }

    /// The same; with `over` lists of sections of rails without a place in them go along the track.
    pub(super) fn read_over(&self, deviation: f64, over: bool) -> Result<ProfiledPair, Failure> {
        let deviation = self.deviation.as_ref().map_or(deviation, Quantity::to_si);
        let options = |side: Option<Side>| ReadOptions {
            deviation,
            datum: self.datum.map(|datum| match datum {
                Datum::Tape => WheelDatum::Tape,
                Datum::FlangeBack => WheelDatum::FlangeBack,
            }),
            tape_from_back: self.tape_from_back.as_ref().map(Quantity::to_si),
            side,
        };
        let (names, rail_names) = (self.wheels(), self.rails());
        let given = [self.left_wheel.is_some(), self.right_wheel.is_some()];
        let own = |side: usize, given: [bool; 2]| given[side].then_some(SIDES[side]);
        let left = self.wheel(names[0], &options(own(0, given)))?;
        let right = match given {
            [false, false] => left.clone(),
            _ => self.wheel(names[1], &options(own(1, given)))?,
        };
        let given = [self.left_rail.is_some(), self.right_rail.is_some()];
        let left_rail = self.rail(rail_names[0], &options(own(0, given)), over)?;
        let right_rail = match given {
            [false, false] => left_rail.clone(),
            _ => self.rail(rail_names[1], &options(own(1, given)), over)?,
        };
        let wheels = [left, right];
        let over = [&left_rail, &right_rail].map(|own| own.over.clone());
        let sliced = [left_rail.placed, right_rail.placed];
        let rails = [left_rail.profile, right_rail.profile];
        let usual = |given: Option<f64>, stated: Option<f64>, simpack: bool, usual: [f64; 2]| {
            given.or(stated).unwrap_or(usual[usize::from(!simpack)])
        };
        let metric = is_simpack(names[0])
            || wheels[0]
                .flange_back()
                .is_some_and(|back| (back + TAPE_FROM_BACK).abs() < 1e-6);
        let layout = Layout {
            tape_distance: usual(
                self.tape_distance.as_ref().map(Quantity::to_si),
                wheels[0].stated().tape_distance,
                metric,
                [1.5, nominal::TAPE_DISTANCE],
            ),
            gauge: self.gauge.to_si(),
            gauge_depth: usual(
                self.gauge_depth.as_ref().map(Quantity::to_si),
                rails[0].stated().gauge_depth,
                is_simpack(rail_names[0]),
                [14e-3, nominal::GAUGE_DEPTH],
            ),
        };
        let radii = [0, 1].map(|side| {
            let own = [&self.left_radius, &self.right_radius][side].as_ref();
            let given = own.or(self.radius.as_ref()).map(Quantity::to_si);
            usual(
                given,
                wheels[side].stated().radius,
                is_simpack(names[side]),
                [0.46, 18.0 * INCH],
            )
        });
        Ok(ProfiledPair {
            wheels,
            rails,
            radii,
            layout,
            sliced,
            over,
        })
    }

    fn wheel(&self, name: &str, options: &ReadOptions) -> Result<Profile, Failure> {
        let path = Path::new(name);
        if SlicedProfile::kind_of(path) == Some(ProfileKind::Wheel) && path.exists() {
            let sliced = sliced(path, options)?;
            let Some(angle) = &self.wheel_angle else {
                return Err(not_placed(&sliced, "--wheel-angle \"0 deg\""));
            };
            return sliced.at(angle.to_si()).map_err(|error| wrong(&error));
        }
        match names::wheel(name) {
            Ok(Some(wheel)) => Ok(wheel),
            Ok(None) => of_file(name, ProfileKind::Wheel, options),
            Err(_) if path.exists() => of_file(name, ProfileKind::Wheel, options),
            Err(error) => Err(wrong(&error)),
        }
    }

    fn rail(&self, name: &str, options: &ReadOptions, over: bool) -> Result<ReadRail, Failure> {
        let path = Path::new(name);
        let slope = |usual: f64| self.inclination.unwrap_or(usual);
        let (rail, usual, sliced) = match names::rail(name) {
            _ if SlicedProfile::kind_of(path) == Some(ProfileKind::Rail) && path.exists() => {
                let sliced = sliced(path, options)?;
                let Some(at) = &self.at else {
                    let Some(first) = sliced.profiles().first().filter(|_| over) else {
                        return Err(not_placed(&sliced, "--at \"0.5 m\""));
                    };
                    let slope = slope(0.0);
                    return Ok(ReadRail {
                        profile: first.inclined(slope),
                        placed: None,
                        over: Some(Arc::new(sliced.inclined(slope))),
                    });
                };
                let place = at.to_si();
                (
                    sliced.at(place).map_err(|error| wrong(&error))?,
                    0.0,
                    Some((sliced, place)),
                )
            }
            Ok(Some((rail, usual))) => (rail, usual, None),
            Err(error) if !path.exists() => return Err(wrong(&error)),
            _ => (of_file(name, ProfileKind::Rail, options)?, 0.0, None),
        };
        let profile = match slope(usual) {
            0.0 => rail,
            slope => rail.inclined(slope),
        };
        Ok(ReadRail {
            profile,
            placed: sliced,
            over: None,
        })
    }
}

/// A rail as read.
#[derive(Clone)]
struct ReadRail {
    profile: Profile,
    /// The list of sections it comes from, and the place in it, m.
    placed: Option<(SlicedProfile, f64)>,
    /// The list of sections that go along the track.
    over: Option<Arc<SlicedProfile>>,
}

fn sliced(path: &Path, options: &ReadOptions) -> Result<SlicedProfile, Failure> {
    let sliced = SlicedProfile::read(path, options).map_err(|error| wrong(&error))?;
    warn(sliced.notices());
    Ok(sliced)
}

fn not_placed(sliced: &SlicedProfile, option: &str) -> Failure {
    let places = sliced.places();
    let (first, last) = (places.first().copied(), places.last().copied());
    let message = format!(
        "{} has {} sections, from {} to {} {}",
        sliced.name(),
        places.len(),
        first.unwrap_or_default(),
        last.unwrap_or_default(),
        if sliced.kind() == ProfileKind::Rail {
            "m"
        } else {
            "rad"
        }
    );
    Message::new(message, format!("say which one is meant: {option}")).into()
}

fn of_file(name: &str, kind: ProfileKind, options: &ReadOptions) -> Result<Profile, Failure> {
    let path = Path::new(name);
    if !path.exists() {
        return Err(wrong(&names::unknown(name, kind)));
    }
    let profile = Profile::read_with(path, kind, options).map_err(|error| wrong(&error))?;
    warn(profile.notices());
    Ok(profile)
}

/// Returns the side's word, left or right.
pub(super) fn word(side: usize) -> &'static str {
    WORDS[side]
}

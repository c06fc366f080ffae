//! Profiles that change along the rail or around the wheel: CONTACT's `.slcs` and `.slcw`.
//!
//! A list of places and files: four lines with offset and scale of the places, number of slices, numbers of
//! features and kinks, kind of interpolation; then a line `place 'file'` for each slice. Places are scale ×
//! (place + offset): mm along the rail, rad around the wheel, and grow. Files lie beside the list. After `%`
//! comes a comment. Source: the program CONTACT's reader (its open source, 2008 to 2025).
//!
//! Between two slices the section is linear: points at equal shares of the lengths of both curves are joined
//! by straight lines, for the part that is not steeper than 82° and for what lies on each side of it.
//! Features, at which CONTACT ties slices together, are not read; a list that has them is doubted.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use input::file::Expected;
use input::{FileType, Separated, limits, shortened};

use super::points::{line_error, number_of};
use super::{
    Points, Profile, ProfileCurve, ProfileError, ProfileKind, ProfileNotice, ReadOptions, visible_from,
    zero_of,
};

/// Most slices of a list.
const MOST: usize = 2000;
/// Spacing of the points of a section between slices, m.
const SPACING: f64 = 2.5e-4;
/// Smallest distance of two slices, mm or rad: that of CONTACT.
const SMALLEST: f64 = 1e-3;
const FORM: &str = "a list of slices has four lines: offset and scale; number of slices; numbers of \
                    features, kinks and accelerations; 1 or 2 for the interpolation; then lines such as: \
                    0.5 'rail_a.prr'";

/// A slice as a list names it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedSlice {
    /// Its place: m along the rail, rad around the wheel.
    pub place: f64,
    /// Its file.
    pub file: String,
    /// Its line in the list, from 1.
    pub line: usize,
}

/// Profiles at places of a rail or a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct SlicedProfile {
    name: String,
    kind: ProfileKind,
    places: Vec<f64>,
    profiles: Vec<Arc<Profile>>,
    notices: Vec<ProfileNotice>,
}

impl SlicedProfile {
    /// Returns the kind of the list that a file's extension names: a rail for `.slcs`, a wheel for `.slcw`.
    #[must_use]
    pub fn kind_of(path: &Path) -> Option<ProfileKind> {
        let extension = path.extension().and_then(|extension| extension.to_str())?;
        match extension.to_ascii_lowercase().as_str() {
            "slcs" => Some(ProfileKind::Rail),
            "slcw" => Some(ProfileKind::Wheel),
            _ => None,
        }
    }

    /// Returns rail profiles at places along the track (m), which must rise; `name` is what messages call it.
    ///
    /// # Errors
    /// There is no profile, or the places do not rise.
    pub fn of_rails(name: &str, slices: Vec<(f64, Arc<Profile>)>) -> Result<Self, ProfileError> {
        Self::of(name, ProfileKind::Rail, "place of a rail's section (m)", slices)
    }

    /// Returns wheel profiles at angles around the wheel (rad), which must rise; `name` is what messages
    /// call it.
    ///
    /// # Errors
    /// There is no profile, or the angles do not rise.
    pub fn of_wheels(name: &str, slices: Vec<(f64, Arc<Profile>)>) -> Result<Self, ProfileError> {
        Self::of(
            name,
            ProfileKind::Wheel,
            "angle of a wheel's section (rad)",
            slices,
        )
    }

    fn of(
        name: &str,
        kind: ProfileKind,
        what: &'static str,
        slices: Vec<(f64, Arc<Profile>)>,
    ) -> Result<Self, ProfileError> {
        let (places, profiles): (Vec<f64>, Vec<Arc<Profile>>) = slices.into_iter().unzip();
        let rises = places
            .windows(2)
            .find(|pair| pair[1] <= pair[0] || pair[1].is_nan());
        if let Some(value) = rises
            .map(|pair| pair[1])
            .or(places.is_empty().then_some(f64::NAN))
        {
            let must = "more than that of the one before";
            return Err(ProfileError::Number { what, value, must });
        }
        Ok(Self {
            name: name.to_owned(),
            kind,
            places,
            profiles,
            notices: Vec::new(),
        })
    }

    /// Reads a list and its files.
    ///
    /// # Errors
    /// The list or one of its files is not read, or the places do not grow.
    pub fn read(path: &Path, options: &ReadOptions) -> Result<Self, ProfileError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::read_with(path, options, |file| Ok(folder.join(file)))
    }

    /// The same with files that lie where `locate` says.
    ///
    /// # Errors
    /// As [`SlicedProfile::read`], or those of `locate`.
    pub fn read_with<E: From<ProfileError>>(
        path: &Path,
        options: &ReadOptions,
        mut locate: impl FnMut(&str) -> Result<PathBuf, E>,
    ) -> Result<Self, E> {
        let kind = Self::kind_of(path).ok_or_else(|| ProfileError::UnknownFile {
            path: path.to_owned(),
        })?;
        let expected = Expected {
            what: "list of slices",
            types: &[FileType::Profile],
            most: limits::TEXT_FILE,
        };
        let text = input::file::read_text(path, &expected).map_err(ProfileError::from)?;
        let name = path.display().to_string();
        let (slices, features) = Self::list(&name, &text, kind)?;
        let mut read = Self {
            name: name.clone(),
            kind,
            places: Vec::with_capacity(slices.len()),
            profiles: Vec::with_capacity(slices.len()),
            notices: Vec::new(),
        };
        if features > 1 {
            read.notices.push(ProfileNotice {
                text: format!(
                    "{name}: the {features} features that tie slices together are left aside; points at \
                     equal shares of the slices' lengths are"
                ),
                advice:
                    "compare sections between slices with what you expect, or give slices closer together"
                        .into(),
            });
        }
        for slice in slices {
            let profile = Profile::read_with(&locate(&slice.file)?, kind, options)?;
            read.notices.extend(profile.notices().iter().cloned());
            read.places.push(slice.place);
            read.profiles.push(Arc::new(profile));
        }
        Ok(read)
    }

    /// Returns the slices that a list names, and its number of features; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong, the places do not grow, or there are too many.
    pub fn list(name: &str, text: &str, kind: ProfileKind) -> Result<(Vec<NamedSlice>, usize), ProfileError> {
        let wrong = |line: usize, found: String| line_error(name, line, found, FORM);
        let lines = text.lines().enumerate().map(|(index, line)| {
            let line = line.split('%').next().unwrap_or("").trim();
            (index + 1, line)
        });
        let mut lines = lines.filter(|(_, line)| !line.is_empty());
        let mut header = |numbers: usize| {
            let last = text.lines().count().max(1);
            let (line, row) = lines
                .next()
                .ok_or_else(|| wrong(last, "the list ends within its header".into()))?;
            let cells = row
                .split([' ', '\t', ','])
                .filter(|cell| !cell.is_empty())
                .take(numbers);
            let read: Result<Vec<f64>, _> = cells
                .map(|cell| number_of(&mut Separated::of(""), name, line, cell))
                .collect();
            let read = read?;
            match read.len() == numbers {
                true => Ok((line, read)),
                false => Err(wrong(line, format!("{numbers} numbers are expected here"))),
            }
        };
        let (_, scaling) = header(2)?;
        let (line, count) = header(1)?;
        if !(count[0] >= 1.0 && count[0] <= MOST as f64 && count[0].fract() == 0.0) {
            return Err(wrong(
                line,
                format!("a list has 1 to {MOST} slices, not {}", count[0]),
            ));
        }
        let (_, features) = header(2)?;
        header(1)?;
        let count = count[0] as usize;
        let unit = if kind == ProfileKind::Rail { 1e-3 } else { 1.0 };
        let mut slices: Vec<NamedSlice> = Vec::new();
        for (line, row) in lines.by_ref().take(count) {
            let quoted = ['\'', '"'].into_iter().find_map(|quote| {
                let mut parts = row.splitn(3, quote);
                let (place, file, _) = (parts.next()?, parts.next()?, parts.next()?);
                Some((place.trim().trim_end_matches(','), file.trim()))
            });
            let Some((place, file)) = quoted.filter(|(_, file)| !file.is_empty()) else {
                return Err(wrong(line, format!("{} names no file in quotes", shortened(row))));
            };
            let place = scaling[1] * (number_of(&mut Separated::of(""), name, line, place)? + scaling[0]);
            let apart = slices
                .last()
                .map_or(f64::INFINITY, |last| place - last.place / unit);
            if apart.is_nan() || apart < SMALLEST {
                return Err(wrong(line, "the places of slices must grow".into()));
            }
            slices.push(NamedSlice {
                place: unit * place,
                file: file.to_owned(),
                line,
            });
        }
        match slices.len() == count {
            true => Ok((slices, features[0].clamp(0.0, 1e6) as usize)),
            false => Err(wrong(
                text.lines().count().max(1),
                format!("the list has {} slices; its header says {count}", slices.len()),
            )),
        }
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns whether it is a wheel or a rail.
    #[must_use]
    pub fn kind(&self) -> ProfileKind {
        self.kind
    }

    /// Returns the places of its slices: m along the rail, rad around the wheel.
    #[must_use]
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Returns the profiles of its slices.
    #[must_use]
    pub fn profiles(&self) -> &[Arc<Profile>] {
        &self.profiles
    }

    /// Returns the same with all places moved, m along the rail or rad around the wheel.
    #[must_use]
    pub fn from(mut self, place: f64) -> Self {
        self.places.iter_mut().for_each(|own| *own += place);
        self
    }

    /// Returns the same with all profiles moved, m.
    #[must_use]
    pub fn moved(&self, shift: [f64; 2]) -> Self {
        self.changed(|profile| profile.moved(shift))
    }

    /// Returns the same with all profiles inclined towards the track's center (a slope).
    #[must_use]
    pub fn inclined(&self, slope: f64) -> Self {
        self.changed(|profile| profile.inclined(slope))
    }

    fn changed(&self, change: impl Fn(&Profile) -> Profile) -> Self {
        let mut profiles: Vec<Arc<Profile>> = Vec::with_capacity(self.profiles.len());
        for (i, profile) in self.profiles.iter().enumerate() {
            // Slices that share a profile go on to share it.
            let mut before = self.profiles[..i].iter();
            profiles.push(match before.position(|other| Arc::ptr_eq(profile, other)) {
                Some(known) => profiles[known].clone(),
                None => Arc::new(change(profile)),
            });
        }
        Self {
            profiles,
            ..self.clone()
        }
    }

    /// Returns the doubts about the list and its files.
    #[must_use]
    pub fn notices(&self) -> &[ProfileNotice] {
        &self.notices
    }

    /// Returns the slices around a place and how far it lies from the first to the second one.
    fn around(&self, place: f64) -> Result<(usize, usize, f64), ProfileError> {
        let last = self.places.len() - 1;
        let (low, high) = (self.places[0], self.places[last]);
        let outside = || ProfileError::NoSlice {
            name: self.name.clone(),
            place,
            range: [low, high],
            of_wheel: self.kind == ProfileKind::Wheel,
        };
        let mut place = place;
        if self.kind == ProfileKind::Wheel {
            // A turn brings the wheel back; the gap behind the last slice leads to the first one.
            place -= TAU * libm::floor((place + PI) / TAU);
            if place < low || place > high {
                let gap = low + TAU - high;
                let from_last = if place > high {
                    place - high
                } else {
                    place + TAU - high
                };
                return if gap > 0.0 && from_last <= gap {
                    Ok((last, 0, from_last / gap))
                } else {
                    Err(outside())
                };
            }
        }
        if !(place >= low && place <= high) {
            return Err(outside());
        }
        let next = self.places.partition_point(|own| *own <= place).min(last);
        let before = next.saturating_sub(1);
        if before == next {
            return Ok((0, 0, 0.0));
        }
        let share = (place - self.places[before]) / (self.places[next] - self.places[before]);
        Ok((before, next, share))
    }

    /// Returns the profile at a place: m along the rail, rad around the wheel.
    ///
    /// # Errors
    /// There is no slice on both sides of it, or the section there is no profile.
    pub fn at(&self, place: f64) -> Result<Profile, ProfileError> {
        let (before, next, share) = self.around(place)?;
        if share == 0.0 || share == 1.0 {
            return Ok(Profile::clone(
                &self.profiles[if share == 0.0 { before } else { next }],
            ));
        }
        let curves = [before, next].map(|slice| self.profiles[slice].curve());
        let anchors = curves.map(anchors);
        let mut points: Vec<[f64; 2]> = Vec::new();
        for part in 0..3 {
            let length = anchors.map(|own| own[part + 1] - own[part]);
            let count = libm::ceil(length[0].max(length[1]) / SPACING) as usize;
            let first = usize::from(!points.is_empty());
            points.extend((first..=count).map(|i| {
                let along = i as f64 / count.max(1) as f64;
                let [a, b] = [0, 1].map(|k| curves[k].at(anchors[k][part] + along * length[k]).position);
                [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]))
            }));
        }
        let unit = if self.kind == ProfileKind::Rail {
            "m"
        } else {
            "rad"
        };
        let name = format!("{} at {place} {unit}", self.name);
        let mut points = Points::new(&name, &points);
        points.stated = self.profiles[before].stated();
        Profile::of_points(&points, self.kind, 0.0)
    }

    /// Returns the height of a rail's top at a place (m) above that of its first slice, m; beyond the ends
    /// that of the end.
    #[must_use]
    pub fn top_at(&self, place: f64) -> f64 {
        let [low, high] = [0, self.places.len() - 1].map(|k| self.places[k]);
        let Ok((before, next, share)) = self.around(place.clamp(low, high)) else {
            return 0.0;
        };
        let [first, before, next] = [0, before, next].map(|k| self.profiles[k].top()[1]);
        before + share * (next - before) - first
    }

    /// Returns how fast the surface at y (m) rises along the rail (m/m), or around the wheel (m/rad), at a
    /// place; none beside the points.
    ///
    /// # Errors
    /// There is no slice on both sides of the place.
    pub fn rise(&self, place: f64, y: f64) -> Result<Option<f64>, ProfileError> {
        let (before, next, _) = self.around(place)?;
        let heights = [before, next].map(|slice| height(&self.profiles[slice], y));
        let mut length = self.places[next] - self.places[before];
        if length < 0.0 {
            length += TAU;
        }
        Ok(match heights {
            [Some(from), Some(to)] if length > 0.0 => Some((to - from) / length),
            [Some(_), Some(_)] => Some(0.0),
            _ => None,
        })
    }
}

/// Returns the parameters of a curve's beginning, of both ends of its visible part, and of its end.
fn anchors(curve: &ProfileCurve) -> [f64; 4] {
    let [start, end] = curve.range();
    let [low, high] = zero_of(curve).map_or([start, end], |zero| visible_from(curve, zero));
    [start, low, high, end]
}

/// Returns the largest z (m) of a profile at y (m).
fn height(profile: &Profile, y: f64) -> Option<f64> {
    let sample = profile.curve().sample(SPACING);
    let heights = sample.windows(2).filter_map(|pair| {
        let [[y0, z0], [y1, z1]] = [pair[0].1.position, pair[1].1.position];
        ((y0 <= y) != (y1 <= y)).then(|| z0 + (y - y0) * (z1 - z0) / (y1 - y0))
    });
    heights.reduce(f64::max)
}

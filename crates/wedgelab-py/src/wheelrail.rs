//! Wheel on rail and track over arrays: profiles, contact of a loaded wheelset, creep forces, conicity,
//! tracks.

use std::path::PathBuf;
use std::sync::Arc;

use ::wheelrail::conicity::RollingRadiusDifference;
use ::wheelrail::contact::{ContactLaw, CreepLaw, PatchForm, Side};
use ::wheelrail::creep::fastsim::StripGrid;
use ::wheelrail::creep::{Coefficients, Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins};
use ::wheelrail::friction::Friction;
use ::wheelrail::hertz::Material;
use ::wheelrail::loaded::{Attitude, LoadError, LoadedPatch, LoadedWheel};
use ::wheelrail::profile::{
    Points, Profile, ProfileError, ProfileKind, ReadOptions, WheelDatum, names, nominal,
};
use ::wheelrail::wheelset::{Layout, RigidWheelset};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use study::track::TrackFile;

use crate::errors::{case_error, guarded, simple};

type Array<'py> = Bound<'py, PyArray1<f64>>;
type Given<'py> = PyReadonlyArray1<'py, f64>;

/// Most patches of a wheel: three areas, each as a whole and in two parts.
const PATCHES: usize = 9;
/// Numbers of a patch.
const OF_PATCH: usize = 13;
/// Numbers of a wheel: center, height, lateral and vertical force.
const OF_WHEEL: usize = 4;
/// The advice where there is no conicity.
const WHERE_TO_LOOK: &str = "look at gauge, tape distance and amplitude";
/// Numbers of a track at a distance.
const OF_TRACK: usize = 17;

fn refused(py: Python<'_>, message: &str, help: &str) -> PyErr {
    simple(py, "WheelRailError", message, help)
}

fn of_profile(py: Python<'_>, error: &ProfileError) -> PyErr {
    refused(py, &error.to_string(), &error.remedy())
}

/// Errors of points by their numbers: message and help.
type Failed = Vec<(usize, String, String)>;

/// A profile of a wheel or a rail.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeProfile")]
pub struct NativeProfile {
    profile: Arc<Profile>,
}

impl NativeProfile {
    fn of(py: Python<'_>, made: Result<Profile, ProfileError>) -> PyResult<Self> {
        let profile = Arc::new(made.map_err(|error| of_profile(py, &error))?);
        Ok(Self { profile })
    }
}

fn kind(wheel: bool) -> ProfileKind {
    if wheel {
        ProfileKind::Wheel
    } else {
        ProfileKind::Rail
    }
}

#[pymethods]
impl NativeProfile {
    #[staticmethod]
    fn read(
        py: Python<'_>,
        path: PathBuf,
        wheel: bool,
        deviation: f64,
        flange_back: Option<bool>,
        tape_from_back: Option<f64>,
    ) -> PyResult<Self> {
        let options = ReadOptions {
            deviation,
            datum: flange_back.map(|back| match back {
                true => WheelDatum::FlangeBack,
                false => WheelDatum::Tape,
            }),
            tape_from_back,
            side: None,
        };
        guarded(py, || {
            Self::of(py, Profile::read_with(&path, kind(wheel), &options))
        })
    }

    #[staticmethod]
    fn of_points(py: Python<'_>, y: Given<'_>, z: Given<'_>, wheel: bool, deviation: f64) -> PyResult<Self> {
        let (y, z) = (y.as_slice()?, z.as_slice()?);
        if y.len() != z.len() {
            return Err(PyValueError::new_err("the arrays differ in length"));
        }
        let points: Vec<[f64; 2]> = y.iter().zip(z).map(|(y, z)| [*y, *z]).collect();
        let points = Points::new("points", &points);
        guarded(py, || {
            Self::of(py, Profile::of_points(&points, kind(wheel), deviation))
        })
    }

    #[staticmethod]
    fn nominal(py: Python<'_>, name: &str) -> PyResult<Self> {
        guarded(py, || {
            let made = match names::rail(name) {
                Ok(Some((rail, _))) => return Self::of(py, Ok(rail)),
                Err(error) => return Self::of(py, Err(error)),
                Ok(None) => names::wheel(name),
            };
            match made {
                Ok(Some(wheel)) => Self::of(py, Ok(wheel)),
                Err(error) => Self::of(py, Err(error)),
                Ok(None) => Err(refused(
                    py,
                    &format!("there is no nominal profile {name:?}"),
                    &format!("wheels are {}; rails are {}", names::WHEELS, names::RAILS),
                )),
            }
        })
    }

    #[staticmethod]
    fn cone(py: Python<'_>, slope: f64, half_width: f64) -> PyResult<Self> {
        guarded(py, || Self::of(py, nominal::cone(slope, half_width)))
    }

    fn inclined(&self, slope: f64) -> Self {
        Self {
            profile: Arc::new(self.profile.inclined(slope)),
        }
    }

    #[getter]
    fn name(&self) -> String {
        self.profile.name().to_owned()
    }

    #[getter]
    fn is_wheel(&self) -> bool {
        self.profile.kind() == ProfileKind::Wheel
    }

    #[getter]
    fn note(&self) -> String {
        self.profile.note().to_owned()
    }

    /// Doubts about its file: text and advice.
    #[getter]
    fn notices(&self) -> Vec<(String, String)> {
        let notices = self.profile.notices().iter();
        notices
            .map(|own| (own.text.clone(), own.advice.clone()))
            .collect()
    }

    #[getter]
    fn deviation(&self) -> f64 {
        self.profile.deviation().largest
    }

    /// y and z of points along the profile, m.
    fn sample<'py>(&self, py: Python<'py>, spacing: f64) -> PyResult<(Array<'py>, Array<'py>)> {
        if !(spacing >= 1e-6 && spacing.is_finite()) {
            return Err(refused(
                py,
                "the spacing of points must be 1 μm or more",
                "give for example \"0.5 mm\"",
            ));
        }
        let sample = self.profile.curve().sample(spacing);
        let column = |axis: usize| sample.iter().map(|(_, point)| point.position[axis]).collect();
        Ok((
            PyArray1::from_vec(py, column(0)),
            PyArray1::from_vec(py, column(1)),
        ))
    }
}

/// A wheelset on rails.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeWheelset")]
pub struct NativeWheelset {
    wheelset: RigidWheelset,
    layout: Layout,
}

/// Returns the columns of numbers that were given, and how long they are: all alike.
fn columns_of<'g>(given: &'g [Given<'_>; 7]) -> PyResult<(Vec<&'g [f64]>, usize)> {
    let columns: Vec<&[f64]> = given
        .iter()
        .map(|column| column.as_slice())
        .collect::<Result<_, _>>()?;
    let count = columns[0].len();
    if columns.iter().any(|column| column.len() != count) {
        return Err(PyValueError::new_err("the arrays differ in length"));
    }
    Ok((columns, count))
}

fn law_of(py: Python<'_>, name: &str, cells: usize) -> PyResult<CreepLaw> {
    Ok(match name {
        "linear" => CreepLaw::Linear,
        "shen_hedrick_elkins" => CreepLaw::ShenHedrickElkins,
        "polach" => CreepLaw::Polach(polach::DRY),
        "fastsim" => CreepLaw::Fastsim(StripGrid { cells, strips: cells }),
        _ => {
            let help = "creep laws are \"linear\", \"shen_hedrick_elkins\", \"polach\", \"fastsim\"";
            return Err(refused(py, &format!("there is no creep law {name:?}"), help));
        }
    })
}

/// Returns the attitude, load and law of a point of a question.
fn point(columns: &[&[f64]], k: usize, creep: CreepLaw) -> (Attitude, f64, ContactLaw) {
    let attitude = Attitude {
        lateral: columns[0][k],
        yaw: columns[1][k],
        roll: columns[2][k],
        speed: columns[3][k],
        pitch_rate: columns[4][k],
    };
    let law = ContactLaw {
        friction: Friction::constant(columns[6][k]),
        damping: 0.0,
        creep,
        slowest: 0.0,
    };
    (attitude, columns[5][k], law)
}

/// Returns the values of the points that have one; the errors of the others go to `failed`.
fn sorted<T>(made: Vec<Result<T, LoadError>>, failed: &mut Failed) -> Vec<Option<T>> {
    let entries = made.into_iter().enumerate();
    entries
        .map(|(k, one)| {
            one.map_err(|error| failed.push((k, error.to_string(), error.remedy())))
                .ok()
        })
        .collect()
}

fn numbers(patch: &LoadedPatch) -> [f64; OF_PATCH] {
    [
        patch.share,
        patch.y,
        patch.angle,
        patch.normal,
        patch.fx,
        patch.fy,
        patch.spin_moment,
        patch.creepage[0],
        patch.creepage[1],
        patch.spin,
        patch.axes[0],
        patch.axes[1],
        patch.greatest_pressure,
    ]
}

#[pymethods]
impl NativeWheelset {
    #[new]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        wheels: [PyRef<'_, NativeProfile>; 2],
        rails: [PyRef<'_, NativeProfile>; 2],
        gauge: f64,
        gauge_depth: f64,
        tape_distance: f64,
        radii: [f64; 2],
        shear_modulus: f64,
        poisson: f64,
        strips: bool,
    ) -> PyResult<Self> {
        let layout = Layout {
            tape_distance,
            gauge,
            gauge_depth,
        };
        let material = Material {
            youngs_modulus: 2.0 * shear_modulus * (1.0 + poisson),
            poisson,
        };
        guarded(py, || {
            let made = RigidWheelset::new(
                wheels.each_ref().map(|own| &*own.profile),
                radii,
                rails.each_ref().map(|own| &*own.profile),
                layout,
                material,
            );
            let form = if strips {
                PatchForm::Strips
            } else {
                PatchForm::Ellipse
            };
            let wheelset = made.map_err(|error| of_profile(py, &error))?.with_patches(form);
            Ok(Self { wheelset, layout })
        })
    }

    /// Returns the pitch rates (rad/s) at which the wheelset rolls freely, NaN where there is none, and the
    /// errors of those points; the given pitch rates do not count.
    fn free_rolling<'py>(
        &self,
        py: Python<'py>,
        given: [Given<'py>; 7],
        creep: &str,
        cells: usize,
    ) -> PyResult<(Array<'py>, Failed)> {
        let creep = law_of(py, creep, cells)?;
        let (columns, count) = columns_of(&given)?;
        let made: Vec<Result<f64, LoadError>> = guarded(py, || {
            Ok(py.detach(|| {
                (0..count)
                    .map(|k| {
                        let (attitude, load, law) = point(&columns, k, creep);
                        self.wheelset.free_rolling(&attitude, load, &law)
                    })
                    .collect()
            }))
        })?;
        let mut failed = Failed::new();
        let rates = sorted(made, &mut failed).into_iter();
        let rates = rates.map(|rate| rate.unwrap_or(f64::NAN)).collect();
        Ok((PyArray1::from_vec(py, rates), failed))
    }

    /// Returns the loaded wheels of one side. Arrays of one length in; out: numbers of patches (entry, patch,
    /// number) as one flat array, numbers of wheels (entry, number), the seats' names, and the errors of the
    /// points that have no wheel, whose numbers are NaN and whose seat is empty.
    #[allow(clippy::too_many_arguments)]
    fn contact<'py>(
        &self,
        py: Python<'py>,
        left: bool,
        given: [Given<'py>; 7],
        creep: &str,
        cells: usize,
    ) -> PyResult<(Array<'py>, Array<'py>, Vec<&'static str>, Failed)> {
        let creep = law_of(py, creep, cells)?;
        let (columns, count) = columns_of(&given)?;
        let side = if left { Side::Left } else { Side::Right };
        let made: Vec<Result<LoadedWheel, LoadError>> = guarded(py, || {
            Ok(py.detach(|| {
                (0..count)
                    .map(|k| {
                        let (attitude, load, law) = point(&columns, k, creep);
                        self.wheelset.loaded(side, &attitude, load, &law)
                    })
                    .collect()
            }))
        })?;
        let mut failed = Failed::new();
        let wheels = sorted(made, &mut failed);
        let mut patches = vec![f64::NAN; count * PATCHES * OF_PATCH];
        let mut whole = vec![f64::NAN; count * OF_WHEEL];
        let mut seats = vec![""; count];
        for (k, wheel) in wheels.iter().enumerate() {
            let Some(wheel) = wheel else { continue };
            for (j, patch) in wheel.patches.iter().take(PATCHES).enumerate() {
                let at = (k * PATCHES + j) * OF_PATCH;
                patches[at..at + OF_PATCH].copy_from_slice(&numbers(patch));
            }
            let own = [wheel.center, wheel.height, wheel.force[0], wheel.force[1]];
            whole[k * OF_WHEEL..][..OF_WHEEL].copy_from_slice(&own);
            seats[k] = wheel.seat.word();
        }
        Ok((
            PyArray1::from_vec(py, patches),
            PyArray1::from_vec(py, whole),
            seats,
            failed,
        ))
    }

    /// Rolling radius difference, contact angles left and right, and roll at lateral shifts (m, to the left);
    /// NaN where a wheel is not over its rail.
    fn positions<'py>(&self, py: Python<'py>, shifts: Given<'py>) -> PyResult<[Array<'py>; 4]> {
        let shifts = shifts.as_slice()?;
        let rows: Vec<[f64; 4]> = guarded(py, || {
            Ok(py.detach(|| {
                let row = |shift: &f64| {
                    self.wheelset
                        .position(*shift, 0.0)
                        .map_or([f64::NAN; 4], |found| {
                            let [left, right] = found.contact_angles();
                            [found.rolling_radius_difference(), left, right, found.roll]
                        })
                };
                shifts.iter().map(row).collect()
            }))
        })?;
        Ok([0, 1, 2, 3].map(|k: usize| PyArray1::from_vec(py, rows.iter().map(|row| row[k]).collect())))
    }

    /// Equivalent conicity after EN 15302 and by harmonic linearization at amplitudes (m), from a table of
    /// `count` positions up to `largest` (m); NaN where there is none, with the errors of those points.
    fn conicity<'py>(
        &self,
        py: Python<'py>,
        amplitudes: Given<'py>,
        largest: f64,
        count: usize,
    ) -> PyResult<([Array<'py>; 2], Failed)> {
        let amplitudes = amplitudes.as_slice()?;
        guarded(py, || {
            let wrong = |text: String| refused(py, &text, WHERE_TO_LOOK);
            let positions = self.wheelset.sweep(largest, count, false);
            let table = RollingRadiusDifference::of_positions(&positions)
                .map_err(|error| wrong(error.to_string()))?;
            let (radius, distance) = (self.wheelset.nominal_radius(), self.layout.tape_distance);
            let mut failed = Failed::new();
            let mut found = Vec::with_capacity(amplitudes.len());
            for (k, amplitude) in amplitudes.iter().enumerate() {
                let one = table.equivalent_conicity(*amplitude, radius, distance);
                found.push(match one {
                    Ok(found) => [found.by_wavelength, found.by_linearization],
                    Err(error) => {
                        failed.push((k, error.to_string(), WHERE_TO_LOOK.to_owned()));
                        [f64::NAN; 2]
                    }
                });
            }
            let column = |k: usize| PyArray1::from_vec(py, found.iter().map(|row| row[k]).collect());
            Ok(([0, 1].map(column), failed))
        })
    }
}

/// Creep forces over arrays of one length: semi-axes along and across (m), load (N), friction, creepages,
/// spin (1/m). Gives forces on the wheel along and across (N) and the spin moment (N m).
#[pyfunction]
pub fn creep_forces<'py>(
    py: Python<'py>,
    law: &str,
    given: [Given<'py>; 7],
    shear_modulus: f64,
    poisson: f64,
    cells: usize,
) -> PyResult<[Array<'py>; 3]> {
    let law = law_of(py, law, cells)?;
    let (columns, count) = columns_of(&given)?;
    let rows: Vec<[f64; 3]> = guarded(py, || {
        Ok(py.detach(|| {
            (0..count)
                .map(|k| {
                    let axes = [columns[0][k], columns[1][k]];
                    let patch = Patch {
                        axes,
                        load: columns[2][k],
                        friction: columns[3][k],
                        shear_modulus,
                        coefficients: Coefficients::of(axes[0] / axes[1], poisson),
                    };
                    let creepage = Creepage {
                        longitudinal: columns[4][k],
                        lateral: columns[5][k],
                        spin: columns[6][k],
                    };
                    let found = match law {
                        CreepLaw::ShenHedrickElkins => shen_hedrick_elkins::forces(&patch, &creepage),
                        CreepLaw::Polach(reduction) => polach::forces(&patch, &creepage, reduction),
                        CreepLaw::Fastsim(grid) => fastsim::forces(&patch, &creepage, grid),
                        CreepLaw::Linear | CreepLaw::Frictionless => linear::forces(&patch, &creepage),
                    };
                    [found.x, found.y, found.spin_moment]
                })
                .collect()
        }))
    })?;
    Ok([0, 1, 2].map(|k: usize| PyArray1::from_vec(py, rows.iter().map(|row| row[k]).collect())))
}

/// A track.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "NativeTrack")]
pub struct NativeTrack {
    file: TrackFile,
}

#[pymethods]
impl NativeTrack {
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        guarded(py, || {
            let file = TrackFile::read(&path).map_err(|error| case_error(py, &error))?;
            Ok(Self { file })
        })
    }

    #[staticmethod]
    fn parse(py: Python<'_>, text: &str, source: &str) -> PyResult<Self> {
        guarded(py, || {
            let file = TrackFile::parse(source, text).map_err(|error| case_error(py, &error))?;
            Ok(Self { file })
        })
    }

    #[getter]
    fn name(&self) -> String {
        self.file.name.clone()
    }

    #[getter]
    fn title(&self) -> String {
        self.file.title.clone()
    }

    #[getter]
    fn length(&self) -> f64 {
        self.file.track.center_line.length()
    }

    /// Returns the track at distances (m), a flat array (entry, number).
    fn sample<'py>(&self, py: Python<'py>, distances: Given<'py>) -> PyResult<Array<'py>> {
        let distances = distances.as_slice()?;
        let values: Vec<f64> = guarded(py, || {
            Ok(py.detach(|| distances.iter().flat_map(|distance| self.at(*distance)).collect()))
        })?;
        Ok(PyArray1::from_vec(py, values))
    }
}

impl NativeTrack {
    fn at(&self, distance: f64) -> [f64; OF_TRACK] {
        let station = self.file.track.center_line.at(distance);
        let [left, right] = self.file.track.rails(distance);
        let [x, y, z] = station.position;
        [
            x,
            y,
            z,
            station.heading,
            station.curvature[0],
            station.superelevation[0],
            station.grade,
            left.vertical[0],
            right.vertical[0],
            left.lateral[0],
            right.lateral[0],
            left.vertical[1],
            right.vertical[1],
            left.lateral[1],
            right.lateral[1],
            station.superelevation[0] + right.vertical[0] - left.vertical[0],
            left.lateral[0] - right.lateral[0],
        ]
    }
}

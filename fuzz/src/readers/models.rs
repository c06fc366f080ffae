//! Short runs of every model, whose saved states and folders are corpora.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use quantity::System as Units;
use rolling::rig::RigStart;
use rolling::wheelset::WheelsetBody;
use study::car::{self, CarCase};
use study::case::{Case, builtin};
use study::half_truck::files::Settings;
use study::half_truck::{HalfTruckCase, catalog};
use study::track::TrackFile;
use study::truck::{self, TruckCase};
use study::wheelset::{SearchMode, Wheelset, WheelsetCase};
use wheelrail::contact::{CreepLaw, PatchForm};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;
use wheelrail::wheelset::Layout;

const SHORT: [&str; 2] = ["simulation.duration=0.02 s", "simulation.output_interval=0.002 s"];

fn short() -> [String; 2] {
    SHORT.map(str::to_owned)
}

/// A short run of a yawed wedge.
pub fn wedge() -> Option<&'static Case> {
    static CASE: LazyLock<Option<Case>> =
        LazyLock::new(|| builtin::case_with("cdrun_toe_out_0.2_psi_0.012", &short()).ok());
    CASE.as_ref()
}

/// A short run of a truck.
pub fn truck() -> Option<&'static TruckCase> {
    static CASE: LazyLock<Option<TruckCase>> =
        LazyLock::new(|| truck::builtin::case_with("truck_vertical_constant_toe_out", &short()).ok());
    CASE.as_ref()
}

/// A short run of a half-truck.
pub fn half_truck() -> Option<&'static HalfTruckCase> {
    static CASE: LazyLock<Option<HalfTruckCase>> = LazyLock::new(|| {
        let settings = Settings {
            duration: Some(0.02),
            interval: 0.002,
            ..Settings::default()
        };
        let entry = catalog::entry("nucars_69_constant_toe_out")?;
        entry.case_with(&settings).ok()
    });
    CASE.as_ref()
}

/// A short run of a car.
pub fn car() -> Option<&'static CarCase> {
    static CASE: LazyLock<Option<CarCase>> =
        LazyLock::new(|| car::builtin::case_with("car_spiral_loaded", &short()).ok());
    CASE.as_ref()
}

/// A short run of a wheelset.
pub fn wheelset() -> Option<&'static WheelsetCase> {
    static CASE: LazyLock<Option<WheelsetCase>> = LazyLock::new(|| WheelsetCase::new(one_wheelset()?).ok());
    CASE.as_ref()
}

fn one_wheelset() -> Option<Wheelset> {
    let rail = nominal::rail_136re().ok()?.inclined(nominal::INCLINATION);
    Some(Wheelset {
        name: "wheelset".to_owned(),
        wheels: [nominal::aar_1b().ok()?, nominal::aar_1b().ok()?],
        rails_over: [None, None],
        forms: [None, None],
        rails: [rail.clone(), rail],
        radii: [0.4572; 2],
        layout: Layout {
            tape_distance: nominal::TAPE_DISTANCE,
            gauge: 1.4351,
            gauge_depth: nominal::GAUGE_DEPTH,
        },
        material: Material {
            youngs_modulus: 207e9,
            poisson: 0.28,
        },
        track: TrackFile::parse("straight.toml", "[[segments]]\ntangent = \"100 ft\"\n").ok()?,
        body: WheelsetBody {
            mass: 1250.0,
            about_axle: 150.0,
            about_diameter: 700.0,
        },
        axle_load: 2e5,
        speed: 15.0,
        stiffness: [2e6, 2e6],
        damping: [2e4, 2e3],
        friction: Friction::constant(0.4),
        creep: CreepLaw::Polach(polach::DRY),
        patch: PatchForm::Ellipse,
        search: SearchMode::Search,
        start: RigStart {
            distance: 2.0,
            lateral: 0.003,
            ..RigStart::default()
        },
        duration: Some(0.02),
        interval: 0.002,
        relative_tolerance: 1e-5,
        units: Units::Si,
        given: BTreeMap::new(),
    })
}

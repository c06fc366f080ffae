//! A wheelset that tests run.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;

use quantity::System as Units;
use rolling::rig::RigStart;
use rolling::wheelset::WheelsetBody;
use study::track::TrackFile;
use study::wheelset::{SearchMode, Wheelset};
use wheelrail::contact::{CreepLaw, PatchForm};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;
use wheelrail::wheelset::Layout;

const INCH: f64 = 0.0254;

/// Returns a wheelset with a carriage on a track (its file's text), at a speed (m/s).
pub fn wheelset(track: &str, speed: f64) -> Wheelset {
    Wheelset {
        name: "test".to_owned(),
        wheels: [nominal::aar_1b().unwrap(), nominal::aar_1b().unwrap()],
        rails_over: [None, None],
        forms: [None, None],
        rails: std::array::from_fn(|_| nominal::rail_136re().unwrap().inclined(nominal::INCLINATION)),
        radii: [18.0 * INCH; 2],
        layout: Layout {
            tape_distance: nominal::TAPE_DISTANCE,
            gauge: 56.5 * INCH,
            gauge_depth: nominal::GAUGE_DEPTH,
        },
        material: Material {
            youngs_modulus: 207e9,
            poisson: 0.28,
        },
        track: TrackFile::parse("track.toml", track).unwrap(),
        body: WheelsetBody {
            mass: 1250.0,
            about_axle: 150.0,
            about_diameter: 700.0,
        },
        axle_load: 290e3,
        speed,
        stiffness: [2e6, 2e6],
        damping: [2e4, 2e3],
        friction: Friction::constant(0.4),
        creep: CreepLaw::Polach(polach::DRY),
        search: SearchMode::Search,
        patch: PatchForm::Ellipse,
        start: RigStart {
            distance: 2.0,
            ..RigStart::default()
        },
        duration: None,
        interval: 0.005,
        relative_tolerance: 1e-5,
        units: Units::Si,
        given: BTreeMap::new(),
    }
}

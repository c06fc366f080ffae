//! The built-in vehicles, in groups. Every one is the text of a case file.

use std::sync::LazyLock;

use super::VehicleCase;
use crate::case::CaseError;
use crate::case::builtin::{BuiltIn, CaseGroup, text_in};
use crate::models::ModelKeys;

/// Cases that together have all keys.
pub(crate) const KEYS: ModelKeys = ModelKeys {
    cases: &[
        ("vehicle_catalog", &[]),
        ("vehicle_two_axles", &[]),
        ("vehicle_car_empty", &[]),
        (
            "vehicle_two_axles",
            &[concat!(
                r#"elements.coupler={ kind = "coupler", a = "body", at = ["200 in", "0 in", "33 in"], "#,
                r#"truck_distance = "236 in", direction = "angle" }"#
            )],
        ),
        (
            "vehicle_catalog",
            &[r#"elements.spring.table=[["0 in", "0 lbf"], ["1 in", "3000 lbf"]]"#],
        ),
        (
            "vehicle_catalog",
            &[r#"elements.damper.table=[["0 in/s", "0 lbf"], ["1 in/s", "3000 lbf"]]"#],
        ),
    ],
    alike: &[],
    known: VehicleCase::known_keys,
};

/// A file of a vehicle: its name, its title, its text.
macro_rules! file {
    ($name:literal, $title:literal) => {
        ($name, $title, include_str!(concat!("builtin/", $name, ".toml")))
    };
}

static GROUPS: LazyLock<Vec<CaseGroup>> = LazyLock::new(|| {
    let case =
        |(name, title, body): (&str, &str, &str)| BuiltIn::new(name.to_owned(), title.to_owned(), body);
    vec![mechanisms(case), suspensions(case), wagons(case)]
});

type Made = fn((&str, &str, &str)) -> BuiltIn;

fn mechanisms(case: Made) -> CaseGroup {
    CaseGroup {
        name: "mechanisms",
        title: "Vehicles of bodies and elements: mechanisms with closed forms",
        look_at: "Their natural frequencies stand in the summary and are those of textbooks. They show the \
                  keys of bodies and elements.",
        cases: [
            file!("vehicle_two_masses", "Two masses on springs, let go from aside"),
            file!("vehicle_double_pendulum", "A double pendulum on bushings"),
            file!(
                "vehicle_catalog",
                "One of every element of the catalog, on a shaking table"
            ),
        ]
        .map(case)
        .into(),
    }
}

fn wagons(case: Made) -> CaseGroup {
    CaseGroup {
        name: "wagons",
        title: "Vehicles on a track: axles where you like",
        look_at: "Wheel loads and accelerations on tangent track. Its numbers are guesses: it shows the \
                  keys of \
                  wheelsets, wheels, rails and track.",
        cases: [
            file!(
                "vehicle_two_axles",
                "A wagon on two axles over tangent track of FRA class 4 at 40 mph"
            ),
            file!(
                "vehicle_car_empty",
                "The empty car, written out as a body and two trucks, over a dip of the left rail"
            ),
        ]
        .map(case)
        .into(),
    }
}

/// The four sets of friction of the planar half-bogie: name, title, friction of columns (leading, trailing)
/// and of slopes.
const FRICTIONS: [(&str, &str, [f64; 4]); 4] = [
    (
        "same",
        "the same friction on columns and slopes",
        [0.4, 0.4, 0.4, 0.4],
    ),
    (
        "different",
        "different friction, slopes too",
        [0.4, 0.4, 0.2, 0.2],
    ),
    (
        "same_frictionless_slope",
        "the same friction, slopes without",
        [0.4, 0.0, 0.4, 0.0],
    ),
    (
        "different_frictionless_slope",
        "different friction, slopes without",
        [0.4, 0.0, 0.2, 0.0],
    ),
];

/// The two suspensions of Berghuvud and Stensson, as Steets (2007, section 1.4.8) tells them; their numbers
/// are those of the truck here.
fn suspensions(case: Made) -> CaseGroup {
    let mut cases = vec![case(file!(
        "vehicle_one_mass",
        "Berghuvud and Stensson: one mass on coils and friction over a moving side frame"
    ))];
    for (name, title, [leading_column, leading_slope, trailing_column, trailing_slope]) in FRICTIONS {
        let friction = |wedge: &str, column: f64, slope: f64| {
            format!("\n[elements.{wedge}.friction]\ncolumn = {column:?}\nslope = {slope:?}\n")
        };
        let text = [
            include_str!("builtin/half_bogie.toml"),
            &friction("leading_wedge", leading_column, leading_slope),
            &friction("trailing_wedge", trailing_column, trailing_slope),
        ];
        let title = format!("Berghuvud and Stensson: a planar half-bogie, {title}");
        cases.push(case((
            &format!("vehicle_half_bogie_{name}"),
            &title,
            &text.concat(),
        )));
    }
    CaseGroup {
        name: "suspensions",
        title: "Two suspensions of the literature under a sine of the track",
        look_at: "Below the natural frequency, at small amplitudes, the car goes with the side frame: \
                  friction \
                  locks it. In the half-bogie the wedges carry different forces, and lose different \
                      energies.",
        cases,
    }
}

/// Returns the groups.
#[must_use]
pub fn groups() -> &'static [CaseGroup] {
    &GROUPS
}

/// Returns the case file of the built-in vehicle of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest.
pub fn text(name: &str) -> Result<&'static str, CaseError> {
    text_in(groups(), name, "vehicle")
}

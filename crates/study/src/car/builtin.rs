//! The built-in cars, after the [regimes](Regime) by which freight cars are assessed. Every one is the text
//! of a case file.

use std::path::Path;
use std::sync::LazyLock;

use quantity::Quantity;

use super::CarCase;
use super::regime::Regime;
use crate::case::CaseError;
use crate::case::builtin::{BuiltIn, CaseGroup, names_in, text_in};
use crate::models::ModelKeys;

/// Cases that together have all keys.
pub(crate) const KEYS: ModelKeys = ModelKeys {
    cases: &[
        ("car_tangent_loaded", &[]),
        ("car_tangent_empty", &[]),
        ("car_constant_curve_loaded", &[]),
        ("car_hunting_empty", &[]),
        ("car_hunting_roller_empty", &[]),
        ("car_twist_and_roll_loaded", &[]),
        ("car_286k_loaded", &[]),
        ("car_buff_curve_empty", &["couplers.direction=angle"]),
        ("car_static_curve_empty", &[]),
        ("car_286k_loaded", &["truck.load_springs.height=9 in"]),
    ],
    // Each truck of a car takes the keys of both.
    alike: &[["front_truck", "truck"], ["rear_truck", "truck"]],
    known: CarCase::known_keys,
};

/// Irregularities of a track of FRA class 4 by spectra, tapered at the start.
const CLASS_4: &str = "
[[track.irregularities]]
spectrum = \"fra_vertical\"
class = 4
rails = \"both\"
direction = \"vertical\"
seed = 1
[[track.irregularities]]
spectrum = \"fra_cross_level\"
class = 4
rails = \"against\"
direction = \"vertical\"
seed = 2
[[track.irregularities]]
spectrum = \"fra_lateral\"
class = 4
rails = \"both\"
direction = \"lateral\"
seed = 3
";

/// A car of 286,000 lbf on rail: trucks of 72 in whose nests have 7 outer and 7 inner D5 coils and two pairs
/// of B-353 and B-354, which carry it within 0.02 in of the nominal height (derived). Body and masses of the
/// trucks are those of the car of 263,000 lbf; the center of gravity of body and lading is 84 in high and the
/// inertia grows with the weight, both guesses.
const HEAVY: &str = "truck.wheelbase = \"72 in\"
truck.load_springs = { kind = \"D5\", outer = 7, inner = 7 }
truck.control_coil.kind = \"B-353\"
lading.kind = \"masses\"
lading.masses = [{ name = \"lading\", weight = \"223400 lbf\", place = [\"0 in\", \"0 in\", \"87.66 in\"], \
                     inertia = [\"1.558e6 lbf in s^2\", \"1.4117e7 lbf in s^2\", \"1.4165e7 lbf in s^2\"] }]";

/// Returns the keys that a regime sets, as lines of a case, but for the start, which a case that slows down
/// has of its own.
fn set_of(regime: &str) -> String {
    let set = Regime::named(regime).map_or(&[][..], |own| &own.set);
    let lines = set.iter().filter(|line| !line.starts_with("start."));
    lines.map(|line| format!("{line}\n")).collect()
}

/// Returns a car in a regime at the speed with this place among the regime's own.
fn in_regime(name: &str, lading: &str, place: usize) -> Option<BuiltIn> {
    let regime = Regime::named(name)?;
    let speed: &Quantity = regime.speeds.get(place)?;
    let settings = regime.settings(speed).ok()?.join("\n");
    let body = format!("model = \"car\"\nlading.kind = \"{lading}\"\n{settings}\n");
    Some(BuiltIn::new(
        format!("car_{name}_{lading}"),
        format!("{} at {speed}, {lading} car", regime.title),
        &body,
    ))
}

fn tangent(length: f64) -> String {
    format!("[[track.segments]]\ntangent = \"{length} ft\"\n")
}

fn case(name: &str, title: &str, lading: &str, speed: &str, duration: f64, track: &str) -> BuiltIn {
    let body = format!(
        "model = \"car\"
lading.kind = \"{lading}\"
{speed}
simulation.duration = \"{duration} s\"
{track}"
    );
    BuiltIn::new(
        format!("car_{name}_{lading}"),
        format!("{title}, {lading} car"),
        &body,
    )
}

fn held(speed: f64) -> String {
    format!("speed.value = \"{speed} mph\"")
}

static GROUPS: LazyLock<Vec<CaseGroup>> = LazyLock::new(|| {
    let rough = format!("{}{CLASS_4}", tangent(2500.0));
    let tangents = ["loaded", "empty"].map(|lading| {
        case(
            "tangent",
            "tangent track of FRA class 4 at 50 mph",
            lading,
            &held(50.0),
            20.0,
            &rough,
        )
    });
    let slowing = "speed.kind = \"over_distance\"
speed.over_distance = [[\"200 ft\", \"75 mph\"], [\"4200 ft\", \"30 mph\"]]
start.axle_shift = \"0.2 in\"";
    let rollers = "truck.side_bearing.kind = \"roller\"
speed.kind = \"over_time\"
speed.over_time = [[\"10 s\", \"75 mph\"], [\"70 s\", \"30 mph\"]]
start.axle_shift = \"0.4 in\"";
    let slows_down = |name: &str, title: &str, speed: &str, duration: f64, length: f64| {
        let track = format!("{}{}", set_of("hunting"), tangent(length));
        case(name, title, "empty", speed, duration, &track)
    };
    // At a speed in the middle, and spectra at the greatest speed of their class.
    let others = [
        ("yaw_and_sway", "loaded", 3),
        ("dynamic_curving", "loaded", 3),
        ("constant_curve_10", "loaded", 3),
        ("constant_curve_12", "loaded", 3),
        ("bunched_spiral", "loaded", 2),
        ("single_bump", "loaded", 3),
        ("curve_with_bump", "loaded", 3),
        ("curve_with_dip", "loaded", 3),
        ("lean", "loaded", 5),
        ("static_curve", "empty", 0),
        ("buff_curve", "empty", 3),
        ("draft_curve", "empty", 3),
        ("fra_class_1", "loaded", 5),
        ("fra_class_1", "empty", 5),
        ("fra_class_2", "loaded", 5),
        ("fra_class_2", "empty", 5),
        ("fra_class_3", "loaded", 5),
        ("fra_class_3", "empty", 5),
        ("fra_class_4", "loaded", 5),
        ("fra_class_4", "empty", 5),
        ("fra_class_5", "loaded", 5),
        ("fra_class_5", "empty", 5),
    ];
    let in_regimes = |cases: &[(&str, &str, usize)]| -> Vec<BuiltIn> {
        let cases = cases.iter();
        cases
            .filter_map(|(name, lading, place)| in_regime(name, lading, *place))
            .collect()
    };
    vec![
        CaseGroup {
            name: "car",
            title: "A freight car on track",
            look_at: "Tangent: accelerations at the truck centers, losses of the wedges. Curves: lateral \
                      forces of the leading axles, L/V, and the trucks' turning against center plates and \
                      wedges. Amplitudes and limits are remembered of AAR M-1001, chapter XI: check them \
                      against your edition.",
            cases: [
                &tangents[..],
                &in_regimes(&[("constant_curve", "loaded", 3), ("constant_curve", "empty", 3)]),
                &[BuiltIn::new(
                    "car_286k_loaded".to_owned(),
                    "tangent track of FRA class 4 at 50 mph, car of 286,000 lbf on trucks of 72 in"
                        .to_owned(),
                    &format!(
                        "model = \"car\"\n{HEAVY}\n{}\nsimulation.duration = \"20 s\"\n{rough}",
                        held(50.0)
                    ),
                )],
            ]
            .concat(),
        },
        CaseGroup {
            name: "car_regimes",
            title: "Regimes of freight cars",
            look_at: "Spiral: the least wheel load. Hunting: where the lateral motion dies while the car \
                      slows down, and the standard deviation of the lateral acceleration. Twist and roll: \
                      the roll of the body, greatest less least, over speeds. Pitch and bounce: wheel loads. \
                      Yaw and sway, dynamic curving: L/V. Bumps and dips: wheel loads. Lean, static curve: \
                      steady wheel loads. `wedgelab regime` runs them over speeds.",
            cases: [
                in_regimes(&[("spiral", "loaded", 2)]),
                vec![
                    slows_down(
                        "hunting",
                        "tangent, slowing down from 75 to 30 mph",
                        slowing,
                        50.0,
                        5000.0,
                    ),
                    slows_down(
                        "hunting_roller",
                        "tangent on roller side bearings, slowing down from 75 to 30 mph",
                        rollers,
                        70.0,
                        6500.0,
                    ),
                ],
                in_regimes(&[("twist_and_roll", "loaded", 1), ("pitch_and_bounce", "loaded", 3)]),
                in_regimes(&others),
            ]
            .concat(),
        },
    ]
});

/// Returns the groups.
pub fn groups() -> &'static [CaseGroup] {
    &GROUPS
}

/// Returns the names of all built-in cars.
pub fn names() -> impl Iterator<Item = &'static str> {
    names_in(groups())
}

/// Returns the built-in car of this name, with `--set` overrides (`path.key=value`); files that
/// these name are looked for from the current folder.
///
/// # Errors
/// There is none of this name, or an override is wrong.
pub fn case_with(name: &str, overrides: &[String]) -> Result<CarCase, CaseError> {
    CarCase::parse(&format!("{name}.toml"), text(name)?, Path::new(""), overrides)
}

/// Returns the case file of the built-in car of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest.
pub fn text(name: &str) -> Result<&'static str, CaseError> {
    text_in(groups(), name, "car")
}

//! All keys of a model's cases: built-in cases that together have all of them, and the schema by which
//! editors complete and check a case.

use std::collections::BTreeSet;

use serde_json::Value;

use super::built_in;
use crate::car::CarCase;
use crate::case::Case;
use crate::case::builtin::BuiltIn;
use crate::reader::schema::{KnownSection, address, schema as joined};
use crate::truck::TruckCase;
use crate::vehicle::VehicleCase;

/// A built-in case and `--set` overrides of it.
pub type Variant = (&'static str, &'static [&'static str]);

/// All keys of a model's cases.
#[derive(Debug)]
pub struct ModelKeys {
    /// Cases that together have all keys.
    pub cases: &'static [Variant],
    /// Tables with the keys of another one.
    alike: &'static [[&'static str; 2]],
    known: fn(&str, &[String]) -> Vec<KnownSection>,
}

pub(super) const WEDGE: ModelKeys = ModelKeys {
    cases: &[
        ("vdrun_toe_0_psi_0", &[]),
        ("cdrun_toe_0_psi_0", &[]),
        ("cdrun_toe_0_psi_0", &["friction.law=bristle"]),
        (
            "cdrun_toe_0_psi_0",
            &[r#"control_coil.table=[["0 in", "0 lbf"], ["1 in", "3000 lbf"]]"#],
        ),
    ],
    alike: &[],
    known: Case::known_keys,
};

pub(super) const TRUCK: ModelKeys = ModelKeys {
    cases: &[
        ("truck_vertical_variable", &[]),
        ("truck_vertical_constant", &[]),
        ("truck_warp_axles_variable_rising", &[]),
        ("truck_roll_variable", &[]),
        ("truck_vertical_variable", &["load.kind=car_body"]),
        ("truck_warp_axles_variable_rising", &["adapter.kind=pad"]),
        ("truck_vertical_variable", &["wedge.kind=massless"]),
        ("truck_vertical_split", &[]),
        (
            "truck_vertical_variable",
            &[
                "control_coil.kind=B-353",
                "load_springs.kind=D5",
                "load_springs.outer=7",
                "load_springs.inner=7",
                "load_springs.height=9 in",
            ],
        ),
        (
            "truck_vertical_variable",
            &[
                "control_coil.kind=thesis",
                r#"control_coil.table=[["0 in", "0 lbf"], ["1 in", "3000 lbf"]]"#,
            ],
        ),
    ],
    alike: &[],
    known: TruckCase::known_keys,
};

pub(super) const CAR: ModelKeys = ModelKeys {
    cases: &[
        ("car_tangent_loaded", &[]),
        ("car_tangent_empty", &[]),
        ("car_constant_curve_loaded", &[]),
        ("car_hunting_empty", &[]),
        ("car_hunting_roller_empty", &[]),
        ("car_twist_and_roll_loaded", &[]),
        ("car_286k_loaded", &[]),
        ("car_286k_loaded", &["truck.load_springs.height=9 in"]),
    ],
    // Each truck of a car takes the keys of both.
    alike: &[["front_truck", "truck"], ["rear_truck", "truck"]],
    known: CarCase::known_keys,
};

pub(super) const VEHICLE: ModelKeys = ModelKeys {
    cases: &[
        ("vehicle_catalog", &[]),
        ("vehicle_two_axles", &[]),
        ("vehicle_car_empty", &[]),
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

impl ModelKeys {
    /// Returns the schema of the cases of the model with this name (JSON Schema, draft 7).
    #[must_use]
    pub fn schema(&self, model: &str) -> Value {
        let text = |name: &str| built_in(name).map_or("", BuiltIn::text);
        // What is said first stands: the built-in cases before their variants.
        let (mut sections, mut variants) = (Vec::new(), Vec::new());
        let mut chosen = BTreeSet::new();
        for (name, overrides) in self.cases {
            let overrides: Vec<String> = overrides.iter().map(|&own| own.to_owned()).collect();
            let known = (self.known)(text(name), &overrides);
            // Keys that there are beside one choice alone.
            for choice in known.iter().flat_map(KnownSection::choices) {
                if chosen.insert(choice.clone()) {
                    let overrides = [overrides.as_slice(), &[choice]].concat();
                    variants.extend((self.known)(text(name), &overrides));
                }
            }
            sections.extend(known);
        }
        sections.extend(variants);
        let title = format!("A case of Wedgelab, model \"{model}\"");
        joined(&address(model), &title, &sections, self.alike)
    }
}

//! The static table: what a car or a truck weighs, how its coils stand, at the start of its run.

use std::collections::BTreeMap;

use quantity::{Kind, Number, System as Units};
use serde::{Deserialize, Serialize};
use truck::{CoilGroup, TruckStatics, WEDGE_NAMES, WedgeLoads};

use crate::summary_value::SummaryValue;

/// Coils that act together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CoilSummary {
    /// Their load.
    pub load: SummaryValue,
    /// Down from their free height, the mean by their stiffness.
    pub deflection: Option<SummaryValue>,
    /// Down to where the first coil is solid; none of coils that never are.
    pub reserve: Option<SummaryValue>,
    /// Their load there.
    pub solid_load: Option<SummaryValue>,
}

/// A wedge.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WedgeAtRest {
    /// Its control coils; none if they are broken, those of the thesis, or those of a wedge without mass.
    pub control_coils: Option<CoilSummary>,
    /// Normal force of its column.
    pub column: SummaryValue,
    /// Its rise in its pocket, as a gauge shows it.
    pub rise: SummaryValue,
}

/// A car or a truck at the start of its run; what a truck alone does not have is missing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StaticTable {
    /// Weight of all that stands on the rails.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight_on_rail: Option<SummaryValue>,
    /// Vertical force of each wheel by its name: `axle_1_left`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub wheels: BTreeMap<String, SummaryValue>,
    /// True if the car is not at rest at the start: then the wheels have the loads of the car at rest, from
    /// weights and places.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub disturbed: bool,
    /// Heights above the top of rail: `center_of_gravity` of the car, `body_center_of_gravity` of body and
    /// lading, `front_coupler`, `rear_coupler`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub heights: BTreeMap<String, SummaryValue>,
    /// Load coils of each nest by its name: `truck_1_left`, of a truck alone `left`.
    pub nests: BTreeMap<String, CoilSummary>,
    /// The wedges by their names: `truck_1_leading_left`, of a truck alone `leading_left`.
    pub wedges: BTreeMap<String, WedgeAtRest>,
}

/// A row of the table of coils: some groups that are alike, and their values in output units.
#[derive(Clone, Debug, PartialEq)]
pub struct CoilRow {
    /// Names of the groups in words.
    pub name: String,
    /// Load, deflection, reserve, load when solid, column force, rise; none where there is none.
    pub values: [Option<f64>; 6],
}

/// The head of the rows of [`StaticTable::coils`], with the kinds of their values.
pub const COILS: [(&str, Kind); 6] = [
    ("load", Kind::Force),
    ("down", Kind::Length),
    ("left", Kind::Length),
    ("load when solid", Kind::Force),
    ("column", Kind::Force),
    ("rise", Kind::Length),
];
/// Relative and absolute difference of values (output units) that are alike in the table.
const ALIKE: [f64; 2] = [1e-2, 2e-3];

impl CoilSummary {
    fn of(own: &CoilGroup, units: Units) -> Self {
        let value = |value: f64, kind| SummaryValue::new(value, kind, units);
        Self {
            load: value(own.load, Kind::Force),
            deflection: own.deflection.map(|own| value(own, Kind::Length)),
            reserve: own.reserve.map(|own| value(own, Kind::Length)),
            solid_load: own.solid_load.map(|own| value(own, Kind::Force)),
        }
    }

    fn values(&self) -> [Option<f64>; 4] {
        let of = |own: &Option<SummaryValue>| own.as_ref().map(|own| own.value);
        [
            Some(self.load.value),
            of(&self.deflection),
            of(&self.reserve),
            of(&self.solid_load),
        ]
    }
}

impl StaticTable {
    /// Adds the coils and wedges of a truck; their names begin with `prefix`.
    pub(crate) fn add_truck(
        &mut self,
        prefix: &str,
        coils: &TruckStatics,
        wedges: &[WedgeLoads; 4],
        units: Units,
    ) {
        for (name, own) in ["left", "right"].iter().zip(&coils.nests) {
            self.nests
                .insert(format!("{prefix}{name}"), CoilSummary::of(own, units));
        }
        for ((name, coil), own) in WEDGE_NAMES.iter().zip(&coils.control_coils).zip(wedges) {
            let wedge = WedgeAtRest {
                control_coils: coil.as_ref().map(|own| CoilSummary::of(own, units)),
                column: SummaryValue::new(own.column_normal, Kind::Force, units),
                rise: SummaryValue::new(own.rise, Kind::Length, units),
            };
            self.wedges.insert(format!("{prefix}{name}"), wedge);
        }
    }

    /// Returns the table of coils, with groups that are alike in one row: all of a kind, or those of a truck,
    /// or single ones.
    #[must_use]
    pub fn coils(&self) -> Vec<CoilRow> {
        let nests = self.nests.iter().map(|(name, own)| {
            let [load, down, left, solid] = own.values();
            (name.clone(), [load, down, left, solid, None, None])
        });
        let wedges = self.wedges.iter().map(|(name, own)| {
            let coils = own.control_coils.as_ref().map_or([None; 4], CoilSummary::values);
            let [load, down, left, solid] = coils;
            let own = [Some(own.column.value), Some(own.rise.value)];
            (name.clone(), [load, down, left, solid, own[0], own[1]])
        });
        let mut rows = folded("load coils of", "nest", nests.collect());
        rows.extend(folded("control coils of", "wedge", wedges.collect()));
        rows
    }

    /// Returns weight, wheel loads and heights in a sentence; none of a truck alone.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let weight = self.weight_on_rail.as_ref()?;
        let loads = || self.wheels.values().map(|own| own.value);
        let (least, most) = (loads().reduce(f64::min)?, loads().reduce(f64::max)?);
        let whole = |value: f64| Number(value.round()).to_string();
        let a_wheel = match most - least <= ALIKE[0] * most.abs() {
            true => whole(0.5 * (least + most)),
            false => format!("{} to {}", whole(least), whole(most)),
        };
        let height = |name: &str| {
            let own = self.heights.get(name)?;
            Some(format!("{:.1}", own.value))
        };
        let unit = &self.heights.get("center_of_gravity")?.unit;
        let [front, rear] = [height("front_coupler")?, height("rear_coupler")?];
        let couplers = match front == rear {
            true => format!("couplers at {front} {unit}"),
            false => format!("front coupler at {front} {unit}, rear one at {rear} {unit}"),
        };
        let at_rest = match self.disturbed {
            true => " at rest",
            false => "",
        };
        Some(format!(
            "At the start {} {} on rail, {a_wheel} a wheel{at_rest}; center of gravity at {} {unit} \
             (body with lading {} {unit}), {couplers} above the top of rail.",
            whole(weight.value),
            weight.unit,
            height("center_of_gravity")?,
            height("body_center_of_gravity")?,
        ))
    }
}

/// Returns rows of groups by their names, `left` or `truck_1_left`; alike ones in one row.
fn folded(what: &str, one: &str, all: Vec<(String, [Option<f64>; 6])>) -> Vec<CoilRow> {
    let alike = |rows: &[&(String, [Option<f64>; 6])]| {
        rows.iter().all(|(_, own)| {
            own.iter().zip(&rows[0].1).all(|(a, b)| match (a, b) {
                (Some(a), Some(b)) => (a - b).abs() <= (ALIKE[0] * b.abs()).max(ALIKE[1]),
                (a, b) => a == b,
            })
        })
    };
    let row = |name: String, own: &[Option<f64>; 6]| CoilRow { name, values: *own };
    let every: Vec<_> = all.iter().collect();
    match every.first() {
        None => return Vec::new(),
        Some((_, values)) if alike(&every) => return vec![row(format!("{what} each {one}"), values)],
        Some(_) => {}
    }
    let mut rows = Vec::new();
    for (prefix, words) in [("truck_1_", "front truck"), ("truck_2_", "rear truck"), ("", "")] {
        let own: Vec<_> = all
            .iter()
            .filter(|(name, _)| match prefix {
                "" => !name.starts_with("truck_"),
                own => name.starts_with(own),
            })
            .collect();
        match own.first() {
            Some((_, values)) if alike(&own) && !words.is_empty() => {
                rows.push(row(format!("{what} each {one}, {words}"), values));
            }
            _ => rows.extend(own.iter().map(|(name, values)| {
                let short = name[prefix.len()..].replace('_', " ");
                let place = if words.is_empty() {
                    short
                } else {
                    format!("{short}, {words}")
                };
                row(format!("{what} {one} {place}"), values)
            })),
        }
    }
    rows
}

//! The runs of the report: the rigs of loaded and empty trucks, which the page shows, and variants for
//! comparison.

use std::collections::BTreeMap;

use study::case::CaseError;
use study::truck::run::TruckResult;
use study::truck::{TruckCase, builtin};

/// lbf, in N.
pub(super) const POUND: f64 = 4.448_221_615_260_5;
/// Inch, in m.
pub(super) const INCH: f64 = 0.0254;
/// kip·in, in N·m.
pub(super) const KIP_INCH: f64 = 1e3 * POUND * INCH;

/// Returns the names of the rigs that the page shows: those of the loaded and of the empty truck.
#[must_use]
pub fn shown() -> Vec<&'static str> {
    let groups = builtin::groups().iter();
    let cases = groups
        .filter(|group| ["truck", "truck_empty"].contains(&group.name))
        .flat_map(|group| &group.cases);
    cases.map(|case| case.name.as_str()).collect()
}

/// A run for comparison.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The name by which it is asked for.
    pub key: String,
    /// Its case.
    pub case: TruckCase,
}

/// Rigs whose results are computed with contacts and bristles of twice the stiffness too.
pub(super) const SENSITIVE: [(&str, &str, &[&str]); 4] = [
    ("warp, new", "truck_warp_nest_constant_rising", &[]),
    (
        "warp, mu 0.25",
        "truck_warp_nest_constant_rising",
        &["truck.condition=mu_0.25"],
    ),
    ("vertical, constant", "truck_vertical_constant", &[]),
    ("vertical, variable", "truck_vertical_variable", &[]),
];
/// The stiffness that is doubled: its name, and the value that is set.
pub(super) const STIFFENED: [(&str, &str); 2] = [
    ("contacts", "contact.stiffness=500000 lbf/in"),
    ("bristles", "friction.bristle_stiffness=2000000 lbf/in"),
];

/// The rig that warps the truck by its axles.
const AXLES: &str = "truck_warp_axles_constant_rising";

/// Returns the runs for comparison.
///
/// # Errors
/// A value is refused: the built-in cases have changed.
pub fn variants() -> Result<Vec<Variant>, CaseError> {
    const FRICTIONLESS: [&str; 2] = ["friction.column=0", "friction.slope=0"];
    let mut all = Vec::new();
    let mut add = |key: &str, name: &str, set: &[&str]| -> Result<(), CaseError> {
        let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
        let case = builtin::case_with(name, &set)?;
        all.push(Variant {
            key: key.to_owned(),
            case,
        });
        Ok(())
    };
    add(
        "frictionless warp",
        "truck_warp_nest_constant_rising",
        &[&FRICTIONLESS[..], &["simulation.duration=4.6 s"]].concat(),
    )?;
    add("frictionless vertical", "truck_vertical_constant", &FRICTIONLESS)?;
    add(
        "turned plate",
        "truck_vertical_variable",
        &[
            "load.kind=car_body",
            "bolster.vertical=0 in",
            "bolster.yaw={ shape = \"ramp\", amplitude = \"0.02 rad\", start = \"0.1 s\", duration = \"1 \
             s\", profile = \"half_cosine\" }",
            "simulation.duration=1.5 s",
        ],
    )?;
    for damping in ["constant", "variable"] {
        for lading in ["", "_empty"] {
            add(
                &format!("rest, {damping}{lading}"),
                &format!("truck_drop_{damping}{lading}"),
                &[
                    "start.lift=0 in",
                    "start.kind=equilibrium",
                    "simulation.duration=0.02 s",
                ],
            )?;
        }
    }
    for damping in ["constant", "variable"] {
        add(
            &format!("much toe, {damping}"),
            &format!("truck_vertical_{damping}_toe_out"),
            &["side_frame.toe=2 deg out"],
        )?;
    }
    for damping in ["constant", "variable"] {
        let rig = format!("truck_vertical_{damping}_toe_out");
        add(&format!("massless, {damping}"), &rig, &["wedge.kind=massless"])?;
    }
    // NUCARS's spring of a worn truck beside wedges of less friction.
    for (spring, condition) in [("new", "new"), ("worn", "mu_0.25")] {
        let truck = format!("truck.condition={condition}");
        add(&format!("axles, {spring}"), AXLES, &[&truck])?;
        let empirical = format!("warp_spring.kind={spring}");
        let set = [truck.as_str(), "wedge.kind=massless", empirical.as_str()];
        add(&format!("massless axles, {spring}"), AXLES, &set)?;
    }
    for (key, name, set) in SENSITIVE {
        add(key, name, set)?;
        for (what, stiffer) in STIFFENED {
            add(&format!("{key}, {what}"), name, &[set, &[stiffer]].concat())?;
        }
    }
    Ok(all)
}

/// Runs by the names of rigs and the keys of variants.
#[derive(Clone, Debug, Default)]
pub struct Rigs {
    runs: BTreeMap<String, (TruckCase, TruckResult)>,
}

impl Rigs {
    /// Adds a run.
    pub fn add(&mut self, key: &str, case: TruckCase, result: TruckResult) {
        self.runs.insert(key.to_owned(), (case, result));
    }

    /// Returns a run with its case, if it came to its end.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<(&TruckCase, &TruckResult)> {
        let (case, result) = self.runs.get(key)?;
        result.summary.complete.then_some((case, result))
    }

    /// Returns all runs with their keys.
    pub fn all(&self) -> impl Iterator<Item = (&str, &TruckResult)> {
        self.runs.iter().map(|(key, (_, result))| (key.as_str(), result))
    }
}

/// Returns the value of a column (SI) in the row nearest to a time (s).
pub(super) fn at(result: &TruckResult, name: &str, time: f64) -> Option<f64> {
    let times = result.column("time")?;
    let after = times.partition_point(|own| *own < time);
    let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let row = near
        .filter(|row| *row < times.len())
        .min_by(|a, b| (times[*a] - time).abs().total_cmp(&(times[*b] - time).abs()))?;
    result.column(name)?.get(row).copied()
}

/// Preload and weight (N) of the leading left wedge's coil.
pub(super) fn coil_and_weight(case: &TruckCase) -> [f64; 2] {
    let wedge = &case.parameters.wedges[0];
    [wedge.control_coil.preload(), wedge.mass * case.parameters.gravity]
}

//! The built-in trucks: rigs, in groups. Every one is the text of a case file.

use std::path::Path;
use std::sync::LazyLock;

use super::TruckCase;
use crate::case::CaseError;
use crate::case::builtin::{BuiltIn, CaseGroup, names_in, text_in};
use crate::models::ModelKeys;

/// Cases that together have all keys.
pub(crate) const KEYS: ModelKeys = ModelKeys {
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

/// Dampings, each with the height by which an empty car stands above the loaded one, in.
const DAMPINGS: [(&str, f64); 2] = [("constant", 1.936), ("variable", 1.976)];

/// The faces of the wedges of the thesis, which bear on four corners, with which independent simulations have
/// checked the rigs.
const CHECKED_FACES: &str = "column_face.grid = [2, 2]\nslope_face.grid = [2, 2]\nslope_face.wedge_surface = \
                             \"flat\"\n";
/// The adapters of these simulations.
const CHECKED_ADAPTERS: &str = "adapter.stiffness = \"5e5 lbf/in\"\n";

/// A case from its parts; `empty` adds the height of an empty car to the bolster's vertical motion.
struct Rig {
    name: String,
    title: String,
    damping: &'static str,
    /// All keys but `truck.damping`, `bolster.vertical`, `start.lift` and `simulation.duration`.
    body: String,
    /// True: with the faces of wedges in service, by default; false: with those of the rigs that independent
    /// simulations check.
    crowned: bool,
    /// Height from which half a car is dropped, in.
    lift: Option<f64>,
    /// The bolster's vertical motions.
    vertical: Vec<String>,
    duration: f64,
}

impl Rig {
    /// Returns a rig with its name (after `truck_`) and title.
    fn new(
        damping: &'static str,
        (name, title): (&str, String),
        body: String,
        vertical: Vec<String>,
        duration: f64,
    ) -> Self {
        Self {
            name: format!("truck_{name}"),
            title,
            damping,
            body,
            crowned: false,
            lift: None,
            vertical,
            duration,
        }
    }

    fn lifted(self, lift: f64) -> Self {
        Self {
            lift: Some(lift),
            ..self
        }
    }

    fn case(mut self, rise: Option<f64>) -> BuiltIn {
        if !self.crowned {
            self.body += CHECKED_FACES;
            if !self.body.contains("adapter.kind") {
                self.body += CHECKED_ADAPTERS;
            }
        }
        if let Some(rise) = rise {
            self.name += "_empty";
            self.title += ", empty";
            match &mut self.lift {
                Some(lift) => {
                    *lift += rise;
                    self.body += "load.lading = \"empty\"\n";
                }
                None => self.vertical.insert(0, format!("\"{rise} in\"")),
            }
        }
        let vertical = match self.vertical.as_slice() {
            [] => String::new(),
            [one] => format!("bolster.vertical = {one}\n"),
            several => format!("bolster.vertical = [{}]\n", several.join(", ")),
        };
        let lift = self
            .lift
            .map_or(String::new(), |lift| format!("start.lift = \"{lift} in\"\n"));
        let text = format!(
            "model = \"truck\"\ntruck.damping = \"{}\"\n{vertical}{}{lift}simulation.duration = \"{} s\"\n",
            self.damping, self.body, self.duration
        );
        BuiltIn::new(self.name, self.title, &text)
    }
}

/// Returns the yaw of both side frames in warp tests, from 2 s on.
fn warp_by_nests(amplitude: &str) -> String {
    format!(
        "side_frame.free_coordinates = []\n\
         side_frame.yaw = {{ shape = \"triangle\", amplitude = \"{amplitude}\", frequency = \"0.1 Hz\", \
         start = \"2 s\" }}\nadapter.kind = \"nothing\"\n"
    )
}

/// Returns a motion in which the bolster comes to height 0 within 0.2 to 1.2 s, from below or from above.
fn approach(rising: bool) -> Vec<String> {
    let [from, by] = if rising { ["-0.2", "0.2"] } else { ["0.2", "-0.2"] };
    vec![
        format!("\"{from} in\""),
        format!(
            "{{ shape = \"ramp\", amplitude = \"{by} in\", start = \"0.2 s\", duration = \"1 s\", profile \
             = \"half_cosine\" }}"
        ),
    ]
}

fn sine(amplitude: &str, frequency: &str) -> String {
    format!("{{ shape = \"sine\", amplitude = \"{amplitude}\", frequency = \"{frequency}\" }}")
}

fn bolster(key: &str, motion: &str) -> String {
    format!("bolster.{key} = {motion}\n")
}

const HALF_CAR: &str = "load.kind = \"half_car\"\n";

/// Returns the rigs of one damping that have an empty version too.
fn rigs(damping: &'static str) -> Vec<Rig> {
    let rig = |name: String, title: &str, body, vertical, duration| {
        let title = format!("{damping} damping, {title}");
        Rig::new(damping, (&name, title), body, vertical, duration)
    };
    let up_and_down = vec![sine("0.5 in", "2 rad/s")];
    let axles = "leading_wheelset.lateral = { shape = \"triangle\", amplitude = \"0.7 in\", frequency \
                 = \"0.1 Hz\", start = \"2 s\" }\n\
                 trailing_wheelset.lateral = { shape = \"triangle\", amplitude = \"-0.7 in\", frequency \
                 = \"0.1 Hz\", start = \"2 s\" }\n";
    let toe_out = "side_frame.toe = \"0.2 deg out\"\n".to_owned();
    vec![
        rig(
            format!("vertical_{damping}"),
            "bolster up and down",
            String::new(),
            up_and_down.clone(),
            10.0,
        ),
        rig(
            format!("vertical_{damping}_toe_out"),
            "bolster up and down, toe out",
            toe_out,
            up_and_down,
            10.0,
        ),
        rig(
            format!("warp_nest_{damping}_rising"),
            "side frames yaw after the bolster has risen",
            warp_by_nests("0.02 rad"),
            approach(true),
            22.0,
        ),
        rig(
            format!("warp_nest_{damping}_sinking"),
            "side frames yaw after the bolster has sunk",
            warp_by_nests("0.02 rad"),
            approach(false),
            22.0,
        ),
        rig(
            format!("warp_axles_{damping}_rising"),
            "wheelsets move sideways against each other",
            axles.to_owned(),
            approach(true),
            22.0,
        ),
        rig(
            format!("drop_{damping}"),
            "half a car dropped by 0.5 in",
            HALF_CAR.to_owned(),
            Vec::new(),
            5.0,
        )
        .lifted(0.5),
        rig(
            format!("roll_{damping}"),
            "bolster rolls",
            bolster("roll", &sine("0.01 rad", "0.5 Hz")),
            Vec::new(),
            10.0,
        ),
        rig(
            format!("lateral_{damping}"),
            "bolster moves sideways",
            bolster("lateral", &sine("0.4 in", "0.5 Hz")),
            Vec::new(),
            10.0,
        ),
    ]
}

/// Up and down, and warp, with the wedges of a truck in service.
fn crowned(damping: &'static str) -> Vec<Rig> {
    let rig = |name: String, title: &str, body, vertical, duration| {
        let title = format!("{damping} damping, crowned wedges, {title}");
        Rig {
            crowned: true,
            ..Rig::new(damping, (&name, title), body, vertical, duration)
        }
    };
    vec![
        rig(
            format!("crowned_vertical_{damping}"),
            "bolster up and down",
            "start.kind = \"equilibrium\"\n".to_owned(),
            vec![sine("0.5 in", "2 rad/s")],
            10.0,
        ),
        rig(
            format!("crowned_warp_nest_{damping}"),
            "side frames yaw after the bolster has risen",
            format!("{}start.kind = \"equilibrium\"\n", warp_by_nests("0.02 rad")),
            approach(true),
            22.0,
        ),
    ]
}

/// Up and down, and warp, with wedges of other kinds; variable damping. Angles across are guesses.
fn kinds() -> Vec<BuiltIn> {
    let across = "wedge.slope_across = \"10 deg\"\nwedge.side_clearance = \"0 in\"\n";
    let spatial = ("spatial", "spatial wedges, pressed outboard", across.to_owned());
    let split = format!("wedge.kind = \"split\"\n{across}");
    let split = ("split", "split wedges, pressed apart", split);
    [spatial, split]
        .into_iter()
        .flat_map(|(kind, title, keys)| {
            let rig = |name: &str, what: &str, body, vertical, duration| {
                let named = (&*format!("{name}_{kind}"), format!("{title}: {what}"));
                Rig::new("variable", named, body, vertical, duration)
            };
            let warp = format!("{keys}{}", warp_by_nests("0.02 rad"));
            [
                rig(
                    "vertical",
                    "bolster up and down",
                    keys,
                    vec![sine("0.5 in", "2 rad/s")],
                    10.0,
                ),
                rig(
                    "warp_nest",
                    "side frames yaw after the bolster has risen",
                    warp,
                    approach(true),
                    22.0,
                ),
            ]
        })
        .map(|rig| rig.case(None))
        .collect()
}

/// Rigs of one damping that reach what the others do not.
fn limits(damping: &'static str) -> Vec<Rig> {
    let rig = |name: &str, title: &str, body, vertical, duration| {
        let title = format!("{damping} damping, {title}");
        Rig::new(
            damping,
            (&format!("{name}_{damping}"), title),
            body,
            vertical,
            duration,
        )
    };
    let pocket = format!(
        "{}friction.column = 0.5\nfriction.slope = 0.05\n",
        bolster("lateral", &sine("0.4 in", "0.5 Hz"))
    );
    let adapters: String = [("leading", "0.005 rad"), ("trailing", "-0.005 rad")]
        .map(|(axle, yaw)| {
            let [lateral, yaw] = ["0.5 in", yaw].map(|amplitude| sine(amplitude, "0.5 Hz"));
            format!("{axle}_wheelset.lateral = {lateral}\n{axle}_wheelset.yaw = {yaw}\n")
        })
        .concat();
    vec![
        rig(
            "lands",
            "warp by 35 mrad: lands meet",
            warp_by_nests("0.035 rad"),
            approach(true),
            22.0,
        ),
        rig(
            "gibs",
            "bolster moves sideways by 0.7 in: gibs meet",
            bolster("lateral", &sine("0.7 in", "0.5 Hz")),
            Vec::new(),
            10.0,
        ),
        rig(
            "solid",
            "half a car dropped by 2.2 in: coils go solid",
            HALF_CAR.to_owned(),
            Vec::new(),
            5.0,
        )
        .lifted(2.2),
        rig(
            "pocket_sides",
            "wedges are held by the columns and pushed by the pockets' sides",
            pocket,
            Vec::new(),
            10.0,
        ),
        rig(
            "adapter_stops",
            "wheelsets move and turn against the adapters' stops",
            adapters,
            Vec::new(),
            10.0,
        ),
    ]
}

/// Loads and motions beyond what a truck is made for, of one damping.
fn extremes(damping: &'static str) -> Vec<Rig> {
    let rig = |name: &str, title: &str, body, vertical, duration| {
        let title = format!("{damping} damping, {title}");
        Rig::new(
            damping,
            (&format!("{name}_{damping}"), title),
            body,
            vertical,
            duration,
        )
    };
    let ramp = |amplitude: &str, start: &str, duration: &str| {
        format!(
            "{{ shape = \"ramp\", amplitude = \"{amplitude}\", start = \"{start} s\", duration = \
             \"{duration} s\", profile = \"half_cosine\" }}"
        )
    };
    let bottomed = vec![ramp("-1.8 in", "0.2", "1"), ramp("1.8 in", "1.7", "1")];
    let locked = format!(
        "{HALF_CAR}side_frame.free_coordinates = []\nside_frame.yaw = {}\nadapter.kind = \"nothing\"\n\
         bolster.load.vertical = {}\n",
        ramp("0.015 rad", "0.5", "1"),
        ramp("-50000 lbf", "2", "2"),
    );
    vec![
        rig(
            "bottomed",
            "bolster pressed down by 1.8 in: nests bottom and come back",
            String::new(),
            bottomed,
            3.0,
        ),
        rig(
            "lock_up",
            "nests locked by 15 mrad of warp, half a car forced down by a load that grows to 50 kip",
            locked,
            Vec::new(),
            5.0,
        ),
        rig(
            "impact",
            "half a car lifted by 4 in, off its coils, and let go; side frames held",
            format!(
                "{HALF_CAR}side_frame.free_coordinates = []\nadapter.kind = \"nothing\"\n\
                 simulation.relative_tolerance = 1e-8\n"
            ),
            Vec::new(),
            3.0,
        )
        .lifted(4.0),
        rig(
            "ten_times",
            "ten times the weight of half a car released in the nominal layout",
            format!("{HALF_CAR}bolster.weight = \"1230300 lbf\"\n"),
            Vec::new(),
            3.0,
        ),
    ]
}

static GROUPS: LazyLock<Vec<CaseGroup>> = LazyLock::new(|| {
    let all = |rigs: fn(&'static str) -> Vec<Rig>, empty: bool| -> Vec<BuiltIn> {
        let dampings = DAMPINGS.iter();
        dampings
            .flat_map(|(damping, rise)| rigs(damping).into_iter().map(move |rig| (rig, *rise)))
            .map(|(rig, rise)| rig.case(empty.then_some(rise)))
            .collect()
    };
    vec![
        CaseGroup {
            name: "truck",
            title: "A three-piece truck on rigs, loaded",
            look_at: "Warp: the moment over the angle, its parts, and the normal forces of the columns, \
                      which grow where the nest locks; `--set truck.condition=worn` has a plateau instead. \
                      Vertical, without toe: slopes stick and the start sets the normal forces with \
                      constant damping; with variable damping they follow the coil.",
            cases: all(rigs, false),
        },
        CaseGroup {
            name: "truck_empty",
            title: "The same rigs with an empty car",
            look_at: "Coils are longer by the height that an empty car rises, and with variable damping \
                      columns carry a third of the loaded car's forces. Constant damping keeps them.",
            cases: all(rigs, true),
        },
        CaseGroup {
            name: "truck_crowned",
            title: "Rigs with wedges as they are in service: slope faces crowned across by 240 in",
            look_at: "Warp: half the stiffness of flat faces or less, which depends less on the contacts' \
                      stiffness. The radius is a choice, in no source: `wedgelab warp` and \
                      docs/wedge-faces.md compare others. `--set \"wedge.rise='0.75 in'\"` wears the wedges.",
            cases: [all(crowned, false), all(crowned, true)].concat(),
        },
        CaseGroup {
            name: "truck_limits",
            title: "Rigs that reach lands, gibs, solid coils, pocket sides and adapter stops",
            look_at: "Each stop shows as a corner in the loop: warp moment at 30 mrad (lands), lateral \
                      force at 0.5 in (gibs), nest force at 1.3 to 1.4 in (solid coils). The energy ledger \
                      must close there too.",
            cases: all(limits, false),
        },
        CaseGroup {
            name: "truck_kinds",
            title: "Spatial wedges, whose slopes are inclined across, and split wedges of two halves",
            look_at: "Each wedge bears on slope, column and a side of its pocket. Vertical: the column's \
                      friction beside that of truck_vertical_variable. Warp: the part of the pocket's sides \
                      beside that of the slopes, and how far the halves of a split wedge turn.",
            cases: kinds(),
        },
        CaseGroup {
            name: "truck_extreme",
            title: "Loads and motions beyond what a truck is made for",
            look_at: "Bottomed nests carry 1,000 kip more for each inch, warp locks the nests until the load \
                      exceeds their friction, a lifted car strikes its coils at √(2gh), ten times the load \
                      sinks to where solid coils carry it. Each run ends with a closed ledger; what is \
                      implausible is said in its warnings.",
            cases: all(extremes, false),
        },
    ]
});

/// Returns the groups.
pub fn groups() -> &'static [CaseGroup] {
    &GROUPS
}

/// Returns the names of all built-in trucks.
pub fn names() -> impl Iterator<Item = &'static str> {
    names_in(groups())
}

/// Returns the built-in truck of this name, with `--set` overrides (`path.key=value`); files that
/// these name are looked for from the current folder.
///
/// # Errors
/// There is none of this name, or an override is wrong.
pub fn case_with(name: &str, overrides: &[String]) -> Result<TruckCase, CaseError> {
    TruckCase::parse(&format!("{name}.toml"), text(name)?, Path::new(""), overrides)
}

/// Returns the case file of the built-in truck of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest.
pub fn text(name: &str) -> Result<&'static str, CaseError> {
    text_in(groups(), name, "truck")
}

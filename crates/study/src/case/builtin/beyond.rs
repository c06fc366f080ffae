//! Cases beyond the thesis: what people who design, test and simulate trucks ask a wedge.
//!
//! They share what the thesis's runs have not: bristle friction, which holds; 10 lbf·s/in of damping a corner
//! (5 % of critical for the wedge on a face), so that contacts do not ring; a start in equilibrium, with
//! sines at 90° of phase, which begin at rest. Everything else is the thesis's wedge. Where numbers of a car
//! or a track had to be assumed, the case's title says so.

use super::{BuiltIn, CaseGroup};

/// The part that the cases share.
const COMMON: &str = r#"
[contact]
damping = "10 lbf s/in"
[friction]
law = "bristle"
"#;

/// Both dampings, with the height of the bolster about which it moves.
///
/// A variably damped wedge carries load where the bolster lies below the place at which the control coil is
/// just free: 2.4333 in on 3000 lbf/in are 7300 lbf. That, and 1350 lbf, are the ends of the range of
/// side-spring forces in US patent 6,269,752 (2001), on wedges. With constant damping the height makes no
/// difference.
const DAMPINGS: [(&str, &str); 2] = [("constant", "0 in"), ("variable", LOADED)];
const LOADED: &str = "-2.4333 in";
const EMPTY: &str = "-0.45 in";

pub(super) fn groups() -> Vec<CaseGroup> {
    vec![
        warp(),
        rig(),
        sweep(),
        twist_and_roll(),
        yaw_and_sway(),
        load(),
        wear(),
        lock_up(),
        overturned_toe(),
    ]
}

fn warp() -> CaseGroup {
    let case = |(name, friction, free, title): (&str, &str, &str, &str)| {
        BuiltIn::new(
            format!("warp_{name}"),
            format!("constant damping, pocket yaws by 0.02 rad at 0.05 Hz; {title}"),
            &format!(
                r#"
[wedge]
damping = "constant"
free_coordinates = [{free}]
{COMMON}column = {friction}
slope = {friction}
[bolster]
vertical = "0 in"
yaw = {{ shape = "sine", amplitude = "0.02 rad", frequency = "0.05 Hz" }}
[simulation]
duration = "50 s"
output_interval = "0.02 s"
start = "equilibrium"
"#
            ),
        )
    };
    let (four, six) = (
        r#""x", "z", "pitch", "yaw""#,
        r#""x", "y", "z", "roll", "pitch", "yaw""#,
    );
    CaseGroup {
        name: "warp",
        title: "Warp test: the pocket yaws slowly against the side frame",
        look_at: "With friction 0.2 the wedge is squeezed down until the column bears on one edge: the \
                  moment runs along the edge-loading limit N_c h3/2 (a nest of two wedges: N_c h3), and \
                  stays well below it where the wedge may roll away. With friction 0.4 it jams instead: \
                  N_c, and the limit with it, grow with the yaw against the contacts' stiffness.",
        cases: [
            ("friction_0.2", "0.2", four, "friction 0.2"),
            (
                "friction_0.2_rolling",
                "0.2",
                six,
                "friction 0.2, wedge free to roll and to move across",
            ),
            ("friction_0.4", "0.4", four, "friction 0.4"),
        ]
        .map(case)
        .into(),
    }
}

fn rig() -> CaseGroup {
    let case = |(damping, middle): (&str, &str)| {
        BuiltIn::new(
            format!("rig_{damping}"),
            format!("{damping} damping, toe out, triangle of 1 in at 0.1 Hz"),
            &format!(
                r#"
[wedge]
damping = "{damping}"
{COMMON}[side_frame]
toe = "0.2 deg out"
[bolster]
vertical = [{{ shape = "triangle", amplitude = "1 in", frequency = "0.1 Hz" }}, "{middle}"]
[simulation]
duration = "25 s"
output_interval = "0.02 s"
start = "equilibrium"
"#
            ),
        )
    };
    CaseGroup {
        name: "rig",
        title: "Rig test: a triangle at 0.1 Hz, as truck springs and snubbers are tested",
        look_at: "The loop leans away from the straight lines of the quasi-static wedge and comes to them \
                  late in a stroke, if at all: at each reversal the slope's friction must turn over too, \
                  and there the wedge slides by a hundredth of an inch only. The area of the loop is the \
                  damping that a rig would report, its lean a stiffness that no spring has.",
        cases: DAMPINGS.map(case).into(),
    }
}

fn sweep() -> CaseGroup {
    let mut cases = Vec::new();
    for (damping, middle) in DAMPINGS {
        for amplitude in ["0.25", "0.5", "1"] {
            for (frequency, duration) in [("0.5", "5.02 s"), ("1", "2.52 s"), ("2", "1.26 s")] {
                cases.push(BuiltIn::new(
                    format!("sweep_{damping}_{amplitude}in_{frequency}hz"),
                    format!("{damping} damping, toe out, {amplitude} in at {frequency} Hz"),
                    &sine(damping, "", amplitude, frequency, middle, duration),
                ));
            }
        }
    }
    CaseGroup {
        name: "sweep",
        title: "Amplitude and frequency: equivalent stiffness and damping",
        look_at: "The equivalent damping falls with one over the frequency and one over the amplitude, as \
                  that of dry friction does, close to the quasi-static lines: a linear damper fitted to one \
                  motion is wrong for every other. The equivalent stiffness does not care for the \
                  frequency, but is the greater the smaller the amplitude, because more of the stroke goes \
                  into turning the friction over.",
        cases,
    }
}

fn twist_and_roll() -> CaseGroup {
    let case = |(damping, middle): (&str, &str)| {
        BuiltIn::new(
            format!("twist_and_roll_{damping}"),
            format!(
                "{damping} damping; assumed: 39 ft rails at 15 mph (0.564 Hz), bolster rolls by 1 deg about \
                 the truck's middle, 39 in away, which lifts it by 0.681 in at the wedge"
            ),
            &format!(
                r#"
[wedge]
damping = "{damping}"
free_coordinates = ["x", "y", "z", "roll", "pitch", "yaw"]
{COMMON}[bolster]
vertical = [
    {{ shape = "sine", amplitude = "0.681 in", frequency = "0.5641 Hz", phase = "90 deg" }},
    "{middle}",
]
roll = {{ shape = "sine", amplitude = "1 deg", frequency = "0.5641 Hz", phase = "90 deg" }}
[simulation]
duration = "6.3 s"
start = "equilibrium"
"#
            ),
        )
    };
    CaseGroup {
        name: "twist_and_roll",
        title: "Motion of the pocket as in twist and roll: vertical and roll together",
        look_at: "The vertical force on the bolster jumps at each reversal and, with constant damping, \
                  holds its level between, whatever the speed; with variable damping it follows the coil as \
                  well. The roll moment peaks at the reversals, where the wedge sticks and is turned along \
                  with the pocket, and fades as soon as it slides.",
        cases: DAMPINGS.map(case).into(),
    }
}

fn yaw_and_sway() -> CaseGroup {
    let case = |(damping, middle): (&str, &str)| {
        BuiltIn::new(
            format!("yaw_and_sway_{damping}"),
            format!(
                "{damping} damping; assumed: 39 ft alignment at 50 mph (1.880 Hz), side frame moves by 0.25 \
                 in across under the bolster, bolster yaws against it by 0.004 rad a quarter period later"
            ),
            &format!(
                r#"
[wedge]
damping = "{damping}"
free_coordinates = ["x", "z", "roll", "pitch", "yaw"]
{COMMON}[side_frame]
lateral = {{ shape = "sine", amplitude = "0.25 in", frequency = "1.8803 Hz", phase = "90 deg" }}
[bolster]
vertical = "{middle}"
yaw = {{ shape = "sine", amplitude = "0.004 rad", frequency = "1.8803 Hz" }}
[simulation]
duration = "2.2 s"
output_interval = "0.005 s"
start = "equilibrium"
"#
            ),
        )
    };
    CaseGroup {
        name: "yaw_and_sway",
        title: "Motion of the pocket as in yaw and sway: the side frame slides across, the bolster yaws",
        look_at: "The lateral force is the column's friction, which points where the side frame slides: it \
                  turns over at each reversal and follows the normal force, not the displacement. The yaw \
                  moment follows the bolster's yaw instead, up to the edge that bears.",
        cases: DAMPINGS.map(case).into(),
    }
}

fn load() -> CaseGroup {
    let mut cases = Vec::new();
    for (damping, _) in DAMPINGS {
        for (load, height) in [("empty", EMPTY), ("loaded", LOADED)] {
            cases.push(BuiltIn::new(
                format!("load_{damping}_{load}"),
                format!(
                    "{damping} damping, toe out, 0.25 in at 1 Hz; assumed for an {load} car: bolster at \
                         {height}"
                )
                .replace("an loaded", "a loaded"),
                &sine(damping, "", "0.25", "1", height, "2.52 s"),
            ));
        }
    }
    CaseGroup {
        name: "load",
        title: "Empty and loaded car: small motions about two heights of the bolster",
        look_at: "With variable damping the loaded car's loop holds more than five times the energy of the \
                  empty car's: friction follows the coil's load, 7300 lbf against 1350. With constant \
                  damping both loops are the same but for the toe, so that an empty car is damped as hard \
                  as a loaded one.",
        cases,
    }
}

fn wear() -> CaseGroup {
    let mut cases = Vec::new();
    for (damping, middle) in DAMPINGS {
        for depth in ["0", "0.1", "0.2", "0.3"] {
            let worn = format!("column_wear = \"{depth} in\"\nslope_wear = \"{depth} in\"");
            cases.push(BuiltIn::new(
                format!("wear_{damping}_{depth}in"),
                format!(
                    "{damping} damping, toe out, column and slope worn by {depth} in each, 0.25 in at 1 Hz"
                ),
                &sine(damping, &worn, "0.25", "1", middle, "2.52 s"),
            ));
        }
    }
    CaseGroup {
        name: "wear",
        title: "Wear of the faces: how far the wedge rises, and what damping is left",
        look_at: "The wedge rises by (w_c cos θ + w_s cos φ)/sin(θ + φ), three to three and a half times \
                  the depth where both faces wear alike: its height tells the wear. The coil lengthens by \
                  as much, and the energy lost in a cycle falls about as its force does.",
        cases,
    }
}

/// Returns a case in which the bolster presses the wedge against the column, pushes it down while it is
/// pressed, and rises.
fn lock_up() -> CaseGroup {
    let ramp = |amplitude: &str, start: &str| {
        format!(
            "{{ shape = \"ramp\", amplitude = \"{amplitude} in\", start = \"{start} s\", duration = \"1 s\", \
             profile = \"half_cosine\" }}"
        )
    };
    let (pressed, pushed, raised) = (ramp("-0.03", "0.2"), ramp("-0.2", "1.5"), ramp("0.3", "3"));
    let case = |friction: &str| {
        BuiltIn::new(
            format!("lock_up_friction_{friction}"),
            format!(
                "constant damping, bolster pressed in by 0.03 in, then forced down, then up; friction \
                 {friction}"
            ),
            &format!(
                r#"
[wedge]
damping = "constant"
{COMMON}column = {friction}
slope = {friction}
[bolster]
longitudinal = {pressed}
vertical = [{pushed}, {raised}]
[simulation]
duration = "4.5 s"
start = "equilibrium"
"#
            ),
        )
    };
    CaseGroup {
        name: "lock_up",
        title: "Lock-up and release: the bolster presses, is forced down, and rises",
        look_at: "With friction 0.2 the pressed wedge slides down until its force is that of the \
                  quasi-static wedge; with 0.4 it locks, and its force grows against the stiffness of the \
                  contacts. The locked bolster moves down under a vertical force of μ N_c only, and 0.05 in \
                  upwards free it.",
        cases: ["0.2", "0.4"].map(case).into(),
    }
}

/// Returns a column that leans in by more than the wedge's angle: the faces open upwards.
fn overturned_toe() -> CaseGroup {
    let case = BuiltIn::new(
        "overturned_toe".to_owned(),
        "constant damping, wedge of 18 deg and a column with 20 deg of toe in: the faces open upwards"
            .to_owned(),
        &format!(
            r#"
[wedge]
damping = "constant"
angle = "18 deg"
[control_coil]
damping = "0 lbf s/in"
pulls = false
{COMMON}[side_frame]
toe = "20 deg in"
[bolster]
vertical = "0 in"
[simulation]
duration = "0.1 s"
output_interval = "0.001 s"
relative_tolerance = 1e-7
start = "touching"
"#
        ),
    );
    CaseGroup {
        name: "overturned_toe",
        title: "Overturned toe: the column leans in by more than the wedge's angle",
        look_at: "Nothing holds the wedge: the coil throws it out, and what the coil had stored is found in \
                  its height and speed. The run says so in its warnings, and its ledger closes.",
        cases: vec![case],
    }
}

/// Returns a case file: the bolster moves in a sine about a height, with toe out.
fn sine(
    damping: &str,
    wedge: &str,
    amplitude: &str,
    frequency: &str,
    middle: &str,
    duration: &str,
) -> String {
    format!(
        r#"
[wedge]
damping = "{damping}"
{wedge}
{COMMON}[side_frame]
toe = "0.2 deg out"
[bolster]
vertical = [
    {{ shape = "sine", amplitude = "{amplitude} in", frequency = "{frequency} Hz", phase = "90 deg" }},
    "{middle}",
]
[simulation]
duration = "{duration}"
start = "equilibrium"
"#
    )
}

//! Expected contents of the figures, after the thesis's appendices D and E.

use std::collections::BTreeMap;

use crate::runs::{Csv, NAMES};

/// Expected contents of a figure: of these runs one column over another (with an offset), these rows
/// (counted from one), these limits.
pub struct Wanted {
    pub runs: Vec<String>,
    pub labels: Vec<&'static str>,
    pub x: (&'static str, f64),
    pub y: &'static str,
    pub rows: (usize, usize),
    pub x_limits: Option<[f64; 2]>,
    pub y_limits: Option<[f64; 2]>,
}

const ALL: (usize, usize) = (1, 1001);
const TIME: (&str, f64) = ("time_s", 0.0);
const HEIGHT: &str = "wedge_z_in";
const ON_FRAME: &str = "vertical_force_on_side_frame_lbf";
const FRICTION: &str = "vertical_wedge_force_lbf";
const LONGITUDINAL: &str = "longitudinal_wedge_force_lbf";
const POWER: &str = "side_frame_friction_power_lbf_in_per_s";
const PITCH: &str = "side_frame_pitch_moment_lbf_in";
const YAW: &str = "side_frame_yaw_moment_lbf_in";
const COIL: &str = "coil_force_lbf";

/// Name, x and its offset, y, rows, limits in x.
type Row = (
    &'static str,
    (&'static str, f64),
    &'static str,
    (usize, usize),
    Option<[f64; 2]>,
);

pub fn wanted() -> BTreeMap<String, Wanted> {
    let mut all = BTreeMap::new();
    let mut toes = |prefix: &str, damping: &str, yaw: &str, rows: &[Row]| {
        for (name, x, y, rows, x_limits) in rows {
            let runs = ["out_0.2", "0", "in_0.2"].map(|toe| format!("{damping}run_toe_{toe}_psi_{yaw}"));
            let wanted = Wanted {
                runs: runs.to_vec(),
                labels: vec!["Toe Out", "No Toe", "Toe In"],
                x: *x,
                y,
                rows: *rows,
                x_limits: *x_limits,
                y_limits: None,
            };
            all.insert(format!("{prefix}_{name}"), wanted);
        }
    };
    let whole = Some([0.0, 10.0]);
    let near = Some([4.0, 7.0]);
    toes(
        "variable_vertical",
        "vd",
        "0",
        &[
            ("force", TIME, ON_FRAME, ALL, whole),
            ("force_near", TIME, ON_FRAME, ALL, near),
            ("longitudinal", TIME, LONGITUDINAL, ALL, whole),
            ("dissipation", TIME, POWER, ALL, whole),
            ("hysteresis", (HEIGHT, 10.25), ON_FRAME, (1, 400), None),
            ("longitudinal_near", TIME, LONGITUDINAL, (400, 700), near),
            ("dissipation_near", TIME, POWER, ALL, near),
        ],
    );
    let cut = Some([0.1, 10.0]);
    toes(
        "variable_yaw",
        "vd",
        "0.012",
        &[
            ("force", TIME, ON_FRAME, ALL, cut),
            ("longitudinal", TIME, LONGITUDINAL, ALL, cut),
            ("dissipation", TIME, POWER, ALL, cut),
            ("hysteresis", (HEIGHT, 10.25), ON_FRAME, (300, 700), None),
            ("force_near", TIME, ON_FRAME, ALL, near),
            ("pitch_moment", TIME, PITCH, ALL, cut),
            ("yaw_moment", TIME, YAW, ALL, cut),
            ("longitudinal_near", TIME, LONGITUDINAL, ALL, near),
            ("dissipation_near", TIME, POWER, ALL, near),
        ],
    );
    let cut = Some([0.5, 10.0]);
    let near = Some([3.5, 7.5]);
    toes(
        "constant_vertical",
        "cd",
        "0",
        &[
            ("force", TIME, FRICTION, ALL, cut),
            ("longitudinal", TIME, LONGITUDINAL, ALL, cut),
            ("dissipation", TIME, POWER, ALL, cut),
            ("hysteresis", (HEIGHT, 9.95), FRICTION, (350, 750), None),
            ("coil_force", TIME, COIL, ALL, None),
            ("force_near", TIME, FRICTION, ALL, near),
            ("longitudinal_near", TIME, LONGITUDINAL, ALL, near),
            ("dissipation_near", TIME, POWER, ALL, near),
            ("pitch_moment", TIME, PITCH, ALL, whole),
            ("yaw_moment", TIME, YAW, ALL, whole),
            ("coil_over_length", ("coil_length_in", 0.0), COIL, ALL, None),
        ],
    );
    let cut = Some([0.4, 10.0]);
    let near = Some([3.8, 7.2]);
    let moments = Some([0.1, 10.0]);
    toes(
        "constant_yaw",
        "cd",
        "0.012",
        &[
            ("force", TIME, FRICTION, ALL, cut),
            ("longitudinal", TIME, LONGITUDINAL, ALL, cut),
            ("dissipation", TIME, POWER, ALL, cut),
            ("hysteresis", (HEIGHT, 9.95), FRICTION, (350, 750), None),
            ("pitch_moment", TIME, PITCH, ALL, moments),
            ("yaw_moment", TIME, YAW, ALL, moments),
            ("force_near", TIME, FRICTION, ALL, near),
            ("longitudinal_near", TIME, LONGITUDINAL, ALL, near),
            ("dissipation_near", TIME, POWER, ALL, near),
        ],
    );
    let cut = Some([0.5, 10.0]);
    let travel = Some([-1.1, 1.1]);
    let mut single = |name: &str, run: &str, x, y, rows, x_limits, y_limits| {
        let wanted = Wanted {
            runs: vec![run.to_owned()],
            labels: vec!["Wedgelab"],
            x,
            y,
            rows,
            x_limits,
            y_limits,
        };
        all.insert(name.to_owned(), wanted);
    };
    let [variable, variable_yaw, constant, constant_yaw] = [NAMES[0], NAMES[3], NAMES[6], NAMES[9]];
    single("bolster", variable, TIME, "bolster_vertical_in", ALL, whole, None);
    let rise = (HEIGHT, 0.0);
    let most = |force: f64| Some([0.0, force]);
    single(
        "toe_out_variable_force",
        variable,
        TIME,
        ON_FRAME,
        ALL,
        whole,
        None,
    );
    single(
        "toe_out_variable_hysteresis",
        variable,
        rise,
        ON_FRAME,
        (1, 400),
        None,
        None,
    );
    single(
        "toe_out_variable_longitudinal",
        variable,
        TIME,
        LONGITUDINAL,
        ALL,
        whole,
        most(8000.0),
    );
    single(
        "toe_out_variable_dissipation",
        variable,
        TIME,
        POWER,
        ALL,
        whole,
        None,
    );
    let later = (5, 1000);
    single(
        "toe_out_variable_yaw_force",
        variable_yaw,
        TIME,
        ON_FRAME,
        later,
        whole,
        None,
    );
    single(
        "toe_out_variable_yaw_hysteresis",
        variable_yaw,
        rise,
        ON_FRAME,
        (300, 700),
        None,
        None,
    );
    single(
        "toe_out_variable_yaw_longitudinal",
        variable_yaw,
        TIME,
        LONGITUDINAL,
        later,
        whole,
        most(6000.0),
    );
    single(
        "toe_out_variable_yaw_dissipation",
        variable_yaw,
        TIME,
        POWER,
        later,
        whole,
        None,
    );
    let heights = Csv::of(constant).get(HEIGHT);
    let largest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let centred = (HEIGHT, -0.5 * (largest + smallest));
    single("toe_out_constant_force", constant, TIME, FRICTION, ALL, cut, None);
    single(
        "toe_out_constant_hysteresis",
        constant,
        centred,
        FRICTION,
        (350, 750),
        travel,
        Some([-2100.0, 2600.0]),
    );
    single(
        "toe_out_constant_longitudinal",
        constant,
        TIME,
        LONGITUDINAL,
        ALL,
        cut,
        most(8000.0),
    );
    single(
        "toe_out_constant_dissipation",
        constant,
        TIME,
        POWER,
        ALL,
        cut,
        None,
    );
    single(
        "toe_out_constant_yaw_force",
        constant_yaw,
        TIME,
        FRICTION,
        ALL,
        cut,
        None,
    );
    single(
        "toe_out_constant_yaw_hysteresis",
        constant_yaw,
        rise,
        FRICTION,
        (350, 750),
        travel,
        None,
    );
    single(
        "toe_out_constant_yaw_dissipation",
        constant_yaw,
        TIME,
        POWER,
        ALL,
        cut,
        None,
    );
    single(
        "toe_out_constant_both_longitudinal",
        constant,
        TIME,
        LONGITUDINAL,
        ALL,
        cut,
        most(8000.0),
    );
    let both = all.get_mut("toe_out_constant_both_longitudinal").unwrap();
    both.runs.push(constant_yaw.to_owned());
    both.labels = vec!["Vertical", "Yaw"];
    all.get_mut("bolster").unwrap().labels = vec!["z=sin(2t)"];
    all
}

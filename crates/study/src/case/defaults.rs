//! The thesis's values, which complete what a case leaves out: they are case files themselves.

use super::document::{Damping, METHODS};
use super::problem::{Problems, TomlSource};
use super::section::name_of;
use super::tree::{self, TableNode};
use integrate::Method;

/// The name of these values as a source.
pub(crate) const SOURCE: &str = "the thesis's values";

/// The part that both dampings share (Steets 2007, tables 3-1 to 3-4).
const COMMON: &str = r#"
title = ""
[wedge]
height = "6.125 in"
width = "10.5 in"
weight = "50 lbf"
inertia = ["100 lb in^2", "100 lb in^2", "100 lb in^2"]
center_of_gravity = ["-1.0734 in", "0 in", "2.0417 in"]
column_wear = "0 in"
slope_wear = "0 in"
free_coordinates = ["x", "z", "pitch", "yaw"]
[control_coil]
damping = "1 lbf s/in"
acts_at = "center_of_gravity"
pulls = true
[contact]
stiffness = "2.5e5 lbf/in"
damping = "0 lbf s/in"
[friction]
law = "tanh"
column = 0.4
slope = 0.4
reference_speed = "0.001 in/s"
bristle_stiffness = "1e6 lbf/in"
bristle_damping = "1e3 lbf s/in"
[column_face]
grid = [2, 2]
wedge_surface = "flat"
counterface = "flat"
[slope_face]
grid = [2, 2]
wedge_surface = "flat"
counterface = "flat"
[side_frame]
toe = "0 deg"
longitudinal = "0 in"
lateral = "0 in"
vertical = "0 in"
roll = "0 deg"
pitch = "0 deg"
yaw = "0 deg"
[bolster]
longitudinal = "0 in"
lateral = "0 in"
vertical = { shape = "sine", amplitude = "1 in", frequency = "2 rad/s", phase = "0 deg" }
roll = "0 deg"
pitch = "0 deg"
yaw = "0 rad"
[environment]
gravity = "9.80665 m/s^2"
[simulation]
duration = "10 s"
output_interval = "0.01 s"
relative_tolerance = 1e-6
start = "rest"
output_units = "us"
"#;

const VARIABLE: &str = r#"
[wedge]
damping = "variable"
angle = "32 deg"
[control_coil]
stiffness = "3000 lbf/in"
free_length = "10.25 in"
nominal_length = "10.25 in"
"#;

/// The nominal length is 7.25 in - 3702.2 lbf / (1979 lbf/in), rounded to the nearest `f64`.
const CONSTANT: &str = r#"
[wedge]
damping = "constant"
angle = "37.5 deg"
[control_coil]
stiffness = "1979 lbf/in"
free_length = "7.25 in"
nominal_length = "5.379257200606367 in"
"#;

/// Returns the values that complete a case of this damping.
pub(super) fn tree(damping: Damping) -> Result<TableNode, Problems> {
    let own = match damping {
        Damping::Variable => VARIABLE,
        Damping::Constant => CONSTANT,
    };
    let method = format!(
        "[simulation]\nmethod = \"{}\"\n",
        name_of(METHODS, &Method::default())
    );
    let mut table = TableNode::default();
    for text in [own, COMMON, &method] {
        table.complete_from(&tree::parse(&TomlSource::new(SOURCE, text))?);
    }
    Ok(table)
}

//! limits: a wedge of the truck between a side frame and a bolster that are prescribed is the single wedge of
//! the thesis, whichever of the four mounts it is in.
#![allow(clippy::unwrap_used)]

use study::case::builtin;
use study::run::Run;
use study::truck::{TruckCase, WEDGE_NAMES};

use super::common::{INCH, column};

/// Of the whole run: mean size of the column's vertical friction (N), and the energies lost at column and
/// slope, J.
type Averages = [f64; 3];

/// From the coil's end to the center of gravity.
const CENTER: &str = r#"["-1.0734 in", "0 in", "2.0416666666666665 in"]"#;

fn mean_size(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).sum::<f64>() / values.len() as f64
}

fn single(name: &str) -> Averages {
    let set = [
        "simulation.relative_tolerance=1e-9".to_owned(),
        // A third of the height to the last digit; the thesis rounds it.
        format!("wedge.center_of_gravity={CENTER}"),
    ];
    let result = Run::new(&builtin::case_with(name, &set).unwrap())
        .unwrap()
        .finish(|_| ());
    let last = |name: &str| *result.column(name).unwrap().last().unwrap();
    [
        mean_size(result.column("vertical_wedge_force").unwrap()),
        last("side_frame_friction_loss"),
        last("bolster_friction_loss"),
    ]
}

fn mounted(number: usize, damping: &str, toe: &str) -> Averages {
    let name = WEDGE_NAMES[number];
    let [end, side] = [
        if number < 2 { 1.0 } else { -1.0 },
        if number.is_multiple_of(2) { 1.0 } else { -1.0 },
    ];
    let angle: f64 = if damping == "constant" { 37.5 } else { 32.0 };
    let length = 6.125 * angle.to_radians().tan();
    // The bolster turns about the middle of this pocket.
    let center = [end * (8.5 - length / 6.0), side * 39.5, 18.0 + 6.125 / 6.0];
    let others: String = WEDGE_NAMES
        .into_iter()
        .filter(|other| *other != name)
        .map(|other| format!("[wedge.{other}]\ncolumn_wear = \"1 in\"\n"))
        .collect();
    let text = format!(
        "model = \"truck\"\n[truck]\ndamping = \"{damping}\"\n[bolster]\n\
         center = [\"{} in\", \"{} in\", \"{} in\"]\n\
         vertical = {{ shape = \"sine\", amplitude = \"1 in\", frequency = \"2 rad/s\" }}\n\
         yaw = \"0.012 rad\"\n[side_frame]\nfree_coordinates = []\ntoe = \"{toe}\"\n[adapter]\n\
         kind = \"nothing\"\n[column_face]\ngrid = [2, 2]\n[slope_face]\ngrid = [2, 2]\nwedge_surface = \
         \"flat\"\n\
         [wedge]\ninertia = [\"100 lb in^2\", \"100 lb in^2\", \"100 lb in^2\"]\n\
         free_coordinates = [\"x\", \"z\", \"pitch\", \"yaw\"]\n[control_coil]\nkind = \"thesis\"\n\
         center_of_gravity = {CENTER}\n[contact]\ndamping = \"0 lbf s/in\"\n[friction]\nlaw = \"tanh\"\n\
         {others}[simulation]\nduration = \"10 s\"\nrelative_tolerance = 1e-9\n",
        center[0], center[1], center[2]
    );
    let case = TruckCase::parse("mount.toml", &text, study::case::Tables::nowhere(), &[]).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{name}: {:?}", result.summary.stopped);
    let last = |face: &str| {
        *column(&result, &format!("{name}_{face}_friction_loss"))
            .last()
            .unwrap()
    };
    // The single wedge rises and falls with the bolster by an inch.
    let z = column(&result, "bolster_z");
    assert!((z.iter().fold(0.0, |most: f64, z| most.max(*z)) / INCH - 1.0).abs() < 1e-3);
    [
        mean_size(column(&result, &format!("{name}_column_friction_z"))),
        last("column"),
        last("slope"),
    ]
}

/// With variable damping the wedge rings on undamped contacts and its run depends on the last bits: the
/// single wedge's own averages at tolerances of 1e-9 and 1e-10 are 3e-4 apart.
#[test]
fn limits_a_wedge_of_the_truck_is_the_thesis_wedge_from_all_four_mounts() {
    for (name, damping, toe, bound) in [
        ("cdrun_toe_out_0.2_psi_0.012", "constant", "0.2 deg out", 1e-6),
        ("cdrun_toe_0_psi_0.012", "constant", "0 deg", 1e-6),
        ("cdrun_toe_in_0.2_psi_0.012", "constant", "0.2 deg in", 1e-6),
        ("vdrun_toe_out_0.2_psi_0.012", "variable", "0.2 deg out", 1e-3),
    ] {
        let single = single(name);
        std::thread::scope(|scope| {
            for number in 0..4 {
                scope.spawn(move || {
                    let found = mounted(number, damping, toe);
                    for (found, expected) in found.iter().zip(single) {
                        let relative = (found / expected - 1.0).abs();
                        assert!(
                            relative < bound,
                            "{name} at {}: {found} and {expected}, {relative:e} apart",
                            WEDGE_NAMES[number]
                        );
                    }
                });
            }
        });
    }
}

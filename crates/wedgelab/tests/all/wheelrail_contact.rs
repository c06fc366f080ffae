//! reproduction, limits, input: `wedgelab wheelrail contact`, against CONTACT's results for the Manchester
//! contact benchmark, case.
//!
//! Reference: CONTACT (<https://github.com/eve70a/CONTACT>), examples `mbench_a22_left` and
//! `mbench_a22_right`, revision 2707: y to the right, z down, forces on the rail. The command answers in the
//! same frame, so that nothing is converted here.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

fn profiles() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../wheelrail/tests/data/manchester")
}

fn command(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(profiles())
        .args(["wheelrail", "contact"])
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

fn answer(arguments: &[&str]) -> Value {
    let (code, out, err) = command(arguments);
    assert_eq!(code, Some(0), "{arguments:?}: {err}");
    serde_json::from_str(&out).unwrap()
}

/// Returns the benchmark at a lateral shift (mm, to the right), with roll (rad) and pitch rate (rad/s).
fn manchester(shift: f64, roll: f64, pitch_rate: f64, creep: &str) -> Value {
    answer(&[
        "MBench_S1002_v3.prw",
        "MBench_UIC60_v3.prr",
        "--gauge",
        "1435 mm",
        "--lateral",
        &format!("{shift} mm"),
        "--yaw",
        &format!("{} rad", 2.4e-3 * shift),
        "--roll",
        &format!("{roll} rad"),
        "--load",
        "10 kN",
        "--speed",
        "2 m/s",
        "--pitch-rate",
        &format!("{pitch_rate} rad/s"),
        "--friction",
        "0.3",
        "--creep",
        creep,
        "--json",
    ])
}

/// Returns a key's values of all patches of a wheel.
fn all(answer: &Value, side: &str, key: &str) -> Vec<f64> {
    let patches = answer[side].as_array().unwrap();
    patches.iter().map(|patch| patch[key].as_f64().unwrap()).collect()
}

/// Sum of a key weighted by another one, over the sum of the weights.
fn mean(answer: &Value, side: &str, key: &str) -> f64 {
    let weights = all(answer, side, "normal_n");
    let sum: f64 = all(answer, side, key)
        .iter()
        .zip(&weights)
        .map(|(v, w)| v * w)
        .sum();
    sum / weights.iter().sum::<f64>()
}

fn sum(answer: &Value, side: &str, key: &str) -> f64 {
    all(answer, side, key).iter().sum()
}

/// Places within 1 mm, angles within 4 mrad, normal forces within 1 %, creep forces within 10 % of their
/// size, creepages of the right wheel within 3 % of their size, at 0 mm, where they are those of a rolling
/// radius 0.04 mm apart, within 1e-4. Signs are CONTACT's.
#[test]
fn reproduction_manchester_contact_benchmark_in_the_frame_of_contact() {
    // Shift, roll, pitch rate; y, angle, FN, FX, FS left and right; creepages right.
    let rows = [
        (
            [0.0, 0.0, -4.348_118_1],
            [-751.87, 0.0290, 9997.0, 0.28, 253.6],
            [751.87, -0.0290, 9997.0, 0.28, -253.6],
            [-5.67e-5, 0.0],
        ),
        (
            [1.0, -5.049e-5, -4.346_575_2],
            [-755.24, 0.0176, 10050.0, 829.0, -2893.0],
            [741.99, -0.0696, 9827.0, -814.0, -2832.0],
            [6.94e-4, 2.407e-3],
        ),
        (
            [2.0, -1.128e-4, -4.345_919_7],
            [-756.51, 0.0134, 10040.0, 546.0, -2961.0],
            [740.91, -0.0806, 9799.0, -517.0, -2893.0],
            [8.75e-4, 4.818e-3],
        ),
        (
            [4.0, -2.557e-4, -4.344_093],
            [-757.66, 0.0096, 10030.0, 437.0, -2977.0],
            [738.74, -0.1078, 9745.0, -380.0, -2898.0],
            [1.28e-3, 9.66e-3],
        ),
    ];
    for ([shift, roll, pitch_rate], left, right, creepages) in rows {
        let found = manchester(shift, roll, pitch_rate, "fastsim");
        for (side, [y, angle, normal, x, lateral]) in [("left", left), ("right", right)] {
            let what = format!("{shift} mm, {side}: {:#}", found[side]);
            assert!((mean(&found, side, "y_mm") - y).abs() < 1.0, "{what}");
            assert!((mean(&found, side, "angle_rad") - angle).abs() < 4e-3, "{what}");
            assert!(
                (sum(&found, side, "normal_n") / normal - 1.0).abs() < 0.01,
                "{what}"
            );
            let difference = f64::hypot(sum(&found, side, "fx_n") - x, sum(&found, side, "fy_n") - lateral);
            let scale = f64::hypot(x, lateral);
            assert!(difference < 0.1 * scale, "{what}");
            let vertical = found[format!("{side}_wheel")]["vertical_force_n"]
                .as_f64()
                .unwrap();
            assert!((vertical / 1e4 - 1.0).abs() < 1e-6, "{vertical}");
        }
        let [x, y] = ["creepage_x", "creepage_y"].map(|key| mean(&found, "right", key));
        let difference = f64::hypot(x - creepages[0], y - creepages[1]);
        let within = match shift {
            0.0 => 1e-4,
            _ => 0.03 * f64::hypot(creepages[0], creepages[1]),
        };
        assert!(difference < within, "{shift} mm: {x} {y}, {creepages:?}");
    }
}

/// The spin is that of the geometry, `-Ω sin δ / V` on the rail's side, with opposite signs left and right;
/// the spin moment opposes it where there is no lateral creepage. Kalker's linear law has the signs of its
/// own formula.
#[test]
fn analytic_spin_and_its_moment_have_the_signs_of_the_frame() {
    let found = manchester(0.0, 0.0, -4.348_118_1, "linear");
    for (side, sign) in [("left", -1.0), ("right", 1.0)] {
        for patch in found[side].as_array().unwrap() {
            let of = |key: &str| patch[key].as_f64().unwrap();
            let expected = sign * 4.348_118_1 / 2.0 * of("angle_rad").abs().sin() * 1e-3;
            let spin = of("spin_per_mm");
            assert!((spin / expected - 1.0).abs() < 1e-6, "{side}: {spin} {expected}");
            assert!(of("spin_moment_nmm") * spin < 0.0, "{patch:#}");
            // Without lateral creepage the lateral force is -G a b √(ab) C23 φ.
            assert!(
                of("fy_n") * spin < 0.0 && of("creepage_y").abs() < 1e-12,
                "{patch:#}"
            );
        }
    }
}

/// The laws agree within 5 % below 15 % of the limit of friction, and differ where forces saturate: the
/// linear one exceeds it.
#[test]
fn limits_laws_agree_at_small_creepages_and_saturate() {
    let laws = ["linear", "shen_hedrick_elkins", "polach", "fastsim"];
    let size = |answer: &Value| f64::hypot(sum(answer, "right", "fx_n"), sum(answer, "right", "fy_n"));
    let small = laws.map(|law| {
        let arguments = [
            "cone_1:20",
            "136re",
            "--load",
            "100 kN",
            "--tape-distance",
            "1504.16 mm",
            "--pitch-rate",
            "-4.3725 rad/s",
        ];
        let found = answer(&[&arguments[..], &["--creep", law, "--json"]].concat());
        assert_eq!(found["given"]["creep"], *law);
        (sum(&found, "right", "normal_n"), size(&found))
    });
    for (normal, force) in small {
        assert!(
            force < 0.15 * 0.3 * normal && (force / small[0].1 - 1.0).abs() < 0.05,
            "{small:?}"
        );
    }
    let large = laws.map(|law| {
        let found = manchester(4.0, -2.557e-4, -4.344_093, law);
        size(&found) / (0.3 * sum(&found, "right", "normal_n"))
    });
    assert!(large[0] > 1.5, "{large:?}");
    assert!(
        large[1..].iter().all(|share| *share > 0.9 && *share < 1.001),
        "{large:?}"
    );
}

/// Wheels that have climbed or left their rail are results that say so.
#[test]
fn limits_derailed_wheels_are_reported_with_their_places() {
    let at = |lateral: &str, json: bool| {
        let arguments = ["aar_1b", "136re", "--load", "146.8 kN", "--lateral", lateral];
        let json: &[&str] = if json { &["--json"] } else { &[] };
        command(&[&arguments[..], json].concat())
    };
    let (_, out, _) = at("80 mm", false);
    assert!(
        out.contains("right wheel has climbed") && out.contains("y = 835.65 mm"),
        "{out}"
    );
    let (code, out, _) = at("-80 mm", true);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(
        (code, &found["left_wheel"]["seat"]),
        (Some(0), &Value::from("flange_tip"))
    );
    let (_, out, _) = at("200 mm", true);
    let found: Value = serde_json::from_str(&out).unwrap();
    for (side, y) in [("left", -555.65), ("right", 955.65)] {
        let wheel = &found[format!("{side}_wheel")];
        assert_eq!(wheel["seat"], "off_rail", "{found:#}");
        assert!(
            (wheel["center_y_mm"].as_f64().unwrap() - y).abs() < 0.01,
            "{found:#}"
        );
        assert!(found[side].as_array().unwrap().is_empty() && wheel["height_mm"].is_null());
    }
    let (_, out, _) = at("200 mm", false);
    assert!(
        out.contains("left wheel is off its rail") && out.contains("y = -555.65 mm"),
        "{out}"
    );
}

/// Mistakes are refused with a remedy; the frame stands in the help and in the answer.
#[test]
fn input_mistakes_are_refused_and_the_frame_is_reported() {
    for (arguments, texts) in [
        (&["--load", "10 mm"][..], &["this is a length", "N"][..]),
        (&["--load", "-10 kN"], &["load", "positive"]),
        (
            &["--load", "1000 MN"],
            &["no height of the left wheel carries", "load of one wheel"],
        ),
        (&["--load", "10 kN", "--speed", "0 m/s"], &["speed", "positive"]),
        (
            &["--load", "10 kN", "--creep", "contact"],
            &["shen_hedrick_elkins"],
        ),
        (
            &["--load", "10 kN", "--friction", "-0.3"],
            &["friction", "between 0 and 2"],
        ),
        (&["--load", "10 kN", "--yaw", "3 mm"], &["angle"]),
        (&["--load", "10 kN", "--lateral", "2 m"], &["within 1 m"]),
        (&["--load", "10 kN", "--shear-modulus", "82"], &["82 GPa"]),
        (&["--load", "10 kN", "--poisson", "0.7"], &["0 to 0.5"]),
        (&[], &["--load"]),
    ] {
        let (code, out, err) = command(&[&["aar_1b", "136re"], arguments].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {out}");
        assert!(
            texts.iter().all(|text| err.contains(text)),
            "{arguments:?}: {err}"
        );
    }
    let (_, help, _) = command(&["--help"]);
    assert!(
        help.contains("y to the right, z down") && help.contains("negative pitch rate"),
        "{help}"
    );
    let found = answer(&["aar_1b", "136re", "--load", "10 kN", "--json"]);
    let frame = found["frame"].as_str().unwrap();
    assert!(
        frame.contains("y to the right, z down") && frame.contains("negative pitch rate"),
        "{frame}"
    );
    assert_eq!(found["given"]["nominal_radius_mm"], 457.2);
}

/// Every command refuses a wheel as the rail and a rail as the wheel, with exit code 2 and nothing written;
/// `check` prints where gauge is measured, and the rail's place: 750 mm from the middle in EN 15302.
#[test]
fn issue_047_every_command_tells_wheels_from_rails_and_measures_gauge_from_the_datum() {
    let data = profiles().join("../en15302");
    let [wheel, rail] = ["wheel_a.csv", "rail_a.csv"].map(|file| data.join(file).display().to_string());
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("track.toml"),
        "[[segments]]\ntangent = \"100 ft\"\n",
    )
    .unwrap();
    let call = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(folder.path())
            .arg("wheelrail")
            .args(arguments)
            .env_remove("FORCE_COLOR")
            .output()
            .unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.code(), out, err)
    };
    for (wheel, rail, said) in [
        (
            &wheel,
            &wheel,
            "this looks like a wheel, where a rail is expected: it has a flange of 28.0 mm",
        ),
        (
            &rail,
            &rail,
            "this looks like a rail, where a wheel is expected: it is highest at y = 14.6 mm",
        ),
        (&rail, &wheel, "this looks like a rail"),
    ] {
        for arguments in [
            &["check", wheel, rail][..],
            &["plot", wheel, rail],
            &["contact", wheel, rail, "--load", "100 kN"],
            &["run", wheel, rail, "track.toml", "--speed", "30 mph"],
        ] {
            let (code, _, err) = call(arguments);
            assert!(
                code == Some(2) && err.contains(said),
                "{arguments:?}: {code:?} {err}"
            );
            assert!(err.contains("if wheel and rail are exchanged"), "{err}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let arguments = [
        "check",
        &wheel,
        &rail,
        "--gauge",
        "1435 mm",
        "--gauge-depth",
        "14 mm",
        "--tape-distance",
        "1500 mm",
        "--deviation",
        "0 mm",
    ];
    let (code, out, err) = call(&arguments);
    assert_eq!(code, Some(0), "{err}");
    for text in [
        "gauge point at y = -32.500 mm, 14.000 mm below its datum z = 0",
        "which lies 0.492 mm below its highest point",
        "y = 0 lies 750.000 mm from the middle of the track",
    ] {
        assert!(out.contains(text), "{text}: {out}");
    }
}

/// Without a pitch rate the axle has no torque: a wheelset in the middle has next to no longitudinal forces,
/// those of a shifted one cancel. A given pitch rate counts.
#[test]
fn issue_048_a_wheelset_rolls_freely_by_default() {
    let usual = [
        "aar_1b", "136re", "--load", "146.8 kN", "--speed", "60 km/h", "--json",
    ];
    let found = answer(&usual);
    for side in ["left", "right"] {
        assert!(sum(&found, side, "fx_n").abs() < 1e-4 * 146.8e3, "{found:#}");
    }
    assert_eq!(found["given"]["free_rolling"], true);
    let shifted = answer(&[&usual[..], &["--lateral", "6 mm"]].concat());
    let [left, right] = ["left", "right"].map(|side| sum(&shifted, side, "fx_n"));
    assert!(left > 1e3 && (left + right).abs() < 0.01 * left, "{left} {right}");
    let rate = found["given"]["pitch_rate_rad_per_s"].as_f64().unwrap();
    let given = answer(&[&usual[..], &["--pitch-rate", &format!("{} rad/s", 1.001 * rate)]].concat());
    assert_eq!(given["given"]["free_rolling"], false);
    assert!(sum(&given, "left", "fx_n") < -1e3, "{given:#}");
    let (_, text, _) = command(&usual[..6]);
    assert!(text.contains("rolls freely: pitch rate -"), "{text}");
}

/// Answers are in the units of the load; `--units` says otherwise. Both are the same contact.
#[test]
fn issue_048_answers_are_in_the_units_of_the_question() {
    let of = |load: &str, more: &[&str]| {
        let arguments = [
            "aar_1b",
            "136re",
            "--load",
            load,
            "--lateral",
            "0.25 in",
            "--json",
        ];
        answer(&[&arguments[..], more].concat())
    };
    let (us, si) = (of("33 kip", &[]), of("33 kip", &["--units", "si"]));
    assert_eq!(
        (&us["units"], &si["units"]),
        (&Value::from("us"), &Value::from("si"))
    );
    assert_eq!(us["units"], of("33000 lbf", &[])["units"]);
    assert_eq!(of("146.8 kN", &[])["units"], "si");
    assert_eq!(of("146.8 kN", &["--units", "us"])["units"], "us");
    let pound_force = 4.448_221_615_260_5;
    for (in_us, in_si, factor) in [
        ("y_in", "y_mm", 25.4),
        ("normal_lbf", "normal_n", pound_force),
        ("fx_lbf", "fx_n", pound_force),
        ("spin_moment_lbf_in", "spin_moment_nmm", 25.4 * pound_force),
        ("spin_per_in", "spin_per_mm", 1.0 / 25.4),
        ("a_in", "a_mm", 25.4),
        (
            "greatest_pressure_ksi",
            "greatest_pressure_mpa",
            6.894_757_293_168_362,
        ),
    ] {
        let (a, b) = (sum(&us, "left", in_us), sum(&si, "left", in_si));
        assert!((a * factor / b - 1.0).abs() < 1e-12, "{in_us}: {a} {b}");
    }
    assert!(
        (us["given"]["load_lbf"].as_f64().unwrap() - 33e3).abs() < 1e-6,
        "{us:#}"
    );
    let (_, text, _) = command(&["aar_1b", "136re", "--load", "33 kip"]);
    assert!(text.contains("lbf"), "{text}");
    assert!(!text.contains("mm"), "{text}");
}

/// A gauge at which wheels fall in is told with numbers by every command that runs on it.
#[test]
fn issue_048_a_gauge_too_wide_for_the_wheels_is_told() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("track.toml"),
        "[[segments]]\ntangent = \"100 ft\"\n",
    )
    .unwrap();
    for arguments in [
        &["wheelrail", "check", "aar_1b", "136re", "--gauge", "68 in"][..],
        &[
            "wheelrail",
            "run",
            "aar_1b",
            "136re",
            "track.toml",
            "--speed",
            "30 mph",
            "--gauge",
            "68 in",
        ],
        &["run", "car_tangent_loaded", "--set", "rails.gauge=68 in"],
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(folder.path())
            .args(arguments)
            .env_remove("FORCE_COLOR")
            .output()
            .unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {err}");
        for part in [
            "the wheels do not reach both rails",
            "68.00 in",
            "lower the gauge to",
        ] {
            assert!(err.contains(part), "{arguments:?}: {part}: {err}");
        }
    }
}

/// Files of other programs, sections along a rail, sides that are not alike: said on the command line.
#[test]
fn input_files_and_sides_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    for (name, fall) in [("a.csv", 0.0), ("b.csv", -2.0)] {
        let mut text = "y [mm], z [mm]\n".to_owned();
        for i in -60..=60 {
            let y = 0.5 * f64::from(i);
            text += &format!("{y}, {:.6}\n", (9e4 - y * y).sqrt() - 300.0 + fall);
        }
        write(name, &text);
    }
    write("rails.slcs", "0 1000\n2\n0 0\n1\n0 'a.csv'\n1 'b.csv'\n");
    // A cone of 1:20 from the back of the flange, 70 mm before the taper line: MiniProf without its flange.
    let mut mini = "ProgramName=MiniProf for Windows\nDiameterTaperline=840\n\n".to_owned();
    for i in 0..=180 {
        let x = 40.0 + 0.5 * f64::from(i);
        mini += &format!("{x} {:.6}\n", 0.05 * (70.0 - x));
    }
    write("cone.WHL", &mini);
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(folder.path())
            .arg("wheelrail")
            .args(arguments)
            .env_remove("FORCE_COLOR")
            .output()
            .unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        (output.status.code(), out, err)
    };
    let placed = [
        "--load", "100 kN", "--at", "0.5 m", "--radius", "460 mm", "--json",
    ];
    let (code, out, err) = run(&[&["contact", "cone_1:20", "rails.slcs"][..], &placed].concat());
    assert_eq!(code, Some(0), "{err}");
    let found: Value = serde_json::from_str(&out).unwrap();
    for side in ["left_rail_along", "right_rail_along"] {
        let [top, ahead] = ["top_mm", "contact_ahead_mm"].map(|key| found[side][key].as_f64().unwrap());
        assert!((top + 1.0).abs() < 1e-4, "{top}");
        assert!((ahead + 0.92).abs() < 1e-3, "{ahead}");
    }
    let (code, _, err) = run(&["check", "cone_1:20", "rails.slcs"]);
    assert_eq!(code, Some(2));
    assert!(
        err.contains("2 sections, from 0 to 1 m") && err.contains("--at"),
        "{err}"
    );
    let (code, out, err) = run(&["check", "cone_1:20", "136re", "--left-wheel", "cone.WHL"]);
    assert_eq!(code, Some(0), "{err}");
    for part in [
        "left wheel: cone.WHL",
        "left nominal radius 420.000 mm",
        "right wheel: cone",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    let unlike = ["--left-wheel", "cylinder"];
    let (_, out, _) = run(&[&["check", "cone_1:20", "136re"][..], &unlike].concat());
    let rows: Vec<f64> = out
        .lines()
        .filter_map(|line| {
            let cells: Vec<&str> = line.split_whitespace().collect();
            (cells.len() == 5).then(|| cells[4].parse().ok()).flatten()
        })
        .collect();
    // Half of that of two cones, up to 0.5 in.
    assert_eq!(rows.len(), 10, "{out}");
    assert!(rows.iter().all(|own| (own - 0.025).abs() < 5e-4), "{rows:?}");
    for (name, parts) in [
        ("aar_2a", ["AAR-2A", "name a file"]),
        ("AAR-2A", ["AAR-2A", "name a file"]),
        ("aar_7", ["neither a file nor a nominal wheel", "aar_1b"]),
        ("cone_x", ["`cone_x` names no profile", "cone_1:20"]),
    ] {
        let (code, _, err) = run(&["check", name, "136re"]);
        assert_eq!(code, Some(2));
        assert!(parts.iter().all(|part| err.contains(part)), "{err}");
    }
}

/// Figures of inspectors and the flangeway clearance are printed; only what is doubtful is warned of.
#[test]
fn input_figures_and_clearance_are_told() {
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .args(["wheelrail", "check"])
            .args(arguments)
            .env_remove("FORCE_COLOR")
            .output()
            .unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        assert_eq!(output.status.code(), Some(0), "{err}");
        (out, err)
    };
    let (out, err) = run(&["aar_1b", "136re"]);
    for part in [
        "flange height Sh 25.40 mm, thickness Sd 3",
        "nominal radius 457.200 mm",
        "angle 75.0 deg; hollow depth 0.00 mm",
        "flangeway clearance 10.319 mm (0.4063 in) to each side",
        "stands on the tip of its flange",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    assert!(err.is_empty(), "{err}");
    let (out, err) = run(&["s1002", "60e1", "--gauge", "1435 mm", "--gauge-depth", "14 mm"]);
    let figures = "flange height Sh 28.00 mm, thickness Sd 32.50 mm, qR 10.79 mm";
    assert!(out.contains(figures) && err.is_empty(), "{out}{err}");
    let (out, _) = run(&["hollow_4mm", "136re_8in"]);
    assert!(out.contains("hollow depth 4.00 mm"), "{out}");
    let (_, err) = run(&["aar_1b", "136re", "--gauge", "55.8 in"]);
    assert!(err.contains("warning: the flangeway clearance is 1.4"), "{err}");
}

/// Patches on strips: the answer has the strips' places, half lengths and pressures; the table says whose
/// pressure it is.
#[test]
fn limits_pressure_of_an_ellipse_and_on_strips() {
    let common = ["aar_1b", "136re", "--load", "140 kN"];
    let [ellipse, strips] = ["ellipse", "strips"].map(|patch| {
        let (_, text, _) = command(&[&common[..], &["--patch", patch]].concat());
        let answer = answer(&[&common[..], &["--patch", patch, "--json"]].concat());
        assert_eq!(answer["given"]["patch"], patch);
        (text, answer)
    });
    assert!(ellipse.0.contains("pressure of an ellipse"), "{}", ellipse.0);
    assert!(strips.0.contains("pressure on strips"), "{}", strips.0);
    let patch = &strips.1["left"][0];
    assert!(ellipse.1["left"][0]["strips"].is_null());
    let list = |key: &str| -> Vec<f64> {
        let values = patch["strips"][key].as_array().unwrap();
        values.iter().map(|value| value.as_f64().unwrap()).collect()
    };
    let (half, pressure) = (list("half_length_mm"), list("pressure_mpa"));
    let width = patch["strips"]["width_mm"].as_f64().unwrap();
    let load: f64 = half
        .iter()
        .zip(&pressure)
        .map(|(a, p)| 0.5 * std::f64::consts::PI * a * p * width)
        .sum();
    let normal = patch["normal_n"].as_f64().unwrap();
    assert!((load / normal - 1.0).abs() < 2e-3, "{load} {normal}");
    let greatest = pressure.iter().fold(0.0_f64, |most, own| most.max(*own));
    assert!((greatest / patch["greatest_pressure_mpa"].as_f64().unwrap() - 1.0).abs() < 1e-9);
}

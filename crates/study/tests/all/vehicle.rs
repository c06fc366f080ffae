//! Vehicles written as cases: mechanisms against closed forms, mistakes with their places.

use std::f64::consts::PI;
use std::path::Path;

use study::models::AnyCase;
use study::run::Run;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;

const G: f64 = 9.80665;
const POUND: f64 = 0.453_592_37;
const INCH: f64 = 0.0254;

fn case(text: &str) -> VehicleCase {
    VehicleCase::parse("own.toml", text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}"))
}

fn run(text: &str) -> VehicleResult {
    let result = Run::new(&case(text)).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.warnings);
    result
}

/// The roots of `a ω⁴ - b ω² + c = 0`, rad/s, rising.
fn frequencies(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - 4.0 * a * c).sqrt();
    [(b - root) / (2.0 * a), (b + root) / (2.0 * a)].map(f64::sqrt)
}

/// Two masses on springs, let go: natural frequencies, and the motion as the sum of both.
#[test]
fn analytic_two_masses_on_springs() {
    let text = study::models::built_in("vehicle_two_masses").unwrap().text();
    let text = format!("{text}relative_tolerance = 1e-9\n");
    let result = run(&text);
    let (m1, m2) = (1000.0 * POUND, 2000.0 * POUND);
    let pound_per_inch = POUND * G / INCH;
    let (k1, k2) = (2000.0 * pound_per_inch, 1000.0 * pound_per_inch);
    let both = frequencies(m1 * m2, m1 * k2 + m2 * (k1 + k2), k1 * k2);
    for (found, omega) in result.summary.vibrations.iter().zip(both) {
        assert!((found.frequency_hz * 2.0 * PI / omega - 1.0).abs() < 1e-9);
    }
    // Modes (1, r): r = (k1 + k2 - m1 ω²)/k2; the start (0.5 in, 0) is a sum of both.
    let ratios = both.map(|omega| (k1 + k2 - m1 * omega * omega) / k2);
    let start = 0.5 * INCH;
    let first = start * ratios[1] / (ratios[1] - ratios[0]);
    let parts = [first, start - first];
    let [lower, upper] = ["lower_z", "upper_z"].map(|name| result.column(name).unwrap());
    for (row, time) in result.column("time").unwrap().iter().enumerate() {
        let cosines = both.map(|omega| (omega * time).cos());
        let exact = parts[0] * cosines[0] + parts[1] * cosines[1];
        assert!((lower[row] - exact).abs() < 1e-6 * start, "{time}");
        let exact = parts[0] * ratios[0] * cosines[0] + parts[1] * ratios[1] * cosines[1];
        assert!((upper[row] - exact).abs() < 1e-6 * start, "{time}");
    }
}

/// A double pendulum of two rods on bushings: its frequencies come to those with rigid joints as these
/// harden.
#[test]
fn convergence_a_double_pendulum_on_bushings() {
    let text = study::models::built_in("vehicle_double_pendulum").unwrap().text();
    let (mass, inertia) = (20.0 * POUND, 0.2 * POUND * G * INCH);
    let (length, half) = (20.0 * INCH, 10.0 * INCH);
    // M = [[I + m a² + m L², m L a], [m L a, I + m a²]], K = m g diag(a + L, a).
    let own = inertia + mass * half * half;
    let [m11, m12, m22] = [own + mass * length * length, mass * length * half, own];
    let [k1, k2] = [mass * G * (half + length), mass * G * half];
    let rigid = frequencies(m11 * m22 - m12 * m12, m11 * k2 + m22 * k1, k1 * k2);
    let at = |stiffness: &str| {
        let text = text.replace("1e5 lbf/in", stiffness);
        let mut vehicle = case(&text).vehicle().unwrap();
        let found = vehicle.vibrations().unwrap();
        [0, 1].map(|k| found[k].frequency / rigid[k] - 1.0)
    };
    let (soft, hard) = (at("1e5 lbf/in"), at("1e6 lbf/in"));
    for k in 0..2 {
        assert!(soft[k].abs() < 2e-3 && hard[k].abs() < 2e-4, "{soft:?} {hard:?}");
        // The error falls as the stiffness grows: extrapolated, it is gone.
        let rest = (10.0 * hard[k] - soft[k]) / 9.0;
        assert!(rest.abs() < 0.02 * soft[k].abs() + 1e-7, "{k}: {soft:?} {hard:?}");
    }
}

/// The angle of a four-bar's rocker over that of its crank (rad), by Freudenstein's closure: pivots `d`
/// apart, crank `a`, coupler `b`, rocker `c`, the coupler above the line of pivots.
fn rocker(crank: f64, [a, b, c, d]: [f64; 4]) -> f64 {
    let (x, y) = (d - a * crank.cos(), -a * crank.sin());
    let diagonal = x.hypot(y);
    let cosine = (diagonal * diagonal + c * c - b * b) / (2.0 * diagonal * c);
    // From the rocker's pivot back to the crank's pin, then down to the rocker.
    (-y).atan2(-x) - cosine.clamp(-1.0, 1.0).acos()
}

/// The text of a four-bar in the plane of x and z, driven by its crank, with a stop under the rocker's
/// middle.
fn four_bar(clearance: f64, duration: f64) -> (String, [f64; 4]) {
    let sizes = [0.2, 0.5, 0.4, 0.6];
    let [a, _, c, d] = sizes;
    let crank = PI / 2.0;
    let [pin_x, pin_z] = [a * crank.cos(), a * crank.sin()];
    let psi = rocker(crank, sizes);
    let [end_x, end_z] = [d + c * psi.cos(), c * psi.sin()];
    let m = |[x, z]: [f64; 2]| format!("[\"{x:.17} m\", \"0 m\", \"{z:.17} m\"]");
    let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let (pin, end, far) = ([pin_x, pin_z], [end_x, end_z], [d, 0.0]);
    let free = "weight = \"10 N\"\ninertia = [\"0.01 kg m^2\", \"0.01 kg m^2\", \"0.01 kg \
                m^2\"]\nfree_coordinates = [\"x\", \"z\", \"pitch\"]";
    let joint = |name: &str, a: &str, b: &str, at: [f64; 2]| {
        format!(
            "[elements.{name}]\nkind = \"bushing\"\na = \"{a}\"\nb = \"{b}\"\nat = {}\n\
             stiffness = [\"1e9 N/m\", \"0 N/m\", \"1e9 N/m\"]\ndamping = [\"1e5 N s/m\", \"0 N s/m\", \
                            \"1e5 N s/m\"]\n",
            m(at)
        )
    };
    // Pitch turns z towards x: a crank angle that grows is a pitch that falls.
    let text = format!(
        "model = \"vehicle\"\nenvironment.gravity = \"0 m/s^2\"\nstart.kind = \"nominal\"\n\
         [bodies.crank]\nat = {}\nfree_coordinates = []\ncenter = [\"0 m\", \"0 m\", \"0 m\"]\n\
         pitch = {{ shape = \"ramp\", amplitude = \"-0.6 rad\", start = \"0 s\", duration = \"2 s\" }}\n\
         [bodies.coupler]\nat = {}\n{free}\n[bodies.rocker]\nat = {}\n{free}\n{}{}{}\
         [elements.stop]\nkind = \"stop\"\na = \"rocker\"\nb = \"ground\"\nat = {}\naxis = \"x\"\n\
         clearance = \"1 m\"\nclearance_behind = \"{clearance} m\"\nstiffness = \"1e4 N/m\"\n\
         [simulation]\nduration = \"{duration} s\"\noutput_units = \"si\"\nrelative_tolerance = 1e-7\n",
        m(middle([0.0; 2], pin)),
        m(middle(pin, end)),
        m(middle(end, far)),
        joint("pin", "coupler", "crank", pin),
        joint("elbow", "coupler", "rocker", end),
        joint("pivot", "rocker", "ground", far),
        m(middle(end, far)),
    );
    (text, sizes)
}

/// A four-bar on hard bushings, driven by its crank: the rocker's angle is that of the closure equation; a
/// stop presses with its stiffness times what the closure says that the rocker goes beyond the clearance.
#[test]
fn analytic_a_four_bar_with_a_stop() {
    let clearance = 0.02;
    let (text, sizes) = four_bar(clearance, 2.5);
    let result = run(&text);
    let start = rocker(PI / 2.0, sizes);
    let columns = ["time", "crank_pitch", "rocker_pitch", "stop_force", "rocker_x"];
    let [times, crank, turned, force, aside] = columns.map(|name| result.column(name).unwrap());
    let (mut pressed, mut most) = (0, 0.0_f64);
    for row in 0..times.len() {
        let psi = rocker(PI / 2.0 - crank[row], sizes);
        assert!(
            (turned[row] + (psi - start)).abs() < 2e-5,
            "{}: {} {}",
            times[row],
            turned[row],
            psi - start
        );
        let way = 0.5 * sizes[2] * (psi.cos() - start.cos());
        assert!((aside[row] - way).abs() < 5e-6);
        let beyond = -way - clearance;
        let exact = if beyond > 0.0 { 1e4 * beyond } else { 0.0 };
        assert!(
            (force[row] - exact).abs() < 0.1,
            "{}: {} {exact}",
            times[row],
            force[row]
        );
        pressed += usize::from(exact > 0.0);
        most = most.max(exact);
    }
    assert!(pressed > 20 && most > 100.0, "{pressed} {most}");
}

/// A case is the same as the one that it completes to, and `like` takes what is not given.
#[test]
fn input_a_completed_case_reads_back() {
    for name in ["vehicle_two_masses", "vehicle_double_pendulum"] {
        let own = case(study::models::built_in(name).unwrap().text());
        let again = case(own.to_toml());
        assert_eq!(again.to_toml(), own.to_toml());
        assert_eq!(again.description.bodies, own.description.bodies);
    }
    let own = case(study::models::built_in("vehicle_two_masses").unwrap().text());
    assert_eq!(own.description.bodies[1].free, own.description.bodies[0].free);
    assert!((own.description.bodies[1].mass - 2000.0 * POUND).abs() < 1e-9);
}

const BLOCK: &str = "model = \"vehicle\"\n[bodies.block]\nweight = \"10 lbf\"\n\
                     inertia = [\"1 lbf in s^2\", \"1 lbf in s^2\", \"1 lbf in s^2\"]\nat = [\"0 in\", \
                                  \"0 in\", \"9 in\"]\n";
const SPRING: &str = "[elements.spring]\nkind = \"spring\"\na = \"block\"\nb = \"ground\"\nstiffness = \
                      \"100 lbf/in\"\n\
                      at_a = [\"0 in\", \"0 in\", \"9 in\"]\nat_b = [\"0 in\", \"0 in\", \"0 in\"]\n";

/// Each mistake with its place and what to write instead.
#[test]
fn input_mistakes_have_place_and_remedy() {
    let table: [(&str, String, &str, &str); 14] = [
        (
            "no bodies",
            "model = \"vehicle\"\n".into(),
            "has no bodies",
            "[bodies.NAME]",
        ),
        (
            "no weight",
            BLOCK.replace("weight = \"10 lbf\"\n", ""),
            "`bodies.block.weight` is missing",
            "weight =",
        ),
        (
            "no mass",
            BLOCK.replace("10 lbf\"", "0 lbf\""),
            "must be greater than zero",
            "write",
        ),
        ("no unit", BLOCK.replace("10 lbf\"", "10\""), "unit", "lbf"),
        (
            "no place",
            BLOCK.replace("at = ", "# "),
            "`bodies.block.at` is missing",
            "at =",
        ),
        (
            "nowhere",
            format!("{BLOCK}{}", SPRING.replace("\"ground\"", "\"grnd\"")),
            "names \"grnd\"",
            "did you mean \"ground\"",
        ),
        (
            "itself",
            format!("{BLOCK}{}", SPRING.replace("\"ground\"", "\"block\"")),
            "between block and itself",
            "two bodies",
        ),
        (
            "kind",
            format!("{BLOCK}{}", SPRING.replace("\"spring\"", "\"sprig\"")),
            "cannot be \"sprig\"",
            "did you mean \"spring\"",
        ),
        (
            "no kind",
            format!("{BLOCK}{}", SPRING.replace("kind = \"spring\"\n", "")),
            "`elements.spring.kind` is missing",
            "write kind",
        ),
        (
            "one name",
            format!("{BLOCK}{}", SPRING.replace("elements.spring", "elements.block")),
            "both named `block`",
            "another",
        ),
        (
            "unknown key",
            format!("{BLOCK}{SPRING}stifness = \"1 lbf/in\"\n"),
            "stifness",
            "stiffness",
        ),
        (
            "loop",
            format!("{BLOCK}like = \"other\"\n[bodies.other]\nlike = \"block\"\n{SPRING}"),
            "in a loop",
            "like",
        ),
        (
            "no such like",
            format!("{BLOCK}like = \"blok\"\n{SPRING}"),
            "names \"blok\"",
            "did you mean \"block\"",
        ),
        (
            "inertia",
            BLOCK.replace("[\"1 lbf in s^2\"", "[\"9 lbf in s^2\""),
            "of no body",
            "check the order",
        ),
    ];
    for (what, text, message, help) in table {
        let error = VehicleCase::parse("own.toml", &text, Path::new(""), &[]).unwrap_err();
        let shown = format!("{:?}", miette::Report::new(error));
        let plain = shown
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
            .replace(" │ ", " ");
        assert!(plain.contains(message), "{what}: {shown}");
        assert!(plain.contains(help), "{what}: {shown}");
    }
}

/// A mistake is told once: not again by those that are like its table, nor by what a wrong `like` or kind
/// leaves unknown.
#[test]
fn input_one_mistake_is_told_once() {
    let twin = "[elements.twin]\nlike = \"spring\"\nat_a = [\"9 in\", \"0 in\", \"9 in\"]\n";
    let both = format!("{BLOCK}{SPRING}{twin}");
    let texts = [
        both.replace("\"100 lbf/in\"", "\"-100 lbf/in\""),
        both.replace("\"spring\"\na =", "\"sprig\"\na ="),
        both.replace("like = \"spring\"", "like = \"twin\""),
        both.replace("like = \"spring\"", "like = \"sprung\""),
        both.replace("like = \"spring\"", "like = 3"),
        format!("{BLOCK}{SPRING}[bodies.other]\nlike = \"blok\"\n"),
    ];
    VehicleCase::parse("own.toml", &both, Path::new(""), &[]).unwrap();
    for text in texts {
        let error = VehicleCase::parse("own.toml", &text, Path::new(""), &[]).unwrap_err();
        let count = error.problems().len();
        assert_eq!(count, 1, "{:?}", miette::Report::new(error));
    }
}

/// What nothing holds falls: told once, as a warning; a body on a spring is not warned of.
#[test]
fn input_a_body_that_nothing_holds_is_told() {
    let alone = case(BLOCK);
    assert!(
        alone.doubts[0].contains("nothing holds block: it falls freely"),
        "{:?}",
        alone.doubts
    );
    assert!(case(&format!("{BLOCK}{SPRING}")).doubts.is_empty());
}

/// Every case file says its model; a vehicle's is read as one, by whoever reads any.
#[test]
fn input_any_case_reads_a_vehicle() {
    let any = AnyCase::parse("own.toml", &format!("{BLOCK}{SPRING}"), Path::new(""), &[]).unwrap();
    assert_eq!(any.model(), "vehicle");
    let measures = any.definitions();
    for name in ["slowest_frequency", "block_z_max", "spring_force_rms"] {
        assert!(measures.place(name).is_some(), "{name}");
    }
}

/// The travel of the coils in the last two seconds of a run of `vehicle_one_mass`, m, from peak to peak.
fn travel(amplitude: &str, frequency: &str) -> f64 {
    let overrides = [
        format!("bodies.side_frame.vertical.amplitude={amplitude}"),
        format!("bodies.side_frame.vertical.frequency={frequency}"),
    ];
    let text = study::models::built_in("vehicle_one_mass").unwrap().text();
    let own = VehicleCase::parse("own.toml", text, Path::new(""), &overrides).unwrap();
    let result = Run::new(&own).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.warnings);
    let own = &result.column("coils_compression").unwrap()[400..];
    let ends = own
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], own| {
            [a.min(*own), b.max(*own)]
        });
    ends[1] - ends[0]
}

/// Berghuvud and Stensson's finding: the suspension is locked below the natural frequency at small
/// amplitudes. It locks while `m ω² A < F`: at 0.1 in up to 2.48 Hz, which is above the natural frequency of
/// 2.03 Hz; at 0.3 in up to 1.43 Hz.
#[test]
fn reproduction_a_suspension_locks_below_its_natural_frequency() {
    let weight = 61515.0;
    let gravity = G / INCH;
    let natural = (25875.0 * gravity / weight).sqrt() / (2.0 * PI);
    assert!((natural - 2.03).abs() < 0.01, "{natural}");
    let limit = |amplitude: f64| (0.4 * 9650.0 * gravity / (weight * amplitude)).sqrt() / (2.0 * PI);
    for amplitude in [0.1, 0.3] {
        let text = format!("{amplitude} in");
        let edge = limit(amplitude);
        // The bristle gives by F/K = 0.0019 in to each side.
        let locked = travel(&text, &format!("{} Hz", 0.95 * edge)) / INCH;
        assert!(locked < 0.005, "{amplitude}: {locked} in below {edge} Hz");
        let slips = travel(&text, &format!("{} Hz", 1.1 * edge)) / INCH;
        assert!(slips > 0.02, "{amplitude}: {slips} in above {edge} Hz");
    }
    assert!(limit(0.1) > natural && limit(0.3) < natural);
    assert!(travel("0.1 in", &format!("{natural} Hz")) / INCH < 0.005);
}

/// The four sets of friction in the half-bogie: both wedges carry different forces and lose different
/// energies, so that they wear differently; slopes without friction lose nothing.
#[test]
fn reproduction_wedges_of_a_half_bogie_carry_different_forces() {
    let sets = [
        "same",
        "different",
        "same_frictionless_slope",
        "different_frictionless_slope",
    ];
    for set in sets {
        let name = format!("vehicle_half_bogie_{set}");
        let result = run(study::models::built_in(&name).unwrap().text());
        let largest = |name: &str| {
            result
                .column(name)
                .unwrap()
                .iter()
                .fold(0.0_f64, |most, own| most.max(*own))
        };
        let normals = ["leading", "trailing"].map(|end| largest(&format!("{end}_wedge_column_normal_force")));
        assert!((normals[0] / normals[1] - 1.0).abs() > 1e-3, "{set}: {normals:?}");
        let lost = |face: &str| {
            ["leading", "trailing"].map(|end| {
                let entry = format!("{end}_wedge_{face}_friction_loss");
                result.summary.ledger.entries[&entry].value
            })
        };
        let (columns, slopes) = (lost("column"), lost("slope"));
        assert!((columns[0] / columns[1] - 1.0).abs() > 0.2, "{set}: {columns:?}");
        assert!(columns.iter().all(|own| *own > 0.0), "{set}: {columns:?}");
        assert_eq!(
            slopes == [0.0; 2],
            set.ends_with("frictionless_slope"),
            "{set}: {slopes:?}"
        );
    }
}

/// The example of the pages runs, and its natural frequencies are those of a frame on two springs.
#[test]
fn analytic_the_example_of_ones_own_vehicle() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/own_vehicle.toml");
    let own = VehicleCase::read(&path, &[]).unwrap();
    let result = Run::new(&own).unwrap().finish(|_| ());
    assert!(result.summary.complete && result.summary.warnings.is_empty());
    let (mass, inertia) = (900.0 * POUND, 400.0 * POUND * G * INCH);
    let stiffness = 800.0 * POUND * G / INCH;
    let damped = |k: f64, c: f64, m: f64| (k / m - (c / (2.0 * m)).powi(2)).sqrt() / (2.0 * PI);
    let damping = 4.0 * POUND * G / INCH;
    let arm = 35.0 * INCH;
    // Springs under load push the frame over: 2 F h of the line's turn, which the equal and opposite turn of
    // its ends gives back but for the load's own part.
    let bounce = damped(2.0 * stiffness, 2.0 * damping, mass);
    let found: Vec<f64> = result
        .summary
        .vibrations
        .iter()
        .map(|own| own.frequency_hz)
        .collect();
    assert!(
        found.iter().any(|own| (own / bounce - 1.0).abs() < 1e-6),
        "{found:?} {bounce}"
    );
    let pitch = damped(2.0 * stiffness * arm * arm, 2.0 * damping * arm * arm, inertia);
    assert!(
        found.iter().any(|own| (own / pitch - 1.0).abs() < 2e-3),
        "{found:?} {pitch}"
    );
}

/// The text of a car's completed case as a vehicle: a body and two trucks.
pub(crate) fn written_out(car: &str) -> String {
    let mut text = String::from(
        "model = \"vehicle\"\n[bodies.car_body]\nweight = \"43060 lbf\"\n\
         inertia = [\"375000 lbf in s^2\", \"3610000 lbf in s^2\", \"3610000 lbf in s^2\"]\n\
         at = [\"0 in\", \"0 in\", \"65 in\"]\n",
    );
    let (mut section, mut of_truck) = (String::new(), String::new());
    for line in car.lines() {
        if line.starts_with('[') {
            section = line.trim_matches(['[', ']']).to_owned();
            if let Some(rest) = section.strip_prefix("truck") {
                of_truck += &format!("[trucks.front{rest}]\n");
                if rest.is_empty() {
                    of_truck += "at = \"243 in\"\nunder = \"car_body\"\n";
                }
                continue;
            }
        }
        let own = ["rails", "wheels", "track", "speed", "simulation"].contains(&section.as_str());
        match section.starts_with("truck") {
            true if !line.starts_with('[') => of_truck += &format!("{line}\n"),
            false if own => text += &format!("{line}\n"),
            _ => {}
        }
    }
    let speed = text.replace("[speed]\n", "[drive]\nheight = \"34.5 in\"\n[speed]\n");
    format!("{speed}{of_truck}[trucks.rear]\nlike = \"front\"\nat = \"-243 in\"\n")
}

/// The empty car of `model = "car"`, and the same car written out as bodies and trucks, over a dip of both
/// rails: the same wheel forces, motions and wedge forces, to rounding.
#[test]
fn cross_code_a_car_written_out_equals_the_built_in_one() {
    let overrides = [
        "track.segments=[{tangent=\"400 ft\"}]",
        "track.irregularities=[{shape=\"dip\",start=\"60 ft\",length=\"20 ft\",depth=\"0.3 \
         in\",rails=\"both\",direction=\"vertical\"}]",
        "simulation.duration=2 s",
    ]
    .map(str::to_owned);
    let car = study::models::built_in("car_tangent_empty").unwrap().text();
    let car = study::car::CarCase::parse("car.toml", car, Path::new(""), &overrides)
        .unwrap_or_else(|error| panic!("{:?}", miette::Report::new(error)));
    let own = VehicleCase::parse("own.toml", &written_out(car.to_toml()), Path::new(""), &[])
        .unwrap_or_else(|error| panic!("{:?}", miette::Report::new(error)));
    let (built_in, own) = (
        Run::new(&car).unwrap().finish(|_| ()),
        Run::new(&own).unwrap().finish(|_| ()),
    );
    assert!(own.summary.complete, "{:?}", own.summary.stopped);
    for (theirs, ours) in [
        ("axle_1_left_vertical", "front_wheelset_1_left_vertical_force"),
        ("axle_2_right_lateral", "front_wheelset_2_right_lateral_force"),
        ("axle_4_right_vertical", "rear_wheelset_2_right_vertical_force"),
        ("body_roll", "car_body_roll"),
        ("speed", "car_body_speed"),
        (
            "truck_1_leading_left_column_normal",
            "front_leading_left_column_normal",
        ),
        (
            "truck_2_left_nest_vertical_force",
            "rear_left_nest_vertical_force",
        ),
    ] {
        let [a, b] = [built_in.column(theirs), own.column(ours)]
            .map(|own| own.unwrap_or_else(|| panic!("{theirs} {ours}")));
        assert_eq!(a.len(), b.len());
        let scale = a.iter().fold(1e-3_f64, |most, own| most.max(own.abs()));
        let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst <= 1e-9 * scale, "{theirs}: {worst:.2e} of {scale:.3e}");
    }
}

/// A wagon on two axles: its wheels carry its weight at the start, and its ledger closes.
#[test]
fn analytic_a_wagon_on_two_axles_stands_on_its_wheels() {
    let result = run(study::models::built_in("vehicle_two_axles").unwrap().text());
    let load = |name: &str| result.summary.forces_at_start[name].value;
    let mut sum = 0.0;
    for axle in ["leading", "trailing"] {
        let both = ["left", "right"].map(|side| load(&format!("{axle}_{side}_vertical_force")));
        assert!((both[0] / both[1] - 1.0).abs() < 0.2, "{both:?}");
        sum += both[0] + both[1];
    }
    let wheelsets = 2.0 * 3135.0;
    assert!((sum / (60000.0 + wheelsets) - 1.0).abs() < 0.05, "{sum}");
    let reached = result.summary.reached.unwrap();
    assert!(
        (reached.value - (118.0 / 12.0 + 3.28 + 118.0 / 12.0 + 40.0 * 1.46667 * 6.0)).abs() < 5.0,
        "{reached:?}"
    );
}

/// A force over distance does the work of its course: on a mass that slides along x, and on a wagon that
/// coasts along a track into a curve.
#[test]
fn analytic_a_force_over_distance_does_its_work() {
    let slides = "model = \"vehicle\"
[bodies.mass]
weight = \"980.665 N\"
at = [\"0 m\", \"0 m\", \"0 m\"]
free_coordinates = [\"x\"]
[elements.held]
kind = \"bushing\"
a = \"mass\"
b = \"ground\"
at = [\"0 m\", \"0 m\", \"0 m\"]
stiffness = [\"1 N/m\", \"0 N/m\", \"0 N/m\"]
[elements.push]
kind = \"force\"
a = \"mass\"
at = [\"0 m\", \"0 m\", \"0 m\"]
axis = \"x\"
over_distance = [[\"0 m\", \"50 N\"], [\"1 m\", \"150 N\"], [\"2 m\", \"150 N\"], [\"3 m\", \"-50 N\"]]
[start]
kind = \"nominal\"
[simulation]
duration = \"2.55 s\"
relative_tolerance = 1e-8
";
    let result = run(slides);
    let [x, speed] = ["mass_x", "mass_x_rate"].map(|name| result.column(name).unwrap());
    let last = x.len() - 1;
    assert!(x[last] > 2.2 && x[last] < 2.9, "{}", x[last]);
    let ramp = |x: f64| 150.0 * (x - 2.0) - 100.0 * (x - 2.0).powi(2);
    let work = 0.5 * (50.0 + 150.0) + 150.0 + ramp(x[last]) - 0.5 * x[last] * x[last];
    assert!(
        (50.0 * speed[last] * speed[last] / work - 1.0).abs() < 1e-6,
        "{work}"
    );

    let wagon = study::models::built_in("vehicle_two_axles").unwrap().text();
    let (before, behind) = wagon.split_once("[track]").unwrap();
    let (_, rest) = behind.split_once("[speed]").unwrap();
    let track = "segments = [{ tangent = \"40 m\" }, { spiral = \"30 m\" }, { curve = \"60 m\", radius = \
                 \"400 m\", superelevation = \"30 mm\", direction = \"left\" }]";
    let push = "[elements.push]\nkind = \"force\"\na = \"body\"\nat = [\"0 in\", \"0 in\", \"34.5 in\"]\n\
                axis = \"x\"\nover_distance = [[\"20 m\", \"0 N\"], [\"21 m\", \"40 kN\"], \
                [\"70 m\", \"40 kN\"], \
                [\"71 m\", \"0 N\"]]\n";
    let text = format!("{before}{push}[track]\n{track}\n[speed]{rest}")
        .replace("value = \"40 mph\"", "kind = \"coasting\"\nvalue = \"16 m/s\"");
    let result = run(&text);
    let work = result.column("work").unwrap();
    let distance = result.summary.reached.as_ref().unwrap();
    assert!(distance.value > 0.0);
    let last = work.len() - 1;
    let expected = 40e3 * 50.0;
    assert!(
        (work[last] / expected - 1.0).abs() < 0.02,
        "{} {expected}",
        work[last]
    );
    let force = result.column("push_force").unwrap();
    assert!(force.iter().any(|own| (own - 40e3).abs() < 1.0) && force[0] == 0.0);
}

/// A car of a train on 300 ft of a curve of 10 deg behind a spiral, under buff; `at` is its middle.
fn car_of_train(name: &str, at: f64) -> String {
    let truck = |end: &str, x: f64| {
        format!(
            "[trucks.{name}_{end}]\nat = \"{x} in\"\nunder = \"{name}\"\n\
             side_bearing.kind = \"constant_contact\"\n"
        )
    };
    format!(
        "[bodies.{name}]\nweight = \"43060 lbf\"\nat = [\"{at} in\", \"0 in\", \"65 in\"]\n\
         inertia = [\"375000 lbf in s^2\", \"3610000 lbf in s^2\", \"3610000 lbf in s^2\"]\n{}{}",
        truck("front", at + 243.0),
        truck("rear", at - 243.0)
    )
}

/// A coupler towards a like neighbor at an end (1 or -1) of a car, buff of 150,000 lbf that grows when all
/// cars of a train are in the curve: what friction holds then is the same in all.
fn coupler_of_train(car: &str, middle: f64, end: f64) -> String {
    format!(
        "[elements.{car}_coupler_{}]\nkind = \"coupler\"\na = \"{car}\"\n\
         at = [\"{} in\", \"0 in\", \"32.5 in\"]\ntruck_distance = \"486 in\"\nmiddle = \"{middle} in\"\n\
         force = {{ shape = \"ramp\", amplitude = \"150000 lbf\", start = \"9.5 s\", duration = \"3 s\" }}\n",
        if end > 0.0 { "leading" } else { "trailing" },
        middle + end * 289.25
    )
}

/// The wheel forces of the middle one of three equal cars, coupled by draft gears, are those of one car with
/// like neighbors, in a curve under buff.
#[test]
#[ignore = "takes a minute; run by name"]
fn cross_code_like_neighbors_are_the_cars_of_a_train() {
    const PITCH: f64 = 637.0;
    let rest = "[track]\nsegments = [{ tangent = \"160 ft\" }, { spiral = \"150 ft\" }, \
                { curve = \"500 ft\", degree = \"10 deg\", direction = \"left\", \
                superelevation = \"4 in\" }]\n[speed]\nvalue = \"24 mph\"\n[simulation]\n\
                duration = \"18 s\"\noutput_interval = \"0.02 s\"\n\
                relative_tolerance = 1e-4\nmethod = \"tr-bdf2\"\n";
    let alone = [
        "model = \"vehicle\"\n".to_owned(),
        car_of_train("two", 0.0),
        coupler_of_train("two", 0.0, 1.0),
        coupler_of_train("two", 0.0, -1.0),
        rest.to_owned(),
        "[start]\ndistance = \"80 ft\"\n".to_owned(),
    ];
    let gear = |front: &str, rear: &str, middle: f64| {
        format!(
            "[elements.{front}_{rear}]\nkind = \"draft_gear\"\na = \"{front}\"\nb = \"{rear}\"\n\
             at_a = [\"{} in\", \"0 in\", \"32.5 in\"]\nat_b = [\"{} in\", \"0 in\", \"32.5 in\"]\n",
            middle + 29.25,
            middle - 29.25
        )
    };
    let train = [
        "model = \"vehicle\"\n".to_owned(),
        car_of_train("one", PITCH),
        car_of_train("two", 0.0),
        car_of_train("three", -PITCH),
        coupler_of_train("one", PITCH, 1.0),
        coupler_of_train("three", -PITCH, -1.0),
        gear("one", "two", 0.5 * PITCH),
        gear("two", "three", -0.5 * PITCH),
        rest.to_owned(),
        "[drive]\nbody = \"two\"\n[start]\ndistance = \"80 ft\"\n".to_owned(),
    ];
    let [alone, train] = [alone.concat(), train.concat()].map(|text| run(&text));
    // Between the gears the train is shorter by their travel, and the middle car stands where the one does.
    let late = |result: &VehicleResult, name: &str| {
        let values = result.column(name).unwrap_or_else(|| panic!("{name}"));
        let count = 100;
        values[values.len() - count..].iter().sum::<f64>() / count as f64
    };
    let force = late(&train, "one_two_force");
    assert!((force / (150e3 * POUND * G) - 1.0).abs() < 0.02, "{force} N");
    let mut worst: f64 = 0.0;
    for truck in ["front", "rear"] {
        for axle in [1, 2] {
            for side in ["left", "right"] {
                let stem = format!("two_{truck}_wheelset_{axle}_{side}");
                let mut total = 0.0;
                for what in ["vertical", "lateral"] {
                    let name = format!("{stem}_{what}_force");
                    let [one, three] = [&alone, &train].map(|result| late(result, &name));
                    eprintln!("{name}: {one:.0} N alone, {three:.0} N in the train");
                    total = f64::max(total, late(&alone, &format!("{stem}_vertical_force")));
                    worst = worst.max((one - three).abs() / total);
                }
            }
        }
    }
    assert!(worst < 0.01, "{worst}");
}

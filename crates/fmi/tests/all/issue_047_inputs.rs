//! Issue 47: inputs left alone hold a wedge still; a position without its rate works, or is warned of; what
//! no machine does is warned of once.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::half_truck::HalfTruck;
use fmi::instance::{Instance, Saved};
use fmi::source::{FmuModel, Source};
use fmi::{Category, Severity};
use study::car::CarCase;
use study::case::{Case, Tables, builtin};
use study::half_truck::files::Settings;
use study::run::Run;

const NAME: &str = "cdrun_toe_0_psi_0";
const POUND: f64 = 0.453_592_37 * 9.806_65;

/// What makes a source.
type Made = fn() -> Source;

/// An instance with its variables by their names.
struct Part {
    instance: Instance,
    description: Description,
    warnings: Vec<String>,
}

impl Part {
    fn of(source: Source, interface: Interface) -> Self {
        let description = Description::new(&source).unwrap();
        let mut instance = Instance::of("part", None, source, Version::Two, interface).unwrap();
        instance.set_experiment(0.0, None, None).unwrap();
        Self {
            instance,
            description,
            warnings: Vec::new(),
        }
    }

    fn wedge(interface: Interface) -> Self {
        Self::of(wedge(), interface)
    }

    fn begin(mut self) -> Self {
        self.instance.enter_initialization().unwrap();
        self.instance.exit_initialization().unwrap();
        self
    }

    fn reference(&self, name: &str) -> u32 {
        let mut all = self.description.variables.iter();
        let found = all.find(|variable| variable.name == name);
        found
            .unwrap_or_else(|| panic!("there is no variable {name}"))
            .reference
    }

    fn set(&mut self, name: &str, value: f64) {
        self.instance.set_float(self.reference(name), value).unwrap();
    }

    fn get(&mut self, name: &str) -> f64 {
        self.instance.get_float(self.reference(name)).unwrap()
    }

    fn option(mut self, name: &str) -> Self {
        let reference = self.reference(name);
        self.instance.set_boolean(reference, true).unwrap();
        self
    }

    fn step(&mut self, length: f64) {
        self.instance.do_step(self.instance.time(), length).unwrap();
        self.listen();
    }

    /// Keeps warnings.
    fn listen(&mut self) {
        for message in self.instance.take_log() {
            if message.category == Category::Warning {
                assert_eq!(message.severity, Severity::Warning);
                self.warnings.push(message.text);
            }
        }
    }

    /// Checks that there is one warning, with these words.
    fn expect(&self, words: &[&str]) {
        let [text] = &self.warnings[..] else {
            panic!("{:#?}", self.warnings)
        };
        let missing = words.iter().find(|word| !text.contains(*word));
        assert!(missing.is_none(), "{missing:?}: {text}");
    }
}

fn wedge() -> Source {
    Source::of_case(FmuModel::Wedge, builtin::case(NAME).unwrap()).unwrap()
}

fn quasi_static() -> Source {
    Source::of_case(FmuModel::QuasiStatic, builtin::case(NAME).unwrap()).unwrap()
}

/// One whose coil stands on the side frame: forces depend on the bolster's height.
fn variably_damped() -> Source {
    Source::of_case(FmuModel::QuasiStatic, builtin::case("vdrun_toe_0_psi_0").unwrap()).unwrap()
}

fn half_truck() -> Source {
    let run = HalfTruck::built_in("nucars_69_constant_toe_out", &Settings::default());
    Source::HalfTruck(Box::new(run.unwrap()))
}

fn three_piece() -> Source {
    let set = ["simulation.relative_tolerance=1e-7".to_owned()];
    let case = study::truck::builtin::case_with("truck_vertical_variable", &set).unwrap();
    Source::ThreePieceTruck(Box::new(case))
}

fn car() -> Source {
    let text = "model = \"car\"\nstart.settle = \"0 s\"\ntrack.support.kind = \"rigid\"\n\
                speed.value = \"40 mph\"\n[[track.segments]]\ntangent = \"2000 ft\"\n";
    let case = CarCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap();
    Source::Car(Box::new(case))
}

/// Bolster's motion of the thesis: 1 in at 2 rad/s.
fn height(time: f64) -> [f64; 2] {
    let (sine, cosine) = (2.0 * time).sin_cos();
    [0.0254 * sine, 0.0508 * cosine]
}

#[test]
fn issue_047_a_wedge_with_nothing_connected_rests_whatever_the_steps() {
    for source in [wedge, quasi_static] {
        let forces = [0.0005, 0.002, 0.01].map(|length| {
            let mut part = Part::of(source(), Interface::CoSimulation).begin();
            for _ in 0..(2.0_f64 / length).round() as u32 {
                part.step(length);
            }
            assert!(part.warnings.is_empty(), "{:#?}", part.warnings);
            let force = |on: &str, axis: &str| format!("force_on_{on}_{axis}");
            let on = |part: &mut Part, axis: &str| {
                let [bolster, side_frame] = ["bolster", "side_frame"].map(|on| part.get(&force(on, axis)));
                // What rests is in balance: its weight stands on both neighbors.
                let weight = if axis == "z" { -50.0 * POUND } else { 0.0 };
                assert!(
                    (bolster + side_frame - weight).abs() < 1.0,
                    "{axis}: {bolster} {side_frame}"
                );
                bolster
            };
            [on(&mut part, "x"), on(&mut part, "z")]
        });
        for other in &forces[1..] {
            for (a, b) in forces[0].iter().zip(other) {
                assert!((a - b).abs() < 1e-4 * forces[0][0].abs(), "{forces:?}");
            }
        }
    }
}

#[test]
fn issue_047_bristles_hold_a_wedge_at_rest_for_a_minute() {
    let set = "[friction]\nlaw = \"bristle\"\n[wedge]\ndamping = \"constant\"\n";
    let case = Case::parse("case.toml", set, Tables::nowhere(), &[]).unwrap();
    let mut part = Part::of(
        Source::of_case(FmuModel::Wedge, case).unwrap(),
        Interface::CoSimulation,
    )
    .begin();
    let (mut first, mut normal) = (0.0, 0.0);
    for step in 1..=600 {
        part.step(0.1);
        if step == 50 {
            (first, normal) = (part.get("force_on_bolster_z"), part.get("column_normal_force"));
        }
    }
    let last = part.get("force_on_bolster_z");
    assert!(
        normal > 1e4 && (last - first).abs() < 1e-6 * normal,
        "{first} {last} of {normal}"
    );
}

/// Against the run of the case, not at reversals, where a delay of a millisecond is all of the force.
#[test]
fn issue_047_positions_alone_give_the_forces_of_the_run() {
    let mut case = builtin::case(NAME).unwrap();
    case.simulation.duration = 3.0;
    let run = Run::new(&case).unwrap().finish(|_| ());
    let times = run.column("time").unwrap();
    let wanted = run.column("vertical_force_on_side_frame").unwrap();
    let size = wanted.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    for at_end in [false, true] {
        for length in [0.001, 0.01] {
            let mut part = Part::wedge(Interface::CoSimulation);
            if at_end {
                part = part.option("inputs_at_end");
            }
            let mut part = part.begin();
            let mut worst = (0.0_f64, 0.0);
            for step in 1..=(3.0_f64 / length).round() as u32 {
                let end = f64::from(step) * length;
                part.set("bolster_z", height(if at_end { end } else { end - length })[0]);
                part.step(length);
                let row = times.iter().position(|time| (time - end).abs() < 1e-9);
                let Some(row) = row.filter(|_| height(end)[1].abs() > 0.3 * 0.0508 && end > 0.1) else {
                    continue;
                };
                let error = (part.get("force_on_side_frame_z") - wanted[row]).abs();
                if error > worst.0 {
                    worst = (error, end);
                }
            }
            println!("at end: {at_end}, steps of {length} s: {worst:?} N of {size} N");
            assert!(part.warnings.is_empty(), "{:#?}", part.warnings);
            assert!(worst.0 < 0.01 * size, "{at_end} {length}: {worst:?} of {size}");
        }
    }
}

/// One output of each kind with positions alone, and with positions and rates.
#[test]
fn issue_047_every_kind_finds_rates_from_positions() {
    let kinds: [(Made, &str, &str, f64); 4] = [
        (variably_damped, "bolster_z", "coil_force", 0.01),
        (
            three_piece,
            "bolster_z_motion",
            "leading_left_column_normal",
            0.01,
        ),
        (half_truck, "body_7_z", "wedge_127_column_friction", 0.01),
        (car, "rail_bed_1_left_z_motion", "axle_1_left_vertical", 0.002),
    ];
    for (source, input, output, length) in kinds {
        let course = |rates: bool| {
            let mut part = Part::of(source(), Interface::CoSimulation);
            // An importer sets what it has at the initialization too; the motion begins at rest.
            let motion = |time: f64| {
                let (sine, cosine) = (10.0 * time).sin_cos();
                [-0.004 * (1.0 - cosine), -0.04 * sine]
            };
            let mut course = Vec::new();
            part = part.begin();
            for step in 0..20 {
                let [value, rate] = motion(f64::from(step) * length);
                part.set(input, value);
                if rates {
                    part.set(&format!("{input}_rate"), rate);
                }
                part.step(length);
                course.push(part.get(output));
            }
            assert!(part.warnings.is_empty(), "{input}: {:#?}", part.warnings);
            course
        };
        let (alone, both) = (course(false), course(true));
        let size = both.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let pairs = alone.iter().zip(&both).skip(5);
        let worst = pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        println!("{input}: {worst} of {size}");
        assert!(size > 1e3 && worst < 0.01 * size, "{input}: {worst} of {size}");
    }
}

#[test]
fn issue_047_a_state_carries_what_rates_are_found_from() {
    let go = |part: &mut Part, steps: std::ops::Range<u32>| {
        for step in steps {
            let length = if step % 3 == 0 { 0.004 } else { 0.01 };
            let time = part.instance.time();
            part.set("bolster_z", height(time)[0]);
            part.step(length);
        }
    };
    let mut straight = Part::wedge(Interface::CoSimulation).begin();
    go(&mut straight, 0..20);
    let bytes = straight.instance.save().to_bytes().unwrap();
    go(&mut straight, 20..30);
    let mut other = Part::wedge(Interface::CoSimulation).begin();
    other
        .instance
        .restore(&Saved::from_bytes(&bytes).unwrap())
        .unwrap();
    go(&mut other, 20..30);
    assert_eq!(straight.instance.save(), other.instance.save());
}

#[test]
fn issue_047_rates_that_contradict_positions_are_warned_of_once() {
    let rates: [fn(f64) -> f64; 4] = [
        |_| 0.0,
        |_| 0.0508,
        |time| -height(time)[1],
        |time| height(time)[1] / 0.0254,
    ];
    for (number, rate) in rates.into_iter().enumerate() {
        let mut part = Part::wedge(Interface::CoSimulation).begin();
        for step in 0..80 {
            let time = 0.01 * f64::from(step);
            part.set("bolster_z", height(time)[0]);
            part.set("bolster_z_rate", rate(time));
            part.step(0.01);
        }
        println!("{number}: {:?}", part.warnings);
        part.expect(&[
            "`bolster_z` and `bolster_z_rate` contradict",
            "derive_rates",
            " m, ",
        ]);
    }
    // A rate without its position.
    let mut part = Part::wedge(Interface::CoSimulation).begin();
    for _ in 0..20 {
        part.set("side_frame_yaw_rate", 0.01);
        part.step(0.01);
    }
    part.expect(&["`side_frame_yaw`", "has never been set", "connect it too", "rad"]);
}

#[test]
fn issue_047_inputs_that_agree_are_not_warned_of() {
    type Motion = fn(f64) -> [f64; 2];
    // A triangle of 20 mm/s, and a vibration with 0.3 rad a step; the latter rates come a step late too.
    let triangle: Motion = |time| {
        let phase = time.rem_euclid(0.25) - 0.125;
        let sign = if (time / 0.25).rem_euclid(2.0) < 1.0 {
            1.0
        } else {
            -1.0
        };
        [
            sign * (0.0025 - 0.02 * phase.abs()),
            -sign * 0.02 * phase.signum(),
        ]
    };
    let vibration: Motion = |time| [0.0005 * (30.0 * time).sin(), 0.015 * (30.0 * time).cos()];
    for motion in [height as Motion, triangle, vibration] {
        for way in 0..4 {
            let mut part = Part::wedge(Interface::CoSimulation);
            if way == 3 {
                part = part.option("inputs_at_end");
            }
            let [value, rate] = motion(0.0);
            part.set("bolster_z", value);
            part.set("bolster_z_rate", rate);
            let mut part = part.begin();
            for step in 0..200_u32 {
                let time = part.instance.time();
                // Steps of changing size, but where rates are late.
                let length = if way == 2 {
                    0.01
                } else {
                    [0.01, 0.002, 0.0001][step as usize % 3]
                };
                let at = if way == 3 { time + length } else { time };
                let [value, mut rate] = motion(at);
                if way == 2 && time > 0.0 {
                    rate = motion(time - 0.01)[1];
                }
                part.set("bolster_z", value);
                part.set("bolster_z_rate", rate);
                if way == 1 {
                    let (input, slope) = (part.reference("bolster_z_rate"), -4.0 * value);
                    part.instance.set_input_derivative(input, 1, slope).unwrap();
                }
                part.step(length);
            }
            assert!(part.warnings.is_empty(), "{way}: {:#?}", part.warnings);
        }
    }
}

/// An importer that integrates: positions and rates at the ends of its steps.
fn exchange(mut set: impl FnMut(&mut Part, f64)) -> Part {
    let mut part = Part::wedge(Interface::ModelExchange);
    set(&mut part, 0.0);
    let mut part = part.begin();
    part.instance.update_discrete_states().unwrap();
    part.instance.enter_continuous_time_mode().unwrap();
    for step in 1..=200 {
        let time = 1e-3 * f64::from(step);
        part.instance.set_time(time).unwrap();
        set(&mut part, time);
        part.instance.completed_integrator_step().unwrap();
        part.listen();
    }
    part
}

#[test]
fn issue_047_model_exchange_is_warned_of_positions_without_rates() {
    exchange(|part, time| part.set("bolster_z", height(time)[0])).expect(&[
        "`bolster_z` and `bolster_z_rate` contradict",
        "`bolster_z_rate` has never been set",
        "use co-simulation",
    ]);
    let both = exchange(|part, time| {
        let [value, rate] = height(time);
        part.set("bolster_z", value);
        part.set("bolster_z_rate", rate);
    });
    // The wedge itself stays where it is: that is told, and nothing of the inputs.
    let of_inputs = both.warnings.iter().filter(|text| text.contains("`bolster_z"));
    assert_eq!(of_inputs.count(), 0, "{:#?}", both.warnings);
}

#[test]
fn issue_047_motions_that_no_machine_makes_are_warned_of_once() {
    let jumps: [(Made, &str); 4] = [
        (car, "rail_bed_1_left_z_motion"),
        (three_piece, "bolster_z_motion"),
        (half_truck, "body_7_z"),
        (quasi_static, "bolster_z"),
    ];
    for (source, input) in jumps {
        let mut part = Part::of(source(), Interface::CoSimulation).begin();
        part.set(input, 1e6);
        // It may fail, but not silently.
        let _ = part.instance.do_step(0.0, 1e-3);
        part.listen();
        let of_speed = part.warnings.iter().filter(|text| text.contains("100 m/s"));
        let texts: Vec<&String> = of_speed.collect();
        assert!(
            matches!(texts[..], [text] if text.contains(input) && text.contains("1000000 m")),
            "{input}: {:#?}",
            part.warnings
        );
    }
}

#[test]
fn issue_047_an_implausible_place_is_warned_of_once() {
    for interface in [Interface::CoSimulation, Interface::ModelExchange] {
        let mut part = Part::wedge(interface).begin();
        if interface == Interface::ModelExchange {
            part.instance.enter_continuous_time_mode().unwrap();
        }
        // The bolster leaves the wedge, at 1 m/s.
        for step in 1..=300 {
            let time = 1e-3 * f64::from(step);
            part.set("bolster_x", time);
            part.set("bolster_x_rate", 1.0);
            match interface {
                Interface::CoSimulation => part.step(1e-3),
                Interface::ModelExchange => {
                    part.instance.set_time(time).unwrap();
                    part.instance.completed_integrator_step().unwrap();
                    part.listen();
                }
            }
        }
        // The wedge follows, and its coil pulls; where nobody integrates, it stays.
        let words = match interface {
            Interface::CoSimulation => "longer than its free length",
            Interface::ModelExchange => "has left its surface",
        };
        let own = part.warnings.iter().filter(|text| text.contains(words));
        let all: Vec<&String> = own.collect();
        assert!(
            matches!(all[..], [text] if text.starts_with("implausible: ") && text.contains("the limit is")),
            "{interface:?}: {:#?}",
            part.warnings
        );
    }
}

/// A call that takes very many steps of the integrator is told; ordinary ones are not.
#[test]
fn issue_048_steps_that_take_much_work_are_warned_of() {
    // Its method ends a step at every row at least.
    // Its method ends a step at every row at least.
    let of = |interval: &str| {
        let text = format!(
            "model = \"car\"\nstart.settle = \"0 s\"\ntrack.support.kind = \"rigid\"\n[simulation]\nmethod = \
             \"tr-bdf2\"\nduration = \"0.1 s\"\noutput_interval = \
             \"{interval}\"\n[[track.segments]]\ntangent = \"500 ft\"\n"
        );
        let case = CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap();
        Source::Car(Box::new(case))
    };
    for (interval, told) in [("1e-3 s", 0), ("4e-6 s", 1)] {
        let mut part = Part::of(of(interval), Interface::CoSimulation).begin();
        part.step(0.025);
        let of_effort = part
            .warnings
            .iter()
            .filter(|text| text.contains("steps of the integrator"));
        assert_eq!(of_effort.count(), told, "{interval}: {:#?}", part.warnings);
    }
}

/// A car that derails is told, once, at the next communication point.
#[test]
fn issue_047_a_car_that_derails_is_warned_of_once() {
    let text = "model = \"car\"\nstart.settle = \"0 s\"\ntrack.support.kind = \"rigid\"\n\
                speed.value = \"100 mph\"\nsimulation.duration = \"3 s\"\n\
                [[track.segments]]\ntangent = \"200 ft\"\n[[track.segments]]\nspiral = \"60 ft\"\n\
                [[track.segments]]\ncurve = \"600 ft\"\ndegree = \"20 deg\"\n";
    let case = CarCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap();
    let mut part = Part::of(Source::Car(Box::new(case)), Interface::CoSimulation).begin();
    for _ in 0..150 {
        let time = part.instance.time();
        if part.instance.do_step(time, 0.02).is_err() {
            break;
        }
        part.listen();
        if part.warnings.iter().any(|text| text.starts_with("derailed: ")) {
            break;
        }
    }
    let told = part
        .warnings
        .iter()
        .filter(|text| text.starts_with("derailed: the "));
    let told: Vec<&String> = told.collect();
    assert!(
        matches!(told[..], [text] if text.contains("wheel of axle") && text.contains("left its rail")),
        "{:.3} s: {:#?}",
        part.instance.time(),
        part.warnings
    );
}

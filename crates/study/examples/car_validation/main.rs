//! Writes docs/validation-car.md: numbers of whole cars beside those of the field and of closed forms.
//!
//! `cargo run --release -p study --example car_validation`: some minutes on two cores.

mod amplitude;
mod explained;
mod hollow;
mod onset;
mod shared;

use std::fmt::Write;
use std::thread;

use car::FrictionState;
use study::car::builtin;
use study::car::run::CarResult;
use truck::ControlCoil;

use shared::{
    Failure, INCH, MPH, cells, column, each, finished, hunt, in_regime, late, run_in, set, statistic,
};

const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Duration for which the speed falls, and rises, s.
const RAMP: f64 = 50.0;

const HEAD: &str = "\
# Validation: cars on track

Numbers of whole cars with three-piece trucks, beside those of the field and of closed forms. **Nothing is \
tuned to them**: all
parameters are the defaults of [the car](car.md) unless a table says otherwise. This page is written by \
`cargo run --release -p
study --example car_validation`, in some minutes; the tests of the crates `car` and `study` hold what is \
exact. Wheelsets and
linear vehicles: [validation of wheelsets](validation-rolling.md).
";

/// A section: its text.
type Section = fn() -> Result<String, Failure>;

fn main() -> Result<(), Failure> {
    let sections: [Section; 14] = [
        hunting_over_speed,
        hunting_held,
        onset::of_treads,
        amplitude::critical_speeds,
        flange_contact,
        sides_in_curves,
        hollow::wheels,
        turning_moment,
        rock_and_roll,
        bounce,
        stillness,
        headings,
        explained::stuck_vibrations,
        explained::ends_of_trucks,
    ];
    let chosen = std::env::args()
        .nth(1)
        .and_then(|word| word.parse::<usize>().ok());
    if let Some(number) = chosen {
        // One section, to look at.
        let section = sections.get(number).ok_or("there are sections 0 to 13")?;
        println!("{}", section()?);
        return Ok(());
    }
    let texts = thread::scope(|scope| {
        let threads: Vec<_> = sections.iter().map(|section| scope.spawn(section)).collect();
        let join = |own: thread::ScopedJoinHandle<'_, _>| own.join().map_err(|_| "a thread panicked")?;
        threads
            .into_iter()
            .map(join)
            .collect::<Result<Vec<String>, Failure>>()
    })?;
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/validation-car.md");
    std::fs::write(path, format!("{HEAD}\n{}", texts.join("\n")))?;
    Ok(())
}

/// Runs a built-in case with overrides.
fn run(name: &str, overrides: &[String]) -> Result<CarResult, Failure> {
    let case = builtin::case_with(name, overrides)?;
    finished(&case, &format!("{name} {overrides:?}"))
}

fn hunting_over_speed() -> Result<String, Failure> {
    let mut out = "## Hunting\n\n\
         The speed falls by a slow ramp (50 s) after a lateral start of all axles by 0.4 in at the highest \
         speed, and rises from the lowest over\nlateral dips of 0.02 in; an axle with an amplitude of 0.05 \
         in hunts, one with 0.38 in\n\
         runs from flange to flange. \
         Profiles: AAR-1B with its tread of 1:20, and the same flange with a\ntread of 1:10 (conicity \
         0.1; one of 0.2 leaves this flange no face). In the field empty cars hunt from 50 to\n\
         55 mph on, loaded ones from 90 to 100 mph.\n\n\
         | car | side bearings | tread | speeds, mph | falling: flange to flange down to, mph | falling: \
         dies at, mph | rising: begins at, mph | largest amplitude, in |\n|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let rows: [(&str, &str, &str, [f64; 2]); 5] = [
        ("empty", "roller", "aar_1b", [30.0, 80.0]),
        ("empty", "roller", "aar_1b_1:10", [30.0, 80.0]),
        ("empty", "constant_contact", "aar_1b", [30.0, 80.0]),
        ("empty", "constant_contact", "aar_1b_1:10", [30.0, 80.0]),
        ("loaded", "roller", "aar_1b", [60.0, 120.0]),
    ];
    let lines = each(&rows, |(lading, bearing, tread, range)| {
        let overrides = [
            format!("truck.side_bearing.kind={bearing}"),
            format!("wheels.profile={tread}"),
            format!("lading.kind={lading}"),
        ];
        let found = hunt(*range, RAMP, &overrides)?;
        let [low, high] = range;
        let name = match *tread {
            "aar_1b" => "1:20",
            other => other.trim_start_matches("aar_1b_"),
        };
        Ok(format!(
            "| {lading} | {} | {name} | {low:.0} to {high:.0} | {} |\n",
            bearing.replace('_', " "),
            cells(&found).join(" | ")
        ))
    })?;
    out.extend(lines);
    out += "\nThe amplitude is that of the falling ramp. Conicities of real wheels depend on wear: 1:10 \
            stands for a worn tread.\n";
    Ok(out)
}

fn hunting_held() -> Result<String, Failure> {
    let mut out = "## Hunting at held speeds\n\n\
         The regime `hunting`: the empty car with roller side bearings, all axles 0.4 in to the left at the \
         start, held at a speed over 2,620 ft:\nhow far the first axle is from the middle within the last \
         two seconds (friction may hold it there), and the standard deviation of the body's \
         lateral\nacceleration over 2,000 ft. The field tells hunting of empty cars from 50 to 55 mph on, \
         and allows a deviation of 0.13 g (remembered).\n\n| speed, mph | farthest from the middle, in | \
         deviation, front, g | deviation, rear, g |\n|---|---|---|---|\n"
        .to_owned();
    let speeds = [30.0, 40.0, 50.0, 60.0, 70.0, 80.0];
    let lines = each(&speeds, |speed| {
        let result = run_in("hunting", "empty", *speed, &["truck.side_bearing.kind=roller"])?;
        let lateral = column(&result, "axle_1_lateral")?;
        let swing = lateral[lateral.len() - 400..].iter();
        let swing = swing.fold(0.0_f64, |most, own| most.max(own.abs()));
        let [front, rear] = [1, 2].map(|end| {
            statistic(
                &result,
                &format!("body_at_truck_{end}_lateral_acceleration_deviation"),
            )
        });
        Ok(format!(
            "| {speed:.0} | {:.3} | {:.3} | {:.3} |\n",
            swing / INCH,
            front?,
            rear?
        ))
    })?;
    out.extend(lines);
    Ok(out)
}

fn sides_in_curves() -> Result<String, Failure> {
    let mut out = "## Sides in curves\n\n\
         The regime `constant_curve`, the loaded car in 7.5° to the left with 4 in of superelevation, from 3 \
         in of cant excess to 3 in of deficiency:\nmeans of the last two seconds, and L/V of the front \
         truck's sides. The leading outer wheel runs on its flange (0.41 in) at all speeds and has \
         the\nlargest L/V, less at deficiency, where it bears more. The truck's outer side has the larger \
         L/V at all of them, balance being at 28 mph.\n\n| speed, mph | cant deficiency, in | leading \
         axle to the outside, in | L/V leading outer | L/V leading inner | truck side outer | truck side \
         inner |\n|---|---|---|---|---|---|---|\n"
        .to_owned();
    let speeds: [f64; 6] = [14.0, 18.0, 23.0, 28.0, 32.0, 36.0];
    let lines = each(&speeds, |speed| {
        let result = run_in("constant_curve", "loaded", *speed, &[])?;
        let mean = |name: &str| late(&result, name, 400);
        Ok(format!(
            "| {speed:.0} | {:+.1} | {:.3} | {:.3} | {:.3} | {:.3} | {:.3} |\n",
            0.0007 * 7.5 * speed * speed - 4.0,
            -mean("axle_1_lateral")? / INCH,
            mean("axle_1_right_l_over_v")?,
            mean("axle_1_left_l_over_v")?,
            statistic(&result, "truck_1_right_side_l_over_v")?,
            statistic(&result, "truck_1_left_side_l_over_v")?,
        ))
    })?;
    out.extend(lines);
    Ok(out)
}

/// Bounce on joints opposite each other, beside its frequency.
fn bounce() -> Result<String, Failure> {
    let car = in_regime("pitch_and_bounce", "loaded", 50.0, &[])?.parameters;
    let trucks = car.trucks.iter();
    let control = |own: &truck::Wedge| match &own.control_coil {
        ControlCoil::Shear(spring) => spring.stiffness,
        _ => 0.0,
    };
    let stiffness: f64 = trucks
        .clone()
        .map(|own| own.load_stiffness() + own.wedges.iter().map(control).sum::<f64>())
        .sum();
    let bolsters: f64 = trucks.map(|own| own.bolster.body.mass + own.wedge_mass()).sum();
    let coils = (stiffness / (car.carried_mass() + bolsters)).sqrt() / std::f64::consts::TAU;
    let modes = car.modes(20.0, FrictionState::Absent)?;
    let near = modes
        .iter()
        .filter(|mode| (mode.frequency / coils - 1.0).abs() < 0.05);
    let found = near.min_by(|a, b| a.growth.abs().total_cmp(&b.growth.abs()));
    let found = found.ok_or("there is no bounce")?.frequency;
    let mut out = format!(
        "## Bounce\n\n\
         The regime `pitch_and_bounce`, ten low joints of 0.75 in every 39 ft on both rails alike, the \
         loaded car: standard deviation of the body's\nvertical acceleration over the front truck, and least \
         wheel load. On its coils the car bounces with {coils:.3} Hz, on coils, contacts and sprung \
         rails\nwith {found:.3} Hz by linearization without friction: joints come with it at {:.1} mph.\n\n\
         | speed, mph | deviation, g, wedge friction 0.4 | wedge friction 0.1 | least wheel load, %, 0.4 | \
         0.1 |\n|---|---|---|---|---|\n",
        found * 39.0 * 0.3048 / MPH
    );
    let speeds = [40.0, 45.0, 50.0, 55.0, 60.0, 65.0, 70.0];
    let both: Vec<(f64, f64)> = speeds.iter().flat_map(|own| [(*own, 0.4), (*own, 0.1)]).collect();
    let found = each(&both, |(speed, friction)| {
        let overrides = ["column", "slope"].map(|own| format!("truck.friction.{own}={friction}"));
        let overrides = overrides.each_ref().map(String::as_str);
        let result = run_in("pitch_and_bounce", "loaded", *speed, &overrides)?;
        let deviation = statistic(&result, "body_at_truck_1_vertical_acceleration_deviation")?;
        let mut least = f64::INFINITY;
        for axle in 1..=4 {
            least = least.min(statistic(&result, &format!("axle_{axle}_left_least_load_time"))?);
        }
        Ok([deviation, least])
    })?;
    for (speed, pair) in speeds.iter().zip(found.chunks(2)) {
        if let [usual, little] = pair {
            let _ = writeln!(
                out,
                "| {speed:.0} | {:.3} | {:.3} | {:.0} | {:.0} |",
                usual[0], little[0], usual[1], little[1]
            );
        }
    }
    out += "\nWith friction of 0.1 the coils go solid from 50 mph on. That stiffens the car: it bounces most \
            above the speed of its\nfrequency, and falls out of step beyond. With friction of 0.4 there is \
            no such resonance.\n";
    Ok(out)
}

fn flange_contact() -> Result<String, Failure> {
    let mut out = "## Flange contact in curves\n\n\
         The loaded car at 25 mph in curves without superelevation, after 20 s. Free rolling on cones of \
         1:20 needs a shift of r a/(λR); the\nflange of the AAR-1B (narrow) touches at 0.41 in. The field \
         tells flange contact above about 2°.\n\n\
         | curve, deg | leading axle to the outside, in | free rolling, in | its angle of attack, mrad | L/V \
         of its outer wheel |\n|---|---|---|---|---|\n"
        .to_owned();
    let degrees: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 6.0];
    let lines = each(&degrees, |degree| {
        let overrides = [
            "track.segments=[{tangent='100 ft'}, {spiral='200 ft'}, {curve='1000 ft', degree='D deg', \
             direction='left'}]"
                .replace('D', &degree.to_string())
                .replace('\'', "\""),
            "speed.value=25 mph".to_owned(),
            "simulation.duration=28 s".to_owned(),
        ];
        let result = run("car_constant_curve_loaded", &overrides)?;
        // The last second.
        let mean = |name: &str| late(&result, name, 200);
        let shift = -mean("axle_1_lateral")? / INCH;
        let attack = -mean("axle_1_yaw")? * 1e3;
        let ratio = mean("axle_1_right_l_over_v")?;
        let radius = 50.0 / (0.5 * degree.to_radians()).sin() * 12.0;
        let rolling = 18.0 * 29.75 / (0.05 * radius);
        Ok(format!(
            "| {degree} | {shift:.3} | {rolling:.2} | {attack:.2} | {ratio:.3} |\n"
        ))
    })?;
    out.extend(lines);
    Ok(out)
}

fn turning_moment() -> Result<String, Failure> {
    let result = run("car_spiral_loaded", &set(&["truck.side_bearing.kind=roller"]))?;
    let mut out = "## Center plates in a spiral\n\n\
         The loaded car with roller side bearings runs into a curve of 7.5° by a spiral of 150 ft. A flat \
         plate of diameter D, of radius R = D/2, that slides all\nover turns with 2/3 μ W R: 114 kip·in at a \
         diameter of 14 in, μ = 0.2 and half of the body's weight. One that bears on its edge alone turns \
         with\nμ W R, half as much again: \
         numbers between both are those of a plate on which the load lies unevenly, as the twist of a spiral \
         puts it.\n\n| truck | turning moment, largest, kip·in | plate load there, kip | 2/3 μ W R, kip·in \
         |  |\n|---|---|---|---|---|\n"
        .to_owned();
    for truck in 1..=2 {
        let moments = column(&result, &format!("truck_{truck}_center_plate_turning_moment"))?;
        let loads = column(&result, &format!("truck_{truck}_center_plate_load"))?;
        let pairs = moments.iter().zip(loads);
        let (moment, load) = pairs.fold((0.0_f64, 0.0), |most, (moment, load)| {
            if moment.abs() > most.0 {
                (moment.abs(), *load)
            } else {
                most
            }
        });
        let closed = 2.0 / 3.0 * 0.2 * load.abs() * 7.0 / (1e3 * POUND_FORCE);
        let found = moment / (1e3 * POUND_FORCE * INCH);
        let _ = writeln!(
            out,
            "| {} | {found:.1} | {:.1} | {closed:.1} | {:+.1} % |",
            ["front", "rear"][truck - 1],
            load.abs() / (1e3 * POUND_FORCE),
            100.0 * (found / closed - 1.0)
        );
    }
    Ok(out)
}

fn rock_and_roll() -> Result<String, Failure> {
    let mut out = "## Rock and roll\n\n\
         Ten staggered low joints of 0.75 in every 39 ft, the loaded car: roll of the body, greatest less \
         least, degrees. The field tells the\nlargest roll at 12 to 24 mph; less friction of the wedges \
         rolls more.\n\n\
         | speed, mph | wedge friction 0.4 | wedge friction 0.1 |\n|---|---|---|\n"
        .to_owned();
    let speeds = [12.0, 14.0, 16.0, 18.0, 22.0];
    let both: Vec<(f64, f64)> = speeds
        .iter()
        .flat_map(|speed| [(*speed, 0.4), (*speed, 0.1)])
        .collect();
    let found = each(&both, |(speed, friction)| {
        let overrides = [
            format!("speed.value={speed} mph"),
            format!("truck.friction.column={friction}"),
            format!("truck.friction.slope={friction}"),
            format!("simulation.duration={:.0} s", 620.0 / (speed * 1.4667)),
        ];
        let result = run("car_twist_and_roll_loaded", &overrides)?;
        let roll = result.summary.statistics.get("body_roll_peak_to_peak");
        let roll = roll.and_then(|own| own.raw.as_ref()).ok_or("no roll")?;
        let derailed = if result.summary.derailed.is_some() {
            " (derails)"
        } else {
            ""
        };
        Ok((roll.value.to_degrees(), derailed))
    })?;
    for (speed, pair) in speeds.iter().zip(found.chunks(2)) {
        if let [(usual, a), (little, b)] = pair {
            let _ = writeln!(out, "| {speed:.0} | {usual:.2}{a} | {little:.2}{b} |");
        }
    }
    Ok(out)
}

fn stillness() -> Result<String, Failure> {
    let mut out = "## Stillness on perfect track\n\n\
         60 s on straight track without irregularities, standing and below half of the speeds at which a car \
         hunts: largest lateral motions\nof axles, and roll of the body, to stay below 1e-6 m and rad.\n\n\
         | car | speed, mph | lateral, m | roll, rad |\n|---|---|---|---|\n"
        .to_owned();
    let runs = [("loaded", 0.0), ("empty", 0.0), ("loaded", 25.0), ("empty", 25.0)];
    let lines = each(&runs, |(lading, speed)| {
        let kind = if *speed == 0.0 { "coasting" } else { "held" };
        let overrides = [
            format!("lading.kind={lading}"),
            format!("speed.kind={kind}"),
            format!("speed.value={speed} mph"),
            "track.segments=[{tangent=\"2400 ft\"}]".to_owned(),
            "track.irregularities=[]".to_owned(),
            "simulation.duration=60 s".to_owned(),
            "simulation.output_interval=0.02 s".to_owned(),
        ];
        let result = run(&format!("car_tangent_{lading}"), &overrides)?;
        let most = |name: &str| -> Result<f64, Failure> {
            Ok(column(&result, name)?
                .iter()
                .fold(0.0, |most: f64, own| most.max(own.abs())))
        };
        let mut lateral = 0.0_f64;
        for axle in 1..=4 {
            lateral = lateral.max(most(&format!("axle_{axle}_lateral"))?);
        }
        let degrees_or = |own: f64| {
            if own < 1e-6 {
                "below 1e-6".to_owned()
            } else {
                format!("**{own:.1e}**")
            }
        };
        Ok(format!(
            "| {lading} | {speed:.0} | {} | {} |\n",
            degrees_or(lateral),
            degrees_or(most("body_roll")?)
        ))
    })?;
    out.extend(lines);
    Ok(out)
}

fn headings() -> Result<String, Failure> {
    let mut out = "## A circle of curve\n\n\
         The loaded car through most of a circle of 10° at 15 mph without superelevation: forces of all \
         wheels around the circle,\nbeside those a quarter of a circle after its beginning.\n\n\
         | part of the circle | largest difference of wheel forces | in parts of the static load \
         |\n|---|---|---|\n"
        .to_owned();
    // 3,604 ft a lap at 22 ft/s: 163.8 s.
    let overrides = [
        "track.segments=[{tangent='100 ft'}, {spiral='200 ft'}, {curve='3260 ft', degree='10 deg', \
         direction='left'}]"
            .replace('\'', "\""),
        "speed.value=15 mph".to_owned(),
        "simulation.duration=155 s".to_owned(),
        "simulation.output_interval=0.05 s".to_owned(),
    ];
    let result = run("car_constant_curve_loaded", &overrides)?;
    let times = column(&result, "time")?;
    let at = |time: f64| times.partition_point(|own| *own < time).min(times.len() - 1);
    let lap = 163.8;
    let first = at(14.0 + 0.25 * lap);
    for share in [0.5, 0.75, 0.85] {
        let row = at(14.0 + share * lap);
        let mut largest = 0.0_f64;
        for axle in 1..=4 {
            for side in ["left", "right"] {
                for force in ["vertical", "lateral"] {
                    let own = column(&result, &format!("axle_{axle}_{side}_{force}"))?;
                    largest = largest.max((own[row] - own[first]).abs());
                }
            }
        }
        let _ = writeln!(out, "| {share} | {largest:.3} N | {:.1e} |", largest / 146.2e3);
    }
    Ok(out)
}

//! Cars: curving and rocking with other faces, rocking over wedge rise, center plates and adapters.

use drawing::{Figure, Panel, PlotCurve, distinct};
use study::car::run::CarResult;

use crate::shared::{Failure, INCH, column, each, late, run_in, statistic};
use crate::{CROWN_60, CROWN_240, FLAT, POUND_FORCE, Section, head, row};

/// Runs a loaded car in a regime at a speed (mph).
fn run(regime: &str, speed: f64, set: &[String]) -> Result<CarResult, Failure> {
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    run_in(regime, "loaded", speed, &set)
}

/// Returns the roll of the car body, greatest less least, deg.
fn roll(result: &CarResult) -> Result<f64, Failure> {
    Ok(statistic(result, "body_roll_peak_to_peak")?.to_degrees())
}

/// Returns a statistic of all wheels.
fn of_wheels(result: &CarResult, ending: &str) -> Result<Vec<f64>, Failure> {
    let wheels =
        (1..=4).flat_map(|axle| ["left", "right"].map(|side| format!("axle_{axle}_{side}_{ending}")));
    wheels.map(|name| statistic(result, &name)).collect()
}

/// Returns the least wheel load, % of the static one.
fn least_load(result: &CarResult) -> Result<f64, Failure> {
    let all = of_wheels(result, "least_load_time")?;
    Ok(all.into_iter().fold(f64::INFINITY, f64::min))
}

/// Returns the largest L/V of a wheel.
fn largest_ratio(result: &CarResult) -> Result<f64, Failure> {
    Ok(of_wheels(result, "l_over_v_time")?
        .into_iter()
        .fold(0.0, f64::max))
}

/// Returns the mean of a column over its last two seconds.
fn mean(result: &CarResult, name: &str) -> Result<f64, Failure> {
    late(result, name, 400)
}

fn of_truck(set: &[&str]) -> Vec<String> {
    set.iter().map(|own| format!("truck.{own}")).collect()
}

pub(crate) fn section() -> Result<Section, Failure> {
    let mut text = curving()?;
    let (rising, figure) = rising()?;
    text += &rising;
    text += &plates()?;
    text += &adapters()?;
    Ok(Section {
        text,
        figures: vec![("wedge_faces_rise", figure)],
    })
}

fn curving() -> Result<String, Failure> {
    let mut text = "## Curving and rocking\n\nThe loaded car: the curve of 7.5° at 28 mph (means of the \
                    last two seconds), dynamic curving at 20 mph, twist and roll at 16 mph.\n\n"
        .to_owned();
    text += &head(&[
        "slope face",
        "curve: warp, mrad",
        "leading outer L/V",
        "dynamic curving: largest L/V",
        "least wheel load, %",
        "twist and roll: roll, deg",
        "least wheel load, %",
    ]);
    let faces = [FLAT, CROWN_240, CROWN_60];
    let items: Vec<_> = faces
        .into_iter()
        .flat_map(|own| [0, 1, 2].map(|which| (own, which)))
        .collect();
    let found = each(&items, |((_, set), which)| {
        let set = of_truck(set);
        Ok(match which {
            0 => {
                let result = run("constant_curve", 28.0, &set)?;
                let warp = 1e3 * mean(&result, "truck_1_warp_angle")?.abs();
                let [right, left] =
                    ["right", "left"].map(|own| mean(&result, &format!("axle_1_{own}_l_over_v")));
                [warp, right?.max(left?)]
            }
            1 => {
                let result = run("dynamic_curving", 20.0, &set)?;
                [largest_ratio(&result)?, least_load(&result)?]
            }
            _ => {
                let result = run("twist_and_roll", 16.0, &set)?;
                [roll(&result)?, least_load(&result)?]
            }
        })
    })?;
    for ((name, _), own) in faces.iter().zip(found.chunks(3)) {
        text += &row([
            (*name).to_owned(),
            format!("{:.1}", own[0][0]),
            format!("{:.3}", own[0][1]),
            format!("{:.3}", own[1][0]),
            format!("{:.0}", own[1][1]),
            format!("{:.2}", own[2][0]),
            format!("{:.0}", own[2][1]),
        ]);
    }
    text += "\nThe loaded car's verdicts hardly notice the face.\n";
    Ok(text)
}

/// Rocking over the rise.
fn rising() -> Result<(String, Figure), Failure> {
    let mut text = "\n## Rocking over wedge rise\n\nTwist and roll, the loaded car at 16 mph, variable \
                    damping, all wedges worn alike: depths c at column and slope lift a wedge by (c cos θ + \
                    c)/sin θ, θ = 32°. A worn wedge's coil is longer and presses less; damping goes with \
                    it.\n\n"
        .to_owned();
    text += &head(&[
        "rise, in",
        "depth of each face, in",
        "roll, 240 in, deg",
        "least wheel load, %",
        "column force at the start, lbf",
        "roll, flat, deg",
        "least wheel load, %",
    ]);
    let rises = [0.0, 0.25, 0.523, 0.697, 0.75, 0.872, 1.0, 1.046];
    let items: Vec<_> = rises
        .into_iter()
        .flat_map(|rise| [CROWN_240, FLAT].map(|own| (rise, own)))
        .collect();
    let found = each(&items, |(rise, (_, set))| {
        let mut set = of_truck(set);
        set.push(format!("truck.wedge.rise={rise} in"));
        let result = run("twist_and_roll", 16.0, &set)?;
        let normal = column(&result, "truck_1_leading_left_column_normal")?;
        Ok([roll(&result)?, least_load(&result)?, normal[0] / POUND_FORCE])
    })?;
    let angle = 32f64.to_radians();
    for (rise, own) in rises.iter().zip(found.chunks(2)) {
        text += &row([
            format!("{rise:.2}"),
            format!("{:.3}", rise * angle.sin() / (1.0 + angle.cos())),
            format!("{:.2}", own[0][0]),
            format!("{:.0}", own[0][1]),
            format!("{:.0}", own[0][2]),
            format!("{:.2}", own[1][0]),
            format!("{:.0}", own[1][1]),
        ]);
    }
    text += "\n![Roll and least wheel load over wedge rise](figures/wedge_faces_rise.svg)\n\nBetween two \
             marks of a gauge, 0.75 and 1 in, the car begins to rock: a cliff that stands with flat faces \
             as with crowned ones.\n";
    let curve = |which: usize, value: usize, label: &str| {
        let (colour, line) = distinct(which);
        PlotCurve {
            label: label.to_owned(),
            colour,
            line,
            points: rises
                .iter()
                .zip(found.chunks(2))
                .map(|(rise, own)| (*rise, own[which][value]))
                .collect(),
        }
    };
    let panel = |y_label: &str, value: usize| Panel {
        x_label: "wedge rise (in)".to_owned(),
        y_label: y_label.to_owned(),
        curves: vec![curve(0, value, "crown of 240 in"), curve(1, value, "flat")],
        ..Panel::default()
    };
    let figure = Figure {
        title: "Rocking of the loaded car over wedge rise".to_owned(),
        caption: "Roll (greatest less least) and least wheel load of the loaded car in twist and roll at 16 \
                  mph over the rise of all wedges, with crowned and with flat slope faces."
            .to_owned(),
        panels: vec![
            panel("roll of the car body (deg)", 0),
            panel("least wheel load (% of the static one)", 1),
        ],
        ..Figure::default()
    };
    Ok((text, figure))
}

fn plates() -> Result<String, Failure> {
    let mut text = "\n## Center plate\n\nBowls of 12, 14 and 16 in are in use (the US Navy's handbook \
                    P-301 has wear limits of each); no source at hand says which truck has which, and \
                    14 in is a choice (`truck.center_plate.diameter`). A plate of diameter D under the \
                    load W resists turning with (1/3) μ W D. The loaded car: through a spiral at 20 mph, \
                    and twist and roll at 16 mph.\n\n"
        .to_owned();
    text += &head(&[
        "diameter, in",
        "(1/3) μ W D, kip·in",
        "spiral: largest turning moment, kip·in",
        "twist and roll: roll, deg",
        "least wheel load, %",
    ]);
    let diameters = [12.0, 14.0, 16.0];
    let items: Vec<_> = diameters
        .into_iter()
        .flat_map(|own| [(own, true), (own, false)])
        .collect();
    let found = each(&items, |(diameter, spiral)| {
        let set = [format!("truck.center_plate.diameter={diameter} in")];
        Ok(match spiral {
            true => {
                let result = run("spiral", 20.0, &set)?;
                let turning = column(&result, "truck_1_center_plate_turning_moment")?;
                let load = mean(&result, "truck_1_center_plate_load")?;
                let largest = turning.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
                [largest, 0.2 * load * diameter * INCH / 3.0]
            }
            false => {
                let result = run("twist_and_roll", 16.0, &set)?;
                [roll(&result)?, least_load(&result)?]
            }
        })
    })?;
    let kip = 1e3 * POUND_FORCE * INCH;
    for (diameter, own) in diameters.iter().zip(found.chunks(2)) {
        text += &row([
            format!("{diameter:.0}"),
            format!("{:.1}", own[0][1] / kip),
            format!("{:.1}", own[0][0] / kip),
            format!("{:.2}", own[1][0]),
            format!("{:.0}", own[1][1]),
        ]);
    }
    text += "\nIn the spiral the load sits towards an edge of the plate, whose moment then comes nearer to \
             that of the edge alone, (1/2) μ W D.\n";
    Ok(text)
}

fn adapters() -> Result<String, Failure> {
    let mut text = "\n## Adapters\n\nThe stiffness of an adapter's two points is a guess. 1e6 lbf/in each \
                    is a fifteenth of Hertz's line contact of a steel roof on a crowned adapter (3e7 lbf/in \
                    for both), and enough for a car that rocks not to sink into its adapters further than \
                    their faces allow. The loaded car, twist and roll at 16 mph and dynamic curving at 20 \
                    mph:\n\n"
        .to_owned();
    text += &head(&[
        "stiffness of a point, lbf/in",
        "roll, deg",
        "least wheel load, %",
        "dynamic curving: largest L/V",
        "least wheel load, %",
        "steps of the integrator",
    ]);
    let values = ["5e5", "1e6", "2e6", "4e6"];
    let items: Vec<_> = values
        .into_iter()
        .flat_map(|own| [(own, true), (own, false)])
        .collect();
    let found = each(&items, |(stiffness, rocking)| {
        let set = [format!("truck.adapter.stiffness={stiffness} lbf/in")];
        let (regime, speed) = if *rocking {
            ("twist_and_roll", 16.0)
        } else {
            ("dynamic_curving", 20.0)
        };
        let result = run(regime, speed, &set)?;
        let first = match rocking {
            true => roll(&result)?,
            false => largest_ratio(&result)?,
        };
        Ok([first, least_load(&result)?, result.summary.solver.steps as f64])
    })?;
    for (stiffness, own) in values.iter().zip(found.chunks(2)) {
        text += &row([
            (*stiffness).to_owned(),
            format!("{:.2}", own[0][0]),
            format!("{:.0}", own[0][1]),
            format!("{:.3}", own[1][0]),
            format!("{:.0}", own[1][1]),
            format!("{:.0}", own[0][2] + own[1][2]),
        ]);
    }
    text += "\nRocking hardly notices it, the largest L/V of dynamic curving does: a guess that is in a \
             verdict.\n";
    Ok(text)
}

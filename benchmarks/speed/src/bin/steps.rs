//! `steps [STEP [NAME-PART]]`: drives the thesis's yawed wedges through an FMU's instance in communication
//! steps (s) and says what one costs.

use std::process::ExitCode;
use std::time::Instant;

use fmi::description::Version;
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::source::FmuModel;
use study::case::builtin;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let step = arguments.next().map_or(Ok(1e-3), |text| text.parse());
    let part = arguments.next().unwrap_or_else(|| "psi_0.012".to_owned());
    let Ok(step) = step else {
        eprintln!("usage: steps [STEP [NAME-PART]], such as 0.001 psi_0.012");
        return ExitCode::from(2);
    };
    println!("{:28} {:>12} {:>14}", "case", "step", "with outputs");
    for name in builtin::thesis_names().filter(|name| name.contains(&part)) {
        match measure(name, step, false).and_then(|bare| Ok((bare, measure(name, step, true)?))) {
            Ok((bare, read)) => println!("{name:28} {bare:>9.1} µs {read:>11.1} µs"),
            Err(error) => {
                eprintln!("{name}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Returns the mean cost of a step, µs, with or without reading all outputs after it.
fn measure(name: &str, step: f64, read: bool) -> Result<f64, Box<dyn std::error::Error>> {
    let case = builtin::case(name)?;
    let duration = case.simulation.duration;
    let mut instance = Instance::of_case(
        name,
        None,
        FmuModel::Wedge,
        case,
        Version::Two,
        Interface::CoSimulation,
    )?;
    let find = |instance: &Instance, wanted: &str| {
        let variables = &instance.description().variables;
        variables
            .iter()
            .find(|variable| variable.name == wanted)
            .map(|variable| variable.reference)
    };
    let (Some(height), Some(rate)) = (find(&instance, "bolster_z"), find(&instance, "bolster_z_rate")) else {
        return Err("the inputs are missing".into());
    };
    let outputs: Vec<u32> = instance
        .description()
        .variables
        .iter()
        .filter(|variable| matches!(variable.role, fmi::variable::VariableRole::Output(_)))
        .map(|variable| variable.reference)
        .collect();
    instance.enter_initialization()?;
    instance.exit_initialization()?;
    let steps = (duration / step).round();
    let begin = Instant::now();
    let mut sum = 0.0;
    for number in 0..steps as u64 {
        let time = number as f64 * step;
        // 1 in · sin(2 rad/s · t), as in all of the thesis's runs.
        let (sin, cos) = (2.0 * time).sin_cos();
        instance.set_float(height, 0.0254 * sin)?;
        instance.set_float(rate, 0.0508 * cos)?;
        instance.do_step(time, step)?;
        if read {
            for output in &outputs {
                sum += instance.get_float(*output)?;
            }
        }
    }
    let cost = begin.elapsed().as_secs_f64() / steps * 1e6;
    if sum.is_nan() {
        return Err("an output is no number".into());
    }
    Ok(cost)
}

//! A car on track: how it stands, how long steps are, what they cost.
//!
//! `cargo run --release -p car --example speed -- loaded|empty track method tolerance seconds`

use std::time::Instant;

use car::{Car, Parameters};
use integrate::{Integrator, Method, Options, Problem};
use mechanics::energy_balance::EnergyBalance;
use truck::Lading;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{CenterLine, CurveElements, Direction, Irregularity, Placed, Rails, Segment, Track};

const INCH: f64 = 0.0254;

type Failure = Box<dyn std::error::Error>;

fn track(name: &str) -> Result<Track, Failure> {
    let curve = |degree: f64| CurveElements::of_degree(degree.to_radians(), 4.0 * INCH);
    let class = |n: u8| -> Result<Vec<Placed>, Failure> {
        let placed = |rails, direction, spectrum, seed| -> Result<Placed, Failure> {
            let own = Realization::new(spectrum, [1.524, 91.44], 1000, 30.0, seed)?;
            Ok(Placed {
                rails,
                direction,
                irregularity: Irregularity::Spectrum(own),
            })
        };
        Ok(vec![
            placed(Rails::Both, Direction::Lateral, Spectrum::FraLateral(n), 1)?,
            placed(Rails::Against, Direction::Lateral, Spectrum::FraCrossLevel(n), 2)?,
            placed(Rails::Both, Direction::Vertical, Spectrum::FraVertical(n), 3)?,
            placed(Rails::Against, Direction::Vertical, Spectrum::FraCrossLevel(n), 4)?,
        ])
    };
    let (segments, irregularities) = match name {
        "class6" => (vec![Segment::Tangent(600.0)], class(6)?),
        "class4" => (vec![Segment::Tangent(600.0)], class(4)?),
        "curve" => (
            vec![
                Segment::Tangent(60.0),
                Segment::Spiral(60.0),
                Segment::Curve(400.0, curve(7.5)),
            ],
            Vec::new(),
        ),
        _ => (vec![Segment::Tangent(2000.0)], Vec::new()),
    };
    Ok(Track {
        center_line: CenterLine::new(&segments, 59.5 * INCH, &[])?,
        irregularities,
    })
}

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let word = |i: usize, usual: &str| words.get(i).cloned().unwrap_or_else(|| usual.to_owned());
    let lading = match word(0, "loaded").as_str() {
        "empty" => Lading::Empty,
        _ => Lading::Loaded,
    };
    let number = |i: usize, usual: &str| -> Result<f64, Failure> { Ok(word(i, usual).parse()?) };
    let method = match word(2, "esdirk").as_str() {
        "rodas" => Method::Rodas5P,
        "trbdf2" => Method::TrBdf2,
        _ => Method::Esdirk3,
    };
    let speed = number(5, "60")? / 3.6;
    let mut parameters = Parameters::new(lading, track(&word(1, "straight"))?, speed)?;
    for other in words.iter().skip(6) {
        match other.as_str() {
            "rigid" => parameters.support = None,
            "tables" => {
                if let car::Wheels::OnRails(wheels) = &mut parameters.wheels {
                    wheels.tables = true;
                }
            }
            "massless" => {
                for own in &mut parameters.trucks {
                    for wedge in &mut own.wedges {
                        wedge.kind = truck::WedgeKind::Massless;
                    }
                }
            }
            "warp" => {
                for own in &mut parameters.trucks {
                    own.warp_spring = Some(truck::empirical_warp(255e3 * 4.448 * INCH)?);
                }
            }
            other => return Err(format!("unknown word {other}").into()),
        }
    }
    let begun = Instant::now();
    let car = Car::new(&parameters)?;
    println!("made in {:.3} s", begun.elapsed().as_secs_f64());
    let mut system = car.system.clone();
    let mut rates = vec![0.0; car.initial_state.len()];
    println!("{} states", rates.len());
    let begun = Instant::now();
    let x = &car.initial_state;
    for _ in 0..200 {
        system.derivative(0.0, x, &mut rates);
        let mut other = x.clone();
        other[0] += 1e-9;
        system.derivative(0.0, &other, &mut rates);
    }
    println!("derivative {:.1} us", begun.elapsed().as_secs_f64() / 400.0 * 1e6);
    let mut unused = vec![0.0; x.len()];
    let begun = Instant::now();
    for _ in 0..100 {
        system.linearize(0.0, x, &rates, &mut unused);
    }
    println!("jacobian {:.1} us", begun.elapsed().as_secs_f64() / 100.0 * 1e6);
    let begun = Instant::now();
    for i in 0..100 {
        system.factor(1e3 + f64::from(i))?;
    }
    println!("factor {:.1} us", begun.elapsed().as_secs_f64() / 100.0 * 1e6);
    let begun = Instant::now();
    for _ in 0..100 {
        system.solve(&mut unused);
    }
    println!("solve {:.1} us", begun.elapsed().as_secs_f64() / 100.0 * 1e6);
    let seen = system.observe(0.0, x);
    let start = seen.energies.total();
    system.derivative(0.0, x, &mut rates);
    let loads = car.loads(&seen, &rates);
    show(&loads);
    let end = number(4, "1")?;
    let options = Options {
        relative_tolerance: number(3, "1e-4")?,
        ..Options::of(method)
    };
    let begun = Instant::now();
    let mut integrator = Integrator::new(car.system.clone(), options, 0.0, x)?;
    let mut balance = EnergyBalance::new(start);
    let mut next = 0.0;
    while integrator.time() < end {
        integrator.step_to(end)?;
        if integrator.time() >= next {
            next += 0.1;
            let (time, state) = (integrator.time(), integrator.x().to_vec());
            let seen = system.observe(time, &state);
            balance.note(time, &system.ledger_entries(&seen, start));
            if next.rem_euclid(end / 5.0) < 0.1 {
                system.derivative(time, &state, &mut rates);
                println!("{time:.3} s");
                show(&car.loads(&seen, &rates));
            }
        }
    }
    let seconds = begun.elapsed().as_secs_f64();
    let statistics = integrator.statistics();
    println!("{end} s in {seconds:.2} s: {statistics:?}");
    println!("residual {:.2e}", balance.relative_residual());
    let seen = system.observe(integrator.time(), integrator.x());
    for (term, value) in system.energy_terms().iter().zip(&seen.quadratures) {
        if value.abs() > 100.0 {
            println!("{:?} {}: {value:.1} J", term.kind, term.element);
        }
    }
    Ok(())
}

fn show(loads: &car::Loads) {
    println!(
        "  {:.2} m, {:.3} m/s, angles {:?}",
        loads.distance, loads.speed, loads.body_angles
    );
    for (axle, wheels) in loads.axles.iter().zip(&loads.wheels) {
        println!(
            "  y {:8.3} mm, yaw {:8.3} mrad, V {:8.0} {:8.0}, L {:8.0} {:8.0} N",
            axle.lateral * 1e3,
            axle.yaw * 1e3,
            wheels[0].vertical,
            wheels[1].vertical,
            wheels[0].lateral,
            wheels[1].lateral
        );
    }
    for (end, truck) in loads.ends.iter().zip(&loads.trucks) {
        println!(
            "  end {:.4} {:.4} m, {:.3} {:.3} m/s2; warp {:.3} mrad, nests {:.0} {:.0}, column {:.0}",
            end.lateral,
            end.vertical,
            end.lateral_acceleration,
            end.vertical_acceleration,
            truck.warp_angle * 1e3,
            truck.nest_vertical[0],
            truck.nest_vertical[1],
            truck.wedges[0].column_normal
        );
    }
}

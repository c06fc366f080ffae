//! Times and energies of the thesis's cases.
use integrate::{Integrator, Method, Options};
use mechanics::system::ChannelKind;
use std::time::Instant;
use wedge::outputs::Outputs;
use wedge::parameters::Damping;
use wedge::{Wedge, thesis};

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let method = if args.get(1).is_some_and(|m| m == "4") {
        Method::Rodas4
    } else {
        Method::Rodas5P
    };
    let tolerance: f64 = args.get(2).map_or(1e-6, |t| t.parse().unwrap());
    let only = args.get(3);
    let mut total = 0.0;
    for damping in [Damping::Variable, Damping::Constant] {
        for toe in [0.2_f64, 0.0, -0.2] {
            for yaw in [0.0, 0.012] {
                let name = format!("{damping:?} toe {toe} yaw {yaw}");
                if only.is_some_and(|o| !name.contains(o.as_str())) {
                    continue;
                }
                let mut wedge = Wedge::new(thesis::parameters(damping, toe.to_radians(), yaw)).unwrap();
                let outputs = Outputs::new(&wedge.parameters);
                let vertical = outputs
                    .columns()
                    .iter()
                    .position(|c| c.name == "vertical_wedge_force")
                    .unwrap();
                let x = wedge.initial_state.clone();
                let start_energy = wedge.system.observe(0.0, &x).energies.total();
                let loss = wedge
                    .system
                    .channels()
                    .iter()
                    .position(|c| c.kind == ChannelKind::FrictionLoss)
                    .unwrap();
                let offset = 2 * wedge.system.layout().speeds + wedge.system.layout().internals;
                let clock = Instant::now();
                let options = Options {
                    method,
                    relative_tolerance: tolerance,
                    ..Options::default()
                };
                let mut run = Integrator::new(wedge.system.clone(), options, 0.0, &x).unwrap();
                let mut row = 0;
                let mut buffer = x.clone();
                let (mut up, mut down, mut nu, mut nd) = (0.0, 0.0, 0, 0);
                let probes: Vec<f64> = (0..=2)
                    .map(|k| std::f64::consts::PI * (0.5 + f64::from(k)))
                    .collect();
                let mut energy = [0.0; 3];
                let mut values = Vec::new();
                let mut events = 0;
                let mut worst: f64 = 0.0;
                while run.time() < 10.0 {
                    run.step_to(10.0).unwrap();
                    events += run.events().len();
                    for (p, e) in probes.iter().zip(&mut energy) {
                        if *p > run.previous_time() && *p <= run.time() {
                            run.interpolate(*p, &mut buffer);
                            *e = buffer[offset + loss] / 0.112_984_829_027_616_7;
                        }
                    }
                    while f64::from(row) * 0.01 <= run.time() {
                        let t = f64::from(row) * 0.01;
                        run.interpolate(t, &mut buffer);
                        row += 1;
                        values.clear();
                        let seen = wedge.system.observe(t, &buffer);
                        outputs.values(&wedge.system, &seen, run.modes(), start_energy, &mut values);
                        let force = values[vertical] / 4.448_221_615_260_5;
                        worst = worst.max(values.last().unwrap().abs());
                        let (zb, vb) = ((2.0 * t).sin(), (2.0 * t).cos());
                        let counts = t > std::f64::consts::FRAC_PI_2
                            && match damping {
                                Damping::Constant => vb.abs() > 0.9,
                                Damping::Variable => vb.abs() > 0.25 && zb < -0.3,
                            };
                        if counts && vb > 0.0 {
                            up += force;
                            nu += 1;
                        }
                        if counts && vb < 0.0 {
                            down += force;
                            nd += 1;
                        }
                    }
                }
                let wall = clock.elapsed().as_secs_f64();
                total += wall;
                let s = run.statistics();
                let seen = wedge.system.observe(10.0, run.x());
                let ledger = Outputs::ledger(&wedge.system, &seen, start_energy);
                println!(
                    "{name:34} up {:7.1} down {:7.1} energy {:7.1} residual {:9.2e} (worst {:9.2e}) work {:7.1} {:6.1} ms steps {} rej {} {} events {events}",
                    up / f64::from(nu),
                    down / f64::from(nd),
                    (energy[2] - energy[0]) / 2.0,
                    ledger.residual / ledger.motion_work,
                    worst / ledger.motion_work,
                    ledger.motion_work / 0.112_984_829,
                    wall * 1e3,
                    s.steps,
                    s.rejected_error,
                    s.rejected_not_finite,
                );
            }
        }
    }
    println!("total {total:.2} s");
}

//! One wheelset on track: how long steps are, what an evaluation costs, how continuous forces are.
//!
//! `cargo run --release -p rolling --example trial`, and words of the first five columns of its table after
//! `--` for a part of the runs, such as `curve sprung search`.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use integrate::{Integrator, Method, Options, Problem};
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::vector::{Matrix, Vector};
use rolling::carriage::Carriage;
use rolling::rig::{Rig, RigStart, Setup, Wheels};
use rolling::track::RailSupport;
use rolling::wheel::{Search, WheelOnRail};
use rolling::wheelset::WheelsetBody;
use wheelrail::contact::{ContactLaw, ContactTable, CreepLaw, Side};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{
    CenterLine, CurveElements, Direction, Irregularity, Placed, RailLines, Rails, Segment, SpiralForm, Track,
};
use wheelrail::wheelset::{Layout, RigidWheelset};

const INCH: f64 = 0.0254;
const SPEED: f64 = 60.0 / 3.6;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

type Failure = Box<dyn std::error::Error>;

fn wheels() -> Result<RigidWheelset, Failure> {
    let wheel = nominal::aar_1b()?;
    let rail = nominal::rail_136re()?.inclined(nominal::INCLINATION);
    let layout = Layout {
        tape_distance: nominal::TAPE_DISTANCE,
        gauge: 56.5 * INCH,
        gauge_depth: nominal::GAUGE_DEPTH,
    };
    Ok(RigidWheelset::new(
        [&wheel; 2],
        [18.0 * INCH; 2],
        [&rail; 2],
        layout,
        STEEL,
    )?)
}

/// 350 m of straight track with irregularities of a class in alignment and gauge.
fn rough(class: u8) -> Result<Track, Failure> {
    let realization = |spectrum, seed| Realization::new(spectrum, [1.524, 91.44], 1000, 30.0, seed);
    let placed = |rails, irregularity| Placed {
        rails,
        direction: Direction::Lateral,
        irregularity: Irregularity::Spectrum(irregularity),
    };
    Ok(Track {
        center_line: CenterLine::new(&[Segment::Tangent(400.0)], 59.5 * INCH, &[])?,
        irregularities: vec![
            placed(Rails::Both, realization(Spectrum::FraLateral(class), 1)?),
            placed(Rails::Against, realization(Spectrum::FraCrossLevel(class), 2)?),
        ],
    })
}

/// Into a curve of 10 deg to the left, with 4 in of superelevation.
fn curve() -> Result<Track, Failure> {
    let curve = CurveElements::of_degree(10.0_f64.to_radians(), 4.0 * INCH);
    let segments = [
        Segment::Tangent(40.0),
        Segment::Spiral(60.0, SpiralForm::Clothoid),
        Segment::Curve(300.0, curve),
    ];
    Ok(Track {
        center_line: CenterLine::new(&segments, 59.5 * INCH, &[])?,
        irregularities: Vec::new(),
    })
}

fn setup(track: Track, sprung: bool, table: bool) -> Result<Setup, Failure> {
    let rigid = wheels()?;
    let lines = Arc::new(RailLines::new(track, rigid.rail_origins()));
    let search = |index: usize| -> Result<Search, Failure> {
        let pair = rigid.pairs()[index].clone();
        Ok(match table {
            false => Search::Exact(Arc::new(pair)),
            true => Search::Table(Arc::new(ContactTable::new(pair, 1e-4)?)),
        })
    };
    Ok(Setup {
        body: WheelsetBody {
            mass: 1250.0,
            about_axle: 150.0,
            about_diameter: 700.0,
        },
        wheels: Wheels::OnRails {
            search: [search(0)?, search(1)?],
            tape_distance: nominal::TAPE_DISTANCE,
            law: ContactLaw {
                friction: Friction::constant(0.4),
                damping: if sprung { 0.3 } else { 2.0 },
                creep: CreepLaw::Polach(polach::DRY),
                slowest: 0.1,
            },
        },
        carriage: Carriage {
            name: "carriage".to_owned(),
            lines: lines.clone(),
            stiffness: [2e6, 2e6],
            damping: [2e4, 2e3],
            load: 263e3 * 4.448 / 4.0 - 1250.0 * 9.81,
            speed: SPEED,
            drive: 1e4,
        },
        lines,
        support: sprung.then(|| RailSupport::default_support("rail", 9.81)),
        gravity: 9.81,
        heading: 0.0,
    })
}

/// The outcome of a run.
struct Run {
    steps: u64,
    rejected: u64,
    derivatives: u64,
    jacobians: u64,
    seconds: f64,
    longest: f64,
    /// Share of time with two or more patches at a wheel.
    doubles: f64,
    /// Largest lateral place, N at a wheel, flange force.
    largest: [f64; 2],
    /// Residual and the creep loss, work of the geometry, J.
    ledger: [f64; 3],
    end: Vec<f64>,
}

fn run(setup: &Setup, method: Method, tolerance: f64, end: f64) -> Result<Run, Failure> {
    let mut rig = Rig::new(
        setup,
        RigStart {
            distance: 1.0,
            ..RigStart::default()
        },
    )?;
    let stored = rig.system.observe(0.0, &rig.start).energies.total();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::of(method)
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start)?;
    let (mut seconds, mut doubles, mut largest) = (0.0, 0.0, [0.0_f64; 2]);
    while integrator.time() < end {
        let started = Instant::now();
        integrator.step_to(end)?;
        seconds += started.elapsed().as_secs_f64();
        let seen = rig.system.observe(integrator.time(), integrator.x());
        let place = rig.relative(&setup.lines, &seen);
        let (mut counts, mut loads) = ([0; 2], [0.0; 2]);
        rig.patches(&seen, |side, patch| {
            let index = usize::from(side == Side::Right);
            counts[index] += usize::from(patch.forces.normal > 1.0);
            loads[index] += patch.forces.normal * patch.patch.share;
        });
        if counts.iter().any(|count| *count > 1) {
            doubles += integrator.time() - integrator.previous_time();
        }
        largest[0] = largest[0].max(place[1].abs());
        largest[1] = largest[1].max(loads[0].max(loads[1]));
    }
    let seen = rig.system.observe(integrator.time(), integrator.x());
    let terms = rig.system.energy_terms();
    let sum = |what: &str| -> f64 {
        let of = terms.iter().zip(&seen.quadratures);
        of.filter(|(term, _)| term.element.starts_with("wheel") && term.kind.name() == what)
            .map(|(_, value)| value)
            .sum()
    };
    let statistics = integrator.statistics();
    Ok(Run {
        steps: statistics.steps,
        rejected: statistics.rejected(),
        derivatives: statistics.derivatives,
        jacobians: statistics.jacobians,
        longest: statistics.largest_step,
        seconds,
        doubles: doubles / end,
        largest,
        ledger: [seen.residual(stored), sum("element_loss"), sum("element_work")],
        end: integrator.x().to_vec(),
    })
}

fn runs() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "| track | rails | search | method | tolerance | steps | rejected | mean step, ms | longest | f | J \
         | CPU, s | times real time | two patches, % | largest lateral, mm | largest N, kN | ledger: \
         residual, creep and damping loss, geometry's work, J | lateral at the end, mm |"
    );
    println!("|{}", "---|".repeat(18));
    let tracks: Vec<(&str, Track, f64)> = vec![
        ("class 6", rough(6)?, 20.0),
        ("class 4", rough(4)?, 20.0),
        ("curve", curve()?, 15.0),
    ];
    for (name, track, end) in tracks {
        for sprung in [false, true] {
            for table in [false, true] {
                let setup = setup(track.clone(), sprung, table)?;
                for (method, tolerances) in [
                    (Method::Rodas5P, &[1e-4, 1e-5, 1e-6][..]),
                    (Method::TrBdf2, &[1e-4, 1e-5]),
                    (Method::Esdirk3, &[1e-4, 1e-5]),
                ] {
                    for &tolerance in tolerances {
                        let (rails, search) = (
                            if sprung { "sprung" } else { "rigid" },
                            if table { "table" } else { "search" },
                        );
                        let label = format!("| {name} | {rails} | {search} | {method:?} | {tolerance:.0e} ");
                        if !words.iter().all(|word| label.contains(word.as_str())) {
                            continue;
                        }
                        print!("{label}");
                        match run(&setup, method, tolerance, end) {
                            Ok(run) => println!(
                                "| {} | {} | {:.2} | {:.1} | {} | {} | {:.2} | {:.1} | {:.0} | {:.2} | \
                                 {:.1} | {:.1e}, {:.0}, {:.2} | {:.3} |",
                                run.steps,
                                run.rejected,
                                end / run.steps as f64 * 1e3,
                                run.longest * 1e3,
                                run.derivatives,
                                run.jacobians,
                                run.seconds,
                                end / run.seconds,
                                run.doubles * 100.0,
                                run.largest[0] * 1e3,
                                run.largest[1] * 1e-3,
                                run.ledger[0],
                                run.ledger[1],
                                run.ledger[2],
                                run.end[0] * 1e3,
                            ),
                            Err(error) => println!("| {error} |"),
                        }
                    }
                }
            }
        }
    }
    Ok(())
}

/// Returns the shortest time of a call, s: the best of 50 batches, since the machine may be shared.
fn best(mut call: impl FnMut(u32)) -> f64 {
    let batch = 200;
    let mut shortest = f64::INFINITY;
    for number in 0..50 {
        let started = Instant::now();
        for k in 0..batch {
            call(number * batch + k);
        }
        shortest = shortest.min(started.elapsed().as_secs_f64() / f64::from(batch));
    }
    shortest
}

/// Prints the cost of an evaluation, by the search and by tables.
fn costs() -> Result<(), Failure> {
    for table in [false, true] {
        let setup = setup(rough(6)?, false, table)?;
        let mut rig = Rig::new(
            &setup,
            RigStart {
                distance: 200.0,
                ..RigStart::default()
            },
        )?;
        let (x, mut dx) = (rig.start.clone(), rig.start.clone());
        let mut unused = vec![0.0; x.len()];
        let mut moved = x.clone();
        let rates = best(|k| {
            moved[0] = x[0] + 1e-9 * f64::from(k);
            rig.system.derivative(0.0, &moved, &mut dx);
        });
        let matrix = best(|k| {
            moved[0] = x[0] + 1e-9 * f64::from(k);
            rig.system.linearize(0.0, &moved, &dx, &mut unused);
        });
        let section = best(|k| {
            let point = [200.0, 0.7 + 1e-9 * f64::from(k), 0.45];
            black_box(setup.lines.section(wheelrail::track::Line::Left, point));
        });
        println!(
            "{}: right-hand side {:.1} us (two wheels, carriage), matrix {:.1} us, section of a rail {:.2} \
             us",
            if table { "table" } else { "search" },
            rates * 1e6,
            matrix * 1e6,
            section * 1e6
        );
    }
    Ok(())
}

/// Forces over the lateral place at a fixed height: jumps where patches appear and merge.
fn continuity() -> Result<(), Failure> {
    let setup = setup(rough(6)?, false, false)?;
    let Wheels::OnRails { search, law, .. } = &setup.wheels else {
        return Ok(());
    };
    let lines = {
        let line = CenterLine::new(&[Segment::Tangent(10.0)], 59.5 * INCH, &[])?;
        let track = Track {
            center_line: line,
            irregularities: Vec::new(),
        };
        Arc::new(RailLines::new(track, wheels()?.rail_origins()))
    };
    let wheel = WheelOnRail {
        name: String::new(),
        lines,
        side: Side::Left,
        search: search[0].clone(),
        law: law.clone(),
        roll: None,
    };
    let at = |lateral: f64| {
        let motion = RelativeMotion {
            position: Vector([5.0, 0.5 * nominal::TAPE_DISTANCE + lateral, 18.0 * INCH + 2e-4]),
            rotation: Matrix::identity(),
            velocity: Vector([SPEED, 0.01, 0.0]),
            angular_velocity: Vector([0.0, SPEED / (18.0 * INCH), 0.0]),
        };
        let mut count = 0;
        wheel.patches(&motion, [0.0; 2], |patch| {
            count += usize::from(patch.patch.share > 0.0)
        });
        (wheel.evaluate(&motion), count)
    };
    println!(
        "changes of force between places h apart, from the tread over two patches to the flange (0 to 11.8 \
         mm):"
    );
    println!("| h, um | largest change of Fx, Fy, Fz, N | at, mm | patches there |");
    println!("|---|---|---|---|");
    for step in [1e-5, 1e-6, 1e-7] {
        let count = (11.8e-3 / step) as usize;
        let mut largest = ([0.0_f64; 3], 0.0, 0);
        let mut before = at(0.0).0.force.0;
        for k in 1..=count {
            let place = k as f64 * step;
            let (wrench, patches) = at(place);
            let own = wrench.force.0;
            for i in 0..3 {
                let change = (own[i] - before[i]).abs();
                if change > largest.0[i] {
                    largest.0[i] = change;
                    if i == 1 {
                        (largest.1, largest.2) = (place, patches);
                    }
                }
            }
            before = own;
        }
        let [x, y, z] = largest.0;
        println!(
            "| {:.1} | {x:.2}, {y:.2}, {z:.2} | {:.3} | {} |",
            step * 1e6,
            largest.1 * 1e3,
            largest.2
        );
    }
    Ok(())
}

fn main() -> Result<(), Failure> {
    costs()?;
    continuity()?;
    runs()
}

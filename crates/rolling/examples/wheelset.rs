//! A wheelset on springs: Klingel's motion of cones, and hunting of nominal 1B wheels on 136RE below and
//! above its critical speed. CSV goes to the standard output, what came of it to the other one.
//!
//! `cargo run --release -p rolling --example wheelset > wheelset.csv`

use std::f64::consts::TAU;
use std::io::Write;
use std::sync::Arc;

use integrate::{Integrator, Options};
use rolling::carriage::Carriage;
use rolling::rig::{Rig, RigStart, Setup, Wheels};
use rolling::wheel::Search;
use rolling::wheelset::WheelsetBody;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;
use wheelrail::track::{CenterLine, RailLines, Segment, Track};
use wheelrail::wheelset::{Layout, RigidWheelset};

const INCH: f64 = 0.0254;
const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};

type Failure = Box<dyn std::error::Error>;

/// Cones of 1:20 on crowns of 254 mm, or nominal 1B wheels on 136RE; the distance of their tape circles.
fn wheels(cones: bool) -> Result<(RigidWheelset, f64), Failure> {
    let (wheel, rail, tape_distance, gauge, gauge_depth);
    if cones {
        (wheel, rail) = (nominal::cone(0.05, 0.05)?, nominal::cylinder(0.254, 0.035)?);
        (tape_distance, gauge_depth) = (1.5, 0.001);
        gauge = 1.5 + 2.0 * rail.gauge_point(gauge_depth);
    } else {
        (wheel, rail) = (
            nominal::aar_1b()?,
            nominal::rail_136re()?.inclined(nominal::INCLINATION),
        );
        tape_distance = nominal::TAPE_DISTANCE;
        (gauge, gauge_depth) = (56.5 * INCH, nominal::GAUGE_DEPTH);
    }
    let layout = Layout {
        tape_distance,
        gauge,
        gauge_depth,
    };
    let rigid = RigidWheelset::new([&wheel; 2], [18.0 * INCH; 2], [&rail; 2], layout, STEEL)?;
    Ok((rigid, tape_distance))
}

/// Straight track, springs (N/m, N·m/rad), load (N), speed (m/s).
fn setup(
    (rigid, tape_distance): &(RigidWheelset, f64),
    stiffness: [f64; 2],
    load: f64,
    speed: f64,
) -> Result<Setup, Failure> {
    let track = Track {
        center_line: CenterLine::new(&[Segment::Tangent(1000.0)], 59.5 * INCH, &[])?,
        irregularities: Vec::new(),
    };
    let lines = Arc::new(RailLines::new(track, rigid.rail_origins()));
    Ok(Setup {
        body: WheelsetBody {
            mass: 1250.0,
            about_axle: 150.0,
            about_diameter: 700.0,
        },
        wheels: Wheels::OnRails {
            search: [0, 1].map(|i| Search::Exact(Arc::new(rigid.pairs()[i].clone()))),
            tape_distance: *tape_distance,
            law: ContactLaw {
                friction: Friction::constant(0.4),
                damping: 2.0,
                creep: CreepLaw::Polach(polach::DRY),
                slowest: 0.1,
            },
        },
        carriage: Carriage {
            name: "carriage".to_owned(),
            lines: lines.clone(),
            stiffness,
            damping: [0.0; 2],
            load,
            speed,
            drive: 1e4,
        },
        lines,
        support: None,
        gravity: 9.81,
        heading: 0.0,
    })
}

/// Returns the fastest growing vibration between two frequencies (rad/s): growth and frequency, 1/s.
fn least_damped(setup: &Setup, range: [f64; 2]) -> Result<[f64; 2], Failure> {
    let mut rig = Rig::new(
        setup,
        RigStart {
            distance: 500.0,
            ..RigStart::default()
        },
    )?;
    let found = rig.system.eigenvalues(0.0, &rig.start.clone(), 20.0)?;
    let inside = |value: &&[f64; 2]| value[1] > range[0] && value[1] < range[1];
    Ok(*found.iter().find(inside).ok_or("no vibration in the range")?)
}

/// Runs to a time (s) and writes rows; returns the largest lateral excursion in the last fifth, m, and the
/// places where the wheelset crosses the middle, m.
fn run(
    out: &mut impl Write,
    name: &str,
    setup: &Setup,
    lateral: f64,
    end: f64,
) -> Result<(f64, Vec<f64>), Failure> {
    let start = RigStart {
        distance: 1.0,
        lateral,
        yaw: 0.0,
    };
    let mut rig = Rig::new(setup, start)?;
    let options = Options {
        relative_tolerance: 1e-5,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start)?;
    let (rows, mut largest, mut crossings, mut before) = (1000, 0.0_f64, Vec::new(), [0.0; 2]);
    let mut x = rig.start.clone();
    for row in 0..=rows {
        let time = end * f64::from(row) / f64::from(rows);
        while integrator.time() < time {
            integrator.step_to(end)?;
        }
        integrator.interpolate(time, &mut x);
        let seen = rig.system.observe(time, &x);
        let [distance, lateral, _, yaw, _] = rig.relative(&setup.lines, &seen);
        let (mut forces, mut patches) = ([[0.0; 2]; 2], [0; 2]);
        rig.patches(&seen, |side, patch| {
            let index = usize::from(side == Side::Right);
            let share = patch.patch.share;
            forces[index][0] += patch.forces.normal * share;
            forces[index][1] += patch.forces.creep.y * share;
            patches[index] += 1;
        });
        let [[left, left_creep], [right, right_creep]] = forces;
        writeln!(
            out,
            "{name},{time:.4},{distance:.3},{:.4},{:.4},{:.2},{:.2},{:.2},{:.2},{},{}",
            lateral * 1e3,
            yaw * 1e3,
            left * 1e-3,
            right * 1e-3,
            left_creep * 1e-3,
            right_creep * 1e-3,
            patches[0],
            patches[1]
        )?;
        if time > 0.8 * end {
            largest = largest.max(lateral.abs());
        }
        if before[1] * lateral < 0.0 {
            crossings.push(before[0] + (distance - before[0]) * before[1] / (before[1] - lateral));
        }
        before = [distance, lateral];
    }
    Ok((largest, crossings))
}

fn main() -> Result<(), Failure> {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    writeln!(
        out,
        "run,time_s,distance_m,lateral_mm,yaw_mrad,normal_left_kN,normal_right_kN,creep_left_kN,\
         creep_right_kN,patches_left,patches_right"
    )?;
    let cones = wheels(true)?;
    let klingel = LinearGeometry::of(&cones.0, 1e-3)?.klingel_wavelength();
    let free = setup(&cones, [0.0; 2], 100e3, 5.0)?;
    let (_, crossings) = run(&mut out, "klingel", &free, 1e-3, 20.0)?;
    let found = crossings[3] - crossings[1];
    eprintln!("cones of 1:20 at 5 m/s: wavelength {found:.3} m, Klingel's {klingel:.3} m");

    let freight = wheels(false)?;
    let springs = [2.5e5, 2.5e6];
    let at = |speed: f64| setup(&freight, springs, 60e3, speed);
    let growth = |speed: f64| least_damped(&at(speed)?, [5.0, 300.0]);
    let (mut low, mut high) = (10.0, 400.0);
    while high - low > 1e-3 {
        let middle = 0.5 * (low + high);
        *(if growth(middle)?[0] < 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    let critical = 0.5 * (low + high);
    eprintln!(
        "1B on 136RE under springs: critical speed {critical:.2} m/s, {:.2} Hz",
        growth(critical)?[1] / TAU
    );
    for (name, factor) in [("stable", 0.9), ("hunting", 1.1)] {
        let (largest, _) = run(&mut out, name, &at(factor * critical)?, 1e-3, 10.0)?;
        eprintln!(
            "{name}, {:.2} m/s: lateral excursion at the end {:.3} mm from 1 mm",
            factor * critical,
            largest * 1e3
        );
    }
    Ok(())
}

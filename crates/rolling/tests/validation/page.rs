//! The page docs/validation-rolling.md: every number computed here, beside its source's.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::thread;

use integrate::{Integrator, Options};
use rolling::rig::{Rig, RigStart};
use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::track::shape::Shape;
use wheelrail::track::{CurveElements, Direction, Irregularity, Placed, Rails, Segment};

#[path = "../common/mod.rs"]
mod common;

use common::impact::{LOAD, closed_forms, joint, meeting};
use common::not_round::{first_peaks, separation_speed};
use common::suspended::{SUSPENDED, critical_speed, growth_by_steps, hunting};
use common::{
    POLACH, after, bogie, coned_wheelset, freight, linear, manchester, nonlinear as limits, on_rails, track,
};

const HEAD: &str = "\
# Validation: wheelsets on track

Each number of the crate `rolling`, through its elements on the multibody core, beside its source's. This \
page is written
by `cargo run --release -p rolling --example wheelset_validation`, and a test computes it anew and compares; \
the tests of the crate
hold the same numbers to the limits that are stated here. Contact and creep alone: [wheel and
rail](validation-wheelrail.md).
";

/// Returns the page.
pub fn page() -> String {
    let parts = [
        suspended,
        cooperrider,
        manchester,
        nonlinear,
        klingel,
        bump,
        circle,
        impact,
    ];
    // On as many threads: together they take as long as all of the crate's other tests.
    let parts = thread::scope(|scope| {
        let running = parts.map(|part| {
            scope.spawn(move || {
                let mut own = String::from("\n");
                part(&mut own);
                own
            })
        });
        running.map(|part| part.join().unwrap())
    });
    HEAD.to_owned() + &parts.concat()
}

fn percent(found: f64, source: f64) -> String {
    format!("{:+.3} %", 100.0 * (found / source - 1.0))
}

fn suspended(out: &mut String) {
    *out += "## A wheelset on lateral and yaw springs\n\n\
             Critical speeds with linear geometry and creep. The closed form, with c1 = 2 f22, c2 = 2 f11 \
             l², X = 4 f11 f22 λ l / r:\n\
             ω² = (c1 kψ + c2 ky) / (c1 I + c2 m), V² = c1 c2 ω² / (X + (ky - m ω²)(kψ - I ω²)). By \
             linearization to lie within 0.01 %,\n\
             by time steps (where the growth of runs 1 % below and above is zero) within 1 %.\n\n\
             | wheelset | by | critical speed here, m/s | closed form |  | frequency here, Hz | closed \
             form |\n|---|---|---|---|---|---|---|\n";
    for (number, (suspension, creep, geometry, [critical, frequency])) in SUSPENDED.into_iter().enumerate() {
        let [found, hertz] = critical_speed(&(suspension, creep, geometry));
        let growth = [0.99, 1.01].map(|factor| {
            growth_by_steps(&linear(suspension, creep, geometry, critical * factor), frequency)
        });
        let share = -growth[0] / (growth[1] - growth[0]);
        let stepped = critical * (0.99 + 0.02 * share);
        let number = number + 1;
        let _ = writeln!(
            out,
            "| {number} | linearization | {found:.4} | {critical} | {} | {hertz:.5} | {frequency} |",
            percent(found, critical)
        );
        let _ = writeln!(
            out,
            "| {number} | time steps | {stepped:.2} | {critical} | {:+.2} % |  |  |",
            100.0 * (stepped / critical - 1.0)
        );
    }
}

fn cooperrider(out: &mut String) {
    let [found, frequency] = bogie::critical();
    let _ = write!(
        out,
        "## Cooperrider's bogie\n\n\
         Seven degrees of freedom on linear wheels, parameters of Kaas-Petersen's form (from memory, \
         confirmed by the number). The\n\
         published bifurcation (Hassard) is at 68.66 m/s; the eigenvalue problem of the model by itself \
         gives 68.644 m/s and 3.998 Hz.\n\n|  | here | by itself |  | published |\n|---|---|---|---|---|\n\
         | critical speed, m/s | {found:.3} | 68.644 | {} | 68.66 |\n\
         | frequency, Hz | {frequency:.3} | 3.998 | {} |  |\n",
        percent(found, 68.644),
        percent(frequency, 3.998)
    );
}

/// Returns whether two numbers agree within a share, below which their difference is that of rounding.
fn within(found: f64, source: f64, share: f64) -> String {
    match (found / source - 1.0).abs() < share {
        true => format!("below {} %", 100.0 * share),
        false => "MORE".to_owned(),
    }
}

fn manchester(out: &mut String) {
    *out += "## Manchester vehicle 1\n\n\
             Vehicle 1 of the Manchester benchmarks (Iwnicki 1998) as data on the same core: body, two \
             bogies, four wheelsets, linear springs and\ndampers, no wedges. Masses, springs and dampers are \
             published; heights of the centers of gravity (body 1.8 m, bogies 0.6 m), lateral\nplaces of the \
             springs (1 m) and the height of the secondary ones (0.83 m) are guesses. Each spring acts at \
             one height, without\npreload; bump stops and rods are left out. Beside it mass, damping and \
             stiffness matrices by themselves, from the extensions of\nthe springs.\n\n\
             Natural frequencies on wheelsets that are held, to lie within 0.001 %:\n\n\
             | what moves most | here, Hz | by itself |  |\n|---|---|---|---|\n";
    for own in manchester::natural() {
        let _ = writeln!(
            out,
            "| {} | {:.4} | {:.4} | {} |",
            own.name,
            own.found,
            own.expected,
            within(own.found, own.expected, 1e-5)
        );
    }
    let _ = write!(
        out,
        "\nThe closed form of two masses has the body's bounce at {:.4} Hz. Critical speeds on linear wheels \
         (f11 = 10 MN, f22 = 9 MN a wheel,\nguesses), to lie within 0.01 %:\n\n\
         | conicity | here, m/s | by itself |  | here, Hz | by itself |\n|---|---|---|---|---|---|\n",
        manchester::bounce()
    );
    for conicity in [0.2, 0.3, 0.4] {
        let [[found, hertz], [expected, other]] = manchester::critical(conicity);
        let _ = writeln!(
            out,
            "| {conicity} | {found:.2} | {expected:.2} | {} | {hertz:.3} | {other:.3} |",
            within(found, expected, 1e-4)
        );
    }
}

fn nonlinear(out: &mut String) {
    let critical = limits::critical();
    let [speed, turning] = critical;
    let stepped = limits::by_steps(critical);
    let _ = write!(
        out,
        "## Hunting between flanges\n\n\
         A wheelset with 58 kN on lateral and yaw springs (150 kN/m, 800 kN m/rad), nominal AAR-1B on 136RE, \
         Polach's creep: linear critical\nspeed {speed:.2} m/s ({:.3} Hz). Runs from 0.1 mm neither grow nor \
         die at {stepped:.1} m/s ({:+.1} %, to lie within 1 %). What is left after 8 s:\n\n\
         | speed / critical speed | start, mm | amplitude, mm |\n|---|---|---|\n",
        turning / TAU,
        100.0 * (stepped / speed - 1.0)
    );
    for (factor, start) in [(0.9, 0.5), (0.9, 9.0), (1.1, 0.5)] {
        let found = 1e3 * limits::amplitude(factor * speed, 1e-3 * start, 8.0);
        let outcome = if found < 0.5 {
            "below 0.5".to_owned()
        } else {
            format!("{found:.1}")
        };
        let _ = writeln!(out, "| {factor} | {start} | {outcome} |");
    }
    *out += "\nThe flanges have a clearance of 10.3 mm: above the critical speed the motion grows up to \
             them; at nine tenths of it dies even\nfrom there.\n";
}

fn klingel(out: &mut String) {
    *out += "## Klingel's wavelength through patches\n\n\
             Coned wheels with contact patches on round crowns, 2 m/s, no springs. The wavelength by \
             linearization against\n2π √(r l / λ) with l and λ of the rigid wheelset; to lie within 1 %.\n\
             \n| cone | crown, mm | wavelength here, m | Klingel, m |  |\n|---|---|---|---|---|\n";
    for (word, slope, crown) in [
        ("1:40", 0.025, 0.3),
        ("1:20", 0.05, 0.3),
        ("1:10", 0.1, 0.3),
        ("1:20", 0.05, 0.05),
    ] {
        let (setup, klingel) = coned_wheelset(slope, crown);
        let speed = setup.carriage.speed;
        let [_, frequency] = hunting(&setup, [0.1, 10.0], 1.0);
        let found = TAU * speed / frequency;
        let _ = writeln!(
            out,
            "| {word} | {:.0} | {found:.3} | {klingel:.3} | {} |",
            1e3 * crown,
            percent(found, klingel)
        );
    }
}

fn bump(out: &mut String) {
    let law = ContactLaw {
        creep: CreepLaw::Frictionless,
        damping: 0.0,
        ..POLACH
    };
    let dip = vec![Placed {
        rails: Rails::Both,
        direction: Direction::Vertical,
        irregularity: Irregularity::Shape(Shape::Dip {
            depth: 0.01,
            length: 3.0,
            start: 4.0,
        }),
    }];
    let mut setup = on_rails(&freight(), track(&[Segment::Tangent(60.0)], dip), law, 5.0);
    setup.carriage.stiffness = [0.0; 2];
    setup.carriage.damping = [0.0; 2];
    setup.carriage.load = 0.0;
    setup.carriage.drive = 0.0;
    let start = RigStart {
        distance: 1.0,
        ..RigStart::default()
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let stored = rig.system.observe(0.0, &rig.start).energies.total();
    let options = Options {
        relative_tolerance: 1e-7,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    let (mut lowest, mut change) = (0.0_f64, 0.0);
    let height = rig.system.observe(0.0, &rig.start).bodies[1].origin.0[2];
    while integrator.time() < 2.0 {
        integrator.step_to(2.0).unwrap();
        let seen = rig.system.observe(integrator.time(), integrator.x());
        lowest = lowest.min(seen.bodies[1].origin.0[2] - height);
        change = seen.energies.total() - stored;
    }
    let exchanged = -lowest * setup.body.mass * setup.gravity;
    let _ = write!(
        out,
        "## A frictionless mass over a bump\n\n\
         A wheelset of 1250 kg without friction runs at 5 m/s through a dip of 10 mm over 3 m. The rail \
         is at rest, so that\n\
         nothing may be put in: its energy after the dip is to be that before within 1e-5 of what was \
         exchanged.\n\n| sinks by, mm | energy exchanged, J | change of energy after the dip, at most |\n\
         |---|---|---|\n| {:.1} | {exchanged:.0} | {} |\n",
        -1e3 * lowest,
        if change.abs() < 1e-5 * exchanged {
            "1e-5 of that"
        } else {
            "MORE"
        }
    );
}

/// Normal forces and lateral creep forces of both wheels after a time, N.
fn forces(heading: f64, time: f64) -> [f64; 4] {
    let curve = CurveElements::of_degree(10.0_f64.to_radians(), 0.0);
    let circle = track(&[Segment::Curve(TAU / curve.curvature, curve)], Vec::new());
    let mut setup = on_rails(&freight(), circle, POLACH, 60.0 / 3.6);
    setup.carriage.stiffness = [2e6, 2e7];
    setup.heading = heading;
    let start = RigStart {
        distance: 1.0,
        ..RigStart::default()
    };
    let (mut rig, x) = after(&setup, start, 1e-4, time);
    let seen = rig.system.observe(time, &x);
    let mut found = [0.0; 4];
    rig.patches(&seen, |side, patch| {
        let index = usize::from(side == Side::Right);
        found[index] += patch.forces.normal * patch.patch.share;
        found[2 + index] += patch.forces.creep.y * patch.patch.share;
    });
    found
}

fn circle(out: &mut String) {
    *out += "## A circle from any heading\n\n\
             Steady curving at 60 km/h in a curve of 10 deg, half a lap and more after the start; the \
             fixed axes turned by the\nheading. Forces are to be the same within 1e-6 of the wheel load.\n\
             \n| heading, rad | after, s | normal forces left, right, kN | creep forces across, left, \
             right, kN | largest difference |\n|---|---|---|---|---|\n";
    let first = forces(0.0, 20.0);
    for (heading, time) in [(0.0, 20.0), (0.5 * PI, 40.0), (PI, 55.0), (3.9, 30.0)] {
        let found = forces(heading, time);
        let largest = (0..4).fold(0.0, |most: f64, i| most.max((found[i] - first[i]).abs()));
        let kilo = found.map(|force| format!("{:.3}", 1e-3 * force));
        let [left, right, across, other] = kilo;
        let _ = writeln!(
            out,
            "| {heading:.3} | {time} | {left}, {right} | {across}, {other} | {} |",
            if largest < 1e-6 * first[0] {
                "below 1e-6"
            } else {
                "MORE"
            }
        );
    }
}

fn impact(out: &mut String) {
    let velocity = 0.01;
    let [found, masses, closed] = meeting(velocity);
    *out += "## Impact at a dipped joint: P1 and P2\n\n\
             1250 kg unsprung and 125 kN a wheel; track 345 kg, 80 MN/m, 140 kN·s/m a rail. A wheel meets \
             its rail at 2αv: both\n\
             peaks of its load above the static one, per velocity; by two masses on Hertz's spring \
             (integrated by themselves), and the\n\
             closed forms of Jenkins and others (1974; from memory). P1 without damping of the contact, \
             P2 with 6 s/m, so that the\n\
             contact's vibration is over. To lie within 2 % of the two masses and 15 % of the closed \
             forms.\n\n|  | here, kN s/m | two masses |  | closed form |  |\n|---|---|---|---|---|---|\n";
    for (number, name) in ["P1", "P2"].into_iter().enumerate() {
        let of = |own: [f64; 2]| 1e-3 * own[number] / velocity;
        let _ = writeln!(
            out,
            "| {name} | {:.1} | {:.1} | {:+.1} % | {:.1} | {:+.1} % |",
            of(found),
            of(masses),
            100.0 * (found[number] / masses[number] - 1.0),
            of(closed),
            100.0 * (found[number] / closed[number] - 1.0)
        );
    }
    let (angle, speed) = (1e-3, 40.0);
    let [_, second] = closed_forms(2.0 * angle * speed, 1.0);
    let [_, example] = closed_forms(0.02 * 26.8, 1.0);
    let joint = joint(angle, speed);
    let _ = write!(
        out,
        "\nThe closed form's own example (2α = 0.02, 26.8 m/s) gives {:.1} kN, in the source 228.9 kN. A \
         joint of a track, 2α = 0.002 at\n\
         40 m/s: P2 is {:.1} kN above the static load, the closed form {:.1} kN ({:+.1} %). Rails are \
         kept at points 1/8 m apart, which\n\
         round a joint over that length: P1, which a wheel passes within a few centimeters, needs a \
         sharper one and is not shown there.\n",
        1e-3 * (LOAD + example),
        1e-3 * joint,
        1e-3 * second,
        100.0 * (joint / second - 1.0)
    );
    flats(out);
}

fn flats(out: &mut String) {
    let _ = write!(
        out,
        "\n## Impact under a flat: P1\n\n\
         The same wheel and track, a fresh flat (a chord) on both wheels, no damping of the contacts: \
         the largest load above the static\n\
         one, by the elements and by two masses on Hertz's spring that ride the same chord. The closed \
         form is P1 of a joint at the velocity\n\
         at which the wheel meets its rail, `V l / R`, and above the critical speed \
         `V_c = √(R P0 (1/m_u + 1/m_t))`, {:.1} m/s here, at which\n\
         the wheel no longer follows its flat, `V_c l / R` at any speed. It leaves out that Hertz's \
         spring stiffens (low for large\n\
         peaks), that the spring bridges flats that are not much deeper than its 0.15 mm, and that the \
         rail loses force as it comes up:\n\
         for shallow flats and above the critical speed it is a bound. To lie within 3 % of the two \
         masses.\n\n\
         | flat | speed | here | two masses |  | closed form |\n|---|---|---|---|---|---|\n",
        separation_speed()
    );
    for (length, speed) in [
        (0.02, 5.0),
        (0.02, 10.0),
        (0.05, 5.0),
        (0.05, 10.0),
        (0.05, 20.0),
        (0.05, 30.0),
    ] {
        let [found, masses, closed] = first_peaks(length, speed);
        let _ = writeln!(
            out,
            "| {:.0} mm | {speed:.0} m/s | {:.1} kN | {:.1} kN | {:+.1} % | {:.1} kN |",
            1e3 * length,
            1e-3 * found,
            1e-3 * masses,
            100.0 * (found / masses - 1.0),
            1e-3 * closed
        );
    }
}

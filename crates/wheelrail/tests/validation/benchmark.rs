//! The Manchester contact benchmark on the validation page.

use std::fmt::Write as _;

use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::loaded::Attitude;
use wheelrail::profile::{Profile, ProfileKind};
use wheelrail::wheelset::{Layout, RigidWheelset};

use super::{POISSON, SHEAR, data, line, row, table};

/// The part about the benchmark.
pub fn manchester(out: &mut String) {
    line(out, "## Manchester contact benchmark, case A-2.2\n");
    line(
        out,
        "Wheels S1002 on rails UIC60, 10 kN each at 2 m/s, yaw of 2.4 mrad a mm; FASTSIM 50 × 50. CONTACT's \
         results",
    );
    line(
        out,
        "(`mbench_a22_left`, `mbench_a22_right`, revision 2707) second; its frame: y to the right, forces \
         on the rail. Up",
    );
    line(
        out,
        "to 4 mm places are to lie within 1 mm, N within 1 %, creep forces within 10 % of their size (at 0 \
         mm of the limit of",
    );
    line(
        out,
        "friction). Places are means weighted with N; at 5 mm CONTACT's single place is the deeper one of \
         two here.\n",
    );
    table(
        out,
        &[
            "shift, mm",
            "wheel",
            "y, mm",
            "",
            "N, N",
            "",
            "Fx, N",
            "",
            "Fy, N",
            "",
            "creep force differs by",
        ],
    );
    let folder = data("manchester");
    let profile = |file: &str, kind| Profile::read(&folder.join(file), kind, 0.0);
    let (Ok(wheel), Ok(rail)) = (
        profile("MBench_S1002_v3.prw", ProfileKind::Wheel),
        profile("MBench_UIC60_v3.prr", ProfileKind::Rail),
    ) else {
        return;
    };
    let steel = Material {
        youngs_modulus: 2.0 * SHEAR * (1.0 + POISSON),
        poisson: POISSON,
    };
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.435,
        gauge_depth: 0.014,
    };
    let Ok(wheelset) = RigidWheelset::new([&wheel; 2], [0.46; 2], [&rail; 2], layout, steel) else {
        return;
    };
    let law = ContactLaw {
        friction: Friction::constant(0.3),
        damping: 0.0,
        creep: CreepLaw::Fastsim(StripGrid {
            cells: 50,
            strips: 50,
        }),
        slowest: 0.0,
    };
    let (mut place, mut normal, mut creep) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (shift, roll, pitch_rate, left, right) in [
        (
            0.0,
            0.0,
            -4.348_118_1,
            [-751.87, 9997.0, 0.28, 253.6],
            [751.87, 9997.0, 0.28, -253.6],
        ),
        (
            1.0,
            -5.049e-5,
            -4.346_575_2,
            [-755.24, 10050.0, 829.0, -2893.0],
            [741.99, 9827.0, -814.0, -2832.0],
        ),
        (
            2.0,
            -1.128e-4,
            -4.345_919_7,
            [-756.51, 10040.0, 546.0, -2961.0],
            [740.91, 9799.0, -517.0, -2893.0],
        ),
        (
            4.0,
            -2.557e-4,
            -4.344_093,
            [-757.66, 10030.0, 437.0, -2977.0],
            [738.74, 9745.0, -380.0, -2898.0],
        ),
        (
            5.0,
            -3.554e-4,
            -4.335_363_7,
            [-757.90, 10030.0, 838.0, -2889.0],
            [727.09, 9619.0, -763.0, -2738.0],
        ),
        (
            6.0,
            -6.272e-4,
            -4.329_371_8,
            [-758.02, 10020.0, 973.0, -2845.0],
            [725.14, 9709.0, -880.0, -2775.0],
        ),
        (
            7.0,
            -6.393e-3,
            -4.263_562_9,
            [-758.61, 10010.0, 2327.0, -1900.0],
            [719.04, 14030.0, -2079.0, -3644.0],
        ),
        (
            10.0,
            -1.126_431e-2,
            -4.243_637_5,
            [-757.10, 10020.0, 2196.0, -2054.0],
            [721.09, 11440.0, -1947.0, -2820.0],
        ),
    ] {
        let attitude = Attitude {
            lateral: 1e-3 * shift,
            yaw: 2.4e-3 * shift,
            roll,
            speed: 2.0,
            pitch_rate,
        };
        for (side, name, source) in [(Side::Left, "left", left), (Side::Right, "right", right)] {
            let Ok(found) = wheelset.loaded(side, &attitude, 10e3, &law) else {
                line(out, &format!("no height carries the {name} wheel at {shift} mm"));
                continue;
            };
            let sum = |of: &dyn Fn(&wheelrail::loaded::LoadedPatch) -> f64| {
                found.patches.iter().map(of).sum::<f64>()
            };
            let force = sum(&|patch| patch.normal);
            let y = 1e3 * sum(&|patch| patch.normal * patch.y) / force;
            let (fx, fy) = (sum(&|patch| patch.fx), sum(&|patch| patch.fy));
            let scale = match shift {
                0.0 => 0.3 * source[1],
                _ => f64::hypot(source[2], source[3]),
            };
            let difference = f64::hypot(fx - source[2], fy - source[3]) / scale;
            if shift <= 4.0 {
                place = place.max((y - source[0]).abs());
                normal = normal.max((force / source[1] - 1.0).abs());
                creep = creep.max(difference);
            }
            let mut cells = vec![format!("{shift}"), name.to_owned()];
            for (found, source, digits) in [
                (y, source[0], 2),
                (force, source[1], 0),
                (fx, source[2], 0),
                (fy, source[3], 0),
            ] {
                cells.extend([format!("{found:.digits$}"), format!("{source:.digits$}")]);
            }
            cells.push(format!("{:.1} %", 100.0 * difference));
            row(out, &cells);
        }
    }
    let _ = writeln!(
        out,
        "\nUp to 4 mm the largest differences are {place:.2} mm, {:.2} % of N and {:.1} % of the creep \
         forces.",
        100.0 * normal,
        100.0 * creep
    );
}

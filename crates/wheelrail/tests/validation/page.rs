//! The page docs/validation-wheelrail.md: every number computed here, beside its source's.

use std::path::{Path, PathBuf};

use wheelrail::conicity::RollingRadiusDifference;
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::creep::{Coefficients, Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins};
use wheelrail::hertz::{EllipseShape, Hertz, Material};
use wheelrail::profile::nominal;
use wheelrail::wheelset::{Layout, RigidWheelset};

#[path = "benchmark.rs"]
mod benchmark;
#[path = "en15302.rs"]
mod en15302;
#[path = "worn.rs"]
mod worn;

const SHEAR: f64 = 82e9;
const POISSON: f64 = 0.28;

const HEAD: &str = "\
# Validation: wheel and rail

Each number of the crate `wheelrail` beside its source's. This page is written by `cargo run --release -p \
wheelrail
--example validation`, and a test computes it anew and compares; the tests of the crate hold the same \
numbers to the
limits that are stated here. [Theory](wheelrail-theory.md) has the equations.
";

/// Returns the page.
pub fn page() -> String {
    let mut out = HEAD.to_owned();
    for part in [
        hertz,
        kalker,
        fastsim_limit,
        traction,
        spin,
        benchmark::manchester,
        worn::worn,
        conicity,
        en15302::en15302,
    ] {
        out.push('\n');
        part(&mut out);
    }
    out
}

fn line(out: &mut String, text: &str) {
    out.push_str(text);
    out.push('\n');
}

/// A row of a table.
fn row(out: &mut String, cells: &[String]) {
    line(out, &format!("| {} |", cells.join(" | ")));
}

fn table(out: &mut String, head: &[&str]) {
    let cells: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    row(out, &cells);
    line(out, &format!("|{}", "---|".repeat(head.len())));
}

fn data(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(folder)
}

fn hertz(out: &mut String) {
    line(out, "## Hertz's contact\n");
    line(
        out,
        "A 36 in wheel on a crown of 10 in, 160 kN, 207 GPa, ν = 0.27; the source is another program with \
         exact",
    );
    line(out, "elliptic integrals.\n");
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let Ok(hertz) = Hertz::new(steel, 1.0 / 0.4572, 1.0 / 0.254) else {
        return;
    };
    let [a, b] = hertz.semi_axes(160e3);
    table(out, &["", "here", "source"]);
    for (what, found, source) in [
        ("semi-axis along, mm", format!("{:.3}", 1e3 * a), "8.660"),
        ("semi-axis across, mm", format!("{:.3}", 1e3 * b), "5.856"),
        (
            "greatest pressure, MPa",
            format!("{:.0}", 1e-6 * hertz.greatest_pressure(160e3)),
            "1506",
        ),
        (
            "approach, mm",
            format!("{:.4}", 1e3 * hertz.approach(160e3)),
            "0.1495",
        ),
    ] {
        row(out, &[what.to_owned(), found, source.to_owned()]);
    }
    line(
        out,
        "\nSemi-axes m, n and approach r over their scales, by θ with cos θ = |B - A| / (A + B).\n",
    );
    table(
        out,
        &[
            "θ, deg", "m here", "source", "n here", "source", "r here", "source",
        ],
    );
    for (degrees, source) in [
        (1.0, [36.9319, 0.1313, 0.1211]),
        (6.0, [9.7883, 0.2552, 0.3274]),
        (20.0, [3.8160, 0.4121, 0.6038]),
        (45.0, [1.9265, 0.6038, 0.8547]),
        (60.0, [1.4858, 0.7171, 0.9376]),
        (75.0, [1.2020, 0.8448, 0.9847]),
        (85.0, [1.0609, 0.9442, 0.9983]),
    ] {
        let cosine = libm::cos(f64::to_radians(degrees));
        let shape = EllipseShape::of((1.0 - cosine) / (1.0 + cosine));
        let mut cells = vec![format!("{degrees}")];
        for (found, source) in [shape.major, shape.minor, shape.approach].into_iter().zip(source) {
            cells.extend([format!("{found:.4}"), format!("{source:.4}")]);
        }
        row(out, &cells);
    }
}

fn kalker(out: &mut String) {
    line(out, "## Kalker's coefficients\n");
    line(
        out,
        "At nodes of the table (Kalker 1990, table E.3) the table's own digits; between Poisson's ratios \
         1/C is a",
    );
    line(out, "parabola: C11 at a/b = 0.5 and ν = 0.28");
    let between = Coefficients::of(0.5, POISSON).c11;
    line(out, &format!("is {between:.3}, in CONTACT 3.734.\n"));
    table(out, &["a/b", "ν", "C11, C22, C23, C33 here", "source"]);
    for (ratio, name, poisson, source) in [
        (0.1, "0.1", 0.0, "2.51, 2.51, 0.334, 6.42"),
        (0.5, "0.5", 0.25, "3.62, 3.01, 0.929, 1.93"),
        (1.0, "1", 0.5, "5.20, 3.98, 1.63, 1.16"),
        (1.0 / 0.9, "1/0.9", 0.25, "4.22, 3.81, 1.59, 1.11"),
        (2.0, "1/0.5", 0.25, "5.10, 4.90, 2.62, 0.819"),
        (10.0, "1/0.1", 0.5, "12.9, 16.0, 18.0, 0.228"),
    ] {
        let c = Coefficients::of(ratio, poisson);
        let digits = |value: f64| match value {
            value if value < 0.9995 => format!("{value:.3}"),
            value if value < 9.995 => format!("{value:.2}"),
            value => format!("{value:.1}"),
        };
        let found = [c.c11, c.c22, c.c23, c.c33].map(digits).join(", ");
        row(
            out,
            &[name.to_owned(), format!("{poisson}"), found, source.to_owned()],
        );
    }
}

/// Returns the patch of CONTACT's example `tractcurv`.
fn traction_patch() -> Patch<f64> {
    Patch {
        axes: [6.305e-3, 12.611e-3],
        load: 106.7e3,
        friction: 0.33,
        shear_modulus: SHEAR,
        coefficients: Coefficients::of(6.305 / 12.611, POISSON),
    }
}

fn along(longitudinal: f64) -> Creepage<f64> {
    Creepage {
        longitudinal,
        lateral: 0.0,
        spin: 0.0,
    }
}

fn fastsim_limit(out: &mut String) {
    line(out, "## FASTSIM without slip\n");
    line(
        out,
        "The force of n strips over Kalker's linear force is 1 + (2/n)²/8, the midpoint rule of a half \
         circle.\n",
    );
    table(out, &["n", "here", "formula"]);
    let free = Patch {
        friction: 1e6,
        ..traction_patch()
    };
    let expected = linear::forces(&free, &along(1e-6)).x;
    for strips in [5_usize, 11, 21] {
        let found = fastsim::forces(&free, &along(1e-6), StripGrid { cells: 400, strips }).x / expected;
        let formula = 1.0 + (2.0 / strips as f64).powi(2) / 8.0;
        row(
            out,
            &[
                format!("{strips}"),
                format!("{found:.4}"),
                format!("{formula:.4}"),
            ],
        );
    }
}

fn traction(out: &mut String) {
    line(out, "## Traction curve\n");
    line(
        out,
        "The share Fx / (μN) by longitudinal creepage in CONTACT's example `tractcurv` (exact theory; 106.7 \
         kN, a = 6.305 mm,",
    );
    line(
        out,
        "b = 12.611 mm, μ = 0.33, 82 GPa, ν = 0.28). FASTSIM (30 × 30) and Shen-Hedrick-Elkins are to lie \
         within 6 %,",
    );
    line(out, "Polach within 8 %.\n");
    table(
        out,
        &[
            "creepage",
            "CONTACT",
            "FASTSIM",
            "",
            "Shen-Hedrick-Elkins",
            "",
            "Polach",
            "",
        ],
    );
    let patch = traction_patch();
    let grid = StripGrid {
        cells: 30,
        strips: 30,
    };
    let mut largest = [0.0_f64; 3];
    for (creepage, contact) in [
        (4e-4, 0.2588),
        (1.2e-3, 0.6482),
        (1.6e-3, 0.7831),
        (2.4e-3, 0.9467),
        (3.6e-3, 0.9991),
    ] {
        let found = [
            fastsim::forces(&patch, &along(creepage), grid),
            shen_hedrick_elkins::forces(&patch, &along(creepage)),
            polach::forces(&patch, &along(creepage), polach::DRY),
        ]
        .map(|forces| -forces.x / patch.limit());
        let mut cells = vec![format!("{creepage:.4}"), format!("{contact:.4}")];
        for (found, largest) in found.iter().zip(&mut largest) {
            let difference: f64 = 100.0 * (found / contact - 1.0);
            *largest = largest.max(difference.abs());
            cells.extend([format!("{found:.4}"), format!("{difference:+.1} %")]);
        }
        row(out, &cells);
    }
    let [fastsim, cubic, polach] = largest;
    let text = format!("\nLargest differences: {fastsim:.1}, {cubic:.1}, {polach:.1} %.");
    line(out, &text);
}

fn spin(out: &mut String) {
    line(out, "## Lateral creepage with spin\n");
    line(
        out,
        "CONTACT's example `fastsim`: a = 8 mm, b = 4 mm, 82 kN, μ = 0.3, lateral creepage -6.25e-4, spin \
         6.25e-4 1/mm;",
    );
    line(out, "parabolic bound, 200 × 200 cells, to lie within 3 %.\n");
    let patch = Patch {
        axes: [8e-3, 4e-3],
        load: 82e3,
        friction: 0.3,
        shear_modulus: SHEAR,
        coefficients: Coefficients::of(2.0, POISSON),
    };
    let creepage = Creepage {
        longitudinal: 0.0,
        lateral: -6.25e-4,
        spin: 0.625,
    };
    let grid = StripGrid {
        cells: 200,
        strips: 200,
    };
    let found = fastsim::forces(&patch, &creepage, grid);
    table(out, &["", "here", "CONTACT's FASTSIM", "", "CONTACT, half-space"]);
    for (what, found, source, exact) in [
        ("Fy, N", found.y, -15_640.0, -14_940.0),
        ("Mz, N·m", found.spin_moment, -37.98, -48.21),
    ] {
        let difference: f64 = 100.0 * (found / source - 1.0);
        let digits = usize::from(what.starts_with('M')) * 2;
        row(
            out,
            &[
                what.to_owned(),
                format!("{found:.digits$}"),
                format!("{source:.digits$}"),
                format!("{difference:+.1} %"),
                format!("{exact:.digits$}"),
            ],
        );
    }
    let [polach, cubic] = [
        polach::forces(&patch, &creepage, polach::DRY).y,
        shen_hedrick_elkins::forces(&patch, &creepage).y,
    ];
    let against = |force: f64| 100.0 * (force / -14_940.0 - 1.0);
    line(
        out,
        &format!(
            "\nAgainst the half-space: Fy of Polach {:+.1} %, of Shen-Hedrick-Elkins {:+.1} %; FASTSIM's \
             spin moment is a\nfifth too small, as in CONTACT's own.",
            against(polach),
            against(cubic)
        ),
    );
}

fn conicity(out: &mut String) {
    line(out, "## Coned wheels: conicity, Klingel's wavelength\n");
    line(
        out,
        "Cones on rails 136RE, amplitude 3 mm, radius 457.2 mm, tape circles 1.491 m apart. Klingel: 2π √(r \
         l / λ). Rolling",
    );
    line(
        out,
        "radius differences are to be 2 λ y exactly, wavelengths within 1 %.\n",
    );
    table(
        out,
        &[
            "cone",
            "conicity here",
            "wavelength here, m",
            "Klingel, m",
            "largest error of the difference, nm",
        ],
    );
    let Ok(rail) = nominal::rail_136re() else {
        return;
    };
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let layout = Layout {
        tape_distance: 1.491,
        gauge: 56.5 * 0.0254,
        gauge_depth: nominal::GAUGE_DEPTH,
    };
    for (name, slope) in [("1:40", 0.025), ("1:20", 0.05), ("1:10", 0.1), ("1:5", 0.2)] {
        let Ok(wheel) = nominal::cone(slope, 0.05) else {
            continue;
        };
        let Ok(wheelset) = RigidWheelset::new([&wheel; 2], [0.4572; 2], [&rail; 2], layout, steel) else {
            continue;
        };
        let positions = wheelset.sweep(8e-3, 200, true);
        let error = positions
            .iter()
            .map(|own| (own.rolling_radius_difference() - 2.0 * slope * own.shift).abs())
            .fold(0.0, f64::max);
        let found = RollingRadiusDifference::of_positions(&positions)
            .and_then(|table| table.equivalent_conicity(3e-3, 0.4572, 1.491));
        let Ok(found) = found else {
            continue;
        };
        let klingel = std::f64::consts::TAU * (0.4572 * 0.7455 / slope).sqrt();
        row(
            out,
            &[
                name.to_owned(),
                format!("{:.5}", found.by_wavelength),
                format!("{:.2}", found.wavelength),
                format!("{klingel:.2}"),
                format!("{:.1}", 1e9 * error),
            ],
        );
    }
}

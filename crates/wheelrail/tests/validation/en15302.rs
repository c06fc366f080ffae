//! The section of the page on EN 15302.

use wheelrail::conicity::RollingRadiusDifference;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileKind};
use wheelrail::wheelset::{Layout, RigidWheelset};

use super::{POISSON, SHEAR, data, line, row, table};

fn reference(file: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(data("en15302").join(file)).unwrap_or_default();
    let number = |cell: &str| cell.trim().parse().unwrap_or(f64::NAN);
    text.lines()
        .skip(2)
        .map(|line| line.split(',').map(number).collect())
        .collect()
}

/// Writes the section.
pub fn en15302(out: &mut String) {
    line(out, "## EN 15302\n");
    line(
        out,
        "Reference cases E1 to E3: equivalent conicity from the given rolling radius differences, by \
         amplitude; to lie",
    );
    line(out, "within 0.0015.\n");
    table(
        out,
        &[
            "case",
            "at 3 mm here",
            "standard",
            "amplitudes compared",
            "largest difference",
            "at, mm",
        ],
    );
    for case in 1..=3 {
        let rows = reference(&format!("rolling_radius_difference_e{case}.csv"));
        let Ok(table) = RollingRadiusDifference::new(rows.iter().map(|row| [1e-3 * row[0], 1e-3 * row[1]]))
        else {
            continue;
        };
        let (mut at_three, mut compared, mut largest) = ([f64::NAN; 2], 0, [0.0_f64; 2]);
        for own in reference(&format!("conicity_e{case}.csv")) {
            let Ok(found) = table.equivalent_conicity(1e-3 * own[0], 0.46, 1.5) else {
                continue;
            };
            compared += 1;
            if (own[0] - 3.0).abs() < 1e-9 {
                at_three = [found.by_wavelength, own[1]];
            }
            let difference = (found.by_wavelength - own[1]).abs();
            if difference > largest[0] {
                largest = [difference, own[0]];
            }
        }
        row(
            out,
            &[
                format!("E{case}"),
                format!("{:.4}", at_three[0]),
                format!("{:.4}", at_three[1]),
                format!("{compared}"),
                format!("{:.4}", largest[0]),
                format!("{:.1}", largest[1]),
            ],
        );
    }
    profiles_of_en15302(out);
}

fn profiles_of_en15302(out: &mut String) {
    line(
        out,
        "\nCases E1 to E4 from the profiles, the gauge of 1435 mm measured 14 mm below the rail's datum: \
         conicities at",
    );
    line(
        out,
        "amplitudes from 1 mm to 7.5 mm at which the wheelset swings, and those within the standard's \
         limits.\n",
    );
    let head = [
        "case",
        "at 3 mm here",
        "standard",
        "rail's axis from the middle, mm",
    ];
    table(
        out,
        &[&head[..], &["amplitudes compared", "within the limits"]].concat(),
    );
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.435,
        gauge_depth: 0.014,
    };
    let steel = Material {
        youngs_modulus: 2.0 * SHEAR * (1.0 + POISSON),
        poisson: POISSON,
    };
    let wheelset = |wheel: &str| {
        let wheel = Profile::read(&data("en15302").join(wheel), ProfileKind::Wheel, 0.0)?;
        let rail = Profile::read(&data("en15302").join("rail_a.csv"), ProfileKind::Rail, 0.0)?;
        RigidWheelset::new([&wheel; 2], [0.46; 2], [&rail; 2], layout, steel)
    };
    for (case, wheel) in [(1, "a"), (2, "b"), (3, "h"), (4, "i")] {
        let Ok(wheelset) = wheelset(&format!("wheel_{wheel}.csv")) else {
            continue;
        };
        let Ok(table) = RollingRadiusDifference::of_positions(&wheelset.sweep(9e-3, 360, true)) else {
            continue;
        };
        let (mut at_three, mut compared, mut within) = ([f64::NAN; 2], 0, 0);
        for own in reference(&format!("conicity_e{case}.csv")) {
            let Ok(found) = table.equivalent_conicity(1e-3 * own[0], 0.46, 1.5) else {
                continue;
            };
            compared += 1;
            within += i32::from((own[3]..=own[2]).contains(&found.by_wavelength));
            if (own[0] - 3.0).abs() < 1e-9 {
                at_three = [found.by_wavelength, own[1]];
            }
        }
        row(
            out,
            &[
                format!("E{case}"),
                format!("{:.4}", at_three[0]),
                format!("{:.4}", at_three[1]),
                format!("{:.3}", 1e3 * wheelset.rail_origins()[0]),
                compared.to_string(),
                within.to_string(),
            ],
        );
    }
}

//! Hollow wheels: conicity, forces in a curve of 7.5° and hunting.

use std::fmt::Write;

use study::car::builtin;

use crate::onset::rolling;
use crate::shared::{Failure, cells, each, hunt, late, run_in, statistic};
use crate::{INCH, POUND_FORCE, RAMP};

/// New wheels and those with hollow treads.
const TREADS: [&str; 3] = ["aar_1b", "hollow_2mm", "hollow_4mm"];
const KIP: f64 = 1e3 * POUND_FORCE;
/// Shifts of a wheelset at which the difference of its rolling radii is told, m.
const SHIFTS: [f64; 3] = [3e-3, 6e-3, 9e-3];

/// The section.
pub fn wheels() -> Result<String, Failure> {
    let mut out = "## Hollow wheels\n\n\
         All wheels alike, by their names: the nominal AAR-1B, and with a tread hollow by 2 and 4 mm (its \
         width and form are guesses). Conicity: equivalent,\nat 3 mm. Rolling radius difference: right less \
         left wheel with the wheelset shifted to the right; positive steers.\nHunting: the empty car on \
         roller side bearings on the ramps of the first table.\n\n\
         | tread | conicity | difference at 3 mm, mm | at 6 mm | at 9 mm | flange to flange down to, mph | \
         hunting dies at, mph | begins at, mph | largest amplitude, in \
         |\n|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let hunting = each(&TREADS, |tread| {
        let overrides = [
            "truck.side_bearing.kind=roller".to_owned(),
            format!("wheels.profile={tread}"),
        ];
        let found = hunt([30.0, 80.0], RAMP, &overrides)?;
        let case = builtin::case_with("car_hunting_empty", &overrides)?;
        let (table, conicity) = rolling(&case)?;
        let [three, six, nine] = SHIFTS.map(|shift| format!("{:+.2}", 1e3 * table.value(shift)));
        Ok(format!(
            "| {tread} | {conicity:.3} | {three} | {six} | {nine} | {} |\n",
            cells(&found).join(" | ")
        ))
    })?;
    out.extend(hunting);
    out += "\nThe loaded car in 7.5° to the left with 4 in of superelevation (the regime `constant_curve`): \
            means of the last two seconds; forces of the leading\naxle spread the gauge.\n\n\
            | tread | gauge, in | speed, mph | leading axle to the outside, in | its angle of attack, mrad | \
            lateral force outer, kip | inner, kip | L/V outer | L/V inner | truck side outer | warp, front, \
            mrad |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    let curves = [
        (14.0, 56.5),
        (28.0, 56.5),
        (36.0, 56.5),
        (28.0, 57.0),
        (28.0, 57.5),
    ];
    let runs: Vec<(&str, f64, f64)> = TREADS
        .iter()
        .flat_map(|tread| curves.map(|(speed, gauge)| (*tread, speed, gauge)))
        .collect();
    let lines = each(&runs, |(tread, speed, gauge)| {
        let set = [
            format!("wheels.profile={tread}"),
            format!("rails.gauge={gauge} in"),
        ];
        let result = run_in("constant_curve", "loaded", *speed, &[&set[0], &set[1]])?;
        let mean = |name: &str| late(&result, name, 400);
        let mut line = format!("| {tread} | {gauge} | {speed:.0} |");
        let _ = writeln!(
            line,
            " {:.3} | {:.2} | {:.2} | {:.2} | {:.3} | {:.3} | {:.3} | {:.2} |",
            -mean("axle_1_lateral")? / INCH,
            -1e3 * mean("axle_1_yaw")?,
            mean("axle_1_right_lateral")? / KIP,
            mean("axle_1_left_lateral")? / KIP,
            mean("axle_1_right_l_over_v")?,
            mean("axle_1_left_l_over_v")?,
            statistic(&result, "truck_1_right_side_l_over_v")?,
            1e3 * mean("truck_1_warp_angle")?,
        );
        Ok(line)
    })?;
    out.extend(lines);
    out += "\nThe direction: a hollow whose middle is near the tape circle makes the cone between it and the \
            flange steeper, so that the leading axle steers better and its\nforces fall, and the empty car \
            hunts at lower speeds. On its field side the hollow rises again: a low wheel that bears there \
            has the larger radius and steers out\nof the curve. A wheelset whose flange is on the outer \
            rail comes there on wide gauge: forces of new wheels fall with the gauge, those of hollow ones \
            rise,\nand the front truck warps the other way. That hollow wheels are a cause of warp in \
            curves (Wolf 2004, remembered) is so where the low wheel bears on the\nfield side of its \
            hollow, not for every hollow wheel.\n";
    Ok(out)
}

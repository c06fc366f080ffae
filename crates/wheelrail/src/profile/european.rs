//! Nominal profiles of Europe: wheel S1002, rail 60E1.
//!
//! **S1002** (EN 13715, UIC 510-2): polynomials of the tread and the throat, lines and arcs of the flange,
//! from 70 mm on the flange's side to 60 mm on the field side of the tape circle. Source: the function
//! `s1002` of a public program (courtesy of H. Netter, DLR), which several repositories on GitHub have; the
//! standard itself was not at hand. It agrees with the file of the Manchester contact benchmark within 0.01
//! mm.
//!
//! **60E1** (EN 13674-1; before: UIC60): crown of radius 300 mm, 20.456 mm wide, shoulders of 80 mm, corners
//! of 13 mm, sides inclined by 1:20, 72 mm apart 14 mm below the top. Remembered; with them the shoulders end
//! 52.05 mm apart, as on the drawing, and the head agrees with the file of the Manchester contact benchmark
//! within 0.05 mm. It stands inclined by 1:40 or 1:20.

use std::f64::consts::{FRAC_PI_2, PI};

use super::chain::{ChainElement, chain};
use super::{Points, Profile, ProfileError, ProfileKind};

const MILLIMETER: f64 = 1e-3;
/// Spacing of the points of S1002, mm.
const SPACING: f64 = 0.25;

/// Coefficients of the tread from -26 mm to 32.15796 mm, by rising powers of y in mm; z down in mm.
const TREAD: [f64; 9] = [
    0.0,
    -3.358_537_058e-2,
    1.565_681_624e-3,
    -2.810_427_944e-5,
    5.844_240_864e-8,
    -1.562_379_023e-8,
    5.309_217_349e-15,
    -5.957_839_843e-12,
    2.646_656_573e-13,
];
/// Those of the throat from -35 mm to -26 mm.
const THROAT: [f64; 8] = [
    -4.320_221_063e3,
    -1.038_384_026e3,
    -1.065_501_873e2,
    -6.051_367_875,
    -2.054_332_446e-1,
    -4.169_739_389e-3,
    -4.687_195_829e-5,
    -2.252_755_540e-7,
];
/// Ends of the sections, mm: back of the flange, tip, face, throat, tread, field side.
const ENDS: [f64; 9] = [
    -70.0,
    -62.764_705_882,
    -49.662_510_381,
    -39.764_473_993,
    -38.426_669_071,
    -35.0,
    -26.0,
    32.157_96,
    60.0,
];

/// Returns z, down, of S1002 at y, mm.
fn s1002_depth(y: f64) -> f64 {
    let polynomial = |of: &[f64]| of.iter().rev().fold(0.0, |sum, own| sum * y + own);
    let arc = |center: [f64; 2], radius: f64, sign: f64| {
        center[1] + sign * (radius * radius - (y - center[0]).powi(2)).max(0.0).sqrt()
    };
    match ENDS[1..8].iter().position(|end| y < *end) {
        Some(0) => arc([-49.5, 9.519_259_302], 20.5, 1.0),
        Some(1) => arc([-55.0, 16.0], 12.0, 1.0),
        Some(2) => arc([-58.558_326_413, 8.834_924_130], 20.0, 1.0),
        Some(3) => -2.747_477_419 * y - 93.576_667_419,
        Some(4) => arc([-26.210_665, 16.446], 13.0, -1.0),
        Some(5) => polynomial(&THROAT),
        Some(6) => polynomial(&TREAD),
        _ => 1.364_323_640 - 0.066_666_667 * y,
    }
}

/// Returns the nominal wheel S1002; see the head of this module for its source.
///
/// # Errors
/// None that a user can cause.
pub fn s1002() -> Result<Profile, ProfileError> {
    // Points by y, on the steep back of the flange by the angle of its arc.
    let mut at: Vec<f64> = Vec::new();
    let steep = libm::acos((ENDS[1] + 49.5) / 20.5);
    at.extend((0..40).map(|i| -49.5 + 20.5 * libm::cos(PI + (steep - PI) * f64::from(i) / 40.0)));
    for ends in ENDS[1..].windows(2) {
        let count = libm::ceil((ends[1] - ends[0]) / SPACING) as u32;
        at.extend((0..count).map(|i| ends[0] + (ends[1] - ends[0]) * f64::from(i) / f64::from(count)));
    }
    at.push(ENDS[8]);
    let points: Vec<[f64; 2]> = at
        .into_iter()
        .map(|y| [MILLIMETER * y, -MILLIMETER * s1002_depth(y)])
        .collect();
    let made = Profile::of_points(&Points::new("S1002 (nominal)", &points), ProfileKind::Wheel, 0.0)?;
    Ok(Profile {
        note: "nominal, from a published function of EN 13715's polynomials",
        back: Some(MILLIMETER * ENDS[0]),
        ..made
    })
}

/// Returns the nominal head of the rail 60E1, upright, its top at the origin; see the head of this module for
/// its source.
///
/// # Errors
/// None that a user can cause.
pub fn rail_60e1() -> Result<Profile, ProfileError> {
    let [crown, shoulder, corner] = [300.0, 80.0, 13.0].map(|radius| MILLIMETER * radius);
    let (half_width, side_depth, end_depth) = (36.0 * MILLIMETER, 14.0 * MILLIMETER, 30.0 * MILLIMETER);
    let slope = 1.0 / 20.0;
    let sine = 10.228 * MILLIMETER / crown;
    let cosine = (1.0 - sine * sine).sqrt();
    let center = [(crown - shoulder) * sine, -crown + (crown - shoulder) * cosine];
    let steep = FRAC_PI_2 - libm::atan(slope);
    let side = half_width + (end_depth - side_depth) * slope;
    let line = |sign: f64| ChainElement::Line {
        point: [sign * half_width, -side_depth],
        angle: -sign * steep,
    };
    let shoulder_at = |sign: f64| ChainElement::Circle {
        center: [sign * center[0], center[1]],
        radius: -shoulder,
    };
    let elements = [
        line(-1.0),
        ChainElement::Fillet { radius: -corner },
        shoulder_at(-1.0),
        ChainElement::Circle {
            center: [0.0, -crown],
            radius: -crown,
        },
        shoulder_at(1.0),
        ChainElement::Fillet { radius: -corner },
        line(1.0),
    ];
    let curve = chain(
        "60E1 (nominal)",
        [-side, -end_depth],
        &elements,
        [side, -end_depth],
    )?;
    Ok(Profile {
        note: "nominal, from remembered radii of EN 13674-1, compared with a published file",
        ..Profile::of_curve("60E1 (nominal)", ProfileKind::Rail, curve)
    })
}

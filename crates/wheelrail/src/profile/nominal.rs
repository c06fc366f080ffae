//! Cone and cylinder, and nominal profiles of North American freight: wheel AAR-1B narrow flange, rail 136RE.
//!
//! **The wheel AAR-1B and the rail 136RE are nominal: built from radii that were remembered, not read from
//! the drawings (AAR S-669, AREMA figure 4-1). Check them against the drawings; a profile from a file is
//! always preferable.** Where each number comes from:
//!
//! | wheel AAR-1B | value | source |
//! |---|---|---|
//! | tread | 1:20 | remembered, and a published statement about AAR treads on rails inclined by 1:40 |
//! | flange angle | 75° | remembered (72° is the least in APTA SS-M-015) |
//! | throat | radius 9/16 in, then 1 1/2 in into the tread | remembered |
//! | flange | height 1 in, thickness 1 5/32 in at 5/8 in below the tape circle | remembered |
//! | rim | 5 23/32 in wide, tape circle 3 1/16 in from the back | remembered |
//! | back to back of a wheelset | 53 3/8 in; 53 3/32 in with wide flanges | remembered |
//! | where the two throat radii meet | at a slope of 20° | guess |
//! | tip of the flange | radius 1/2 in, then an arc to the vertical back | guess |
//!
//! | wheel AAR 1:20 of before 1990 | value | source |
//! |---|---|---|
//! | flange angle | 70° | published |
//! | throat | one radius of 3/4 in | published |
//! | all else | as AAR-1B | remembered |
//!
//! | rail 136RE | value | source |
//! |---|---|---|
//! | head | 2 15/16 in wide | manufacturer's table |
//! | crown, shoulders, corners | radius 10 or 8, 1 1/4, 9/16 in | remembered; both crowns exist, one of 14
//! in too |
//! | sides | inclined by 1:40, the width measured 5/8 in below the top | remembered, guess |
//! | where crown and shoulders meet | 3/4 in from the middle | guess |
//!
//! The gauge is measured 5/8 in below the top of the rail (49 CFR 213.53); rails stand inclined by 1:40: use
//! [`Profile::inclined`].

use std::f64::consts::FRAC_PI_2;

use quantity::INCH;

use super::chain::{ChainElement, chain};
use super::{Profile, ProfileError, ProfileKind};

/// Depth below the datum of the rail, its top, at which gauge is measured in North America, m (49 CFR
/// 213.53).
pub const GAUGE_DEPTH: f64 = 0.625 * INCH;
/// Inclination of rails in North America.
pub const INCLINATION: f64 = 1.0 / 40.0;
/// Distance of the tape circles of a wheelset with narrow flanges, m: 53 3/8 in from back to back
/// (remembered; wheelsets with wide flanges have 53 3/32 in) and twice the 3 1/16 in of [`aar_1b`]. In a
/// gauge of 56 1/2 in its flanges have a clearance of 13/32 in to each side, at the depth where gauge is
/// measured.
pub const TAPE_DISTANCE: f64 = (53.0 + 3.0 / 8.0 + 2.0 * (3.0 + 1.0 / 16.0)) * INCH;

const REMEMBERED: &str =
    "nominal, from memory, not from the drawing: check it, or give a profile from a file";

/// Returns the tread of a cone without a flange: the radius falls by `slope` to the field side; from
/// `-half_width` to `half_width` (m).
///
/// # Errors
/// A number is not admissible.
pub fn cone(slope: f64, half_width: f64) -> Result<Profile, ProfileError> {
    if !(half_width > 0.0 && half_width.is_finite()) {
        return Err(ProfileError::Number {
            what: "half width of the tread",
            value: half_width,
            must: "positive",
        });
    }
    let line = ChainElement::Line {
        point: [0.0, 0.0],
        angle: libm::atan(slope),
    };
    let ends = [-half_width, half_width].map(|y| [y, y * slope]);
    let curve = chain("cone", ends[0], &[line], ends[1])?;
    Ok(Profile::of_curve("cone", ProfileKind::Wheel, curve))
}

/// Returns a rail whose head is an arc of `radius` (m), from `-half_width` to `half_width` (m, less than the
/// radius), its top at the origin.
///
/// # Errors
/// A number is not admissible.
pub fn cylinder(radius: f64, half_width: f64) -> Result<Profile, ProfileError> {
    if !(radius > 0.0 && half_width > 0.0 && half_width < radius && radius.is_finite()) {
        return Err(ProfileError::Number {
            what: "half width of the head",
            value: half_width,
            must: "positive and less than its radius",
        });
    }
    let drop = radius - (radius * radius - half_width * half_width).sqrt();
    let circle = ChainElement::Circle {
        center: [0.0, -radius],
        radius: -radius,
    };
    let curve = chain("cylinder", [-half_width, -drop], &[circle], [half_width, -drop])?;
    Ok(Profile::of_curve("cylinder", ProfileKind::Rail, curve))
}

/// Returns the nominal wheel AAR-1B with narrow flange; see the head of this module for the source of each
/// number.
///
/// # Errors
/// None that a user can cause.
pub fn aar_1b() -> Result<Profile, ProfileError> {
    aar_1b_with_tread(20.0)
}

/// Returns the same wheel with a tread of 1:`run` in place of 1:20, so that a wheelset on round crowns has
/// the conicity 1/`run` on its treads, with the flange of the AAR-1B.
///
/// # Errors
/// The run is below 10: a steeper tread leaves the flange no straight face.
pub fn aar_1b_with_tread(run: f64) -> Result<Profile, ProfileError> {
    if !(run >= 10.0 && run.is_finite()) {
        return Err(ProfileError::Number {
            what: "the run of the tread",
            value: run,
            must: "at least 10",
        });
    }
    let back = -(3.0 + 1.0 / 16.0) * INCH;
    let rim = (5.0 + 23.0 / 32.0) * INCH + back;
    let tread_angle = libm::atan(1.0 / run);
    let tread = ChainElement::Line {
        point: [0.0, 0.0],
        angle: tread_angle,
    };
    let face_angle = 75f64.to_radians();
    let face_point = [back + (1.0 + 5.0 / 32.0) * INCH, -0.625 * INCH];
    let face = ChainElement::Line {
        point: face_point,
        angle: face_angle,
    };
    let bottom = -INCH;
    // The tip: a circle that touches the face and the level of the flange's height.
    let tip_radius = 0.5 * INCH;
    let (sine, cosine) = libm::sincos(face_angle);
    let height = bottom + tip_radius;
    let along = (tip_radius - (height - face_point[1]) * cosine) / sine;
    let tip = [face_point[0] - along, height];
    let back_radius = tip[0] - back;
    // The throat: an arc of 9/16 in turns from the face to a slope of 20°, one of 1 1/2 in from there to the
    // tread.
    let (small, large) = (-9.0 / 16.0 * INCH, -1.5 * INCH);
    let meeting = 20f64.to_radians();
    let (sin_meeting, cos_meeting) = libm::sincos(meeting);
    // The center of the large arc lies at the signed distance of its radius from the tread, that of the small
    // one from the face; their difference points along the normal where they meet.
    let offset = [(small - large) * -sin_meeting, (small - large) * cos_meeting];
    let (sin_tread, cos_tread) = libm::sincos(tread_angle);
    // On the tread's offset line: p + t u; the small center p + t u + offset has the distance `small` of the
    // face.
    let p = [-large * sin_tread, large * cos_tread];
    let distance = |point: [f64; 2]| (point[1] - face_point[1]) * cosine - (point[0] - face_point[0]) * sine;
    let at_zero = distance([p[0] + offset[0], p[1] + offset[1]]);
    let rate = sin_tread * cosine - cos_tread * sine;
    let t = (small - at_zero) / rate;
    let large_center = [p[0] + t * cos_tread, p[1] + t * sin_tread];
    let elements = [
        ChainElement::Circle {
            center: [tip[0], bottom + back_radius],
            radius: back_radius,
        },
        ChainElement::Circle {
            center: tip,
            radius: tip_radius,
        },
        face,
        ChainElement::Fillet { radius: small },
        ChainElement::Circle {
            center: large_center,
            radius: large,
        },
        tread,
    ];
    let curve = chain(
        "AAR-1B (nominal)",
        [back, bottom + back_radius],
        &elements,
        [rim, rim / run],
    )?;
    Ok(Profile {
        note: REMEMBERED,
        back: Some(back),
        ..Profile::of_curve("AAR-1B (nominal)", ProfileKind::Wheel, curve)
    })
}

/// Returns the nominal AAR wheel 1:20 of before 1990, with narrow flange: a face of 70° and one throat radius
/// of 3/4 in; see the head of this module for the source of each number.
///
/// # Errors
/// None that a user can cause.
pub fn aar_1_20() -> Result<Profile, ProfileError> {
    let back = -(3.0 + 1.0 / 16.0) * INCH;
    let rim = (5.0 + 23.0 / 32.0) * INCH + back;
    let run = 20.0;
    let face_angle = 70f64.to_radians();
    let face_point = [back + (1.0 + 5.0 / 32.0) * INCH, -0.625 * INCH];
    let (tip_radius, bottom) = (0.5 * INCH, -INCH);
    let (sine, cosine) = libm::sincos(face_angle);
    let height = bottom + tip_radius;
    let along = (tip_radius - (height - face_point[1]) * cosine) / sine;
    let tip = [face_point[0] - along, height];
    let back_radius = tip[0] - back;
    let elements = [
        ChainElement::Circle {
            center: [tip[0], bottom + back_radius],
            radius: back_radius,
        },
        ChainElement::Circle {
            center: tip,
            radius: tip_radius,
        },
        ChainElement::Line {
            point: face_point,
            angle: face_angle,
        },
        ChainElement::Fillet { radius: -0.75 * INCH },
        ChainElement::Line {
            point: [0.0, 0.0],
            angle: libm::atan(1.0 / run),
        },
    ];
    let name = "AAR 1:20 of before 1990 (nominal)";
    let curve = chain(name, [back, bottom + back_radius], &elements, [rim, rim / run])?;
    Ok(Profile {
        note: REMEMBERED,
        back: Some(back),
        ..Profile::of_curve(name, ProfileKind::Wheel, curve)
    })
}

/// Returns the nominal head of the rail 136RE with a crown of 10 in, upright, its top at the origin; see the
/// head of this module for the source of each number.
///
/// # Errors
/// None that a user can cause.
pub fn rail_136re() -> Result<Profile, ProfileError> {
    rail_136re_with_crown("136RE (nominal)", 10.0 * INCH)
}

/// Returns the same rail with a crown of 8 in.
///
/// # Errors
/// None that a user can cause.
pub fn rail_136re_8in() -> Result<Profile, ProfileError> {
    rail_136re_with_crown("136RE, crown 8 in (nominal)", 8.0 * INCH)
}

fn rail_136re_with_crown(name: &str, crown: f64) -> Result<Profile, ProfileError> {
    let (shoulder, corner) = (1.25 * INCH, 9.0 / 16.0 * INCH);
    let half_width = 0.5 * (2.0 + 15.0 / 16.0) * INCH;
    let (side_depth, end_depth) = (0.625 * INCH, 1.25 * INCH);
    // Where crown and shoulders meet, as a direction from the crown's center.
    let sine = 0.75 * INCH / crown;
    let cosine = (1.0 - sine * sine).sqrt();
    let center = [(crown - shoulder) * sine, -crown + (crown - shoulder) * cosine];
    let steep = FRAC_PI_2 - libm::atan(INCLINATION);
    let side = half_width + (end_depth - side_depth) * INCLINATION;
    let elements = [
        ChainElement::Line {
            point: [-half_width, -side_depth],
            angle: steep,
        },
        ChainElement::Fillet { radius: -corner },
        ChainElement::Circle {
            center: [-center[0], center[1]],
            radius: -shoulder,
        },
        ChainElement::Circle {
            center: [0.0, -crown],
            radius: -crown,
        },
        ChainElement::Circle {
            center,
            radius: -shoulder,
        },
        ChainElement::Fillet { radius: -corner },
        ChainElement::Line {
            point: [half_width, -side_depth],
            angle: -steep,
        },
    ];
    let curve = chain(name, [-side, -end_depth], &elements, [side, -end_depth])?;
    Ok(Profile {
        note: REMEMBERED,
        ..Profile::of_curve(name, ProfileKind::Rail, curve)
    })
}

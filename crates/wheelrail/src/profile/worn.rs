//! Worn wheels by name: AAR-1B with a hollow tread.
//!
//! The tread of the nominal [`aar_1b`](super::nominal::aar_1b) is worn by `c cos²(π (y - y0)/w)` over a width
//! w of 70 mm about y0, 5 mm on the field side of the tape circle, the flange is new. The depth c is the one
//! that gives the hollow depth of the name, as [`WheelFigures`](super::WheelFigures) measures it: 2 or 4 mm.
//! Hollow depths of this size are measured on freight wheels (5 mm and more are condemned, remembered);
//! **width, place and form are guesses**, so that the name says how deep the wheel is hollow and no more.

use std::f64::consts::PI;

use super::figures::hollow_depth;
use super::{Points, Profile, ProfileError, ProfileKind, nominal};

/// Width of the worn tread and the place of its middle, m; guesses.
const WIDTH: f64 = 70e-3;
const MIDDLE: f64 = 5e-3;
/// Spacing of the points, m.
const SPACING: f64 = 2.5e-4;

/// Returns the AAR-1B with a hollow tread of a depth (m).
///
/// # Errors
/// The depth is not above zero and at most 8 mm.
pub fn hollow(depth: f64) -> Result<Profile, ProfileError> {
    if !(depth > 0.0 && depth <= 8e-3) {
        return Err(ProfileError::Number {
            what: "the hollow depth (m)",
            value: depth,
            must: "above zero and at most 0.008",
        });
    }
    let new = nominal::aar_1b()?;
    let sample = new.curve().sample(SPACING);
    let worn = |deepest: f64| -> Vec<[f64; 2]> {
        let worn = sample.iter().map(|(_, point)| {
            let [y, z] = point.position;
            let place = (y - MIDDLE) / WIDTH;
            let cosine = if place.abs() < 0.5 {
                libm::cos(PI * place)
            } else {
                0.0
            };
            [y, z + deepest * cosine * cosine]
        });
        worn.collect()
    };
    // The hollow depth grows with the wear. It counts behind the tip of the flange, whose back falls too.
    let tip = sample
        .iter()
        .enumerate()
        .min_by(|(_, a), (_, b)| a.1.position[1].total_cmp(&b.1.position[1]))
        .map_or(0, |(index, _)| index);
    let (mut low, mut high) = (0.0, 3.0 * depth + WIDTH / 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if hollow_depth(worn(middle).into_iter().skip(tip)) < depth {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    let name = format!("AAR-1B, hollow by {:.0} mm", 1e3 * depth);
    // The tape circle stays where the nominal radius is measured: it has worn with the tread.
    let mut points = worn(high);
    let place = MIDDLE / WIDTH;
    let lifted = high * libm::cos(PI * place).powi(2);
    points.iter_mut().for_each(|point| point[1] -= lifted);
    let made = Profile::of_points(&Points::new(&name, &points), ProfileKind::Wheel, 0.0)?;
    Ok(Profile {
        note: "the nominal wheel from memory with a hollow tread, whose width and form are guesses",
        back: new.flange_back(),
        ..made
    })
}

//! Names of profiles that are built in.

use quantity::INCH;

use super::{Profile, ProfileError, ProfileKind, european, nominal, worn};

/// Half width of the tread of cones and cylinders, m.
const TREAD: f64 = 2.0 * INCH;
/// Names of wheels that are built in, for messages.
pub const WHEELS: &str = "aar_1b, aar_1b_1:10 (its flange, another tread), aar_1:20 (before 1990), s1002, \
                          hollow_2mm, hollow_4mm (AAR-1B, worn by guess), cylinder, cone_1:20 (any slope)";
/// Names of rails that are built in, for messages.
pub const RAILS: &str = "136re (crown 10 in, 136re_10in too), 136re_8in, 60e1";

/// Profiles that have a name but no drawing here: name, what it is, why it is not built in.
const NOT_BUILT_IN: [(&str, ProfileKind, &str); 1] = [(
    "aar_2a",
    ProfileKind::Wheel,
    "AAR-2A is the primary profile of new freight car wheels in North America since January 2020; its \
     drawing (AAR S-669) is not public, and it is not drawn from memory here",
)];

/// Returns the wheel of a name; none if there is no such name.
///
/// # Errors
/// The name is that of a profile that is not built in, or its numbers are not admissible.
pub fn wheel(name: &str) -> Result<Option<Profile>, ProfileError> {
    let lower = name.to_ascii_lowercase();
    let slope_of = |text: &str| {
        slope(text).ok_or_else(|| ProfileError::Name {
            name: name.to_owned(),
            remedy: "write for example cone_1:20".into(),
        })
    };
    if let Some(run) = lower.strip_prefix("aar_1b_1:") {
        let run = run.trim().parse::<f64>().unwrap_or(f64::NAN);
        return nominal::aar_1b_with_tread(run).map(Some);
    }
    if let Some(text) = lower.strip_prefix("cone_") {
        return nominal::cone(slope_of(text)?, TREAD).map(Some);
    }
    match lower.as_str() {
        "aar_1b" => nominal::aar_1b().map(Some),
        "aar_1:20" => nominal::aar_1_20().map(Some),
        "s1002" => european::s1002().map(Some),
        "hollow_2mm" => worn::hollow(2e-3).map(Some),
        "hollow_4mm" => worn::hollow(4e-3).map(Some),
        "cylinder" => nominal::cone(0.0, TREAD).map(Some),
        _ => refused(name, ProfileKind::Wheel),
    }
}

/// Returns the rail of a name, upright, and its usual inclination; none if there is no such name.
///
/// # Errors
/// The name is that of a profile that is not built in.
pub fn rail(name: &str) -> Result<Option<(Profile, f64)>, ProfileError> {
    match name.to_ascii_lowercase().as_str() {
        "136re" | "136re_10in" => Ok(Some((nominal::rail_136re()?, nominal::INCLINATION))),
        "136re_8in" => Ok(Some((nominal::rail_136re_8in()?, nominal::INCLINATION))),
        "60e1" => Ok(Some((european::rail_60e1()?, nominal::INCLINATION))),
        _ => Ok(refused(name, ProfileKind::Rail)?.map(|profile| (profile, 0.0))),
    }
}

/// Returns the refusal of a name that stands neither for a file nor for a profile that is built in.
#[must_use]
pub fn unknown(name: &str, kind: ProfileKind) -> ProfileError {
    ProfileError::NoSuchProfile {
        name: name.to_owned(),
        kind: kind.word(),
        names: match kind {
            ProfileKind::Wheel => WHEELS,
            ProfileKind::Rail => RAILS,
        },
    }
}

fn refused(name: &str, kind: ProfileKind) -> Result<Option<Profile>, ProfileError> {
    let plain = |text: &str| text.to_ascii_lowercase().replace(['-', '_', ' '], "");
    let found = NOT_BUILT_IN
        .iter()
        .find(|(own, of, _)| *of == kind && plain(own) == plain(name));
    match found {
        Some((own, _, why)) => Err(ProfileError::NotBuiltIn { name: own, why }),
        None => Ok(None),
    }
}

/// Returns a slope written as a ratio (1:40) or a number; none if it is neither, or larger than 0.5.
#[must_use]
pub fn slope(text: &str) -> Option<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let value = match text.split_once(':') {
        Some((rise, run)) => number(rise)? / number(run)?,
        None => number(text)?,
    };
    (-0.5..=0.5).contains(&value).then_some(value)
}

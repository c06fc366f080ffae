//! What a survey of wedge rise varies besides rise and speed: conditions, each of a factor, and
//! irregularities of a class of track.

use toml::Value;

use crate::assessment::conditions::Condition;
use crate::case::CaseError;
use crate::case::problem::Problem;

/// Factors with the conditions that stand for them, in the order in which they are looked at.
const FACTORS: [(&str, &[&str]); 7] = [
    ("where wear lies", &["worn_columns", "worn_slopes"]),
    ("friction of the wedges", &["mu_0.25", "mu_0.5"]),
    (
        "friction of wheel on rail",
        &["dry_rail", "gauge_face_lubricated"],
    ),
    ("lading", &["empty", "cg_98"]),
    ("side bearings", &["low_preload_side_bearing"]),
    ("wheel profile", &["hollow_2mm"]),
    ("track", &["track_class_3", "track_class_5"]),
];
/// The beginning of the names of levels that lay irregularities over the tracks.
const TRACK: &str = "track_class_";
/// Classes that the spectra have.
const CLASSES: std::ops::RangeInclusive<u8> = 1..=6;
/// Irregularities of a class: spectrum, rails, direction; each with its number as its seed.
const SPECTRA: [[&str; 3]; 3] = [
    ["fra_vertical", "both", "vertical"],
    ["fra_cross_level", "against", "vertical"],
    ["fra_lateral", "both", "lateral"],
];

/// A value of a factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// The factor: what is varied.
    pub factor: String,
    /// Its settings.
    pub condition: Condition,
    /// The FRA class whose irregularities lie over those of the tracks.
    pub track_class: Option<u8>,
}

impl Level {
    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.condition.name
    }

    fn of(condition: Condition) -> Self {
        let factor = FACTORS
            .iter()
            .find(|(_, names)| names.contains(&condition.name.as_str()))
            .map_or(condition.name.as_str(), |(factor, _)| factor);
        Self {
            factor: factor.to_owned(),
            condition,
            track_class: None,
        }
    }

    fn of_track(class: u8) -> Self {
        let title = format!("irregularities of FRA class {class} by spectra, over those of the track");
        Self {
            factor: "track".to_owned(),
            condition: Condition {
                name: format!("{TRACK}{class}"),
                title,
                set: Vec::new(),
            },
            track_class: Some(class),
        }
    }
}

/// Returns all that are varied if none are asked for.
#[must_use]
pub fn all() -> Vec<Level> {
    let names = FACTORS.iter().flat_map(|(_, names)| names.iter());
    names.filter_map(|name| built_in(name)).collect()
}

fn built_in(name: &str) -> Option<Level> {
    if let Some(class) = name.strip_prefix(TRACK) {
        let class = class.parse().ok().filter(|own| CLASSES.contains(own))?;
        return Some(Level::of_track(class));
    }
    let own = Condition::all().iter().find(|own| own.name == name)?;
    Some(Level::of(own.clone()))
}

/// Returns those that texts name: `track_class_N`, a built-in condition, or all conditions of a file.
///
/// # Errors
/// There is none of this name, one is named twice, or something in a file is wrong.
pub fn chosen(names: &[String]) -> Result<Vec<Level>, CaseError> {
    let mut found: Vec<Level> = Vec::new();
    for name in names {
        let levels = match name.strip_prefix(TRACK) {
            Some(_) => match built_in(name) {
                Some(own) => vec![own],
                None => {
                    let problem = Problem::new(format!("there is no track of the name {name}"));
                    let help = format!("write {TRACK}1 to {TRACK}6, the classes that have spectra");
                    return Err(problem.help(help).into());
                }
            },
            None => {
                let own = Condition::chosen(std::slice::from_ref(name), true)?;
                own.into_iter().map(Level::of).collect()
            }
        };
        for own in levels {
            if found.iter().any(|other| other.name() == own.name()) {
                let problem = Problem::new(format!("the factor {} is named twice", own.name()));
                return Err(problem.help("name each once").into());
            }
            if let Some(set) = own.condition.set.iter().find(|set| super::sets_rise(set)) {
                let message = format!(
                    "the condition {} sets {set}: rise is what a survey varies",
                    own.name()
                );
                let problem = Problem::new(message);
                return Err(problem.help("leave it out, or take the condition out").into());
            }
            found.push(own);
        }
    }
    Ok(found)
}

/// Lays irregularities of a class over a regime's track, a table as TOML in one value.
///
/// # Errors
/// The track is no table with a list of irregularities.
pub(super) fn roughened(track: &str, class: u8) -> Result<String, CaseError> {
    let no_table = || {
        let problem = Problem::new(format!(
            "irregularities of class {class} cannot lie over this track"
        ));
        problem.help("write the track as a table with its irregularities, or leave this condition out")
    };
    let mut own: Value = track.parse().map_err(|_| no_table())?;
    let table = own.as_table_mut().ok_or_else(no_table)?;
    let all = table
        .entry("irregularities")
        .or_insert_with(|| Value::Array(Vec::new()));
    let all = all.as_array_mut().ok_or_else(no_table)?;
    for (seed, [spectrum, rails, direction]) in (1_i64..).zip(SPECTRA) {
        let added = [
            ("spectrum", Value::from(spectrum)),
            ("class", Value::from(i64::from(class))),
            ("rails", Value::from(rails)),
            ("direction", Value::from(direction)),
            ("seed", Value::from(seed)),
        ];
        let added = added.map(|(key, value)| (key.to_owned(), value));
        all.push(Value::Table(added.into_iter().collect()));
    }
    Ok(own.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::car::regime::Regime;

    #[test]
    fn input_all_levels_that_are_named_are_there() {
        let names: usize = FACTORS.iter().map(|(_, names)| names.len()).sum();
        assert_eq!(all().len(), names);
        assert!(all().iter().all(|own| !own.condition.title.is_empty()));
        for wrong in ["track_class_9", "track_class_x", "no_such_condition", "rise_0.5"] {
            assert!(chosen(&[wrong.to_owned()]).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_class_of_track_lies_over_a_track() {
        for name in super::super::REGIMES {
            let own = Regime::named(name).unwrap();
            let rough = roughened(&own.track, 3).unwrap();
            let count = |text: &str| text.matches("direction").count();
            assert_eq!(count(&rough), count(&own.track) + 3, "{rough}");
        }
        assert!(roughened("\"a track\"", 3).is_err());
    }
}

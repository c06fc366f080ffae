//! The choice of the columns to compare.

use std::path::PathBuf;

use miette::Diagnostic;
use quantity::{Kind, System as Units, nearest};

use super::{ComparedResult, ComparisonError, MAIN};
use crate::table::TableColumn;

/// Most names of columns that a note lists.
const LISTED: usize = 5;

/// Returns the columns to compare, without units; `models` are what the runs are about, as far as it is
/// known.
pub(super) fn choose(
    entries: &[ComparedResult],
    models: &[Option<&'static str>],
    wanted: &[String],
    notes: &mut Vec<String>,
) -> Result<Vec<String>, ComparisonError> {
    let Some((first, others)) = entries.split_first() else {
        return Ok(Vec::new());
    };
    if !wanted.is_empty() {
        return chosen(first, others, wanted);
    }
    let mut common: Vec<&TableColumn> = columns(first).collect();
    for (other, model) in others.iter().zip(&models[1..]) {
        let before = common.clone();
        common.retain(|own| other.table.find(&own.name).is_some());
        if common.is_empty() {
            return Err(nothing_in_common(first, other, &before));
        }
        if let (Some(own), Some(theirs)) = (models[0], *model)
            && own != theirs
        {
            return Err(ComparisonError::Models {
                first: first.table.file.clone(),
                own,
                second: other.table.file.clone(),
                other: theirs,
                common: listed(&common),
            });
        }
        let mut clashes = Vec::new();
        common.retain(|own| {
            clash(own, first, other)
                .map(|error| clashes.push(error))
                .is_none()
        });
        if common.is_empty() {
            return Err(nothing_comparable(first, other, &clashes));
        }
        for error in clashes {
            let help = error.help().map_or(String::new(), |help| format!(": {help}"));
            notes.push(format!("{error}; it is left out{help}."));
        }
    }
    for other in others {
        for (one, two) in [(first, other), (other, first)] {
            let alone: Vec<_> = columns(one)
                .filter(|own| two.table.find(&own.name).is_none())
                .collect();
            if !alone.is_empty() {
                notes.push(format!(
                    "{} has, and {} has not: {}.",
                    one.label,
                    two.label,
                    listed(&alone)
                ));
            }
        }
    }
    let main: Vec<String> = MAIN
        .iter()
        .filter(|name| common.iter().any(|own| own.name == **name))
        .map(|name| (*name).to_owned())
        .collect();
    if main.is_empty() {
        return Ok(common.into_iter().map(|own| own.name.clone()).collect());
    }
    Ok(main)
}

/// Returns the columns that are asked for.
fn chosen(
    first: &ComparedResult,
    others: &[ComparedResult],
    wanted: &[String],
) -> Result<Vec<String>, ComparisonError> {
    let mut chosen: Vec<String> = Vec::new();
    for name in wanted {
        let own = first.table.column(name)?;
        if own.name == "time" {
            return Err(ComparisonError::Time);
        }
        for other in others {
            other.table.column(&own.name)?;
            if let Some(error) = clash(own, first, other) {
                return Err(error);
            }
        }
        if !chosen.contains(&own.name) {
            chosen.push(own.name.clone());
        }
    }
    Ok(chosen)
}

/// Returns the columns of a result but the time.
fn columns(result: &ComparedResult) -> impl Iterator<Item = &TableColumn> {
    result.table.columns().iter().filter(|own| own.name != "time")
}

/// Returns names of columns: the first ones, and how many more there are.
fn listed(columns: &[&TableColumn]) -> String {
    let names = columns.iter().take(LISTED).map(|column| column.name.as_str());
    let names = names.collect::<Vec<&str>>().join(", ");
    match columns.len().saturating_sub(LISTED) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}

/// Returns why a column of the first result cannot be compared with that of its name in another one.
fn clash(own: &TableColumn, first: &ComparedResult, other: &ComparedResult) -> Option<ComparisonError> {
    let theirs = other.table.find(&own.name)?;
    let column = own.name.clone();
    let [ours, others] =
        [(own, first), (theirs, other)].map(|(column, result)| (column.kind, &result.table.file));
    if ours.0.dimension() == others.0.dimension() {
        return None;
    }
    let dimensionless = |(kind, _): &(Kind, &PathBuf)| kind.dimension() == Kind::Dimensionless.dimension();
    let (without, with) = if dimensionless(&ours) {
        (ours, others)
    } else {
        (others, ours)
    };
    if dimensionless(&without) {
        return Some(ComparisonError::NoUnit {
            advice: advice(&column, with.0),
            column,
            first: without.1.clone(),
            second: with.1.clone(),
            kind: with.0.name(),
        });
    }
    Some(ComparisonError::Kinds {
        column,
        first: ours.1.clone(),
        own: ours.0.name(),
        second: others.1.clone(),
        other: others.0.name(),
    })
}

/// Returns the names that a column of this kind may have.
fn advice(name: &str, kind: Kind) -> String {
    let [us, si] = [Units::Us, Units::Si].map(|units| format!("{name}_{}", kind.suffix(units)));
    match us == si {
        true => format!("write {us}"),
        false => format!("write {us} or {si}"),
    }
}

/// Returns the error where none of the common columns can be compared.
fn nothing_comparable(
    first: &ComparedResult,
    other: &ComparedResult,
    clashes: &[ComparisonError],
) -> ComparisonError {
    const MOST: usize = 3;
    let shown = clashes.iter().take(MOST);
    let reasons: Vec<String> = shown.clone().map(ToString::to_string).collect();
    let helps: Vec<String> = shown
        .filter_map(|error| Some(error.help()?.to_string()))
        .collect();
    ComparisonError::NothingComparable {
        first: first.table.file.clone(),
        second: other.table.file.clone(),
        reasons: reasons.join("; "),
        advice: helps.join("; "),
    }
}

/// Returns the error, with names that may be meant to be the same.
fn nothing_in_common(
    first: &ComparedResult,
    other: &ComparedResult,
    own: &[&TableColumn],
) -> ComparisonError {
    const MOST: usize = 3;
    let theirs = || columns(other).map(|column| column.name.as_str());
    // Names of ours with a unit that is not known.
    let unknown: Vec<String> = columns(other)
        .filter_map(|column| {
            let of_ours = |own: &&&TableColumn| {
                let rest = column
                    .name
                    .strip_prefix(own.name.as_str())
                    .and_then(|rest| rest.strip_prefix('_'));
                rest.is_some_and(|rest| !rest.is_empty()) && column.kind == Kind::Dimensionless
            };
            let own = own.iter().filter(of_ours).max_by_key(|own| own.name.len())?;
            let unit = &column.name[own.name.len() + 1..];
            let advice = advice(&own.name, own.kind);
            Some(format!(
                "the unit `{unit}` of `{}` is not known: {advice}",
                column.name
            ))
        })
        .take(MOST)
        .collect();
    let near: Vec<String> = own
        .iter()
        .filter_map(|own| Some(format!("`{}` and `{}`", own.name, nearest(&own.name, theirs())?)))
        .take(MOST)
        .collect();
    let advice = if !unknown.is_empty() {
        unknown.join("; ")
    } else if near.is_empty() {
        let list = theirs().take(MOST).collect::<Vec<&str>>().join(", ");
        format!("the columns of the second are {list} ...; name them as docs/summary.md does")
    } else {
        format!("near each other are {}: give them the same name", near.join(", "))
    };
    ComparisonError::NothingInCommon {
        first: first.table.file.clone(),
        second: other.table.file.clone(),
        advice,
    }
}

//! The choice of the columns to compare.

use quantity::nearest;

use super::{ComparedResult, ComparisonError, MAIN};
use crate::table::TableColumn;

/// Returns the columns to compare, without units.
pub(super) fn choose(
    first: &ComparedResult,
    others: &[ComparedResult],
    wanted: &[String],
    notes: &mut Vec<String>,
) -> Result<Vec<String>, ComparisonError> {
    let clash = |own: &TableColumn, other: &ComparedResult| {
        let theirs = other.table.find(&own.name)?;
        (theirs.kind.dimension() != own.kind.dimension()).then(|| ComparisonError::Kinds {
            column: own.name.clone(),
            first: first.table.file.clone(),
            own: own.kind.name(),
            second: other.table.file.clone(),
            other: theirs.kind.name(),
        })
    };
    if !wanted.is_empty() {
        let mut chosen: Vec<String> = Vec::new();
        for name in wanted {
            let own = first.table.column(name)?;
            if own.name == "time" {
                return Err(ComparisonError::Time);
            }
            for other in others {
                other.table.column(&own.name)?;
                if let Some(error) = clash(own, other) {
                    return Err(error);
                }
            }
            if !chosen.contains(&own.name) {
                chosen.push(own.name.clone());
            }
        }
        return Ok(chosen);
    }
    let mut common: Vec<&TableColumn> = first
        .table
        .columns()
        .iter()
        .filter(|own| own.name != "time")
        .collect();
    for other in others {
        let before = common.clone();
        common.retain(|own| other.table.find(&own.name).is_some());
        if common.is_empty() {
            return Err(nothing_in_common(first, other, &before));
        }
        common.retain(|own| match clash(own, other) {
            None => true,
            Some(error) => {
                notes.push(format!("{error}; it is left out."));
                false
            }
        });
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

/// Returns the error, with names that may be meant to be the same.
fn nothing_in_common(
    first: &ComparedResult,
    other: &ComparedResult,
    own: &[&TableColumn],
) -> ComparisonError {
    const MOST: usize = 3;
    let theirs = || {
        let names = other.table.columns().iter().map(|column| column.name.as_str());
        names.filter(|name| *name != "time")
    };
    let near: Vec<String> = own
        .iter()
        .filter_map(|own| Some(format!("`{}` and `{}`", own.name, nearest(&own.name, theirs())?)))
        .take(MOST)
        .collect();
    let advice = if near.is_empty() {
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

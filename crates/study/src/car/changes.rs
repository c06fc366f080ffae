//! What changes along the track: the key `over_distance`, places with what holds from each of them on.

use quantity::{Kind, Quantity};

use crate::case::field::Written;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range};
use crate::reader::CaseReader;
use crate::reader::schema::Form;

/// Most places of a list.
const MOST: usize = 1000;
const KEY: &str = "over_distance";

/// A change: from a place along the track on something else holds.
#[derive(Clone, Debug)]
pub(super) struct Change<T> {
    pub from: Quantity,
    pub to: T,
}

/// The entries of a list.
pub(super) struct Entries<'e> {
    /// Their keys, `from` among them.
    pub keys: &'e [&'static str],
    /// What one is, in words.
    pub what: &'e str,
    /// What a list of more than [`MOST`] could be instead; may be empty.
    pub instead: &'e str,
}

/// Reads `over_distance` of the current section: each entry but its place by `read`. It is written by
/// `write`.
pub(super) fn over_distance<T: Clone>(
    r: &mut CaseReader<'_>,
    comment: &str,
    entries: &Entries<'_>,
    read: impl Fn(&CaseSection<'_>, &mut Problems) -> Option<T>,
    write: impl Fn(&T) -> String,
) -> Vec<Change<T>> {
    let list = |section: &CaseSection<'_>, problems: &mut Problems| {
        let mut list = Vec::new();
        for own in section.tables(KEY, problems) {
            own.allow_in(entries.keys, &[], entries.what, problems);
            let from = own.quantity("from", Kind::Distance, Range::Any, problems);
            let to = read(&own, problems);
            list.push(Change { from: from?, to: to? });
        }
        if list.len() > MOST {
            let message = format!("`{}.{KEY}` has {} places", section.path, list.len());
            let help = format!("at most {MOST} are read{}", entries.instead);
            problems.push(Problem::new(message).label("too many").help(help));
            return None;
        }
        Some(list)
    };
    r.other(
        KEY,
        Form::Other,
        comment,
        Vec::new(),
        list,
        |list: &Vec<Change<T>>| {
            let one = |own: &Change<T>| format!("{{ from = \"{}\", {} }}", own.from, write(&own.to));
            let all: Vec<String> = list.iter().map(one).collect();
            Written::toml(format!("[{}]", all.join(", ")))
        },
    )
}

/// Returns places (m, rising) with what holds there: `first` up to the first change, and each from its own
/// place plus a length (m) on, over which the one before goes over into it.
///
/// # Errors
/// The number of a change that begins before the one before it is reached.
pub(super) fn places<T: Clone>(first: &T, changes: &[(f64, T)], length: f64) -> Result<Vec<(f64, T)>, usize> {
    let mut places: Vec<(f64, T)> = Vec::with_capacity(2 * changes.len());
    let mut before = first;
    for (number, (from, to)) in changes.iter().enumerate() {
        let end = places.last().map_or(f64::NEG_INFINITY, |(end, _)| *end);
        if *from < end {
            return Err(number);
        }
        if *from > end {
            places.push((*from, before.clone()));
        }
        places.push((from + length, to.clone()));
        before = to;
    }
    Ok(places)
}

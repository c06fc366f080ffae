//! Choosing built-in cases by name, beginning of a name, or pattern.

use std::path::Path;

use quantity::{fits_pattern, is_pattern, nearest};
use report::table::ResultTable;
use study::case::builtin;
use study::half_truck::catalog;
use study::models::built_in;

use crate::failure::{Failure, Message};

/// Returns the command that runs the built-in case or half-truck of this name, to the user of one that does
/// not take it; `None` if nothing has this name.
pub fn built_in_elsewhere(path: &Path) -> Option<Message> {
    let name = path.to_str()?;
    let (what, command) = match built_in(name).is_some() {
        true => ("a built-in case", "wedgelab run"),
        false => (
            catalog::entry(name).map(|_| "a built-in half-truck")?,
            "wedgelab nucars run",
        ),
    };
    Some(Message::new(
        format!("`{name}` is {what}, and this command does not take it"),
        format!("`{command} {name}` runs it"),
    ))
}

/// Reads the result of a run, or another table.
pub fn read_table(path: &Path) -> Result<ResultTable, Failure> {
    match built_in_elsewhere(path).filter(|_| !path.exists()) {
        Some(message) => Err(message.into()),
        None => Ok(ResultTable::read(path)?),
    }
}

/// Those of the names that the texts choose, in the order of the names; all of them if there are no texts.
pub fn select(
    texts: &[String],
    names: impl Iterator<Item = &'static str>,
) -> Result<Vec<&'static str>, Message> {
    let names: Vec<&'static str> = names.collect();
    if texts.is_empty() {
        return Ok(names);
    }
    let mut chosen = vec![false; names.len()];
    for text in texts {
        for index in matching(text, &names)? {
            chosen[index] = true;
        }
    }
    Ok(names
        .into_iter()
        .zip(chosen)
        .filter_map(|(name, chosen)| chosen.then_some(name))
        .collect())
}

fn matching(text: &str, names: &[&str]) -> Result<Vec<usize>, Message> {
    let text = &*builtin::own_name(text);
    let having = |fits: &dyn Fn(&str) -> bool| -> Vec<usize> {
        (0..names.len()).filter(|index| fits(names[*index])).collect()
    };
    if is_pattern(text) {
        let found = having(&|name| fits_pattern(text, name));
        return if found.is_empty() {
            Err(Message::new(
                format!("no built-in case fits `{text}`"),
                several(names),
            ))
        } else {
            Ok(found)
        };
    }
    let exact = having(&|name| name == text);
    if !exact.is_empty() {
        return Ok(exact);
    }
    let beginning = having(&|name| !text.is_empty() && name.starts_with(text));
    match beginning.as_slice() {
        [_] => Ok(beginning),
        [] if builtin::names().any(|name| name == text) => Err(Message::new(
            format!("the built-in case `{text}` is not one of these"),
            format!("`wedgelab run {text}` runs it"),
        )),
        [] if catalog::entry(text).is_some() => Err(Message::new(
            format!("`{text}` is a built-in half-truck, whose files are those of NUCARS"),
            format!("`wedgelab nucars run {text}` runs it"),
        )),
        [] => Err(Message::new(
            format!("there is no built-in case `{text}`"),
            match nearest(text, names.iter().copied()) {
                Some(near) => format!("did you mean {near}? `wedgelab case` lists all"),
                None => several(names),
            },
        )),
        found => {
            let found: Vec<&str> = found.iter().map(|index| names[*index]).collect();
            Err(Message::new(
                format!("`{text}` is the beginning of {} names", found.len()),
                format!("write '{text}*' for all of them, or one of {}", found.join(", ")),
            ))
        }
    }
}

/// Returns the names to choose from, as many as can be read.
fn several(names: &[&str]) -> String {
    const MOST: usize = 12;
    let shown = names[..names.len().min(MOST)].join(", ");
    match names.len() {
        0..=MOST => format!("the built-in cases are {shown}"),
        _ => format!("the built-in cases are {shown} and more; `wedgelab case` lists all"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(texts: &[&str]) -> Result<Vec<&'static str>, String> {
        let texts: Vec<String> = texts.iter().map(|text| (*text).to_owned()).collect();
        select(&texts, builtin::thesis_names()).map_err(|message| message.to_string())
    }

    #[test]
    fn names_beginnings_and_patterns() {
        assert_eq!(chosen(&[]).unwrap().len(), 12);
        assert_eq!(chosen(&["vdrun_toe_0_psi_0"]).unwrap(), ["vdrun_toe_0_psi_0"]);
        assert_eq!(
            chosen(&["cdrun_toe_0_psi_0.0"]).unwrap(),
            ["cdrun_toe_0_psi_0.012"]
        );
        assert_eq!(chosen(&["vdrun*"]).unwrap().len(), 6);
        assert_eq!(chosen(&["*psi_0", "cdrun_toe_0_psi_0"]).unwrap().len(), 6);
        assert_eq!(chosen(&["?drun_toe_0_psi_0"]).unwrap().len(), 2);
        assert!(chosen(&["vdrun"]).unwrap_err().contains("beginning of 6 names"));
        assert!(chosen(&["nothing"]).unwrap_err().contains("no built-in case"));
        assert!(
            chosen(&["rig_constant"])
                .unwrap_err()
                .contains("not one of these")
        );
        assert!(chosen(&["x*"]).unwrap_err().contains("fits"));
        assert!(chosen(&[""]).is_err());
    }
}

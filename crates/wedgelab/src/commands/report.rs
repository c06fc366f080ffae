//! `wedgelab report`: a page of any runs.

use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use report::page;
use report::page::side_by_side;
use report::run_folder::{self, RunFolder};
use serde_json::json;

use crate::execute::write_page;
use crate::failure::{Failure, Message, say};
use crate::folders;
use crate::interrupt;
use crate::json;

/// Make a page that compares any runs
///
/// Reads the folders of runs (result.csv and summary.json, of wedges, half-trucks, trucks, cars or wheelsets)
/// and writes index.html: the runs moving in 3D, a table of their key numbers with units and windows, their
/// loops and time histories in common figures (of cars over the distance), limits, energy ledgers, warnings,
/// assumptions, and links to their files. Nothing is computed again: the runs may come from another machine.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab report my_run
  wedgelab report vdrun_toe_0_psi_0 softer --out both
  wedgelab report reproduction/runs/truck_vertical_*

What a run looks like is taken from its own index.html, if it has one, else made of result.csv and \
case.toml; then the
corners of a truck's wedges and the bodies of a car are not seen.")]
pub struct Arguments {
    /// Folders of runs; the others are compared with the first
    #[arg(required = true, num_args = 1.., value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "report")]
    out: PathBuf,
    /// Overwrite an existing page
    #[arg(long)]
    force: bool,
    #[arg(long, help = json::HELP)]
    json: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    interrupt::listen();
    let mut runs = Vec::new();
    let mut places: Vec<PathBuf> = Vec::new();
    for path in &arguments.runs {
        let run = RunFolder::read(path)?;
        let place = absolute(&run.folder);
        if places.contains(&place) {
            let message = format!("`{}` is named twice", path.display());
            return Err(Message::new(message, "name each run once").into());
        }
        places.push(place);
        runs.push(run);
    }
    run_folder::tell_apart(&mut runs, &arguments.runs);
    let folder = folders::check(&arguments.out, &[page::FILE_NAME], arguments.force)?;
    let out = absolute(folder.path());
    let links: Vec<String> = places.iter().map(|place| link(&out, place)).collect();
    write_page(&folder, || side_by_side::render(&runs, &links))?;
    if arguments.json {
        let described = runs.iter().map(|run| {
            json!({
                "label": run.label,
                "folder": run.folder,
                "schema": run.summary.shared().schema(),
                "outcome": run.summary.shared().outcome().word(),
                "notes": run.notes,
                "numbers": run.key_numbers().into_iter().map(|number| json!({
                    "what": number.what,
                    "window": number.window,
                    "value": number.value.value,
                    "unit": number.value.unit,
                })).collect::<Vec<_>>(),
            })
        });
        json::print(&json!({
            "folder": folder.path(),
            "files": [page::FILE_NAME],
            "runs": described.collect::<Vec<_>>(),
        }))?;
    } else {
        let mut out = io::stdout().lock();
        writeln!(
            out,
            "Written into {}: {} (open it in a browser).",
            folder.path().display(),
            page::FILE_NAME
        )?;
    }
    for run in &runs {
        if let Some(told) = run.summary.shared().outcome().told() {
            say(&format!("warning: {} {told}", run.label));
        }
        for note in &run.notes {
            say(&format!("warning: {}: {note}", run.label));
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns a path from the root, without links as far as it exists.
fn absolute(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut rest = Vec::new();
    let mut existing = path.as_path();
    loop {
        if let Ok(found) = existing.canonicalize() {
            return rest.into_iter().rev().fold(found, |path, part| path.join(part));
        }
        match (existing.parent(), existing.file_name()) {
            (Some(parent), Some(name)) => {
                rest.push(name.to_owned());
                existing = parent;
            }
            _ => return path,
        }
    }
}

/// Returns the address of a folder from a page in another one, ending in `/`; empty for the same folder.
fn link(from: &Path, to: &Path) -> String {
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (from.components().collect(), to.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        // Another drive: the way from its root.
        let parts: Vec<String> = to.iter().map(|part| encoded(part.as_os_str())).collect();
        return format!("file:///{}/", parts.join("/").trim_start_matches('/'));
    }
    let up = from[shared..].iter().map(|_| "../".to_owned());
    let down = to[shared..]
        .iter()
        .map(|part| format!("{}/", encoded(part.as_os_str())));
    up.chain(down).collect()
}

/// Returns a part of a path as addresses have it.
fn encoded(part: &std::ffi::OsStr) -> String {
    let mut text = String::new();
    for byte in part.as_encoded_bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(byte) {
            text.push(char::from(*byte));
        } else {
            text.push_str(&format!("%{byte:02X}"));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_from_the_page_to_the_run() {
        for (from, to, expected) in [
            ("/a/report", "/a/run", "../run/"),
            ("/a/run", "/a/run", ""),
            ("/a", "/a/b/c 1", "b/c%201/"),
            ("/x/y", "/a/50%#?", "../../a/50%25%23%3F/"),
            ("/a/b", "/a/ä", "../%C3%A4/"),
        ] {
            assert_eq!(link(Path::new(from), Path::new(to)), expected, "{from} {to}");
        }
    }
}

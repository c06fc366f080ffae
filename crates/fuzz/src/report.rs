//! What is told at the end.

use std::fs;
use std::path::Path;

use fuzz::inputs::Inputs;

use crate::parent::ReaderResult;

const MEGABYTE: f64 = 1e6;

/// Prints the table of all readers, and what was found.
pub fn print(results: &[ReaderResult], seed: u64) {
    say!("{}", table(results));
    for result in results {
        for (what, group) in &result.found {
            let shortest = &group.shortest;
            let address = format!("{}:{seed}:{}", result.reader.name, shortest.number);
            say!("\n{}: {what}, {} times", result.reader.name, group.count);
            say!(
                "  seed {seed}, number {}, {} bytes",
                shortest.number,
                shortest.length
            );
            for line in shortest.detail.lines() {
                say!("  {line}");
            }
            say!("  cargo xtask fuzz --repeat {address}");
        }
    }
}

/// The table.
fn table(results: &[ReaderResult]) -> String {
    let head = [
        "reader",
        "executions",
        "accepted",
        "refused",
        "slowest, ms",
        "memory, MB",
        "message, B",
        "findings",
    ];
    let mut rows = vec![head.map(str::to_owned)];
    let (mut executions, mut findings) = (0, 0);
    for ReaderResult { reader, tally, found } in results {
        executions += tally.executions;
        findings += found.len();
        rows.push([
            reader.name.to_owned(),
            tally.executions.to_string(),
            tally.accepted.to_string(),
            tally.refused.to_string(),
            format!("{:.1}", tally.slowest as f64 / 1e6),
            format!("{:.1}", tally.memory as f64 / MEGABYTE),
            tally.message.to_string(),
            found.len().to_string(),
        ]);
    }
    let total = [
        "all",
        &executions.to_string(),
        "",
        "",
        "",
        "",
        "",
        &findings.to_string(),
    ];
    rows.push(total.map(str::to_owned));
    let line = |row: &[String; 8]| {
        let [name, rest @ ..] = row;
        let cells: Vec<String> = rest.iter().map(|cell| format!("{cell:>12}")).collect();
        format!("{name:<14}{}", cells.concat()).trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Writes the shortest input of each finding into a folder, and beside it what was found.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn save(results: &[ReaderResult], seed: u64, folder: &Path) -> Result<(), String> {
    let failed = |error| format!("{} cannot be written to: {error}", folder.display());
    fs::create_dir_all(folder).map_err(failed)?;
    for result in results {
        let inputs = Inputs::of(result.reader);
        for group in result.found.values() {
            let number = group.shortest.number;
            let name = format!("{}-{seed}-{number}", result.reader.name);
            fs::write(folder.join(format!("{name}.input")), inputs.input(seed, number)).map_err(failed)?;
            let text = format!("{}\n{}\n", group.shortest.what, group.shortest.detail);
            fs::write(folder.join(format!("{name}.txt")), text).map_err(failed)?;
        }
    }
    Ok(())
}

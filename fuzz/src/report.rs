//! The report at the end.

use std::fmt::Write;
use std::fs;
use std::io;
use std::path::Path;

use fuzz::inputs::Inputs;

use crate::parent::ReaderResult;

const MEGABYTE: f64 = 1e6;

/// Tells what came out for a reader, as soon as it is known.
pub fn print_one(result: &ReaderResult, seed: u64) {
    let ReaderResult { reader, tally, found } = result;
    let mut text = format!(
        "{}: {} executions, {} findings\n",
        reader.name,
        tally.executions,
        found.len()
    );
    for (what, group) in found {
        let shortest = &group.shortest;
        let address = format!("{}:{seed}:{}", reader.name, shortest.number);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "\n{}: {what}, {} times", reader.name, group.count);
        let _ = writeln!(
            text,
            "  seed {seed}, number {}, {} bytes",
            shortest.number, shortest.length
        );
        for line in shortest.detail.lines() {
            let _ = writeln!(text, "  {line}");
        }
        let _ = writeln!(text, "  cargo xtask fuzz --repeat {address}\n");
    }
    say!("{}", text.trim_end());
}

/// Prints the table of all readers.
pub fn print(results: &[ReaderResult]) {
    say!("\n{}", table(results));
}

/// Returns the table.
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

/// Writes the shortest input of each finding of a reader into a folder, and beside it what was found.
///
/// # Errors
/// The folder or a file cannot be written.
pub fn save(result: &ReaderResult, seed: u64, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let inputs = Inputs::of(result.reader);
    for group in result.found.values() {
        let number = group.shortest.number;
        let name = format!("{}-{seed}-{number}", result.reader.name);
        fs::write(folder.join(format!("{name}.input")), inputs.input(seed, number))?;
        let text = format!("{}\n{}\n", group.shortest.what, group.shortest.detail);
        fs::write(folder.join(format!("{name}.txt")), text)?;
    }
    Ok(())
}

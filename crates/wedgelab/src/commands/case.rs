//! `wedgelab case`: the built-in cases.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::PossibleValuesParser;
use report::terminal::TerminalTable;
use study::models::{self, AnyCase, case_keys};

use crate::failure::{Failure, Message};
use crate::folders;
use crate::select::select;

/// List the built-in cases, or print one as a case file
///
/// Without a name, lists the built-in cases in groups, with their titles and the features to look at in their
/// results. With one, prints that case as a complete, commented case file: change it, and run it with
/// `wedgelab run`. With --out and a pattern such as 'truck_*', writes each case that fits into a file of its
/// own.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab case
  wedgelab case vdrun_toe_0_psi_0 > a.toml && wedgelab run a.toml
  wedgelab case truck_vertical_variable --out cases
  wedgelab case --schema car > car.schema.json")]
pub struct Arguments {
    /// Name of a built-in case, or a beginning that only one has; with --out also a pattern
    name: Option<String>,
    /// Print the schema of a model's cases (JSON Schema)
    ///
    /// Editors complete and check case files by it. A printed case names its schema in the first line.
    #[arg(long, value_name = "MODEL", num_args = 0..=1, default_missing_value = "wedge")]
    #[arg(value_parser = PossibleValuesParser::new(case_keys().map(|(name, _)| name)))]
    #[arg(conflicts_with_all = ["name", "out"])]
    schema: Option<String>,
    /// Write it into this folder, as NAME.toml, instead of printing it
    #[arg(long, value_name = "DIR", requires = "name")]
    out: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long, requires = "out")]
    force: bool,
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut out = io::stdout().lock();
    if let Some(name) = &arguments.schema {
        let schema = case_keys().find(|(own, _)| own == name);
        let schema = schema.map(|(name, keys)| keys.schema(name));
        serde_json::to_writer_pretty(&mut out, &schema).map_err(io::Error::from)?;
        writeln!(out)?;
        return Ok(ExitCode::SUCCESS);
    }
    let Some(name) = &arguments.name else {
        for (index, group) in models::groups().enumerate() {
            let between = if index == 0 { "" } else { "\n" };
            writeln!(out, "{between}{}: {}", group.name, group.title)?;
            let mut table = TerminalTable::new(2, &[]);
            for case in &group.cases {
                table.row([format!("  {}", case.name), case.title.clone()]);
            }
            table.write(&mut out)?;
            for line in lines(group.look_at, WIDTH) {
                writeln!(out, "  {line}")?;
            }
        }
        return Ok(ExitCode::SUCCESS);
    };
    let names = select(std::slice::from_ref(name), models::built_in_names())?;
    if let ([first, .., last], None) = (names.as_slice(), &arguments.out) {
        let message = format!(
            "{} cases fit `{name}`, from {first} to {last}; one is printed",
            names.len()
        );
        let advice =
            format!("name one of them, or write each into a file: `wedgelab case '{name}' --out cases`");
        return Err(Message::new(message, advice).into());
    }
    for name in names {
        let case = AnyCase::built_in(name, &[])?;
        let text = case.and_then(|case| case.to_toml()).unwrap_or_default();
        let Some(folder) = &arguments.out else {
            out.write_all(text.as_bytes())?;
            continue;
        };
        let file = format!("{name}.toml");
        let folder = folders::check(folder, &[&file], arguments.force)?;
        folder.write(|files| files.add(&file, |out| out.write_all(text.as_bytes())))?;
        writeln!(out, "Written: {}.", folder.path().join(&file).display())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Width of the sentences below a group.
const WIDTH: usize = 110;

/// Returns a text in lines of at most so many signs, broken between words.
fn lines(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

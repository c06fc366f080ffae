//! `wedgelab man`: manual pages.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Command};
use clap_mangen::Man;

use crate::failure::Failure;
use crate::folders;

/// Write the manual pages of all commands
///
/// Writes a page a command, wedgelab.1, wedgelab-run.1, ..., into a folder: `man -l wedgelab-run.1` shows
/// one, and a folder man1 of the MANPATH makes `man wedgelab-run` find it.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab man --out ~/.local/share/man/man1")]
pub struct Arguments {
    /// Folder to write into
    #[arg(long, value_name = "DIR", default_value = "man1")]
    out: PathBuf,
    /// Overwrite existing pages
    #[arg(long)]
    force: bool,
}

/// Executes the command for the whole command line.
pub fn execute(arguments: &Arguments, mut whole: Command) -> Result<ExitCode, Failure> {
    whole.build();
    let mut pages = Vec::new();
    add(&whole, &mut pages)?;
    let names: Vec<&str> = pages.iter().map(|(name, _)| name.as_str()).collect();
    let folder = folders::check(&arguments.out, &names, arguments.force)?;
    folder.write(|files| {
        pages
            .iter()
            .try_for_each(|(name, page)| files.add(name, |out| out.write_all(page)))
    })?;
    writeln!(
        io::stdout().lock(),
        "Written into {}: {} pages.",
        folder.path().display(),
        names.len()
    )?;
    Ok(ExitCode::SUCCESS)
}

/// Adds the page of a command and those of the commands below it.
fn add(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) -> io::Result<()> {
    let mut page = Vec::new();
    let man = Man::new(command.clone());
    man.render(&mut page)?;
    pages.push((man.get_filename(), page));
    let visible = command.get_subcommands().filter(|below| !below.is_hide_set());
    visible
        .filter(|below| below.get_name() != "help")
        .try_for_each(|below| add(below, pages))
}

//! `wedgelab completions`: completions of a shell.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::failure::Failure;

/// Print completions of commands and options for a shell
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab completions bash > ~/.local/share/bash-completion/completions/wedgelab
  wedgelab completions zsh > ~/.zfunc/_wedgelab
  wedgelab completions fish > ~/.config/fish/completions/wedgelab.fish")]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

/// Executes the command for the whole command line.
pub fn execute(arguments: &Arguments, mut whole: Command) -> Result<ExitCode, Failure> {
    let name = whole.get_name().to_owned();
    let mut text = Vec::new();
    generate(arguments.shell, &mut whole, name, &mut text);
    io::stdout().lock().write_all(&text)?;
    Ok(ExitCode::SUCCESS)
}

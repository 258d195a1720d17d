//! What a shell and `man` want of an installed command: `fluisim completions` and `fluisim man`.

use std::io::Write;

use clap::{Args, Command};
use clap_complete::Shell;
use clap_mangen::Man;

use super::failure::Failure;
use super::to_stdout;

/// Write the completions of a shell to stdout.
///
/// Example: fluisim completions bash > ~/.local/share/bash-completion/completions/fluisim
#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Write a page for man to stdout.
///
/// Example: fluisim man sample > ~/.local/share/man/man1/fluisim-sample.1
#[derive(Debug, Args)]
pub(super) struct ManArgs {
    /// The command whose page it is; without it, that of fluisim as a whole
    command: Option<String>,
}

/// Writes the completions.
pub(super) fn completions(args: &CompletionsArgs, command: &mut Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    let name = command.get_name().to_owned();
    clap_complete::generate(args.shell, command, name, &mut script);
    to_stdout(std::io::stdout().write_all(&script))
}

/// Writes the page.
pub(super) fn man(args: &ManArgs, mut command: Command) -> Result<(), Failure> {
    command.build();
    let command = match &args.command {
        None => command,
        Some(name) => named(&command, name)?,
    };
    let mut page = Vec::new();
    to_stdout(Man::new(command).render(&mut page))?;
    to_stdout(std::io::stdout().write_all(&page))
}

/// One of the commands of `fluisim`.
fn named(all: &Command, name: &str) -> Result<Command, Failure> {
    let Some(command) = all.find_subcommand(name) else {
        let names: Vec<&str> = all.get_subcommands().map(Command::get_name).collect();
        return Err(Failure::usage(format!("man {name}: expected one of {}", names.join(", "))));
    };
    Ok(command.clone())
}

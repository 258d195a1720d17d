//! The command line of `fluisim`: words in, exit status out. The work is done elsewhere.

mod choices;
mod failure;
mod input;
mod install;
mod kernels;
mod parse;
mod progress;
mod results;
mod run;
mod sample;
mod sample_messages;
mod study;
mod study_words;
mod support;
mod surface;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::output;
use failure::Failure;

/// Smoothed Particle Hydrodynamics: fields and gradients out of particle files, and the kernels behind them.
///
/// Results go to stdout or to --out, messages and the progress bar to stderr. A file is written beside its target and renamed:
/// nothing is half-written, not even after Ctrl-C, and an existing file is kept unless --force is given. Numbers are printed so
/// that they read back to the same bits; the same input and options give the same bytes, whatever --threads.
///
/// Exit status: 0 success, 1 the input or the run is at fault, 2 wrong usage.
///
/// Example: fluisim sample demo:vortex --grid 256,256 --out vortex.png
#[derive(Debug, Parser)]
#[command(name = "fluisim", version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::RunArgs),
    Sample(Box<sample::SampleArgs>),
    Study(Box<study::StudyArgs>),
    Kernels(kernels::KernelsArgs),
    Completions(install::CompletionsArgs),
    Man(install::ManArgs),
}

/// Runs the command with the process's arguments: what `main` returns.
#[must_use]
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // help and version go to stdout and are a success; a closed pipe there is nobody's fault
            let _ = error.print();
            return ExitCode::from(error.exit_code() as u8);
        }
    };
    let done = prepare().and_then(|()| match cli.command {
        Command::Run(args) => run::run(args),
        Command::Sample(args) => sample::run(*args),
        Command::Study(args) => study::run(*args),
        Command::Kernels(args) => kernels::run(&args),
        Command::Completions(args) => install::completions(&args, &mut Cli::command()),
        Command::Man(args) => install::man(&args, Cli::command()),
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            say(&format!("error: {failure}"));
            ExitCode::from(failure.status())
        }
    }
}

fn prepare() -> Result<(), Failure> {
    output::cleanup_on_interrupt()
        .map_err(|error| Failure::input(format!("cannot watch for interrupts: {error}")))
}

/// One line on stderr. Where nobody can read it, there is nobody left to tell.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// The result of writing to stdout, where a reader that has gone away is no error.
fn to_stdout(written: std::io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::input(format!("cannot write to stdout: {error}")))
        }
        _ => Ok(()),
    }
}

//! The command line of `fluisim`: words in, exit status out. The work is done elsewhere.

mod kernels;
mod parse;
mod sample;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::failure::Failure;
use crate::output;

/// Smoothed Particle Hydrodynamics: fields and gradients out of particle files, and the kernels behind them.
///
/// Exit status: 0 success, 1 the input or the run is at fault, 2 wrong usage.
#[derive(Debug, Parser)]
#[command(name = "fluisim", version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Sample(Box<sample::SampleArgs>),
    Kernels(kernels::KernelsArgs),
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
        Command::Sample(args) => sample::run(*args),
        Command::Kernels(args) => kernels::run(&args),
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.status())
        }
    }
}

fn prepare() -> Result<(), Failure> {
    output::cleanup_on_interrupt()
        .map_err(|error| Failure::input(format!("cannot watch for interrupts: {error}")))
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

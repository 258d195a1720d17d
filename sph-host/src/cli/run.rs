//! `fluisim run`: words to [`Options`], summary to stdout.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::progress::Bar;
use super::{parse, to_stdout};
use crate::failure::Failure;
use crate::kernel_choice::KernelName;
use crate::run::{self, CaseName, Options, Solver};
use crate::scalar_choice::ScalarName;

/// Simulate a case and hold it against what is known of it.
///
/// Leaves in its directory summary.json, series.csv, particle frames frame_0000.vtu with frames.pvd for ParaView, pictures
/// frame_0000.png, animation.gif, and a plot against the reference (front.png for the dam break), and ends with a table.
/// Exit status 1 when the run failed, with --check also when it falls short of a goal.
///
/// Example: fluisim run dam-break --resolution 40 --out dam
#[derive(Debug, Args)]
pub(super) struct RunArgs {
    /// The case
    #[arg(value_enum, default_value_t = CaseName::DamBreak)]
    case: CaseName,
    /// Name the cases and what they show
    #[arg(long)]
    list: bool,
    /// How it is simulated; without it, pbf for tilt and wcsph for all others
    #[arg(long, value_enum)]
    solver: Option<Solver>,
    /// Dimensions; 3 for the dam break alone
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    dim: u8,
    /// Particles across the column, the depth, the radius, the period or the channel
    #[arg(long, value_name = "N")]
    resolution: Option<u32>,
    /// Seconds to simulate
    #[arg(long, value_name = "SECONDS", value_parser = parse::positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// The number type: f64 (without it) or f32 for wcsph, f32 (without it), fast32 or fixed point for pbf
    #[arg(long, value_enum)]
    scalar: Option<ScalarName>,
    /// The kernel of wcsph; without it, wendland-c2
    #[arg(long, value_enum)]
    kernel: Option<KernelName>,
    /// The directory of the results; without it, fluisim-CASE
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seconds from frame to frame; without it, a fiftieth of the time
    #[arg(long, value_name = "SECONDS", value_parser = parse::positive, allow_hyphen_values = true)]
    every: Option<f64>,
    /// Go on from the last complete frame in the directory
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Exit with status 1 when the run falls short of a goal
    #[arg(long)]
    check: bool,
    /// Threads; without it, one for each core. No bit of the result depends on it
    #[arg(long, value_name = "N", value_parser = parse::count)]
    threads: Option<usize>,
    /// Replace an earlier run in the directory
    #[arg(long)]
    force: bool,
    /// No progress bar
    #[arg(long)]
    quiet: bool,
}

/// Does what the words say.
pub(super) fn run(args: RunArgs) -> Result<(), Failure> {
    use std::io::Write;

    if args.list {
        let lines =
            CaseName::value_variants().iter().map(|case| format!("{:<14}{}\n", case.name(), case.about()));
        return to_stdout(std::io::stdout().write_all(lines.collect::<String>().as_bytes()));
    }
    let out = args.out.unwrap_or_else(|| PathBuf::from(format!("fluisim-{}", args.case.name())));
    let options = Options {
        case: args.case,
        solver: args.solver,
        dim: args.dim.into(),
        resolution: args.resolution,
        time: args.time,
        scalar: args.scalar,
        kernel: args.kernel,
        out,
        every: args.every,
        resume: args.resume,
        force: args.force,
        threads: args.threads,
    };
    let summary = run::run(&options, &Bar::new(args.quiet, "{bar:40} {percent} %, {eta} left"))?;
    to_stdout(std::io::stdout().write_all(summary.table().as_bytes()))?;
    if summary.escaped > 0 {
        return Err(Failure::input(format!("{} particles escaped", summary.escaped)));
    }
    match summary.checks.iter().find(|check| !check.holds()) {
        Some(check) if args.check => {
            let (name, value, goal) = (&check.name, check.value, check.goal);
            Err(Failure::input(format!("{name}: {value}, expected at most {goal}")))
        }
        _ => Ok(()),
    }
}

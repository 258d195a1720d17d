//! `fluisim run`: words to [`Options`] and [`Output`], summary to stdout, errors to messages that name the option to change.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;

use super::failure::Failure;
use super::progress::Bar;
use super::{parse, say, to_stdout};
use crate::kernel_choice::KernelName;
use crate::run::{self, CaseName, Earlier, Error, Options, Output, Solver, either};
use crate::scalar_choice::ScalarName;

/// Simulate a case and measure it against what is known of it.
///
/// Leaves in its directory summary.json, series.csv, particle frames frame_0000.vtu with frames.pvd for ParaView, pictures
/// frame_0000.png, animation.gif, and a plot against the reference (front.png for the dam break), and ends with a table.
/// A goal whose time the run does not reach is not measured.
///
/// Exit status 1 when the run failed; with --check, also when something that was measured falls short of its goal.
///
/// Example: fluisim run dam-break --resolution 40 --out dam
#[derive(Debug, Args)]
pub(super) struct RunArgs {
    /// The case; without it, that of the run that is resumed, else dam-break
    #[arg(value_enum)]
    case: Option<CaseName>,
    /// Name the cases and what they show
    #[arg(long)]
    list: bool,
    #[arg(long, value_enum, help = solver_help())]
    solver: Option<Solver>,
    #[arg(long, help = dim_help())]
    dim: Option<usize>,
    #[arg(long, value_name = "N", help = resolution_help(), allow_hyphen_values = true)]
    resolution: Option<u32>,
    /// Seconds to simulate; without it, the case's own
    #[arg(long, value_name = "SECONDS", value_parser = parse::positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// The number type: f64 (without it) or f32 for wcsph, f32 (without it) or f64 for incompressible, f32 (without it), fast32 or
    /// fixed point for pbf
    #[arg(long, value_name = "TYPE", value_parser = parse::scalar)]
    scalar: Option<ScalarName>,
    /// The kernel of wcsph and incompressible; without it, wendland-c2
    #[arg(long, value_enum)]
    kernel: Option<KernelName>,
    /// The directory of the results; without it, fluisim-CASE
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Seconds from frame to frame; without it, a fiftieth of the time
    #[arg(long, value_name = "SECONDS", value_parser = parse::positive, allow_hyphen_values = true)]
    every: Option<f64>,
    /// Go on from the last whole frame in the directory, with the options of that run for those not given; --time may be longer
    #[arg(long, conflicts_with = "force")]
    resume: bool,
    /// Draw no pictures: no frame_0000.png, no animation and no plot. --resume without it draws them later
    #[arg(long)]
    no_pictures: bool,
    /// Exit with status 1 when something that was measured falls short of its goal
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

/// The cases of which something is so.
fn cases(is_so: impl Fn(CaseName) -> bool) -> String {
    let names: Vec<_> = CaseName::ALL.iter().filter(|&&case| is_so(case)).collect();
    either(&names).replace(" or ", " and ")
}

fn solver_help() -> String {
    let usual = Solver::ALL[0];
    let of_solver = |solver: Solver| {
        let forms = CaseName::ALL.iter().flat_map(|case| {
            let dimensions =
                case.dimensions().into_iter().filter(move |&dim| case.solver(dim) == Some(solver));
            dimensions.map(move |dim| match case.dimensions().len() {
                1 => case.to_string(),
                _ => format!("{case} in {dim}-D"),
            })
        });
        let forms: Vec<String> = forms.collect();
        (!forms.is_empty()).then(|| format!("{solver} for {}", forms.join(" and ")))
    };
    let others: Vec<String> = Solver::ALL[1..].iter().copied().filter_map(of_solver).collect();
    format!("How it is simulated; without it, {}, else {usual}", others.join(", "))
}

fn dim_help() -> String {
    format!("Dimensions: 2 (without it), or 3 for {}", cases(|case| case.dimensions().contains(&3)))
}

fn resolution_help() -> String {
    let [[least, most], [_, most_3d]] = [2, 3].map(run::resolutions);
    let mut lengths: Vec<&str> = Vec::new();
    for case in CaseName::ALL {
        if !lengths.contains(&case.across()) {
            lengths.push(case.across());
        }
    }
    let usual = CaseName::ALL.iter().flat_map(|case| {
        case.dimensions().into_iter().filter_map(move |dim| {
            let suffix = if dim == 3 { " in three dimensions" } else { "" };
            case.resolution(dim).map(|usual| format!("{usual} for {case}{suffix}"))
        })
    });
    format!(
        "Particles across {}: {least} to {most}, in three dimensions to {most_3d}; without it, {}",
        either(&lengths),
        usual.collect::<Vec<_>>().join(", ")
    )
}

/// Simulates what the words say, and prints the table.
pub(super) fn run(args: RunArgs) -> Result<(), Failure> {
    if args.list {
        let lines = CaseName::ALL.iter().map(|case| format!("{:<14}{}\n", case.name(), case.about()));
        return to_stdout(std::io::stdout().write_all(lines.collect::<String>().as_bytes()));
    }
    let usual = || PathBuf::from(format!("fluisim-{}", args.case.unwrap_or(CaseName::ALL[0])));
    let output = Output {
        directory: args.out.clone().unwrap_or_else(usual),
        earlier: match (args.resume, args.force) {
            (true, _) => Earlier::Resume,
            (_, true) => Earlier::Replace,
            _ => Earlier::Keep,
        },
        pictures: !args.no_pictures,
    };
    let options = Options {
        case: args.case,
        solver: args.solver,
        dim: args.dim,
        resolution: args.resolution,
        time: args.time,
        scalar: args.scalar,
        kernel: args.kernel,
        every: args.every,
        threads: args.threads,
    };
    let bar = Bar::new(args.quiet, "{bar:40} {percent} %, {left}");
    let summary = run::run(&options, &output, &bar).map_err(failure)?;
    to_stdout(std::io::stdout().write_all(summary.table().as_bytes()))?;
    if summary.escaped > 0 {
        return Err(Failure::input(format!("{} particles escaped", summary.escaped)));
    }
    if !args.check {
        return Ok(());
    }
    let unmeasured = summary.checks.iter().filter(|check| check.value.is_none()).count();
    if unmeasured > 0 {
        let all = summary.checks.len();
        say(&format!("note: {unmeasured} of {all} goals were not measured: the run ended before their time"));
    }
    match summary.short().next() {
        Some(check) => {
            let (name, value, goal) = (&check.name, check.value.unwrap_or(f64::NAN), check.goal);
            Err(Failure::input(format!("{name}: {value}, expected at most {goal}")))
        }
        None => Ok(()),
    }
}

/// The error with the option to change, and whether the words or the files and the run are at fault.
fn failure(error: Error) -> Failure {
    match &error {
        Error::Resolution { found, least, most } => {
            Failure::usage(format!("--resolution {found}: expected {least} to {most}"))
        }
        Error::Dimensions { found, .. } => Failure::usage(format!("--dim {found}: {error}")),
        Error::TooFewFrames { every, time } => {
            Failure::usage(format!("--every {every}: longer than the {time} s simulated, which --time sets"))
        }
        Error::TooManyFrames { every, time, most } => Failure::usage(format!(
            "--every {every}: more than {most} frames in the {time} s simulated, which --time sets"
        )),
        Error::SolverForCase { solver, .. } => Failure::usage(format!("--solver {solver}: {error}")),
        Error::ScalarForSolver { scalar, .. } | Error::BoxTooLarge { scalar, .. } => {
            Failure::usage(format!("--scalar {}: {error}", scalar.name()))
        }
        Error::KernelForSolver { kernel, .. } => {
            Failure::usage(format!("--kernel {}: {error}", kernel.name()))
        }
        Error::NotADirectory(path) => {
            Failure::input(format!("--out {}: is a file, expected a directory", path.display()))
        }
        Error::InUse { .. } => {
            Failure::input(format!("{error}; wait for its end, or take another directory with --out"))
        }
        Error::Taken(_) => {
            Failure::input(format!("{error}; use --resume to go on with it, --force to replace it"))
        }
        Error::OtherRun { parameter, .. } => {
            let option = if *parameter == "case" { "the case".into() } else { format!("--{parameter}") };
            Failure::input(format!(
                "{error}; leave {option} out to go on as it was, or use --force to start anew"
            ))
        }
        Error::UnknownRun(_) => Failure::input(format!("{error}; use --force to start anew")),
        Error::Threads { threads: Some(threads), .. } => {
            Failure::input(format!("--threads {threads}: {error}"))
        }
        Error::Read(_) => {
            Failure::input(format!("{error}; --resume without that file goes on from the frame before it"))
        }
        _ => Failure::input(error.to_string()),
    }
}

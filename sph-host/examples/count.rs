//! Instructions a particle or a point of the fast path with AVX2, counted by valgrind, against those of
//! `docs/instructions.txt`: `just count`. Unlike times, they are the same on every run, so a vector loop that has silently
//! become a scalar one shows on any machine.
//!
//! `count` compares and fails where a job needs over 2 % more; `count --update` writes the table anew. `count JOB` does
//! one job: what valgrind is told to run.

use std::path::Path;
use std::process::{Command, ExitCode};

use sph_core::Uniform;
use sph_core::kernel::CubicSpline;
use sph_host::fast::{InstructionSet, NeighbourLists, SortedCells};

/// Particles along an edge of the cube.
const SIDE: usize = 24;
/// What a count may exceed that of the table by.
const TOLERANCE: f64 = 0.02;
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/instructions.txt");
const JOBS: [&str; 6] = ["sort", "J1", "J1-masses", "J2-value", "J2-gradient", "J4"];

fn main() -> ExitCode {
    match std::env::args().nth(1).as_deref() {
        None => compare(),
        Some("--update") => update(),
        Some(job) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
            pool.install(|| run(job));
            ExitCode::SUCCESS
        }
    }
}

/// Counts all jobs and prints them beside the table's counts.
fn compare() -> ExitCode {
    let table = std::fs::read_to_string(TABLE).expect("docs/instructions.txt");
    let expected = |job: &str| -> Option<f64> {
        table.lines().find_map(|line| line.strip_prefix(job)?.strip_prefix(' ')?.trim().parse().ok())
    };
    let mut worse = Vec::new();
    for job in JOBS {
        let (found, expected) = (count(job), expected(job).expect("a line for each job in the table"));
        println!("{job:12} {found:8.1}   table {expected:8.1}   {:+5.1} %", 100.0 * (found / expected - 1.0));
        if found > expected * (1.0 + TOLERANCE) {
            worse.push(job);
        }
    }
    if worse.is_empty() {
        return ExitCode::SUCCESS;
    }
    eprintln!("more instructions than in docs/instructions.txt: {}", worse.join(", "));
    eprintln!("where that is right, write the table anew: just count --update");
    ExitCode::FAILURE
}

fn update() -> ExitCode {
    let lines: String = JOBS.iter().map(|job| format!("{job:12} {:8.1}\n", count(job))).collect();
    print!("{lines}");
    std::fs::write(TABLE, lines).expect("docs/instructions.txt can be written");
    ExitCode::SUCCESS
}

/// Instructions a particle within [`measured`].
fn count(job: &str) -> f64 {
    let program = std::env::current_exe().expect("the path of this program");
    let out = Path::new("/dev/null").display();
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--toggle-collect=*measured*", &format!("--callgrind-out-file={out}")]);
    let output = command.arg(program).arg(job).output().expect("valgrind is installed");
    let said = String::from_utf8_lossy(&output.stderr);
    let collected =
        said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse::<f64>().ok());
    match collected {
        Some(count) if output.status.success() => count / SIDE.pow(3) as f64,
        _ => panic!("valgrind failed: {said}"),
    }
}

/// Does a job on a lattice where every coordinate is jittered by up to a fifth of the spacing.
fn run(job: &str) {
    let mut random = 12345_u64;
    let mut jitter = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.4 * ((random >> 40) as f32 / (1 << 24) as f32 - 0.5)
    };
    let positions: Vec<[f32; 3]> = (0..SIDE.pow(3))
        .map(|i| [i / (SIDE * SIDE), i / SIDE % SIDE, i % SIDE].map(|k| k as f32 + 0.5 + jitter()))
        .collect();
    let sort = || SortedCells::sort(&positions, 2.6).expect("a set").at_level(InstructionSet::Avx2);
    let cells = sort();
    let numbers: Vec<f32> = positions.iter().map(|x| 1.0 + 0.1 * x[0]).collect();
    let fields = cells.fields(&[&numbers]).expect("coefficients");
    let mut lists = NeighbourLists::new();
    match job {
        "sort" => drop(measured(sort)),
        "J1" => drop(measured(|| cells.density::<CubicSpline>(Uniform(1.0)))),
        "J1-masses" => drop(measured(|| cells.density::<CubicSpline>(&numbers[..]))),
        "J2-value" => drop(measured(|| fields.at::<CubicSpline>(&positions, false))),
        "J2-gradient" => drop(measured(|| fields.at::<CubicSpline>(&positions, true))),
        "J4" => measured(|| cells.neighbour_lists(&mut lists)),
        _ => panic!("no such job: {job}"),
    }
}

/// What is counted.
#[inline(never)]
fn measured<R>(job: impl FnOnce() -> R) -> R {
    std::hint::black_box(job())
}

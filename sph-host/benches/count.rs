//! Instructions a particle, a point or a particle-step with AVX2, counted by valgrind, against those of
//! `docs/instructions.txt`: `just count`. Unlike times, they are the same on every run, so a vector loop that has silently
//! become a scalar one shows on any machine.
//!
//! `count` compares and fails where a job needs over 2 % more; `count --update` writes the table anew. `count JOB` does
//! one job: what valgrind is told to run.

use std::path::Path;
use std::process::{Command, ExitCode};

use sph_core::Uniform;
use sph_core::kernel::CubicSpline;
use sph_host::Tank;
use sph_host::fast::{InstructionSet, NeighbourLists, SortedCells};

/// Particles along an edge of the cube.
const SIDE: usize = 24;
/// What a count may exceed that of the table by.
const TOLERANCE: f64 = 0.02;
const AVX2: InstructionSet = InstructionSet::Avx2;
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/instructions.txt");
const JOBS: [&str; 11] = [
    "sort",
    "J1",
    "J1-f64",
    "J1-masses",
    "J2-value",
    "J2-gradient",
    "J4",
    STEP_F32_3D,
    STEP_F64_2D,
    INCOMPRESSIBLE_F32_3D,
    INCOMPRESSIBLE_F32_2D,
];
/// A step of the weakly compressible fluid.
const STEP_F32_3D: &str = "step-f32-3d";
const STEP_F64_2D: &str = "step-f64-2d";
/// A step of the incompressible fluid, as many iterations as it takes.
const INCOMPRESSIBLE_F32_3D: &str = "incompressible-f32-3d";
const INCOMPRESSIBLE_F32_2D: &str = "incompressible-f32-2d";

fn main() -> ExitCode {
    // cargo adds --bench
    match std::env::args().skip(1).find(|word| word != "--bench").as_deref() {
        None => compare(),
        Some("--update") => update(),
        Some(job) => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
            println!("{}", pool.install(|| run(job)));
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
        println!("{job:22} {found:8.1}   table {expected:8.1}   {:+5.1} %", 100.0 * (found / expected - 1.0));
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
    let lines: String = JOBS.iter().map(|job| format!("{job:22} {:8.1}\n", count(job))).collect();
    print!("{lines}");
    std::fs::write(TABLE, lines).expect("docs/instructions.txt can be written");
    ExitCode::SUCCESS
}

/// Instructions within [`measured`], divided by what the job prints.
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
        Some(count) if output.status.success() => {
            let units = String::from_utf8_lossy(&output.stdout);
            count / units.trim().parse::<f64>().expect("a number of particles, points or particle-steps")
        }
        _ => panic!("valgrind failed: {said}"),
    }
}

/// Does a job; returns for how many particles, points or particle-steps.
fn run(job: &str) -> usize {
    match job {
        STEP_F32_3D => steps(&mut Tank::<3>::weakly_compressible::<f32>(12, AVX2).expect("a tank"), 0.02),
        STEP_F64_2D => steps(&mut Tank::<2>::weakly_compressible::<f64>(32, AVX2).expect("a tank"), 0.01),
        INCOMPRESSIBLE_F32_3D => {
            steps(&mut Tank::<3>::incompressible::<f32>(12, AVX2).expect("a tank"), 0.06)
        }
        INCOMPRESSIBLE_F32_2D => {
            steps(&mut Tank::<2>::incompressible::<f32>(32, AVX2).expect("a tank"), 0.06)
        }
        _ => run_on_lattice(job),
    }
}

/// Steps of the fluid: enough for neighbours to be listed anew.
fn steps<const D: usize>(tank: &mut Tank<D>, seconds: f64) -> usize {
    let steps = measured(|| tank.advance(seconds)).expect("steps");
    steps as usize * tank.particles()
}

/// Does a job on a lattice where every coordinate is jittered by up to a fifth of the spacing.
fn run_on_lattice(job: &str) -> usize {
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
        "J1-f64" => {
            let wide: Vec<[f64; 3]> = positions.iter().map(|x| x.map(f64::from)).collect();
            let cells = SortedCells::sort(&wide, 2.6).expect("a set").at_level(InstructionSet::Avx2);
            drop(measured(|| cells.density::<CubicSpline>(Uniform(1.0))));
        }
        "J1-masses" => drop(measured(|| cells.density::<CubicSpline>(&numbers[..]))),
        "J2-value" => drop(measured(|| fields.at::<CubicSpline>(&positions, false))),
        "J2-gradient" => drop(measured(|| fields.at::<CubicSpline>(&positions, true))),
        "J4" => measured(|| cells.neighbour_lists(&mut lists)),
        _ => panic!("no such job: {job}"),
    }
    positions.len()
}

/// What is counted.
#[inline(never)]
fn measured<R>(job: impl FnOnce() -> R) -> R {
    std::hint::black_box(job())
}

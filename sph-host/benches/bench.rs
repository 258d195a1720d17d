//! The fast path's jobs on jittered lattices, in nanoseconds a particle or a point, and a step of the fluid: `just bench`.
//!
//! `bench [SIDE [THREADS]]`: SIDE³ particles, 100 unless told, and sets of 1,000 and 10,000. Each job runs with AVX2 and with the
//! best instruction set of the processor. Where the environment's `RUST_PEERS` names the program that runs splashsurf_lib on the
//! data in `SPH_PEERS_DATA`, that runs as well, in the same sitting, and the table has the ratios.
//!
//! Minimum of some repetitions; each job as a user would call it, from unsorted particles to results in their order.

use std::process::Command;
use std::time::Instant;

use sph_core::Uniform;
use sph_core::kernel::CubicSpline;
use sph_host::Tank;
use sph_host::fast::{InstructionSet, NeighbourLists, RadiusOctaves, Real, SortedCells};

fn main() {
    // cargo adds --bench
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let number = |place: usize, otherwise| {
        words.get(place).map_or(Ok(otherwise), |word| word.parse()).expect("a number was expected")
    };
    let (side, threads) = (number(0, 100), number(1, 1));
    let mut levels = vec![InstructionSet::Avx2.min(InstructionSet::best()), InstructionSet::best()];
    levels.dedup();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    println!("{threads} threads; nanoseconds a particle, a point or a particle-step");
    print!("{:50}", "");
    levels.iter().for_each(|level| print!(" {:>9}", format!("{level:?}")));
    println!();
    let flat = (side as f64).powf(1.5).round() as usize;
    pool.install(|| {
        let set = |counts| Set { counts, levels: levels.clone(), threads };
        set([side; 3]).all();
        set([10; 3]).small();
        set([20, 20, 25]).small();
        Set { counts: [flat; 2], levels: levels.clone(), threads }.small();
        Set { counts: [100; 2], levels: levels.clone(), threads }.small();
        steps::<f32, 3>("f32, 3-D", &levels, &[10, 24, 48]);
        steps::<f64, 3>("f64, 3-D", &levels, &[24]);
        steps::<f32, 2>("f32, 2-D", &levels, &[120]);
        steps::<f64, 2>("f64, 2-D", &levels, &[32, 120, 320]);
    });
}

/// Steps of the fluid in tanks that are so many particles wide.
fn steps<T: Real, const D: usize>(what: &str, levels: &[InstructionSet], sides: &[u32]) {
    for &side in sides {
        let times = levels.iter().map(|&level| {
            let mut tank = Tank::<D>::weakly_compressible::<T>(side, level).expect("a tank");
            // some 40 steps each time
            let seconds = 0.25 / f64::from(side);
            let runs = (0..4).map(|_| {
                let start = Instant::now();
                let steps = tank.advance(seconds).expect("steps");
                start.elapsed().as_secs_f64() * 1e9 / (tank.particles() as f64 * steps as f64)
            });
            runs.fold(f64::INFINITY, f64::min)
        });
        line(&format!("step of the fluid {what}, {} particles", side.pow(D as u32)), times, None);
    }
}

/// One line: a time for each instruction set, and the ratio to the peer where it is installed.
fn line(name: &str, times: impl Iterator<Item = f64>, peer: Option<f64>) {
    let times: Vec<f64> = times.collect();
    print!("{name:50}");
    times.iter().for_each(|time| print!(" {time:9.1}"));
    if let Some(peer) = peer {
        print!("   splashsurf {peer:8.1}:");
        times.iter().for_each(|time| print!(" {:5.1} times", peer / time));
    }
    println!();
}

/// The lattice in a box one long along its first axis, and how it is treated.
struct Set<const D: usize> {
    counts: [usize; D],
    levels: Vec<InstructionSet>,
    threads: usize,
}

impl Set<3> {
    /// Every job.
    fn all(&self) {
        let sorted = self.positions::<f32>(false);
        self.densities::<f32>("J1 density f32", &sorted, Some(("splash_j1_f32", "J1 total")));
        self.densities::<f32>("J1 density f32, shuffled", &self.positions(true), None);
        self.densities::<f64>("J1 density f64", &self.positions(false), Some(("splash_j1_f64", "J1 total")));
        self.lists(&sorted);
        self.fields("sorted", &sorted);
        self.fields("shuffled", &self.positions(true));
        self.own_radii(&sorted);
    }
}

impl<const D: usize> Set<D> {
    /// The jobs that are of interest where there are few particles, or in the plane.
    fn small(&self) {
        let what = format!("{}-D, {} particles", D, self.len());
        self.densities::<f32>(&format!("J1 density f32, {what}"), &self.positions(false), None);
        self.densities::<f64>(&format!("J1 density f64, {what}"), &self.positions(false), None);
        let positions = self.positions::<f32>(false);
        let coefficients = vec![self.volume() as f32; positions.len()];
        for (name, gradient) in [("value", false), ("value and gradient", true)] {
            let times = self.levels.iter().map(|&level| {
                let cells = self.cells(&positions, level);
                let fields = cells.fields(&[&coefficients]).expect("coefficients");
                best(self.len(), || fields.at::<CubicSpline>(&positions, gradient))
            });
            line(&format!("J2 {name} f32, {what}"), times, None);
        }
    }

    fn len(&self) -> usize {
        self.counts.iter().product()
    }

    fn spacing(&self) -> f64 {
        1.0 / self.counts[0] as f64
    }

    fn volume(&self) -> f64 {
        self.spacing().powi(D as i32)
    }

    fn radius<T: Real>(&self) -> T {
        T::from_f64(2.6 * self.spacing())
    }

    /// Every coordinate jittered by up to a fifth of the spacing.
    fn positions<T: Real>(&self, shuffled: bool) -> Vec<[T; D]> {
        let mut random = Random(12345);
        let position = |mut number: usize| {
            let mut x = [T::ZERO; D];
            for axis in (0..D).rev() {
                let k = (number % self.counts[axis]) as f64;
                number /= self.counts[axis];
                x[axis] = T::from_f64((k + 0.5 + 0.4 * (random.next() - 0.5)) * self.spacing());
            }
            x
        };
        let mut positions: Vec<[T; D]> = (0..self.len()).map(position).collect();
        if shuffled {
            for i in (1..positions.len()).rev() {
                positions.swap(i, (random.next() * (i + 1) as f64) as usize);
            }
        }
        positions
    }

    fn cells<T: Real>(&self, positions: &[[T; D]], level: InstructionSet) -> SortedCells<T, D> {
        SortedCells::sort(positions, self.radius()).expect("a set").at_level(level)
    }

    fn densities<T: Real>(&self, name: &str, positions: &[[T; D]], peer: Option<(&str, &str)>) {
        let mass = Uniform(T::from_f64(1000.0 * self.volume()));
        let times = self.levels.iter().map(|&level| {
            best(positions.len(), || self.cells(positions, level).density::<CubicSpline>(mass))
        });
        line(name, times, peer.and_then(|(job, line)| self.peer(job, line)));
    }

    /// What the peer says of a job: the number after `ns/particle=` in the line that has these words.
    fn peer(&self, job: &str, line: &str) -> Option<f64> {
        let program = std::env::var_os("RUST_PEERS")?;
        let mut command = Command::new(program);
        command.args([job, "1M", "3"]).env("RAYON_NUM_THREADS", self.threads.to_string());
        let said = String::from_utf8(command.output().ok()?.stdout).ok()?;
        let (_, rest) = said.lines().find(|said| said.contains(line))?.split_once("ns/particle=")?;
        rest.split_whitespace().next()?.parse().ok()
    }
}

impl Set<3> {
    fn lists(&self, positions: &[[f32; 3]]) {
        let mut lists = NeighbourLists::new();
        let times = self
            .levels
            .iter()
            .map(|&level| best(positions.len(), || self.cells(positions, level).neighbour_lists(&mut lists)));
        line("J4 neighbour lists f32", times, self.peer("splash_j1_f32", "J4"));
    }

    fn fields(&self, order: &str, positions: &[[f32; 3]]) {
        let field: Vec<f32> =
            positions.iter().map(|[x, y, z]| (6.3 * x).sin() * (6.3 * y).cos() + z).collect();
        let volume = self.volume() as f32;
        let coefficients: Vec<f32> = field.iter().map(|a| a * volume).collect();
        let mut random = Random(99);
        let scattered: Vec<[f32; 3]> = (0..100_000).map(|_| [(); 3].map(|()| random.next() as f32)).collect();
        let grid: Vec<[f32; 3]> = (0..64 * 64 * 64)
            .map(|i| [i % 64, i / 64 % 64, i / 4096].map(|k| (k as f32 + 0.5) / 64.0))
            .collect();
        for (place, points, peer) in [("random", &scattered, "M=100k plain"), ("grid", &grid, "grid64 plain")]
        {
            for (what, gradient) in [("value", false), ("value and gradient", true)] {
                let times = self.levels.iter().map(|&level| {
                    let cells = self.cells(positions, level);
                    let fields = cells.fields(&[&coefficients]).expect("coefficients");
                    best(points.len(), || fields.at::<CubicSpline>(points, gradient))
                });
                let peer =
                    if order == "sorted" && !gradient { self.peer("splash_j2_f32", peer) } else { None };
                line(&format!("J2 {place}, {what}, {order}"), times, peer);
            }
        }
    }

    /// Radii over a factor of 30, most of them small, as in a set that is refined somewhere.
    fn own_radii(&self, positions: &[[f32; 3]]) {
        let radii: Vec<f32> = (0..positions.len())
            .map(|i| self.radius::<f32>() * if i % 27_000 == 0 { 30.0 } else { 1.0 + (i % 7) as f32 / 20.0 })
            .collect();
        let masses = vec![1.0; positions.len()];
        let times = self.levels.iter().map(|&level| {
            best(positions.len(), || {
                let octaves = RadiusOctaves::sort(positions, &radii)?.at_level(level);
                octaves.fields(&[&masses])?.at::<CubicSpline>(positions, false)
            })
        });
        line("J1 a radius each, 1:30", times, None);
    }
}

/// Nanoseconds of the fastest of some runs, divided by `count`: more runs where there is little to do.
fn best<R>(count: usize, mut job: impl FnMut() -> R) -> f64 {
    let repetitions = (200_000 / count).clamp(4, 50);
    let runs = (0..repetitions).map(|_| {
        let start = Instant::now();
        std::hint::black_box(job());
        start.elapsed().as_secs_f64()
    });
    runs.fold(f64::INFINITY, f64::min) * 1e9 / count as f64
}

/// Numbers in [0, 1), the same every time (a multiplicative congruential sequence).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

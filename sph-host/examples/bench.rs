//! The fast path's jobs on a jittered lattice, in nanoseconds a particle or a point: `just bench`.
//!
//! `bench [SIDE [THREADS [LEVEL]]]`: SIDE³ particles, 100 unless told; LEVEL baseline, avx2 or avx512, the best unless
//! told. Where the environment's `RUST_PEERS` names the program that runs splashsurf_lib on the data in
//! `SPH_PEERS_DATA`, that runs as well, in the same sitting, and the table has the ratio.
//!
//! Minimum of some repetitions; each job as a user would call it, from unsorted particles to results in their order.

use std::process::Command;
use std::time::Instant;

use sph_core::Uniform;
use sph_core::kernel::CubicSpline;
use sph_host::fast::{InstructionSet, NeighbourLists, RadiusOctaves, Real, SortedCells};

/// Repetitions, of which the fastest counts.
const REPETITIONS: usize = 4;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize, otherwise| {
        words.get(place).map_or(Ok(otherwise), |word| word.parse()).expect("a number was expected")
    };
    let (side, threads) = (number(0, 100), number(1, 1));
    let level = match words.get(2).map(String::as_str) {
        Some("baseline") => InstructionSet::Baseline,
        Some("avx2") => InstructionSet::Avx2,
        _ => InstructionSet::best(),
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    println!("{} particles, {threads} threads, {level:?}; nanoseconds a particle or a point", side.pow(3));
    let set = Set { side, level, threads };
    pool.install(|| {
        set.densities::<f32>("J1 density f32", &set.positions(false), Some(("splash_j1_f32", "J1 total")));
        set.densities::<f32>("J1 density f32, shuffled", &set.positions(true), None);
        set.densities::<f64>("J1 density f64", &set.positions(false), Some(("splash_j1_f64", "J1 total")));
        set.lists(&set.positions(false));
        set.fields("sorted", &set.positions(false));
        set.fields("shuffled", &set.positions(true));
        set.own_radii(&set.positions(false));
    });
}

/// The lattice in the unit cube, and how it is treated.
struct Set {
    side: usize,
    level: InstructionSet,
    threads: usize,
}

impl Set {
    fn spacing(&self) -> f64 {
        1.0 / self.side as f64
    }

    fn radius<T: Real>(&self) -> T {
        T::from_f64(2.6 * self.spacing())
    }

    /// Every coordinate jittered by up to a fifth of the spacing.
    fn positions<T: Real>(&self, shuffled: bool) -> Vec<[T; 3]> {
        let mut random = Random(12345);
        let side = self.side;
        let mut positions: Vec<[T; 3]> = (0..side.pow(3))
            .map(|i| {
                [i / (side * side), i / side % side, i % side]
                    .map(|k| T::from_f64((k as f64 + 0.5 + 0.4 * (random.next() - 0.5)) * self.spacing()))
            })
            .collect();
        if shuffled {
            for i in (1..positions.len()).rev() {
                positions.swap(i, (random.next() * (i + 1) as f64) as usize);
            }
        }
        positions
    }

    fn cells<T: Real>(&self, positions: &[[T; 3]]) -> SortedCells<T, 3> {
        SortedCells::sort(positions, self.radius()).expect("a set").at_level(self.level)
    }

    fn densities<T: Real>(&self, name: &str, positions: &[[T; 3]], peer: Option<(&str, &str)>) {
        let mass = Uniform(T::from_f64(1000.0 * self.spacing().powi(3)));
        let time = best(positions.len(), || self.cells(positions).density::<CubicSpline>(mass));
        self.report(name, time, peer);
    }

    fn lists(&self, positions: &[[f32; 3]]) {
        let mut lists = NeighbourLists::new();
        let time = best(positions.len(), || self.cells(positions).neighbour_lists(&mut lists));
        self.report("J4 neighbour lists f32", time, Some(("splash_j1_f32", "J4")));
    }

    fn fields(&self, order: &str, positions: &[[f32; 3]]) {
        let field: Vec<f32> =
            positions.iter().map(|[x, y, z]| (6.3 * x).sin() * (6.3 * y).cos() + z).collect();
        let volume = self.spacing().powi(3) as f32;
        let coefficients: Vec<f32> = field.iter().map(|a| a * volume).collect();
        let cells = self.cells(positions);
        let fields = cells.fields(&[&coefficients]).expect("coefficients");
        let mut random = Random(99);
        let scattered: Vec<[f32; 3]> = (0..100_000).map(|_| [(); 3].map(|()| random.next() as f32)).collect();
        let grid: Vec<[f32; 3]> = (0..64 * 64 * 64)
            .map(|i| [i % 64, i / 64 % 64, i / 4096].map(|k| (k as f32 + 0.5) / 64.0))
            .collect();
        for (place, points, peer) in [("random", &scattered, "M=100k plain"), ("grid", &grid, "grid64 plain")]
        {
            for (what, gradient) in [("value", false), ("value and gradient", true)] {
                let time = best(points.len(), || fields.at::<CubicSpline>(points, gradient));
                let peer = (order == "sorted" && !gradient).then_some(("splash_j2_f32", peer));
                self.report(&format!("J2 {place}, {what}, {order}"), time, peer);
            }
        }
    }

    /// Radii over a factor of 30, most of them small, as in a set that is refined somewhere.
    fn own_radii(&self, positions: &[[f32; 3]]) {
        let radii: Vec<f32> = (0..positions.len())
            .map(|i| self.radius::<f32>() * if i % 27_000 == 0 { 30.0 } else { 1.0 + (i % 7) as f32 / 20.0 })
            .collect();
        let masses = vec![1.0; positions.len()];
        let time = best(positions.len(), || {
            let levels = RadiusOctaves::sort(positions, &radii)?.at_level(self.level);
            levels.fields(&[&masses])?.at::<CubicSpline>(positions, false)
        });
        self.report("J1 a radius each, 1:30", time, None);
    }

    /// One line, and the ratio to the peer where it is installed.
    fn report(&self, name: &str, time: f64, peer: Option<(&str, &str)>) {
        match peer.and_then(|(job, line)| self.peer(job, line)) {
            Some(theirs) => {
                println!("{name:45} {time:8.1}   splashsurf {theirs:8.1}   {:5.1} times", theirs / time)
            }
            None => println!("{name:45} {time:8.1}"),
        }
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

/// Nanoseconds of the fastest run, divided by `count`.
fn best<R>(count: usize, mut job: impl FnMut() -> R) -> f64 {
    let runs = (0..REPETITIONS).map(|_| {
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

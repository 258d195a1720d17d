//! What the tests and the example of the position-based fluid measure.

use sph_core::fluid::{OpenBox, Particle, PositionBasedFluid, Settings};
use sph_core::kernel::{Kernel, Poly6, normalisation};
use sph_core::scalar::compact::Compact;

/// The spacing of particles at rest.
const SPACING: f64 = 0.5;

/// Positions and velocities as f64.
pub(crate) struct State {
    /// Positions in h.
    pub(crate) positions: Vec<[f64; 2]>,
    /// Velocities in h a frame.
    pub(crate) velocities: Vec<[f64; 2]>,
}

/// The particles' state.
pub(crate) fn state<T: Compact>(particles: &[Particle<T, 2>]) -> State {
    State {
        positions: particles.iter().map(|p| p.position().map(T::to_f64)).collect(),
        velocities: particles.iter().map(|p| p.velocity().map(T::to_f64)).collect(),
    }
}

/// The mean of vectors.
pub(crate) fn mean(values: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| values.iter().map(|v| v[axis]).sum::<f64>() / values.len() as f64)
}

impl State {
    fn distance(&self, i: usize, j: usize) -> f64 {
        let [a, b] = [self.positions[i], self.positions[j]];
        (a[0] - b[0]).hypot(a[1] - b[1])
    }

    /// The distance of each particle to its nearest neighbour over the spacing at rest, ascending.
    pub(crate) fn spacings(&self) -> Vec<f64> {
        let n = self.positions.len();
        let nearest =
            |i| (0..n).filter(|&j| j != i).map(|j| self.distance(i, j)).fold(f64::INFINITY, f64::min);
        let mut spacings: Vec<f64> = (0..n).map(|i| nearest(i) / SPACING).collect();
        spacings.sort_by(f64::total_cmp);
        spacings
    }

    /// Mean |ρ/ρ₀ − 1| over the particles in a box that are at least 1 below the surface.
    pub(crate) fn density_error(&self, width: f64, surface: f64) -> f64 {
        let rest = SPACING * SPACING * normalisation::<Poly6>(2);
        let solid = |d: f64| sph_core::fluid::container::half_space::share::<f64, 2>(d);
        let error = |i: usize| {
            let kernel = |j| Poly6::profile(self.distance(i, j));
            let fluid: f64 = (0..self.positions.len()).map(kernel).sum();
            let [x, y] = self.positions[i];
            let open = (1.0 - solid(x) - solid(width - x)) * (1.0 - solid(y));
            (fluid * rest - open).abs()
        };
        let deep = |&i: &usize| self.positions[i][1] < surface - 1.0;
        let errors: Vec<f64> = (0..self.positions.len()).filter(deep).map(error).collect();
        errors.iter().sum::<f64>() / errors.len() as f64
    }

    pub(crate) fn fastest(&self) -> f64 {
        self.velocities.iter().map(|v| v[0].hypot(v[1])).fold(0.0, f64::max)
    }

    pub(crate) fn rms_speed(&self) -> f64 {
        let squares = self.velocities.iter().map(|v| v[0] * v[0] + v[1] * v[1]);
        (squares.sum::<f64>() / self.velocities.len() as f64).sqrt()
    }
}

/// A particle at rest.
pub(crate) fn at<T: Compact>(x: f64, y: f64) -> Particle<T, 2> {
    Particle::new([x, y].map(T::from_f64), [T::ZERO; 2])
}

/// `columns` × `rows` particles at rest from a lower corner on.
pub(crate) fn block<T: Compact>(
    corner: [f64; 2],
    columns: usize,
    rows: usize,
) -> impl Iterator<Item = Particle<T, 2>> {
    let place = move |k: usize, base: f64| base + SPACING * (k as f64 + 0.5);
    (0..columns * rows).map(move |k| at(place(k % columns, corner[0]), place(k / columns, corner[1])))
}

/// A deterministic noise.
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// In [−1, 1).
    pub(crate) fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// What a dam break has become, speeds over √(g H).
#[derive(Debug)]
pub(crate) struct Figures {
    /// The farthest particle after 80 frames.
    pub(crate) front: f64,
    /// Mean |ρ/ρ₀ − 1|.
    pub(crate) density_error: f64,
    /// The nearest neighbour's distance over the spacing at rest that 99 % of the particles exceed.
    pub(crate) first_percentile_of_spacing: f64,
    /// The fluid's height over that of the volume put in.
    pub(crate) height: f64,
    /// Root of the mean square speed.
    pub(crate) speed: f64,
    /// The fastest particle's speed.
    pub(crate) fastest: f64,
    /// The difference of the mean height at both ends.
    pub(crate) slope: f64,
}

/// A column of fluid 8 × 12 in a box 16 wide falls, spreads and rests 6 deep.
pub(crate) fn dam_break<T: Compact>(frames: usize) -> Figures {
    let (width, gravity, depth) = (16.0, 0.005, 6.0);
    let walls = OpenBox::new([width, 16.0].map(T::from_f64));
    let mut fluid = PositionBasedFluid::<T, _, 2, 384, 289>::new(walls);
    for particle in block([0.0, 0.0], 16, 24) {
        fluid.add(particle).unwrap();
    }
    let down = [T::ZERO, T::from_f64(-gravity)];
    for _ in 0..80 {
        fluid.step(down);
    }
    let front = state(fluid.particles()).positions.iter().map(|x| x[0]).fold(0.0, f64::max);
    for _ in 80..frames {
        fluid.step(down);
    }
    let rest = state(fluid.particles());
    let wave_speed = f64::sqrt(gravity * depth);
    let spacings = rest.spacings();
    let level = |side: f64| {
        let near = |x: &&[f64; 2]| (x[0] - side).abs() < 2.0;
        mean(&rest.positions.iter().filter(near).copied().collect::<Vec<_>>())[1]
    };
    Figures {
        front,
        density_error: rest.density_error(width, depth),
        first_percentile_of_spacing: spacings[spacings.len() / 100],
        height: 2.0 * mean(&rest.positions)[1] / depth,
        speed: rest.rms_speed() / wave_speed,
        fastest: rest.fastest() / wave_speed,
        slope: level(2.0) - level(14.0),
    }
}

/// A drop that oscillates in free space; returns the change of its mean velocity in h a frame.
pub(crate) fn drift<T: Compact>(frames: usize, seed: u64) -> [f64; 2] {
    let walls = OpenBox::new([60.0, 60.0].map(T::from_f64));
    let settings = Settings { cohesion: 32, ..Settings::DEFAULT };
    let mut fluid = PositionBasedFluid::<T, _, 2, 64, 3721>::with_settings(walls, settings);
    for particle in block([28.0, 28.0], 8, 8) {
        fluid.add(particle).unwrap();
    }
    let mut noise = Noise(seed);
    fluid.impulse(|_| [0, 1].map(|_| T::from_f64(0.02 * noise.number())));
    let start = mean(&state(fluid.particles()).velocities);
    fluid.impulse(|_| start.map(|v| T::from_f64(-v)));
    let before = mean(&state(fluid.particles()).velocities);
    for _ in 0..frames {
        fluid.step([T::ZERO; 2]);
    }
    let after = state(fluid.particles());
    for axis in 0..2 {
        let reach = after.positions.iter().map(|x| (x[axis] - 30.0).abs()).fold(0.0, f64::max);
        assert!(reach < 29.0, "a particle met a wall: {reach}");
    }
    let after = mean(&after.velocities);
    [after[0] - before[0], after[1] - before[1]]
}

/// Numbers up to the limits of the type.
pub(crate) fn extremes<T: Compact>(noise: &mut Noise) -> [T; 2] {
    [0, 1].map(|_| match noise.bits() >> 61 {
        0 => T::MAX,
        1 => -T::MAX,
        2 => T::from_f64(f64::NAN),
        3 => T::from_f64(f64::INFINITY),
        4 => T::ratio(-1, 8),
        _ => T::from_f64(noise.number()),
    })
}

//! Built-in particle sets, so that nothing is needed to try the command.
//!
//! Each is a jittered or regular lattice in the unit box, the jitter drawn from a fixed seed: the same set every time.

use std::f64::consts::PI;

use crate::io::{Array, PointTable};

/// A particle set and a support radius that suits it.
#[derive(Debug, Clone)]
pub struct Demo {
    /// The particles.
    pub table: PointTable,
    /// h, for about the neighbour number that the field uses.
    pub support_radius: f64,
}

/// The sets there are: name and what it is.
pub const SETS: &[(&str, &str)] = &[
    ("vortex", "Taylor-Green velocities on a jittered lattice, 2-D"),
    ("drop", "a rotating ball with a temperature that falls from its centre, 3-D"),
    ("lattice", "A = sin(2πx) cos(2πy) + z on a regular lattice, 3-D"),
];

/// The density of every set.
const DENSITY: f64 = 1000.0;

/// The set of this name with about `particles` particles; `None` for an unknown name.
///
/// ```
/// let demo = sph_host::demo::set("vortex", Some(400)).unwrap();
/// assert_eq!((demo.table.len(), demo.table.dimensions()), (400, 2));
/// assert!(sph_host::demo::set("teapot", None).is_none());
/// ```
#[must_use]
pub fn set(name: &str, particles: Option<usize>) -> Option<Demo> {
    match name {
        "vortex" => Some(vortex(particles.unwrap_or(10_000))),
        "drop" => Some(drop(particles.unwrap_or(30_000))),
        "lattice" => Some(lattice(particles.unwrap_or(27_000))),
        _ => None,
    }
}

fn vortex(particles: usize) -> Demo {
    let side = side(particles, 2);
    let positions = lattice_points::<2>(side, 0.2);
    let k = 2.0 * PI;
    let column = |name, f: &dyn Fn(f64, f64) -> f64| {
        Array::new(name, 1, positions.iter().map(|&[x, y]| f(k * x, k * y)).collect())
    };
    let arrays = vec![
        column("velocity_x", &|x, y| -x.cos() * y.sin()),
        column("velocity_y", &|x, y| x.sin() * y.cos()),
        column("pressure", &|x, y| -0.25 * ((2.0 * x).cos() + (2.0 * y).cos())),
    ];
    demo("vortex", &positions, arrays, side, 4.0)
}

fn drop(particles: usize) -> Demo {
    // a ball fills π/6 of its box
    let side = side((particles as f64 * 6.0 / PI).min(1e15) as usize, 3);
    let mut positions = lattice_points::<3>(side, 0.2);
    let radius_squared = |x: &[f64; 3]| x.iter().map(|c| (c - 0.5) * (c - 0.5)).sum::<f64>();
    positions.retain(|x| radius_squared(x) < 0.25);
    let velocity = positions.iter().flat_map(|[x, y, _]| [0.5 - y, x - 0.5, 0.0]).collect();
    let temperature = positions.iter().map(|x| 20.0 + 60.0 * (-8.0 * radius_squared(x)).exp()).collect();
    let arrays = vec![Array::new("velocity", 3, velocity), Array::new("temperature", 1, temperature)];
    demo("drop", &positions, arrays, side, 2.6)
}

fn lattice(particles: usize) -> Demo {
    let side = side(particles, 3);
    let positions = lattice_points::<3>(side, 0.0);
    let k = 2.0 * PI;
    let a = positions.iter().map(|[x, y, z]| (k * x).sin() * (k * y).cos() + z).collect();
    demo("lattice", &positions, vec![Array::new("A", 1, a)], side, 2.6)
}

/// The lattice points along each axis for about this many in all.
fn side(particles: usize, dimensions: u32) -> usize {
    ((particles as f64).powf(1.0 / f64::from(dimensions)).round() as usize).max(1)
}

/// Cell centres of a lattice in the unit box, last axis fastest, each coordinate moved by up to `jitter` spacings.
fn lattice_points<const D: usize>(side: usize, jitter: f64) -> Vec<[f64; D]> {
    let spacing = 1.0 / side as f64;
    let mut random = SplitMix(20_250_301);
    let points = side.pow(D as u32);
    let mut positions = Vec::with_capacity(points);
    for number in 0..points {
        let mut rest = number;
        let mut point = [0.0; D];
        for axis in (0..D).rev() {
            let place = (rest % side) as f64 + 0.5;
            rest /= side;
            point[axis] = (place + jitter * (2.0 * random.next() - 1.0)) * spacing;
        }
        positions.push(point);
    }
    positions
}

/// A set of particles that stand for a volume of spacing^D each, with the reach h / spacing.
fn demo<const D: usize>(
    name: &str,
    positions: &[[f64; D]],
    mut arrays: Vec<Array>,
    side: usize,
    reach: f64,
) -> Demo {
    let spacing = 1.0 / side as f64;
    let mass = DENSITY * spacing.powi(D as i32);
    arrays.insert(0, Array::new("m", 1, vec![mass; positions.len()]));
    let coordinates = (0..D).map(|axis| positions.iter().map(|x| x[axis]).collect()).collect();
    let table = PointTable::new(format!("demo:{name}"), coordinates, arrays)
        .expect("a set's arrays have one value for each of its particles");
    Demo { table, support_radius: reach * spacing }
}

/// G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014.
struct SplitMix(u64);

impl SplitMix {
    /// A number in [0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_the_same_every_time_and_about_as_large_as_asked() {
        for (name, _) in SETS {
            let demo = set(name, Some(3000)).unwrap();
            let again = set(name, Some(3000)).unwrap();
            assert_eq!(demo.table.coordinates, again.table.coordinates);
            let size = demo.table.len() as f64;
            assert!((size / 3000.0 - 1.0).abs() < 0.1, "{name}: {size}");
        }
    }

    #[test]
    fn the_vortex_stays_in_its_box_and_is_not_a_lattice() {
        let table = set("vortex", Some(2500)).unwrap().table;
        let x = &table.coordinates[0];
        assert!(x.iter().all(|x| (0.0..1.0).contains(x)));
        assert!(x.windows(2).any(|pair| pair[0] != pair[1]));
    }
}

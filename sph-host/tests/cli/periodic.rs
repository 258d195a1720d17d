//! `--periodic`: sums over images equal sums over copies of the particles.

use std::fmt::Write;

use crate::support::{Folder, Random, is_close, magnitude};

/// A particle: its coordinates and its other cells.
struct Particle(Vec<f64>, String);

/// Particles in a box from 0 to 1 along each axis.
fn cloud(count: usize, dim: usize) -> Vec<Particle> {
    let mut random = Random(11);
    let particle = |_| {
        let x = (0..dim).map(|_| random.next()).collect();
        let (m, rho, h) = (1e-2 * (1.0 + random.next()), 1.0 + random.next(), 0.1 + 0.1 * random.next());
        Particle(x, format!("{m},{rho},{h},{},{}", random.next(), random.next()))
    };
    (0..count).map(particle).collect()
}

fn table(particles: &[Particle], dim: usize) -> String {
    let mut text = format!("{},m,rho,h,a,b\n", ["x", "x,y", "x,y,z"][dim - 1]);
    for Particle(x, rest) in particles {
        x.iter().for_each(|x| write!(text, "{x:?},").unwrap());
        writeln!(text, "{rest}").unwrap();
    }
    text
}

/// Each particle, and behind it its copies within `reach` of the box, x fastest; along the axes that are periodic.
fn copies(particles: &[Particle], is_periodic: &[bool], reach: f64) -> Vec<Particle> {
    let mut all = Vec::new();
    for Particle(x, rest) in particles {
        all.push(Particle(x.clone(), rest.clone()));
        for number in 0..5_usize.pow(x.len() as u32) {
            let shift = |axis: usize| (number / 5_usize.pow(axis as u32) % 5) as f64 - 2.0;
            let image: Vec<f64> = (0..x.len()).map(|axis| x[axis] + shift(axis)).collect();
            let is_near = |axis: usize| image[axis] >= -reach && image[axis] <= 1.0 + reach;
            let is_here =
                (0..x.len()).all(|axis| if is_periodic[axis] { is_near(axis) } else { shift(axis) == 0.0 });
            if is_here && image != *x {
                all.push(Particle(image, rest.clone()));
            }
        }
    }
    all
}

#[test]
fn sums_equal_those_over_copies() {
    for dim in 1..=3 {
        let particles = cloud([60, 200, 300][dim - 1], dim);
        let folder = Folder::with("p.csv", table(&particles, dim));
        let zeros_and_ones = [vec!["0"; dim], vec!["1"; dim]].concat().join(",");
        let grid = format!("--grid {} --bounds {zeros_and_ones}", ["23", "7,5", "4,3,5"][dim - 1]);
        for (options, most) in [
            ("--support 0.3", 0.3),
            ("--support 0.3 --recompute-density --gradient", 0.3),
            ("--support 0.9 --estimate shepard", 0.9),
            ("--support-column h --estimate corrected --gradient", 0.2),
            ("--support-column h --recompute-density", 0.2),
        ] {
            let most = if options.contains("column h") { largest_h(&particles) } else { most };
            folder.write("c.csv", table(&copies(&particles, &vec![true; dim], 2.02 * most), dim));
            let scalars = ["--exact", "", "--exact --scalar f32", "--exact --scalar i16f16"];
            for scalar in &scalars[..if dim == 3 { 2 } else { 4 }] {
                let words = format!("{grid} {options} {scalar} --quantity a --quantity b");
                let periodic = folder.columns(&format!("sample p.csv {words} --periodic {zeros_and_ones}"));
                let explicit = folder.columns(&format!("sample c.csv {words}"));
                assert_eq!(periodic.names, explicit.names);
                for (name, (a, b)) in periodic.names.iter().zip(periodic.values.iter().zip(&explicit.values))
                {
                    let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
                    assert!(a.iter().zip(b).all(same), "{dim} {words}: {name}: {a:?} {b:?}");
                }
                let pieces =
                    folder.columns(&format!("sample p.csv {words} --periodic {zeros_and_ones} --chunk 37"));
                for (whole, pieces) in periodic.values.iter().zip(&pieces.values) {
                    // the fit divides by small determinants
                    let rounding = if options.contains("corrected") { 1e-9 } else { 1e-12 };
                    let tolerance = if scalar.is_empty() { rounding } else { 0.0 };
                    let scale = magnitude(whole);
                    assert!(
                        whole.iter().zip(pieces).all(|(&a, &b)| is_close(a, b, tolerance, scale)),
                        "{dim} {words}"
                    );
                }
            }
        }
    }
}

fn largest_h(particles: &[Particle]) -> f64 {
    let h = |Particle(_, rest): &Particle| rest.split(',').nth(2).unwrap().parse::<f64>().unwrap();
    particles.iter().map(h).fold(0.0, f64::max)
}

/// Whatever the cells and the order: all 5 × 5 copies of the box, far beyond reach.
#[test]
fn sums_equal_those_over_a_tiled_plane() {
    let particles = cloud(100, 2);
    let folder = Folder::with("p.csv", table(&particles, 2));
    folder.write("c.csv", table(&copies(&particles, &[true, true], 2.0), 2));
    let words = "--support 0.4 --grid 9,9 --bounds 0,0,1,1 --recompute-density --gradient --quantity a";
    let periodic = folder.columns(&format!("sample p.csv {words} --periodic 0,0,1,1"));
    let tiled = folder.columns(&format!("sample c.csv {words}"));
    for (a, b) in periodic.values.iter().zip(&tiled.values) {
        let scale = magnitude(a);
        assert!(a.iter().zip(b).all(|(&a, &b)| is_close(a, b, 1e-12, scale)), "{a:?} {b:?}");
    }
}

#[test]
fn everything_is_repeated_along_a_periodic_axis_and_not_along_an_open_one() {
    let folder = Folder::with("p.csv", table(&cloud(150, 2), 2));
    folder.write("at.csv", "x,y\n0.125,0.5\n1.125,0.5\n-2.875,0.5\n0.125,1.5\n");
    let words = "sample p.csv --at at.csv --support 0.2 --quantity a --exact";
    let both = folder.columns(&format!("{words} --periodic 0,0,1,1"));
    assert_eq!(both.get("x"), [0.125, 1.125, -2.875, 0.125], "coordinates are as read");
    assert!(both.get("a").iter().all(|&a| a == both.get("a")[0]));
    let open = folder.columns(&format!("{words} --periodic 0,7,1,7"));
    assert_eq!(open.get("a")[0], open.get("a")[2]);
    assert_eq!(open.get("density")[3], 0.0, "nothing is there along the open axis");
    // a particle outside of the box is the same as the one in it
    let moved = table(&cloud(150, 2), 2).replace("\n0.", "\n4.");
    folder.write("moved.csv", moved);
    let found = folder.columns(&format!("{} --periodic 0,0,1,1", words.replace("p.csv", "moved.csv")));
    for (a, b) in found.get("a").iter().zip(both.get("a")) {
        assert!(is_close(*a, *b, 1e-11, 1.0), "{a} {b}");
    }
    let at = folder.succeed("sample moved.csv --at-particles --support 0.2 --quantity a --periodic 0,0,1,1");
    assert!(at.stdout.lines().nth(1).unwrap().starts_with("4."), "particles are where they were read");
    assert_eq!(at.stdout.lines().count(), 151);
}

#[test]
fn a_plane_has_a_box_of_its_own_axes() {
    let particles = cloud(80, 2);
    let flat = table(&particles, 2);
    let mut space = String::from("x,y,z,m,rho,h,a,b\n");
    for Particle(x, rest) in &particles {
        writeln!(space, "{:?},3.5,{:?},{rest}", x[0], x[1]).unwrap();
    }
    let folder = Folder::with("p.csv", flat);
    folder.write("s.csv", space);
    let words = "--support 0.3 --grid 4,4 --quantity a --exact";
    let expected = folder.columns(&format!("sample p.csv {words} --periodic 0,0,1,1"));
    for periodic in ["0,0,1,1", "0,3,0,1,3,1"] {
        let found = folder.columns(&format!("sample s.csv {words} --dim 2 --periodic {periodic}"));
        assert_eq!(found.get("a"), expected.get("a"), "{periodic}");
    }
}

#[test]
fn boxes_that_cannot_be_are_refused() {
    let folder = Folder::with("p.csv", "x,y,m\n0,0,1\n0.5,0.5,1\n");
    let words = "sample p.csv --at-particles --support 0.3 --quantity m";
    for wrong in ["0,0,1", "0,0,0,0", "1,0,0,1", "0,0,nan,1"] {
        folder.fail_with(2, &format!("{words} --periodic {wrong}"), &["--periodic"]);
    }
    folder.fail_with(
        1,
        &format!("{words} --periodic 0,0,0,1,1,1"),
        &["p.csv", "2 dimensions", "3", "--periodic"],
    );
    folder.fail_with(1, &format!("{words} --periodic 0,0,1e-6,1e-6"), &["p.csv", "images"]);
}

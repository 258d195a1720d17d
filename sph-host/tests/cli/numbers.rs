//! Every estimate against its definition, in one, two and three dimensions.

use std::fmt::Write;

use crate::oracle::{Cloud, KERNELS, Kernel, Local};
use crate::support::{Columns, Folder, Random, is_close, magnitude};

/// Jittered lattice of unit box, unequal masses, densities and supports, and a curved field.
fn cloud(dim: usize, kernel: &Kernel) -> (Cloud<'_>, Vec<f64>) {
    let mut random = Random(7 + dim as u64);
    let side = [40_usize, 9, 6][dim - 1];
    let spacing = 1.0 / side as f64;
    let point = |mut number: usize, random: &mut Random| {
        let coordinate = |_| {
            let place = (number % side) as f64 + 0.5 + 0.3 * (random.next() - 0.5);
            number /= side;
            place * spacing
        };
        (0..dim).map(coordinate).collect::<Vec<f64>>()
    };
    let positions: Vec<Vec<f64>> = (0..side.pow(dim as u32)).map(|n| point(n, &mut random)).collect();
    let mut column = |lower: f64, upper: f64| -> Vec<f64> {
        positions.iter().map(|_| lower + (upper - lower) * random.next()).collect()
    };
    let volume = spacing.powi(dim as i32);
    let masses = column(900.0 * volume, 1100.0 * volume);
    let densities = column(950.0, 1050.0);
    let supports = column(2.3 * spacing, 3.4 * spacing);
    let values = positions.iter().map(|x| 1.0 + x[0] * x[0] - 2.0 * x[dim - 1]).collect();
    (Cloud { kernel, positions, masses, densities, supports }, values)
}

/// The points of evaluation: inside, near the border, and none exactly on a particle.
fn points(dim: usize) -> Vec<Vec<f64>> {
    let mut random = Random(99);
    (0..25).map(|_| (0..dim).map(|_| random.next()).collect()).collect()
}

fn rows(header: &str, rows: impl Iterator<Item = Vec<f64>>) -> String {
    let mut text = format!("{header}\n");
    for row in rows {
        let cells: Vec<String> = row.iter().map(f64::to_string).collect();
        writeln!(text, "{}", cells.join(",")).unwrap();
    }
    text
}

/// The cloud as CSV with the columns `with`, among m, rho and h, and the field A.
fn text(cloud: &Cloud, values: &[f64], with: &[&str]) -> String {
    let axes = &["x", "y", "z"][..cloud.positions[0].len()];
    let special = |name: &&str, j: usize| match *name {
        "m" => cloud.masses[j],
        "rho" => cloud.densities[j],
        _ => cloud.supports[j],
    };
    let row = |j: usize| {
        let special = with.iter().map(|name| special(name, j));
        cloud.positions[j].iter().copied().chain(special).chain([values[j]]).collect()
    };
    let header = [axes, with, &["A"]].concat().join(",");
    rows(&header, (0..values.len()).map(row))
}

fn folder(cloud: &Cloud, values: &[f64], with: &[&str]) -> Folder {
    let folder = Folder::with("p.csv", text(cloud, values, with));
    let dim = cloud.positions[0].len();
    folder.write("at.csv", rows(&["x", "y", "z"][..dim].join(","), points(dim).into_iter()));
    folder
}

/// That columns `name` and its gradient hold what `expected` says.
fn check(columns: &Columns, name: &str, dim: usize, expected: impl Fn(&[f64]) -> Local) {
    let expected: Vec<Local> = points(dim).iter().map(|x| expected(x)).collect();
    let compare = |name: &str, expected: Vec<f64>| {
        let found = columns.get(name);
        assert_eq!(found.len(), expected.len());
        let scale = magnitude(&expected);
        assert!(scale > 0.0, "{name} is tested against nothing");
        for (found, expected) in found.iter().zip(expected) {
            assert!(is_close(*found, expected, 1e-9, scale), "{dim}-D {name}: {found}, not {expected}");
        }
    };
    compare(name, expected.iter().map(|(value, _)| *value).collect());
    for axis in 0..dim {
        let name = format!("{name}_d{}", ["x", "y", "z"][axis]);
        compare(&name, expected.iter().map(|(_, gradient)| gradient[axis]).collect());
    }
}

const SAMPLE: &str = "sample p.csv --at at.csv --gradient --quantity A";

#[test]
fn plain_shepard_and_corrected_are_their_definitions() {
    for (dim, kernel) in (1..=3).flat_map(|dim| KERNELS.iter().map(move |kernel| (dim, kernel))) {
        let (mut cloud, values) = cloud(dim, kernel);
        let h = 3.0 * cloud.supports[0].min(0.1);
        cloud.supports.fill(h);
        let folder = folder(&cloud, &values, &["m", "rho"]);
        let words = format!("{SAMPLE} --support {h} --kernel {}", kernel.name);
        let plain = folder.columns(&words);
        check(&plain, "density", dim, |x| cloud.density(x));
        check(&plain, "A", dim, |x| cloud.plain(x, &values));
        let shepard = folder.columns(&format!("{words} --estimate shepard"));
        check(&shepard, "A", dim, |x| cloud.shepard(x, &values));
        let corrected = folder.columns(&format!("{words} --estimate corrected"));
        check(&corrected, "A", dim, |x| cloud.corrected(x, &values));
    }
}

#[test]
fn each_particle_brings_its_own_support_and_densities_follow() {
    for dim in 1..=3 {
        let kernel = &KERNELS[0];
        let (mut cloud, values) = cloud(dim, kernel);
        let folder = folder(&cloud, &values, &["m", "rho", "h"]);
        let by_support = format!("{SAMPLE} --support-column h");
        check(&folder.columns(&by_support), "A", dim, |x| cloud.plain(x, &values));
        let shepard = folder.columns(&format!("{by_support} --estimate shepard"));
        check(&shepard, "A", dim, |x| cloud.shepard(x, &values));
        let corrected = folder.columns(&format!("{by_support} --estimate corrected"));
        check(&corrected, "A", dim, |x| cloud.corrected(x, &values));
        cloud.recompute_densities();
        let recomputed = folder.columns(&format!("{by_support} --recompute-density"));
        check(&recomputed, "density", dim, |x| cloud.density(x));
        check(&recomputed, "A", dim, |x| cloud.plain(x, &values));
        cloud.supports.iter_mut().for_each(|h| *h *= 2.0);
        cloud.recompute_densities();
        let by_length = folder.columns(&format!("{SAMPLE} --smoothing-length-column h --recompute-density"));
        check(&by_length, "A", dim, |x| cloud.plain(x, &values));
    }
}

#[test]
fn without_a_density_column_densities_are_summed_and_an_option_wins_over_columns() {
    let kernel = &KERNELS[3];
    let (mut cloud, values) = cloud(2, kernel);
    let with_columns = folder(&cloud, &values, &["m", "h"]);
    cloud.supports.fill(0.32);
    cloud.masses.fill(2.5);
    cloud.recompute_densities();
    let words = format!("{SAMPLE} --kernel wendland-c2 --mass 2.5");
    // the smoothing length is half the support of Wendland's functions
    for support in ["--support 0.32", "--smoothing-length 0.16 --support-column h", "--smoothing-length 0.16"]
    {
        let columns = with_columns.columns(&format!("{words} {support}"));
        check(&columns, "density", 2, |x| cloud.density(x));
        check(&columns, "A", 2, |x| cloud.plain(x, &values));
    }
}

#[test]
fn shepard_needs_no_mass() {
    let kernel = &KERNELS[0];
    let (mut cloud, values) = cloud(2, kernel);
    cloud.supports.fill(0.35);
    cloud.masses.fill(1.0);
    let words = format!("{SAMPLE} --support 0.35 --estimate shepard");
    let columns = folder(&cloud, &values, &["rho"]).columns(&words);
    assert_eq!(columns.names, ["x", "y", "A", "A_dx", "A_dy"], "no density");
    check(&columns, "A", 2, |x| cloud.shepard(x, &values));
    cloud.densities.fill(1.0);
    let columns = folder(&cloud, &values, &[]).columns(&words);
    assert_eq!(columns.names, ["x", "y", "A", "A_dx", "A_dy"], "no density");
    check(&columns, "A", 2, |x| cloud.shepard(x, &values));
}

#[test]
fn the_order_of_particles_changes_rounding_alone() {
    let (cloud, values) = cloud(3, &KERNELS[0]);
    let folder = folder(&cloud, &values, &["m", "rho", "h"]);
    let text = String::from_utf8(folder.bytes("p.csv")).unwrap();
    let (header, lines) = text.split_once('\n').unwrap();
    let mut lines: Vec<&str> = lines.lines().collect();
    let mut random = Random(5);
    lines.sort_by_cached_key(|_| (random.next() * 1e9) as u64);
    folder.write("q.csv", format!("{header}\n{}\n", lines.join("\n")));
    for estimate in ["plain", "shepard", "corrected"] {
        let words = format!("--at at.csv --gradient --support-column h --quantity A --estimate {estimate}");
        let ordered = folder.columns(&format!("sample p.csv {words}"));
        let shuffled = folder.columns(&format!("sample q.csv {words}"));
        for (a, b) in ordered.values.iter().zip(&shuffled.values) {
            let scale = magnitude(a);
            assert!(a.iter().zip(b).all(|(a, b)| is_close(*a, *b, 1e-12, scale)), "{estimate}");
        }
    }
}

#[test]
fn exact_and_any_number_of_threads_give_the_same_bytes() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 2500 --grid 60,60 --gradient --estimate corrected";
    let one = folder.succeed(&format!("{words} --threads 1")).stdout;
    assert_eq!(one.lines().count(), 3601);
    for more in ["--threads 2", "", "--threads 5", "--threads 1000000"] {
        assert!(folder.succeed(&format!("{words} {more}")).stdout == one, "{more}");
    }
    let exact = folder.succeed(&format!("{words} --exact --threads 1")).stdout;
    assert!(folder.succeed(&format!("{words} --exact --threads 2")).stdout == exact);
    let (exact, one) = (Columns::parse(&exact), Columns::parse(&one));
    for (a, b) in exact.values.iter().zip(&one.values) {
        let scale = magnitude(a);
        assert!(a.iter().zip(b).all(|(a, b)| is_close(*a, *b, 1e-10, scale)));
    }
}

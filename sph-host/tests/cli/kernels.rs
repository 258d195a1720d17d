//! `fluisim kernels`: names, constants, and the picture.

use std::f64::consts::PI;

use crate::support::{Folder, is_close};

/// Name, support ratio, f(0) and σ in 1, 2, 3 and 4 dimensions, from the literature.
#[rustfmt::skip]
const LITERATURE: [(&str, f64, f64, [f64; 4]); 9] = [
    ("poly6", 1.0, 1.0, [35.0 / 32.0, 4.0 / PI, 315.0 / (64.0 * PI), 20.0 / (PI * PI)]),
    ("spiky", 1.0, 1.0, [2.0, 10.0 / PI, 15.0 / PI, 70.0 / (PI * PI)]),
    ("viscosity", 1.0, f64::NAN, [f64::NAN, 10.0 / (3.0 * PI), 15.0 / (2.0 * PI), 42.0 / (PI * PI)]),
    ("cubic-spline", 2.0, 1.0, [4.0 / 3.0, 40.0 / (7.0 * PI), 8.0 / PI, 1120.0 / (31.0 * PI * PI)]),
    ("quartic-spline", 2.5, 0.368, [3125.0 / 768.0, 46875.0 / (2398.0 * PI), 15625.0 / (512.0 * PI), 5468750.0 / (35783.0 * PI * PI)]),
    ("quintic-spline", 3.0, 66.0 / 243.0, [243.0 / 40.0, 15309.0 / (478.0 * PI), 2187.0 / (40.0 * PI), 826686.0 / (2771.0 * PI * PI)]),
    ("wendland-c2", 2.0, 1.0, [1.25, 7.0 / PI, 21.0 / (2.0 * PI), 252.0 / (5.0 * PI * PI)]),
    ("wendland-c4", 2.0, 1.0, [1.5, 9.0 / PI, 495.0 / (32.0 * PI), 594.0 / (7.0 * PI * PI)]),
    ("wendland-c6", 2.0, 1.0, [55.0 / 32.0, 78.0 / (7.0 * PI), 1365.0 / (64.0 * PI), 130.0 / (PI * PI)]),
];

/// The rows as text: name, dimension, and the four numbers, NaN for an empty cell.
fn rows(text: &str) -> Vec<(String, usize, [f64; 4])> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = ["name", "dim", "normalisation", "support_ratio", "profile_at_zero", "second_moment"];
    assert_eq!(reader.headers().unwrap(), &header[..]);
    let row = |record: csv::StringRecord| {
        let number =
            |index: usize| if record[index].is_empty() { f64::NAN } else { record[index].parse().unwrap() };
        (record[0].to_owned(), record[1].parse().unwrap(), std::array::from_fn(|index| number(index + 2)))
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

#[test]
fn constants_are_those_of_the_literature() {
    let folder = Folder::new();
    for dim in 1..=4 {
        let rows = rows(&folder.succeed(&format!("kernels --dim {dim} --format csv")).stdout);
        assert_eq!(rows.iter().map(|row| row.0.as_str()).collect::<Vec<_>>(), listed(dim));
        for kernel in LITERATURE.iter().filter(|kernel| dim > 1 || kernel.0 != "viscosity") {
            let (name, of, [normalisation, ratio, zero, _]) =
                rows.iter().find(|row| row.0 == kernel.0).expect("a row for each kernel");
            assert_eq!((*of, *ratio), (dim, kernel.1));
            assert!(is_close(*normalisation, kernel.3[dim - 1], 1e-13, 0.0), "{name} {dim}: {normalisation}");
            assert!(is_close(*zero, kernel.2, 1e-14, 0.0), "{name} {dim}: {zero}");
        }
    }
}

/// The kernels that have a norm in `dim` dimensions: a singular one has none in one.
fn listed(dim: usize) -> Vec<&'static str> {
    macro_rules! names {
        ([$($module:ident $Kernel:ident $name:tt $about:tt;)+]) => {
            [$(($name, <sph_core::kernel::$Kernel as sph_core::kernel::Kernel>::SINGULAR)),+]
        };
    }
    let kernels = sph_core::for_each_kernel!(names);
    kernels.iter().filter(|(_, singular)| dim > 1 || !singular).map(|(name, _)| *name).collect()
}

#[test]
fn without_a_dimension_there_are_three() {
    let folder = Folder::new();
    let all = folder.succeed("kernels --format csv").stdout;
    let dims: Vec<usize> = rows(&all).iter().map(|row| row.1).collect();
    let expected: Vec<usize> = (1..=3).flat_map(|dim| vec![dim; listed(dim).len()]).collect();
    assert_eq!(dims, expected);
    let table = folder.succeed("kernels").stdout;
    assert_eq!(table.lines().count(), 1 + expected.len());
    assert!(table.lines().next().unwrap().starts_with("name "));
    for dim in 5..=8 {
        let rows = rows(&folder.succeed(&format!("kernels --dim {dim} --format csv")).stdout);
        assert!(rows.iter().all(|row| row.1 == dim && row.2[0] > 0.0) && rows.len() == listed(dim).len());
    }
}

#[test]
fn second_moments_are_integrals() {
    // ∫ q^{D+1} f / ∫ q^{D−1} f by beta functions, ∫ qⁿ (1 − q)ᵐ dq = n! m! / (n + m + 1)!
    let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
    let beta = |n: usize, m: usize| factorial(n) * factorial(m) / factorial(n + m + 1);
    let wendland_c2 = |n| beta(n, 4) + 4.0 * beta(n + 1, 4);
    // −q³/2 + q² + 1/(2q) − 1
    let viscosity = |n: usize| {
        let n = n as f64;
        -0.5 / (n + 4.0) + 1.0 / (n + 3.0) + 0.5 / n - 1.0 / (n + 1.0)
    };
    // (1 − q²)³
    let poly6 = |n: usize| {
        let n = n as f64;
        1.0 / (n + 1.0) - 3.0 / (n + 3.0) + 3.0 / (n + 5.0) - 1.0 / (n + 7.0)
    };
    let folder = Folder::new();
    for dim in 2..=8 {
        let rows = rows(&folder.succeed(&format!("kernels --dim {dim} --format csv")).stdout);
        let check = |name: &str, moment: &dyn Fn(usize) -> f64| {
            let found = rows.iter().find(|row| row.0 == name).unwrap().2[3];
            let expected = moment(dim + 1) / moment(dim - 1);
            assert!(is_close(found, expected, 1e-12, 0.0), "{name} {dim}: {found}, not {expected}");
        };
        check("spiky", &|n| beta(n, 3));
        check("wendland-c2", &wendland_c2);
        check("viscosity", &viscosity);
        check("poly6", &poly6);
    }
}

#[test]
fn numbers_read_back_and_the_plot_is_a_picture() {
    let folder = Folder::new();
    let said = folder.succeed("kernels --dim 2 --format csv --plot k.png");
    assert_eq!(said.stderr, "");
    assert!(
        rows(&said.stdout).iter().any(|row| row.0 == "poly6" && is_close(row.2[0], 4.0 / PI, 1e-15, 0.0))
    );
    let picture = folder.bytes("k.png");
    let decoded = png::Decoder::new(std::io::Cursor::new(&picture[..])).read_info().unwrap();
    assert!(decoded.info().width > 200);
    folder.succeed("kernels --dim 2 --plot k.png --force");
    assert_eq!(folder.bytes("k.png"), picture, "the same every time");
}

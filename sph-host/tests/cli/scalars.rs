//! Every number type does the work, as well as its digits allow.

use sph_host::scalar_choice::ScalarName;

use crate::support::{Columns, Folder, magnitude};

/// Value and gradient errors that a type is allowed, relative to the largest magnitude of a column.
const SCALARS: [(&str, f64, f64); 6] = [
    ("f32", 2e-6, 2e-5),
    // micromath's square root is up to 6 % off
    ("fast32", 0.1, 0.25),
    ("i16f16", 2e-3, 1.5e-2),
    ("i8f24", 1e-5, 5e-5),
    ("i4f28", 1e-6, 5e-6),
    ("i32f32", 1e-7, 1e-6),
];

/// Every scalar of the list can be chosen and named.
#[test]
fn all_listed_scalars_are_taken() {
    let folder = Folder::new();
    let help = folder.succeed("sample --help").stdout;
    for scalar in ScalarName::compiled() {
        assert!(help.contains(&scalar.name()), "{scalar} is not in the help");
        let found =
            folder.columns(&format!("sample demo:vortex --particles 100 --grid 3,3 --scalar {scalar}"));
        assert!(found.get("density").iter().all(|density| *density > 0.0), "{scalar}");
    }
}

fn compare(exact: &Columns, found: &Columns, value: f64, gradient: f64, what: &str) {
    assert_eq!(exact.names, found.names);
    for (name, (a, b)) in exact.names.iter().zip(exact.values.iter().zip(&found.values)) {
        // a component of a gradient is held against the whole gradient
        let most = match name.rsplit_once("_d") {
            Some((base, _)) => ["_dx", "_dy"].map(|end| magnitude(exact.get(&format!("{base}{end}")))),
            None => [magnitude(a); 2],
        };
        let most = most[0].max(most[1]) * if name.contains("_d") { gradient } else { value };
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() <= most, "{what} {name}: {b}, not {a}");
        }
    }
}

#[test]
fn they_agree_with_f64() {
    let folder = Folder::new();
    for set in ["vortex --particles 400 --grid 4,4", "drop --particles 600 --grid 2,2,2"] {
        for estimate in ["plain", "shepard", "corrected"] {
            let inside = if set.starts_with("drop") { "0.3,0.3,0.3,0.7,0.7,0.7" } else { "0.2,0.2,0.9,0.8" };
            let words = format!("sample demo:{set} --bounds {inside} --gradient --estimate {estimate}");
            let exact = folder.columns(&words);
            assert_eq!(folder.columns(&format!("{words} --scalar f64")), exact);
            for (scalar, value, gradient) in SCALARS {
                let found = folder.columns(&format!("{words} --scalar {scalar}"));
                compare(&exact, &found, value, gradient, &format!("{set} {estimate} {scalar}"));
            }
        }
    }
}

#[test]
fn they_take_the_units_of_the_file() {
    // metres and kilograms far from one; densities as a column, with and without masses
    let rows: String = (0..25)
        .map(|i| (3e4 + f64::from(i % 5), f64::from(i / 5)))
        .map(|(x, y)| format!("{x},{y},5e9,5e9,{}\n", 1e5 + 2e3 * y))
        .collect();
    let folder = Folder::with("m.csv", format!("x,y,m,rho,A\n{rows}"));
    folder.write("rho.csv", format!("x,y,unused,rho,A\n{rows}"));
    for (file, estimate) in [("m.csv", "plain"), ("m.csv", "shepard"), ("rho.csv", "shepard")] {
        let words = format!("sample {file} --support 2.6 --at-particles --quantity A --estimate {estimate}");
        let exact = folder.columns(&words);
        for (scalar, value, gradient) in SCALARS.into_iter().skip(2) {
            let found = folder.columns(&format!("{words} --scalar {scalar}"));
            compare(&exact, &found, value, gradient, &format!("{file} {estimate} {scalar}"));
        }
    }
}

#[test]
fn what_a_type_cannot_hold_is_said() {
    // from −3.9 h to 3.9 h about their middle: the range of i4f28 is from −8 to 8
    let rows: String = (0..40).map(|i| format!("{},1,1\n", f64::from(i) / 5.0)).collect();
    let folder = Folder::with("p.csv", format!("x,m,A\n{rows}"));
    folder.write("at.csv", "x\n8.2\n11\n40\n-1e6\n");
    let said = folder.succeed("sample p.csv --support 1 --at at.csv --scalar i4f28 --estimate shepard");
    let columns = Columns::parse(&said.stdout);
    assert!(columns.get("density")[0] > 0.0 && columns.get("A")[0] > 0.0);
    assert_eq!(columns.get("density")[1], 0.0, "out of reach");
    for row in 2..4 {
        let x = columns.get("x")[row];
        assert!(columns.get("density")[row].is_nan() && columns.get("A")[row].is_nan(), "made up at {x}");
    }
    assert!(said.stderr.contains("warning: 4 values are outside the range"), "{}", said.stderr);
    let words = "sample p.csv --support 0.1 --at-particles --scalar i4f28";
    folder.fail_with(1, words, &["p.csv", "particle 0", "does not fit"]);
    folder.fail_with(1, &words.replace("0.1", "0.7"), &["p.csv", "span", "does not fit"]);
}

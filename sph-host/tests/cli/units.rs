//! Coordinates are taken from an origin near the particles and in units of h, before they are rounded to the scalar.

use std::fmt::Write;

use crate::support::{Columns, Folder, Random, is_close, magnitude};

const SCALARS: [&str; 7] = ["f64", "f32", "fast32", "i16f16", "i8f24", "i4f28", "i32f32"];

/// Particles on multiples of 1/1024 in a box of 3 × 2 (× 2) about a place, so that moving them by a power of two rounds nothing.
fn cloud(place: [f64; 3], dim: usize) -> String {
    let mut random = Random(11);
    let mut text = format!("{},m,h,a\n", ["x", "x,y", "x,y,z"][dim - 1]);
    for _ in 0..300 {
        for (axis, place) in place.iter().enumerate().take(dim) {
            let x = (random.next() * [3.0, 2.0, 2.0][axis] * 1024.0).floor() / 1024.0;
            write!(text, "{},", place + x).unwrap();
        }
        let (m, h, a) = (1.0 + random.next(), 0.5 + 0.3 * random.next(), random.next() - 0.5);
        writeln!(text, "{m},{h},{a}").unwrap();
    }
    text
}

/// All columns but the coordinates.
fn fields(columns: &Columns) -> Vec<(&String, &Vec<f64>)> {
    let all = columns.names.iter().zip(&columns.values);
    all.filter(|(name, _)| !["x", "y", "z"].contains(&name.as_str())).collect()
}

#[test]
fn a_set_far_away_has_the_bits_of_the_same_set_at_hand() {
    let far = [1073741824.0, -536870912.0, 2147483648.0];
    for dim in 1..=3 {
        let folder = Folder::with("near.csv", cloud([0.0; 3], dim));
        folder.write("far.csv", cloud(far, dim));
        // cell centres are multiples of 1/16 too
        let grid = ["5", "5,10", "5,5,2"][dim - 1];
        let corners = |place: [f64; 3]| {
            let lower = place[..dim].iter().map(|x| (x - 0.25).to_string());
            let upper = place[..dim].iter().map(|x| (x + 2.25).to_string());
            lower.chain(upper).collect::<Vec<_>>().join(",")
        };
        for scalar in SCALARS {
            for options in [
                "--support 0.6 --at-particles",
                "--support 0.6 --at-particles --gradient --exact",
                "--support-column h --at NAME.csv --estimate shepard",
                "--support 0.6 --grid GRID --bounds BOX --estimate corrected",
                "--support-column h --grid GRID --bounds BOX --chunk 90 --gradient",
            ] {
                // normalisations of the smaller radii leave the range of i4f28
                if scalar == "i4f28" && options.contains("column") {
                    continue;
                }
                let words = |name: &str, place| {
                    let options = options.replace("NAME", name).replace("GRID", grid);
                    let options = options.replace("BOX", &corners(place));
                    format!("sample {name}.csv --scalar {scalar} {options}")
                };
                let near = folder.columns(&words("near", [0.0; 3]));
                let far = folder.columns(&words("far", far));
                assert!(magnitude(near.get("density")) > 0.0);
                for ((name, near), (_, far)) in fields(&near).into_iter().zip(fields(&far)) {
                    let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(near), bits(far), "{dim}-D {scalar} {options} {name}");
                }
            }
        }
    }
}

#[test]
fn numbers_far_from_the_origin_are_those_of_f64() {
    for offset in [1e6, 1e9] {
        let rows = [(0.1, 0.2), (0.2, 0.2), (0.3, 0.2), (0.1, 0.3)];
        let rows: String = rows.iter().map(|(x, y)| format!("{},{y}\n", offset + x)).collect();
        let folder = Folder::with("p.csv", format!("x,y\n{rows}"));
        let words = "sample p.csv --mass 0.01 --support 0.15 --at-particles --scalar";
        let expected = folder.columns(&format!("{words} f64"));
        if offset < 1e7 {
            assert!((expected.get("density")[0] - 0.92817).abs() < 1e-5);
        }
        for (scalar, tolerance) in
            [("f32", 1e-6), ("fast32", 0.1), ("i16f16", 1e-3), ("i8f24", 1e-5), ("f32 --exact", 1e-6)]
        {
            let found = folder.columns(&format!("{words} {scalar}"));
            for (a, b) in expected.get("density").iter().zip(found.get("density")) {
                assert!(is_close(*a, *b, tolerance, 0.0), "{offset} {scalar}: {b}, not {a}");
            }
        }
    }
}

#[test]
fn numbers_of_any_size_fit_a_float_of_small_range() {
    // masses of 1e-60, lengths of 1e-25, values of 1e50: all beyond f32, and so are their densities
    let folder = Folder::new();
    let mut text = String::from("x,y,m,a\n");
    for i in 0..36 {
        writeln!(text, "{}e-25,{}e-25,1e-60,{}e50", i % 6, i / 6, 3 + i % 4).unwrap();
    }
    folder.write("p.csv", text);
    let words = "sample p.csv --support 2.5e-25 --at-particles --quantity a --estimate";
    for estimate in ["plain", "shepard", "corrected"] {
        let expected = folder.columns(&format!("{words} {estimate}"));
        let found = folder.succeed(&format!("{words} {estimate} --scalar f32"));
        assert_eq!(expected.get("density").len(), 36);
        let found = Columns::parse(&found.stdout);
        for (a, b) in expected.get("density").iter().zip(found.get("density")) {
            assert!(is_close(*a, *b, 1e-6, 0.0), "{estimate}: {b}, not {a}");
        }
        assert!(found.get("a").iter().all(|a| a.is_nan()), "1e50 is no f32 to be printed");
    }
}

#[test]
fn a_scalar_too_coarse_for_the_support_is_told() {
    let folder = Folder::with("p.csv", "x,m\n0,1\n0.5,1\n1000000000,1\n");
    let words = "sample p.csv --support 1 --at-particles";
    assert_eq!(folder.succeed(words).stderr, "");
    let said = folder.succeed(&format!("{words} --scalar f32"));
    for part in ["warning: ", "f32", "--scalar f64"] {
        assert!(said.stderr.contains(part), "{}", said.stderr);
    }
}

#[test]
fn exact_sums_in_chunks_have_the_bits_of_the_whole() {
    for dim in 1..=3 {
        let folder = Folder::with("p.csv", cloud([3.0, -7.0, 90.0], dim));
        let grid = ["40", "9,8", "6,5,4"][dim - 1];
        for scalar in ["f64", "f32", "fast32", "i16f16", "i8f24", "i4f28"] {
            for options in [
                "--support 0.4",
                "--support 0.4 --recompute-density --gradient --estimate shepard",
                "--support-column h --estimate corrected",
                "--support-column h --gradient",
            ] {
                if scalar == "i4f28" && options.contains("column") {
                    continue;
                }
                let words = format!("sample p.csv --grid {grid} --exact --scalar {scalar} {options}");
                let whole = folder.succeed(&words);
                for chunk in [17, 100, 1000] {
                    let pieces = folder.succeed(&format!("{words} --chunk {chunk}"));
                    assert!(pieces.stdout == whole.stdout, "{words} --chunk {chunk}");
                    assert_eq!(pieces.stderr, whole.stderr, "{words} --chunk {chunk}");
                }
            }
        }
    }
}

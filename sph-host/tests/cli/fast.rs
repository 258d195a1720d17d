//! Without `--exact` a faster path sums in another order: close to the exact one, and the same bytes whatever the threads.

use std::fmt::Write;

use crate::support::{Columns, Folder, Random, is_close, magnitude};

/// Particles with masses, radii over 1:30, and a field; densities too where these are asked for.
fn particles(dim: usize, with_density: bool) -> String {
    let mut random = Random(8);
    let axes = ["x", "y", "z"][..dim].join(",");
    let mut text = format!("{axes},m,size,a{}\n", if with_density { ",rho" } else { "" });
    for _ in 0..900 {
        let x: Vec<String> = (0..dim).map(|_| (6.0 * random.next() - 1.0).to_string()).collect();
        let size = 0.1 * 30_f64.powf(random.next());
        let (m, a) = (0.5 + random.next(), 1.0 + random.next());
        write!(text, "{},{m},{size},{a}", x.join(",")).unwrap();
        text.push_str(if with_density { ",2.5\n" } else { "\n" });
    }
    text
}

/// Every column of a run without `--exact`, by its magnitude, against the run with it; and threads change no byte.
fn check(folder: &Folder, words: &str, tolerance: f64) {
    let one = folder.succeed(&format!("{words} --threads 1"));
    for threads in [2, 3] {
        let more = folder.succeed(&format!("{words} --threads {threads}"));
        assert!(more.stdout == one.stdout && more.stderr == one.stderr, "{words}");
    }
    let said = folder.succeed(&format!("{words} --exact"));
    let (units, rest) = said.stderr.split_at(said.stderr.rfind("units: ").unwrap());
    assert!(units == one.stderr && rest.lines().count() == 1, "{words}: {}", said.stderr);
    let (exact, fast) = (Columns::parse(&said.stdout), Columns::parse(&one.stdout));
    assert_eq!(exact.names, fast.names);
    for (name, (a, b)) in exact.names.iter().zip(exact.values.iter().zip(&fast.values)) {
        let scale = magnitude(a);
        assert!(a.iter().zip(b).all(|(a, b)| is_close(*a, *b, tolerance, scale)), "{words}: {name}");
    }
}

#[test]
fn is_close_to_the_exact_path_and_the_same_for_any_threads() {
    for dim in 1..=3 {
        let folder = Folder::new();
        for with_density in [false, true] {
            folder.write("p.csv", particles(dim, with_density));
            let grid = ["40", "9,8", "6,5,4"][dim - 1];
            for place in
                ["--at-particles".to_owned(), format!("--grid {grid}"), "--at p.csv --gradient".to_owned()]
            {
                for support in ["--support 0.9", "--support-column size"] {
                    let words = format!("sample p.csv {place} {support} --quantity a");
                    check(&folder, &words, 1e-12);
                    check(&folder, &format!("{words} --estimate shepard --kernel wendland-c2"), 1e-11);
                    check(&folder, &format!("{words} --scalar f32"), 1e-5);
                }
            }
        }
    }
}

#[test]
fn densities_in_f32_are_within_a_millionth() {
    let folder = Folder::new();
    let words = "sample demo:drop --particles 3000 --at-particles --scalar f32";
    let (fast, exact) = (folder.columns(words), folder.columns(&format!("{words} --exact")));
    for (a, b) in fast.get("density").iter().zip(exact.get("density")) {
        assert!((a / b - 1.0).abs() <= 1e-6, "{a} {b}");
    }
}

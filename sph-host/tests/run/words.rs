//! Right and wrong words.

use crate::support::Folder;

#[test]
fn the_list_names_every_case() {
    let folder = Folder::new();
    let list = folder.succeed("run --list").stdout;
    for case in ["dam-break", "hydrostatic", "drop", "taylor-green", "poiseuille", "tilt"] {
        assert!(list.lines().any(|line| line.starts_with(case)), "{list}");
    }
    assert!(folder.names().is_empty());
    let help = folder.succeed("run --help").stdout;
    for word in
        ["--solver", "--resolution", "--time", "--every", "--resume", "--check", "Example: fluisim run"]
    {
        assert!(help.contains(word), "{word}: {help}");
    }
}

#[test]
fn words_that_cannot_be_are_wrong_usage_and_make_nothing() {
    let folder = Folder::new();
    for (words, part) in [
        ("run teapot", "teapot"),
        ("run --solver magic", "magic"),
        ("run --resolution 2", "--resolution 2"),
        ("run --resolution 100000", "100000"),
        ("run --resolution -4", "-4"),
        ("run --resolution x", "'x'"),
        ("run --time 0", "--time"),
        ("run --time -1", "--time"),
        ("run --time nan", "--time"),
        ("run --time inf", "--time"),
        ("run --every 0", "--every"),
        ("run --every 9", "--every 9"),
        ("run --every 1e-9", "--every"),
        ("run --threads 0", "--threads"),
        ("run --kernel gauss", "gauss"),
        ("run --kernel viscosity", "viscosity"),
        ("run --scalar f16", "f16"),
        ("run --scalar i16f16", "i16f16"),
        ("run --scalar fast32", "fast32"),
        ("run drop --solver pbf", "drop"),
        ("run tilt --scalar f64", "f64"),
        ("run tilt --kernel cubic-spline", "cubic-spline"),
        ("run --solver pbf --scalar i4f28", "support radii"),
        ("run tilt --solver wcsph --scalar i16f16", "i16f16"),
        ("run tilt --dim 3", "--dim 3"),
        ("run --dim 4", "--dim"),
        ("run drop --dim 3", "--dim 3"),
        ("run --resume --force", "--force"),
        ("run --frobnicate", "--frobnicate"),
    ] {
        folder.fail_with(2, words, &[part]);
    }
}

#[test]
fn a_place_that_is_no_directory_is_an_error() {
    let folder = Folder::with("taken", "");
    folder.fail_with(1, "run --resolution 8 --time 0.001 --out taken", &["taken"]);
}

#[test]
fn a_goal_that_is_missed_counts_only_where_it_is_asked_for() {
    let folder = Folder::new();
    let words = "run poiseuille --resolution 8 --time 0.03 --every 0.03 --out flow";
    let said = folder.succeed(words);
    assert!(said.stdout.contains("FALLS SHORT"), "{}", said.stdout);
    let said = folder.run(&format!("{words} --force --check"));
    assert_eq!(said.status, Some(1));
    assert!(said.stderr.contains("velocity profile at 0.0225 s"), "{}", said.stderr);
    assert!(folder.path("flow/summary.json").exists());
    let said = folder.run("run taylor-green --resolution 20 --time 1 --out vortices --check");
    assert_eq!(said.status, Some(0), "{}{}", said.stdout, said.stderr);
}

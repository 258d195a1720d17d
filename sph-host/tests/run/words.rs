//! Right and wrong words.

use sph_host::run::CaseName;

use crate::support::Folder;

#[test]
fn the_list_names_every_case() {
    let folder = Folder::new();
    let list = folder.succeed("run --list").stdout;
    assert_eq!(list.lines().count(), CaseName::ALL.len(), "{list}");
    for (line, case) in list.lines().zip(CaseName::ALL) {
        assert!(line.starts_with(case.name()) && line.ends_with(case.about()), "{line}");
    }
    assert!(folder.names().is_empty());
    let help = folder.succeed("run --help").stdout;
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in [
        "--solver",
        "incompressible for dam-break in 2-D and impact, pbf for tilt, else wcsph",
        "3 for dam-break",
        "8 to 2000, in three dimensions to 256",
        "20 for dam-break in three dimensions",
        "--time",
        "--every",
        "--resume",
        "--no-pictures",
        "--check",
        "Example: fluisim run",
    ] {
        assert!(help.contains(word), "{word}: {help}");
    }
    for case in CaseName::ALL {
        assert!(help.contains(case.about()), "{case}: {help}");
    }
}

#[test]
fn words_that_cannot_be_are_wrong_usage_and_make_nothing() {
    let folder = Folder::new();
    for (words, part) in [
        ("run teapot", "teapot"),
        ("run --solver magic", "magic"),
        ("run --resolution 2", "--resolution 2: expected 8 to 2000"),
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
        ("run poiseuille --solver incompressible", "poiseuille"),
        ("run --solver incompressible --scalar i16f16", "i16f16"),
        ("run --solver incompressible --kernel viscosity", "viscosity"),
        ("run tilt --scalar f64", "f64"),
        ("run tilt --kernel cubic-spline", "cubic-spline"),
        ("run --solver pbf --scalar i4f28", "support radii"),
        ("run tilt --solver wcsph --scalar i16f16", "i16f16"),
        ("run tilt --dim 3", "--dim 3"),
        ("run --dim 4", "--dim 4: dam-break in 4 dimensions: it has 2 or 3"),
        ("run --dim 1", "--dim 1"),
        ("run --dim 3 --resolution 1000", "--resolution 1000: expected 8 to 256"),
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
    for option in ["", "--force", "--resume"] {
        let words = format!("run --resolution 8 --time 0.001 --out taken {option}");
        folder.fail_with(1, &words, &["--out taken: is a file, expected a directory"]);
    }
    folder.fail_with(1, "run --resolution 8 --time 0.001 --out taken/dam", &["taken/dam", "Not a directory"]);
    assert_eq!(folder.bytes("taken"), b"");
}

#[test]
fn what_the_run_did_not_come_to_is_not_measured() {
    let folder = Folder::new();
    for (words, measured) in [
        ("run dam-break --resolution 8 --time 0.05", 4),
        ("run dam-break --solver wcsph --resolution 8 --time 0.05", 2),
        ("run drop --resolution 8 --time 0.001", 4),
        ("run hydrostatic --resolution 8 --time 0.05", 2),
        ("run tilt --resolution 8 --time 0.1", 3),
        ("run poiseuille --resolution 40 --time 0.001", 1),
        ("run taylor-green --resolution 8 --time 0.01", 2),
    ] {
        let said = folder.succeed(&format!("{words} --no-pictures --force --out case --check"));
        assert!(!said.stdout.contains("FALLS SHORT"), "{words}: {}", said.stdout);
        let summary: serde_json::Value = serde_json::from_slice(&folder.bytes("case/summary.json")).unwrap();
        let checks = summary["checks"].as_array().unwrap();
        let not_measured = checks.len() - measured;
        assert_eq!(said.stdout.matches("not measured").count(), not_measured, "{words}: {}", said.stdout);
        assert!(
            said.stderr.contains(&format!("{not_measured} of {} goals were not", checks.len())),
            "{}",
            said.stderr
        );
        let nulls = checks.iter().filter(|check| check["value"].is_null() && check["holds"].is_null());
        assert_eq!(nulls.count(), not_measured, "{words}: {checks:?}");
        assert!(checks.iter().all(|check| check["goal"].is_number()));
    }
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
}

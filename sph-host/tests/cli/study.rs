//! `fluisim study`: the report, the files, and what is refused.

use serde_json::Value;

use crate::support::Folder;

/// A study that takes a moment.
const SMALL: &str =
    "study demo:vortex --particles 144 --kernel poly6 --bits 12..16 --want density=1e-2 --quiet";

#[test]
fn a_study_reports_and_leaves_its_files() {
    let folder = Folder::new();
    let said = folder.succeed(&format!("{SMALL} --out here --blame --bound --also f16"));
    for word in [
        "recommended   poly6, Saturating<I",
        "bottleneck",
        "bound",
        "type Real = Saturating<",
        "const LENGTH: f64 =",
    ] {
        assert!(said.stdout.contains(word), "{word}: {}", said.stdout);
    }
    let json: Value = serde_json::from_slice(&folder.bytes("here/study.json")).unwrap();
    let found = &json["recommended"];
    assert_eq!((&found["kernel"], &found["overflow"]), (&Value::from("poly6"), &Value::from("saturating")));
    let bits = found["integer_bits"].as_u64().unwrap() + found["fraction_bits"].as_u64().unwrap();
    assert!(bits == 16 && found["errors"]["density"].as_f64().unwrap() <= 1e-2);
    let csv = String::from_utf8(folder.bytes("here/study.csv")).unwrap();
    assert!(csv.starts_with("kernel,format,quantity,bits,") && csv.lines().count() == 1 + 5 + 1, "{csv}");
    for picture in ["errors", "front", "bits", "units"] {
        assert!(folder.bytes(&format!("here/{picture}.png")).starts_with(b"\x89PNG"), "{picture}");
    }

    folder.fail_with(1, &format!("{SMALL} --out here"), &["study.csv: the file exists already", "--force"]);
    let before = folder.bytes("here/study.json");
    folder.succeed(&format!("{SMALL} --out here --bound --also f16 --threads 1 --force"));
    assert_eq!(folder.bytes("here/study.json"), before, "no byte depends on the threads");
}

#[test]
fn goals_that_are_not_met_are_an_error_after_the_report() {
    let folder = Folder::new();
    let said = folder.run("study demo:vortex --particles 144 --kernel poly6 --bits 12..14 --want density=1e-9 --quiet --out here");
    assert_eq!(said.status, Some(1), "{}", said.stderr);
    assert!(said.stdout.contains("best          poly6, i"), "{}", said.stdout);
    assert!(
        said.stderr.contains("no format of up to 14 bits meets the goals; what limits it most is"),
        "{}",
        said.stderr
    );
    let json: Value = serde_json::from_slice(&folder.bytes("here/study.json")).unwrap();
    assert!(json["recommended"].is_null() && !json["rows"].as_array().unwrap().is_empty());
}

#[test]
fn what_cannot_be_studied_is_refused() {
    let folder = Folder::new();
    folder.write("one.csv", "x,y,m,a\n0,0,1,1\n");
    folder.write("wide.csv", "x,y,m,a\n0,0,1,1\n0.5,1e12,1,2\n0.1,0,1,3\n");
    let usage = [
        ("study", "PARTICLES"),
        ("study demo:vortex --bits 4..32", "expected 8 to 64 bits"),
        ("study demo:vortex --bits 20..10", "expected 8 to 64 bits"),
        ("study demo:vortex --target z80", "m0, m4f, rv32"),
        ("study demo:vortex --want rho=1", "expected one of density, interpolation, gradient"),
        ("study demo:vortex --want density=0", "greater than zero"),
        ("study demo:vortex --round up", "expected nearest, floor, zero or stochastic"),
        ("study demo:vortex --overflow none", "expected saturating, wrapping or checked"),
        ("study demo:vortex --also f8", "expected f16, bf16 or posit16"),
        ("study demo:vortex --kernel viscosity", "diverges at r = 0"),
        ("study demo:vortex --kernel none", "expected all, poly6"),
        ("study demo:vortex --support 0", "greater than zero"),
        ("study demo:vortex --smoothing-length 0.1", "choose one --kernel"),
        ("study demo:teapot", "there is no built-in set"),
        ("study --fluid poiseuille", "choose dam-break or tilt"),
        ("study demo:vortex --fluid tilt", "cannot be used with"),
    ];
    for (words, part) in usage {
        folder.fail_with(2, words, &[part]);
    }
    let data = [
        ("study one.csv --support 1", "the gradient is zero at every particle (there is one particle)"),
        ("study wide.csv --support 1 --kernel poly6", "40 of them for the coordinates"),
        ("study demo:vortex --particles 144 --quantity none", "there is no quantity `none`"),
        ("study missing.csv --support 1", "missing.csv"),
    ];
    for (words, part) in data {
        folder.fail_with(1, &format!("{words} --quiet"), &[part]);
    }
}

#[test]
fn sixteen_bits_with_a_floating_point_are_a_scalar() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 400 --grid 3,3 --quantity velocity_x --scalar";
    let exact = folder.columns(&format!("{words} f64"));
    for (scalar, tolerance) in [("f16", 4e-3), ("bf16", 4e-2), ("posit16", 4e-3)] {
        let found = folder.columns(&format!("{words} {scalar}"));
        for (found, exact) in found.get("density").iter().zip(exact.get("density")) {
            assert!((found / exact - 1.0).abs() < tolerance, "{scalar}: {found} {exact}");
        }
    }
}

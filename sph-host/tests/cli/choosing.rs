//! `--only`, `--support-factor`, standard input and packed files.

use std::io::Write;
use std::process::Stdio;

use crate::support::{Columns, Folder, Said};

const MIXED: &str = "x,y,type,m,h,A\n0,0,1,1,0.5,1\n0.1,0,2,-1,0.5,nan\n0,0.2,1,1,0.5,2\n0.3,0.1,3,1,0.5,3\n0.2,0.2,1,1,0.5,4\n";

#[test]
fn particles_are_chosen_by_values_and_ranges() {
    let folder = Folder::with("p.csv", MIXED);
    folder.write("q.csv", "x,y,type,m,h,A\n0,0,1,1,0.5,1\n0,0.2,1,1,0.5,2\n0.2,0.2,1,1,0.5,4\n");
    let words = "--support 0.5 --grid 3,3 --bounds 0,0,0.3,0.3 --quantity A --gradient";
    let expected = folder.succeed(&format!("sample q.csv {words}")).stdout;
    for only in [
        "--only type=1",
        "--only type=1..1",
        "--only type=1,7",
        "--only type=..1.5",
        "--only type=1,3 --only A=..2,4",
    ] {
        if only.contains("..2,4") {
            folder.fail_with(2, &format!("sample p.csv {words} {only}"), &["--only"]);
            continue;
        }
        let said = folder.succeed(&format!("sample p.csv {words} {only}"));
        assert_eq!(said.stdout, expected, "{only}");
        assert!(said.stderr.contains("3 of 5 particles"), "{}", said.stderr);
        for chunk in [1, 2, 100] {
            let said = folder.succeed(&format!("sample p.csv {words} {only} --chunk {chunk} --exact"));
            assert_eq!(
                said.stdout,
                folder.succeed(&format!("sample q.csv {words} --exact")).stdout,
                "{only}"
            );
            assert!(said.stderr.contains("3 of 5 particles"), "{}", said.stderr);
        }
    }
    let found =
        folder.columns("sample p.csv --support 0.5 --at-particles --only x=0.1.. --only type=3 --quantity A");
    assert_eq!((found.get("x"), found.get("y")), (&[0.3][..], &[0.1][..]));
}

#[test]
fn what_is_chosen_keeps_its_line_and_none_is_an_error() {
    let folder = Folder::with("p.csv", MIXED);
    let words = "sample p.csv --support 0.5 --at-particles";
    folder.fail_with(1, &format!("{words} --only type=2,3"), &["line 3", "column `m`"]);
    folder.fail_with(1, &format!("{words} --only type=9"), &["p.csv", "none of 5", "type=9", "--only"]);
    folder.fail_with(
        1,
        "sample p.csv --support 1 --grid 2,2 --chunk 2 --only type=9",
        &["none of 5", "type=9"],
    );
    folder.fail_with(1, &format!("{words} --only kind=1"), &["`kind`"]);
    for wrong in ["type", "type=x", "type=3..1"] {
        folder.fail_with(2, &format!("{words} --only {wrong}"), &["--only"]);
    }
}

#[test]
fn a_column_of_supports_is_multiplied() {
    let folder = Folder::with("p.csv", "x,m,h,H\n0,1,0.4,1.2\n0.5,1,0.5,1.5\n1,1,0.6,1.8\n");
    let expected = folder.succeed("sample p.csv --at-particles --support-column H --quantity m").stdout;
    let found =
        folder.succeed("sample p.csv --at-particles --support-column h --support-factor 3 --quantity m");
    let (expected, found) = (Columns::parse(&expected), Columns::parse(&found.stdout));
    for (a, b) in expected.get("density").iter().zip(found.get("density")) {
        assert!((a / b - 1.0).abs() < 1e-13, "{a} and {b}");
    }
    let words = "sample p.csv --at-particles --support-factor 3";
    folder.fail_with(2, &format!("{words} --support 1"), &["--support-factor"]);
    folder.fail_with(2, &format!("{words} --support 1 --support-column h"), &["--support-factor"]);
    folder.fail_with(2, words, &["--support-factor"]);
}

fn piped(folder: &Folder, words: &str, input: &[u8]) -> Said {
    let mut command = folder.command(words);
    let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().unwrap();
    // a command that refuses its words reads nothing
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap().into()
}

fn packed(content: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(content).unwrap();
    encoder.finish().unwrap()
}

#[test]
fn standard_input_and_packed_files_give_what_the_file_gives() {
    let text = "x,y,m,A\n0,0,1,3\n0.5,0,1,4\n0,0.5,1,5\n";
    let folder = Folder::with("p.csv", text);
    let (at, grid) = ("--support 1.5 --at-particles", "--support 1.5 --grid 2,2");
    let expected = folder.succeed(&format!("sample p.csv {at}")).stdout;
    let on_grid = folder.succeed(&format!("sample p.csv {grid}")).stdout;
    folder.write("p.csv.gz", packed(text.as_bytes()));
    folder.write("odd.dat", text);
    assert_eq!(folder.succeed(&format!("sample p.csv.gz {at}")).stdout, expected);
    assert_eq!(folder.succeed(&format!("sample p.csv.gz {grid} --chunk 2")).stdout, on_grid);
    assert_eq!(folder.succeed(&format!("sample odd.dat {at} --format csv")).stdout, expected);
    assert_eq!(piped(&folder, &format!("sample - {at} --format csv"), text.as_bytes()).stdout, expected);
    let input = packed(text.as_bytes());
    assert_eq!(piped(&folder, &format!("sample - {at} --format csv.gz"), &input).stdout, expected);
    assert_eq!(
        piped(&folder, &format!("sample - {grid} --chunk 1 --format csv"), text.as_bytes()).stdout,
        on_grid
    );
    let points = piped(&folder, "sample p.csv --support 1.5 --at - --format csv", b"x,y\n0.1,0.2\n");
    assert_eq!(Columns::parse(&points.stdout).get("x"), [0.1]);
    // two members one after the other, as gzip allows
    folder.write("p.csv.gz", [packed(&text.as_bytes()[..20]), packed(&text.as_bytes()[20..])].concat());
    assert_eq!(folder.succeed(&format!("sample p.csv.gz {at}")).stdout, expected);
}

#[test]
fn what_is_wrong_with_standard_input_or_packing_is_told() {
    let text = "x,y,m\n0,0,1\n0.5,b,1\n";
    let folder = Folder::with("p.csv", text);
    let at = "--support 1.5 --at-particles";
    let said = piped(&folder, &format!("sample - {at}"), text.as_bytes());
    assert_eq!(said.status, Some(2));
    assert!(said.stderr.contains("standard input") && said.stderr.contains("--format"), "{}", said.stderr);
    let said = piped(&folder, &format!("sample - {at} --format csv"), text.as_bytes());
    assert_eq!(said.status, Some(1));
    assert!(said.stderr.contains("standard input: line 3, column `y`"), "{}", said.stderr);
    let said = piped(&folder, "sample - --support 1 --at - --format csv", text.as_bytes());
    assert_eq!(said.status, Some(2));
    folder.fail_with(2, &format!("sample p.csv {at} --format doc"), &["doc", ".csv"]);
    folder.write("p.csv.gz", text);
    folder.fail_with(1, &format!("sample p.csv.gz {at}"), &["p.csv.gz", "gzip"]);
    let whole = packed(text.repeat(50).as_bytes());
    folder.write("p.csv.gz", &whole[..whole.len() / 2]);
    folder.fail_with(1, &format!("sample p.csv.gz {at}"), &["p.csv.gz", "cut short"]);
    folder.fail_with(1, &format!("sample none.csv.gz {at}"), &["none.csv.gz"]);
    folder.fail_with(2, &format!("sample p.txt.gz {at}"), &["p.txt.gz"]);
}

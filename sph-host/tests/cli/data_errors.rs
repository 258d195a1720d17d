//! What is wrong with files and data: exit status 1, and a message that names file, line, column and value.

use crate::support::Folder;

/// Runs on a file whose fourth line is at fault.
fn refuse(header: &str, row: &str, words: &str, parts: &[&str]) {
    let fine = header.split(',').map(|_| "1").collect::<Vec<_>>().join(",");
    let folder = Folder::with("p.csv", format!("{header}\n{fine}\n# note\n{row}\n"));
    let parts = [&["p.csv", "line 4"], parts].concat();
    folder.fail_with(1, &format!("sample p.csv --at-particles {words} --out out.csv"), &parts);
}

#[test]
fn a_number_that_cannot_be_is_named_with_its_line_and_column() {
    for (value, shown) in [("nan", "NaN"), ("inf", "inf"), ("-inf", "-inf"), ("0", "0"), ("-2.5", "-2.5")] {
        let support = "--support 2";
        refuse("x,y,m,A", &format!("0,0,{value},1"), support, &["column `m`", shown]);
        refuse("x,y,Mass,A", &format!("0,0,{value},1"), support, &["column `Mass`", shown]);
        refuse("x,y,m,rho,A", &format!("0,0,1,{value},1"), support, &["column `rho`", shown]);
        refuse("x,y,m,A,h", &format!("0,0,1,1,{value}"), "--support-column h", &["column `h`", shown]);
        let length = "--smoothing-length-column h --quantity A";
        refuse("x,y,m,A,h", &format!("0,0,1,1,{value}"), length, &["column `h`", shown]);
        if !shown.contains(char::is_numeric) {
            refuse("x,y,m,A", &format!("0,{value},1,1"), support, &["column `y`", shown]);
            refuse("x,y,m,A", &format!("0,0,1,{value}"), support, &["column `A`", shown]);
            refuse("x,y,z,m,A", &format!("0,0,{value},1,1"), "--dim 2 --support 2", &["column `z`", shown]);
        }
    }
}

#[test]
fn what_is_no_number_is_named_when_it_is_used() {
    for (header, row, column) in [
        ("x,y,m,A", "0,oops,1,1", "`y`"),
        ("x,y,m,A", "0,0,oops,1", "`m`"),
        ("x,y,m,rho,A", "0,0,1,oops,1", "`rho`"),
        ("x,y,m,A", "0,0,1,oops", "`A`"),
    ] {
        refuse(header, row, "--support 2", &["column", column, "`oops`"]);
    }
    refuse("x,y,m,A", "0,0,1,", "--support 2", &["column `A`", "empty"]);
    refuse("x,y,m,h", "0,0,1,wide", "--support-column h", &["column `h`", "`wide`"]);
    refuse("x,y,m,A", "0,0,1,text", "--support 2 --quantity A", &["column `A`", "`text`"]);
    refuse("x,y,m,A", "0,0,1", "--support 2", &["3 cells", "4"]);
    refuse("x,y,m,A", "0,0,1,2,3", "--support 2", &["5 cells", "4"]);
}

#[test]
fn an_extent_beyond_all_numbers_is_refused_with_its_lines() {
    let folder = Folder::with("p.csv", "x,y,m,A\n-1e308,0,1,1\n0,0,1,-1e308\n1e308,0,1,1e308\n");
    folder.fail_with(1, "sample p.csv --at-particles --support 2", &["p.csv", "`x`", "line 2", "line 4"]);
    folder.write("q.csv", "x,y,m,A\n1,0,1,1\n0,0,1,-1e308\n1,0,1,1e308\n");
    folder.fail_with(1, "sample q.csv --at-particles --support 2", &["q.csv", "`A`", "line 3", "line 4"]);
    folder.write("h.csv", "x,y,m,h\n1,0,1,1\n0,0,1,1e308\n");
    let words = "sample h.csv --at-particles --smoothing-length-column h";
    folder.fail_with(1, words, &["h.csv", "line 3", "`h`", "inf"]);
}

#[test]
fn names_are_there_and_there_once() {
    for (header, parts) in [
        ("x,y,m,A,A", &["line 1", "`A`"][..]),
        ("x,y,Rho,rho,m", &["line 1", "`rho`", "`Rho`"]),
        ("x,X,m,A,B", &["line 1", "`X`"]),
        ("x,y,,A,m", &["line 1", "column 3", "missing"]),
        ("a,b,c,d,m", &["line 1", "`x`", "`a`"]),
        ("x,b,z,d,m", &["line 1", "`z`", "`y`"]),
        ("y,b,c,d,m", &["line 1", "`y`", "`x`"]),
        ("x,y,m,mass,A", &["line 1", "`m`", "`mass`"]),
        ("x,y,M,A,MASS", &["line 1", "`M`", "`MASS`"]),
        ("x,y,rho,density,m", &["line 1", "`rho`", "`density`"]),
    ] {
        let folder = Folder::with("p.csv", format!("{header}\n1,1,1,1,1\n"));
        // of a pair, both are an error whether or not they are used
        for words in ["", "--mass 1", "--mass 1 --recompute-density", "--estimate shepard"] {
            let words = format!("sample p.csv --at-particles --support 1 {words}");
            folder.fail_with(1, &words, &[&["p.csv"], parts].concat());
        }
    }
    let folder = Folder::with("p.csv", "x,y,m,A\n0,0,1,1\n");
    let sample = "sample p.csv --at-particles";
    folder.fail_with(1, &format!("{sample} --support 1 --quantity B"), &["p.csv", "line 1", "`B`", "`A`"]);
    folder.fail_with(1, &format!("{sample} --support-column hh"), &["p.csv", "line 1", "`hh`", "`A`"]);
    for coordinate in ["x", "Y"] {
        let words = format!("{sample} --support 1 --quantity {coordinate}");
        folder.fail_with(1, &words, &["p.csv", &format!("`{coordinate}`"), "coordinate"]);
    }
}

#[test]
fn dimensions_that_do_not_fit_are_refused() {
    let folder = Folder::with("p.csv", "x,y,z,m\n0,0,1,1\n\n1,3,2,1\n");
    folder.write("at.csv", "x,y\n0,0\n");
    folder.write("flat.csv", "x,y,m\n0,0,1\n1,1,1\n");
    folder.write("line.csv", "x,y,m\n0,0,1\n1,0,1\n");
    let sample = "sample p.csv --support 3";
    folder.fail_with(1, &format!("{sample} --at-particles --dim 2"), &["p.csv", "line 4", "z", "--dim 2"]);
    folder.fail_with(1, &format!("{sample} --grid 2,2"), &["p.csv", "3", "2,2"]);
    folder.fail_with(1, &format!("{sample} --at at.csv"), &["at.csv", "p.csv", "2", "3"]);
    let flat = "sample flat.csv --support 3";
    folder.fail_with(1, &format!("{flat} --at-particles --dim 3"), &["flat.csv", "--dim 3"]);
    folder.fail_with(1, "sample line.csv --support 3 --grid 2,2", &["line.csv", "y", "--bounds"]);
}

#[test]
fn a_missing_mass_or_support_says_what_helps() {
    // 4 × 4 particles, one apart
    let rows: String = (0..16).map(|i| format!("{},{},1\n", i % 4, i / 4)).collect();
    let folder = Folder::with("p.csv", format!("x,y,m\n{rows}"));
    let message = folder.fail(1, "sample p.csv --at-particles");
    let (_, after) = message.split_once("--support ").expect("a suggestion");
    let suggested: f64 = after.split([' ', ',']).next().unwrap().parse().unwrap();
    assert!((1.5..4.0).contains(&suggested), "{message}");
    folder.succeed(&format!("sample p.csv --at-particles --support {suggested}"));
    folder.write("q.csv", "x,y,A\n0,0,1\n1,0,2\n");
    for estimate in ["plain", "corrected", "shepard --recompute-density"] {
        let words = format!("sample q.csv --at-particles --support 1 --estimate {estimate}");
        folder.fail_with(1, &words, &["q.csv", "mass"]);
    }
}

#[test]
fn points_at_fault_are_named_too() {
    let folder = Folder::with("p.csv", "x,y,m\n0,0,1\n1,0,1\n");
    folder.write("at.csv", "x,y\n0,0\n0,nan\n");
    folder.fail_with(1, "sample p.csv --support 1 --at at.csv", &["at.csv", "line 3", "`y`", "NaN"]);
    folder.fail_with(1, "sample p.csv --support 1 --at none.csv", &["none.csv"]);
    folder.fail_with(1, "sample none.csv --support 1 --at at.csv", &["none.csv"]);
    folder.write("empty.csv", "");
    folder.fail_with(1, "sample empty.csv --support 1 --at at.csv", &["empty.csv", "empty"]);
    folder.write("header.csv", "x,y,m\n");
    folder.fail_with(1, "sample header.csv --support 1 --at-particles", &["header.csv", "no particles"]);
    folder.write("broken.npz", "PK");
    folder.fail_with(1, "sample broken.npz --support 1 --at-particles", &["broken.npz"]);
}

#[test]
fn a_result_that_is_too_large_is_refused_before_anything_is_read() {
    let folder = Folder::new();
    for grid in ["1000000,1000000", "4294967296,4294967296,4", "99999999999,99999999999"] {
        folder.fail_with(1, &format!("sample missing.csv --support 1 --grid {grid}"), &["points", "GB"]);
    }
    let many = "sample demo:lattice --particles 9999999999999";
    folder.fail_with(1, &format!("{many} --at-particles"), &["9999999999999", "GB"]);
    folder.fail_with(1, &format!("{many} --grid 2,2,2"), &["9999999999999", "GB"]);
}

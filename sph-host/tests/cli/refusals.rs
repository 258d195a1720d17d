//! What is refused before the work, and in which words.

use crate::support::Folder;

const VECTOR_AND_COMPONENT: &str = "# vtk DataFile Version 3.0
t
ASCII
DATASET POLYDATA
POINTS 2 double
0 0 0
1 0 1
POINT_DATA 2
SCALARS m double 1
LOOKUP_TABLE default
1
1
SCALARS velocity_x double 1
LOOKUP_TABLE default
5
6
VECTORS velocity double
1 2 3
4 5 6
";

#[test]
fn two_results_of_one_name_are_found_before_the_work() {
    let folder = Folder::with("p.vtk", VECTOR_AND_COMPONENT);
    let words = "sample p.vtk --support 2 --at-particles";
    let parts = ["p.vtk", "`velocity`", "`velocity_x`", "--quantity"];
    folder.fail_with(1, words, &parts);
    let message = folder.fail(1, words);
    assert!(!message.contains("stdout"), "{message}");
    folder.fail_with(1, &format!("{words} --out out.csv"), &parts);
    assert_eq!(folder.columns(&format!("{words} --quantity velocity")).get("velocity_x").len(), 2);
    folder.write("q.csv", "x,m,A,A_dx\n0,1,1,5\n1,1,2,6\n");
    let words = "sample q.csv --support 2 --at-particles";
    folder.succeed(words);
    folder.fail_with(1, &format!("{words} --gradient"), &["q.csv", "`A`", "`A_dx`"]);
    folder.fail_with(
        1,
        &format!("{} --gradient --chunk 1", words.replace("--at-particles", "--grid 2")),
        &["`A_dx`"],
    );
}

#[test]
fn messages_name_the_option_to_change() {
    let folder = Folder::with("p.csv", "x,y,m\n1,2,1\n1,2,1\n");
    let words = "sample p.csv --support 1 --grid 100000,100000000";
    folder.fail_with(1, words, &["--grid 100000,100000000", "10000000000000 points", "GB"]);
    folder.fail_with(1, "sample demo:lattice --particles 9999999999999 --at-particles", &["--particles"]);
    // a spacing of nothing suggests nothing
    let message = folder.fail(1, "sample p.csv --at-particles");
    assert!(message.contains("p.csv") && message.contains("at one point"), "{message}");
    assert!(
        message.contains("--support") && !message.contains("0.0") && !message.contains("2.6"),
        "{message}"
    );
    folder.fail_with(
        1,
        "sample p.csv --at-particles --support 1 --dim 3",
        &["p.csv", "--dim 3", "2 coordinates"],
    );
    folder.write("far.csv", "x,m\n1000000000,1\n1000000001,1\n");
    folder.succeed("sample far.csv --at-particles --support 2 --scalar fast32");
}

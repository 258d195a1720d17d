//! Wrong words: exit status 2. And the help that shows the right ones.

use crate::support::Folder;

#[test]
fn words_that_cannot_be_are_wrong_usage() {
    let folder = Folder::with("p.csv", "x,y,m\n0,0,1\n1,1,1\n");
    for (words, part) in [
        ("sample p.csv --at-particles --support 1 --frobnicate", "--frobnicate"),
        ("sample p.csv --at-particles --support 1 --kernel gauss", "gauss"),
        ("sample p.csv --at-particles --support 1 --kernel viscosity", "viscosity"),
        ("sample p.csv --at-particles --support 1 --estimate best", "best"),
        ("sample p.csv --at-particles --support 1 --scalar f8", "f8"),
        ("sample p.csv --at-particles --support 1 --out out.stl", "out.stl"),
        ("sample p.csv --at-particles --support 1 --out out", ".csv"),
        ("sample p.csv --at-particles --support 1 --out out.png", "--grid"),
        ("sample p.csv --at-particles --support 1 --out out.vti", "--grid"),
        ("sample p.xls --at-particles --support 1", "p.xls"),
        ("sample p.csv --at points.xls --support 1", "points.xls"),
        ("sample demo:teapot --at-particles", "demo:teapot"),
        ("sample p.csv --support 1", "--grid"),
        ("sample p.csv --at-particles --grid 2,2 --support 1", "--grid"),
        ("sample p.csv --at-particles --bounds 0,0,1,1 --support 1", "--bounds"),
        ("sample p.csv --at p.csv --bounds 0,0,1,1 --support 1", "--bounds"),
        ("sample p.csv --grid 2,2 --bounds 0,0,1 --support 1", "0,0,1"),
        ("sample p.csv --grid 2,2 --bounds 0,0,0,1,1,1 --support 1", "--bounds"),
        ("sample p.csv --grid 2,2 --bounds 1,0,0,1 --support 1", "along x"),
        ("sample p.csv --grid 0,2 --support 1", "0,2"),
        ("sample p.csv --grid 2,2,2,2 --support 1", "2,2,2,2"),
        ("sample p.csv --grid 2,2 --dim 3 --support 1", "--dim"),
        ("sample p.csv --at-particles --support 0", "--support"),
        ("sample p.csv --at-particles --support -1", "--support"),
        ("sample p.csv --at-particles --support inf", "--support"),
        ("sample p.csv --at-particles --support 1 --mass nan", "--mass"),
        ("sample p.csv --at-particles --support 1 --smoothing-length 1", "--smoothing-length"),
        ("sample p.csv --at-particles --support-column m --smoothing-length-column m", "-column"),
        ("sample p.csv --at-particles --support 1 --threads 0", "--threads"),
        ("sample p.csv --at-particles --support 1 --particles 9", "--particles"),
        ("sample p.csv --at-particles --support 1 --dim 4", "--dim"),
        ("sample", "PARTICLES"),
        ("kernels --dim 9", "9"),
        ("kernels --dim 0", "0"),
        ("kernels --format xml", "xml"),
        ("kernels --plot kernels.pdf", ".png"),
        ("teach", "teach"),
    ] {
        folder.fail_with(2, words, &[part]);
    }
    assert_eq!(folder.run("").status, Some(2));
}

#[test]
fn every_help_has_an_example_that_works() {
    let folder = Folder::new();
    for command in ["", "sample", "kernels"] {
        let help = folder.succeed(&format!("{command} --help")).stdout;
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        let (_, example) = help.split_once("Example: fluisim ").unwrap_or_else(|| panic!("{help}"));
        let (example, _) = example.split_once(" Usage:").unwrap();
        folder.succeed(&format!("{example} --force"));
    }
    assert!(folder.bytes("vortex.png").starts_with(b"\x89PNG"));
    let help = folder.succeed("--help").stdout;
    for word in ["Exit status", "stderr", "--force", "Ctrl-C", "--threads", "sample", "kernels"] {
        assert!(help.contains(word), "{word}");
    }
    let help = folder.succeed("sample --help").stdout;
    for word in ["cubic-spline", "wendland-c6", "i16f16", "corrected", ".npz", ".vti", "demo:vortex"] {
        assert!(help.contains(word), "{word}");
    }
    assert!(folder.succeed("--version").stdout.starts_with("fluisim "));
}

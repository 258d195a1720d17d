//! Text tables as spreadsheets and numpy.savetxt write them.

use crate::support::Folder;

const PLAIN: &str = "x,y,m,A\n0,0,1,3\n0.5,0,1,4e-1\n0,-0.5,1,5\n";
const WORDS: &str = "--support 1.5 --at-particles";

#[test]
fn semicolons_units_and_commented_headers_are_taken() {
    let folder = Folder::with("p.csv", PLAIN);
    let expected = folder.succeed(&format!("sample p.csv {WORDS}")).stdout;
    let semicolons = PLAIN.replace(',', ";");
    let units = |row: &str, text: &str| text.replacen('\n', &format!("\n{row}\n"), 1);
    for variant in [
        semicolons.clone(),
        semicolons.replace('.', ","),
        semicolons.replace('.', ",").replace("x;y", "\"x\";y"),
        units("m,m,kg,Pa", PLAIN),
        units("[m],[m],[kg],", PLAIN),
        units("m;m;kg;-", &semicolons.replace('.', ",")),
        format!("# {PLAIN}"),
        format!("# made by numpy\n#{PLAIN}"),
        format!("# {}", semicolons.replace('.', ",")),
    ] {
        folder.write("v.csv", &variant);
        assert_eq!(folder.succeed(&format!("sample v.csv {WORDS}")).stdout, expected, "{variant}");
        let pieces = folder.succeed("sample v.csv --support 1.5 --grid 2,2 --chunk 2").stdout;
        assert_eq!(
            pieces,
            folder.succeed("sample p.csv --support 1.5 --grid 2,2 --chunk 2").stdout,
            "{variant}"
        );
    }
}

#[test]
fn lines_are_skipped_and_still_counted() {
    let folder = Folder::with("p.csv", format!("Run 12\nof, some, day\n{PLAIN}1,x,1,1\n"));
    let words = format!("sample p.csv {WORDS}");
    folder.fail_with(1, &words, &["p.csv: line 2"]);
    folder.fail_with(1, &format!("{words} --skip-lines 2"), &["p.csv: line 7", "column `y`", "`x`"]);
    folder.write("p.csv", format!("Run 12\nof, some, day\n{PLAIN}"));
    assert_eq!(folder.columns(&format!("{words} --skip-lines 2")).get("A").len(), 3);
    folder.fail_with(1, &format!("{words} --skip-lines 99"), &["p.csv", "no header"]);
    folder.write("p.vtk", "");
    folder.fail_with(2, &format!("sample p.vtk {WORDS} --skip-lines 1"), &["p.vtk", ".csv"]);
}

#[test]
fn what_only_looks_like_these_is_an_error_with_its_line() {
    let folder = Folder::new();
    for (text, parts) in [
        ("x;m\n0;1.000,5\n", &["line 2", "column `m`", "`1.000,5`"][..]),
        ("x;m\n0,5;1;2\n", &["line 2", "3 cells"]),
        ("0,1\n2,3\n", &["line 1", "`0`", "number"]),
        ("# x,y,m\n0,1\n2,3\n", &["line 2", "`0`", "number"]),
        ("x,m\nm,kg\n0,kg\n", &["line 3", "`kg`"]),
        ("x,m\nm,kg\nm,kg\n0,1\n", &["line 3", "`m`"]),
        ("x,m\nm\n0,1\n", &["line 2", "1 cell"]),
    ] {
        folder.write("p.csv", text);
        let message = folder.fail(1, &format!("sample p.csv {WORDS}"));
        for part in parts {
            assert!(message.contains(part), "{text}: `{part}` is missing in {message}");
        }
    }
}

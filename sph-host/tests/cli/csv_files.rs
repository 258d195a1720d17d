//! What a CSV file may look like.

use crate::support::Folder;

const PLAIN: &str = "x,y,m,rho,A\n0,0,1,2,3\n0.5,0,1,2,4\n0,0.5,1,2,-5e-1\n";
const WORDS: &str = "--support 1.5 --at-particles --gradient";

#[test]
fn marks_line_ends_blanks_comments_and_case_change_nothing() {
    let folder = Folder::with("p.csv", PLAIN);
    let expected = folder.succeed(&format!("sample p.csv {WORDS}")).stdout;
    assert_eq!(expected.lines().count(), 4);
    let variants = [
        PLAIN.replace('\n', "\r\n"),
        format!("\u{feff}{PLAIN}"),
        format!("\u{feff}# made by hand\r\n\r\n{}", PLAIN.replace('\n', "\r\n\r\n")),
        PLAIN.replace(',', " ,\t"),
        PLAIN.replace('\n', "\n   # a \"note\n \t \n"),
        PLAIN.replace("x,y,m,rho", "X,Y,Mass,DENSITY"),
        PLAIN.replace("x,y,m,rho", "x,\"Y\",M,Rho"),
        PLAIN.replace("0.5", "\"0.5\"").replace("-5e-1", "-.5"),
        PLAIN.trim_end().to_owned(),
        PLAIN.replace('\n', ",a \"\"b\"\"\n").replace("A,a \"\"b\"\"", "A,\"note, \"\"long\"\"\""),
    ];
    for variant in variants {
        folder.write("v.csv", &variant);
        assert_eq!(folder.succeed(&format!("sample v.csv {WORDS}")).stdout, expected, "{variant}");
    }
    folder.write("v.tsv", PLAIN.replace(',', "\t"));
    assert_eq!(folder.succeed(&format!("sample v.tsv {WORDS}")).stdout, expected);
    folder.write("order.csv", "A,rho,note,y,m,x\n3,2,,0,1,0\n4,2,b,0,1,0.5\n-.5,2,c,0.5,1,0\n");
    assert_eq!(folder.succeed(&format!("sample order.csv {WORDS}")).stdout, expected);
}

#[test]
fn text_in_a_column_that_is_not_used_does_no_harm() {
    let folder = Folder::with("p.csv", "x,y,m,A,B,kind\n0,0,1,3,1,air\n1,0,1,4,n/a,\n");
    folder.succeed("sample p.csv --support 1 --at-particles --quantity A");
    folder.fail_with(1, "sample p.csv --support 1 --at-particles", &["line 3", "`B`", "`n/a`"]);
    folder.write("q.csv", "x,y,m,A,kind\n0,0,1,3,air\n1,0,1,4,\n");
    let columns = folder.columns("sample q.csv --support 1 --at-particles");
    assert_eq!(columns.names, ["x", "y", "density", "A"]);
}

//! Plain and extended XYZ.

use crate::support::{File, read, refused, unusable, values};

const EXTENDED: &str = "3\nLattice=\"1 0 0 0 1 0 0 0 1\" note=\"a \\\" Properties=x:R:1 \" Properties=species:S:1:pos:R:3:velo:R:2:id:I:1:fixed:L:1 time=0.5\n\
    Si 0 1 2 0.1 0.2 7 true\n  O  1e-3\t4 5 .3 .4 8 F \nH 6 7 8 5 6 9 T\n\n";

#[test]
fn columns_are_what_the_comment_says() {
    let table = read("p.xyz", EXTENDED);
    assert_eq!(table.coordinates, [[0.0, 1e-3, 6.0], [1.0, 4.0, 7.0], [2.0, 5.0, 8.0]]);
    let velocity = table.quantity("velo").unwrap();
    assert_eq!(velocity.labels, ["velo_x", "velo_y"]);
    assert_eq!(*velocity.values, [0.1, 0.2, 0.3, 0.4, 5.0, 6.0]);
    assert_eq!((values(&table, "id"), values(&table, "fixed")), (vec![7.0, 8.0, 9.0], vec![1.0, 0.0, 1.0]));
    assert_eq!(table.default_quantities(), ["velo", "id", "fixed"], "text is not among them");
    assert_eq!(unusable(&table, "species"), "line 3, column `species`: `Si` where a number is expected");
    assert_eq!((table.locate(0), table.locate(2)), ("line 3".to_owned(), "line 5".to_owned()));
    let quoted = EXTENDED.replace("Properties=s", "properties=\"s").replace("fixed:L:1", "fixed:L:1\"");
    assert_eq!(values(&read("p.xyz", quoted.replace('\n', "\r\n")), "id"), [7.0, 8.0, 9.0]);
    let axes = "2\nProperties=x:R:1:m:R:1:y:I:1\n1 2 3\n4 5 6";
    let table = read("p.xyz", axes);
    assert_eq!(
        (table.coordinates.len(), table.mass().unwrap().unwrap().values.to_vec()),
        (2, vec![2.0, 5.0])
    );
}

#[test]
fn without_properties_the_columns_are_species_and_coordinates() {
    let table = read("p.xyz", "\u{feff}2\n\n1 0 1 2 3 4\n2 5 6 7 8 9\n");
    assert_eq!(table.coordinates, [[0.0, 5.0], [1.0, 6.0], [2.0, 7.0]]);
    assert_eq!((values(&table, "array_4"), values(&table, "array_5")), (vec![3.0, 8.0], vec![4.0, 9.0]));
    assert!(table.quantity("species").is_err(), "what is text stays text, whatever it looks like");
    let table = read("p.xyz", "1\nany words = here\nH 0 1 2 note\n");
    assert_eq!(unusable(&table, "array_4"), "line 3, column `array_4`: `note` where a number is expected");
    let empty = read("p.xyz", "0\n\n");
    assert_eq!((empty.len(), empty.dimensions()), (0, 3));
}

#[test]
fn a_second_frame_is_an_error_that_says_so() {
    let message = refused("p.xyz", format!("{EXTENDED}{EXTENDED}"));
    assert_eq!(message, "p.xyz: line 7: a second frame starts here, where a file of one frame is expected");
    let message = refused("p.xyz", format!("{EXTENDED}H 1 2 3 4 5 6 T\n"));
    assert!(message.ends_with("line 7: `H 1 2 3 4 5 6 T` behind the last of 3 particles"), "{message}");
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let one = |properties: &str, line: &str| format!("1\nProperties={properties}\n{line}\n");
    for (file, words) in [
        ("H 0 0 0\n".to_owned(), "line 1: `H 0 0 0` where the number of particles is expected"),
        ("-1\n\n".to_owned(), "line 1: `-1` where the number of particles is expected"),
        ("3".to_owned(), "line 1: the file ends before its comment on line 2"),
        ("3\n\nH 0 0 0\n".to_owned(), "line 3: the particles end after 1, where line 1 has 3 particles"),
        (
            "2\n\nH 0 0 0\n\nH 0 0 0\n".to_owned(),
            "line 4: the particles end after 1, where line 1 has 2 particles",
        ),
        (
            "99999999999\n\nH 0 0 0\n".to_owned(),
            "line 3: the particles end after 1, where line 1 has 99999999999",
        ),
        ("1\n\n0 0 0\n".to_owned(), "line 3: 3 words where `species x y z` are expected"),
        ("2\n\nH 0 0 0\nH 0 0\n".to_owned(), "line 4: 3 words where 4 are expected"),
        (one("pos:R:3:id:I:1", "0 0 0"), "line 3: 3 words where 4 are expected"),
        (one("pos:R:3", "0 0 none"), "line 3, column `pos`: `none` where a number is expected"),
        (one("pos:R:3:id", "0 0 0 1"), "line 2: Properties=`pos:R:3:id` where name:type:width"),
        (one("", "0 0 0 1"), "line 2: Properties=`` where name:type:width"),
        (one("pos:R:0", "0"), "line 2: column `pos` has `0` where a width of 1 or more is expected"),
        (one("pos:R:4", "0 0 0 0"), "line 2: `pos` has 4 numbers a point, where 1 to 3 are expected"),
        (one("pos:Q:3", "0 0 0"), "line 2: column `pos` has `Q` where a type S, R, I or L is expected"),
        (one("pos:S:3", "a b c"), "line 3, column `pos`: `a` where a number is expected"),
        (one(":R:3", "0 0 0"), "line 2: column `` has `` where a name is expected"),
        (one("a:R:1:a:R:1", "0 0"), "line 2: the name `a` of number 2 is taken"),
        (one("pos:R:2:x:R:1", "0 0 0"), "line 2: coordinates are in `x` and in `pos`"),
        (one("species:S:1:a:R:1", "H 0"), "line 2: no column is called `x`; there are `species`, `a`"),
        (one("a:R:1000000000", "0"), "line 2: 1000000000 numbers a point, where at most 4096 are read"),
    ] {
        let message = refused("p.xyz", &file);
        assert!(message.contains(words), "{message} for {file}");
    }
}

#[test]
fn every_truncation_is_an_error() {
    let end = EXTENDED.trim_end().len();
    let file = File::new("p.xyz", "");
    for cut in 0..EXTENDED.len() {
        file.rewrite(&EXTENDED.as_bytes()[..cut]);
        assert_eq!(file.read().is_ok(), cut >= end, "{cut}");
    }
}

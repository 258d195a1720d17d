//! The Stanford polygon format.

use crate::support::{read, refused, unusable, values};

const TYPES: [(&str, &str, f64); 8] = [
    ("char", "int8", -7.0),
    ("uchar", "uint8", 200.0),
    ("short", "int16", -300.0),
    ("ushort", "uint16", 65_000.0),
    ("int", "int32", -70_000.0),
    ("uint", "uint32", 4e9),
    ("float", "float32", 0.25),
    ("double", "float64", 0.1),
];

/// The bytes of `value` as the type with the number `index`.
fn stored(index: usize, value: f64, is_big: bool) -> Vec<u8> {
    let mut bytes = match index {
        0 => (value as i8).to_le_bytes().to_vec(),
        1 => (value as u8).to_le_bytes().to_vec(),
        2 => (value as i16).to_le_bytes().to_vec(),
        3 => (value as u16).to_le_bytes().to_vec(),
        4 => (value as i32).to_le_bytes().to_vec(),
        5 => (value as u32).to_le_bytes().to_vec(),
        6 => (value as f32).to_le_bytes().to_vec(),
        _ => value.to_le_bytes().to_vec(),
    };
    if is_big {
        bytes.reverse();
    }
    bytes
}

#[test]
fn every_type_by_both_names_in_every_coding() {
    for (coding, is_long) in
        [("ascii", true), ("binary_little_endian", false), ("binary_big_endian", true), ("ascii", false)]
    {
        let mut file =
            format!("ply\r\nformat {coding} 1.0\r\ncomment é\nelement vertex 2\nproperty double x\n");
        for (short, long, _) in TYPES {
            file += &format!("property {} a_{short}\n", if is_long { long } else { short });
        }
        file += "end_header\n";
        let mut bytes = file.into_bytes();
        for row in 0..2 {
            if coding == "ascii" {
                let words = TYPES.map(|(.., value)| value.to_string()).join("\t ");
                bytes.extend(format!("{row} {words}\r\n\n").into_bytes());
                continue;
            }
            let is_big = coding == "binary_big_endian";
            bytes.extend(stored(7, f64::from(row), is_big));
            for (index, (.., value)) in TYPES.iter().enumerate() {
                bytes.extend(stored(index, *value, is_big));
            }
        }
        let table = read("p.PLY", &bytes);
        assert_eq!(table.coordinates, [[0.0, 1.0]], "{coding}");
        for (name, _, value) in TYPES {
            assert_eq!(values(&table, &format!("a_{name}")), [value; 2], "{coding} {name}");
        }
        // Every truncation of the data is an error, but for the blanks at the end of a text.
        let end = bytes.trim_ascii_end().len();
        for cut in 0..end.min(bytes.len()) {
            let file = &bytes[..cut];
            let is_number_cut = coding == "ascii" && cut + 2 >= end;
            assert!(
                is_number_cut || crate::support::File::new("p.ply", file).read().is_err(),
                "{coding} {cut}"
            );
        }
    }
}

const LISTS: &str = "property list uchar short near\n";

#[test]
fn lists_are_passed_over_and_other_elements_too() {
    let header = |coding: &str| {
        format!(
            "ply\nformat {coding} 1.0\nelement face 2\nproperty list uchar int corners\nproperty uchar kind\n\
             element nothing 3\nelement vertex 2\nproperty float y\n{LISTS}property uchar x\nelement edge 7\n\
             property int a\nend_header\n"
        )
    };
    let text = header("ascii") + "2 1 2 9\n0 9\n\n10 3 1 2 3 20\n11 0 21\n";
    let mut binary = header("binary_big_endian").into_bytes();
    binary.extend([2, 0, 0, 0, 1, 0, 0, 0, 2, 9, 0, 9]);
    for (y, near, x) in [(10.0_f32, 3, 20), (11.0, 0, 21)] {
        binary.extend(y.to_be_bytes());
        binary.push(near);
        binary.extend(vec![0; 2 * usize::from(near)]);
        binary.push(x);
    }
    for table in [read("p.ply", text), read("p.ply", &binary)] {
        assert_eq!(table.coordinates, [[20.0, 21.0], [10.0, 11.0]]);
        assert!(table.default_quantities().is_empty());
        assert!(unusable(&table, "near").starts_with("array `near`: a list"));
    }
    let end = binary.len();
    for cut in 1..=20 {
        let message = refused("p.ply", &binary[..end - cut]);
        assert!(message.starts_with("p.ply: line ") && message.contains("element `"), "{message}");
    }
}

#[test]
fn a_word_that_is_no_number_harms_its_own_property_alone() {
    let start = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float a\nproperty float b\nend_header\n";
    let table = read("p.ply", format!("{start}0 1 2\n1 none 3\n"));
    assert_eq!(values(&table, "b"), [2.0, 3.0]);
    assert_eq!(unusable(&table, "a"), "line 9, column `a`: `none` where a number is expected");
    let table = read("p.ply", format!("{start}0 1 2\n1 -nan 3\n"));
    let error = table.require_finite(&table.quantity("a").unwrap()).unwrap_err().to_string();
    assert!(error.contains("line 9, column `a`"), "{error}");
    let message = refused("p.ply", format!("{start}0 1 2\n1 3\n"));
    assert_eq!(message, "p.ply: line 9: 2 words where 3 are expected");
    let message = refused("p.ply", format!("{start}0 1 2\n1 3 4 5\n"));
    assert_eq!(message, "p.ply: line 9: 4 words where 3 are expected");
    let message = refused("p.ply", format!("{start}0 1 2\n"));
    assert_eq!(message, "p.ply: line 3, element `vertex`: the data end after 1 of 2 lines");
    let message = refused("p.ply", format!("{start}none 1 2\n1 2 3\n"));
    assert_eq!(message, "p.ply: line 8, column `x`: `none` where a number is expected");
}

#[test]
fn what_is_wrong_with_a_header_is_named() {
    let vertex = "element vertex 1\nproperty float x\n";
    for (header, words) in [
        ("plx\n".to_owned(), "line 1: `plx` where `ply` is expected"),
        ("ply\nformat ascii 1.0\n".to_owned(), "line 2: the header ends without `end_header`"),
        (format!("ply\n{vertex}end_header\n"), "line 4: the header has no line `format`"),
        ("ply\nformat ascii 2.0\n".to_owned(), "line 2: `format ascii 2.0` where"),
        ("ply\nformat utf8 1.0\n".to_owned(), "ascii, binary_little_endian or binary_big_endian is expected"),
        ("ply\nformat ascii 1.0\nformat ascii 1.0\n".to_owned(), "line 3: a second line `format`"),
        ("ply\nelement vertex -1\n".to_owned(), "line 2: `element vertex -1` where"),
        ("ply\nproperty float x\n".to_owned(), "line 2: a property before the first element"),
        ("ply\nelement vertex 1\nproperty half x\n".to_owned(), "line 3: `property half x` where"),
        (
            "ply\nelement vertex 1\nproperty list float int x\n".to_owned(),
            "line 3: `property list float int x`",
        ),
        (
            "ply\nformat ascii 1.0\nelement face 1\nend_header\n".to_owned(),
            "no element is called `vertex`; there are `face`",
        ),
        (
            "ply\nformat ascii 1.0\nend_header\n".to_owned(),
            "no element is called `vertex`; there are none at all",
        ),
        (
            format!("ply\nformat ascii 1.0\n{vertex}{vertex}end_header\n"),
            "line 5, element `vertex`: a second element `vertex`",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float a\nend_header\n1\n".to_owned(),
            "line 3: no column is called `x`; there are `a`",
        ),
        (
            format!("ply\nformat ascii 1.0\n{vertex}property int X\nend_header\n1 1\n"),
            "line 3, element `vertex`: the name `X` of number 2 is taken",
        ),
        (
            format!("ply\nformat ascii 1.0\n{vertex}property int a\nproperty int z\nend_header\n1 1 1\n"),
            "there is a `z` but no `y`",
        ),
    ] {
        let message = refused("p.ply", &header);
        assert!(message.contains(words), "{message} for {header}");
    }
}

#[test]
fn claims_beyond_the_file_are_refused() {
    for count in ["9000000000", "18446744073709551615"] {
        for coding in ["ascii", "binary_little_endian"] {
            for property in ["", LISTS] {
                let start = format!("ply\nformat {coding} 1.0\n");
                let vertex = format!("element vertex {count}\nproperty double x\n{property}end_header\n");
                let message = refused("p.ply", format!("{start}{vertex}"));
                assert!(message.contains("element `vertex`"), "{message}");
                let face = format!("element face {count}\nproperty double x\n{property}");
                let message = refused("p.ply", format!("{start}{face}{vertex}"));
                assert!(message.contains("element `face`"), "{message}");
            }
        }
    }
    // A list of 4 294 967 295 items in a file of a few bytes.
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty list uint double a\nproperty char x\nend_header\n".to_vec();
    bytes.extend([0xff; 4]);
    let message = refused("p.ply", &bytes);
    assert!(
        message.ends_with(
            "number 0, property `a`: a list of 4294967295 items is claimed, but only 0 bytes follow"
        ),
        "{message}"
    );
}

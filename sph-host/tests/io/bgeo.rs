//! Houdini's classic binary geometry.

use crate::support::{File, read, refused, unusable, values};

fn text(value: &str) -> Vec<u8> {
    [&(value.len() as u16).to_be_bytes(), value.as_bytes()].concat()
}

/// The declaration of an attribute of so many values of a type.
fn attribute(name: &str, size: u16, kind: u32) -> Vec<u8> {
    let defaults = vec![0; 4 * usize::from(size)];
    [&text(name)[..], &size.to_be_bytes(), &kind.to_be_bytes(), &defaults].concat()
}

fn header(version: u32, points: u32, attributes: u32) -> Vec<u8> {
    let numbers = [version, points, 0, 0, 0, attributes, 0, 0, 0];
    [&b"BgeoV"[..], &numbers.map(u32::to_be_bytes).concat()].concat()
}

/// Two points at (i, 2 i, −i) with an id, a velocity, a text and a density.
fn file() -> Vec<u8> {
    let mut bytes = header(5, 2, 4);
    bytes.extend(attribute("id", 1, 1));
    bytes.extend(attribute("velocity", 3, 5));
    bytes.extend([&text("kind")[..], &[0, 1, 0, 0, 0, 4, 0, 0, 0, 2], &text("fluid"), &text("")].concat());
    bytes.extend(attribute("density", 1, 0));
    for i in [1_i16, 2] {
        let i = f32::from(i);
        bytes.extend([i, 2.0 * i, -i, 1.0].map(f32::to_be_bytes).concat());
        bytes.extend((-7 * i as i32).to_be_bytes());
        bytes.extend([0.5 * i, 0.25, i].map(f32::to_be_bytes).concat());
        bytes.extend([0, 0, 0, 1]);
        bytes.extend((1000.0 + i).to_be_bytes());
    }
    bytes
}

#[test]
fn attributes_are_arrays() {
    // What follows the points is not theirs.
    let table = read("p.bgeo", [&file()[..], &[0, 0xff]].concat());
    assert_eq!(table.coordinates, [[1.0, 2.0], [2.0, 4.0], [-1.0, -2.0]]);
    assert_eq!(values(&table, "id"), [-7.0, -14.0]);
    assert_eq!(values(&table, "velocity"), [0.5, 0.25, 1.0, 1.0, 0.25, 2.0]);
    assert_eq!(*table.density().unwrap().unwrap().values, [1001.0, 1002.0]);
    assert_eq!(unusable(&table, "kind"), "array `kind`: texts where numbers are expected");
    assert_eq!(table.default_quantities(), ["id", "velocity"]);
    assert_eq!(table.arrays.len(), 4, "the weight is none of them");
    assert_eq!(read("p.bgeo", header(5, 0, 0)).len(), 0);
}

#[test]
fn every_truncation_is_an_error() {
    let whole = file();
    let file = File::new("p.bgeo", &whole);
    assert!(file.read().is_ok());
    for cut in 0..whole.len() {
        file.rewrite(&whole[..cut]);
        assert!(file.read().is_err(), "{cut}");
    }
}

#[test]
fn what_is_wrong_is_named() {
    let one = |attribute: Vec<u8>| [&header(5, 1, 1)[..], &attribute, &[0; 20]].concat();
    for (bytes, words) in [
        (b"Bgeo".to_vec(), "`Bgeo` where the classic geometry of version 5 is expected"),
        (b"\x7fNSJ\x01".to_vec(), "Houdini's newer geometry where the classic"),
        (header(4, 0, 0), "header: version 4 where 5 is expected"),
        (header(5, 1, 0), "byte 41: the header claims 1 point of 16 bytes, but only 0 bytes follow"),
        (header(5, u32::MAX, 0), "byte 41: the header claims 4294967295 points of 16 bytes"),
        (header(5, 0, u32::MAX), "attribute 0, byte 41: the file ends here"),
        (one(attribute("a", 1, 2)), "attribute 0, byte 41: `a` has the type 2 where 0 (float)"),
        (one(attribute("a", 0, 0)), "`a` has no numbers a point"),
        (one(attribute("a", 5000, 0)), "`a` has 5000 numbers a point, where at most 4096"),
        (
            one([&text("a")[..], &[0, 1, 0, 0, 0, 4], &[0xff; 4]].concat()),
            "attribute 0, byte 41: the file ends here",
        ),
        (one([&[0, 1, 0xff][..], &[0; 8]].concat()), "is not UTF-8"),
    ] {
        let message = refused("p.bgeo", &bytes);
        assert!(message.contains(words), "{message} where {words}");
    }
    let twice = [&header(5, 0, 2)[..], &attribute("a", 1, 0), &attribute("a", 1, 1)].concat();
    assert!(refused("p.bgeo", twice).contains("the name `a` of number 2 is taken"));
    let nameless = [&header(5, 0, 1)[..], &attribute("", 1, 0)].concat();
    assert_eq!(read("p.bgeo", nameless).arrays[0].name, "array_0");
}

//! Single arrays of NumPy.

use sph_host::io::InputFile;
use zip::CompressionMethod;

use crate::support::{File, archive, npy, read, refused, three_points, unusable, values};

/// A file of records with these fields.
fn records(fields: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let mut bytes = npy(shape, &[]);
    let text = String::from_utf8_lossy(&bytes[10..]).replace("'<f8'", fields);
    bytes.truncate(8);
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.as_bytes());
    bytes.extend(data);
    bytes
}

const FIELDS: &str = "[('x', '>f8'), ('shape', '|u1'), ('', '|V3'), (('title', 'vel'), '<f4', (2,)), ('t', '<U1'), \
    ('fortran_order', '<i2', 1), ('in', [('a', '<f8'), ('b', '|b1')]), ('m', '>f2', ())]";

/// Two records of `FIELDS`.
fn data() -> Vec<u8> {
    let mut data = Vec::new();
    for (x, shape, velocity, order) in [(0.1_f64, 7_u8, [1.5_f32, 2.5], -3_i16), (0.2, 8, [3.5, 4.5], 4)] {
        data.extend(x.to_be_bytes());
        data.extend([shape, 0xee, 0xee, 0xee]);
        data.extend(velocity.iter().flat_map(|value| value.to_le_bytes()));
        data.extend([b'a', 0, 0, 0]);
        data.extend(order.to_le_bytes());
        data.extend([0xdd; 9]);
        data.extend([0x3e, 0x00]);
    }
    data
}

#[test]
fn fields_are_arrays_wherever_they_stand_in_a_record() {
    let table = read("p.npy", records(FIELDS, "(2,)", &data()));
    assert_eq!(table.coordinates, [[0.1, 0.2]]);
    assert_eq!(values(&table, "shape"), [7.0, 8.0]);
    assert_eq!((values(&table, "vel"), values(&table, "vel_y")), (vec![1.5, 2.5, 3.5, 4.5], vec![2.5, 4.5]));
    assert_eq!(values(&table, "fortran_order"), [-3.0, 4.0]);
    assert_eq!(*table.mass().unwrap().unwrap().values, [1.5, 1.5]);
    assert_eq!(unusable(&table, "t"), "array `t`: values of type <U1 where numbers are expected");
    assert_eq!(unusable(&table, "in"), "array `in`: records where numbers are expected");
    assert_eq!(table.default_quantities(), ["shape", "vel", "fortran_order"]);
}

#[test]
fn positions_alone_are_coordinates() {
    let numbers = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    assert_eq!(read("p.npy", npy("(3, 2)", &numbers)).coordinates, [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0]]);
    assert_eq!(read("p.npy", npy("(6, 1)", &numbers)).coordinates, [numbers]);
    for shape in ["()", "(6,)", "(1, 6)", "(1, 2, 3)"] {
        let message = refused("p.npy", npy(shape, &numbers[..if shape == "()" { 1 } else { 6 }]));
        assert!(message.contains("[points, 1 to 3], or records with fields, are expected"), "{message}");
    }
}

#[test]
fn positions_may_be_a_field() {
    let data: Vec<u8> = (0..6).collect();
    let table = read("p.npy", records("[('Pos', '|u1', (2,)), ('a', '|i1')]", "(2,)", &data));
    assert_eq!((table.coordinates.len(), values(&table, "a")), (2, vec![2.0, 5.0]));
    assert_eq!(table.coordinates, [[0.0, 3.0], [1.0, 4.0]]);
    let message = refused("p.npy", records("[('pos', '|u1', (2,)), ('x', '|i1')]", "(2,)", &data));
    assert!(message.ends_with("coordinates are in `x` and in `pos`: one of them is expected"), "{message}");
}

#[test]
fn what_is_wrong_is_named() {
    let x = "[('x', '<f8')]";
    for (fields, shape, bytes, words) in [
        (x, "(2,)", 15, "15 bytes for 2 records of 8 bytes"),
        (x, "(2,)", 17, "17 bytes for 2 records of 8 bytes"),
        (x, "(2305843009213693953,)", 8, "8 bytes for 2305843009213693953 records of 8 bytes"),
        (x, "(1, 2)", 16, "records of shape [1, 2], where [points] is expected"),
        (x, "()", 8, "records of shape [], where [points] is expected"),
        ("[('x', '|S0')]", "(1000000000000,)", 0, "0 bytes for 1000000000000 records of 0 bytes"),
        ("[('a', '<f8')]", "(1,)", 8, "no array is called `x` or `pos`; there are `a`"),
        ("[('x', '<U2')]", "(1,)", 8, "array `x`: values of type <U2 where numbers are expected"),
        ("[('x', '<f4', (2,))]", "(1,)", 8, "array `x`: 2 numbers a point, where one is expected"),
        ("[('', '|V8')]", "(1,)", 8, "the records have no fields with a name"),
        ("[('x', '|O')]", "(1,)", 8, "the header has fields that are not those of NumPy"),
        ("[('x', '<f8', (1, 4611686018427387904, 4))]", "(1,)", 8, "fields that are not those of NumPy"),
        ("['x']", "(1,)", 8, "fields that are not those of NumPy"),
        ("[('x', '<f8'), ('x', '<f8')]", "(1,)", 16, "the name `x` of number 2 is taken"),
        ("[('x', '<f8'), ('a', '|u1'), ('a', '|u1')]", "(1,)", 10, "the name `a` of number 3 is taken"),
        ("'|O'", "(1, 1)", 8, "values of type |O where numbers are expected"),
        ("None", "(1, 1)", 8, "is not one of NumPy"),
    ] {
        let message = refused("p.npy", records(fields, shape, &vec![0; bytes]));
        assert!(message.contains(words), "{message} for {fields}");
    }
}

#[test]
fn every_truncation_is_an_error() {
    for whole in [records(FIELDS, "(2,)", &data()), npy("(2, 2)", &[1.0, 2.0, 3.0, 4.0])] {
        let file = File::new("p.npy", &whole);
        assert!(file.read().is_ok());
        for cut in 0..whole.len() {
            file.rewrite(&whole[..cut]);
            assert!(file.read().is_err(), "{cut}");
        }
    }
}

#[test]
fn records_in_an_archive_are_told_what_is_expected() {
    let member = records("[('x', '<f8')]", "(3,)", &[0; 24]);
    let words =
        "records of several fields, where numbers are expected: each field is to be an array of its own";
    let file = File::new("p.npz", three_points(&[("a.npy", member.clone())]));
    for table in [file.read().unwrap(), file.pieces().unwrap().remove(0)] {
        assert_eq!(unusable(&table, "a"), format!("array `a`: {words}"));
    }
    let message = refused("p.npz", archive(&[("x.npy", member)], CompressionMethod::Stored));
    assert_eq!(message, format!("p.npz: array `x`: {words}"));
}

/// 3 N numbers in a row could be the coordinates of N points: nobody is to take them for 3 N points on a line unasked.
#[test]
fn one_row_of_positions_is_refused_unless_it_is_named() {
    let flat =
        archive(&[("pos.npy", npy("(6,)", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0]))], CompressionMethod::Stored);
    let message = refused("p.npz", &flat);
    assert_eq!(message, "p.npz: `pos` has the shape [6] where [points, 1 to 3] is expected");
    let file = File::new("p.npz", &flat);
    let named = InputFile { position: vec!["pos".to_owned()], ..file.1.as_path().into() };
    assert_eq!((named.read().unwrap().dimensions(), named.read().unwrap().len()), (1, 6));
    let column = archive(&[("pos.npy", npy("(6, 1)", &[0.0; 6]))], CompressionMethod::Stored);
    assert_eq!(read("p.npz", column).dimensions(), 1);
}

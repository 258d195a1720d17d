//! Points in extended XYZ and in PLY.

use sph_host::output::{Column, Precision, Table};

use super::{bits, bytes, doubles, table};

#[test]
fn extended_xyz_says_what_its_columns_are_and_holds_every_bit() {
    for precision in [Precision::F32, Precision::F64] {
        let mut table = table(true, precision);
        table.columns[1].values[..3].copy_from_slice(&[f64::INFINITY, -0.0, f64::NEG_INFINITY]);
        let text = String::from_utf8(bytes(&table, "xyz")).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next().unwrap(), "12");
        assert_eq!(lines.next().unwrap(), "Properties=species:S:1:pos:R:3:density:R:1:a__b___:R:1");
        for (point, position) in table.positions().enumerate() {
            let words: Vec<&str> = lines.next().unwrap().split(' ').collect();
            assert_eq!((words.len(), words[0]), (6, "X"));
            let numbers: Vec<f64> = words[1..4].iter().map(|word| word.parse().unwrap()).collect();
            assert_eq!(bits(&numbers), bits(&position));
            for (column, word) in table.columns.iter().zip(&words[4..]) {
                let read = match precision {
                    Precision::F64 => word.parse::<f64>().unwrap(),
                    Precision::F32 => f64::from(word.parse::<f32>().unwrap()),
                };
                assert_eq!(bits(&[read]), bits(&[column.values[point]]), "{word}");
            }
        }
        assert_eq!(lines.next(), None);
    }
}

#[test]
fn coordinates_that_a_table_lacks_are_zero_in_xyz_and_ply() {
    let table = Table {
        coordinates: vec![Column::coordinate(1, vec![0.1])],
        columns: vec![Column::new("z", vec![2.0]), Column::new("pos", vec![3.0]), Column::new("", vec![4.0])],
        grid: None,
        precision: Precision::F64,
        caption: String::new(),
    };
    let text = String::from_utf8(bytes(&table, "xyz")).unwrap();
    let properties = "species:S:1:pos:R:3:z:R:1:pos_:R:1:array_2:R:1";
    assert_eq!(text, format!("1\nProperties={properties}\nX 0.0 0.1 0.0 2.0 3.0 4.0\n"));
    let ply = bytes(&table, "ply");
    let header = b"ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty double z\n\
        property double z_\nproperty double pos\nproperty double array_2\nend_header\n";
    assert!(ply.starts_with(header));
    assert_eq!(doubles(&ply[header.len()..], false), [0.0, 0.1, 0.0, 2.0, 3.0, 4.0]);
}

#[test]
fn points_in_ply_are_vertices_with_a_property_a_column() {
    for precision in [Precision::F32, Precision::F64] {
        let table = table(false, precision);
        let (ply, kind) =
            (bytes(&table, "ply"), if precision == Precision::F32 { "float" } else { "double" });
        let header = format!(
            "ply\nformat binary_little_endian 1.0\ncomment kernel -- support\nelement vertex 12\nproperty double x\nproperty double y\n\
             property double z\nproperty {kind} density\nproperty {kind} a__b___\nend_header\n"
        );
        let (start, mut rest) = ply.split_at(header.len());
        assert_eq!(std::str::from_utf8(start).unwrap(), header);
        for (point, position) in table.positions().enumerate() {
            let (coordinates, more) = rest.split_at(24);
            assert_eq!(doubles(coordinates, false), position);
            let width = if precision == Precision::F32 { 4 } else { 8 };
            let (values, more) = more.split_at(2 * width);
            let expected = table.columns.iter().flat_map(|column| match precision {
                Precision::F32 => (column.values[point] as f32).to_le_bytes().to_vec(),
                Precision::F64 => column.values[point].to_le_bytes().to_vec(),
            });
            assert_eq!(values, expected.collect::<Vec<u8>>());
            rest = more;
        }
        assert!(rest.is_empty());
    }
}

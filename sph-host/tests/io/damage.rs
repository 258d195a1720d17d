//! Damage is seen to the last byte.

use std::io::Cursor;

use sph_host::io::ReadError;
use zip::{CompressionMethod, ZipArchive};

use crate::support::{BOTH, File, archive, npy, refused, unusable};

#[test]
fn a_flipped_bit_in_an_archive_is_a_checksum_that_does_not_fit() {
    let numbers: Vec<f64> = (0..5).map(f64::from).collect();
    let members = [("x.npy", npy("(5,)", &numbers)), ("a.npy", npy("(5,)", &numbers))];
    let mut bytes = archive(&members, CompressionMethod::Stored);
    let mut opened = ZipArchive::new(Cursor::new(&bytes)).unwrap();
    let data = opened.by_name("a.npy").unwrap().data_start().unwrap() as usize;
    bytes[data + members[1].1.len() - 1] ^= 0x40;
    let file = File::new("p.npz", &bytes);
    let message = unusable(&file.read().unwrap(), "a");
    assert!(message.contains("array `a`") && message.contains("checksum"), "{message}");
    let pieces = file.pieces().unwrap();
    let message = unusable(pieces.last().unwrap(), "a");
    assert!(message.contains("array `a`") && message.contains("checksum"), "{message}");
    // An array in use is an error at once.
    let mut opened = ZipArchive::new(Cursor::new(&bytes)).unwrap();
    let data = opened.by_name("x.npy").unwrap().data_start().unwrap() as usize;
    bytes[data + members[0].1.len() - 1] ^= 0x40;
    let message = refused("p.npz", &bytes);
    assert!(message.starts_with("p.npz: array `x`: ") && message.contains("checksum"), "{message}");
    assert!(File::new("p.npz", &bytes).pieces().is_err());
}

/// A bit in each part of an archive, stored and deflated, whole and in pieces: what is read is what was written, or an error.
#[test]
fn no_flipped_bit_in_an_archive_changes_a_number() {
    let numbers: Vec<f64> = (0..5).map(|i| f64::from(i) + 0.3).collect();
    let others: Vec<f64> = (0..10).map(|i| f64::from(i % 3) - 7.0).collect();
    for method in BOTH {
        let bytes = archive(&[("x.npy", npy("(5,)", &numbers)), ("v.npy", npy("(5, 2)", &others))], method);
        let file = File::new("p.npz", &bytes);
        let mut seen = 0;
        for bit in (0..8 * bytes.len()).step_by(5) {
            let mut damaged = bytes.clone();
            damaged[bit / 8] ^= 1 << (bit % 8);
            file.rewrite(&damaged);
            let whole = file.read();
            seen += usize::from(whole.is_err());
            if let Ok(table) = whole {
                assert_eq!(table.coordinates, [&*numbers], "bit {bit}");
                for array in &table.arrays {
                    let read = table.quantity(&array.name).map(|quantity| quantity.values.into_owned());
                    assert!(read.is_err() || read.is_ok_and(|read| read == others), "bit {bit}");
                }
            }
            if let Ok(pieces) = file.pieces() {
                let axis: Vec<f64> = pieces.iter().flat_map(|piece| piece.coordinates[0].clone()).collect();
                assert_eq!(axis, numbers, "bit {bit}");
                let read: Result<Vec<Vec<f64>>, _> = pieces
                    .iter()
                    .filter(|piece| !piece.arrays.is_empty())
                    .map(|piece| {
                        Ok::<_, ReadError>(piece.quantity(&piece.arrays[0].name)?.values.into_owned())
                    })
                    .collect();
                assert!(read.is_err() || read.is_ok_and(|read| read.is_empty() || read.concat() == others));
            }
        }
        assert!(seen > bytes.len() / 4, "{seen} errors");
    }
}

#[test]
fn no_flipped_bit_in_a_packed_block_changes_a_number() {
    no_flipped_bit_changes_a_number("raw_zlib.vtu");
    no_flipped_bit_changes_a_number("raw_lzma.vtp");
}

fn no_flipped_bit_changes_a_number(fixture: &str) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fixtures");
    let bytes = std::fs::read(folder.join(fixture)).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    let start = bytes.windows(2).position(|pair| pair == b">_").filter(|_| text.contains("AppendedData"));
    let start = start.or_else(|| bytes.windows(4).position(|w| w == b"   _").map(|at| at + 2)).unwrap() + 2;
    let file = File::new(fixture, &bytes);
    let whole = file.read().unwrap();
    let names: Vec<String> = whole.default_quantities();
    let mut refused = 0;
    for at in start..bytes.len() - 30 {
        {
            let bit = at % 8;
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            file.rewrite(&damaged);
            let Ok(table) = file.read() else {
                refused += 1;
                continue;
            };
            assert_eq!(table.coordinates, whole.coordinates, "byte {at}");
            for name in &names {
                match table.quantity(name) {
                    Ok(quantity) => {
                        assert_eq!(quantity.values, whole.quantity(name).unwrap().values, "byte {at}")
                    }
                    Err(error) => {
                        refused += 1;
                        assert!(error.to_string().contains(&format!("array `{name}`")), "{error}");
                    }
                }
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

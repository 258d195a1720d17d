//! HDF5 that is damaged: by cuts, flipped bits, and claims that lead a reader astray.

use crate::hdf5::{SAMPLES, read_group, sample};
use crate::support::{File, unusable};

/// Reads a damaged file of a sample, each of its sets.
fn survives(file: &File, bytes: &[u8]) -> bool {
    file.rewrite(bytes);
    let mut whole = true;
    for wanted in [None, Some("fluid")] {
        match read_group(&file.1, wanted) {
            // A dataset of n packed bytes has at most 1032 n.
            Ok(table) => assert!(table.len() <= 1032 * bytes.len()),
            Err(error) => {
                assert!(error.to_string().contains(".h"), "{error}");
                whole = false;
            }
        }
    }
    whole
}

#[test]
fn no_cut_and_no_flipped_bit_is_a_panic() {
    for name in SAMPLES {
        let bytes = sample(name);
        let file = File::new(name, &bytes);
        for end in (0..bytes.len()).step_by(64) {
            assert!(!survives(&file, &bytes[..end]), "{name} {end}");
        }
        for at in (0..bytes.len()).step_by(61) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << (at % 8);
            survives(&file, &damaged);
        }
    }
}

/// Every byte of every sample, with four other values each.
#[test]
#[ignore = "takes minutes"]
fn no_byte_is_a_panic() {
    for name in SAMPLES {
        let bytes = sample(name);
        let file = File::new(name, &bytes);
        for at in 0..bytes.len() {
            for value in [bytes[at] ^ 1 << (at % 8), 0xff, 0x80, bytes[at].wrapping_add(1)] {
                let mut damaged = bytes.clone();
                damaged[at] = value;
                survives(&file, &damaged);
            }
            survives(&file, &bytes[..at]);
        }
    }
}

/// A checksum of SWIFT's arrays does not fit a single changed bit.
#[test]
fn no_flipped_bit_changes_a_number_with_a_checksum() {
    let bytes = sample("swift.hdf5");
    let file = File::new("swift.hdf5", &bytes);
    let whole = file.read().unwrap();
    let mut refused = 0;
    for at in (0..bytes.len()).step_by(3) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << (at % 8);
        file.rewrite(&damaged);
        let Ok(table) = file.read() else {
            refused += 1;
            continue;
        };
        assert_eq!(table.coordinates, whole.coordinates, "byte {at}");
        for array in &whole.arrays {
            match table.quantity(&array.name) {
                Ok(quantity) => assert_eq!(*quantity.values, array.values, "byte {at}"),
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 300, "{refused}");
}

/// Claims of more points than the file can hold, in the shape of a dataset.
#[test]
fn a_shape_that_the_file_cannot_hold_is_refused() {
    let bytes = sample("gadget.hdf5");
    let file = File::new("g.hdf5", &bytes);
    let six_by_three: Vec<u8> = [6_u64, 3].iter().flat_map(|length| length.to_le_bytes()).collect();
    let at = bytes.windows(16).position(|window| window == six_by_three).unwrap();
    for length in [7_u64, 1 << 20, 1 << 40, u64::MAX] {
        let mut claimed = bytes.clone();
        claimed[at..at + 8].copy_from_slice(&length.to_le_bytes());
        file.rewrite(&claimed);
        match file.read() {
            Ok(table) => assert_eq!(table.len(), 6, "{length}"),
            Err(error) => assert!(error.to_string().contains("array `Coordinates`"), "{error}"),
        }
    }
}

/// `bytes` of a sample with old groups, its array `B` being six numbers of this type, laid out so; and `more` behind the header of
/// `B`, which ends at the place that `layout` is given.
fn with_another(
    bytes: &[u8],
    kind: Vec<u8>,
    layout: impl Fn(u64) -> Vec<u8>,
    more: impl Fn(u64) -> Vec<u8>,
) -> Vec<u8> {
    let space = [[1, 1, 0, 0, 0, 0, 0, 0], [6, 0, 0, 0, 0, 0, 0, 0]].concat();
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    let header = bytes.len() as u64;
    let place = header + 16 + 3 * 8 + (space.len() + kind.len() + layout(0).len()) as u64;
    let mut messages = Vec::new();
    for (number, message) in [(1_u16, space), (3, kind), (8, layout(place))] {
        assert!(message.len().is_multiple_of(8));
        messages.extend(number.to_le_bytes());
        messages.extend((message.len() as u16).to_le_bytes());
        messages.extend([0; 4]);
        messages.extend(message);
    }
    bytes.extend([1, 0, 3, 0, 1, 0, 0, 0]);
    bytes.extend((messages.len() as u64).to_le_bytes());
    bytes.extend(messages);
    assert_eq!(bytes.len() as u64, place);
    bytes.extend(more(place));
    let end = bytes.len() as u64;
    bytes[40..48].copy_from_slice(&end.to_le_bytes());
    // The first name in the first table of names.
    let names = bytes.windows(4).position(|word| word == b"SNOD").unwrap();
    bytes[names + 16..names + 24].copy_from_slice(&header.to_le_bytes());
    bytes
}

/// Integers of four bytes.
const INTEGER: [u8; 16] = [0x10, 8, 0, 0, 4, 0, 0, 0, 0, 0, 32, 0, 0, 0, 0, 0];

/// A sample whose array `B` is one of types in types.
fn nested(levels: usize) -> Vec<u8> {
    let kind = [[0x19, 0, 0, 0, 16, 0, 0, 0].repeat(levels), INTEGER.to_vec()].concat();
    let layout = |_| [[3, 1, 0, 8, 0, 0, 0, 0], [0, 0, 24, 0, 0, 0, 0, 0], [0; 8]].concat();
    with_another(&sample("plain.h5"), kind, layout, |_| Vec::new())
}

/// A sample whose array `B` has an index of so many levels, each of which leads to the next one twice.
fn branching(levels: u64) -> Vec<u8> {
    let node = 24 + 3 * 24 + 2 * 8;
    let layout = |place: u64| {
        let mut layout = vec![3, 2, 2];
        layout.extend(place.to_le_bytes());
        layout.extend([6, 0, 0, 0, 4, 0, 0, 0]);
        layout.resize(24, 0);
        layout
    };
    let index = |place: u64| {
        let mut index = Vec::new();
        for level in (0..levels).rev() {
            let next = place + if level == 0 { 0 } else { (levels - level) * node };
            index.extend(b"TREE\x01");
            index.extend([level as u8, 2, 0]);
            index.extend([0xff; 16]);
            for _ in 0..2 {
                index.extend([24, 0, 0, 0, 0, 0, 0, 0]);
                index.extend([0; 16]);
                index.extend(next.to_le_bytes());
            }
            index.extend([0; 24]);
        }
        index
    };
    with_another(&sample("plain.h5"), INTEGER.to_vec(), layout, index)
}

#[test]
fn an_index_that_leads_to_the_same_places_again_and_again_is_an_error() {
    let table = File::new("p.h5", branching(1)).read().unwrap();
    assert_eq!(table.quantity("B").unwrap().values.len(), 6);
    let table = File::new("p.h5", branching(40)).read().unwrap();
    let message = unusable(&table, "B");
    assert!(message.ends_with("its indexes lead to the same places too often"), "{message}");
}

#[test]
fn types_in_types_do_not_exhaust_the_stack() {
    for levels in [3, 8180] {
        let table = File::new("p.h5", nested(levels)).read().unwrap();
        let message = unusable(&table, "B");
        assert!(message.starts_with("array `B`: values of type ") && message.len() < 200, "{message}");
    }
}

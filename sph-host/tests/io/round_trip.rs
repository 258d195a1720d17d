//! What is written is read back: the same names, the same bits, in every format that is both written and read.

use std::path::PathBuf;

use proptest::prelude::*;
use sph_host::io;
use sph_host::output::{self, Column, Content, Format, Grid, Precision, Table, Target, write};

/// Names that a format could stumble over.
const NAMES: [&str; 26] = [
    "", " ", "  a", "a  ", "a b", "\t", "a,b", "\"", "a \"b\"", "'", "#", "é", "速度", "a\nb", "a\r\nb",
    "a/b", "../a", "a.npy", "%20", "1.5", "nan", "pos", "x ", " m", "METADATA", "&lt;<>&",
];

/// Any 64 bits, and those that matter most: not a number, infinite, negative zero, subnormal.
fn value() -> impl Strategy<Value = f64> {
    let special =
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 5e-324, f64::MIN_POSITIVE, f64::MAX, 0.1];
    prop_oneof![any::<u64>().prop_map(f64::from_bits), prop::sample::select(special.to_vec())]
}

fn name() -> impl Strategy<Value = String> {
    let known = prop::sample::select(NAMES.to_vec()).prop_map(str::to_owned);
    prop_oneof![known, any::<String>(), "[a-z_ ,\"']{0,6}"]
}

/// Columns of different names, none of which is a coordinate's, nor a second mass or density.
fn columns(points: usize) -> impl Strategy<Value = Vec<Column>> {
    let special =
        |name: &str| ["x", "y", "z", "m", "mass", "rho", "density"].contains(&&*name.to_lowercase());
    let column = (name(), prop::collection::vec(value(), points));
    prop::collection::vec(column, 0..5).prop_map(move |columns| {
        let mut kept: Vec<Column> = Vec::new();
        for (name, values) in columns {
            if !special(&name) && kept.iter().all(|column| column.name != name) {
                kept.push(Column::new(name, values));
            }
        }
        kept
    })
}

fn table() -> impl Strategy<Value = Table> {
    (1..=3_usize, 0..4_usize, prop::bool::ANY).prop_flat_map(|(axes, points, single)| {
        let finite = value().prop_filter("finite", |value| value.is_finite());
        let coordinates = prop::collection::vec(prop::collection::vec(finite, points), axes);
        (coordinates, columns(points), any::<String>()).prop_map(
            move |(coordinates, mut columns, caption)| {
                let precision = if single { Precision::F32 } else { Precision::F64 };
                if single {
                    let values = columns.iter_mut().flat_map(|column| &mut column.values);
                    values.for_each(|value| *value = f64::from(*value as f32));
                }
                let coordinates = ["x", "y", "z"].into_iter().zip(coordinates);
                let coordinates = coordinates.map(|(name, values)| Column::new(name, values)).collect();
                Table { coordinates, columns, grid: None, precision, caption }
            },
        )
    })
}

/// The formats that are both written and read.
fn endings(content: Content) -> impl Iterator<Item = &'static str> {
    let written = output::FORMATS.iter().filter(move |format| format.holds.contains(&content));
    written.map(|format| format.ending).filter(|ending| io::ENDINGS.contains(ending))
}

fn read_back(table: &Table, ending: &str) -> io::PointTable {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(format!("out{ending}"));
    write(table, &Target::new(&path)).unwrap();
    let read = io::read(&path).unwrap_or_else(|error| panic!("{ending}: {error}\n{table:?}"));
    // Reading in pieces gives the same, where there is reading in pieces.
    let mut pieces = Vec::new();
    match io::Pieces::open(&path, 2) {
        Ok(opened) => pieces.extend(opened.map(Result::unwrap)),
        Err(io::ReadError::NotInPieces { .. }) => return read,
        Err(error) => panic!("{error}"),
    }
    for (index, array) in read.arrays.iter().enumerate() {
        let joined: Vec<f64> = pieces.iter().flat_map(|piece| piece.arrays[index].values.clone()).collect();
        assert_eq!(joined.len(), array.values.len());
        assert!(joined.iter().zip(&array.values).all(|(a, b)| a.to_bits() == b.to_bits()), "{ending}");
    }
    read
}

/// Whether two numbers have the same bits; one NaN is as good as another in text and after a conversion to f32.
fn same(a: f64, b: f64, precision: Precision) -> bool {
    let bits = |value: f64| match precision {
        Precision::F64 => value.to_bits(),
        Precision::F32 => u64::from((value as f32).to_bits()),
    };
    a.is_nan() && b.is_nan() || bits(a) == bits(b)
}

fn check(table: &Table, ending: &str) {
    let read = read_back(table, ending);
    assert_eq!(read.len(), table.points(), "{ending}");
    for (axis, values) in read.coordinates.iter().enumerate() {
        // VTK has three coordinates; those that a table lacks are zero.
        let zeros = vec![0.0; table.points()];
        let written = table.coordinates.get(axis).map_or(&zeros, |column| &column.values);
        assert!(values.iter().zip(written).all(|(a, b)| a.to_bits() == b.to_bits()), "{ending}: {values:?}");
    }
    assert!(read.dimensions() >= table.coordinates.len());
    // every point of XYZ is an atom of some species
    let is_of_table = |array: &&io::Array| ending != ".xyz" || array.name != "species";
    let arrays: Vec<&io::Array> = read.arrays.iter().filter(is_of_table).collect();
    assert_eq!(arrays.len(), table.columns.len(), "{ending}");
    let keeps_names = Format::of(format!("out{ending}").as_ref()).unwrap().keeps_names;
    for (array, column) in arrays.into_iter().zip(&table.columns) {
        if keeps_names && !column.name.is_empty() {
            assert_eq!(array.name, column.name, "{ending}");
        }
        assert!(!array.name.is_empty());
        let quantity = read.quantity(&array.name).unwrap();
        assert_eq!(quantity.values.len(), column.values.len(), "{ending} {:?}", column.name);
        let mut pairs = quantity.values.iter().zip(&column.values);
        assert!(pairs.all(|(&a, &b)| same(a, b, table.precision)), "{ending}: {array:?} {column:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn every_table_is_read_back_to_the_bit(table in table()) {
        endings(Content::Points).for_each(|ending| check(&table, ending));
    }
}

#[test]
fn every_awkward_name_is_read_back() {
    assert!(endings(Content::Points).count() >= 5);
    for ending in endings(Content::Points) {
        for name in NAMES {
            let table = Table {
                coordinates: vec![Column::new("x", vec![0.5, -0.0])],
                columns: vec![
                    Column::new(name, vec![f64::NAN, f64::INFINITY]),
                    Column::new("b", vec![1.0, 2.0]),
                ],
                grid: None,
                precision: Precision::F64,
                caption: "two\nlines -->".to_owned(),
            };
            check(&table, ending);
        }
    }
}

#[test]
fn a_grid_is_read_back_where_its_format_is_read() {
    let bounds = [[0.0, -1.0, 5.0], [3.0, 1.0, 5.5]];
    for counts in [&[4][..], &[3, 2], &[3, 2, 2]] {
        let axes = counts.len();
        let grid = Grid::new(counts, &bounds[0][..axes], &bounds[1][..axes]).unwrap();
        let values: Vec<f64> = (0..grid.cells()).map(|cell| 1.0 / (cell as f64 + 1.0)).collect();
        let table = Table {
            coordinates: grid.coordinates(),
            columns: vec![Column::new("density", values.clone())],
            grid: Some(grid),
            precision: Precision::F64,
            caption: String::new(),
        };
        for ending in endings(Content::Grid) {
            let read = read_back(&table, ending);
            assert_eq!(*read.quantity("density").unwrap().values, values, "{ending}");
            for (read, written) in read.coordinates.iter().zip(&table.coordinates) {
                let mut pairs = read.iter().zip(&written.values);
                assert!(pairs.all(|(a, b)| (a - b).abs() <= 1e-14), "{ending}: {read:?}");
            }
        }
    }
}

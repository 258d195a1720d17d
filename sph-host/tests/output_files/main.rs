//! Binary files, read back byte by byte: npz, legacy VTK, VTK's XML; points in XYZ and PLY.

mod points;

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use sph_host::output::{Column, FORMATS, Grid, Precision, Table, Target, write};

/// 3 × 2 × 2 cells, or as many points, with a value missing and a name that needs care.
fn table(on_grid: bool, precision: Precision) -> Table {
    let grid = Grid::new(&[3, 2, 2], &[0.0, -1.0, 5.0], &[3.0, 1.0, 5.5]).unwrap();
    let mut density: Vec<f64> = (0..12).map(|cell| f64::from(1.0_f32 / (cell as f32 + 3.0))).collect();
    density[7] = f64::NAN;
    Table {
        coordinates: grid.coordinates(),
        columns: vec![
            Column::new("density", density),
            Column::new("a <b> %", (0..12).map(f64::from).collect()),
        ],
        grid: on_grid.then_some(grid),
        precision,
        caption: String::from("kernel -- support é"),
    }
}

fn bytes(table: &Table, ending: &str) -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let target = Target::new(directory.path().join(format!("out.{ending}")));
    write(table, &target).unwrap();
    fs::read(&target.path).unwrap()
}

/// Both columns' values as bits, NaN included.
fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn doubles(bytes: &[u8], big_endian: bool) -> Vec<f64> {
    let number = |chunk: &[u8]| {
        let chunk: [u8; 8] = chunk.try_into().unwrap();
        if big_endian { f64::from_be_bytes(chunk) } else { f64::from_le_bytes(chunk) }
    };
    bytes.chunks(8).map(number).collect()
}

#[test]
fn equal_tables_give_equal_bytes() {
    for format in FORMATS {
        for table in [table(true, Precision::F64), table(false, Precision::F64)] {
            if format.holds.contains(&table.content()) {
                let ending = &format.ending[1..];
                assert_eq!(bytes(&table, ending), bytes(&table, ending), "{ending}");
            }
        }
    }
}

/// The bytes behind the header that `numpy.save` writes before a one-dimensional array.
fn numpy_data<'a>(content: &'a [u8], descr: &str, count: usize) -> &'a [u8] {
    let (header, data) = content.split_at(128);
    assert_eq!(header[..10], *b"\x93NUMPY\x01\x00\x76\x00");
    let dictionary = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({count},), }}");
    assert_eq!(std::str::from_utf8(&header[10..]).unwrap(), format!("{dictionary:<117}\n"));
    data
}

#[test]
fn npz_has_an_array_a_column_of_the_right_type() {
    for precision in [Precision::F32, Precision::F64] {
        let table = table(false, precision);
        let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes(&table, "npz"))).unwrap();
        assert_eq!(archive.len(), 5);
        for (index, column) in table.all_columns().enumerate() {
            let mut file = archive.by_index(index).unwrap();
            assert_eq!(file.name().unwrap(), format!("{}.npy", column.name));
            let mut content = Vec::new();
            file.read_to_end(&mut content).unwrap();
            let single = index >= 3 && precision == Precision::F32;
            let data = numpy_data(&content, if single { "<f4" } else { "<f8" }, 12);
            let values = if single {
                let numbers = data.as_chunks().0.iter();
                numbers.map(|&number| f64::from(f32::from_le_bytes(number))).collect()
            } else {
                doubles(data, false)
            };
            assert_eq!(bits(&values), bits(&column.values), "{}", column.name);
        }
    }
}

/// The lines of text and the binary parts of a legacy file; the size of a part in bytes follows from the line before it.
struct Legacy<'a>(&'a [u8]);

impl<'a> Legacy<'a> {
    fn line(&mut self) -> &'a str {
        let end = self.0.iter().position(|&byte| byte == b'\n').unwrap();
        let (line, rest) = self.0.split_at(end);
        self.0 = &rest[1..];
        std::str::from_utf8(line).unwrap()
    }

    fn binary(&mut self, size: usize) -> &'a [u8] {
        let (part, rest) = self.0.split_at(size);
        assert_eq!(rest[0], b'\n');
        self.0 = &rest[1..];
        part
    }

    fn head(&mut self) {
        assert_eq!(self.line(), "# vtk DataFile Version 3.0");
        assert_eq!(self.line(), "kernel -- support  ");
        assert_eq!(self.line(), "BINARY");
    }

    fn values(&mut self, table: &Table) {
        assert_eq!(self.line(), "POINT_DATA 12");
        assert_eq!(self.line(), "FIELD FieldData 2");
        for (column, name) in table.columns.iter().zip(["density", "a%20<b>%20%25"]) {
            let values = if table.precision == Precision::F64 {
                assert_eq!(self.line(), format!("{name} 1 12 double"));
                doubles(self.binary(96), true)
            } else {
                assert_eq!(self.line(), format!("{name} 1 12 float"));
                self.binary(48)
                    .chunks(4)
                    .map(|c| f64::from(f32::from_be_bytes(c.try_into().unwrap())))
                    .collect()
            };
            assert_eq!(bits(&values), bits(&column.values), "{name}");
        }
        assert!(self.0.is_empty());
    }
}

#[test]
fn a_grid_in_legacy_vtk_is_structured_points() {
    for precision in [Precision::F32, Precision::F64] {
        let table = table(true, precision);
        let bytes = bytes(&table, "vtk");
        let mut file = Legacy(&bytes);
        file.head();
        assert_eq!(file.line(), "DATASET STRUCTURED_POINTS");
        assert_eq!(file.line(), "DIMENSIONS 3 2 2");
        assert_eq!(file.line(), "ORIGIN 0.5 -0.5 5.125");
        assert_eq!(file.line(), "SPACING 1.0 1.0 0.25");
        file.values(&table);
    }
}

#[test]
fn points_in_legacy_vtk_are_vertices() {
    let table = table(false, Precision::F64);
    let bytes = bytes(&table, "vtk");
    let mut file = Legacy(&bytes);
    file.head();
    assert_eq!(file.line(), "DATASET UNSTRUCTURED_GRID");
    assert_eq!(file.line(), "POINTS 12 double");
    let positions: Vec<f64> = table.positions().flatten().collect();
    assert_eq!(doubles(file.binary(288), true), positions);
    assert_eq!(file.line(), "CELLS 12 24");
    let cells: Vec<u8> =
        (0..12_i32).flat_map(|point| [1_i32.to_be_bytes(), point.to_be_bytes()].concat()).collect();
    assert_eq!(file.binary(96), cells);
    assert_eq!(file.line(), "CELL_TYPES 12");
    assert_eq!(file.binary(48), [0, 0, 0, 1].repeat(12));
    file.values(&table);
}

fn attributes(start: &BytesStart) -> BTreeMap<String, String> {
    let text = |text: &str| quick_xml::escape::unescape(text).unwrap().into_owned();
    let attributes = start.attributes().map(Result::unwrap);
    attributes.map(|attribute| (text(attribute.key.as_ref()), text(&attribute.value))).collect()
}

/// The elements of an XML file with their attributes, and the arrays' type and bytes by name.
#[derive(Default)]
struct Xml {
    elements: BTreeMap<String, BTreeMap<String, String>>,
    arrays: BTreeMap<String, (String, Vec<u8>)>,
}

impl Xml {
    fn read(bytes: &[u8]) -> Self {
        let mut xml = Self::default();
        let mut reader = Reader::from_reader(bytes);
        let mut array = None;
        loop {
            match reader.read_event().unwrap() {
                Event::Start(start) => {
                    let name = start.name().as_ref().to_owned();
                    let attributes = attributes(&start);
                    array = (name == "DataArray")
                        .then(|| (attributes["Name"].clone(), attributes["type"].clone()));
                    xml.elements.insert(name, attributes);
                }
                Event::Text(text) => {
                    if let Some((name, kind)) = array.take() {
                        xml.arrays.insert(name, (kind, decoded(text.trim())));
                    }
                }
                Event::Eof => return xml,
                _ => {}
            }
        }
    }

    fn check_values(&self, table: &Table) {
        for column in &table.columns {
            let (kind, bytes) = &self.arrays[&column.name];
            let values = if table.precision == Precision::F64 {
                assert_eq!(kind, "Float64");
                doubles(bytes, false)
            } else {
                assert_eq!(kind, "Float32");
                bytes.chunks(4).map(|c| f64::from(f32::from_le_bytes(c.try_into().unwrap()))).collect()
            };
            assert_eq!(bits(&values), bits(&column.values), "{}", column.name);
        }
    }

    fn integers(&self, name: &str) -> Vec<i64> {
        self.arrays[name].1.chunks(8).map(|chunk| i64::from_le_bytes(chunk.try_into().unwrap())).collect()
    }
}

/// Base64 of a header of 64-bit integers, base64 of zlib blocks.
fn decoded(text: &str) -> Vec<u8> {
    let words = |text: &str| -> Vec<u64> {
        let bytes = STANDARD.decode(text).unwrap();
        bytes.chunks_exact(8).map(|chunk| u64::from_le_bytes(chunk.try_into().unwrap())).collect()
    };
    let blocks = words(&text[..32])[0] as usize;
    let length = (8 * (3 + blocks)).div_ceil(3) * 4;
    let header = words(&text[..length]);
    let body = STANDARD.decode(&text[length..]).unwrap();
    assert!(header[2] < header[1].max(1), "a full last block is not a partial one");
    let mut rest = &body[..];
    let mut bytes = Vec::new();
    for (block, &size) in header[3..].iter().enumerate() {
        let (part, after) = rest.split_at(size as usize);
        let before = bytes.len();
        flate2::read::ZlibDecoder::new(part).read_to_end(&mut bytes).unwrap();
        let last = block + 1 == blocks && header[2] != 0;
        assert_eq!((bytes.len() - before) as u64, if last { header[2] } else { header[1] });
        rest = after;
    }
    assert!(rest.is_empty());
    bytes
}

#[test]
fn a_grid_in_vti_is_image_data() {
    for precision in [Precision::F32, Precision::F64] {
        let table = table(true, precision);
        let xml = Xml::read(&bytes(&table, "vti"));
        assert_eq!(xml.elements["VTKFile"]["type"], "ImageData");
        let image = &xml.elements["ImageData"];
        assert_eq!(image["WholeExtent"], "0 2 0 1 0 1");
        assert_eq!(image["Origin"], "0.5 -0.5 5.125");
        assert_eq!(image["Spacing"], "1.0 1.0 0.25");
        assert_eq!(xml.elements["Piece"]["Extent"], "0 2 0 1 0 1");
        xml.check_values(&table);
    }
}

#[test]
fn vtu_has_vertices_for_points_and_hexahedra_for_a_grid() {
    for (on_grid, corners, kind, cells) in [(false, 1, 1, 12), (true, 8, 12, 2)] {
        let table = table(on_grid, Precision::F64);
        let xml = Xml::read(&bytes(&table, "vtu"));
        assert_eq!(xml.elements["VTKFile"]["type"], "UnstructuredGrid");
        assert_eq!(xml.elements["Piece"]["NumberOfPoints"], "12");
        assert_eq!(xml.elements["Piece"]["NumberOfCells"], cells.to_string());
        let positions: Vec<f64> = table.positions().flatten().collect();
        assert_eq!(doubles(&xml.arrays["Points"].1, false), positions);
        assert_eq!(xml.integers("offsets"), (1..=cells).map(|cell| cell * corners).collect::<Vec<i64>>());
        assert_eq!(xml.arrays["types"].1, vec![kind; cells as usize]);
        let connectivity = xml.integers("connectivity");
        if on_grid {
            assert_eq!(connectivity, [0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10]);
        } else {
            assert_eq!(connectivity, (0..12).collect::<Vec<i64>>());
        }
        xml.check_values(&table);
    }
}

#[test]
fn arrays_of_many_blocks_and_of_none_read_back() {
    for points in [0, (1 << 15) * 2, 100_000] {
        let values: Vec<f64> = (0..points).map(|point| (point as f64).sin()).collect();
        let table = Table {
            coordinates: vec![Column::new("x", values.clone())],
            columns: vec![Column::new("density", values)],
            grid: None,
            precision: Precision::F64,
            caption: String::new(),
        };
        let xml = Xml::read(&bytes(&table, "vtu"));
        xml.check_values(&table);
        assert_eq!(xml.elements["Piece"]["NumberOfPoints"], points.to_string());
    }
}

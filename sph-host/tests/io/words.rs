//! Words, numbers and names as programs spell them; files that are something else.

use std::io::Read;

use sph_host::io;

use crate::support::{File, VTK, array, npy, read, refused, three_points, unusable, values, vtu};

#[test]
fn arrays_without_a_name_get_one() {
    let nameless = "<DataArray type=\"Float64\" format=\"ascii\">5 6</DataArray>";
    let empty = array("", "7 8");
    let table = read("p.vtu", vtu(&[(2, &[nameless, &empty, &array("array_1", "9 9")].concat())]));
    let names: Vec<&str> = table.arrays.iter().map(|array| array.name.as_str()).collect();
    assert_eq!(names, ["array_0", "array_1_", "array_1"]);
    assert_eq!((values(&table, "array_0"), values(&table, "array_1_")), (vec![5.0, 6.0], vec![7.0, 8.0]));
    let table = read("p.vtu", vtu(&[(2, nameless), (2, nameless)]));
    assert_eq!(values(&table, "array_0"), [5.0, 6.0, 5.0, 6.0], "the pieces' arrays are the same one");
    let nameless = three_points(&[(".npy", npy("(3,)", &[1.0, 2.0, 3.0]))]);
    assert_eq!(values(&read("p.npz", &nameless), "array_1"), [1.0, 2.0, 3.0]);
    assert_eq!(File::new("p.npz", &nameless).pieces().unwrap()[0].arrays[0].name, "array_1");
}

#[test]
fn tokens_of_legacy_vtk_are_read_wherever_lines_break() {
    let parts = [
        "DATASET POLYDATA",
        "POINTS 3 double 0 0 0 1 0 0",
        "2 0",
        "0",
        "LINES 1 3 2",
        "0",
        "1",
        "POINT_DATA 3",
        "SCALARS a double 1",
        "LOOKUP_TABLE default 1 2",
        "3",
        "VECTORS v float 1 2 3 4 5 6 7 8 9",
        "FIELD FieldData 2",
        "b 1 3 int 7",
        "8 9",
        "c 2 3 double 1 2 3 4 5 6",
        "CELL_DATA 1",
        "SCALARS d int LOOKUP_TABLE default 4",
    ];
    let check = |text: &str| {
        let table = read("p.vtk", format!("{VTK}{text}"));
        assert_eq!(table.coordinates[0], [0.0, 1.0, 2.0], "{text}");
        assert_eq!(values(&table, "a"), [1.0, 2.0, 3.0]);
        assert_eq!(values(&table, "v"), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
        assert_eq!(values(&table, "b"), [7.0, 8.0, 9.0]);
        assert_eq!(values(&table, "c_y"), [2.0, 4.0, 6.0]);
        assert_eq!(table.arrays.len(), 4);
    };
    check(&parts.join("\n"));
    let same_line = format!("{}{}", VTK.replace("ASCII\n", "ascii "), parts.join("\n"));
    assert_eq!(values(&read("p.vtk", same_line), "b"), [7.0, 8.0, 9.0]);
    check(&parts.join(" "));
    check(&parts.join("\r\n\r\n"));
    let words: Vec<&str> = parts.iter().flat_map(|part| part.split(' ')).collect();
    check(&words.join("\n"));
    check(&words.join("\t \n"));
}

#[test]
fn binary_data_of_legacy_vtk_begin_behind_the_line_of_their_keyword() {
    let mut bytes = b"# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS\n1\ndouble\n".to_vec();
    // The first byte is a blank, which belongs to the number.
    let point = [f64::from_be_bytes([0x20, 0x0a, 0x20, 0x0a, 0, 0, 0, 1]), 2.0, 3.0];
    bytes.extend(point.iter().flat_map(|value| value.to_be_bytes()));
    bytes.extend(b"\nPOINT_DATA\n1\nSCALARS a double\n1\nLOOKUP_TABLE\ndefault\n");
    bytes.extend(point[0].to_be_bytes());
    bytes.extend(b"\nSCALARS b unsigned_char \nLOOKUP_TABLE default\r\n\x20");
    let table = read("p.vtk", bytes);
    assert_eq!(table.coordinates, [[point[0]], [2.0], [3.0]]);
    assert_eq!((values(&table, "a"), values(&table, "b")), (vec![point[0]], vec![32.0]));
}

const NAN: [&str; 14] = [
    "nan",
    "-nan",
    "NaN",
    "+NAN",
    "nan(ind)",
    "-nan(ind)",
    "nan(snan)",
    "NaN(0x7ff)",
    "1.#QNAN",
    "-1.#IND",
    "1.#SNAN",
    "1.#QNAN0",
    "1.#IND00",
    "-1.#J",
];
const INFINITE: [&str; 8] = ["inf", "-inf", "Infinity", "+Inf", "1.#INF", "-1.#INF", "1.#INF00", "-infinity"];

#[test]
fn spellings_of_c_are_numbers_in_every_text() {
    for (index, word) in NAN.iter().chain(&INFINITE).enumerate() {
        let tables = [
            read("p.csv", format!("x,a\n0,1\n1,{word}\n")),
            read(
                "p.vtk",
                format!(
                    "{VTK}DATASET POLYDATA\nPOINTS 2 float 0 0 0 1 1 1\nPOINT_DATA 2\nSCALARS a float\n1 {word}"
                ),
            ),
            read("p.vtu", vtu(&[(2, &array("a", &format!("1 {word}")))])),
        ];
        for table in tables {
            let value = values(&table, "a")[1];
            assert_eq!(value.is_nan(), index < NAN.len(), "{word}");
            assert_eq!(value < 0.0, index >= NAN.len() && word.starts_with('-'), "{word}");
            let error = table.require_finite(&table.quantity("a").unwrap()).unwrap_err().to_string();
            assert!(error.contains("`a`") && error.contains("finite"), "{error}");
        }
    }
    for word in ["nan(", "nan()x", "1.#", "1.#X", "2.#INF", "nano", "infinite", "***", "#NAN"] {
        let table = read("p.csv", format!("x,a\n0,1\n1,{word}\n"));
        assert!(unusable(&table, "a").contains(&format!("`{word}`")), "{word}");
    }
}

#[test]
fn endings_that_are_not_known_are_named() {
    let error = io::read(std::path::Path::new("a.dat.gz")).unwrap_err().to_string();
    assert!(error.starts_with("a.dat.gz: the ending .dat.gz is not known"), "{error}");
    for ending in io::ENDINGS {
        assert!(error.contains(ending), "{error}");
    }
    let error = io::read(std::path::Path::new("particles")).unwrap_err().to_string();
    assert!(error.starts_with("particles: the name has no ending"), "{error}");
    let Err(error) = io::Pieces::open(std::path::Path::new("a.vtu"), 2) else { panic!() };
    assert!(error.to_string().ends_with("one of .csv, .tsv, .npz is expected"), "{error}");
}

#[test]
fn packed_and_foreign_files_are_recognised_by_their_first_bytes() {
    let mut packed = Vec::new();
    let mut encoder = flate2::read::GzEncoder::new(&b"x,y\n1,2\n"[..], flate2::Compression::default());
    encoder.read_to_end(&mut packed).unwrap();
    for ending in io::ENDINGS {
        let message = refused(&format!("p{ending}"), &packed);
        assert!(message.contains("packed by gzip"), "{message}");
        let message = refused(&format!("p{ending}"), b"\x89HDF\r\n\x1a\n");
        assert!(message.contains("HDF5"), "{message}");
    }
    let message = refused("p.csv", b"\xff\xfex\0,\0");
    assert!(message.contains("UTF-16"), "{message}");
}

#[test]
fn one_cell_is_not_cells() {
    assert_eq!(refused("p.csv", "x,y\n1\n"), "p.csv: line 2: the row has 1 cell where the header has 2");
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_refused_before_it_can_block() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe.csv");
    assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
    let Err(error) = io::Pieces::open(&path, 2) else { panic!() };
    assert!(error.to_string().contains("a pipe") && error.to_string().contains("more than once"), "{error}");
    let archive = folder.path().join("pipe.npz");
    std::fs::rename(&path, &archive).unwrap();
    let error = io::read(&archive).unwrap_err().to_string();
    assert!(error.contains("a pipe") && error.contains("regular file"), "{error}");
    for device in ["/dev/zero", "/dev/null"] {
        for ending in io::ENDINGS {
            let link = folder.path().join(format!("device{ending}"));
            let _ = std::fs::remove_file(&link);
            std::os::unix::fs::symlink(device, &link).unwrap();
            let error = io::read(&link).unwrap_err().to_string();
            assert!(error.contains("a device"), "{error}");
        }
    }
}

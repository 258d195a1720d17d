//! Damaged files are errors or tables, never panics, and never ask for memory that the file cannot fill.

use sph_host::io::read;
use std::path::Path;

const CSV: &str = "# note\nx,y,m,name\n0,0,1,\"a, b\"\n0.5,1e-3,2,\"c\nd\"\n";

fn fixtures() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let mut files = vec![("table.csv".to_owned(), CSV.as_bytes().to_vec())];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if !name.ends_with(".py") {
            files.push((name, std::fs::read(path).unwrap()));
        }
    }
    files.sort();
    files
}

/// Reads every version of every file that `damage` makes, and gives how many were read and refused.
fn count(damage: impl Fn(&[u8], usize) -> Vec<u8>) -> (usize, usize) {
    let folder = tempfile::tempdir().unwrap();
    let (mut tables, mut errors) = (0, 0);
    for (name, bytes) in fixtures() {
        let path = folder.path().join(&name);
        let stride = bytes.len() / 60 + 1;
        for at in (0..bytes.len()).step_by(stride) {
            std::fs::write(&path, damage(&bytes, at)).unwrap();
            match read(&path) {
                Ok(table) => {
                    tables += 1;
                    assert!(table.len() <= bytes.len());
                }
                Err(error) => {
                    errors += 1;
                    assert!(error.to_string().contains(&name), "{error}");
                }
            }
        }
    }
    (tables, errors)
}

#[test]
fn cut_short_anywhere() {
    let (tables, errors) = count(|bytes, at| bytes[..at].to_vec());
    // What follows the last point array (cells, closing tags) may be missing.
    assert!(errors > tables, "{tables} read, {errors} refused");
}

#[test]
fn with_a_byte_changed() {
    for mask in [0x01, 0x10, 0x80] {
        let (tables, errors) = count(|bytes, at| {
            let mut bytes = bytes.to_vec();
            bytes[at] ^= mask;
            bytes
        });
        assert!(tables > 0 && errors > 0, "{tables} read, {errors} refused");
    }
}

#[test]
fn with_digits_made_huge() {
    count(|bytes, at| {
        let mut bytes = bytes.to_vec();
        if bytes[at].is_ascii_digit() {
            bytes.splice(at..=at, *b"99999999999999");
        }
        bytes
    });
}

#[test]
fn claims_beyond_the_file_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let vtu = |points: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"{points}\"><Points>\
             <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray></Points>\
             </Piece></UnstructuredGrid></VTKFile>"
        )
    };
    let vtk = |coding: &str, points: &str| {
        format!("# vtk DataFile Version 3.0\nt\n{coding}\nDATASET POLYDATA\nPOINTS {points} double\n1 2 3\n")
    };
    for points in ["9000000000", "18446744073709551615", "99999999999999999999", "-1"] {
        let files =
            [("a.vtu", vtu(points)), ("a.vtk", vtk("ASCII", points)), ("b.vtk", vtk("BINARY", points))];
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            assert!(read(&path).is_err(), "{name} {points}");
        }
    }
    std::fs::write(folder.path().join("a.vtu"), vtu("1")).unwrap();
    assert_eq!(read(&folder.path().join("a.vtu")).unwrap().coordinates, [[1.0], [2.0], [3.0]]);
}

#[test]
fn what_is_no_file_of_particles() {
    let folder = tempfile::tempdir().unwrap();
    for ending in sph_host::io::ENDINGS {
        let path = folder.path().join(format!("a{ending}"));
        assert!(read(&path).unwrap_err().to_string().contains("No such file"), "{ending}");
        for content in [&b""[..], b"\xff\xfe\0x\0", &[0; 1000], b"\n\n\n", b"<a><b/></a>", b"PK\x05\x06"] {
            std::fs::write(&path, content).unwrap();
            assert!(read(&path).is_err(), "{ending} {content:?}");
        }
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        assert!(matches!(read(&path), Err(sph_host::io::ReadError::Io { .. })), "{ending}");
    }
    for name in ["a.txt", "a", ".csv", "a.csv.gz"] {
        let error = read(Path::new(name)).unwrap_err();
        assert!(matches!(error, sph_host::io::ReadError::UnknownEnding { .. }), "{error}");
    }
}

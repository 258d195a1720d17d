//! Damaged files are errors or tables, never panics, and never ask for memory that the file cannot fill.

use sph_host::io::{ENDINGS, Pieces, PointTable, ReadError, read};
use std::path::Path;

const CSV: &str = "# note\nx,y,m,name\n0,0,1,\"a, b\"\n0.5,1e-3,2,\"c\nd\"\n";

const VTK: &str = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 1\nORIGIN 0 0 0\n\
    SPACING 1 1 1\nPOINT_DATA 4\nSCALARS a float 1\nLOOKUP_TABLE default 1 2\n3 4\nFIELD f 1\nb 2 4 int 1 2 3 4 5 6 7 8\n";

fn fixtures() -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let tabs = CSV.replace(", b", " b").replace(',', "\t");
    let mut files = vec![
        ("table.csv".to_owned(), CSV.as_bytes().to_vec()),
        ("table.tsv".to_owned(), tabs.into_bytes()),
        ("grid.vtk".to_owned(), VTK.as_bytes().to_vec()),
    ];
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

/// What holds of every table, however damaged its file: lengths fit, and every array can be asked for.
fn check(table: &PointTable, bytes: &[u8]) -> bool {
    assert!(table.len() <= 8 * bytes.len());
    let usable = |name: &str| match table.quantity(name) {
        Ok(quantity) => {
            assert_eq!(quantity.values.len(), table.len() * quantity.components());
            true
        }
        Err(error) => {
            assert!(error.to_string().contains(&table.source), "{error}");
            false
        }
    };
    table.default_quantities().iter().all(|name| usable(name))
}

/// Makes the file anew: some file systems wait for the disk where a file is cut and written again.
fn rewrite(path: &Path, bytes: &[u8]) {
    let _ = std::fs::remove_file(path);
    std::fs::write(path, bytes).unwrap();
}

/// Reads every version of every file that `damage` makes, and gives how many were read and refused.
fn count(damage: impl Fn(&[u8], usize) -> Vec<u8>) -> (usize, usize) {
    let folder = tempfile::tempdir().unwrap();
    let (mut tables, mut errors) = (0, 0);
    // What a file names beside it is whole.
    fixtures().iter().for_each(|(name, bytes)| rewrite(&folder.path().join(name), bytes));
    for (name, bytes) in fixtures() {
        let path = folder.path().join(&name);
        let stride = bytes.len() / 60 + 1;
        for at in (0..bytes.len()).step_by(stride) {
            rewrite(&path, &damage(&bytes, at));
            match read(&path) {
                Ok(table) if check(&table, &bytes) => tables += 1,
                Ok(_) => errors += 1,
                Err(error) => {
                    errors += 1;
                    assert!(error.to_string().contains(&name), "{error}");
                }
            }
        }
        rewrite(&path, &bytes);
    }
    (tables, errors)
}

/// Numbers that are the same every time (a multiplicative congruential sequence).
struct Random(u64);

impl Random {
    /// A number below `limit`.
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit.max(1)
    }

    /// `bytes` with one to four bytes changed, cut out, doubled, or replaced by a word that readers look at.
    fn damaged(&mut self, bytes: &[u8]) -> Vec<u8> {
        const WORDS: [&[u8]; 12] = [
            b"0",
            b"-1",
            b"99999999999",
            b"nan",
            b" ",
            b"\n",
            b"\"",
            b"POINTS ",
            b"LOOKUP_TABLE ",
            b"METADATA\n",
            b"<",
            b"NumberOfPoints=\"7\"",
        ];
        let mut bytes = bytes.to_vec();
        for _ in 0..=self.below(4) {
            let start = self.below(bytes.len());
            let end = (start + self.below(9)).min(bytes.len());
            match self.below(5) {
                0 if start < bytes.len() => bytes[start] ^= 1 << self.below(8),
                1 => drop(bytes.drain(start..end)),
                2 => drop(bytes.splice(start..start, bytes[start..end].to_vec())),
                3 => drop(bytes.splice(start..end, WORDS[self.below(WORDS.len())].iter().copied())),
                _ => bytes.truncate(bytes.len() - self.below(bytes.len() / 8)),
            }
        }
        bytes
    }
}

/// Random damage, the same every time: tables or errors, whole and in pieces, that agree with each other.
#[test]
fn damaged_at_random() {
    const ROUNDS: usize = 2000;
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(1);
    let (mut tables, mut errors) = (0, 0);
    let fixtures = fixtures();
    fixtures.iter().for_each(|(name, bytes)| rewrite(&folder.path().join(name), bytes));
    for (name, bytes) in &fixtures {
        let path = folder.path().join(name);
        // So many of a format, whatever its number of fixtures.
        let ending = name.rsplit('.').next().unwrap();
        let alike = fixtures.iter().filter(|(other, _)| other.ends_with(ending)).count();
        for _ in 0..ROUNDS / alike {
            let damaged = random.damaged(bytes);
            rewrite(&path, &damaged);
            let whole = read(&path);
            match &whole {
                Ok(table) if check(table, &damaged) => tables += 1,
                _ => errors += 1,
            }
            let pieces: Result<Vec<PointTable>, ReadError> = match Pieces::open(&path, 2) {
                Ok(pieces) => pieces.collect(),
                Err(error) => Err(error),
            };
            if let (Ok(whole), Ok(pieces)) = (&whole, &pieces) {
                assert_eq!(whole.len(), pieces.iter().map(PointTable::len).sum::<usize>(), "{name}");
                assert!(pieces.iter().all(|piece| piece.arrays.len() == whole.arrays.len()));
            }
        }
        rewrite(&path, bytes);
    }
    assert!(tables > 100 && errors > 1000, "{tables} read, {errors} refused");
}

#[test]
fn there_is_a_fixture_of_every_ending() {
    for ending in ENDINGS {
        assert!(fixtures().iter().any(|(name, _)| name.ends_with(ending)), "{ending}");
    }
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
    for ending in ENDINGS {
        let path = folder.path().join(format!("a{ending}"));
        assert!(read(&path).unwrap_err().to_string().contains("No such file"), "{ending}");
        for content in [&b""[..], b"\xff\xfe\0x\0", &[0; 1000], b"\n\n\n", b"<a><b/></a>", b"PK\x05\x06"] {
            std::fs::write(&path, content).unwrap();
            assert!(read(&path).is_err(), "{ending} {content:?}");
        }
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        assert!(matches!(read(&path), Err(ReadError::Io { .. })), "{ending}");
    }
    for name in ["a.txt", "a", ".csv", ".csv.gz", "a.txt.gz"] {
        let error = read(Path::new(name)).unwrap_err();
        assert!(matches!(error, ReadError::UnknownEnding { .. }), "{error}");
    }
}

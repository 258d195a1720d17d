//! Files as people have them: what is damaged is an error, what nobody asked for does no harm.

use std::io::{Cursor, Write};

use sph_host::{io, output};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::support::Folder;

const AT: &str = "--at-particles --support 2";

fn npy(shape: &str, values: &[f64]) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    let mut bytes = b"\x93NUMPY\x01\0".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

/// An archive of three points on a line and more.
fn archive(more: &[(&str, Vec<u8>)], method: CompressionMethod) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let points = [("x.npy", npy("(3,)", &[0.0, 0.5, 1.0])), ("A.npy", npy("(3,)", &[1.0, 2.0, 3.0]))];
    for (name, bytes) in points.iter().chain(more) {
        archive.start_file(*name, SimpleFileOptions::default().compression_method(method)).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn a_damaged_array_in_use_is_an_error_and_another_does_no_harm() {
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        let mut bytes =
            archive(&[("m.npy", npy("(3,)", &[1.0; 3])), ("B.npy", npy("(3,)", &[0.3, 0.4, 0.5]))], method);
        let mut opened = ZipArchive::new(Cursor::new(bytes.clone())).unwrap();
        let file = opened.by_name("B.npy").unwrap();
        let end = (file.data_start().unwrap() + file.compressed_size()) as usize;
        bytes[end - if method == CompressionMethod::Stored { 1 } else { 4 }] ^= 0x10;
        let folder = Folder::with("p.npz", &bytes);
        folder.fail_with(1, &format!("sample p.npz {AT}"), &["p.npz", "array `B`"]);
        folder.fail_with(1, &format!("sample p.npz {AT} --quantity B"), &["p.npz", "array `B`"]);
        folder.fail_with(1, "sample p.npz --support 2 --grid 2 --chunk 2", &["p.npz", "array `B`"]);
        assert_eq!(folder.columns(&format!("sample p.npz {AT} --quantity A")).names, ["x", "density", "A"]);
        let chunks = folder.columns("sample p.npz --support 2 --grid 2 --chunk 2 --quantity A");
        assert_eq!(chunks.get("A").len(), 2);
    }
}

#[test]
fn what_stands_beside_the_particles_is_no_field() {
    let beside = [
        ("box.npy", npy("(2,)", &[0.0, 1.0])),
        ("time.npy", npy("()", &[0.1])),
        ("mass.npy", npy("(1,)", &[0.25])),
    ];
    let folder = Folder::with("p.npz", archive(&beside, CompressionMethod::Stored));
    let columns = folder.columns(&format!("sample p.npz {AT}"));
    assert_eq!(columns.names, ["x", "density", "A"]);
    folder.write("all.csv", "x,mass,A\n0,0.25,1\n0.5,0.25,2\n1,0.25,3\n");
    assert_eq!(columns, folder.columns(&format!("sample all.csv {AT}")));
    folder.succeed("sample p.npz --support 2 --grid 3 --chunk 2");
    folder.fail_with(
        1,
        &format!("sample p.npz {AT} --quantity box"),
        &["p.npz", "array `box`", "[2]", "3 points"],
    );
}

#[test]
fn odd_numbers_harm_where_they_are_used() {
    let vtk = |word: &str| {
        format!(
            "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float 0 0 0 1 0 0\nPOINT_DATA 2\n\
             SCALARS A float\nLOOKUP_TABLE default\n1 2\nSCALARS B float\nLOOKUP_TABLE default\n1 {word}\n"
        )
    };
    for word in ["-nan(ind)", "1.#QNAN", "1.#INF", "***", "text"] {
        let folder = Folder::with("p.vtk", vtk(word));
        folder.write("p.csv", format!("x,y,A,B\n0,0,1,1\n1,0,2,{word}\n"));
        for file in ["p.vtk", "p.csv"] {
            let words = format!("sample {file} {AT} --mass 1");
            assert_eq!(folder.columns(&format!("{words} --quantity A")).get("A").len(), 2);
            for quantity in ["", "--quantity B"] {
                folder.fail_with(1, &format!("{words} {quantity}"), &[file, "`B`"]);
            }
        }
        folder.write("q.csv", format!("x,y,A,B\n0,0,1,{word}\n1,0,2,\n"));
        let finite = word.contains("INF");
        if !finite {
            let columns = folder.columns(&format!("sample q.csv {AT} --mass 1"));
            assert_eq!(
                columns.names,
                ["x", "y", "density", "A"],
                "a column without a number is as one of text"
            );
        }
    }
}

#[test]
fn arrays_without_a_name_go_through_every_format() {
    let array = "<DataArray type=\"Float64\" format=\"ascii\">1 2</DataArray>";
    let vtu = format!(
        "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"2\"><PointData>{array}</PointData>\
         <Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0</DataArray></Points></Piece>\
         </UnstructuredGrid></VTKFile>"
    );
    let folder = Folder::with("p.vtu", vtu);
    let words = format!("{AT} --mass 1");
    let first = folder.columns(&format!("sample p.vtu {words}"));
    assert_eq!(first.names, ["x", "y", "z", "density", "array_0"]);
    for ending in output::ENDINGS.iter().filter(|ending| io::ENDINGS.contains(ending)) {
        folder.succeed(&format!("sample p.vtu {words} --out nn{ending}"));
        let again =
            folder.columns(&format!("sample nn{ending} {words} --quantity array_0 --recompute-density"));
        assert_eq!(again.names, first.names, "{ending}");
    }
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_in_words() {
    let folder = Folder::new();
    assert!(std::process::Command::new("mkfifo").arg(folder.path("p.csv")).status().unwrap().success());
    folder.fail_with(
        1,
        "sample p.csv --support 2 --mass 1 --grid 2 --chunk 2",
        &["p.csv", "a pipe", "regular file"],
    );
    folder.fail_with(
        1,
        &format!("sample demo:drop --particles 9 {AT} --out p.csv --force"),
        &["p.csv", "a pipe"],
    );
    std::os::unix::fs::symlink("/dev/full", folder.path("full.csv")).unwrap();
    folder.fail_with(
        1,
        &format!("sample demo:drop --particles 9 {AT} --out full.csv --force"),
        &["full.csv", "device"],
    );
    folder.fail_with(1, &format!("sample full.csv {AT} --mass 1"), &["full.csv", "device"]);
    let device = format!("sample demo:drop --particles 9 {AT} --out /dev/null --force");
    folder.fail_with(2, &device, &["/dev/null", "no ending"]);
    std::fs::create_dir(folder.path("d.csv")).unwrap();
    folder.fail_with(1, &format!("sample d.csv {AT}"), &["d.csv", "directory"]);
    folder.fail_with(1, "sample d.csv --support 2 --grid 2 --chunk 2", &["d.csv", "directory"]);
}

#[test]
fn unknown_endings_are_named_with_those_that_are_known() {
    let folder = Folder::with("p.dat.gz", b"\x1f\x8b");
    folder.write("p.vtu", b"\x1f\x8b\x08\0");
    folder.fail_with(2, &format!("sample p.dat.gz {AT}"), &["p.dat.gz", "not known", ".vtu", ".npz"]);
    folder.fail_with(1, &format!("sample p.vtu {AT}"), &["p.vtu", "packed by gzip"]);
    folder.fail_with(
        2,
        &format!("sample demo:drop {AT} --out out.csv.gz"),
        &["out.csv.gz", ".gz is not known", ".tsv"],
    );
}

/// The lists of formats are what the help and the README say.
#[test]
fn every_format_is_in_the_help_and_in_the_readme() {
    let help = Folder::new().succeed("sample --help").stdout;
    let readme = include_str!("../../../README.md");
    let page = include_str!("../../docs/files.md");
    for ending in io::ENDINGS {
        assert!(help.contains(ending), "{ending} is missing in the help");
        assert!(readme.contains(&format!("`{ending}`")), "{ending} is missing in README.md");
        assert!(page.contains(&format!("`{ending}`")), "{ending} is missing in files.md");
    }
    for ending in output::ENDINGS {
        assert!(help.contains(ending), "{ending} is missing in the help");
        assert!(
            page.contains(&format!("| `{ending}`")) || page.contains(&format!(", `{ending}`")),
            "{ending}"
        );
    }
}

#[test]
fn no_ending_is_in_a_list_twice() {
    for endings in [io::ENDINGS, output::ENDINGS] {
        for (index, ending) in endings.iter().enumerate() {
            assert!(ending.starts_with('.') && **ending == ending.to_ascii_lowercase());
            assert!(!endings[..index].contains(ending), "{ending}");
        }
    }
}

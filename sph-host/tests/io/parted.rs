//! VTK's files that name pieces.

use std::path::Path;

use crate::support::{array, refused, unusable, values, vtu};

fn parted(sources: &[&str]) -> String {
    let pieces: String = sources.iter().map(|source| format!("<Piece Source=\"{source}\"/>")).collect();
    format!(
        "<?xml version=\"1.0\"?><VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><PPointData>\
         <PDataArray Name=\"a\" type=\"Float64\"/></PPointData>{pieces}</PUnstructuredGrid></VTKFile>"
    )
}

/// What is said of a file that names these pieces, beside the files `a.vtu`, `b/b.vtu` and others.
fn beside(sources: &[&str]) -> Result<sph_host::io::PointTable, String> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, content: &str| std::fs::write(folder.path().join(name), content).unwrap();
    std::fs::create_dir(folder.path().join("b")).unwrap();
    write("a.vtu", &vtu(&[(2, &array("a", "1 2"))]));
    write("b/b.vtu", &vtu(&[(3, &array("a", "3 4 5"))]));
    write("none.vtu", &vtu(&[(0, &array("c", ""))]));
    write("other.vtu", &vtu(&[(1, &array("o", "1"))]));
    write("fault.vtu", &vtu(&[(2, &array("a", "6 x"))]));
    write("short.vtu", "<VTKFile type=\"UnstructuredGrid\">");
    write("p.pvtu", &parted(sources));
    let path = folder.path().join("p.pvtu");
    let whole = format!("{}: ", path.display());
    sph_host::io::read(&path).map_err(|error| error.to_string().strip_prefix(&whole).unwrap().to_owned())
}

#[test]
fn pieces_become_one_table() {
    let table = beside(&["none.vtu", "a.vtu", "./b/./b.vtu"]).unwrap();
    assert_eq!(table.coordinates, [vec![0.0, 1.0, 0.0, 1.0, 2.0], vec![0.0; 5], vec![0.0; 5]]);
    assert_eq!(values(&table, "a"), [1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(table.arrays.len(), 1, "a piece without points has no say");
    let empty = beside(&["none.vtu"]).unwrap();
    assert_eq!((empty.len(), empty.arrays[0].name.as_str()), (0, "c"));
}

#[test]
fn an_array_that_one_piece_has_not_or_that_is_at_fault_there_names_the_piece() {
    let table = beside(&["a.vtu", "other.vtu"]).unwrap();
    assert_eq!(table.len(), 3);
    assert_eq!(unusable(&table, "a"), "array `a`: piece 1 has no such array");
    assert_eq!(unusable(&table, "o"), "array `o`: piece 0 has no such array");
    let table = beside(&["a.vtu", "fault.vtu"]).unwrap();
    assert_eq!(
        unusable(&table, "a"),
        "piece 1, `fault.vtu`, array `a`, point 1: `x` where a number is expected"
    );
}

#[test]
fn pieces_that_cannot_be_read_are_named() {
    let words = |sources: &[&str]| beside(sources).unwrap_err();
    let missing = words(&["a.vtu", "b/missing.vtu"]);
    assert!(missing.starts_with("piece 1, `b/missing.vtu`: No such file"), "{missing}");
    let short = words(&["short.vtu"]);
    assert!(short.starts_with("piece 0, `short.vtu`, byte ") && short.contains("cut short"), "{short}");
    let folder = words(&["b"]);
    assert!(folder.starts_with("piece 0, `b`: ") && folder.contains("directory"), "{folder}");
    let itself = words(&["p.pvtu"]);
    assert!(itself.contains("`VTKFile` of type `PUnstructuredGrid`, where"), "{itself}");
    assert!(words(&["a.vtu", "./a.vtu"]).ends_with("the piece `a.vtu` is named twice"));
    assert_eq!(words(&[]), "no Piece is named");
}

#[test]
fn a_path_that_leaves_the_folder_is_refused() {
    for path in ["../a.vtu", "b/../../a.vtu", "b/..", "/etc/passwd", "/", "./../p.pvtu", "", ".", "./"] {
        let message = beside(&["a.vtu", path]).unwrap_err();
        let words = format!(
            "the piece `{path}` where a file in the folder of this one is expected: a relative path without `..`"
        );
        assert!(message.starts_with("byte ") && message.contains(&words), "{message}");
    }
}

#[test]
fn what_is_wrong_with_the_file_itself_is_named() {
    let whole = parted(&["a.vtu"]);
    for cut in 0..whole.len() {
        assert!(!refused("p.pvtu", &whole[..cut]).contains("piece 0"), "{cut}");
    }
    assert!(
        refused("p.pvtu", whole.replace("PUnstr", "Unstr"))
            .contains("PUnstructuredGrid or PPolyData is expected")
    );
    assert!(refused("p.pvtp", whole.replace("Source", "File")).contains("a Piece without Source"));
    assert!(refused("p.pvtp", [&whole.as_bytes()[..60], b"\xff"].concat()).contains("byte 60: not UTF-8"));
    let message = sph_host::io::read(Path::new("missing.pvtu")).unwrap_err().to_string();
    assert!(message.starts_with("missing.pvtu: No such file"), "{message}");
}

#[cfg(unix)]
#[test]
fn a_piece_that_is_a_pipe_is_refused_before_it_can_block() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.vtu");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let path = folder.path().join("p.pvtu");
    std::fs::write(&path, parted(&["pipe.vtu"])).unwrap();
    let message = sph_host::io::read(&path).unwrap_err().to_string();
    assert!(
        message.ends_with("piece 0, `pipe.vtu`: this is a pipe; a regular file is expected"),
        "{message}"
    );
}

//! Results as files: formats, types, targets that are kept or replaced.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};

use crate::support::{Columns, Folder, is_close};

/// Name, type and values of each array of an archive.
fn arrays(npz: Vec<u8>) -> BTreeMap<String, (String, Vec<f64>)> {
    let mut archive = zip::ZipArchive::new(Cursor::new(npz)).unwrap();
    let mut arrays = BTreeMap::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).unwrap();
        let name = file.name().unwrap().strip_suffix(".npy").unwrap().to_owned();
        let mut content = Vec::new();
        file.read_to_end(&mut content).unwrap();
        // magic word and version, length of the dictionary, the dictionary
        let length = 10 + usize::from(u16::from_le_bytes([content[8], content[9]]));
        let (header, data) = content.split_at(length);
        let header = std::str::from_utf8(&header[10..]).unwrap();
        let kind = header.strip_prefix("{'descr': '").unwrap().split('\'').next().unwrap().to_owned();
        let values = match kind.as_str() {
            "<f4" => data.as_chunks().0.iter().map(|&number| f64::from(f32::from_le_bytes(number))).collect(),
            _ => data.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect(),
        };
        arrays.insert(name, (kind, values));
    }
    arrays
}

#[test]
fn npz_holds_the_columns_at_the_precision_of_the_scalar() {
    let folder = Folder::new();
    for (scalar, kind) in [("f32", "<f4"), ("f64", "<f8"), ("fast32", "<f8"), ("i16f16", "<f8")] {
        let words =
            format!("sample demo:vortex --particles 400 --grid 7,5 --estimate shepard --scalar {scalar}");
        let csv = folder.columns(&words);
        folder.succeed(&format!("{words} --out {scalar}.npz"));
        let arrays = arrays(folder.bytes(&format!("{scalar}.npz")));
        assert_eq!(arrays.len(), csv.names.len());
        for (name, (found, values)) in &arrays {
            let is_coordinate = ["x", "y"].contains(&name.as_str());
            assert_eq!(found, if is_coordinate { "<f8" } else { kind }, "{scalar} {name}");
            // what CSV prints of an f32 is read as an f32
            let printed = csv.get(name).iter();
            let printed: Vec<f64> = if found == "<f4" {
                printed.map(|value| f64::from(*value as f32)).collect()
            } else {
                printed.copied().collect()
            };
            assert_eq!(*values, printed, "{scalar} {name}");
        }
    }
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    assert!(found.iter().zip(expected).all(|(a, b)| is_close(*a, *b, 1e-14, 0.0)), "{found:?}");
}

#[test]
fn every_format_holds_the_same_points_and_values() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 400 --grid 6,4 --quantity pressure";
    let csv = folder.columns(words);
    for name in ["out.csv", "out.npz", "out.vtk", "out.vtu", "OUT2.CSV"] {
        folder.succeed(&format!("{words} --out {name}"));
    }
    assert_eq!(arrays(folder.bytes("out.npz"))["pressure"].1, csv.get("pressure"));
    assert_eq!(folder.bytes("out.csv"), folder.bytes("OUT2.CSV"));
    // what was written can be sampled again, which says where its points are and what they hold
    let again = "--mass 1 --support 0.001 --estimate shepard --at-particles";
    for name in ["out.csv", "out.npz"] {
        let read = folder.columns(&format!("sample {name} {again}"));
        assert_eq!(read.get("x"), csv.get("x"), "{name}");
        assert_close(read.get("pressure"), csv.get("pressure"));
    }
    let points = "sample demo:vortex --particles 400 --at out.csv --quantity pressure --out points.vtu";
    folder.succeed(points);
    let read = folder.columns(&format!("sample points.vtu {again} --dim 2"));
    assert_eq!(read.get("y"), csv.get("y"));
    assert_close(read.get("pressure"), csv.get("pressure"));
}

#[test]
fn a_grid_becomes_image_data_or_a_picture() {
    let folder = Folder::new();
    let flat = "sample demo:vortex --particles 400 --grid 6,4 --gradient";
    let deep = "sample demo:drop --particles 400 --grid 6,4,3 --quantity temperature";
    for (words, extent) in [(flat, "0 5 0 3 0 0"), (deep, "0 5 0 3 0 2")] {
        folder.succeed(&format!("{words} --force --out out.vti"));
        let text = String::from_utf8_lossy(&folder.bytes("out.vti")).into_owned();
        assert!(text.contains("ImageData") && text.contains(extent), "{words}");
        folder.succeed(&format!("{words} --force --out out.png"));
        let picture = folder.bytes("out.png");
        let decoded = png::Decoder::new(Cursor::new(picture)).read_info().unwrap();
        assert!(decoded.info().width > 200 && decoded.info().height > 150);
    }
    folder.succeed(&format!("{deep} --out out.vtk"));
    let text = String::from_utf8_lossy(&folder.bytes("out.vtk")).into_owned();
    assert!(text.contains("DATASET STRUCTURED_POINTS"));
}

#[test]
fn an_existing_target_is_kept_unless_forced() {
    let folder = Folder::new();
    for name in ["out.csv", "out.npz", "out.vtk", "out.vtu", "out.vti", "out.png"] {
        folder.write(name, "precious");
        let words = format!("sample demo:vortex --particles 100 --grid 4,4 --out {name}");
        folder.fail_with(1, &words, &[name, "--force"]);
        assert_eq!(folder.bytes(name), b"precious");
        folder.succeed(&format!("{words} --force"));
        assert_ne!(folder.bytes(name), b"precious");
    }
    folder.write("k.png", "precious");
    folder.fail_with(1, "kernels --plot k.png", &["k.png", "--force"]);
    assert_eq!(folder.bytes("k.png"), b"precious");
    assert_eq!(folder.names().len(), 7, "nothing is left over");
}

#[test]
fn a_failure_keeps_the_old_target_even_when_forced() {
    let folder = Folder::with("p.csv", "x,y,m,A\n0,0,1,1\n0,1,0,1\n");
    folder.write("out.csv", "precious");
    folder.fail_with(1, "sample p.csv --support 1 --at-particles --out out.csv --force", &["line 3"]);
    assert_eq!(folder.bytes("out.csv"), b"precious");
    std::fs::create_dir(folder.path("sub.csv")).unwrap();
    let words = "sample demo:vortex --particles 100 --at-particles --force --out";
    folder.fail_with(1, &format!("{words} sub.csv"), &["sub.csv", "directory"]);
    folder.fail_with(1, &format!("{words} nowhere/out.csv"), &["nowhere"]);
}

#[test]
fn a_result_may_replace_its_own_input() {
    let folder = Folder::with("p.csv", "x,y,m,A\n0,0,1,1\n1,0,1,1\n");
    folder.succeed("sample p.csv --support 2 --at-particles --estimate shepard --out p.csv --force");
    let columns = Columns::parse(&String::from_utf8(folder.bytes("p.csv")).unwrap());
    assert_eq!(columns.get("A"), [1.0, 1.0]);
}

//! `--chunk`: a file some particles at a time gives what it gives as a whole.

use std::fmt::Write;
use std::io::{Cursor, Write as _};

use crate::support::{Columns, Folder, Random, is_close, magnitude};

/// A cloud of particles in a box of 1 × 0.5 × 0.5, crowded to the left, as a table with comments and blank lines between.
fn cloud(particles: usize, dim: usize) -> String {
    let mut random = Random(7);
    let mut text = format!("{}rho,m,h,a,b_x,b_y\n", ["x,", "x,y,", "x,y,z,"][dim - 1]);
    for particle in 0..particles {
        let x = random.next();
        write!(text, "{},", x * x).unwrap();
        (1..dim).for_each(|_| write!(text, "{},", 0.5 * random.next()).unwrap());
        let (rho, m, h) = (1.0 + random.next(), 1e-3 * (1.0 + random.next()), 0.1 + 0.1 * random.next());
        writeln!(text, "{rho},{m},{h},{},{},{}", random.next(), random.next() - 0.5, x).unwrap();
        if particle % 97 == 0 {
            text.push_str("# a comment\n\n");
        }
    }
    text
}

/// The numeric columns of a text table as an archive of NumPy arrays, every other one deflated.
fn archive(text: &str) -> Vec<u8> {
    let plain: String = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')).fold(
        String::new(),
        |mut plain, line| {
            plain.push_str(line);
            plain.push('\n');
            plain
        },
    );
    let columns = Columns::parse(&plain);
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (index, (name, values)) in columns.names.iter().zip(&columns.values).enumerate() {
        let method = [zip::CompressionMethod::Stored, zip::CompressionMethod::Deflated][index % 2];
        let options = zip::write::SimpleFileOptions::default().compression_method(method);
        archive.start_file(format!("{name}.npy"), options).unwrap();
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}\n", values.len());
        archive.write_all(b"\x93NUMPY\x01\x00").unwrap();
        archive.write_all(&(header.len() as u16).to_le_bytes()).unwrap();
        archive.write_all(header.as_bytes()).unwrap();
        values.iter().for_each(|value| archive.write_all(&value.to_le_bytes()).unwrap());
    }
    archive.finish().unwrap().into_inner()
}

fn assert_alike(whole: &Columns, pieces: &Columns, tolerance: f64, what: &str) {
    assert_eq!(whole.names, pieces.names, "{what}");
    for (name, (whole, pieces)) in whole.names.iter().zip(whole.values.iter().zip(&pieces.values)) {
        assert_eq!(whole.len(), pieces.len(), "{what}, {name}");
        let scale = magnitude(whole);
        for (row, (&a, &b)) in whole.iter().zip(pieces).enumerate() {
            assert!(is_close(a, b, tolerance, scale), "{what}, {name}[{row}]: {a} and {b}");
        }
    }
}

#[test]
fn pieces_give_what_the_whole_gives() {
    for dim in 1..=3 {
        let text = cloud(1500, dim);
        let folder = Folder::with("p.csv", &text);
        folder.write("p.npz", archive(&text));
        let grid = ["40", "20,10", "12,6,6"][dim - 1];
        for (options, tolerance) in [
            ("--support 0.12", 1e-14),
            ("--support 0.12 --recompute-density --gradient", 1e-14),
            ("--support-column h --estimate shepard --gradient", 1e-12),
            ("--support 0.15 --exact --recompute-density", 1e-14),
            ("--support 0.2 --estimate corrected --quantity b", 1e-13),
            ("--support 0.12 --scalar f32", 2e-6),
        ] {
            let words = format!("--grid {grid} {options}");
            let whole = folder.columns(&format!("sample p.csv {words}"));
            for (file, chunk) in [("p.csv", 400), ("p.csv", 7000), ("p.npz", 150)] {
                let what = format!("sample {file} {words} --chunk {chunk}");
                assert_alike(&whole, &folder.columns(&what), tolerance, &what);
            }
        }
    }
}

#[test]
fn no_bit_depends_on_threads() {
    let folder = Folder::with("p.csv", cloud(2000, 2));
    let words = "sample p.csv --support 0.1 --recompute-density --gradient --grid 30,20 --chunk 500";
    let one = folder.succeed(&format!("{words} --threads 1")).stdout;
    assert_eq!(one, folder.succeed(&format!("{words} --threads 3")).stdout);
}

#[test]
fn points_of_a_file_may_lie_anywhere() {
    let folder = Folder::with("p.csv", cloud(1000, 2));
    folder.write("q.csv", "x,y\n-5,0.1\n0.999,0.2\n0.0001,0.3\n7,7\n0.25,0.25\n");
    let whole = folder.columns("sample p.csv --at q.csv --support 0.1 --quantity a");
    let pieces = folder.columns("sample p.csv --at q.csv --support 0.1 --quantity a --chunk 100");
    assert_alike(&whole, &pieces, 1e-14, "points");
    assert_eq!(pieces.get("a")[0], 0.0);
    assert!(pieces.get("a")[4] > 0.0);
}

#[test]
fn faults_in_a_later_piece_are_named_with_their_line() {
    let folder = Folder::with("p.csv", "x,m,a\n0,1,1\n1,1,1\n2,1,1\n3,-1,1\n");
    let words = "--support 1 --grid 5 --chunk 2";
    folder.fail_with(1, &format!("sample p.csv {words}"), &["p.csv", "line 5", "`m`", "-1"]);
    folder.write("p.csv", "x,m,a\n0,1,1\n1,1,1\n2,1\n");
    folder.fail_with(1, &format!("sample p.csv {words}"), &["line 4", "2 cells"]);
    folder.write("p.csv", "x,m,a\n0,1,b\n1,1,b\n2,1,3\n");
    folder.fail_with(1, &format!("sample p.csv {words}"), &["p.csv", "--quantity"]);
    folder.write("p.csv", "x,y,m\n0,0,1\n1,0,1\n2,1,1\n");
    folder.fail_with(1, &format!("sample p.csv {words} --dim 1"), &["y is 0 and 1", "--dim 1"]);
    folder.write("p.csv", "x,m\n");
    folder.fail_with(1, &format!("sample p.csv {words}"), &["no particles"]);
    folder.write("p.csv", "x,m\n-1.5e308,1\n0,1\n1.5e308,1\n");
    folder.fail_with(1, &format!("sample p.csv {words}"), &["x spans"]);

    let whole = archive("x,m\n0,1\n1,1\n2,1\n");
    folder.write("cut.npz", &whole[..whole.len() - 10]);
    folder.fail_with(1, "sample cut.npz --support 1 --grid 5 --chunk 2", &["cut.npz"]);
    let mut damaged = whole.clone();
    let place = damaged.windows(8).position(|bytes| bytes == 2.0_f64.to_le_bytes()).unwrap();
    damaged[place + 6] ^= 1;
    folder.write("damaged.npz", damaged);
    folder.fail_with(1, "sample damaged.npz --support 1 --grid 5 --chunk 2", &["`x`", "checksum"]);
}

#[test]
fn words_that_go_with_pieces() {
    let folder = Folder::with("p.vtk", "");
    folder.write("p.csv", "x,m\n0,1\n");
    folder.fail_with(2, "sample p.vtk --support 1 --grid 5 --chunk 2", &["p.vtk", ".npz"]);
    folder.fail_with(2, "sample p.csv --support 1 --at-particles --chunk 2", &["--chunk"]);
    folder.fail_with(2, "sample p.csv --support 1 --grid 5 --chunk 0", &["--chunk"]);
    folder.fail_with(2, "sample demo:vortex --grid 5,5 --chunk 100", &["--chunk", "built-in"]);
}

#[test]
fn no_points_in_chunks_are_no_points_at_all() {
    let folder = Folder::with("p.csv", "x,y,z,m\n0,0,0,1\n1,0,0,1\n0,1,0,1\n");
    folder.write("q.csv", "x\n");
    let words = "sample p.csv --at q.csv --support 1";
    let whole = folder.succeed(words);
    assert_eq!(whole.stdout, "x,density\n");
    assert!(whole.stderr.contains("there are no points"), "{}", whole.stderr);
    let pieces = folder.succeed(&format!("{words} --chunk 2"));
    assert_eq!((pieces.stdout, pieces.stderr), (whole.stdout, whole.stderr));
}

#[test]
fn no_byte_of_a_compressed_file_depends_on_threads() {
    let folder = Folder::new();
    let words = "sample demo:vortex --grid 300,300 --quantity velocity_x --out";
    let written = |threads: usize| {
        let name = format!("{threads}.vti");
        folder.succeed(&format!("{words} {name} --threads {threads}"));
        folder.bytes(&name)
    };
    let one = written(1);
    assert_eq!(one, written(3));
    folder.succeed(&format!("{words} g.vtu"));
    let read = folder
        .columns("sample g.vtu --support 1 --mass 1 --at-particles --quantity velocity_x --only x=0..0.01");
    assert!(!read.get("x").is_empty(), "blocks on end are read back");
}

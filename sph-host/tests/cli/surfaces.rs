//! `--surface`: triangles that are read back, and what is refused.

use std::collections::HashMap;

use crate::support::Folder;

type Vector = [f64; 3];

/// A surface as a file holds it.
#[derive(Debug, Default, PartialEq)]
struct Read {
    positions: Vec<Vector>,
    normals: Vec<Vector>,
    triangles: Vec<[usize; 3]>,
}

impl Read {
    /// Binary PLY with float vertices and triangles.
    fn ply(bytes: &[u8]) -> Self {
        let end = b"end_header\n";
        let header = bytes.windows(end.len()).position(|window| window == end).unwrap() + end.len();
        let lines: Vec<&str> = std::str::from_utf8(&bytes[..header]).unwrap().lines().collect();
        assert_eq!(lines[..2], ["ply", "format binary_little_endian 1.0"]);
        assert!(lines[2].starts_with("comment density = "), "{}", lines[2]);
        let count = |line: &str, element: &str| line.strip_prefix(element).unwrap().parse::<usize>().unwrap();
        let (vertices, faces) = (count(lines[3], "element vertex "), count(lines[10], "element face "));
        let properties = ["x", "y", "z", "nx", "ny", "nz"].map(|name| format!("property float {name}"));
        assert_eq!(lines[4..10], properties);
        assert_eq!(lines[11..], ["property list uchar int vertex_indices", "end_header"]);
        let (data, list) = bytes[header..].split_at(24 * vertices);
        assert_eq!(list.len(), 13 * faces);
        let numbers: Vec<f64> =
            data.as_chunks().0.iter().map(|&number| f64::from(f32::from_le_bytes(number))).collect();
        let vectors = numbers.as_chunks::<3>().0;
        let triangles = list.chunks(13).map(|triangle| {
            assert_eq!(triangle[0], 3);
            let numbers = triangle[1..].as_chunks().0;
            [0, 1, 2].map(|corner| usize::try_from(i32::from_le_bytes(numbers[corner])).unwrap())
        });
        Self {
            positions: vectors.iter().step_by(2).copied().collect(),
            normals: vectors.iter().skip(1).step_by(2).copied().collect(),
            triangles: triangles.collect(),
        }
    }

    /// Text with `v`, `vn` and `f a//a b//b c//c`.
    fn obj(text: &str) -> Self {
        let mut read = Self::default();
        for line in text.lines() {
            let (keyword, rest) = line.split_once(' ').unwrap();
            let words: Vec<&str> = rest.split(' ').collect();
            let vector =
                || <Vector>::try_from(words.iter().map(|word| word.parse().unwrap()).collect::<Vec<f64>>());
            match keyword {
                "#" => assert!(read.positions.is_empty()),
                "v" => read.positions.push(vector().unwrap()),
                "vn" => read.normals.push(vector().unwrap()),
                "f" => read.triangles.push(<[&str; 3]>::try_from(words).unwrap().map(|word| {
                    let (vertex, normal) = word.split_once("//").unwrap();
                    assert_eq!(vertex, normal);
                    vertex.parse::<usize>().unwrap() - 1
                })),
                other => panic!("{other}"),
            }
        }
        read
    }

    /// How many edges have one triangle; that no other edge has anything but two, which go opposite ways.
    fn open_edges(&self) -> usize {
        let mut edges: HashMap<(usize, usize), [usize; 2]> = HashMap::new();
        for [a, b, c] in &self.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.entry((*from.min(to), *from.max(to))).or_default()[usize::from(from > to)] += 1;
            }
        }
        assert!(edges.values().all(|ways| ways.iter().all(|&count| count <= 1)));
        edges.values().filter(|ways| **ways != [1, 1]).count()
    }

    /// The volume that is enclosed: negative where triangles are seen from inside.
    fn volume(&self) -> f64 {
        let corners = self.triangles.iter().map(|triangle| triangle.map(|corner| self.positions[corner]));
        corners.map(|[a, b, c]| dot(a, cross(b, c)) / 6.0).sum()
    }
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A run that fails after it has warned of its points, and leaves no file.
fn refused(folder: &Folder, words: &str, parts: &[&str]) {
    let before = folder.names();
    let said = folder.run(words);
    assert_eq!((said.status, said.stdout.as_str()), (Some(1), ""), "{words}: {}", said.stderr);
    let error = said.stderr.lines().find(|line| line.starts_with("error: --surface: ")).unwrap();
    parts.iter().for_each(|part| assert!(error.contains(part), "{words}: `{part}` is missing in {error}"));
    assert_eq!(folder.names(), before, "{words}");
}

/// A small drop in a box that it does not reach the border of.
const DROP: &str = "sample demo:drop --particles 2000 --grid 24,25,26 --bounds=-0.2,-0.2,-0.2,1.2,1.2,1.2";

#[test]
fn the_surface_of_a_drop_is_closed_and_reads_back_from_both_formats() {
    let folder = Folder::new();
    let said = folder.succeed(&format!("{DROP} --surface density=500 --quantity temperature --out drop.ply"));
    assert!(said.stdout.is_empty() && !said.stderr.contains("the surface"), "{}", said.stderr);
    folder.succeed(&format!("{DROP} --surface density=500 --out drop.obj"));
    let ply = Read::ply(&folder.bytes("drop.ply"));
    let obj = Read::obj(&String::from_utf8(folder.bytes("drop.obj")).unwrap());
    assert_eq!((ply.positions.len(), ply.normals.len()), (obj.positions.len(), obj.positions.len()));
    assert_eq!(ply.triangles, obj.triangles);
    let single =
        |vectors: &[Vector]| vectors.iter().map(|v| v.map(|x| f64::from(x as f32))).collect::<Vec<_>>();
    assert_eq!((ply.positions, ply.normals), (single(&obj.positions), single(&obj.normals)));
    assert_eq!(obj.open_edges(), 0);
    assert_eq!(obj.positions.len() + obj.triangles.len(), 3 * obj.triangles.len() / 2 + 2, "a sphere");
    // the ball has radius 0.5; half its density is where it ends
    let volume = 4.0 / 3.0 * std::f64::consts::PI * 0.125;
    assert!((obj.volume() / volume - 1.0).abs() < 0.05, "{}", obj.volume() / volume);
    for (position, normal) in obj.positions.iter().zip(&obj.normals) {
        let from = position.map(|x| x - 0.5);
        assert!((dot(*normal, *normal) - 1.0).abs() < 1e-12);
        assert!(dot(from, *normal) > 0.9 * dot(from, from).sqrt(), "{position:?} {normal:?}");
    }
}

#[test]
fn vertices_and_normals_are_those_of_the_columns_on_the_grid() {
    let folder = Folder::new();
    let words = "sample demo:drop --particles 500 --grid 9,10,11 --bounds=-0.3,-0.3,-0.3,1.3,1.3,1.3 --quantity temperature";
    folder.succeed(&format!("{words} --surface temperature=30 --out t.obj"));
    let mesh = Read::obj(&String::from_utf8(folder.bytes("t.obj")).unwrap());
    let columns = folder.columns(&format!("{words} --gradient"));
    let spacing = [1.6 / 9.0, 0.16, 1.6 / 11.0];
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        // the box around the vertex, and the corners of the edge that it lies on
        let place: Vector = std::array::from_fn(|axis| (position[axis] + 0.3) / spacing[axis] - 0.5);
        let fraction = place.map(|x| x - x.round());
        let t = fraction.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        let at = |number: usize, name: &str| columns.get(name)[number];
        let number = |place: Vector| place[0] as usize + 9 * (place[1] as usize + 10 * place[2] as usize);
        let near = number(place.map(f64::round));
        let far = number(std::array::from_fn(|axis| {
            let step = if fraction[axis].abs() > 1e-9 { fraction[axis].signum() } else { 0.0 };
            place[axis].round() + step
        }));
        let between = |name: &str| at(near, name) + t * (at(far, name) - at(near, name));
        let is_moved = (t * 1024.0 - 1.0).abs() < 1e-6;
        assert!(is_moved || (between("temperature") - 30.0).abs() < 1e-9, "{position:?}");
        let gradient = ["temperature_dx", "temperature_dy", "temperature_dz"].map(between);
        let length = dot(gradient, gradient).sqrt();
        assert!((dot(gradient, *normal) / length + 1.0).abs() < 1e-9, "{position:?}");
    }
    assert!(mesh.positions.len() > 100);
}

#[test]
fn the_bytes_do_not_depend_on_threads_nor_on_gradient_being_asked_for() {
    let folder = Folder::new();
    for ending in ["ply", "obj"] {
        let files = ["--threads 1", "--threads 2", "--threads 2 --gradient"].map(|options| {
            folder.succeed(&format!("{DROP} --surface density=400 {options} --out out.{ending} --force"));
            folder.bytes(&format!("out.{ending}"))
        });
        assert!(files.iter().all(|file| *file == files[0]), "{ending}");
    }
}

#[test]
fn a_surface_that_goes_on_beyond_the_grid_is_open_and_says_how_much() {
    let folder = Folder::new();
    let words = "sample demo:drop --particles 2000 --grid 16,16,16 --bounds=-0.2,-0.2,-0.2,1.2,1.2,0.5";
    let said = folder.succeed(&format!("{words} --surface density=500 --out half.obj"));
    let mesh = Read::obj(&String::from_utf8(folder.bytes("half.obj")).unwrap());
    let (open, edges) = (mesh.open_edges(), mesh.positions.len() + mesh.triangles.len() - 1);
    assert!(open > 30);
    let expected = format!("{open} of its {edges} edges");
    assert!(said.stderr.contains("warning: the surface meets the border"), "{}", said.stderr);
    assert!(
        said.stderr.contains(&expected) && said.stderr.contains("--bounds"),
        "{expected}: {}",
        said.stderr
    );
    // beyond the particles there are no values of this estimate
    let said = folder.succeed(&format!(
        "{DROP} --estimate shepard --quantity temperature --surface temperature=45 --out inner.obj"
    ));
    let open = Read::obj(&String::from_utf8(folder.bytes("inner.obj")).unwrap()).open_edges();
    assert!(said.stderr.contains("`temperature` has no value at"), "{}", said.stderr);
    assert!(open == 0 && said.stderr.contains(" 0 of its "), "{}", said.stderr);
    let said = folder.succeed(&format!(
        "{DROP} --estimate shepard --quantity velocity_x --surface velocity_x=0.1 --out cut.obj"
    ));
    let open = Read::obj(&String::from_utf8(folder.bytes("cut.obj")).unwrap()).open_edges();
    assert!(open > 20 && said.stderr.contains(&format!(" {open} of its ")), "{}", said.stderr);
}

#[test]
fn any_column_has_a_surface() {
    let folder = Folder::new();
    for column in ["density_dx", "velocity_z", "temperature", "temperature_dy", "x"] {
        let level = if column == "velocity_z" { "1e-3" } else { "0.5" };
        let words = format!("{DROP} --surface {column}={level} --out out.obj --force");
        if column == "velocity_z" {
            refused(&folder, &words, &["`velocity_z`", "from 0.0 to 0.0", "0.001"]);
        } else {
            folder.succeed(&words);
        }
    }
    let mesh = Read::obj(&String::from_utf8(folder.bytes("out.obj")).unwrap());
    assert!(mesh.positions.iter().all(|position| (position[0] - 0.5).abs() < 1e-12));
    assert!(mesh.normals.iter().all(|normal| normal[0] < -1.0 + 1e-12));
    folder.write("p.csv", "x,y,z,m\n1e7,0,0,1\n10000001,1,1,1\n");
    let words = "sample p.csv --support 1 --grid 9,9,9 --surface density=0.1 --out far";
    let said = folder.succeed(&format!("{words}.ply"));
    assert!(said.stderr.contains("single precision") && said.stderr.contains(".obj"), "{}", said.stderr);
    assert!(!folder.succeed(&format!("{words}.obj")).stderr.contains("single precision"));
}

#[test]
fn what_gives_no_surface_is_refused() {
    let folder = Folder::with("p.csv", "x,y,m\n0,0,1\n1,1,1\n");
    let cube = "sample demo:drop --particles 200 --grid 4,4,4";
    for (words, parts) in [
        (format!("{cube} --surface density=500 --out out.csv"), &["out.csv", ".ply", ".obj"][..]),
        (format!("{cube} --surface density=500 --out out.xyz"), &["out.xyz", ".ply", ".obj"]),
        (format!("{cube} --surface density=500 --out out.stl"), &[".stl is not known", ".ply", ".obj"]),
        (format!("{cube} --surface density=500"), &["--surface", "--out FILE.ply", "--out FILE.obj"]),
        (format!("{cube} --surface density=500 --out /dev/stdout"), &["--out FILE.ply"]),
        (format!("{cube} --surface density --out out.ply"), &["--surface", "NAME=LEVEL"]),
        (format!("{cube} --surface density=nan --out out.ply"), &["finite"]),
        (format!("{cube} --out out.ply"), &["out.ply", "--surface NAME=LEVEL"]),
        (format!("{cube} --out out.obj"), &["out.obj", "--surface NAME=LEVEL", "--grid"]),
        (
            "sample p.csv --support 1 --at-particles --out out.obj".into(),
            &["out.obj", "--surface NAME=LEVEL"],
        ),
        (
            "sample p.csv --support 1 --at-particles --surface density=1 --out out.ply".into(),
            &["--grid NX,NY,NZ"],
        ),
        (
            "sample p.csv --support 1 --at p.csv --surface density=1 --out out.ply".into(),
            &["--grid NX,NY,NZ"],
        ),
        (
            "sample p.csv --support 1 --grid 4,4 --surface density=1 --out out.ply".into(),
            &["--grid NX,NY,NZ"],
        ),
        ("sample demo:drop --grid 4,4,1 --surface density=1 --out out.ply".into(), &["at least two cells"]),
        ("sample demo:vortex --grid 4,4 --out out.ply".into(), &["out.ply", "--surface"]),
    ] {
        folder.fail_with(2, &words, parts);
    }
    folder.fail_with(
        1,
        &format!("{cube} --surface density=5000 --out out.ply"),
        &["`density` goes from", "5000.0", "LEVEL"],
    );
    folder.fail_with(
        1,
        &format!("{cube} --quantity temperature --surface speed=5 --out out.ply"),
        &["demo:drop", "`speed`", "x, y, z, density, density_dx", "temperature_dz"],
    );
    let far = "--bounds 8,8,8,9,9,9 --estimate shepard --quantity temperature --surface temperature=5 --out out.ply";
    refused(&folder, &format!("{cube} {far}"), &["`temperature` has no value anywhere"]);
    folder.write("out.ply", "precious");
    folder.fail_with(1, &format!("{cube} --surface density=500 --out out.ply"), &["out.ply", "--force"]);
    assert_eq!(folder.bytes("out.ply"), b"precious");
}

#[test]
fn the_example_in_the_help_works() {
    let folder = Folder::new();
    let help = folder.succeed("sample --help").stdout;
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let (_, example) = help.split_once("For example: fluisim ").unwrap();
    let (example, _) = example.split_once("drop.ply").unwrap();
    let example = example.replace("60,60,60", "30,30,30");
    let said = folder.succeed(&format!("{example}drop.ply --particles 3000"));
    assert!(!said.stderr.contains("border"), "{}", said.stderr);
    assert_eq!(Read::ply(&folder.bytes("drop.ply")).open_edges(), 0);
}

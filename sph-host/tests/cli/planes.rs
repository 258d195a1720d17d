//! `--dim`: sums over fewer dimensions than a file has coordinates.

use crate::support::{Columns, Folder};

/// 400 particles in a plane across one axis, of density 1000 there.
fn plane(normal: usize) -> String {
    let mut text = String::from("x,y,z,m,A\n");
    for i in 0..400 {
        let mut x = [f64::from(i % 20) * 0.05, f64::from(i / 20) * 0.05, 3.5];
        let a = 1.0 + x[0] - 2.0 * x[1];
        x.swap(normal, 2);
        if normal == 0 {
            x.swap(1, 2);
        }
        text.push_str(&format!("{},{},{},2.5,{a}\n", x[0], x[1], x[2]));
    }
    text
}

#[test]
fn a_plane_in_space_is_told() {
    for (normal, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let folder = Folder::with("p.csv", plane(normal));
        let words = "sample p.csv --support 0.13 --at-particles";
        let said = folder.succeed(words);
        for part in ["warning: p.csv", &format!("`{axis}`"), "3.5", "3 dimensions", "--dim 2"] {
            assert!(said.stderr.contains(part), "`{part}` is missing in {}", said.stderr);
        }
        assert_eq!(said.stderr.lines().count(), 1);
        assert_eq!(folder.succeed(&format!("{words} --dim 2")).stderr, "");
        assert_eq!(folder.succeed(&format!("{words} --dim 3")).stderr, "", "3 dimensions were asked for");
    }
    let folder = Folder::with("p.csv", "x,y,z,m\n0,0,1,1\n1,0,1,1\n");
    let said = folder.succeed("sample p.csv --support 2 --at-particles");
    assert!(said.stderr.contains("`y`") && said.stderr.contains("--dim 1"), "{}", said.stderr);
    let said = folder.succeed("sample p.csv --support 2 --grid 2,2,2 --bounds 0,0,0,1,1,2 --chunk 1");
    assert!(said.stderr.contains("--dim 1"), "{}", said.stderr);
}

#[test]
fn the_axis_along_which_all_are_equal_is_dropped() {
    let folder = Folder::new();
    let expected = {
        let rows: String = plane(2)
            .lines()
            .skip(1)
            .map(|row| {
                let cells: Vec<&str> = row.split(',').collect();
                format!("{},{},{},{}\n", cells[0], cells[1], cells[3], cells[4])
            })
            .collect();
        folder.write("flat.csv", format!("x,y,m,A\n{rows}"));
        folder.columns("sample flat.csv --support 0.13 --at-particles --gradient")
    };
    assert!((expected.get("density")[210] / 1000.0 - 1.0).abs() < 0.01);
    for (normal, [across, up]) in [["y", "z"], ["x", "z"], ["x", "y"]].into_iter().enumerate() {
        folder.write("p.csv", plane(normal));
        let words = "sample p.csv --support 0.13 --dim 2 --gradient";
        let found = folder.columns(&format!("{words} --at-particles"));
        let names = ["x", "y", "z", "density"].map(str::to_owned);
        assert_eq!(found.names[..4], names);
        assert_eq!(found.names[4..6], [format!("density_d{across}"), format!("density_d{up}")]);
        for (name, flat) in [("density", "density"), ("A", "A")] {
            assert_eq!(found.get(name), expected.get(flat), "{across}{up}");
            assert_eq!(found.get(&format!("{name}_d{across}")), expected.get(&format!("{flat}_dx")));
            assert_eq!(found.get(&format!("{name}_d{up}")), expected.get(&format!("{flat}_dy")));
        }
        let grid = folder.columns(&format!("{words} --grid 4,3"));
        assert_eq!(grid.names[..3], [across, up, "density"].map(str::to_owned));
        let chunks = folder.columns(&format!("{words} --grid 4,3 --exact --chunk 50"));
        assert_eq!(chunks, folder.columns(&format!("{words} --grid 4,3 --exact")));
        let flat = folder.columns("sample flat.csv --support 0.13 --gradient --grid 4,3");
        assert_eq!(grid.values, flat.values);
        folder.succeed(&format!("{words} --grid 4,3 --out out{normal}.png"));
        let at = folder.columns(&format!("{words} --at p.csv"));
        assert_eq!(at.names, found.names);
        folder.succeed(&format!("{words} --at-particles --out out.vtu --force"));
        let back =
            folder.columns("sample out.vtu --support 0.1 --mass 1 --at-particles --quantity A --dim 2");
        assert_eq!(back.get("z"), found.get("z"), "a plane stays where it is");
    }
}

#[test]
fn what_is_not_flat_is_refused() {
    let folder = Folder::with("p.csv", "x,y,z,m\n0,0,1,1\n\n1,2,2,1\n");
    let words = "sample p.csv --support 3";
    folder.fail_with(1, &format!("{words} --at-particles --dim 2"), &["p.csv", "line 4", "z", "--dim 2"]);
    let chunked = format!("{words} --grid 2,2 --dim 2 --chunk 1");
    folder.fail_with(1, &chunked, &["p.csv", "z", "--dim 2"]);
    folder.write("line.csv", "x,y,z,m\n0,0,1,1\n0,1,1,1\n");
    let line = folder.columns("sample line.csv --support 3 --at-particles --dim 1 --gradient");
    assert_eq!(line.names, ["x", "y", "z", "density", "density_dy"]);
    let line = Columns::parse(&folder.succeed("sample line.csv --support 3 --grid 3 --dim 1").stdout);
    assert_eq!(line.names, ["y", "density"]);
}

#[test]
fn a_plane_that_was_written_is_read_back_with_its_axes_and_its_place() {
    for (normal, [across, up]) in [["y", "z"], ["x", "z"], ["x", "y"]].into_iter().enumerate() {
        let folder = Folder::with("p.csv", plane(normal));
        let words = "sample p.csv --support 0.13 --dim 2 --grid 40,30 --quantity A";
        for ending in ["csv", "npz", "vtu", "xyz"] {
            folder.succeed(&format!("{words} --out g.{ending}"));
            let has_names = ["csv", "npz"].contains(&ending);
            let again = format!("sample g.{ending} --support 0.13 --mass 1 --dim 2 --gradient --quantity A");
            let said = folder.succeed(&format!("{again} --at-particles"));
            let missing = format!("`{across}` and `{up}` alone");
            assert_eq!(
                said.stderr.contains(&missing),
                has_names && [across, up] != ["x", "y"],
                "{}",
                said.stderr
            );
            let found = Columns::parse(&said.stdout);
            for axis in ["x", "y", "z"].iter().filter(|axis| !has_names || [across, up].contains(axis)) {
                let along = found.get(axis);
                let is_flat = ![across, up].contains(axis);
                assert_eq!(along.iter().all(|&x| x == 3.5), is_flat, "{ending}, {axis}");
            }
            let slopes = [format!("A_d{across}"), format!("A_d{up}")];
            assert_eq!(found.names[found.names.len() - 2..], slopes, "{ending}");
            folder.succeed(&format!(
                "sample p.csv --support 0.13 --dim 2 --at g.{ending} --out at.csv --force"
            ));
        }
        for (file, before) in [("g.vti", "Origin=\""), ("g.vtk", "ORIGIN ")] {
            folder.succeed(&format!("{words} --out {file} --force"));
            let text = String::from_utf8_lossy(&folder.bytes(file)).into_owned();
            let origin = text.split_once(before).unwrap().1.split(['"', '\n']).next().unwrap();
            assert_eq!(origin.split(' ').nth(normal), Some("3.5"), "{file}: {origin}");
        }
    }
}

#[test]
fn a_plane_of_two_axes_is_one_for_points_and_boxes_too() {
    let folder = Folder::with("p.csv", "x,z,m,A\n0,0,1,1\n1,0,1,2\n0,1,1,3\n1,1,1,4\n");
    let flat = Folder::with("p.csv", "x,y,m,A\n0,0,1,1\n1,0,1,2\n0,1,1,3\n1,1,1,4\n");
    for words in [
        "--at-particles --gradient --exact",
        "--at-particles --periodic 0,0,2,2",
        "--grid 2,3 --gradient --chunk 2",
        "--grid 2,3 --periodic 0,0,2,0 --chunk 3",
        "--at-particles --only A=2..4 --scalar i16f16",
        "--grid 3,3 --part 2/3",
    ] {
        let words = format!("sample p.csv --support 1.5 {words}");
        let (found, expected) = (folder.columns(&words), flat.columns(&words));
        let renamed = expected
            .names
            .iter()
            .map(|name| if name == "y" { "z".into() } else { name.replace("_dy", "_dz") });
        assert_eq!(found.names, renamed.collect::<Vec<_>>(), "{words}");
        assert_eq!(found.values, expected.values, "{words}");
    }
    folder.write("space.csv", "x,y,z\n0.5,7,0.25\n");
    let at = folder.columns("sample p.csv --support 1.5 --at space.csv --dim 2");
    assert_eq!((at.get("y"), at.get("z")), (&[7.0][..], &[0.25][..]));
    folder.write("other.csv", "x,y\n0.5,0.25\n");
    let words = "sample p.csv --support 1.5 --at other.csv";
    folder.fail_with(1, words, &["other.csv", "x, y (2)", "p.csv", "x, z (2)"]);
    folder.write("named.csv", "a_y,a_z,m\n0,0,1\n1,0,1\n");
    let named =
        folder.columns("sample named.csv --support 1.5 --position a_y,a_z --at-particles --quantity m");
    assert_eq!(named.names, ["y", "z", "density", "m"]);
}

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

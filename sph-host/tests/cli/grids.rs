//! Where points are: grids, their order and their box; points out of reach; no points at all.

use crate::support::Folder;

#[test]
fn cell_centres_run_along_x_first() {
    let folder = Folder::new();
    let words = "sample demo:lattice --particles 64 --grid 3,2,2 --bounds -3,0,1,3,1,2";
    let columns = folder.columns(words);
    assert_eq!(columns.names, ["x", "y", "z", "density", "A"]);
    assert_eq!(columns.get("x"), [-2.0, 0.0, 2.0].repeat(4));
    let y = [[0.25; 3], [0.75; 3]].concat().repeat(2);
    assert_eq!(columns.get("y"), y);
    assert_eq!(columns.get("z"), [[1.25; 6], [1.75; 6]].concat());
}

#[test]
fn without_bounds_the_box_is_that_of_the_particles() {
    let folder = Folder::with("p.csv", "x,y,m\n-1,5,1\n3,6,1\n0,9,1\n");
    let columns = folder.columns("sample p.csv --support 1 --grid 2,4");
    assert_eq!(columns.get("x"), [0.0, 2.0].repeat(4));
    assert_eq!(columns.get("y"), [5.5, 5.5, 6.5, 6.5, 7.5, 7.5, 8.5, 8.5]);
    let line = Folder::with("p.csv", "x,m\n0,1\n1,1\n");
    assert_eq!(line.columns("sample p.csv --support 1 --grid 2").get("x"), [0.25, 0.75]);
}

#[test]
fn a_flat_set_is_flat_only_when_asked() {
    let folder = Folder::with("p.csv", "x,y,z,m\n0,0,7,1\n1,0,7,1\n");
    folder.write("q.csv", "x,y,m\n0,0,1\n1,0,1\n");
    let deep = folder.columns("sample p.csv --support 2 --at-particles");
    let flat = folder.columns("sample p.csv --support 2 --at-particles --dim 2");
    let plain = folder.columns("sample q.csv --support 2 --at-particles");
    assert_eq!(flat.get("density"), plain.get("density"));
    assert_ne!(flat.get("density"), deep.get("density"));
    assert_eq!(flat.get("z"), [7.0, 7.0], "coordinates are as read");
    let grid = folder.columns("sample p.csv --support 2 --grid 2,1 --dim 2 --bounds 0,-1,1,1 --gradient");
    assert_eq!(grid.names, ["x", "y", "density", "density_dx", "density_dy"]);
}

#[test]
fn points_out_of_reach_are_empty_and_counted() {
    let folder = Folder::with("p.csv", "x,y,m,rho,A\n0,0,1,1,5\n1,0,1,1,5\n0,1,1,1,5\n1,1,1,1,5\n");
    // in reach, just out of it, on the edge of the support, far away
    folder.write("at.csv", "x,y\n0.5,0.5\n-2.001,0\n3,0\n1e300,0\n");
    for (estimate, beyond, gradient) in [("plain", "0.0", "0.0"), ("shepard", "", ""), ("corrected", "", "")]
    {
        let words = format!("sample p.csv --support 2 --at at.csv --gradient --estimate {estimate}");
        let said = folder.succeed(&words);
        assert!(said.stderr.contains("warning: 3 of 4 points"), "{}", said.stderr);
        let lines: Vec<&str> = said.stdout.lines().collect();
        assert_eq!(lines[0], "x,y,density,density_dx,density_dy,A,A_dx,A_dy");
        for line in &lines[2..] {
            let end = format!(",0.0,0.0,0.0,{beyond},{gradient},{gradient}");
            assert!(line.ends_with(&end), "{estimate}: {line}");
        }
        assert!(!lines[1].contains(",,"), "{estimate}: {}", lines[1]);
    }
}

#[test]
fn too_few_or_flat_particles_carry_no_corrected_estimate() {
    let folder = Folder::with("p.csv", "x,y,m,rho,A\n0,0,1,1,5\n1,0,1,1,5\n2,0,1,1,5\n");
    folder.write("at.csv", "x,y\n1,0\n-0.5,0\n9,0\n");
    let said = folder.succeed("sample p.csv --support 1.8 --at at.csv --estimate corrected");
    assert!(said.stderr.contains("warning: 1 of 3 points"), "{}", said.stderr);
    assert!(said.stderr.contains("warning: 2 of 3 points"), "{}", said.stderr);
    assert!(said.stdout.lines().skip(1).all(|line| line.ends_with(',')), "{}", said.stdout);
}

#[test]
fn shepard_is_exact_for_constants_and_corrected_for_planes() {
    let rows: String = (0..36)
        .map(|i| (f64::from(i % 6) + 0.2 * f64::from(i % 5), f64::from(i / 6) - 0.1 * f64::from(i % 7)))
        .map(|(x, y)| format!("{x},{y},1,7,{}\n", 3.0 * x - 2.0 * y + 1.0))
        .collect();
    let folder = Folder::with("p.csv", format!("x,y,m,C,A\n{rows}"));
    let words = "sample p.csv --support 2.5 --at-particles --gradient --estimate";
    let shepard = folder.columns(&format!("{words} shepard"));
    assert!(shepard.get("C").iter().all(|c| (c - 7.0).abs() < 1e-13));
    assert!(shepard.get("C_dx").iter().all(|slope| slope.abs() < 1e-12));
    let corrected = folder.columns(&format!("{words} corrected"));
    for (x, (y, a)) in corrected.get("x").iter().zip(corrected.get("y").iter().zip(corrected.get("A"))) {
        assert!((a - (3.0 * x - 2.0 * y + 1.0)).abs() < 1e-11);
    }
    assert!(corrected.get("A_dx").iter().all(|slope| (slope - 3.0).abs() < 1e-10));
    assert!(corrected.get("A_dy").iter().all(|slope| (slope + 2.0).abs() < 1e-10));
}

#[test]
fn no_points_give_the_header_alone() {
    let folder = Folder::with("p.csv", "x,y,m,A\n0,0,1,5\n1,0,1,5\n");
    folder.write("at.csv", "x,y\n");
    let said = folder.succeed("sample p.csv --support 2 --at at.csv --gradient --timing");
    assert_eq!(said.stdout, "x,y,density,density_dx,density_dy,A,A_dx,A_dy\n");
    assert!(said.stderr.starts_with("warning: there are no points"), "{}", said.stderr);
    for name in ["out.csv", "out.npz", "out.vtk", "out.vtu"] {
        folder.succeed(&format!("sample p.csv --support 2 --at at.csv --out {name}"));
        assert!(!folder.bytes(name).is_empty());
    }
}

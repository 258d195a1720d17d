//! Coordinates under the names that programs give them, and units behind names.

use crate::support::Folder;

const WORDS: &str = "--support 1.5 --at-particles --gradient";
const PLAIN: &str = "x,y,m,rho,A\n0,0,1,2,3\n0.5,0,1,2,4\n0,0.5,1,2,-5e-1\n";

#[test]
fn coordinates_are_found_under_the_names_of_programs() {
    let folder = Folder::with("p.csv", PLAIN);
    let expected = folder.succeed(&format!("sample p.csv {WORDS}")).stdout;
    for header in [
        "\"Points:0\",\"Points:1\",mass,rho,A",
        "Points_0,Points_1,m,rho,A",
        "pos_x,pos_y,m,rho,A",
        "Pos.x [m],Pos.y [m],m [kg],rho [kg/m^3],A [Pa]",
        "x [m],y [m],m,rho,A",
        "position_x,position_y,m,rho,A",
        "coords:0,coords:1,m,rho,A",
    ] {
        folder.write("v.csv", PLAIN.replace("x,y,m,rho,A", header));
        let found = folder.succeed(&format!("sample v.csv {WORDS}")).stdout;
        assert_eq!(found, expected, "{header}");
        let found = folder.succeed("sample v.csv --support 1.5 --grid 2,2 --chunk 2").stdout;
        assert_eq!(
            found,
            folder.succeed("sample p.csv --support 1.5 --grid 2,2 --chunk 2").stdout,
            "{header}"
        );
    }
    folder.write("points.csv", "Points:0,Points:1\n0.1,0.1\n");
    assert_eq!(folder.columns("sample p.csv --support 1.5 --at points.csv").get("x"), [0.1]);
}

#[test]
fn two_sets_of_coordinates_are_an_error_unless_one_is_named() {
    let folder = Folder::with("p.csv", "x,y,pos_x,pos_y,m\n0,0,5,5,1\n1,0,6,5,1\n");
    let words = "sample p.csv --support 1.5 --at-particles";
    folder.fail_with(1, words, &["p.csv: line 1", "`x`, `y`", "`pos_x`, `pos_y`", "--position"]);
    for (position, first) in [("pos", [5.0, 6.0]), ("pos_x,pos_y", [5.0, 6.0]), ("x,y", [0.0, 1.0])] {
        let found = folder.columns(&format!("{words} --quantity m --position {position}"));
        assert_eq!(found.get("x"), first, "{position}");
    }
    assert_eq!(folder.columns(&format!("{words} --quantity m --position y,pos_x")).get("y"), [5.0, 6.0]);
    folder.fail_with(1, &format!("{words} --position w"), &["p.csv: line 1", "`w`", "`pos_x`"]);
    folder.fail_with(2, &format!("{words} --position x,x"), &["--position", "once"]);
    folder.fail_with(2, &format!("{words} --position a,b,c,d"), &["--position"]);
    folder.fail_with(2, "sample demo:vortex --at-particles --position x,y", &["--position", "built-in"]);
    folder.write("none.csv", "a,b\n1,2\n");
    folder.fail_with(
        1,
        "sample none.csv --support 1 --at-particles",
        &["line 1", "`x`", "`a`", "--position"],
    );
}

#[test]
fn a_named_position_is_that_of_points_too_where_they_have_it() {
    let folder = Folder::with("p.csv", "a,b,m\n0,0,1\n1,0,1\n");
    folder.write("at.csv", "x,y\n0.5,0.25\n");
    let words = "sample p.csv --support 1.5 --quantity m --position a,b";
    assert_eq!(folder.columns(&format!("{words} --at p.csv")).get("x"), [0.0, 1.0]);
    assert_eq!(folder.columns(&format!("{words} --at at.csv")).get("y"), [0.25]);
    for wrong in ["--position=", "--position a,", "--position a,a"] {
        folder.fail_with(2, &format!("sample p.csv --support 1 --at-particles {wrong}"), &["--position"]);
    }
    folder.write("p.pvtu.gz", [0x1f, 0x8b]);
    folder.fail_with(2, "sample p.pvtu.gz --support 1 --at-particles", &["p.pvtu.gz", "beside"]);
}

#[test]
fn quantities_are_known_with_and_without_the_unit() {
    let text = "x,m,p [Pa],Vel.x [m/s],Vel.y [m/s],Vel.z [m/s]\n0,1,2,1,2,3\n1,1,2,1,2,3\n";
    let folder = Folder::with("p.csv", text);
    let words = "sample p.csv --support 1.5 --at-particles";
    assert_eq!(folder.columns(words).names, ["x", "density", "p", "Vel.x", "Vel.y", "Vel.z"]);
    assert_eq!(folder.columns(&format!("{words} --quantity Vel")).names[2..], ["Vel.x", "Vel.y", "Vel.z"]);
    let mut command = folder.command(words);
    let output = command.args(["--quantity", "p [Pa]"]).output().unwrap();
    assert!(String::from_utf8(output.stdout).unwrap().starts_with("x,density,p"));
    folder.write("p.csv", "x,m,T [K],T [C]\n0,1,300,27\n");
    assert_eq!(
        folder.columns(words).names,
        ["x", "density", "T [K]", "T [C]"],
        "units that tell columns apart stay"
    );
}

#[test]
fn an_array_of_vtk_or_numpy_can_be_the_coordinates() {
    let folder = Folder::with(
        "p.vtk",
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 0 0 1 0 0\nPOINT_DATA 2\n\
         SCALARS m float\nLOOKUP_TABLE default\n1 1\nVECTORS initial float\n7 0 1 8 0 2\n",
    );
    let words = "sample p.vtk --support 1.5 --at-particles --quantity m";
    assert_eq!(folder.columns(words).get("x"), [0.0, 1.0]);
    let found = folder.columns(&format!("{words} --position initial"));
    assert_eq!((found.get("x"), found.get("z")), (&[7.0, 8.0][..], &[1.0, 2.0][..]));
    folder.fail_with(1, &format!("{words} --position m,w"), &["p.vtk", "`w`"]);
}

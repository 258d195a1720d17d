//! Which columns there are, and what they are called.

use crate::support::{Columns, Folder};

const PARTICLES: &str = "x,y,m,rho,velocity_x,velocity_y,A,kind\n0,0,1,2,1,-1,3,air\n0.5,0,1,2,1.5,-2,4,-\n";

fn names(words: &str) -> Vec<String> {
    let folder = Folder::with("p.csv", PARTICLES);
    folder.columns(&format!("sample p.csv --support 1 --at-particles {words}")).names
}

#[test]
fn by_default_every_numeric_column_that_is_not_special() {
    assert_eq!(names(""), ["x", "y", "density", "velocity_x", "velocity_y", "A"]);
    assert_eq!(names("--quantity A"), ["x", "y", "density", "A"]);
    let gradients = ["x", "y", "density", "density_dx", "density_dy", "A", "A_dx", "A_dy"];
    assert_eq!(names("--quantity A --gradient"), gradients);
}

#[test]
fn a_vector_is_asked_for_whole_or_by_component() {
    assert_eq!(names("--quantity velocity"), ["x", "y", "density", "velocity_x", "velocity_y"]);
    assert_eq!(names("--quantity velocity_y"), ["x", "y", "density", "velocity_y"]);
    let twice = ["x", "y", "density", "velocity_y", "velocity_x"];
    assert_eq!(names("--quantity velocity_y --quantity velocity"), twice, "nothing twice");
    let folder = Folder::new();
    let drop = "sample demo:drop --particles 500 --at-particles --quantity";
    let whole = folder.columns(&format!("{drop} velocity"));
    assert_eq!(whole.names, ["x", "y", "z", "density", "velocity_x", "velocity_y", "velocity_z"]);
    let part = folder.columns(&format!("{drop} velocity_y"));
    assert_eq!(part.names, ["x", "y", "z", "density", "velocity_y"]);
    assert_eq!(part.get("velocity_y"), whole.get("velocity_y"));
}

#[test]
fn the_density_column_is_a_quantity_when_asked_for() {
    assert_eq!(names("--quantity rho"), ["x", "y", "density", "rho"]);
    assert_eq!(names("--quantity density"), ["x", "y", "density", "density_interpolated"]);
    let folder = Folder::with("p.csv", PARTICLES.replace("rho", "Density"));
    let sample = "sample p.csv --support 1 --at-particles --estimate shepard";
    let found = folder.columns(&format!("{sample} --quantity Density --quantity rho"));
    assert_eq!(found.names, ["x", "y", "density", "density_interpolated", "rho"]);
    assert_eq!(found.get("rho"), [2.0, 2.0], "the file's column, not the sum");
    assert_eq!(found.get("rho"), found.get("density_interpolated"));
    assert_ne!(found.get("rho"), found.get("density"));
    // summed densities are the weights, the column is still the quantity, whatever it holds
    let folder = Folder::with("p.csv", PARTICLES.replace(",2,", ",-2,"));
    let found = folder.columns(&format!("{sample} --recompute-density --quantity rho"));
    assert_eq!(found.get("rho"), [-2.0, -2.0]);
}

#[test]
fn a_column_h_is_a_quantity_like_any_other() {
    let folder = Folder::with("p.csv", "x,y,m,h\n0,0,1,3\n1,0,1,3\n");
    let columns = folder.columns("sample p.csv --support 2 --at-particles --estimate shepard");
    assert!(columns.get("h").iter().all(|h| (h - 3.0).abs() < 1e-15));
    folder.fail_with(1, "sample p.csv --at-particles", &["--support"]);
}

#[test]
fn two_results_of_one_name_are_refused() {
    let folder = Folder::with("p.csv", "x,m,density,density_interpolated\n0,1,1,5\n1,1,1,6\n");
    let words = "sample p.csv --support 2 --at-particles --quantity density --quantity density_interpolated";
    folder.fail_with(1, &format!("{words} --out out.csv"), &["density_interpolated"]);
}

#[test]
fn options_win_over_columns_whatever_these_hold() {
    let folder = Folder::with("p.csv", "x,y,m,rho,h,A\n0,0,0,-1,nan,1\n1,0,oops,0,x,2\n");
    folder.write("q.csv", "x,y,A\n0,0,1\n1,0,2\n");
    let words = "--mass 1 --support 2 --quantity A --at-particles";
    let found = folder.columns(&format!("sample p.csv {words} --recompute-density --support-column h"));
    assert_eq!(found, folder.columns(&format!("sample q.csv {words}")));
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let folder = Folder::new();
    let words = "sample demo:vortex --particles 400 --at-particles";
    let printed = folder.columns(words);
    folder.succeed(&format!("{words} --out out.csv"));
    assert_eq!(Columns::parse(&String::from_utf8(folder.bytes("out.csv")).unwrap()), printed);
    // coordinates that have gone through the file are the same points; densities at particles are summed pair by pair
    let again = folder.columns("sample demo:vortex --particles 400 --at out.csv");
    let close = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() < 4e-15;
    assert!(again.get("density").iter().zip(printed.get("density")).all(close));
    for (name, values) in printed.names.iter().zip(&printed.values).filter(|(name, _)| *name != "density") {
        assert_eq!(again.get(name), values, "{name}");
    }
    let demo = sph_host::demo::set("vortex", Some(400)).unwrap();
    assert_eq!(printed.get("x"), demo.table.coordinates[0]);
}

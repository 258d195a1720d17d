//! Text tables: what is taken, and what each error names.

use sph_host::io::{PointTable, ReadError, read};

fn table(text: impl AsRef<[u8]>) -> Result<PointTable, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.csv");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

/// The error of `text`, without the file's name.
fn error(text: impl AsRef<[u8]>) -> String {
    let message = table(text).unwrap_err().to_string();
    message.split_once("p.csv: ").unwrap().1.to_owned()
}

fn message(error: ReadError) -> String {
    error.to_string().split_once("p.csv: ").unwrap().1.to_owned()
}

#[test]
fn marks_blanks_and_comments_are_taken() {
    let text = "\u{feff}# a \"comment\r\n X , \"Y\" ,RHO,\"name, long\"\r\n\r\n 1. , +2 ,1e3, a\r\n#1,2,3\r\n.5,\"-2\",999,b";
    let table = table(text).unwrap();
    assert_eq!(table.coordinates, [[1.0, 0.5], [2.0, -2.0]]);
    assert_eq!(*table.density().unwrap().unwrap().values, [1000.0, 999.0]);
    assert_eq!(*table.quantity("rho").unwrap().values, [1000.0, 999.0]);
    assert_eq!(*table.quantity("density").unwrap().values, [1000.0, 999.0]);
    assert_eq!((table.locate(0), table.locate(1)), ("line 4".to_owned(), "line 6".to_owned()));
    assert!(table.default_quantities().is_empty(), "text is no quantity");
}

#[test]
fn numbers_are_read_to_the_bit() {
    let mut state = 1u64;
    let values: Vec<f64> = (0..3000)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            f64::from_bits(state)
        })
        .filter(|value| value.is_finite())
        .chain([f64::MIN_POSITIVE, 5e-324, f64::MAX, -0.0, 0.1])
        .collect();
    let text: String = values.iter().map(|value| format!("{value:?},{value:e}\n")).collect();
    let table = table(format!("x,y\n{text}")).unwrap();
    for axis in &table.coordinates {
        assert!(axis.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

#[test]
fn text_harms_only_where_it_is_used() {
    let text = "x,y,z,kind,temp,note\n0,0,0,air,1,\n\n0,0,0,water,-,\n0,0,0,\"a\nb\",oops,\n0,0,bad,air,3,\n";
    assert_eq!(error(text), "line 7, column `z`: `bad` where a number is expected");
    let table = table(text.replace("bad", "1")).unwrap();
    assert_eq!(table.default_quantities(), ["temp"]);
    let problem = |name: &str| message(table.quantity(name).unwrap_err());
    assert_eq!(problem("temp"), "line 4, column `temp`: `-` where a number is expected");
    assert_eq!(problem("kind"), "line 2, column `kind`: `air` where a number is expected");
    let note = table.quantity("note").unwrap();
    assert!(note.values.iter().all(|value| value.is_nan()));
    let empty = message(table.require_finite(&note).unwrap_err());
    assert_eq!(empty, "line 2, column `note`: the cell is empty where a finite number is expected");
    assert_eq!(problem("X"), "line 1: `X` is a coordinate, not a quantity");
    assert!(problem("foo").contains("`temp`"));
    assert_eq!(table.locate(3), "line 7");
}

#[test]
fn headers_at_fault() {
    assert!(error("x,y,x\n").starts_with("line 1: two columns have one name"));
    assert!(error("#\nx,Rho,rho\n").starts_with("line 2: two columns have one name"));
    assert!(table("x,a,A\n1,2,3\n").is_ok(), "only special names are the same in any case");
    assert_eq!(error("x,,m\n1,2,3\n"), "line 1, column 2: the name is missing");
    assert!(error("1,2\n3,4\n").starts_with("line 1, column 1: `1` is a number"));
    assert!(error("a;b\n").contains("no column is called `x`; there are `a`, `b`"));
    assert!(error("a b\n").contains("no column is called `x`; there are `a b`"));
    assert_eq!(error("y,m\n"), "line 1: there is a `y` but no `x`");
    assert_eq!(error("x,a,z\n"), "line 1: there is a `z` but no `y`");
    assert_eq!(table("x,z\n").unwrap().space, [0, 2], "a plane, and a note says so");
    assert!(error(b"x,\xff\n").contains("not UTF-8"));
}

#[test]
fn rows_at_fault() {
    assert_eq!(error("x,y\n1,2\n\n#\n1\n"), "line 5: the row has 1 cell where the header has 2");
    assert_eq!(error("x,y\n\"1\",2,3\n"), "line 2: the row has 3 cells where the header has 2");
    assert_eq!(error("x,y\n1,\"2\n3,4\n"), "line 2: a quotation mark is never closed");
    for text in ["1,5", "0x10", "1e", "--1", "1_0"] {
        let problem = error(format!("x;y\n{text};2\n").replace(',', "\",\"").replace(';', ","));
        assert!(problem.starts_with("line 2"), "{problem}");
    }
}

#[test]
fn dimensions_follow_the_columns() {
    for (text, dimensions) in [("x\n", 1), ("y,x\n", 2), ("Z,m,Y,X\n", 3)] {
        let table = table(text).unwrap();
        assert_eq!((table.dimensions(), table.len()), (dimensions, 0));
    }
}

#[test]
fn masses_and_densities() {
    let table = table("x,m,Mass,density,h\n0,1,1,nan,2\n1,1,1,0,3\n").unwrap();
    assert!(message(table.mass().unwrap_err()).starts_with("line 1: both `m` and `Mass`"));
    let density = table.density().unwrap().unwrap();
    let problem = message(table.require_positive(&density).unwrap_err());
    assert_eq!(problem, "line 2, column `density`: NaN where a positive finite number is expected");
    assert_eq!(table.default_quantities(), ["h"], "h is a column like any other");
    let mass = table.quantity("mass").unwrap();
    table.require_positive(&mass).unwrap();
}

#[test]
fn vectors_whole_and_by_component() {
    let table = table("x,y,v_y,v_x,w_x,w_z,v\n0,0,2,1,5,6,9\n1,1,4,3,7,8,9\n").unwrap();
    assert_eq!(*table.quantity("v").unwrap().values, [9.0, 9.0], "the exact name wins");
    assert_eq!(*table.quantity("v_x").unwrap().values, [1.0, 3.0]);
    assert!(table.quantity("w").is_err(), "w has no w_y");
    assert_eq!(table.default_quantities(), ["v_y", "v_x", "w_x", "w_z", "v"]);
    let table = self::table("x,y,v_y,v_x\n0,0,2,1\n1,1,inf,3\n").unwrap();
    let vector = table.quantity("v").unwrap();
    assert_eq!((&*vector.values, vector.components()), (&[1.0, 2.0, 3.0, f64::INFINITY][..], 2));
    let problem = message(table.require_finite(&vector).unwrap_err());
    assert_eq!(problem, "line 3, column `v_y`: inf where a finite number is expected");
    assert!(message(table.scalar("v").unwrap_err()).contains("2 numbers a point"));
}

#[test]
fn coordinates_are_finite_and_so_is_their_extent() {
    let problem = |text: &str| message(table(text).unwrap().require_finite_coordinates().unwrap_err());
    assert_eq!(problem("x,y\n0,0\n1,NaN\n"), "line 3, column `y`: NaN where a finite number is expected");
    let wide = problem("x\n1e308\n0\n-1e308\n");
    assert!(wide.contains("line 2") && wide.contains("line 4"), "{wide}");
    table("x\n").unwrap().require_finite_coordinates().unwrap();
}

#[test]
fn tabs_delimit_a_tsv() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.TSV");
    std::fs::write(&path, "x\ty y\n1,5\t2\n").unwrap();
    let problem = read(&path).unwrap_err().to_string();
    assert!(problem.ends_with("line 2, column `x`: `1,5` where a number is expected"), "{problem}");
}

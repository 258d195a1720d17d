//! What is not used does no harm, and is named where it is used.

use zip::CompressionMethod;

use crate::support::{
    BOTH, File, VTK, archive, array, npy, read, refused, three_points, unusable, values, vtu,
};

#[test]
fn what_is_no_number_harms_its_own_array_alone() {
    for word in ["***", "text", "--", "1,5", "1.0.0"] {
        let vtk = format!(
            "{VTK}DATASET POLYDATA\nPOINTS 2 float 0 0 0 1 1 1\nLINES 1 3 2 0 {word}\nPOINT_DATA 2\n\
             SCALARS a float\nLOOKUP_TABLE default\n1 {word}\nVECTORS v float\n1 2 3 4 5 6\nFIELD f 2\n\
             c 1 2 int {word} 7\nd 1 2 int 8 9\nCELL_DATA 1\nSCALARS e int\nLOOKUP_TABLE default\n{word}\n"
        );
        let both = [array("a", &format!("1 {word}")), array("c", &format!("{word} 7")), array("d", "8 9")];
        for table in [read("p.vtk", vtk), read("p.vtu", vtu(&[(2, &both.concat())]))] {
            assert_eq!(values(&table, "d"), [8.0, 9.0]);
            let message = unusable(&table, "a");
            assert!(
                message.starts_with("array `a`, point 1: ") && message.contains(&format!("`{word}`")),
                "{message}"
            );
            assert!(unusable(&table, "c").starts_with("array `c`, point 0: "));
            assert!(table.default_quantities().contains(&"a".to_owned()), "it has numbers, so it is wanted");
        }
    }
    let table = read("p.vtu", vtu(&[(2, &array("t", "*** ---"))]));
    assert!(table.default_quantities().is_empty(), "nothing in it is a number");
}

#[test]
fn short_and_long_arrays_harm_nobody_else() {
    let fine = array("d", "8 9");
    for (text, part) in [("1", "1 of 2 numbers"), ("", "0 of 2 numbers"), ("1 2 3", "more than 2")] {
        let table = read("p.vtu", vtu(&[(2, &[array("a", text), fine.clone()].concat())]));
        assert_eq!(values(&table, "d"), [8.0, 9.0]);
        let message = unusable(&table, "a");
        assert!(message.starts_with("array `a`: ") && message.contains(part), "{message}");
    }
    for rest in ["VECTORS d float 1 2 3 4 5 6", "SCALARS d_x float 1\nLOOKUP_TABLE default 1 4"] {
        let start = format!("{VTK}DATASET POLYDATA\nPOINTS 2 float 0 0 0 1 1 1\nPOINT_DATA 2\n");
        let table = read("p.vtk", format!("{start}SCALARS a float\nLOOKUP_TABLE default\n1\n{rest}\n"));
        assert_eq!(values(&table, "d_x"), [1.0, 4.0]);
        assert!(unusable(&table, "a").contains("1 of 2 numbers"));
        let table = read(
            "p.vtk",
            format!("{start}FIELD f 2\na 1 2 float 1\nd_x 1 2 float 1 4\n{rest}")
                .replace("\nVECTORS d ", "\nVECTORS e ")
                .replace("\nSCALARS d_x", "\nSCALARS e"),
        );
        assert_eq!(values(&table, "d_x"), [1.0, 4.0]);
        assert!(unusable(&table, "a").contains("1 of 2 numbers"));
    }
    let short = [("a.npy", npy("(3,)", &[1.0, 2.0])), ("d.npy", npy("(3,)", &[7.0, 8.0, 9.0]))];
    for method in BOTH {
        let members = [&[("x.npy", npy("(3,)", &[0.0, 0.5, 1.0]))], &short[..]].concat();
        let file = File::new("p.npz", archive(&members, method));
        let table = file.read().unwrap();
        assert_eq!(values(&table, "d"), [7.0, 8.0, 9.0]);
        assert!(unusable(&table, "a").starts_with("array `a`: 16 bytes"), "{}", unusable(&table, "a"));
        let pieces = file.pieces().unwrap();
        assert_eq!(pieces.iter().flat_map(|piece| values(piece, "d")).collect::<Vec<_>>(), [7.0, 8.0, 9.0]);
        assert!(pieces.iter().any(|piece| piece.quantity("a").is_err()));
    }
}

#[test]
fn an_array_that_one_piece_has_not_harms_nobody_else() {
    let (a, b) = (array("a", "1 2"), array("b", "3 4"));
    for (first, second, missing) in [
        (format!("{a}{b}"), b.clone(), 1),
        (b.clone(), format!("{a}{b}"), 0),
        (
            format!("{b}{a}"),
            format!("{}{b}", array("a", "1 2 3 4").replace("Name", "NumberOfComponents=\"2\" Name")),
            1,
        ),
    ] {
        let table = read("p.vtu", vtu(&[(2, &first), (2, &second)]));
        assert_eq!(values(&table, "b"), [3.0, 4.0, 3.0, 4.0]);
        let message = unusable(&table, "a");
        assert!(
            message.starts_with("array `a`: ") && message.contains(&format!("piece {missing}")),
            "{message}"
        );
    }
    let table = read(
        "p.vtu",
        vtu(&[(
            2,
            "<DataArray type=\"Complex\" Name=\"c\">1 2</DataArray><DataArray type=\"Int32\" Name=\"o\" format=\"appended\"/><DataArray type=\"Int32\" NumberOfComponents=\"none\" Name=\"n\">1 2</DataArray>",
        )]),
    );
    for (name, part) in [("c", "Complex"), ("o", "offset"), ("n", "none")] {
        assert!(unusable(&table, name).contains(part));
    }
}

#[test]
fn an_empty_cell_is_no_value_and_is_named_where_one_is_wanted() {
    let table = read("p.csv", "x,a,m,t\n0,1,2,\n1,,,\n");
    assert!(values(&table, "a")[1].is_nan());
    let error = table.require_finite(&table.quantity("a").unwrap()).unwrap_err().to_string();
    assert!(
        error.ends_with("line 3, column `a`: the cell is empty where a finite number is expected"),
        "{error}"
    );
    let error = table.require_positive(&table.mass().unwrap().unwrap()).unwrap_err().to_string();
    assert!(
        error.ends_with("column `m`: the cell is empty where a positive finite number is expected"),
        "{error}"
    );
    assert_eq!(table.default_quantities(), ["a"], "a column without any number is not wanted");
    let message = refused("p.csv", "x,a\n0,1\n,2\n");
    assert_eq!(message, "p.csv: line 3, column `x`: the cell is empty where a number is expected");
}

#[test]
fn what_stands_beside_the_particles_in_an_archive_is_passed_over() {
    let members = [
        ("box.npy", npy("(2,)", &[0.0, 1.0])),
        ("gravity.npy", npy("(2, 1)", &[0.0, 1.0])),
        ("time.npy", npy("()", &[0.25])),
        ("a.npy", npy("(3,)", &[1.0, 2.0, 3.0])),
        ("readme.txt", b"hello".to_vec()),
    ];
    for (single, shape) in [("mass", "()"), ("M", "(1,)"), ("mass", "(1, 1)")] {
        let single = format!("{single}.npy");
        let more =
            [&members[..], &[(&*single, npy(shape, &[0.5])), ("rho.npy", npy("(1,)", &[998.0]))]].concat();
        let file = File::new("p.npz", three_points(&more));
        let tables = [vec![file.read().unwrap()], file.pieces().unwrap()];
        for table in tables.iter().flatten() {
            assert_eq!(table.default_quantities(), ["a"]);
            assert_eq!(*table.mass().unwrap().unwrap().values, vec![0.5; table.len()]);
            assert_eq!(*table.density().unwrap().unwrap().values, vec![998.0; table.len()]);
            assert_eq!(
                unusable(table, "box"),
                "array `box`: shape [2], where [3] or [3, n] for 3 points is expected"
            );
            assert!(unusable(table, "time").starts_with("array `time`: a single number"));
        }
    }
    let message = refused("p.npz", archive(&[("x.txt", Vec::new())], CompressionMethod::Stored));
    assert_eq!(message, "p.npz: there are no arrays in the archive: members that end in .npy are expected");
    // Masses and densities are in use: of another length they are an error.
    let table = read("p.npz", three_points(&[("m.npy", npy("(2,)", &[1.0, 1.0]))]));
    assert!(table.mass().unwrap_err().to_string().contains("array `m`: shape [2]"));
}

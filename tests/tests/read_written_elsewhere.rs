//! Files written by other programs (`fixtures/make.py` and `make_more.py` say how) give the particles that went into them.

use sph_host::io::{PointTable, read};
use std::path::Path;

fn fixture(name: &str) -> PointTable {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name)).unwrap()
}

/// What the five particles hold, to the bit: every value but i/10 is exact as text of any precision.
fn check(name: &str, table: &PointTable) {
    check_with_flag(name, table, "flag u");
}

/// The same, where the flags have this name.
fn check_with_flag(name: &str, table: &PointTable, flag: &str) {
    let want: Vec<f64> = (0..5).map(f64::from).collect();
    let scaled = |factor: f64, shift: f64| want.iter().map(|i| i * factor + shift).collect::<Vec<_>>();
    assert_eq!(table.coordinates, [scaled(1.0, 0.0), scaled(0.5, 0.0), scaled(-0.25, 0.0)], "{name}");
    let values = |quantity: &str| table.quantity(quantity).unwrap().values.into_owned();
    assert_eq!(values("rho"), scaled(1.0, 1000.0), "{name}");
    assert_eq!(values("index"), scaled(1.0, -2.0), "{name}");
    assert_eq!(values(flag), want, "{name}");
    assert_eq!(values("velocity_y"), scaled(-1.0, 0.0), "{name}");
    let velocity = table.quantity("velocity").unwrap();
    assert_eq!(velocity.labels, ["velocity_x", "velocity_y", "velocity_z"]);
    let tenths: Vec<f64> = velocity.values.iter().skip(2).step_by(3).copied().collect();
    assert_eq!(tenths, want.iter().map(|i| i / 10.0).collect::<Vec<_>>(), "{name}");
    assert_eq!(table.density().unwrap().unwrap().values, scaled(1.0, 1000.0));
    assert!(table.mass().unwrap().is_none());
}

#[test]
fn every_coding_of_vtk() {
    let names = [
        "ascii.vtu",
        "base64.vtp",
        "base64_zlib_big.vtp",
        "appended_base64_big.vtu",
        "appended_base64_zlib.vtu",
        "raw.vtp",
        "raw_zlib.vtu",
        "legacy_ascii_42.vtk",
        "legacy_ascii_51.vtk",
        "legacy_binary_42.vtk",
        "legacy_binary_51.vtk",
    ];
    for name in names {
        let table = fixture(name);
        check(name, &table);
        let values = |quantity: &str| table.quantity(quantity).unwrap().values.into_owned();
        assert_eq!(values("bit"), [0.0, 1.0, 0.0, 1.0, 0.0], "{name}");
        assert_eq!(values("gid"), [0.0, 7.0, 14.0, 21.0, 28.0], "{name}");
        let mut quantities = table.default_quantities();
        quantities.sort();
        assert_eq!(quantities, ["bit", "flag u", "gid", "index", "velocity"], "{name}");
        let text = table.quantity("tag").unwrap_err().to_string();
        assert!(text.contains(name) && text.contains("array `tag`"), "{text}");
    }
}

#[test]
fn pieces_follow_each_other() {
    let (twice, once) = (fixture("raw_zlib_pieces.vtu"), fixture("raw_zlib.vtu"));
    assert_eq!(twice.len(), 10);
    for (long, short) in twice.coordinates.iter().zip(&once.coordinates) {
        assert_eq!(*long, short.repeat(2));
    }
    for name in ["velocity", "rho", "bit"] {
        let values = |table: &PointTable| table.quantity(name).unwrap().values.into_owned();
        assert_eq!(values(&twice), values(&once).repeat(2), "{name}");
    }
}

#[test]
fn every_coding_of_numpy() {
    for name in ["stored.npz", "deflated_fortran_big.npz"] {
        check(name, &fixture(name));
    }
    let other = fixture("deflated_fortran_big.npz").default_quantities();
    assert!(!other.contains(&"other".to_owned()), "an array of another length is none of the points");
    let stored = fixture("stored.npz");
    assert_eq!(stored.default_quantities(), ["velocity", "index", "flag u"]);
    for unusable in ["time", "tag"] {
        let text = stored.quantity(unusable).unwrap_err().to_string();
        assert!(text.contains(&format!("array `{unusable}`")), "{text}");
    }
    let text = fixture("deflated_fortran_big.npz").quantity("other").unwrap_err().to_string();
    assert!(
        text.contains("array `other`") && text.contains("shape [3]") && text.contains("5 points"),
        "{text}"
    );
}

#[test]
fn records_and_positions_of_numpy() {
    for name in ["packed.npy", "aligned.npy", "big_pos.npy"] {
        let table = fixture(name);
        check(name, &table);
        let values = |quantity: &str| table.quantity(quantity).unwrap().values.into_owned();
        if name == "big_pos.npy" {
            assert_eq!(values("h"), [0.0, 1.0, 2.0, 3.0, 4.0]);
        } else {
            assert_eq!(values("odd"), [0.0, 1.0, 0.0, 1.0, 0.0], "{name}");
            let text = table.quantity("tag").unwrap_err().to_string();
            assert!(text.contains("array `tag`: values of type <U3 where numbers are expected"), "{text}");
        }
    }
    let table = fixture("positions.npy");
    assert_eq!(table.coordinates, fixture("packed.npy").coordinates[..2]);
    assert!(table.arrays.is_empty());
}

#[test]
fn every_coding_of_plyfile() {
    for name in ["text.ply", "text_lists.ply", "little_lists.ply", "big.ply"] {
        let table = fixture(name);
        check_with_flag(name, &table, "flag_u");
        let values = |quantity: &str| table.quantity(quantity).unwrap().values.into_owned();
        let row = |f: fn(f64) -> f64| (0..5).map(|i| f(f64::from(i))).collect::<Vec<_>>();
        assert_eq!(values("i8"), row(|i| -i), "{name}");
        assert_eq!(values("i16"), row(|i| -300.0 * i), "{name}");
        assert_eq!(values("u16"), row(|i| 65_535.0 - i), "{name}");
        assert_eq!(values("u32"), row(|i| 4_294_967_295.0 - i), "{name}");
        assert_eq!(table.array("near").is_some(), name.contains("lists"), "{name}");
        assert_eq!(table.arrays.len(), if name.contains("lists") { 11 } else { 10 }, "{name}");
    }
}

#[test]
fn both_forms_of_xyz_by_ase() {
    let table = fixture("extended.xyz");
    check_with_flag("extended.xyz", &table, "flag_u");
    assert_eq!(*table.quantity("odd").unwrap().values, [0.0, 1.0, 0.0, 1.0, 0.0]);
    let text = table.quantity("species").unwrap_err().to_string();
    assert!(text.ends_with("line 3, column `species`: `H` where a number is expected"), "{text}");
    assert_eq!(fixture("plain.xyz").coordinates, table.coordinates);
}

#[test]
fn the_geometry_of_partio() {
    let table = fixture("classic.bgeo");
    // Partio stores 32 bits.
    let velocity = table.quantity("velocity").unwrap();
    let tenths: Vec<f64> = velocity.values.iter().skip(2).step_by(3).copied().collect();
    assert_eq!(tenths, [0.0_f32, 0.1, 0.2, 0.3, 0.4].map(f64::from));
    let mut exact = table.clone();
    let array = exact.arrays.iter_mut().find(|array| array.name == "velocity").unwrap();
    for (i, value) in array.values.iter_mut().skip(2).step_by(3).enumerate() {
        *value = i as f64 / 10.0;
    }
    check_with_flag("classic.bgeo", &exact, "flag_u");
    assert_eq!(*table.quantity("id").unwrap().values, [0.0, 1.0, 2.0, 3.0, 4.0]);
    assert!(table.quantity("kind").unwrap_err().to_string().contains("array `kind`"));
}

#[test]
fn every_packer_of_vtk() {
    for name in ["raw_lz4.vtu", "base64_lz4_big.vtp", "raw_lzma.vtp", "appended_base64_lzma.vtu"] {
        check(name, &fixture(name));
    }
}

#[test]
fn pieces_in_files_of_their_own() {
    check("parted.pvtp", &fixture("parted.pvtp"));
    let (twice, once) = (fixture("parted.pvtu"), fixture("parted_0.vtu"));
    check("parted_0.vtu", &once);
    for (long, short) in twice.coordinates.iter().zip(&once.coordinates) {
        assert_eq!(*long, short.repeat(2));
    }
    for name in ["velocity", "rho", "flag u"] {
        let values = |table: &PointTable| table.quantity(name).unwrap().values.into_owned();
        assert_eq!(values(&twice), values(&once).repeat(2), "{name}");
    }
}

//! Particles of HDF5 files: which group is meant, and what the file says of its units.

use crate::support::Folder;

const AT: &str = "--at-particles --support 1";

/// A folder with a sample of `tests/fixtures`.
fn folder(name: &str) -> Folder {
    let samples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fixtures");
    Folder::with(name, std::fs::read(samples.join(name)).unwrap())
}

#[test]
fn a_group_is_chosen_by_its_name() {
    let pysph = folder("pysph.hdf5");
    pysph.fail_with(
        1,
        &format!("sample pysph.hdf5 {AT}"),
        &["pysph.hdf5: several groups hold particles: `fluid`, `solid`", "--group NAME"],
    );
    for (name, particles) in [("fluid", 6), ("solid", 4)] {
        let columns = pysph.columns(&format!("sample pysph.hdf5 {AT} --group {name} --quantity u --dim 2"));
        assert_eq!(columns.names, ["x", "y", "z", "density", "u"]);
        assert_eq!(columns.get("u").len(), particles);
    }
    pysph.fail_with(
        1,
        &format!("sample pysph.hdf5 {AT} --group gas"),
        &["no group `gas`", "`fluid`, `solid`"],
    );
    let gadget = folder("gadget.hdf5");
    assert_eq!(gadget.columns(&format!("sample gadget.hdf5 {AT}")).get("x").len(), 6);
    assert_eq!(gadget.columns(&format!("sample gadget.hdf5 {AT} --group PartType1")).get("x").len(), 4);
}

#[test]
fn a_group_of_what_has_none_is_wrong_usage() {
    let folder = Folder::with("p.csv", "x,m\n0,1\n");
    folder.fail_with(2, &format!("sample p.csv {AT} --group fluid"), &["p.csv", ".h5, .hdf5", "--group"]);
    folder.fail_with(2, &format!("sample demo:vortex {AT} --group fluid"), &["--group", "built-in set"]);
}

#[test]
fn units_are_told_and_not_applied() {
    let swift = folder("swift.hdf5");
    let said = swift.succeed(&format!("sample swift.hdf5 {AT}"));
    let notes: Vec<&str> = said.stderr.lines().filter(|line| line.contains("units")).collect();
    assert_eq!(notes.len(), 1, "{}", said.stderr);
    let start = "note: swift.hdf5: units: Coordinates × 3.08567758e24 cm a^1, ";
    assert!(
        notes[0].starts_with(start) && notes[0].ends_with("(from the file, not applied)"),
        "{}",
        notes[0]
    );
    let columns = swift.columns(&format!("sample swift.hdf5 {AT}"));
    assert_eq!(columns.get("x"), [0.0, 0.25, 0.5, 0.75, 1.0, 1.25]);
    let pysph = folder("pysph.hdf5");
    let said = pysph.succeed(&format!("sample pysph.hdf5 {AT} --group fluid"));
    assert!(!said.stderr.contains("units"), "{}", said.stderr);
}

#[test]
fn a_mass_is_asked_for_where_the_header_has_none() {
    let gadget = folder("gadget.hdf5");
    let mut bytes = gadget.bytes("gadget.hdf5");
    let at = bytes.windows(9).position(|window| window == b"MassTable").unwrap();
    bytes[at] = b'm';
    gadget.write("gadget.hdf5", bytes);
    gadget.fail_with(1, &format!("sample gadget.hdf5 {AT}"), &["gadget.hdf5: there is no mass", "--mass"]);
    gadget.succeed(&format!("sample gadget.hdf5 {AT} --mass 1"));
}

#[test]
fn masses_and_densities_answer_to_the_names_of_the_file() {
    let swift = folder("swift.hdf5");
    let words = format!("sample swift.hdf5 {AT}");
    for (own, special) in [("Masses", "mass"), ("Densities", "density")] {
        let (own, special) =
            [own, special].map(|name| swift.succeed(&format!("{words} --quantity {name}"))).into();
        let without = |said: &crate::support::Said| said.stdout.split_once('\n').unwrap().1.to_owned();
        assert_eq!(without(&own), without(&special));
    }
    assert!(
        swift
            .succeed(&format!("{words} --quantity Masses"))
            .stdout
            .lines()
            .next()
            .unwrap()
            .ends_with(",Masses")
    );
}

#[test]
fn a_mass_of_the_header_that_cannot_be_is_named() {
    let gadget = folder("gadget.hdf5");
    let bytes = gadget.bytes("gadget.hdf5");
    // the masses of the first two kinds, as the sample has them
    let first_two = [0.25_f64.to_le_bytes(), 0.5_f64.to_le_bytes()].concat();
    let at = bytes.windows(16).position(|window| window == first_two).unwrap();
    for wrong in [-1.0, f64::NAN, f64::INFINITY] {
        let mut bytes = bytes.clone();
        bytes[at..at + 8].copy_from_slice(&f64::to_le_bytes(wrong));
        gadget.write("gadget.hdf5", &bytes);
        let parts = ["`MassTable`", "`Header`", &wrong.to_string(), "above 0"];
        gadget.fail_with(1, &format!("sample gadget.hdf5 {AT}"), &parts);
        gadget.succeed(&format!("sample gadget.hdf5 {AT} --mass 1"));
    }
}

//! HDF5 as programs of the field lay it out; the samples are made by `tests/fixtures/make_hdf5.py`.

use sph_host::io::{self, PointTable, ReadError};

use crate::support::{File, unusable, values};

pub(crate) const SAMPLES: [&str; 5] = ["swift.hdf5", "arepo.hdf5", "gadget.hdf5", "plain.h5", "pysph.hdf5"];

/// The particles of a group.
pub(crate) fn read_group(path: &std::path::Path, group: Option<&str>) -> Result<PointTable, ReadError> {
    io::InputFile { group: group.map(str::to_owned), ..path.into() }.read()
}

/// The bytes of a sample.
pub(crate) fn sample(name: &str) -> Vec<u8> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/fixtures");
    std::fs::read(folder.join(name)).unwrap()
}

fn group(name: &str, group: Option<&str>) -> Result<PointTable, ReadError> {
    read_group(&File::new(name, sample(name)).1, group)
}

/// The message for a group that is not read, behind the file's name.
fn refused(name: &str, wanted: Option<&str>) -> String {
    let message = group(name, wanted).unwrap_err().to_string();
    message.split_once(&format!("{name}: ")).unwrap().1.to_owned()
}

/// `value` of every particle from 0.
fn each(count: usize, value: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..count).map(|i| value(i as f64)).collect()
}

/// The positions of the samples of Gadget's kind, each coordinate `more`.
fn positions(count: usize, more: f64) -> Vec<Vec<f64>> {
    let axes: [fn(f64) -> f64; 3] = [|i| i / 4.0, |i| i % 3.0, |i| i * 0.5 - 1.0];
    axes.iter().map(|axis| each(count, |i| axis(i) + more)).collect()
}

#[test]
fn pysph_has_its_sets_by_name() {
    for wanted in ["fluid", "particles/fluid/arrays", "/particles/fluid", "/particles/fluid/arrays/"] {
        let table = group("pysph.hdf5", Some(wanted)).unwrap();
        let axes = [each(6, |i| i * 0.25), each(6, |i| i * 0.5), vec![0.0; 6]];
        assert_eq!(table.coordinates, axes, "{wanted}");
        assert_eq!(*table.mass().unwrap().unwrap().values, [0.125; 6]);
        assert_eq!(*table.density().unwrap().unwrap().values, each(6, |i| 1000.0 + i));
        assert_eq!(values(&table, "u"), each(6, |i| -i));
        assert_eq!(values(&table, "A_y"), each(6, |i| 3.0 * i + 1.0));
        assert!(table.array("au").is_none() && table.notes.is_empty());
    }
    let solid = group("pysph.hdf5", Some("solid")).unwrap();
    assert_eq!((solid.len(), solid.mass().unwrap().unwrap().values[3]), (4, 1.125));
}

#[test]
fn gadget_has_its_mass_in_the_header() {
    let gas = group("gadget.hdf5", None).unwrap();
    assert_eq!(gas.coordinates, positions(6, 0.0));
    assert_eq!(values(&gas, "mass"), [0.25; 6]);
    assert_eq!(values(&gas, "density"), each(6, |i| 1.0 + i));
    assert_eq!(values(&gas, "Velocities_x"), each(6, |i| i / 2.0));
    assert_eq!(values(&gas, "ParticleIDs"), each(6, |i| i + 1_099_511_627_776.0));
    assert_eq!(values(&gas, "InternalEnergy"), each(6, |i| 10.0 * i));
    let note =
        "units: length 3.085678e21 cm, mass 1.989e43 g, velocity 100000 cm/s (from the file, not applied)";
    assert_eq!(gas.notes, [note]);
    let halo = group("gadget.hdf5", Some("PartType1")).unwrap();
    assert_eq!(halo.coordinates, positions(4, 1.0));
    assert_eq!(values(&halo, "mass"), [0.5; 4]);
    assert!(halo.density().unwrap().is_none());
}

#[test]
fn swift_packs_its_arrays_and_says_their_units() {
    let table = group("swift.hdf5", None).unwrap();
    assert_eq!(table.coordinates, positions(6, 0.0));
    assert_eq!(values(&table, "mass"), [0.5; 6]);
    assert_eq!(values(&table, "density"), each(6, |i| 1.0 + i));
    assert_eq!(values(&table, "SmoothingLengths"), [0.75; 6]);
    let note = "units: Coordinates × 3.08567758e24 cm a^1, Densities × 6.767905e-31 g/cm³ a^-3, \
        SmoothingLengths × 3.08567758e24 cm a^1, Masses × 1.98848e43 g (from the file, not applied)";
    assert_eq!(table.notes, [note]);
}

#[test]
fn the_only_set_needs_no_name() {
    let stars = group("arepo.hdf5", None).unwrap();
    assert_eq!(stars.coordinates, positions(6, 0.0));
    assert_eq!(values(&stars, "mass"), [2.0; 6]);
    assert_eq!(stars.notes, ["units: Coordinates × 3.085678e21 cm (from the file, not applied)"]);
}

#[test]
fn what_stands_beside_the_particles_does_no_harm() {
    for wanted in [None, Some("/")] {
        let table = group("plain.h5", wanted).unwrap();
        assert_eq!(table.coordinates, [each(6, |i| i * 0.5), each(6, |i| i * 0.25)]);
        assert_eq!(*table.mass().unwrap().unwrap().values, [0.125; 6]);
        assert_eq!(values(&table, "T"), each(6, |i| i + 0.5));
        assert_eq!(values(&table, "wet"), each(6, |i| 1.0 - i % 2.0));
        assert_eq!(values(&table, "B_y"), each(6, |i| i + 1.0));
        assert_eq!(table.default_quantities(), ["B", "T", "wet"]);
        for (name, problem) in [
            ("time", "a single number, where one for each of 6 points is expected"),
            ("box", "shape [2], where [6] or [6, n] for 6 points is expected"),
            ("code", "values of type `string` where numbers are expected"),
            ("label", "values of type `vlen_string` where numbers are expected"),
            ("unwritten", "its numbers were never written"),
        ] {
            assert_eq!(unusable(&table, name), format!("array `{name}`: {problem}"));
        }
        assert!(unusable(&table, "pair").contains("of type `compound"));
    }
}

#[test]
fn a_set_that_is_not_there_is_an_error_that_names_those_there() {
    assert_eq!(
        refused("pysph.hdf5", Some("gas")),
        "there is no group `gas`; of the groups with particles there are `fluid`, `solid`"
    );
    assert_eq!(
        refused("swift.hdf5", Some("Header")),
        "the group `Header` does not hold particles: a dataset `Coordinates`, `pos` or `x` is expected; of the groups with \
         particles there are `PartType0`"
    );
    assert_eq!(refused("pysph.hdf5", None), "several groups hold particles: `fluid`, `solid`");
    assert!(matches!(group("pysph.hdf5", None), Err(ReadError::SeveralSets { .. })));
    let table = File::new("p.csv", "x,y\n0,0\n");
    let error = read_group(&table.1, Some("fluid")).unwrap_err();
    assert!(matches!(error, ReadError::NoGroups { .. }), "{error}");
}

/// `bytes` with every `from` made `to`, which is as long.
pub(crate) fn replaced(bytes: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let mut bytes = bytes.to_vec();
    for at in 0..bytes.len() - from.len() {
        if bytes[at..].starts_with(from.as_bytes()) {
            bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
        }
    }
    bytes
}

#[test]
fn coordinates_of_another_shape_or_none_are_an_error() {
    let gadget = replaced(&sample("gadget.hdf5"), "Coordinates", "Koordinates");
    let read = |bytes: &[u8]| File::new("a.hdf5", bytes).read().unwrap_err().to_string();
    let message = read(&gadget);
    let expected = "no group holds particles: a dataset `Coordinates`, `pos` or `x` is expected";
    assert!(message.ends_with(expected), "{message}");
    let message = read(&replaced(&gadget, "Density\0", "coords\0\0"));
    assert!(message.ends_with("`coords` has the shape [6] where [points, 1 to 3] is expected"), "{message}");
    let message = read(&replaced(&sample("plain.h5"), "X\0\0\0", "Z\0\0\0"));
    assert!(
        message.ends_with("no group holds particles: a dataset `Coordinates`, `pos` or `x` is expected"),
        "{message}"
    );
    let message = read(&replaced(&sample("plain.h5"), "Y\0\0\0", "Z\0\0\0"));
    assert!(message.ends_with("group `/`: there is a `z` but no `y`"), "{message}");
}

#[test]
fn positions_beside_x_are_an_error_if_they_could_be_meant() {
    let plain = sample("plain.h5");
    let table = File::new("p.h5", replaced(&plain, "time\0", "pos\0\0")).read().unwrap();
    assert!(unusable(&table, "pos").contains("a single number"));
    let both = File::new("p.h5", replaced(&plain, "B\0\0\0\0", "pos\0\0"));
    let message = both.read().unwrap_err().to_string();
    assert!(
        message.ends_with("coordinates are in `X`, `Y` and in `pos`: one of them is expected"),
        "{message}"
    );
}

#[test]
fn coordinates_are_found_by_the_names_of_programs_and_by_the_users() {
    let gadget = sample("gadget.hdf5");
    let read = |bytes: &[u8], position: &[&str]| {
        let file = File::new("g.hdf5", bytes);
        let position = position.iter().map(|&name| name.to_owned()).collect();
        io::InputFile { position, ..file.1.as_path().into() }.read().map(|table| table.coordinates)
    };
    let expected = read(&gadget, &[]).unwrap();
    assert_eq!(read(&gadget, &["Coordinates"]).unwrap(), expected);
    assert_eq!(read(&replaced(&gadget, "Coordinates", "Koordinates"), &["Koordinates"]).unwrap(), expected);
    let plain = sample("plain.h5");
    assert_eq!(read(&plain, &["Y", "X"]).unwrap()[0], read(&plain, &[]).unwrap()[1]);
}

#[test]
fn without_a_mass_there_is_none() {
    let bytes = replaced(&sample("gadget.hdf5"), "MassTable", "massTable");
    let table = File::new("g.hdf5", bytes).read().unwrap();
    assert!(table.mass().unwrap().is_none());
}

#[test]
fn other_files_are_not_taken_for_hdf5() {
    let message = File::new("p.h5", "x,y\n0,0\n").read().unwrap_err().to_string();
    let expected = "not an HDF5 file, damaged or cut short: HDF5 signature not found";
    assert!(message.contains(expected), "{message}");
    let message = File::new("p.hdf5", b"PK\x03\x04").read().unwrap_err().to_string();
    assert!(message.contains("ZIP"), "{message}");
    assert!(File::new("p.h5", "").read().unwrap_err().to_string().ends_with("the file is empty"));
}

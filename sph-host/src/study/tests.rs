//! What a study says must be so: for the compiled type, for any number of threads, and for sets that are not as they should be.

use std::io::Write;

use sph_core::scalar::fixed::{Saturating, types::I6F10};
use sph_lab::{Format, MiniFormat};

use super::measure::measure;
use super::set::Set;
use super::sweep::{Prepared, deviations, scales, shortfall};
use super::units::Units;
use super::*;
use crate::sample::{ParticleSource, SampleError};

fn vortex(kernel: KernelName, goals: &[(Quantity, f64)]) -> Request {
    Request {
        kernels: vec![kernel],
        goals: goals.to_vec(),
        ..Request::new(ParticleSource::Demo("vortex".into(), Some(400)))
    }
}

/// A file of particles, which lives as long as its directory.
fn file(directory: &tempfile::TempDir, rows: impl Iterator<Item = String>) -> ParticleSource {
    let path = directory.path().join("particles.csv");
    let mut file = std::fs::File::create(&path).unwrap();
    rows.for_each(|row| writeln!(file, "{row}").unwrap());
    ParticleSource::File(path.into())
}

#[test]
fn the_compiled_type_has_the_same_errors_and_one_bit_less_misses_the_goal() {
    let request = vortex(KernelName::Poly6, &[(Quantity::Density, 1e-2), (Quantity::Gradient, 2e-2)]);
    let study = run(&request, &()).unwrap();
    let found = study.recommendation.unwrap();
    assert_eq!(found.format, Format::new(6, 10).unwrap(), "the type that this test is compiled for");
    assert!(shortfall(&found.errors, &request.goals) <= 1.0);

    let mut read = ParticleSet::read(&request.sample(KernelName::Poly6)).unwrap();
    read.fields.truncate(1);
    let set = Set::<2>::new(read).unwrap();
    let all: Vec<usize> = (0..400).collect();
    let patch = set.around(&all).unwrap();
    let units = Units::with_support(&set, set.reach() / found.length);
    assert_eq!((units.length, units.mass), (found.length, found.mass));
    let truth = measure::<f64, 2>(&patch, KernelName::Poly6, &units).unwrap();
    let compiled = measure::<Saturating<I6F10>, 2>(&patch, KernelName::Poly6, &units).unwrap();
    assert_eq!(deviations(&compiled, &truth, &scales(&truth)), found.errors, "digit for digit");

    let less = Format::new(found.fewest.integer_bits(), found.fewest.fraction_bits() - 1).unwrap();
    let prepared = Prepared::new(&patch, KernelName::Poly6, units).unwrap();
    let errors = prepared.errors(&patch, NumberFormat::Fixed(less)).unwrap();
    assert!(shortfall(&errors, &request.goals) > 1.0, "{errors:?}");
}

#[test]
fn threads_change_nothing_and_every_format_has_a_row() {
    let request = Request {
        roundings: vec![sph_lab::Rounding::Nearest, sph_lab::Rounding::Stochastic { seed: 0 }],
        overflows: vec![sph_lab::Overflow::Saturating, sph_lab::Overflow::Wrapping],
        also: vec![MiniFormat::F16, MiniFormat::POSIT16],
        bits: 14..=18,
        threads: Some(1),
        ..vortex(KernelName::WendlandC2, &[(Quantity::Density, 1e-2)])
    };
    let one = run(&request, &()).unwrap();
    let three = run(&Request { threads: Some(3), ..request.clone() }, &()).unwrap();
    assert_eq!(one, three);
    assert_eq!(one.rows.len(), 5 * 4 + 2);
    let error = |format: NumberFormat| {
        one.rows.iter().find(|row| row.format == format).unwrap().errors.as_ref().unwrap()[0].largest
    };
    let (half, posit) = (NumberFormat::Mini(MiniFormat::F16), NumberFormat::Mini(MiniFormat::POSIT16));
    assert!(error(posit) < error(half), "a posit has two bits more near 1");
}

/// A set so small that every particle is watched.
#[test]
fn bounds_are_no_less_than_the_errors_at_the_same_particles() {
    let request = Request {
        particles: ParticleSource::Demo("vortex".into(), Some(25)),
        bound: true,
        ..vortex(
            KernelName::WendlandC2,
            &Quantity::ALL.iter().map(|&quantity| (quantity, 1e-2)).collect::<Vec<_>>(),
        )
    };
    let study = run(&request, &()).unwrap();
    let (bounds, found) = (study.insight.unwrap().bounds.unwrap(), study.recommendation.unwrap());
    for (bound, error) in bounds.into_iter().zip(found.errors) {
        assert!(bound >= error.largest && bound <= 100.0 * error.largest, "{bound} {error:?}");
    }
}

/// Compiled types round to nearest, whatever else is compared.
#[test]
fn a_recommendation_rounds_to_nearest() {
    let request = Request {
        roundings: vec![sph_lab::Rounding::Floor],
        bits: 12..=16,
        ..vortex(KernelName::Poly6, &[(Quantity::Density, 1e-2)])
    };
    let study = run(&request, &()).unwrap();
    assert_eq!(study.recommendation.unwrap().format.rounding(), sph_lab::Rounding::Nearest);
    assert_eq!(study.rows.len(), 2 * 5, "with those that were asked for");
}

/// The last particles are in a field that hardly changes: their errors are relative to the slope of all.
#[test]
fn a_flat_part_of_the_field_does_not_raise_the_bits() {
    let directory = tempfile::tempdir().unwrap();
    let rows = |flat: bool| {
        (0..1600).map(move |n| {
            let (i, j) = (n / 40, n % 40);
            let [x, y] = [i, j].map(|n| 0.4 * f64::from(n));
            let value = if i < 20 || !flat { (0.5 * x).sin() } else { 1e-6 * (0.5 * x).sin() };
            format!("{x},{y},0.16,{value}")
        })
    };
    let bits = |flat: bool| {
        let source = file(&directory, std::iter::once("x,y,m,a".into()).chain(rows(flat)));
        let request = Request {
            support: Some(crate::sample::SupportFrom::Radius(1.0)),
            kernels: vec![KernelName::WendlandC2],
            goals: vec![(Quantity::Interpolation, 1e-3)],
            ..Request::new(source)
        };
        run(&request, &()).unwrap().recommendation.unwrap().fewest.fraction_bits()
    };
    assert!(bits(true) <= bits(false) + 1);
}

#[test]
fn files_hold_what_the_study_found() {
    let request = vortex(KernelName::Poly6, &[(Quantity::Density, 1e-2), (Quantity::Interpolation, 1e-2)]);
    let study = run(&request, &()).unwrap();
    let mut csv = Vec::new();
    study.write_csv(&mut csv).unwrap();
    let mut reader = csv::Reader::from_reader(&csv[..]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2 * study.rows.len());
    assert_eq!((&rows[0][0], &rows[0][2], &rows[1][2]), ("poly6", "density", "interpolation"));
    let json = study.json();
    let found = &json["recommended"];
    for key in [
        "kernel",
        "scalar",
        "integer_bits",
        "fraction_bits",
        "overflow",
        "unit_of_length",
        "unit_of_mass",
        "saturations",
        "bytes_per_particle",
    ] {
        assert!(!found[key].is_null(), "{key}");
    }
    assert!(found["errors"]["density"].as_f64().unwrap() <= 1e-2 && found["errors"]["gradient"].is_null());
    assert_eq!(json["rows"].as_array().unwrap().len(), study.rows.len());
    let pictures = study.pictures().unwrap();
    assert!(pictures.iter().any(|(name, _)| *name == "bits.png") && pictures.len() >= 4);
    let report = study.to_string();
    for word in ["recommended", "Saturating<I", "bottleneck", "paste", "not counted"] {
        assert_eq!(report.contains(word), word != "not counted", "{word}: {report}");
    }
}

/// A dam's water in SI units: 44 support radii wide, 1000 kg/m³.
fn dam(directory: &tempfile::TempDir) -> Request {
    let rows = (0..120).flat_map(|i| (0..30).map(move |j| (i, j))).map(|(i, j)| {
        let shift = 0.2 * f64::from((i * 7 + j * 3) % 11) / 11.0;
        let [x, y] = [i, j].map(|n| 0.005 * (f64::from(n) + shift));
        format!("{x},{y},0.025,{}", 9810.0 * (0.15 - y))
    });
    let particles = file(directory, std::iter::once("x,y,m,pressure".into()).chain(rows));
    Request {
        support: Some(crate::sample::SupportFrom::Radius(0.0134)),
        kernels: vec![KernelName::WendlandC2],
        ..Request::new(particles)
    }
}

#[test]
fn units_are_worth_more_than_bits() {
    let directory = tempfile::tempdir().unwrap();
    let study = run(&dam(&directory), &()).unwrap();
    let gain = study.insight.as_ref().unwrap().gain(&study.goals).unwrap();
    assert!(gain >= 50.0, "{gain}");
    let own = Request { units: UnitChoice::File, ..dam(&directory) };
    let own = run(&own, &()).map(|study| study.recommendation.map(|found| found.fewest.bits()));
    let scaled = study.recommendation.unwrap().fewest.bits();
    assert!(own.is_err() || own.unwrap().is_none_or(|bits| bits > scaled + 4));
}

#[test]
fn a_goal_that_is_not_met_leaves_the_best_and_what_limits_it() {
    let request = Request { bits: 8..=16, ..vortex(KernelName::WendlandC2, &[(Quantity::Density, 1e-9)]) };
    let study = run(&request, &()).unwrap();
    assert!(study.recommendation.is_none());
    assert_eq!(study.best().unwrap().format.bits(), 16);
    assert!(!study.insight.as_ref().unwrap().blamed.is_empty());
    assert!(study.to_string().contains("best"));
}

/// Rows of a file, a change of the request, and words of the message.
type Refused<'a> = (&'a [&'a str], &'a dyn Fn(&mut Request), &'a str);

#[test]
fn sets_that_are_not_as_they_should_be_are_refused() {
    let directory = tempfile::tempdir().unwrap();
    let study = |rows: &[&str], change: &dyn Fn(&mut Request)| {
        let source = file(&directory, rows.iter().map(|row| (*row).to_owned()));
        let mut request = Request { kernels: vec![KernelName::Poly6], ..Request::new(source) };
        request.support = Some(crate::sample::SupportFrom::Radius(1.0));
        change(&mut request);
        run(&request, &()).unwrap_err().to_string()
    };
    let fine = ["x,y,m,a", "0,0,1,1", "0.5,0,1,2", "0,0.5,1,3"];
    let cases: [Refused<'_>; 7] = [
        (&["x,y,m", "0,0,1"], &|_| (), "the gradient is zero at every particle (there is one particle)"),
        (&["x,y,m,a", "0,0,1,0", "0.5,0,1,0"], &|_| (), "the interpolation is zero"),
        (&["x,y,m,a", "0,0,1,1", "9,9,1,2"], &|_| (), "the gradient is zero"),
        (&["x,y,m,a", "0,0,1,NaN", "0.5,0,1,2"], &|_| (), "NaN"),
        (&["x,y,a", "0,0,1", "0.5,0,2"], &|_| (), "there is no mass"),
        (&fine, &|request| request.kernels = vec![KernelName::Viscosity], "diverges at r = 0"),
        (&["x,y,m,a", "0,0,1,1", "0.5,1e12,1,2", "0.1,0,1,3"], &|_| (), "40 of them for the coordinates"),
    ];
    for (rows, change, words) in cases {
        let message = study(rows, change);
        assert!(message.contains(words), "{message}: {words}");
    }
    let missing = Request::new(ParticleSource::File(std::path::PathBuf::from("no/such/file.csv").into()));
    assert!(matches!(run(&missing, &()), Err(StudyError::Particles(SampleError::Read(_)))));
}

#[test]
fn a_fluid_is_judged_by_its_scatter() {
    use super::fluid::{FluidRequest, Usage, run};
    let request = FluidRequest {
        frames: 60,
        starts: 2,
        fractions: vec![14, 8],
        roundings: vec![sph_lab::Rounding::Floor],
        ..FluidRequest::new(crate::run::CaseName::Tilt)
    };
    let study = run(&request, &()).unwrap();
    let coarse =
        study.rows.iter().find(|row| row.format.is_some_and(|format| format.fraction_bits() == 8)).unwrap();
    assert!(!coarse.is_accepted() && study.rows[0].is_accepted(), "{study}");
    assert_eq!(study.rows.iter().filter(|row| row.usage == Usage::Compiled).count(), 2);
    assert!(study.json()["rows"].as_array().unwrap().len() == 5);
    let one = FluidRequest { fractions: vec![14], threads: Some(1), ..request.clone() };
    assert_eq!(study.rows[..2], run(&one, &()).unwrap().rows[..2]);
    let chaotic = FluidRequest { most_scatter: 1e-9, fractions: vec![14], ..request.clone() };
    assert!(matches!(run(&chaotic, &()), Err(StudyError::Chaotic { .. })));
    let none = FluidRequest { case: crate::run::CaseName::TaylorGreen, ..request };
    assert!(matches!(run(&none, &()), Err(StudyError::NoFluid { .. })));
}

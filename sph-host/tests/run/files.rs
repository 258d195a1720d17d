//! What a run leaves in its directory.

use std::collections::BTreeSet;
use std::fs::File;

use serde_json::Value;
use sph_host::io;
use sph_host::run::CaseName;

use crate::support::{Columns, Folder};

const SERIES: &str =
    "time,kinetic_energy,potential_energy,max_speed,mean_density_error,max_density_error,min_spacing,";

fn summary(folder: &Folder, place: &str) -> Value {
    serde_json::from_slice(&folder.bytes(&format!("{place}/summary.json"))).unwrap()
}

#[test]
fn every_case_leaves_all_its_files_with_every_solver() {
    let folder = Folder::new();
    for &case in CaseName::ALL {
        for &solver in case.solvers() {
            let place = format!("{case}-{solver}");
            let time = case.duration() / 50.0;
            let words =
                format!("run {case} --solver {solver} --resolution 8 --time {time} --every {}", time / 2.0);
            let said = folder.succeed(&format!("{words} --out {place}"));
            assert_eq!(said.stderr, "", "{place}");
            assert_files(&folder, &place, case.plot());
            let header = String::from_utf8(folder.bytes(&format!("{place}/series.csv"))).unwrap();
            let header = header.lines().next().unwrap().to_owned();
            assert!(
                header.starts_with(&format!("{SERIES}{},", case.columns().join(","))),
                "{place}: {header}"
            );
            let summary = summary(&folder, &place);
            assert_eq!((&summary["case"], &summary["solver"]), (&case.name().into(), &solver.name().into()));
            let found = summary["particles"].as_u64().unwrap() as usize;
            assert!(found > 20, "{place}: {found}");
            for k in 0..3 {
                let frame = io::read(&folder.path(&format!("{place}/frame_{k:04}.vtu"))).unwrap();
                assert_eq!(frame.len(), found, "{place}");
                assert!(
                    frame.quantity("velocity").is_ok() || frame.quantity("velocity_x").is_ok(),
                    "{place}"
                );
                assert_pictures_agree(&folder, &place, k);
            }
            for file in ["frame_0002.png", "animation.gif", case.plot(), "frames.pvd"] {
                assert!(said.stdout.contains(&format!("{place}/{file}")), "{place}: {}", said.stdout);
            }
        }
    }
}

fn assert_files(folder: &Folder, place: &str, plot: &str) {
    let always =
        ["run.json", "summary.json", "series.csv", "frames.pvd", "animation.gif", "checkpoint.json", ".lock"];
    let mut expected: BTreeSet<String> = always.iter().chain([&plot]).map(|&name| name.to_owned()).collect();
    expected.extend((0..3).flat_map(|k| ["vtu", "png"].map(|ending| format!("frame_{k:04}.{ending}"))));
    assert_eq!(folder.names_in(place), expected, "{place}");
}

/// The picture of a frame is a PNG of the size of the first.
fn assert_pictures_agree(folder: &Folder, case: &str, k: usize) {
    let size = |k: usize| {
        let file = File::open(folder.path(&format!("{case}/frame_{k:04}.png"))).unwrap();
        let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
        (reader.info().width, reader.info().height)
    };
    assert_eq!(size(k), size(0), "{case}");
    assert!(size(k).0 >= 300);
}

#[test]
fn the_summary_says_what_was_done_and_agrees_with_the_series() {
    let folder = Folder::new();
    folder.succeed("run --resolution 8 --time 0.05 --every 0.02 --out dam --kernel cubic-spline");
    let summary = summary(&folder, "dam");
    for (name, value) in
        [("case", "dam-break"), ("solver", "incompressible"), ("scalar", "f32"), ("kernel", "cubic-spline")]
    {
        assert_eq!(summary[name], value);
    }
    let number = |name: &str| summary[name].as_f64().unwrap_or_else(|| panic!("{name}: {}", summary[name]));
    for name in ["wall_s", "momentum_drift", "energy_drift", "us_per_particle_step"] {
        assert!(number(name).is_finite(), "{name}");
    }
    assert_eq!(number("mass_drift"), 0.0);
    assert_eq!(number("column_width"), 0.146);
    assert_eq!(number("gravity"), 9.81);
    assert!((number("simulated_s") - 0.05).abs() < 1e-12, "the end is a frame too");
    let rate = number("particles") * number("steps") / number("wall_s");
    assert!((number("particle_steps_per_s") / rate - 1.0).abs() < 1e-9);
    for check in summary["checks"].as_array().unwrap() {
        let (value, goal) = (check["value"].as_f64(), check["goal"].as_f64().unwrap());
        assert!(check["name"].is_string());
        let holds = value.map_or(Value::Null, |value| (value.abs() <= goal).into());
        assert_eq!(check["holds"], holds, "{check}");
    }

    let series = Columns::parse(&String::from_utf8(folder.bytes("dam/series.csv")).unwrap());
    let time = series.get("time");
    assert!(time.is_sorted() && time[0] == 0.0 && *time.last().unwrap() == number("simulated_s"), "{time:?}");
    // water falls: 2 a high, its centre at a
    let weight = 1000.0 * 0.146 * 0.146 * 2.0 * 9.81;
    let potential = series.get("potential_energy");
    assert!((potential[0] / (weight * 0.146) - 1.0).abs() < 1e-6, "{}", potential[0]);
    assert!(potential.is_sorted_by(|a, b| a > b));
    assert!(series.get("kinetic_energy").is_sorted());
    assert!(series.get("front_x").iter().all(|&x| (0.1459..0.584).contains(&x)));
    assert!((series.get("min_spacing")[0] - 1.0).abs() < 1e-6);

    let pvd = String::from_utf8(folder.bytes("dam/frames.pvd")).unwrap();
    assert!(pvd.contains(r#"timestep="0.05" file="frame_0003.vtu""#), "{pvd}");
    assert_eq!(pvd.matches("<DataSet").count(), 4);
}

#[test]
fn frames_hold_what_the_series_measures() {
    let folder = Folder::new();
    folder.succeed("run hydrostatic --resolution 8 --time 0.04 --every 0.02 --out tank");
    let series = Columns::parse(&String::from_utf8(folder.bytes("tank/series.csv")).unwrap());
    for (frame, row) in [(0, 0), (1, 4), (2, 8)] {
        let table = io::read(&folder.path(&format!("tank/frame_{frame:04}.vtu"))).unwrap();
        let along = |name: &str| table.quantity(name).unwrap().values.to_vec();
        let squares: f64 = along("velocity_x").iter().chain(&along("velocity_y")).map(|v| v * v).sum();
        let kinetic = 0.5 * 1000.0 / 64.0 * squares;
        assert!((kinetic - series.get("kinetic_energy")[row]).abs() <= 1e-12 * kinetic, "frame {frame}");
        assert!(along("density").iter().all(|density| (990.0..1030.0).contains(density)));
    }
}

#[test]
fn the_animation_has_every_frame() {
    let folder = Folder::new();
    folder.succeed("run drop --resolution 8 --time 0.0003 --every 0.0001 --out drop");
    let gif = folder.bytes("drop/animation.gif");
    assert!(gif.starts_with(b"GIF89a") && gif.ends_with(&[0x3b]));
    // a graphic control extension a frame
    assert_eq!(gif.windows(3).filter(|window| *window == [0x21, 0xf9, 0x04]).count(), 4);
}

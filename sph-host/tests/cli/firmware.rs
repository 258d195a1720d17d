//! `--exact` has the bits of firmware: a program that links sph-core alone and is given the same numbers in the units that the
//! command prints.

use std::fmt::Write;

use sph_core::kernel::CubicSpline;
use sph_core::scalar::fixed::{I16F16, Saturating};
use sph_core::{CellGrid, CellLayout, Field, KernelInfluence, Scalar, Sources, field};

use crate::support::{Columns, Folder, Random};

/// What the command prints of its units.
struct Units {
    origin: Vec<f64>,
    length: f64,
    mass: f64,
    density: f64,
    temperature: f64,
    cells: Vec<u32>,
}

impl Units {
    fn parse(stderr: &str) -> Self {
        let line = stderr.lines().find_map(|line| line.strip_prefix("units: ")).expect("a line of units");
        // the standard library reads numbers to the last bit, serde_json not unless told
        let numbers = |name: &str| -> Vec<f64> {
            let (_, after) = line.split_once(&format!("\"{name}\":")).unwrap();
            let list = after.trim_start_matches('[');
            let end = if list.len() < after.len() { list.find(']') } else { list.find([',', '}']) };
            list[..end.unwrap()].split(',').map(|number| number.parse().unwrap()).collect()
        };
        let number = |name: &str| numbers(name)[0];
        Self {
            origin: numbers("origin"),
            length: number("length"),
            mass: number("mass"),
            density: number("density"),
            temperature: number("temperature"),
            cells: numbers("cells").iter().map(|&count| count as u32).collect(),
        }
    }
}

/// Rows of x, y, mass and temperature, far from the origin.
fn file() -> String {
    let mut random = Random(3);
    let mut text = String::from("x,y,m,temperature\n");
    for i in 0..144 {
        let (x, y) = (f64::from(i % 12) + 0.4 * random.next(), f64::from(i / 12) + 0.4 * random.next());
        let (m, t) = (0.9 + 0.2 * random.next(), 280.0 + 3.0 * x - y);
        writeln!(text, "{},{},{},{t}", 5000.3 + 0.02 * x, 0.02 * y - 700.1, 0.4 * m).unwrap();
    }
    text
}

/// Everything that firmware does, with what a flash image would hold: positions, masses and temperatures in units.
fn firmware<T: Scalar>(rows: &[Vec<f64>], units: &Units, support: f64) -> Vec<[T; 4]> {
    let convert = |value: f64, unit: f64| T::from_f64(value / unit);
    let position = |row: &Vec<f64>| [0, 1].map(|axis| convert(row[axis] - units.origin[axis], units.length));
    let positions: Vec<[T; 2]> = rows.iter().map(position).collect();
    let masses: Vec<T> = rows.iter().map(|row| convert(row[2], units.mass)).collect();
    let temperatures: Vec<T> = rows.iter().map(|row| convert(row[3], units.temperature)).collect();

    let (mut lower, mut upper) = (positions[0], positions[0]);
    for x in &positions {
        for axis in 0..2 {
            lower[axis] = lower[axis].min(x[axis]);
            upper[axis] = upper[axis].max(x[axis]);
        }
    }
    let layout = CellLayout::bounded(&lower, &upper, [units.cells[0], units.cells[1]]).unwrap();
    let (mut starts, mut entries) = ([0_u16; 1025], [0_u16; 256]);
    let search = CellGrid::build(layout, &positions, &mut starts, &mut entries).unwrap();

    let w = &KernelInfluence::<T, 2, CubicSpline>::new(convert(support, units.length)).unwrap();
    let sources = Sources::new(search, &masses[..]).unwrap();
    let densities: Vec<T> = positions.iter().map(|x| sources.density_at(w, x)).collect();
    let mut volumes = vec![T::ZERO; densities.len()];
    field::volumes(&masses[..], &densities, &mut volumes).unwrap();
    let volumes = Sources::new(search, &volumes[..]).unwrap();
    let temperature = Field::new(&volumes, &temperatures[..]).unwrap();
    let at = |x: &[T; 2]| {
        let (value, [slope_x, slope_y]) = temperature.shepard_gradient_at(w, x).unwrap();
        let density = sources.density_gradient_at(w, x).0;
        [density, value, slope_x, slope_y]
    };
    positions.iter().map(at).collect()
}

fn check<T: Scalar>(scalar: &str) {
    let folder = Folder::with("p.csv", file());
    let words =
        format!("sample p.csv --support 0.05 --estimate shepard --gradient --exact --scalar {scalar}");
    let said = folder.succeed(&format!("{words} --at-particles"));
    assert!(!said.stdout.contains("units"), "the result itself has columns alone");
    let (units, found) = (Units::parse(&said.stderr), Columns::parse(&said.stdout));
    assert!(units.cells.iter().all(|&count| count > 2), "{:?}", units.cells);
    let input = Columns::parse(&file());
    let rows: Vec<Vec<f64>> =
        (0..144).map(|row| input.values.iter().map(|column| column[row]).collect()).collect();
    let slope = units.temperature / units.length;
    for (row, numbers) in firmware::<T>(&rows, &units, 0.05).into_iter().enumerate() {
        let names = ["density", "temperature", "temperature_dx", "temperature_dy"];
        for ((name, number), unit) in
            names.into_iter().zip(numbers).zip([units.density, units.temperature, slope, slope])
        {
            let (found, expected) = (found.get(name)[row], number.to_f64() * unit);
            // f32 is printed as the shortest number that reads back as that f32
            let bits =
                |value: f64| if scalar == "f32" { (value as f32).to_bits().into() } else { value.to_bits() };
            assert_eq!(bits(found), bits(expected), "{scalar} {name}[{row}]: {found}, not {expected}");
        }
    }
}

#[test]
fn exact_sums_are_those_of_sph_core_in_the_printed_units() {
    check::<f32>("f32");
    check::<Saturating<I16F16>>("i16f16");
    check::<f64>("f64");
}

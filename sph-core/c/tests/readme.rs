//! The numbers of the README are those of the library.

use fluisim_c::{Q16, code};
use sph_core::fluid::Particle;

const README: &str = include_str!("../README.md");

/// The words between the bars of each row of a table, found by its heading.
fn table(heading: &str) -> Vec<Vec<&'static str>> {
    let (_, rest) = README.split_once(heading).unwrap_or_else(|| panic!("the README has no {heading:?}"));
    let rows = rest.lines().skip(2).take_while(|line| line.starts_with('|'));
    rows.map(|row| row.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

#[test]
fn ram_is_what_the_constant_expression_gives_on_32_bits() {
    const HEAD: usize = 16 + 6 * 4;
    let rows = table("| particles | container | q16, bytes | f32, bytes |");
    assert_eq!(rows.len(), 4);
    for row in rows {
        let lengths: Vec<f64> = row[1].split(" × ").map(|length| length.parse().unwrap()).collect();
        let cells: usize = lengths.iter().map(|&length| length as usize + 1).product();
        let (q16, f32) = match lengths.len() {
            2 => (size_of::<Particle<Q16, 2>>(), size_of::<Particle<f32, 2>>()),
            _ => (size_of::<Particle<Q16, 3>>(), size_of::<Particle<f32, 3>>()),
        };
        let particles: usize = row[0].parse().unwrap();
        for (said, particle) in [(row[2], q16), (row[3], f32)] {
            assert_eq!(said, (HEAD + particles * particle + 2 * cells).to_string(), "{row:?}");
        }
    }
}

#[test]
fn every_error_is_in_the_table() {
    let said = table("| code | number | what is wrong |").into_iter().map(|row| (row[0], row[1]));
    let expected: Vec<_> = code::CODES.iter().filter(|(_, value)| *value < 0).collect();
    assert_eq!(said.len(), expected.len());
    for ((name, number), &&(code, value)) in said.zip(&expected) {
        assert_eq!(name, format!("`FLUISIM_{code}`"));
        assert_eq!(number.replace('−', "-"), value.to_string(), "{name}");
    }
}

#[test]
fn flash_is_that_of_the_table_that_is_measured() {
    let measured = include_str!("../../../tests/on-target/c.csv");
    let targets = [("Cortex-M0", "thumbv6m-none-eabi"), ("Cortex-M4F", "thumbv7em-none-eabihf")];
    let columns = ["i16f16,C", "i16f16,Rust", "f32,C", "f32,Rust"];
    let rows = table("| | q16, C | q16, Rust | f32, C | f32, Rust |");
    assert_eq!(rows.len(), targets.len());
    for (row, (processor, triple)) in rows.iter().zip(targets) {
        assert_eq!(row[0], processor);
        for (said, column) in row[1..].iter().zip(columns) {
            let line = format!("{triple},{column},{said}");
            assert!(measured.lines().any(|row| row == line), "c.csv has no row {line}");
        }
    }
}

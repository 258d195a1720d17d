//! CSV: what is written reads back to the same bits.

use proptest::prelude::*;
use sph_host::output::{Column, Precision, Table, shortest, write_csv};

fn table(precision: Precision, x: Vec<f64>, values: Vec<f64>) -> Table {
    Table {
        coordinates: vec![Column::new("x", x)],
        columns: vec![Column::new("density", values)],
        grid: None,
        precision,
        caption: String::new(),
    }
}

fn text(table: &Table) -> String {
    let mut bytes = Vec::new();
    write_csv(table, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Any finite number, by its bits: subnormal, huge and negative zero too.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

fn finite_f32() -> impl Strategy<Value = f32> {
    any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |value| value.is_finite())
}

proptest! {
    #[test]
    fn f64_reads_back_to_the_same_bits(rows in prop::collection::vec((finite(), finite()), 0..40)) {
        let (x, values): (Vec<f64>, Vec<f64>) = rows.into_iter().unzip();
        let text = text(&table(Precision::F64, x.clone(), values.clone()));
        let read: Vec<(f64, f64)> = csv::Reader::from_reader(text.as_bytes()).deserialize().map(Result::unwrap).collect();
        prop_assert_eq!(read.len(), x.len());
        for (row, (x, value)) in read.iter().zip(x.iter().zip(&values)) {
            prop_assert_eq!(row.0.to_bits(), x.to_bits());
            prop_assert_eq!(row.1.to_bits(), value.to_bits());
        }
    }

    #[test]
    fn f32_reads_back_to_the_same_bits_and_is_short(x in finite(), value in finite_f32()) {
        let text = text(&table(Precision::F32, vec![x], vec![f64::from(value)]));
        let cells: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
        prop_assert_eq!(cells[0].parse::<f64>().unwrap().to_bits(), x.to_bits());
        prop_assert_eq!(cells[1].parse::<f32>().unwrap().to_bits(), value.to_bits());
        prop_assert!(cells[1].len() <= 16, "{}", cells[1]);
    }
}

#[test]
fn known_numbers_look_as_people_write_them() {
    let cases = [
        (0.1, "0.1"),
        (1000.0, "1000.0"),
        (-0.0, "-0.0"),
        (1e300, "1e+300"),
        (5e-324, "5e-324"),
        (1.0 / 3.0, "0.3333333333333333"),
    ];
    for (value, expected) in cases {
        assert_eq!(shortest(value, Precision::F64), expected);
    }
    assert_eq!(shortest(f64::from(1.0_f32 / 3.0), Precision::F32), "0.33333334");
}

#[test]
fn no_value_is_an_empty_cell_and_no_points_are_the_header_alone() {
    let table = |x, values| table(Precision::F64, x, values);
    assert_eq!(text(&table(vec![0.5, 1.0], vec![f64::NAN, 2.0])), "x,density\n0.5,\n1.0,2.0\n");
    assert_eq!(text(&table(vec![], vec![])), "x,density\n");
}

#[test]
fn names_with_commas_and_quotes_are_quoted() {
    let mut table = table(Precision::F64, vec![1.0], vec![2.0]);
    table.columns[0].name = String::from("a,\"b\"");
    assert_eq!(text(&table), "x,\"a,\"\"b\"\"\"\n1.0,2.0\n");
}

#[test]
fn tables_that_contradict_themselves_are_refused() {
    let short = table(Precision::F64, vec![1.0, 2.0], vec![2.0]);
    let message = write_csv(&short, Vec::new()).unwrap_err().to_string();
    assert_eq!(message, "column `density` has 1 values, expected 2");
    let mut twice = table(Precision::F64, vec![1.0], vec![2.0]);
    twice.columns.push(twice.columns[0].clone());
    assert_eq!(write_csv(&twice, Vec::new()).unwrap_err().to_string(), "two columns are named `density`");
}

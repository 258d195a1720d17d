//! The examples hold; those that implement a trait of one's own run in `tests/tests/from_outside.rs`.

#[path = "../examples/field.rs"]
mod field;
#[path = "../examples/pendant.rs"]
mod pendant;

#[test]
fn a_field_on_the_types_of_a_microcontroller() {
    field::main().unwrap();
}

#[test]
fn a_pendant_that_is_turned() {
    pendant::main().unwrap();
}

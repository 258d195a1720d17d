//! The command `fluisim`.

fn main() {}

//! A dam break from the library, without files: `cargo run --release -p sph-host --example run_case`.

use sph_host::run::{self, CaseName, Options};

fn main() -> Result<(), run::Error> {
    let options = Options { resolution: Some(16), time: Some(0.2), ..Options::new(CaseName::DamBreak) };
    let (summary, series) = run::simulate(&options, &())?; // () shows no progress
    print!("{}", summary.table());
    if let Some(front) = series.last("front_x") {
        println!("the front is at {front:.3} m after 0.2 s");
    }
    Ok(())
}

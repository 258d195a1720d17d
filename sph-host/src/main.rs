//! The command `fluisim`.

use std::process::ExitCode;

fn main() -> ExitCode {
    sph_host::cli::main()
}

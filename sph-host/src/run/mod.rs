//! Cases simulated and held against what is known of them.

mod case;
mod drive;
mod measure;
mod reference;
mod series;
mod setup;
mod simulation;

pub use series::Check;

use crate::failure::Failure;
use crate::kernel_choice::KernelName;
use crate::scalar_choice::ScalarName;

#[doc(hidden)]
pub fn experiment(name: &str, n: u32, scalar: ScalarName, time: Option<f64>) -> Result<(), Failure> {
    let rounding = if scalar == ScalarName::F64 { 1e-12 } else { 1e-4 };
    match name {
        "dam" => go(&case::DamBreak { resolution: n } as &dyn case::Case<2>, scalar, time),
        "dam3" => go(&case::DamBreak { resolution: n } as &dyn case::Case<3>, scalar, time),
        "hydro" => go(&case::Hydrostatic { resolution: n }, scalar, time),
        "drop" => go(&case::Drop { resolution: n, rounding }, scalar, time),
        "tg" => go(&case::TaylorGreen { resolution: n, rounding }, scalar, time),
        _ => go(&case::Poiseuille { resolution: n }, scalar, time),
    }
}

fn go<const D: usize>(case: &dyn case::Case<D>, scalar: ScalarName, time: Option<f64>) -> Result<(), Failure> {
    let duration = time.unwrap_or(case.duration());
    let mut drive = drive::Drive::new(case, scalar, KernelName::WendlandC2, duration / 20.0)?;
    let start = std::time::Instant::now();
    let mut last = drive.next_frame()?;
    for frame in 1..drive.frames_in(duration) {
        last = drive.next_frame()?;
        if frame % 4 == 0 { eprintln!("{frame} {:?}", drive.series.rows.last()); }
    }
    let wall = start.elapsed().as_secs_f64();
    let n = last.positions.len();
    eprintln!("{:?}", drive.series.columns);
    eprintln!("n {n} walls {} steps {} wall {wall:.2} us/particle-step {:.3}", drive.setup.walls.len(), drive.steps(), wall*1e6/(n as f64*drive.steps() as f64));
    for check in drive.checks(&last) {
        eprintln!("{:5} {:.6} <= {} {}", check.holds(), check.value, check.goal, check.name);
    }
    let e = drive.series.energy();
    eprintln!("energy {:?} -> {:?}", e[0], e[e.len()-1]);
    Ok(())
}

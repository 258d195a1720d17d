//! The pendants of `firmware/src/cycles.rs`: rows of the table, and frames a second.

use super::region::Region;
use anyhow::{Context, Result, ensure};

/// The clocks of chips with these processors, in MHz.
const CLOCKS: [u32; 4] = [48, 64, 125, 133];

/// What the plugin counted of a piece of work.
#[derive(Clone, Debug)]
pub(crate) struct Pendant {
    scalar: String,
    particles: u64,
    /// `frame`, or a raster.
    work: String,
    /// Once each time it was done.
    pub(crate) regions: Vec<Region>,
}

impl Pendant {
    /// Deals regions to the lines of the log: `scalar,particles,work,regions`.
    pub(crate) fn read(log: &[String], regions: &[Region]) -> Result<Vec<Self>> {
        let mut rest = regions;
        let mut pendants = Vec::new();
        for line in log {
            let fields: Vec<&str> = line.split(',').collect();
            let [scalar, particles, work, times] = fields[..] else {
                anyhow::bail!("expected scalar,particles,work,regions, got {line:?}")
            };
            let (own, others) = rest.split_at_checked(times.parse()?).context("regions are missing")?;
            ensure!(
                own.iter().all(|region| region.unknown == 0),
                "{line}: instructions without a published number"
            );
            rest = others;
            pendants.push(Self {
                scalar: scalar.into(),
                particles: particles.parse()?,
                work: work.into(),
                regions: own.to_vec(),
            });
        }
        ensure!(rest.is_empty(), "{} regions that no line announces", rest.len());
        Ok(pendants)
    }

    /// The mean of what is counted of a region.
    fn mean(&self, of: impl Fn(&Region) -> u64) -> f64 {
        self.regions.iter().map(of).sum::<u64>() as f64 / self.regions.len().max(1) as f64
    }

    /// Instructions and cycles a particle and frame.
    pub(crate) fn rows(&self) -> [String; 3] {
        let row = |quantity: &str, of: fn(&Region) -> u64| {
            let each = self.mean(of) / self.particles as f64;
            format!("{},{},{},{quantity},{each:.0}", self.scalar, self.particles, self.work)
        };
        [
            row("instructions", |region| region.instructions),
            row("cycles M0", |region| region.m0),
            row("cycles M0+", |region| region.m0_plus),
        ]
    }
}

/// Prints how many frames a second the work leaves time for, without drawing and with it.
pub(crate) fn print_frames_a_second(pendants: &[Pendant]) {
    let clocks: String = CLOCKS.iter().map(|clock| format!("{:>9}", format!("{clock} MHz"))).collect();
    println!("\nframes a second at zero wait states, with the fast multiplier");
    println!("{:<18} {:>9}  {:<24} {:<4}{clocks}", "scalar", "particles", "work", "core");
    for pair in pendants.chunks(2) {
        let [frame, raster] = pair else { continue };
        for (core, of) in
            [("M0", (|region| region.m0) as fn(&Region) -> u64), ("M0+", |region| region.m0_plus)]
        {
            let (frame_alone, drawn) = (frame.mean(of), frame.mean(of) + raster.mean(of));
            for (work, cycles) in
                [(frame.work.clone(), frame_alone), (format!("frame, {}", raster.work), drawn)]
            {
                let rates: String =
                    CLOCKS.iter().map(|&clock| format!("{:>9.1}", f64::from(clock) * 1e6 / cycles)).collect();
                println!("{:<18} {:>9}  {work:<24} {core:<4}{rates}", frame.scalar, frame.particles);
            }
        }
    }
}

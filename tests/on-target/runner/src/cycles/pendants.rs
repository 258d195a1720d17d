//! The pendants of `firmware/src/cycles.rs`: rows of the table, and frames a second.

use super::region::Region;
use crate::target::{M0, M4F, Target};
use anyhow::{Context, Result, bail, ensure};

/// The clocks of chips with these processors, in MHz.
const CLOCKS: [u32; 4] = [48, 64, 125, 133];

/// A column of cycles.
struct Cycles {
    name: &'static str,
    of: fn(&Region) -> u64,
}

const OF_M0: [Cycles; 2] = [
    Cycles { name: "cycles M0", of: |region| region.m0 },
    Cycles { name: "cycles M0+", of: |region| region.m0_plus },
];

const OF_M4: [Cycles; 2] = [
    Cycles { name: "cycles M4 at least", of: |region| region.m4[0] },
    Cycles { name: "cycles M4 at most", of: |region| region.m4[1] },
];

/// What the plugin counted of a piece of work.
#[derive(Clone, Debug)]
pub(crate) struct Pendant {
    target: Target,
    scalar: String,
    particles: u64,
    /// `frame`, or a raster.
    work: String,
    /// Once each time it was done.
    pub(crate) regions: Vec<Region>,
}

impl Pendant {
    /// Deals regions to the lines of the log: `scalar,particles,work,regions`.
    pub(crate) fn read(target: Target, log: &[String], regions: &[Region]) -> Result<Vec<Self>> {
        let mut rest = regions;
        let mut pendants = Vec::new();
        for line in log {
            let fields: Vec<&str> = line.split(',').collect();
            let [scalar, particles, work, times] = fields[..] else {
                bail!("expected scalar,particles,work,regions, got {line:?}")
            };
            let (own, others) = rest.split_at_checked(times.parse()?).context("regions are missing")?;
            let unknown: u64 = own.iter().map(|r| if target == M4F { r.m4_unknown } else { r.unknown }).sum();
            ensure!(unknown == 0, "{line}: {unknown} instructions without a published number");
            rest = others;
            pendants.push(Self {
                target,
                scalar: scalar.into(),
                particles: particles.parse()?,
                work: work.into(),
                regions: own.to_vec(),
            });
        }
        ensure!(rest.is_empty(), "{} regions that no line announces", rest.len());
        Ok(pendants)
    }

    fn is_on_m0(&self) -> bool {
        self.target == M0
    }

    fn columns(&self) -> &'static [Cycles] {
        if self.is_on_m0() { &OF_M0 } else { &OF_M4 }
    }

    /// The mean of what is counted of a region.
    fn mean(&self, of: fn(&Region) -> u64) -> f64 {
        self.regions.iter().map(of).sum::<u64>() as f64 / self.regions.len().max(1) as f64
    }

    /// Instructions and cycles a particle and frame.
    pub(crate) fn rows(&self) -> Vec<String> {
        let instructions = Cycles { name: "instructions", of: |region| region.instructions };
        let row = |Cycles { name, of }: &Cycles| {
            let each = self.mean(*of) / self.particles as f64;
            let Self { target, scalar, particles, work, .. } = self;
            format!("{},{scalar},{particles},{work},{name},{each:.0}", target.triple)
        };
        std::iter::once(&instructions).chain(self.columns()).map(row).collect()
    }
}

/// Prints how many frames a second the work leaves time for, without drawing and with it.
pub(crate) fn print_frames_a_second(pendants: &[Pendant]) {
    println!("\nframes a second at zero wait states, M0 and M0+ with the fast multiplier");
    let clocks = CLOCKS.map(|clock| format!("{clock} MHz"));
    print_row("scalar", "particles", "work", "from", &clocks);
    for pair in pendants.chunks(2) {
        let [frame, raster] = pair else { continue };
        for Cycles { name, of } in frame.columns() {
            let alone = frame.mean(*of);
            for (work, cycles) in [("frame", alone), ("frame and raster", alone + raster.mean(*of))] {
                let rates = CLOCKS.map(|clock| format!("{:.1}", f64::from(clock) * 1e6 / cycles));
                print_row(&frame.scalar, &frame.particles.to_string(), work, name, &rates);
            }
        }
    }
}

fn print_row(scalar: &str, particles: &str, work: &str, from: &str, rates: &[String; 4]) {
    let [a, b, c, d] = rates;
    println!("{scalar:<18} {particles:>9}  {work:<17} {from:<19}{a:>9}{b:>9}{c:>9}{d:>9}");
}

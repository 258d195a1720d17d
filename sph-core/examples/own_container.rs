//! A container of one's own: a ring, half full of fluid that runs to the bottom.
//!
//! `cargo run -p sph-core --example own_container`

use sph_core::Error;
use sph_core::fluid::{Container, Particle, PositionBasedFluid, Wall};

/// The room between two circles, in units of h.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) inner: f32,
    pub(crate) outer: f32,
}

impl Ring {
    /// The distance from the centre and the unit vector away from it; `None` at the centre and for NaN.
    fn polar(&self, x: &[f32; 2]) -> Option<(f32, [f32; 2])> {
        let d = x.map(|component| component - self.outer);
        let r = d[0].hypot(d[1]);
        (r > 0.0 && r.is_finite()).then(|| (r, d.map(|component| component / r)))
    }
}

impl Container<f32, 2> for Ring {
    fn size(&self) -> [f32; 2] {
        [2.0 * self.outer; 2]
    }

    fn contains(&self, x: &[f32; 2]) -> bool {
        self.polar(x).is_some_and(|(r, _)| r >= self.inner && r <= self.outer)
    }

    /// The nearer of the two walls, as if it were plane.
    fn wall(&self, x: &[f32; 2]) -> Option<Wall<f32, 2>> {
        let (r, away) = self.polar(x)?;
        if r - self.inner < self.outer - r {
            Wall::plane(r - self.inner, away)
        } else {
            Wall::plane(self.outer - r, away.map(|component| -component))
        }
    }

    fn confine(&self, from: &[f32; 2], to: [f32; 2], gap: f32) -> [f32; 2] {
        match self.polar(&to) {
            Some((r, _)) if r >= self.inner && r <= self.outer => to,
            Some((r, away)) => {
                let r = r.clamp(self.inner + gap, self.outer - gap);
                away.map(|component| self.outer + r * component)
            }
            None => *from,
        }
    }
}

pub(crate) fn main() -> Result<(), Error> {
    let ring = Ring { inner: 3.0, outer: 6.0 };
    let mut fluid = PositionBasedFluid::<f32, Ring, 2, 200, 169>::new(ring);
    for k in 0..576 {
        // the right half, at rest
        let place = [0.25 + 0.5 * (k % 24) as f32, 0.25 + 0.5 * (k / 24) as f32];
        if place[0] > 6.5 && ring.contains(&place) {
            fluid.add(Particle::new(place, [0.0; 2])).map_err(|rejected| rejected.reason)?;
        }
    }
    for _ in 0..1500 {
        fluid.step([0.0, -0.005]);
    }
    let particles = fluid.particles();
    let mean =
        |axis: usize| particles.iter().map(|p| p.position()[axis]).sum::<f32>() / particles.len() as f32;
    println!("{} particles about ({:.2}, {:.2})", particles.len(), mean(0), mean(1));
    assert!(particles.iter().all(|p| ring.contains(&p.position())));
    assert!((mean(0) - 6.0).abs() < 0.5 && mean(1) < 4.0, "it lies at the bottom, left and right alike");
    Ok(())
}

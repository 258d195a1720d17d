//! The position-based fluid in every container and number type: no call brings a particle out of its container or to no number.

use arbitrary::{Result, Unstructured};
use sph_core::fluid::raster::draw_density;
use sph_core::fluid::{Container, Disc, Mask, OpenBox, Particle, PositionBasedFluid, Settings, Shape};
use sph_core::scalar::compact::Compact;
use sph_core::scalar::fast::Fast32;
use sph_core::scalar::fixed::{Check, Fixed, I8F24, I16F16, Saturate, Wrap};

use crate::numbers::{number, vector};

/// Calls of one input at most.
const MOST: usize = 60;

/// The first byte chooses the number type, the second the container.
pub fn fluid(data: &[u8]) {
    let Some((&[scalar, container], rest)) = data.split_first_chunk() else { return };
    let bytes = &mut Unstructured::new(rest);
    // Bytes that end too soon end the input.
    let _ = match scalar % 7 {
        0 => contained::<f32>(container, bytes),
        1 => contained::<f64>(container, bytes),
        2 => contained::<Fast32>(container, bytes),
        3 => contained::<Fixed<I16F16, Saturate>>(container, bytes),
        4 => contained::<Fixed<I8F24, Saturate>>(container, bytes),
        5 => contained::<Fixed<I16F16, Wrap>>(container, bytes),
        _ => contained::<Fixed<I16F16, Check>>(container, bytes),
    };
}

fn contained<T: Compact>(container: u8, bytes: &mut Unstructured) -> Result<()> {
    match container % 6 {
        0 => calls::<T, _, 2>(OpenBox::new(vector(bytes)?), bytes),
        1 => calls::<T, _, 3>(OpenBox::new(vector(bytes)?), bytes),
        2 => calls::<T, _, 2>(Disc::new(number(bytes)?), bytes),
        3 => calls::<T, _, 3>(Disc::new(number(bytes)?), bytes),
        4 => {
            let bits: [u8; 8] = bytes.arbitrary()?;
            let Ok(mask) = Mask::new(&bits, bytes.arbitrary()?, number(bytes)?) else { return Ok(()) };
            calls::<T, _, 2>(mask, bytes)
        }
        _ => {
            // a distance that makes no sense at all
            let (size, distance, normal) = (vector(bytes)?, number(bytes)?, vector(bytes)?);
            let shape = Shape::new(size, move |x: &[T; 2]| (x[0] - distance, normal));
            calls::<T, _, 2>(shape, bytes)
        }
    }
}

fn calls<T: Compact, C: Container<T, D>, const D: usize>(
    container: C,
    bytes: &mut Unstructured,
) -> Result<()> {
    let mut fluid = PositionBasedFluid::<T, C, D, 24, 600, u8>::new(container);
    for _ in 0..MOST {
        match bytes.arbitrary::<u8>()? % 8 {
            0 => drop(fluid.remove(bytes.arbitrary::<u8>()?.into())),
            1 => {
                let change = vector(bytes)?;
                fluid.impulse(|_| change);
            }
            2 => {
                let [iterations, viscosity, cohesion] = bytes.arbitrary()?;
                // more iterations are time alone
                *fluid.settings_mut() = Settings { iterations: iterations % 8, viscosity, cohesion };
            }
            3 => {
                let acceleration = vector(bytes)?;
                (0..8).for_each(|_| fluid.step(acceleration));
            }
            4 => fluid.step(vector(bytes)?),
            _ => {
                let particle = Particle::new(vector(bytes)?, vector(bytes)?).with_pressure(number(bytes)?);
                let _ = fluid.add(particle);
            }
        }
        check(&fluid);
    }
    Ok(())
}

fn check<T: Compact, C: Container<T, D>, const D: usize>(fluid: &PositionBasedFluid<T, C, D, 24, 600, u8>) {
    for particle in fluid.particles() {
        let (position, velocity) = (particle.position(), particle.velocity());
        assert!(position.iter().chain(&velocity).all(|number| number.is_finite()), "{particle:?}");
        assert!(fluid.container().contains(&position), "{particle:?} is outside");
    }
    let flat: Vec<Particle<T, 2>> =
        fluid.particles().iter().map(|one| Particle::new([one.position()[0]; 2], [T::ZERO; 2])).collect();
    draw_density(&flat, T::ratio(1, 2), 4, &mut [0; 16]);
}

//! The accelerometer LIS3DH.

use crate::bus::{Bus, NoAnswer};

/// Its address with SA0 at ground.
const ADDRESS: u8 = 0x18;
const WHO_AM_I: (u8, u8) = (0x0f, 0x33);
/// Where x begins; with the highest bit set, the register goes on by one with each byte.
const OUT_X_L: u8 = 0x28 | 0x80;

/// The sensor, which has answered.
pub(crate) struct Sensor(());

impl Sensor {
    /// Starts it: 100 samples a second, all axes; a sample is replaced as a whole, ±2 g in high resolution.
    pub(crate) fn start(bus: &mut Bus) -> Result<Self, NoAnswer> {
        let [name] = bus.read(ADDRESS, WHO_AM_I.0)?;
        if name != WHO_AM_I.1 {
            return Err(NoAnswer);
        }
        bus.write(ADDRESS, &[0x20, 0x57])?;
        bus.write(ADDRESS, &[0x23, 0x88])?;
        Ok(Self(()))
    }

    /// What it reads along x and y: 16384 is 1 g.
    pub(crate) fn read(&self, bus: &mut Bus) -> Result<[i16; 2], NoAnswer> {
        let [xl, xh, yl, yh] = bus.read(ADDRESS, OUT_X_L)?;
        Ok([i16::from_le_bytes([xl, xh]), i16::from_le_bytes([yl, yh])])
    }
}

//! An animated GIF of pictures.

use std::io::{self, Write};
use std::time::Duration;

use gif::{EncodingError, Repeat};

use super::Image;

/// A GIF that grows frame by frame and plays for ever. Each frame has its own 256 colours.
///
/// ```
/// use std::time::Duration;
/// use sph_host::picture::{Image, animation::Animation};
///
/// let frame = |grey| Image { width: 2, height: 1, rgb: vec![grey; 6] };
/// let mut bytes = Vec::new();
/// let mut animation = Animation::begin(&mut bytes, 2, 1, Duration::from_millis(40))?;
/// animation.push(&frame(0))?;
/// animation.push(&frame(255))?;
/// animation.finish()?;
/// assert!(bytes.starts_with(b"GIF89a"));
/// # Ok::<(), std::io::Error>(())
/// ```
pub struct Animation<W: Write> {
    encoder: gif::Encoder<W>,
    size: (u16, u16),
    /// Hundredths of a second.
    delay: u16,
}

/// How fast colours are chosen, 1 (best) to 30.
const SPEED: i32 = 10;

impl<W: Write> Animation<W> {
    /// Begins a GIF of pictures of this size that each stay for `delay`, to a hundredth of a second but no less than two, below
    /// which viewers slow down.
    ///
    /// # Errors
    ///
    /// Sizes that GIF cannot hold (65535 pixels at most), as [`io::ErrorKind::InvalidInput`], and what `writer` reports.
    pub fn begin(writer: W, width: u32, height: u32, delay: Duration) -> io::Result<Self> {
        let (Ok(width), Ok(height)) = (u16::try_from(width), u16::try_from(height)) else {
            let message = format!("a GIF of {width} by {height} pixels is too large, 65535 is the most");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        };
        let mut encoder = gif::Encoder::new(writer, width, height, &[]).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        let delay = u16::try_from((delay.as_millis() + 5) / 10).unwrap_or(u16::MAX).max(2);
        Ok(Self { encoder, size: (width, height), delay })
    }

    /// Adds a frame.
    ///
    /// # Errors
    ///
    /// A picture of another size, as [`io::ErrorKind::InvalidInput`], and what the writer reports.
    pub fn push(&mut self, image: &Image) -> io::Result<()> {
        let (width, height) = self.size;
        let pixels = usize::from(width) * usize::from(height);
        if (image.width, image.height) != (u32::from(width), u32::from(height))
            || image.rgb.len() != 3 * pixels
        {
            let message = format!(
                "a frame of {} by {} pixels, expected {width} by {height}",
                image.width, image.height
            );
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        let mut frame = gif::Frame::from_rgb_speed(width, height, &image.rgb, SPEED);
        frame.delay = self.delay;
        self.encoder.write_frame(&frame).map_err(failed)
    }

    /// Ends the GIF and gives the writer back.
    ///
    /// # Errors
    ///
    /// What the writer reports.
    pub fn finish(self) -> io::Result<W> {
        self.encoder.into_inner().map_err(failed)
    }
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

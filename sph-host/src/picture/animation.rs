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
    /// How long a frame stays, in hundredths of a second.
    delay: u16,
}

/// A picture as a frame of a GIF. Frames are independent of each other, so threads can encode several at a time.
pub struct EncodedFrame(gif::Frame<'static>);

impl EncodedFrame {
    /// Chooses the colours and compresses.
    ///
    /// # Errors
    ///
    /// A picture too large for a GIF, or whose pixels do not fill it, as [`io::ErrorKind::InvalidInput`].
    pub fn of(image: &Image) -> io::Result<Self> {
        let Image { width, height, ref rgb } = *image;
        let (Ok(across), Ok(down)) = (u16::try_from(width), u16::try_from(height)) else {
            return Err(too_large(width, height));
        };
        let pixels = usize::from(across) * usize::from(down);
        if rgb.len() != 3 * pixels {
            return Err(invalid(format!("{} bytes for {pixels} pixels, expected {}", rgb.len(), 3 * pixels)));
        }
        let mut frame = gif::Frame::from_rgb_speed(across, down, rgb, SPEED);
        frame.make_lzw_pre_encoded();
        Ok(Self(frame))
    }
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
            return Err(too_large(width, height));
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
        self.push_encoded(EncodedFrame::of(image)?)
    }

    /// Adds a frame that is encoded already, to the same bytes as [`push`](Self::push).
    ///
    /// # Errors
    ///
    /// As [`push`](Self::push).
    pub fn push_encoded(&mut self, frame: EncodedFrame) -> io::Result<()> {
        let EncodedFrame(mut frame) = frame;
        let (width, height) = self.size;
        if (frame.width, frame.height) != self.size {
            let (found, high) = (frame.width, frame.height);
            return Err(invalid(format!(
                "a frame of {found} by {high} pixels, expected {width} by {height}"
            )));
        }
        frame.delay = self.delay;
        self.encoder.write_lzw_pre_encoded_frame(&frame).map_err(failed)
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

fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message)
}

fn too_large(width: u32, height: u32) -> io::Error {
    invalid(format!("a GIF of {width} by {height} pixels is too large, 65535 is the most"))
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}

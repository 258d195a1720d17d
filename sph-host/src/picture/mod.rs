//! Pictures: heat maps, line plots, particles; drawn in memory, the same bytes everywhere.
//!
//! * [`heat_map`]: fields on a plane grid, with colour bars, axes and arrows;
//! * [`plot`]: lines and points over two axes, linear or logarithmic, with a legend;
//! * [`spectrum`]: histograms over powers of two, one below the other;
//! * [`particles`]: particles coloured by a value, e.g. the frames of an animation;
//! * [`animation`]: an animated GIF of such frames.
//!
//! Each of them gives an [`Image`]. Nothing of the system is needed: the typeface is compiled in.

pub mod animation;
mod arrows;
mod axes;
mod canvas;
mod colour;
mod colour_bar;
pub mod heat_map;
pub mod particles;
pub mod plot;
pub mod spectrum;
mod text;
mod ticks;

use std::io::{self, Write};

use thiserror::Error;

pub use colour::Palette;

/// A finished picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// Red, green and blue of each pixel, row by row from the top.
    pub rgb: Vec<u8>,
}

impl Image {
    /// Writes the picture as PNG.
    ///
    /// # Errors
    ///
    /// What `writer` reports.
    pub fn write_png(&self, writer: impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(writer, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.rgb)?;
        Ok(writer.finish()?)
    }
}

/// Why a picture cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PictureError {
    /// Nothing to show.
    #[error("a picture needs at least one quantity")]
    Empty,
    /// More than fits.
    #[error("a picture shows at most {limit} quantities, got {count}: choose some of them")]
    TooMany {
        /// How many there are.
        count: usize,
        /// How many fit.
        limit: usize,
    },
    /// Lists that belong together differ in length.
    #[error("{what}: got {got} values, expected {expected}")]
    Length {
        /// What the values are.
        what: String,
        /// How many there are.
        got: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A range that is not finite, or empty.
    #[error("{what}: a range must be finite with lower < upper, got {lower} and {upper}")]
    Range {
        /// What the range is of.
        what: String,
        /// Its lower end.
        lower: String,
        /// Its upper end.
        upper: String,
    },
    /// More pixels than a picture may have.
    #[error("a picture of {width} by {height} pixels is too large")]
    TooLarge {
        /// Pixels from left to right.
        width: u32,
        /// Pixels from top to bottom.
        height: u32,
    },
}

/// A range that axes can show: finite and not empty.
fn check_range(what: &str, [lower, upper]: [f64; 2]) -> Result<(), PictureError> {
    if lower < upper && (upper - lower).is_finite() {
        return Ok(());
    }
    Err(PictureError::Range { what: what.to_owned(), lower: lower.to_string(), upper: upper.to_string() })
}

//! Particles that each bring their own support radius h_j (scatter form, W(x − x_j, h_j)).

use sph_core::{Error, Parameter};

use super::fields::Fields;
use super::part::{OwnRadii, Part, Samples};
use super::simd::{InstructionSet, Real};
use super::sorted_cells::{SortedCells, check_length, check_radius};
use crate::parallel;

/// Particles sorted by the octave of their support radius, and within each octave into [`SortedCells`]: a point looks at cells that
/// suit the radii in them, however widely these differ.
///
/// ```
/// use sph_core::kernel::CubicSpline;
/// use sph_host::fast::RadiusOctaves;
/// let levels = RadiusOctaves::sort(&[[0.0_f64], [1.0], [1.5]], &[0.8, 2.0, 0.1])?;
/// let sums = levels.fields(&[&[1.0, 1.0, 1.0]])?.at::<CubicSpline>(&[[0.0]], false)?;
/// assert_eq!(sums.reached, [2]);
/// # Ok::<(), sph_core::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct RadiusOctaves<T, const D: usize> {
    parts: Vec<(SortedCells<T, D>, OwnRadii<T>)>,
    len: usize,
}

impl<T: Real, const D: usize> RadiusOctaves<T, D> {
    /// Sorts particles, each with its support radius.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] unless there is a radius for each particle; for the radii and positions as
    /// [`SortedCells::sort`], a position's index being that among the particles of its octave.
    pub fn sort(positions: &[[T; D]], radii: &[T]) -> Result<Self, Error> {
        check_length(radii.len(), positions.len(), Parameter::SupportRadius)?;
        radii.iter().enumerate().try_for_each(|(index, &radius)| check_radius(radius, index))?;
        let mut octaves = vec![0; radii.len()];
        parallel::fill(&mut octaves, |j| radii[j].to_f64().log2().floor() as i32);
        let mut distinct = octaves.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let parts = distinct.into_iter().map(|octave| {
            let of_octave = |&j: &u32| octaves[j as usize] == octave;
            let indices: Vec<u32> = (0..positions.len() as u32).filter(of_octave).collect();
            part(positions, radii, &indices)
        });
        Ok(Self { parts: parts.collect::<Result<_, _>>()?, len: positions.len() })
    }

    /// As [`SortedCells::at_level`].
    #[must_use]
    pub fn at_level(self, level: InstructionSet) -> Self {
        let parts = self.parts.into_iter().map(|(cells, own)| (cells.at_level(level), own)).collect();
        Self { parts, ..self }
    }

    /// How many particles there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// As [`SortedCells::fields`].
    ///
    /// # Errors
    /// As [`SortedCells::fields`].
    pub fn fields(&self, coefficients: &[&[T]]) -> Result<Fields<'_, T, D>, Error> {
        self.samples(&Samples { coefficients, volumes: &[], values: &[] })
    }

    /// As [`SortedCells::samples`].
    ///
    /// # Errors
    /// As [`SortedCells::samples`].
    pub fn samples(&self, samples: &Samples<'_, T>) -> Result<Fields<'_, T, D>, Error> {
        samples.check(self.len())?;
        let parts = self.parts.iter().map(|(cells, own)| Part::new(cells, Some(own), samples)).collect();
        Ok(Fields::new(parts, samples))
    }
}

/// The cells of the particles with these indices.
fn part<T: Real, const D: usize>(
    positions: &[[T; D]],
    radii: &[T],
    indices: &[u32],
) -> Result<(SortedCells<T, D>, OwnRadii<T>), Error> {
    let chosen: Vec<[T; D]> = indices.iter().map(|&j| positions[j as usize]).collect();
    let of = |index: &u32| radii[*index as usize];
    let first = indices.first().map_or(T::ONE, of);
    let (least, most) = indices.iter().map(of).fold((first, first), |(least, most), radius| {
        (if radius < least { radius } else { least }, if radius > most { radius } else { most })
    });
    let mut cells = SortedCells::sort(&chosen, most)?;
    cells.sorted.order.iter_mut().for_each(|index| *index = indices[*index as usize]);
    let column = |value: &(dyn Fn(T) -> T + Sync)| cells.sorted.column(|j| value(radii[j]));
    let own = OwnRadii {
        radii: column(&|h| h),
        squares: column(&|h| h * h),
        inverses: column(&|h| T::ONE / h),
        least,
    };
    Ok((cells, own))
}

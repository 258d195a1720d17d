//! What particles span: all that units, cells and columns depend on. It is the same whether the particles come at once or in
//! pieces.

use super::error::SampleError;
use super::particles::{Particles, Support, bounds};

/// The least and the greatest of some numbers.
pub(super) type Bounds = (f64, f64);

/// The name of a field, the quantity that it belongs to, and the bounds of its values.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FieldSpan {
    pub(super) name: String,
    pub(super) quantity: String,
    pub(super) bounds: Bounds,
}

/// The bounds of everything that particles bring, and their number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Span {
    /// The file or set, for messages.
    pub(super) file: String,
    pub(super) count: usize,
    /// The axis in space of each coordinate: 0 is x.
    pub(super) space: Vec<usize>,
    /// Coordinate by coordinate, as many as the file has.
    pub(super) coordinates: Vec<Bounds>,
    pub(super) masses: Option<Bounds>,
    pub(super) densities: Option<Bounds>,
    /// h
    pub(super) supports: Bounds,
    /// Whether h is the same for all.
    pub(super) is_uniform: bool,
    pub(super) fields: Vec<FieldSpan>,
}

impl Span {
    /// What some particles span.
    pub(super) fn of(particles: &Particles) -> Self {
        let fields = particles.quantities.iter().map(|field| FieldSpan {
            name: field.name.clone(),
            quantity: field.quantity.clone(),
            bounds: bounds(&field.values),
        });
        Self {
            file: particles.file.clone(),
            count: particles.len(),
            space: particles.space.clone(),
            coordinates: particles.coordinates.iter().map(|axis| bounds(axis)).collect(),
            masses: particles.masses.as_deref().map(bounds),
            densities: particles.densities.as_deref().map(bounds),
            supports: match &particles.support {
                Support::Uniform(h) => (*h, *h),
                Support::PerParticle(radii) => bounds(radii),
            },
            is_uniform: matches!(particles.support, Support::Uniform(_)),
            fields: fields.collect(),
        }
    }

    /// What these and more particles span, which must have the same fields.
    pub(super) fn join(mut self, more: &Self) -> Result<Self, SampleError> {
        let names = |span: &Self| span.fields.iter().map(|field| field.name.clone()).collect::<Vec<_>>();
        let (before, now) = (names(&self), names(more));
        if before != now {
            let (file, before, now) = (self.file, before.join(", "), now.join(", "));
            return Err(SampleError::ChangingQuantities { file, before, now });
        }
        self.count += more.count;
        self.coordinates.iter_mut().zip(&more.coordinates).for_each(|(a, b)| *a = joined(*a, *b));
        self.masses = self.masses.zip(more.masses).map(|(a, b)| joined(a, b));
        self.densities = self.densities.zip(more.densities).map(|(a, b)| joined(a, b));
        self.supports = joined(self.supports, more.supports);
        self.fields.iter_mut().zip(&more.fields).for_each(|(a, b)| a.bounds = joined(a.bounds, b.bounds));
        Ok(self)
    }

    /// The axes in space of some coordinates.
    pub(super) fn in_space(&self, axes: &[usize]) -> Vec<usize> {
        axes.iter().map(|&axis| self.space[axis]).collect()
    }

    /// That the extent along every axis is a number.
    pub(super) fn check(&self) -> Result<(), SampleError> {
        let infinite = |&(lower, upper): &Bounds| !(upper - lower).is_finite();
        match self.coordinates.iter().position(infinite) {
            None => Ok(()),
            Some(axis) => {
                let (lower, upper) = self.coordinates[axis];
                Err(SampleError::Extent { file: self.file.clone(), axis: self.space[axis], lower, upper })
            }
        }
    }
}

fn joined(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

//! Checked particles.

/// Support radii h.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Support {
    /// One for all.
    Uniform(f64),
    /// One for each particle (scatter form).
    PerParticle(Vec<f64>),
}

/// A field to evaluate.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Values {
    /// The column's name in the result.
    pub(super) name: String,
    /// The quantity that was asked for, of which this is all or a component.
    pub(super) quantity: String,
    /// One value a particle.
    pub(super) values: Vec<f64>,
}

/// Particles whose every number in use is finite, and positive where it must be.
#[derive(Clone, Debug)]
pub(super) struct Particles {
    /// The file or set, for messages.
    pub(super) file: String,
    /// The axis in space of each coordinate: 0 is x.
    pub(super) space: Vec<usize>,
    /// All coordinates as read, axis by axis.
    pub(super) coordinates: Vec<Vec<f64>>,
    /// m_i; none: weights without mass.
    pub(super) masses: Option<Vec<f64>>,
    /// ρ_i of the file, unless they are to be summed.
    pub(super) densities: Option<Vec<f64>>,
    /// h
    pub(super) support: Support,
    /// The fields.
    pub(super) quantities: Vec<Values>,
}

impl Particles {
    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.coordinates[0].len()
    }

    /// The particles with these numbers, one of which may be there again, at these places.
    pub(super) fn taken(self, numbers: &[usize], coordinates: Vec<Vec<f64>>) -> Self {
        let take = |values: &Vec<f64>| numbers.iter().map(|&number| values[number]).collect::<Vec<f64>>();
        Self {
            space: self.space,
            coordinates,
            masses: self.masses.as_ref().map(take),
            densities: self.densities.as_ref().map(take),
            support: match &self.support {
                Support::Uniform(h) => Support::Uniform(*h),
                Support::PerParticle(radii) => Support::PerParticle(take(radii)),
            },
            quantities: self
                .quantities
                .into_iter()
                .map(|field| Values { values: take(&field.values), ..field })
                .collect(),
            file: self.file,
        }
    }
}

/// The least and the greatest.
pub(super) fn bounds(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), &x| (lower.min(x), upper.max(x)))
}

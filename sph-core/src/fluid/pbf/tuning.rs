//! The numbers of the solver that follow from measurement.

/// A fraction.
type Ratio = (i32, i32);

/// What the solver does with densities and pressures. TABLE
pub(super) struct Tuning {
    /// 1 over the kernel's sum Σ t³, the particle itself included, at which the fluid is at rest. The kernel's own constant, π in two
    /// dimensions, is that of the inside; a smaller sum makes up for the surface, which any such solver compresses.
    pub(super) per_rest_sum: Ratio,
    /// κ, the pressure for an excess density of 1.
    pub(super) stiffness: Ratio,
    /// How much of the pressure of the pass before is kept. It halves what is left of the compression under the fluid's own weight.
    pub(super) kept_pressure: Ratio,
    /// The highest pressure: a push by it is shorter than the distance of the pair.
    pub(super) highest_pressure: Ratio,
    /// t = 1 − q² above which a pair is pushed apart whatever the pressure: q < 0.4, 0.8 spacings. Without it particles pair up.
    pub(super) core: Ratio,
    /// The wall's push in units of p G. A mirror image of the fluid would push with 2 p G; that makes the fluid tremble at rest.
    pub(super) wall_push: Ratio,
    /// How far a particle is moved at most by one correction, in h.
    pub(super) longest_correction: Ratio,
    /// How far two particles at one place are moved apart along each axis, in h.
    pub(super) parting: Ratio,
    /// The largest share of XSPH viscosity in 1/256: beyond, neighbours overshoot.
    pub(super) most_viscosity: u8,
    /// The largest share of a negative pressure that is kept, in 1/256.
    pub(super) most_cohesion: u8,
}

impl Tuning {
    const IN_2D: Self = Self {
        per_rest_sum: (100, 305),
        stiffness: (1, 1),
        kept_pressure: (3, 10),
        highest_pressure: (1, 2),
        core: (21, 25),
        wall_push: (8, 5),
        longest_correction: (1, 4),
        parting: (1, 64),
        most_viscosity: 128,
        most_cohesion: 64,
    };

    const IN_3D: Self = Self {
        per_rest_sum: (100, 496),
        stiffness: (17, 20),
        wall_push: (3, 2),
        most_viscosity: 72,
        ..Self::IN_2D
    };

    pub(super) const fn of<const D: usize>() -> Self {
        if D == 2 { Self::IN_2D } else { Self::IN_3D }
    }
}

//! Sums over arrays of the caller: every sample is looked at, in the order of the arrays.
//!
//! The kernel is a number, its place in [`kernel::LIST`]. Sums are compiled once for all kernels, which they call through a table.

use crate::{code, fluid, pointer};
use sph_core::{
    BruteForce, Domain, Field, Influence, KernelInfluence, Scalar, Sources, for_each_kernel, kernel,
};

/// What sums ask of a kernel's influence: a table of no more than that.
pub(crate) trait Weights<T, const D: usize> {
    /// h
    fn support_radius(&self) -> T;
    /// W
    fn influence(&self, distance_squared: T) -> T;
    /// ∇W
    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D];
    /// W and ∇W
    fn both(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]);
}

impl<T: Scalar, K: kernel::Kernel, const D: usize> Weights<T, D> for KernelInfluence<T, D, K> {
    fn support_radius(&self) -> T {
        Influence::support_radius(self)
    }

    fn influence(&self, distance_squared: T) -> T {
        Influence::influence(self, distance_squared)
    }

    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        Influence::gradient(self, x, distance_squared)
    }

    fn both(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        self.value_and_gradient(x, distance_squared)
    }
}

/// Any kernel's influence.
pub(crate) struct Any<'a, T, const D: usize>(&'a dyn Weights<T, D>);

impl<T: Scalar, const D: usize> Influence<T, D> for Any<'_, T, D> {
    fn support_radius(&self) -> T {
        self.0.support_radius()
    }

    fn influence(&self, distance_squared: T) -> T {
        self.0.influence(distance_squared)
    }

    fn gradient(&self, x: &[T; D], distance_squared: T) -> [T; D] {
        self.0.gradient(x, distance_squared)
    }

    fn value_and_gradient(&self, x: &[T; D], distance_squared: T) -> (T, [T; D]) {
        self.0.both(x, distance_squared)
    }
}

macro_rules! with_each {
    ([$($module:ident $Kernel:ident $name:tt $about:tt;)+] $number:ident $support_radius:ident $use:ident) => {{
        let mut place = 0;
        $(
            if $number == place {
                let influence = KernelInfluence::<T, D, kernel::$Kernel>::new($support_radius).map_err(code::of)?;
                return $use(Any(&influence));
            }
            place += 1;
        )+
        let _ = place;
        Err(code::NOT_FOUND)
    }};
}

/// Hands the influence of a kernel to `sums`.
fn with_kernel<T: Scalar, const D: usize>(
    number: i32,
    support_radius: T,
    sums: impl FnOnce(Any<'_, T, D>) -> Result<(), i32>,
) -> Result<(), i32> {
    for_each_kernel!(with_each; number support_radius sums)
}

/// Samples of the caller with the weight of each.
pub(crate) type Samples<'a, T, const D: usize> = Sources<T, D, BruteForce<'a, T, D, Domain<T, D>>, &'a [T]>;

/// Samples, their kernel and the point, as they come from C.
pub(crate) struct Request<T, const D: usize> {
    pub(crate) kernel: i32,
    pub(crate) support_radius: T,
    pub(crate) positions: *const [T; D],
    pub(crate) weights: *const T,
    pub(crate) count: usize,
}

impl<T: Scalar, const D: usize> Request<T, D> {
    /// The samples, checked.
    ///
    /// # Safety
    /// Pointers that are not null point to `count` elements.
    unsafe fn samples<'a>(&self) -> Result<Samples<'a, T, D>, i32> {
        // SAFETY: as this function.
        let (positions, weights) = unsafe {
            (pointer::slice(self.positions, self.count)?, pointer::slice(self.weights, self.count)?)
        };
        Sources::new(BruteForce::new(positions).map_err(code::of)?, weights).map_err(code::of)
    }

    /// Estimates a field at a point; `estimate` gives value and gradient where there are any.
    ///
    /// # Safety
    /// As [`samples`](Self::samples), for `values` as well; `point` and the results as in [`mod@pointer`].
    pub(crate) unsafe fn estimate(
        self,
        values: *const T,
        point: *const [T; D],
        results: Results<T, D>,
        estimate: impl FnOnce(&FieldOf<'_, T, D>, &Any<'_, T, D>, &[T; D]) -> Option<(T, [T; D])>,
    ) -> Result<(), i32> {
        // SAFETY: as this function.
        let (samples, values, point) =
            unsafe { (self.samples()?, pointer::slice(values, self.count)?, fluid::finite(point)?) };
        if !values.iter().all(|value| value.is_finite()) {
            return Err(code::NOT_FINITE);
        }
        let field = Field::new(&samples, values).map_err(code::of)?;
        with_kernel(self.kernel, self.support_radius, |w| {
            let (value, gradient) = estimate(&field, &w, &point).ok_or(code::UNDEFINED)?;
            // SAFETY: as this function.
            unsafe { results.write(value, gradient) }
        })
    }
}

pub(crate) type FieldOf<'a, T, const D: usize> =
    Field<'a, T, D, BruteForce<'a, T, D, Domain<T, D>>, &'a [T], &'a [T]>;

/// Where a value and its gradient go; a null gradient is not wanted.
pub(crate) struct Results<T, const D: usize>(pub(crate) *mut T, pub(crate) *mut [T; D]);

impl<T: Scalar, const D: usize> Results<T, D> {
    /// # Safety
    /// As [`pointer::write`].
    unsafe fn write(&self, value: T, gradient: [T; D]) -> Result<(), i32> {
        pointer::check(self.0)?;
        if !value.is_finite() || !gradient.iter().all(|along| along.is_finite()) {
            return Err(code::UNDEFINED);
        }
        // SAFETY: as this function.
        unsafe {
            if !self.1.is_null() {
                pointer::write(self.1, gradient)?;
            }
            pointer::write(self.0, value)
        }
    }
}

/// ρ at a point and, where it is wanted, ∇ρ.
///
/// # Safety
/// As [`Request::estimate`].
pub(crate) unsafe fn density<T: Scalar, const D: usize>(
    request: Request<T, D>,
    point: *const [T; D],
    results: Results<T, D>,
) -> Result<(), i32> {
    // SAFETY: as this function.
    let (samples, point) = unsafe { (request.samples()?, fluid::finite(point)?) };
    with_kernel(request.kernel, request.support_radius, |w| {
        let (density, gradient) = if results.1.is_null() {
            (samples.density_at(&w, &point), [T::ZERO; D])
        } else {
            samples.density_gradient_at(&w, &point)
        };
        // SAFETY: as this function.
        unsafe { results.write(density, gradient) }
    })
}

/// ρ at every sample.
///
/// # Safety
/// As [`Request::samples`], for `densities` as well.
pub(crate) unsafe fn densities<T: Scalar, const D: usize>(
    request: Request<T, D>,
    densities: *mut T,
) -> Result<(), i32> {
    // SAFETY: as this function.
    let (samples, densities) = unsafe { (request.samples()?, pointer::slice_mut(densities, request.count)?) };
    with_kernel(request.kernel, request.support_radius, |w| samples.density(&w, densities).map_err(code::of))
}

/// V = m / ρ of every sample.
///
/// # Safety
/// Pointers that are not null point to `count` elements.
pub(crate) unsafe fn volumes<T: Scalar>(
    masses: *const T,
    densities: *const T,
    count: usize,
    volumes: *mut T,
) -> Result<(), i32> {
    // SAFETY: as this function.
    unsafe {
        let (masses, densities) = (pointer::slice(masses, count)?, pointer::slice(densities, count)?);
        sph_core::field::volumes(masses, densities, pointer::slice_mut(volumes, count)?).map_err(code::of)
    }
}

//! What is found at a point, on its way to a row of the result.

/// A value and its gradient.
pub(super) type Local<T, const D: usize> = (T, [T; D]);

/// What is found at one point, in the scalar and its units; `None` where there is no value.
#[derive(Clone, Debug)]
pub(super) struct AtPoint<T, const D: usize> {
    pub(super) density: Option<Local<T, D>>,
    /// Field by field.
    pub(super) fields: Vec<Option<Local<T, D>>>,
}

impl<T, const D: usize> Default for AtPoint<T, D> {
    fn default() -> Self {
        Self { density: None, fields: Vec::new() }
    }
}

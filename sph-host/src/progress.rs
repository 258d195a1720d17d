//! How far work has come, for whoever shows it.

/// Is told of work under way. `()` shows nothing.
///
/// ```
/// use std::sync::atomic::{AtomicU64, Ordering};
/// use sph_host::progress::Progress;
///
/// #[derive(Default)]
/// struct Counter(AtomicU64);
/// impl Progress for Counter {
///     fn begin(&self, _: u64, done: u64) {
///         self.0.store(done, Ordering::Relaxed);
///     }
///     fn advance(&self, items: u64) {
///         self.0.fetch_add(items, Ordering::Relaxed);
///     }
/// }
/// let counter = Counter::default();
/// counter.begin(10, 4);
/// counter.advance(2);
/// assert_eq!(counter.0.load(Ordering::Relaxed), 6);
/// ```
pub trait Progress: Sync {
    /// There are `total` items, of which `done` were done before.
    fn begin(&self, total: u64, done: u64);

    /// So many more are done; called from any thread.
    fn advance(&self, items: u64);

    /// There is nothing left to do.
    fn end(&self) {}

    /// Something that the one who waits should know: a sentence without its full stop.
    fn note(&self, _: &str) {}
}

impl Progress for () {
    fn begin(&self, _: u64, _: u64) {}

    fn advance(&self, _: u64) {}
}

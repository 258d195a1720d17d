//! Work spread over rayon's threads, for code that is compiled once for each scalar, dimension and kernel.
//!
//! A parallel iterator of rayon's takes longer to compile than most loops here. These functions share one such iterator, in
//! `each`, so that generic code compiles in a fraction of the time. Code that is compiled a few times uses rayon itself.

use std::sync::Mutex;

use rayon::prelude::*;

/// Items that a thread takes at a time in [`fill`].
const CHUNK: usize = 256;

/// More threads than this help nobody and take long to start.
const MOST_THREADS: usize = 256;

/// So many threads, or one for each core, each of which begins with `start`.
pub(crate) fn pool(
    threads: Option<usize>,
    start: impl Fn() + Send + Sync + 'static,
) -> Result<rayon::ThreadPool, String> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, |all| all.min(MOST_THREADS)));
    builder.start_handler(move |_| start()).build().map_err(|error| error.to_string())
}

/// Calls f(0), f(1) … f(count − 1), in any order and on any thread.
fn each(count: usize, f: &(dyn Fn(usize) + Sync)) {
    (0..count).into_par_iter().for_each(f);
}

/// Locks a mutex, poisoned or not: a thread that panicked ends the whole run anyway.
fn within<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Hands each piece of work to a thread, with its number. Returns the results in order.
pub(crate) fn map<W: Send, R: Send>(
    work: impl Iterator<Item = W>,
    f: impl Fn(usize, W) -> R + Sync,
) -> Vec<R> {
    let slots: Vec<_> = work.map(|piece| Mutex::new((Some(piece), None))).collect();
    each(slots.len(), &|number| {
        let mut slot = within(&slots[number]);
        slot.1 = slot.0.take().map(|piece| f(number, piece));
    });
    let result = |slot: Mutex<(Option<W>, Option<R>)>| {
        slot.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).1
    };
    slots.into_iter().filter_map(result).collect()
}

/// Hands each piece of work to a thread, with its number.
pub(crate) fn for_each<W: Send>(work: impl Iterator<Item = W>, f: impl Fn(usize, W) + Sync) {
    let slots: Vec<_> = work.map(|piece| Mutex::new(Some(piece))).collect();
    each(slots.len(), &|number| {
        let piece = within(&slots[number]).take();
        piece.into_iter().for_each(|piece| f(number, piece));
    });
}

/// As [`for_each`], with memory that later pieces of work use again.
pub(crate) fn for_each_with<W: Send, M: Default + Send>(
    work: impl Iterator<Item = W>,
    f: impl Fn(&mut M, usize, W) + Sync,
) {
    let left = Mutex::new(Vec::new());
    for_each(work, |number, piece| {
        let mut memory = within(&left).pop().unwrap_or_default();
        f(&mut memory, number, piece);
        within(&left).push(memory);
    });
}

/// out[i] = f(i)
pub(crate) fn fill<T: Send>(out: &mut [T], f: impl Fn(usize) -> T + Sync) {
    for_each(out.chunks_mut(CHUNK), |number, chunk| {
        for (offset, slot) in chunk.iter_mut().enumerate() {
            *slot = f(number * CHUNK + offset);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_done_once_and_results_keep_their_order() {
        let mut numbers = vec![0_usize; 3 * CHUNK + 7];
        fill(&mut numbers, |i| i * i);
        assert!(numbers.iter().enumerate().all(|(i, &n)| n == i * i));
        for_each(numbers.chunks_mut(10), |number, chunk| chunk.iter_mut().for_each(|n| *n += number));
        assert!(numbers.iter().enumerate().all(|(i, &n)| n == i * i + i / 10));
        let sums = map(numbers.chunks(100), |number, chunk| (number, chunk.iter().sum::<usize>()));
        assert!(sums.iter().enumerate().all(|(i, sum)| sum.0 == i));
        assert_eq!(sums.iter().map(|sum| sum.1).sum::<usize>(), numbers.iter().sum::<usize>());
        assert!(map(std::iter::empty::<u8>(), |_, _| ()).is_empty());
        let done = Mutex::new(0);
        for_each_with(0..50, |memory: &mut Vec<usize>, number, piece| {
            assert_eq!(number, piece);
            memory.push(piece);
            *within(&done) += 1;
        });
        assert_eq!(*within(&done), 50);
    }
}

//! The records of the thread that is watched.

use std::cell::{Cell, RefCell};
use std::collections::{HashMap, HashSet};
use std::mem::ManuallyDrop;
use std::panic::Location;

use super::log::Log;
use super::place::{Operation, Place};
use super::record::Record;

/// Places that are found without a search; a power of two.
const CACHED: usize = 1024;
/// Slots in which such a place may be.
const TRIED: usize = 8;

/// Everything that happened since the watch began.
pub(super) struct Recorder {
    /// Keys of places, and the numbers of their records; a key of 0 is none.
    cache: Box<[(usize, u32); CACHED]>,
    numbers: HashMap<usize, u32>,
    pub(super) records: Vec<Record>,
    /// The number of the last saturation before the watch.
    first: u32,
    consequential: HashSet<u32>,
}

thread_local! {
    // a value that is not dropped with its thread is reached without asking whether it was
    static RECORDER: RefCell<ManuallyDrop<Option<Box<Recorder>>>> = const { RefCell::new(ManuallyDrop::new(None)) };
    /// Saturations of this thread so far.
    static EVENTS: Cell<u32> = const { Cell::new(0) };
}

impl Recorder {
    fn new() -> Self {
        Self {
            cache: Box::new([(0, 0); CACHED]),
            numbers: HashMap::new(),
            records: Vec::new(),
            first: EVENTS.get(),
            consequential: HashSet::new(),
        }
    }

    /// The number of the record of a place.
    #[inline]
    pub(super) fn number(&mut self, location: &'static Location<'static>, operation: Operation) -> u32 {
        let address = std::ptr::from_ref(location) as usize;
        // a location's address is a multiple of 8, and there are fewer than 16 operations
        let key = address.wrapping_mul(2).wrapping_add(operation as usize);
        let first = (address / 8).wrapping_mul(13).wrapping_add(operation as usize);
        for slot in first..first.wrapping_add(TRIED) {
            let (known, number) = self.cache[slot % CACHED];
            if known == key {
                return number;
            }
            if known == 0 {
                return self.searched(key, slot % CACHED, Place::new(location, operation));
            }
        }
        self.searched(key, first % CACHED, Place::new(location, operation))
    }

    /// The number of the record of a place that is not where it is found without a search.
    #[cold]
    fn searched(&mut self, key: usize, slot: usize, place: Place) -> u32 {
        let records = &mut self.records;
        let number = *self.numbers.entry(key).or_insert_with(|| {
            records.push(Record::new(place));
            records.len() as u32 - 1
        });
        self.cache[slot] = (key, number);
        number
    }

    /// Counts a saturation at a place.
    pub(super) fn saturated(&mut self, number: u32) -> Event {
        self.records[number as usize].saturated += 1;
        let event = EVENTS.get().saturating_add(1);
        EVENTS.set(event);
        Event { number: event, place: number }
    }

    /// Says that a saturation changed something.
    fn consequence(&mut self, event: Event) {
        // a number of an earlier watch may still be about
        if event.number > self.first && self.consequential.insert(event.number) {
            self.records[event.place as usize].consequential += 1;
        }
    }
}

/// One saturation; none where its number is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Event {
    number: u32,
    place: u32,
}

impl Event {
    pub(super) const NONE: Self = Self { number: 0, place: 0 };

    #[inline(always)]
    pub(super) fn is_some(self) -> bool {
        self.number != 0
    }

    /// Says that this saturation changed something.
    pub(super) fn has_consequence(self) {
        if self.is_some() {
            record(|recorder| recorder.consequence(self));
        }
    }
}

/// Tells the recorder of this thread, if it is watched.
#[inline]
pub(super) fn record<R>(tell: impl FnOnce(&mut Recorder) -> R) -> Option<R> {
    RECORDER.with_borrow_mut(|recorder| recorder.as_deref_mut().map(tell))
}

/// Puts a recorder in the place of another, which it returns.
fn replace(recorder: Option<Box<Recorder>>) -> Option<Box<Recorder>> {
    ManuallyDrop::into_inner(RECORDER.replace(ManuallyDrop::new(recorder)))
}

/// Does some work and keeps a log of what happens in it on this thread to numbers that watch. Returns what the work returns, and
/// the log. A watch in a watch has its own log, of which the outer one does not know.
///
/// ```
/// use sph_core::Scalar;
/// use sph_core::scalar::fixed::{I4F12, Saturating};
/// use sph_lab::{Tally, watch};
///
/// // generic code, as a firmware has it
/// fn energy<T: Scalar>(speed: T) -> T {
///     speed * speed * T::ratio(1, 2)
/// }
///
/// type Real = Tally<Saturating<I4F12>>;
/// let (result, log) = watch(|| energy(Real::from_f64(3.0)).to_f64());
/// assert_eq!(log.saturations().consequential(), 1); // 9 is beyond 8
/// assert_eq!(result, 4.0, "where 4.5 is right");
/// ```
pub fn watch<R>(work: impl FnOnce() -> R) -> (R, Log) {
    struct Restore(Option<Box<Recorder>>);
    impl Drop for Restore {
        fn drop(&mut self) {
            replace(self.0.take());
        }
    }
    let before = Restore(replace(Some(Box::new(Recorder::new()))));
    let result = work();
    let records = replace(None).map_or_else(Vec::new, |recorder| recorder.records);
    drop(before);
    (result, Log::new(records))
}

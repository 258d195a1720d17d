//! The pictures of a run: drawn on threads of their own beside the steps, and joined to an animation at the end.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;
use std::sync::mpsc::sync_channel;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use rayon::prelude::*;

use super::case::CaseName;
use super::case_run::CaseRun;
use super::definition::Case;
use super::error::Error;
use super::folder::{RunFolder, failed, target, write_png};
use super::frame;
use super::resume::is_whole_picture;
use super::series::{ROWS_A_FRAME, time_of_row};
use crate::engine::Snapshot;
use crate::picture::animation::{Animation, EncodedFrame};
use crate::picture::{Image, plot};

/// How long a picture of the animation stays.
const DELAY: Duration = Duration::from_millis(60);

/// Frames of the animation that each thread encodes before they are written.
const FRAMES_A_THREAD: usize = 4;

/// Draws the pictures of one run.
pub(super) struct Gallery<'a, const D: usize> {
    pub(super) case: &'a dyn Case<D>,
    pub(super) name: CaseName,
    pub(super) folder: &'a RunFolder,
    /// Seconds from frame to frame.
    pub(super) every: f64,
}

/// Takes the number of a frame and the fluid in it, to draw its picture now or later.
pub(super) type Draw<'a, const D: usize> = dyn Fn(u64, &Snapshot<D>) -> Result<(), Error> + 'a;

impl<const D: usize> Gallery<'_, D> {
    /// Does the work of a run. The pictures that it asks for are drawn by one thread fewer than there are for the steps; when these
    /// are all busy, by the thread that asks. All are written at the end, whether the work succeeds or not.
    pub(super) fn draw_beside<R>(&self, work: impl FnOnce(&Draw<D>) -> Result<R, Error>) -> Result<R, Error> {
        let threads = rayon::current_num_threads() - 1;
        let (queue, frames) = sync_channel::<(u64, Snapshot<D>)>(threads);
        let frames = Mutex::new(frames);
        let refused = Mutex::new(None);
        let refusal = || lock(&refused).take().map_or(Ok(()), Err);
        let draw_all = || {
            // The lock is held until a frame comes, not while it is drawn.
            while let Ok((number, now)) = { lock(&frames).recv() } {
                if let Err(error) = self.draw(number, &now) {
                    *lock(&refused) = Some(error);
                    break;
                }
            }
        };
        let done = thread::scope(|scope| {
            for _ in 0..threads {
                // Where the system has no thread to give, the others draw more.
                let _ = thread::Builder::new().spawn_scoped(scope, draw_all);
            }
            let done = work(&|number, now| {
                refusal()?;
                match queue.try_send((number, now.clone())) {
                    Ok(()) => Ok(()),
                    Err(_) => self.draw(number, now).map(drop),
                }
            });
            drop(queue);
            done
        })?;
        refusal().map(|()| done)
    }

    /// Draws the picture of a frame and writes it.
    fn draw(&self, number: u64, now: &Snapshot<D>) -> Result<Image, Error> {
        let title = format!("{}, t = {:.4} s", self.name, now.time);
        let image = self.case.picture(now, &title)?;
        write_png(&image, self.folder.picture(number))?;
        Ok(image)
    }

    /// Draws the plot against the reference and writes it.
    pub(super) fn write_plot(&self, run: &CaseRun<D>, last: &Snapshot<D>) -> Result<(), Error> {
        let (particles, method) = (last.positions.len(), run.method);
        let (kernel, scalar) = (method.kernel.name(), method.scalar.name());
        let caption = format!("{}: {particles} particles, {kernel}, {scalar}", self.name);
        let image = plot::draw(&caption, &self.case.plots(&run.results(last)))?;
        write_png(&image, self.folder.plot(self.name))
    }

    /// Joins the pictures of all frames to an animation. One that is missing or damaged is drawn again from its frame; `last` is
    /// the newest frame.
    pub(super) fn write_animation(&self, frames: u64, last: &Snapshot<D>) -> Result<(), Error> {
        let image = |number: u64| match read_png(&self.folder.picture(number)) {
            Ok(image) if is_whole_picture(&self.folder.picture(number)) => Ok(image),
            _ if number + 1 == frames => self.draw(number, last),
            _ => {
                let time = time_of_row(self.every, number * ROWS_A_FRAME);
                self.draw(number, &frame::restore(&self.folder.frame(number), time)?)
            }
        };
        let first = image(0)?;
        let threads = rayon::current_num_threads();
        let numbers: Vec<u64> = (0..frames).collect();
        let mut refused = None;
        let written = target(self.folder.animation()).create(|file| {
            let mut animation = Animation::begin(file, first.width, first.height, DELAY)?;
            for part in numbers.chunks(FRAMES_A_THREAD * threads) {
                let images: Result<Vec<io::Result<EncodedFrame>>, Error> =
                    part.par_iter().map(|&number| Ok(EncodedFrame::of(&image(number)?))).collect();
                let images = images.map_err(|error| {
                    let message = error.to_string();
                    refused = Some(error);
                    io::Error::other(message)
                })?;
                images.into_iter().try_for_each(|frame| animation.push_encoded(frame?))?;
            }
            animation.finish().map(drop)
        });
        match refused {
            Some(error) => Err(error),
            None => Ok(written?),
        }
    }
}

/// The lock; what a thread that panicked has left is as good as any.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A picture back from its file.
fn read_png(path: &Path) -> Result<Image, Error> {
    let file = File::open(path).map_err(failed(path))?;
    let damaged = |error: png::DecodingError| failed(path)(io::Error::other(error));
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(damaged)?;
    let (width, height) = (reader.info().width, reader.info().height);
    let mut rgb = vec![0; reader.output_buffer_size().unwrap_or(0)];
    reader.next_frame(&mut rgb).map_err(damaged)?;
    if rgb.len() as u64 != 3 * u64::from(width) * u64::from(height) {
        return Err(failed(path)(io::Error::other("not a picture of this run")));
    }
    Ok(Image { width, height, rgb })
}

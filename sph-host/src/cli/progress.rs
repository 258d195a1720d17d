//! A progress bar on stderr.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::progress::Progress;

/// A bar; indicatif draws nothing where stderr is no terminal.
pub(super) struct Bar(ProgressBar);

impl Bar {
    /// With what indicatif's template says; hidden if `quiet`.
    pub(super) fn new(quiet: bool, template: &str) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(None, target);
        Self(match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        })
    }
}

impl Progress for Bar {
    fn begin(&self, total: u64, done: u64) {
        self.0.set_length(total);
        self.0.set_position(done);
        self.0.reset_eta();
    }

    fn advance(&self, items: u64) {
        self.0.inc(items);
    }

    fn end(&self) {
        self.0.finish_and_clear();
    }

    fn note(&self, note: &str) {
        self.0.suspend(|| super::say(&format!("note: {note}")));
    }
}

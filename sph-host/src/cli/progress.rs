//! A progress bar on stderr.

use std::fmt::Write;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::progress::Progress;

/// A bar; indicatif draws nothing where stderr is no terminal.
pub(super) struct Bar(ProgressBar);

impl Bar {
    /// With what indicatif's template says, and `{left}` for the time left; hidden if `quiet`.
    pub(super) fn new(quiet: bool, template: &str) -> Self {
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(None, target);
        Self(match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style.with_key("left", left)),
            Err(_) => bar,
        })
    }
}

/// The time left, once something is known of it.
fn left(state: &ProgressState, out: &mut dyn Write) {
    // a bar that cannot be written is nobody's fault
    let _ = match state.eta() {
        eta if eta.is_zero() => out.write_str("time left not known yet"),
        eta => write!(out, "{:#} left", HumanDuration(eta)),
    };
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

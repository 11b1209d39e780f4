//! A progress bar for work above a second, on a terminal only.

use foliar_bake::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Work shorter than this needs no bar.
const PATIENCE: Duration = Duration::from_secs(1);

/// One bar; it goes away when dropped.
pub struct Bar {
    bar: ProgressBar,
    start: Instant,
    draws: bool,
    shown: AtomicBool,
}

impl Bar {
    /// A bar that is drawn once the work has lasted a second, where it may be drawn at all.
    pub fn new(draws: bool) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {percent} % {eta}") {
            bar.set_style(style);
        }
        Bar { bar, start: Instant::now(), draws, shown: AtomicBool::new(false) }
    }
}

impl Progress for Bar {
    fn step(&self, stage: &str, done: u64, total: u64) {
        if !self.draws || self.start.elapsed() < PATIENCE {
            return;
        }
        if !self.shown.swap(true, Ordering::Relaxed) {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
        self.bar.set_message(stage.to_owned());
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

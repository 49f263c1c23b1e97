//! Messages of the compute child to the server, with estimates of its progress.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeValLike;

use crate::maps::{IterationFiles, Maps};
use unwrapd_api::{Message, Progress};
use unwrapd_layout::charts::MapUnderway;
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{self as pipeline, Observer};

/// Minimum time between two reports of one stage. Forty reports per second look continuous; each wakes the server.
const TELL_INTERVAL: Duration = Duration::from_millis(25);

/// Silence after which an estimate is sent, so that clients see progress at least once a second.
const SILENCE: Duration = Duration::from_millis(500);

/// Reports progress to the server, and the elapsed time to the pipeline.
pub(crate) struct Reporter {
    start: Instant,
    finish: Arc<AtomicBool>,
    sent: Arc<Mutex<SentProgress>>,
    frames: Mutex<IterationFiles>,
    maps: Arc<Maps>,
}

/// Last progress sent, and the time at which it moved.
#[derive(Default)]
struct SentProgress {
    progress: Progress,
    at: Duration,
    estimator: Estimator,
}

impl Reporter {
    /// Reports that the child is ready, and starts the thread that sends estimates.
    pub(crate) fn start(
        finish: Arc<AtomicBool>,
        frames: IterationFiles,
        maps: Arc<Maps>,
    ) -> std::io::Result<Self> {
        Message::Ready.tell();
        let reporter = Self {
            start: Instant::now(),
            finish,
            sent: Arc::default(),
            frames: Mutex::new(frames),
            maps,
        };
        let (start, sent) = (reporter.start, Arc::clone(&reporter.sent));
        let maps = Arc::clone(&reporter.maps);
        std::thread::Builder::new().spawn(move || {
            loop {
                std::thread::sleep(SILENCE);
                lock(&sent).estimate(start.elapsed());
                maps.flush();
            }
        })?;
        Ok(reporter)
    }

    /// Reports the processor time used so far.
    pub(crate) fn tell_cpu() {
        if let Ok(usage) = getrusage(UsageWho::RUSAGE_SELF) {
            let times = [usage.user_time(), usage.system_time()];
            let ms = times.map(|time| time.num_milliseconds());
            Message::Cpu(ms.iter().sum::<i64>().max(0) as u64).tell();
        }
    }

    /// Returns the frames that were written.
    pub(crate) fn into_frames(self) -> IterationFiles {
        let frames = self.frames.into_inner();
        frames.unwrap_or_else(PoisonError::into_inner)
    }
}

impl SentProgress {
    /// Sends a report, unless one of its stage was just sent. A report without progress is replaced by an estimate if
    /// one is due.
    fn report(&mut self, progress: Progress, now: Duration) {
        let begins = self.progress.stage != progress.stage;
        if !begins && now < self.at + TELL_INTERVAL {
            return;
        }
        let shown = self.progress.fraction;
        let fraction = self.estimator.reported(progress.fraction, now);
        self.progress = progress;
        if begins || shown < fraction {
            self.tell(fraction, now);
        } else {
            self.progress.fraction = shown;
            self.estimate(now);
        }
    }

    /// Sends an estimate if there was no progress for a while.
    fn estimate(&mut self, now: Duration) {
        if self.progress.stage.is_some() && self.at + SILENCE <= now {
            let fraction = self.estimator.estimated(now);
            self.tell(fraction, now);
        }
    }

    fn tell(&mut self, fraction: f64, now: Duration) {
        (self.progress.fraction, self.at) = (fraction, now);
        Message::Progress(self.progress).tell();
    }
}

impl Observer for Reporter {
    fn progress(&self, progress: &pipeline::Progress) -> Control {
        // Flat charts are laid out without an iteration, so they have no energy and no smallest face.
        let has_iterate = (progress.iteration, progress.energy, progress.smallest) != (0, 0.0, 0.0);
        let progress = Progress {
            stage: Some(progress.stage),
            fraction: progress.fraction,
            chart: progress.chart as u64,
            charts: progress.charts as u64,
            iteration: progress.iteration as u64,
            energy: Some(progress.energy).filter(|e| has_iterate && e.is_finite()),
            smallest: Some(progress.smallest).filter(|s| has_iterate && s.is_finite()),
        };
        lock(&self.sent).report(progress, self.start.elapsed());
        if self.finish.load(Ordering::Relaxed) {
            Control::Finish
        } else {
            Control::Continue
        }
    }

    fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    fn map(&self, surface: usize, map: &MapUnderway) {
        self.maps.take(surface, map);
    }

    fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        lock(&self.frames).add(number, file);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

// Estimated progress between two reports.

/// Fraction of the speed so far at which the estimate advances between reports, so that a report rarely finds it
/// ahead. A larger fraction overtakes the next report more often, a smaller one lags further behind.
const SPEED_SHARE: f64 = 0.5;

/// Maximum lead of the estimate over the last report. A larger lead shows progress for longer without a report, but
/// stands still for longer if it was wrong.
const MOST_AHEAD: f64 = 0.05;

/// Highest share that the estimate reaches by speed alone: only a report may say that the work is done.
const MOST: f64 = 0.99;

/// Minimum gain of every estimate, as a fraction of the remaining work. It keeps the displayed share moving in a long
/// silence: at two estimates per second, it takes a tenth of the rest in about 50 s.
const LEAST_GAIN: f64 = 1e-3;

/// Share of the work that is done: reported, or estimated from the speed so far. It never falls, and every estimate
/// exceeds the previous one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Estimator {
    reported: f64,
    at: Duration,
    shown: f64,
}

impl Estimator {
    /// Returns the share after a report, at a time since the work began. A report that repeats the last one counts as
    /// silence.
    pub fn reported(&mut self, share: f64, now: Duration) -> f64 {
        if self.reported < share {
            (self.reported, self.at) = (share, now);
        }
        self.shown = self.shown.max(share);
        self.shown
    }

    /// Returns the estimated share without a new report.
    pub fn estimated(&mut self, now: Duration) -> f64 {
        let speed = self.reported / self.at.as_secs_f64().max(f64::MIN_POSITIVE);
        let silence = now.saturating_sub(self.at).as_secs_f64();
        let ahead = (SPEED_SHARE * speed * silence).min(MOST_AHEAD);
        let least = self.shown + LEAST_GAIN * (1.0 - self.shown);
        self.shown = least.max((self.reported + ahead).min(MOST));
        self.shown
    }
}

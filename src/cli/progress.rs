//! Progress of a command on standard error: a bar on a terminal, otherwise plain lines.

use std::io::{IsTerminal, stderr};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console::{CommandFailure, warn_of};
use super::files::{Talk, write_whole};
use unwrapd_files::document::Warning;
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{Observer, Progress, Stage};

/// Number of steps of the bar: ten per displayed percent.
const STEPS: u64 = 1000;

/// Shows progress, provides the time, and writes frames.
pub(super) struct Display {
    begin: Instant,
    is_shown: bool,
    bar: Option<ProgressBar>,
    last_stage: Mutex<Option<Stage>>,
    told: Mutex<Vec<Warning>>,
    frames: Option<FrameFiles>,
}

/// Settings for a file per iteration.
struct FrameFiles {
    folder: PathBuf,
    extension: String,
    failure: Mutex<Option<CommandFailure>>,
}

impl Display {
    pub(super) fn new(talk: &Talk) -> Self {
        let is_shown = !talk.quiet;
        let bar = (is_shown && stderr().is_terminal()).then(|| {
            let bar =
                ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
            let style = ProgressStyle::with_template("{bar:30} {percent:>3} % {elapsed:>4} {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self {
            begin: Instant::now(),
            is_shown,
            bar,
            last_stage: Mutex::new(None),
            told: Mutex::default(),
            frames: None,
        }
    }

    /// Creates a display that also writes every map into a folder.
    pub(super) fn with_frames(talk: &Talk, folder: PathBuf, extension: String) -> Self {
        let failure = Mutex::new(None);
        Self {
            frames: Some(FrameFiles {
                folder,
                extension,
                failure,
            }),
            ..Self::new(talk)
        }
    }

    /// Removes the bar. Returns the warnings that were printed during the work; fails if a frame could not be written.
    pub(super) fn finish(self) -> Result<Vec<Warning>, CommandFailure> {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        let failure = self.frames.and_then(|frames| {
            let failure = frames.failure.into_inner();
            failure.unwrap_or_else(PoisonError::into_inner)
        });
        let told = self.told.into_inner();
        let told = told.unwrap_or_else(PoisonError::into_inner);
        failure.map_or(Ok(told), Err)
    }

    fn has_failed(&self) -> bool {
        let failure = self.frames.as_ref().map(|frames| frames.failure.lock());
        failure.is_some_and(|failure| failure.unwrap_or_else(PoisonError::into_inner).is_some())
    }

    fn line(&self, progress: &Progress) {
        let mut last = self
            .last_stage
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        if last.replace(progress.stage) != Some(progress.stage) {
            eprintln!(
                "{:7.2} s  {}",
                self.begin.elapsed().as_secs_f64(),
                stage_text(progress)
            );
        }
    }
}

impl Observer for Display {
    fn progress(&self, progress: &Progress) -> Control {
        match &self.bar {
            Some(bar) => {
                bar.set_position((progress.fraction * STEPS as f64) as u64);
                bar.set_message(stage_text(progress));
            }
            None if self.is_shown => self.line(progress),
            None => {}
        }
        if self.has_failed() {
            Control::Finish
        } else {
            Control::Continue
        }
    }

    fn warning(&self, warning: &Warning) {
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        told.push(warning.clone());
        match &self.bar {
            Some(bar) => bar.suspend(|| warn_of(&warning.message)),
            None => warn_of(&warning.message),
        }
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }

    fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        if let Some(frames) = &self.frames {
            let name = format!("{number:05}.{}", frames.extension);
            let written = write_whole(&frames.folder.join(name), &file());
            let mut failure = frames
                .failure
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            *failure = failure.take().or(written.err());
        }
    }
}

fn stage_text(progress: &Progress) -> String {
    match progress.stage {
        Stage::Read => "read".into(),
        Stage::Cut => "cut".into(),
        Stage::Map if progress.chart == 0 && progress.iteration == 0 => match progress.charts {
            0 => "map".into(),
            charts => format!("map {charts} charts"),
        },
        Stage::Map if progress.charts == 0 => format!(
            "map, iteration {}, energy {:.6}",
            progress.iteration, progress.energy
        ),
        Stage::Map => format!(
            "map chart {} of {}, iteration {}, energy {:.6}",
            (progress.chart + 1).min(progress.charts),
            progress.charts,
            progress.iteration,
            progress.energy
        ),
        Stage::Deform => format!(
            "pull, iteration {}, energy {:.6}",
            progress.iteration, progress.energy
        ),
        // Packing may cut charts further, so their number is known only at its end.
        Stage::Pack => "pack the charts".into(),
        Stage::Bake => "resample the textures".into(),
        Stage::Write => "write".into(),
        Stage::Judge => "judge the written bytes".into(),
    }
}

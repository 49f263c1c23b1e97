//! Progress of a command: a bar on a terminal, plain lines otherwise, both on standard error.

use std::io::{IsTerminal, stderr};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::pipeline::{Observer, Progress, Stage};
use crate::solver::Control;

/// Steps of the bar.
const STEPS: u64 = 1000;

/// Shows progress and tells the time.
pub(super) struct Display {
    begin: Instant,
    bar: Option<ProgressBar>,
    last_stage: Mutex<Option<Stage>>,
}

impl Display {
    pub(super) fn new() -> Self {
        let bar = stderr().is_terminal().then(|| {
            let bar =
                ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
            let style = ProgressStyle::with_template("{bar:30} {percent:>3} % {elapsed:>4} {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self {
            begin: Instant::now(),
            bar,
            last_stage: Mutex::new(None),
        }
    }

    pub(super) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn line(&self, progress: &Progress) {
        let mut last = self
            .last_stage
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
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
            None => self.line(progress),
        }
        Control::Continue
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}

fn stage_text(progress: &Progress) -> String {
    match progress.stage {
        Stage::Read => "read".into(),
        Stage::Cut => "cut".into(),
        Stage::Map if progress.chart == 0 && progress.iteration == 0 => {
            format!("map {} charts", progress.charts)
        }
        Stage::Map => format!(
            "map chart {} of {}, iteration {}, energy {:.6}",
            (progress.chart + 1).min(progress.charts),
            progress.charts,
            progress.iteration,
            progress.energy
        ),
        Stage::Pack => format!("pack {} charts", progress.charts),
        Stage::Write => "write".into(),
        Stage::Judge => "judge the written bytes".into(),
    }
}

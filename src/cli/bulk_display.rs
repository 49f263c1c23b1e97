//! Progress over many files on standard error: a bar on a terminal, otherwise a line per asset.

use std::io::{IsTerminal, stderr};
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console::{one_line, say};
use crate::bulk::{Fate, Figures, Row, Status, Totals};
use unwrapd_server::jobs::Gates;

/// Display of a run's progress.
pub(super) struct BulkDisplay<'a> {
    gates: &'a Gates,
    n_assets: usize,
    n_kept: usize,
    n_done: usize,
    /// Number of outputs of this run.
    n_made: usize,
    begin: Instant,
    bar: Option<ProgressBar>,
    is_quiet: bool,
}

impl<'a> BulkDisplay<'a> {
    pub(super) fn new(n_assets: usize, gates: &'a Gates, is_quiet: bool) -> Self {
        let bar = (!is_quiet && stderr().is_terminal()).then(|| {
            let target = ProgressDrawTarget::stderr_with_hz(10);
            let bar = ProgressBar::with_draw_target(Some(n_assets as u64), target);
            let style = "{bar:30} {pos} of {len} {elapsed} left {eta} {msg}";
            let style = ProgressStyle::with_template(style);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self {
            gates,
            n_assets,
            n_kept: 0,
            n_done: 0,
            n_made: 0,
            begin: Instant::now(),
            bar,
            is_quiet,
        }
    }

    /// Shows a finished asset.
    pub(super) fn see(&mut self, row: &Row, fate: Fate) {
        // Count the asset.
        match fate {
            Fate::Kept => self.n_kept += 1,
            Fate::Done => self.n_done += 1,
        }
        self.n_made += usize::from(fate == Fate::Done && matches!(row.status, Status::Written(_)));
        // Print a line: on a terminal only for rejected assets, since the bar shows the others.
        let is_accepted = row.is_accepted(self.gates);
        let is_told = match fate {
            Fate::Kept => false,
            Fate::Done => !is_accepted || (self.bar.is_none() && !self.is_quiet),
        };
        let number = self.n_kept + self.n_done;
        if is_told {
            let mark = if is_accepted { "" } else { ", not accepted" };
            let text = format!(
                "{number} of {}  {}{mark}",
                self.n_assets,
                one_line(&text_of(row))
            );
            match &self.bar {
                Some(bar) => bar.println(text),
                None => eprintln!("{text}"),
            }
        }
        if let Some(bar) = &self.bar {
            bar.set_position(number as u64);
        }
    }

    /// Removes the bar and prints the totals.
    pub(super) fn finish(self, totals: &Totals) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
        let hours = self.begin.elapsed().as_secs_f64() / 3600.0;
        let speed = match self.n_made {
            0 => String::new(),
            made => format!(", {:.0} an hour", made as f64 / hours),
        };
        say(format_args!(
            "{} assets: {} written, {} failed, {} missing, {} accepted; {} done now, {} before{speed}",
            totals.assets,
            totals.written,
            totals.failed,
            totals.missing,
            totals.accepted,
            self.n_done,
            self.n_kept
        ));
    }
}

fn text_of(row: &Row) -> String {
    let name = &row.input;
    match &row.status {
        Status::Written(Figures {
            certified, charts, ..
        }) => {
            let verdict = if *certified {
                "certified"
            } else {
                "not certified"
            };
            format!("{name}: {charts} charts, {verdict}, {:.2} s", row.seconds)
        }
        Status::Failed { code, detail } => format!("{name}: {detail} ({code})"),
        Status::Missing => format!("{name}: missing"),
    }
}

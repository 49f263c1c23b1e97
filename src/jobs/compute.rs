//! The compute child: one attempt at one job, in its own process.
//!
//! It reads the attempt's folder, limits its own memory, tells its progress on standard output and leaves its results
//! in the folder. SIGTERM ends it as it ends any process; SIGINT has it finish early with the present valid map; when
//! its standard input closes, the server is gone, and so is it.

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use nix::sys::resource::{Resource, setrlimit};
use nix::sys::signal::{SigSet, Signal};

use super::checksum::sha256;
use super::frames::Frames;
use super::input_output::OutputFile;
use super::job::Failure;
use super::progress::Progress;
use super::store_error::StoreError;
use super::task::{self, ERROR, Message, NO_SPACE, OUTCOME, Outcome, TASK, Task};
use super::work::Work;
use crate::document::Upload;
use crate::pipeline::{self, Observer, PipelineError, Stage};
use crate::solver::Control;

/// At most so often progress is told within a stage.
const TELL_INTERVAL: Duration = Duration::from_millis(25);

/// Runs the job in `folder` and returns the exit code of the process: 0 with results written, else that of the error.
pub fn run(folder: &Path) -> ExitCode {
    match attempt(folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err((exit_code, failure)) => {
            eprintln!("{}: {}", failure.code, failure.detail);
            match task::write_json(folder, ERROR, &failure) {
                Ok(()) => ExitCode::from(exit_code),
                Err(error) => ExitCode::from(unwritten(error).0),
            }
        }
    }
}

type Attempt<T> = Result<T, (u8, Failure)>;

fn attempt(folder: &Path) -> Attempt<()> {
    let finish = Arc::new(AtomicBool::new(false));
    listen(&finish).map_err(internal)?;
    let task: Task = task::read_json(folder, TASK).map_err(internal)?;
    setrlimit(Resource::RLIMIT_DATA, task.memory, task.memory).map_err(internal)?;
    // A crash is reported by its signal; an image of the memory would only fill the disk.
    setrlimit(Resource::RLIMIT_CORE, 0, 0).map_err(internal)?;
    let reporter = Reporter {
        start: Instant::now(),
        finish,
        told: Mutex::new(None),
        frames: Mutex::new(Frames::new(folder)),
    };
    tell(&Message::Ready);
    let upload = read_upload(folder, &task.input).map_err(internal)?;
    let work = Work::new(task.kind, task.options).map_err(|e| refusal(&e))?;
    let made = work
        .run(&upload, task.limits, &reporter)
        .map_err(|e| refusal(&e))?;
    let mut output = Vec::new();
    for (index, (role, name, bytes)) in made.files.into_iter().enumerate() {
        std::fs::write(folder.join(task::output_file(index)), &bytes).map_err(unwritten)?;
        output.push(OutputFile {
            role,
            name,
            bytes: bytes.len() as u64,
            sha256: Some(sha256(&bytes)),
        });
    }
    let frames = reporter.frames.into_inner();
    let frames = frames.unwrap_or_else(PoisonError::into_inner);
    frames.into_output(&mut output).map_err(unwritten)?;
    let verdict = made.verdict;
    task::write_json(folder, OUTCOME, &Outcome { output, verdict }).map_err(unwritten)
}

/// Starts the threads that hear the end of standard input and SIGINT. Called before any other thread exists, since a
/// thread inherits which signals are blocked.
fn listen(finish: &Arc<AtomicBool>) -> std::io::Result<()> {
    let mut signals = SigSet::empty();
    signals.add(Signal::SIGINT);
    signals.thread_block()?;
    let finish = Arc::clone(finish);
    std::thread::Builder::new().spawn(move || {
        while signals.wait().is_ok() {
            finish.store(true, Ordering::Relaxed);
        }
    })?;
    std::thread::Builder::new().spawn(|| {
        let mut byte = [0];
        while matches!(std::io::stdin().read(&mut byte), Ok(1..)) {}
        std::process::exit(1);
    })?;
    Ok(())
}

fn read_upload(folder: &Path, names: &[String]) -> std::io::Result<Upload> {
    let mut files = Vec::new();
    for (index, name) in names.iter().enumerate() {
        files.push((
            name.clone(),
            std::fs::read(folder.join(task::input_file(index)))?,
        ));
    }
    let (name, bytes) = files.remove(0);
    let resources: BTreeMap<_, _> = files.into_iter().collect();
    Ok(Upload {
        name,
        bytes,
        resources,
    })
}

fn refusal(error: &PipelineError) -> (u8, Failure) {
    (
        error.exit_code(),
        Failure::new(error.code(), error.to_string()),
    )
}

/// A file could not be written.
fn unwritten(error: std::io::Error) -> (u8, Failure) {
    match StoreError::from(error) {
        error @ StoreError::Full(_) => {
            let failure = Failure::new("storage_full", error.to_string());
            (NO_SPACE as u8, failure)
        }
        error => internal(error),
    }
}

fn internal(error: impl std::fmt::Display) -> (u8, Failure) {
    (1, Failure::new("internal_error", error.to_string()))
}

/// Tells the server how far it is, and the pipeline how late it is.
struct Reporter {
    start: Instant,
    finish: Arc<AtomicBool>,
    /// When something was told last, and of which stage.
    told: Mutex<Option<(Instant, Stage)>>,
    frames: Mutex<Frames>,
}

/// Writes one line to the server. Nobody listens any more if this fails: there is no reason to go on.
fn tell(message: &Message) {
    let mut line = serde_json::to_vec(message).unwrap_or_default();
    line.push(b'\n');
    let mut out = std::io::stdout().lock();
    if out.write_all(&line).and_then(|()| out.flush()).is_err() {
        std::process::exit(1);
    }
}

impl Observer for Reporter {
    fn progress(&self, progress: &pipeline::Progress) -> Control {
        let stage = progress.stage;
        let progress = Progress {
            stage: Some(stage),
            fraction: progress.fraction,
            chart: progress.chart as u64,
            charts: progress.charts as u64,
            iteration: progress.iteration as u64,
            energy: Some(progress.energy).filter(|e| e.is_finite()),
            smallest: Some(progress.smallest).filter(|s| s.is_finite()),
        };
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        let is_due = told
            .as_ref()
            .is_none_or(|(when, last)| TELL_INTERVAL <= when.elapsed() || *last != stage);
        if is_due {
            *told = Some((Instant::now(), stage));
            tell(&Message::Progress(progress));
        }
        if self.finish.load(Ordering::Relaxed) {
            Control::Finish
        } else {
            Control::Continue
        }
    }

    fn elapsed(&self) -> Duration {
        self.start.elapsed()
    }

    fn frame(&self, number: usize, file: &dyn Fn() -> Vec<u8>) {
        let mut frames = self.frames.lock().unwrap_or_else(PoisonError::into_inner);
        frames.add(number, file);
    }
}

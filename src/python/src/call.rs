//! Calls of the library from Python: on a thread, with the interpreter released.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::panicking;
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use unwrapd::pipeline::{self, Observer, PipelineError};
use unwrapd::solver::{Control, Iterate, Watch};

use crate::error::{exception, internal};
use crate::iterates::{Question, Questions};

/// Interval at which signals are handled and progress is reported: short enough that Ctrl-C seems immediate.
const ATTENTION: Duration = Duration::from_millis(20);

/// Progress of the work.
#[pyclass(frozen, get_all, module = "unwrapd")]
pub struct Progress {
    /// The stage under way.
    stage: &'static str,
    /// Share of the whole work done, 0 to 1.
    fraction: f64,
    /// Charts mapped so far.
    chart: usize,
    /// Charts known so far.
    charts: usize,
    /// Iteration of the chart that reported last.
    iteration: usize,
    /// Its energy.
    energy: f64,
    /// Its smallest element over the rest size.
    smallest: f64,
}

#[pymethods]
impl Progress {
    fn __repr__(&self) -> String {
        format!("Progress({}, {:.3})", self.stage, self.fraction)
    }
}

impl From<pipeline::Progress> for Progress {
    fn from(progress: pipeline::Progress) -> Self {
        Self {
            stage: progress.stage.word(),
            fraction: progress.fraction,
            chart: progress.chart,
            charts: progress.charts,
            iteration: progress.iteration,
            energy: progress.energy,
            smallest: progress.smallest,
        }
    }
}

/// State shared by the working thread and the calling one.
struct Link {
    begin: Instant,
    is_ending: AtomicBool,
    is_abandoned: AtomicBool,
    latest: Mutex<Option<pipeline::Progress>>,
}

impl Observer for Link {
    /// Leaves the library by unwinding once nobody waits for a result: an early end would still pack and judge one.
    fn progress(&self, progress: &pipeline::Progress) -> Control {
        if self.is_abandoned.load(Ordering::Relaxed) {
            // Values dropped while unwinding report, too.
            if !panicking() {
                resume_unwind(Box::new("abandoned"));
            }
            return Control::Finish;
        }
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress.clone());
        if self.is_ending.load(Ordering::Relaxed) {
            Control::Finish
        } else {
            Control::Continue
        }
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}

impl Link {
    fn abandon(&self) {
        self.is_abandoned.store(true, Ordering::Relaxed);
    }

    /// Reports new progress to the listener, if there are both. A listener that returns False ends the work with the
    /// present map.
    fn tell(&self, py: Python<'_>, listener: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        let Some(listener) = listener else {
            return Ok(());
        };
        let latest = (self.latest.lock())
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        if let Some(progress) = latest {
            let answer = listener.call1((Progress::from(progress),))?;
            if answer.is(&*pyo3::types::PyBool::new(py, false)) {
                self.is_ending.store(true, Ordering::Relaxed);
            }
        }
        Ok(())
    }
}

/// Runs work on a thread. The calling thread stays with the interpreter: it handles signals and calls the listener. An
/// exception from either returns at once; the work ends at its next report.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    listener: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn Observer) -> Result<T, PipelineError> + Send + 'static,
) -> PyResult<T> {
    run_shown(py, listener, None, |observer, _| work(observer))
}

/// Message of the working thread.
enum Message<T> {
    Asked(Question),
    Ended(Result<T, PipelineError>),
}

/// Like [`run`], for work with a watch: `show` receives each iterate on the calling thread before the next one is
/// computed.
pub fn run_shown<T: Send + 'static>(
    py: Python<'_>,
    listener: Option<&Bound<'_, PyAny>>,
    show: Option<&dyn Fn(Question) -> PyResult<()>>,
    work: impl FnOnce(&dyn Observer, &(dyn Watch + Sync)) -> Result<T, PipelineError> + Send + 'static,
) -> PyResult<T> {
    let link = Arc::new(Link {
        begin: Instant::now(),
        is_ending: AtomicBool::new(false),
        is_abandoned: AtomicBool::new(false),
        latest: Mutex::new(None),
    });
    // Start the work on a thread of its own.
    let (sender, mut receiver) = channel();
    let observer = Arc::clone(&link);
    let is_shown = show.is_some();
    std::thread::Builder::new()
        .name("unwrapd".to_owned())
        .spawn(move || {
            let asked = Questions::new(|question| sender.send(Message::Asked(question)).is_ok());
            let unasked = |_: &Iterate| Control::Continue;
            let watch: &(dyn Watch + Sync) = if is_shown { &asked } else { &unasked };
            let ended = work(&*observer, watch);
            // The caller may be gone.
            let _ = sender.send(Message::Ended(ended));
        })
        .map_err(|error| internal(py, &format!("cannot start a thread: {error}")))?;
    // Answer its messages; when there are none, look for signals and report progress.
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(ATTENTION), receiver));
        match received {
            Ok(Message::Ended(result)) => {
                link.tell(py, listener)?;
                return result.map_err(|error| exception(py, &error));
            }
            Ok(Message::Asked(question)) => {
                let shown =
                    (py.check_signals()).and_then(|()| show.map_or(Ok(()), |show| show(question)));
                shown.inspect_err(|_| link.abandon())?;
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(internal(py, "the computation ended without a result"));
            }
            Err(RecvTimeoutError::Timeout) => {
                let attended = (py.check_signals()).and_then(|()| link.tell(py, listener));
                attended.inspect_err(|_| link.abandon())?;
            }
        }
    }
}

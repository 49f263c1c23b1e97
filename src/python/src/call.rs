//! Calls of the library from Python: on a thread, with the interpreter released; iterates shown meanwhile; errors.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::panicking;
use std::time::{Duration, Instant};

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBool;

use unwrapd::deform::ProblemError;
use unwrapd::pipeline::{self, Observer, PipelineError};
use unwrapd::solver::{Control, Iterate, Watch};

/// Interval at which signals are handled and progress is reported: short enough that Ctrl-C seems immediate.
const ATTENTION: Duration = Duration::from_millis(20);

/// Progress of the work.
#[pyclass(frozen, get_all, name = "Progress", module = "unwrapd")]
pub struct PyProgress {
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
impl PyProgress {
    fn __repr__(&self) -> String {
        format!("Progress({}, {:.3})", self.stage, self.fraction)
    }
}

impl From<pipeline::Progress> for PyProgress {
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
struct PythonCall {
    begin: Instant,
    is_ending: AtomicBool,
    is_abandoned: AtomicBool,
    latest: Mutex<Option<pipeline::Progress>>,
}

impl Observer for PythonCall {
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

impl PythonCall {
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
            let answer = listener.call1((PyProgress::from(progress),))?;
            if answer.is(&*PyBool::new(py, false)) {
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
enum WorkMessage<T> {
    Asked(IterateQuestion),
    Ended(Result<T, PipelineError>),
}

/// Like [`run`], for work with a watch: `show` receives each iterate on the calling thread before the next one is
/// computed.
pub fn run_shown<T: Send + 'static>(
    py: Python<'_>,
    listener: Option<&Bound<'_, PyAny>>,
    show: Option<&dyn Fn(IterateQuestion) -> PyResult<()>>,
    work: impl FnOnce(&dyn Observer, &(dyn Watch + Sync)) -> Result<T, PipelineError> + Send + 'static,
) -> PyResult<T> {
    let link = Arc::new(PythonCall {
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
            let asked =
                Questions::new(|question| sender.send(WorkMessage::Asked(question)).is_ok());
            let watch: &(dyn Watch + Sync) = if is_shown {
                &asked
            } else {
                &|_: &Iterate| Control::Continue
            };
            let ended = work(&*observer, watch);
            // The caller may be gone.
            let _ = sender.send(WorkMessage::Ended(ended));
        })
        .map_err(|error| internal(py, &format!("cannot start a thread: {error}")))?;
    // Answer its messages; when there are none, look for signals and report progress.
    loop {
        let received;
        (received, receiver) = py.detach(move || (receiver.recv_timeout(ATTENTION), receiver));
        match received {
            Ok(WorkMessage::Ended(result)) => {
                link.tell(py, listener)?;
                return result.map_err(|error| exception(py, &error));
            }
            Ok(WorkMessage::Asked(question)) => {
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

// Iterates of a solver, shown to Python one by one.

/// An iterate of a minimization.
#[pyclass(frozen, get_all, name = "Iterate", module = "unwrapd")]
pub struct Shown {
    /// 0 for the start, then 1, 2, …
    iteration: usize,
    /// The energy with the barrier.
    energy: f64,
    /// The barrier's share of it.
    barrier: f64,
    /// The smallest element over its rest size.
    smallest: f64,
    /// The length of the step that led here as a share of its direction.
    step: f64,
    /// Positions, one row per vertex.
    x: Py<PyArray2<f64>>,
}

#[pymethods]
impl Shown {
    fn __repr__(&self) -> String {
        format!("Iterate({}, energy {:.6e})", self.iteration, self.energy)
    }
}

/// An iterate for the thread that shows it, with the channel for its answer.
pub struct IterateQuestion {
    iterate: Iterate,
    x: Vec<f64>,
    answer: Sender<Control>,
}

impl IterateQuestion {
    /// Shows the iterate. A callback that returns False ends the work with the present map.
    pub fn put(self, py: Python<'_>, dim: usize, callback: &Bound<'_, PyAny>) -> PyResult<()> {
        let n_vertices = self.x.len() / dim;
        let shown = Shown {
            iteration: self.iterate.iteration,
            energy: self.iterate.energy,
            barrier: self.iterate.barrier,
            smallest: self.iterate.smallest,
            step: self.iterate.sigma,
            x: PyArray1::from_vec(py, self.x)
                .reshape([n_vertices, dim])?
                .unbind(),
        };
        let said = callback.call1((shown,))?;
        let is_over = said.is(&*PyBool::new(py, false));
        let control = if is_over {
            Control::Finish
        } else {
            Control::Continue
        };
        // The working thread may be gone.
        let _ = self.answer.send(control);
        Ok(())
    }
}

/// Sends every iterate to the thread that shows it, and waits for the answer.
pub struct Questions<F> {
    /// Sends a question; returns `false` if nobody listens any more.
    send: F,
    /// Positions of the next iterate.
    x: Mutex<Vec<f64>>,
}

impl<F: Fn(IterateQuestion) -> bool> Questions<F> {
    pub fn new(send: F) -> Self {
        Self {
            send,
            x: Mutex::default(),
        }
    }
}

impl<F: Fn(IterateQuestion) -> bool> Watch for Questions<F> {
    /// Ends the work when nobody listens any more.
    fn iterate(&self, iterate: &Iterate) -> Control {
        let (answer, answered) = channel();
        let x = std::mem::take(&mut *self.x.lock().unwrap_or_else(PoisonError::into_inner));
        let is_sent = (self.send)(IterateQuestion {
            iterate: *iterate,
            x,
            answer,
        });
        let answer = if is_sent { answered.recv().ok() } else { None };
        answer.unwrap_or(Control::Finish)
    }

    fn positions(&self, _: &Iterate, x: &[f64]) {
        *self.x.lock().unwrap_or_else(PoisonError::into_inner) = x.to_vec();
    }
}

// Errors of the library as exceptions of the package.

/// Returns the exception for an error of the library, with its code.
pub fn exception(py: Python<'_>, error: &PipelineError) -> PyErr {
    let column = error.column();
    of(
        py,
        error.code(),
        error.exit_code(),
        &error.to_string(),
        column,
    )
}

/// Returns the exception for a problem that cannot be solved.
pub fn refused(py: Python<'_>, error: impl Into<ProblemError>) -> PyErr {
    exception(py, &PipelineError::from(error.into()))
}

/// Returns the exception for invalid options.
pub fn invalid_options(py: Python<'_>, text: String) -> PyErr {
    exception(py, &PipelineError::InvalidOptions(text))
}

/// Returns the exception for a bug of this program.
pub fn internal(py: Python<'_>, text: &str) -> PyErr {
    of(py, "internal_error", 1, text, None)
}

fn of(py: Python<'_>, code: &str, exit_code: u8, message: &str, column: Option<usize>) -> PyErr {
    let made = py
        .import("unwrapd._errors")
        .and_then(|module| module.call_method1("of", (code, exit_code, message, column)));
    made.map_or_else(|error| error, PyErr::from_value)
}

//! Calls of the library from JavaScript: cancellation and errors.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::panicking;
use std::time::{Duration, Instant};

use napi_derive::napi;
use unwrapd::pipeline::{Observer, PipelineError, Progress};
use unwrapd::solver::Control;

/// Reason why there is no result.
#[napi(object)]
pub struct Failure {
    /// Stable code, as in the problems of the HTTP service.
    pub code: String,
    /// Exit status of the command line.
    pub exit_code: u8,
    /// Description in one sentence.
    pub message: String,
}

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        Self {
            code: error.code().to_owned(),
            exit_code: error.exit_code(),
            message: error.to_string(),
        }
    }
}

impl Failure {
    /// Creates the failure of a bug in this program.
    pub fn internal(message: impl Into<String>) -> Self {
        Self {
            code: "internal_error".to_owned(),
            exit_code: 1,
            message: message.into(),
        }
    }
}

/// Token that cancels the calls it is passed to.
#[napi]
#[derive(Clone, Default)]
pub struct Cancellation {
    is_cancelled: Arc<AtomicBool>,
}

#[napi]
impl Cancellation {
    /// Creates a token that is not cancelled.
    #[napi(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes the calls fail at their next report of progress.
    #[napi]
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// Observer of a call, with its start time and its token.
struct NodeCall {
    begin: Instant,
    cancellation: Cancellation,
}

impl Observer for NodeCall {
    /// Unwinds out of the library once the call is cancelled: an early end would still pack and judge a result.
    fn progress(&self, _: &Progress) -> Control {
        if !self.cancellation.is_cancelled.load(Ordering::Relaxed) {
            return Control::Continue;
        }
        // Destructors may report progress during unwinding, and a second panic would abort the process.
        if !panicking() {
            resume_unwind(Box::new("cancelled"));
        }
        Control::Finish
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}

/// Runs work on this thread. Catches panics, so that JavaScript continues.
pub fn run<T>(
    cancellation: Cancellation,
    work: impl FnOnce(&dyn Observer) -> Result<T, PipelineError>,
) -> Result<T, Failure> {
    let link = NodeCall {
        begin: Instant::now(),
        cancellation,
    };
    match catch_unwind(AssertUnwindSafe(|| work(&link))) {
        Ok(result) => result.map_err(Failure::from),
        Err(_) if link.cancellation.is_cancelled.load(Ordering::Relaxed) => Err(Failure {
            code: "cancelled".to_owned(),
            exit_code: 1,
            message: "the call was cancelled".to_owned(),
        }),
        Err(_) => Err(Failure::internal("the computation ended without a result")),
    }
}

//! Calls of the library from JavaScript: how they end.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::panicking;
use std::time::{Duration, Instant};

use napi_derive::napi;
use unwrapd::pipeline::{Observer, PipelineError, Progress};
use unwrapd::solver::Control;

/// Why there is no result.
#[napi(object)]
pub struct Failure {
    /// A stable name, the same as in the problems of the HTTP service.
    pub code: String,
    /// The exit status of the command line.
    pub exit_code: u8,
    /// One sentence.
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
    /// A mistake of this program.
    pub fn internal(message: impl Into<String>) -> Self {
        Self {
            code: "internal_error".to_owned(),
            exit_code: 1,
            message: message.into(),
        }
    }
}

/// Ends the calls that it is given to.
#[napi]
#[derive(Clone, Default)]
pub struct Cancellation {
    is_cancelled: Arc<AtomicBool>,
}

#[napi]
impl Cancellation {
    /// Of calls that are to go on for now.
    #[napi(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// The calls fail at their next report of progress.
    #[napi]
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

/// What the library sees of a call.
struct Link {
    begin: Instant,
    cancellation: Cancellation,
}

impl Observer for Link {
    /// Leaves the library by unwinding once nobody waits for a result: an early end would still pack and judge one.
    fn progress(&self, _: &Progress) -> Control {
        if !self.cancellation.is_cancelled.load(Ordering::Relaxed) {
            return Control::Continue;
        }
        // What is dropped on the way out reports, too.
        if !panicking() {
            resume_unwind(Box::new("cancelled"));
        }
        Control::Finish
    }

    fn elapsed(&self) -> Duration {
        self.begin.elapsed()
    }
}

/// Runs work on this thread. What unwinds out of it stays here: JavaScript goes on.
pub fn run<T>(
    cancellation: Cancellation,
    work: impl FnOnce(&dyn Observer) -> Result<T, PipelineError>,
) -> Result<T, Failure> {
    let link = Link {
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

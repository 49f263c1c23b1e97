//! Threads that stay between the calls of an object.

use std::num::NonZeroUsize;

use rayon::{ThreadPool, ThreadPoolBuilder};
use unwrapd::pipeline::PipelineError;

/// Threads of this process, created at their first use. A forked process does not inherit them and creates its own.
pub struct Pool {
    threads: Option<NonZeroUsize>,
    made: Option<Made>,
}

struct Made {
    process: u32,
    pool: ThreadPool,
}

impl Pool {
    /// Creates a pool of at most this number of threads; without a number, one per core.
    pub fn new(threads: Option<NonZeroUsize>) -> Self {
        Self {
            threads,
            made: None,
        }
    }

    /// Runs work on the threads.
    pub fn run<T: Send>(&mut self, work: impl FnOnce() -> T + Send) -> Result<T, PipelineError> {
        let process = std::process::id();
        if let Some(lost) = self.made.take_if(|made| made.process != process) {
            // Dropping the pool might wait for threads that do not exist in this process.
            std::mem::forget(lost.pool);
        }
        let made = match &mut self.made {
            Some(made) => made,
            none => none.insert(Made {
                process,
                pool: fresh(self.threads)?,
            }),
        };
        Ok(made.pool.install(work))
    }
}

/// Starts the threads.
fn fresh(threads: Option<NonZeroUsize>) -> Result<ThreadPool, PipelineError> {
    ThreadPoolBuilder::new()
        .num_threads(threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|error| PipelineError::Threads(error.to_string()))
}

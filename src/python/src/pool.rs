//! Threads that stay between the calls of an object.

use std::num::NonZeroUsize;

use rayon::{ThreadPool, ThreadPoolBuilder};
use unwrapd::pipeline::PipelineError;

/// Threads of this process, made when they are first needed. A process that was forked has none of them, and makes its own.
pub struct Pool {
    threads: Option<NonZeroUsize>,
    made: Option<Made>,
}

struct Made {
    process: u32,
    pool: ThreadPool,
}

impl Pool {
    /// So many threads at most; without a number, as many as there are cores.
    pub fn new(threads: Option<NonZeroUsize>) -> Self {
        Self {
            threads,
            made: None,
        }
    }

    /// Works on them.
    pub fn run<T: Send>(&mut self, work: impl FnOnce() -> T + Send) -> Result<T, PipelineError> {
        let process = std::process::id();
        if let Some(lost) = self.made.take_if(|made| made.process != process) {
            // To end threads that are not there might wait for them.
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

/// As many threads as are asked for.
fn fresh(threads: Option<NonZeroUsize>) -> Result<ThreadPool, PipelineError> {
    ThreadPoolBuilder::new()
        .num_threads(threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|error| PipelineError::Threads(error.to_string()))
}

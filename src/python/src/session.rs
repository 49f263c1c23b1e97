//! Bodies that are pulled interactively, on threads that stay between the calls of an object.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::{Duration, Instant};

use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::call::{exception, refused};
use crate::energy::{Functions, PyEnergy};
use crate::files::{json, parsed};
use crate::problem::{body, energy_kind};
use unwrapd::deform::{self, Handle, HandleId, Model, ProblemError};
use unwrapd::pipeline::PipelineError;
use unwrapd::solver::Stage;

/// Time that a session works between two checks for signals: short enough that Ctrl-C seems immediate.
const SLICE: Duration = Duration::from_millis(20);

/// A session of the library. Positions are flat arrays of float64.
#[pyclass(name = "Session", module = "unwrapd._native")]
pub struct PySession {
    inner: deform::Session,
    threads: SessionThreads,
    dim: usize,
    /// Identifier of each handle, by its number in the order of adding.
    ids: Vec<HandleId>,
}

#[pymethods]
impl PySession {
    #[new]
    fn new(
        py: Python<'_>,
        vertices: PyReadonlyArray2<'_, f64>,
        elements: PyReadonlyArray2<'_, u32>,
        start: Option<PyReadonlyArray1<'_, f64>>,
        options: &str,
        functions: Option<Functions>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Self> {
        let start = start.as_ref().map(|start| start.as_slice()).transpose()?;
        let body = body(py, &vertices, &elements, start)?;
        let dim = body.dim();
        let (model, energy) = model(py, options, functions, dim)?;
        let mut threads = SessionThreads {
            pool: Pool::new(threads),
            energy,
            is_lost: false,
        };
        let made = threads.run(py, || deform::Session::new(body, &model))?;
        Ok(Self {
            inner: made.map_err(|error| refused(py, error))?,
            threads,
            dim,
            ids: Vec::new(),
        })
    }

    /// Number of coordinates of a position.
    #[getter]
    fn dim(&self) -> usize {
        self.dim
    }

    /// Adds a handle and returns its number.
    fn add(&mut self, py: Python<'_>, handle: &str) -> PyResult<usize> {
        let handle: Handle = serde_json::from_str(handle)
            .map_err(|error| refused(py, ProblemError::MalformedHandles(error.to_string())))?;
        let id = self.threads.run(py, || self.inner.add(handle))?;
        self.ids.push(id.map_err(|error| refused(py, error))?);
        Ok(self.ids.len() - 1)
    }

    /// Changes the target of a handle.
    fn move_to(&mut self, py: Python<'_>, number: u32, to: Vec<f64>) -> PyResult<()> {
        let id = self.id(py, number)?;
        let moved = self.threads.run(py, || self.inner.move_handle(id, &to))?;
        moved.map_err(|error| refused(py, error))
    }

    /// Removes a handle.
    fn remove(&mut self, py: Python<'_>, number: u32) -> PyResult<()> {
        let id = self.id(py, number)?;
        let removed = self.threads.run(py, || self.inner.remove(id))?;
        removed.map_err(|error| refused(py, error))
    }

    /// Exchanges energy and barrier.
    fn remodel(
        &mut self,
        py: Python<'_>,
        options: &str,
        functions: Option<Functions>,
    ) -> PyResult<()> {
        let (model, energy) = model(py, options, functions, self.dim)?;
        let before = std::mem::replace(&mut self.threads.energy, energy);
        let remodeled = self.threads.run(py, || self.inner.remodel(&model))?;
        remodeled.map_err(|error| {
            self.threads.energy = before;
            refused(py, error)
        })
    }

    /// Runs one iteration and returns the state of the handles.
    fn step(&mut self, py: Python<'_>) -> PyResult<&'static str> {
        self.threads.run(py, || self.inner.step()).map(word)
    }

    /// Runs iterations until nothing is left to do or the time is up; returns the state of the handles.
    fn settle(&mut self, py: Python<'_>, seconds: f64) -> PyResult<&'static str> {
        let begin = Instant::now();
        while self.inner.stage() == Stage::Moving && begin.elapsed().as_secs_f64() < seconds {
            let slice = Instant::now();
            self.threads.run(py, || {
                self.inner.step_while(|_: &deform::Session| {
                    slice.elapsed() < SLICE && begin.elapsed().as_secs_f64() < seconds
                })
            })?;
            py.check_signals()?;
        }
        Ok(word(self.inner.stage()))
    }

    /// State of the handles.
    #[getter]
    fn stage(&self) -> &'static str {
        word(self.inner.stage())
    }

    /// Positions of the vertices.
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.inner.positions())
    }

    /// Returns the quality of the map as JSON.
    fn worth(&mut self, py: Python<'_>) -> PyResult<String> {
        let quality = self.threads.run(py, || self.inner.quality())?;
        json(py, &quality)
    }

    /// Returns the summary of the solver as JSON.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        json(py, self.inner.summary())
    }

    /// Records positions and handles.
    fn remember(&mut self) {
        self.inner.remember();
    }

    /// Returns to the last recorded state; returns `false` if there is none.
    fn undo(&mut self, py: Python<'_>) -> PyResult<bool> {
        self.threads.run(py, || self.inner.undo())
    }

    /// Reverts an undo; returns `false` if there is none.
    fn redo(&mut self, py: Python<'_>) -> PyResult<bool> {
        self.threads.run(py, || self.inner.redo())
    }

    /// Resets the body to rest, without handles.
    fn reset(&mut self, py: Python<'_>) -> PyResult<()> {
        self.threads.run(py, || self.inner.reset())
    }
}

impl PySession {
    fn id(&self, py: Python<'_>, number: u32) -> PyResult<HandleId> {
        let id = self.ids.get(number as usize).copied();
        id.ok_or_else(|| refused(py, ProblemError::RemovedHandle { handle: number }))
    }
}

/// Returns energy and barrier, and the functions of the energy if it consists of functions.
fn model(
    py: Python<'_>,
    options: &str,
    functions: Option<Functions>,
    dim: usize,
) -> PyResult<(Model, Option<Arc<PyEnergy>>)> {
    let mut model: Model = parsed(py, options)?;
    let energy = functions.map(PyEnergy::new);
    if let Some(energy) = &energy {
        model.energy = energy_kind(py, energy, dim)?;
    }
    Ok((model, energy))
}

/// The threads of a session, and the energy that they may call.
struct SessionThreads {
    pool: Pool,
    /// The energy, if it consists of functions of Python.
    energy: Option<Arc<PyEnergy>>,
    /// `true` once a function failed in the middle of an iteration: the map is the last valid one, and no more work is
    /// possible.
    is_lost: bool,
}

impl SessionThreads {
    /// Runs work on the threads, with the interpreter released.
    ///
    /// # Errors
    /// The exception of a function of the energy, after which any work is refused.
    fn run<T: Send>(&mut self, py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
        if self.is_lost {
            return Err(PyRuntimeError::new_err(
                "an exception of the energy ended the session",
            ));
        }
        let pool = &mut self.pool;
        let done = match &self.energy {
            Some(energy) => energy.run(|| py.detach(|| pool.run(work))),
            None => Ok(py.detach(|| pool.run(work))),
        };
        self.is_lost = done.is_err();
        done?.map_err(|error| exception(py, &error))
    }
}

fn word(stage: Stage) -> &'static str {
    match stage {
        Stage::Moving => "moving",
        Stage::Settled => "settled",
        Stage::Unreachable => "unreachable",
    }
}

// Threads that stay between the calls of an object.

/// Threads of this process, created at their first use. A forked process does not inherit them and creates its own.
pub struct Pool {
    threads: Option<NonZeroUsize>,
    made: Option<MadePool>,
}

struct MadePool {
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
            none => none.insert(MadePool {
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

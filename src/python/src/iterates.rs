//! Iterates of a solver, shown to Python one by one.

use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, PoisonError};

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBool;
use unwrapd::solver::{Control, Iterate, Watch};

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
pub struct Question {
    iterate: Iterate,
    x: Vec<f64>,
    answer: Sender<Control>,
}

impl Question {
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

impl<F: Fn(Question) -> bool> Questions<F> {
    pub fn new(send: F) -> Self {
        Self {
            send,
            x: Mutex::default(),
        }
    }
}

impl<F: Fn(Question) -> bool> Watch for Questions<F> {
    /// Ends the work when nobody listens any more.
    fn iterate(&self, iterate: &Iterate) -> Control {
        let (answer, answered) = channel();
        let x = std::mem::take(&mut *self.x.lock().unwrap_or_else(PoisonError::into_inner));
        let is_sent = (self.send)(Question {
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

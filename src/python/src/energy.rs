//! Energies as functions of Python.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use unwrapd::energy::{Batched, DensityBatch, DensityKind, FormulaError, OwnEnergy};

/// ψ, its gradient and its Hessian as functions of the singular values (n, D). Each returns its n items as one flat array.
/// The package checks their shapes and numbers.
#[derive(FromPyObject)]
pub struct Functions(Py<PyAny>, Py<PyAny>, Py<PyAny>);

/// The functions, and the exception that ended the work that called them.
pub struct PyEnergy {
    functions: Functions,
    failure: Mutex<Option<PyErr>>,
}

/// The functions as a density. A solver calls them from its own threads.
struct Calls(Arc<PyEnergy>);

impl PyEnergy {
    pub fn new(functions: Functions) -> Arc<Self> {
        Arc::new(Self {
            functions,
            failure: Mutex::default(),
        })
    }

    /// Returns the energy of elements of dimension `dim`.
    ///
    /// # Errors
    /// If it is no energy, or if a function fails.
    pub fn density(self: &Arc<Self>, dim: usize) -> PyResult<Result<DensityKind, FormulaError>> {
        let calls = Calls(Arc::clone(self));
        let own = self.run(|| -> Result<OwnEnergy, FormulaError> {
            Ok(match dim {
                2 => Batched::<2>::new(calls)?.into(),
                _ => Batched::<3>::new(calls)?.into(),
            })
        })?;
        Ok(own.map(DensityKind::Formula))
    }

    /// Runs work that may call the functions. An exception that one of them raises ends the work by unwinding, and is
    /// returned here.
    pub fn run<T>(&self, work: impl FnOnce() -> T) -> PyResult<T> {
        catch_unwind(AssertUnwindSafe(work))
            .map_err(|panic| self.take_failure().unwrap_or_else(|| resume_unwind(panic)))
    }

    /// Returns the outcome of work on another thread: an exception that a function raised is the reason why it has no
    /// result.
    pub fn outcome<T>(energy: Option<&Arc<Self>>, outcome: PyResult<T>) -> PyResult<T> {
        let failure = energy.and_then(|energy| energy.take_failure());
        failure.map_or(outcome, Err)
    }

    /// Returns the exception that ended the work, once.
    fn take_failure(&self) -> Option<PyErr> {
        (self.failure.lock())
            .unwrap_or_else(PoisonError::into_inner)
            .take()
    }

    /// Calls a function.
    fn call<const D: usize>(&self, function: &Py<PyAny>, sigmas: &[[f64; D]]) -> Vec<f64> {
        let called = Python::try_attach(|py| -> PyResult<Vec<f64>> {
            let sigmas =
                PyArray1::from_slice(py, sigmas.as_flattened()).reshape([sigmas.len(), D])?;
            let found: PyReadonlyArray1<'_, f64> = function.bind(py).call1((sigmas,))?.extract()?;
            Ok(found.as_slice()?.to_vec())
        });
        // There is no interpreter at the end of the process.
        let failure = match called {
            Some(Ok(found)) => return found,
            Some(Err(error)) => Some(error),
            None => None,
        };
        *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = failure;
        resume_unwind(Box::new("an energy failed"))
    }
}

impl<const D: usize> DensityBatch<D> for Calls {
    fn values(&self, sigmas: &[[f64; D]]) -> Vec<f64> {
        self.0.call(&self.0.functions.0, sigmas)
    }

    fn gradients(&self, sigmas: &[[f64; D]]) -> Vec<[f64; D]> {
        let flat = self.0.call(&self.0.functions.1, sigmas);
        flat.as_chunks().0.to_vec()
    }

    fn hessians(&self, sigmas: &[[f64; D]]) -> Vec<[[f64; D]; D]> {
        let flat = self.0.call(&self.0.functions.2, sigmas);
        flat.as_chunks().0.as_chunks().0.to_vec()
    }
}

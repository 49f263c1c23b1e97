//! Problems of deformation: their energies at any point, and their solutions.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use numpy::{
    PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods,
};
use pyo3::prelude::*;

use crate::call::{IterateQuestion, refused, run_shown};
use crate::energy::{Functions, PyEnergy};
use crate::files::{json, parsed};
use crate::meshes::rows;
use unwrapd::deform::{
    self, Body, Bound as Held, Handle, Model, Potential, ProblemError, Units, bind,
};
use unwrapd::energy::EnergyKind;
use unwrapd::mesh::{PlanarMesh, TetMesh};
use unwrapd::pipeline::{SolveOptions, solve_problem};

/// A body with an energy and a barrier, without handles. Positions are flat arrays of float64.
#[pyclass(frozen, name = "Problem", module = "unwrapd._native")]
pub struct PyProblem {
    problem: deform::Problem,
    potential: Mutex<Potential>,
    /// The energy, if it consists of functions of Python.
    energy: Option<Arc<PyEnergy>>,
}

/// A sparse matrix by rows: data, columns, and the start of each row.
type PyMatrix<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<usize>>,
    Bound<'py, PyArray1<usize>>,
);

/// Name and values of a property of the elements, one row per element.
type Column<'py> = (&'static str, Bound<'py, PyArray2<f64>>);

#[pymethods]
impl PyProblem {
    #[new]
    fn new(
        py: Python<'_>,
        vertices: PyReadonlyArray2<'_, f64>,
        elements: PyReadonlyArray2<'_, u32>,
        start: Option<PyReadonlyArray1<'_, f64>>,
        options: &str,
        functions: Option<Functions>,
        is_normalized: bool,
    ) -> PyResult<Self> {
        let start = start.as_ref().map(|start| start.as_slice()).transpose()?;
        let body = body(py, &vertices, &elements, start)?;
        let mut model: Model = parsed(py, options)?;
        let energy = functions.map(PyEnergy::new);
        if let Some(energy) = &energy {
            model.energy = energy_kind(py, energy, body.dim())?;
        }
        let made = problem(body, start, &model, is_normalized);
        let (problem, potential) = made.map_err(|error| refused(py, error))?;
        Ok(Self {
            problem,
            potential: Mutex::new(potential),
            energy,
        })
    }

    /// Number of coordinates of a position.
    #[getter]
    fn dim(&self) -> usize {
        self.problem.body.dim()
    }

    /// Start positions of a solution.
    #[getter]
    fn start<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.problem.start)
    }

    /// Returns the sum of energy and barriers.
    fn value(&self, py: Python<'_>, x: PyReadonlyArray1<'_, f64>) -> PyResult<f64> {
        let x = x.as_slice()?;
        let value = self.released(py, || self.potential().value(x))?;
        value.map_err(|error| refused(py, error))
    }

    /// Returns its gradient.
    fn gradient<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let x = x.as_slice()?;
        let gradient = self.released(py, || self.potential().gradient(x))?;
        let gradient = gradient.map_err(|error| refused(py, error))?;
        Ok(PyArray1::from_vec(py, gradient))
    }

    /// Returns its Hessian.
    fn hessian<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<PyMatrix<'py>> {
        let x = x.as_slice()?;
        let hessian = self.released(py, || self.potential().hessian(x))?;
        let hessian = hessian.map_err(|error| refused(py, error))?;
        Ok((
            PyArray1::from_vec(py, hessian.data),
            PyArray1::from_vec(py, hessian.indices),
            PyArray1::from_vec(py, hessian.indptr),
        ))
    }

    /// Returns the properties of each element at the positions `x`.
    fn elements<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Vec<Column<'py>>> {
        let x = x.as_slice()?;
        let checked = self.problem.body.check(x);
        checked.map_err(|error| refused(py, error))?;
        let mut columns = Vec::new();
        for cell in self.released(py, || self.problem.cells(x))? {
            let shape = [cell.values.len() / cell.components, cell.components];
            let values = PyArray1::from_vec(py, cell.values).reshape(shape)?;
            columns.push((cell.name, values));
        }
        Ok(columns)
    }

    /// Pulls handles to their targets, or minimizes from the start without any; returns positions, and the report as JSON.
    fn solve<'py>(
        &self,
        py: Python<'py>,
        handles: &str,
        options: &str,
        callback: Option<Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, String)> {
        let problem = self.held(py, handles)?;
        let options: SolveOptions = parsed(py, options)?;
        let dim = problem.body.dim();
        let show = callback
            .as_ref()
            .map(|callback| move |question: IterateQuestion| question.put(py, dim, callback));
        let show = show.as_ref().map(|show| show as &dyn Fn(_) -> _);
        let solved = run_shown(py, None, show, move |observer, watch| {
            solve_problem(&problem, &options, observer, watch)
        });
        let (solution, report) = PyEnergy::outcome(self.energy.as_ref(), solved)?;
        Ok((PyArray1::from_vec(py, solution.x), json(py, &report)?))
    }
}

impl PyProblem {
    /// Runs work with the interpreter released; a function of the energy that fails ends it.
    fn released<T: Send>(&self, py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
        match &self.energy {
            Some(energy) => energy.run(|| py.detach(work)),
            None => Ok(py.detach(work)),
        }
    }

    fn potential(&self) -> MutexGuard<'_, Potential> {
        self.potential
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns the problem with handles in the form of handle files.
    fn held(&self, py: Python<'_>, handles: &str) -> PyResult<deform::Problem> {
        let handles: Vec<Handle> = serde_json::from_str(handles)
            .map_err(|error| refused(py, ProblemError::MalformedHandles(error.to_string())))?;
        if handles.is_empty() {
            return Ok(self.problem.clone());
        }
        let held = bind(&self.problem.body, &handles).map_err(|error| refused(py, error))?;
        let Held {
            stations,
            aims,
            turns,
            soft,
        } = held;
        Ok(deform::Problem {
            stations,
            aims,
            turned: turns,
            soft,
            ..self.problem.clone()
        })
    }
}

/// Returns functions as the energy of a body of dimension `dim`.
pub fn energy_kind(py: Python<'_>, energy: &Arc<PyEnergy>, dim: usize) -> PyResult<EnergyKind> {
    let density = energy.density(dim)?;
    let density = density.map_err(|error| refused(py, ProblemError::from(error)))?;
    Ok(density.into())
}

fn problem(
    body: Body,
    start: Option<&[f64]>,
    model: &Model,
    is_normalized: bool,
) -> Result<(deform::Problem, Potential), ProblemError> {
    let mut problem = deform::Problem::at_rest(body, model)?;
    if !is_normalized {
        problem.units = Units::Given;
    }
    if let Some(start) = start {
        problem.start = start.to_vec();
        problem.untangle_start()?;
    }
    let potential = problem.potential()?;
    Ok((problem, potential))
}

// Bodies from arrays.

/// Creates a body of triangles of the plane, of triangles of space laid flat one by one, or of tetrahedra, depending on
/// the shapes of the arrays. Triangles laid flat rest at `start`, their places in the plane.
pub fn body(
    py: Python<'_>,
    vertices: &PyReadonlyArray2<'_, f64>,
    elements: &PyReadonlyArray2<'_, u32>,
    start: Option<&[f64]>,
) -> PyResult<Body> {
    let (positions, corners) = (vertices.as_slice()?, elements.as_slice()?);
    let made = match (vertices.shape()[1], elements.shape()[1]) {
        (2, _) => PlanarMesh::new(rows(positions), rows(corners)).map(|mesh| Body::from(&mesh)),
        (_, 3) => Body::flattened(&rows(positions), &rows(corners)),
        _ => TetMesh::new(rows(positions), rows(corners)).map(|mesh| Body::from(&mesh)),
    };
    let mut body = made.map_err(|error| refused(py, ProblemError::from(error)))?;
    if let Some(start) = start {
        body.check(start).map_err(|error| refused(py, error))?;
        if vertices.shape()[1] > body.dim() {
            body.rest = start.to_vec();
        }
    }
    Ok(body)
}

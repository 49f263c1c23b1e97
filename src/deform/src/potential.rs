//! A problem's energy as a function of positions.

use super::normalized::Frame;
use super::problem::{Problem, Units};
use super::problem_error::ProblemError;
use unwrapd_method::numerics::csr::Csr;
use unwrapd_method::solver::Objective;

/// The sum of energy, barriers and bound of a [`Problem`] at any positions, for inspection or for other optimizers.
/// Handles do not contribute.
///
/// Positions are those of the problem, and derivatives are derivatives in them. The value has the unit in which the
/// problem's numbers are meant ([`Units`]).
pub struct Potential {
    objective: Objective,
    /// The frame in which the problem's numbers are meant, if that differs from the frame of positions.
    frame: Option<Frame>,
}

impl Problem {
    /// Returns the energy of the problem as a function of positions.
    ///
    /// # Errors
    /// If the energy is not defined for the body.
    pub fn potential(&self) -> Result<Potential, ProblemError> {
        let of = |problem: &Self| {
            let terms = problem.terms(problem.barrier)?;
            let n_vertices = problem.body.n_vertices();
            Ok::<_, ProblemError>(Objective::of_terms(n_vertices, terms))
        };
        let (objective, frame) = match self.units {
            Units::Given => (of(self)?, None),
            Units::Normalized => {
                let (inner, frame) = self.normalized();
                (of(&inner)?, Some(frame))
            }
        };
        Ok(Potential { objective, frame })
    }
}

impl Potential {
    /// Returns E(x), +∞ outside the domain.
    ///
    /// # Errors
    /// If the number of coordinates is not that of the problem.
    pub fn value(&self, x: &[f64]) -> Result<f64, ProblemError> {
        Ok(self.objective.value(&self.inward(x)?))
    }

    /// Returns ∂E/∂x.
    ///
    /// # Errors
    /// As [`value`](Self::value), or if that is infinite.
    pub fn gradient(&mut self, x: &[f64]) -> Result<Vec<f64>, ProblemError> {
        self.linearize(x)?;
        let gradient = self.objective.gradient().iter();
        Ok(gradient.map(|slope| slope / self.unit()).collect())
    }

    /// Returns ∂²E/∂x² without any projection.
    ///
    /// # Errors
    /// As [`gradient`](Self::gradient).
    pub fn hessian(&mut self, x: &[f64]) -> Result<Csr, ProblemError> {
        self.linearize(x)?;
        // Take off the shift that makes the Hessian regular for the solver.
        self.objective.shift_diagonal(-self.objective.shift());
        let (pattern, values) = self.objective.hessian();
        let mut hessian = Csr::of_lower(pattern.scalar(), values);
        let square = self.unit() * self.unit();
        hessian.data.iter_mut().for_each(|entry| *entry /= square);
        Ok(hessian)
    }

    fn linearize(&mut self, x: &[f64]) -> Result<(), ProblemError> {
        let x = self.inward(x)?;
        if !self.objective.value(&x).is_finite() {
            return Err(ProblemError::OutsideDomain);
        }
        self.objective.linearize(&x, 1.0);
        Ok(())
    }

    fn inward(&self, x: &[f64]) -> Result<Vec<f64>, ProblemError> {
        let (found, expected) = (x.len(), self.objective.n());
        if found != expected {
            return Err(ProblemError::WrongStart { found, expected });
        }
        Ok(self
            .frame
            .as_ref()
            .map_or_else(|| x.to_vec(), |frame| frame.inward(x)))
    }

    fn unit(&self) -> f64 {
        self.frame.as_ref().map_or(1.0, Frame::unit)
    }
}

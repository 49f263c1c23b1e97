//! What is seen of a solution while it is made.

use std::cell::RefCell;
use std::fmt::Write;
use std::path::Path;

use super::failure::Failure;
use super::files::write_atomically;
use crate::deform::{Method, Problem, Solution};
use crate::solver::{Control, Iterate, Settings, Watch};

/// A file for the map of every iteration.
pub(super) struct Frames<'a> {
    /// Where they go.
    pub folder: &'a Path,
    /// How their names end.
    pub extension: String,
    /// What is in them, given the positions.
    pub text: &'a dyn Fn(&[f64]) -> String,
}

/// What happened in every iteration.
pub(super) struct Trace<'a> {
    iterates: RefCell<Vec<Iterate>>,
    frames: Option<Frames<'a>>,
    failure: RefCell<Option<Failure>>,
}

impl Watch for Trace<'_> {
    fn iterate(&self, iterate: &Iterate) -> Control {
        // Where one stage follows another the last iterate is shown again.
        let mut iterates = self.iterates.borrow_mut();
        if iterates
            .last()
            .is_none_or(|last| last.iteration < iterate.iteration)
        {
            iterates.push(*iterate);
        }
        if self.failure.borrow().is_some() {
            Control::Finish
        } else {
            Control::Continue
        }
    }

    fn positions(&self, x: &[f64]) {
        if let Some(frames) = &self.frames {
            let name = format!("{:05}.{}", self.iterates.borrow().len(), frames.extension);
            let written = write_atomically(&frames.folder.join(name), (frames.text)(x).as_bytes());
            *self.failure.borrow_mut() = written.err();
        }
    }
}

impl<'a> Trace<'a> {
    pub(super) fn new(frames: Option<Frames<'a>>) -> Self {
        Self {
            iterates: RefCell::default(),
            frames,
            failure: RefCell::default(),
        }
    }

    /// Solves the problem; an error also where a frame could not be written.
    pub(super) fn solve(&self, problem: &Problem, method: Method) -> Result<Solution, Failure> {
        let solution = match method {
            Method::Projected => problem.solve(&Settings::follow(), self)?,
            Method::Levenberg => problem.solve_by_levenberg(&problem.levenberg, self)?,
        };
        match self.failure.take() {
            Some(failure) => Err(failure),
            None => Ok(solution),
        }
    }

    /// The smallest size of an element over its rest size, over all iterates.
    pub(super) fn smallest(&self) -> f64 {
        let sizes = self.iterates.borrow();
        sizes
            .iter()
            .map(|i| i.smallest)
            .fold(f64::INFINITY, f64::min)
    }

    /// A line per iteration; `energy` is that without the barrier.
    pub(super) fn csv(&self) -> String {
        let mut text =
            String::from("iteration,energy,barrier,constraint,smallest,mu,sigma,alpha,residual\n");
        for i in self.iterates.borrow().iter() {
            let numbers = [
                i.energy - i.barrier,
                i.barrier,
                i.constraint,
                i.smallest,
                i.mu,
                i.sigma,
                i.alpha,
                i.residual,
            ];
            let numbers = numbers.map(|x| format!("{x:e}")).join(",");
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{},{numbers}", i.iteration);
        }
        text
    }
}

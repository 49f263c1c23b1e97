//! Live editing of a body or a picture.

use serde_json::Value;

use super::frame::{Drawn, Elements};
use super::hand::{Hand, check_model, parsed};
use super::message::Named;
use super::names::Names;
use unwrapd_api::Failure;
use unwrapd_deform::warp::PictureHandle;
use unwrapd_deform::{Handle, HandleId, Model, ProblemError};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::HeldBody;

/// Format of handles.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Vertices, places and discs.
    Body,
    /// Places only, because the body is a cage.
    Cage,
    /// Pixels.
    Picture,
}

/// A body or a picture under live editing.
pub(super) struct BodyHand {
    held: HeldBody,
    form: Form,
    /// Determinant of each element at rest.
    rest: Vec<f64>,
    names: Names<HandleId>,
    /// Handles that no client added: a fixed border.
    border: Vec<Handle>,
}

impl BodyHand {
    /// Wraps a body whose only handles are its fixed border.
    pub fn new(held: HeldBody, form: Form) -> Self {
        let border = held.session.handles().map(|(_, handle)| handle.clone());
        Self {
            rest: held.body.determinants(),
            border: border.collect(),
            names: Names::none(),
            held,
            form,
        }
    }

    fn present(&self) -> impl Iterator<Item = HandleId> {
        self.held.session.handles().map(|(id, _)| id)
    }

    fn read(&self, name: u32, handle: Value) -> Result<Handle, Failure> {
        match self.form {
            Form::Body => parsed(handle),
            Form::Picture => {
                let PictureHandle { at, to } = parsed(handle)?;
                let (at, to) = (at.to_vec(), to.to_vec());
                Ok(Handle::Point { at, to })
            }
            Form::Cage => match parsed(handle)? {
                Handle::Vertex { .. } => {
                    let handle = name as usize;
                    Err(failure(&ProblemError::VertexOfCage { handle }))
                }
                handle => Ok(handle),
            },
        }
    }
}

fn failure(error: &ProblemError) -> Failure {
    Failure::new(error.code(), error.to_string())
}

impl Hand for BodyHand {
    fn add(&mut self, name: u32, handle: Value) -> Result<(), Failure> {
        let handle = self.read(name, handle)?;
        if let Some(id) = self.names.find(self.present(), name) {
            let exchanged = self.held.session.exchange(id, handle);
            return exchanged.map_err(|e| failure(&e));
        }
        let id = self.held.session.add(handle).map_err(|e| failure(&e))?;
        self.names.give(id, name);
        Ok(())
    }

    fn move_to(&mut self, name: u32, to: &[f64]) -> Result<(), Failure> {
        let id = self.names.expect(self.present(), name)?;
        let moved = self.held.session.move_handle(id, to);
        moved.map_err(|e| failure(&e))
    }

    fn remove(&mut self, name: u32) -> Result<(), Failure> {
        let id = self.names.expect(self.present(), name)?;
        self.held.session.remove(id).map_err(|e| failure(&e))
    }

    fn remodel(&mut self, model: &Model) -> Result<(), Failure> {
        check_model(model)?;
        self.held.session.remodel(model).map_err(|e| failure(&e))
    }

    fn remember(&mut self) {
        self.held.session.remember();
    }

    fn undo(&mut self) -> bool {
        self.held.session.undo()
    }

    fn redo(&mut self) -> bool {
        self.held.session.redo()
    }

    fn reset(&mut self) {
        self.held.session.reset();
        for handle in &self.border {
            // This cannot fail: handles at rest contradict nothing.
            let _ = self.held.session.add(handle.clone());
        }
    }

    fn handles(&self) -> Vec<Named> {
        let named = |(id, handle): (HandleId, &Handle)| {
            let name = self.names.of(id)?;
            let handle = serde_json::to_value(handle).unwrap_or_default();
            Some(Named { name, handle })
        };
        self.held.session.handles().filter_map(named).collect()
    }

    fn step(&mut self) -> Stage {
        self.held.session.step()
    }

    fn stage(&self) -> Stage {
        self.held.session.stage()
    }

    fn energy(&self) -> f64 {
        self.held.session.summary().energy_last
    }

    fn smallest(&self, positions: &[f64]) -> f64 {
        let now = self.held.body.determinants_at(positions);
        let ratios = now.iter().zip(&self.rest).map(|(now, rest)| now / rest);
        ratios.fold(f64::INFINITY, f64::min)
    }

    fn positions(&self) -> Vec<f64> {
        self.held.session.positions()
    }

    fn elements(&self) -> Elements<'_> {
        Elements::of_body(&self.held.body)
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.held.body.rest.clone(),
            triangles: &self.held.triangles,
            skin: self.held.skin.as_ref(),
            picture: self.held.picture,
        }
    }

    fn start(&self) -> Vec<f64> {
        self.positions()
    }
}

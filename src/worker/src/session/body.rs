//! Live editing of a body or a picture.

use serde_json::Value;

use super::editing::{Edited, View, parsed};
use super::frame::{Drawn, Elements};
use unwrapd_api::Failure;
use unwrapd_deform::warp::PictureHandle;
use unwrapd_deform::{Handle, LiveBody, ProblemError, Session};
use unwrapd_pipeline::SessionBody;

/// Format of handles.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum HandleFormat {
    /// Vertices, places and discs.
    Body,
    /// Places only, because the body is a cage.
    Cage,
    /// Pixels.
    Picture,
}

/// A body or a picture under live editing.
pub(super) struct BodyView {
    held: SessionBody,
    format: HandleFormat,
    /// Determinant of each element at rest.
    rest: Vec<f64>,
    /// Handles that no client added: a fixed border.
    border: Vec<Handle>,
}

impl BodyView {
    /// Wraps a body whose only handles are its fixed border.
    pub fn new(held: SessionBody, format: HandleFormat) -> Self {
        let border = held.session.handles().map(|(_, handle)| handle.clone());
        Self {
            rest: held.body.determinants(),
            border: border.collect(),
            held,
            format,
        }
    }
}

impl Edited for BodyView {
    type Map = LiveBody;

    fn editor(&self) -> &Session {
        &self.held.session
    }

    fn editor_mut(&mut self) -> &mut Session {
        &mut self.held.session
    }

    fn read(&self, name: u32, handle: Value) -> Result<Handle, Failure> {
        match self.format {
            HandleFormat::Body => parsed(handle),
            HandleFormat::Picture => {
                let PictureHandle { at, to } = parsed(handle)?;
                let (at, to) = (at.to_vec(), to.to_vec());
                Ok(Handle::Point { at, to })
            }
            HandleFormat::Cage => match parsed(handle)? {
                Handle::Vertex { .. } => {
                    let handle = name as usize;
                    Err(Self::failure(&ProblemError::VertexOfCage { handle }))
                }
                handle => Ok(handle),
            },
        }
    }

    fn failure(error: &ProblemError) -> Failure {
        Failure::new(error.code(), error.to_string())
    }

    fn reset(&mut self) {
        self.held.session.reset();
        for handle in &self.border {
            // A body at rest held where it is: nothing contradicts that.
            let _ = self.held.session.add(handle.clone());
        }
    }
}

impl View for BodyView {
    fn energy(&self) -> f64 {
        self.held.session.summary().energy_last
    }

    fn positions(&self) -> Vec<f64> {
        self.held.session.positions()
    }

    fn smallest(&self, positions: &[f64]) -> f64 {
        let now = self.held.body.determinants_at(positions);
        let ratios = now.iter().zip(&self.rest).map(|(now, rest)| now / rest);
        ratios.fold(f64::INFINITY, f64::min)
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

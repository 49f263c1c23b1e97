//! Live editing of UVs.

use serde_json::Value;

use super::frame::{Drawn, Elements};
use super::hand::{Hand, check_model, parsed};
use super::message::Named;
use super::names::Names;
use unwrapd_api::Failure;
use unwrapd_deform::Model;
use unwrapd_deform::uv::{Anchor, AnchorId, EditError, UvSession};
use unwrapd_method::solver::Stage;

/// UVs under live editing.
pub(super) struct UvHand {
    session: UvSession,
    names: Names<AnchorId>,
}

impl UvHand {
    /// Wraps a session on UVs.
    pub fn new(session: UvSession) -> Self {
        Self {
            session,
            names: Names::none(),
        }
    }

    fn present(&self) -> impl Iterator<Item = AnchorId> {
        self.session.anchors().map(|(id, _)| id)
    }
}

fn failure(error: &EditError) -> Failure {
    Failure::new(error.code(), error.to_string())
}

impl Hand for UvHand {
    fn add(&mut self, name: u32, handle: Value) -> Result<(), Failure> {
        let anchor: Anchor = parsed(handle)?;
        if let Some(id) = self.names.find(self.present(), name) {
            let exchanged = self.session.exchange(id, anchor);
            return exchanged.map_err(|e| failure(&e));
        }
        let id = self.session.add(anchor).map_err(|e| failure(&e))?;
        self.names.give(id, name);
        Ok(())
    }

    fn move_to(&mut self, name: u32, to: &[f64]) -> Result<(), Failure> {
        let id = self.names.expect(self.present(), name)?;
        let to = <[f64; 2]>::try_from(to).unwrap_or([f64::NAN; 2]);
        let moved = self.session.move_anchor(id, to);
        moved.map_err(|e| failure(&e))
    }

    fn remove(&mut self, name: u32) -> Result<(), Failure> {
        let id = self.names.expect(self.present(), name)?;
        self.session.remove(id).map_err(|e| failure(&e))
    }

    fn remodel(&mut self, model: &Model) -> Result<(), Failure> {
        check_model(model)?;
        self.session.remodel(model).map_err(|e| failure(&e))
    }

    fn remember(&mut self) {
        self.session.remember();
    }

    fn undo(&mut self) -> bool {
        self.session.undo()
    }

    fn redo(&mut self) -> bool {
        self.session.redo()
    }

    fn reset(&mut self) {
        self.session.reset();
    }

    fn handles(&self) -> Vec<Named> {
        let named = |(id, anchor): (AnchorId, &Anchor)| {
            let name = self.names.of(id)?;
            let handle = serde_json::to_value(anchor).unwrap_or_default();
            Some(Named { name, handle })
        };
        self.session.anchors().filter_map(named).collect()
    }

    fn step(&mut self) -> Stage {
        self.session.step()
    }

    fn stage(&self) -> Stage {
        self.session.stage()
    }

    fn energy(&self) -> f64 {
        self.session.energy()
    }

    fn smallest(&self, _: &[f64]) -> f64 {
        self.session.smallest()
    }

    fn positions(&self) -> Vec<f64> {
        self.session.vertex_uvs().into_flattened()
    }

    fn elements(&self) -> Elements<'_> {
        let signs = self.session.kept_signs();
        Elements::Triangles(self.session.faces(), Some(signs))
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.positions(),
            triangles: self.session.faces(),
            skin: None,
            picture: None,
        }
    }

    fn start(&self) -> Vec<f64> {
        let corners = self.session.uvs().into_flattened();
        corners.into_flattened()
    }
}

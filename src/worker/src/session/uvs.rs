//! Live editing of UVs.

use serde_json::Value;

use super::editing::{Edited, View, parsed};
use super::frame::{Drawn, Elements};
use unwrapd_api::Failure;
use unwrapd_deform::uv::{Anchor, EditError, LiveUvs, UvSession};

/// UVs under live editing.
pub(super) struct UvView(pub UvSession);

impl Edited for UvView {
    type Map = LiveUvs;

    fn editor(&self) -> &UvSession {
        &self.0
    }

    fn editor_mut(&mut self) -> &mut UvSession {
        &mut self.0
    }

    fn read(&self, _: u32, handle: Value) -> Result<Anchor, Failure> {
        parsed(handle)
    }

    fn failure(error: &EditError) -> Failure {
        Failure::new(error.code(), error.to_string())
    }

    fn reset(&mut self) {
        self.0.reset();
    }
}

impl View for UvView {
    fn energy(&self) -> f64 {
        self.0.energy()
    }

    fn positions(&self) -> Vec<f64> {
        self.0.vertex_uvs().into_flattened()
    }

    fn smallest(&self, _: &[f64]) -> f64 {
        self.0.smallest()
    }

    fn elements(&self) -> Elements<'_> {
        let signs = self.0.kept_signs();
        Elements::Triangles(self.0.faces(), Some(signs))
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.positions(),
            triangles: self.0.faces(),
            skin: None,
            picture: None,
        }
    }

    fn start(&self) -> Vec<f64> {
        let corners = self.0.uvs().into_flattened();
        corners.into_flattened()
    }
}

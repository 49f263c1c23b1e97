//! Corners of faces that the selectors of handles name.

use super::selection::{FaceAttributes, in_bytes, linear};
use crate::PipelineError;
use crate::options::Selector;
use std::collections::HashSet;
use unwrapd_deform::{ProblemError, Select};
use unwrapd_files::document::Document;

/// Primitives of a document, whose faces and vertices are chosen by material, object, color or number.
pub struct CornerSelection {
    document: Document,
    primitives: Vec<usize>,
}

impl CornerSelection {
    /// Creates the selection of corners of these primitives; they are counted one primitive after the other.
    pub fn new(document: Document, primitives: Vec<usize>) -> Self {
        Self {
            document,
            primitives,
        }
    }

    /// Fills in the corners, `3 * face + c`, that selectors name.
    ///
    /// # Errors
    /// If a selector cannot be parsed, or names a material that does not exist.
    pub fn fill<'a>(
        &self,
        selects: impl IntoIterator<Item = &'a mut Select>,
    ) -> Result<(), PipelineError> {
        self.fill_mapped(selects, |corners| corners)
    }

    /// Like [`fill`](Self::fill), with what `members` makes of the corners.
    pub fn fill_mapped<'a>(
        &self,
        selects: impl IntoIterator<Item = &'a mut Select>,
        members: impl Fn(Vec<u32>) -> Vec<u32>,
    ) -> Result<(), PipelineError> {
        for select in selects {
            let corners = self.corners(select.text())?;
            select.fill(members(corners));
        }
        Ok(())
    }

    fn corners(&self, text: &str) -> Result<Vec<u32>, PipelineError> {
        let document = &self.document;
        if let Some(name) = text.strip_prefix("object=") {
            let objects = self.primitives.iter().map(|&p| document.face_objects(p));
            let named = objects.flatten().map(|own| own.as_deref() == Some(name));
            return Ok(corners_of(named));
        }
        let selector: Selector = text.parse().map_err(ProblemError::MalformedHandles)?;
        let material = match &selector {
            Selector::Color(color) => return self.corners_of_color(*color),
            Selector::Material(name) => {
                let index = document.material(name);
                Some(index.ok_or_else(|| PipelineError::UnknownMaterial(name.clone()))?)
            }
            Selector::All | Selector::Faces(_) => None,
        };
        let faces = FaceAttributes::of_primitives(document, &self.primitives)?;
        Ok(corners_of(faces.selected(&selector, material).into_iter()))
    }

    /// Returns the corners at vertices of a color, in sRGB.
    fn corners_of_color(&self, color: [u8; 3]) -> Result<Vec<u32>, PipelineError> {
        let wanted = in_bytes(&linear(color));
        let mut colors = Vec::new();
        for &index in &self.primitives {
            let of_vertices = self.document.vertex_colors(index)?.unwrap_or_default();
            let corners = self.document.primitives()[index].triangles.as_flattened();
            colors.extend(
                corners
                    .iter()
                    .map(|&v| of_vertices.get(v as usize).map(in_bytes)),
            );
        }
        let named = (0..).zip(colors).filter(|(_, own)| *own == Some(wanted));
        Ok(named.map(|(corner, _)| corner).collect())
    }
}

/// Returns the corners of the selected faces.
fn corners_of(is_selected: impl Iterator<Item = bool>) -> Vec<u32> {
    let selected = (0..)
        .zip(is_selected)
        .filter(|(_, is_selected)| *is_selected);
    selected
        .flat_map(|(face, _): (u32, bool)| [3 * face, 3 * face + 1, 3 * face + 2])
        .collect()
}

/// Vertices of a body that the selectors of handles name.
pub struct VertexSelection {
    pub corners: CornerSelection,
    /// Faces of the document that the body has, and their vertices.
    pub faces: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
    /// Of a surface in a cage: for each vertex the vertices of the cage that carry it.
    pub carriers: Option<Vec<[u32; 4]>>,
}

impl VertexSelection {
    /// Fills in the vertices that selectors name.
    ///
    /// # Errors
    /// If a selector cannot be parsed, or names a material that does not exist.
    pub fn fill<'a>(
        &self,
        selects: impl IntoIterator<Item = &'a mut Select>,
    ) -> Result<(), PipelineError> {
        self.corners.fill_mapped(selects, |corners| {
            let is_named: HashSet<u32> = corners.into_iter().collect();
            let corners = self.faces.iter().zip(&self.triangles);
            let corners = corners.flat_map(|(face, triangle)| {
                let numbered = (3 * face..).zip(triangle);
                numbered.filter(|(corner, _)| is_named.contains(corner))
            });
            let vertices = corners.map(|(_, &vertex)| vertex);
            match &self.carriers {
                Some(carriers) => vertices.flat_map(|v| carriers[v as usize]).collect(),
                None => vertices.collect(),
            }
        })
    }
}

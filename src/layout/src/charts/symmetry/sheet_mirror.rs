//! A sheet that is its own mirror image.

use super::own_image::are_own_image;
use super::plane::MirrorPlane;
use unwrapd_maps::cut::Sheet;

/// A vertex lies in the plane if it keeps within this share of the mean length of the edges, and a way if its edges keep within
/// about that of it.
const VERTEX_IN_PLANE: f64 = 0.5;
const WAY_IN_PLANE: f64 = 0.25;

/// The plane in which a sheet is its own mirror image.
#[derive(Clone, Copy, Debug)]
pub struct SheetMirror {
    pub plane: MirrorPlane,
    /// The mean length of the sheet's edges.
    pub edge: f64,
}

impl SheetMirror {
    /// Unless the sheet is not its own mirror image.
    pub fn of(sheet: &Sheet, plane: &MirrorPlane) -> Option<Self> {
        are_own_image(sheet.vertex.as_chunks().0, &sheet.positions, plane)
            .then(|| Self::any(sheet, plane))
    }

    /// Also where it is not its own mirror image.
    pub fn any(sheet: &Sheet, plane: &MirrorPlane) -> Self {
        let lengths = (0..sheet.twin.len() as u32).map(|h| sheet.length(h));
        Self {
            plane: *plane,
            edge: lengths.sum::<f64>() / sheet.twin.len().max(1) as f64,
        }
    }

    /// Whether a vertex of the sheet lies in the plane.
    pub fn has(&self, sheet: &Sheet, vertex: u32) -> bool {
        let height = self.plane.height(sheet.positions[vertex as usize]);
        height.abs() <= VERTEX_IN_PLANE * self.edge
    }

    /// Costs of edges for ways in the plane.
    pub fn within(&self, sheet: &Sheet, cost: impl Fn(u32) -> f64) -> impl Fn(u32) -> f64 {
        let unit = WAY_IN_PLANE * self.edge;
        move |h| cost(h) * (1.0 + (self.plane.height(sheet.middle(h)) / unit).powi(2))
    }
}

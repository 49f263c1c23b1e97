//! Charts: parts of a surface opened to disks.

use super::symmetry::plane::MirrorPlane;
use serde::{Deserialize, Serialize};
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::{Disk, Surface, next, spread};
use unwrapd_method::numerics::vec3::{area_vector, norm};

/// Where a surface is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Cut {
    /// Few charts under a bound on their distortion.
    #[default]
    Auto,
    /// Charts whose normals lie within a cone: more charts in less time.
    Fast,
    /// One disk per component, with few and short seams.
    Disk,
    /// The present UV islands, cut further only where they are not disks. Maps start where the islands
    /// lie.
    Keep,
    /// The pieces between given seams, cut further only where they are not disks.
    Seams,
}

/// A part of a surface, opened to a disk.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The position of each vertex; both sides of a seam have their own.
    pub positions: Vec<[f64; 3]>,
    /// The triangles, consistently wound: most of their area as the surface has it.
    pub disk: Disk,
    /// For each triangle's corners the corners `3 t + c` of the surface they come from; a triangle wound the other way than
    /// its chart has them in reverse order.
    pub corners: Vec<[u32; 3]>,
    /// The plane in which the surface is mirrored that the chart is a part of, if it is cut alike on both sides.
    pub mirror: Option<MirrorPlane>,
}

/// A sheet as a chart. Sheets are disks by construction; should one not be, its triangles are charts of their own.
pub(super) fn open(surface: &Surface, sheet: Sheet) -> Vec<Chart> {
    let corners = consistent_corners(surface, &sheet);
    let triangles = corners
        .iter()
        .map(|local| local.map(|corner| sheet.vertex[corner as usize]))
        .collect();
    let corners = corners
        .iter()
        .map(|local| local.map(|c| 3 * sheet.triangles[c as usize / 3] + c % 3))
        .collect();
    match Disk::new(sheet.positions.len(), triangles) {
        Ok(disk) => vec![Chart {
            positions: sheet.positions,
            disk,
            corners,
            mirror: None,
        }],
        Err(reason) => {
            debug_assert!(false, "opened to no disk: {reason}");
            let singles = sheet.triangles.iter();
            let corners = |t: u32| [3 * t, 3 * t + 1, 3 * t + 2];
            singles
                .filter_map(|&t| Chart::single(surface.corners(t as usize), corners(t)))
                .collect()
        }
    }
}

impl Chart {
    /// One triangle.
    pub(super) fn single(positions: [[f64; 3]; 3], corners: [u32; 3]) -> Option<Self> {
        Some(Self {
            positions: positions.to_vec(),
            disk: Disk::new(3, vec![[0, 1, 2]]).ok()?,
            corners: vec![corners],
            mirror: None,
        })
    }

    /// Whether the surface winds this triangle as its chart does.
    pub fn is_wound_as_surface(&self, triangle: usize) -> bool {
        let [a, b, _] = self.corners[triangle].map(|corner| corner % 3);
        b == (a + 1) % 3
    }

    /// The surface's halfedge that is one of the chart's.
    pub(crate) fn surface_halfedge(&self, h: u32) -> u32 {
        let corner = |h: u32| self.corners[h as usize / 3][h as usize % 3];
        let [from, to] = [h, next(h)].map(corner);
        if next(from) == to { from } else { to }
    }

    /// Seen from behind: every triangle in the other winding.
    pub fn turn_over(&mut self) {
        for triangle in self.disk.triangles.iter_mut().chain(&mut self.corners) {
            triangle.swap(1, 2);
        }
        for boundary in &mut self.disk.loops {
            boundary.reverse();
        }
    }
}

/// The corners of each face of a connected sheet, in reverse where its winding disagrees with that of most area.
fn consistent_corners(surface: &Surface, sheet: &Sheet) -> Vec<[u32; 3]> {
    let n = sheet.triangles.len();
    let mut turned: Vec<Option<bool>> = vec![None; n];
    turned[0] = Some(false);
    let mut order = vec![0u32];
    spread(&sheet.twin, &mut order, |h, t| {
        let is_new = turned[t as usize / 3].is_none();
        if is_new {
            let this = turned[h as usize / 3] == Some(true);
            let same = sheet.vertex[h as usize] == sheet.vertex[t as usize];
            turned[t as usize / 3] = Some(this != same);
        }
        is_new
    });
    let mut balance = 0.0;
    for &f in &order {
        let [a, b, c] = surface.corners(sheet.triangles[f as usize] as usize);
        let area = norm(area_vector(a, b, c));
        let is_turned = turned[f as usize] == Some(true);
        balance += if is_turned { -area } else { area };
    }
    (0..n as u32)
        .map(|f| {
            if (turned[f as usize] == Some(true)) == (balance >= 0.0) {
                [3 * f, 3 * f + 2, 3 * f + 1]
            } else {
                [3 * f, 3 * f + 1, 3 * f + 2]
            }
        })
        .collect()
}

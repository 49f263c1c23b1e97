//! Charts: parts of a surface opened to disks.

use super::regions::within_cones::regions;
use super::symmetry::opening::opened_alike;
use super::symmetry::plane::MirrorPlane;
use crate::cut::{Branches, Sheet, isolate_doubled_edges, join_disks};
use crate::mesh::{CUT, Disk, Surface, UnionFind, next, spread};
use crate::numerics::vec3::{area_vector, norm};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Where a surface is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema, clap::ValueEnum))]
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

/// The charts of a surface, ordered by their first triangles. Deterministic, for any number of threads.
pub fn charts(surface: &Surface, cut: Cut) -> Vec<Chart> {
    charts_alike(surface, cut, None)
}

/// The same, opened alike on both sides of a plane.
pub(super) fn charts_alike(surface: &Surface, cut: Cut, mirror: Option<MirrorPlane>) -> Vec<Chart> {
    let adjacency = surface.adjacency();
    let (region, n_regions) = match cut {
        Cut::Fast => regions(surface),
        Cut::Auto | Cut::Disk | Cut::Keep | Cut::Seams => {
            (adjacency.piece.clone(), adjacency.n_pieces)
        }
    };
    let branches = match cut {
        Cut::Auto | Cut::Keep | Cut::Seams => Branches::None,
        Cut::Fast | Cut::Disk => Branches::ToLimbs,
    };
    let mut twin = opened(surface, &region, n_regions, (branches, mirror));
    if cut == Cut::Disk && !surface.is_cut() {
        join_disks(surface, &mut twin);
    }
    charts_glued(surface, &twin, mirror)
}

/// The charts of given regions of a surface, each opened to a disk, alike on both sides of a plane;
/// `region` labels triangles.
pub(super) fn charts_of_regions(
    surface: &Surface,
    region: &[u32],
    n_regions: usize,
    mirror: Option<MirrorPlane>,
) -> Vec<Chart> {
    let twin = opened(surface, region, n_regions, (Branches::None, mirror));
    charts_glued(surface, &twin, mirror)
}

/// The gluing that is left when regions are parted and opened to disks.
fn opened(
    surface: &Surface,
    region: &[u32],
    n_regions: usize,
    (branches, mirror): (Branches, Option<MirrorPlane>),
) -> Vec<u32> {
    let adjacency = surface.adjacency();
    let mesh = (&*surface.triangles, &*surface.positions);
    let sheets = Sheet::divide(mesh, &adjacency.twin, region, n_regions);
    let mut twin = glued_within(&adjacency.twin, region);
    let seams: Vec<Vec<u32>> = sheets
        .par_iter()
        .map(|sheet| opened_alike(sheet, branches, mirror.as_ref()))
        .collect();
    for (sheet, seams) in sheets.iter().zip(seams) {
        for h in seams {
            for side in [h, sheet.twin[h as usize]] {
                let triangle = sheet.triangles[side as usize / 3];
                twin[(3 * triangle + side % 3) as usize] = CUT;
            }
        }
    }
    isolate_doubled_edges(surface, &mut twin);
    twin
}

/// The charts that a gluing leaves of some faces, which it does not glue to others.
pub(super) fn glued_charts(
    surface: &Surface,
    twin: &mut [u32],
    mirror: Option<MirrorPlane>,
    is_wanted: impl Fn(usize) -> bool,
) -> Vec<Chart> {
    isolate_doubled_edges(surface, twin);
    let mesh = (&*surface.triangles, &*surface.positions);
    let (label, n_charts) = connected_faces(twin);
    let sheets = Sheet::divide(mesh, twin, &label, n_charts).into_iter();
    let wanted = sheets.filter(|sheet| is_wanted(sheet.triangles[0] as usize));
    let charts = wanted.flat_map(|sheet| open(surface, sheet));
    charts.map(|chart| Chart { mirror, ..chart }).collect()
}

/// The charts that a gluing leaves.
fn charts_glued(surface: &Surface, twin: &[u32], mirror: Option<MirrorPlane>) -> Vec<Chart> {
    let mesh = (&*surface.triangles, &*surface.positions);
    let (label, n_charts) = connected_faces(twin);
    Sheet::divide(mesh, twin, &label, n_charts)
        .into_par_iter()
        .flat_map_iter(|sheet| open(surface, sheet))
        .map(|chart| Chart { mirror, ..chart })
        .collect()
}

/// The gluing without what connects different regions.
fn glued_within(twin: &[u32], region: &[u32]) -> Vec<u32> {
    (0..)
        .zip(twin)
        .map(|(h, &t): (usize, _)| match t {
            CUT => CUT,
            t if region[h / 3] != region[t as usize / 3] => CUT,
            t => t,
        })
        .collect()
}

/// The faces that hang together, labeled.
pub(super) fn connected_faces(twin: &[u32]) -> (Vec<u32>, usize) {
    let mut faces = UnionFind::new(twin.len() / 3);
    for (h, &t) in (0u32..).zip(twin).filter(|(_, t)| **t != CUT) {
        faces.unite(h / 3, t / 3);
    }
    faces.labels()
}

/// A sheet as a chart. Sheets are disks by construction; should one not be, its triangles are charts of their own.
fn open(surface: &Surface, sheet: Sheet) -> Vec<Chart> {
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
    pub(super) fn surface_halfedge(&self, h: u32) -> u32 {
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

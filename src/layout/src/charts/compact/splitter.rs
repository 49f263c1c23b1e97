//! Seams near chords of a map.

use super::chord::Chord;
use super::clusters::Clusters;
use super::own_axes::along_own_axes;
use super::planes::Planes;
use super::split::Split;
use crate::charts::MappedChart;
use crate::charts::crease::edge_costs;
use crate::charts::min_cut::min_cut;
use crate::charts::opened::connected_faces;
use crate::charts::parts::{parted, twins_among};
use crate::charts::symmetry::edge_images::EdgeImages;
use crate::charts::symmetry::image::{Canvas, InPlane};
use crate::charts::unfold::overlaps::capacities;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::CUT;
use unwrapd_method::numerics::support::{Directions, Support};
use unwrapd_method::numerics::vec2::{dot, doubled_area};
use unwrapd_method::solver::Control;

/// How far a seam may leave its chord, in square roots of the chart's area; clusters are narrower.
const BAND: f64 = 0.04;
/// The least area of a part, as a share of the atlas'.
const CRUMB: f64 = 0.005;
/// What a seam costs beside its length, in the unit of the price.
const PER_SEAM: f64 = 0.05;
/// What a cut is worth beside the room it gains, as a share of the smaller part's area: small charts leave less of a square
/// empty than large ones.
const SMALLER: f64 = 0.05;
/// The share of its square that an atlas should fill: no square around one chart should be larger.
const HOPE: f64 = 0.85;
/// The cost of a seam over its length where none may be, for the minimum cut that looks for others.
const NEVER: f64 = 1e3;
/// A chart is too large for the page if the area of the square around it exceeds that of this one so many times.
const TOO_LARGE: f64 = 2.0;

/// A chart whose chords become seams.
pub(super) struct Splitter<'a> {
    sheet: &'a Sheet,
    uv: Vec<[f64; 2]>,
    pub clusters: Clusters,
    /// For each halfedge what a seam along it costs.
    cost: Vec<f64>,
    area: f64,
    /// The room that it takes up, and the square that should be enough for the atlas.
    room: f64,
    pub square: f64,
    planes: Planes,
    /// Whether it is much larger than that.
    is_too_large: bool,
    /// The least area of a part, and what a seam costs beside its length.
    pub crumb: f64,
    per_seam: f64,
    directions: Directions,
    /// Where the chart is its own mirror image; and where its planes stay whole, whose edges are mirrored exactly.
    canvas: Option<Canvas<'a>>,
    images: Option<EdgeImages<'a>>,
}

impl<'a> Splitter<'a> {
    /// The vertices of the sheet are numbered anew.
    pub(super) fn new(mapped: &MappedChart, sheet: &'a Sheet, unit: f64) -> Self {
        let mut uv = vec![[0.0; 2]; sheet.positions.len()];
        let corners = mapped.chart.disk.triangles.as_flattened();
        for (&v, &of_chart) in sheet.vertex.iter().zip(corners) {
            uv[v as usize] = mapped.embedding.uv[of_chart as usize];
        }
        let uv = along_own_axes(sheet, &uv);
        let directions = Directions::default();
        let square = unit * unit / HOPE;
        let whole = vec![0; sheet.triangles.len()];
        let hull = hulls_of(sheet, &uv, &directions, &whole, 1).swap_remove(0);
        let cost = edge_costs(sheet);
        let planes = Planes::of(sheet, &uv, &cost, hull.area());
        let clusters = Clusters::new(sheet, &uv, &cost, planes);
        let canvas = (mapped.chart.mirror).and_then(|plane| Canvas::new(sheet, &plane));
        let are_exact = canvas.is_some() && planes != Planes::Cut;
        let mirror = mapped.chart.mirror.filter(|_| are_exact);
        Self {
            images: mirror.map(|plane| EdgeImages::new(sheet, &plane)),
            cost,
            area: clusters.area.iter().sum(),
            room: hull.room(square),
            square,
            planes,
            is_too_large: hull.square() > TOO_LARGE * square,
            crumb: CRUMB * unit * unit,
            per_seam: PER_SEAM * unit,
            directions,
            canvas,
            sheet,
            uv,
            clusters,
        }
    }

    /// The same where planes may be cut, too; none if they may be already, or the page is not too small for the chart.
    pub(super) fn cutting_planes(self) -> Option<Self> {
        (self.is_too_large && self.planes != Planes::Cut).then(|| Self {
            clusters: Clusters::new(self.sheet, &self.uv, &self.cost, Planes::Cut),
            planes: Planes::Cut,
            images: None,
            ..self
        })
    }

    pub(super) fn n_faces(&self) -> usize {
        self.sheet.triangles.len()
    }

    /// The seam near a chord, if it leaves parts of some size and crosses no plane that stays whole.
    pub(super) fn split(&self, chord: &Chord, control: &dyn Fn() -> Control) -> Option<Split> {
        let is_piece = self.refined(&self.beyond(chord), chord, control);
        let twin = &self.sheet.twin;
        let exactly = self.images.as_ref().and_then(|of| of.cut_alike(&is_piece));
        let (part, n_parts) = connected_faces(&match (exactly, &self.canvas) {
            (Some(twin), _) => twin,
            (None, Some(canvas)) => canvas.cut_alike(&is_piece, InPlane::Refused)?,
            (None, None) => parted(twin, &is_piece),
        });
        let seam = || {
            (0u32..).zip(twin).filter(|&(h, &t)| {
                t != CUT && h < t && part[h as usize / 3] != part[t as usize / 3]
            })
        };
        let cost = |h: u32| self.cost[h as usize].max(self.sheet.length(h));
        if seam().any(|(h, _)| self.is_kept(h)) {
            return None;
        }
        let mut areas = vec![0.0; n_parts];
        for (face, &part) in part.iter().enumerate() {
            areas[part as usize] += self.face_area(face);
        }
        if n_parts < 2 || areas.iter().any(|&area| area < self.crumb) {
            return None;
        }
        let hulls = hulls_of(self.sheet, &self.uv, &self.directions, &part, n_parts);
        let rooms = hulls.iter().map(|hull| hull.room(self.square));
        let gain = self.room - rooms.sum::<f64>();
        let smallest = areas.iter().copied().fold(f64::INFINITY, f64::min);
        let length = seam().map(|(h, _)| cost(h)).sum();
        Some(Split {
            worth: self.worth(gain, smallest, length, n_parts - 1),
            part,
            length,
            planes: self.planes,
        })
    }

    /// What a cut of some length into so many parts more is worth that gains so much room and of which the smallest part has some
    /// area.
    pub(super) fn worth(&self, gain: f64, area: f64, length: f64, n_new: usize) -> f64 {
        let cost = length + n_new as f64 * self.per_seam;
        (gain + SMALLER * area.min(self.area - area)) / cost
    }

    /// The faces of the clusters that the chord cuts off.
    fn beyond(&self, chord: &Chord) -> Vec<bool> {
        let Clusters {
            centre,
            neighbors,
            of_face,
            ..
        } = &self.clusters;
        let mut is_in = vec![false; centre.len()];
        is_in[chord.cluster as usize] = true;
        let mut open = vec![chord.cluster];
        while let Some(cluster) = open.pop() {
            for &(next, _) in &neighbors[cluster as usize] {
                let is_beyond = dot(centre[next as usize], chord.direction) > chord.offset;
                if is_beyond && !std::mem::replace(&mut is_in[next as usize], true) {
                    open.push(next);
                }
            }
        }
        of_face
            .iter()
            .map(|&cluster| is_in[cluster as usize])
            .collect()
    }

    /// The piece with the cheapest border within a band around the chord.
    fn refined(
        &self,
        is_piece: &[bool],
        chord: &Chord,
        control: &dyn Fn() -> Control,
    ) -> Vec<bool> {
        let band = BAND * self.area.sqrt();
        let is_near: Vec<bool> = (0..is_piece.len() as u32)
            .map(|f| (self.reach(f, chord.direction) - chord.offset).abs() < band)
            .collect();
        let is_near = |f: u32| is_near[f as usize];
        let sheet = self.sheet;
        let touches = |f: u32, what: &dyn Fn(u32) -> bool| {
            (3 * f..3 * f + 3)
                .any(|h| sheet.twin[h as usize] != CUT && what(sheet.twin[h as usize] / 3))
        };
        // The band and the faces beside it.
        let faces: Vec<u32> = (0..is_piece.len() as u32)
            .filter(|&f| is_near(f) || touches(f, &is_near))
            .collect();
        let twin = twins_among(&sheet.twin, &faces);
        let halfedges = faces.iter().flat_map(|&f| 3 * f..3 * f + 3);
        let cost = |h: u32| {
            if self.is_kept(h) {
                NEVER * sheet.length(h)
            } else {
                self.cost[h as usize]
            }
        };
        let cost: Vec<f64> = halfedges.map(cost).collect();
        let beside = |side: bool| -> Vec<u32> {
            let far = (0..)
                .zip(&faces)
                .filter(|&(_, &f)| !is_near(f) && is_piece[f as usize] == side);
            far.map(|(i, _)| i).collect()
        };
        let stays = min_cut(
            &twin,
            &capacities(&twin, &cost),
            &beside(true),
            &beside(false),
            control,
        );
        let mut refined = is_piece.to_vec();
        for (&f, stays) in faces.iter().zip(stays) {
            refined[f as usize] = stays;
        }
        refined
    }

    /// Whether no seam may run along a halfedge.
    fn is_kept(&self, h: u32) -> bool {
        self.planes
            .keep(self.cost[h as usize], self.sheet.length(h))
    }

    fn corners(&self, face: usize) -> [[f64; 2]; 3] {
        [3 * face, 3 * face + 1, 3 * face + 2].map(|c| self.uv[self.sheet.vertex[c] as usize])
    }

    fn face_area(&self, face: usize) -> f64 {
        let [a, b, c] = self.corners(face);
        doubled_area(a, b, c) / 2.0
    }

    /// How far a face's center lies in a direction.
    fn reach(&self, face: u32, direction: [f64; 2]) -> f64 {
        let corners = self.corners(face as usize);
        corners.iter().map(|&p| dot(p, direction)).sum::<f64>() / 3.0
    }
}

/// The hull of each part of the faces, from the edges at which it ends.
fn hulls_of(
    sheet: &Sheet,
    uv: &[[f64; 2]],
    directions: &Directions,
    part: &[u32],
    n_parts: usize,
) -> Vec<Support> {
    let mut hulls = vec![Support::EMPTY; n_parts];
    for (h, &t) in (0u32..).zip(&sheet.twin) {
        let of = part[h as usize / 3];
        if t == CUT || part[t as usize / 3] != of {
            for v in sheet.ends(h) {
                hulls[of as usize].add(uv[v as usize], directions);
            }
        }
    }
    hulls
}

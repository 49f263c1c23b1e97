//! Seams of a chart, drawn once more as their mirror images.

use super::chains::{Chain, border};
use super::edge_images::{EdgeImages, border_edges, without};
use super::own_image::are_own_image;
use super::plane::MirrorPlane;
use super::sheet_mirror::SheetMirror;
use super::way::{Way, along, vertices_at};
use crate::charts::chart::Chart;
use unwrapd_maps::cut::{Neighbors, Sheet};
use unwrapd_method::numerics::vec3::{distance, polyline_length};

/// How far the ends of an image may lie from their places, in mean lengths of the edges.
const ASTRAY: f64 = 3.0;

/// The gluing of a chart that is its own mirror image without the border at which `is_inside` changes and the mirror image of
/// that; none if it is not, or if the image cannot be drawn.
pub fn cut_alike(chart: &Chart, is_inside: &[bool]) -> Option<Vec<u32>> {
    let plane = chart.mirror?;
    let sheet = sheet_of(chart);
    Canvas::new(&sheet, &plane)?.cut_alike(is_inside, InPlane::Allowed)
}

/// The gluing of a chart without the edges nearest to the mirror image of the border between the parts of another; none if it
/// cannot be drawn.
pub fn cut_as_image(chart: &Chart, of: &Chart, part: &[u32]) -> Option<Vec<u32>> {
    let plane = chart.mirror?;
    let [sheet, other] = [chart, of].map(sheet_of);
    let [canvas, from] = [&sheet, &other].map(|sheet| Canvas::any(sheet, &plane));
    let mut edges = Vec::new();
    for chain in border(&other, part) {
        edges.extend(canvas.image(&from.line(&chain)?)?);
    }
    Some(without(&sheet.twin, edges))
}

/// The same where each edge has an exact mirror image.
pub fn cut_as_exact_image(chart: &Chart, of: &Chart, part: &[u32]) -> Option<Vec<u32>> {
    let plane = chart.mirror?;
    let [sheet, other] = [chart, of].map(sheet_of);
    let edges = EdgeImages::new(&sheet, &plane).of(&other, &border_edges(&other, part))?;
    Some(without(&sheet.twin, edges))
}

fn sheet_of(chart: &Chart) -> Sheet {
    Sheet::of_disk(&chart.disk, &chart.positions)
}

/// A line to be drawn, and whether its ends shall lie on the boundary.
struct DrawnLine {
    points: Vec<[f64; 3]>,
    ends: [bool; 2],
}

/// Whether a chart may be cut in the plane itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InPlane {
    Allowed,
    Refused,
}

/// A sheet on which images are drawn.
pub struct Canvas<'a> {
    sheet: &'a Sheet,
    neighbors: Neighbors,
    on_boundary: Vec<bool>,
    mirror: SheetMirror,
}

impl<'a> Canvas<'a> {
    /// A sheet and the plane in which it is its own mirror image; none if it is not.
    pub fn new(sheet: &'a Sheet, plane: &MirrorPlane) -> Option<Self> {
        are_own_image(sheet.vertex.as_chunks().0, &sheet.positions, plane)
            .then(|| Self::any(sheet, plane))
    }

    fn any(sheet: &'a Sheet, plane: &MirrorPlane) -> Self {
        Self {
            neighbors: Neighbors::new(sheet),
            on_boundary: sheet.on_boundary(),
            mirror: SheetMirror::any(sheet, plane),
            sheet,
        }
    }

    /// The gluing without a border and its mirror image; none if that cannot be drawn. Of a border that crosses the plane the
    /// shorter side is kept, and drawn once more.
    pub fn cut_alike(&self, is_inside: &[bool], in_plane: InPlane) -> Option<Vec<u32>> {
        let mut edges = Vec::new();
        for chain in border(self.sheet, is_inside) {
            let kept = self.shorter_side(chain)?;
            edges.extend(self.edges(&kept));
            let is_in_plane = kept.iter().all(|&v| self.mirror.has(self.sheet, v));
            if !is_in_plane {
                edges.extend(self.image(&self.line(&kept)?)?);
            } else if in_plane == InPlane::Refused {
                return None;
            }
        }
        Some(without(&self.sheet.twin, edges))
    }

    fn line(&self, chain: &Chain) -> Option<DrawnLine> {
        let is_end = |v: u32| self.on_boundary[v as usize];
        Some(DrawnLine {
            ends: [is_end(*chain.first()?), is_end(*chain.last()?)],
            points: self.mirrored(chain),
        })
    }

    /// The edges along a line.
    fn image(&self, DrawnLine { points, ends }: &DrawnLine) -> Option<Vec<u32>> {
        if points.first() != points.last() {
            return self.way(points, *ends).map(|way| way.edges);
        }
        let (there, back) = points.split_at(points.len() / 2);
        let there = [there, &[*back.first()?]].concat();
        let edges = [
            self.way(&there, [ends[0], false])?.edges,
            self.way(back, [false, ends[1]])?.edges,
        ];
        Some(edges.concat())
    }

    /// The way near a line from its first point to its last, each on the boundary or not.
    fn way(&self, line: &[[f64; 3]], on_boundary: [bool; 2]) -> Option<Way> {
        let from = self.place(*line.first()?, on_boundary[0])?;
        let to = self.place(*line.last()?, on_boundary[1])?;
        let is_end = |v: u32| from.contains(&v) || to.contains(&v);
        let is_barred = |v: u32| self.on_boundary[v as usize] && !is_end(v);
        let near = along(self.sheet, line);
        let cost = |h: u32| {
            let is_barred = self.sheet.ends(h).into_iter().any(is_barred);
            if is_barred { f64::INFINITY } else { near(h) }
        };
        let is_goal = |v: u32| to.contains(&v);
        let sources = from.iter().copied();
        Way::cheapest(self.sheet, &self.neighbors, sources, cost, is_goal)
    }

    fn place(&self, point: [f64; 3], on_boundary: bool) -> Option<Vec<u32>> {
        let is_allowed = |v: u32| !on_boundary || self.on_boundary[v as usize];
        let there = vertices_at(self.sheet, point, is_allowed);
        let &first = there.first()?;
        let astray = distance(self.sheet.positions[first as usize], point);
        (astray <= ASTRAY * self.mirror.edge).then_some(there)
    }

    /// A chain that stays on one side of the plane, or the shorter of two sides; none if it changes sides more often.
    fn shorter_side(&self, mut chain: Chain) -> Option<Chain> {
        let is_ring = chain.first() == chain.last();
        let crossing = chain.iter().position(|&v| self.mirror.has(self.sheet, v));
        if is_ring && let Some(place) = crossing {
            chain.pop();
            let n = chain.len();
            chain.rotate_left(place % n);
            chain.push(chain[0]);
        }
        let mut sides = self.sides(&chain).into_iter();
        match (sides.next(), sides.next(), sides.next()) {
            (Some(side), None, None) => Some(side),
            (Some(a), Some(b), None) if self.length(&a) <= self.length(&b) => Some(a),
            (Some(_), Some(b), None) => Some(b),
            _ => None,
        }
    }

    /// The parts of a chain on one side and the other.
    fn sides(&self, chain: &Chain) -> Vec<Chain> {
        let mut sides: Vec<Chain> = Vec::new();
        // The first vertex of the present side, the last in the plane, and the side.
        let (mut start, mut in_plane, mut side) = (0, None, 0.0);
        for (i, &v) in chain.iter().enumerate() {
            if self.mirror.has(self.sheet, v) {
                in_plane = Some(i);
                continue;
            }
            let height = self.mirror.plane.height(self.sheet.positions[v as usize]);
            if side != 0.0 && side != height.signum() {
                let end = in_plane.unwrap_or(i);
                sides.push(chain[start..=end].to_vec());
                start = end;
            }
            (in_plane, side) = (None, height.signum());
        }
        sides.push(chain[start..].to_vec());
        sides
    }

    fn mirrored(&self, chain: &Chain) -> Vec<[f64; 3]> {
        let positions = chain.iter().map(|&v| self.sheet.positions[v as usize]);
        positions.map(|p| self.mirror.plane.mirrored(p)).collect()
    }

    fn edges(&self, chain: &Chain) -> Vec<u32> {
        let edge = |ends: &[u32]| {
            let around = self.neighbors.of(ends[0]).iter().copied();
            around
                .into_iter()
                .find(|&h| self.sheet.ends(h).contains(&ends[1]))
        };
        chain.windows(2).filter_map(edge).collect()
    }

    fn length(&self, chain: &Chain) -> f64 {
        let positions = chain.iter().map(|&v| self.sheet.positions[v as usize]);
        let positions: Vec<[f64; 3]> = positions.collect();
        polyline_length(&positions)
    }
}

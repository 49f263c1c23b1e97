//! Slits on both sides of a mirror plane.

use super::slits::Slits;
use crate::charts::symmetry::sheet_mirror::SheetMirror;
use crate::charts::symmetry::way::{Way, along, vertices_at};
use unwrapd_method::numerics::vec3::{distance, polyline_length};

/// A slit begins in the plane if its tip is nearer to it than this share of its length: two slits side by side would part a
/// strip.
const BESIDE: f64 = 0.25;

/// How far the mirror image of a slit may begin from its place, in mean lengths of its edges.
const ASTRAY: f64 = 3.0;

impl Slits {
    /// Plans a slit to a vertex and its mirror image, or one in the plane: its length.
    ///
    /// The cheaper side decides how it runs.
    pub(super) fn slit_alike(&mut self, tip: u32, mirror: &SheetMirror) -> Option<f64> {
        let way = self.way_beside(tip, mirror)?;
        if let Some(way) = self.way_in_plane(tip, &way, mirror) {
            self.draw(&way);
            return Some(way.length(&self.sheet));
        }
        let image = mirror.plane.mirrored(self.sheet.positions[tip as usize]);
        let others = vertices_at(&self.sheet, image, |v| self.is_inside(v)).into_iter();
        let other = others
            .filter(|&v| v != tip)
            .find_map(|v| self.way_beside(v, mirror));
        let way = match other {
            Some(other) if other.cost < way.cost => other,
            _ => way,
        };
        self.draw(&way);
        if !mirror.has(&self.sheet, tip) {
            let image = self.way_along(&self.image_of(&way, mirror), |v| self.is_inside(v));
            if let Some(image) = image {
                self.draw(&image);
            }
        }
        Some(way.length(&self.sheet))
    }

    /// The mirror image of a point, if the chart is its own.
    pub(super) fn image(&self, point: [f64; 3]) -> Option<[f64; 3]> {
        self.mirror.map(|mirror| mirror.plane.mirrored(point))
    }

    /// The mirror images of the slits that are planned, but for so many.
    pub(super) fn images(&self, n_first: usize) -> Vec<Vec<[f64; 3]>> {
        let Some(plane) = self.chart().mirror else {
            return Vec::new();
        };
        let mirrored = |line: &Vec<[f64; 3]>| line.iter().map(|&p| plane.mirrored(p)).collect();
        self.lines.iter().skip(n_first).map(mirrored).collect()
    }

    /// The cheapest way from a hole to another seam: in the plane if the hole lies on both sides.
    pub(super) fn way_from_hole(&self, hole: u32, mirror: &SheetMirror) -> Option<Way> {
        let from = self.of_seam(hole);
        let in_plane = from.iter().copied().filter(|&v| mirror.has(&self.sheet, v));
        let in_plane = self.way_within(in_plane, Some(hole), mirror);
        in_plane.or_else(|| self.way(from, Some(hole), |h| self.cost[h as usize]))
    }

    /// Plans the mirror image of a slit that was drawn from a hole, from the hole that is the mirror image of that.
    pub(super) fn draw_image_of_hole(&mut self, way: &Way, mirror: &SheetMirror) {
        let reached = self.seam[way.end() as usize];
        let is_other = |v: u32| !self.is_inside(v) && self.seam[v as usize] != reached;
        let image = self.way_along(&self.image_of(way, mirror), is_other);
        if let Some(image) = image {
            self.draw(&image);
        }
    }

    fn image_of(&self, way: &Way, mirror: &SheetMirror) -> Vec<[f64; 3]> {
        let positions = way.positions(&self.sheet).into_iter();
        positions.map(|p| mirror.plane.mirrored(p)).collect()
    }

    /// The way near a line, from a vertex near its last point that `is_start` to another seam.
    fn way_along(&self, line: &[[f64; 3]], is_start: impl Fn(u32) -> bool) -> Option<Way> {
        let from = vertices_at(&self.sheet, *line.last()?, is_start);
        let &first = from.first()?;
        let astray = distance(self.sheet.positions[first as usize], *line.last()?);
        let edge = polyline_length(line) / (line.len() as f64 - 1.0).max(1.0);
        let own = self.seam[first as usize];
        (astray <= ASTRAY * edge).then(|| self.way(from, own, along(&self.sheet, line)))?
    }

    /// Plans a slit near a line, which leads from a seam.
    pub(super) fn slit_along(&mut self, line: &[[f64; 3]]) {
        if let Some(way) = self.way_along(line, |v| self.is_inside(v)) {
            self.draw(&way);
        }
    }

    fn way_beside(&self, tip: u32, mirror: &SheetMirror) -> Option<Way> {
        let cost = |h: u32| self.cost[h as usize];
        self.way([tip], None, mirror.beside(&self.sheet, tip, cost))
    }

    /// Instead of a way from a vertex near the plane one in the plane.
    fn way_in_plane(&self, tip: u32, way: &Way, mirror: &SheetMirror) -> Option<Way> {
        let near = BESIDE * way.length(&self.sheet);
        if mirror
            .plane
            .height(self.sheet.positions[tip as usize])
            .abs()
            > near
        {
            return None;
        }
        let is_start = |v: u32| mirror.has(&self.sheet, v) && self.is_inside(v);
        let length = |h: u32| self.sheet.length(h);
        let to = Way::cheapest(&self.sheet, &self.neighbors, [tip], length, is_start)?;
        if to.cost > near {
            return None;
        }
        let in_plane = self.way_within([to.end()], None, mirror)?;
        let is_short = in_plane.length(&self.sheet) <= 2.0 * way.length(&self.sheet);
        (is_short || to.edges.is_empty()).then_some(in_plane)
    }

    /// The way in the plane from some vertices to a seam other than their own.
    fn way_within(
        &self,
        from: impl IntoIterator<Item = u32>,
        own: Option<u32>,
        mirror: &SheetMirror,
    ) -> Option<Way> {
        let is_other = |v: u32| !self.is_inside(v) && self.seam[v as usize] != own;
        let is_goal = |v: u32| is_other(v) && mirror.has(&self.sheet, v);
        let is_barred = |v: u32| is_other(v) && !mirror.has(&self.sheet, v);
        let cost = |h: u32| {
            let is_barred = self.sheet.ends(h).into_iter().any(is_barred);
            if is_barred {
                f64::INFINITY
            } else {
                self.cost[h as usize]
            }
        };
        let cost = mirror.within(&self.sheet, cost);
        Way::cheapest(&self.sheet, &self.neighbors, from, cost, is_goal)
    }

    fn is_inside(&self, v: u32) -> bool {
        self.seam[v as usize].is_none()
    }
}

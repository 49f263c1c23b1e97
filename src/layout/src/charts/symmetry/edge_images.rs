//! Edges of a sheet and their mirror images among the edges of another.

use super::plane::MirrorPlane;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::mesh::CUT;
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::point_tree::PointTree;
use unwrapd_method::numerics::vec3::distance;

/// How far the ends of an edge may lie from those of a mirror image, as a part of the sheet's diagonal.
const EXACT: f64 = 1e-4;

/// The edges inside a sheet, to be asked which is the mirror image of one.
pub struct EdgeImages<'a> {
    sheet: &'a Sheet,
    plane: MirrorPlane,
    edges: Vec<u32>,
    middles: PointTree,
    reach: f64,
}

impl<'a> EdgeImages<'a> {
    /// Of the edges of a sheet that are glued. O(n log n).
    pub fn new(sheet: &'a Sheet, plane: &MirrorPlane) -> Self {
        let glued = (0u32..).zip(&sheet.twin);
        let edges = glued.filter(|&(h, &t)| t != CUT && h < t);
        let edges: Vec<u32> = edges.map(|(h, _)| h).collect();
        let [low, high] = bounds_of(&sheet.positions);
        Self {
            plane: *plane,
            middles: PointTree::new(edges.iter().map(|&h| sheet.middle(h)).collect()),
            reach: EXACT * distance(low, high),
            sheet,
            edges,
        }
    }

    /// The gluing without the border at which `is_inside` changes and the mirror image of that; none if an
    /// edge of it has none, or if all of it lies in the plane.
    pub fn cut_alike(&self, is_inside: &[bool]) -> Option<Vec<u32>> {
        let edges = border_edges(self.sheet, is_inside);
        let images = self.of(self.sheet, &edges)?;
        Some(without(&self.sheet.twin, edges.into_iter().chain(images)))
    }

    /// The mirror images of edges of a sheet; none if an edge has none, or if all lie in the plane.
    pub fn of(&self, from: &Sheet, edges: &[u32]) -> Option<Vec<u32>> {
        let in_plane = |&h: &u32| {
            let ends = from.ends(h).map(|v| from.positions[v as usize]);
            ends.iter()
                .all(|&p| self.plane.height(p).abs() <= self.reach)
        };
        if edges.iter().all(in_plane) {
            return None;
        }
        edges.iter().map(|&h| self.image(from, h)).collect()
    }

    fn image(&self, from: &Sheet, h: u32) -> Option<u32> {
        let [a, b] = from
            .ends(h)
            .map(|v| self.plane.mirrored(from.positions[v as usize]));
        let is_near =
            |p: [f64; 3], v: u32| distance(p, self.sheet.positions[v as usize]) <= self.reach;
        let is_image = |i: u32| {
            let [v, w] = self.sheet.ends(self.edges[i as usize]);
            is_near(a, v) && is_near(b, w) || is_near(a, w) && is_near(b, v)
        };
        let middle = [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]));
        let (i, _) = self.middles.nearest(middle, 2.0 * self.reach, is_image)?;
        Some(self.edges[i as usize])
    }
}

/// The edges at which the part changes.
pub fn border_edges<T: PartialEq>(sheet: &Sheet, part: &[T]) -> Vec<u32> {
    let glued = (0u32..).zip(&sheet.twin);
    let is_border =
        |&(h, &t): &(u32, &u32)| t != CUT && h < t && part[h as usize / 3] != part[t as usize / 3];
    glued.filter(is_border).map(|(h, _)| h).collect()
}

/// A gluing without some edges.
pub fn without(twin: &[u32], edges: impl IntoIterator<Item = u32>) -> Vec<u32> {
    let mut twin = twin.to_vec();
    for h in edges {
        let t = std::mem::replace(&mut twin[h as usize], CUT);
        if t != CUT {
            twin[t as usize] = CUT;
        }
    }
    twin
}

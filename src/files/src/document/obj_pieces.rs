//! Splitting of polygons whose corners have several texture coordinates.
use crate::polygon::{smallest_first, triangulate};
use std::collections::HashMap;
use unwrapd_maps::mesh::UnionFind;

/// A polygon with the numbers of texture coordinates per triangle.
pub(super) struct NumberedPolygon<'a> {
    pub n_corners: usize,
    /// Triangles inside it, as indices of its corners.
    pub triangles: Vec<[u32; 3]>,
    /// Numbers of their texture coordinates.
    pub numbers: &'a [[u32; 3]],
}

/// Corners in the order of the polygon, each with the number of its texture coordinate.
type Piece = Vec<(u32, u32)>;

impl NumberedPolygon<'_> {
    /// Returns the whole polygon if each corner has one number, else as few pieces as its triangles allow. A reader
    /// that triangulates a piece gets the polygon's own triangles again: pieces for which it would not are given as
    /// triangles.
    pub fn pieces(&self, position: impl Fn(u32) -> [f64; 3]) -> Vec<Piece> {
        if let Some(whole) = self.whole() {
            return vec![whole];
        }
        let mut pieces = Vec::new();
        for members in self.connected() {
            match self.outline(&members, &position) {
                Some(piece) => pieces.push(piece),
                None => pieces.extend(members.iter().map(|&t| self.triangle(t))),
            }
        }
        pieces
    }

    fn whole(&self) -> Option<Piece> {
        let mut number_of = vec![None; self.n_corners];
        for (&corner, &number) in self.triangles.iter().zip(self.numbers).flat_map(zipped) {
            if *number_of[corner as usize].get_or_insert(number) != number {
                return None;
            }
        }
        let numbered = (0..).zip(number_of);
        numbered
            .map(|(corner, number)| Some((corner, number?)))
            .collect()
    }

    /// Returns the sets of triangles that are connected across diagonals with the same numbers on both sides, in
    /// increasing order.
    fn connected(&self) -> Vec<Vec<usize>> {
        let mut sets = UnionFind::new(self.triangles.len());
        let mut sides = HashMap::new();
        for (t, (corners, numbers)) in self.triangles.iter().zip(self.numbers).enumerate() {
            for k in 0..3 {
                let end = |k: usize| (corners[k % 3], numbers[k % 3]);
                // Neighbors run along a diagonal in opposite directions.
                if let Some(&other) = sides.get(&[end(k + 1), end(k)]) {
                    sets.unite(other, t as u32);
                }
                sides.insert([end(k), end(k + 1)], t as u32);
            }
        }
        let (labels, n) = sets.labels();
        let mut members = vec![Vec::new(); n];
        for (t, &label) in labels.iter().enumerate() {
            members[label as usize].push(t);
        }
        members
    }

    fn triangle(&self, t: usize) -> Piece {
        let corners = zipped((&self.triangles[t], &self.numbers[t]));
        corners.map(|(&corner, &number)| (corner, number)).collect()
    }

    /// Returns the corners of connected triangles, if triangulating them gives these triangles. Among connected
    /// triangles a corner has one number, because the triangles around it are neighbors one after the other.
    fn outline(&self, members: &[usize], position: impl Fn(u32) -> [f64; 3]) -> Option<Piece> {
        let mut piece: Piece = members.iter().flat_map(|&t| self.triangle(t)).collect();
        piece.sort_unstable();
        piece.dedup();
        // Which diagonal a flat quad gets depends on its first corner.
        for _ in 0..2 {
            let corners: Vec<[f64; 3]> =
                piece.iter().map(|&(corner, _)| position(corner)).collect();
            let mut filled = Vec::new();
            triangulate(&corners, &mut filled);
            let mut filled: Vec<[u32; 3]> = filled
                .iter()
                .map(|triangle| smallest_first(triangle.map(|k| piece[k as usize].0)))
                .collect();
            filled.sort_unstable();
            if filled
                .iter()
                .eq(members.iter().map(|&t| &self.triangles[t]))
            {
                return Some(piece);
            }
            piece.rotate_left(1);
        }
        None
    }
}

/// Iterates over the corners of a triangle with their numbers.
fn zipped<'a>(
    (corners, numbers): (&'a [u32; 3], &'a [u32; 3]),
) -> impl Iterator<Item = (&'a u32, &'a u32)> {
    corners.iter().zip(numbers)
}

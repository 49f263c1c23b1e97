//! A part of a surface with its gluing.

use crate::mesh::{CUT, Disk, Surface, UnionFind, next, origin};
use std::array::from_fn;
use unwrapd_method::numerics::vec3::distance;

/// Ratio above which distances count as equal up to rounding.
const SAME: f64 = 1.0 - 1e-6;

/// Some faces of a surface, numbered locally, with the glued edges among them.
///
/// Around a vertex the glued faces form one fan by construction, so a bow-tie vertex of the surface is several vertices
/// here.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// For each face of the sheet its triangle in the surface.
    pub triangles: Vec<u32>,
    /// For each halfedge `3 f + c` the one glued to it, or [`CUT`].
    pub twin: Vec<u32>,
    /// For each corner `3 f + c` its vertex.
    pub vertex: Vec<u32>,
    /// For each vertex its position.
    pub positions: Vec<[f64; 3]>,
}

impl Sheet {
    /// Creates the sheet of a whole disk with these vertex positions. Vertices are numbered in the order of the
    /// triangles' corners. O(n log n).
    pub fn of_disk(disk: &Disk, positions: &[[f64; 3]]) -> Self {
        let mut number = vec![CUT; disk.n_vertices];
        let mut sheet = Self {
            triangles: (0..disk.triangles.len() as u32).collect(),
            twin: disk.twins(),
            vertex: Vec::with_capacity(3 * disk.triangles.len()),
            positions: Vec::with_capacity(disk.n_vertices),
        };
        for &v in disk.triangles.as_flattened() {
            if number[v as usize] == CUT {
                number[v as usize] = sheet.positions.len() as u32;
                sheet.positions.push(positions[v as usize]);
            }
            sheet.vertex.push(number[v as usize]);
        }
        sheet
    }

    /// Divides triangles over some positions, glued by `twin`, into sheets by their labels; label `i` makes sheet `i`.
    pub fn divide(
        (surface, positions): (&[[u32; 3]], &[[f64; 3]]),
        twin: &[u32],
        labels: &[u32],
        n_labels: usize,
    ) -> Vec<Self> {
        let mut triangles = vec![Vec::new(); n_labels];
        let mut local = Vec::with_capacity(labels.len());
        for (t, &label) in labels.iter().enumerate() {
            local.push(triangles[label as usize].len() as u32);
            triangles[label as usize].push(t as u32);
        }
        triangles
            .into_iter()
            .map(|triangles| {
                let twin = triangles
                    .iter()
                    .flat_map(|&t| 3 * t..3 * t + 3)
                    .map(|h| match twin[h as usize] {
                        CUT => CUT,
                        t if labels[t as usize / 3] != labels[h as usize / 3] => CUT,
                        t => 3 * local[t as usize / 3] + t % 3,
                    })
                    .collect();
                Self::new((surface, positions), triangles, twin)
            })
            .collect()
    }

    fn new(
        (surface, all): (&[[u32; 3]], &[[f64; 3]]),
        triangles: Vec<u32>,
        twin: Vec<u32>,
    ) -> Self {
        let welded = |corner: u32| {
            let triangle = triangles[corner as usize / 3] as usize;
            surface[triangle][corner as usize % 3]
        };
        let (vertex, n_vertices) = fans(&twin, welded);
        let mut positions = vec![[0.0; 3]; n_vertices];
        for corner in 0..twin.len() as u32 {
            positions[vertex[corner as usize] as usize] = all[welded(corner) as usize];
        }
        Self {
            triangles,
            twin,
            vertex,
            positions,
        }
    }

    /// Returns the two vertices of a halfedge.
    pub fn ends(&self, h: u32) -> [u32; 2] {
        [self.vertex[h as usize], self.vertex[next(h) as usize]]
    }

    /// Returns the length of a halfedge.
    pub fn length(&self, h: u32) -> f64 {
        let [a, b] = self.ends(h).map(|v| self.positions[v as usize]);
        distance(a, b)
    }

    /// Returns the midpoint of a halfedge.
    pub fn middle(&self, h: u32) -> [f64; 3] {
        let [a, b] = self.ends(h).map(|v| self.positions[v as usize]);
        [0, 1, 2].map(|k| f64::midpoint(a[k], b[k]))
    }

    /// Iterates over one halfedge of each edge.
    pub fn edges(&self) -> impl Iterator<Item = u32> {
        (0u32..)
            .zip(&self.twin)
            .filter(|&(h, &t)| t == CUT || h < t)
            .map(|(h, _)| h)
    }

    /// Returns the vertex farthest from the mean of all among those with `is_one`: a start that does not depend on
    /// numbers, scale and rotation. Returns the first of equally far ones, as on a sphere.
    pub fn outermost(&self, is_one: impl Fn(u32) -> bool) -> Option<u32> {
        let mut sum = [0.0; 3];
        for p in &self.positions {
            sum = from_fn(|k| sum[k] + p[k]);
        }
        let mean = sum.map(|x| x / self.positions.len().max(1) as f64);
        let reach = |v: u32| distance(self.positions[v as usize], mean);
        let all = || (0..self.positions.len() as u32).filter(|&v| is_one(v));
        let farthest = all().map(reach).fold(0.0, f64::max);
        all().find(|&v| reach(v) >= SAME * farthest)
    }

    /// Returns for each vertex whether it lies on the boundary.
    pub fn on_boundary(&self) -> Vec<bool> {
        let mut on_boundary = vec![false; self.positions.len()];
        for h in (0..self.twin.len() as u32).filter(|&h| self.twin[h as usize] == CUT) {
            for v in self.ends(h) {
                on_boundary[v as usize] = true;
            }
        }
        on_boundary
    }
}

/// Numbers the vertices of glued faces: corners are one vertex if glued edges connect them around it. `welded` returns
/// the position of a corner, which tells the ends of two glued halfedges apart.
pub fn fans(twin: &[u32], welded: impl Fn(u32) -> u32) -> (Vec<u32>, usize) {
    let mut corners = UnionFind::new(twin.len());
    for (h, &t) in (0u32..).zip(twin).filter(|&(h, &t)| t != CUT && h < t) {
        let (near, far) = if welded(h) == welded(t) {
            (t, next(t))
        } else {
            (next(t), t)
        };
        corners.unite(h, near);
        corners.unite(next(h), far);
    }
    corners.labels()
}

/// Numbers the vertices of a whole surface glued by `twin`: corners are one vertex if glued edges connect them around
/// it.
pub fn surface_fans(surface: &Surface, twin: &[u32]) -> (Vec<u32>, usize) {
    fans(twin, |corner| origin(&surface.triangles, corner))
}

// Double edges between one pair of vertices.

/// Cuts faces out of a glued surface until no two edges join the same two vertices; returns whether any was cut.
///
/// Only a non-manifold input can have such edges: the copies of an edge with several faces may have both ends in
/// common. All copies but one are taken out together with the faces at them. The remainder has the same genus and a
/// longer boundary, so disks fall into disks.
pub fn isolate_doubled_edges(surface: &Surface, twin: &mut [u32]) -> bool {
    if surface.defects.nonmanifold_edges == 0 {
        return false;
    }
    let mut any = false;
    loop {
        let doubled = doubled_edges(surface, twin);
        if doubled.is_empty() {
            return any;
        }
        any = true;
        for h in doubled {
            let t = twin[h as usize];
            cut_face_out(twin, h);
            if t != CUT {
                cut_face_out(twin, t);
                twin[h as usize] = t;
                twin[t as usize] = h;
            }
        }
    }
}

fn cut_face_out(twin: &mut [u32], h: u32) {
    for side in [h, next(h), next(next(h))] {
        let t = std::mem::replace(&mut twin[side as usize], CUT);
        if t != CUT {
            twin[t as usize] = CUT;
        }
    }
}

/// Returns one halfedge of each edge that has an earlier copy between the same two vertices.
fn doubled_edges(surface: &Surface, twin: &[u32]) -> Vec<u32> {
    let (vertex, _) = surface_fans(surface, twin);
    let mut edges: Vec<(u32, u32, u32)> = (0u32..)
        .zip(twin)
        .filter(|&(h, &t)| t == CUT || h < t)
        .map(|(h, _)| {
            let (a, b) = (vertex[h as usize], vertex[next(h) as usize]);
            (a.min(b), a.max(b), h)
        })
        .collect();
    edges.sort_unstable();
    edges
        .windows(2)
        .filter(|w| (w[0].0, w[0].1) == (w[1].0, w[1].1))
        .map(|w| w[1].2)
        .collect()
}

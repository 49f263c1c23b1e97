//! Surfaces cut where they pass from one tetrahedron into the next.
//!
//! The tetrahedra of all voxels are the cells of six families of parallel planes: x, y, z, x − y, y − z and x − z at
//! integer numbers of voxels. So a triangle is cut by one family after the other, and every piece lies in one
//! tetrahedron.

use super::{Cage, CageError, CagedSurface};
use std::collections::HashMap;
use unwrapd_maps::mesh::validate;
use unwrapd_method::numerics::vec3::{add_scaled, sub};

/// Distance, in voxels, within which a vertex lies on a plane: above the rounding of f32, in which files store
/// positions, so that no slivers without area are cut off: with 1e-9 some had a symmetric Dirichlet energy of 2e11.
const SNAP: f64 = 1e-5;
/// Most triangles of a split surface.
const MOST_PIECES: usize = 20_000_000;

/// A vertex added where a triangle was cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Added {
    /// A triangle of the original surface that contains it.
    pub triangle: u32,
    /// Barycentric weights in that triangle.
    pub weights: [f64; 3],
}

/// A surface cut at the faces of a cage's tetrahedra.
#[derive(Clone, Debug, Default)]
pub struct SplitSurface {
    /// Original vertices, then the added ones.
    pub positions: Vec<[f64; 3]>,
    /// Data for interpolating attributes at the added vertices.
    pub added: Vec<Added>,
    /// Pieces, in the order of their triangles, wound like these.
    pub triangles: Vec<[u32; 3]>,
    /// For each piece its triangle in the original surface.
    pub parents: Vec<u32>,
    /// For each piece and corner the barycentric weights in that triangle.
    pub weights: Vec<[[f64; 3]; 3]>,
}

impl Cage {
    /// Cuts the triangles so that each piece lies in one tetrahedron.
    ///
    /// Neighbors stay neighbors: pieces share the vertices on a common edge. Two edges with equal ends that are not one
    /// edge, as on seams, get vertices at equal positions.
    pub fn split(&self, surface: &CagedSurface) -> Result<SplitSurface, CageError> {
        validate(surface.positions, surface.triangles, "triangles")
            .map_err(|error| CageError::Surface { surface: 0, error })?;
        let levels = surface
            .positions
            .iter()
            .map(|&p| snapped(levels(self.grid.local(p))));
        let mut cutter = SurfaceCutter {
            levels: levels.collect(),
            result: SplitSurface {
                positions: surface.positions.to_vec(),
                ..SplitSurface::default()
            },
            cuts: HashMap::new(),
        };
        for (parent, &triangle) in surface.triangles.iter().enumerate() {
            cutter.split(parent as u32, triangle);
            if cutter.result.triangles.len() > MOST_PIECES {
                return Err(CageError::TooFine("20 million pieces of triangles"));
            }
        }
        Ok(cutter.result)
    }
}

/// Coordinates that are integers on the planes of the six families.
type Levels = [f64; 6];

fn levels([x, y, z]: [f64; 3]) -> Levels {
    [x, y, z, x - y, y - z, x - z]
}

fn snapped(levels: Levels) -> Levels {
    levels.map(|s| {
        if (s - s.round()).abs() < SNAP {
            s.round()
        } else {
            s
        }
    })
}

/// A corner of a piece.
#[derive(Clone, Copy)]
struct CageCorner {
    vertex: u32,
    weights: [f64; 3],
}

struct SurfaceCutter {
    /// Levels of every vertex.
    levels: Vec<Levels>,
    result: SplitSurface,
    /// The vertex that cuts an edge, keyed by the edge's ends in increasing order. An edge is cut by the first plane,
    /// in the order of the families and levels, that passes between its ends, whichever triangle is cut.
    cuts: HashMap<[u32; 2], u32>,
}

impl SurfaceCutter {
    fn split(&mut self, parent: u32, triangle: [u32; 3]) {
        let weights = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let corner = |k: usize| CageCorner {
            vertex: triangle[k],
            weights: weights[k],
        };
        let mut pieces = vec![vec![corner(0), corner(1), corner(2)]];
        for family in 0..6 {
            let mut thinner = Vec::new();
            for piece in pieces {
                self.slice(parent, piece, family, &mut thinner);
            }
            pieces = thinner;
        }
        for piece in pieces {
            for k in 1..piece.len() - 1 {
                let corners = [piece[0], piece[k], piece[k + 1]];
                self.result.triangles.push(corners.map(|c| c.vertex));
                self.result.weights.push(corners.map(|c| c.weights));
                self.result.parents.push(parent);
            }
        }
    }

    /// Cuts a convex piece along all planes of a family that pass through it, from the lowest.
    fn slice(
        &mut self,
        parent: u32,
        piece: Vec<CageCorner>,
        family: usize,
        slices: &mut Vec<Vec<CageCorner>>,
    ) {
        // Range of the levels of the piece's corners.
        let level = |cutter: &Self, c: &CageCorner| cutter.levels[c.vertex as usize][family];
        let range = |pick: fn(f64, f64) -> f64, from: f64| {
            piece
                .iter()
                .fold(from, |best, c| pick(best, level(self, c)))
        };
        let (low, high) = (
            range(f64::min, f64::INFINITY),
            range(f64::max, f64::NEG_INFINITY),
        );
        // From plane to plane: corners on a plane belong to both sides, an edge that crosses it is cut.
        let mut rest = piece;
        let mut plane = low.floor() + 1.0;
        while plane < high {
            let (mut lower, mut upper) = (Vec::new(), Vec::new());
            for (k, corner) in rest.iter().enumerate() {
                let next = rest[(k + 1) % rest.len()];
                let (here, there) = (level(self, corner), level(self, &next));
                if here <= plane {
                    lower.push(*corner);
                }
                if here >= plane {
                    upper.push(*corner);
                }
                if (here < plane && plane < there) || (there < plane && plane < here) {
                    let cut = self.cut(parent, [*corner, next], family, plane);
                    lower.push(cut);
                    upper.push(cut);
                }
            }
            slices.push(lower);
            rest = upper;
            plane += 1.0;
        }
        slices.push(rest);
    }

    /// Returns the corner where an edge passes a plane; independent of side and direction.
    fn cut(&mut self, parent: u32, ends: [CageCorner; 2], family: usize, plane: f64) -> CageCorner {
        let position = |c: CageCorner| self.result.positions[c.vertex as usize];
        let [mut a, mut b] = ends;
        if position(b) < position(a) {
            (a, b) = (b, a);
        }
        let (from, to) = (
            self.levels[a.vertex as usize],
            self.levels[b.vertex as usize],
        );
        let t = (plane - from[family]) / (to[family] - from[family]);
        let weights = add_scaled(a.weights, t, sub(b.weights, a.weights));
        let key = [a.vertex.min(b.vertex), a.vertex.max(b.vertex)];
        let next = self.levels.len() as u32;
        let vertex = *self.cuts.entry(key).or_insert(next);
        if vertex == next {
            let (p, q) = (position(a), position(b));
            let mut levels: Levels = std::array::from_fn(|k| from[k] + t * (to[k] - from[k]));
            levels[family] = plane;
            self.levels.push(snapped(levels));
            self.result.positions.push(add_scaled(p, t, sub(q, p)));
            self.result.added.push(Added {
                triangle: parent,
                weights,
            });
        }
        CageCorner { vertex, weights }
    }
}

//! Lengths, angles and areas of a surface, in units of the root of its area.

use unwrapd_maps::mesh::{CUT, NEEDLE, Surface, next};
use unwrapd_method::numerics::ties::tied;
use unwrapd_method::numerics::vec3::{area_vector, cross, distance, dot, norm, sub, unit};

/// Height of a needle's rest shape over its longest side: ten times the largest height of a needle, so that the solver
/// can place it.
const RAISED: f64 = 1e-3;

/// A surface with consistently wound faces, measured in units in which its area is 1.
///
/// Halfedge `3 f + k` runs from corner k of face f to the next one. Edges whose two faces cannot be wound alike, as on a
/// Möbius strip, are boundary.
pub struct Metric<'a> {
    pub surface: &'a Surface,
    /// Length of a unit in the mesh's unit.
    pub unit: f64,
    /// Vertices of each face, in its winding here.
    pub corners: Vec<[u32; 3]>,
    /// For each face whether its winding is the opposite of that of the surface.
    pub is_turned: Vec<bool>,
    /// For each halfedge the one across, or [`CUT`].
    pub twin: Vec<u32>,
    /// For each halfedge its edge.
    pub edge: Vec<u32>,
    /// For each edge its first halfedge.
    pub halfedge: Vec<u32>,
    /// Length of each edge, [rounded](tied).
    pub length: Vec<f64>,
    /// Angle between the normals of the faces at each edge; π at the boundary.
    pub fold: Vec<f64>,
    /// Area of each face.
    pub area: Vec<f64>,
    /// Area of each face, times what its excess counts.
    pub weight: Vec<f64>,
    /// Stretch, max(σ₁, 1/σ₂), beyond which a face counts as stretched.
    pub most_stretch: f64,
    /// Angle at each corner.
    pub angle: Vec<f64>,
    /// Cotangent of the angle at each corner of the rest shape.
    pub cotangent: Vec<f64>,
    /// For each face the inverse of the matrix whose columns are its first and last side at rest.
    pub rest: Vec<[[f64; 2]; 2]>,
    /// For each face its longest halfedge if it is a needle.
    pub needle: Vec<Option<u32>>,
}

/// Distortion of a mapped face.
pub struct Distortion {
    /// Symmetric Dirichlet energy over 4.
    pub excess: f64,
    /// Determinant of the Jacobian.
    pub det: f64,
    /// max(σ₁, 1/σ₂).
    pub stretch: f64,
}

impl<'a> Metric<'a> {
    /// Measures a surface; every face has weight 1.
    pub fn new(surface: &'a Surface) -> Self {
        let adjacency = surface.adjacency();
        let n = surface.triangles.len();
        let is_turned = adjacency.turned.clone();
        // Halfedge k of a turned face runs along halfedge 2 − k of the surface.
        let own = |h: u32| {
            let (f, k) = (h / 3, h % 3);
            3 * f + if is_turned[f as usize] { 2 - k } else { k }
        };
        let mut twin = vec![CUT; 3 * n];
        for (h, &t) in (0u32..).zip(&adjacency.twin) {
            if t != CUT && !adjacency.is_twisted(&surface.triangles, h) {
                twin[own(h) as usize] = own(t);
            }
        }
        let corners: Vec<[u32; 3]> = (surface.triangles.iter().zip(&is_turned))
            .map(|(&[a, b, c], turned)| if *turned { [a, c, b] } else { [a, b, c] })
            .collect();
        let doubled = |f: usize| {
            let [a, b, c] = surface.corners(f);
            norm(area_vector(a, b, c))
        };
        let total: f64 = (0..n).map(doubled).sum::<f64>() / 2.0;
        let unit_length = total.sqrt().max(f64::MIN_POSITIVE);
        let mut metric = Self {
            surface,
            unit: unit_length,
            corners,
            is_turned,
            twin,
            edge: vec![0; 3 * n],
            halfedge: Vec::new(),
            length: Vec::new(),
            fold: Vec::new(),
            area: Vec::with_capacity(n),
            weight: Vec::new(),
            most_stretch: f64::INFINITY,
            angle: Vec::with_capacity(3 * n),
            cotangent: Vec::with_capacity(3 * n),
            rest: Vec::with_capacity(n),
            needle: Vec::with_capacity(n),
        };
        for face in 0..n {
            metric.measure_face(face);
        }
        metric.weight = metric.area.clone();
        metric.measure_edges();
        metric
    }

    /// Returns the position of a vertex of the surface.
    pub fn position(&self, vertex: u32) -> [f64; 3] {
        self.surface.positions[vertex as usize].map(|x| x / self.unit)
    }

    fn measure_face(&mut self, face: usize) {
        let p = self.corners[face].map(|v| self.position(v));
        let side = [0, 1, 2].map(|k| distance(p[k], p[(k + 1) % 3]));
        let longest = (0..3).fold(0, |best, k| if side[k] > side[best] { k } else { best });
        let area = norm(area_vector(p[0], p[1], p[2])) / 2.0;
        let base = side[longest].max(f64::MIN_POSITIVE);
        let is_needle = 2.0 * area < NEEDLE * base * base;
        // Lay the longest side along the first axis, and raise the third corner of a needle.
        let [a, b, c] = [longest, (longest + 1) % 3, (longest + 2) % 3];
        let along = unit(sub(p[b], p[a]));
        let foot = dot(sub(p[c], p[a]), along).clamp(0.0, base);
        let least = if is_needle { RAISED * base } else { 0.0 };
        let height = (2.0 * area / base).max(least);
        let mut flat = [[0.0; 2]; 3];
        flat[b] = [base, 0.0];
        flat[c] = [foot, height];
        let (first, last) = (minus(flat[1], flat[0]), minus(flat[2], flat[0]));
        let det = first[0] * last[1] - first[1] * last[0];
        self.rest.push([
            [last[1] / det, -last[0] / det],
            [-first[1] / det, first[0] / det],
        ]);
        for k in 0..3 {
            let (q, r) = ((k + 1) % 3, (k + 2) % 3);
            let [u, v] = [sub(p[q], p[k]), sub(p[r], p[k])];
            self.angle.push(norm(cross(u, v)).atan2(dot(u, v)));
            let [u, v] = [minus(flat[q], flat[k]), minus(flat[r], flat[k])];
            let turn = u[0] * v[1] - u[1] * v[0];
            self.cotangent.push((u[0] * v[0] + u[1] * v[1]) / turn);
        }
        self.area.push(area);
        let longest = (3 * face + longest) as u32;
        self.needle.push(is_needle.then_some(longest));
    }

    fn measure_edges(&mut self) {
        for h in 0..self.twin.len() as u32 {
            let t = self.twin[h as usize];
            if t != CUT && t < h {
                self.edge[h as usize] = self.edge[t as usize];
                continue;
            }
            self.edge[h as usize] = self.halfedge.len() as u32;
            self.halfedge.push(h);
            let [a, b] = self.ends(h).map(|v| self.position(v));
            self.length.push(tied(distance(a, b)));
            self.fold.push(if t == CUT {
                std::f64::consts::PI
            } else {
                let [m, n] = [h / 3, t / 3].map(|face| self.normal(face));
                norm(cross(m, n)).atan2(dot(m, n))
            });
        }
    }

    /// Returns the unit normal of a face; zero for one without area.
    fn normal(&self, face: u32) -> [f64; 3] {
        let [a, b, c] = self.corners[face as usize].map(|v| self.position(v));
        unit(area_vector(a, b, c))
    }

    /// Returns the two vertices of a halfedge.
    pub fn ends(&self, h: u32) -> [u32; 2] {
        [h, next(h)].map(|h| self.corners[h as usize / 3][h as usize % 3])
    }

    /// Returns the two vertices of an edge.
    pub fn ends_of_edge(&self, edge: u32) -> [u32; 2] {
        self.ends(self.halfedge[edge as usize])
    }

    /// Returns the total length of some edges.
    pub fn length_of(&self, edges: &[u32]) -> f64 {
        edges.iter().map(|&e| self.length[e as usize]).sum()
    }

    /// Returns the corners of a face at rest.
    pub fn face_at_rest(&self, face: u32) -> [[f64; 2]; 3] {
        let [[a, b], [c, d]] = self.rest[face as usize];
        let det = a * d - b * c;
        [[0.0; 2], [d / det, -c / det], [-b / det, a / det]]
    }

    /// Measures the distortion of a mapped face.
    pub fn distortion_of_face(&self, face: u32, [a, b, c]: [[f64; 2]; 3]) -> Distortion {
        let [p, q] = self.rest[face as usize];
        let (first, last) = (minus(b, a), minus(c, a));
        let jacobian = [0, 1].map(|i| {
            [
                first[i] * p[0] + last[i] * q[0],
                first[i] * p[1] + last[i] * q[1],
            ]
        });
        let [[j00, j01], [j10, j11]] = jacobian;
        let det = j00 * j11 - j01 * j10;
        let squares = j00 * j00 + j01 * j01 + j10 * j10 + j11 * j11;
        let larger = f64::midpoint(
            squares,
            (squares * squares - 4.0 * det * det).max(0.0).sqrt(),
        )
        .sqrt();
        Distortion {
            excess: squares * (1.0 + 1.0 / (det * det)) - 4.0,
            det,
            stretch: larger.max(larger / det),
        }
    }
}

fn minus(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

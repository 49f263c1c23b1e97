//! Parts of a mesh that have one shape.
//!
//! Two parts have one shape if a motion takes every vertex of one to a vertex of the other, and every face to a face of
//! the same material. Neither part needs the numbering of the other. Flat areas may be divided into other triangles:
//! the edges that only one part has are left out, and the areas that the others bound are compared.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::position_key::position_key;
use super::repeated::GridCorners;
use super::seams::Seams;
use super::soup::Soup;
use crate::options::Stacking;
use unwrapd_maps::mesh::UnionFind;
use unwrapd_method::numerics::vec3::{area_vector, cross, distance, dot, norm, sub};

/// Largest distance between vertices of two parts that are one, as a share of the parts' radius: a hundredth of a
/// percent, which no texture shows. Not tuned.
pub const TOLERANCE: f64 = 1e-4;
/// Largest distance as a share of the radius where the coordinates of the parts are rounded more coarsely than that: a
/// small part far from the origin. A tenth of a percent. Not tuned.
pub const LARGEST_TOLERANCE: f64 = 1e-3;
/// Error of a vertex in f32 coordinates after a motion, in units of its largest coordinate: a few roundings of 2⁻²⁴, of
/// both vertices and of those from which the motion was found.
const ROUNDINGS: f64 = 8.0 / 16_777_216.0;
/// Maximum number of motions that are tried. It bounds the time for parts of many equal faces; copies that keep their
/// order are found at the first. Not tuned.
const MOST_TRIES: usize = 192;

/// Triangles of the flat areas of two parts of one shape.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum FlatTriangles {
    /// They may differ.
    Any,
    /// They are the same.
    Same,
}

/// A face of a copy, and for each of its corners a corner of the mesh with the same UV.
#[derive(Clone, Copy)]
pub struct CopiedFace {
    pub face: u32,
    pub corners: [u32; 3],
}

/// A part that is a copy of another one.
pub struct PartCopy {
    pub faces: Vec<CopiedFace>,
    pub flat: FlatAreas,
}

/// Flat areas that copies divide into other triangles than their originals.
#[derive(Default)]
pub struct FlatAreas {
    /// Corners of an original that meet within a flat area.
    pub ties: Vec<[u32; 2]>,
    /// Triangles of copies by the corners whose UVs they get, wound as those of the original.
    pub triangles: Vec<[u32; 3]>,
}

impl FlatAreas {
    pub fn extend(&mut self, other: Self) {
        self.ties.extend(other.ties);
        self.triangles.extend(other.triangles);
    }

    /// Returns whether the map of the originals is one of the copies, too: no flat area is cut, and no triangle of a copy
    /// is flipped in it.
    pub fn hold(&self, grid: &[GridCorners]) -> bool {
        let at = |corner: u32| grid[corner as usize / 3][corner as usize % 3];
        let sign = |[a, b, c]: GridCorners| {
            let [e, f] = [b, c].map(|p| [0, 1].map(|k| i64::from(p[k]) - i64::from(a[k])));
            (e[0] * f[1] - e[1] * f[0]).signum()
        };
        let is_unflipped = |triangle: &[u32; 3]| {
            let own = sign(triangle.map(at));
            own != 0 && own == sign(grid[triangle[0] as usize / 3])
        };
        self.ties.iter().all(|[a, b]| at(*a) == at(*b)) && self.triangles.iter().all(is_unflipped)
    }
}

/// A part of a mesh, about the mean of its vertices.
pub struct Part {
    pub faces: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    pub positions: Vec<[f64; 3]>,
    /// Mean distance of a vertex from the mean of all.
    pub size: f64,
    radius: f64,
    /// Error of a vertex that rounding its coordinates explains.
    rounding: f64,
}

impl Part {
    pub fn new(mesh: Soup, faces: Vec<u32>) -> Self {
        let mut number = HashMap::new();
        let mut positions: Vec<[f64; 3]> = Vec::new();
        let mut vertex = |v: u32| {
            let p = mesh.positions[v as usize];
            *number.entry(position_key(p)).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        };
        let corners = faces.iter().map(|&face| mesh.triangles[face as usize]);
        let triangles: Vec<[u32; 3]> = corners.map(|corners| corners.map(&mut vertex)).collect();
        let coordinates = positions.as_flattened().iter();
        let rounding = ROUNDINGS * coordinates.fold(0.0, |most: f64, x| most.max(x.abs()));
        let n = positions.len() as f64;
        let sum = positions
            .iter()
            .fold([0.0; 3], |sum, p| [0, 1, 2].map(|k| sum[k] + p[k]));
        let mean = sum.map(|x| x / n);
        for p in &mut positions {
            *p = sub(*p, mean);
        }
        let distances = || positions.iter().map(|&p| norm(p));
        Self {
            size: distances().sum::<f64>() / n,
            radius: distances().fold(0.0, f64::max),
            rounding,
            faces,
            triangles,
            positions,
        }
    }

    /// Returns the faces with their own corners.
    pub fn itself(&self) -> Vec<CopiedFace> {
        let own = |&face: &u32| CopiedFace {
            face,
            corners: [3 * face, 3 * face + 1, 3 * face + 2],
        };
        self.faces.iter().map(own).collect()
    }

    /// Returns this part as a copy of `first`; `None` if it is none.
    pub fn copy_of(
        &self,
        first: &Self,
        seams: &Seams,
        stacking: Stacking,
        triangles: FlatTriangles,
    ) -> Option<PartCopy> {
        let tolerance = (TOLERANCE * first.radius + self.rounding.max(first.rounding))
            .min(LARGEST_TOLERANCE * first.radius);
        if !tolerance.is_normal() || (self.radius - first.radius).abs() > tolerance {
            return None;
        }
        let handedness: &[Handedness] = match stacking {
            Stacking::Mirrored => &[Handedness::Same, Handedness::Mirrored],
            _ => &[Handedness::Same],
        };
        let index = Index::new(first, tolerance);
        let landmarks = self.landmarks()?;
        // The landmarks give a motion more exactly than the corners of a face, which are nearer to each other.
        let exact = |(motion, hand): (Motion, Handedness)| {
            let at = landmarks
                .map(|v| first.positions[first.nearest(motion.place(self.positions[v])) as usize]);
            let [p, q] = landmarks.map(|v| self.positions[v]);
            let motion = Motion::between([[0.0; 3], p, q], [[0.0; 3], at[0], at[1]], hand)?;
            Some((motion, hand))
        };
        let of_face = self.motions_of_face(first, tolerance, handedness);
        let of_face = of_face.take(MOST_TRIES).filter_map(exact);
        let of_landmarks = self.motions_of_landmarks(landmarks, first, tolerance, handedness);
        let of_landmarks = match triangles {
            FlatTriangles::Any => of_landmarks.take(MOST_TRIES),
            FlatTriangles::Same => of_landmarks.take(0),
        };
        of_face.chain(of_landmarks).find_map(|(motion, hand)| {
            let met = self.met(first, &motion, &index)?;
            let same = self.same_triangles(first, &met, hand, seams);
            same.or_else(|| match triangles {
                FlatTriangles::Any => self.flat_areas(first, &met, hand, seams, tolerance),
                FlatTriangles::Same => None,
            })
        })
    }

    /// Iterates over the motions that take the largest face to a face of `first`, that with its number first.
    fn motions_of_face<'a>(
        &'a self,
        first: &'a Self,
        tolerance: f64,
        handedness: &'a [Handedness],
    ) -> impl Iterator<Item = (Motion, Handedness)> + 'a {
        let area = |k: usize| {
            let [a, b, c] = self.corners(k);
            norm(area_vector(a, b, c))
        };
        let faces = 0..self.triangles.len();
        let largest = faces.max_by(|&a, &b| area(a).total_cmp(&area(b)));
        let lengths = |[a, b, c]: [[f64; 3]; 3]| [distance(a, b), distance(b, c), distance(c, a)];
        largest.into_iter().flat_map(move |largest| {
            let own = self.corners(largest);
            let wanted = lengths(own);
            let others = (0..first.triangles.len()).filter(move |&k| k != largest);
            let faces = std::iter::once(largest).chain(others);
            let ways = faces.flat_map(move |face| {
                let turns = handedness
                    .iter()
                    .flat_map(|&hand| (0..3).map(move |turn| (turn, hand)));
                turns.map(move |(turn, hand)| (turned(first.corners(face), turn, hand), hand))
            });
            ways.filter_map(move |(to, hand)| {
                let found = lengths(to);
                let fits = (0..3).all(|k| (found[k] - wanted[k]).abs() <= 4.0 * tolerance);
                Some((Motion::between(own, to, hand).filter(|_| fits)?, hand))
            })
        })
    }

    /// Iterates over the motions that take the landmarks to vertices of `first` at the same distances from its mean and
    /// from each other, those with their numbers first.
    fn motions_of_landmarks<'a>(
        &'a self,
        landmarks: [usize; 2],
        first: &'a Self,
        tolerance: f64,
        handedness: &'a [Handedness],
    ) -> impl Iterator<Item = (Motion, Handedness)> + 'a {
        let [p, q] = landmarks.map(|v| self.positions[v]);
        let apart = distance(p, q);
        let alike = move |v: usize| {
            let radius = norm(self.positions[v]);
            let all = (0..first.positions.len()).filter(move |&other| other != v);
            std::iter::once(v)
                .chain(all)
                .map(|v| first.positions[v])
                .filter(move |p| (norm(*p) - radius).abs() <= tolerance)
        };
        alike(landmarks[0]).flat_map(move |at_p| {
            let near = alike(landmarks[1])
                .filter(move |at_q| (distance(at_p, *at_q) - apart).abs() <= 2.0 * tolerance);
            near.flat_map(move |at_q| {
                handedness.iter().filter_map(move |&hand| {
                    let to = [[0.0; 3], at_p, at_q];
                    Some((Motion::between([[0.0; 3], p, q], to, hand)?, hand))
                })
            })
        })
    }

    /// Returns for each vertex the vertex of `first` on which a motion puts it; `None` if it does not put each on one of
    /// its own.
    fn met(&self, first: &Self, motion: &Motion, index: &Index) -> Option<Vec<u32>> {
        let mut is_met = vec![false; first.positions.len()];
        let mut met = Vec::with_capacity(self.positions.len());
        for &p in &self.positions {
            let v = index.nearest(first, motion.place(p))?;
            if std::mem::replace(&mut is_met[v as usize], true) {
                return None;
            }
            met.push(v);
        }
        Some(met)
    }

    /// Returns the copy if every face has the vertices of a face of `first`.
    fn same_triangles(
        &self,
        first: &Self,
        met: &[u32],
        hand: Handedness,
        seams: &Seams,
    ) -> Option<PartCopy> {
        // Faces by their vertices, the smallest number first.
        let from_smallest = |[a, b, c]: [u32; 3]| match a.min(b).min(c) {
            least if least == a => ([a, b, c], [0, 1, 2]),
            least if least == b => ([b, c, a], [1, 2, 0]),
            _ => ([c, a, b], [2, 0, 1]),
        };
        let mut of_vertices: HashMap<[u32; 3], Vec<(usize, [usize; 3])>> = HashMap::new();
        for (k, &triangle) in first.triangles.iter().enumerate().rev() {
            let (key, order) = from_smallest(triangle);
            of_vertices.entry(key).or_default().push((k, order));
        }
        let corners = hand.corners();
        let mut faces = Vec::with_capacity(self.faces.len());
        for (&face, triangle) in self.faces.iter().zip(&self.triangles) {
            let (key, order) = from_smallest(corners.map(|k: usize| met[triangle[k] as usize]));
            let (other, other_order) = of_vertices.get_mut(&key)?.pop()?;
            let other = first.faces[other];
            if !seams.agree(face, other) {
                return None;
            }
            let mut copy = CopiedFace {
                face,
                corners: [0; 3],
            };
            for k in 0..3 {
                copy.corners[corners[order[k]]] = 3 * other + other_order[k] as u32;
            }
            faces.push(copy);
        }
        let flat = FlatAreas::default();
        Some(PartCopy { faces, flat })
    }

    /// Returns the copy if the edges that both parts have bound the same areas, and those of several triangles are flat.
    fn flat_areas(
        &self,
        first: &Self,
        met: &[u32],
        hand: Handedness,
        seams: &Seams,
        tolerance: f64,
    ) -> Option<PartCopy> {
        let order = hand.corners();
        let moved = |triangle: &[u32; 3]| order.map(|k| met[triangle[k] as usize]);
        let own: Vec<[u32; 3]> = self.triangles.iter().map(moved).collect();
        let [own_areas, areas] = [
            areas_between(&own, &undirected_edges(&first.triangles)),
            areas_between(&first.triangles, &undirected_edges(&own)),
        ];
        let mut with_border: HashMap<BTreeSet<[u32; 2]>, Vec<Vec<usize>>> = HashMap::new();
        for area in areas.into_iter().rev() {
            let area_border = border(&first.triangles, &area);
            with_border.entry(area_border).or_default().push(area);
        }
        let mut copy = PartCopy {
            faces: Vec::with_capacity(self.faces.len()),
            flat: FlatAreas::default(),
        };
        for own_area in own_areas {
            let area = with_border.get_mut(&border(&own, &own_area))?.pop()?;
            let is_divided = area.len() > 1;
            if is_divided
                && !(first.is_flat(&first.triangles, &area, tolerance)
                    && first.is_flat(&own, &own_area, tolerance))
            {
                return None;
            }
            // A corner of the area at each of its vertices.
            let mut corner_at: HashMap<u32, u32> = HashMap::new();
            for &k in &area {
                for (c, &v) in (0..).zip(&first.triangles[k]) {
                    let corner = 3 * first.faces[k] + c;
                    let known = *corner_at.entry(v).or_insert(corner);
                    if known != corner {
                        copy.flat.ties.push([known, corner]);
                    }
                }
            }
            for &k in &own_area {
                let face = self.faces[k];
                if !area
                    .iter()
                    .all(|&other| seams.agree(face, first.faces[other]))
                {
                    return None;
                }
                let mut found = [0; 3];
                for (c, v) in order.into_iter().zip(own[k]) {
                    found[c] = *corner_at.get(&v)?;
                }
                copy.faces.push(CopiedFace {
                    face,
                    corners: found,
                });
                if is_divided {
                    copy.flat.triangles.push(order.map(|c| found[c]));
                }
            }
        }
        Some(copy)
    }

    /// Returns whether some triangles of this part's vertices lie in one plane and face the same way.
    fn is_flat(&self, triangles: &[[u32; 3]], area: &[usize], tolerance: f64) -> bool {
        let corners = |&k: &usize| triangles[k].map(|v| self.positions[v as usize]);
        let normal = |[a, b, c]: [[f64; 3]; 3]| area_vector(a, b, c);
        let sum = (area.iter().map(corners).map(normal))
            .fold([0.0; 3], |sum, n| [0, 1, 2].map(|k| sum[k] + n[k]));
        let unit = sum.map(|x| x / norm(sum));
        let origin = corners(&area[0])[0];
        area.iter().map(corners).all(|triangle| {
            dot(normal(triangle), unit) > 0.0
                && (triangle.iter()).all(|p| dot(sub(*p, origin), unit).abs() <= tolerance)
        })
    }

    fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    /// Returns the vertex farthest from the mean, and the one farthest from the line through both.
    fn landmarks(&self) -> Option<[usize; 2]> {
        let farthest = |height: &dyn Fn([f64; 3]) -> f64| {
            let all = 0..self.positions.len();
            all.max_by(|&a, &b| height(self.positions[a]).total_cmp(&height(self.positions[b])))
        };
        let first = farthest(&|p| norm(p))?;
        let second = farthest(&|p| norm(cross(self.positions[first], p)))?;
        Some([first, second])
    }

    fn nearest(&self, p: [f64; 3]) -> u32 {
        let all = self.positions.iter().zip(0..);
        let nearest = all.min_by(|(a, _), (b, _)| distance(**a, p).total_cmp(&distance(**b, p)));
        nearest.map_or(0, |(_, v)| v)
    }
}

// Areas of triangles.

fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

fn undirected([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn undirected_edges(triangles: &[[u32; 3]]) -> HashSet<[u32; 2]> {
    triangles
        .iter()
        .flat_map(|t| sides(*t).map(undirected))
        .collect()
}

/// Returns the areas into which some edges divide triangles, as their numbers.
fn areas_between(triangles: &[[u32; 3]], edges: &HashSet<[u32; 2]>) -> Vec<Vec<usize>> {
    let mut areas = UnionFind::new(triangles.len());
    let mut last_at: HashMap<[u32; 2], u32> = HashMap::new();
    for (k, triangle) in (0..).zip(triangles) {
        for side in sides(*triangle).map(undirected) {
            if !edges.contains(&side)
                && let Some(other) = last_at.insert(side, k)
            {
                areas.unite(k, other);
            }
        }
    }
    let (label, n_labels) = areas.labels();
    let mut found = vec![Vec::new(); n_labels];
    for (k, label) in label.into_iter().enumerate() {
        found[label as usize].push(k);
    }
    found
}

/// Returns the directed edges around some triangles; those that run both ways cancel.
fn border(triangles: &[[u32; 3]], area: &[usize]) -> BTreeSet<[u32; 2]> {
    let mut edges = BTreeSet::new();
    for [a, b] in area.iter().flat_map(|&k| sides(triangles[k])) {
        if !edges.remove(&[b, a]) {
            edges.insert([a, b]);
        }
    }
    edges
}

/// Relation of two parts that have one shape.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Handedness {
    Same,
    Mirrored,
}

impl Handedness {
    /// Returns the corners of a face in the order in which the other part has them.
    fn corners(self) -> [usize; 3] {
        match self {
            Self::Same => [0, 1, 2],
            Self::Mirrored => [0, 2, 1],
        }
    }
}

/// Returns the corners of a face beginning with one of them, in reverse order for a mirror image.
fn turned(corners: [[f64; 3]; 3], turn: usize, hand: Handedness) -> [[f64; 3]; 3] {
    let [a, b, c] = [0, 1, 2].map(|k| corners[(turn + k) % 3]);
    match hand {
        Handedness::Same => [a, b, c],
        Handedness::Mirrored => [a, c, b],
    }
}

/// Rigid motion, or a mirror image after one.
struct Motion {
    from: [[f64; 3]; 4],
    to: [[f64; 3]; 4],
}

impl Motion {
    /// Returns the motion that takes three points to three others; `None` if they lie on a line.
    fn between(from: [[f64; 3]; 3], to: [[f64; 3]; 3], hand: Handedness) -> Option<Self> {
        let frame = |[a, b, c]: [[f64; 3]; 3], sign: f64| {
            let unit = |v: [f64; 3]| {
                let length = norm(v);
                (length > 0.0).then(|| v.map(|x| x / length))
            };
            let x = unit(sub(b, a))?;
            let z = unit(cross(x, sub(c, a)))?;
            let y = cross(z, x);
            Some([a, x, y, z.map(|w| sign * w)])
        };
        let sign = match hand {
            Handedness::Same => 1.0,
            Handedness::Mirrored => -1.0,
        };
        Some(Self {
            from: frame(from, 1.0)?,
            to: frame(to, sign)?,
        })
    }

    fn place(&self, p: [f64; 3]) -> [f64; 3] {
        let [origin, x, y, z] = self.from;
        let along = [x, y, z].map(|axis| dot(axis, sub(p, origin)));
        let [origin, axes @ ..] = self.to;
        [0, 1, 2].map(|k| origin[k] + (0..3).map(|i| along[i] * axes[i][k]).sum::<f64>())
    }
}

/// Vertices of a part by their place.
struct Index {
    cell: f64,
    vertices: HashMap<[i64; 3], Vec<u32>>,
}

impl Index {
    fn new(part: &Part, cell: f64) -> Self {
        let mut vertices: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (v, p) in (0..).zip(&part.positions) {
            let at = p.map(|x| (x / cell).floor() as i64);
            vertices.entry(at).or_default().push(v);
        }
        Self { cell, vertices }
    }

    /// Returns the nearest vertex of the part within a cell's side.
    fn nearest(&self, part: &Part, p: [f64; 3]) -> Option<u32> {
        let at = p.map(|x| (x / self.cell).floor() as i64);
        let mut best: Option<(f64, u32)> = None;
        for n in 0..27_i64 {
            let by = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            let cell = [0, 1, 2].map(|k| at[k] + by[k]);
            for &v in self.vertices.get(&cell).into_iter().flatten() {
                let apart = distance(part.positions[v as usize], p);
                if apart <= self.cell && best.is_none_or(|(least, _)| apart < least) {
                    best = Some((apart, v));
                }
            }
        }
        best.map(|(_, v)| v)
    }
}

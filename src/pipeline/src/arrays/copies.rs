//! Parts of one shape, mapped once.
//!
//! Parts are the components of a mesh. Many models repeat them: screws, links, windows, and
//! both sides of what is symmetric. A part that is another one but for a rigid motion, or a mirror image of it, is left
//! out of the mesh that is unwrapped, and gets the UVs of the other: it is stacked on it.
//!
//! Two parts are matched by a motion that takes a face of one to a face of the other; then every vertex must meet a
//! vertex, and every face a face of the same material. Neither part needs the numbering of the other.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use super::position_key::{PositionKey, position_key};
use super::repeated::GridCorners;
use super::seams::Seams;
use super::soup::Soup;
use crate::options::Stacking;
use unwrapd_maps::mesh::UnionFind;
use unwrapd_method::numerics::vec3::{area_vector, cross, distance, dot, norm, sub};

/// Largest distance between vertices of two parts that are one, as a share of the parts' radius: a hundredth of a
/// percent, which no texture shows. Not tuned.
const TOLERANCE: f64 = 1e-4;
/// Maximum number of faces of a part to which the first face of another is moved, three ways each. It bounds the time for
/// parts of many equal faces; copies that keep their order are found at the first. Not tuned.
const MOST_TRIES: usize = 64;

/// A mesh without the parts that are copies of others.
pub struct WithoutCopies<'a> {
    mesh: Soup<'a>,
    triangles: Vec<[u32; 3]>,
    seams: Seams,
    /// Face of the whole mesh for each triangle.
    kept: Vec<u32>,
    /// Parts that have copies, as faces of `triangles`.
    originals: Vec<Vec<u32>>,
    /// Faces of copies.
    copied: Vec<CopiedFace>,
}

/// A face of a copy, and for each of its corners the corner of the mesh with the same UV.
struct CopiedFace {
    face: u32,
    corners: [u32; 3],
}

impl<'a> WithoutCopies<'a> {
    /// Finds the copies.
    pub fn of(mesh: Soup<'a>, stacking: Stacking) -> Self {
        let mut firsts: BTreeMap<(usize, usize, i64), Vec<Part>> = BTreeMap::new();
        let mut originals: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        // Copies must not join others at an edge with equal UVs: both would be one chart, on itself.
        let mut used: HashSet<EdgeUse> = HashSet::new();
        let mut is_copied = vec![false; mesh.triangles.len()];
        let mut copied = Vec::new();
        for faces in parts(mesh) {
            let part = Part::new(mesh, faces);
            let key = |step: i64| (part.faces.len(), part.positions.len(), step);
            let step = (part.size.ln() / TOLERANCE).floor().clamp(-1e15, 1e15) as i64;
            let near = firsts.range(key(step - 1)..=key(step + 1));
            let matched = near.flat_map(|(_, parts)| parts).find_map(|first| {
                let faces = part.matched(first, mesh.seams, stacking)?;
                let joins = edge_uses(mesh, &faces).any(|edge| used.contains(&edge));
                (!joins).then_some((first, faces))
            });
            if let Some((first, faces)) = matched {
                originals.insert(first.faces[0], first.faces.clone());
                for face in &faces {
                    is_copied[face.face as usize] = true;
                }
                used.extend(edge_uses(mesh, &faces));
                copied.extend(faces);
            } else {
                used.extend(edge_uses(mesh, &part.itself()));
                firsts.entry(key(step)).or_default().push(part);
            }
        }
        let all = 0..mesh.triangles.len() as u32;
        let kept: Vec<u32> = all.filter(|&face| !is_copied[face as usize]).collect();
        let of_kept = |corners: &Vec<[u32; 3]>| kept.iter().map(|&f| corners[f as usize]).collect();
        let seams = Seams {
            polygons: mesh.seams.polygons.as_ref().map(of_kept),
            control: (mesh.seams.control.as_ref()).map(|control| control.restricted(&kept)),
            ..mesh.seams.restricted(&kept, 0..mesh.positions.len() as u32)
        };
        // Number the originals as the faces that are kept.
        let number = |face: u32| kept.partition_point(|&other| other < face) as u32;
        let originals = originals.into_values();
        let originals = originals.map(|faces| faces.into_iter().map(number).collect());
        Self {
            originals: originals.collect(),
            triangles: kept.iter().map(|&f| mesh.triangles[f as usize]).collect(),
            seams,
            kept,
            copied,
            mesh,
        }
    }

    pub fn soup(&self) -> Soup<'_> {
        Soup {
            positions: self.mesh.positions,
            triangles: &self.triangles,
            seams: &self.seams,
            parts: &[],
            originals: &self.originals,
        }
    }

    /// Returns the corners of all faces of the mesh, from those of the faces that are not copied; copies are shifted by this
    /// number of grid units along u, unless the part that they are copies of is shifted already.
    pub fn with_copies(&self, grid: &[GridCorners], shift: i32) -> Vec<GridCorners> {
        let mut all = vec![[[0; 2]; 3]; self.mesh.triangles.len()];
        for (&face, corners) in self.kept.iter().zip(grid) {
            all[face as usize] = *corners;
        }
        for CopiedFace { face, corners } in &self.copied {
            let places = corners.map(|corner| all[corner as usize / 3][corner as usize % 3]);
            let is_shifted = shift > 0 && places.iter().any(|[u, _]| *u > shift);
            let shift = if is_shifted { 0 } else { shift };
            all[*face as usize] = places.map(|[u, v]| [u + shift, v]);
        }
        all
    }
}

/// Ends of an edge, each with the position whose UV it gets.
type EdgeUse = [[PositionKey; 2]; 2];

/// Iterates over the edges of some faces.
fn edge_uses<'a>(mesh: Soup<'a>, faces: &'a [CopiedFace]) -> impl Iterator<Item = EdgeUse> + 'a {
    let key = move |corner: u32| {
        let v = mesh.triangles[corner as usize / 3][corner as usize % 3];
        position_key(mesh.positions[v as usize])
    };
    faces.iter().flat_map(move |CopiedFace { face, corners }| {
        let ends = [0, 1, 2].map(|k| [key(3 * face + k), key(corners[k as usize])]);
        let sorted = |a: [PositionKey; 2], b: [PositionKey; 2]| if a < b { [a, b] } else { [b, a] };
        [0, 1, 2].map(|k| sorted(ends[k], ends[(k + 1) % 3]))
    })
}

/// Returns the faces of each part of a mesh, in ascending order, except of parts with a vertex of a given seam.
///
/// Parts are connected by positions; closed surfaces that only touch each other, such as the steps of a stair, are parts
/// of their own if they have vertices of their own.
fn parts(mesh: Soup) -> Vec<Vec<u32>> {
    let mut number = HashMap::new();
    let welded: Vec<u32> = (mesh.positions.iter())
        .map(|&p| {
            let next = number.len() as u32;
            *number.entry(position_key(p)).or_insert(next)
        })
        .collect();
    let touching = connected(mesh.triangles, number.len(), |v| welded[v as usize]);
    let solids = connected(mesh.triangles, mesh.positions.len(), |v| v);
    let is_closed = solids.iter().map(|faces| is_closed(mesh.triangles, faces));
    let is_closed: Vec<bool> = is_closed.collect();
    let mut solid_of = vec![0; mesh.triangles.len()];
    for (solid, faces) in solids.iter().enumerate() {
        for face in faces {
            solid_of[*face as usize] = solid;
        }
    }
    let mut is_seam = vec![false; mesh.positions.len()];
    for v in mesh.seams.edges.iter().flatten().flatten() {
        is_seam[*v as usize] = true;
    }
    let has_seam = |faces: &Vec<u32>| {
        let mut corners = faces.iter().flat_map(|&face| mesh.triangles[face as usize]);
        corners.any(|v| is_seam[v as usize])
    };
    let mut parts = Vec::new();
    for faces in touching {
        if faces.iter().all(|&face| is_closed[solid_of[face as usize]]) {
            let of_faces: BTreeSet<usize> = faces.iter().map(|&f| solid_of[f as usize]).collect();
            parts.extend(of_faces.into_iter().map(|solid| solids[solid].clone()));
        } else {
            parts.push(faces);
        }
    }
    parts.retain(|faces| !has_seam(faces));
    parts.sort_by_key(|faces| faces[0]);
    parts
}

/// Returns the sets of faces that are connected by vertices, as `vertex` numbers them, each in ascending order.
fn connected(triangles: &[[u32; 3]], n: usize, vertex: impl Fn(u32) -> u32) -> Vec<Vec<u32>> {
    let mut vertices = UnionFind::new(n);
    for [a, b, c] in triangles {
        vertices.unite(vertex(*a), vertex(*b));
        vertices.unite(vertex(*a), vertex(*c));
    }
    let (label, n_labels) = vertices.labels();
    let mut faces = vec![Vec::new(); n_labels];
    for (face, triangle) in (0..).zip(triangles) {
        faces[label[vertex(triangle[0]) as usize] as usize].push(face);
    }
    faces.retain(|faces| !faces.is_empty());
    faces
}

/// Returns whether each edge of some faces is between two of them.
fn is_closed(triangles: &[[u32; 3]], faces: &[u32]) -> bool {
    let mut times: HashMap<[u32; 2], u32> = HashMap::new();
    for face in faces {
        let [a, b, c] = triangles[*face as usize];
        for [a, b] in [[a, b], [b, c], [c, a]] {
            *times.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    times.values().all(|&n| n == 2)
}

/// A part of a mesh, about the mean of its vertices.
struct Part {
    faces: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    positions: Vec<[f64; 3]>,
    /// Mean distance of a vertex from the mean of all.
    size: f64,
    radius: f64,
}

impl Part {
    fn new(mesh: Soup, faces: Vec<u32>) -> Self {
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
            faces,
            triangles,
            positions,
        }
    }

    /// Returns the faces with their own corners.
    fn itself(&self) -> Vec<CopiedFace> {
        let own = |&face: &u32| CopiedFace {
            face,
            corners: [3 * face, 3 * face + 1, 3 * face + 2],
        };
        self.faces.iter().map(own).collect()
    }

    /// Returns the faces with the corners of `first` that they are copies of; `None` if the part is no copy.
    fn matched(&self, first: &Self, seams: &Seams, stacking: Stacking) -> Option<Vec<CopiedFace>> {
        let tolerance = TOLERANCE * first.radius;
        if !tolerance.is_normal() || (self.radius - first.radius).abs() > tolerance {
            return None;
        }
        // Move the largest face to the faces of the other part, the one with its number first.
        let area = |k: usize| {
            let [a, b, c] = self.corners(k);
            norm(area_vector(a, b, c))
        };
        let largest = (0..self.triangles.len()).max_by(|&a, &b| area(a).total_cmp(&area(b)))?;
        let landmarks = self.landmarks()?;
        let index = Index::new(first, tolerance);
        let lengths = |[a, b, c]: [[f64; 3]; 3]| [distance(a, b), distance(b, c), distance(c, a)];
        let wanted = lengths(self.corners(largest));
        let others = (0..first.triangles.len()).filter(|&k| k != largest);
        let handedness: &[Handedness] = match stacking {
            Stacking::Mirrored => &[Handedness::Same, Handedness::Mirrored],
            _ => &[Handedness::Same],
        };
        let fits = |&(face, turn, hand): &(usize, usize, Handedness)| {
            let found = lengths(turned(first.corners(face), turn, hand));
            (0..3).all(|k| (found[k] - wanted[k]).abs() <= 4.0 * tolerance)
        };
        let ways = std::iter::once(largest).chain(others).flat_map(|face| {
            let turns = handedness
                .iter()
                .flat_map(|&hand| (0..3).map(move |turn| (turn, hand)));
            turns.map(move |(turn, hand)| (face, turn, hand))
        });
        ways.filter(fits)
            .take(3 * MOST_TRIES)
            .find_map(|(face, turn, hand)| {
                let to = turned(first.corners(face), turn, hand);
                let motion = Motion::between(self.corners(largest), to, hand)?;
                // The landmarks are farther apart than the corners of a face, and give the motion more exactly.
                let at = landmarks.map(|v| {
                    first.positions[first.nearest(motion.place(self.positions[v])) as usize]
                });
                let [p, q] = landmarks.map(|v| self.positions[v]);
                let motion = Motion::between([[0.0; 3], p, q], [[0.0; 3], at[0], at[1]], hand)?;
                self.moved(first, &motion, hand, &index, seams)
            })
    }

    /// Returns the faces with the corners on which a motion puts them; `None` if it does not put vertices on vertices and
    /// faces on faces.
    fn moved(
        &self,
        first: &Self,
        motion: &Motion,
        hand: Handedness,
        index: &Index,
        seams: &Seams,
    ) -> Option<Vec<CopiedFace>> {
        let mut is_met = vec![false; first.positions.len()];
        let mut met = Vec::with_capacity(self.positions.len());
        for &p in &self.positions {
            let v = index.nearest(first, motion.place(p))?;
            if std::mem::replace(&mut is_met[v as usize], true) {
                return None;
            }
            met.push(v);
        }
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
        let mut copied = Vec::with_capacity(self.faces.len());
        for (&face, triangle) in self.faces.iter().zip(&self.triangles) {
            let mut corners = [0, 1, 2];
            if hand == Handedness::Mirrored {
                corners = [0, 2, 1];
            }
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
            copied.push(copy);
        }
        Some(copied)
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

/// Relation of two parts that have one shape.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Handedness {
    Same,
    Mirrored,
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

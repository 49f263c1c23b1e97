//! Edges at which a caller wants a mesh to be cut.

use std::collections::HashSet;
use std::ops::Range;

use super::control::FaceControl;
use super::placement::Placement;
use super::position_key::position_key;
use crate::PipelineError;
use unwrapd_maps::cut::surface_fans;
use unwrapd_maps::mesh::{CUT, CornerUvs, Resolution, Surface, next};
use unwrapd_method::numerics::vec3::dot;

/// Cosine of the least angle between normals on the two sides of a hard edge: 1°.
const SOFT: f64 = 0.999_85;

/// Edges to cut a mesh along, determined by attributes of its faces and corners. Each list of attributes is absent or
/// has an entry per face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seams {
    /// UVs, v up: an edge at which those of two faces differ is a seam. With [`Cut::Keep`](unwrapd_layout::charts::Cut::Keep) maps begin here.
    pub uvs: Option<Vec<CornerUvs>>,
    /// The texture that the UVs were made for, whose texels are square on the surface; a square one if absent.
    pub texture: Option<Resolution>,
    /// Islands of the UVs that stay where they are put, where all maps are kept as they are given.
    pub placed: Vec<Placement>,
    /// Rules for islands.
    pub control: Option<FaceControl>,
    /// Normals: an edge at which those of two faces differ by more than a degree is a seam.
    pub normals: Option<Vec<[[f64; 3]; 3]>>,
    /// Labels, as of materials: an edge between faces of different labels is a seam.
    pub labels: Option<Vec<u32>>,
    /// Materials: charts of different ones are not stacked on each other.
    pub materials: Option<Vec<u32>>,
    /// Relative texel densities: an edge between faces of different ones is a seam, and a chart gets that multiple of
    /// the texels along a line.
    pub weights: Option<Vec<f64>>,
    /// Pairs of positions, by the indices of the mesh: an edge between two such positions is a seam, unless it is alone inside the
    /// surface, where it would open nothing.
    pub edges: Option<Vec<[u32; 2]>>,
    /// Positions, by the indices of the mesh, at which [`Cut::Disk`](unwrapd_layout::charts::Cut::Disk) puts cone singularities: it
    /// slits each component through them. If a mesh has such a list, maps that overlap themselves are parted.
    pub cones: Option<Vec<u32>>,
    /// Polygons that stay in one piece: for each corner the number of its corner of a polygon. Faces that share such
    /// numbers are of one polygon, and no seam of a new map runs between them.
    pub polygons: Option<Vec<[u32; 3]>>,
}

impl Seams {
    /// Checks that this fits a mesh.
    pub(crate) fn check(
        &self,
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<(), PipelineError> {
        let n_faces = triangles.len();
        let lengths = [
            self.uvs.as_ref().map(Vec::len),
            self.normals.as_ref().map(Vec::len),
            self.labels.as_ref().map(Vec::len),
            self.weights.as_ref().map(Vec::len),
            self.materials.as_ref().map(Vec::len),
            self.polygons.as_ref().map(Vec::len),
            self.control.as_ref().map(|control| control.of_face.len()),
        ];
        if lengths.into_iter().flatten().any(|n| n != n_faces) {
            return Err(PipelineError::Seams("not one entry per face".to_owned()));
        }
        if let Some(edges) = &self.edges {
            Self::check_edges(edges, positions, triangles)?;
        }
        let cones = self.cones.as_deref().unwrap_or_default();
        Self::check_cones(cones, positions.len())
    }

    /// Restricts the seams to some faces, and to positions that are counted from the first of a range.
    pub(crate) fn restricted(&self, faces: &[u32], vertices: Range<u32>) -> Self {
        fn of<T: Copy>(all: Option<&Vec<T>>, faces: &[u32]) -> Option<Vec<T>> {
            let all = all?;
            Some(faces.iter().map(|&face| all[face as usize]).collect())
        }
        let within = |edge: &&[u32; 2]| edge.iter().all(|v| vertices.contains(v));
        let edges = |all: &Vec<[u32; 2]>| {
            let edges = all.iter().filter(within);
            edges.map(|edge| edge.map(|v| v - vertices.start)).collect()
        };
        let cones = |all: &Vec<u32>| {
            let cones = all.iter().filter(|v| vertices.contains(v));
            cones.map(|v| v - vertices.start).collect()
        };
        Self {
            uvs: of(self.uvs.as_ref(), faces),
            texture: self.texture,
            placed: Vec::new(),
            // Rules hold for charts of the whole mesh, like placements.
            control: None,
            normals: of(self.normals.as_ref(), faces),
            labels: of(self.labels.as_ref(), faces),
            materials: of(self.materials.as_ref(), faces),
            weights: of(self.weights.as_ref(), faces),
            edges: self.edges.as_ref().map(edges),
            cones: self.cones.as_ref().map(cones),
            // Charts of the whole mesh are united, not those of a piece.
            polygons: None,
        }
    }

    /// Returns whether two faces have one label, material and weight, and the same rules.
    pub(crate) fn agree(&self, f: u32, g: u32) -> bool {
        fn same<T: PartialEq>(all: Option<&Vec<T>>, f: u32, g: u32) -> bool {
            all.is_none_or(|all| all[f as usize] == all[g as usize])
        }
        let rules = self.control.as_ref().map(|control| &control.of_face);
        same(self.labels.as_ref(), f, g)
            && same(rules, f, g)
            && same(self.materials.as_ref(), f, g)
            && same(self.weights.as_ref(), f, g)
    }

    /// Rejects pairs that are not the ends of an edge of some triangle: nothing would be cut there.
    pub(crate) fn check_edges(
        edges: &[[u32; 2]],
        positions: &[[f64; 3]],
        triangles: &[[u32; 3]],
    ) -> Result<(), PipelineError> {
        let n_positions = positions.len();
        if let Some(v) = (edges.as_flattened().iter()).find(|&&v| v as usize >= n_positions) {
            return Err(PipelineError::Seams(format!(
                "a pair names vertex {v}, but there are only {n_positions} vertices"
            )));
        }
        let ends = |a, b| {
            let [a, b] = [a, b].map(|v: u32| position_key(positions[v as usize]));
            sorted(a, b)
        };
        let sides = triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let sides: HashSet<_> = sides.map(|[a, b]| ends(a, b)).collect();
        let is_none = |&&[a, b]: &&[u32; 2]| a == b || !sides.contains(&ends(a, b));
        let mut none = edges.iter().filter(is_none);
        let Some(first) = none.next() else {
            return Ok(());
        };
        let (n_none, n_pairs) = (1 + none.count(), edges.len());
        Err(PipelineError::Seams(format!(
            "{n_none} of {n_pairs} vertex pairs are not joined by an edge; the first is {first:?}"
        )))
    }

    /// Rejects cones at vertices that do not exist.
    pub(crate) fn check_cones(cones: &[u32], n_positions: usize) -> Result<(), PipelineError> {
        match cones.iter().find(|&&v| v as usize >= n_positions) {
            None => Ok(()),
            Some(v) => Err(PipelineError::Seams(format!(
                "a cone is at vertex {v}, but there are only {n_positions} vertices"
            ))),
        }
    }

    /// Returns the vertices of a surface, made of these positions, at which there are cones.
    pub(crate) fn cones_of(&self, surface: &Surface, positions: &[[f64; 3]]) -> Vec<u32> {
        let cones = self.cones.iter().flatten();
        let cones: HashSet<_> = cones
            .map(|&v| position_key(positions[v as usize]))
            .collect();
        let vertices = (0..).zip(&surface.positions);
        let vertices = vertices.filter(|(_, p)| cones.contains(&position_key(**p)));
        vertices.map(|(v, _)| v).collect()
    }

    /// Cuts a surface that was made of these positions along its seams.
    pub(crate) fn cut(&self, surface: &mut Surface, positions: &[[f64; 3]]) {
        let key = |v: u32| position_key(positions[v as usize]);
        let edges = self.edges.iter().flatten();
        let edges: HashSet<_> = edges.map(|&[a, b]| sorted(key(a), key(b))).collect();
        let (faces, triangles, welded) = (&surface.faces, &surface.triangles, &surface.positions);
        let ends = |h: u32| [h, if h % 3 == 2 { h - 2 } else { h + 1 }];
        let vertex = |corner: u32| triangles[corner as usize / 3][corner as usize % 3];
        let is_seam = |h: u32, t: u32| {
            let face = |h: u32| faces[h as usize / 3] as usize;
            let [[a, b], mut across] = [ends(h), ends(t)];
            if vertex(a) != vertex(across[0]) {
                across.reverse();
            }
            let differ = |apart: &dyn Fn([usize; 2], [usize; 2]) -> bool| {
                [[a, across[0]], [b, across[1]]]
                    .iter()
                    .any(|[x, y]| apart([face(*x), *x as usize % 3], [face(*y), *y as usize % 3]))
            };
            let by_uv = |uvs: &Vec<CornerUvs>| differ(&|[f, c], [g, d]| uvs[f][c] != uvs[g][d]);
            let by_normal = |normals: &Vec<[[f64; 3]; 3]>| {
                differ(&|[f, c], [g, d]| is_hard(normals[f][c], normals[g][d]))
            };
            let is_named = || {
                let at = |corner: u32| welded[vertex(corner) as usize];
                edges.contains(&sorted(position_key(at(a)), position_key(at(b))))
            };
            self.uvs.as_ref().is_some_and(by_uv)
                || self.normals.as_ref().is_some_and(by_normal)
                || (self.labels.as_ref()).is_some_and(|label| label[face(h)] != label[face(t)])
                || (self.weights.as_ref()).is_some_and(|weight| weight[face(h)] != weight[face(t)])
                || is_named()
        };
        let mut seams: HashSet<(u32, u32)> = (0..)
            .zip(&surface.adjacency().twin)
            .filter(|&(h, &t)| t != CUT && h < t && is_seam(h, t))
            .map(|(h, &t)| (h, t))
            .collect();
        keep_what_opens(surface, &mut seams);
        if !seams.is_empty() {
            surface.cut_along(|h, t| seams.contains(&(h, t)));
        }
    }
}

/// Removes edges that would open nothing: no other seams or boundaries continue at either end, so the faces on both
/// sides keep both vertices in common.
fn keep_what_opens(surface: &Surface, seams: &mut HashSet<(u32, u32)>) {
    let mut twin = surface.adjacency().twin.clone();
    for &(h, t) in &*seams {
        twin[h as usize] = CUT;
        twin[t as usize] = CUT;
    }
    let (vertex, _) = surface_fans(surface, &twin);
    let ends = |h: u32| sorted(vertex[h as usize], vertex[next(h) as usize]);
    seams.retain(|&(h, t)| ends(h) != ends(t));
}

fn sorted<T: PartialOrd>(a: T, b: T) -> [T; 2] {
    if a < b { [a, b] } else { [b, a] }
}

fn is_hard(a: [f64; 3], b: [f64; 3]) -> bool {
    dot(a, b) < SOFT * (dot(a, a) * dot(b, b)).sqrt()
}

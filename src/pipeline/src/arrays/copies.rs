//! Parts of one shape, mapped once.
//!
//! Parts are the components of a mesh, and the charts into which they are cut. Many models repeat them: screws, links,
//! windows, and both sides of what is symmetric. A part that has the [shape](super::same_shape) of another one, or is a
//! mirror image of it, is left out of what is mapped or packed, and gets the UVs of the other: it is stacked on it.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use super::position_key::{PositionKey, position_key};
use super::repeated::GridCorners;
use super::same_shape::{CopiedFace, FlatAreas, FlatTriangles, LARGEST_TOLERANCE, Part, PartCopy};
use super::seams::Seams;
use super::soup::Soup;
use crate::options::Stacking;
use unwrapd_maps::mesh::UnionFind;

/// Parts of a mesh that are copies of others.
pub struct Copies {
    faces: Vec<CopiedFace>,
    flat: FlatAreas,
    /// Faces of each part that has copies, by the first of them.
    originals: BTreeMap<u32, Vec<u32>>,
    is_copied: Vec<bool>,
}

impl Copies {
    /// Finds the copies among parts that are given by their faces. Parts whose rules hold for each by itself have none.
    pub fn among(
        mesh: Soup,
        parts: impl IntoIterator<Item = Vec<u32>>,
        stacking: Stacking,
        triangles: FlatTriangles,
    ) -> Self {
        let mut copies = Self {
            faces: Vec::new(),
            flat: FlatAreas::default(),
            originals: BTreeMap::new(),
            is_copied: vec![false; mesh.triangles.len()],
        };
        let mut firsts: BTreeMap<(usize, usize, i64), Vec<Part>> = BTreeMap::new();
        // Copies must not join others at an edge with equal UVs: both would be one chart, on itself.
        let mut used: HashSet<EdgeUse> = HashSet::new();
        for faces in parts {
            let part = Part::new(mesh, faces);
            if !may_share(mesh.seams, &part.faces) {
                used.extend(edge_uses(mesh, &part.itself()));
                continue;
            }
            let key = |step: i64| (part.faces.len(), part.positions.len(), step);
            let step = (part.size.ln() / LARGEST_TOLERANCE)
                .floor()
                .clamp(-1e15, 1e15) as i64;
            let near = firsts.range(key(step - 1)..=key(step + 1));
            let matched = near.flat_map(|(_, parts)| parts).find_map(|first| {
                let copy = part.copy_of(first, mesh.seams, stacking, triangles)?;
                let joins = edge_uses(mesh, &copy.faces).any(|edge| used.contains(&edge));
                (!joins).then_some((first, copy))
            });
            if let Some((first, copy)) = matched {
                copies.originals.insert(first.faces[0], first.faces.clone());
                used.extend(edge_uses(mesh, &copy.faces));
                copies.add(copy);
            } else {
                used.extend(edge_uses(mesh, &part.itself()));
                firsts.entry(key(step)).or_default().push(part);
            }
        }
        copies
    }

    fn add(&mut self, copy: PartCopy) {
        for face in &copy.faces {
            self.is_copied[face.face as usize] = true;
        }
        self.faces.extend(copy.faces);
        self.flat.extend(copy.flat);
    }

    /// Returns whether a face belongs to a copy.
    pub fn has(&self, face: u32) -> bool {
        self.is_copied[face as usize]
    }

    /// Gives the faces of copies their corners, from those of the others; copies are shifted by this number of grid units
    /// along u, unless the part that they are copies of is shifted already. Returns whether the map of each original is
    /// also one of its copies; it is unless a flat area, whose triangles differ, was cut or bent.
    pub fn place(&self, grid: &mut [GridCorners], shift: i32) -> bool {
        let holds = self.flat.hold(grid);
        for CopiedFace { face, corners } in &self.faces {
            let places = corners.map(|corner| grid[corner as usize / 3][corner as usize % 3]);
            let is_shifted = shift > 0 && places.iter().any(|[u, _]| *u > shift);
            let shift = if is_shifted { 0 } else { shift };
            grid[*face as usize] = places.map(|[u, v]| [u + shift, v]);
        }
        holds
    }
}

/// Returns whether the rules of some faces allow that they share the UVs of others.
fn may_share(seams: &Seams, faces: &[u32]) -> bool {
    let is_by_itself = |&face: &u32| {
        let control = seams.control.as_ref();
        control.is_some_and(|control| control.of(face).is_by_itself())
    };
    !faces.iter().any(is_by_itself)
}

/// A mesh without the parts that are copies of others.
pub struct WithoutCopies<'a> {
    mesh: Soup<'a>,
    triangles: Vec<[u32; 3]>,
    seams: Seams,
    /// Face of the whole mesh for each triangle.
    kept: Vec<u32>,
    /// Parts that have copies, as faces of `triangles`.
    originals: Vec<Vec<u32>>,
    copies: Copies,
}

impl<'a> WithoutCopies<'a> {
    /// Finds the copies among the components.
    pub fn of(mesh: Soup<'a>, stacking: Stacking, triangles: FlatTriangles) -> Self {
        let copies = Copies::among(mesh, parts(mesh), stacking, triangles);
        let all = 0..mesh.triangles.len() as u32;
        let kept: Vec<u32> = all.filter(|&face| !copies.has(face)).collect();
        let of_kept = |corners: &Vec<[u32; 3]>| kept.iter().map(|&f| corners[f as usize]).collect();
        let seams = Seams {
            polygons: mesh.seams.polygons.as_ref().map(of_kept),
            control: (mesh.seams.control.as_ref()).map(|control| control.restricted(&kept)),
            ..mesh.seams.restricted(&kept, 0..mesh.positions.len() as u32)
        };
        // Number the originals as the faces that are kept.
        let number = |face: &u32| kept.partition_point(|other| other < face) as u32;
        let originals = copies.originals.values();
        let originals = originals.map(|faces| faces.iter().map(number).collect());
        Self {
            originals: originals.collect(),
            triangles: kept.iter().map(|&f| mesh.triangles[f as usize]).collect(),
            seams,
            kept,
            copies,
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

    /// Returns the corners of all faces of the mesh, from those of the faces that are not copied, with copies
    /// [shifted](Copies::place); `None` if a flat area of an original cannot be mapped as in its copies.
    pub fn with_copies(&self, grid: &[GridCorners], shift: i32) -> Option<Vec<GridCorners>> {
        let mut all = vec![[[0; 2]; 3]; self.mesh.triangles.len()];
        for (&face, corners) in self.kept.iter().zip(grid) {
            all[face as usize] = *corners;
        }
        self.copies.place(&mut all, shift).then_some(all)
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

/// Returns the faces of each part of a mesh, in ascending order, except of parts with a vertex of a given seam or a given
/// cone.
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
    let seams = mesh.seams.edges.iter().flatten().flatten();
    for v in seams.chain(mesh.seams.cones.iter().flatten()) {
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

//! Meshes as arrays, and their division into pieces that are mapped by themselves.

use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

use rayon::prelude::*;

use super::alike::alike;
use super::position_key::{PositionKey, position_key};
use super::seams::Seams;
use crate::PipelineError;
use unwrapd_maps::mesh::Surface;

/// A mesh as arrays.
#[derive(Clone, Copy)]
pub struct Soup<'a> {
    pub positions: &'a [[f64; 3]],
    pub triangles: &'a [[u32; 3]],
    pub seams: &'a Seams,
    /// Meshes of a document from which it was put together; empty if they are not known.
    pub parts: &'a [Part],
    /// Faces of parts that keep bounds on distortion by themselves, as they stand for their copies.
    pub originals: &'a [Vec<u32>],
}

/// A mesh of a document within a mesh that was put together from several.
#[derive(Clone, Debug)]
pub struct Part {
    pub vertices: Range<u32>,
    pub faces: Range<u32>,
}

impl Part {
    fn size(&self) -> (usize, usize) {
        (self.vertices.len(), self.faces.len())
    }
}

/// A part of a mesh that is cut and mapped by itself.
pub struct Piece<'a> {
    positions: Cow<'a, [[f64; 3]]>,
    triangles: Cow<'a, [[u32; 3]]>,
    pub seams: Cow<'a, Seams>,
    /// Face in the mesh for each triangle; absent if the piece is the whole mesh.
    faces: Option<Vec<u32>>,
}

impl Piece<'_> {
    /// Returns the surface, cut along its seams.
    pub fn surface(&self) -> Result<Surface, PipelineError> {
        let mut surface = Surface::new(&self.positions, &self.triangles)?;
        self.seams.cut(&mut surface, &self.positions);
        Ok(surface)
    }

    /// Returns the vertices of its surface, which may be reordered, at which there are cones.
    pub fn cones(&self, surface: &Surface) -> Vec<u32> {
        self.seams.cones_of(surface, &self.positions)
    }

    /// Returns the face of the mesh for a triangle.
    pub fn face(&self, triangle: u32) -> u32 {
        (self.faces.as_ref()).map_or(triangle, |faces| faces[triangle as usize])
    }

    /// Returns whether the piece is the whole mesh.
    pub fn is_whole(&self) -> bool {
        self.faces.is_none()
    }
}

impl<'a> Soup<'a> {
    /// Returns the whole mesh as one piece.
    pub fn whole(&self) -> Result<Vec<Piece<'a>>, PipelineError> {
        self.seams.check(self.positions, self.triangles)?;
        Ok(vec![Piece {
            positions: Cow::Borrowed(self.positions),
            triangles: Cow::Borrowed(self.triangles),
            seams: Cow::Borrowed(self.seams),
            faces: None,
        }])
    }

    /// Returns each part that occurs more than once as a piece, and all others as one piece.
    ///
    /// A part that touches another one, except for exact copies in the same place, may belong to it and stays with
    /// the others.
    pub fn pieces(&self) -> Result<Vec<Piece<'a>>, PipelineError> {
        self.seams.check(self.positions, self.triangles)?;
        if !self.originals.is_empty() {
            return Ok(self.pieces_with_originals());
        }
        let repeated: Vec<&Part> = self.repeated_parts();
        if repeated.is_empty() {
            return self.whole();
        }
        let mut is_left = vec![true; self.triangles.len()];
        for part in &repeated {
            is_left[part.faces.start as usize..part.faces.end as usize].fill(false);
        }
        let left: Vec<u32> = (0..)
            .zip(&is_left)
            .filter(|(_, left)| **left)
            .map(|(f, _)| f)
            .collect();
        let rest = (!left.is_empty()).then(|| Piece {
            positions: Cow::Borrowed(self.positions),
            triangles: left
                .iter()
                .map(|&face| self.triangles[face as usize])
                .collect(),
            seams: Cow::Owned(self.seams.restricted(&left, 0..self.positions.len() as u32)),
            faces: Some(left),
        });
        let parts = repeated.into_iter().map(|part| self.piece(part));
        Ok(rest.into_iter().chain(parts).collect())
    }

    /// Returns each original as a piece, and all other faces as one.
    fn pieces_with_originals(&self) -> Vec<Piece<'a>> {
        let mut is_left = vec![true; self.triangles.len()];
        for face in self.originals.iter().flatten() {
            is_left[*face as usize] = false;
        }
        let all = 0..self.triangles.len() as u32;
        let left: Vec<u32> = all.filter(|&face| is_left[face as usize]).collect();
        let rest = (!left.is_empty()).then_some(left);
        let pieces = rest.into_iter().chain(self.originals.iter().cloned());
        pieces.map(|faces| self.piece_of(faces)).collect()
    }

    /// Returns some faces as a piece with positions of its own.
    fn piece_of(&self, faces: Vec<u32>) -> Piece<'a> {
        let mut number: HashMap<u32, u32> = HashMap::new();
        let mut positions = Vec::new();
        let mut renumbered = |v: u32| {
            *number.entry(v).or_insert_with(|| {
                positions.push(self.positions[v as usize]);
                positions.len() as u32 - 1
            })
        };
        let triangles = faces.iter().map(|&face| self.triangles[face as usize]);
        let triangles: Vec<[u32; 3]> = triangles.map(|t| t.map(&mut renumbered)).collect();
        let edges = self.seams.edges.iter().flatten();
        let edges = edges.filter_map(|[a, b]| Some([*number.get(a)?, *number.get(b)?]));
        let cones = self.seams.cones.iter().flatten();
        let cones = cones.filter_map(|v| number.get(v).copied());
        let seams = Seams {
            edges: self.seams.edges.as_ref().map(|_| edges.collect()),
            cones: self.seams.cones.as_ref().map(|_| cones.collect()),
            ..self.seams.restricted(&faces, 0..0)
        };
        Piece {
            positions: Cow::Owned(positions),
            triangles: Cow::Owned(triangles),
            seams: Cow::Owned(seams),
            faces: Some(faces),
        }
    }

    fn piece(&self, part: &Part) -> Piece<'a> {
        let Range { start, end } = part.vertices;
        let faces: Vec<u32> = part.faces.clone().collect();
        let triangles = &self.triangles[part.faces.start as usize..part.faces.end as usize];
        Piece {
            positions: Cow::Borrowed(&self.positions[start as usize..end as usize]),
            triangles: triangles.iter().map(|t| t.map(|v| v - start)).collect(),
            seams: Cow::Owned(self.seams.restricted(&faces, start..end)),
            faces: Some(faces),
        }
    }

    fn repeated_parts(&self) -> Vec<&'a Part> {
        let mut of_size: HashMap<_, usize> = HashMap::new();
        for part in self.parts {
            *of_size.entry(part.size()).or_default() += 1;
        }
        let candidates: Vec<&Part> = (self.parts.iter())
            .filter(|part| of_size[&part.size()] > 1)
            .collect();
        // Parts that are not surfaces are reported when the whole mesh is made a surface.
        let surfaces: Vec<(&Part, Piece, Surface)> = (candidates.into_par_iter())
            .filter_map(|part| {
                let piece = self.piece(part);
                let surface = piece.surface().ok()?;
                Some((part, piece, surface))
            })
            .collect();
        let meshes: Vec<&Surface> = surfaces.iter().map(|(_, _, surface)| surface).collect();
        let seams: Vec<&Seams> = surfaces.iter().map(|(_, piece, _)| &*piece.seams).collect();
        let shapes = alike(&meshes, &seams);
        let mut times = vec![0; shapes.len()];
        for shape in &shapes {
            times[shape.first] += 1;
        }
        let found = shapes
            .iter()
            .zip(&surfaces)
            .filter(|(shape, _)| times[shape.first] > 1);
        let found: Vec<&Part> = found.map(|(_, (part, ..))| *part).collect();
        self.standing_apart(found)
    }

    /// Returns the parts that share no position with another part, except for parts that are equal number for number.
    fn standing_apart(&self, parts: Vec<&'a Part>) -> Vec<&'a Part> {
        if parts.is_empty() {
            return parts;
        }
        let content = |part: &Part| {
            let positions =
                &self.positions[part.vertices.start as usize..part.vertices.end as usize];
            positions
                .iter()
                .map(|&p| position_key(p))
                .collect::<Vec<_>>()
        };
        let mut first_with: HashMap<Vec<PositionKey>, u32> = HashMap::new();
        let same: Vec<u32> = (0..)
            .zip(self.parts)
            .map(|(index, part)| *first_with.entry(content(part)).or_insert(index))
            .collect();
        let mut owner: HashMap<PositionKey, Option<u32>> = HashMap::new();
        for (part, &same) in self.parts.iter().zip(&same) {
            for p in content(part) {
                let owner = owner.entry(p).or_insert(Some(same));
                *owner = owner.filter(|&owner| owner == same);
            }
        }
        let stands_apart = |part: &&Part| content(part).iter().all(|p| owner[p].is_some());
        parts.into_iter().filter(stands_apart).collect()
    }
}

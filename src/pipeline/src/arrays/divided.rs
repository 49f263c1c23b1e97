//! Division of meshes into pieces; pieces of one shape are mapped once.

use std::ops::Range;

use rayon::prelude::*;

use super::alike::{Alike, alike};
use super::map::{GivenCuts, mapped_charts};
use super::plan::{Plan, Refinement};
use super::seams::Seams;
use super::settings::Settings;
use super::soup::{Piece, Soup};
use crate::PipelineError;
use crate::portion::Portion;
use crate::tracker::Tracker;
use unwrapd_layout::charts::{Cut, MappedChart, with_needles};
use unwrapd_maps::mesh::{Defects, NeedleStep, Surface, canonical_order};

/// Largest difference of a size from 1 if a density is given.
const SAME_SIZE: f64 = 1e-6;

/// Where the triangles of a surface come from that is cut instead of another.
struct Origin {
    /// For each triangle the halfedge of the other surface that it begins with.
    halfedge: Vec<u32>,
    /// Steps that took needles out of the other surface.
    steps: Vec<NeedleStep>,
}

/// Returns a surface in canonical order, without needles where it is cut by its shape.
fn prepared(surface: &Surface, plan: &Plan) -> (Surface, Origin) {
    let without = match plan.refinement {
        Refinement::UnderBound => surface.without_needles(),
        Refinement::Glued | Refinement::None => None,
    };
    let Some((surface, triangles, steps)) = without else {
        let halfedge = canonical_order(surface);
        let steps = Vec::new();
        return (surface.reordered(&halfedge), Origin { halfedge, steps });
    };
    let order = canonical_order(&surface);
    let halfedge = order.iter().map(|&h| 3 * triangles[h as usize / 3] + h % 3);
    let origin = Origin {
        halfedge: halfedge.collect(),
        steps,
    };
    (surface.reordered(&order), origin)
}

/// The pieces of several meshes.
pub struct Divided<'a> {
    pieces: Vec<Piece<'a>>,
    surfaces: Vec<Surface>,
    shapes: Vec<Alike>,
    /// The pieces of each mesh.
    of_mesh: Vec<Range<usize>>,
}

impl<'a> Divided<'a> {
    pub fn new(meshes: &[Soup<'a>], plan: &Plan) -> Result<Self, PipelineError> {
        // The maximum number of charts applies to an atlas, not to a piece.
        let is_one = plan.most_charts.is_some();
        let pieces: Vec<Vec<Piece>> = meshes
            .par_iter()
            .map(|mesh| if is_one { mesh.whole() } else { mesh.pieces() })
            .collect::<Result<_, _>>()?;
        let mut next = 0;
        let of_mesh = pieces.iter().map(|of_mesh| {
            next += of_mesh.len();
            next - of_mesh.len()..next
        });
        let of_mesh = of_mesh.collect();
        let pieces: Vec<Piece> = pieces.into_iter().flatten().collect();
        let surfaces: Vec<Surface> = pieces
            .par_iter()
            .map(Piece::surface)
            .collect::<Result<_, _>>()?;
        if surfaces.iter().all(|surface| surface.triangles.is_empty()) {
            return Err(match meshes.iter().map(|mesh| mesh.triangles.len()).sum() {
                0 => PipelineError::NoTriangles,
                triangles => PipelineError::NoArea { triangles },
            });
        }
        let seams: Vec<&Seams> = pieces.iter().map(|piece| &*piece.seams).collect();
        let shapes = alike(&surfaces.iter().collect::<Vec<_>>(), &seams);
        Ok(Self {
            pieces,
            surfaces,
            shapes,
            of_mesh,
        })
    }

    /// Returns the charts of the `wanted` meshes, with corners `3 f + c` of their faces; only the first piece of each
    /// shape is mapped.
    pub fn charts(&self, wanted: &[bool], plan: &Plan, tracker: &Tracker) -> Vec<Vec<MappedChart>> {
        let mut mapped = self.mapped(plan, tracker);
        let meshes = || (0..wanted.len()).filter(|&mesh| wanted[mesh]);
        let mut uses = vec![0; self.pieces.len()];
        for piece in meshes().flat_map(|mesh| self.of_mesh[mesh].clone()) {
            uses[self.shapes[piece].first] += 1;
        }
        let mut charts = vec![Vec::new(); wanted.len()];
        for mesh in meshes() {
            for piece in self.of_mesh[mesh].clone() {
                let Alike { first, size } = self.shapes[piece];
                uses[first] -= 1;
                let own = if uses[first] == 0 {
                    std::mem::take(&mut mapped[first])
                } else {
                    mapped[first].clone()
                };
                charts[mesh].extend(own.into_iter().map(|chart| self.placed(chart, piece, size)));
            }
        }
        charts
    }

    /// Converts a chart of the first piece of a shape to a chart of `piece`.
    fn placed(&self, mut chart: MappedChart, piece: usize, size: f64) -> MappedChart {
        chart.scale(size);
        for corner in chart.chart.corners.as_flattened_mut() {
            *corner = 3 * self.face(piece, *corner / 3) + *corner % 3;
        }
        chart
    }

    /// Returns the charts of the first piece of each shape, cut and mapped in canonical order, and no charts for
    /// other pieces.
    fn mapped(&self, plan: &Plan, tracker: &Tracker) -> Vec<Vec<MappedChart>> {
        let is_first = |&piece: &usize| self.shapes[piece].first == piece;
        let firsts: Vec<usize> = (0..self.pieces.len()).filter(is_first).collect();
        let (surfaces, origins): (Vec<Surface>, Vec<Origin>) = (firsts.par_iter())
            .map(|&piece| prepared(&self.surfaces[piece], plan))
            .unzip();
        let cuts: Vec<GivenCuts> = (firsts.iter().zip(&surfaces))
            .map(|(&piece, surface)| GivenCuts {
                seams: &self.pieces[piece].seams,
                cones: self.pieces[piece].cones(surface),
            })
            .collect();
        let mut mapped = vec![Vec::new(); self.pieces.len()];
        let charts = mapped_charts(&surfaces, &cuts, plan, tracker);
        for ((piece, origin), mut charts) in firsts.into_iter().zip(origins).zip(charts) {
            for corner in charts
                .iter_mut()
                .flat_map(|map| map.chart.corners.as_flattened_mut())
            {
                let first = origin.halfedge[*corner as usize / 3];
                *corner = 3 * (first / 3) + (first + *corner) % 3;
            }
            if !origin.steps.is_empty() {
                // The stage has counted the work on this surface already.
                let portion = Portion::of_surface(tracker, piece, 0);
                let surface = &self.surfaces[piece];
                charts = with_needles(surface, &origin.steps, charts, &plan.embedding, &portion);
            }
            mapped[piece] = match plan.cut {
                Cut::Keep => charts,
                _ => (charts.into_iter())
                    .flat_map(MappedChart::parted_without_front)
                    .collect(),
            };
        }
        mapped
    }

    /// Returns the face of the mesh for a triangle of a piece's surface.
    fn face(&self, piece: usize, triangle: u32) -> u32 {
        self.pieces[piece].face(self.surfaces[piece].faces[triangle as usize])
    }

    /// Returns the number of triangles in the pieces that are mapped.
    pub fn n_mapped_faces(&self) -> usize {
        let is_first = |&piece: &usize| self.shapes[piece].first == piece;
        let firsts = (0..self.pieces.len()).filter(is_first);
        firsts
            .map(|piece| self.surfaces[piece].triangles.len())
            .sum()
    }

    /// Returns the number of triangles of a mesh that are in charts.
    pub fn n_faces(&self, mesh: usize) -> usize {
        let pieces = self.of_mesh[mesh].clone();
        pieces
            .map(|piece| self.surfaces[piece].triangles.len())
            .sum()
    }

    /// Returns the number of components of a mesh.
    pub fn n_components(&self, mesh: usize) -> usize {
        let pieces = self.of_mesh[mesh].clone();
        pieces
            .map(|piece| self.surfaces[piece].defects.components)
            .sum()
    }

    /// Returns the faces of a mesh that are in charts, in ascending order.
    pub fn faces(&self, mesh: usize) -> Vec<u32> {
        let of_piece = |piece: usize| {
            let triangles = 0..self.surfaces[piece].triangles.len() as u32;
            triangles.map(move |triangle| self.face(piece, triangle))
        };
        let mut faces: Vec<u32> = self.of_mesh[mesh].clone().flat_map(of_piece).collect();
        faces.sort_unstable();
        faces
    }

    /// Returns an earlier mesh whose atlas also fits this mesh, and the size of this mesh relative to it.
    pub fn same_mesh(&self, mesh: usize, settings: &Settings) -> Option<(usize, f64)> {
        let whole = |mesh: usize| {
            let piece = self.of_mesh[mesh].start;
            self.pieces[piece].is_whole().then_some(piece)
        };
        let Alike { first, size } = self.shapes[whole(mesh)?];
        let other = self.of_mesh.partition_point(|pieces| pieces.end <= first);
        let is_sized = settings.layout.texels_per_unit.is_none() || (size - 1.0).abs() <= SAME_SIZE;
        let is_same = other != mesh && whole(other).is_some() && is_sized;
        is_same.then_some((other, size))
    }

    /// Returns the defects of a mesh.
    pub fn defects(&self, mesh: usize, soup: &Soup) -> Result<Defects, PipelineError> {
        let first = self.of_mesh[mesh].start;
        if self.pieces[first].is_whole() {
            return Ok(self.surfaces[first].defects);
        }
        Ok(Surface::new(soup.positions, soup.triangles)?.defects)
    }
}

//! Triangles of bounded angles inside an outline.

use super::{Outline, OutlineError};
use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};
use std::collections::HashSet;
use unwrapd_maps::mesh::PlanarMesh;

/// Mean area of triangles after refinement, as a share of the largest allowed area; measured on a disk with 10⁵ and
/// 5·10⁵ triangles.
const MEAN_TO_LARGEST: f64 = 0.63;
/// Attempts to meet a number of triangles; the first is within a quarter, each further one much nearer.
const ATTEMPTS: usize = 3;
/// Relative tolerance for the number of triangles.
const NEAR: f64 = 0.1;

/// Resolution of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlineResolution {
    /// Approximate edge length, in units of the outline.
    EdgeLength(f64),
    /// Approximate number of triangles; an outline with many vertices needs more.
    Triangles(usize),
}

/// Settings for filling an outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshSettings {
    /// Resolution.
    pub resolution: OutlineResolution,
    /// Least angle of a triangle, in degrees, unless the outline itself has a smaller one; at most 30.
    pub smallest_angle: f64,
    /// Most triangles; a mesh that needs more is refused.
    pub most_triangles: usize,
}

impl Default for MeshSettings {
    fn default() -> Self {
        Self {
            resolution: OutlineResolution::Triangles(5000),
            smallest_angle: 25.0,
            most_triangles: 1_000_000,
        }
    }
}

/// Fills an outline with triangles, leaving out holes (Delaunay refinement after Ruppert, by `spade`).
///
/// Boundary edges are split where they are long. Every vertex is used, every triangle is positive (exactly). Equal
/// input gives equal meshes.
pub fn triangulate(outline: &Outline, settings: &MeshSettings) -> Result<PlanarMesh, OutlineError> {
    if !(0.0..=30.0).contains(&settings.smallest_angle) {
        return Err(OutlineError::InvalidSetting("smallest_angle"));
    }
    // Find the largest area for the resolution.
    let area = outline.area();
    let largest = |n: usize| area / n as f64 / MEAN_TO_LARGEST;
    let (mut largest_area, wanted) = match settings.resolution {
        // An equilateral triangle of the wanted edge is an average one.
        OutlineResolution::EdgeLength(h) if h > 0.0 && h.is_finite() => {
            (0.75_f64.sqrt() * 0.5 * h * h / MEAN_TO_LARGEST, None)
        }
        OutlineResolution::Triangles(n) if n > 0 => (largest(n), Some(n as f64)),
        OutlineResolution::EdgeLength(_) => {
            return Err(OutlineError::InvalidSetting("edge_length"));
        }
        OutlineResolution::Triangles(_) => return Err(OutlineError::InvalidSetting("triangles")),
    };
    if largest_area < largest(settings.most_triangles) {
        return Err(OutlineError::TooManyTriangles(settings.most_triangles));
    }
    // Fill the outline; correct the area until the number of triangles is near enough.
    let mut mesh = fill(outline, largest_area, settings)?;
    for _ in 1..ATTEMPTS {
        let Some(wanted) = wanted else { break };
        let ratio = mesh.triangles().len() as f64 / wanted;
        if (ratio - 1.0).abs() <= NEAR {
            break;
        }
        largest_area = (largest_area * ratio).min(area);
        mesh = fill(outline, largest_area, settings)?;
    }
    Ok(mesh)
}

fn fill(
    outline: &Outline,
    largest_area: f64,
    settings: &MeshSettings,
) -> Result<PlanarMesh, OutlineError> {
    let frame = &outline.frame;
    let mut triangulation = triangulation(outline)?;
    // A triangulation has two triangles for each vertex.
    let most_vertices = settings.most_triangles / 2;
    let refined = triangulation.refine(
        RefinementParameters::new()
            .exclude_outer_faces(true)
            .with_angle_limit(AngleLimit::from_deg(settings.smallest_angle))
            .with_max_allowed_area(largest_area / (frame.side * frame.side))
            .with_max_additional_vertices(most_vertices),
    );
    if !refined.refinement_complete {
        return Err(OutlineError::TooManyTriangles(settings.most_triangles));
    }
    // Collect the triangles inside, and number their vertices by first use.
    let outside: HashSet<_> = refined.excluded_faces.into_iter().collect();
    let mut vertex_of = vec![u32::MAX; triangulation.num_vertices()];
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for face in triangulation.inner_faces() {
        if outside.contains(&face.fix()) {
            continue;
        }
        triangles.push(face.vertices().map(|vertex| {
            let slot = &mut vertex_of[vertex.fix().index()];
            if *slot == u32::MAX {
                *slot = vertices.len() as u32;
                let p = vertex.position();
                vertices.push(frame.leave([p.x, p.y]));
            }
            *slot
        }));
    }
    match PlanarMesh::new(vertices, triangles) {
        Ok(mesh) if mesh.reoriented() == 0 => Ok(mesh),
        _ => Err(OutlineError::TooFine),
    }
}

/// Returns the constrained Delaunay triangulation of the boundary, in the outline's frame.
fn triangulation(
    outline: &Outline,
) -> Result<ConstrainedDelaunayTriangulation<Point2<f64>>, OutlineError> {
    let (mut vertices, mut edges) = (Vec::new(), Vec::new());
    for boundary in outline.loops() {
        let (first, n) = (vertices.len(), boundary.len());
        vertices.extend(
            boundary
                .iter()
                .map(|&p| Point2::from(outline.frame.enter(p))),
        );
        edges.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
    }
    let n_vertices = vertices.len();
    let mut n_conflicts = 0;
    let triangulation =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(vertices, edges, |_| {
            n_conflicts += 1;
        })
        .map_err(|_| OutlineError::TooFine)?;
    if n_conflicts > 0 || triangulation.num_vertices() != n_vertices {
        return Err(OutlineError::TooFine);
    }
    Ok(triangulation)
}

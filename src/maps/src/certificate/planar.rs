//! Judgment of a deformed mesh of the plane.

use super::box_tree::Visit;
use super::overlap::OrientedFaces;
use crate::mesh::CornerUvs;
use serde::Serialize;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Certificate of triangles in the plane: facts proven by exact predicates on their coordinates.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PlanarCertificate {
    /// Triangles judged, all those below included.
    pub faces: usize,
    /// Triangles of negative area.
    pub inverted: usize,
    /// Triangles of exactly zero area.
    pub degenerate: usize,
    /// Triangles that cannot be judged: a coordinate is not finite or an index out of range.
    pub nonfinite: usize,
    /// Pairs of triangles whose interiors intersect.
    pub overlapping_pairs: u64,
    /// `true` if the search for pairs stopped at its limit, so that there may be more.
    pub overlap_truncated: bool,
}

impl PlanarCertificate {
    /// Returns whether every triangle has positive area: the map from a rest shape of positive triangles is locally
    /// injective.
    pub fn is_valid(&self) -> bool {
        self.inverted == 0 && self.degenerate == 0 && self.nonfinite == 0
    }

    /// Returns whether the map is bijective: also no two triangles overlap, whether its boundary was fixed or free.
    pub fn is_bijective(&self) -> bool {
        self.is_valid() && self.overlapping_pairs == 0 && !self.overlap_truncated
    }
}

/// Judges triangles that should be counter-clockwise and disjoint except for their edges and corners.
///
/// Unlike in [`certify`](super::certify), a mirrored mesh is not valid. All triangles are tested against each other by
/// a tree of boxes, so that slits and boundaries that touch need no special case: touching is no overlap.
pub fn certify_planar(vertices: &[[f64; 2]], triangles: &[[u32; 3]]) -> PlanarCertificate {
    let corners_of = |triangle: &[u32; 3]| -> Option<CornerUvs> {
        let corner = |k: usize| {
            let vertex = vertices.get(triangle[k] as usize)?;
            vertex.iter().all(|x| x.is_finite()).then_some(*vertex)
        };
        Some([corner(0)?, corner(1)?, corner(2)?])
    };
    let corners: Vec<CornerUvs> = triangles.iter().filter_map(corners_of).collect();
    let orientation: Vec<i8> = corners
        .iter()
        .map(|&[a, b, c]| orient2d_sign(a, b, c))
        .collect();
    let count = |sign: i8| orientation.iter().filter(|&&s| s == sign).count();
    let mut overlapping_pairs = 0;
    let visit = OrientedFaces::of(&corners, &orientation).overlaps(|_| overlapping_pairs += 1);
    PlanarCertificate {
        faces: triangles.len(),
        inverted: count(-1),
        degenerate: count(0),
        nonfinite: triangles.len() - corners.len(),
        overlapping_pairs,
        overlap_truncated: visit == Visit::Truncated,
    }
}

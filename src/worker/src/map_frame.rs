//! Binary format of maps under way, as watchers of a job receive them; little-endian.
//!
//! ```text
//! frame   0  u8   3                          map   0  u32  surface          28  u32  0; 1 for a plan
//!         1  7 zeros                               4  u32  first face       32  f64  unit
//!         8  u64  number                           8  u32  iteration        40  f64  energy
//!        16  maps                                 12  u32  faces            48  f64  smallest face
//!                                                 16  u32  faces that follow
//!                                                 20  u32  flips
//!                                                 24  u32  bytes of a coordinate: 4, 8
//!                                                 56  faces u32; u and v of three corners each, f32 or f64
//! ```
//!
//! Faces are those of the welded surface in cutting order. If there are too many to draw, only every 2ⁿ-th one
//! follows. Seams of large charts are planned on a simplified mesh, and each face of a plan stands for one near it.

use unwrapd_layout::charts::MapUnderway;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Maximum number of faces drawn of a map. In f32 they take 2.8 MB, a third of a second at the rate limit of frames.
const MOST_FACES: usize = 100_000;

/// Identity of a chart: its surface and its first face. Later maps of the chart have the same key.
pub(crate) type ChartKey = [u32; 2];

/// Returns the key of the chart that a map belongs to.
pub(crate) fn key(surface: usize, map: &MapUnderway) -> ChartKey {
    [surface as u32, map.faces().next().unwrap_or(0)]
}

/// Encodes a map. Rounds coordinates to f32 unless that would flip a face; `flips` counts the encoded numbers.
pub(crate) fn encoded([surface, first]: ChartKey, map: &MapUnderway) -> Vec<u8> {
    // Choose the precision.
    let points: &[[f64; 2]] = map.x.as_chunks().0;
    let rounded: Vec<[f64; 2]> = points
        .iter()
        .map(|p| p.map(|x| f64::from(x as f32)))
        .collect();
    let triangles = &map.chart.disk.triangles;
    let is_exact = flips(triangles, &rounded) > 0;
    let (points, width) = if is_exact {
        (points, 8)
    } else {
        (&*rounded, 4)
    };
    // Choose the faces to draw.
    let step = triangles.len().div_ceil(MOST_FACES).next_power_of_two() as u32;
    let drawn: Vec<(u32, &[u32; 3])> = (map.faces().zip(triangles))
        .filter(|(face, _)| face % step == 0)
        .collect();

    // Write the header, then faces and coordinates.
    let mut bytes = Vec::with_capacity(56 + drawn.len() * (4 + 6 * width));
    let counts = [
        surface,
        first,
        map.iterate.iteration as u32,
        triangles.len() as u32,
        drawn.len() as u32,
        flips(triangles, points),
        width as u32,
        u32::from(map.planned_for.is_some()),
    ];
    bytes.extend(counts.iter().flat_map(|x| x.to_le_bytes()));
    let numbers = [map.unit(), map.iterate.energy, map.iterate.smallest];
    bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend(drawn.iter().flat_map(|(face, _)| face.to_le_bytes()));
    let corners = drawn.iter().flat_map(|(_, triangle)| *triangle);
    let coordinates = corners.flat_map(|&v| points[v as usize]);
    if is_exact {
        bytes.extend(coordinates.flat_map(f64::to_le_bytes));
    } else {
        bytes.extend(coordinates.flat_map(|x| (x as f32).to_le_bytes()));
    }
    bytes
}

/// Counts the triangles that are not positively oriented, exactly.
fn flips(triangles: &[[u32; 3]], points: &[[f64; 2]]) -> u32 {
    let is_flipped = |t: &&[u32; 3]| {
        let [a, b, c] = t.map(|v| points[v as usize]);
        orient2d_sign(a, b, c) <= 0
    };
    triangles.iter().filter(is_flipped).count() as u32
}

//! Coverage of the texture.

use super::faces::FaceMeasures;
use crate::certificate::{BoxVisit, ChartBoundary, UvTopology, segment_distance};
use crate::mesh::{CornerUvs, UsedVertices};
use serde::Serialize;
use std::collections::BTreeMap;

/// Coverage of the texture, counted at texel centers of a raster over the unit square (over the square that holds the UVs where they
/// leave it). A center on a common edge counts once.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Packing {
    /// Side of the raster in texels.
    pub raster_res: u32,
    /// Texels that at least one face covers.
    pub covered_texels: u64,
    /// Texels that two or more faces cover, over covered ones.
    pub overlap_frac: Option<f64>,
    /// Texels that two or more faces cover.
    pub overlap_texels: u64,
    /// The most faces that cover one texel.
    pub overlap_max_layers: u32,
    /// Covered part of the unit square; null when UVs leave it.
    pub pack_unit: Option<f64>,
    /// Covered part of the smallest axis-aligned square that could hold the UV bounding box.
    pub pack_square: f64,
    /// Covered part of the UV bounding box.
    pub pack_rect: f64,
}

impl Packing {
    pub(super) fn new(topology: &UvTopology, texels: u32, aspect: f64) -> Packing {
        let [low, high] = topology.bounds;
        let extent = topology.extent();
        let unit = in_unit_square(topology, aspect);
        let (origin, side) = if unit {
            ([0.0; 2], aspect.max(1.0))
        } else {
            (low, extent)
        };
        let counts = coverage(&topology.uvs, texels, origin, side);
        let covered = counts.covered as f64 * (side / f64::from(texels)).powi(2);
        let [width, height] = [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-100));
        Packing {
            raster_res: texels,
            covered_texels: counts.covered,
            overlap_frac: (counts.covered > 0)
                .then(|| counts.covered_twice as f64 / counts.covered as f64),
            overlap_texels: counts.covered_twice,
            overlap_max_layers: counts.most_layers,
            pack_unit: unit.then_some(covered / aspect),
            pack_square: covered / (extent * extent),
            pack_rect: covered / (width * height),
        }
    }
}

// Coverage of texel centers by faces.

/// Fixed-point units per texel.
const ONE: i64 = 1 << 16;
const HALF: i64 = ONE / 2;

/// Rows rasterized at a time: their counters stay in the cache, 130 kB at 1024 texels.
const BAND: usize = 32;
/// Texels over which mostly nothing changes, so that they are counted at once: a cache line of counters.
const STEADY: usize = 16;

/// Totals over a raster.
#[derive(Clone, Copy, Default)]
struct CoverageTotals {
    pub covered: u64,
    pub covered_twice: u64,
    pub most_layers: u32,
}

/// Counts covered texel centers of a `texels`² raster over the square at `origin` with the given side.
///
/// Half-open scan conversion in fixed point, exact once corners are rounded to 2⁻¹⁶ texel: in a triangulation without
/// overlaps every center is counted exactly once, also on edges and vertices.
fn coverage(uvs: &[CornerUvs], texels: u32, origin: [f64; 2], side: f64) -> CoverageTotals {
    let scale = f64::from(texels) * ONE as f64;
    let texels = texels as usize;
    let faces: Vec<[[i64; 2]; 3]> = uvs
        .iter()
        .map(|corners| {
            corners.map(|uv: [f64; 2]| {
                [0, 1]
                    .map(|axis| ((uv[axis] - origin[axis]) / side * scale).round_ties_even() as i64)
            })
        })
        .collect();
    let bands = faces_by_band(&faces, texels);
    let mut coverage = CoverageTotals::default();
    // Difference array of a band: at each column how many spans begin less how many end.
    let mut change = vec![0_i32; BAND * (texels + 1)];
    for (band, members) in bands.iter().enumerate() {
        change.fill(0);
        let rows = band * BAND..((band + 1) * BAND).min(texels);
        for &face in members {
            add_spans(&faces[face as usize], &rows, texels, &mut change);
        }
        for row in change.chunks(texels + 1) {
            coverage.add_row(&row[..texels]);
        }
    }
    coverage
}

impl CoverageTotals {
    fn add_row(&mut self, change: &[i32]) {
        let mut layers = 0;
        let (mut covered, mut covered_twice, mut most) = (0_u32, 0_u32, 0);
        for some in change.chunks(STEADY) {
            if some.iter().fold(0, |all, change| all | change) == 0 {
                covered += STEADY as u32 * u32::from(layers > 0);
                covered_twice += STEADY as u32 * u32::from(layers > 1);
                continue;
            }
            for step in some {
                layers += step;
                covered += u32::from(layers > 0);
                covered_twice += u32::from(layers > 1);
                most = most.max(layers);
            }
        }
        self.covered += u64::from(covered);
        self.covered_twice += u64::from(covered_twice);
        self.most_layers = self.most_layers.max(most as u32);
    }
}

/// Returns for each band of rows the faces that have rows of texel centers in it.
fn faces_by_band(faces: &[[[i64; 2]; 3]], texels: usize) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); texels.div_ceil(BAND)];
    for (face, corners) in (0..).zip(faces) {
        let rows = rows(corners, texels);
        if !rows.is_empty() {
            for band in &mut bands[rows.start / BAND..=(rows.end - 1) / BAND] {
                band.push(face);
            }
        }
    }
    bands
}

/// Returns the rows whose center lies at or above the lowest corner and below the highest.
fn rows([a, b, c]: &[[i64; 2]; 3], texels: usize) -> std::ops::Range<usize> {
    let low = a[1].min(b[1]).min(c[1]);
    let high = a[1].max(b[1]).max(c[1]);
    first_center(low).clamp(0, texels as i64) as usize
        ..first_center(high).clamp(0, texels as i64) as usize
}

/// Returns the first texel whose center is at or beyond a coordinate.
fn first_center(x: i64) -> i64 {
    (x - HALF + ONE - 1).div_euclid(ONE)
}

/// Adds a face's spans in the given rows to their difference array.
fn add_spans(
    corners: &[[i64; 2]; 3],
    band: &std::ops::Range<usize>,
    texels: usize,
    change: &mut [i32],
) {
    let of_face = rows(corners, texels);
    for row in of_face.start.max(band.start)..of_face.end.min(band.end) {
        let y = row as i64 * ONE + HALF;
        let (mut from, mut to) = (i64::MAX, i64::MIN);
        for e in 0..3 {
            if let Some(column) = crossing(corners[e], corners[(e + 1) % 3], y) {
                from = from.min(column);
                to = to.max(column);
            }
        }
        if from < to {
            let line = &mut change[(row - band.start) * (texels + 1)..][..=texels];
            line[from.clamp(0, texels as i64) as usize] += 1;
            line[to.clamp(0, texels as i64) as usize] -= 1;
        }
    }
}

/// Returns the first column whose center is at or to the right of the point where an edge crosses the line at `y`; an
/// edge contains only its lower end.
fn crossing(p: [i64; 2], q: [i64; 2], y: i64) -> Option<i64> {
    let ([x0, y0], [x1, y1]) = if p[1] <= q[1] { (p, q) } else { (q, p) };
    (y0 <= y && y < y1).then(|| {
        let height = y1 - y0;
        let numerator = (x0 - HALF) * height + (y - y0) * (x1 - x0);
        let denominator = height * ONE;
        -(-numerator).div_euclid(denominator)
    })
}

// Contents of the pages of an atlas.

/// One page: a unit square of UV space that holds charts.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Page {
    /// Its number as a tile of UDIM, 1001 + u + 10 v with the u and v, up, of its lower left corner.
    pub udim: u32,
    /// Charts with the middle of their UVs on it.
    pub charts: usize,
    /// Their area over that of the page.
    pub fill: f64,
}

/// Most tiles in a row, and most rows: their numbers, 1001 + u + 10 v, have four digits.
const TILES: i64 = 10;
const ROWS: i64 = 899;

/// Returns the pages on which charts lie, in the order of their numbers; charts outside all tiles are left out.
///
/// `up` turns a v of the file into one that points up.
pub(super) fn pages(
    topology: &UvTopology,
    faces: &FaceMeasures,
    aspect: f64,
    up: impl Fn(f64) -> f64,
) -> Vec<Page> {
    // Find the bounds of each chart.
    let mut bounds = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; faces.charts.len()];
    for (corners, &chart) in topology.uvs.iter().zip(&topology.charts.of_face) {
        let [low, high] = &mut bounds[chart as usize];
        for uv in corners {
            for axis in 0..2 {
                low[axis] = low[axis].min(uv[axis]);
                high[axis] = high[axis].max(uv[axis]);
            }
        }
    }
    // Count each chart on the page that holds the middle of its bounds.
    let mut pages: BTreeMap<u32, (usize, f64)> = BTreeMap::new();
    for (chart, [low, high]) in faces.charts.iter().zip(bounds) {
        let middle = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
        let (u, v) = (
            (middle[0] / aspect).floor() as i64,
            up(middle[1]).floor() as i64,
        );
        if chart.is_real() && (0..TILES).contains(&u) && (0..ROWS).contains(&v) {
            let page = pages.entry((1001 + u + TILES * v) as u32).or_default();
            *page = (page.0 + 1, page.1 + chart.area_uv / aspect);
        }
    }
    let listed = pages.into_iter();
    listed
        .map(|(udim, (charts, fill))| Page { udim, charts, fill })
        .collect()
}

// Counts, areas and extents.

/// Counts, areas and extents.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Size {
    /// Faces.
    pub faces: usize,
    /// Vertices that faces refer to, as the file has them.
    pub vertices: usize,
    /// Vertices after welding equal positions.
    pub vertices_welded: usize,
    /// Faces with a UV that is not finite (or without UVs or vertices).
    pub uv_nonfinite_faces: usize,
    /// Faces without area in 3D.
    pub faces_degenerate_3d: usize,
    /// Surface area.
    pub area_3d: f64,
    /// Sum of the unsigned UV areas of the faces.
    pub area_uv: f64,
    /// Diagonal of the bounding box of the positions.
    pub bbox_diag: f64,
    /// Smallest u and v.
    pub uv_min: [f64; 2],
    /// Greatest u and v.
    pub uv_max: [f64; 2],
    /// Width and height of the UV bounding box.
    pub uv_bbox: [f64; 2],
    /// `true` if all UVs lie in the unit square, to 1e-6.
    pub uv_in_unit_square: bool,
}

impl Size {
    pub(super) fn new(
        triangles: &[[u32; 3]],
        topology: &UvTopology,
        faces: &FaceMeasures,
        aspect: f64,
    ) -> Size {
        let [low, high] = topology.bounds;
        Size {
            faces: triangles.len(),
            vertices: distinct(triangles),
            vertices_welded: distinct(&topology.faces),
            uv_nonfinite_faces: count(&topology.unusable),
            faces_degenerate_3d: count(&faces.degenerate_3d),
            area_3d: faces.total_3d,
            area_uv: faces.total_uv,
            bbox_diag: faces.diagonal,
            uv_min: low,
            uv_max: high,
            uv_bbox: [0, 1].map(|axis| (high[axis] - low[axis]).max(1e-100)),
            uv_in_unit_square: in_unit_square(topology, aspect),
        }
    }
}

/// Returns whether all UVs lie in the unit square, whose width is `aspect` here, to 1e-6.
fn in_unit_square(topology: &UvTopology, aspect: f64) -> bool {
    let [low, high] = topology.bounds;
    low.iter().all(|&x| x >= -1e-6) && high[0] <= aspect + 1e-6 && high[1] <= 1.0 + 1e-6
}

fn count(flags: &[bool]) -> usize {
    flags.iter().filter(|&&flag| flag).count()
}

fn distinct(faces: &[[u32; 3]]) -> usize {
    UsedVertices::new(faces.iter().flatten().copied()).count()
}

// Distances between charts.

/// Distances between the boundaries of different charts, in parts of the unit square's side (of the UV extent where
/// UVs leave it); 0 means that charts touch or cross. Null when there is one chart.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Gaps {
    /// The smallest distance between two charts.
    pub gap_uv: Option<f64>,
    /// The smallest distance in texels of a 1024² texture.
    pub gap_texels_1024: Option<f64>,
    /// The smallest distance in texels of a 4096² texture.
    pub gap_texels_4096: Option<f64>,
    /// Charts less than a texel of a 1024² texture away from another.
    pub charts_gap_lt_1texel_1024: Option<usize>,
    /// Charts less than a texel of a 4096² texture away from another.
    pub charts_gap_lt_1texel_4096: Option<usize>,
    /// `true` if the search stopped at its limit.
    pub gap_truncated: bool,
}

impl Gaps {
    pub(super) fn new(topology: &UvTopology, faces: &FaceMeasures, aspect: f64) -> Gaps {
        let real = faces.charts.iter().filter(|chart| chart.is_real()).count();
        let chart = |face: u32| topology.charts.of_face[face as usize] as usize;
        let boundary = ChartBoundary::new(topology, |face| faces.charts[chart(face)].is_real());
        if real < 2 || boundary.edges.is_empty() {
            return Gaps::default();
        }
        // Measure relative to the unit square or, if UVs leave it, to their extent.
        let side = if in_unit_square(topology, aspect) {
            1.0
        } else {
            topology.extent()
        };
        // Look for charts within a texel of 1024; if there are none, search for the closest pair anywhere.
        let (nearest, visit) = nearest_charts(&boundary, faces.charts.len(), side / 1024.0);
        let within = nearest.iter().copied().fold(f64::INFINITY, f64::min);
        let (gap, visit) = if within.is_finite() || visit == BoxVisit::Truncated {
            (within, visit)
        } else {
            boundary.closest()
        };
        let gap_uv = gap.is_finite().then_some(gap / side);
        // 0.999: a chart placed just a texel away may come out nearer by rounding.
        let closer_than = |texels: f64| {
            Some(
                nearest
                    .iter()
                    .filter(|&&gap| gap < side / texels * 0.999)
                    .count(),
            )
        };
        Gaps {
            gap_uv,
            gap_texels_1024: gap_uv.map(|gap| gap * 1024.0),
            gap_texels_4096: gap_uv.map(|gap| gap * 4096.0),
            charts_gap_lt_1texel_1024: closer_than(1024.0),
            charts_gap_lt_1texel_4096: closer_than(4096.0),
            gap_truncated: visit == BoxVisit::Truncated,
        }
    }
}

/// Returns for each chart the distance to the nearest other, infinite if that is more than `reach`.
fn nearest_charts(boundary: &ChartBoundary, n_charts: usize, reach: f64) -> (Vec<f64>, BoxVisit) {
    let margin = 0.5 * reach * (1.0 + 1e-9); // a pair at just this distance is found
    let mut nearest = vec![f64::INFINITY; n_charts];
    let visit = boundary.near_pairs(margin, |p, q| {
        let [a, b] = [p, q].map(|edge| edge.chart as usize);
        if a != b && nearest[a].max(nearest[b]) > 0.0 {
            let distance = segment_distance(p.uvs, q.uvs);
            if distance <= reach {
                nearest[a] = nearest[a].min(distance);
                nearest[b] = nearest[b].min(distance);
            }
        }
    });
    (nearest, visit)
}

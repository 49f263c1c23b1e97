//! Coverage of the texture.

use super::size::in_unit_square;
use crate::certificate::UvTopology;
use crate::mesh::CornerUvs;
use serde::Serialize;

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
    let fixed = |uv: [f64; 2]| {
        [0, 1].map(|axis| ((uv[axis] - origin[axis]) / side * scale).round_ties_even() as i64)
    };
    let texels = texels as usize;
    let faces: Vec<[[i64; 2]; 3]> = uvs.iter().map(|corners| corners.map(fixed)).collect();
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
            if some == [0; STEADY] {
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

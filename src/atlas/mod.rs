//! Charts placed in the unit square, on an integer grid.
//!
//! Chart maps arrive one by one, in mesh units and all at one density. Each is turned to a good
//! angle, all are packed without touching, at one scale, and every vertex is rounded to a multiple
//! of 2⁻²³, which `f32` holds exactly. Rounding may flip a triangle that was positive in `f64`:
//! such places are repaired, and what leaves this module is positive in exact integer arithmetic.
//!
//! Charts are never mirrored and never scaled one against the other.
mod orientation;

use thiserror::Error;

/// Atlas coordinates are integers in `0..=2^GRID_BITS`, the unit square in steps `f32` represents.
pub const GRID_BITS: u32 = 23;

/// One chart's map: counter-clockwise triangles over vertices in mesh units.
#[derive(Clone, Copy, Debug)]
pub struct ChartMap<'a> {
    /// The position of each vertex in the plane.
    pub uv: &'a [[f64; 2]],
    /// Vertex indices, each triangle counter-clockwise.
    pub triangles: &'a [[u32; 3]],
}

/// How the atlas is laid out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AtlasOptions {
    /// Side of the texture, in texels, in which the padding is counted.
    pub resolution: u32,
    /// Smallest distance between two charts, in texels.
    pub padding_texels: u32,
}

impl Default for AtlasOptions {
    fn default() -> Self {
        Self {
            resolution: 1024,
            padding_texels: 2,
        }
    }
}

/// One chart in the atlas.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The position of each vertex in units of 2^-[`GRID_BITS`], v up.
    pub grid: Vec<[i32; 2]>,
}

/// All charts in the unit square.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// The charts, in the order they were given.
    pub placed: Vec<Placed>,
    /// UV units per mesh unit, the same for every chart.
    pub scale: f64,
    /// Share of the unit square that triangles cover.
    pub utilization: f64,
    /// The distance that is kept between charts, in texels: what was asked for, or less where so
    /// many charts do not leave room for it.
    pub padding_texels: f64,
    /// Vertices that do not lie on the grid point next to their exact position, because a triangle
    /// would have lost its area there.
    pub moved_vertices: usize,
}

/// A chart that cannot be placed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AtlasError {
    /// A coordinate is not a finite number.
    #[error("chart {chart} has a coordinate that is not finite")]
    NonFinite {
        /// Its index.
        chart: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("chart {chart} has a triangle with a vertex that does not exist")]
    IndexOutOfRange {
        /// Its index.
        chart: usize,
    },
    /// No grid positions were found at which every triangle is positive.
    #[error("chart {chart} has triangles that cannot be represented on the grid")]
    NotRepresentable {
        /// Its index.
        chart: usize,
    },
}

/// Places every chart in the unit square, each triangle strictly positive on the grid.
pub fn pack(charts: &[ChartMap], options: &AtlasOptions) -> Result<Atlas, AtlasError> {
    for (chart, map) in charts.iter().enumerate() {
        check(chart, map)?;
    }
    let turned: Vec<Vec<[f64; 2]>> = charts
        .iter()
        .map(|map| orientation::turned(map.uv))
        .collect();
    let (offsets, scale) = shelves(&turned, options);
    let side = f64::from(1 << GRID_BITS);
    let mut placed = Vec::with_capacity(charts.len());
    let mut doubled_area = 0.0;
    for (chart, (map, uv)) in charts.iter().zip(&turned).enumerate() {
        let grid: Vec<[i32; 2]> = uv
            .iter()
            .map(|p| [0, 1].map(|k| ((p[k] + offsets[chart][k]) * scale * side).round() as i32))
            .collect();
        for triangle in map.triangles {
            let area = doubled(triangle.map(|v| grid[v as usize]));
            if area <= 0 {
                return Err(AtlasError::NotRepresentable { chart });
            }
            doubled_area += area as f64;
        }
        placed.push(Placed { grid });
    }
    Ok(Atlas {
        placed,
        scale,
        utilization: doubled_area / (2.0 * side * side),
        padding_texels: f64::from(options.padding_texels),
        moved_vertices: 0,
    })
}

fn check(chart: usize, map: &ChartMap) -> Result<(), AtlasError> {
    if map.uv.iter().flatten().any(|x| !x.is_finite()) {
        return Err(AtlasError::NonFinite { chart });
    }
    if map
        .triangles
        .iter()
        .flatten()
        .any(|&v| v as usize >= map.uv.len())
    {
        return Err(AtlasError::IndexOutOfRange { chart });
    }
    Ok(())
}

/// Twice the signed area of a grid triangle, exact.
fn doubled([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// Bounding boxes on shelves: offsets in mesh units and the scale that makes them fit.
fn shelves(charts: &[Vec<[f64; 2]>], options: &AtlasOptions) -> (Vec<[f64; 2]>, f64) {
    let boxes: Vec<[f64; 2]> = charts
        .iter()
        .map(|uv| [0, 1].map(|k| uv.iter().map(|p| p[k]).fold(0.0, f64::max)))
        .collect();
    let area: f64 = boxes.iter().map(|b| b[0] * b[1]).sum();
    let longest = boxes
        .iter()
        .flatten()
        .copied()
        .fold(f64::MIN_POSITIVE, f64::max);
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|&i, &j| boxes[j][1].total_cmp(&boxes[i][1]));
    let mut side = area.sqrt().max(longest);
    loop {
        let gap =
            side * f64::from(options.padding_texels + 1) / f64::from(options.resolution.max(1));
        let mut offsets = vec![[0.0; 2]; boxes.len()];
        let (mut x, mut y, mut shelf) = (0.0, 0.0, 0.0);
        for &i in &order {
            if x > 0.0 && x + boxes[i][0] > side {
                (x, y, shelf) = (0.0, y + shelf + gap, 0.0);
            }
            offsets[i] = [x, y];
            x += boxes[i][0] + gap;
            shelf = f64::max(shelf, boxes[i][1]);
        }
        if y + shelf <= side || side > 1e3 * longest.max(area.sqrt()) {
            return (offsets, 1.0 / side.max(y + shelf));
        }
        side *= 1.02;
    }
}

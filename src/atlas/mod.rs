//! Charts placed in the unit square, on an integer grid.
//!
//! Chart maps arrive in mesh units, all at one density. Each is turned to a good angle; all are
//! packed at one scale by a conservative raster, with a gap that is counted in texels; then every
//! vertex is rounded to a multiple of 2⁻²³, which `f32` holds exactly. Rounding may take the area of
//! a triangle that was positive in `f64`: such places are repaired, vertices moving no farther than
//! they must, and what leaves this module is positive in exact integer arithmetic.
//!
//! Rounding is done once per chart, before it is turned by quarters and shifted by whole grid units,
//! so its signs hold wherever the chart lies. A vertex that had to move farther than the gap allows
//! for makes the charts be laid out again with that much more room.
//!
//! Charts are never mirrored. None is scaled against the others, except those so small (below a
//! texel) that the grid has fewer than a handful of cells for each of their triangles.
mod layout;
mod mask;
mod orientation;
mod outline;
mod relax;
mod sheet;
mod snap;

use rayon::prelude::*;
use thiserror::Error;

use layout::{Layout, SLACK};
use orientation::Bounds;
use outline::Outline;
use sheet::Spot;
use snap::Snapped;

/// Atlas coordinates are integers in `0..=2^GRID_BITS`: the unit square in steps `f32` represents.
pub const GRID_BITS: u32 = 23;
/// The side of the unit square in grid units.
const GRID_SIDE: f64 = (1 << GRID_BITS) as f64;

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
    /// Smallest distance between two charts, in texels; half of it is kept to the border.
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
    /// UV units per mesh unit.
    pub scale: f64,
    /// Share of the unit square that triangles cover.
    pub utilization: f64,
    /// The distance that is kept between charts, in texels: what was asked for, or less where so
    /// many charts leave no room for it.
    pub padding_texels: f64,
    /// Charts too small for the grid that were enlarged.
    pub enlarged_charts: usize,
    /// Vertices that do not lie on the grid point next to their exact position, because a triangle
    /// would have lost its area there.
    pub moved_vertices: usize,
    /// The largest distance between a vertex and its exact position, in grid units.
    pub largest_move: f64,
}

/// Charts that cannot be placed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum AtlasError {
    /// A coordinate, or the area, is not a finite number.
    #[error("chart {chart} has coordinates that are not finite")]
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
    /// There are more charts than the finest raster can keep apart.
    #[error("{charts} charts are too many for one atlas")]
    TooManyCharts {
        /// Their number.
        charts: usize,
    },
}

/// Layouts tried until no vertex moves farther than its chart's room.
const ROUNDS: usize = 6;

/// Places every chart in the unit square, each triangle strictly positive on the grid, any two charts
/// at least the padding apart.
///
/// The charts must be strictly positive as given; one that has a flipped triangle is rounded without repair. The same input gives the same atlas for any number
/// of threads.
pub fn pack(charts: &[ChartMap], options: &AtlasOptions) -> Result<Atlas, AtlasError> {
    let outlines = outlines(charts)?;
    let mut slack = vec![SLACK; charts.len()];
    let mut cramped = 0;
    for _ in 0..ROUNDS {
        let layout =
            layout::layout(&outlines, &slack, options).ok_or(AtlasError::TooManyCharts {
                charts: charts.len(),
            })?;
        let snapped = snapped(charts, &outlines, &layout)?;
        let mut settled = true;
        for (chart, snapped) in snapped.iter().enumerate() {
            // Shifting and turning round to whole grid units once more.
            let needed = (snapped.largest_move + 2.0) / layout.cell;
            if needed > slack[chart] {
                slack[chart] = 1.5 * needed;
                (cramped, settled) = (chart, false);
            }
        }
        if settled {
            return Ok(atlas(charts, &layout, &slack, snapped));
        }
    }
    Err(AtlasError::NotRepresentable { chart: cramped })
}

/// Checks the charts and turns each to its angle.
fn outlines<'a>(charts: &[ChartMap<'a>]) -> Result<Vec<Outline<'a>>, AtlasError> {
    let areas: Vec<f64> = charts
        .par_iter()
        .map(check)
        .collect::<Vec<_>>()
        .into_iter()
        .enumerate()
        .map(|(chart, checked)| checked.map_err(|fault| fault(chart)))
        .collect::<Result<_, _>>()?;
    let total: f64 = areas.iter().sum();
    let turned = charts.par_iter().zip(&areas).map(|(map, &area)| {
        // A chart that is most of the atlas decides its side; others fit better as rectangles.
        let bounds = if 2.0 * area > total {
            Bounds::Square
        } else {
            Bounds::Rectangle
        };
        Outline::new(map, bounds, area)
    });
    Ok(turned.collect())
}

/// The area of a chart, or what is wrong with it.
fn check(map: &ChartMap) -> Result<f64, fn(usize) -> AtlasError> {
    if map.uv.iter().flatten().any(|x| !x.is_finite()) {
        return Err(|chart| AtlasError::NonFinite { chart });
    }
    if map
        .triangles
        .iter()
        .flatten()
        .any(|&v| v as usize >= map.uv.len())
    {
        return Err(|chart| AtlasError::IndexOutOfRange { chart });
    }
    let area = outline::area(map);
    if !area.is_finite() {
        return Err(|chart| AtlasError::NonFinite { chart });
    }
    if area <= 0.0 && !map.triangles.is_empty() {
        return Err(|chart| AtlasError::NotRepresentable { chart });
    }
    Ok(area)
}

/// Every chart on its own grid.
fn snapped(
    charts: &[ChartMap],
    outlines: &[Outline],
    layout: &Layout,
) -> Result<Vec<Snapped>, AtlasError> {
    let snapped: Vec<Option<Snapped>> = charts
        .par_iter()
        .zip(outlines)
        .zip(&layout.charts)
        .map(|((map, outline), &(_, stretch))| snap::snapped(map, outline, layout.scale * stretch))
        .collect();
    let named = snapped.into_iter().enumerate();
    named
        .map(|(chart, snapped)| snapped.ok_or(AtlasError::NotRepresentable { chart }))
        .collect()
}

/// Turns and shifts every chart to its place.
fn atlas(charts: &[ChartMap], layout: &Layout, slack: &[f64], snapped: Vec<Snapped>) -> Atlas {
    let moved_vertices = snapped.iter().map(|s| s.moved).sum();
    let largest_move = snapped.iter().map(|s| s.largest_move).fold(0.0, f64::max);
    let spots = layout.charts.iter().zip(slack);
    let placed: Vec<Placed> = charts
        .iter()
        .zip(snapped.into_iter().zip(spots))
        .map(|(map, (snapped, (&(spot, _), &slack)))| Placed {
            grid: if map.triangles.is_empty() {
                vec![[0; 2]; map.uv.len()]
            } else {
                moved(snapped.grid, spot, layout, slack - SLACK)
            },
        })
        .collect();
    let doubled = |(map, placed): (&ChartMap, &Placed)| {
        let of = |t: &[u32; 3]| doubled_area(t.map(|v| placed.grid[v as usize])) as f64;
        map.triangles.iter().map(of).sum::<f64>()
    };
    let covered: f64 = charts.iter().zip(&placed).map(doubled).sum();
    Atlas {
        placed,
        scale: layout.scale / GRID_SIDE,
        utilization: covered / (2.0 * GRID_SIDE * GRID_SIDE),
        padding_texels: layout.padding_texels,
        enlarged_charts: layout
            .charts
            .iter()
            .filter(|(_, stretch)| *stretch > 1.0)
            .count(),
        moved_vertices,
        largest_move,
    }
}

/// A chart turned by quarters and shifted to its spot; `around` cells of its mask surround it.
fn moved(mut grid: Vec<[i32; 2]>, spot: Spot, layout: &Layout, around: f64) -> Vec<[i32; 2]> {
    let near =
        |corner: u32| ((layout.border + f64::from(corner) + around) * layout.cell).round() as i32;
    let far = |corner: u32, size: u32| {
        ((layout.border + f64::from(corner + size) - around) * layout.cell).round() as i32
    };
    let Spot {
        x,
        y,
        turns,
        width,
        height,
    } = spot;
    for p in &mut grid {
        let [i, j] = *p;
        *p = match turns {
            0 => [near(x) + i, near(y) + j],
            1 => [far(x, height) - j, near(y) + i],
            2 => [far(x, width) - i, far(y, height) - j],
            _ => [near(x) + j, far(y, width) - i],
        };
    }
    grid
}

/// Twice the signed area of a grid triangle, exact.
fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i64 {
    let [ax, ay] = a.map(i64::from);
    let [bx, by] = b.map(i64::from);
    let [cx, cy] = c.map(i64::from);
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

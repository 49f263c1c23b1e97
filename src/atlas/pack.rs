//! From chart maps to their places on the grid.
use rayon::prelude::*;

use super::layout::{self, Layout, SLACK};
use super::orientation::Bounds;
use super::outline::{self, Outline};
use super::sheet::Spot;
use super::snap::{self, Snapped};
use super::{Atlas, AtlasError, AtlasOptions, ChartMap, GRID_SIDE, Placed, Turns, doubled_area};

/// Layouts tried until no vertex moves farther than its chart's room.
const ROUNDS: usize = 6;

/// Places every chart in the unit square, each triangle strictly positive on the grid, any two charts
/// at least the padding apart.
///
/// The charts must be strictly positive as given; one that has a flipped triangle is rounded without repair. The same
/// input gives the same atlas for any number of threads.
pub fn pack(charts: &[ChartMap], options: &AtlasOptions) -> Result<Atlas, AtlasError> {
    let outlines = outlines(charts, options.turns)?;
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
fn outlines<'a>(charts: &[ChartMap<'a>], turns: Turns) -> Result<Vec<Outline<'a>>, AtlasError> {
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
        let bounds = if turns == Turns::Quarters {
            Bounds::Given
        } else if 2.0 * area > total {
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

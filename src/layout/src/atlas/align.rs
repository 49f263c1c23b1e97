//! Charts whose bounding rectangles end where texels end.

use super::{ChartMap, doubled_area};

/// Texels by which two charts may come nearer: each point moves by at most one to each side and up or down.
pub(super) const ROOM_TEXELS: u32 = 3;

/// A chart widened to the next borders of texels of so many steps on all sides. One of which a triangle would lose its area to
/// rounding is only shifted, so that it ends at texels on two sides.
pub(super) fn aligned(map: &ChartMap, grid: Vec<[i32; 2]>, texel: i32) -> Vec<[i32; 2]> {
    if map.triangles.is_empty() {
        return grid;
    }
    let axes = [0, 1].map(|axis| Axis::new(&grid, axis, texel));
    let widened: Vec<[i32; 2]> = moved(&grid, |axis, x| axes[axis].widened(x));
    if is_positive(map, &widened) || !is_positive(map, &grid) {
        widened
    } else {
        moved(&grid, |axis, x| axes[axis].shifted(x))
    }
}

fn moved(grid: &[[i32; 2]], to: impl Fn(usize, i32) -> i32) -> Vec<[i32; 2]> {
    grid.iter().map(|[x, y]| [to(0, *x), to(1, *y)]).collect()
}

fn is_positive(map: &ChartMap, grid: &[[i32; 2]]) -> bool {
    let area = |t: &[u32; 3]| doubled_area(t.map(|v| grid[v as usize]));
    map.triangles.iter().all(|t| area(t) > 0)
}

/// The extent of a chart along an axis, and that of the texels that it touches.
struct Axis {
    low: i32,
    length: i64,
    texels_low: i32,
    texels_length: i64,
}

impl Axis {
    fn new(grid: &[[i32; 2]], axis: usize, texel: i32) -> Self {
        let of = || grid.iter().map(|point| point[axis]);
        let (low, high) = (of().min().unwrap_or(0), of().max().unwrap_or(0));
        let texels_low = low.div_euclid(texel) * texel;
        let texels_high = -(-high).div_euclid(texel) * texel;
        Self {
            low,
            length: i64::from(high - low),
            texels_low,
            texels_length: i64::from(texels_high - texels_low),
        }
    }

    fn widened(&self, x: i32) -> i32 {
        let along = i64::from(x - self.low) * self.texels_length;
        self.texels_low + ((2 * along + self.length) / (2 * self.length.max(1))) as i32
    }

    fn shifted(&self, x: i32) -> i32 {
        x - self.low + self.texels_low
    }
}

//! Charts that survive rounding to few bits.

use rayon::prelude::*;

use unwrapd_layout::atlas::{ChartMap, cleared};
use unwrapd_layout::charts::MappedChart;

/// Returns the distance by which tools that round to `bits` may move a coordinate of the unit square: half of their
/// step, plus the error of storing the result in 16 bits.
fn rounding(bits: u32) -> f64 {
    0.5 / (f64::from(bits).exp2() - 1.0) + f64::from(-16).exp2()
}

/// Returns the distance in UV at which two places stay apart although each coordinate of both moves that far.
fn clearance(bits: u32) -> f64 {
    2.0 * std::f64::consts::SQRT_2 * rounding(bits)
}

/// Returns the least padding at which charts stay apart, in texels at `resolution`.
pub fn texels_apart(bits: u32, resolution: u32) -> u32 {
    (clearance(bits) * f64::from(resolution)).ceil() as u32
}

/// Opens thin places of every chart for an atlas of `scale` UV units per mesh unit. Returns whether there were any.
pub fn open_charts(charts: &mut [MappedChart], scale: f64, bits: u32) -> bool {
    let opened: Vec<bool> = charts
        .par_iter_mut()
        .map(|mapped| {
            let map = ChartMap {
                uv: &mapped.embedding.uv,
                triangles: &mapped.chart.disk.triangles,
            };
            let opened = cleared(&map, clearance(bits) / scale);
            let is_opened = opened.is_some();
            mapped.embedding.uv =
                opened.unwrap_or_else(|| std::mem::take(&mut mapped.embedding.uv));
            is_opened
        })
        .collect();
    opened.contains(&true)
}

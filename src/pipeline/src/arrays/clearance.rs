//! Charts that survive rounding to few bits.

use rayon::prelude::*;

use unwrapd_layout::atlas::{ChartMap, cleared};
use unwrapd_layout::charts::MappedChart;

/// How far tools that round to `bits` may move a coordinate of the unit square: half a step of
/// theirs, and what storing the result in 16 bits may add.
fn rounding(bits: u32) -> f64 {
    0.5 / (f64::from(bits).exp2() - 1.0) + f64::from(-16).exp2()
}

/// What keeps two places apart when each coordinate of both moves that far, in UV.
fn clearance(bits: u32) -> f64 {
    2.0 * std::f64::consts::SQRT_2 * rounding(bits)
}

/// The least padding, in texels at a resolution, at which charts stay apart.
pub fn texels_apart(bits: u32, resolution: u32) -> u32 {
    (clearance(bits) * f64::from(resolution)).ceil() as u32
}

/// Opens what is too thin in every chart for an atlas of `scale` UV units per mesh unit; whether there was anything.
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

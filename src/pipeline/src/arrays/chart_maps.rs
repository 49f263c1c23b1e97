//! Charts as the packer sees them.

use unwrapd_layout::atlas::ChartMap;
use unwrapd_layout::charts::MappedChart;

/// Charts as the packer sees them.
pub fn chart_maps<'a>(charts: impl IntoIterator<Item = &'a MappedChart>) -> Vec<ChartMap<'a>> {
    let maps = charts.into_iter().map(|mapped| ChartMap {
        uv: &mapped.embedding.uv,
        triangles: &mapped.chart.disk.triangles,
    });
    maps.collect()
}

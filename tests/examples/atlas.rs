//! A surface cut into charts, mapped and packed.
//!
//! `cargo run --release --example atlas`

use unwrapd_layout::atlas::{AtlasOptions, ChartMap, pack};
use unwrapd_layout::charts::{Cut, Folds, MappedChart, Unobserved, charts, map_chart};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::Surface;

fn main() {
    // The surface of a cube: 8 corners, 12 triangles.
    let positions: Vec<[f64; 3]> = (0..8_u32)
        .map(|corner| [0, 1, 2].map(|axis| f64::from(corner >> axis & 1)))
        .collect();
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles: Vec<[u32; 3]> = (faces.iter())
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let surface = Surface::new(&positions, &triangles).expect("a mesh");

    // Cut, then map each chart; one that overlaps itself is cut again.
    let options = Options::default();
    let mapped: Vec<MappedChart> = charts(&surface, Cut::Auto)
        .into_iter()
        .flat_map(|chart| map_chart(chart, &options, Folds::Cut, &Unobserved))
        .collect();

    // Pack.
    let maps: Vec<ChartMap> = (mapped.iter())
        .map(|mapped| ChartMap {
            uv: &mapped.embedding.uv,
            triangles: &mapped.chart.disk.triangles,
        })
        .collect();
    let atlas = pack(&maps, &AtlasOptions::default()).expect("charts that fit");
    println!(
        "{} charts fill {:.0} % of the page",
        maps.len(),
        100.0 * atlas.utilization
    );
}

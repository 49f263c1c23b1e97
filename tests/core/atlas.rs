//! Packing: positive on the grid, inside the square, apart.
use unwrapd::atlas::{AtlasOptions, ChartMap, GRID_BITS, pack};

#[test]
fn one_triangle_fills_half_of_its_rectangle() {
    let chart = ChartMap {
        uv: &[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]],
        triangles: &[[0, 1, 2]],
    };
    let atlas = pack(&[chart], &AtlasOptions::default()).unwrap();
    assert!(
        (atlas.utilization - 0.5).abs() < 0.01,
        "{}",
        atlas.utilization
    );
    assert!(
        atlas.placed[0]
            .grid
            .iter()
            .flatten()
            .all(|&x| (0..=1 << GRID_BITS).contains(&x))
    );
}

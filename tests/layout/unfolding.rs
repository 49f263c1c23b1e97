//! Maps of charts that cover places of the plane more than once, and what they are cut into.

use std::collections::BTreeMap;

use unwrapd_layout::charts::{Chart, MappedChart};
use unwrapd_maps::certificate::certify_planar;
use unwrapd_maps::mesh::Disk;
use unwrapd_method::solver::Control;

/// A chart of the triangles with these corners; corners of one key are one vertex, at that place.
fn chart<K: Ord + Copy>(triangles: &[[K; 3]], place: impl Fn(K) -> [f64; 2]) -> MappedChart {
    let mut number: BTreeMap<K, u32> = BTreeMap::new();
    let mut uv = Vec::new();
    let mut vertex = |key: K| {
        *number.entry(key).or_insert_with(|| {
            uv.push(place(key));
            uv.len() as u32 - 1
        })
    };
    let triangles: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(&mut vertex)).collect();
    let corners = (0..triangles.len() as u32).map(|t| [0, 1, 2].map(|c| 3 * t + c));
    let chart = Chart {
        mirror: None,
        positions: uv.iter().map(|&[x, y]| [x, y, 0.0]).collect(),
        corners: corners.collect(),
        disk: Disk::new(uv.len(), triangles).expect("a disk with holes"),
    };
    MappedChart::given(chart, uv)
}

/// The two triangles of each cell of the plane from `-reach` to `reach`.
fn cells(reach: i32) -> impl Iterator<Item = [[i32; 2]; 3]> {
    let side = move || -reach..reach;
    side().flat_map(move |y| {
        side().flat_map(move |x| {
            let [a, b, c, d] = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
            [[a, b, c], [a, c, d]]
        })
    })
}

/// What a chart is cut into, each part found to be bijective by the judge and all triangles there.
fn checked(whole: &MappedChart) -> Vec<MappedChart> {
    let image = whole.embedding.uv.clone();
    let parts = whole.clone().unfolded(&image, &|| Control::Continue);
    for part in &parts {
        let judged = certify_planar(&part.embedding.uv, &part.chart.disk.triangles);
        assert!(judged.is_bijective(), "{judged:?}");
    }
    let n_faces: usize = parts.iter().map(|part| part.chart.corners.len()).sum();
    assert_eq!(n_faces, whole.chart.corners.len());
    parts
}

#[test]
fn a_map_with_two_branch_points_is_cut() {
    // Two sheets, one larger, that pass into each other over a slit from (-1, 0) to (1, 0): an
    // annulus whose loops are simple, apart and both counter-clockwise.
    let sheet = |sheet: i32| {
        cells(3 + 2 * sheet).map(move |corners| {
            let is_above = corners.iter().map(|corner| corner[1]).sum::<i32>() > 0;
            corners.map(|[x, y]| match (x, y) {
                (-1 | 1, 0) => (x, y, 0),
                (0, 0) if is_above => (x, y, 1 - sheet),
                _ => (x, y, sheet),
            })
        })
    };
    let triangles: Vec<_> = sheet(0).chain(sheet(1)).collect();
    let whole = chart(&triangles, |(x, y, _)| [x, y].map(f64::from));
    assert_eq!(whole.chart.disk.loops.len(), 2);
    let (uv, triangles) = (&whole.embedding.uv, &whole.chart.disk.triangles);
    let judged = certify_planar(uv, triangles);
    assert!(judged.is_valid() && judged.overlapping_pairs > 0);
    assert_eq!(checked(&whole).len(), 2);
}

/// A strip of two cells around a center, 24 cells to the turn.
fn ramp(n_cells: i32) -> MappedChart {
    let triangles: Vec<_> = (0..n_cells)
        .flat_map(|i| (0..2).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    chart(&triangles, |(i, j)| {
        let (sin, cos) = (f64::from(i % 24) * std::f64::consts::TAU / 24.0).sin_cos();
        [cos, sin].map(|x| (2.0 + f64::from(j)) * x)
    })
}

#[test]
fn a_ramp_is_cut_once_a_turn() {
    for (n_cells, n_parts) in [(20, 1), (24, 1), (25, 2), (40, 2), (60, 3), (96, 4)] {
        let parts = checked(&ramp(n_cells));
        assert_eq!(parts.len(), n_parts, "{n_cells} cells");
    }
}

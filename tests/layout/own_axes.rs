//! A map is cut in the same places however it lies in the plane.

use unwrapd_layout::charts::{Chart, MappedChart};
use unwrapd_maps::mesh::Disk;
use unwrapd_method::solver::Control;

use crate::layouts::disk;

/// A hill whose outline is wavy, most at one side; as a map it is seen from above, turned and moved.
fn hill(angle: f64, by: [f64; 2]) -> MappedChart {
    let (plan, triangles) = disk(12, 60, |ring, angle| {
        ring as f64 * (1.0 + 0.3 * (3.0 * angle).cos() + 0.2 * (angle - 0.5).sin())
    });
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cos * x - sin * y + by[0], sin * x + cos * y + by[1]];
    let chart = Chart {
        positions: (plan.iter())
            .map(|&[x, y]| [x, y, -0.02 * (x * x + y * y)])
            .collect(),
        corners: (0..triangles.len() as u32)
            .map(|t| [0, 1, 2].map(|c| 3 * t + c))
            .collect(),
        disk: Disk::new(plan.len(), triangles).expect("a disk"),
        mirror: None,
    };
    MappedChart::given(chart, plan.into_iter().map(turned).collect())
}

/// The faces of each part that the best cut leaves, by their first corners.
fn parts(chart: &MappedChart) -> Vec<Vec<u32>> {
    let unit = chart.area().sqrt();
    let split = chart.best_split(unit, &|| Control::Continue);
    let parts = chart.parted(&split.expect("two parts"));
    let faces = |part: &MappedChart| {
        let mut faces: Vec<u32> = part.chart.corners.iter().map(|c| c[0]).collect();
        faces.sort_unstable();
        faces
    };
    let mut parts: Vec<Vec<u32>> = parts.iter().map(faces).collect();
    parts.sort();
    parts
}

#[test]
fn a_map_that_is_turned_is_cut_in_the_same_places() {
    let cut = parts(&hill(0.0, [0.0; 2]));
    assert_eq!(cut.len(), 2);
    for (angle, by) in [
        (0.04, [0.0; 2]),
        (0.1, [0.3, 7.0]),
        (1.0, [-40.0, 2.0]),
        (2.5, [1e3; 2]),
    ] {
        assert!(parts(&hill(angle, by)) == cut, "{angle}");
    }
}

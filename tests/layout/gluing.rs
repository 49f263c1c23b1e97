//! Charts glued to their neighbors.

use crate::zoo::{self, Mesh};
use unwrapd_layout::charts::{
    Bound, Bounded, Chart, Cut, Folds, MappedChart, Unobserved, charts, map_chart,
};
use unwrapd_layout::search::{CutProblem, Terms, from_charts};
use unwrapd_maps::certificate::{Claims, certify};
use unwrapd_maps::embed::Options;
use unwrapd_maps::mesh::Surface;

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

/// The charts of a surface cut where faces differ in what `region` says of the middle.
fn regions(surface: &Surface, region: impl Fn([f64; 3]) -> usize) -> Vec<Chart> {
    let of_face: Vec<usize> = (0..surface.triangles.len())
        .map(|t| {
            let corners = surface.corners(t);
            region([0, 1, 2].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / 3.0))
        })
        .collect();
    let mut cut = surface.clone();
    cut.cut_along(|h, t| of_face[h as usize / 3] != of_face[t as usize / 3]);
    charts(&cut, Cut::Seams)
}

fn mapped(chart: Chart) -> MappedChart {
    let parts = map_chart(chart, &options(), Folds::Cut, &Unobserved);
    <[MappedChart; 1]>::try_from(parts).expect("a chart that does not fold")[0].clone()
}

fn options() -> Options {
    Options {
        density: std::sync::Arc::new(unwrapd_method::energy::SymmetricDirichlet),
        ..Options::default()
    }
}

fn balanced() -> Bound {
    Bound {
        mean: 4.1,
        stretch: None,
        of: Bounded::Surface,
    }
}

/// Glues charts of a surface; each triangle must be there once and no chart overlap itself.
fn checked(surface: &Surface, maps: Vec<MappedChart>, bound: &Bound) -> Vec<MappedChart> {
    let problem = CutProblem::new(surface, bound, &Unobserved);
    let terms = Terms::default();
    let (glued, _) = from_charts(&problem, maps, &terms, &options(), &Unobserved);
    let mut uvs = vec![None; surface.triangles.len()];
    for (number, map) in glued.iter().enumerate() {
        for (triangle, corners) in map.chart.disk.triangles.iter().zip(&map.chart.corners) {
            let of_face = uvs[corners[0] as usize / 3].get_or_insert([[0.0; 2]; 3]);
            for (&v, &corner) in triangle.iter().zip(corners) {
                // Charts side by side, so that one certificate judges all of them.
                let [x, y] = map.embedding.uv[v as usize];
                of_face[corner as usize % 3] = [x + 1e3 * number as f64, y];
            }
        }
    }
    let uvs: Vec<_> = uvs.into_iter().map(|uv| uv.expect("in a chart")).collect();
    let certificate = certify(
        &surface.positions,
        &surface.triangles,
        &uvs,
        &Claims::default(),
    );
    assert!(certificate.is_bijective());
    assert_eq!(certificate.charts, glued.len());
    glued
}

/// A flat square of 24 by 24 cells.
fn flat() -> Mesh {
    let mut mesh = zoo::grid(24, 24);
    for p in &mut mesh.positions {
        p[2] = 0.0;
    }
    mesh
}

#[test]
fn parts_of_a_plane_become_one_chart() {
    let surface = surface(&flat());
    // A corner, and a plate in the middle whose whole border is shared.
    let charts = regions(&surface, |[x, y, _]| match (x, y) {
        (..4.0, ..4.0) => 1,
        (8.0..16.0, 8.0..16.0) => 2,
        _ => 0,
    });
    assert_eq!(charts.len(), 3);
    let glued = checked(
        &surface,
        charts.into_iter().map(mapped).collect(),
        &balanced(),
    );
    assert_eq!(glued.len(), 1);
    assert_eq!(glued[0].chart.disk.loops.len(), 1, "nothing is left open");
    assert!((glued[0].area() - 576.0).abs() < 1e-3);
}

#[test]
fn a_chart_seen_from_behind_is_turned_over() {
    let surface = surface(&flat());
    let charts = regions(&surface, |[x, ..]| usize::from(x < 4.0));
    let mut maps: Vec<MappedChart> = charts.into_iter().map(mapped).collect();
    assert!(maps[0].chart.corners.len() < maps[1].chart.corners.len());
    maps[0].chart.turn_over();
    for p in &mut maps[0].embedding.uv {
        p[0] = -p[0];
    }
    let glued = checked(&surface, maps, &balanced());
    assert_eq!(glued.len(), 1);
    let chart = &glued[0].chart;
    assert!((0..chart.corners.len()).all(|t| chart.is_wound_as_surface(t)));
}

#[test]
fn a_chart_that_lies_turned_is_turned_back() {
    let surface = surface(&flat());
    let charts = regions(&surface, |[x, ..]| usize::from(x < 4.0));
    for angle in [1.0_f64, -2.0, 3.0] {
        let mut maps: Vec<MappedChart> = charts.iter().cloned().map(mapped).collect();
        let (sin, cos) = angle.sin_cos();
        for p in &mut maps[0].embedding.uv {
            *p = [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
        }
        assert_eq!(checked(&surface, maps, &balanced()).len(), 1, "{angle}");
    }
}

#[test]
fn what_would_be_flipped_beside_its_neighbor_is_not_glued_so() {
    let surface = surface(&flat());
    let charts = regions(&surface, |[x, ..]| usize::from(x < 4.0));
    // Each second row of one chart is shifted, so far that its inner vertices lie beyond the border
    // once that is straight again.
    let lies = |chart: Chart| {
        let shift = if chart.corners.len() < 300 { 3.0 } else { 0.0 };
        let place = |p: &[f64; 3]| [p[0] + shift * (p[1] % 2.0), p[1]];
        let uv = chart.positions.iter().map(place).collect();
        MappedChart::given(chart, uv)
    };
    let anything = Bound {
        mean: 1e9,
        ..balanced()
    };
    checked(&surface, charts.into_iter().map(lies).collect(), &anything);
}

/// A square of 24 by 24 cells whose middle third is a box that stands on the plane.
fn box_on_a_plane() -> Mesh {
    let mut mesh = flat();
    for p in &mut mesh.positions {
        // Columns and rows of the walls are drawn together, so that the walls stand upright.
        let [x, y, _] = *p;
        let inside = |c: f32| (8.0..=16.0).contains(&c);
        if inside(x) && inside(y) {
            let depth = (x - 8.0).min(16.0 - x).min(y - 8.0).min(16.0 - y);
            p[2] = 8.0 * depth.min(1.0);
        }
    }
    mesh
}

#[test]
fn what_would_cover_its_neighbor_stays_apart() {
    let surface = surface(&box_on_a_plane());
    let is_box = |[x, y, _]: [f64; 3]| (8.0..16.0).contains(&x) && (8.0..16.0).contains(&y);
    let charts = regions(&surface, |p| usize::from(is_box(p)));
    let maps: Vec<MappedChart> = charts
        .into_iter()
        .map(|chart| {
            let uv = chart.positions.iter().map(|p| [p[0], p[1]]).collect();
            MappedChart::given(chart, uv)
        })
        .map(|map| {
            if map.chart.corners.len() < 300 {
                mapped(map.chart)
            } else {
                map
            }
        })
        .collect();
    assert_eq!(maps.len(), 2);
    // The walls are eight times as high as their rim is wide: wherever the box is laid it lies on the plane.
    assert_eq!(checked(&surface, maps, &balanced()).len(), 2);
}

/// Both halves of a hilly square become one chart where the bound leaves room for that.
#[test]
fn the_bound_decides_what_is_glued() {
    let surface = surface(&zoo::grid(24, 24));
    let glued = |bound: &Bound| {
        let charts = regions(&surface, |[x, ..]| usize::from(x < 12.0));
        checked(&surface, charts.into_iter().map(mapped).collect(), bound).len()
    };
    let bound = |mean, stretch| Bound {
        mean,
        stretch,
        ..balanced()
    };
    assert_eq!(glued(&bound(4.1, None)), 1);
    assert_eq!(glued(&bound(4.000_01, None)), 2);
    assert_eq!(glued(&bound(4.1, Some(1.001))), 2);
}

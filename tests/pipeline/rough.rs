//! Rough surfaces: cut as what they are samples of.

use std::sync::Arc;

use crate::zoo::{self, Mesh};
use std::fmt::Write as _;
use unwrapd_files::document::Upload;
use unwrapd_layout::charts::{Bound, Bounded, Symmetry, Unobserved, smoothed_where_rough};
use unwrapd_layout::search::{CutProblem, Terms, from_surface};
use unwrapd_maps::embed::{self, Options};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::energy::SymmetricDirichlet;
use unwrapd_method::numerics::random::Random;
use unwrapd_pipeline::{
    self as pipeline, Options as DocumentOptions, Settings, unwrap, unwrap_document,
};

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

/// A sheet whose vertices are off by up to so many edges.
fn noisy_sheet(noise: f32) -> Mesh {
    let mut mesh = zoo::grid(24, 24);
    let edge = mesh.positions[1][0] - mesh.positions[0][0];
    let mut random = Random::new(1);
    for p in &mut mesh.positions {
        p[2] += noise * edge.abs() * (2.0 * random.unit() - 1.0) as f32;
    }
    mesh
}

#[test]
fn only_noise_is_smoothed() {
    let rough = surface(&noisy_sheet(2.0));
    let smooth = smoothed_where_rough(&rough).expect("a rough surface");
    let height = |s: &Surface| s.positions.iter().map(|p| p[2].powi(2)).sum::<f64>().sqrt();
    assert!(height(&smooth) < 0.5 * height(&rough));
    for mesh in [
        zoo::grid(24, 24),
        zoo::voxels(&[[0; 3]]),
        // Smoothing flattens it, but its curvature does not cancel.
        zoo::cone(32),
        zoo::sphere(20, 30),
        noisy_sheet(0.05),
    ] {
        assert!(smoothed_where_rough(&surface(&mesh)).is_none());
    }
}

#[test]
fn a_component_that_is_not_rough_stays_as_it_is() {
    let rough = noisy_sheet(2.0);
    let n_rough = rough.positions.len();
    let mesh = rough.with(&zoo::sphere(20, 30).moved([0.0, 0.0, 99.0]));
    let both = surface(&mesh);
    let smooth = smoothed_where_rough(&both).expect("a rough component");
    let is_kept = |v: usize| smooth.positions[v] == both.positions[v];
    assert!((n_rough..both.positions.len()).all(is_kept));
    assert!(!(0..n_rough).all(is_kept));
}

#[test]
fn a_rough_sheet_stays_whole_unless_its_own_distortion_is_bounded() {
    let surface = surface(&noisy_sheet(2.0));
    let charts = |of| {
        let bound = Bound {
            mean: 4.1,
            stretch: None,
            of,
        };
        let options = Options {
            density: Arc::new(SymmetricDirichlet),
            ..Options::default()
        };
        let problem = CutProblem::new(&surface, &bound, &Unobserved);
        let terms = Terms::default();
        from_surface(&problem, &terms, &options, Symmetry::Auto, &Unobserved).0
    };
    let [whole, cut] = [Bounded::Smoothed, Bounded::Surface].map(charts);
    assert_eq!(whole.len(), 1);
    assert!(cut.len() > 3, "{}", cut.len());
    for map in whole.iter().chain(&cut) {
        assert!(embed::is_positive(
            &map.chart.disk.triangles,
            &map.embedding.uv
        ));
        for (triangle, corners) in map.chart.disk.triangles.iter().zip(&map.chart.corners) {
            for (&v, &corner) in triangle.iter().zip(corners) {
                let own = surface.corners(corner as usize / 3)[corner as usize % 3];
                assert_eq!(map.chart.positions[v as usize], own);
            }
        }
    }
}

#[test]
fn a_bound_that_is_given_is_one_on_the_surface() {
    let mesh = noisy_sheet(2.0);
    let charts = |max_distortion| {
        let mut settings = Settings::default();
        settings.cutting.max_distortion = max_distortion;
        let (positions, triangles) = (&mesh.positions, &mesh.triangles);
        let atlas = unwrap(positions, triangles, &settings, &pipeline::Unobserved);
        atlas.expect("an atlas").charts.len()
    };
    let [own, default] = [Some(4.1), None].map(charts);
    assert!(own > 2 * default, "{own} of {default}");
}

#[test]
fn the_report_says_which_surface_keeps_the_bound() {
    let mesh = noisy_sheet(0.95);
    let mut text = String::new();
    for [x, y, z] in &mesh.positions {
        writeln!(text, "v {x} {y} {z}").expect("a string takes it");
    }
    for [a, b, c] in mesh.triangles.iter().map(|t| t.map(|v| v + 1)) {
        writeln!(text, "f {a} {b} {c}").expect("a string takes it");
    }
    let upload = Upload::single("sheet.obj", text.into_bytes());
    let report = |max_distortion| {
        let mut options = DocumentOptions::default();
        options.cutting.max_distortion = max_distortion;
        let outcome = unwrap_document(&upload, &options, &pipeline::Unobserved);
        let report = outcome.expect("a result").report;
        let atlas = report.groups[0].atlas.as_ref().expect("an atlas");
        let is_warned = report.warnings.iter().any(|w| w.code == "rough_surface");
        (atlas.bound.expect("a bound"), is_warned)
    };
    let (bound, is_warned) = report(None);
    let smoothed = bound.smoothed_distortion.expect("a rough surface");
    let own = bound.distortion.expect("a distortion");
    assert!(smoothed < 4.1 && 4.1 < own, "{smoothed}, {own}");
    assert_eq!(
        (bound.of, bound.kept, is_warned),
        (Bounded::Smoothed, true, true)
    );
    let (bound, is_warned) = report(Some(4.1));
    assert_eq!(bound.smoothed_distortion, None);
    assert_eq!((bound.of, is_warned), (Bounded::Surface, false));
}

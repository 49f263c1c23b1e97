//! Figures with known values, and all of them against an independent script.

use crate::places;
use crate::uv_meshes::{UvMesh, moebius_in_one_piece, read_obj};
use unwrapd_maps::certificate::Overlap;
use unwrapd_maps::measure::{MeasureOptions, face_distortion};
use unwrapd_maps::mesh::VAxis;

#[track_caller]
fn near(value: impl Into<Option<f64>>, expected: f64) {
    let value = value.into().expect("a figure");
    assert!(
        (value - expected).abs() <= 1e-9 * expected.abs().max(1.0),
        "{value} is not {expected}"
    );
}

#[test]
fn the_identity_is_ideal() {
    let m = UvMesh::grid(8).measure();
    assert_eq!(
        (m.size.faces, m.size.vertices, m.size.vertices_welded),
        (128, 81, 81)
    );
    near(m.size.area_3d, 1.0);
    near(m.size.area_uv, 1.0);
    near(m.size.bbox_diag, 2.0_f64.sqrt());
    assert_eq!((m.size.uv_min, m.size.uv_max), ([0.0; 2], [1.0; 2]));
    assert!(m.size.uv_in_unit_square);
    near(m.seams.boundary_length, 4.0);
    assert_eq!((m.seams.seam_edges, m.seams.charts), (0, 1));
    let d = &m.distortion;
    for ideal in [
        d.l2_stretch,
        d.linf_stretch,
        d.conformal_max,
        d.area_dist_max,
        d.conformal_p99,
    ] {
        near(ideal, 1.0);
    }
    near(d.sym_dirichlet_mean, 4.0);
    near(d.sym_dirichlet_median, 4.0);
    near(d.arap_mean, 0.0);
    near(m.density.density_p95_over_p5, 1.0);
    near(m.density.density_cv, 0.0);
    assert!(m.locally_injective);
    assert_eq!(m.bijective, Some(true));
    assert_eq!(m.gaps.gap_uv, None);
}

#[test]
fn a_needle_is_counted_apart() {
    let plain = UvMesh::grid(16).measure().distortion;
    // As long as the grid and 1e-6 of that high, but a wedge in UV.
    let needle = || {
        let mut needle = UvMesh::planar(&[[2.0, 0.0], [3.0, 0.0], [2.5, 1e-6]], &[[0, 1, 2]]);
        needle.uvs[0][2][1] = 0.1;
        needle
    };
    let mut mesh = UvMesh::grid(16);
    for _ in 0..100 {
        mesh.add(&needle());
    }
    let measured = mesh.measure().distortion;
    assert_eq!(measured.needles, 100);
    near(measured.needles_area_frac, 5e-5 / 1.00005);
    for (of, plain) in [
        (measured.sym_dirichlet_mean, plain.sym_dirichlet_mean),
        (measured.stretch_p99, plain.stretch_p99),
        (measured.sym_dirichlet_max, plain.sym_dirichlet_max),
    ] {
        near(of, plain.expect("a figure"));
    }
    // So many that they are more than a thousandth of the surface count.
    let mut mesh = UvMesh::grid(16);
    for _ in 0..3000 {
        mesh.add(&needle());
    }
    let measured = mesh.measure().distortion;
    assert!(measured.needles_area_frac > 1e-3);
    assert!(measured.sym_dirichlet_mean > Some(100.0), "{measured:?}");
}

#[test]
fn every_texel_center_is_covered_once() {
    for n in [1, 3, 7, 64] {
        let packing = UvMesh::grid(n)
            .measure_with(VAxis::Up, MeasureOptions::default())
            .packing;
        assert_eq!(packing.covered_texels, 4096 * 4096);
        assert_eq!((packing.overlap_texels, packing.overlap_max_layers), (0, 1));
        assert_eq!(
            (packing.pack_unit, packing.overlap_frac),
            (Some(1.0), Some(0.0))
        );
    }
}

#[test]
fn packing_counts_layers_and_the_box_of_the_uvs() {
    let half = UvMesh::grid(2).map_uvs(|[u, v]| [0.5 * u, 0.25 * v + 0.5]);
    let mut twice = half.clone();
    twice.add(&half);
    let packing = twice.measure().packing;
    assert_eq!(packing.overlap_max_layers, 2);
    assert_eq!(packing.overlap_frac, Some(1.0));
    near(packing.pack_unit, 0.125);
    near(packing.pack_square, 0.5);
    near(packing.pack_rect, 1.0);
    let outside = half.map_uvs(|[u, v]| [u + 40.0, v]).measure();
    assert_eq!(outside.packing.pack_unit, None);
    near(outside.packing.pack_square, 0.5);
}

#[test]
fn a_coarse_raster_agrees_with_a_fine_one() {
    let options = |raster_texels| MeasureOptions {
        raster_texels,
        overlap: Overlap::Skip,
        aspect: 1.0,
        weights: None,
    };
    let mesh = UvMesh::grid(5).map_uvs(|[u, v]| [0.1 + 0.7 * u - 0.1 * v, 0.2 + 0.2 * u + 0.5 * v]);
    let area = mesh.measure_with(VAxis::Up, options(8)).size.area_uv;
    for (texels, tolerance) in [(64, 0.03), (1000, 2e-3), (8192, 3e-4), (u32::MAX, 2e-4)] {
        let packing = mesh.measure_with(VAxis::Up, options(texels)).packing;
        let covered = packing.pack_unit.expect("inside the unit square");
        assert!(
            (covered / area - 1.0).abs() < tolerance,
            "{covered} at {texels}"
        );
        assert!(packing.raster_res <= MeasureOptions::MAX_RASTER);
    }
}

#[test]
fn a_stretch_has_its_singular_values() {
    // σ = (2, 1), scaled to equal areas (√2, 1/√2).
    let d = UvMesh::grid(4)
        .map_uvs(|[u, v]| [2.0 * u, v])
        .measure()
        .distortion;
    near(d.conformal_mean, 2.0);
    near(d.area_dist_mean, 1.0);
    near(d.sym_dirichlet_mean, 5.0);
    near(d.l2_stretch, 1.25_f64.sqrt());
    near(d.linf_stretch, 2.0_f64.sqrt());
    near(
        d.arap_mean,
        (2.0_f64.sqrt() - 1.0).powi(2) + (0.5_f64.sqrt() - 1.0).powi(2),
    );
}

#[test]
fn means_are_weighted_by_surface_area() {
    // Two charts: one face of area 8 at scale 1, one of area 2 whose UVs are twice as wide.
    let mut mesh = UvMesh::planar(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], &[[0, 1, 2]]);
    let small = UvMesh::planar(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]], &[[0, 1, 2]]);
    mesh.add(&small.map_uvs(|[u, v]| [2.0 * u + 10.0, v]));
    let m = mesh.measure();
    near(m.size.area_3d, 10.0);
    near(m.size.area_uv, 12.0);
    near(m.distortion.conformal_mean, 0.8 + 0.2 * 2.0);
    near(m.distortion.conformal_max, 2.0);
    near(m.distortion.conformal_p99, 2.0);
    near(m.density.density_p95_over_p5, 2.0_f64.sqrt());
    near(m.density.density_min, (10.0 / 12.0_f64).sqrt());
    near(m.density.density_max, (2.0 * 10.0 / 12.0_f64).sqrt());
    assert_eq!(m.seams.charts_for_90pct_area, 2);
}

#[test]
fn seams_are_edges_whose_uvs_differ() {
    let mut mesh = UvMesh::grid(2);
    for uv in mesh.uvs[0..4].as_flattened_mut() {
        uv[1] -= 2.0; // the lower half is a chart of its own
    }
    let m = mesh.measure();
    assert_eq!((m.seams.charts, m.seams.seam_edges), (2, 2));
    near(m.seams.seam_length, 1.0);
    near(m.seams.seam_over_sqrt_area, 1.0);
    near(m.seams.seam_over_bbox, 0.5_f64.sqrt());
    near(m.seams.boundary_length, 4.0);
    assert_eq!(
        (m.seams.edges_nonmanifold, m.seams.charts_le2_faces),
        (0, 0)
    );
}

#[test]
fn three_faces_on_an_edge_are_counted() {
    let mut mesh = UvMesh::planar(
        &[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, -1.0], [0.5, 3.0]],
        &[[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    );
    mesh.positions[4] = [0.5, 0.0, 1.0];
    mesh.uvs[2] = mesh.uvs[2].map(|[u, v]| [u + 2.0, v]);
    let seams = mesh.measure().seams;
    assert_eq!(
        (seams.edges_nonmanifold, seams.seam_edges, seams.charts),
        (1, 1, 2)
    );
    assert_eq!(seams.charts_le2_faces, 2);
}

#[test]
fn gaps_are_measured_between_charts() {
    let square =
        |x: f64, y: f64| UvMesh::grid(2).map_uvs(move |[u, v]| [0.25 * u + x, 0.25 * v + y]);
    let gaps = |offset: [f64; 2]| {
        let mut mesh = square(0.0, 0.0);
        mesh.add(&square(0.25 + offset[0], offset[1]));
        mesh.add(&square(0.0, 0.75));
        mesh.measure().gaps
    };
    let wide = gaps([0.3, 0.0]);
    near(wide.gap_uv, 0.3);
    near(wide.gap_texels_1024, 307.2);
    assert_eq!(wide.charts_gap_lt_1texel_1024, Some(0));
    let diagonal = gaps([0.25 * 0.75, 0.25 + 0.25]);
    near(diagonal.gap_uv, 0.25 * 0.75);
    let narrow = gaps([1.0 / 2048.0, 0.1]);
    near(narrow.gap_texels_4096, 2.0);
    assert_eq!(narrow.charts_gap_lt_1texel_1024, Some(2));
    assert_eq!(narrow.charts_gap_lt_1texel_4096, Some(0));
    let touching = gaps([0.0, 0.1]);
    assert_eq!(touching.gap_uv, Some(0.0));
    let crossing = gaps([-0.1, 0.1]);
    assert_eq!(crossing.gap_uv, Some(0.0));
    assert_eq!(crossing.charts_gap_lt_1texel_4096, Some(2));
    assert!(!crossing.gap_truncated);
}

#[test]
fn mirrored_depends_on_where_v_points() {
    let mut mesh = UvMesh::grid(1);
    mesh.add(&UvMesh::grid(1).map_uvs(|[u, v]| [3.0 - u, v]));
    mesh.add(&UvMesh::grid(1).map_uvs(|[u, v]| [6.0 - u, v]));
    let mirrored = |v_axis| {
        mesh.measure_with(v_axis, MeasureOptions::default())
            .validity
            .mirrored_charts
    };
    assert_eq!((mirrored(VAxis::Up), mirrored(VAxis::Down)), (2, 1));
}

#[test]
fn winding_is_made_consistent_before_flips_are_counted() {
    let mut mesh = UvMesh::grid(4);
    mesh.reverse(3);
    mesh.reverse(17);
    let validity = mesh.measure().validity;
    assert_eq!(
        (validity.flipped, validity.winding_inconsistent_faces),
        (0, 2)
    );
    assert_eq!(
        moebius_in_one_piece(12)
            .measure()
            .seams
            .nonorientable_charts,
        1
    );
}

#[test]
fn a_fold_is_counted_with_its_area_and_pairs() {
    let m = UvMesh::grid(10)
        .map_uvs(|[u, v]| [(u - 0.3).abs(), v])
        .measure();
    assert_eq!(m.validity.flipped, 60);
    near(m.validity.flipped_uv_area_frac, 0.3);
    assert_eq!(m.overlaps.overlap_faces, Some(120));
    assert_eq!(
        m.overlaps.overlap_pairs,
        m.overlaps.overlap_pairs_same_chart
    );
    assert!(!m.locally_injective);
    assert_eq!(m.bijective, Some(false));
}

#[test]
fn overlaps_of_rounding_depth_are_exact_pairs_only() {
    let mut mesh = UvMesh::grid(1);
    mesh.add(&UvMesh::grid(1).map_uvs(|[u, v]| [u + 1.0 - 1e-8, v]));
    let overlaps = mesh.measure().overlaps;
    assert_eq!(
        (overlaps.overlap_pairs_exact, overlaps.overlap_pairs),
        (Some(3), Some(0))
    );
}

#[test]
fn faces_that_vanish_are_counted_beside_the_means() {
    let mut mesh = UvMesh::grid(2);
    let line = mesh.uvs[0][0];
    mesh.uvs[0] = [line; 3];
    mesh.uvs[7] = [[1.0, 1.0], [0.5, 1.0], [0.5, 1.0 + 1e-12]];
    mesh.triangles.push([0, 1, 2]);
    mesh.uvs.push([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let m = mesh.measure();
    assert_eq!((m.validity.uv_degenerate, m.validity.uv_collapsed), (1, 1));
    assert_eq!(m.size.faces_degenerate_3d, 1);
    near(m.validity.uv_degenerate_area3d_frac, 0.25);
    assert!(m.distortion.sym_dirichlet_max > Some(1e6) && !m.locally_injective);
}

#[test]
fn nothing_and_not_a_number_have_figures_too() {
    let empty = UvMesh::default().measure();
    assert_eq!((empty.size.faces, empty.seams.charts), (0, 0));
    assert_eq!(empty.distortion.conformal_mean, None);
    let mut mesh = UvMesh::grid(2);
    mesh.uvs[2][0][1] = f64::NAN;
    mesh.triangles[3][0] = 99;
    let m = mesh.measure();
    assert_eq!(m.size.uv_nonfinite_faces, 2);
    assert!(m.size.area_uv.is_finite() && !m.locally_injective);
}

#[test]
fn overlaps_are_searched_on_request() {
    let options = MeasureOptions {
        overlap: Overlap::Skip,
        ..MeasureOptions::default()
    };
    let m = UvMesh::grid(2).measure_with(VAxis::Up, options);
    assert_eq!((m.overlaps.overlap_pairs, m.bijective), (None, None));
}

#[test]
fn distortion_of_faces_makes_up_that_of_the_mesh() {
    let mesh = UvMesh::grid(6).map_uvs(|[u, v]| [(u - 0.3).abs() + 0.2 * v * v, v * (1.0 + u)]);
    let m = mesh.measure();
    let faces = face_distortion(&mesh.positions, &mesh.triangles, &mesh.uvs, None);
    let greatest = |of: fn(&unwrapd_maps::measure::FaceDistortion) -> f64| {
        faces.iter().map(of).fold(0.0, f64::max)
    };
    near(m.distortion.conformal_max, greatest(|f| f.conformal));
    near(m.distortion.area_dist_max, greatest(|f| f.area));
    near(
        m.distortion.sym_dirichlet_max,
        greatest(|f| f.symmetric_dirichlet),
    );
    let mean = faces.iter().map(|f| f.symmetric_dirichlet).sum::<f64>() / faces.len() as f64;
    near(m.distortion.sym_dirichlet_mean, mean);
    assert_eq!(
        faces.iter().filter(|f| f.flipped).count(),
        m.validity.flipped
    );
    assert!(m.validity.flipped > 0 && faces.iter().all(|f| !f.degenerate));
}

/// Values asserted by the tests of "A Dataset and Benchmark for Mesh Parameterization" (Shay et al. 2022).
#[test]
fn benchmark_meshes_have_their_published_values() {
    let measured =
        |name: &str| read_obj(&places::asset(&format!("uv_metrics/{name}.obj"))).measure();
    let (triangle, stretched) = (measured("triangle"), measured("square_stretched"));
    let (scaled, cube) = (measured("square_scaled"), measured("cube"));
    let (folded, strip) = (measured("folded"), measured("strip_fold"));
    let cone = measured("cone_disk");
    near(triangle.distortion.conformal_max, 1.5); // √(3/2) over 2/√6
    near(triangle.distortion.linf_stretch, 6.0_f64.sqrt() / 2.0);
    near(stretched.distortion.conformal_max, 2.0);
    near(stretched.distortion.area_dist_max, 1.0);
    near(scaled.distortion.sym_dirichlet_max, 4.0);
    near(cube.seams.seam_over_sqrt_area, 7.0 / 6.0_f64.sqrt());
    assert_eq!((cube.seams.charts, cube.cost.components), (1, 1));
    let seams = (0.5 + 7.0 / 6.0_f64.sqrt()).ln();
    near(cube.cost.cost, seams + 1.0 - cube.packing.pack_square);
    assert_eq!(
        (folded.validity.flipped, folded.overlaps.overlap_faces),
        (2, Some(2))
    );
    assert_eq!(strip.overlaps.overlap_faces, Some(4)); // 0.7 of its surface
    assert!((cone.distortion.area_dist_max.expect("a figure") - 1.0).abs() < 1e-5);
    assert_eq!(cone.seams.seam_edges, 0);
}

/// Maps of other programs, and small faulty ones, as an independent script measures them.
mod shared {
    use super::{MeasureOptions, VAxis, read_obj};
    use crate::places;
    use serde_json::Value;
    use std::path::PathBuf;
    use std::process::Command;

    const PROGRAM: &str = "\
import json, sys
sys.path.insert(0, sys.argv[1])
import uvmetrics
out = []
for path in sys.argv[2:]:
    r = uvmetrics.evaluate(*uvmetrics.load_obj(path))
    r.pop('_chart'), r.pop('eval_seconds')
    out.append(r)
print(json.dumps(out))
";

    #[test]
    #[ignore = "needs ../shared"]
    fn all_figures_agree_with_the_independent_script() {
        let paths: Vec<PathBuf> = [
            "uv_baseline/camel_b_libigl.obj",
            "uv_baseline/camel_seamster.obj",
            "uv_baseline/lucy_8k_zbrush.obj",
            "uv_baseline/statue5_10k_zbrush.obj",
            "uv_metrics/cube.obj",
            "uv_metrics/folded.obj",
            "uv_metrics/strip_fold.obj",
            "uv_metrics/flat_triangle.obj",
        ]
        .map(|name| places::shared("data").join(name))
        .into();
        for (path, expected) in paths.iter().zip(evaluate(&paths)) {
            let ours = read_obj(path).measure_with(VAxis::Up, MeasureOptions::default());
            let ours = serde_json::to_value(ours).expect("plain numbers");
            for (key, value) in expected.as_object().expect("an object") {
                assert!(
                    agree(&ours[key], value),
                    "{path:?} {key}: {} {value}",
                    ours[key]
                );
            }
        }
    }

    /// What the script says of each file.
    fn evaluate(paths: &[PathBuf]) -> Vec<Value> {
        let output = Command::new(places::python())
            .args(["-c", PROGRAM])
            .arg(places::shared("tools"))
            .args(paths)
            .output()
            .expect("a Python");
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{error}");
        serde_json::from_slice(&output.stdout).expect("JSON")
    }

    /// Equal, numbers that are not counts to 1e-3.
    fn agree(ours: &Value, expected: &Value) -> bool {
        if let (Value::Array(ours), Value::Array(expected)) = (ours, expected) {
            return ours.len() == expected.len()
                && ours.iter().zip(expected).all(|(a, b)| agree(a, b));
        }
        match (ours.as_f64(), expected.as_f64()) {
            (Some(a), Some(b)) if !expected.is_i64() => {
                (a - b).abs() <= 1e-3 * a.abs().max(b.abs()) + 1e-12
            }
            _ => ours == expected,
        }
    }
}

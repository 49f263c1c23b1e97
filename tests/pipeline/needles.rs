//! Needles decide nothing: a mesh is cut as it is without them.

use crate::zoo::{self, Mesh};
use unwrapd_maps::certificate::{Overlap, certify};
use unwrapd_maps::measure::{MeasureOptions, measure};
use unwrapd_maps::mesh::VAxis;
use unwrapd_pipeline::{Settings, Unobserved, Unwrapped, unwrap};

fn positions(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.positions.iter().map(|p| p.map(f64::from)).collect()
}

fn certified(mesh: &Mesh) -> Unwrapped {
    let settings = Settings::default();
    let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved).unwrap();
    let (positions, uvs) = (positions(mesh), unwrapped.corner_uvs());
    let certificate = certify(&positions, &mesh.triangles, &uvs, &Overlap::Test.into());
    assert!(certificate.is_bijective(), "{}: {certificate:?}", mesh.name);
    unwrapped
}

/// Length of the seams over the root of the area.
fn seam(mesh: &Mesh, unwrapped: &Unwrapped) -> f64 {
    let uvs = unwrapped.corner_uvs();
    let options = MeasureOptions::default();
    let positions = positions(mesh);
    let measures = measure(&positions, &mesh.triangles, &uvs, VAxis::Up, &options);
    (measures.seams.seam_over_sqrt_area).unwrap()
}

#[test]
fn vertices_on_sides_change_no_cut() {
    let meshes = [
        zoo::grid(6, 5),
        zoo::tube(12, 3.0),
        zoo::sphere(10, 14).lopsided(),
        zoo::torus(14, 9).lopsided(),
        zoo::voxels(&[[0, 0, 0], [1, 0, 0], [1, 1, 0]]).lopsided(),
    ];
    for mesh in meshes {
        let sound = certified(&mesh);
        for (every, height) in [(1, 0.0), (5, 0.0), (5, 1e-6), (11, 3e-5)] {
            let with_needles = mesh.clone().with_needles(every, height);
            let unwrapped = certified(&with_needles);
            let name = format!("{} faces, {every} {height}", mesh.triangles.len());
            assert_eq!(unwrapped.charts.len(), sound.charts.len(), "{name}");
            let [before, after] = [seam(&mesh, &sound), seam(&with_needles, &unwrapped)];
            assert!(
                (after - before).abs() <= 0.03 * before,
                "{name}: {before} {after}"
            );
        }
    }
}

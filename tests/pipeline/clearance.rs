//! Charts opened by the packer until the judge finds them safe to be rounded.

use unwrapd_layout::atlas::{ChartMap, cleared};
use unwrapd_maps::certificate::{Certificate, Claims, certify};
use unwrapd_maps::mesh::Resolution;
use unwrapd_maps::plane::keep_apart;
use unwrapd_pipeline::{Layout, Mapping, Settings, Unobserved, unwrap};

use crate::uv_meshes::UvMesh;
use crate::zoo;

const BITS: u32 = 12;

/// What two places may come nearer to each other by when the certificate moves both.
fn clearance() -> f64 {
    8.0_f64.sqrt() * (0.5 / 4095.0 + 1.0 / 65_536.0)
}

/// Two prongs on a base, a quarter of a unit wide, whose faces are all fat: the tip of one comes
/// near the other's side.
fn fork(gap: f64, is_mirrored: bool) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
    let (left, right) = (1.0 - gap / 2.0, 1.0 + gap / 2.0);
    let corners = [
        [0.0, -1.0],
        [2.0, -1.0],
        [0.0, 0.0],
        [0.4, 0.0],
        [right, 0.0],
        [2.0, 0.0],
        [0.0, 1.0],
        [left, 0.5],
        [right, 1.0],
        [2.0, 1.0],
    ];
    let mut triangles = vec![
        [0, 3, 2],
        [0, 1, 3],
        [1, 4, 3],
        [1, 5, 4],
        [2, 3, 7],
        [2, 7, 6],
        [4, 5, 9],
        [4, 9, 8],
    ];
    let side = if is_mirrored { -0.25 } else { 0.25 };
    if is_mirrored {
        for triangle in &mut triangles {
            triangle.swap(1, 2);
        }
    }
    let places = corners.map(|[x, y]| [0.5 + side * (x - 1.0), 0.5 + 0.25 * y]);
    (places.to_vec(), triangles)
}

fn judged(places: &[[f64; 2]], triangles: &[[u32; 3]]) -> Certificate {
    let mesh = UvMesh::planar(places, triangles);
    at_bits(&mesh.positions, &mesh.triangles, &mesh.uvs)
}

fn at_bits(positions: &[[f64; 3]], triangles: &[[u32; 3]], uvs: &[[[f64; 2]; 3]]) -> Certificate {
    let claims = Claims {
        bits: Some(BITS),
        ..Claims::default()
    };
    certify(positions, triangles, uvs, &claims)
}

#[test]
fn narrow_gaps_are_opened_on_either_side() {
    for is_mirrored in [false, true] {
        for gap in [1e-5, 4e-4] {
            let (uv, triangles) = fork(gap, is_mirrored);
            let before = judged(&uv, &triangles).bits.expect("asked for");
            assert!(!before.hold && before.faces_in_doubt == 0, "{before:?}");
            let map = ChartMap {
                uv: &uv,
                triangles: &triangles,
            };
            let opened = cleared(&map, clearance()).expect("a gap to be opened");
            let after = judged(&opened, &triangles).bits.expect("asked for");
            assert!(after.hold, "{gap}: {after:?}");
        }
    }
}

#[test]
fn gaps_are_opened_however_vertices_are_numbered() {
    let (uv, triangles) = fork(1e-5, false);
    for first in 1..uv.len() {
        let mut turned = uv.clone();
        turned.rotate_right(first);
        let number = |v: u32| (v + first as u32) % uv.len() as u32;
        let triangles: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(number)).collect();
        let map = ChartMap {
            uv: &turned,
            triangles: &triangles,
        };
        let opened = cleared(&map, clearance()).expect("a gap to be opened");
        let after = judged(&opened, &triangles).bits.expect("asked for");
        assert!(after.hold, "{first}: {after:?}");
    }
}

#[test]
fn a_boundary_keeps_apart_from_itself_where_the_judge_says_so() {
    // The boundary of a fork, its area on the left.
    let around = [0, 1, 5, 9, 8, 4, 3, 7, 6, 2];
    for gap in [1e-5, 4e-4, 3e-3, 0.1] {
        let (uv, triangles) = fork(gap, false);
        let holds = judged(&uv, &triangles).bits.expect("asked for").hold;
        let mut boundary = around.map(|v: usize| uv[v]).to_vec();
        for first in 0..around.len() {
            // The fork is half a unit wide and high.
            let is_apart = keep_apart(std::slice::from_ref(&boundary), clearance() / 0.5);
            assert_eq!(is_apart, holds, "{gap} from {first}");
            boundary.rotate_left(1);
        }
    }
}

#[test]
fn charts_without_padding_stay_apart_when_they_are_rounded() {
    let sphere = || zoo::sphere(8, 6);
    let others = [4.0, 8.0].map(|x| sphere().moved([x, 0.0, 0.0]));
    let mesh = others.iter().fold(sphere(), zoo::Mesh::with);
    let settings = Settings {
        layout: Layout {
            padding: 0,
            resolution: Resolution::square(4096),
            ..Layout::default()
        },
        mapping: Mapping {
            quantization_safe: Some(BITS),
            ..Mapping::default()
        },
        ..Settings::default()
    };
    let made = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
    let uvs = made.expect("it unwraps").corner_uvs();
    let positions: Vec<[f64; 3]> = (mesh.positions.iter()).map(|p| p.map(f64::from)).collect();
    let certificate = at_bits(&positions, &mesh.triangles, &uvs);
    assert!(certificate.charts > 1, "the mesh is no test");
    assert!(certificate.bits.expect("asked for").hold);
}

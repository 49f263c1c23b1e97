//! What the certificate accepts, what it refuses and why.

use crate::uv_meshes::{UvMesh, moebius_in_one_piece};
use unwrapd_maps::certificate::{Overlap, chart_ids};
use unwrapd_maps::mesh::CornerUvs;

/// Uniform numbers in 0..n, the same on every run.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }
}

#[test]
fn the_identity_is_bijective() {
    let certificate = UvMesh::grid(6).certify(Overlap::Test);
    assert!(certificate.is_valid() && certificate.is_bijective());
    assert_eq!((certificate.faces, certificate.charts), (72, 1));
    assert_eq!(certificate.overlapping_pairs, Some(0));
    assert_eq!(certificate.grid_bits, Some(12));
}

#[test]
fn what_was_not_tested_is_not_claimed() {
    let certificate = UvMesh::grid(6).certify(Overlap::Skip);
    assert!(certificate.is_valid() && !certificate.is_bijective());
    assert_eq!(certificate.overlapping_pairs, None);
}

#[test]
fn a_vertex_moved_across_its_ring_flips_faces() {
    let moved = |uv: [f64; 2]| if uv == [0.5, 0.5] { [0.95, 0.5] } else { uv };
    let certificate = UvMesh::grid(4).map_uvs(moved).certify(Overlap::Test);
    assert!(!certificate.is_valid());
    assert!(certificate.flipped > 0 && certificate.flipped < 6);
    assert_eq!(certificate.offending_faces.len(), certificate.flipped);
    assert!(certificate.overlapping_pairs > Some(0));
    assert_eq!(certificate.grid_bits, None);
}

#[test]
fn exactly_zero_is_degenerate_and_an_ulp_is_not() {
    let triangle = |y: f64| UvMesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        uvs: vec![[[0.0, 0.0], [0.5, 0.25], [1.0, y]]],
    };
    let zero = triangle(0.5).certify(Overlap::Test);
    assert_eq!((zero.degenerate, zero.is_valid()), (1, false));
    assert_eq!(zero.offending_faces, [0]);
    for ulp in [0.5_f64.next_up(), 0.5_f64.next_down()] {
        let sliver = triangle(ulp).certify(Overlap::Test);
        assert!(sliver.is_bijective());
        assert_eq!(sliver.grid_bits, None, "no grid keeps an ulp of f64");
    }
}

#[test]
fn a_mirrored_chart_is_valid() {
    let mut mesh = UvMesh::grid(3);
    mesh.add(&UvMesh::grid(3).map_uvs(|[u, v]| [-1.0 - u, v]));
    let certificate = mesh.certify(Overlap::Test);
    assert!(certificate.is_bijective());
    assert_eq!(certificate.charts, 2);
}

#[test]
fn winding_of_the_file_does_not_matter() {
    let mut mesh = UvMesh::grid(5);
    for face in [0, 7, 8, 20, 49] {
        mesh.reverse(face);
    }
    assert!(mesh.certify(Overlap::Test).is_bijective());
}

#[test]
fn a_fold_is_flipped_on_the_smaller_side() {
    let folded = UvMesh::grid(10).map_uvs(|[u, v]| [(u - 0.3).abs(), v]);
    let certificate = folded.certify(Overlap::Test);
    assert_eq!(certificate.flipped, 60);
    assert!(certificate.overlapping_pairs_same_chart > Some(0));
    assert_eq!(certificate.overlapping_pairs_between_charts, Some(0));
}

#[test]
fn two_faces_folded_onto_each_other_are_both_refused() {
    // Equal areas: neither side is the chart's own.
    let mut mesh = UvMesh::planar(
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]],
        &[[0, 1, 2], [2, 1, 3]],
    );
    mesh.uvs[1][2] = [0.0, 0.0];
    let certificate = mesh.certify(Overlap::Test);
    assert_eq!(
        (certificate.flipped, certificate.overlapping_pairs),
        (2, Some(1))
    );
}

#[test]
fn a_moebius_strip_in_one_piece_is_refused() {
    let certificate = moebius_in_one_piece(12).certify(Overlap::Test);
    assert_eq!(
        (certificate.charts, certificate.nonorientable_charts),
        (1, 1)
    );
    assert!(!certificate.is_valid());
}

#[test]
fn overlapping_charts_are_valid_but_not_bijective() {
    let mut mesh = UvMesh::grid(1);
    mesh.add(&UvMesh::grid(1).map_uvs(|[u, v]| [u + 0.5, v + 0.125]));
    let certificate = mesh.certify(Overlap::Test);
    assert!(certificate.is_valid() && !certificate.is_bijective());
    assert_eq!(certificate.overlapping_pairs_same_chart, Some(0));
    assert_eq!(
        certificate.overlapping_pairs_between_charts,
        certificate.overlapping_pairs
    );
    let expected = brute_force_pairs(&mesh.uvs);
    assert_eq!(certificate.overlapping_pairs, Some(expected));
}

#[test]
fn touching_charts_do_not_overlap() {
    let mut mesh = UvMesh::grid(3);
    mesh.add(&UvMesh::grid(2).map_uvs(|[u, v]| [u + 1.0, v]));
    mesh.add(&UvMesh::grid(1).map_uvs(|[u, v]| [u - 1.0, v + 1.0]));
    let certificate = mesh.certify(Overlap::Test);
    assert!(certificate.is_bijective());
    assert_eq!(certificate.charts, 3);
}

#[test]
fn a_double_wall_is_two_charts_or_an_overlap() {
    let front = UvMesh::grid(4);
    let mut wall = front.clone();
    for face in 0..front.triangles.len() {
        wall.triangles.push(front.triangles[face]);
        wall.uvs.push(front.uvs[face].map(|[u, v]| [3.0 - u, v]));
        wall.reverse(front.triangles.len() + face);
    }
    assert!(wall.certify(Overlap::Test).is_bijective());
    assert_eq!(wall.certify(Overlap::Test).charts, 2);
    for face in 0..front.triangles.len() {
        let twin = front.triangles.len() + face;
        wall.uvs[twin] = wall.uvs[twin].map(|[u, v]| [3.0 - u, v]);
    }
    assert!(!wall.certify(Overlap::Test).is_bijective());
}

#[test]
fn equal_positions_are_one_vertex() {
    let mut mesh = UvMesh::grid(3);
    let split = UvMesh {
        positions: mesh
            .triangles
            .as_flattened()
            .iter()
            .map(|&v| mesh.positions[v as usize])
            .collect(),
        triangles: (0..18).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
        uvs: mesh.uvs.clone(),
    };
    for p in mesh.positions.as_flattened_mut() {
        *p = if *p == 0.0 { -0.0 } else { *p };
    }
    assert_eq!(split.certify(Overlap::Test), mesh.certify(Overlap::Test));
}

#[test]
fn only_repeated_positions_are_exempt() {
    let mut mesh = UvMesh::grid(2);
    mesh.triangles.push([0, 0, 1]);
    mesh.uvs.push([[0.0; 2]; 3]);
    let certificate = mesh.certify(Overlap::Test);
    assert!(certificate.is_bijective());
    assert_eq!(
        (
            certificate.faces,
            certificate.exempt_faces,
            certificate.charts
        ),
        (9, 1, 1)
    );
    // Collinear, but three positions: it must have area.
    mesh.triangles.push([0, 1, 2]);
    mesh.uvs.push([[0.0; 2]; 3]);
    assert_eq!(mesh.certify(Overlap::Test).degenerate, 1);
    mesh.uvs[9] = [[2.0, 0.0], [3.0, 0.0], [2.0, 1.0]];
    assert!(mesh.certify(Overlap::Test).is_bijective());
}

#[test]
fn a_repeated_position_does_not_excuse_a_flip() {
    let mut mesh = UvMesh::planar(
        &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        &[[0, 1, 2], [1, 0, 0]],
    );
    mesh.uvs[1] = [[1.0, 0.0], [0.0, 0.0], [0.5, 0.5]];
    assert_eq!(mesh.certify(Overlap::Skip).flipped, 1);
    mesh.uvs[1][2] = [0.5, -0.5];
    assert!(mesh.certify(Overlap::Skip).is_valid());
}

#[test]
fn what_cannot_be_read_is_named() {
    let mut mesh = UvMesh::grid(2);
    mesh.uvs[3][1][0] = f64::NAN;
    mesh.uvs[4][2][1] = f64::INFINITY;
    mesh.triangles[5][0] = 1000;
    mesh.uvs.pop();
    let certificate = mesh.certify(Overlap::Test);
    assert_eq!(certificate.nonfinite_faces, 4);
    assert_eq!(certificate.offending_faces, [3, 4, 5, 7]);
    assert!(!certificate.is_valid());
    mesh.positions.clear();
    assert_eq!(mesh.certify(Overlap::Test).nonfinite_faces, 8);
}

#[test]
fn nothing_is_valid() {
    let certificate = UvMesh::default().certify(Overlap::Test);
    assert!(certificate.is_bijective());
    assert_eq!((certificate.faces, certificate.charts), (0, 0));
}

#[test]
fn charts_are_numbered_by_their_first_faces() {
    let mut mesh = UvMesh::grid(2);
    for uv in mesh.uvs[2..4].as_flattened_mut() {
        uv[0] += 5.0;
    }
    let ids = chart_ids(&mesh.positions, &mesh.triangles, &mesh.uvs);
    assert_eq!(ids, [0, 0, 1, 1, 0, 0, 0, 0]);
}

#[test]
fn pairs_are_those_whose_common_polygon_has_area() {
    let mut random = Random(7);
    for n in [1, 2, 5, 40, 150] {
        let mut mesh = UvMesh::default();
        for f in 0..n {
            let mut corner = || [random.below(12) as f64, random.below(12) as f64];
            let uvs = [corner(), corner(), corner()];
            let z = f64::from(f);
            mesh.positions
                .extend([[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]]);
            mesh.triangles.push([3 * f, 3 * f + 1, 3 * f + 2]);
            mesh.uvs.push(uvs);
        }
        let pairs = mesh.certify(Overlap::Test).overlapping_pairs;
        assert_eq!(pairs, Some(brute_force_pairs(&mesh.uvs)), "{n} faces");
    }
}

#[test]
fn grid_bits_are_those_all_moves_leave_positive() {
    let mut random = Random(3);
    let mut seen = [0; 4];
    for _ in 0..3000 {
        let size = 1 << (1 + random.below(10));
        let mut coordinate = || (4096 + random.below(size)) as f64 / 8192.0;
        let mut corner = || [coordinate(), coordinate()];
        let uvs = [corner(), corner(), corner()];
        if doubled_area(&uvs) == 0.0 {
            continue;
        }
        let mesh = UvMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            uvs: vec![uvs],
        };
        let by_force = [12, 14, 16]
            .into_iter()
            .find(|&bits| survives_all_moves(&uvs, bits));
        let expected = by_force.unwrap_or(23);
        assert_eq!(
            mesh.certify(Overlap::Skip).grid_bits,
            Some(expected),
            "{uvs:?}"
        );
        seen[[12, 14, 16, 23]
            .iter()
            .position(|&b| b == expected)
            .expect("a level")] += 1;
    }
    assert!(seen.iter().all(|&n| n > 20), "each level occurs: {seen:?}");
}

#[test]
fn one_cell_of_the_grid_holds_at_23_bits() {
    let step = f64::from(1 << 23).recip();
    let triangle = |size: f64| UvMesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        uvs: vec![[[0.75, 0.25], [0.75 + size, 0.25], [0.75, 0.25 + size]]],
    };
    assert_eq!(triangle(step).certify(Overlap::Skip).grid_bits, Some(23));
    assert_eq!(triangle(0.25 * step).certify(Overlap::Skip).grid_bits, None);
}

fn doubled_area([a, b, c]: &CornerUvs) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Tries the 64 extreme moves of six coordinates; the area is linear in each of them.
fn survives_all_moves(uvs: &CornerUvs, bits: u32) -> bool {
    let delta = 0.5 / (f64::from(bits).exp2() - 1.0) + f64::from(-16).exp2();
    let sign = doubled_area(uvs).signum();
    (0..64_u32).all(|choice| {
        let mut moved = *uvs;
        for (k, x) in moved.as_flattened_mut().iter_mut().enumerate() {
            *x += if choice >> k & 1 == 1 { delta } else { -delta };
        }
        doubled_area(&moved) * sign > 0.0
    })
}

/// Pairs whose common polygon, found by clipping, has area. Corners are small integers, so no area between 0 and 1e-6 occurs.
fn brute_force_pairs(uvs: &[CornerUvs]) -> u64 {
    let mut pairs = 0;
    for (i, a) in uvs.iter().enumerate() {
        for b in &uvs[..i] {
            pairs += u64::from(common_area(a, b) > 1e-7);
        }
    }
    pairs
}

fn common_area(a: &CornerUvs, b: &CornerUvs) -> f64 {
    let clip = counter_clockwise(b);
    let mut polygon = counter_clockwise(a).to_vec();
    for e in 0..3 {
        let (p, q) = (clip[e], clip[(e + 1) % 3]);
        let height = |r: [f64; 2]| doubled_area(&[p, q, r]);
        let mut clipped = Vec::new();
        for (k, &r) in polygon.iter().enumerate() {
            let s = polygon[(k + 1) % polygon.len()];
            let (h, g) = (height(r), height(s));
            if h >= 0.0 {
                clipped.push(r);
            }
            if h * g < 0.0 {
                let t = h / (h - g);
                clipped.push([r[0] + t * (s[0] - r[0]), r[1] + t * (s[1] - r[1])]);
            }
        }
        polygon = clipped;
    }
    let fan = |k: usize| doubled_area(&[polygon[0], polygon[k], polygon[k + 1]]);
    (1..polygon.len().max(2) - 1).map(fan).sum()
}

fn counter_clockwise(uvs: &CornerUvs) -> CornerUvs {
    let [a, b, c] = *uvs;
    if doubled_area(uvs) < 0.0 {
        [a, c, b]
    } else {
        *uvs
    }
}

#[test]
fn planar_maps_are_judged_with_their_overlaps() {
    use unwrapd_maps::certificate::certify_planar;
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let triangles = [[0, 1, 2], [0, 2, 3]];
    assert!(certify_planar(&square, &triangles).is_bijective());
    let mirrored = square.map(|[x, y]| [-x, y]);
    assert_eq!(certify_planar(&mirrored, &triangles).inverted, 2);
    let flat = square.map(|[x, _]| [x, 0.0]);
    assert_eq!(certify_planar(&flat, &triangles).degenerate, 2);
    let infinite = square.map(|[x, y]| [x / y.min(0.5), y]);
    assert_eq!(certify_planar(&infinite, &triangles).nonfinite, 2);
    assert_eq!(certify_planar(&square, &[[0, 1, 9]]).nonfinite, 1);
}

#[test]
fn a_strip_wound_over_itself_is_valid_but_not_bijective() {
    use unwrapd_maps::certificate::certify_planar;
    // A strip of an annulus whose angle grows past a full turn.
    let wound = |turns: f64| {
        let point = |k: u32| {
            let angle = f64::from(k / 2) / 40.0 * turns * std::f64::consts::TAU;
            let radius = if k.is_multiple_of(2) { 2.0 } else { 1.0 };
            [radius * angle.cos(), radius * angle.sin()]
        };
        let vertices: Vec<[f64; 2]> = (0..82).map(point).collect();
        let triangles: Vec<[u32; 3]> = (0..40_u32)
            .flat_map(|k| {
                [
                    [2 * k, 2 * k + 2, 2 * k + 1],
                    [2 * k + 1, 2 * k + 2, 2 * k + 3],
                ]
            })
            .collect();
        certify_planar(&vertices, &triangles)
    };
    assert!(wound(0.9).is_bijective());
    let twice = wound(1.5);
    assert!(twice.is_valid() && !twice.is_bijective());
    assert!(twice.overlapping_pairs >= 40, "{}", twice.overlapping_pairs);
}

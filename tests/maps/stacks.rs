//! Stacks: charts that coincide are accepted where a caller accepts them, and nothing else is.

use crate::uv_meshes::UvMesh;
use unwrapd_maps::certificate::{Certificate, Claims, Overlap, Padding, Stacks, certify};
use unwrapd_maps::mesh::Resolution;

/// A quarter of the page, cut into squares, at a corner.
fn tile(corner: [f64; 2]) -> UvMesh {
    UvMesh::grid(4).map_uvs(|uv| [0, 1].map(|k| corner[k] + 0.25 * uv[k]))
}

/// Charts on each other and one beside them.
fn stacked(charts: &[UvMesh]) -> UvMesh {
    let mut mesh = UvMesh::default();
    for chart in charts {
        mesh.add(chart);
    }
    mesh.add(&tile([0.625, 0.625]));
    mesh
}

fn judged(mesh: &UvMesh, stacks: Stacks) -> Certificate {
    let claims = Claims {
        stacks,
        padding: Some(Padding {
            texels: 4,
            resolution: Resolution::square(64),
        }),
        ..Overlap::Test.into()
    };
    certify(&mesh.positions, &mesh.triangles, &mesh.uvs, &claims)
}

/// The tile with the other diagonals.
fn with_other_diagonals(corner: [f64; 2]) -> UvMesh {
    let mut mesh = tile([0.0; 2]).map_uvs(|[u, v]| [0.25 - u, v]);
    // Mirrored, it has the other diagonals and is wound the other way.
    for (triangle, uvs) in mesh.triangles.iter_mut().zip(&mut mesh.uvs) {
        triangle.swap(1, 2);
        uvs.swap(1, 2);
    }
    mesh.map_uvs(|uv| [0, 1].map(|k| uv[k] + corner[k]))
}

#[test]
fn charts_that_coincide_are_one_stack_if_that_is_accepted() {
    let at = [0.125; 2];
    let mirrored = tile([0.0; 2]).map_uvs(|[u, v]| [at[0] + 0.25 - u, at[1] + v]);
    let mesh = stacked(&[tile(at), tile(at), with_other_diagonals(at), mirrored]);
    let refused = judged(&mesh, Stacks::Refused);
    assert!(refused.is_valid() && !refused.is_bijective_but_for_stacks());
    assert!(refused.overlapping_pairs > Some(0) && refused.stacks.is_none());
    let accepted = judged(&mesh, Stacks::Accepted);
    assert!(accepted.is_bijective_but_for_stacks());
    assert!(!accepted.is_bijective(), "stacked charts overlap");
    assert_eq!(accepted.stacks, Some(vec![vec![0, 1, 2, 3]]));
    assert_eq!((accepted.charts, accepted.overlapping_pairs), (5, Some(0)));
    assert!(accepted.padding.is_some_and(|padding| padding.kept));
    assert_eq!(accepted.safe_bits, None, "rounding may part a stack");
}

#[test]
fn a_map_without_stacks_is_judged_as_ever() {
    let mesh = stacked(&[tile([0.125; 2])]);
    let [refused, accepted] = [Stacks::Refused, Stacks::Accepted].map(|it| judged(&mesh, it));
    assert!(refused.is_bijective() && accepted.is_bijective());
    assert_eq!(accepted.stacks, Some(Vec::new()));
    assert_eq!(refused.safe_bits, accepted.safe_bits);
    assert_eq!(refused.padding, accepted.padding);
}

#[test]
fn overlaps_beside_a_stack_are_found() {
    let at = [0.125; 2];
    let step = 1.0 / f64::from(1 << 23);
    let moved = |by: [f64; 2]| tile(at).map_uvs(|uv| [0, 1].map(|k| uv[k] + by[k]));
    let one_moved =
        |at: [f64; 2], to: [f64; 2]| tile([0.125; 2]).map_uvs(|uv| if uv == at { to } else { uv });
    let scaled = |factor: f64| tile(at).map_uvs(|uv| uv.map(|x| 0.125 + factor * (x - 0.125)));
    let turned = tile(at).map_uvs(|[u, v]| {
        [
            0.25 - 0.8 * (v - 0.25) - 0.6 * (u - 0.25),
            0.25 + 0.8 * (u - 0.25),
        ]
    });
    let grid = |n: u32| UvMesh::grid(n).map_uvs(|uv| uv.map(|x| 0.125 + 0.25 * x));
    let planted: Vec<UvMesh> = vec![
        // Shifted by a step of the grid, a texel, and more.
        moved([step, 0.0]),
        moved([0.0, -step]),
        moved([1.0 / 64.0, 0.0]),
        moved([0.0625, 0.0625]),
        moved([0.125, 0.0]),
        moved([0.2499, 0.2499]),
        // One vertex of the border moved in or out.
        one_moved([0.125, 0.125], [0.125 + step, 0.125]),
        one_moved([0.375, 0.375], [0.375 + step, 0.375 + step]),
        one_moved([0.125, 0.25], [0.13, 0.25]),
        one_moved([0.375, 0.25], [0.38, 0.25]),
        one_moved([0.25, 0.375], [0.25, 0.40]),
        // Larger and smaller.
        scaled(1.01),
        scaled(0.99),
        scaled(0.5),
        scaled(1.5),
        // Turned about the middle.
        turned,
        // A border with other vertices has other edges.
        grid(3),
        grid(8),
        // A part of the tile, and a tile that reaches over another chart.
        UvMesh::planar(
            &[[0.125, 0.125], [0.375, 0.125], [0.375, 0.375]],
            &[[0, 1, 2]],
        ),
        tile([0.5, 0.5]),
    ];
    assert_eq!(planted.len(), 20);
    for (number, chart) in planted.into_iter().enumerate() {
        let mesh = stacked(&[tile(at), tile(at), chart]);
        let certificate = judged(&mesh, Stacks::Accepted);
        assert!(certificate.is_valid(), "{number}: {certificate:?}");
        assert_eq!(certificate.stacks, Some(vec![vec![0, 1]]), "{number}");
        assert!(!certificate.is_bijective_but_for_stacks(), "{number}");
        assert!(certificate.overlapping_pairs > Some(0), "{number}");
        assert!(certificate.padding.is_some_and(|padding| !padding.kept));
    }
}

#[test]
fn a_stack_of_charts_that_overlap_themselves_is_refused() {
    // Two turns of a spiral stair, seen from above.
    let points: Vec<[f64; 2]> = (0..=12)
        .flat_map(|k: u32| {
            let angle = f64::from(k);
            [0.1, 0.2].map(|r| [0.5 + r * angle.cos(), 0.5 + r * angle.sin()])
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..12)
        .flat_map(|k| {
            let a = 2 * k;
            [[a, a + 1, a + 3], [a, a + 3, a + 2]]
        })
        .collect();
    let stair = UvMesh::planar(&points, &triangles);
    let mut mesh = stair.clone();
    mesh.add(&stair);
    let certificate = judged(&mesh, Stacks::Accepted);
    assert!(certificate.is_valid());
    assert_eq!(certificate.stacks, Some(vec![vec![0, 1]]));
    assert!(certificate.overlapping_pairs_same_chart > Some(0));
    assert!(!certificate.is_bijective_but_for_stacks());
}

#[test]
fn a_stack_of_many_charts_is_judged_in_time() {
    let charts = vec![tile([0.125; 2]); 3000];
    let certificate = judged(&stacked(&charts), Stacks::Accepted);
    assert!(certificate.is_bijective_but_for_stacks());
    assert_eq!(certificate.stacks.map(|stacks| stacks[0].len()), Some(3000));
}

//! Cages around surfaces, and surfaces carried along by them.

use crate::zoo;
use std::collections::HashMap;
use unwrapd_deform::cage::{Cage, CageError, CagedSurface};
use unwrapd_maps::certificate::crossings;

struct Surface {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    fn of(mesh: &zoo::Mesh) -> Self {
        Self {
            positions: mesh.positions.iter().map(|p| p.map(f64::from)).collect(),
            triangles: mesh.triangles.clone(),
        }
    }

    fn caged(&self) -> CagedSurface<'_> {
        CagedSurface {
            positions: &self.positions,
            triangles: &self.triangles,
        }
    }
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn norm(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn area(positions: &[[f64; 3]], triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| positions[v as usize]);
    0.5 * norm(cross(sub(b, a), sub(c, a)))
}

/// A linear map with shear and stretch, positive determinant, and its inverse transpose times the determinant.
const LINEAR: [[f64; 3]; 3] = [[1.5, 0.25, 0.0], [0.0, 0.5, 0.75], [-0.5, 0.0, 2.0]];

fn linear([x, y, z]: [f64; 3]) -> [f64; 3] {
    LINEAR.map(|row| row[0] * x + row[1] * y + row[2] * z)
}

/// Twists about the z axis by up to `turns` turns per unit of height.
fn twisted(p: [f64; 3], turns: f64) -> [f64; 3] {
    let (sin, cos) = (turns * std::f64::consts::TAU * p[2]).sin_cos();
    [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1], p[2]]
}

#[test]
fn a_cage_fills_what_its_surface_encloses() {
    let sphere = Surface::of(&zoo::sphere(24, 48));
    let cage = Cage::around(&[sphere.caged()], 20).expect("a cage");
    let n_voxels = cage.mesh().tets().len() / 6;
    let volume = n_voxels as f64 * cage.voxel_side().powi(3);
    let radius = norm(sphere.positions[0]);
    let (inner, outer) = (radius, radius + 2.0 * cage.voxel_side());
    let ball = |r: f64| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3);
    assert!(ball(inner) < volume && volume < ball(outer), "{volume}");
    assert_eq!(cage.mesh().reoriented(), 0);
    assert!((cage.voxel_side() / (radius / 10.0) - 1.0).abs() < 1e-3);
}

#[test]
fn vertices_that_no_triangle_uses_follow_the_nearest_voxel() {
    let mut sphere = Surface::of(&zoo::sphere(24, 48));
    let alone = Cage::around(&[sphere.caged()], 20).expect("a cage");
    sphere.positions.extend([[3.0, 0.1, 0.2], [-1e9, 0.0, 0.0]]);
    let cage = Cage::around(&[sphere.caged()], 20).expect("a cage");
    assert_eq!(cage.mesh(), alone.mesh());
    let embedding = cage.embed(&sphere.positions).expect("finite");
    let moved: Vec<[f64; 3]> = cage.mesh().vertices().iter().map(|&p| linear(p)).collect();
    let carried = cage.interpolate(&embedding, &moved);
    for (p, q) in sphere.positions.iter().zip(carried) {
        assert!(norm(sub(q, linear(*p))) < 1e-12 * (1.0 + norm(*p)) * 100.0);
    }
    let nearest = embedding.tets[sphere.positions.len() - 2] as usize;
    let corner = cage.mesh().vertices()[cage.mesh().tets()[nearest][0] as usize];
    assert!(norm(sub(corner, [1.0, 0.1, 0.2])) < 0.3, "{corner:?}");
}

#[test]
fn a_shell_with_a_wide_hole_has_no_inside() {
    let mesh = zoo::grid(20, 20);
    let sheet = Surface::of(&mesh);
    let cage = Cage::around(&[sheet.caged()], 20).expect("a cage");
    let n_voxels = cage.mesh().tets().len() / 6;
    assert!((400..1200).contains(&n_voxels), "{n_voxels} voxels");
}

#[test]
fn points_at_rest_stay_and_linear_maps_are_kept() {
    let torus = Surface::of(&zoo::torus(40, 20));
    let cage = Cage::around(&[torus.caged()], 17).expect("a cage");
    let embedding = cage.embed(&torus.positions).expect("inside");
    let same = cage.interpolate(&embedding, cage.mesh().vertices());
    let moved: Vec<[f64; 3]> = cage.mesh().vertices().iter().map(|&p| linear(p)).collect();
    let carried = cage.interpolate(&embedding, &moved);
    for (k, &p) in torus.positions.iter().enumerate() {
        assert!(norm(sub(same[k], p)) < 1e-12);
        assert!(norm(sub(carried[k], linear(p))) < 1e-12);
        assert!(
            embedding.weights[k].iter().all(|&w| w >= 0.0),
            "{:?}",
            embedding.weights[k]
        );
        assert!((embedding.weights[k].iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
    // Tangents move with the surface, normals stay orthogonal to them.
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, 0.0, 0.8]];
    for k in 0..3 {
        let tangents = vec![axes[k]; torus.positions.len()];
        let along = cage.tangents(&embedding, &moved, &tangents);
        let expected = linear(axes[k]);
        assert!(norm(sub(along[7], expected.map(|x| x / norm(expected)))) < 1e-12);
        let normal = cross(axes[k], axes[(k + 1) % 3]);
        let normals = cage.normals(&embedding, &moved, &vec![normal; torus.positions.len()]);
        let plane = cross(expected, linear(axes[(k + 1) % 3]));
        assert!(norm(sub(normals[7], plane.map(|x| x / norm(plane)))) < 1e-12);
    }
}

#[test]
fn of_several_elements_the_lowest_is_chosen() {
    // Eight voxels of side 1 meet in the middle.
    let positions = [
        [0.25, 0.25, 0.25],
        [2.25, 0.25, 0.25],
        [0.25, 2.25, 2.25],
        [1.0, 1.0, 1.0],
    ];
    let surface = CagedSurface {
        positions: &positions,
        triangles: &[[0, 1, 2], [0, 1, 3]],
    };
    let cage = Cage::around(&[surface], 2).expect("a cage");
    assert_eq!(cage.voxel_side(), 1.0);
    let embedding = cage
        .embed(&[[1.0, 1.0, 1.0], [0.5, 0.5, 0.5]])
        .expect("inside");
    let tets = cage.mesh().tets();
    let middle = cage
        .mesh()
        .vertices()
        .iter()
        .position(|&p| p == [1.0; 3])
        .expect("a corner");
    let lowest = tets
        .iter()
        .position(|t| t.contains(&(middle as u32)))
        .expect("an element");
    assert_eq!(embedding.tets[0], lowest as u32);
    assert_eq!(
        embedding.tets[1], lowest as u32,
        "the first tetrahedron has the diagonal too"
    );
}

#[test]
fn a_split_surface_stays_closed_and_follows_the_cage() {
    let torus = Surface::of(&zoo::torus(40, 20));
    let cage = Cage::around(&[torus.caged()], 13).expect("a cage");
    let split = cage.split(&torus.caged()).expect("pieces");
    assert!(split.triangles.len() > 2 * torus.triangles.len());
    assert_eq!(
        split.positions.len(),
        torus.positions.len() + split.added.len()
    );

    // Closed: each edge is passed once in each direction.
    let mut passes: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
    for t in &split.triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            passes.entry([a.min(b), a.max(b)]).or_default()[usize::from(a < b)] += 1;
        }
    }
    assert!(
        passes.values().all(|&n| n == [1, 1]),
        "the pieces do not fit"
    );

    // The same surface.
    let total = |positions: &[[f64; 3]], triangles: &[[u32; 3]]| -> f64 {
        triangles.iter().map(|t| area(positions, t)).sum()
    };
    let before = total(&torus.positions, &torus.triangles);
    let after = total(&split.positions, &split.triangles);
    assert!((after / before - 1.0).abs() < 1e-12);
    let smallest = split
        .triangles
        .iter()
        .map(|t| area(&split.positions, t))
        .fold(1.0, f64::min);
    assert!(smallest > 0.0);

    // Weights say where the corners are.
    let at = |triangle: u32, weights: [f64; 3]| {
        let corners = torus.triangles[triangle as usize].map(|v| torus.positions[v as usize]);
        [0, 1, 2].map(|x| (0..3).map(|k| weights[k] * corners[k][x]).sum::<f64>())
    };
    for (k, added) in split.added.iter().enumerate() {
        let position = split.positions[torus.positions.len() + k];
        assert!(norm(sub(at(added.triangle, added.weights), position)) < 1e-12);
    }
    for (k, triangle) in split.triangles.iter().enumerate() {
        for (vertex, weights) in triangle.iter().zip(split.weights[k]) {
            let position = split.positions[*vertex as usize];
            assert!(norm(sub(at(split.parents[k], weights), position)) < 1e-12);
        }
    }

    // On a piece the map is linear, but for vertices that count as on a plane: the center goes to the center.
    let moved: Vec<[f64; 3]> = cage
        .mesh()
        .vertices()
        .iter()
        .map(|&p| twisted(p, 0.3))
        .collect();
    let center = |positions: &[[f64; 3]], t: &[u32; 3]| {
        [0, 1, 2].map(|x| t.iter().map(|&v| positions[v as usize][x]).sum::<f64>() / 3.0)
    };
    let embedding = cage.embed(&split.positions).expect("inside");
    let carried = cage.interpolate(&embedding, &moved);
    let centers: Vec<_> = split
        .triangles
        .iter()
        .map(|t| center(&split.positions, t))
        .collect();
    let expected = cage.interpolate(&cage.embed(&centers).expect("inside"), &moved);
    for (t, expected) in split.triangles.iter().zip(expected) {
        assert!(norm(sub(center(&carried, t), expected)) < 1e-5 * cage.voxel_side());
    }
    assert_eq!(crossings(&carried, &split.triangles).pairs, 0);
}

#[test]
fn seams_are_cut_alike_on_both_sides() {
    let torus = zoo::torus(16, 8);
    let (joined, soup) = (Surface::of(&torus), Surface::of(&torus.soup()));
    let cage = Cage::around(&[soup.caged()], 9).expect("a cage");
    let (a, b) = (cage.split(&joined.caged()), cage.split(&soup.caged()));
    let (a, b) = (a.expect("pieces"), b.expect("pieces"));
    assert_eq!(a.triangles.len(), b.triangles.len());
    for (t, u) in a.triangles.iter().zip(&b.triangles) {
        let corners = |s: &[[f64; 3]], t: &[u32; 3]| t.map(|v| s[v as usize]);
        assert_eq!(corners(&a.positions, t), corners(&b.positions, u));
    }
}

#[test]
fn a_surface_on_the_planes_of_the_grid_is_cut_without_slivers() {
    // Corners on whole and half voxels, edges along the diagonals.
    let positions = [
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 0.0],
        [8.0, 8.0, 8.0],
        [0.0, 8.0, 8.0],
        [4.0, 0.5, 8.0],
    ];
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 2, 4], [1, 3, 4]];
    let surface = CagedSurface {
        positions: &positions,
        triangles: &triangles,
    };
    let cage = Cage::around(&[surface], 8).expect("a cage");
    assert_eq!(cage.voxel_side(), 1.0);
    let split = cage.split(&surface).expect("pieces");
    let smallest = split
        .triangles
        .iter()
        .map(|t| area(&split.positions, t))
        .fold(1.0, f64::min);
    assert!(smallest > 1e-4, "{smallest}");
    cage.embed(&split.positions).expect("inside");
}

#[test]
fn parts_pushed_into_each_other_are_counted() {
    let ball = zoo::sphere(12, 24);
    let two = Surface::of(&ball.clone().with(&ball.moved([5.0, 0.0, 0.0])));
    assert_eq!(crossings(&two.positions, &two.triangles).pairs, 0);
    let half = two.positions.len() / 2;
    let pushed: Vec<[f64; 3]> = two
        .positions
        .iter()
        .enumerate()
        .map(|(k, &p)| {
            if k < half {
                p
            } else {
                [p[0] - 3.7, p[1] + 0.1, p[2] + 0.05]
            }
        })
        .collect();
    let found = crossings(&pushed, &two.triangles);
    // Each triangle along the circle of intersection crosses one or two others.
    assert!((10..200).contains(&found.pairs), "{}", found.pairs);
    assert_eq!(found.named.len(), 8);
}

#[test]
fn what_gets_no_cage_is_named() {
    let ball = Surface::of(&zoo::sphere(6, 12));
    let code = |surfaces: &[CagedSurface], n| Cage::around(surfaces, n).map_err(|e| e.code()).err();
    assert_eq!(code(&[ball.caged()], 0), Some("limit_exceeded"));
    assert_eq!(code(&[ball.caged()], 1000), Some("limit_exceeded"));
    assert_eq!(code(&[ball.caged()], u32::MAX), Some("limit_exceeded"));
    assert_eq!(code(&[], 5), Some("no_elements"));
    let mut broken = Surface::of(&zoo::sphere(6, 12));
    broken.positions[3][1] = f64::NAN;
    assert_eq!(
        code(&[ball.caged(), broken.caged()], 5),
        Some("non_finite_position")
    );
    let point = CagedSurface {
        positions: &[[1.0; 3]; 3],
        triangles: &[[0, 1, 2]],
    };
    assert_eq!(code(&[point], 5), Some("no_elements"));
    let far = [[1e12, 0.0, 0.0], [1e12, 1.0, 0.0], [1e12, 0.0, 1.0]];
    let far = CagedSurface {
        positions: &far,
        triangles: &[[0, 1, 2]],
    };
    assert_eq!(code(&[far], 5), Some("limit_exceeded"));
    let cage = Cage::around(&[ball.caged()], 5).expect("a cage");
    assert_eq!(
        cage.embed(&[[0.0; 3], [f64::NAN; 3]]),
        Err(CageError::NonFinitePosition { vertex: 1 })
    );
}

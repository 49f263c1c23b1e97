//! Surfaces that are their own mirror images are cut alike on both sides.

use crate::zoo::{self, Mesh};
use std::collections::{BTreeMap, BTreeSet};
use unwrapd_layout::charts::Symmetry;
use unwrapd_pipeline::{Cutting, Settings, Unobserved, Unwrapped, unwrap};

/// A body with four legs and a head. Its vertices are mirrored at y = 0; its edges are not.
fn animal(n: u32, m: u32) -> Mesh {
    let limbs = [
        [0.6, 0.5, -0.6],
        [0.6, -0.5, -0.6],
        [-0.6, 0.5, -0.6],
        [-0.6, -0.5, -0.6],
        [0.9, 0.0, 0.4],
    ];
    let mut mesh = zoo::sphere(n, m);
    for p in &mut mesh.positions {
        let length = |limb: &[f32; 3]| {
            let squared: f32 = (0..3).map(|k| (p[k] - limb[k]).powi(2)).sum();
            1.5 * (-squared / 0.06).exp()
        };
        let size = 1.0 + limbs.iter().map(length).sum::<f32>();
        *p = p.map(|x| size * x);
    }
    mesh.named("animal")
}

fn unwrapped(mesh: &Mesh, symmetry: Symmetry) -> Unwrapped {
    let settings = Settings {
        cutting: Cutting {
            symmetry,
            ..Cutting::default()
        },
        ..Settings::default()
    };
    unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved).expect("a mesh")
}

type Place = [i32; 3];

fn place(p: [f32; 3]) -> Place {
    p.map(|x| (1e4 * x).round() as i32)
}

/// The edges at which two triangles lie apart in the atlas, in places of their ends.
fn seam(mesh: &Mesh, unwrapped: &Unwrapped) -> BTreeSet<[Place; 2]> {
    let mut sides: BTreeMap<[Place; 2], BTreeSet<[[i32; 2]; 2]>> = BTreeMap::new();
    for (triangle, corners) in mesh.triangles.iter().zip(&unwrapped.grid) {
        for c in 0..3 {
            let end = |c: usize| (place(mesh.positions[triangle[c] as usize]), corners[c]);
            let mut ends = [end(c), end((c + 1) % 3)];
            ends.sort_unstable();
            let side = ends.map(|(_, uv)| uv);
            sides.entry(ends.map(|(p, _)| p)).or_default().insert(side);
        }
    }
    let apart = sides.into_iter().filter(|(_, sides)| sides.len() > 1);
    apart.map(|(edge, _)| edge).collect()
}

/// The share of the vertices of the seam whose mirror image is a vertex of the seam.
fn mirrored_share(mesh: &Mesh, unwrapped: &Unwrapped) -> f64 {
    let seam = seam(mesh, unwrapped);
    let vertices: BTreeSet<Place> = seam.iter().flatten().copied().collect();
    let is_mirrored = |&&[x, y, z]: &&Place| {
        let near = |by: i32| vertices.contains(&[x, by - y, z]);
        near(-1) || near(0) || near(1)
    };
    vertices.iter().filter(is_mirrored).count() as f64 / vertices.len() as f64
}

#[test]
fn both_sides_are_cut_alike() {
    let mesh = animal(48, 31);
    let alike = mirrored_share(&mesh, &unwrapped(&mesh, Symmetry::Auto));
    let without = mirrored_share(&mesh, &unwrapped(&mesh, Symmetry::Off));
    assert!(alike > 0.9 && without < alike - 0.2, "{alike} {without}");
}

#[test]
fn what_is_not_symmetric_is_cut_as_without() {
    let mut mesh = animal(32, 21);
    for p in &mut mesh.positions {
        // One leg is longer, and the body is bent.
        if p[0] > 0.0 && p[1] > 0.3 {
            p[2] *= 1.6;
        }
        p[1] += 0.3 * p[0] * p[0] + 0.2 * p[2];
    }
    let [auto, off] = [Symmetry::Auto, Symmetry::Off].map(|symmetry| unwrapped(&mesh, symmetry));
    assert_eq!(auto.grid, off.grid);
}

mod shared {
    use super::{Symmetry, unwrapped, zoo};
    use crate::places;

    /// Its slits share edges.
    #[test]
    #[ignore = "needs ../shared"]
    fn a_plate_with_holes_is_opened_along_slits_that_meet() {
        let path = places::shared("data/closed/plane_holes.obj");
        let mesh = zoo::read_mesh(&path).expect("a readable mesh");
        assert!(!unwrapped(&mesh, Symmetry::Auto).charts.is_empty());
    }
}

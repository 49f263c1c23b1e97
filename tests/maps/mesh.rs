//! Surfaces, their gluing and their defects.

use crate::zoo::{self, Mesh};
use proptest::prelude::*;
use unwrapd_maps::mesh::{
    CUT, Defects, MeshError, NeedleStep, Surface, canonical_order, looks_like_edge, next, origin,
};

fn surface(mesh: &Mesh) -> Surface {
    Surface::new(&mesh.positions, &mesh.triangles).expect("a usable mesh")
}

fn defects(mesh: &Mesh) -> Defects {
    surface(mesh).defects
}

fn named(name: &str) -> Mesh {
    zoo::zoo()
        .into_iter()
        .find(|mesh| mesh.name == name)
        .expect("in the zoo")
}

/// What must hold for the gluing of any surface.
fn check_gluing(surface: &Surface) {
    let adjacency = surface.adjacency();
    let ends = |h| {
        let (a, b) = (
            origin(&surface.triangles, h),
            origin(&surface.triangles, next(h)),
        );
        (a.min(b), a.max(b))
    };
    for (h, &t) in (0u32..).zip(&adjacency.twin).filter(|(_, t)| **t != CUT) {
        assert_ne!(h / 3, t / 3);
        assert_eq!(adjacency.twin[t as usize], h);
        assert_eq!(ends(h), ends(t));
        assert_eq!(
            adjacency.piece[h as usize / 3],
            adjacency.piece[t as usize / 3]
        );
    }
    for (piece, component) in adjacency.piece.iter().zip(&adjacency.component) {
        assert!((*piece as usize) < adjacency.n_pieces);
        assert!((*component as usize) < adjacency.n_components);
    }
}

#[test]
fn gluing_is_mutual_on_the_zoo() {
    for mesh in zoo::zoo() {
        check_gluing(&surface(&mesh));
    }
}

#[test]
fn welding_makes_split_vertices_one() {
    let torus = zoo::torus(9, 7);
    let soup = surface(&torus.soup());
    assert_eq!(soup.positions.len(), torus.positions.len());
    assert_eq!(
        soup.defects.welded_vertices,
        3 * torus.triangles.len() - torus.positions.len()
    );
    assert_eq!(soup.defects.components, 1);
    assert_eq!(soup.defects.boundary_loops, 0);
}

#[test]
fn minus_zero_is_zero() {
    let mut mesh = zoo::grid(1, 1).soup();
    for x in mesh.positions[3].iter_mut().filter(|x| **x == 0.0) {
        *x = -0.0;
    }
    assert_eq!(surface(&mesh).positions.len(), 4);
}

#[test]
fn each_defect_is_counted() {
    let count = |name: &str, of: fn(&Defects) -> usize| of(&defects(&named(name)));
    assert_eq!(
        count("faces that repeat a vertex", |d| d.repeated_vertex_faces),
        2
    );
    assert_eq!(count("zero-area face", |d| d.zero_area_faces), 1);
    assert_eq!(count("three faces on an edge", |d| d.nonmanifold_edges), 1);
    assert_eq!(count("hourglass", |d| d.bowtie_vertices), 1);
    assert_eq!(count("hourglass", |d| d.components), 2);
    assert_eq!(count("cubes sharing a corner", |d| d.bowtie_vertices), 1);
    assert_eq!(count("cubes sharing an edge", |d| d.nonmanifold_edges), 1);
    assert_eq!(count("cubes sharing an edge", |d| d.bowtie_vertices), 0);
    assert_eq!(count("doubled wall", |d| d.duplicate_faces), 24);
    assert_eq!(count("wall with a back", |d| d.duplicate_faces), 24);
    assert_eq!(count("unreferenced NaN", |d| d.unreferenced_vertices), 1);
    assert_eq!(count("two components", |d| d.components), 2);
    assert_eq!(count("grid with a hole", |d| d.boundary_loops), 2);
    for name in ["Moebius strip", "Klein bottle", "projective plane"] {
        assert_eq!(count(name, |d| d.nonorientable_components), 1, "{name}");
    }
    assert_eq!(count("Moebius strip", |d| d.boundary_loops), 1);
    for name in ["torus", "inconsistent winding"] {
        assert_eq!(count(name, |d| d.nonorientable_components), 0, "{name}");
    }
    assert!(count("inconsistent winding", |d| d.inconsistent_edges) > 0);
}

#[test]
fn clean_meshes_have_no_defects() {
    for (mesh, loops) in [
        (zoo::grid(4, 3), 1),
        (zoo::sphere(12, 9), 0),
        (zoo::torus(9, 7), 0),
    ] {
        let clean = Defects {
            components: 1,
            boundary_loops: loops,
            ..Defects::default()
        };
        assert_eq!(defects(&mesh), clean);
    }
}

#[test]
fn winding_is_made_consistent_and_mostly_kept() {
    let torus = zoo::torus(8, 6);
    let mut mixed = torus.clone();
    for t in mixed.triangles.iter_mut().step_by(3) {
        t.swap(0, 2);
    }
    let turned = surface(&mixed).adjacency().turned.clone();
    assert!(turned.iter().enumerate().all(|(f, &t)| t == (f % 3 == 0)));
}

#[test]
fn the_copies_of_a_wall_are_two_sheets() {
    let wall = zoo::grid(4, 3);
    let doubled = surface(&wall.clone().with(&wall));
    let interior = |h: u32| surface(&wall).adjacency().twin[h as usize] != CUT;
    let n = 3 * wall.triangles.len() as u32;
    for h in (0..n).filter(|&h| interior(h)) {
        assert!(doubled.adjacency().twin[h as usize] < n, "halfedge {h}");
    }
}

/// A surface in canonical order, as positions and triangles.
fn canonical(surface: &Surface) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let ordered = surface.reordered(&canonical_order(surface));
    (ordered.positions, ordered.triangles)
}

#[test]
fn canonical_order_forgets_the_order_of_the_input() {
    for mesh in [zoo::sphere(12, 9), zoo::grid(4, 3), zoo::tube(9, 2.0)].map(Mesh::lopsided) {
        let shuffled = mesh.shuffled();
        assert_ne!(mesh.triangles, shuffled.triangles);
        assert_eq!(canonical(&surface(&mesh)), canonical(&surface(&shuffled)));
    }
}

#[test]
fn canonical_order_turns_with_the_mesh() {
    let mesh = zoo::sphere(12, 9).lopsided();
    let turned = Mesh {
        positions: mesh
            .positions
            .iter()
            .map(|&[x, y, z]| [2.0 * z, 2.0 * x, 2.0 * y])
            .collect(),
        ..mesh.clone()
    };
    assert_eq!(
        canonical_order(&surface(&mesh)),
        canonical_order(&surface(&turned))
    );
}

#[test]
fn reordered_faces_are_glued_as_before() {
    for mesh in zoo::zoo() {
        let surface = surface(&mesh);
        let order = canonical_order(&surface);
        let mut sorted: Vec<u32> = order.iter().map(|h| h / 3).collect();
        sorted.sort_unstable();
        assert!(
            sorted.into_iter().eq(0..surface.triangles.len() as u32),
            "{}",
            mesh.name
        );
        let reordered = surface.reordered(&order);
        check_gluing(&reordered);
        let (old, new) = (surface.adjacency(), reordered.adjacency());
        assert_eq!(
            (old.n_pieces, old.n_components),
            (new.n_pieces, new.n_components)
        );
        for (h, &t) in (0u32..).zip(&new.twin) {
            let before = |h: u32| {
                let first = order[h as usize / 3];
                3 * (first / 3) + (first + h) % 3
            };
            let expected = if t == CUT { CUT } else { before(t) };
            assert_eq!(old.twin[before(h) as usize], expected, "{}", mesh.name);
        }
    }
}

fn n_needles(surface: &Surface) -> usize {
    let triangles = 0..surface.triangles.len();
    triangles
        .filter(|&t| looks_like_edge(surface.corners(t)))
        .count()
}

#[test]
fn surfaces_without_needles_have_nothing_to_take_out() {
    for mesh in [
        zoo::grid(4, 3),
        zoo::cone(7),
        zoo::sphere(6, 8),
        zoo::pillow(),
    ] {
        assert!(surface(&mesh).without_needles().is_none(), "{}", mesh.name);
    }
}

#[test]
fn vertices_on_sides_are_removed() {
    for mesh in [
        zoo::grid(4, 3),
        zoo::tube(7, 2.0),
        zoo::sphere(6, 8),
        zoo::half_turned(12, 2, true),
    ] {
        for height in [0.0, 1e-6] {
            let with_needles = surface(&mesh.clone().with_needles(3, height));
            let (without, of, steps) = with_needles.without_needles().expect("needles");
            assert_eq!(of.len(), mesh.triangles.len(), "{}", mesh.name);
            assert_eq!(without.positions.len(), mesh.positions.len());
            let removed = |step: &NeedleStep| matches!(step, NeedleStep::Removal { .. });
            assert!(steps.iter().all(removed), "{steps:?}");
            check_gluing(&without);
            let boundary = |surface: &Surface| {
                let twin = &surface.adjacency().twin;
                twin.iter().filter(|t| **t == CUT).count()
            };
            assert_eq!(boundary(&without), boundary(&surface(&mesh)));
        }
    }
}

#[test]
fn sides_of_needles_are_flipped() {
    let before = surface(&zoo::needle_on_a_side());
    let (without, of, steps) = before.without_needles().expect("a needle");
    assert_eq!(
        steps,
        [NeedleStep::Flip {
            needle: 12,
            other: 0
        }]
    );
    assert_eq!(of, [0, 1, 2, 3, 4]);
    assert_eq!(n_needles(&without), 0);
    check_gluing(&without);
    let faces_at_2 = without.triangles.iter().filter(|t| t.contains(&2)).count();
    assert_eq!(faces_at_2, 5);
}

#[test]
fn unusable_input_is_named() {
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::INFINITY, 0.0]];
    assert_eq!(
        Surface::new(&flat, &[[0, 1, 3]]).err(),
        Some(MeshError::IndexOutOfRange {
            face: 0,
            vertex: 3,
            n_vertices: 3
        })
    );
    assert_eq!(
        Surface::new(&flat, &[[0, 1, 2]]).err(),
        Some(MeshError::NonFinitePosition { vertex: 2 })
    );
}

proptest! {
    #[test]
    fn any_triangles_make_a_surface(mesh in crate::few_vertices::few_vertices()) {
        let surface = surface(&mesh);
        check_gluing(&surface);
        let kept = surface.triangles.len() + surface.defects.repeated_vertex_faces;
        prop_assert_eq!(kept, mesh.triangles.len());
        for (triangle, &face) in surface.triangles.iter().zip(&surface.faces) {
            for (&v, &input) in triangle.iter().zip(&mesh.triangles[face as usize]) {
                let written = mesh.positions[input as usize].map(f64::from);
                prop_assert_eq!(surface.positions[v as usize], written);
            }
        }
    }

    #[test]
    fn taking_needles_out_keeps_the_gluing(mesh in crate::few_vertices::few_vertices()) {
        // Squeezed flat, most faces are needles.
        let squeezed = |height: f32| Mesh {
            positions: mesh.positions.iter().map(|&[x, y, z]| [x, height * y, height * z]).collect(),
            ..mesh.clone()
        };
        for height in [0.0, 1e-4, 1e-2] {
            let before = surface(&squeezed(height));
            if let Some((without, of, _)) = before.without_needles() {
                check_gluing(&without);
                // A needle may stand for three faces afterward, but every step leaves fewer needles or fewer faces.
                let size = |surface: &Surface| (n_needles(surface), surface.triangles.len());
                let (fewer, more) = (size(&without), size(&before));
                prop_assert!(fewer != more && fewer.0 <= more.0 && fewer.1 <= more.1);
                prop_assert_eq!(of.len(), without.triangles.len());
                for &[a, b, c] in &without.triangles {
                    prop_assert!(a != b && b != c && c != a);
                }
            }
        }
    }
}
